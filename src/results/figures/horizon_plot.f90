!> The figure of neighbouring trajectory runs: their distance over time, the law of its growth, the times up to which there are
!> digits.
module horizon_plot
   use display_units, only: choose_unit, display_unit_t
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use plot_text, only: quoted
   use precision_results, only: precision_t
   use precision_rows, only: min_error, number
   use script_parts, only: colours, preamble
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: horizon_rows, horizon_script

   integer, parameter :: most_digits = 9   !! digits whose horizons are marked

contains

   !> The distances of neighbouring trajectories over time.
   function horizon_rows(study) result(text)
      type(precision_t), intent(in) :: study   !! results
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      integer :: i, k

      call lines%line("# time [s], distance relative to the initial distance, one column per neighbouring trajectory")
      do i = 1, size(study%growth%t)
         call lines%add(number(study%growth%t(i)))
         do k = 1, size(study%growth%ratio, 2)
            call lines%add(" "//number(max(study%growth%ratio(i, k), min_error)))
         end do
         call lines%line("")
      end do
      text = lines%get()
   end function horizon_rows

   !> The distance of neighbouring trajectories over time with its law and the horizons.
   function horizon_script(study, title) result(script)
      type(precision_t), intent(in) :: study   !! results
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: time
      character(:), allocatable :: at, law
      integer :: k

      associate (growth => study%growth)
         time = choose_unit("s", study%end)
         call preamble(lines, "horizon", 1200, 800)
         call lines%line("set key noautotitle inside top left vertical Left reverse samplen 2 spacing 1.2 opaque")
         call lines%line("set title "//quoted(title)//" font ',17'")
         call lines%line("set xlabel "//quoted("time ["//time%symbol//"]"))
         call lines%line("set ylabel 'relative distance of neighbouring trajectories'")
         call lines%line("set logscale y; set format y '%.0e'; f = "//real_text(time%factor, 9))
         do k = 1, min(n_digit, most_digits)
            if (.not. ieee_is_finite(growth%horizon(k))) cycle
            at = number(growth%horizon(k)*time%factor)
            call lines%line("set arrow from first "//at//", graph 0 to first "//at//", graph 1 nohead dashtype 2 linecolor "// &
                            "rgb '#909090'")
            call lines%line("set label '"//to_text(k)//trim(merge(" digit ", " digits", k == 1))//"' at first "//at// &
                            ", graph 0.02 left rotate by 90 offset -0.7,0 font ',12' textcolor rgb '#606060'")
         end do
         if (growth%is_exponential) then
            law = "exp("//number(growth%offset)//"+"//number(growth%rate)//"*x/f)"
            call lines%line("law(x) = "//law)
            law = "exp("//real_text(growth%rate, 4)//" t/s)"
         else
            call lines%line("law(x) = exp("//number(growth%offset)//")*(x/f)**"//number(growth%power))
            law = "t^"//real_text(growth%power, 2)//": no exponential growth"
         end if
         call lines%line("set xrange [0:"//number(study%end*time%factor)//"]")
         do k = 1, size(growth%ratio, 2)
            call lines%line(merge("plot ", "     ", k == 1)//"'horizon.dat' using ($1*f):"//to_text(k + 1)// &
                            " with lines linewidth 1.5 linecolor rgb '"//colours(k)//"' title 'trajectory "//to_text(k)//"', \")
         end do
         call lines%line("     [x="//number(growth%fit_begin*time%factor)//":"//number(growth%fit_end*time%factor)//"] law(x) "// &
                         "with lines linewidth 3 dashtype 2 linecolor rgb '#000000' title "//quoted(law))
      end associate
      call lines%line("unset output")
      script = lines%get()
   end function horizon_script

end module horizon_plot
