!> What a run remembers: a row of numbers that grows as it is written, and is read in the same order.
!>
!> Counts, flags and characters travel as whole numbers in doubles, exact below 2^53; lists carry their length. Whoever reads an
!> archive that is too short gets zeros, and `is_good` is false from there on. The row may be cut into segments, each with a name
!> and the version of its form: an archive of another run, or of another form, is refused by the name of what differs.
module archive
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: i8, wp
   use text, only: counted, to_text
   implicit none (type, external)
   private
   public :: archive_t, segment_t

   integer, parameter :: first_group = 256  !! numbers

   !> A segment of the row.
   type :: segment_t
      character(:), allocatable :: name   !! what remembers it, as `clearance.revolute 'gudgeon'`
      integer :: version = 1              !! of its form: raised where what is saved, or its order, changes
      integer :: size = 0                 !! how many numbers
      logical :: is_fixed = .true.        !! their number does not change while a run continues
   end type segment_t

   !> The row.
   type :: archive_t
      integer :: n = 0                       !! numbers written
      integer :: place = 0                   !! numbers read
      logical :: is_good = .true.            !! nobody has read beyond the end
      real(wp), allocatable :: row(:)        !! (n or more) the numbers [any]
      type(segment_t), allocatable :: segments(:)   !! (any) in the order of the row; unallocated: none
   contains
      procedure :: begin => archive_begin
      procedure :: drop_empty => archive_drop_empty
      procedure :: reserve => make_storage
      procedure :: compare => archive_compare
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

   !> Begin a segment: what is put from now on belongs to it.
   subroutine archive_begin(self, name, version, is_fixed)
      class(archive_t), intent(inout) :: self       !! the archive
      character(*), intent(in) :: name              !! what remembers it
      integer, intent(in) :: version                !! of its form
      logical, intent(in), optional :: is_fixed     !! its size does not change; absent: it does not

      type(segment_t), allocatable :: grown(:)
      integer :: last

      last = 0
      if (allocated(self%segments)) last = size(self%segments)
      allocate (grown(last + 1))
      if (last > 0) grown(:last) = self%segments
      grown(last + 1)%name = name
      grown(last + 1)%version = version
      if (present(is_fixed)) grown(last + 1)%is_fixed = is_fixed
      call move_alloc(grown, self%segments)
   end subroutine archive_begin

   !> Drop the last segment if it has no numbers.
   subroutine archive_drop_empty(self)
      class(archive_t), intent(inout) :: self       !! the archive

      type(segment_t), allocatable :: others(:)

      if (self%segments(size(self%segments))%size > 0) return
      others = self%segments(:size(self%segments) - 1)
      call move_alloc(others, self%segments)
   end subroutine archive_drop_empty

   !> Whether the archive can be read by those who have written another; the first segment that differs is named.
   subroutine archive_compare(self, written, error)
      class(archive_t), intent(in) :: self                 !! the archive
      type(archive_t), intent(in) :: written               !! by those who would read it
      type(error_t), allocatable, intent(out) :: error     !! what differs: name, version or size

      integer :: k

      associate (here => written%segments, there => self%segments)
         do k = 1, min(size(here), size(there))
            if (there(k)%name /= here(k)%name) then
               call refuse("it contains the state of "//there(k)%name//" instead of that of "//here(k)%name)
            else if (there(k)%version /= here(k)%version) then
               call refuse("the state of "//here(k)%name//" has version "//to_text(there(k)%version)// &
                           ", supported is version "//to_text(here(k)%version))
            else if (there(k)%size /= here(k)%size .and. here(k)%is_fixed) then
               call refuse("the state of "//here(k)%name//" has "//counted(there(k)%size, "number", "numbers")// &
                           ", expected "//to_text(here(k)%size))
            end if
            if (allocated(error)) return
         end do
         if (size(there) > size(here)) then
            call refuse("it contains the state of "//there(size(here) + 1)%name//", which is not part of this run")
         else if (size(here) > size(there)) then
            call refuse("the state of "//here(size(there) + 1)%name//" is missing")
         else if (self%n /= sum(there%size)) then
            call refuse("it has "//counted(self%n, "number", "numbers")//", but its segments describe "//to_text(sum(there%size)))
         end if
      end associate

   contains

      !> Say what differs.
      subroutine refuse(difference)
         character(*), intent(in) :: difference  !! the sentence

         call set_error(error, exit_usage, "the checkpoint does not belong to this run: "//difference//new_line("a")// &
                        "  = use the same deck, options and version of gudgeon as the interrupted run")
      end subroutine refuse

   end subroutine archive_compare

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

      call put_reals(self, [value])
   end subroutine put_real

   subroutine put_reals(self, values)
      class(archive_t), intent(inout) :: self  !! the archive
      real(wp), intent(in) :: values(:)     !! (any) the values [any]

      call make_storage(self, size(values))
      self%row(self%n + 1:self%n + size(values)) = values
      self%n = self%n + size(values)
      if (.not. allocated(self%segments)) return
      associate (last => self%segments(size(self%segments)))
         last%size = last%size + size(values)
      end associate
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
