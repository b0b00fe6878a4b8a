!> A number of a state whose derivatives are asked for: a channel, or force or penetration of a contact.
module observed
   use catalogue, only: catalogue_t
   use contact_peaks, only: look, trend_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use mechanism_report, only: report_state
   implicit none (type, external)
   private
   public :: observed_t

   !> Which number.
   type :: observed_t
      integer :: place = 0            !! of a channel: its place in the values of the catalogue
      integer :: slot = 0             !! of a contact: its set
      integer :: item = 0             !! contact of the set
      logical :: is_force = .true.    !! its normal force, else its penetration
   contains
      procedure :: at => observed_at
   end type observed_t

contains

   !> The number at a state. Status 0: done.
   subroutine observed_at(self, system, catalogue, t, y, ydot, x, status)
      class(observed_t), intent(in) :: self            !! which number
      type(mechanism_t), intent(inout) :: system       !! the system, left at the state
      type(catalogue_t), intent(inout) :: catalogue    !! of its channels, those bound that are asked for
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in), contiguous :: y(:)         !! (n) state [any]
      real(wp), intent(inout), contiguous :: ydot(:)   !! (n) scratch [any]
      type(trend_t), intent(out) :: x                  !! its value, and the rate of that of a contact
      integer, intent(out) :: status                   !! of the evaluation

      type(trend_t) :: force, penetration

      if (self%place > 0) then
         call report_state(system, t, y, ydot, 0.0_wp, catalogue, status)
         x%value = catalogue%values(self%place)
         return
      end if
      call system%evaluate(t, y, ydot, status)
      if (status /= 0) return
      call system%linkage%set_state(t, y, ydot)
      call look(system, self%slot, self%item, force, penetration)
      x = penetration
      if (self%is_force) x = force
   end subroutine observed_at

end module observed
