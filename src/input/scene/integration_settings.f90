!> How a motion is integrated: what [analysis.dynamic] sets, as values.
!>
!> Filled once, when the scene is read. An option of the command line or a study changes it before anything is built; what comes
!> after the scene reads it, and asks methods what they can do, but no word of a deck.
module integration_settings
   use dimension_text, only: unit_text
   use integration_method, only: abilities_t, steps_any, steps_fixed
   use integrator_controls, only: controls_t, onset_words, read_controls
   use integrator, only: integrator_t
   use integrator_registry, only: abilities_of, find_integrator
   use item, only: item_t, location_t, option_t, place_of
   use kind_info, only: dim_length, dim_t
   use kinds, only: wp
   use stabilisation, only: stabilisation_t
   use stabilisation_registry, only: find_stabilisation
   use text, only: real_text
   implicit none (type, external)
   private
   public :: choice_t, chosen, integration_t, new_option, places_t, read_integration, start_ideal, start_static, &
      takes_steps

   integer, parameter :: start_ideal = 1    !! from the mechanism with ideal joints
   integer, parameter :: start_given = 2    !! from the positions and velocities of the deck
   integer, parameter :: start_static = 3   !! from the equilibrium at t = 0
   character(*), parameter :: starts(3) = [character(6) :: "ideal", "given", "static"]  !! as text

   character(*), parameter :: chosen = "auto"   !! word for a choice that the system decides

   !> A choice by name, with the options after it.
   type :: choice_t
      character(:), allocatable :: name              !! in the registry; blank: the one that suits the system
      type(option_t), allocatable :: options(:)      !! (any) its options
   contains
      procedure :: take
   end type choice_t

   !> Where the deck sets what methods and steps must agree on; nowhere for what was changed since.
   type :: places_t
      type(location_t) :: method          !! the integrator
      type(location_t) :: step            !! length of fixed steps
      type(location_t) :: onset           !! treatment of contact onsets
      type(location_t) :: stabilisation   !! the stabilisation method
   end type places_t

   !> The settings.
   type :: integration_t
      character(:), allocatable :: method        !! name of the integrator
      type(controls_t) :: controls               !! its tolerance, steps and limits
      type(choice_t) :: stabilisation            !! of the constraints
      type(choice_t) :: solver                   !! of the augmented equations
      logical :: is_reduced = .true.             !! prescribed bodies and bodies with one degree of freedom leave the unknowns
      logical :: is_apart = .true.               !! independent groups of bodies make their own steps
      integer :: start = start_ideal             !! the initial state, one of the above
      logical :: allows_overlap = .false.        !! contacts may start with an overlap: a preload
      logical :: has_ledger = .true.             !! the balance of energy is monitored
      real(wp) :: energy_limit = 0.0_wp          !! residual of this balance, of the maximum energy; 0: no limit [1]
      real(wp) :: violation_limit = 0.0_wp       !! of the constraints; 0: no limit [m]
      real(wp) :: cpu_limit = 0.0_wp             !! processor time; 0: no limit [s]
      type(places_t) :: places                   !! where it is set
   contains
      procedure :: can
      procedure :: new_method
      procedure :: write => write_integration
   end type integration_t

contains

   !> The settings of a section that has been read.
   subroutine read_integration(item, settings)
      type(item_t), intent(in) :: item                 !! [analysis.dynamic], IMSL's names folded in
      type(integration_t), intent(out) :: settings     !! the settings

      settings%method = item%word("method")
      call read_controls(item, settings%controls)
      settings%stabilisation = choice_of("stabilise")
      settings%solver = choice_of("solver")
      settings%is_reduced = item%word("coordinates") == "fewest"
      settings%is_apart = item%word("groups") == "apart"
      settings%start = findloc(starts == item%word("start"), .true., dim=1)
      settings%allows_overlap = item%word("overlap") == "preload"
      settings%has_ledger = item%flag("ledger")
      settings%energy_limit = item%number("energy_limit")
      settings%violation_limit = item%number("violation_limit")
      settings%cpu_limit = item%number("limit_cpu")
      settings%places = places_t(place("method"), place("step"), place("contact_onset"), place("stabilise"))

   contains

      !> The choice that a key makes.
      type(choice_t) function choice_of(key) result(choice)
         character(*), intent(in) :: key     !! the key

         associate (value => item%values(place_of(item, key)))
            choice%name = value%text
            if (choice%name == chosen) choice%name = ""
            choice%options = [option_t ::]
            if (allocated(value%options)) choice%options = value%options
         end associate
      end function choice_of

      !> Where a key stands.
      type(location_t) function place(key)
         character(*), intent(in) :: key     !! the key

         place = item%values(place_of(item, key))%location
      end function place

   end subroutine read_integration

   !> Take a word; another one than before has no options.
   pure subroutine take(self, word)
      class(choice_t), intent(inout) :: self   !! the choice
      character(*), intent(in) :: word         !! of a deck; blank: nothing changes

      character(:), allocatable :: name

      name = word
      if (word == chosen) name = ""
      if (word == "" .or. self%name == name) return
      self%name = name
      self%options = [option_t ::]
   end subroutine take

   !> What the integrator can do.
   type(abilities_t) function can(self)
      class(integration_t), intent(in) :: self    !! the settings

      can = abilities_of(self%method)
   end function can

   !> The integrator, with its controls.
   subroutine new_method(self, method)
      class(integration_t), intent(in) :: self                     !! the settings
      class(integrator_t), allocatable, intent(out) :: method      !! the integrator, not started

      call find_integrator(self%method, method)
      method%controls = self%controls
   end subroutine new_method

   !> Whether an integrator with a stabilisation method needs steps of a given length.
   logical function takes_steps(method, hold)
      character(*), intent(in) :: method           !! name of the integrator
      character(*), intent(in) :: hold             !! name of the stabilisation method, or blank

      class(stabilisation_t), allocatable :: stabiliser
      type(abilities_t) :: can

      can = abilities_of(method)
      takes_steps = can%steps == steps_fixed
      if (can%steps /= steps_any .or. hold == "" .or. hold == chosen) return
      call find_stabilisation(hold, stabiliser)
      takes_steps = stabiliser%needs_fixed_step()
   end function takes_steps

   !> Write what was changed into a copy of the section, for the echo of the deck and the list of its defaults.
   subroutine write_integration(self, item)
      class(integration_t), intent(in) :: self    !! the settings
      type(item_t), intent(inout) :: item         !! [analysis.dynamic] as the deck has it

      type(option_t) :: limit(1), none(0)
      character(:), allocatable :: onset

      call put_word("method", self%method, none)
      call put_word("stabilise", self%stabilisation%name, self%stabilisation%options)
      call put_word("solver", self%solver%name, none)
      call put_word("coordinates", trim(merge("fewest", "full  ", self%is_reduced)), none)
      call put_word("groups", trim(merge("apart   ", "together", self%is_apart)), none)
      onset = trim(onset_words(self%controls%onset))
      if (onset == "reject") then
         limit(1) = new_option("limit", self%controls%onset_limit, dim_length)
         call put_word("contact_onset", onset, limit)
      else
         call put_word("contact_onset", onset, none)
      end if
      call put_number("tolerance", self%controls%tolerance)
      call put_number("step", self%controls%fixed_step)

   contains

      !> Write a word that was changed.
      subroutine put_word(key, word, options)
         character(*), intent(in) :: key                !! the key
         character(*), intent(in) :: word               !! its word; blank: the system decides
         type(option_t), intent(in) :: options(:)       !! (any) options after it

         associate (value => item%values(place_of(item, key)))
            if (value%text == word .or. (word == "" .and. value%text == chosen)) return
            value%text = word
            value%options = options
            value%given = .true.
         end associate
      end subroutine put_word

      !> Write a number that was changed.
      subroutine put_number(key, number)
         character(*), intent(in) :: key     !! the key
         real(wp), intent(in) :: number      !! its number [1 or s]

         associate (value => item%values(place_of(item, key)))
            if (.not. abs(value%number - number) > 0.0_wp) return
            value%number = number
            value%given = number > 0.0_wp
         end associate
      end subroutine put_number

   end subroutine write_integration

   !> An option with a number, as if it had been read.
   type(option_t) function new_option(name, number, dimension) result(option)
      character(*), intent(in) :: name           !! its name
      real(wp), intent(in) :: number             !! its value, SI [any]
      type(dim_t), intent(in) :: dimension       !! of the value

      option%name = name
      option%text = real_text(number, 6)//unit_text(dimension)
      option%number = number
      option%is_number = .true.
      option%dimension = dimension
   end function new_option

end module integration_settings
