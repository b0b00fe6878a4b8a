!> Forces and channels at an instant of a motion that joints and drivers determine: by inverse dynamics, with friction in joints by
!> the reactions that it gives.
!>
!> Source: Flores et al. (2008), section 2.5, eq. (2.14).
module kinematic_report
   use catalogue, only: catalogue_t
   use inverse_dynamics, only: find_reactions
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use mechanism_report, only: fill_catalogue
   use row_corrections, only: evaluate_rows
   implicit none (type, external)
   private
   public :: report_motion

contains

   !> Forces at an instant, and all values of the catalogue.
   subroutine report_motion(system, t, q, v, a, catalogue)
      type(mechanism_t), intent(inout) :: system        !! the system; its rows are evaluated
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: q(:)                      !! (n_q bodies) positions [any]
      real(wp), intent(in) :: v(:)                      !! (n_v bodies) velocities [m/s or rad/s]
      real(wp), intent(in), contiguous :: a(:)          !! (n_v bodies) accelerations [m/s^2 or rad/s^2]
      type(catalogue_t), intent(inout) :: catalogue     !! values

      integer, parameter :: most_turns = 100         ! of friction in joints and reactions, at most
      real(wp), parameter :: same = 1.0e-12_wp       ! change of friction forces that ends them, of the maximum [1]
      real(wp) :: change, unbalanced
      integer :: turn

      call evaluate_rows(system%linkage, t, q, v)
      call system%evaluate_loads(system%linkage%segment%inside(t))
      call find_reactions(system%linkage, system%loading%g, a, unbalanced)
      do turn = 1, merge(most_turns, 0, system%friction%rubbing%n > 0)  ! friction in joints, by the reactions that it gives
         call system%friction_by_multipliers(.true., turn > 1, change)
         call find_reactions(system%linkage, system%loading%g, a, unbalanced)
         if (change <= same) exit
      end do
      call fill_catalogue(system, t, [q, v], 0.0_wp, catalogue)
   end subroutine report_motion

end module kinematic_report
