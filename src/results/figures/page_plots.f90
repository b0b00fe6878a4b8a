!> Histories beside an animation: the curves of the deck's figures over its window, thinned for the page.
!>
!> Of a curve with more points than the page shows, the minimum and the maximum of each of equal parts of the window stay, each at
!> its time: no peak is lost.
module page_plots
   use catalogue, only: catalogue_t
   use display_units, only: choose_unit, display_unit_t
   use drawn_rows, only: drawn_rows_t
   use errors, only: error_t
   use extremes, only: extremes_t
   use figure_data, only: curve_t, find_curves, is_visible
   use figure_words, only: figure_history, figure_t
   use html_text, only: doubles_in_base_64, escaped, floats_in_base_64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use row_reader, only: row_reader_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: plots_text

   integer, parameter :: n_part = 300      !! parts of the window, two points each at most
   integer, parameter :: most_curves = 60  !! of a page

contains

   !> The plots as a list of objects of JavaScript: heading, unit, and of each curve its name, times and values.
   subroutine plots_text(folder, figures, catalogue, extremes, rows, window, text, n_left_out, error)
      character(*), intent(in) :: folder                    !! of the figures
      type(figure_t), intent(in) :: figures(:)              !! (n) figures of the run
      type(catalogue_t), intent(in) :: catalogue            !! what was recorded
      type(extremes_t), intent(in) :: extremes              !! what is round-off
      type(drawn_rows_t), intent(in) :: rows                !! numbers of curves
      real(wp), intent(in) :: window(2)                     !! (2) times of the animation [s]
      character(:), allocatable, intent(out) :: text        !! `[{title:...},...]`
      integer, intent(out) :: n_left_out                    !! curves beyond those that a page has
      type(error_t), allocatable, intent(out) :: error      !! the rows cannot be read

      type(buffer_t) :: list
      type(curve_t), allocatable :: curves(:)
      logical, allocatable :: is_left(:), is_mine(:)
      character(:), allocatable :: si
      integer :: i, k, n

      n = 0
      n_left_out = 0
      call list%add("[")
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_history .or. figures(k)%curves%abscissa > 0) cycle
         call find_curves(figures(k), catalogue, extremes, rows, "", curves)
         is_left = [(.true., i=1, size(curves))]
         do while (any(is_left))
            si = unit_of(curves(findloc(is_left, .true., dim=1)))
            is_mine = is_left .and. [(unit_of(curves(i)) == si, i=1, size(curves))]
            is_left = is_left .and. .not. is_mine
            call add_plot(pack(curves, is_mine), pack([(figures(k)%curves%is_exact(curves(i)%number), i=1, size(curves))], is_mine))
            if (allocated(error)) return
         end do
      end do
      call list%add("]")
      text = list%get()

   contains

      !> The SI unit of a curve.
      pure function unit_of(curve) result(si)
         type(curve_t), intent(in) :: curve    !! the curve
         character(:), allocatable :: si       !! as in files

         si = catalogue%groups(figures(k)%scalars(curve%number)%group)%channel%unit
      end function unit_of

      !> The curves of a figure that have one unit; components too small to be seen are omitted, unless they were named one by one.
      subroutine add_plot(mine, is_exact)
         type(curve_t), intent(in) :: mine(:)      !! (any) the curves
         logical, intent(in) :: is_exact(:)        !! (any) whether they were named

         type(display_unit_t) :: unit
         real(wp), allocatable :: points(:, :)
         logical :: is_shown(size(mine))
         real(wp) :: extent
         integer :: j

         is_shown = is_visible(mine) .or. is_exact
         if (n >= most_curves) n_left_out = n_left_out + count(is_shown)
         if (n >= most_curves) return
         extent = 0.0_wp
         do j = 1, size(mine)
            if (is_shown(j)) extent = max(extent, maxval(abs(mine(j)%y_range)))
         end do
         unit = choose_unit(si, extent)
         call list%add("{title:"""//escaped(figures(k)%word, .false.)//""",unit:"""//escaped(unit%symbol, .false.)//""",curves:[")
         do j = 1, size(mine)
            if (.not. is_shown(j)) cycle
            n = n + 1
            call read_thinned(folder, rows, mine(j), window, points, error)
            if (allocated(error)) return
            call list%line("{n:"""//escaped(mine(j)%name, .false.)//""",x:"""//doubles_in_base_64(points(1, :))//""",y:"""// &
                           floats_in_base_64(unit%factor*points(2, :))//"""},")
         end do
         call list%line("]},")
      end subroutine add_plot

   end subroutine plots_text

   !> The points of a curve over a window, thinned.
   subroutine read_thinned(folder, rows, curve, window, points, error)
      character(*), intent(in) :: folder                    !! of the figures
      type(drawn_rows_t), intent(in) :: rows                !! of the run
      type(curve_t), intent(in) :: curve                    !! the curve
      real(wp), intent(in) :: window(2)                     !! (2) ends of its abscissa [s]
      real(wp), allocatable, intent(out) :: points(:, :)    !! (2, any) times and values, in order, SI [any]
      type(error_t), allocatable, intent(out) :: error      !! the rows cannot be read

      type(row_reader_t) :: reader
      real(wp) :: low(2, n_part), high(2, n_part), point(2)
      integer :: k, n, r

      low(2, :) = huge(1.0_wp)
      high(2, :) = -huge(1.0_wp)
      call reader%open(folder, curve, error)
      if (allocated(error)) return
      do r = 1, rows%n
         call reader%next(point, error)
         if (allocated(error)) return
         if (any(ieee_is_nan(point)) .or. point(1) < window(1)) cycle
         if (point(1) > window(2)) exit
         k = 1
         if (window(2) > window(1)) k = min(n_part, 1 + int(n_part*(point(1) - window(1))/(window(2) - window(1))))
         if (point(2) < low(2, k)) low(:, k) = point
         if (point(2) > high(2, k)) high(:, k) = point
      end do
      call reader%close()
      allocate (points(2, 2*n_part))
      n = 0
      do k = 1, n_part
         if (low(2, k) > high(2, k)) cycle
         n = n + 1
         points(:, n) = merge(low(:, k), high(:, k), low(1, k) <= high(1, k))
         if (abs(high(1, k) - low(1, k)) <= 0.0_wp) cycle
         n = n + 1
         points(:, n) = merge(high(:, k), low(:, k), low(1, k) <= high(1, k))
      end do
      points = points(:, :n)
   end subroutine read_thinned

end module page_plots
