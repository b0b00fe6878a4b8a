!> The values of what expressions see of a motion, and of the places that requests report of.
!>
!> With r, v, a of the point P less those of the origin O, world frame, A the axes of body F, omega and alpha of it:
!>
!> position  A^T r
!> velocity  A^T v,  as an observer in F sees it A^T (v - omega x r)
!> acceleration  A^T a,  as F sees it A^T (a - alpha x r - 2 omega x (v - omega x r) - omega x (omega x r))
!> distance |r|, its rate r . v/|r|, zero where both points coincide
!>
!> The axes of a spatial body are its own, as the deck gives them. Source: Flores et al. (2008), eqs. (2.1), (6.1). Limits: none.
module observed_motion
   use expression, only: expression_t, most_seen
   use kinds, only: wp
   use motion, only: cross, motion_t, point_position, point_velocity
   use observable, only: place_t, sees_acceleration, sees_angle, sees_angular_velocity, sees_distance, sees_distance_rate, &
      sees_position, sees_state, sees_velocity, observable_t
   implicit none (type, external)
   private
   public :: place_values, value_of

contains

   !> Value of an expression at a time and a motion. No allocation.
   pure real(wp) function value_of(expression, t, motion) result(value)
      type(expression_t), intent(in) :: expression   !! the expression
      real(wp), intent(in) :: t                      !! time [s]
      type(motion_t), intent(in) :: motion           !! positions and velocities

      real(wp) :: first_derivative, second_derivative, x(1 + most_seen)
      integer :: k

      if (.not. allocated(expression%observables)) then
         call expression%evaluate(t, value, first_derivative, second_derivative)
         return
      end if
      x(1) = t
      do k = 1, size(expression%observables)
         x(1 + k) = value_of_observable(expression%observables(k), motion)
      end do
      call expression%evaluate_seeing(x(:1 + size(expression%observables)), 1, value, first_derivative)
   end function value_of

   !> What is seen, at a motion.
   pure real(wp) function value_of_observable(observable, motion) result(value)
      type(observable_t), intent(in) :: observable       !! what is seen
      type(motion_t), intent(in) :: motion     !! positions and velocities

      real(wp) :: x(3)

      select case (observable%quantity)
      case (sees_angle)
         value = motion%angle(observable%place%body)
      case (sees_angular_velocity)
         value = motion%omega(observable%component, observable%place%body)
      case (sees_state)
         value = motion%states(observable%component)
      case default
         x = place_values(observable%place, observable%quantity, motion)
         value = x(observable%component)
      end select
   end function value_of_observable

   !> A quantity of a place: three components, or a number and zeros.
   pure function place_values(place, quantity, motion) result(x)
      type(place_t), intent(in) :: place       !! the place
      integer, intent(in) :: quantity          !! one of `observable`
      type(motion_t), intent(in) :: motion     !! positions and velocities; for accelerations these too
      real(wp) :: x(3)                         !! (3) along the axes of the place's frame [m, m/s or m/s^2]

      real(wp) :: a(3), distance, p(3), p_origin(3), r(3), v(3)

      p = point_position(motion, place%body, place%s)
      p_origin = point_position(motion, place%origin_body, place%origin_s)
      r = p - p_origin
      x = r
      if (quantity /= sees_position) then
         v = point_velocity(motion, place%body, p) - point_velocity(motion, place%origin_body, p_origin)
      end if
      associate (omega => motion%omega(:, place%frame), alpha => motion%alpha(:, place%frame))
         select case (quantity)
         case (sees_velocity)
            x = v
            if (place%turns_with) x = v - cross(omega, r)
         case (sees_acceleration)
            a = acceleration_of(motion, place%body, p) - acceleration_of(motion, place%origin_body, p_origin)
            x = a
            if (place%turns_with) x = a - cross(alpha, r) - 2.0_wp*cross(omega, v - cross(omega, r)) - cross(omega, cross(omega, r))
         case (sees_distance, sees_distance_rate)
            distance = norm2(r)
            x = [distance, 0.0_wp, 0.0_wp]
            if (quantity == sees_distance) return
            x = 0.0_wp
            if (distance > 0.0_wp) x(1) = dot_product(r, v)/distance
            return
         end select
      end associate
      if (place%frame == 0) return
      x = matmul(x, motion%rot(:, :, place%frame))
      if (allocated(motion%spatial%own)) x = matmul(motion%spatial%own(:, :, place%frame), x)
   end function place_values

   !> Acceleration of the point of a body that is at a world position now.
   pure function acceleration_of(motion, body, p) result(a)
      type(motion_t), intent(in) :: motion  !! the motion with its accelerations
      integer, intent(in) :: body           !! the body
      real(wp), intent(in) :: p(3)          !! (3) the position, world frame [m]
      real(wp) :: a(3)                      !! (3) acceleration, world frame [m/s^2]

      a = motion%a(:, body) + cross(motion%alpha(:, body), p - motion%r(:, body)) &
          + cross(motion%omega(:, body), cross(motion%omega(:, body), p - motion%r(:, body)))
   end function acceleration_of

end module observed_motion
