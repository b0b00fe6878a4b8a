!> Bodies that one ideal joint ties to the ground or to a body of known motion, and nothing else: one coordinate describes each.
!>
!> The coordinate x is the angle of the body for a revolute joint, its way along the axis for a translational one:
!>
!> turning:  r = r_P + d,  d = A s,   v = v_P + x' R90 d,         a = a_0 + x'' R90 d,  a_0 = a_P - x'^2 d
!> sliding:  r = r_P + x u,           v = v_C + x' u,             a = a_0 + x'' u,      a_0 = a_C + 2 w x' R90 u
!>
!> with P fixed in the base, C the point of the base that is at the centre of mass now, w the angular velocity of the base. The
!> component of Newton's and Euler's equations along the freedom has no reaction in it:
!>
!> turning:  (I + m |d|^2) x'' = M + R90 d . (F - m a_0),         sliding:  m x'' = u . (F - m a_0).
!>
!> The two rows of the joint leave the equations; their multipliers come back by inverse dynamics, the least-squares solution of
!> Phi_q^T lambda = g - M a in the metric of the masses, which is exact: the right-hand side has no part along the freedom.
!>
!> Signs: as the rows of the joints; the reaction on a body is -Phi_q^T lambda.
!> Source: Flores et al. (2008), eqs. (2.1), (2.14), in the coordinate of the joint. Limits: the axis is fixed in the base.
module guided_motion
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use joint_set, only: rows_t
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: find_guided_multipliers, guided_coordinates, guided_rates, guided_response, guided_t, move_guided
   public :: set_guided_acceleration

   !> The guided bodies: those that turn, then those that slide.
   type :: guided_t
      integer :: n = 0                          !! number of guided bodies
      integer :: n_turning = 0                  !! those of them that turn, the first ones
      integer, allocatable :: body(:)           !! (n) the bodies
      integer, allocatable :: base(:)           !! (n) what each is tied to, 0: the ground
      real(wp), allocatable :: arm(:, :)        !! (2, n) d in the frame of the body; sliding: u in that of the base [m or 1]
      real(wp), allocatable :: s_base(:, :)     !! (2, n) P, sliding: centre of mass at x = 0; frame of the base [m]
      real(wp), allocatable :: turned(:, :)     !! (2, n) sliding: cosine and sine of the next [1]
      real(wp), allocatable :: offset(:)        !! (n) sliding: angle of the body less that of its base [rad]
      real(wp), allocatable :: mass(:)          !! (n) mass of the body [kg]
      real(wp), allocatable :: ease(:)          !! (n) one over what the freedom moves: I + m |d|^2, or m [1/(kg.m^2) or 1/kg]
      integer, allocatable :: row(:, :)         !! (2, n) rows of the joint
      integer, allocatable :: side(:)           !! (n) side of the body in them, 1: i, 2: j
      ! of the motion that is set
      real(wp), allocatable :: along(:, :)      !! (2, n) change of the centre of mass per coordinate, world frame [m or 1]
      real(wp), allocatable :: a_0(:, :)        !! (2, n) acceleration of the centre of mass at x'' = 0 [m/s^2]
   end type guided_t

contains

   !> Positions and velocities of the guided bodies; the motion of their bases is set, accelerations too.
   pure subroutine move_guided(guided, x, x_dot, motion)
      type(guided_t), intent(inout) :: guided    !! the bodies
      real(wp), intent(in) :: x(guided%n)        !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(guided%n)    !! (n) their rates [rad/s or m/s]
      type(motion_t), intent(inout) :: motion    !! the motion of the guided bodies is set

      call place_guided(guided%n, guided%n_turning, guided%body, guided%base, guided%arm, guided%s_base, guided%turned, &
                        guided%offset, x, x_dot, ubound(motion%angle, 1), motion%a, motion%alpha, motion%r, motion%rot, &
                        motion%v, motion%omega, motion%angle, guided%along, guided%a_0)
   end subroutine move_guided

   !> The same on plain arrays.
   pure subroutine place_guided(n, n_turning, body, base, arm, s_base, turned, offset, x, x_dot, n_body, acceleration, alpha, &
                                r, rot, v, omega, angle, along, a_0)
      integer, intent(in) :: n                              !! number of guided bodies
      integer, intent(in) :: n_turning                      !! those that turn
      integer, intent(in) :: body(n)                        !! (n) the bodies
      integer, intent(in) :: base(n)                        !! (n) what they are tied to
      real(wp), intent(in) :: arm(2, n)                     !! (2, n) arms of those that turn, axes of those that slide [m or 1]
      real(wp), intent(in) :: s_base(2, n)                  !! (2, n) points in the frames of the bases [m]
      real(wp), intent(in) :: turned(2, n)                  !! (2, n) cosine and sine of the angle to the base, sliding [1]
      real(wp), intent(in) :: offset(n)                     !! (n) that angle [rad]
      real(wp), intent(in) :: x(n)                          !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(n)                      !! (n) their rates [rad/s or m/s]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(in) :: acceleration(3, 0:n_body)     !! (3, 0:bodies) accelerations, those of the bases [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)            !! (3, 0:bodies) angular accelerations, those of the bases [rad/s^2]
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(inout) :: angle(0:n_body)            !! (0:bodies) angles [rad]
      real(wp), intent(inout) :: along(2, n)                !! (2, n) change of the centre of mass per coordinate [m or 1]
      real(wp), intent(inout) :: a_0(2, n)                  !! (2, n) acceleration of the centre of mass at x'' = 0 [m/s^2]

      real(wp) :: c, d(2), e, p(2), q(2), s, w
      integer :: a, b, k

      do k = 1, n_turning
         b = body(k)
         w = x_dot(k)
         c = cos(x(k))
         s = sin(x(k))
         d(1) = c*arm(1, k) - s*arm(2, k)
         d(2) = s*arm(1, k) + c*arm(2, k)
         angle(b) = x(k)
         rot(1, 1, b) = c
         rot(2, 1, b) = s
         rot(1, 2, b) = -s
         rot(2, 2, b) = c
         omega(3, b) = w
         along(1, k) = -d(2)
         along(2, k) = d(1)
         r(1, b) = s_base(1, k) + d(1)
         r(2, b) = s_base(2, k) + d(2)
         v(1, b) = -w*d(2)
         v(2, b) = w*d(1)
         a_0(1, k) = -w*w*d(1)
         a_0(2, k) = -w*w*d(2)
         if (base(k) == 0) cycle
         ! what the motion of the base adds
         a = base(k)
         w = omega(3, a)
         e = alpha(3, a)
         p(1) = rot(1, 1, a)*s_base(1, k) + rot(1, 2, a)*s_base(2, k)
         p(2) = rot(2, 1, a)*s_base(1, k) + rot(2, 2, a)*s_base(2, k)
         r(1, b) = r(1, a) + p(1) + d(1)
         r(2, b) = r(2, a) + p(2) + d(2)
         v(1, b) = v(1, b) + v(1, a) - w*p(2)
         v(2, b) = v(2, b) + v(2, a) + w*p(1)
         a_0(1, k) = a_0(1, k) + acceleration(1, a) - e*p(2) - w*w*p(1)
         a_0(2, k) = a_0(2, k) + acceleration(2, a) + e*p(1) - w*w*p(2)
      end do
      do k = n_turning + 1, n
         b = body(k)
         p(1) = s_base(1, k) + x(k)*arm(1, k)
         p(2) = s_base(2, k) + x(k)*arm(2, k)
         if (base(k) == 0) then
            angle(b) = offset(k)
            rot(1, 1, b) = turned(1, k)
            rot(2, 1, b) = turned(2, k)
            rot(1, 2, b) = -turned(2, k)
            rot(2, 2, b) = turned(1, k)
            along(1, k) = arm(1, k)
            along(2, k) = arm(2, k)
            r(1, b) = p(1)
            r(2, b) = p(2)
            v(1, b) = x_dot(k)*arm(1, k)
            v(2, b) = x_dot(k)*arm(2, k)
            cycle
         end if
         a = base(k)
         w = omega(3, a)
         e = alpha(3, a)
         d(1) = rot(1, 1, a)*arm(1, k) + rot(1, 2, a)*arm(2, k)
         d(2) = rot(2, 1, a)*arm(1, k) + rot(2, 2, a)*arm(2, k)
         q(1) = rot(1, 1, a)*p(1) + rot(1, 2, a)*p(2)
         q(2) = rot(2, 1, a)*p(1) + rot(2, 2, a)*p(2)
         angle(b) = angle(a) + offset(k)
         rot(1, 1, b) = rot(1, 1, a)*turned(1, k) + rot(1, 2, a)*turned(2, k)
         rot(2, 1, b) = rot(2, 1, a)*turned(1, k) + rot(2, 2, a)*turned(2, k)
         rot(1, 2, b) = -rot(2, 1, b)
         rot(2, 2, b) = rot(1, 1, b)
         omega(3, b) = w
         along(1, k) = d(1)
         along(2, k) = d(2)
         r(1, b) = r(1, a) + q(1)
         r(2, b) = r(2, a) + q(2)
         v(1, b) = v(1, a) - w*q(2) + x_dot(k)*d(1)
         v(2, b) = v(2, a) + w*q(1) + x_dot(k)*d(2)
         a_0(1, k) = acceleration(1, a) - e*q(2) - w*w*q(1) - 2.0_wp*w*x_dot(k)*d(2)
         a_0(2, k) = acceleration(2, a) + e*q(1) - w*w*q(2) + 2.0_wp*w*x_dot(k)*d(1)
      end do
   end subroutine place_guided

   !> Rates of the coordinates and their derivatives at the motion that is set. Status 1 if one is not a finite number.
   pure subroutine guided_rates(n, n_turning, body, mass, ease, along, a_0, n_body, g, x_dot, rate, x_ddot, status)
      integer, intent(in) :: n                         !! number of guided bodies
      integer, intent(in) :: n_turning                 !! those that turn
      integer, intent(in) :: body(n)                   !! (n) the bodies
      real(wp), intent(in) :: mass(n)                  !! (n) their masses [kg]
      real(wp), intent(in) :: ease(n)                  !! (n) one over what the freedoms move [1/(kg.m^2) or 1/kg]
      real(wp), intent(in) :: along(2, n)              !! (2, n) change of the centre of mass per coordinate [m or 1]
      real(wp), intent(in) :: a_0(2, n)                !! (2, n) acceleration of the centre of mass at x'' = 0 [m/s^2]
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: g(3, 0:n_body)           !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: x_dot(n)                 !! (n) rates of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: rate(n)               !! (n) the same, first derivatives of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: x_ddot(n)             !! (n) second derivatives [rad/s^2 or m/s^2]
      integer, intent(out) :: status                   !! 0: all finite

      real(wp) :: load, sum
      integer :: b, k

      sum = 0.0_wp
      !GCC$ novector
      do k = 1, n
         b = body(k)
         rate(k) = x_dot(k)
         load = along(1, k)*(g(1, b) - mass(k)*a_0(1, k)) + along(2, k)*(g(2, b) - mass(k)*a_0(2, k))
         if (k <= n_turning) load = load + g(3, b)
         x_ddot(k) = load*ease(k)
         sum = sum + abs(x_ddot(k))
      end do
      status = merge(0, 1, ieee_is_finite(sum))
   end subroutine guided_rates

   !> Accelerations of the guided bodies under loads, with those that they have by their motion or without: then what the loads
   !> add to them.
   pure subroutine guided_response(guided, g, with_own, alpha, a)
      type(guided_t), intent(in) :: guided             !! the bodies, moved
      real(wp), intent(in) :: g(:, 0:)                 !! (3, 0:bodies) loads [N, N, N.m]
      logical, intent(in) :: with_own                  !! with the accelerations by the motion
      real(wp), intent(in) :: alpha(:, 0:)             !! (3, 0:bodies) angular accelerations, those of the bases [rad/s^2]
      real(wp), intent(inout) :: a(:, 0:)              !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]

      real(wp) :: a_0(2), x_ddot
      integer :: b, k

      do k = 1, guided%n
         b = guided%body(k)
         a_0 = merge(guided%a_0(:, k), 0.0_wp, with_own)
         x_ddot = dot_product(guided%along(:, k), g(1:2, b) - guided%mass(k)*a_0)
         if (k <= guided%n_turning) x_ddot = x_ddot + g(3, b)
         x_ddot = guided%ease(k)*x_ddot
         a(1:2, b) = a_0 + x_ddot*guided%along(:, k)
         a(3, b) = merge(x_ddot, merge(alpha(3, guided%base(k)), 0.0_wp, with_own), k <= guided%n_turning)
      end do
   end subroutine guided_response

   !> Accelerations of the guided bodies from the second derivatives of their coordinates, at the motion that is set.
   pure subroutine set_guided_acceleration(guided, x_ddot, motion)
      type(guided_t), intent(in) :: guided             !! the bodies, moved
      real(wp), intent(in) :: x_ddot(guided%n)         !! (n) second derivatives [rad/s^2 or m/s^2]
      type(motion_t), intent(inout) :: motion          !! accelerations of the guided bodies are set

      integer :: b, k

      do k = 1, guided%n
         b = guided%body(k)
         motion%a(1, b) = guided%a_0(1, k) + x_ddot(k)*guided%along(1, k)
         motion%a(2, b) = guided%a_0(2, k) + x_ddot(k)*guided%along(2, k)
         motion%alpha(3, b) = motion%alpha(3, guided%base(k))
         if (k <= guided%n_turning) motion%alpha(3, b) = x_ddot(k)
      end do
   end subroutine set_guided_acceleration

   !> Coordinates and rates from a motion of all bodies that fulfils the joints.
   pure subroutine guided_coordinates(guided, motion, x, x_dot)
      type(guided_t), intent(in) :: guided        !! the bodies
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(out) :: x(guided%n)        !! (n) coordinates [rad or m]
      real(wp), intent(out) :: x_dot(guided%n)    !! (n) their rates [rad/s or m/s]

      real(wp) :: from_base(2), start(2), u(2)
      integer :: a, b, k

      do k = 1, guided%n
         a = guided%base(k)
         b = guided%body(k)
         if (k <= guided%n_turning) then
            x(k) = motion%angle(b)
            x_dot(k) = motion%omega(3, b)
            cycle
         end if
         u = matmul(motion%rot(1:2, 1:2, a), guided%arm(:, k))
         start = matmul(motion%rot(1:2, 1:2, a), guided%s_base(:, k))
         from_base = motion%r(1:2, b) - motion%r(1:2, a)
         x(k) = dot_product(u, from_base - start)
         x_dot(k) = dot_product(u, motion%v(1:2, b) - motion%v(1:2, a) - motion%omega(3, a)*[-from_base(2), from_base(1)])
      end do
   end subroutine guided_coordinates

   !> Multipliers of the rows of the guided bodies' joints. All rows are evaluated.
   pure subroutine find_guided_multipliers(guided, rows, mass, g, a, lambda)
      type(guided_t), intent(in) :: guided        !! the bodies
      type(rows_t), intent(in) :: rows            !! all rows
      real(wp), intent(in) :: mass(:, :)          !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: g(:, 0:)            !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: a(:, 0:)            !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: lambda(:)        !! (rows) multipliers; those of the joints' rows are set [N or N.m]

      real(wp) :: determinant, p(3), q(3), rest(3), s(3), x(2)
      integer :: b, k, place

      do k = 1, guided%n
         b = guided%body(k)
         place = 3*(guided%side(k) - 1)
         p = rows%jac(place + 1:place + 3, guided%row(1, k))
         q = rows%jac(place + 1:place + 3, guided%row(2, k))
         rest = g(:, b)/mass(:, b) - a(:, b)
         x = [dot_product(p, rest), dot_product(q, rest)]
         s = [dot_product(p, p/mass(:, b)), dot_product(p, q/mass(:, b)), dot_product(q, q/mass(:, b))]
         determinant = s(1)*s(3) - s(2)**2
         lambda(guided%row(1, k)) = (s(3)*x(1) - s(2)*x(2))/determinant
         lambda(guided%row(2, k)) = (s(1)*x(2) - s(2)*x(1))/determinant
      end do
   end subroutine find_guided_multipliers

end module guided_motion
