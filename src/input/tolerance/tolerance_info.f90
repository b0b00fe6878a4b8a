!> The tables of `gudgeon tolerance`: [tolerance], [tolerance.joint], [tolerance.limit], and its settings [tolerance.study].
!>
!> A row of [tolerance] is a parameter of the deck and how its values scatter over the parts that are made. T is half the width of
!> the tolerance, between the limits nominal - T and nominal + T, and
!> $$ C_p = \frac{T}{3 \sigma} $$
!> of normal distributions. A `fit` as H7/f7 gives the limits of a radial clearance by the `diameter`; H7 or f7 alone those of a
!> diameter. Measured values scatter as they were counted. Parameters of one batch deviate together.
module tolerance_info
   use kind_info, only: add_any_number, add_file, add_list, add_number, add_word, add_words, dim_length, dim_none, dim_time, &
                        kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: tolerance_joint_info, tolerance_limit_info, tolerance_study_info, tolerance_table_info

contains

   !> The table of toleranced parameters.
   function tolerance_table_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "tolerance"
      info%help = "tolerances of parameters, for `gudgeon tolerance`; the name of a row is that of a parameter"
      info%source = "ISO 286-1:2010 (fits); N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate Distributions (1994)"
      call add_any_number(info, "plus_minus", "half the width of the tolerance, in the unit of the parameter; with a fit: none", &
                          default="")
      call add_word(info, "distribution", "distribution of the parameter: normal without limits, normal truncated at the limits, " &
                    //"uniform or triangular between them, lognormal, one of both limits, or measured values", &
                    default="truncated", choices="normal truncated uniform triangular lognormal two_point measured")
      call add_number(info, "cp", dim_none, "process capability Cp: half the width over three standard deviations, of normal, " &
                      //"truncated and lognormal", default="1", lower=0.0_wp, open_lower=.true.)
      call add_any_number(info, "shift", "mean of the process less the middle of the tolerance, of normal, truncated and " &
                          //"lognormal; default: 0", default="")
      call add_word(info, "fit", "ISO 286 fit of hole and shaft, as H7/f7: the parameter is their radial clearance; or one " &
                    //"tolerance class, as H7: it is the diameter", default="")
      call add_number(info, "diameter", dim_length, "nominal diameter of the fit", default="0 m", lower=0.0_wp)
      call add_list(info, "value", "values of the parameter that were measured, of distribution = measured", default="")
      call add_list(info, "count", "parts that have each of these values; default: 1 each", default="")
      call add_file(info, "file", "two-column file of value and count, relative to the deck, with names and units in the first " &
                    //"line; instead of value and count", default="")
      call add_word(info, "batch", "name of a batch: parameters that name the same one deviate together", default="")
      call add_number(info, "correlation", dim_none, "part of the variance that the batch has, of normal deviations; of two " &
                      //"parameters with the same part it is their correlation; default: 1", default="", lower=0.0_wp, &
                      upper=1.0_wp)
      call add_number(info, "cost", dim_none, "cost of the part with this tolerance, without what is the same with any: it goes " &
                      //"with one over the width; of some rows: the cheapest tolerances for `target` are stated", default="0", &
                      lower=0.0_wp)
   end function tolerance_table_info

   !> The table of joints with clearance.
   function tolerance_joint_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "tolerance.joint"
      info%help = "position of the pin in revolute joints with clearance, for `gudgeon tolerance`; the name of a row is that of " &
                  //"a joint"
      info%source = "S. W. E. Earles, C. L. S. Wu (1972), IMechE C107/72 (clearance as a massless link)"
      call add_word(info, "pin", "position of the pin: uniform in the circle of the clearance; uniform on it; on it where the " &
                    //"force of the ideal joint presses it; or on it where it is worst for each request", default="disc", &
                    choices="disc circle force worst")
   end function tolerance_joint_info

   !> The table of limits.
   function tolerance_limit_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "tolerance.limit"
      info%help = "limits of a channel, for the yield of `gudgeon tolerance`"
      info%source = ""
      call add_word(info, "channel", "one number of a channel, as slider.position.x or request.NAME; of the dynamic level " &
                    //"a number of a run, as slider.acceleration.x.rms")
      call add_any_number(info, "lower", "lower limit, of the kinematic level at all output times; default: none", default="")
      call add_any_number(info, "upper", "upper limit, likewise; default: none", default="")
   end function tolerance_limit_info

   !> The section of settings.
   function tolerance_study_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "tolerance.study"
      info%help = "settings of `gudgeon tolerance`"
      info%source = "A. Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270; M. J. W. Jansen (1999), Comput. Phys. " &
                    //"Commun. 117, 35-43; J. K. Salmon et al. (2011), SC11 (random numbers)"
      info%is_table = .false.
      call add_word(info, "level", "kinematic: positions by [analysis.kinematic]; dynamic: each member is a run of " &
                    //"[analysis.dynamic]; auto: kinematic if the deck has [analysis.kinematic]", default="auto", &
                    choices="auto kinematic dynamic")
      call add_words(info, "requests", "what is studied, with [tolerance.limit]; kinematic: channels, default those of the " &
                     //"tables of requests; dynamic: numbers of a run, as CHANNEL.rms, or .mean .peak .min .max .final, " &
                     //"or JOINT.impacts", default="")
      call add_number(info, "members", dim_none, "mechanisms that are sampled; 0: 10000, of the dynamic level 200", default="0", &
                      lower=0.0_wp, upper=1.0e8_wp)
      call add_word(info, "plan", "sampling: independent members, or a Latin hypercube or a Sobol' sequence, whose means scatter " &
                    //"less than their intervals state", default="monte_carlo", choices="monte_carlo latin_hypercube sobol")
      call add_number(info, "seed", dim_none, "seed of the random numbers, which depend only on it and the number of the member", &
                      default="1", lower=0.0_wp, upper=2.0e9_wp)
      call add_word(info, "method", "members by the expansion of second order, by assembling each, or auto: by the expansion " &
                    //"if its error in checked members is below `accuracy`", default="auto", choices="auto expansion exact")
      call add_number(info, "accuracy", dim_none, "accepted error of the expansion, of the standard deviation of each request", &
                      default="0.01", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "budget", dim_time, "processor time that `method = auto` may take to assemble all members; more: " &
                      //"the expansion is taken, with a warning", default="60 s", lower=0.0_wp)
      call add_number(info, "checked", dim_none, "members that are assembled to find the error of the expansion", default="100", &
                      lower=1.0_wp, upper=1.0e6_wp)
      call add_word(info, "indices", "Sobol' indices: by members of a plan of their own, or, of the dynamic level, by a " &
                    //"polynomial through the members, without further runs", default="plan", choices="plan polynomial")
      call add_number(info, "points", dim_none, "points of the plan of Sobol' indices; it has points*(contributors + 2) " &
                      //"members; 0: 1000, of the dynamic level 50", default="0", lower=0.0_wp, upper=1.0e5_wp)
      call add_number(info, "resamples", dim_none, "bootstrap resamples for the intervals of the indices", default="200", &
                      lower=20.0_wp, upper=1.0e4_wp)
      call add_number(info, "bins", dim_none, "bins of the histograms", default="30", lower=2.0_wp, upper=10000.0_wp)
      call add_number(info, "rare", dim_none, "members of importance sampling for each channel with limits, of the kinematic " &
                      //"level: failures of parts per million; 0: none", default="0", lower=0.0_wp, upper=1.0e8_wp)
      call add_number(info, "target", dim_none, "yield that the cheapest tolerances reach, with `cost` in [tolerance]", &
                      default="0.9973", lower=0.0_wp, upper=1.0_wp, open_lower=.true., open_upper=.true.)
   end function tolerance_study_info

end module tolerance_info
