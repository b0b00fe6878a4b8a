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
      character(9) :: name = ""      !! the verb
      character(8) :: operand = ""   !! what it works on: DECK, NAME, [KIND]; blank: nothing
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
      command_t("run", "DECK", "run the analysis; writes outputs/NAME/", &
                "--out --set --ideal --analysis --tolerance --method --accuracy --budget --horizon --quiet --json --member "// &
                 "--write --csv --legacy --resume --walltime --verify-restart"), &
      command_t("sweep", "DECK", "run all cases of [sweep] and all runs of [ensemble], on all processors", &
                "--out --set --ideal --tolerance --method --quiet --json --jobs --shard"), &
      command_t("merge", "DIR", "put the parts of a sweep, DIR.shards, together in DIR", "--out --quiet --json"), &
      command_t("precision", "DECK", "error against cost of methods and tolerances: how long for how many digits", &
                "--out --set --ideal --methods --accuracy --budget --quiet --json"), &
      command_t("check", "DECK", "find every mistake without integrating", &
                "--set --ideal --analysis --tolerance --method --legacy"), &
      command_t("explain", "DECK", "what is modelled, what was dropped, every default taken", &
                "--set --ideal --analysis --tolerance --method --legacy --adams"), &
      command_t("compare", "A B", "two runs, or a run and columns of another program: differences, peaks, impacts, figure", &
                "--out --channel --time --table --absolute --relative --statistics --quiet --json"), &
      command_t("import", "MODEL", "make a deck of an Adams dataset MODEL.adm, with a list of what was left out", "--out"), &
      command_t("new", "NAME", "write a commented deck NAME.deck to start from", ""), &
      command_t("list", "[KIND]", "all tables and settings a deck may hold, or a group: gudgeon list contact", ""), &
      command_t("help", "[KIND]", "this page, a kind (gudgeon help joint revolute), or a verb; also gudgeon VERB --help", &
                "--manual --man --completion"), &
      command_t("version", "", "versions of the program and its libraries; also --version", "")]
      !! in the order of the help

   type(option_t), parameter :: known_options(*) = [ &
      option_t("--out", "DIR", "directory of the results; default outputs/NAME, as the deck is called"), &
      option_t("--set", "NAME=VALUE", "change a parameter of the deck", .true.), &
      option_t("--ideal", "", "take every loose joint as ideal"), &
      option_t("--analysis", "A", "the analysis to run; left out: the first of these that the deck has"), &
      option_t("--tolerance", "X", "error allowed, instead of the deck's"), &
      option_t("--method", "M", "method of integration, instead of the deck's"), &
      option_t("--quiet", "", "print errors only"), &
      option_t("--json", "", "print summary.json and nothing else"), &
      option_t("--member", "K", "run number K of the deck's ensemble"), &
      option_t("--write", "W", "leave out what takes long to write"), &
      option_t("--csv", "", "time histories and events as comma-separated values too"), &
      option_t("--horizon", "", "how fast neighbouring motions part (Lyapunov exponent), and how long digits mean anything"), &
      option_t("--resume", "", "go on from the checkpoint in the directory of the run; without one, begin"), &
      option_t("--walltime", "TIME", "save the run and end it before so much time of the clock is over, as 2h"), &
      option_t("--verify-restart", "", "run, run again with restarts from checkpoints, and compare all numbers bit for bit"), &
      option_t("--jobs", "N", "runs at once; default one for each processor"), &
      option_t("--shard", "I/N", "every N-th run from the I-th on, into DIR.shards/I-of-N, for `gudgeon merge DIR`"), &
      option_t("--methods", "LIST", "settings compared, as ""verner rk4 verner.baumgarte"", instead of the deck's"), &
      option_t("--accuracy", "X", "greatest relative error wanted; of run: choose the tolerance that keeps it"), &
      option_t("--budget", "TIME", "time of all runs, as 60s, instead of the deck's (run: with --accuracy, --horizon)"), &
      option_t("--legacy", "WAY", "run with fixed steps, the book's formulas, and onsets of contacts by its procedure 1 or 2"), &
      option_t("--adams", "", "parameters of Adams' IMPACT function that come nearest to each contact law"), &
      option_t("--channel", "SPEC", "a channel and its column, as ""rod.angle=3 unit=deg absolute=1e-3""", .true.), &
      option_t("--time", "SPEC", "column of the time, as ""1 unit=ms shift=-5ms scale=1"""), &
      option_t("--table", "FILE", "a file with one channel in a line, as --channel takes it"), &
      option_t("--absolute", "X", "difference allowed, SI, of channels that have none of their own"), &
      option_t("--relative", "X", "difference allowed, of a channel's greatest magnitude; default 1e-6"), &
      option_t("--statistics", "", "judge means and RMS, with their significance, instead of every instant"), &
      option_t("--manual", "", "the whole manual, as Markdown"), &
      option_t("--man", "", "the man page"), &
      option_t("--completion", "SHELL", "what completes the words of this program in a shell")]
      !! in the order of the help

   integer, parameter :: exit_codes(*) = [exit_ok, exit_different, exit_usage, exit_deck, exit_assembly, exit_integration, &
                                          exit_audit, exit_stopped, exit_sweep, exit_file, exit_internal]
      !! that a run may end with
   character(*), parameter :: exit_meanings(size(exit_codes)) = [character(60) :: &
      "done", "compared and found different", "a wrong command line", "a mistake in the deck", &
      "not assembled: open, shaky, or at a dead centre", "the integration failed", &
      "energy or constraints above a limit, or accuracy not reached", "stopped from outside, and saved", &
      "part of a sweep failed", "a file, the disk or memory", &
      "a mistake of the program itself"]
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
         do k = 1, n_integrator_kinds
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
