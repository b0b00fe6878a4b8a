!> Prescribed bodies of the plane: see `reduced_bodies`.
!>
!> angle_b = angle_a + offset + sign f(t),   r_b = r_a + s_a - s_b,   and the time derivatives of both.
!>
!> Source: Flores et al. (2008), eqs. (2.1), (2.14). Limits: drivers of angles.
module planar_prescribed
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use joint_set, only: joint_slot_t
   use kinds, only: wp
   use motion, only: motion_t
   use reduced_bodies, only: held_t, prescribed_bodies_t
   use rows, only: coordinate_place, n_v => n_v_planar, rows_t
   implicit none (type, external)
   private
   public :: planar_prescribed_t, planar_link_t

   !> One prescribed body: all that the kernel reads of it, side by side.
   type :: planar_link_t
      real(wp) :: s_body(2) = 0.0_wp      !! (2) common point in the frame of the body [m]
      real(wp) :: s_base(2) = 0.0_wp      !! (2) the same in the frame of its base [m]
      integer :: body = 0                 !! the body, as `held` has it
      integer :: base = 0                 !! what it is tied to, 0: the ground
      integer :: slot = 0                 !! set of its driver, 0: none
      integer :: driver = 0               !! its item there
      logical :: is_steady = .false.      !! that driver has a constant speed, which stands here: no call is made for it
      real(wp) :: start = 0.0_wp          !! f at t = 0 of a steady driver [rad]
      real(wp) :: speed = 0.0_wp          !! its f' [rad/s]
      real(wp) :: sign = 0.0_wp           !! of the driver's angle in that of the body; 0: rigid [1]
      real(wp) :: offset = 0.0_wp         !! angle of the body less that of its base, less sign times f [rad]
   end type planar_link_t

   !> All of them.
   type, extends(prescribed_bodies_t) :: planar_prescribed_t
      type(planar_link_t), allocatable :: item(:)   !! (n) the bodies
   contains
      procedure :: move => planar_move
      procedure, nopass :: power => planar_power
      procedure, nopass :: find_multipliers => find_fixing
   end type planar_prescribed_t

contains

   include "../../foundation/numerics/sine_cosine.inc"
   include "planar_prescribed.inc"

   !> Positions, velocities and accelerations of the prescribed bodies at a time; nothing to do if that is their present time.
   subroutine planar_move(self, joints, t, motion)
      class(planar_prescribed_t), intent(inout) :: self             !! the bodies
      type(joint_slot_t), intent(in), contiguous :: joints(:)  !! (sets) joints and drivers
      real(wp), intent(in) :: t                                !! time [s]
      type(motion_t), intent(inout) :: motion                  !! the motion of the prescribed bodies is set, accelerations too

      if (.not. abs(t - self%t) > 0.0_wp) return
      self%t = t
      call place_bodies(self%n, self%item, size(joints), joints, t, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, &
                        motion%omega, motion%angle, motion%a, motion%alpha, self%is_finite)
   end subroutine planar_move

   !> Power that the drivers of prescribed bodies give to the mechanism.
   pure real(wp) function planar_power(driven, rows, mass, g, lambda, motion) result(power)
      integer, intent(in), contiguous :: driven(:)        !! the prescribed bodies, and those that they guide
      type(rows_t), intent(in) :: rows                    !! the solved rows, evaluated
      real(wp), intent(in), contiguous :: mass(:, :)      !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in), contiguous :: g(:, 0:)        !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in), contiguous :: lambda(:)       !! (rows) multipliers of the solved rows [N or N.m]
      type(motion_t), intent(in) :: motion                !! motion, with accelerations

      power = power_of(size(driven), driven, size(rows%known, 2), rows%known, size(mass, 2), rows%n, rows%n_block, mass, g, &
                       rows%jac, lambda, motion%v, motion%omega, motion%a, motion%alpha)
   end function planar_power

   !> The same on plain arrays.
   pure real(wp) function power_of(n, body, n_known, known, n_body, n_row, n_block, mass, g, jac, lambda, v, omega, a, alpha) &
      result(power)
      integer, intent(in) :: n                      !! number of prescribed bodies
      integer, intent(in) :: body(n)                !! (n) the bodies
      integer, intent(in) :: n_known                !! sides of solved rows that are prescribed bodies
      integer, intent(in) :: known(3, n_known)      !! (3, known sides) row, place in the Jacobian, body
      integer, intent(in) :: n_body                 !! number of bodies
      integer, intent(in) :: n_row                  !! number of rows
      integer, intent(in) :: n_block                !! number of blocks of Phi_q
      real(wp), intent(in) :: mass(3, n_body)       !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: g(3, 0:n_body)        !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: jac(6*n_block)        !! (6 blocks) Phi_q, block by block [1 or m]
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
   end function power_of

   include "prescribed_multipliers.inc"

   !> Solution of three equations by Cramer's rule: columns are two unit forces with their moments and a unit moment,
   !> so that the determinant is one or minus one.
   subroutine solve_fixing(matrix, x)
      real(wp), intent(inout) :: matrix(3, 3)  !! (3, 3) gradients of the rows as columns [1 or m]
      real(wp), intent(inout) :: x(3)          !! (3) what they have to carry, then the multipliers [N, N, N.m]

      real(wp) :: b(3), c(3), first(3)

      b = x
      first = turned(matrix(:, 2), matrix(:, 3))
      x(1) = along(first, b)
      c = turned(matrix(:, 3), matrix(:, 1))
      x(2) = along(c, b)
      c = turned(matrix(:, 1), matrix(:, 2))
      x(3) = along(c, b)
      x = x/along(first, matrix(:, 1))

   contains

      !> Vector product, inlined.
      pure function turned(u, v) result(w)
         real(wp), intent(in) :: u(3)  !! (3) first factor [any]
         real(wp), intent(in) :: v(3)  !! (3) second factor [any]
         real(wp) :: w(3)              !! (3) the product [any]

         w(1) = u(2)*v(3) - u(3)*v(2)
         w(2) = u(3)*v(1) - u(1)*v(3)
         w(3) = u(1)*v(2) - u(2)*v(1)
      end function turned

      !> Scalar product, inlined.
      pure real(wp) function along(u, v)
         real(wp), intent(in) :: u(3)  !! (3) first factor [any]
         real(wp), intent(in) :: v(3)  !! (3) second factor [any]

         along = u(1)*v(1) + u(2)*v(2) + u(3)*v(3)
      end function along

   end subroutine solve_fixing

end module planar_prescribed
