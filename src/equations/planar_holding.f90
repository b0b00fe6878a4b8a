!> The correction of states at the ends of steps, with its place in the ledger.
submodule(planar_system) planar_holding
   use planar_energy, only: mechanical_energy
   implicit none (type, external)

contains

   !> Correct a state at the end of a step; what that does to the energy is work of the stabilisation.
   module procedure planar_hold
      class(hold_t), allocatable :: way
      real(wp) :: before
      integer :: z

      call self%set_motion(t, y)
      before = 0.0_wp
      if (self%with_ledger) before = mechanical_energy(self)
      call move_alloc(self%way, way)  ! the system that it corrects must not hold it too
      call way%correct_step(self, t, y, status)
      call move_alloc(way, self%way)
      if (status /= 0 .or. .not. self%with_ledger) return
      z = 2*self%n_position + work_stabilisation
      y(z) = y(z) + (mechanical_energy(self) - before)
   end procedure planar_hold

end submodule planar_holding
