!> Bodies with one degree of freedom of the plane: see `reduced_bodies`.
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
!> Source: Flores et al. (2008), eqs. (2.1), (2.14), in the coordinate of the joint. Limits: the axis is fixed in the base.
module planar_one_dof
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use motion, only: motion_t
   use reduced_bodies, only: one_dof_bodies_t, held_t
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: planar_guide_t, planar_one_dof_t

   !> One body with one degree of freedom: all that the kernel reads of it, side by side.
   type :: planar_guide_t
      real(wp) :: arm(2) = 0.0_wp          !! (2) d in the frame of the body; sliding: u in that of the base [m or 1]
      real(wp) :: s_base(2) = 0.0_wp       !! (2) P, sliding: centre of mass at x = 0; frame of the base [m]
      real(wp) :: turned(2) = 0.0_wp       !! (2) sliding: cosine and sine of the next [1]
      real(wp) :: offset = 0.0_wp          !! sliding: angle of the body less that of its base [rad]
      real(wp) :: turns = 0.0_wp           !! 1: the body turns with the coordinate, 0: it slides [1]
      real(wp) :: mass = 0.0_wp            !! mass of the body [kg]
      integer :: body = 0                  !! the body, as `held` has it
      integer :: base = 0                  !! what it is tied to, 0: the ground
      real(wp) :: ease = 0.0_wp            !! one over what the freedom moves: I + m |d|^2, or m [1/(kg.m^2) or 1/kg]
      ! of the motion that is set
      real(wp) :: along(2) = 0.0_wp        !! (2) change of the centre of mass per coordinate, world frame [m or 1]
      real(wp) :: a_0(2) = 0.0_wp          !! (2) acceleration of the centre of mass at x'' = 0 [m/s^2]
   end type planar_guide_t

   !> All of them.
   type, extends(one_dof_bodies_t) :: planar_one_dof_t
      type(planar_guide_t), allocatable :: item(:)   !! (n) the bodies
   contains
      procedure :: move => planar_move
      procedure :: rates => planar_rates
      procedure :: response => planar_response
      procedure :: set_acceleration => planar_set_acceleration
      procedure :: read_coordinates => planar_read_coordinates
      procedure :: find_multipliers => planar_find_multipliers
   end type planar_one_dof_t

contains

   include "../../foundation/numerics/sine_cosine.inc"
   include "planar_one_dof.inc"

   !> Positions and velocities of the bodies with one degree of freedom; the motion of their bases is set, accelerations too.
   pure subroutine planar_move(self, x, x_dot, motion)
      class(planar_one_dof_t), intent(inout) :: self   !! the bodies
      real(wp), intent(in) :: x(self%n)               !! (n) coordinates [rad or m]
      real(wp), intent(in) :: x_dot(self%n)           !! (n) their rates [rad/s or m/s]
      type(motion_t), intent(inout) :: motion         !! the motion of the bodies with one degree of freedom is set

      associate (n => self%n_turning, n_body => ubound(motion%angle, 1))
         call place_turning(n, self%item, x, x_dot, n_body, motion%a, motion%alpha, motion%r, motion%rot, motion%v, motion%omega, &
                            motion%angle)
         if (n == self%n) return
         call place_sliding(n, self%n, self%item, x, x_dot, n_body, motion%a, motion%alpha, motion%r, motion%rot, motion%v, &
                            motion%omega, motion%angle)
      end associate
   end subroutine planar_move

   !> Rates of the coordinates and their derivatives at the motion that is set. Status 1 if one is not a finite number.
   pure subroutine planar_rates(self, n_v, n_body, g, x_dot, rate, x_ddot, status)
      class(planar_one_dof_t), intent(in) :: self       !! the bodies, moved
      integer, intent(in) :: n_v                       !! rates of a body
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: g(n_v, 0:n_body)         !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: x_dot(self%n)            !! (n) rates of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: rate(self%n)          !! (n) the same, derivatives of the coordinates [rad/s or m/s]
      real(wp), intent(inout) :: x_ddot(self%n)        !! (n) second derivatives [rad/s^2 or m/s^2]
      integer, intent(out) :: status                   !! 0: all finite

      call find_rates(self%n, self%item, n_body, g, g, x_dot, huge(1.0_wp), rate, x_ddot, status)
   end subroutine planar_rates

   !> Accelerations of the bodies with one degree of freedom under loads, with those that they have by their motion or without: then
   !> what the loads add to them.
   pure subroutine planar_response(self, g, with_own, motion, a)
      class(planar_one_dof_t), intent(in) :: self       !! the bodies, moved
      real(wp), intent(in), contiguous :: g(:, 0:)     !! (3, 0:bodies) loads [N, N, N.m]
      logical, intent(in) :: with_own                  !! with the accelerations by the motion
      type(motion_t), intent(in) :: motion             !! accelerations of the bases
      real(wp), intent(inout), contiguous :: a(:, 0:)  !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]

      real(wp) :: a_0(2), x_ddot
      integer :: b, k

      do k = 1, self%n
         b = self%held(k)%body
         a_0 = merge(self%item(k)%a_0, 0.0_wp, with_own)
         x_ddot = dot_product(self%item(k)%along, g(1:2, b) - self%item(k)%mass*a_0)
         if (k <= self%n_turning) x_ddot = x_ddot + g(3, b)
         x_ddot = self%item(k)%ease*x_ddot
         a(1:2, b) = a_0 + x_ddot*self%item(k)%along
         a(3, b) = merge(x_ddot, merge(motion%alpha(3, self%held(k)%base), 0.0_wp, with_own), k <= self%n_turning)
      end do
   end subroutine planar_response

   !> Accelerations of the bodies with one degree of freedom from the second derivatives of their coordinates, at the motion that is
   !> set.
   pure subroutine planar_set_acceleration(self, x_ddot, motion)
      class(planar_one_dof_t), intent(in) :: self      !! the bodies, moved
      real(wp), intent(in) :: x_ddot(self%n)          !! (n) second derivatives [rad/s^2 or m/s^2]
      type(motion_t), intent(inout) :: motion         !! accelerations of the bodies with one degree of freedom are set

      call accelerate(self%n, self%n_turning, self%held, self%item, x_ddot, ubound(motion%angle, 1), motion%a, motion%alpha)
   end subroutine planar_set_acceleration

   include "planar_accelerate.inc"

   !> Coordinates and rates from a motion of all bodies that fulfils the joints.
   pure subroutine planar_read_coordinates(self, motion, x, x_dot)
      class(planar_one_dof_t), intent(in) :: self      !! the bodies
      type(motion_t), intent(in) :: motion            !! positions and velocities
      real(wp), intent(out) :: x(self%n)              !! (n) coordinates [rad or m]
      real(wp), intent(out) :: x_dot(self%n)          !! (n) their rates [rad/s or m/s]

      real(wp) :: from_base(2), start(2), u(2)
      integer :: a, b, k

      do k = 1, self%n
         a = self%held(k)%base
         b = self%held(k)%body
         if (k <= self%n_turning) then
            x(k) = motion%angle(b)
            x_dot(k) = motion%omega(3, b)
            cycle
         end if
         u = matmul(motion%rot(1:2, 1:2, a), self%item(k)%arm)
         start = matmul(motion%rot(1:2, 1:2, a), self%item(k)%s_base)
         from_base = motion%r(1:2, b) - motion%r(1:2, a)
         x(k) = dot_product(u, from_base - start)
         x_dot(k) = dot_product(u, motion%v(1:2, b) - motion%v(1:2, a) - motion%omega(3, a)*[-from_base(2), from_base(1)])
      end do
   end subroutine planar_read_coordinates

   !> Multipliers of the rows of the joints of bodies with one degree of freedom; the rows are evaluated.
   subroutine planar_find_multipliers(self, n_which, which, n_v, n_body, rows, mass, g, a, lambda)
      class(planar_one_dof_t), intent(in) :: self          !! the bodies
      integer, intent(in) :: n_which                      !! how many are meant
      integer, intent(in) :: which(n_which)               !! (n_which) their numbers
      integer, intent(in) :: n_v                          !! rates of a body
      integer, intent(in) :: n_body                       !! number of bodies
      type(rows_t), intent(in) :: rows                    !! all rows
      real(wp), intent(in) :: mass(n_v, n_body)           !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: g(n_v, 0:n_body)            !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: a(n_v, 0:n_body)            !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: lambda(rows%n)           !! (rows) multipliers; those of the joints' rows are set [N or N.m]

      real(wp) :: determinant, p(3), q(3), rest(3), s(3), x(2)
      integer :: b, k, place

      do k = 1, n_which
         associate (held => self%held(which(k)))
            b = held%body
            place = 3*(held%side - 1)
            p = rows%jac(place + 1:place + 3, held%row(1))
            q = rows%jac(place + 1:place + 3, held%row(2))
            rest = g(1:3, b)/mass(1:3, b) - a(1:3, b)
            x = [dot_product(p, rest), dot_product(q, rest)]
            s = [dot_product(p, p/mass(1:3, b)), dot_product(p, q/mass(1:3, b)), dot_product(q, q/mass(1:3, b))]
            determinant = s(1)*s(3) - s(2)**2
            lambda(held%row(1)) = (s(3)*x(1) - s(2)*x(2))/determinant
            lambda(held%row(2)) = (s(1)*x(2) - s(2)*x(1))/determinant
         end associate
      end do
   end subroutine planar_find_multipliers

end module planar_one_dof
