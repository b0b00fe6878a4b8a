!> A ray from the centre of a worn hole through a worn pin: how far the surfaces overlap along it, and how that changes.
!>
!> e the pin's centre from the hole's, u = (cos, sin)(theta), q = e . R90 u,  chi = theta - asin(q/r) - alpha_j  the place on the pin:
!>
!> d(theta) = e . u + S - R - h_i(theta - alpha_i),   S = sqrt(rho^2 - q^2),   rho = r - h_j(chi)
!> d_e = u + w R90 u,  w = (rho h_j'/(r cos(psi)) - q)/S,  sin(psi) = q/r;   d_alpha_i = h_i',  d_alpha_j = rho h_j'/S
!>
!> Derivatives by theta and, along a motion at a fixed theta, by time follow by the chain rule.
!> Signs: d > 0 where the surfaces overlap; angles counter-clockwise, of the world; alpha the angles of the bodies.
!> Source: this program. Limits: |e| < r; depths are small against the radii (chi is that of the new pin).
module overlap_rays
   use kinds, only: wp
   use surfaces, only: surfaces_t
   use surface_profile, only: depth_t, place_t
   implicit none (type, external)
   private
   public :: find_ray, pin_t, quick_ray, ray_t

   !> Where a pin is in its hole, and how it moves.
   type :: pin_t
      real(wp) :: e(2) = 0.0_wp          !! (2) its centre from the hole's, axes of the world or of the hole's body [m]
      real(wp) :: e_dot(2) = 0.0_wp      !! (2) its rate [m/s]
      real(wp) :: e_ddot(2) = 0.0_wp     !! (2) and its second derivative [m/s^2]
      real(wp) :: angle(2) = 0.0_wp      !! (2) alpha of the bodies of hole and pin [rad]
      real(wp) :: omega(2) = 0.0_wp      !! (2) their rates [rad/s]
      real(wp) :: alpha(2) = 0.0_wp      !! (2) and their second derivatives [rad/s^2]
      real(wp) :: distance = 0.0_wp      !! |e| [m]
      real(wp) :: phi = 0.0_wp           !! direction of e; of its rate where e is zero [rad]
   end type pin_t

   !> One ray.
   type :: ray_t
      real(wp) :: theta = 0.0_wp         !! its direction [rad]
      real(wp) :: chi = 0.0_wp           !! where it leaves the pin, frame of the pin's body [rad]
      real(wp) :: u(2) = 0.0_wp          !! (2) along it [1]
      real(wp) :: d = 0.0_wp             !! overlap, negative: a gap [m]
      real(wp) :: slope = 0.0_wp         !! its derivative by theta [m/rad]
      real(wp) :: bend = 0.0_wp          !! and the second one [m/rad^2]
      real(wp) :: w = 0.0_wp             !! of the derivative by e, see above [1]
      real(wp) :: by_i = 0.0_wp          !! derivative of d by alpha_i [m/rad]
      real(wp) :: by_j = 0.0_wp          !! and by alpha_j [m/rad]
      real(wp) :: h_j = 0.0_wp           !! depth of the pin there [m]
      real(wp) :: d_dot = 0.0_wp         !! rate of d [m/s]
      real(wp) :: d_ddot = 0.0_wp        !! its second derivative [m/s^2]
      real(wp) :: w_dot = 0.0_wp         !! rate of w [1/s]
      real(wp) :: h_j_dot = 0.0_wp       !! rate of the depth [m/s]
      real(wp) :: h_j_slope = 0.0_wp     !! its derivative by theta [m/rad]
      real(wp) :: slope_dot = 0.0_wp     !! rate of the slope [m/(rad.s)]
      real(wp) :: w_slope = 0.0_wp       !! derivative of w by theta [1/rad]
   end type ray_t

contains

   !> The ray through a place of the hole where the pin is round, up to the slope. `theta` is left alone.
   pure subroutine quick_ray(pair, pin, place, ray)
      type(surfaces_t), intent(in) :: pair   !! the surfaces, the pin round
      type(pin_t), intent(in) :: pin         !! where the pin is, frame of the hole
      type(place_t), intent(in) :: place     !! the place
      type(ray_t), intent(inout) :: ray      !! set

      real(wp) :: q, root, s, versine

      ray%u = place%u
      s = pin%e(1)*place%u(1) + pin%e(2)*place%u(2)
      q = pin%e(2)*place%u(1) - pin%e(1)*place%u(2)
      versine = pin%distance - s
      if (s > 0.0_wp) versine = q**2/(pin%distance + s)
      root = sqrt(pair%radius_j**2 - q**2)
      ray%d = pin%distance - pair%clearance - versine - q**2/(pair%radius_j + root) - place%h
      ray%w = -q/root
      ray%slope = q + q*s/root - place%slope
      ray%by_i = place%slope
   end subroutine quick_ray

   !> The ray in a direction. `with_motion` asks for what changes with time, `with_bend` for derivatives by theta beyond the first.
   pure subroutine find_ray(pair, pin, theta, cell, with_motion, with_bend, ray)
      type(surfaces_t), intent(in) :: pair   !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! the direction [rad]
      integer, intent(in) :: cell(2)         !! cells of hole and pin it is in, from 0, any turn
      logical, intent(in) :: with_motion     !! rates too
      logical, intent(in) :: with_bend       !! second derivatives by theta too
      type(ray_t), intent(inout) :: ray      !! set

      type(depth_t) :: hole, surface
      real(wp) :: c_psi, q, rho, root, s, versine, x

      ray%theta = theta
      ray%u = [cos(theta), sin(theta)]
      s = pin%e(1)*ray%u(1) + pin%e(2)*ray%u(2)
      q = pin%e(2)*ray%u(1) - pin%e(1)*ray%u(2)
      associate (r => pair%radius_j)
         if (s > 0.0_wp) then
            versine = q**2/(pin%distance + s)  ! |e| - s without cancellation
         else
            versine = pin%distance - s
         end if
         hole = pair%worn%hole%at(theta - pin%angle(1), cell(1))
         ray%by_i = hole%slope
         if (pair%worn%pin%is_round()) then
            root = sqrt(r**2 - q**2)
            ray%d = pin%distance - pair%clearance - versine - q**2/(r + root) - hole%h
            ray%w = -q/root
            ray%slope = q + q*s/root - hole%slope
            if (with_bend) then
               x = q*s/root
               ray%bend = -s + (q**2 - s**2 - x**2)/root - hole%bend
               ray%w_slope = s/root - ray%w*x/root
            end if
            if (with_motion) call follow_ray(pair, pin, ray, q, s, 1.0_wp, r, root, hole, surface)
            return
         end if
         x = q/r
         c_psi = sqrt(1.0_wp - x**2)
         ray%chi = theta - asin(x) - pin%angle(2)
         surface = pair%worn%pin%at(ray%chi, cell(2))
         ray%h_j = surface%h
         rho = r - surface%h
         root = sqrt(rho**2 - q**2)
         ray%d = pin%distance - pair%clearance - versine - (q**2 + surface%h*(2.0_wp*r - surface%h))/(r + root) - hole%h
         ray%w = (rho*surface%slope/(r*c_psi) - q)/root
         ray%by_j = rho*surface%slope/root
         x = 1.0_wp + s/(r*c_psi)  ! of chi by theta
         ray%slope = q + (q*s - rho*surface%slope*x)/root - hole%slope
         if (with_bend) call bend_worn(r, c_psi, q, s, rho, root, x, hole, surface, ray)
         if (with_motion) call follow_ray(pair, pin, ray, q, s, c_psi, rho, root, hole, surface)
      end associate
   end subroutine find_ray

   !> Derivatives by theta where the pin is worn.
   pure subroutine bend_worn(r, c_psi, q, s, rho, root, x, hole, surface, ray)
      real(wp), intent(in) :: r              !! radius of the new pin [m]
      real(wp), intent(in) :: c_psi          !! cos(psi) [1]
      real(wp), intent(in) :: q              !! e . R90 u [m]
      real(wp), intent(in) :: s              !! e . u [m]
      real(wp), intent(in) :: rho            !! radius of the worn pin [m]
      real(wp), intent(in) :: root           !! S [m]
      real(wp), intent(in) :: x              !! derivative of chi by theta [1]
      type(depth_t), intent(in) :: hole      !! depth of the hole
      type(depth_t), intent(in) :: surface   !! depth of the pin
      type(ray_t), intent(inout) :: ray      !! bend, w_slope and h_j_slope are set

      real(wp) :: c_slope, rho_bend, rho_slope, root_slope, x_slope

      c_slope = q*s/(r**2*c_psi)
      x_slope = q/(r*c_psi) - s*c_slope/(r*c_psi**2)
      rho_slope = -surface%slope*x
      ray%h_j_slope = -rho_slope
      rho_bend = -surface%bend*x**2 - surface%slope*x_slope
      root_slope = (rho*rho_slope + q*s)/root
      ray%bend = -s + (rho_slope**2 + rho*rho_bend + q**2 - s**2 - root_slope**2)/root - hole%bend
      ray%w_slope = ((rho_slope*surface%slope + rho*surface%bend*x)/(r*c_psi) - rho*surface%slope*c_slope/(r*c_psi**2) + s)/root &
                    - ray%w*root_slope/root
   end subroutine bend_worn

   !> What changes with time, at a fixed direction.
   pure subroutine follow_ray(pair, pin, ray, q, s, c_psi, rho, root, hole, surface)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      type(ray_t), intent(inout) :: ray      !! rates are set
      real(wp), intent(in) :: q              !! e . R90 u [m]
      real(wp), intent(in) :: s              !! e . u [m]
      real(wp), intent(in) :: c_psi          !! cos(psi) [1]
      real(wp), intent(in) :: rho            !! radius of the worn pin [m]
      real(wp), intent(in) :: root           !! S [m]
      type(depth_t), intent(in) :: hole      !! depth of the hole
      type(depth_t), intent(in) :: surface   !! depth of the pin

      real(wp) :: chi_ddot, chi_dot, q_ddot, q_dot, rho_ddot, rho_dot, root_ddot, root_dot, x

      associate (r => pair%radius_j)
         q_dot = pin%e_dot(2)*ray%u(1) - pin%e_dot(1)*ray%u(2)
         q_ddot = pin%e_ddot(2)*ray%u(1) - pin%e_ddot(1)*ray%u(2)
         chi_dot = -q_dot/(r*c_psi) - pin%omega(2)
         chi_ddot = -q_ddot/(r*c_psi) - q*q_dot**2/(r*c_psi)**3 - pin%alpha(2)
         rho_dot = -surface%slope*chi_dot
         rho_ddot = -surface%bend*chi_dot**2 - surface%slope*chi_ddot
         root_dot = (rho*rho_dot - q*q_dot)/root
         root_ddot = (rho_dot**2 + rho*rho_ddot - q_dot**2 - q*q_ddot - root_dot**2)/root
         ray%d_dot = pin%e_dot(1)*ray%u(1) + pin%e_dot(2)*ray%u(2) + root_dot + hole%slope*pin%omega(1)
         ray%d_ddot = pin%e_ddot(1)*ray%u(1) + pin%e_ddot(2)*ray%u(2) + root_ddot - hole%bend*pin%omega(1)**2 &
                      + hole%slope*pin%alpha(1)
         ray%w_dot = (rho_dot*surface%slope/(r*c_psi) + rho*surface%bend*chi_dot/(r*c_psi) &
                      + rho*surface%slope*q*q_dot/(r*c_psi)**3 - q_dot)/root - ray%w*root_dot/root
         ray%h_j_dot = -rho_dot
         x = 1.0_wp + s/(r*c_psi)
         ! of the slope: d_e . e' + omega_i h_i' + omega_j rho h_j'/S, differentiated by theta
         associate (across => q_dot, along => pin%e_dot(1)*ray%u(1) + pin%e_dot(2)*ray%u(2))
            ray%slope_dot = across - along*ray%w + across*ray%w_slope + pin%omega(1)*hole%bend
         end associate
         root_dot = (q*s - rho*surface%slope*x)/root  ! S by theta
         ray%slope_dot = ray%slope_dot + pin%omega(2)*((-surface%slope**2 + rho*surface%bend)*x/root &
                                                       - rho*surface%slope*root_dot/root**2)
      end associate
   end subroutine follow_ray

end module overlap_rays
