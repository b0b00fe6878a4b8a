!> The correction of states at the ends of steps, with its place in the ledger.
submodule(mechanism) mechanism_holding
   use contact_places, only: work_stabilisation
   use stabilisation_projection, only: stabilisation_projection_t
   use mechanism_energy, only: mechanical_energy
   implicit none (type, external)

contains

   !> Move the bodies to a state as the stabilisation method corrects it.
   module procedure move_corrected
      self%held(:) = y(:size(self%held))
      call self%stabiliser%correct_stage(self%linkage, t, self%held, status)
      if (status == 0) call self%linkage%set_motion(t, self%held)
   end procedure move_corrected

   !> Correct a state at the end of a step.
   module procedure mechanism_stabilise
      real(wp) :: before

      before = energy_before(self, t, y)
      call self%stabiliser%correct_step(self%linkage, t, y, status)
      if (status == 0) call book(self, before, y)
   end procedure mechanism_stabilise

   !> Project a state that was made by interpolation, in whatever way the constraints are held.
   module procedure mechanism_project
      type(stabilisation_projection_t) :: projection
      real(wp) :: before

      status = 0
      if (self%linkage%rows%n_solve == 0) return
      before = energy_before(self, t, y)
      call projection%correct_step(self%linkage, t, y, status)
      if (status == 0) call book(self, before, y)
   end procedure mechanism_project

   !> Mechanical energy of a state that is to be corrected; nothing without a ledger. The motion is set.
   real(wp) function energy_before(self, t, y) result(before)
      class(mechanism_t), intent(inout) :: self     !! the system
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: y(:)                      !! (n) state [any]

      call self%linkage%set_motion(t, y)
      before = 0.0_wp
      if (self%ledger%is_kept) before = mechanical_energy(self)
   end function energy_before

   !> What a correction did to the energy is work of the stabilisation.
   subroutine book(self, before, y)
      class(mechanism_t), intent(inout) :: self     !! the system, its motion that of the corrected state
      real(wp), intent(in) :: before                    !! energy before the correction [J]
      real(wp), intent(inout) :: y(:)                   !! (n) state [any]

      integer :: z

      if (.not. self%ledger%is_kept) return
      z = self%in_state(work_stabilisation)
      y(z) = y(z) + (mechanical_energy(self) - before)
   end subroutine book

end submodule mechanism_holding
