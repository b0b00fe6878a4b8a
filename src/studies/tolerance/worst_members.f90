!> The members with the lowest and the highest value of each channel, at the time that is shown of it.
!>
!> Their numbers are kept while members are taken; what was drawn for them follows from these, by the same random numbers. Members
!> that cannot be assembled, or whose run failed, are omitted. Limits: pins at their worst place have no displacement.
module worst_members
   use kinds, only: i8, not_a_number, wp
   use member_draws, only: draw_t, stream_members
   use tolerance_plan, only: pin_force
   use tolerance_results, only: tolerance_study_t, worst_t
   implicit none (type, external)
   private
   public :: find_worst, keep_worst

contains

   !> Compare a block of members with those that are kept. Of equal ones the first is kept.
   pure subroutine keep_worst(values, is_open, n_before, kept)
      real(wp), intent(in) :: values(:)          !! (members) of the channel [any]
      logical, intent(in) :: is_open(:)          !! (members) which have none
      integer(i8), intent(in) :: n_before        !! members before this block
      type(worst_t), intent(inout) :: kept(2)    !! (2) lowest, highest

      integer :: m

      do m = 1, size(values)
         if (is_open(m)) cycle
         if (kept(1)%number == 0_i8 .or. values(m) < kept(1)%value) kept(1) = worst_t(n_before + m, values(m))
         if (kept(2)%number == 0_i8 .or. values(m) > kept(2)%value) kept(2) = worst_t(n_before + m, values(m))
      end do
   end subroutine keep_worst

   !> What was drawn for the members that are kept: deviations of parameters, displacements of pins.
   subroutine find_worst(study, draw)
      type(tolerance_study_t), intent(inout) :: study   !! the study; deviations and displacements are set
      type(draw_t), intent(in) :: draw                  !! draws its members

      real(wp) :: clearances(size(study%pins)), deviations(size(study%plan%parameters)), u(draw%n), units(2, size(study%pins))
      integer :: i, k, r

      associate (members => study%members)
         allocate (members%worst_deviations(size(deviations), 2, size(members%at)), &
                   members%worst_pins(2, size(clearances), 2, size(members%at)), source=not_a_number())
         do r = 1, size(members%at)
            do i = 1, 2
               if (members%worst(i, r)%number == 0_i8) cycle
               call draw%numbers(stream_members, members%worst(i, r)%number, u)
               call draw%make(study, 1, u, deviations, units, clearances)
               members%worst_deviations(:, i, r) = deviations
               do k = 1, size(clearances)
                  if (study%pins(k)%position == pin_force) units(:, k) = study%derivatives%directions(:, k, members%at(r))
                  members%worst_pins(:, k, i, r) = clearances(k)*units(:, k)
               end do
            end do
         end do
      end associate
   end subroutine find_worst

end module worst_members
