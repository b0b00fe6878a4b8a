!> The tables of `gudgeon fit`: unknown parameters [fit], [fit.sensor], sets of data [fit.set], and its settings [fit.study].
!>
!> A sensor with offset b and delay d shows x(t - d) + b of its channel x. The fit minimises
!> $$ F = \frac{1}{2} \sum_i \left( \frac{x(t_i - d; p) + b - m_i}{\sigma} \right)^2 $$
!> over the parameters p, b and d between their bounds; m_i are the data, sigma is the standard deviation of the noise.
module fit_info
   use kind_info, only: add_any_number, add_list, add_number, add_word, dim_none, dim_time, kind_info_t
   use kinds, only: min_tolerance, wp
   implicit none (type, external)
   private
   public :: fit_sensor_info, fit_set_info, fit_study_info, fit_table_info

contains

   !> The table of unknown parameters.
   function fit_table_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "fit"
      info%help = "unknown parameters that `gudgeon fit` finds from data; the name of a row is that of a parameter"
      info%source = "D. W. Marquardt (1963), J. SIAM 11, 431-441; G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989)"
      call add_any_number(info, "lower", "lower bound, in the unit of the parameter")
      call add_any_number(info, "upper", "upper bound")
      call add_any_number(info, "start", "where the search starts; default: the value of the deck", default="")
      call add_word(info, "each", "yes: every set of data has its own value, as for the start of its motion", default="no", &
                    choices="no yes")
   end function fit_table_info

   !> The table of sensors.
   function fit_sensor_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "fit.sensor"
      info%help = "channels that `gudgeon fit` compares with columns of the data"
      info%source = "G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989), sections 2.1 and 2.8 (weights)"
      call add_word(info, "channel", "one number of a channel, as slider.position.x")
      call add_word(info, "column", "its column of the data, as `gudgeon compare` has it: name or number, unit=, scale=, " &
                    //"offset=; default: the column with the name of the channel", default="")
      call add_any_number(info, "sigma", "standard deviation of its noise; default: that of its residuals", default="")
      call add_any_number(info, "offset", "maximum magnitude of its unknown offset, which is fitted; default: it has none", &
                          default="")
      call add_number(info, "delay", dim_time, "maximum magnitude of its unknown delay, which is fitted; 0: it has none", &
                      default="0 s", lower=0.0_wp)
   end function fit_sensor_info

   !> The table of sets of data.
   function fit_set_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "fit.set"
      info%help = "sets of data, each with a motion of its own; default: each file of the command line is a set"
      info%source = "H. G. Bock (1981), Springer Series in Chemical Physics 18, 102-125 (multiple shooting)"
      call add_number(info, "file", dim_none, "which file of the command line has the data", default="1", lower=1.0_wp, &
                      upper=1000.0_wp)
      call add_number(info, "from", dim_time, "time of the data at which the motion starts", default="0 s")
      call add_number(info, "to", dim_time, "last time of the data; default: all", default="1e30 s")
      call add_word(info, "set", "parameters of the deck that are other in this set, as ""height=50mm speed=3m/s""", default="")
   end function fit_set_info

   !> The section of settings.
   function fit_study_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "fit.study"
      info%help = "settings of `gudgeon fit`"
      info%source = "D. W. Marquardt (1963), J. SIAM 11, 431-441"
      info%is_table = .false.
      call add_number(info, "tolerance", dim_none, "tolerance of the motions; a motion at ten times of it shows which data lie " &
                      //"beyond the horizon", default="1e-9", lower=min_tolerance, upper=1.0e-5_wp)
      call add_list(info, "until", "times of the motion up to which data are fitted in turn, ascending, as ""5 10 20 ms"": a " &
                    //"search that starts far off finds its way through impacts; at last all data are fitted", default="")
      call add_number(info, "iterations", dim_none, "derivatives of a search, at most", default="50", lower=1.0_wp, upper=1.0e4_wp)
   end function fit_study_info

end module fit_info
