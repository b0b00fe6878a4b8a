!> The right-hand side, and that of a planar scene none of whose bodies is unknown in full: each is known or guided
!> (`reduced_bodies`), nothing is solved, and a coordinate's acceleration follows from the loads at once.
!>
!> That is what `linkage_move`, `mechanism_evaluate_loads` and `rates` of the bodies with one degree of freedom do for every scene,
!> in the same order and with the same kernels; here these are inlined in one procedure. Such scenes are small, and a third of an
!> evaluation were calls and addresses. Loads are not gathered on the rates: who reads them there asks for that (`gather_loads`).
!>
!> Source: see `planar_prescribed`, `planar_one_dof`. Limits: nothing that has states or unknowns of its own but coordinates and
!> quadratures: no bristles, no contacts that stick, no joints with friction by multipliers, no correction of stages.
submodule(mechanism) mechanism_direct
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use clearance_set, only: clearance_slot_t, n_integrand, normal_impulse
   use joint_set, only: joint_slot_t
   use loading, only: loading_t, start_loads
   use mechanism_parts, only: clearance_joints_t
   use motion, only: loads_t, motion_t
   use planar_one_dof, only: planar_guide_t, planar_one_dof_t
   use planar_prescribed, only: planar_prescribed_t, planar_link_t
   use diverged_stages, only: overflow_limit
   implicit none (type, external)

contains

   !> Whether a scene is such a one.
   module procedure mechanism_choose_form
      logical :: is_plane

      associate (linkage => self%linkage, friction => self%friction)
         is_plane = .false.
         select type (known => linkage%reduced%known)
         type is (planar_prescribed_t)
            select type (one_dof => linkage%reduced%one_dof)
            type is (planar_one_dof_t)
               is_plane = one_dof%n > 0
            end select
         end select
         self%is_direct = is_plane .and. linkage%rows%n_unknown == 0 .and. linkage%rows%n_solve == 0 &
                          .and. .not. self%stabiliser%at_stages .and. friction%stick_slips%n_slip == 0 &
                          .and. friction%stick_slips%n_bristle == 0 .and. friction%rubbing%n == 0 .and. self%loading%states%n == 0
         self%traits%sees_diverged = self%is_direct
      end associate
   end procedure mechanism_choose_form

   !> Right-hand side. Status 1: singular or not a number, try a smaller step.
   module procedure mechanism_evaluate
      real(wp) :: inside

      ! in the smooth stretch: `smooth_segment`, without its call
      inside = min(max(t, self%linkage%segment%low), self%linkage%segment%high)
      self%n_evaluations = self%n_evaluations + 1
      if (self%is_direct) then
         call evaluate_directly(self, inside, y, ydot, status)
      else
         call evaluate_any(self, t, inside, y, ydot, status)
      end if
      if (status /= 0 .or. .not. self%traits%with_quadratures) return
      if (self%ledger%is_kept) then
         associate (one_dof => self%linkage%reduced%one_dof, last => self%linkage%n_position + self%linkage%n_rate)
            if (one_dof%n > 0) call one_dof%set_acceleration(ydot(last - one_dof%n + 1:), self%linkage%motion)
         end associate
         if (self%is_direct) call self%gather_loads()
         call self%ledger_rates(ydot(self%n - self%n_quadrature + 1:))
      end if
      call impulse_rates(self%n_impulse, self%clearance_joints%integrands, ydot(self%n - self%n_impulse + 1:))
      if (self%n_wear > 0) call self%wear_rates(ydot(self%place_of_wear(1):self%place_of_wear(self%n_wear)))

   contains

   !> Rates of the coordinates and their derivatives. Status 1 if they are wild, or a known motion is not finite.
   subroutine evaluate_directly(self, t, y, ydot, status)
      class(mechanism_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                  !! time, in the smooth stretch [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(inout) :: ydot(self%n)    !! (n) its derivative, but for quadratures [any]
      integer, intent(out) :: status             !! outcome

      status = 1
      associate (linkage => self%linkage, n_body => self%linkage%bodies%n, motion => self%linkage%motion, &
                 joints => self%linkage%joints)
         select type (known => linkage%reduced%known)
         type is (planar_prescribed_t)
            select type (one_dof => linkage%reduced%one_dof)
            type is (planar_one_dof_t)
               motion%t = t
               motion%number = motion%number + 1
               if (abs(t - known%t) > 0.0_wp) then
                  known%t = t
                  call place_bodies(known%n, known%item, size(joints), joints, t, n_body, motion%r, motion%rot, &
                                    motion%v, motion%omega, motion%angle, motion%a, motion%alpha, known%is_finite)
               end if
               if (.not. known%is_finite) return
               call place_one_dof(one_dof%n, one_dof%n_turning, one_dof%item, y, n_body, motion)
               call sum_loads(t, motion, n_body, self%loading, self%clearance_joints)
               call find_rates(one_dof%n, one_dof%item, n_body, self%loading%loads%force, self%loading%loads%moment, &
                               y(one_dof%n + 1:), overflow_limit, ydot, ydot(one_dof%n + 1:), status)
            end select
         end select
      end associate
   end subroutine evaluate_directly

   include "../../foundation/numerics/sine_cosine.inc"
   include "../reduction/planar_prescribed.inc"
   include "../reduction/planar_one_dof.inc"
   include "sum_loads.inc"
   include "impulse_rates.inc"

   !> Positions and velocities of the bodies with one degree of freedom.
   pure subroutine place_one_dof(n, n_turning, item, y, n_body, motion)
      integer, intent(in) :: n                              !! number of bodies with one degree of freedom
      integer, intent(in) :: n_turning                      !! those that turn
      type(planar_guide_t), intent(inout) :: item(n)        !! (n) the bodies, moved
      real(wp), intent(in) :: y(2*n)                        !! (2 n) coordinates and rates [rad or m, and per s]
      integer, intent(in) :: n_body                         !! number of bodies
      type(motion_t), intent(inout) :: motion               !! the motion of the bodies with one degree of freedom is set

      call place_turning(n_turning, item, y, y(n + 1:), n_body, motion%a, motion%alpha, motion%r, motion%rot, motion%v, &
                         motion%omega, motion%angle)
      call place_sliding(n_turning, n, item, y, y(n + 1:), n_body, motion%a, motion%alpha, motion%r, motion%rot, motion%v, &
                         motion%omega, motion%angle)
   end subroutine place_one_dof

   end procedure mechanism_evaluate

end submodule mechanism_direct
