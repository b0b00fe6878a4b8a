!> What a contact loses while its force is cut off.
!>
!> A damped force F_N may be cut off at zero while the surfaces still overlap. From then on the motion does not feel the contact,
!> and steps are as long as it likes, but what is left of the stored energy U continues being lost: the power of the ledger is
!> (F_N - F_elastic) delta' = -dU/dt, a quadrature that no error norm holds. It needs none, for what is lost from one instant
!> without force to another is U at the one less U at the other. So the loss of a contact is
!>
!> z + amends                from a step that ends with a force: z the quadrature
!> held - U                  from the first to the last step end without a force, held = z + amends + U at either; not in a
!>                           row of the step before, where the force still acts
!>
!> with amends such that the one goes over into the other. The step in which the force is cut off is held to its error by the force
!> itself. A contact that ends puts its amends into the quadrature.
!> Limits: contacts that share what they store with others (`has_faces`) keep to the quadrature.
module cut_off
   use clearance_set, only: clearance_set_t
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: follow_cut_off, lost_by_damping

contains

   !> The end of a step: whether a touching contact feels a force there.
   subroutine follow_cut_off(set, k, delta, force, quadrature)
      class(clearance_set_t), intent(inout) :: set  !! the set
      integer, intent(in) :: k                      !! contact of the set
      real(wp), intent(in) :: delta                 !! its penetration [m]
      real(wp), intent(in) :: force                 !! its normal force [N]
      real(wp), intent(in) :: quadrature            !! z, its loss as the ledger has integrated it [J]

      real(wp) :: stored

      if (set%traits%has_faces) return
      associate (contact => set%contact(k))
         if (force > 0.0_wp) then
            contact%is_cut_off = .false.
            return
         end if
         stored = set%laws%normal%potential(max(delta, 0.0_wp), set%laws%parameters(:, k))
         if (contact%is_cut_off) contact%amends = contact%held - stored - quadrature
         contact%is_cut_off = .true.
         contact%held = quadrature + contact%amends + stored
      end associate
   end subroutine follow_cut_off

   !> What a contact has lost by damping since the start of the run, at a motion within the last step or at its end.
   real(wp) function lost_by_damping(set, k, motion, quadrature) result(lost)
      class(clearance_set_t), intent(in) :: set     !! the set
      integer, intent(in) :: k                      !! contact of the set
      type(motion_t), intent(in) :: motion          !! positions and velocities
      real(wp), intent(in) :: quadrature            !! z, its loss as the ledger has integrated it [J]

      real(wp) :: delta, force, force_rate, rate

      lost = quadrature
      associate (contact => set%contact(k))
         if (.not. contact%is_touching) return
         lost = quadrature + contact%amends
         if (.not. contact%is_cut_off) return
         call set%monitor(k, motion, delta, rate, force, force_rate)
         if (force > 0.0_wp) return  ! a row before the force vanishes at the end of the step
         lost = contact%held - set%laws%normal%potential(max(delta, 0.0_wp), set%laws%parameters(:, k))
      end associate
   end function lost_by_damping

end module cut_off
