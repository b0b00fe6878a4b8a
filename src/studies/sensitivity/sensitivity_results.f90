!> What is asked of a study of sensitivities, and what it finds.
module sensitivity_results
   use kinds, only: not_a_number, wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: asked_t, found_t, is_extreme, is_of_contact, sensitivity_plan_t, sensitivity_t
   public :: result_duration, result_impact_speed, result_maximum, result_minimum, result_names, result_onset, &
      result_peak_force, result_peak_penetration, result_release_speed, result_units, result_value, n_result_kind

   integer, parameter :: result_onset = 1             !! time of the N-th onset of a joint [s]
   integer, parameter :: result_impact_speed = 2      !! normal approach speed there [m/s]
   integer, parameter :: result_peak_force = 3        !! maximum normal force of the N-th contact [N]
   integer, parameter :: result_peak_penetration = 4  !! maximum penetration of it [m]
   integer, parameter :: result_duration = 5          !! time between its onset and its separation [s]
   integer, parameter :: result_release_speed = 6     !! normal separation speed [m/s]
   integer, parameter :: result_value = 7             !! a channel at a time [any]
   integer, parameter :: result_maximum = 8           !! maximum of a channel over the motion [any]
   integer, parameter :: result_minimum = 9           !! its minimum [any]
   integer, parameter :: n_result_kind = 9            !! kinds of results

   !> Their names in a deck; those of contacts stand behind the joint: `gudgeon.onset(2)`.
   character(*), parameter :: result_names(n_result_kind) = [character(16) :: "onset", "impact_speed", "peak_force", &
                                                             "peak_penetration", "duration", "release_speed", "at", "max", "min"]
   !> Their SI units; those of channels are the channels' own.
   character(*), parameter :: result_units(n_result_kind) = [character(3) :: "s", "m/s", "N", "m", "s", "m/s", "", "", ""]

   !> One result that is asked for.
   type :: asked_t
      character(:), allocatable :: word    !! as in the deck, one number of a range
      character(:), allocatable :: unit    !! SI
      integer :: kind = 0                  !! one of the above
      integer :: first = 0                 !! of a contact result: first contact of the joint among all
      integer :: last = 0                  !! the last one
      integer :: ordinal = 0               !! which of their onsets, from 1
      integer :: channel(3) = 0            !! (3) of a channel: group, component and item of the catalogue
      real(wp) :: t = 0.0_wp               !! of a value: when [s]
   end type asked_t

   !> What is asked for.
   type :: sensitivity_plan_t
      type(asked_t), allocatable :: results(:)      !! (results) in the order of the deck
      type(text_t), allocatable :: parameters(:)    !! (parameters) their names
      type(text_t), allocatable :: units(:)         !! (parameters) SI
      real(wp), allocatable :: values(:)            !! (parameters) in the deck [any]
      real(wp), allocatable :: spans(:)             !! (parameters) what their changes are measured by; none: their values [any]
      real(wp) :: tolerance = 0.0_wp                !! of the motion [1]
      real(wp) :: end = 0.0_wp                      !! of the motion [s]
   end type sensitivity_plan_t

   !> What one motion gives.
   type :: found_t
      logical, allocatable :: is_found(:)           !! (results) whether the motion has it
      real(wp), allocatable :: t(:)                 !! (results) when [s]
      real(wp), allocatable :: value(:)             !! (results) [any]
      real(wp), allocatable :: derivative(:, :)     !! (parameters, results) NaN: none [any]
      type(text_t), allocatable :: reason(:)        !! (parameters) why derivatives end at some time; blank: they do not
      real(wp), allocatable :: until(:)             !! (parameters) that time [s]
      real(wp), allocatable :: grazing(:)           !! (parameters) minimum change at which a contact would graze; huge: none [any]
      real(wp), allocatable :: onset(:)             !! (any) times of all onsets [s]
      integer, allocatable :: contact(:)            !! (any) contacts of the onsets
      real(wp), allocatable :: speed(:)             !! (any) their impact speeds [m/s]
      integer :: n_step = 0                         !! steps of the motion
      integer :: n_event = 0                        !! events
   contains
      procedure :: start => start_found
   end type found_t

   !> The study.
   type :: sensitivity_t
      type(sensitivity_plan_t) :: plan              !! what was asked for
      real(wp), allocatable :: t(:)                 !! (results) when; NaN: the motion has none [s]
      real(wp), allocatable :: value(:)             !! (results) the result itself [any]
      real(wp), allocatable :: value_error(:)       !! (results) its estimated error [any]
      real(wp), allocatable :: derivative(:, :)     !! (parameters, results) NaN: refused [any]
      real(wp), allocatable :: error(:, :)          !! (parameters, results) estimated error [any]
      type(text_t), allocatable :: reason(:, :)     !! (parameters, results) why it is refused; blank: it is not
      real(wp), allocatable :: grazing(:)           !! (parameters) as of the motion [any]
      real(wp) :: horizon = huge(1.0_wp)            !! beyond it the contact sequence is not known; huge: known to the end [s]
      integer :: n_step = 0                         !! steps of the motion
      integer :: n_event = 0                        !! its events
   end type sensitivity_t

contains

   !> Nothing is found yet.
   subroutine start_found(self, n_result, n_parameter)
      class(found_t), intent(inout) :: self   !! what a motion gives
      integer, intent(in) :: n_result         !! results asked for
      integer, intent(in) :: n_parameter      !! parameters

      integer :: k

      allocate (self%is_found(n_result), source=.false.)
      allocate (self%t(n_result), self%value(n_result), self%derivative(n_parameter, n_result), source=not_a_number())
      allocate (self%until(n_parameter), self%grazing(n_parameter), source=huge(1.0_wp))
      allocate (self%reason(n_parameter), self%onset(0), self%contact(0), self%speed(0))
      do k = 1, n_parameter
         self%reason(k)%s = ""
      end do
   end subroutine start_found

   !> Whether a kind of results belongs to contacts.
   elemental logical function is_of_contact(kind)
      integer, intent(in) :: kind    !! of a result

      is_of_contact = kind < result_value
   end function is_of_contact

   !> Whether a kind of results is an extreme of a channel.
   elemental logical function is_extreme(kind)
      integer, intent(in) :: kind    !! of a result

      is_extreme = kind > result_value
   end function is_extreme

end module sensitivity_results
