!> Where the numbers of a figure are: file, columns, and how far they reach.
module figure_data
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue, only: catalogue_t
   use extremes, only: extremes_t
   use channel_names, only: item_name, scalar_name, scalar_t
   use figure_words, only: figure_portrait, figure_t
   use kinds, only: wp
   use number_rows, only: number_rows_t
   use posix, only: path_exists
   use text, only: segment, split_blank, text_t
   use text_table, only: column_label
   use text_writer, only: file_of_item
   implicit none (type, external)
   private
   public :: curve_t, data_files_t, find_curves, is_visible, open_columns

   real(wp), parameter :: negligible = 1.0e-4_wp  !! of the largest component: not worth a curve [1]

   !> One curve.
   type :: curve_t
      character(:), allocatable :: path    !! file, as observed from the folder of the figures
      character(:), allocatable :: name    !! of the channel
      integer :: number = 0                !! of the channel among those of the figure
      integer :: x = 1                     !! column of the abscissa
      integer :: y = 0                     !! column of the ordinate
      real(wp) :: x_range(2) = 0.0_wp      !! (2) minimum and maximum abscissa, SI [any]
      real(wp) :: y_range(2) = 0.0_wp      !! (2) minimum and maximum ordinate, SI [any]
      integer :: turns = 0                 !! of the ordinate from rising to falling, or back
      logical :: is_function = .true.      !! the abscissa never falls
      integer :: n_row = 0                 !! rows of the file
   end type curve_t

   !> What is known of a file of columns.
   type :: data_file_t
      character(:), allocatable :: path            !! the file
      type(text_t), allocatable :: labels(:)       !! (n) what stands over its columns
      real(wp), allocatable :: lowest(:)           !! (n) minimum value of each column, SI [any]
      real(wp), allocatable :: highest(:)          !! (n) maximum value of each column, SI [any]
      integer, allocatable :: turns(:)             !! (n) turns of each column from rising to falling, or back
      logical, allocatable :: falls(:)             !! (n) whether each column falls somewhere
      integer :: n_row = 0                         !! rows
   end type data_file_t

   !> The files looked at so far: each is read once.
   type :: data_files_t
      type(data_file_t), allocatable :: files(:)  !! (n) files
   contains
      procedure :: look_up
   end type data_files_t

contains

   !> The number of a file in the list, which is read if it is new; 0 if there is no such file.
   subroutine look_up(self, path, found)
      class(data_files_t), intent(inout) :: self  !! files looked at so far
      character(*), intent(in) :: path            !! the file
      integer, intent(out) :: found               !! its number

      type(data_file_t), allocatable :: grown(:)
      integer :: k

      found = 0
      if (.not. allocated(self%files)) allocate (self%files(0))
      do k = 1, size(self%files)
         if (self%files(k)%path == path) found = k
      end do
      if (found > 0 .or. .not. path_exists(path)) return
      allocate (grown(size(self%files) + 1))
      do k = 1, size(self%files)
         grown(k) = self%files(k)
      end do
      call move_alloc(grown, self%files)
      found = size(self%files)
      call read_data_file(path, self%files(found))
   end subroutine look_up

   !> Read the labels and the ranges of a file.
   subroutine read_data_file(path, file)
      character(*), intent(in) :: path           !! the file
      type(data_file_t), intent(out) :: file     !! what is known of it

      real(wp), allocatable :: before(:), row(:), way(:)
      type(number_rows_t) :: rows
      integer :: k, n
      logical :: is_open

      file%path = path
      call open_columns(path, rows, file%labels, is_open)
      n = size(file%labels)
      allocate (file%lowest(n), source=huge(1.0_wp))
      allocate (file%highest(n), source=-huge(1.0_wp))
      allocate (file%turns(n), source=0)
      allocate (file%falls(n), source=.false.)
      allocate (row(n), way(n), before(n), source=0.0_wp)
      if (.not. is_open) return
      before = huge(1.0_wp)  ! nothing came before
      do while (rows%next(row))
         file%n_row = file%n_row + 1
         do k = 1, n
            if (ieee_is_nan(row(k))) cycle
            file%lowest(k) = min(file%lowest(k), row(k))
            file%highest(k) = max(file%highest(k), row(k))
            if (before(k) < huge(1.0_wp)) then
               if ((row(k) - before(k))*way(k) < 0.0_wp) file%turns(k) = file%turns(k) + 1
               if (row(k) < before(k)) file%falls(k) = .true.
               if (row(k) < before(k) .or. row(k) > before(k)) way(k) = sign(1.0_wp, row(k) - before(k))
            end if
            before(k) = row(k)
         end do
      end do
      call rows%close()
   end subroutine read_data_file

   !> Open a file of columns, whose names are its first line.
   subroutine open_columns(path, rows, labels, is_open)
      character(*), intent(in) :: path                        !! the file
      type(number_rows_t), intent(inout) :: rows              !! the open file
      type(text_t), allocatable, intent(out) :: labels(:)     !! (n) what stands over its columns
      logical, intent(out) :: is_open                         !! it is open

      character(:), allocatable :: line
      integer :: status, unit

      allocate (labels(0))
      is_open = .false.
      open (newunit=unit, file=path, status="old", action="read", iostat=status)
      if (status /= 0) return
      call read_line(unit, line, status)
      close (unit)
      if (status /= 0) return
      labels = split_blank(segment(line, 2))
      is_open = rows%open(path)
   end subroutine open_columns

   !> Read a line of any length.
   subroutine read_line(unit, line, status)
      integer, intent(in) :: unit                          !! the open file
      character(:), allocatable, intent(out) :: line       !! the line
      integer, intent(out) :: status                       !! 0: there was one

      character(512) :: part
      integer :: length

      line = ""
      do
         read (unit, "(a)", advance="no", iostat=status, size=length) part
         if (status == 0 .or. is_iostat_eor(status)) line = line//part(1:length)
         if (status /= 0) exit
      end do
      if (is_iostat_eor(status)) status = 0
   end subroutine read_line

   !> The curves of a figure that a run with a given suffix left behind, as many as there are.
   subroutine find_curves(figure, catalogue, extremes, directory, suffix, files, curves)
      type(figure_t), intent(in) :: figure                      !! the figure
      type(catalogue_t), intent(in) :: catalogue                !! what was recorded
      type(extremes_t), intent(in) :: extremes                  !! what is round-off
      character(*), intent(in) :: directory                     !! of the run
      character(*), intent(in) :: suffix                        !! blank, or `.ideal`
      type(data_files_t), intent(inout) :: files                !! files looked at so far
      type(curve_t), allocatable, intent(out) :: curves(:)      !! (n) curves

      type(curve_t) :: curve
      integer :: k

      allocate (curves(0))
      if (figure%kind == figure_portrait) then
         call find_curve(figure%scalars(2), catalogue, extremes, directory, suffix, files, curve, &
                         over=figure%scalars(1), apart=figure%name)
         if (curve%y > 0 .and. curve%x > 0) call append_curve(curves, curve)
         return
      end if
      do k = 1, size(figure%scalars)
         if (k == figure%curves%abscissa) cycle
         if (figure%curves%abscissa > 0) then
            call find_curve(figure%scalars(k), catalogue, extremes, directory, suffix, files, curve, &
                            over=figure%scalars(figure%curves%abscissa), apart=figure%name)
         else
            call find_curve(figure%scalars(k), catalogue, extremes, directory, suffix, files, curve)
         end if
         curve%number = k
         if (curve%y > 0 .and. curve%x > 0) call append_curve(curves, curve)
      end do
   end subroutine find_curves

   !> Append a curve to a list.
   subroutine append_curve(curves, curve)
      type(curve_t), allocatable, intent(inout) :: curves(:)  !! (n) curves
      type(curve_t), intent(in) :: curve                      !! the new one

      type(curve_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(size(curves) + 1))
      do k = 1, size(curves)
         grown(k) = curves(k)
      end do
      grown(size(grown)) = curve
      call move_alloc(grown, curves)
   end subroutine append_curve

   !> One curve; its column is 0 if it is not there or holds no numbers.
   subroutine find_curve(scalar, catalogue, extremes, directory, suffix, files, curve, over, apart)
      type(scalar_t), intent(in) :: scalar              !! the ordinate
      type(catalogue_t), intent(in) :: catalogue        !! what was recorded
      type(extremes_t), intent(in) :: extremes          !! what is round-off
      character(*), intent(in) :: directory             !! of the run
      character(*), intent(in) :: suffix                !! blank, or `.ideal`
      type(data_files_t), intent(inout) :: files        !! files looked at so far
      type(curve_t), intent(out) :: curve               !! the curve
      type(scalar_t), intent(in), optional :: over      !! the abscissa; absent: time
      character(*), intent(in), optional :: apart       !! file in the folder of figures if the two are apart

      character(:), allocatable :: file
      integer :: number

      file = file_of_item(item_name(catalogue, catalogue%groups(scalar%group)%room, scalar%item), suffix)
      curve%path = "../"//file
      if (present(over)) then
         if (file /= file_of_item(item_name(catalogue, catalogue%groups(over%group)%room, over%item), suffix)) then
            curve%path = file_of_item(apart, suffix)
            file = "figures/"//curve%path
         end if
      end if
      curve%name = scalar_name(catalogue, scalar)
      call files%look_up(directory//"/"//file, number)
      if (number == 0) return
      associate (this => files%files(number))
         curve%y = column_of(this, column_label(catalogue, scalar))
         if (curve%y > 0) call get_range(this, curve%y, noise_of(scalar), curve%y_range)
         if (present(over)) curve%x = column_of(this, column_label(catalogue, over))
         if (curve%y > 0) curve%turns = this%turns(curve%y)
         curve%n_row = this%n_row
         if (curve%x == 0 .or. curve%y == 0) return
         call get_range(this, curve%x, noise_of(over), curve%x_range)
         curve%is_function = .not. this%falls(curve%x)
      end associate

   contains

      !> What is round-off in a number.
      pure real(wp) function noise_of(one)
         type(scalar_t), intent(in), optional :: one   !! the number; absent: time

         noise_of = 0.0_wp
         if (present(one)) noise_of = extremes%noise_in(catalogue%groups(one%group)%channel%unit)
      end function noise_of

   end subroutine find_curve

   !> The column with a given label that holds at least one number, 0 if there is none.
   integer function column_of(file, label)
      type(data_file_t), intent(in) :: file  !! the file
      character(*), intent(in) :: label      !! what stands over the column

      integer :: k

      column_of = 0
      do k = 1, size(file%labels)
         if (file%labels(k)%s == label .and. file%lowest(k) <= file%highest(k)) column_of = k
      end do
   end function column_of

   !> Minimum and maximum value of a column; zero if all is round-off.
   subroutine get_range(file, column, noise, range)
      type(data_file_t), intent(in) :: file  !! the file
      integer, intent(in) :: column          !! number of the column
      real(wp), intent(in) :: noise          !! less is round-off, SI [any]
      real(wp), intent(out) :: range(2)      !! (2) minimum, maximum, SI [any]

      range = [file%lowest(column), file%highest(column)]
      if (all(abs(range) <= noise)) range = 0.0_wp
   end subroutine get_range

   !> Which curves are not so small beside the others that nobody would see them.
   pure function is_visible(curves) result(visible)
      type(curve_t), intent(in) :: curves(:)     !! (n) curves of one quantity
      logical, allocatable :: visible(:)         !! (n) whether to draw it

      real(wp) :: extent(size(curves))
      integer :: k

      do k = 1, size(curves)
         extent(k) = maxval(abs(curves(k)%y_range))
      end do
      visible = extent >= negligible*maxval(extent)
   end function is_visible

end module figure_data
