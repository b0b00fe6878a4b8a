!> The section [precision], and the words by which it names settings of an integration.
!>
!> A word is `METHOD`, `METHOD.WAY` or `METHOD.WAY.SOLVER`: an integrator, a stabilisation method, a solver of the
!> augmented equations, as in [analysis.dynamic]; `*` stands for all of them but `auto`. What a word omits is as the deck
!> has it.
module precision_info
   use columns, only: column_of
   use diagnostics, only: diagnostics_t
   use integration_method, only: abilities_t
   use integration_settings, only: chosen, integration_t, places_t, takes_steps
   use integrator_registry, only: abilities_of, reference_methods
   use item, only: item_t, place_of
   use kind_info, only: add_number, add_word, add_words, dim_none, dim_time, kind_info_t
   use kinds, only: min_tolerance, wp
   use section_info, only: dynamic_info
   use spelling, only: nearest_word
   use text, only: append_text, split_blank, text_t
   implicit none (type, external)
   private
   public :: check_precision, check_setting_word, precision_section, reference_setting, setting_t, settings_of

   character(*), parameter :: keys(3) = [character(9) :: "method", "stabilise", "solver"]      !! of [analysis.dynamic]
   character(*), parameter :: sorts(3) = [character(30) :: "method", "stabilisation method", "solver"]  !! as text

   !> How an integration is set. What is blank is as the deck has it.
   type :: setting_t
      character(:), allocatable :: method  !! integrator
      character(:), allocatable :: stabiliser     !! stabilisation method, or blank
      character(:), allocatable :: solver  !! of the augmented equations, or blank
   contains
      procedure :: apply
      procedure :: has_fixed_steps
      procedure :: word
   end type setting_t

contains

   !> The section [precision].
   function precision_section() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "precision"
      info%help = "settings of `gudgeon precision`: accuracy against cost for sequences of tolerances or steps"
      info%source = "E. Hairer, S. P. Noersett, G. Wanner (1993), Solving Ordinary Differential Equations I, section II.10"
      info%is_table = .false.
      call add_words(info, "methods", "settings compared: METHOD, METHOD.WAY or METHOD.WAY.SOLVER with values of `method`, " &
                     //"`stabilise` and `solver` of [analysis.dynamic]; * for all except auto; omitted parts as in the deck", &
                     default=choices_of("method"))
      call add_number(info, "coarsest", dim_none, "largest tolerance of a sequence", default="1e-3", lower=min_tolerance, &
                      upper=0.01_wp)
      call add_number(info, "finest", dim_none, "smallest tolerance of a sequence", default="1e-12", lower=min_tolerance, &
                      upper=0.01_wp)
      call add_number(info, "per_decade", dim_none, "runs per decade", default="4", lower=1.0_wp, upper=20.0_wp)
      call add_number(info, "longest_step", dim_time, "largest step of the sequences with fixed steps; 0: the mean step of a " &
                      //"variable-step method at the largest tolerance", default="0 s", lower=0.0_wp)
      call add_number(info, "step_decades", dim_none, "number of decades of these sequences", default="3", lower=0.0_wp, &
                      upper=8.0_wp)
      call add_number(info, "accuracy", dim_none, "target error, relative to the range of motion or the maximum value", &
                      default="1e-6", lower=min_tolerance, upper=1.0_wp)
      call add_word(info, "error", "error used for the target and the figure: motion (maximum of position and velocity errors), " &
                    //"positions, velocities, or reactions", default="motion", choices="motion positions velocities reactions")
      call add_number(info, "rounds", dim_none, "number of timings of every run", default="5", lower=1.0_wp, upper=1000.0_wp)
      call add_number(info, "instants", dim_none, "number of times compared, besides the initial time", default="200", &
                      lower=2.0_wp, upper=1.0e6_wp)
      call add_number(info, "perturbation", dim_none, "maximum initial displacement of a neighbouring trajectory, relative to "// &
         "the size of the " &
                      //"mechanism; 0: no neighbouring trajectories", default="1e-9", lower=0.0_wp, upper=1.0e-3_wp)
      call add_number(info, "exponent_end", dim_time, "end time for the Lyapunov exponent; 0: end of the run", &
                      default="0 s", lower=0.0_wp)
      call add_number(info, "exponent_instants", dim_none, "number of equal intervals of this time, for the growth and the "// &
         "rescaling of the neighbouring " &
                      //"back", default="640", lower=16.0_wp, upper=1.0e6_wp)
      call add_number(info, "settle", dim_none, "fraction of this time to omit as the transient", &
                      default="0.25", lower=0.0_wp, upper=0.9_wp)
      call add_number(info, "budget", dim_time, "time budget of the comparison; 0: no limit", default="60 s", lower=0.0_wp)
   end function precision_section

   !> Words of a key of [analysis.dynamic].
   function choices_of(key) result(words)
      character(*), intent(in) :: key         !! method, stabilise or solver
      character(:), allocatable :: words      !! blank-separated

      type(kind_info_t) :: info

      info = dynamic_info()
      words = info%columns(column_of(info, trim(key)))%choices
   end function choices_of

   !> What a star stands for: all words of a key but `auto`, which is one of the others, chosen for the deck.
   function all_of(key) result(list)
      character(*), intent(in) :: key           !! method, stabilise or solver
      type(text_t), allocatable :: list(:)      !! (n) words

      type(abilities_t) :: can
      type(text_t), allocatable :: words(:)
      integer :: k

      words = split_blank(choices_of(key))
      allocate (list(0))
      do k = 1, size(words)
         if (key == keys(1)) can = abilities_of(words(k)%s)
         if (words(k)%s /= chosen .and. can%parts == "") call append_text(list, words(k)%s)
      end do
   end function all_of

   !> Give settings of an integration this one; with a tolerance or a step.
   subroutine apply(self, asked, settings)
      class(setting_t), intent(in) :: self               !! the setting
      real(wp), intent(in) :: asked                      !! tolerance, or length of fixed steps [1 or s]
      type(integration_t), intent(inout) :: settings     !! changed

      settings%method = self%method
      call settings%stabilisation%take(self%stabiliser)
      call settings%solver%take(self%solver)
      settings%controls%fixed_step = 0.0_wp
      if (self%has_fixed_steps()) then
         settings%controls%fixed_step = asked
      else
         settings%controls%tolerance = asked
      end if
      settings%places = places_t()
   end subroutine apply

   !> Whether its sequence is one of steps.
   logical function has_fixed_steps(self)
      class(setting_t), intent(in) :: self    !! the setting

      has_fixed_steps = takes_steps(self%method, self%stabiliser)
   end function has_fixed_steps

   !> The word that names a setting.
   pure function word(self) result(name)
      class(setting_t), intent(in) :: self    !! the setting
      character(:), allocatable :: name       !! as `verner.projection`

      name = self%method
      if (self%stabiliser /= "") name = name//"."//self%stabiliser
      if (self%solver /= "") name = name//"."//self%solver
   end function word

   !> The setting of runs that report something of a motion before others: the first method that confirms others.
   type(setting_t) function reference_setting(stabiliser) result(setting)
      character(*), intent(in) :: stabiliser      !! stabilisation method; blank: as the deck has it

      type(text_t), allocatable :: names(:)

      names = reference_methods(with_stiff=.false.)
      setting%method = names(1)%s  ! one by one: of the constructor gfortran 12 makes the length zero
      setting%stabiliser = stabiliser
      setting%solver = ""
   end function reference_setting

   !> What is wrong with the section.
   subroutine check_precision(item, diagnostics)
      type(item_t), intent(in) :: item                    !! the section
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: hint, message
      integer :: k

      associate (value => item%values(place_of(item, "methods")))
         do k = 1, size(value%words)
            call check_setting_word(value%words(k)%s, message, hint)
            if (message == "") cycle
            if (size(value%places) < k) then
               call diagnostics%add(value%location, message, "not a setting of an integration", hint)
            else
               call diagnostics%add(value%places(k), message, "not a setting of an integration", hint)
            end if
         end do
      end associate
      associate (finest => item%values(place_of(item, "finest")))
         if (finest%number <= item%number("coarsest")) return
         call diagnostics%add(finest%location, "'finest' must be smaller than 'coarsest'", "larger than 'coarsest'", &
                              "the finest tolerance is the smallest one")
      end associate
   end subroutine check_precision

   !> What is wrong with a word.
   subroutine check_setting_word(word, message, hint)
      character(*), intent(in) :: word                     !! as `verner.projection`
      character(:), allocatable, intent(out) :: message    !! blank if nothing is wrong
      character(:), allocatable, intent(out) :: hint       !! what may have been meant

      character(:), allocatable :: known, part
      integer :: k
      type(text_t), allocatable :: parts(:)

      message = ""
      hint = ""
      parts = parts_of(word)
      if (size(parts) > size(keys)) then
         message = "'"//word//"' has more parts than a method, a stabilisation method and a solver"
         hint = "write METHOD.WAY.SOLVER, as verner.projection.schur"
         return
      end if
      do k = 1, size(parts)
         part = parts(k)%s
         known = choices_of(keys(k))
         if (part == "*" .or. (part /= "" .and. index(" "//known//" ", " "//part//" ") > 0)) cycle
         message = "unknown "//trim(sorts(k))//" '"//part//"'"
         hint = nearest_word(part, split_blank(known))
         if (len(hint) > 0) hint = "did you mean '"//hint//"'? "
         hint = hint//"known: "//known
         return
      end do
   end subroutine check_setting_word

   !> The settings that words name, each once, in their order. The words are right.
   subroutine settings_of(words, settings)
      type(text_t), intent(in) :: words(:)                         !! (n) words
      type(setting_t), allocatable, intent(out) :: settings(:)     !! (m) settings

      type(text_t), allocatable :: methods(:), parts(:), solvers(:), stabilisers(:)
      type(setting_t) :: one
      integer :: i, j, k, m

      allocate (settings(0))
      do k = 1, size(words)
         parts = parts_of(words(k)%s)
         methods = words_at(1)
         stabilisers = words_at(2)
         solvers = words_at(3)
         do i = 1, size(methods)
            do j = 1, size(stabilisers)
               do m = 1, size(solvers)
                  one%method = methods(i)%s
                  one%stabiliser = stabilisers(j)%s
                  one%solver = solvers(m)%s
                  if (.not. is_there(one)) settings = [settings, one]
               end do
            end do
         end do
      end do

   contains

      !> What part of a word stands for.
      function words_at(place) result(list)
         integer, intent(in) :: place             !! of the part
         type(text_t), allocatable :: list(:)     !! (n) words; one blank: as the deck has it

         allocate (list(0))
         if (place > size(parts)) then
            call append_text(list, "")
         else if (parts(place)%s == "*") then
            list = all_of(keys(place))
         else
            call append_text(list, parts(place)%s)
         end if
      end function words_at

      !> Whether a setting is in the list already.
      pure logical function is_there(other)
         type(setting_t), intent(in) :: other  !! the setting

         integer :: n

         is_there = .false.
         do n = 1, size(settings)
            is_there = is_there .or. (settings(n)%method == other%method .and. settings(n)%stabiliser == other%stabiliser .and. &
                                      settings(n)%solver == other%solver)
         end do
      end function is_there

   end subroutine settings_of

   !> The parts of a word between its dots.
   pure function parts_of(word) result(parts)
      character(*), intent(in) :: word           !! the word
      type(text_t), allocatable :: parts(:)      !! (n) parts, at least one

      integer :: first, last

      allocate (parts(0))
      first = 1
      do
         last = index(word(first:), ".") + first - 2
         if (last < first - 1) last = len(word)
         call append_text(parts, word(first:last))
         first = last + 2
         if (last >= len(word)) exit
      end do
   end function parts_of

end module precision_info
