!> What figures of curves draw: where the numbers of their channels stand in the files of the run, and their ranges.
!>
!> No row is kept: what a figure needs of each it reads from the file (`row_reader`), so that memory does not grow with the run.
module drawn_rows
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use channel_names, only: scalar_t
   use kinds, only: pi, wp
   use text, only: text_t
   use text_table, only: column_label
   use text_writer, only: text_writer_t
   implicit none (type, external)
   private
   public :: drawn_rows_t, labels_of

   !> A column of a file.
   type :: file_column_t
      character(:), allocatable :: path    !! of the file within the run's directory
      character(:), allocatable :: label   !! what stands over the column
      integer :: number = 0                !! of the column in the file
      integer :: series = 0                !! number of its course
   end type file_column_t

   !> Range of the numbers of a column, and how often they turn and fall.
   type :: course_t
      real(wp) :: range(2) = [huge(1.0_wp), -huge(1.0_wp)]  !! (2) minimum, maximum; without numbers reversed, SI [any]
      integer :: turns = 0                                  !! from rising to falling, or back
      integer :: falls = 0                                  !! from one number to the next
      integer :: jumps = 0                                  !! by more than pi from one number to the next
      real(wp), private :: before = huge(1.0_wp)            !! the number before; huge: nothing came before, SI [any]
      integer, private :: direction = 0                     !! 1: rising, -1: falling
   end type course_t

   !> The rows.
   type :: drawn_rows_t
      type(text_t), allocatable :: labels(:)                !! (any) labels of the columns that are drawn
      type(file_column_t), allocatable :: columns(:)        !! (any) the columns, in all files that hold them
      type(scalar_t), allocatable, private :: scalars(:)    !! (m) the numbers, each once
      type(course_t), allocatable :: courses(:)             !! (0:m) of time, then of the numbers
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
      allocate (self%courses(0:size(self%scalars)))
   end subroutine start

   !> Take a row that is written to the files.
   subroutine sample(self, t, catalogue)
      class(drawn_rows_t), intent(inout) :: self    !! the rows
      real(wp), intent(in) :: t                     !! time [s]
      type(catalogue_t), intent(in) :: catalogue    !! values at t

      integer :: k

      if (.not. allocated(self%courses)) return
      self%n = self%n + 1
      call follow(t, self%courses(0))
      do k = 1, size(self%scalars)
         associate (scalar => self%scalars(k))
            call follow(catalogue%values(catalogue%place(scalar%group, scalar%component, scalar%item)), self%courses(k))
         end associate
      end do
   end subroutine sample

   !> Take one more number of a column.
   pure subroutine follow(x, course)
      real(wp), intent(in) :: x                  !! the number, SI [any]
      type(course_t), intent(inout) :: course    !! of its column

      if (ieee_is_nan(x)) return
      associate (before => course%before)
         if (before < huge(1.0_wp)) then
            if ((x - before)*course%direction < 0.0_wp) course%turns = course%turns + 1
            if (x < before) course%falls = course%falls + 1
            if (abs(x - before) > pi) course%jumps = course%jumps + 1
            if (x < before .or. x > before) course%direction = merge(-1, 1, x < before)
         end if
         course%range = [min(course%range(1), x), max(course%range(2), x)]
         before = x
      end associate
   end subroutine follow

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

   !> Write what is known of the rows.
   subroutine save_rows(self, archive)
      class(drawn_rows_t), intent(in) :: self    !! the rows
      type(archive_t), intent(inout) :: archive  !! receives it

      integer :: k

      if (.not. allocated(self%courses)) return
      call archive%put(self%n)
      do k = 0, size(self%scalars)
         associate (course => self%courses(k))
            call archive%put([course%range, course%before])
            call archive%put([course%turns, course%falls, course%jumps, course%direction])
         end associate
      end do
   end subroutine save_rows

   !> Read it.
   subroutine load_rows(self, archive)
      class(drawn_rows_t), intent(inout) :: self !! the rows, started
      type(archive_t), intent(inout) :: archive  !! holds it

      integer :: k

      if (.not. allocated(self%courses)) return
      call archive%get(self%n)
      do k = 0, size(self%scalars)
         associate (course => self%courses(k))
            call archive%get(course%range)
            call archive%get(course%before)
            call archive%get(course%turns)
            call archive%get(course%falls)
            call archive%get(course%jumps)
            call archive%get(course%direction)
         end associate
      end do
   end subroutine load_rows

end module drawn_rows
