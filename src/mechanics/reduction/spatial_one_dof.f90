!> Bodies with one degree of freedom of space: see `reduced_bodies`.
!>
!> The coordinate x is the turn about the axis u of a revolute joint, or the way along that of a translational one:
!>
!> turning:  A = A_base Q(x),  r = r_P + d,    v = v_P + w x d,    a = a_0 + x'' u x d,   alpha = alpha_0 + x'' u,
!>           w = w_base + x' u,   alpha_0 = alpha_base + x' w_base x u,   a_0 = a_P + alpha_0 x d + w x (w x d),
!> sliding:  A = A_base Q,     r = r_P + x u,  v = v_C + x' u,     a = a_0 + x'' u,       alpha = alpha_0 = alpha_base,
!>           a_0 = a_C + 2 x' w_base x u,
!>
!> with P fixed in the base, d from P to the centre of mass, fixed in the body, C the point of the base that is at the centre of
!> mass now. The component of Newton's and Euler's equations along the freedom has no reaction in it:
!>
!> turning:  (u . J u + m |u x d|^2) x'' = u . (M - w x J w - J alpha_0) + (u x d) . (F - m a_0),
!> sliding:  m x'' = u . (F - m a_0).
!>
!> Source: Flores et al. (2008), eqs. (6.1) to (6.12), in the coordinate of the joint. Limits: the axis is fixed in base and body.
module spatial_one_dof
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use lapack, only: dgetrf, dgetrs
   use motion, only: motion_t
   use reduced_bodies, only: one_dof_bodies_t, held_t
   use rotations, only: product_of
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: spatial_guide_t, spatial_one_dof_t

   integer, parameter :: n_held = 5   !! rows of a joint that leaves one freedom

   !> One body with one degree of freedom.
   type :: spatial_guide_t
      real(wp) :: q_0(4) = 0.0_wp      !! (4) Euler parameters against the base at x = 0; sliding: always [1]
      real(wp) :: q_1(4) = 0.0_wp      !! (4) those at half a turn [1]
      real(wp) :: turn(3) = 0.0_wp     !! (3) u in the frame of the body; sliding: zero [1]
      real(wp) :: slide_axis(3) = 0.0_wp  !! (3) d in the frame of the body; sliding: u in that of the base [m or 1]
      real(wp) :: s_base(3) = 0.0_wp   !! (3) P, sliding: centre of mass at x = 0; frame of the base [m]
      real(wp) :: mass(6) = 0.0_wp     !! (6) mass three times, principal moments of inertia [kg and kg.m^2]
      real(wp) :: ease = 0.0_wp        !! one over what the freedom moves [1/(kg.m^2) or 1/kg]
      ! of the motion that is set
      real(wp) :: along(3) = 0.0_wp    !! (3) change of the centre of mass per coordinate, world frame [m or 1]
      real(wp) :: a_0(3) = 0.0_wp      !! (3) acceleration of the centre of mass at x'' = 0 [m/s^2]
      real(wp) :: rise_0(3) = 0.0_wp   !! (3) angular acceleration at x'' = 0, body frame [rad/s^2]
   end type spatial_guide_t

   !> All of them.
   type, extends(one_dof_bodies_t) :: spatial_one_dof_t
      type(spatial_guide_t), allocatable :: item(:)   !! (n) the bodies
   contains
      procedure :: move => spatial_move
      procedure :: rates => spatial_rates
      procedure :: response => spatial_response
      procedure :: set_acceleration => spatial_set_acceleration
      procedure :: read_coordinates => spatial_read_coordinates
      procedure :: find_multipliers => spatial_find_multipliers
   end type spatial_one_dof_t

contains

   include "../../foundation/numerics/sine_cosine.inc"
   include "../../foundation/numerics/across.inc"
   include "../../foundation/numerics/turned.inc"
   include "carried_point.inc"

   !> Positions and velocities of the bodies with one degree of freedom; the motion of their bases is set, accelerations too.
   pure subroutine spatial_move(self, x, x_dot, motion)
      class(spatial_one_dof_t), intent(inout) :: self  !! the bodies
      real(wp), intent(in) :: x(self%n)               !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(self%n)           !! (n) their rates [rad/s or m/s]
      type(motion_t), intent(inout) :: motion         !! the motion of the bodies with one degree of freedom is set

      associate (n => self%n_turning, n_body => ubound(motion%angle, 1))
         call place_turning(n, self%held, self%item, x, x_dot, n_body, motion%a, motion%alpha, motion%r, motion%rot, motion%v, &
                            motion%omega, motion%spatial%p, motion%spatial%spin)
         call place_sliding(n, self%n, self%held, self%item, x, x_dot, n_body, motion%a, motion%alpha, motion%r, motion%rot, &
                            motion%v, motion%omega, motion%spatial%p, motion%spatial%spin)
      end associate
   end subroutine spatial_move

   !> The bodies that turn, on plain arrays.
   pure subroutine place_turning(n, held, item, x, x_dot, n_body, acceleration, alpha, r, rot, v, omega, p, spin)
      integer, intent(in) :: n                              !! number of bodies that turn, the first ones
      type(held_t), intent(in) :: held(n)                   !! (n) how they are held
      type(spatial_guide_t), intent(inout) :: item(n)       !! (n) the bodies, moved
      real(wp), intent(in) :: x(n)                          !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(n)                      !! (n) their rates [rad/s or m/s]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(in) :: acceleration(3, 0:n_body)     !! (3, 0:bodies) accelerations, those of the bases [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)            !! (3, 0:bodies) angular accelerations, those of the bases [rad/s^2]
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities, world frame [rad/s]
      real(wp), intent(inout) :: p(4, 0:n_body)             !! (4, 0:bodies) Euler parameters [1]
      real(wp), intent(inout) :: spin(3, 0:n_body)          !! (3, 0:bodies) angular velocities, body frames [rad/s]

      real(wp) :: at(3), at_dot(3), at_dot_dot(3), cosine, d(3), sine, u(3), wd(3)
      integer :: a, b, k

      do k = 1, n
         a = held(k)%base
         b = held(k)%body
         call sine_cosine(0.5_wp*x(k), sine, cosine)
         call place_turn(cosine, sine, item(k)%q_0, item(k)%q_1, a, p(:, a), p(:, b), rot(:, :, b))
         call carried_point(a, item(k)%s_base, n_body, r, rot, v, omega, acceleration, alpha, at, at_dot, at_dot_dot)
         u = turned(rot(:, :, b), item(k)%turn)
         d = turned(rot(:, :, b), item(k)%slide_axis)
         item(k)%along = across(u, d)
         spin(:, b) = x_dot(k)*item(k)%turn
         omega(:, b) = x_dot(k)*u
         item(k)%a_0 = at_dot_dot
         if (a > 0) then
            ! what the motion of the base adds
            omega(:, b) = omega(:, a) + omega(:, b)
            spin(:, b) = turned_back(rot(:, :, b), omega(:, b))
            wd = alpha(:, a) + x_dot(k)*across(omega(:, a), u)
            item(k)%rise_0 = turned_back(rot(:, :, b), wd)
            item(k)%a_0 = item(k)%a_0 + across(wd, d)
         end if
         wd = across(omega(:, b), d)
         r(:, b) = at + d
         v(:, b) = at_dot + wd
         item(k)%a_0 = item(k)%a_0 + across(omega(:, b), wd)
      end do
   end subroutine place_turning

   !> The bodies that slide, on plain arrays.
   pure subroutine place_sliding(n_turning, n, held, item, x, x_dot, n_body, acceleration, alpha, r, rot, v, omega, p, spin)
      integer, intent(in) :: n_turning                      !! number of bodies that turn, the first ones
      integer, intent(in) :: n                              !! number of bodies with one degree of freedom
      type(held_t), intent(in) :: held(n)                   !! (n) how they are held
      type(spatial_guide_t), intent(inout) :: item(n)       !! (n) the bodies, those that slide are moved
      real(wp), intent(in) :: x(n)                          !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(n)                      !! (n) their rates [rad/s or m/s]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(in) :: acceleration(3, 0:n_body)     !! (3, 0:bodies) accelerations, those of the bases [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)            !! (3, 0:bodies) angular accelerations, those of the bases [rad/s^2]
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities, world frame [rad/s]
      real(wp), intent(inout) :: p(4, 0:n_body)             !! (4, 0:bodies) Euler parameters [1]
      real(wp), intent(inout) :: spin(3, 0:n_body)          !! (3, 0:bodies) angular velocities, body frames [rad/s]

      real(wp) :: at(3), at_dot(3), at_dot_dot(3)
      integer :: a, b, k

      do k = n_turning + 1, n
         a = held(k)%base
         b = held(k)%body
         call place_turn(1.0_wp, 0.0_wp, item(k)%q_0, item(k)%q_1, a, p(:, a), p(:, b), rot(:, :, b))
         call carried_point(a, item(k)%s_base + x(k)*item(k)%slide_axis, n_body, r, rot, v, omega, &
                            acceleration, alpha, at, at_dot, &
                            at_dot_dot)
         item(k)%along = turned(rot(:, :, a), item(k)%slide_axis)
         r(:, b) = at
         v(:, b) = at_dot + x_dot(k)*item(k)%along
         omega(:, b) = omega(:, a)
         item(k)%a_0 = at_dot_dot
         if (a == 0) cycle
         spin(:, b) = turned_back(rot(:, :, b), omega(:, b))
         item(k)%rise_0 = turned_back(rot(:, :, b), alpha(:, a))
         item(k)%a_0 = at_dot_dot + 2.0_wp*x_dot(k)*across(omega(:, a), item(k)%along)
      end do
   end subroutine place_sliding

   !> Rates of the coordinates and their derivatives at the motion that is set. Status 1 if one is not a finite number.
   pure subroutine spatial_rates(self, n_v, n_body, g, x_dot, rate, x_ddot, status)
      class(spatial_one_dof_t), intent(in) :: self      !! the bodies, moved
      integer, intent(in) :: n_v                       !! rates of a body
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: g(n_v, 0:n_body)         !! (6, 0:bodies) applied loads [N and N.m]
      real(wp), intent(in) :: x_dot(self%n)            !! (n) rates of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: rate(self%n)          !! (n) the same, derivatives of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: x_ddot(self%n)        !! (n) second derivatives [rad/s^2 or m/s^2]
      integer, intent(out) :: status                   !! 0: all finite

      call find_rates(self%n, self%held, self%item, n_body, g, x_dot, rate, x_ddot, status)
   end subroutine spatial_rates

   !> The same on plain arrays.
   pure subroutine find_rates(n, held, item, n_body, g, x_dot, rate, x_ddot, status)
      integer, intent(in) :: n                         !! number of bodies with one degree of freedom
      type(held_t), intent(in) :: held(n)              !! (n) how they are held
      type(spatial_guide_t), intent(in) :: item(n)     !! (n) the bodies, moved
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: g(6, 0:n_body)           !! (6, 0:bodies) applied loads [N and N.m]
      real(wp), intent(in) :: x_dot(n)                 !! (n) rates of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: rate(n)               !! (n) the same, derivatives of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: x_ddot(n)             !! (n) second derivatives [rad/s^2 or m/s^2]
      integer, intent(out) :: status                   !! 0: all finite

      real(wp) :: sum
      integer :: k

      sum = 0.0_wp
      do k = 1, n
         rate(k) = x_dot(k)
         x_ddot(k) = second_derivative(item(k), g(:, held(k)%body), item(k)%a_0, item(k)%rise_0)
         sum = sum + abs(x_ddot(k))
      end do
      status = merge(0, 1, ieee_is_finite(sum))
   end subroutine find_rates

   !> Second derivative of a coordinate under a load.
   pure real(wp) function second_derivative(item, g, a_0, rise_0) result(x_ddot)
      type(spatial_guide_t), intent(in) :: item   !! the body, moved
      real(wp), intent(in) :: g(6)                !! (6) load, gyroscopic moments among it [N and N.m]
      real(wp), intent(in) :: a_0(3)              !! (3) acceleration of the centre of mass without it [m/s^2]
      real(wp), intent(in) :: rise_0(3)           !! (3) angular acceleration without it, body frame [rad/s^2]

      x_ddot = item%along(1)*(g(1) - item%mass(1)*a_0(1)) + item%along(2)*(g(2) - item%mass(2)*a_0(2)) &
               + item%along(3)*(g(3) - item%mass(3)*a_0(3)) + item%turn(1)*(g(4) - item%mass(4)*rise_0(1)) &
               + item%turn(2)*(g(5) - item%mass(5)*rise_0(2)) + item%turn(3)*(g(6) - item%mass(6)*rise_0(3))
      x_ddot = item%ease*x_ddot
   end function second_derivative

   !> Accelerations of the bodies with one degree of freedom under loads, with those that they have by their motion or without: then
   !> what the loads add to them.
   pure subroutine spatial_response(self, g, with_own, motion, a)
      class(spatial_one_dof_t), intent(in) :: self      !! the bodies, moved
      real(wp), intent(in), contiguous :: g(:, 0:)     !! (6, 0:bodies) loads [N and N.m]
      logical, intent(in) :: with_own                  !! with the accelerations by the motion
      type(motion_t), intent(in) :: motion             !! not used: accelerations of the bases are in those by the motion
      real(wp), intent(inout), contiguous :: a(:, 0:)  !! (6, 0:bodies) accelerations of the rates [m/s^2 and rad/s^2]

      real(wp) :: a_0(3), rise_0(3), x_ddot
      integer :: b, k

      do k = 1, self%n
         b = self%held(k)%body
         a_0 = merge(self%item(k)%a_0, 0.0_wp, with_own)
         rise_0 = merge(self%item(k)%rise_0, 0.0_wp, with_own)
         x_ddot = second_derivative(self%item(k), g(:, b), a_0, rise_0)
         a(1:3, b) = a_0 + x_ddot*self%item(k)%along
         a(4:6, b) = rise_0 + x_ddot*self%item(k)%turn
      end do
   end subroutine spatial_response

   !> Accelerations of the bodies with one degree of freedom from the second derivatives of their coordinates, at the motion that is
   !> set.
   pure subroutine spatial_set_acceleration(self, x_ddot, motion)
      class(spatial_one_dof_t), intent(in) :: self     !! the bodies, moved
      real(wp), intent(in) :: x_ddot(self%n)          !! (n) second derivatives [rad/s^2 or m/s^2]
      type(motion_t), intent(inout) :: motion         !! accelerations of the bodies with one degree of freedom are set

      call accelerate(self%n, self%held, self%item, x_ddot, ubound(motion%angle, 1), motion%rot, motion%a, motion%alpha, &
                      motion%spatial%rise)
   end subroutine spatial_set_acceleration

   !> The same on plain arrays.
   pure subroutine accelerate(n, held, item, x_ddot, n_body, rot, a, alpha, rise)
      integer, intent(in) :: n                         !! number of bodies with one degree of freedom
      type(held_t), intent(in) :: held(n)              !! (n) how they are held
      type(spatial_guide_t), intent(in) :: item(n)     !! (n) the bodies, moved
      real(wp), intent(in) :: x_ddot(n)                !! (n) second derivatives [rad/s^2 or m/s^2]
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: rot(3, 3, 0:n_body)      !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(inout) :: alpha(3, 0:n_body)    !! (3, 0:bodies) angular accelerations, world frame [rad/s^2]
      real(wp), intent(inout) :: rise(3, 0:n_body)     !! (3, 0:bodies) angular accelerations, body frames [rad/s^2]

      integer :: b, k

      do k = 1, n
         b = held(k)%body
         a(:, b) = item(k)%a_0 + x_ddot(k)*item(k)%along
         rise(:, b) = item(k)%rise_0 + x_ddot(k)*item(k)%turn
         alpha(:, b) = turned(rot(:, :, b), rise(:, b))
      end do
   end subroutine accelerate

   !> Coordinates and rates from a motion of all bodies that fulfils the joints; turns come out within half a turn of zero.
   pure subroutine spatial_read_coordinates(self, motion, x, x_dot)
      class(spatial_one_dof_t), intent(in) :: self     !! the bodies
      type(motion_t), intent(in) :: motion            !! positions and velocities
      real(wp), intent(out) :: x(self%n)              !! (n) coordinates [rad or m]
      real(wp), intent(out) :: x_dot(self%n)          !! (n) their rates [rad/s or m/s]

      real(wp) :: c, from_base(3), s, u(3)
      integer :: a, b, k

      do k = 1, self%n
         a = self%held(k)%base
         b = self%held(k)%body
         associate (item => self%item(k), p => motion%spatial%p, rot => motion%rot)
            if (k <= self%n_turning) then
               ! parts of the parameters against the base that are along those at zero and at half a turn
               c = dot_product(product_of(p(:, a), item%q_0), p(:, b))
               s = dot_product(product_of(p(:, a), item%q_1), p(:, b))
               x(k) = 2.0_wp*atan2(merge(-s, s, c < 0.0_wp), abs(c))
               x_dot(k) = dot_product(item%turn, motion%spatial%spin(:, b) - turned_back(rot(:, :, b), motion%omega(:, a)))
               cycle
            end if
            u = turned(rot(:, :, a), item%slide_axis)
            from_base = motion%r(:, b) - motion%r(:, a)
            x(k) = dot_product(u, from_base - turned(rot(:, :, a), item%s_base))
            x_dot(k) = dot_product(u, motion%v(:, b) - motion%v(:, a) - across(motion%omega(:, a), from_base))
         end associate
      end do
   end subroutine spatial_read_coordinates

   !> Multipliers of the rows of the joints of bodies with one degree of freedom; the rows are evaluated.
   subroutine spatial_find_multipliers(self, n_which, which, n_v, n_body, rows, mass, g, a, lambda)
      class(spatial_one_dof_t), intent(in) :: self         !! the bodies
      integer, intent(in) :: n_which                      !! how many are meant
      integer, intent(in) :: which(n_which)               !! (n_which) their numbers
      integer, intent(in) :: n_v                          !! rates of a body
      integer, intent(in) :: n_body                       !! number of bodies
      type(rows_t), intent(in) :: rows                    !! all rows
      real(wp), intent(in) :: mass(n_v, n_body)           !! (6, bodies) masses [kg and kg.m^2]
      real(wp), intent(in) :: g(n_v, 0:n_body)            !! (6, 0:bodies) applied loads [N and N.m]
      real(wp), intent(in) :: a(n_v, 0:n_body)            !! (6, 0:bodies) accelerations of the rates [m/s^2 and rad/s^2]
      real(wp), intent(inout) :: lambda(rows%n)           !! (rows) multipliers; those of the joints' rows are set [N or N.m]

      real(wp) :: columns(6, n_held), matrix(n_held, n_held), rest(6), x(n_held)
      integer :: b, i, info, k, m, pivots(n_held), place

      do m = 1, n_which
         k = which(m)
         b = self%held(k)%body
         place = 6*(self%held(k)%side - 1)
         rest = g(1:6, b)/mass(1:6, b) - a(1:6, b)
         do i = 1, n_held
            columns(:, i) = rows%jac(place + 1:place + 6, self%held(k)%row(i))
         end do
         do i = 1, n_held
            x(i) = dot_product(columns(:, i), rest)
            matrix(:, i) = matmul(columns(:, i)/mass(1:6, b), columns)
         end do
         call dgetrf(n_held, n_held, matrix, n_held, pivots, info)
         call dgetrs("N", n_held, 1, matrix, n_held, pivots, x, n_held, info)
         do i = 1, n_held
            lambda(self%held(k)%row(i)) = x(i)
         end do
      end do
   end subroutine spatial_find_multipliers

end module spatial_one_dof
