!> Elementary constraints of space: the scalars that joints are made of, with their rates and what moves them.
!>
!> A row has twelve columns: r'_i, w'_i, r'_j, w'_j, angular velocities along the axes of the bodies. A scalar whose rate is
!>
!> F_i . r'_i + N_i . omega_i + F_j . r'_j + N_j . omega_j       (vectors of the world)
!>
!> has the row [ F_i, A_i^T N_i, F_j, A_j^T N_j ]. With a, b axes fixed in i and j, d = r_j + s_j - r_i - s_i (s in the world):
!>
!>     a . b     N_i = a x b,  N_j = -N_i
!>     a . d     F_j = -F_i = a,  N_i = a x (d + s_i),  N_j = s_j x a
!>     |d|       F_j = -F_i = u,  N_i = -s_i x u,  N_j = s_j x u,  u = d/|d|
!>     angle     of x_j against x_i about z_i: atan2(y_i . x_j, x_i . x_j)
!>     twist     2 e_3, N_j = -N_i = e_2 x_i - e_1 y_i + e_0 z_i, with Euler parameters e of j against i
!>     point     P_i - P_j along each axis of the world
!>
!> `bend` is the second derivative that the velocities alone make, so that gamma is -bend.
!> Source: Flores et al. (2008), eqs. (6.13) to (6.15); Nikravesh (1988), chapter 7. Limits: |d| > 0 for the distance; the angle
!> needs x_j not along z_i.
module spatial_rows
   use kinds, only: pi, wp
   use motion, only: motion_t
   use rotations, only: product_of, rotation_of_parameters
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: angle_between, angle_of, axis_of, dot_of_axes, dot_with_span, length_of_span, put_across_rows, put_row, &
      put_vector_rows, row_of, scalar_t, observed_from_other, twist_of_frames, wrapped

   !> A scalar of two bodies, and what moves it.
   type :: scalar_t
      real(wp) :: value = 0.0_wp           !! the scalar [m, rad or 1]
      real(wp) :: rate = 0.0_wp            !! its rate [m/s, rad/s or 1/s]
      real(wp) :: bend = 0.0_wp            !! second derivative without accelerations [m/s^2, rad/s^2 or 1/s^2]
      real(wp) :: force(3) = 0.0_wp        !! (3) F_j = -F_i, world frame [1]
      real(wp) :: turn_i(3) = 0.0_wp       !! (3) N_i, world frame [1 or m]
      real(wp) :: turn_j(3) = 0.0_wp       !! (3) N_j, world frame [1 or m]
   end type scalar_t

contains

   include "../../foundation/numerics/across.inc"

   !> An axis or arm of a body in the world.
   pure function axis_of(motion, body, axis) result(a)
      type(motion_t), intent(in) :: motion   !! positions
      integer, intent(in) :: body            !! the body
      real(wp), intent(in) :: axis(3)        !! (3) body's frame [any]
      real(wp) :: a(3)                       !! (3) world frame [any]

      a = motion%rot(:, 1, body)*axis(1) + motion%rot(:, 2, body)*axis(2) + motion%rot(:, 3, body)*axis(3)
   end function axis_of

   !> a . b of two axes.
   pure function dot_of_axes(motion, body, a_i, b_j) result(x)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: a_i(3)         !! (3) axis of i, its frame [1]
      real(wp), intent(in) :: b_j(3)         !! (3) axis of j, its frame [1]
      type(scalar_t) :: x                    !! a . b

      real(wp) :: a(3), a_dot(3), b(3), b_dot(3)

      a = axis_of(motion, body(1), a_i)
      b = axis_of(motion, body(2), b_j)
      associate (w_i => motion%omega(:, body(1)), w_j => motion%omega(:, body(2)))
         a_dot = across(w_i, a)
         b_dot = across(w_j, b)
         x%value = dot_product(a, b)
         x%turn_i = across(a, b)
         x%turn_j = -x%turn_i
         x%rate = dot_product(a_dot, b) + dot_product(a, b_dot)
         x%bend = dot_product(across(w_i, a_dot), b) + 2.0_wp*dot_product(a_dot, b_dot) + dot_product(a, across(w_j, b_dot))
      end associate
   end function dot_of_axes

   !> a . d of an axis of i and the span of two points.
   pure function dot_with_span(motion, body, a_i, s_i, s_j) result(x)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: a_i(3)         !! (3) axis of i, its frame [1]
      real(wp), intent(in) :: s_i(3)         !! (3) point of i, its frame [m]
      real(wp), intent(in) :: s_j(3)         !! (3) point of j, its frame [m]
      type(scalar_t) :: x                    !! a . d [m]

      real(wp) :: a(3), a_dot(3), arm_i(3), arm_j(3), d(3), d_bend(3), d_dot(3)

      a = axis_of(motion, body(1), a_i)
      call span_parts(motion, body, s_i, s_j, arm_i, arm_j, d, d_dot, d_bend)
      a_dot = across(motion%omega(:, body(1)), a)
      x%value = dot_product(a, d)
      x%rate = dot_product(a_dot, d) + dot_product(a, d_dot)
      x%bend = dot_product(across(motion%omega(:, body(1)), a_dot), d) + 2.0_wp*dot_product(a_dot, d_dot) + dot_product(a, d_bend)
      x%force = a
      x%turn_i = across(a, d + arm_i)
      x%turn_j = across(arm_j, a)
   end function dot_with_span

   !> Length of the span of two points. Of points that coincide, its direction is taken along the world's x.
   pure function length_of_span(motion, body, s_i, s_j) result(x)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: s_i(3)         !! (3) point of i, its frame [m]
      real(wp), intent(in) :: s_j(3)         !! (3) point of j, its frame [m]
      type(scalar_t) :: x                    !! |d| [m]

      real(wp) :: arm_i(3), arm_j(3), d(3), d_bend(3), d_dot(3), u(3)

      call span_parts(motion, body, s_i, s_j, arm_i, arm_j, d, d_dot, d_bend)
      x%value = norm2(d)
      u = [1.0_wp, 0.0_wp, 0.0_wp]
      if (x%value > 0.0_wp) u = d/x%value
      x%rate = dot_product(u, d_dot)
      x%bend = dot_product(u, d_bend)
      if (x%value > 0.0_wp) x%bend = x%bend + max(dot_product(d_dot, d_dot) - x%rate**2, 0.0_wp)/x%value
      x%force = u
      x%turn_i = -across(arm_i, u)
      x%turn_j = across(arm_j, u)
   end function length_of_span

   !> Arms, span, its rate, and what velocities alone make of its second derivative.
   pure subroutine span_parts(motion, body, s_i, s_j, arm_i, arm_j, d, d_dot, d_bend)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: s_i(3)         !! (3) point of i, its frame [m]
      real(wp), intent(in) :: s_j(3)         !! (3) point of j, its frame [m]
      real(wp), intent(out) :: arm_i(3)      !! (3) the point of i from its centre of mass, world frame [m]
      real(wp), intent(out) :: arm_j(3)      !! (3) the point of j from its centre of mass, world frame [m]
      real(wp), intent(out) :: d(3)          !! (3) from the point of i to that of j [m]
      real(wp), intent(out) :: d_dot(3)      !! (3) its rate [m/s]
      real(wp), intent(out) :: d_bend(3)     !! (3) its second derivative without accelerations [m/s^2]

      real(wp) :: turn_i(3), turn_j(3)

      associate (i => body(1), j => body(2))
         arm_i = axis_of(motion, i, s_i)
         arm_j = axis_of(motion, j, s_j)
         turn_i = across(motion%omega(:, i), arm_i)
         turn_j = across(motion%omega(:, j), arm_j)
         d = motion%r(:, j) + arm_j - motion%r(:, i) - arm_i
         d_dot = motion%v(:, j) + turn_j - motion%v(:, i) - turn_i
         d_bend = across(motion%omega(:, j), turn_j) - across(motion%omega(:, i), turn_i)
      end associate
   end subroutine span_parts

   !> Angle of x_j against x_i about z_i, counter-clockwise observed from its tip, -pi to pi.
   pure function angle_between(motion, body, frame_i, frame_j) result(x)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: frame_i(3, 3)  !! (3, 3) axes x, y, z of the joint in i as columns, its frame [1]
      real(wp), intent(in) :: frame_j(3, 3)  !! (3, 3) those in j [1]
      type(scalar_t) :: x                    !! the angle [rad]

      x = angle_of(dot_of_axes(motion, body, frame_i(:, 1), frame_j(:, 1)), &
                   dot_of_axes(motion, body, frame_i(:, 2), frame_j(:, 1)))
   end function angle_between

   !> Twist of two frames: twice the fourth Euler parameter e_3 of j against i, zero where j is turned against i about an axis
   !> across z alone. With n = e_2 x_i - e_1 y_i + e_0 z_i, which is as long as sqrt(1 - e_3^2), the rate is n . (w_j - w_i).
   pure function twist_of_frames(motion, body, q_i, q_j) result(x)
      type(motion_t), intent(in) :: motion   !! positions and velocities
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: q_i(4)         !! (4) Euler parameters of the frame of the joint in i, frame of body i [1]
      real(wp), intent(in) :: q_j(4)         !! (4) those in j [1]
      type(scalar_t) :: x                    !! the twist, an angle where it is small [rad]

      real(wp) :: e(4), n(3), p(4), w(3)

      p = product_of(motion%spatial%p(:, body(1)), q_i)
      e = product_of([p(1), -p(2:4)], product_of(motion%spatial%p(:, body(2)), q_j))
      e = e/norm2(e)
      n = axis_of(motion, body(1), matmul(rotation_of_parameters(q_i), [e(3), -e(2), e(1)]))
      w = motion%omega(:, body(2)) - motion%omega(:, body(1))
      x%value = 2.0_wp*e(4)
      x%rate = dot_product(n, w)
      x%bend = -dot_product(across(motion%omega(:, body(1)), motion%omega(:, body(2))), n) - 0.5_wp*dot_product(w, w)*e(4)
      x%turn_i = -n
      x%turn_j = n
   end function twist_of_frames

   !> Angle of a direction in the plane of two axes, -pi to pi, from its products with them.
   pure function angle_of(c, s) result(x)
      type(scalar_t), intent(in) :: c        !! product with the axis that the angle is counted from [any]
      type(scalar_t), intent(in) :: s        !! product with the other axis [any]
      type(scalar_t) :: x                    !! the angle [rad]

      real(wp) :: square

      square = max(c%value**2 + s%value**2, tiny(1.0_wp))
      x%value = atan2(s%value, c%value)
      x%rate = (c%value*s%rate - s%value*c%rate)/square
      x%bend = (c%value*s%bend - s%value*c%bend)/square - 2.0_wp*x%rate*(c%value*c%rate + s%value*s%rate)/square
      x%turn_i = (c%value*s%turn_i - s%value*c%turn_i)/square
      x%turn_j = (c%value*s%turn_j - s%value*c%turn_j)/square
      x%force = (c%value*s%force - s%value*c%force)/square
   end function angle_of

   !> A scalar of two bodies as of the same two in the other order.
   pure function observed_from_other(x) result(y)
      type(scalar_t), intent(in) :: x   !! the scalar, of j and i
      type(scalar_t) :: y               !! the same, of i and j

      y = x
      y%force = -x%force
      y%turn_i = x%turn_j
      y%turn_j = x%turn_i
   end function observed_from_other

   !> An angle less the whole turns nearest to it.
   elemental real(wp) function wrapped(angle)
      real(wp), intent(in) :: angle   !! the angle [rad]

      wrapped = angle - 2.0_wp*pi*anint(angle/(2.0_wp*pi))
   end function wrapped

   !> Set a row to a scalar that is f(t).
   pure subroutine put_row(rows, row, motion, body, x, f, f_dot, f_dot_dot)
      type(rows_t), intent(inout) :: rows    !! rows
      integer, intent(in) :: row             !! number of the row
      type(motion_t), intent(in) :: motion   !! positions
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      type(scalar_t), intent(in) :: x        !! the scalar
      real(wp), intent(in) :: f              !! its value [m, rad or 1]
      real(wp), intent(in) :: f_dot          !! first time derivative of that [m/s, rad/s or 1/s]
      real(wp), intent(in) :: f_dot_dot      !! second time derivative [m/s^2, rad/s^2 or 1/s^2]

      rows%phi(row) = x%value - f
      rows%phi_t(row) = -f_dot
      rows%gam(row) = f_dot_dot - x%bend
      rows%jac(:, row) = row_of(motion, body, x)
   end subroutine put_row

   !> What the rates of both bodies add to the rate of a scalar.
   pure function row_of(motion, body, x) result(row)
      type(motion_t), intent(in) :: motion   !! positions
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      type(scalar_t), intent(in) :: x        !! the scalar
      real(wp) :: row(12)                    !! (12) the row [1 or m]

      integer :: c

      do c = 1, 3
         row(c) = -x%force(c)
         row(c + 3) = dot_product(motion%rot(:, c, body(1)), x%turn_i)
         row(c + 6) = x%force(c)
         row(c + 9) = dot_product(motion%rot(:, c, body(2)), x%turn_j)
      end do
   end function row_of

   !> Set a row each to a . b of an axis of i and one of j: kernel on plain arrays, for many joints. With v = a . b
   !>
   !> bend = (w_i . a)(w_i . b) + (w_j . a)(w_j . b) - 2 (w_i . b)(w_j . a) - |w_i - w_j|^2 v
   pure subroutine put_across_rows(n, body, of_i, frame_i, of_j, frame_j, n_body, rot, omega, first, n_each, n_row, phi, phi_t, &
                                   jac, gam)
      integer, intent(in) :: n                          !! number of joints
      integer, intent(in) :: body(2, n)                 !! (2, n) bodies i and j
      integer, intent(in) :: of_i                       !! which axis of the frame of i
      real(wp), intent(in) :: frame_i(3, 3, n)          !! (3, 3, n) axes of the joints as columns, frame of body i [1]
      integer, intent(in) :: of_j                       !! which axis of the frame of j
      real(wp), intent(in) :: frame_j(3, 3, n)          !! (3, 3, n) axes of the joints as columns, frame of body j [1]
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: rot(3, 3, 0:n_body)       !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: omega(3, 0:n_body)        !! (3, 0:bodies) angular velocities [rad/s]
      integer, intent(in) :: first                      !! rows before that of the first joint
      integer, intent(in) :: n_each                     !! rows of each joint
      integer, intent(in) :: n_row                      !! number of rows
      real(wp), intent(inout) :: phi(n_row)             !! (rows) violations [1]
      real(wp), intent(inout) :: phi_t(n_row)           !! (rows) their partial time derivatives [1/s]
      real(wp), intent(inout) :: jac(12, n_row)         !! (12, rows) Phi_q [1]
      real(wp), intent(inout) :: gam(n_row)             !! (rows) gamma [1/s^2]

      real(wp) :: a(3), b(3), i_a, i_b, j_a, j_b, q(3), value, w(3), w_i(3), w_j(3)
      integer :: c, i, j, k, row

      do k = 1, n
         row = first + 1 + n_each*(k - 1)
         i = body(1, k)
         j = body(2, k)
         w_i = omega(:, i)
         w_j = omega(:, j)
         do c = 1, 3
            a(c) = rot(c, 1, i)*frame_i(1, of_i, k) + rot(c, 2, i)*frame_i(2, of_i, k) + rot(c, 3, i)*frame_i(3, of_i, k)
            b(c) = rot(c, 1, j)*frame_j(1, of_j, k) + rot(c, 2, j)*frame_j(2, of_j, k) + rot(c, 3, j)*frame_j(3, of_j, k)
         end do
         q = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
         value = a(1)*b(1) + a(2)*b(2) + a(3)*b(3)
         i_a = w_i(1)*a(1) + w_i(2)*a(2) + w_i(3)*a(3)
         i_b = w_i(1)*b(1) + w_i(2)*b(2) + w_i(3)*b(3)
         j_a = w_j(1)*a(1) + w_j(2)*a(2) + w_j(3)*a(3)
         j_b = w_j(1)*b(1) + w_j(2)*b(2) + w_j(3)*b(3)
         w = w_i - w_j
         phi(row) = value
         phi_t(row) = 0.0_wp
         gam(row) = (w(1)*w(1) + w(2)*w(2) + w(3)*w(3))*value - i_a*i_b - j_a*j_b + 2.0_wp*i_b*j_a
         do c = 1, 3
            jac(c, row) = 0.0_wp
            jac(c + 6, row) = 0.0_wp
         end do
         do c = 1, 3
            jac(c + 3, row) = rot(1, c, i)*q(1) + rot(2, c, i)*q(2) + rot(3, c, i)*q(3)
            jac(c + 9, row) = -(rot(1, c, j)*q(1) + rot(2, c, j)*q(2) + rot(3, c, j)*q(3))
         end do
      end do
   end subroutine put_across_rows

   !> Set three rows each to the coincidence of two points along the world's axes: kernel on plain arrays, for many joints.
   !> Their partial time derivatives stay zero.
   pure subroutine put_vector_rows(n, body, s_i, s_j, n_body, r, rot, omega, first, n_each, n_row, phi, jac, gam)
      integer, intent(in) :: n                          !! number of joints
      integer, intent(in) :: body(2, n)                 !! (2, n) bodies i and j
      real(wp), intent(in) :: s_i(3, n)                 !! (3, n) point of body i, its frame [m]
      real(wp), intent(in) :: s_j(3, n)                 !! (3, n) point of body j, its frame [m]
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)            !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)       !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: omega(3, 0:n_body)        !! (3, 0:bodies) angular velocities [rad/s]
      integer, intent(in) :: first                      !! rows before those of the set
      integer, intent(in) :: n_each                     !! rows of each joint, these the first of them
      integer, intent(in) :: n_row                      !! number of rows
      real(wp), intent(inout) :: phi(n_row)             !! (rows) violations [m]
      real(wp), intent(inout) :: jac(12, n_row)         !! (12, rows) Phi_q [1 or m]
      real(wp), intent(inout) :: gam(n_row)             !! (rows) gamma [m/s^2]

      real(wp) :: arm(3), e, gap(3), pull(3), s(3), sign, w(3)
      integer :: b, c, k, place, row, side

      do k = 1, n
         row = first + n_each*(k - 1)
         gap = 0.0_wp
         pull = 0.0_wp
         do side = 1, 2
            b = body(side, k)
            sign = 3.0_wp - 2.0_wp*side
            s = s_i(:, k)
            if (side == 2) s = s_j(:, k)
            place = 6*(side - 1)
            arm = rot(:, 1, b)*s(1) + rot(:, 2, b)*s(2) + rot(:, 3, b)*s(3)
            w = omega(:, b)
            e = w(1)*arm(1) + w(2)*arm(2) + w(3)*arm(3)
            gap = gap + sign*(r(:, b) + arm)
            pull = pull - sign*(w*e - arm*(w(1)*w(1) + w(2)*w(2) + w(3)*w(3)))
            ! moment of a unit force along axis c of the world: arm x e_c, along the body's axes
            do c = 1, 3
               jac(place + 1:place + 3, row + c) = 0.0_wp
               jac(place + c, row + c) = sign
            end do
            do c = 1, 3
               jac(place + 3 + c, row + 1) = sign*(arm(3)*rot(2, c, b) - arm(2)*rot(3, c, b))
               jac(place + 3 + c, row + 2) = sign*(arm(1)*rot(3, c, b) - arm(3)*rot(1, c, b))
               jac(place + 3 + c, row + 3) = sign*(arm(2)*rot(1, c, b) - arm(1)*rot(2, c, b))
            end do
         end do
         phi(row + 1:row + 3) = gap
         gam(row + 1:row + 3) = pull
      end do
   end subroutine put_vector_rows

end module spatial_rows
