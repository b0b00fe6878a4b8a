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
      info%help = "numbers of a motion after its transient: means, peaks, contact fractions, impacts, sections, spectra"
      info%source = "F. J. Harris (1978), Proc. IEEE 66, 51-83 (the window of the spectra)"
      info%is_table = .false.
      call add_duration(info, "after", "the transient, which is left out: a time or `N turns of DRIVER`", default="0 s")
      call add_duration(info, "period", "of the drive, for stroboscopic samples at its multiples and impacts per period: a time " &
                        //"or `N turns of DRIVER`; none: neither of them", default="")
      call add_words(info, "channels", "channels whose mean, RMS, peak, least and greatest value are taken on the output " &
                     //"instants, and which are sampled once per period", default="")
      call add_words(info, "spectra", "channels whose amplitude spectrum is taken on the output instants (Hann window)", default="")
      call add_number(info, "bins", dim_none, "of the histograms of impact speed and peak force", default="20", lower=2.0_wp, &
                      upper=10000.0_wp)
   end function statistics_info

   !> The section [ensemble].
   function ensemble_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "ensemble"
      info%help = "runs of `gudgeon sweep` from slightly perturbed starts, made consistent again"
      info%source = ""
      info%is_table = .false.
      call add_number(info, "runs", dim_none, "number of runs of each case", lower=1.0_wp, upper=100000.0_wp)
      call add_number(info, "seed", dim_none, "of the random numbers, which follow from it and the number of the run alone", &
                      default="1", lower=0.0_wp, upper=2.0e9_wp)
      call add_number(info, "position", dim_length, "greatest displacement of a body at the start in each coordinate; of its " &
                      //"angle: of a point at the radius of gyration", default="1e-9 m", lower=0.0_wp)
      call add_number(info, "velocity", dim_speed, "greatest change of the velocity of a body at the start, likewise", &
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
      call add_word(info, "combine", "grid: every combination, the last parameter changing fastest; paired: the first values " &
                    //"of all, then the second ones", default="grid", choices="grid paired")
      call add_word(info, "keep", "what sweep.h5 holds of each run: its numbers, or its channels too", default="numbers", &
                    choices="numbers channels")
      call add_file(info, "file", "table of cases: the first line names parameters as `c[mm], speed[rpm], law`, each further one " &
                    //"is a case; commas, semicolons, tabs or blanks between the cells", default="")
   end function sweep_info

end module study_info
