!> The sections that ask for statistics and for many runs: [statistics], [ensemble], [sweep].
module study_info
   use kind_info, only: add_duration, add_file, add_number, add_word, add_words, dim_length, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ensemble_info, statistics_info, sweep_info

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
