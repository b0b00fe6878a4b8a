!> Histories beside an animation: the curves of the deck's figures over its window, thinned for the page. Each ordinate of each
!> panel is a plot, in the unit of the figure; of a narrow one what is beyond a round value, as there.
!>
!> Of a curve with more points than the page shows, its ends and the minimum and the maximum of each of equal parts of the window
!> stay, each at its time: no peak is lost.
module page_plots
   use catalogue, only: catalogue_t
   use curve_panels, only: make_panel, panel_t
   use drawn_rows, only: drawn_rows_t
   use errors, only: error_t
   use extremes, only: extremes_t
   use figure_data, only: curve_t, find_curves
   use figure_words, only: figure_history, figure_t
   use html_text, only: doubles_in_base_64, escaped, floats_in_base_64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use row_reader, only: row_reader_t
   use text, only: join
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
      type(curve_t) :: no_ideal(0)
      type(panel_t) :: panel
      integer :: k, n, p, side

      n = 0
      n_left_out = 0
      call list%add("[")
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_history .or. figures(k)%curves%abscissa > 0) cycle
         call find_curves(figures(k), catalogue, extremes, rows, "", curves)
         do p = 1, size(figures(k)%curves%panels)
            call make_panel(figures(k), catalogue, figures(k)%curves%panels(p), curves, no_ideal, panel)
            do side = 1, 2
               if (any(panel%side == side)) call add_plot()
               if (allocated(error)) return
            end do
         end do
      end do
      call list%add("]")
      text = list%get()

   contains

      !> One ordinate of a panel.
      subroutine add_plot()
         real(wp), allocatable :: points(:, :)
         integer :: j

         if (n >= most_curves) n_left_out = n_left_out + count(panel%side == side)
         if (n >= most_curves) return
         call list%add("{title:"""//escaped(heading()//panel%beyond(side)%s, .false.)//""",unit:"""// &
                       escaped(panel%unit(side)%symbol, .false.)//""",curves:[")
         do j = 1, size(panel%curves)
            if (panel%side(j) /= side) cycle
            n = n + 1
            call read_thinned(folder, rows, panel%curves(j), window, points, error)
            if (allocated(error)) return
            call list%line("{n:"""//escaped(panel%curves(j)%name, .false.)//""",x:"""//doubles_in_base_64(points(1, :))// &
                           """,y:"""//floats_in_base_64(panel%unit(side)%factor*(points(2, :) - panel%less(side)))//"""},")
         end do
         call list%line("]},")
      end subroutine add_plot

      !> The channels of the plot: as the deck names them, or one by one where the panel has two ordinates.
      function heading() result(words)
         character(:), allocatable :: words   !! joined by `+`

         integer :: j

         if (all(panel%side == side)) then
            words = join(figures(k)%phrase%panels(p)%words, " + ")
            return
         end if
         words = ""
         do j = 1, size(panel%curves)
            if (panel%side(j) /= side) cycle
            if (len(words) > 0) words = words//" + "
            words = words//panel%curves(j)%name
         end do
      end function heading

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
      real(wp) :: ends(2, 2), low(2, n_part), high(2, n_part), point(2)
      integer :: k, n, r
      logical :: has_any

      has_any = .false.
      low(2, :) = huge(1.0_wp)
      high(2, :) = -huge(1.0_wp)
      call reader%open(folder, curve, error)
      if (allocated(error)) return
      do r = 1, rows%n
         call reader%next(point, error)
         if (allocated(error)) return
         if (any(ieee_is_nan(point)) .or. point(1) < window(1)) cycle
         if (point(1) > window(2)) exit
         if (.not. has_any) ends(:, 1) = point
         has_any = .true.
         ends(:, 2) = point
         k = 1
         if (window(2) > window(1)) k = min(n_part, 1 + int(n_part*(point(1) - window(1))/(window(2) - window(1))))
         if (point(2) < low(2, k)) low(:, k) = point
         if (point(2) > high(2, k)) high(:, k) = point
      end do
      call reader%close()
      allocate (points(2, 2*n_part + 2))
      n = 0
      do k = 1, n_part
         if (low(2, k) > high(2, k)) cycle
         if (n == 0) call append(ends(:, 1))
         call append(merge(low(:, k), high(:, k), low(1, k) <= high(1, k)))
         call append(merge(high(:, k), low(:, k), low(1, k) <= high(1, k)))
      end do
      if (n > 0) call append(ends(:, 2))
      points = points(:, :n)

   contains

      !> One more point, unless it is the last again.
      subroutine append(next)
         real(wp), intent(in) :: next(2)    !! (2) time and value [s, any]

         if (n > 0) then
            if (all(abs(points(:, n) - next) <= 0.0_wp)) return
         end if
         n = n + 1
         points(:, n) = next
      end subroutine append

   end subroutine read_thinned

end module page_plots
