!> A member that is assembled: its mechanism is built from the deck with the parameters that were drawn, and closed at every output
!> time from a prediction to first order.
module exact_member
   use errors, only: error_t
   use expansion, only: predicted_positions
   use kinds, only: not_a_number, wp
   use mechanism_source, only: mechanism_source_t
   use prescribed_motion, only: solved
   use sensitivities, only: pin_rows
   use tolerance_plan, only: pin_force
   use tolerance_results, only: tolerance_study_t
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: assemble_member

contains

   !> Channels of a member at all output times. A deck that has errors with its values cannot be assembled either.
   subroutine assemble_member(source, study, deviations, units, values, is_open)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(in) :: study         !! the study
      real(wp), intent(in) :: deviations(:)                !! (parameters) deviations [any]
      real(wp), intent(in) :: units(:, :)                  !! (2, pins) displacements, of the clearances; those by forces follow [1]
      real(wp), intent(out) :: values(:, :)                !! (requests, times) values; NaN where it cannot be assembled [any]
      logical, intent(out) :: is_open                      !! it cannot be assembled at some time

      type(error_t), allocatable :: error
      type(varied_t) :: varied
      real(wp) :: clearances(size(study%pins)), displaced(2, size(study%pins)), q(size(study%derivatives%instants(1)%q))
      real(wp), allocatable :: e(:)
      integer :: at, k, outcome, rows(2)

      values = not_a_number()
      is_open = .true.
      call source%build(deviations, varied, clearances, error)
      if (allocated(error)) return
      if (any(clearances < 0.0_wp)) return
      is_open = .false.
      allocate (e(varied%system%linkage%rows%n), source=0.0_wp)
      do at = 1, size(study%derivatives%instants)
         do k = 1, size(study%pins)
            displaced(:, k) = clearances(k)*units(:, k)
            if (study%pins(k)%position == pin_force) displaced(:, k) = clearances(k)*study%derivatives%directions(:, k, at)
            rows = pin_rows(varied, study%pins(k))
            e(rows) = displaced(:, k)
         end do
         associate (instant => study%derivatives%instants(at))
            call predicted_positions(study%derivatives, at, varied, deviations, displaced, q)
            call varied%assemble(instant, e, q, outcome)
            if (outcome == solved) call varied%values_at(instant, q, values(:, at), outcome)
            if (outcome /= solved) values(:, at) = not_a_number()
            is_open = is_open .or. outcome /= solved
            call varied%follow()
         end associate
      end do
   end subroutine assemble_member

end module exact_member
