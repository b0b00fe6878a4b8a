!> Scenes of a deck along a branch, as `--set` gives them, each with the period that its section [orbit] has then.
module deck_orbits
   use changed_deck, only: change_parameter, changed_deck_t
   use diagnostics, only: diagnostics_t
   use errors, only: error_t
   use item, only: item_t, place_of
   use jobs, only: copy_job, first_line, job_t
   use kinds, only: wp
   use options, only: options_t
   use orbit_info, only: orbit_section
   use orbit_results, only: orbit_plan_t
   use orbit_source, only: orbit_source_t
   use settings, only: read_settings
   use text, only: exact_text
   use time_plan, only: seconds
   implicit none (type, external)
   private
   public :: deck_orbits_t

   !> A deck. Its options and the plan are set before the first scene is asked for.
   type, extends(orbit_source_t) :: deck_orbits_t
      type(changed_deck_t) :: deck           !! the deck with the last value
      type(orbit_plan_t) :: plan             !! for name and unit of the parameter
      logical :: is_known = .false.          !! the deck took this value
      real(wp) :: p = 0.0_wp                 !! this value [any]
      real(wp) :: period = 0.0_wp            !! and its period [s]
   contains
      procedure :: scene_at => deck_scene_at
   end type deck_orbits_t

contains

   !> The scene with another value of the parameter.
   subroutine deck_scene_at(self, p, job, period, reason)
      class(deck_orbits_t), intent(inout) :: self         !! the deck
      real(wp), intent(in) :: p                           !! value of the parameter, SI; not used without one [any]
      type(job_t), intent(inout) :: job                   !! the scene with it
      real(wp), intent(out) :: period                     !! of its drivers [s]
      character(:), allocatable, intent(out) :: reason    !! what the deck says of the value; blank: it takes it

      type(error_t), allocatable :: error
      type(diagnostics_t) :: mistakes
      type(item_t) :: keys
      type(options_t) :: options
      logical :: has_section

      reason = ""
      period = self%period
      if (.not. self%is_known .or. abs(p - self%p) > 0.0_wp) then
         options = self%deck%options
         if (self%plan%parameter /= "") call change_parameter(options, self%plan%parameter, p, self%plan%unit)
         call self%deck%load(options, error)
         if (.not. allocated(error)) then
            associate (loaded => self%deck%loaded)
               call read_settings(loaded%deck, orbit_section(), keys, has_section, mistakes)
               if (mistakes%count() == 0) then
                  period = seconds(keys%values(place_of(keys, "period")), "period", -1.0_wp, loaded%system, mistakes)
               end if
               call mistakes%to_error(loaded%deck%sources, error)
            end associate
         end if
         self%is_known = .not. allocated(error)
         if (allocated(error)) then
            reason = "the deck does not take "//exact_text(p)//" "//self%plan%unit//": "//first_line(error%message)
            return
         end if
         self%p = p
         self%period = period
      end if
      call copy_job(self%deck%loaded%job_t, job)
   end subroutine deck_scene_at

end module deck_orbits
