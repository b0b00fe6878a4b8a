!> The curves of figures: file and columns for gnuplot, their numbers, and how far they reach.
module figure_data
   use catalogue, only: catalogue_t
   use channel_names, only: item_name, scalar_name, scalar_t
   use drawn_rows, only: drawn_rows_t
   use extremes, only: extremes_t
   use figure_words, only: figure_portrait, figure_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
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
      integer :: series(2) = -1            !! columns of both coordinates in the rows of the run; -1: none
      character(:), allocatable :: x_label !! what stands over the column of the abscissa
      character(:), allocatable :: y_label !! over that of the ordinate
      real(wp) :: x_range(2) = 0.0_wp      !! (2) minimum and maximum abscissa, SI [any]
      real(wp) :: y_range(2) = 0.0_wp      !! (2) minimum and maximum ordinate, SI [any]
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
         if (all(curve%series >= 0)) curves = [curves, curve]
      end do
   end subroutine find_curves

   !> One curve; it has no series if one of its columns is not there or holds no numbers.
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
      call look_at(rows%x(:rows%n, x), noise_of(over), curve%x_range, falls=curve%falls)
      call look_at(rows%x(:rows%n, y), noise_of(scalar), curve%y_range, turns=curve%turns)
      if (curve%x_range(1) <= curve%x_range(2) .and. curve%y_range(1) <= curve%y_range(2)) curve%series = [x, y]

   contains

      !> The file of an item.
      function file_of(one) result(file)
         type(scalar_t), intent(in) :: one      !! one of its numbers
         character(:), allocatable :: file      !! within the run's directory

         file = file_of_item(item_name(catalogue, catalogue%groups(one%group)%room, one%item), suffix)
      end function file_of

      !> What is round-off in a number.
      pure real(wp) function noise_of(one)
         type(scalar_t), intent(in), optional :: one   !! the number; absent: time

         noise_of = 0.0_wp
         if (present(one)) noise_of = extremes%noise_in(catalogue%groups(one%group)%channel%unit)
      end function noise_of

   end subroutine find_curve

   !> How far a column reaches, and how often it turns and falls; the range is zero if all is round-off.
   pure subroutine look_at(x, noise, range, turns, falls)
      real(wp), intent(in) :: x(:)             !! (n) the column, SI [any]
      real(wp), intent(in) :: noise            !! less is round-off, SI [any]
      real(wp), intent(out) :: range(2)        !! (2) minimum, maximum; of a column without numbers reversed, SI [any]
      integer, intent(out), optional :: turns  !! from rising to falling, or back
      integer, intent(out), optional :: falls  !! from one number to the next

      real(wp) :: before
      integer :: k, n_fall, n_turn, way

      range = [huge(1.0_wp), -huge(1.0_wp)]
      before = huge(1.0_wp)  ! nothing came before
      n_turn = 0
      n_fall = 0
      way = 0
      do k = 1, size(x)
         if (ieee_is_nan(x(k))) cycle
         if (before < huge(1.0_wp)) then
            if ((x(k) - before)*way < 0.0_wp) n_turn = n_turn + 1
            if (x(k) < before) n_fall = n_fall + 1
            if (x(k) < before .or. x(k) > before) way = merge(-1, 1, x(k) < before)
         end if
         range = [min(range(1), x(k)), max(range(2), x(k))]
         before = x(k)
      end do
      if (present(turns)) turns = n_turn
      if (present(falls)) falls = n_fall
      if (all(abs(range) <= noise)) range = 0.0_wp
   end subroutine look_at

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
