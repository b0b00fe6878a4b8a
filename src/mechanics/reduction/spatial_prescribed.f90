!> Prescribed bodies of space: see `reduced_bodies`.
!>
!> A_b = A_a Q(f(t)),   r_b = r_a + s_a - s_b,   and the time derivatives of both,
!>
!> with Q the turn of the joint: Euler parameters of b are those of a times cos(f/2) q_0 + sin(f/2) q_1 (`place_turn`).
!>
!> Source: Flores et al. (2008), eqs. (6.1) to (6.5). Limits: drivers of angles.
module spatial_prescribed
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use joint_set, only: joint_slot_t
   use kinds, only: wp
   use lapack, only: dgetrf, dgetrs
   use motion, only: motion_t
   use reduced_bodies, only: held_t, prescribed_bodies_t
   use rows, only: coordinate_place, n_v => n_v_spatial, rows_t
   implicit none (type, external)
   private
   public :: spatial_prescribed_t, spatial_link_t

   !> One prescribed body.
   type :: spatial_link_t
      real(wp) :: q_0(4) = 0.0_wp         !! (4) Euler parameters against the base at angle zero [1]
      real(wp) :: q_1(4) = 0.0_wp         !! (4) those at half a turn [1]
      real(wp) :: axis(3) = 0.0_wp        !! (3) axis of the driver's angle, frame of the body, as the body turns; 0: rigid [1]
      real(wp) :: s_body(3) = 0.0_wp      !! (3) common point in the frame of the body [m]
      real(wp) :: s_base(3) = 0.0_wp      !! (3) the same in the frame of its base [m]
   end type spatial_link_t

   !> All of them.
   type, extends(prescribed_bodies_t) :: spatial_prescribed_t
      type(spatial_link_t), allocatable :: item(:)   !! (n) the bodies
   contains
      procedure :: move => spatial_move
      procedure, nopass :: power => spatial_power
      procedure, nopass :: find_multipliers => find_fixing
   end type spatial_prescribed_t

contains

   include "../../foundation/numerics/sine_cosine.inc"
   include "../../foundation/numerics/across.inc"
   include "../../foundation/numerics/turned.inc"
   include "carried_point.inc"

   !> Positions, velocities and accelerations of the prescribed bodies at a time, up to the first body whose driver says what is no
   !> finite number; nothing to do if that is their present time.
   subroutine spatial_move(self, joints, t, motion)
      class(spatial_prescribed_t), intent(inout) :: self            !! the bodies
      type(joint_slot_t), intent(in), contiguous :: joints(:)  !! (sets) joints and drivers
      real(wp), intent(in) :: t                                !! time [s]
      type(motion_t), intent(inout) :: motion                  !! the motion of the prescribed bodies is set, accelerations too

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      if (.not. abs(t - self%t) > 0.0_wp) return
      self%t = t
      do k = 1, self%n
         associate (held => self%held(k))
            f = 0.0_wp
            f_dot = 0.0_wp
            f_dot_dot = 0.0_wp
            if (held%slot > 0) call joints(held%slot)%set%prescription(held%item, t, f, f_dot, f_dot_dot)
            self%is_finite = ieee_is_finite(f + f_dot + f_dot_dot)
            if (.not. self%is_finite) return
            call place_body(held, self%item(k), f, f_dot, f_dot_dot, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, &
                            motion%omega, motion%a, motion%alpha, motion%spatial%p, motion%spatial%spin, motion%spatial%rise)
         end associate
      end do
      self%is_finite = .true.
   end subroutine spatial_move

   !> One body, on plain arrays.
   pure subroutine place_body(held, item, f, f_dot, f_dot_dot, n_body, r, rot, v, omega, acceleration, alpha, p, spin, rise)
      type(held_t), intent(in) :: held                      !! how it is held
      type(spatial_link_t), intent(in) :: item              !! the body
      real(wp), intent(in) :: f                             !! angle of its driver [rad]
      real(wp), intent(in) :: f_dot                         !! first time derivative [rad/s]
      real(wp), intent(in) :: f_dot_dot                     !! second time derivative [rad/s^2]
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(inout) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities, world frame [rad/s]
      real(wp), intent(inout) :: acceleration(3, 0:n_body)  !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(inout) :: alpha(3, 0:n_body)         !! (3, 0:bodies) angular accelerations, world frame [rad/s^2]
      real(wp), intent(inout) :: p(4, 0:n_body)             !! (4, 0:bodies) Euler parameters [1]
      real(wp), intent(inout) :: spin(3, 0:n_body)          !! (3, 0:bodies) angular velocities, body frames [rad/s]
      real(wp), intent(inout) :: rise(3, 0:n_body)          !! (3, 0:bodies) angular accelerations, body frames [rad/s^2]

      real(wp) :: at(3), at_dot(3), at_dot_dot(3), cosine, d(3), sine, u(3), wd(3)

      associate (a => held%base, b => held%body)
         call sine_cosine(0.5_wp*f, sine, cosine)
         call place_turn(cosine, sine, item%q_0, item%q_1, a, p(:, a), p(:, b), rot(:, :, b))
         call carried_point(a, item%s_base, n_body, r, rot, v, omega, acceleration, alpha, at, at_dot, at_dot_dot)
         u = turned(rot(:, :, b), item%axis)
         omega(:, b) = omega(:, a) + f_dot*u
         alpha(:, b) = alpha(:, a) + f_dot_dot*u + f_dot*across(omega(:, a), u)
         spin(:, b) = turned_back(rot(:, :, b), omega(:, b))
         rise(:, b) = turned_back(rot(:, :, b), alpha(:, b))
         d = -turned(rot(:, :, b), item%s_body)
         wd = across(omega(:, b), d)
         r(:, b) = at + d
         v(:, b) = at_dot + wd
         acceleration(:, b) = at_dot_dot + across(alpha(:, b), d) + across(omega(:, b), wd)
      end associate
   end subroutine place_body

   !> Power that the drivers of prescribed bodies give to the mechanism.
   pure real(wp) function spatial_power(driven, rows, mass, g, lambda, motion) result(power)
      integer, intent(in), contiguous :: driven(:)        !! the prescribed bodies, and those that they guide
      type(rows_t), intent(in) :: rows                    !! the solved rows, evaluated
      real(wp), intent(in), contiguous :: mass(:, :)      !! (6, bodies) masses [kg and kg.m^2]
      real(wp), intent(in), contiguous :: g(:, 0:)        !! (6, 0:bodies) applied loads [N and N.m]
      real(wp), intent(in), contiguous :: lambda(:)       !! (rows) multipliers of the solved rows [N or N.m]
      type(motion_t), intent(in) :: motion                !! motion, with accelerations

      integer :: b, block, k, place

      power = 0.0_wp
      do k = 1, size(driven)
         b = driven(k)
         power = power + sum((mass(1:3, b)*motion%a(:, b) - g(1:3, b))*motion%v(:, b)) &
                 + sum((mass(4:6, b)*motion%spatial%rise(:, b) - g(4:6, b))*motion%spatial%spin(:, b))
      end do
      do k = 1, size(rows%known, 2)
         block = rows%known(2, k)/12 + 1
         place = mod(rows%known(2, k), 12)
         b = rows%known(3, k)
         associate (row => rows%jac(:, block))
            power = power + lambda(rows%known(1, k))*(sum(row(place + 1:place + 3)*motion%v(:, b)) &
                                                      + sum(row(place + 4:place + 6)*motion%spatial%spin(:, b)))
         end associate
      end do
   end function spatial_power

   include "prescribed_multipliers.inc"

   !> Solution of the equations of the multipliers that fix a body, by factors with pivots. The rows of a joint and its driver are
   !> independent wherever the joint is whole, so that there is one.
   subroutine solve_fixing(matrix, x)
      real(wp), intent(inout) :: matrix(6, 6)  !! (6, 6) gradients of the rows as columns, destroyed [1 or m]
      real(wp), intent(inout) :: x(6)          !! (6) what they have to carry, then the multipliers [N or N.m]

      integer :: info, pivots(6)

      call dgetrf(6, 6, matrix, 6, pivots, info)
      call dgetrs("N", 6, 1, matrix, 6, pivots, x, 6, info)
   end subroutine solve_fixing

end module spatial_prescribed
