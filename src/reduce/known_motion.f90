!> Bodies whose motion is a known function of time: driven against the ground, or against one another, without freedom.
!>
!> A body is known when a driven revolute joint, or a rigid one, ties it to the ground or to a known body:
!>
!> angle_b = angle_a + offset + sign f(t),   r_b = r_a + s_a - s_b,   and the time derivatives of both.
!>
!> Its coordinates leave the unknowns, and the three rows that fix it leave the equations. The multipliers of these rows
!> come back by inverse dynamics, body by body from the last to the first:
!>
!> Phi_b^T lambda = g_b - M_b a_b - ( Phi^T lambda of all other rows )_b.
!>
!> Signs: as the rows of the joints; the reaction on a body is -Phi_q^T lambda.
!> Source: Flores et al. (2008), eqs. (2.1), (2.14). Limits: drivers of angles.
module known_motion
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use joint_set, only: joint_slot_t
   use rows, only: rows_t
   use kinds, only: wp
   use motion, only: cross, motion_t
   implicit none (type, external)
   private
   public :: find_multipliers, known_t, move_known, power_of_known

   !> One known body.
   type :: known_body_t
      integer :: body = 0                 !! the body
      integer :: base = 0                 !! what it is tied to, 0: the ground
      integer :: slot = 0                 !! set of the driver, 0: rigid
      integer :: item = 0                 !! its item
      integer :: row(3) = 0               !! (3) rows that fix the body
      integer :: side(3) = 0              !! (3) side of the body in each of them, 1: i, 2: j
      real(wp) :: s_body(2) = 0.0_wp      !! (2) common point in the frame of the body [m]
      real(wp) :: s_base(2) = 0.0_wp      !! (2) the same in the frame of its base [m]
      real(wp) :: sign = 0.0_wp           !! of the driver's angle in that of the body; 0: rigid [1]
      real(wp) :: offset = 0.0_wp         !! angle of the body less that of its base, less sign times f [rad]
   end type known_body_t

   !> The known bodies, each after the body that it is tied to.
   type :: known_t
      integer :: n = 0                               !! number of known bodies
      type(known_body_t), allocatable :: item(:)     !! (n) the bodies
      real(wp) :: t = -huge(1.0_wp)                  !! time of the motion that is set [s]
      logical :: is_finite = .true.                  !! whether that motion is finite numbers
   end type known_t

contains

   include "../math/sine_cosine.inc"

   !> Positions, velocities and accelerations of the known bodies at a time; nothing to do if that is their present time.
   subroutine move_known(known, joints, t, motion)
      type(known_t), intent(inout) :: known                   !! the bodies
      type(joint_slot_t), intent(in), contiguous :: joints(:) !! (sets) joints and drivers
      real(wp), intent(in) :: t                               !! time [s]
      type(motion_t), intent(inout) :: motion                 !! the motion of the known bodies is set, accelerations too

      if (.not. abs(t - known%t) > 0.0_wp) return
      known%t = t
      call place_bodies(known%n, known%item, size(joints), joints, t, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, &
                        motion%omega, motion%angle, motion%a, motion%alpha, known%is_finite)
   end subroutine move_known

   !> The same on plain arrays, up to the first body whose driver says what is no finite number.
   subroutine place_bodies(n, item, n_set, joints, t, n_body, r, rot, v, omega, angle, acceleration, alpha, is_finite)
      integer, intent(in) :: n                              !! number of known bodies
      type(known_body_t), intent(in) :: item(n)             !! (n) the bodies
      integer, intent(in) :: n_set                          !! number of sets of joints
      type(joint_slot_t), intent(in) :: joints(n_set)       !! (sets) joints and drivers
      real(wp), intent(in) :: t                             !! time [s]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(inout) :: angle(0:n_body)            !! (0:bodies) angles [rad]
      real(wp), intent(inout) :: acceleration(3, 0:n_body)  !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(inout) :: alpha(3, 0:n_body)         !! (3, 0:bodies) angular accelerations [rad/s^2]
      logical, intent(out) :: is_finite                     !! whether what the drivers say are finite numbers

      real(wp) :: c, e, f, f_dot, f_dot_dot, s, theta, w, x, y
      integer :: a, b, k

      do k = 1, n
         a = item(k)%base
         b = item(k)%body
         theta = angle(a) + item(k)%offset
         w = omega(3, a)
         e = alpha(3, a)
         if (item(k)%slot > 0) then
            call joints(item(k)%slot)%set%prescription(item(k)%item, t, f, f_dot, f_dot_dot)
            is_finite = ieee_is_finite(f + f_dot + f_dot_dot)
            if (.not. is_finite) return
            theta = theta + item(k)%sign*f
            w = w + item(k)%sign*f_dot
            e = e + item(k)%sign*f_dot_dot
         end if
         call sine_cosine(theta, s, c)
         ! from the common point to the centre of mass
         x = s*item(k)%s_body(2) - c*item(k)%s_body(1)
         y = -s*item(k)%s_body(1) - c*item(k)%s_body(2)
         angle(b) = theta
         omega(3, b) = w
         alpha(3, b) = e
         rot(1, 1, b) = c
         rot(2, 1, b) = s
         rot(1, 2, b) = -s
         rot(2, 2, b) = c
         r(1, b) = item(k)%s_base(1) + x
         r(2, b) = item(k)%s_base(2) + y
         v(1, b) = -w*y
         v(2, b) = w*x
         acceleration(1, b) = -e*y - w*w*x
         acceleration(2, b) = e*x - w*w*y
         if (a > 0) call add_base(a, b, item(k)%s_base, n_body, r, rot, v, omega, acceleration, alpha)
      end do
      is_finite = .true.
   end subroutine place_bodies

   !> What the motion of the body that carries the common point adds to that of a body.
   pure subroutine add_base(a, b, s_base, n_body, r, rot, v, omega, acceleration, alpha)
      integer, intent(in) :: a                              !! the body that carries
      integer, intent(in) :: b                              !! the body that is carried
      real(wp), intent(in) :: s_base(2)                     !! (2) common point in the frame of a; in the position of b already [m]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass; that of b is added to [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)           !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities; that of b is added to [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)            !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(inout) :: acceleration(3, 0:n_body)  !! (3, 0:bodies) accelerations; that of b is added to [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)            !! (3, 0:bodies) angular accelerations [rad/s^2]

      real(wp) :: s(2), w

      s = rot(1:2, 1, a)*s_base(1) + rot(1:2, 2, a)*s_base(2)
      w = omega(3, a)
      r(1:2, b) = r(1:2, b) + (r(1:2, a) + s - s_base)
      v(1:2, b) = v(1:2, b) + v(1:2, a) + w*[-s(2), s(1)]
      acceleration(1:2, b) = acceleration(1:2, b) + acceleration(1:2, a) + alpha(3, a)*[-s(2), s(1)] - w*w*s
   end subroutine add_base

   !> Power that the drivers of known bodies give to the mechanism, with the bodies that they guide counted among them. The rows
   !> that fix these bodies are fulfilled, so that it is lambda^T Phi_t = -lambda^T Phi_q v: what accelerates the bodies and what
   !> the solved rows take from them, times their speed.
   pure real(wp) function power_of_known(n, body, n_known, known, n_body, n_row, mass, g, jac, lambda, v, omega, a, alpha) &
      result(power)
      integer, intent(in) :: n                      !! number of known bodies
      integer, intent(in) :: body(n)                !! (n) the bodies
      integer, intent(in) :: n_known                !! sides of solved rows that are known bodies
      integer, intent(in) :: known(3, n_known)      !! (3, known sides) row, place in the Jacobian, body
      integer, intent(in) :: n_body                 !! number of bodies
      integer, intent(in) :: n_row                  !! number of rows
      real(wp), intent(in) :: mass(3, n_body)       !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: g(3, 0:n_body)        !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: jac(6*n_row)          !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: lambda(n_row)         !! (rows) multipliers of the solved rows [N or N.m]
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)    !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)    !! (3, 0:bodies) angular accelerations [rad/s^2]

      integer :: b, k, place

      power = 0.0_wp
      do k = 1, n
         b = body(k)
         power = power + (mass(1, b)*a(1, b) - g(1, b))*v(1, b) + (mass(2, b)*a(2, b) - g(2, b))*v(2, b) &
                 + (mass(3, b)*alpha(3, b) - g(3, b))*omega(3, b)
      end do
      do k = 1, n_known
         place = known(2, k)
         b = known(3, k)
         power = power + lambda(known(1, k))*(jac(place + 1)*v(1, b) + jac(place + 2)*v(2, b) + jac(place + 3)*omega(3, b))
      end do
   end function power_of_known

   !> Multipliers of the rows that fix the known bodies. Those of all other rows are there; all rows are evaluated.
   pure subroutine find_multipliers(known, rows, carried, n_body, mass, g, a, rest, lambda)
      type(known_t), intent(in) :: known             !! the bodies
      type(rows_t), intent(in) :: rows               !! all rows
      integer, intent(in) :: carried(:, :)           !! (3, sides) sides of other rows that are known bodies: row, place, body
      integer, intent(in) :: n_body                  !! number of bodies
      real(wp), intent(in) :: mass(3, n_body)        !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: g(3, 0:n_body)         !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: a(3, 0:n_body)         !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: rest(3, 0:n_body)   !! (3, 0:bodies) scratch: what the rows of a body have to carry [N, N, N.m]
      real(wp), intent(inout) :: lambda(rows%n)      !! (rows) multipliers; those of the fixing rows are set [N or N.m]

      real(wp) :: matrix(3, 3), x(3)
      integer :: b, i, k, place, row

      do k = 1, known%n
         b = known%item(k)%body
         rest(:, b) = g(:, b) - mass(:, b)*a(:, b)
      end do
      do k = 1, size(carried, 2)
         row = carried(1, k)
         place = carried(2, k) - 6*(row - 1)
         b = carried(3, k)
         rest(:, b) = rest(:, b) - rows%jac(place + 1:place + 3, row)*lambda(row)
      end do
      do k = known%n, 1, -1
         b = known%item(k)%body
         do i = 1, 3
            place = 3*(known%item(k)%side(i) - 1)
            matrix(:, i) = rows%jac(place + 1:place + 3, known%item(k)%row(i))
         end do
         x = solve_three(matrix, rest(:, b))
         do i = 1, 3
            row = known%item(k)%row(i)
            lambda(row) = x(i)
            place = 3*(2 - known%item(k)%side(i))
            rest(:, known%item(k)%base) = rest(:, known%item(k)%base) - rows%jac(place + 1:place + 3, row)*x(i)
         end do
      end do
   end subroutine find_multipliers

   !> Solution of three equations by Cramer's rule: columns are two unit forces with their moments and a unit moment,
   !> so that the determinant is one or minus one.
   pure function solve_three(matrix, right) result(x)
      real(wp), intent(in) :: matrix(3, 3)  !! (3, 3) matrix [1 or m]
      real(wp), intent(in) :: right(3)      !! (3) right-hand side [N, N, N.m]
      real(wp) :: x(3)                      !! (3) solution [N, N, N.m]

      real(wp) :: c23(3), c31(3), c12(3)

      c23 = cross(matrix(:, 2), matrix(:, 3))
      c31 = cross(matrix(:, 3), matrix(:, 1))
      c12 = cross(matrix(:, 1), matrix(:, 2))
      x = [dot_product(c23, right), dot_product(c31, right), dot_product(c12, right)]/dot_product(c23, matrix(:, 1))
   end function solve_three

end module known_motion
