!> Scenes of a deck for a fit: parameters of a set of data and values of the unknowns, as `--set` gives them.
module fit_deck
   use changed_deck, only: changed_deck_t
   use dimension_text, only: unit_text
   use errors, only: error_t
   use fit_plan, only: fit_plan_t
   use fit_source, only: fit_source_t
   use jobs, only: copy_job, first_line, job_t
   use kinds, only: wp
   use options, only: options_t
   use text, only: append_text, exact_text
   implicit none (type, external)
   private
   public :: fit_deck_t

   !> A deck. Its options, with one operand, and the plan are set before the first scene is asked for.
   type, extends(fit_source_t) :: fit_deck_t
      type(changed_deck_t) :: deck           !! the deck with the last values
      type(fit_plan_t) :: plan               !! names and units of the unknowns, changes of the sets
   contains
      procedure :: make => make_scene
   end type fit_deck_t

contains

   !> The scene of the set and values in hand, one of these changed.
   subroutine make_scene(self, parameter, value, job, reason)
      class(fit_deck_t), intent(inout) :: self            !! the deck
      integer, intent(in) :: parameter                    !! number of the parameter that is changed; 0: none
      real(wp), intent(in) :: value                       !! its value, SI [any]
      type(job_t), intent(inout) :: job                   !! the scene with it
      character(:), allocatable, intent(out) :: reason    !! what the deck says of the value; blank: it takes it

      type(error_t), allocatable :: error
      type(options_t) :: options
      integer :: k

      options = self%deck%options
      do k = 1, size(self%plan%sets(self%set)%changes)
         call append_text(options%change%overrides, self%plan%sets(self%set)%changes(k)%s)
      end do
      do k = 1, size(self%values)
         associate (unknown => self%plan%unknowns(k))
            call append_text(options%change%overrides, unknown%name//"="// &
                             exact_text(merge(value, self%values(k), k == parameter))//" "//unit_text(unknown%dimension))
         end associate
      end do
      call self%deck%load(options, error)
      reason = ""
      if (allocated(error)) then
         reason = "the deck does not take the values: "//first_line(error%message)
      else
         call copy_job(self%deck%loaded%job_t, job)
      end if
   end subroutine make_scene

end module fit_deck
