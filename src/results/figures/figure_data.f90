!> The curves of figures: file and columns for gnuplot, and how far they reach.
module figure_data
   use catalogue, only: catalogue_t
   use catalogue_groups, only: goes_round
   use channel_names, only: item_name, scalar_name, scalar_t
   use drawn_rows, only: drawn_rows_t
   use extremes, only: extremes_t
   use figure_words, only: figure_portrait, figure_t
   use kinds, only: wp
   use text_table, only: column_label
   use text_writer, only: file_of_item
   implicit none (type, external)
   private
   public :: curve_t, find_curves, is_visible

   real(wp), parameter :: negligible = 1.0e-4_wp  !! of the largest component: not worth a curve [1]

   !> One curve.
   type :: curve_t
      character(:), allocatable :: path    !! file, as observed from the folder of the figures
      character(:), allocatable :: name    !! of the channel
      integer :: number = 0                !! of the channel among those of the figure
      integer :: x = 1                     !! column of the abscissa
      integer :: y = 0                     !! column of the ordinate
      logical :: is_there = .false.        !! both columns hold numbers
      character(:), allocatable :: x_label !! what stands over the column of the abscissa
      character(:), allocatable :: y_label !! over that of the ordinate
      real(wp) :: x_range(2) = 0.0_wp      !! (2) minimum and maximum abscissa, SI [any]
      real(wp) :: y_range(2) = 0.0_wp      !! (2) minimum and maximum ordinate, SI [any]
      logical :: wraps(2) = .false.        !! (2) abscissa, ordinate: an angle that jumps from pi to -pi, or back
      integer :: turns = 0                 !! of the ordinate from rising to falling, or back
      integer :: falls = 0                 !! of the abscissa from one row to the next
   end type curve_t

contains

   !> The curves of a figure among the rows of a run, as many as there are.
   subroutine find_curves(figure, catalogue, extremes, rows, suffix, curves)
      type(figure_t), intent(in) :: figure                      !! the figure
      type(catalogue_t), intent(in) :: catalogue                !! what was recorded
      type(extremes_t), intent(in) :: extremes                  !! what is round-off
      type(drawn_rows_t), intent(in) :: rows                    !! of the run
      character(*), intent(in) :: suffix                        !! of its files: blank, or `.ideal`
      type(curve_t), allocatable, intent(out) :: curves(:)      !! (n) curves

      type(curve_t) :: curve
      integer :: k, over

      allocate (curves(0))
      over = figure%curves%abscissa
      if (figure%kind == figure_portrait) over = 1
      do k = 1, size(figure%scalars)
         if (k == over) cycle
         if (over > 0) then
            call find_curve(figure%scalars(k), catalogue, extremes, rows, suffix, curve, figure%scalars(over), figure%name)
         else
            call find_curve(figure%scalars(k), catalogue, extremes, rows, suffix, curve)
         end if
         curve%number = k
         if (curve%is_there) curves = [curves, curve]
      end do
   end subroutine find_curves

   !> One curve; it is not there if one of its columns is not there or holds no numbers.
   subroutine find_curve(scalar, catalogue, extremes, rows, suffix, curve, over, apart)
      type(scalar_t), intent(in) :: scalar              !! the ordinate
      type(catalogue_t), intent(in) :: catalogue        !! what was recorded
      type(extremes_t), intent(in) :: extremes          !! what is round-off
      type(drawn_rows_t), intent(in) :: rows            !! of the run
      character(*), intent(in) :: suffix                !! of its files: blank, or `.ideal`
      type(curve_t), intent(out) :: curve               !! the curve
      type(scalar_t), intent(in), optional :: over      !! the abscissa; absent: time
      character(*), intent(in), optional :: apart       !! file in the folder of figures if the two are apart

      character(:), allocatable :: file
      integer :: x, y

      file = file_of(scalar)
      curve%path = "../"//file
      curve%name = scalar_name(catalogue, scalar)
      curve%x_label = "time[s]"
      curve%y_label = column_label(catalogue, scalar)
      x = 0
      if (present(over)) then
         if (file /= file_of(over)) then
            curve%path = file_of_item(apart, suffix)
            file = "figures/"//curve%path
         end if
         curve%x_label = column_label(catalogue, over)
         x = rows%find(file, curve%x_label)
         if (x == 0) return
      end if
      y = rows%find(file, curve%y_label)
      if (y == 0) return
      curve%y = rows%columns(y)%number
      if (x > 0) curve%x = rows%columns(x)%number
      if (x > 0) x = rows%columns(x)%series
      y = rows%columns(y)%series
      curve%x_range = beyond_noise(rows%courses(x)%range, noise_of(over))
      curve%y_range = beyond_noise(rows%courses(y)%range, noise_of(scalar))
      if (present(over)) curve%wraps(1) = rows%courses(x)%jumps > 0 .and. goes_round(catalogue%groups(over%group))
      curve%wraps(2) = rows%courses(y)%jumps > 0 .and. goes_round(catalogue%groups(scalar%group))
      curve%falls = rows%courses(x)%falls
      curve%turns = rows%courses(y)%turns
      curve%is_there = curve%x_range(1) <= curve%x_range(2) .and. curve%y_range(1) <= curve%y_range(2)

   contains

      !> The file of an item.
      function file_of(one) result(file)
         type(scalar_t), intent(in) :: one      !! one of its numbers
         character(:), allocatable :: file      !! within the run's directory

         file = file_of_item(item_name(catalogue, catalogue%groups(one%group)%item_group, one%item), suffix)
      end function file_of

      !> What is round-off in a number.
      pure real(wp) function noise_of(one)
         type(scalar_t), intent(in), optional :: one   !! the number; absent: time

         noise_of = 0.0_wp
         if (present(one)) noise_of = extremes%noise_in(catalogue%groups(one%group)%channel%unit)
      end function noise_of

   end subroutine find_curve

   !> A range; zero if all is round-off.
   pure function beyond_noise(range, noise) result(shown)
      real(wp), intent(in) :: range(2)   !! (2) minimum, maximum, SI [any]
      real(wp), intent(in) :: noise      !! less is round-off, SI [any]
      real(wp) :: shown(2)               !! (2) minimum, maximum, SI [any]

      shown = range
      if (all(abs(range) <= noise)) shown = 0.0_wp
   end function beyond_noise

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
