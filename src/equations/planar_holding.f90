!> The correction of states at the ends of steps, with its place in the ledger.
submodule(planar_system) planar_holding
   use hold_projection, only: hold_projection_t
   use planar_energy, only: mechanical_energy
   implicit none (type, external)

contains

   !> Correct a state at the end of a step.
   module procedure planar_hold
      class(hold_t), allocatable :: way

      call move_alloc(self%way, way)  ! the system that it corrects must not hold it too
      call correct_by(way, self, t, y, status)
      call move_alloc(way, self%way)
   end procedure planar_hold

   !> Project a state that was made by interpolation, in whatever way the constraints are held.
   module procedure planar_mend
      type(hold_projection_t) :: projection

      status = 0
      if (self%rows%n_solve > 0) call correct_by(projection, self, t, y, status)
   end procedure planar_mend

   !> Correct a state; what that does to the energy is work of the stabilisation.
   subroutine correct_by(way, system, t, y, status)
      class(hold_t), intent(inout) :: way               !! how
      class(planar_system_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(inout), contiguous :: y(:)       !! (n) state [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp) :: before
      integer :: z

      call system%set_motion(t, y)
      before = 0.0_wp
      if (system%with_ledger) before = mechanical_energy(system)
      call way%correct_step(system, t, y, status)
      if (status /= 0 .or. .not. system%with_ledger) return
      z = system%n - system%n_quadrature + work_stabilisation
      y(z) = y(z) + (mechanical_energy(system) - before)
   end subroutine correct_by

end submodule planar_holding
