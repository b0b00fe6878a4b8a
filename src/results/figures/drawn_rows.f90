!> What figures of curves draw: the rows of their channels, in memory, and where the same numbers stand in the files of the run.
module drawn_rows
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use kinds, only: wp
   use text, only: text_t
   use text_table, only: column_label
   use text_writer, only: text_writer_t
   implicit none (type, external)
   private
   public :: drawn_rows_t, labels_of

   integer, parameter :: first_rows = 1024  !! capacity at the start; it doubles

   !> A column of a file.
   type :: file_column_t
      character(:), allocatable :: path    !! of the file within the run's directory
      character(:), allocatable :: label   !! what stands over the column
      integer :: number = 0                !! of the column in the file
      integer :: series = 0                !! of its numbers in `x`
   end type file_column_t

   !> The rows.
   type :: drawn_rows_t
      type(text_t), allocatable :: labels(:)                !! (any) labels of the columns that are drawn
      type(file_column_t), allocatable :: columns(:)        !! (any) the columns, in all files that hold them
      type(scalar_t), allocatable, private :: scalars(:)    !! (m) the numbers, each once
      real(wp), allocatable :: x(:, :)                      !! (capacity, 0:m) time, then the numbers, SI [any]
      integer :: n = 0                                      !! rows
   contains
      procedure :: start
      procedure :: sample
      procedure :: find
      procedure :: save => save_rows
      procedure :: load => load_rows
   end type drawn_rows_t

contains

   !> What stands over the columns of some numbers.
   function labels_of(scalars, catalogue) result(labels)
      type(scalar_t), intent(in) :: scalars(:)     !! (n) numbers
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      type(text_t) :: labels(size(scalars))        !! (n) labels

      integer :: k

      do k = 1, size(scalars)
         labels(k)%s = column_label(catalogue, scalars(k))
      end do
   end function labels_of

   !> Start with no rows of the columns that have the labels.
   subroutine start(self, texts, catalogue)
      class(drawn_rows_t), intent(inout) :: self    !! the rows, with their labels
      type(text_writer_t), intent(in) :: texts      !! files of the run
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded

      type(file_column_t) :: column
      integer :: i, j, k

      allocate (self%columns(0), self%scalars(0))
      do k = 1, size(texts%tables)
         do i = 1, size(texts%tables(k)%columns)
            associate (scalar => texts%tables(k)%columns(i))
               column%label = column_label(catalogue, scalar)
               if (.not. any([(self%labels(j)%s == column%label, j=1, size(self%labels))])) cycle
               column%path = texts%names(k)%s
               column%number = i + 1
               column%series = findloc(self%scalars%group == scalar%group .and. self%scalars%item == scalar%item .and. &
                                       self%scalars%component == scalar%component, .true., dim=1)
               if (column%series == 0) self%scalars = [self%scalars, scalar]
               if (column%series == 0) column%series = size(self%scalars)
               self%columns = [self%columns, column]
            end associate
         end do
      end do
      allocate (self%x(first_rows, 0:size(self%scalars)))
   end subroutine start

   !> Keep a row.
   subroutine sample(self, t, catalogue)
      class(drawn_rows_t), intent(inout) :: self    !! the rows
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      integer :: k

      if (.not. allocated(self%x)) return
      if (self%n == size(self%x, 1)) call grow(self, 2*self%n)
      self%n = self%n + 1
      self%x(self%n, 0) = t
      do k = 1, size(self%scalars)
         associate (scalar => self%scalars(k))
            self%x(self%n, k) = catalogue%values(catalogue%place(scalar%group, scalar%component, scalar%item))
         end associate
      end do
   end subroutine sample

   !> Make storage for more rows.
   subroutine grow(self, capacity)
      class(drawn_rows_t), intent(inout) :: self  !! the rows
      integer, intent(in) :: capacity             !! rows

      real(wp), allocatable :: x(:, :)

      allocate (x(capacity, 0:size(self%scalars)))
      x(:self%n, :) = self%x(:self%n, :)
      call move_alloc(x, self%x)
   end subroutine grow

   !> The column of a file with a label; 0: it is not kept.
   pure integer function find(self, path, label) result(column)
      class(drawn_rows_t), intent(in) :: self  !! the rows
      character(*), intent(in) :: path         !! of the file within the run's directory
      character(*), intent(in) :: label        !! what stands over the column

      if (allocated(self%columns)) then
         do column = size(self%columns), 1, -1
            if (self%columns(column)%path == path .and. self%columns(column)%label == label) return
         end do
      end if
      column = 0
   end function find

   !> Write the rows.
   subroutine save_rows(self, archive)
      class(drawn_rows_t), intent(in) :: self    !! the rows
      type(archive_t), intent(inout) :: archive  !! receives them

      integer :: k

      call archive%put(self%n)
      if (self%n == 0) return
      do k = 0, size(self%scalars)
         call archive%put(self%x(:self%n, k))
      end do
   end subroutine save_rows

   !> Read them.
   subroutine load_rows(self, archive)
      class(drawn_rows_t), intent(inout) :: self !! the rows, started
      type(archive_t), intent(inout) :: archive  !! holds them

      integer :: k, n

      call archive%get(n)
      if (n <= 0 .or. n > archive%n .or. .not. allocated(self%x)) return
      call grow(self, max(n, first_rows))
      self%n = n
      do k = 0, size(self%scalars)
         call archive%get(self%x(:n, k))
      end do
   end subroutine load_rows

end module drawn_rows
