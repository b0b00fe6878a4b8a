!> The verbs, options and exit codes of the program, each said once: the command line's reader, `gudgeon help`, the man page
!> and the completions of shells take them from here.
module command_words
   use errors, only: exit_assembly, exit_audit, exit_deck, exit_different, exit_file, exit_integration, exit_internal, exit_ok, &
      exit_stopped, exit_sweep, exit_usage
   use integrator, only: integrator_t
   use integrator_registry, only: n_integrator_kinds, new_integrator
   use kind_info, only: kind_info_t
   use scene, only: analysis_names
   implicit none (type, external)
   private
   public :: command_t, exit_codes, exit_meanings, find_option, known_options, known_verbs, option_t, options_of, takers_of, &
      verb_names, words_of_value

   !> What follows a verb.
   type :: command_t
      character(11) :: name = ""     !! the verb
      character(9) :: operand = ""   !! what it works on: DECK, NAME, [KIND]; blank: nothing
      character(88) :: help = ""     !! one line
      character(170) :: options = ""  !! the options that it takes, blank-separated
   end type command_t

   !> An option.
   type :: option_t
      character(16) :: name = ""      !! with its dashes
      character(10) :: value = ""     !! name of its value; blank: it has none
      character(100) :: help = ""     !! one line
      logical :: is_repeated = .false.   !! may stand more than once
   end type option_t

   type(command_t), parameter :: known_verbs(*) = [ &
      command_t("run", "DECK", "run the analysis; results in outputs/NAME/", &
                "--out --set --ideal --analysis --tolerance --method --accuracy --budget --horizon --quiet --json --member "// &
                 "--write --csv --legacy --resume --walltime --verify-restart"), &
      command_t("sweep", "DECK", "run all cases of [sweep] and all runs of [ensemble] on all processors", &
                "--out --set --ideal --tolerance --method --quiet --json --jobs --shard"), &
      command_t("merge", "DIR", "merge the shards of a sweep, DIR.shards, into DIR", "--out --quiet --json"), &
      command_t("life", "DECK", "wear over many cycles by [life]: depth, volume, life with their intervals", &
                "--out --set --tolerance --method --quiet --json --jobs"), &
      command_t("sensitivity", "DECK", "derivatives of results by parameters, through impacts, by [sensitivity]", &
                "--out --set --tolerance --method --quiet --json"), &
      command_t("orbit", "DECK", "periodic orbits, Floquet multipliers, branches and bifurcations, by [orbit]", &
                "--out --set --tolerance --method --quiet --json"), &
      command_t("modes", "DECK", "eigenvalues, natural frequencies, modes, matrices and Campbell diagram, by [modes]", &
                "--out --set --ideal --tolerance --method --quiet --json"), &
      command_t("tolerance", "DECK", "tolerances and clearances by [tolerance]: derivatives, worst case, scatter, yield", &
                "--out --set --tolerance --method --quiet --json --jobs --shard"), &
      command_t("fit", "DECK DATA", "parameters from measured data by [fit], with 95 % intervals", &
                "--out --set --time --tolerance --method --write --quiet --json"), &
      command_t("precision", "DECK", "compare methods and tolerances: accuracy against cost", &
                "--out --set --ideal --methods --accuracy --budget --quiet --json"), &
      command_t("check", "DECK", "check the deck completely without integrating", &
                "--set --ideal --analysis --tolerance --method --legacy"), &
      command_t("explain", "DECK", "report the model, unused items, defaults and numerical settings", &
                "--set --ideal --analysis --tolerance --method --legacy --adams"), &
      command_t("compare", "A B", "compare two runs, or a run with external columns: differences, peaks, impacts, figure", &
                "--out --channel --time --table --absolute --relative --statistics --quiet --json"), &
      command_t("import", "MODEL", "convert an Adams dataset MODEL.adm to a deck, with a list of unsupported items", "--out"), &
      command_t("new", "NAME", "write a commented starting deck NAME.deck", ""), &
      command_t("list", "[KIND]", "list all tables and settings of a deck, or one group: gudgeon list contact", ""), &
      command_t("help", "[KIND]", "show this page, or help on a type (joint revolute) or a verb; also gudgeon VERB --help", &
                "--manual --man --completion"), &
      command_t("version", "", "show versions of the program and its libraries; also --version", "")]
      !! in the order of the help

   type(option_t), parameter :: known_options(*) = [ &
      option_t("--out", "DIR", "output directory; default outputs/NAME, NAME from the deck file"), &
      option_t("--set", "NAME=VALUE", "override a parameter of the deck", .true.), &
      option_t("--ideal", "", "treat every joint with clearance as ideal"), &
      option_t("--analysis", "A", "analysis to run; default: the first analysis section of the deck"), &
      option_t("--tolerance", "X", "tolerance, overrides the deck"), &
      option_t("--method", "M", "integration method, overrides the deck"), &
      option_t("--quiet", "", "print errors only"), &
      option_t("--json", "", "print summary.json only"), &
      option_t("--member", "K", "run number K of the ensemble of the deck"), &
      option_t("--write", "W", "what to write: numbers (the summary only), channels (no text files, no figures), all"), &
      option_t("--csv", "", "write time histories and events as comma-separated values too"), &
      option_t("--horizon", "", "Lyapunov exponent (divergence of neighbouring trajectories) and the horizon of predictability"), &
      option_t("--resume", "", "resume from the checkpoint in the output directory; without one, start at t = 0"), &
      option_t("--walltime", "TIME", "save the run and stop it before this wall-clock time has passed, as 2h"), &
      option_t("--verify-restart", "", "run twice, once with restarts from checkpoints, and compare all results bit for bit"), &
      option_t("--jobs", "N", "parallel runs; default one per processor"), &
      option_t("--shard", "I/N", "every N-th run starting from run I, into DIR.shards/I-of-N, for `gudgeon merge DIR`"), &
      option_t("--methods", "LIST", "settings to compare, as ""verner rk4 verner.baumgarte"", overrides the deck"), &
      option_t("--accuracy", "X", "target for the maximum relative error; of run: choose the tolerance that meets it"), &
      option_t("--budget", "TIME", "time budget of all runs, as 60s, overrides the deck (run: with --accuracy, --horizon)"), &
      option_t("--legacy", "WAY", "fixed steps, formulas as printed in Flores et al. (2008), contact onset by its procedure 1 "// &
         "or 2"), &
      option_t("--adams", "", "parameters of Adams' IMPACT function closest to each contact law"), &
      option_t("--channel", "SPEC", "a channel and its column, as ""rod.angle=3 unit=deg absolute=1e-3""", .true.), &
      option_t("--time", "SPEC", "time column, as ""1 unit=ms shift=-5ms scale=1"""), &
      option_t("--table", "FILE", "a file with one channel per line, in the form of --channel"), &
      option_t("--absolute", "X", "default absolute tolerance of a channel, SI"), &
      option_t("--relative", "X", "default relative tolerance, of the channel's maximum magnitude; default 1e-6"), &
      option_t("--statistics", "", "compare means and RMS values with their significance, not single output times"), &
      option_t("--manual", "", "print the complete manual as Markdown"), &
      option_t("--man", "", "print the man page"), &
      option_t("--completion", "SHELL", "print the completion script for a shell")]
      !! in the order of the help

   integer, parameter :: exit_codes(*) = [exit_ok, exit_different, exit_usage, exit_deck, exit_assembly, exit_integration, &
                                          exit_audit, exit_stopped, exit_sweep, exit_file, exit_internal]
      !! that a run may end with
   character(*), parameter :: exit_meanings(size(exit_codes)) = [character(60) :: &
      "done", "comparison found differences", "invalid command line", "invalid deck", &
      "assembly failed: open loop, shaky, or at a dead centre", "integration failed", &
      "energy error, constraint violation or accuracy over limit", "stopped by a signal or --walltime; results saved", &
      "some runs of a sweep failed", "file, disk or memory error", &
      "internal error of the program"]
      !! what they mean

contains

   !> The verbs, blank-separated.
   pure function verb_names() result(words)
      character(:), allocatable :: words  !! in the order of the help

      integer :: k

      words = trim(known_verbs(1)%name)
      do k = 2, size(known_verbs)
         words = words//" "//trim(known_verbs(k)%name)
      end do
   end function verb_names

   !> Options that a verb takes, blank-separated.
   pure function options_of(verb) result(words)
      character(*), intent(in) :: verb       !! the verb
      character(:), allocatable :: words     !! blank if it takes none

      integer :: k

      words = ""
      do k = 1, size(known_verbs)
         if (known_verbs(k)%name == verb) words = trim(known_verbs(k)%options)
      end do
   end function options_of

   !> The verbs that take an option, blank-separated.
   pure function takers_of(option) result(words)
      character(*), intent(in) :: option     !! with its dashes
      character(:), allocatable :: words     !! in the order of the help

      integer :: k

      words = ""
      do k = 1, size(known_verbs)
         if (index(" "//known_verbs(k)%options, " "//option//" ") == 0) cycle
         words = words//" "//trim(known_verbs(k)%name)
      end do
      words = trim(adjustl(words))
   end function takers_of

   !> An option by its name; one without a name if there is none.
   pure type(option_t) function find_option(name) result(option)
      character(*), intent(in) :: name  !! with its dashes

      integer :: k

      do k = 1, size(known_options)
         if (known_options(k)%name == name) option = known_options(k)
      end do
   end function find_option

   !> The words that an option takes as its value, blank-separated; blank where it takes anything.
   function words_of_value(name) result(words)
      character(*), intent(in) :: name       !! the option
      character(:), allocatable :: words     !! as the kinds call themselves

      class(integrator_t), allocatable :: method
      type(kind_info_t) :: info
      integer :: k

      words = ""
      select case (name)
      case ("--analysis"); words = concatenated(analysis_names)
      case ("--method")
         do k = 1, n_integrator_kinds()
            call new_integrator(k, method)
            info = method%info()
            words = words//" "//info%name
         end do
      case ("--legacy"); words = "procedure1 procedure2"
      case ("--write"); words = "numbers channels all"
      case ("--completion"); words = "bash zsh"
      end select
      words = trim(adjustl(words))
   end function words_of_value

   !> Words of equal length, blank-separated.
   pure function concatenated(list) result(words)
      character(*), intent(in) :: list(:)    !! the words
      character(:), allocatable :: words     !! all of them

      integer :: k

      words = ""
      do k = 1, size(list)
         words = words//" "//trim(list(k))
      end do
   end function concatenated

end module command_words
