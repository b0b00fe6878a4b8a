!> The sections that ask for statistics and for many runs: [statistics], [ensemble], [sweep], [life].
module study_info
   use kind_info, only: add_condition, add_duration, add_file, add_number, add_word, add_words, dim_length, dim_none, dim_speed, &
      dim_time, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ensemble_info, life_info, statistics_info, sweep_info

contains

   !> The section [statistics].
   function statistics_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "statistics"
      info%help = "statistics after the transient: means, peaks, contact fractions, impacts, Poincare sections, spectra"
      info%source = "F. J. Harris (1978), Proc. IEEE 66, 51-83 (the window of the spectra)"
      info%is_table = .false.
      call add_duration(info, "after", "end of the transient, a time or `N turns of DRIVER`", default="0 s")
      call add_duration(info, "period", "drive period, for Poincare sampling and impacts per period: a time " &
                        //"or `N turns of DRIVER`; none: neither", default="")
      call add_words(info, "channels", "channels for mean, RMS, peak, minimum and maximum over the output " &
                     //"times, and for Poincare sampling once per period", default="")
      call add_words(info, "spectra", "channels for amplitude spectra over the output times (Hann window)", default="")
      call add_number(info, "bins", dim_none, "bins of the histograms of impact speed and peak force", default="20", lower=2.0_wp, &
                      upper=10000.0_wp)
   end function statistics_info

   !> The section [ensemble].
   function ensemble_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "ensemble"
      info%help = "runs of `gudgeon sweep` from perturbed initial states, made consistent"
      info%source = ""
      info%is_table = .false.
      call add_number(info, "runs", dim_none, "number of runs per case", lower=1.0_wp, upper=100000.0_wp)
      call add_number(info, "seed", dim_none, "seed of the random numbers, which depend only on it and the number of the run", &
                      default="1", lower=0.0_wp, upper=2.0e9_wp)
      call add_number(info, "position", dim_length, "maximum initial displacement of a body in each coordinate; for its " &
                      //"angle: of a point at the radius of gyration", default="1e-9 m", lower=0.0_wp)
      call add_number(info, "velocity", dim_speed, "maximum change of the initial velocity of a body, likewise", &
                      default="1e-6 m/s", lower=0.0_wp)
   end function ensemble_info

   !> The section [life].
   function life_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "life"
      info%help = "wear over many cycles by `gudgeon life`: simulated cycles and jumps in between; it ends where the first of " &
                  //"its limits is reached"
      info%source = "E. Hairer, S. P. Norsett, G. Wanner (1993), section III.5 (variable steps, Adams' formulas)"
      info%is_table = .false.
      call add_duration(info, "cycle", "period of the motion, a time or `N turns of DRIVER`")
      call add_number(info, "settle", dim_none, "cycles from the start of each simulation whose wear is omitted, a whole number", &
                      default="1", lower=0.0_wp, upper=1.0e6_wp)
      call add_number(info, "measure", dim_none, "cycles after these whose mean wear is extrapolated, a whole number", &
                      default="1", lower=1.0_wp, upper=1.0e6_wp)
      call add_number(info, "cycles", dim_none, "limit: number of cycles; 0: none", default="0", lower=0.0_wp, upper=1.0e15_wp)
      call add_number(info, "time", dim_time, "limit: time; 0 s: none", default="0 s", lower=0.0_wp)
      call add_number(info, "depth", dim_length, "limit: maximum worn depth of any surface; 0 m: none", default="0 m", lower=0.0_wp)
      call add_number(info, "clearance", dim_length, "limit: clearance of any worn joint, the new one and the maximum depths of " &
                      //"both surfaces; 0 m: none", default="0 m", lower=0.0_wp)
      call add_condition(info, "stop", "limit: an extreme of a channel in the measured cycles, as `crank.force > 500 N`; " &
                         //"several joined by or")
      call add_number(info, "tolerance", dim_none, "error of a jump relative to the depth that it adds, so that the depth at the " &
                      //"end has about this relative error", default="2e-4", lower=1.0e-8_wp, upper=0.1_wp)
      call add_number(info, "depth_tolerance", dim_length, "error of the depth that is accepted in any case", default="1e-9 m", &
                      lower=1.0e-15_wp)
      call add_number(info, "simulations", dim_none, "maximum number of profiles that are simulated", default="10000", &
                      lower=2.0_wp, upper=1.0e6_wp)
   end function life_info

   !> The section [sweep]. Its other keys are parameters of the deck with the values that they take.
   function sweep_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "sweep"
      info%help = "cases of `gudgeon sweep`; every other key is a parameter with its values: `c = 0.5 0.2 0.1 mm`, " &
                  //"`speed = 1000 .. 5000 rpm in 9`, `c = 0.01mm .. 1mm in 5 geometric`, `law = hertz goldsmith`"
      info%source = ""
      info%is_table = .false.
      call add_word(info, "combine", "grid: all combinations, the last parameter varies fastest; paired: all first values, " &
                    //"then all second values, and so on", default="grid", choices="grid paired")
      call add_word(info, "keep", "content of sweep.h5 for each run: statistics, or channels too", default="numbers", &
                    choices="numbers channels")
      call add_file(info, "file", "table of cases: the first line names the parameters as `c[mm], speed[rpm], law`, each "// &
         "further line " &
                    //"is a case; separate cells by commas, semicolons, tabs or blanks", default="")
   end function sweep_info

end module study_info
