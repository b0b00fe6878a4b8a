!> A ray from the centre of a worn hole through a worn pin: how far the surfaces overlap along it, and how that changes.
!>
!> e the pin's centre from the hole's, u = (cos, sin)(theta), q = e . R90 u,  chi = theta - x - x^3/6 - alpha_j,  x = q/r,  the
!> place on the pin, f = (1 + x^2/2)/r:
!>
!> d(theta) = e . u + S - R - h_i(theta - alpha_i),   S = sqrt(rho^2 - q^2),   rho = r - h_j(chi)
!> d_e = u + w R90 u,  w = (rho h_j' f - q)/S;   d_alpha_i = h_i',  d_alpha_j = rho h_j'/S
!>
!> Derivatives by theta and, along a motion at a fixed theta, by time follow by the chain rule.
!> Signs: d > 0 where the surfaces overlap; angles counter-clockwise, of the world; alpha the angles of the bodies.
!> Source: this program. Limits: |e| < r; depths are small against the radii, and so is |e|: chi is that of
!> the new pin to the fifth power of x.
module overlap_rays
   use kinds, only: wp
   use surfaces, only: surfaces_t
   use surface_profile, only: depth_t, most_places
   implicit none (type, external)
   private
   public :: find_ray, find_rays, pin_t, ray_t, rays_t

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
      real(wp) :: u(2) = 0.0_wp          !! (2) along it [1]
      real(wp) :: d = 0.0_wp             !! overlap, negative: a gap [m]
      real(wp) :: slope = 0.0_wp         !! its derivative by theta [m/rad]
      real(wp) :: bend = 0.0_wp          !! and the second one [m/rad^2]
      real(wp) :: w = 0.0_wp             !! of the derivative by e, see above [1]
      real(wp) :: by_i = 0.0_wp          !! derivative of d by alpha_i [m/rad]
      real(wp) :: by_j = 0.0_wp          !! and by alpha_j [m/rad]
      real(wp) :: h_j = 0.0_wp           !! depth of the pin there [m]
      real(wp) :: h_j_by(2) = 0.0_wp     !! (2) its derivatives by theta and by time [m/rad, m/s]
      real(wp) :: d_dot = 0.0_wp         !! rate of d [m/s]
      real(wp) :: d_ddot = 0.0_wp        !! its second derivative [m/s^2]
      real(wp) :: w_dot = 0.0_wp         !! rate of w [1/s]
      real(wp) :: slope_dot = 0.0_wp     !! rate of the slope [m/(rad.s)]
      real(wp) :: w_slope = 0.0_wp       !! derivative of w by theta [1/rad]
   end type ray_t

   !> Many rays through places of the hole.
   type :: rays_t
      integer :: n = 0                   !! how many
      real(wp) :: d(most_places)           !! (n) overlap [m]
      real(wp) :: slope(most_places)       !! (n) its derivative by theta [m/rad]
      real(wp) :: w(most_places)           !! (n) of the derivative by e [1]
      real(wp) :: chi(most_places)         !! (n) angle where they leave the pin, frame of its body, any turn [rad]
      real(wp) :: by_j(most_places)        !! (n) derivative of d by alpha_j [m/rad]
      real(wp) :: h_j(most_places)         !! (n) depth of the pin there [m]
      real(wp) :: d_dot(most_places)       !! (n) rate of d, if asked for [m/s]
      real(wp) :: w_dot(most_places)       !! (n) rate of w, if asked for [1/s]
      real(wp) :: h_j_dot(most_places)     !! (n) rate of h_j, if asked for [m/s]
      real(wp) :: d_ddot(most_places)      !! (n) second derivative of d by time, if asked for [m/s^2]
   end type rays_t

contains

   !> Rays through places of the hole.
   pure subroutine find_rays(pair, pin, n, theta, u_x, u_y, h, slope, hole_bend, with_motion, rays)
      type(surfaces_t), intent(in) :: pair   !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin         !! where the pin is, axes of the hole's body
      integer, intent(in) :: n               !! how many, `most_places` at most
      real(wp), intent(in) :: theta(n)       !! (n) their directions [rad]
      real(wp), intent(in) :: u_x(n)         !! (n) cosines of these [1]
      real(wp), intent(in) :: u_y(n)         !! (n) sines [1]
      real(wp), intent(in) :: h(n)           !! (n) depths of the hole there [m]
      real(wp), intent(in) :: slope(n)       !! (n) their derivatives by theta [m/rad]
      real(wp), intent(in) :: hole_bend(n)   !! (n) and the second ones [m/rad^2]
      logical, intent(in) :: with_motion     !! rates too
      type(rays_t), intent(inout) :: rays    !! set

      real(wp), dimension(most_places) :: bend, f, h_slope, q, rho, root, s
      real(wp) :: chi_ddot, chi_dot, q_ddot, q_dot, rho_ddot, rho_dot, root_ddot, root_dot, x
      integer :: k

      rays%n = n
      associate (r => pair%radius_j)
         do k = 1, n
            s(k) = pin%e(1)*u_x(k) + pin%e(2)*u_y(k)
            q(k) = pin%e(2)*u_x(k) - pin%e(1)*u_y(k)
            x = q(k)/r
            f(k) = (1.0_wp + 0.5_wp*x**2)/r
            rays%chi(k) = theta(k) - x - x**3/6.0_wp - pin%angle(2)
         end do
         if (pair%worn%pin%is_round()) then
            rays%h_j(:n) = 0.0_wp
            h_slope(:n) = 0.0_wp
            bend(:n) = 0.0_wp
         else
            call pair%worn%pin%at_places(n, rays%chi, rays%h_j, h_slope, bend)
         end if
         do k = 1, n
            rho(k) = r - rays%h_j(k)
            root(k) = sqrt(rho(k)**2 - q(k)**2)
            rays%d(k) = s(k) - pair%clearance - q(k)**2/(rho(k) + root(k)) - rays%h_j(k) - h(k)
            rays%by_j(k) = rho(k)*h_slope(k)/root(k)
            rays%w(k) = rays%by_j(k)*f(k) - q(k)/root(k)
            rays%slope(k) = q(k)*(1.0_wp + s(k)/root(k)) - rays%by_j(k)*(1.0_wp + s(k)*f(k)) - slope(k)
         end do
         if (.not. with_motion) return
         do k = 1, n
            q_dot = pin%e_dot(2)*u_x(k) - pin%e_dot(1)*u_y(k)
            chi_dot = -q_dot*f(k) - pin%omega(2)
            rho_dot = -h_slope(k)*chi_dot
            root_dot = (rho(k)*rho_dot - q(k)*q_dot)/root(k)
            rays%h_j_dot(k) = -rho_dot
            rays%d_dot(k) = pin%e_dot(1)*u_x(k) + pin%e_dot(2)*u_y(k) + root_dot + slope(k)*pin%omega(1)
            rays%w_dot(k) = ((rho_dot*h_slope(k) + rho(k)*bend(k)*chi_dot)*f(k) + rho(k)*h_slope(k)*q(k)*q_dot/r**3 - q_dot &
                             - rays%w(k)*root_dot)/root(k)
            q_ddot = pin%e_ddot(2)*u_x(k) - pin%e_ddot(1)*u_y(k)
            chi_ddot = -q_ddot*f(k) - q_dot**2*q(k)/r**3 - pin%alpha(2)
            rho_ddot = -bend(k)*chi_dot**2 - h_slope(k)*chi_ddot
            root_ddot = (rho_dot**2 + rho(k)*rho_ddot - q_dot**2 - q(k)*q_ddot - root_dot**2)/root(k)
            rays%d_ddot(k) = pin%e_ddot(1)*u_x(k) + pin%e_ddot(2)*u_y(k) + root_ddot - hole_bend(k)*pin%omega(1)**2 &
                             + slope(k)*pin%alpha(1)
         end do
      end associate
   end subroutine find_rays

   !> The ray in a direction. `with_motion` asks for what changes with time, `with_bend` for derivatives by theta beyond the first.
   pure subroutine find_ray(pair, pin, theta, cell, with_motion, with_bend, ray)
      type(surfaces_t), intent(in) :: pair   !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin         !! where the pin is, axes of the hole's body
      real(wp), intent(in) :: theta          !! the direction [rad]
      integer, intent(in) :: cell            !! cell of the hole it is in, from 0, any turn
      logical, intent(in) :: with_motion     !! rates too
      logical, intent(in) :: with_bend       !! second derivatives by theta too
      type(ray_t), intent(inout) :: ray      !! set

      type(depth_t) :: hole, surface
      real(wp) :: f, q, rho, root, s, x

      ray%theta = theta
      ray%u = [cos(theta), sin(theta)]
      s = pin%e(1)*ray%u(1) + pin%e(2)*ray%u(2)
      q = pin%e(2)*ray%u(1) - pin%e(1)*ray%u(2)
      x = q/pair%radius_j
      f = (1.0_wp + 0.5_wp*x**2)/pair%radius_j
      hole = pair%worn%hole%at(theta, cell)
      ray%by_i = hole%slope
      if (.not. pair%worn%pin%is_round()) surface = pair%worn%pin%at(theta - x - x**3/6.0_wp - pin%angle(2))
      ray%h_j = surface%h
      rho = pair%radius_j - surface%h
      root = sqrt(rho**2 - q**2)
      ray%d = s - pair%clearance - q**2/(rho + root) - surface%h - hole%h
      ray%w = (rho*surface%slope*f - q)/root
      ray%by_j = rho*surface%slope/root
      ray%slope = q + (q*s - rho*surface%slope*(1.0_wp + s*f))/root - hole%slope
      if (with_bend) call bend_ray(pair%radius_j, q, s, rho, root, hole, surface, ray)
      if (with_motion) call follow_ray(pair%radius_j, pin, q, s, rho, root, hole, surface, ray)
   end subroutine find_ray

   !> Derivatives by theta beyond the first.
   pure subroutine bend_ray(r, q, s, rho, root, hole, surface, ray)
      real(wp), intent(in) :: r              !! radius of the new pin [m]
      real(wp), intent(in) :: q              !! e . R90 u [m]
      real(wp), intent(in) :: s              !! e . u [m]
      real(wp), intent(in) :: rho            !! radius of the worn pin [m]
      real(wp), intent(in) :: root           !! S [m]
      type(depth_t), intent(in) :: hole      !! depth of the hole
      type(depth_t), intent(in) :: surface   !! depth of the pin
      type(ray_t), intent(inout) :: ray      !! bend, w_slope and that of h_j by theta are set

      real(wp) :: chi_bend, chi_slope, f, f_slope, rho_bend, rho_slope, root_slope

      f = (1.0_wp + 0.5_wp*(q/r)**2)/r
      f_slope = -q*s/r**3
      chi_slope = 1.0_wp + s*f
      chi_bend = q*f + s*f_slope
      rho_slope = -surface%slope*chi_slope
      rho_bend = -surface%bend*chi_slope**2 - surface%slope*chi_bend
      root_slope = (rho*rho_slope + q*s)/root
      ray%h_j_by(1) = -rho_slope
      ray%bend = -s + (rho_slope**2 + rho*rho_bend + q**2 - s**2 - root_slope**2)/root - hole%bend
      ray%w_slope = ((rho_slope*surface%slope + rho*surface%bend*chi_slope)*f + rho*surface%slope*f_slope + s)/root &
                    - ray%w*root_slope/root
   end subroutine bend_ray

   !> What changes with time, at a fixed direction.
   pure subroutine follow_ray(r, pin, q, s, rho, root, hole, surface, ray)
      real(wp), intent(in) :: r              !! radius of the new pin [m]
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: q              !! e . R90 u [m]
      real(wp), intent(in) :: s              !! e . u [m]
      real(wp), intent(in) :: rho            !! radius of the worn pin [m]
      real(wp), intent(in) :: root           !! S [m]
      type(depth_t), intent(in) :: hole      !! depth of the hole
      type(depth_t), intent(in) :: surface   !! depth of the pin
      type(ray_t), intent(inout) :: ray      !! rates are set

      real(wp) :: along, chi_ddot, chi_dot, f, f_by_q, q_ddot, q_dot, rho_ddot, rho_dot, root_ddot, root_dot, root_slope

      f = (1.0_wp + 0.5_wp*(q/r)**2)/r
      f_by_q = q/r**3
      along = pin%e_dot(1)*ray%u(1) + pin%e_dot(2)*ray%u(2)
      q_dot = pin%e_dot(2)*ray%u(1) - pin%e_dot(1)*ray%u(2)
      q_ddot = pin%e_ddot(2)*ray%u(1) - pin%e_ddot(1)*ray%u(2)
      chi_dot = -q_dot*f - pin%omega(2)
      chi_ddot = -q_ddot*f - q_dot**2*f_by_q - pin%alpha(2)
      rho_dot = -surface%slope*chi_dot
      rho_ddot = -surface%bend*chi_dot**2 - surface%slope*chi_ddot
      root_dot = (rho*rho_dot - q*q_dot)/root
      root_ddot = (rho_dot**2 + rho*rho_ddot - q_dot**2 - q*q_ddot - root_dot**2)/root
      ray%d_dot = along + root_dot + hole%slope*pin%omega(1)
      ray%d_ddot = pin%e_ddot(1)*ray%u(1) + pin%e_ddot(2)*ray%u(2) + root_ddot - hole%bend*pin%omega(1)**2 &
                   + hole%slope*pin%alpha(1)
      ray%w_dot = ((rho_dot*surface%slope + rho*surface%bend*chi_dot)*f + rho*surface%slope*f_by_q*q_dot - q_dot)/root &
                  - ray%w*root_dot/root
      ray%h_j_by(2) = -rho_dot
      ! of the slope: d_e . e' + omega_i h_i' + omega_j rho h_j'/S, differentiated by theta
      root_slope = (q*s - rho*surface%slope*(1.0_wp + s*f))/root
      ray%slope_dot = q_dot - along*ray%w + q_dot*ray%w_slope + pin%omega(1)*hole%bend &
                      + pin%omega(2)*((rho*surface%bend - surface%slope**2)*(1.0_wp + s*f)/root &
                                      - rho*surface%slope*root_slope/root**2)
   end subroutine follow_ray

end module overlap_rays
