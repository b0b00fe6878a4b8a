!> A row of numbers that grows as it is written, for what is remembered of a run and whose size nobody knows beforehand.
!>
!> Written in one order and read in the same one. Counts, flags and characters travel as whole numbers in doubles, exact below
!> 2^53; lists carry their length. Whoever reads an archive that is too short gets zeros, and `is_good` is false from there on.
module archive
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: archive_t

   integer, parameter :: first_group = 256  !! numbers

   !> The row.
   type :: archive_t
      integer :: n = 0                       !! numbers written
      integer :: place = 0                   !! numbers read
      logical :: is_good = .true.            !! nobody has read beyond the end
      real(wp), allocatable :: row(:)        !! (n or more) the numbers [any]
   contains
      procedure, private :: put_real, put_reals, put_integer, put_integers, put_long, put_logical, put_text
      procedure, private :: get_real, get_reals, get_integer, get_integers, get_long, get_logical
      generic :: put => put_real, put_reals, put_integer, put_integers, put_long, put_logical, put_text
      generic :: get => get_real, get_reals, get_integer, get_integers, get_long, get_logical
      procedure :: put_list => archive_put_list
      procedure :: get_list => archive_get_list
      procedure :: get_text => archive_get_text
      procedure :: is_at_end => archive_is_at_end
   end type archive_t

contains

   !> Storage for so many numbers more.
   subroutine make_storage(self, more)
      class(archive_t), intent(inout) :: self  !! the archive
      integer, intent(in) :: more           !! numbers to come

      real(wp), allocatable :: grown(:)

      if (.not. allocated(self%row)) allocate (self%row(max(first_group, more)))
      if (self%n + more <= size(self%row)) return
      allocate (grown(max(2*size(self%row), self%n + more)))
      grown(:self%n) = self%row(:self%n)
      call move_alloc(grown, self%row)
   end subroutine make_storage

   subroutine put_real(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      real(wp), intent(in) :: value         !! the value [any]

      call make_storage(self, 1)
      self%n = self%n + 1
      self%row(self%n) = value
   end subroutine put_real

   subroutine put_reals(self, values)
      class(archive_t), intent(inout) :: self  !! the archive
      real(wp), intent(in) :: values(:)     !! (any) the values [any]

      call make_storage(self, size(values))
      self%row(self%n + 1:self%n + size(values)) = values
      self%n = self%n + size(values)
   end subroutine put_reals

   subroutine put_integer(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      integer, intent(in) :: value          !! the value

      call put_real(self, real(value, wp))
   end subroutine put_integer

   subroutine put_integers(self, values)
      class(archive_t), intent(inout) :: self  !! the archive
      integer, intent(in) :: values(:)      !! (any) the values

      call put_reals(self, real(values, wp))
   end subroutine put_integers

   subroutine put_long(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      integer(i8), intent(in) :: value      !! the value

      call put_real(self, real(value, wp))
   end subroutine put_long

   subroutine put_logical(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      logical, intent(in) :: value          !! the value

      call put_real(self, merge(1.0_wp, 0.0_wp, value))
   end subroutine put_logical

   !> A text with its length.
   subroutine put_text(self, text)
      class(archive_t), intent(inout) :: self  !! the archive
      character(*), intent(in) :: text      !! the text

      integer :: k

      call put_integer(self, len(text))
      call put_integers(self, [(iachar(text(k:k)), k=1, len(text))])
   end subroutine put_text

   !> A list of numbers with its length.
   subroutine archive_put_list(self, values)
      class(archive_t), intent(inout) :: self  !! the archive
      real(wp), intent(in) :: values(:)     !! (any) the values [any]

      call put_integer(self, size(values))
      call put_reals(self, values)
   end subroutine archive_put_list

   subroutine get_real(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      real(wp), intent(out) :: value        !! the value [any]

      value = 0.0_wp
      self%is_good = self%is_good .and. self%place < self%n
      if (.not. self%is_good) return
      self%place = self%place + 1
      value = self%row(self%place)
   end subroutine get_real

   subroutine get_reals(self, values)
      class(archive_t), intent(inout) :: self   !! the archive
      real(wp), intent(out) :: values(:)     !! (any) the values [any]

      values = 0.0_wp
      self%is_good = self%is_good .and. self%place + size(values) <= self%n
      if (.not. self%is_good) return
      values = self%row(self%place + 1:self%place + size(values))
      self%place = self%place + size(values)
   end subroutine get_reals

   subroutine get_integer(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      integer, intent(out) :: value         !! the value

      real(wp) :: number

      call get_real(self, number)
      value = nint(number)
   end subroutine get_integer

   subroutine get_integers(self, values)
      class(archive_t), intent(inout) :: self   !! the archive
      integer, intent(out) :: values(:)      !! (any) the values

      integer :: k

      do k = 1, size(values)
         call get_integer(self, values(k))
      end do
   end subroutine get_integers

   subroutine get_long(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      integer(i8), intent(out) :: value     !! the value

      real(wp) :: number

      call get_real(self, number)
      value = nint(number, i8)
   end subroutine get_long

   subroutine get_logical(self, value)
      class(archive_t), intent(inout) :: self  !! the archive
      logical, intent(out) :: value         !! the value

      real(wp) :: number

      call get_real(self, number)
      value = nint(number) == 1
   end subroutine get_logical

   !> A list of numbers as long as it was.
   subroutine archive_get_list(self, values)
      class(archive_t), intent(inout) :: self                 !! the archive
      real(wp), allocatable, intent(out) :: values(:)      !! (any) the values [any]

      integer :: n

      call get_integer(self, n)
      self%is_good = self%is_good .and. n >= 0 .and. n <= self%n - self%place
      allocate (values(merge(n, 0, self%is_good)), source=0.0_wp)
      call get_reals(self, values)
   end subroutine archive_get_list

   !> A text.
   subroutine archive_get_text(self, text)
      class(archive_t), intent(inout) :: self                 !! the archive
      character(:), allocatable, intent(out) :: text       !! the text

      real(wp), allocatable :: codes(:)
      integer :: k

      call archive_get_list(self, codes)
      allocate (character(size(codes)) :: text)
      do k = 1, size(codes)
         text(k:k) = achar(nint(codes(k)))
      end do
   end subroutine archive_get_text

   !> Whether all that was written has been read, and no more.
   pure logical function archive_is_at_end(self) result(is_at_end)
      class(archive_t), intent(in) :: self  !! the archive

      is_at_end = self%is_good .and. self%place == self%n
   end function archive_is_at_end

end module archive
