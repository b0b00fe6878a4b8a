!> The figure of a split variance: a bar for each number of a run, between parts below, within the motion above, and the interval
!> of their border. `tolerance_variance.dat`: name in quotes, share between parts, share within, interval of the first.
module variance_plot
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: to_text
   use text_buffer, only: buffer_t
   use text_table, only: number_row
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: variance_rows, variance_script

contains

   !> Shares of the variance; numbers that do not scatter have none.
   function variance_rows(study) result(text)
      type(tolerance_study_t), intent(in) :: study   !! the study, its variances split
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      integer :: r

      call lines%line("# number of a run, share between parts, share within the motion, interval of 95 % of the first")
      do r = 1, size(study%splits)
         associate (share => study%splits(r)%share)
            if (ieee_is_finite(share(1))) then
               call lines%line(""""//study%requests(r)%name//""" "//number_row([1.0_wp - share(1), share(1), 1.0_wp - share(3), &
                                                                               1.0_wp - share(2)]))
            end if
         end associate
      end do
      text = lines%get()
   end function variance_rows

   !> Stacked bars.
   function variance_script(study, title) result(script)
      type(tolerance_study_t), intent(in) :: study   !! the study, its variances split
      character(*), intent(in) :: title              !! of the scene, any text
      character(:), allocatable :: script            !! lines for gnuplot

      character(*), parameter :: file = "'tolerance_variance.dat'"
      type(buffer_t) :: lines

      call preamble(lines, "tolerance_variance", 1200, 600)
      call lines%line("set title "//quoted(title))
      call lines%line("set style data histograms; set style histogram rowstacked; set style fill solid 0.9 noborder")
      call lines%line("set boxwidth 0.6; set yrange [0:1]; set key outside right top vertical Left reverse")
      call lines%line("set ylabel 'share of the variance'; set xrange [-0.7:"// &
                      to_text(size(study%splits))//"-0.3]")
      call lines%line("plot "//file//" using 2:xtic(1) linecolor rgb '"//colours(1)//"' title 'between parts', \")
      call lines%line("     "//file//" using 3 linecolor rgb '"//colours(2)//"' title 'within the motion', \")
      call lines%line("     "//file//" using 0:2:4:5 with yerrorbars pointtype 7 pointsize 0.5 linewidth 2 "// &
                      "linecolor rgb 'black' title '95 %'")
      call lines%line("unset output")
      script = lines%get()
   end function variance_script

end module variance_plot
