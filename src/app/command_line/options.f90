!> The command line: a verb, its operands and its options.
module options
   use command_words, only: find_option, options_of, option_info => option_t, takers_of, verb_names, words_of_value
   use errors, only: error_t, exit_usage, set_error
   use kind_info, only: dim_time, same_dimension
   use kinds, only: i8, min_tolerance, wp
   use numbers, only: number_length, read_number
   use processes, only: clock_ms
   use spelling, only: nearest_word
   use text, only: append_text, join, segment, split_blank, starts_with, text_t, to_text
   use units, only: parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: any_word, options_t, read_options, usage_error

   !> What is set beside the deck.
   type :: changes_t
      type(text_t), allocatable :: overrides(:)      !! (n) `--set NAME=VALUE`
      character(:), allocatable :: method            !! `--method M`; unallocated: as the deck says
      character(:), allocatable :: analysis          !! `--analysis A`; unallocated: the first that the deck has
      integer :: member = 0                          !! `--member K`: run K of the ensemble; 0: the start as it is
      real(wp) :: tolerance = 0.0_wp                 !! `--tolerance X`; 0: as the deck says [1]
      logical :: is_ideal = .false.                  !! `--ideal`
   end type changes_t

   !> How many runs are made.
   type :: runs_options_t
      integer :: jobs = 0                            !! `--jobs N`: at once; 0: as many as there are processors
      integer :: shard = 0                           !! `--shard I/N`: the I; 0: all runs
      integer :: n_shards = 1                        !! the N
      logical :: is_member = .false.                 !! one run of a sweep, whose cases need not be known
      logical :: has_known_words = .false.           !! of a deck whose words for channels and figures were checked
      type(text_t), allocatable :: observed(:)       !! (n) channels whose numbers a study needs; unallocated: as the deck says
   end type runs_options_t

   !> Help in other forms.
   type :: help_options_t
      logical :: is_manual = .false.                 !! `--manual`
      logical :: is_man = .false.                    !! `--man`
      character(:), allocatable :: completion        !! `--completion SHELL`; unallocated: not asked for
   end type help_options_t

   !> What concerns other programs.
   type :: legacy_options_t
      character(:), allocatable :: way               !! `--legacy WAY`; unallocated: as the deck says
      logical :: with_adams = .false.                !! `--adams`
      type(text_t), allocatable :: channels(:)       !! (n) `--channel SPEC`
      character(:), allocatable :: time              !! `--time SPEC`; unallocated: the first column, in its unit
      character(:), allocatable :: table             !! `--table FILE`; unallocated: none
      real(wp) :: absolute = 0.0_wp                  !! `--absolute X` [any]
      real(wp) :: relative = -1.0_wp                 !! `--relative X`; negative: the default [1]
      logical :: by_statistics = .false.             !! `--statistics`
   end type legacy_options_t

   !> Runs that are stopped and continue.
   type :: restart_options_t
      logical :: is_resumed = .false.                !! `--resume`
      logical :: is_verified = .false.               !! `--verify-restart`
      real(wp) :: walltime = 0.0_wp                  !! `--walltime TIME`; 0: none [s]
      integer(i8) :: begun = 0                       !! when the program started, on the clock of `clock_ms` [ms]
   end type restart_options_t

   !> How right the numbers are.
   type :: digits_options_t
      real(wp) :: accuracy = 0.0_wp                  !! `--accuracy X`; 0: as the deck says [1]
      real(wp) :: budget = 0.0_wp                    !! `--budget TIME`; 0: as the deck says [s]
      logical :: with_horizon = .false.              !! `--horizon`
   end type digits_options_t

   !> What the user asked for.
   type :: options_t
      character(:), allocatable :: verb              !! one of `known_verbs`
      type(text_t), allocatable :: operands(:)       !! (n) words that are no options
      type(changes_t) :: change                      !! what is set beside the deck
      character(:), allocatable :: directory         !! `--out DIR`; unallocated: outputs/NAME
      character(:), allocatable :: write             !! `--write W`: numbers, channels or all; nothing, in a sweep
      type(runs_options_t) :: runs                   !! how many runs are made
      character(:), allocatable :: methods           !! `--methods LIST`; unallocated: as the deck says
      type(digits_options_t) :: digits               !! how right the numbers are
      character(:), allocatable :: command           !! the whole command line
      logical :: is_quiet = .false.                  !! `--quiet`
      logical :: is_json = .false.                   !! `--json`
      logical :: is_csv = .false.                    !! `--csv`
      type(restart_options_t) :: restart             !! runs that are stopped and continue
      type(help_options_t) :: help                   !! what help is asked for
      type(legacy_options_t) :: legacy               !! what concerns other programs
   end type options_t

contains

   !> Read the command line.
   subroutine read_options(options, error)
      type(options_t), intent(out) :: options              !! what was asked for
      type(error_t), allocatable, intent(out) :: error     !! unknown verb or option, missing value

      character(:), allocatable :: known, value, word
      integer :: k, sign

      options%restart%begun = clock_ms()
      allocate (options%operands(0), options%change%overrides(0), options%legacy%channels(0))
      options%command = "gudgeon"
      do k = 1, command_argument_count()
         options%command = options%command//" "//argument(k)
      end do
      options%verb = "help"
      options%write = "all"
      if (command_argument_count() == 0) return
      options%verb = argument(1)
      select case (options%verb)
      case ("--version", "-V")
         options%verb = "version"
      case ("--help", "-h")
         options%verb = "help"
      end select
      if (.not. any_word(options%verb, verb_names())) then
         call usage_error("unknown verb '"//options%verb//"'", options%verb, verb_names(), error)
         return
      end if
      known = options_of(options%verb)
      k = 1
      do while (k < command_argument_count())
         k = k + 1
         word = argument(k)
         if (word == "--help" .or. word == "-h") then
            call turn_to_help(options)
            return
         end if
         if (.not. starts_with(word, "--")) then
            call append_text(options%operands, word)
            cycle
         end if
         sign = index(word, "=")
         if (sign > 0) then
            value = word(sign + 1:)
            word = segment(word, 1, sign - 1)
         else if (allocated(value)) then
            deallocate (value)
         end if
         if (.not. any_word(word, known) .and. takers_of(word) /= "") then
            call set_error(error, exit_usage, "unknown option '"//word//"' of "//options%verb//new_line("a")// &
                           "  = options of this verb: "//takers_of(word))
            return
         end if
         if (.not. any_word(word, known)) then
            call usage_error("unknown option '"//word//"' of "//options%verb, word, known, error)
            return
         end if
         call take_option(options, word, value, k, error)
         if (allocated(error)) return
      end do
   end subroutine read_options

   !> Ask for help on the verb instead.
   subroutine turn_to_help(options)
      type(options_t), intent(inout) :: options   !! its operands are left aside

      options%operands = [text_t ::]
      call append_text(options%operands, options%verb)
      options%verb = "help"
   end subroutine turn_to_help

   !> Take an option and its value, as in `--option value` or `--option=value`.
   !> Length: a case for each option.
   subroutine take_option(options, word, glued, k, error)
      type(options_t), intent(inout) :: options            !! what was asked for
      character(*), intent(in) :: word                     !! the option
      character(:), allocatable, intent(in) :: glued       !! value behind an equals sign; unallocated: there is none
      integer, intent(inout) :: k                          !! number of the argument, moved past its value
      type(error_t), allocatable, intent(out) :: error     !! no value, or a bad one

      character(:), allocatable :: value
      type(option_info) :: info
      logical :: is_finite

      info = find_option(word)
      if (allocated(glued) .and. info%value == "") then
         call set_error(error, exit_usage, "option "//word//" takes no value, got '"//glued//"'")
         return
      end if
      select case (word)
      case ("--ideal"); options%change%is_ideal = .true.
      case ("--quiet"); options%is_quiet = .true.
      case ("--json"); options%is_json = .true.
      case ("--horizon"); options%digits%with_horizon = .true.
      case ("--csv"); options%is_csv = .true.
      case ("--adams"); options%legacy%with_adams = .true.
      case ("--statistics"); options%legacy%by_statistics = .true.
      case ("--resume"); options%restart%is_resumed = .true.
      case ("--verify-restart"); options%restart%is_verified = .true.
      case ("--manual"); options%help%is_manual = .true.
      case ("--man"); options%help%is_man = .true.
      case default
         if (allocated(glued)) then
            value = glued
         else
            k = k + 1
            if (k <= command_argument_count()) value = argument(k)
         end if
         if (.not. allocated(value)) then
            call set_error(error, exit_usage, "option "//word//" needs a value")
            return
         end if
         select case (word)
         case ("--out"); options%directory = value
         case ("--write")
            options%write = value
            call check_word(word, value, error)
         case ("--completion")
            options%help%completion = value
            call check_word(word, value, error)
         case ("--legacy")
            options%legacy%way = value
            call check_word(word, value, error)
         case ("--channel"); call append_text(options%legacy%channels, value)
         case ("--time"); options%legacy%time = value
         case ("--table"); options%legacy%table = value
         case ("--absolute"); call take_allowance(word, value, options%legacy%absolute, error)
         case ("--relative"); call take_allowance(word, value, options%legacy%relative, error)
         case ("--member"); call take_count(word, value, options%change%member, error)
         case ("--jobs"); call take_count(word, value, options%runs%jobs, error)
         case ("--shard"); call take_shard(word, value, options%runs%shard, options%runs%n_shards, error)
         case ("--method"); options%change%method = value
         case ("--analysis"); options%change%analysis = value
         case ("--set"); call append_text(options%change%overrides, value)
         case ("--methods"); options%methods = value
         case ("--accuracy"); call take_accuracy(word, value, options%digits%accuracy, error)
         case ("--walltime"); call take_time(word, value, options%restart%walltime, error)
         case ("--budget"); call take_time(word, value, options%digits%budget, error)
         case ("--tolerance")
            is_finite = number_length(value) == len(value) .and. len(value) > 0
            if (is_finite) call read_number(value, 0, options%change%tolerance, is_finite)
            if (.not. is_finite .or. options%change%tolerance <= 0.0_wp .or. options%change%tolerance > 0.01_wp) then
               call set_error(error, exit_usage, "option --tolerance needs a number above 0 and up to 0.01, got '"//value//"'")
            end if
         end select
      end select
   end subroutine take_option

   !> A value that is one of a few words.
   subroutine check_word(word, value, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      type(error_t), allocatable, intent(out) :: error     !! not one of the words

      if (any_word(value, words_of_value(word))) return
      call usage_error("unexpected argument '"//value//"' of "//word, value, words_of_value(word), error)
   end subroutine check_word

   !> A number of things, from 1 on.
   subroutine take_count(word, value, n, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      integer, intent(out) :: n                            !! the number
      type(error_t), allocatable, intent(out) :: error     !! not a number from 1 on

      integer :: status

      n = 0
      status = 1
      if (len(value) > 0 .and. len(value) < 9 .and. verify(value, "0123456789") == 0) read (value, *, iostat=status) n
      if (status == 0 .and. n >= 1) return
      call set_error(error, exit_usage, "option "//word//" needs a number from 1 on, got '"//value//"'")
   end subroutine take_count

   !> A difference that is allowed.
   subroutine take_allowance(word, value, x, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      real(wp), intent(inout) :: x                         !! the number [any]
      type(error_t), allocatable, intent(out) :: error     !! no number, or a negative one

      real(wp) :: read
      logical :: is_good

      is_good = number_length(value) == len(value) .and. len(value) > 0
      if (is_good) call read_number(value, 0, read, is_good)
      if (is_good) is_good = read >= 0.0_wp
      if (is_good) x = read
      if (.not. is_good) call set_error(error, exit_usage, "option "//word//" needs a number from 0 on, got '"//value//"'")
   end subroutine take_allowance

   !> A part of many, as 3/20.
   subroutine take_shard(word, value, shard, n_shards, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      integer, intent(out) :: shard                        !! which part
      integer, intent(out) :: n_shards                     !! of how many
      type(error_t), allocatable, intent(out) :: error     !! not a part, or not of these

      integer :: slash

      n_shards = 1
      slash = index(value, "/")
      call take_count(word, value(:max(0, slash - 1)), shard, error)
      if (.not. allocated(error)) call take_count(word, value(slash + 1:), n_shards, error)
      if (.not. allocated(error) .and. shard <= n_shards) return
      call set_error(error, exit_usage, "option "//word//" needs a shard and the number of shards, as 3/20, got '"//value//"'")
   end subroutine take_shard

   !> A part of one.
   subroutine take_accuracy(word, value, x, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      real(wp), intent(out) :: x                           !! the number [1]
      type(error_t), allocatable, intent(out) :: error     !! not a number that can be reached

      logical :: is_good

      x = 0.0_wp
      is_good = number_length(value) == len(value) .and. len(value) > 0
      if (is_good) call read_number(value, 0, x, is_good)
      if (is_good .and. x >= min_tolerance .and. x <= 1.0_wp) return
      call set_error(error, exit_usage, "option "//word//" needs a number from "//to_text(min_tolerance)//" to 1, got '"// &
                     value//"'")
   end subroutine take_accuracy

   !> A time with its unit.
   subroutine take_time(word, value, t, error)
      character(*), intent(in) :: word                     !! the option
      character(*), intent(in) :: value                    !! its value
      real(wp), intent(out) :: t                           !! the time [s]
      type(error_t), allocatable, intent(out) :: error     !! not a positive time

      type(unit_t) :: unit
      character(:), allocatable :: message
      integer :: first, last, n
      logical :: is_good

      t = 0.0_wp
      n = number_length(value)
      is_good = n > 0 .and. n < len(value)
      if (is_good) then
         call parse_unit(adjustl(value(n + 1:)), unit, message, first, last)
         is_good = message == ""
         if (is_good) is_good = same_dimension(unit%dimension, dim_time)
         if (is_good) call read_quantity(value(:n), unit, t, is_good)
      end if
      if (is_good .and. t > 0.0_wp) return
      call set_error(error, exit_usage, "option "//word//" needs a time above zero with its unit, as 60s, got '"//value//"'")
   end subroutine take_time

   !> An error on the command line, with the nearest word that would do.
   subroutine usage_error(message, word, known, error)
      character(*), intent(in) :: message                  !! what is wrong
      character(*), intent(in) :: word                     !! the wrong word
      character(*), intent(in) :: known                    !! blank-separated words that would do
      type(error_t), allocatable, intent(out) :: error     !! the error

      character(:), allocatable :: near

      near = nearest_word(word, split_blank(known))
      if (near /= "") near = "did you mean '"//near//"'? "
      call set_error(error, exit_usage, message//new_line("a")//"  = "//near//"known: "//join(split_blank(known), " ")// &
                     new_line("a")//"  = see 'gudgeon help'")
   end subroutine usage_error

   !> Whether a word stands in a blank-separated list.
   pure logical function any_word(word, list)
      character(*), intent(in) :: word  !! the word
      character(*), intent(in) :: list  !! the list

      any_word = word /= "" .and. index(" "//list//" ", " "//word//" ") > 0
   end function any_word

   !> One argument of the command line.
   function argument(k) result(word)
      integer, intent(in) :: k             !! its number
      character(:), allocatable :: word    !! the argument

      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(length) :: word)
      call get_command_argument(k, word)
   end function argument

end module options
