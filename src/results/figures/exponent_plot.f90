!> The figure of the largest Lyapunov exponent: growth of a small change by both methods, and the exponent as it settles.
module exponent_plot
   use batch_means, only: estimate_t
   use display_units, only: choose_unit, display_unit_t
   use exponent, only: horizon_t
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use plot_text, only: quoted
   use precision_rows, only: number
   use script_parts, only: colours, preamble
   use text, only: segment, real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: exponent_rows, exponent_script, has_exponent

contains

   !> Whether there is anything to draw.
   pure logical function has_exponent(horizon)
      type(horizon_t), intent(in) :: horizon   !! what is known

      has_exponent = .false.
      if (allocated(horizon%t)) has_exponent = horizon%tangent%reason == "" .or. horizon%twin%reason == ""
   end function has_exponent

   !> Growth over time, and the mean rate from the end of the transient on.
   function exponent_rows(horizon) result(text)
      type(horizon_t), intent(in) :: horizon   !! what is known
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      real(wp) :: rate(size(horizon%t), 2)
      integer :: i

      call lines%line("# time [s], ln of growth: tangent, neighbouring trajectory; running mean rate [1/s]: the same two")
      rate = mean_rates(horizon)
      do i = 1, size(horizon%t)
         call lines%line(number(horizon%t(i))//" "//number(horizon%tangent%growth(i))//" "//number(horizon%twin%growth(i))//" "// &
                         number(rate(i, 1))//" "//number(rate(i, 2)))
      end do
      text = lines%get()
   end function exponent_rows

   !> Mean rates from the end of the transient to each instant, by the tangent and by a reference run; NaN up to that end.
   pure function mean_rates(horizon) result(rate)
      type(horizon_t), intent(in) :: horizon   !! what is known
      real(wp) :: rate(size(horizon%t), 2)     !! (instants, 2) the rates [s^-1]

      integer :: first, i

      first = max(1, count(horizon%t <= horizon%after*(1.0_wp + 1.0e-9_wp)))
      rate(:first, :) = not_a_number()
      do i = first + 1, size(horizon%t)
         rate(i, 1) = (horizon%tangent%growth(i) - horizon%tangent%growth(first))/(horizon%t(i) - horizon%t(first))
         rate(i, 2) = (horizon%twin%growth(i) - horizon%twin%growth(first))/(horizon%t(i) - horizon%t(first))
      end do
   end function mean_rates

   !> Two panels: the growth, and the exponent with its interval.
   function exponent_script(horizon, title) result(script)
      type(horizon_t), intent(in) :: horizon   !! what is known
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: time
      real(wp) :: end

      end = horizon%t(size(horizon%t))
      time = choose_unit("s", end)
      call preamble(lines, "exponent", 1200, 1000)
      call lines%line("f = "//real_text(time%factor, 9))
      call lines%line("set multiplot layout 2,1 title "//quoted(title)//" font ',17'")
      call lines%line("set xrange [0:"//number(end*time%factor)//"]; set datafile missing 'NaN'")
      call lines%line("set key noautotitle inside bottom right vertical Left reverse samplen 2 spacing 1.2 opaque")
      call lines%line("set xlabel "//quoted("time ["//time%symbol//"]"))
      call lines%line("set ylabel 'growth of an initial perturbation [1]'")
      call lines%line("set format y '1e%+.0f'; e = log(10.)")
      call add_tics(lines, horizon)
      call add_digits(lines, horizon, time)
      call lines%line("set offsets 0, 0, graph 0.03, graph 0.03")
      call lines%line("plot "//curve("($1*f)", "($2/e)", 1, "tangent equations, jumps at "//to_text(horizon%n_crossed)// &
                                     " events", "linewidth 2")//", \")
      call lines%line("     "//curve("($1*f)", "($3/e)", 2, "neighbouring trajectory, rescaled "//to_text(horizon%n_renewed)// &
         " times", &
                                     "linewidth 1.5 dashtype 2"))
      call lines%line("unset offsets; unset arrow; unset label; unset x2tics")
      call lines%line("set format y '%g'; set ytics autofreq; set key top right")
      call lines%line("set ylabel 'running mean of the exponent, without the transient [1/s]'")
      call lines%line("set xrange ["//number(horizon%after*time%factor)//":"//number(end*time%factor)//"]")
      call add_interval(lines, horizon)
      call lines%line("plot 0 with lines linewidth 1 linecolor rgb '#404040', \")
      call lines%line("     "//curve("($1*f)", "4", 1, "tangent: "//words_of(horizon%tangent%rate), "linewidth 2")//", \")
      call lines%line("     "//curve("($1*f)", "5", 2, "neighbour: "//words_of(horizon%twin%rate), "linewidth 1.5 dashtype 2"))
      call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function exponent_script

   !> Tics of the growth, whose logarithm is drawn since it may be greater than any number: whole decades, of few of them 1, 2 and 5
   !> too.
   subroutine add_tics(lines, horizon)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(horizon_t), intent(in) :: horizon    !! what is known

      integer, parameter :: few = 3                                 ! decades that have tics between
      integer, parameter :: most = 8                                ! tics
      integer, parameter :: between(3) = [1, 2, 5]                  ! parts of a decade [1]
      character(:), allocatable :: tics
      real(wp) :: high, low
      integer :: decade, k

      associate (growth => [horizon%tangent%growth, horizon%twin%growth]/log(10.0_wp))
         low = minval(growth, mask=ieee_is_finite(growth))
         high = maxval(growth, mask=ieee_is_finite(growth))
      end associate
      if (high - low > real(few, wp)) then
         call lines%line("set ytics "//to_text(1 + int((high - low)/real(most, wp))))
         return
      end if
      tics = ""
      do decade = floor(low), ceiling(high)
         do k = 1, size(between)
            tics = tics//", '"//real_text(real(between(k), wp)*10.0_wp**decade, 2)//"' "// &
                   number(real(decade, wp) + log10(real(between(k), wp)))
         end do
      end do
      call lines%line("set ytics ("//segment(tics, 3)//")")
   end subroutine add_tics

   !> Marks of the times up to which there are digits: a line each, and above the panel their numbers, beside one another.
   subroutine add_digits(lines, horizon, time)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(horizon_t), intent(in) :: horizon    !! what is known
      type(display_unit_t), intent(in) :: time  !! unit of the abscissa

      real(wp), parameter :: apart = 0.026_wp   ! numbers, of the width [1]
      character(:), allocatable :: at, tics
      real(wp) :: last, place(n_digit), wide
      integer :: k, latest

      latest = findloc(ieee_is_finite(horizon%digits), .true., dim=1)  ! the fewer digits, the later
      if (latest == 0) return
      wide = horizon%t(size(horizon%t))
      last = -wide
      do k = n_digit, latest, -1
         if (.not. ieee_is_finite(horizon%digits(k))) cycle
         place(k) = max(horizon%digits(k), last + apart*wide)
         last = place(k)
      end do
      last = (1.0_wp + apart)*wide
      tics = ""
      do k = latest, n_digit
         if (.not. ieee_is_finite(horizon%digits(k))) cycle
         place(k) = min(place(k), last - apart*wide)
         last = place(k)
         at = number(horizon%digits(k)*time%factor)
         call lines%line("set arrow from first "//at//", graph 0 to first "//at//", graph 1 nohead dashtype 2 linecolor "// &
                         "rgb '#909090'")
         tics = tics//", '"//to_text(k)//"' "//number(place(k)*time%factor)
      end do
      call lines%line("set label 'digits' at first "//number((last - 0.6_wp*apart*wide)*time%factor)// &
                      ", graph 1 right offset 0,0.6 font ',12' textcolor rgb '#606060'")
      call lines%line("set x2range [0:"//number(wide*time%factor)//"]")
      call lines%line("set x2tics ("//segment(tics, 3)//") scale 0 offset 0,-0.4 font ',12' textcolor rgb '#606060'")
   end subroutine add_digits

   !> The interval of the exponent, and the range around it, which holds the curves but for what is far away after the transient.
   subroutine add_interval(lines, horizon)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(horizon_t), intent(in) :: horizon    !! what is known

      real(wp), parameter :: most = 4.0_wp      ! of the range that the interval has about it [1]
      real(wp), parameter :: room = 0.06_wp     ! above and below the curves, of their range [1]
      type(estimate_t) :: rate
      real(wp) :: high, low, means(size(horizon%t), 2), reach

      rate = horizon%tangent%rate
      if (horizon%tangent%reason /= "") rate = horizon%twin%rate
      reach = max(5.0_wp*rate%half, 1.2_wp*abs(rate%value), tiny(1.0_wp))
      means = mean_rates(horizon)
      low = max(minval(means, mask=ieee_is_finite(means)), rate%value - most*reach)
      high = min(maxval(means, mask=ieee_is_finite(means)), rate%value + most*reach)
      low = min(low, rate%value - reach)
      high = max(high, rate%value + reach)
      call lines%line("set yrange ["//number(low - room*(high - low))//":"//number(high + room*(high - low))//"]")
      call lines%line("set object 1 rectangle from graph 0, first "//number(rate%value - rate%half)//" to graph 1, first "// &
                      number(rate%value + rate%half)//" behind fillcolor rgb '#e4ecf4' fillstyle solid noborder")
   end subroutine add_interval

   !> A curve of the numbers.
   function curve(x, y, colour, title, style) result(words)
      character(*), intent(in) :: x            !! abscissa
      character(*), intent(in) :: y            !! ordinate
      integer, intent(in) :: colour            !! number of the colour
      character(*), intent(in) :: title        !! in the legend
      character(*), intent(in) :: style        !! of the line
      character(:), allocatable :: words       !! part of `plot`

      words = "'exponent.dat' using "//x//":"//y//" with lines "//style//" linecolor rgb '"//colours(colour)//"' title "// &
              quoted(title)
   end function curve

   !> An exponent with its interval.
   function words_of(rate) result(words)
      type(estimate_t), intent(in) :: rate     !! the exponent [s^-1]
      character(:), allocatable :: words       !! one line

      words = "unknown"
      if (ieee_is_finite(rate%half)) words = real_text(rate%value, 4)//" +-"//real_text(rate%half, 2)//" 1/s"
   end function words_of

end module exponent_plot
