!> Small changes along the axes of bodies in the plane, and what is reported of them.
submodule(planar_coordinates) planar_local_changes
   use sines, only: sines_of => sine_cosine
   implicit none (type, external)

contains

   !> Along the bodies' axes; turns are the same.
   module procedure planar_to_local
      call turn(n, q, -1.0_wp, q_change, v_change, x, w)
   end procedure planar_to_local

   !> Along the world's axes.
   module procedure planar_from_local
      call turn(n, q, 1.0_wp, x, w, q_change, v_change)
   end procedure planar_from_local

   !> Values that are read, body by body.
   module procedure planar_report
      call report_bodies(readings%n, readings%of, ubound(motion%angle, 1), motion%r, motion%v, motion%a, motion%angle, &
                         motion%omega, motion%alpha, size(values), values)
   end procedure planar_report

   !> Two vectors for each body, turned by its angle or back.
   pure subroutine turn(n, q, sense, x, w, x_turned, w_turned)
      integer, intent(in) :: n                   !! how many bodies
      real(wp), intent(in) :: q(3, n)            !! (3, n) x, y, angle [m, m, rad]
      real(wp), intent(in) :: sense              !! 1: from the body's axes to the world's, -1: back [1]
      real(wp), intent(in) :: x(3, n)            !! (3, n) x, y and angle of the first [any]
      real(wp), intent(in) :: w(3, n)            !! (3, n) of the second [any]
      real(wp), intent(out) :: x_turned(3, n)    !! (3, n) the first turned [any]
      real(wp), intent(out) :: w_turned(3, n)    !! (3, n) the second turned [any]

      real(wp) :: c, s
      integer :: k

      do k = 1, n
         call sines_of(q(3, k), s, c)
         s = sense*s
         x_turned(:, k) = [c*x(1, k) - s*x(2, k), s*x(1, k) + c*x(2, k), x(3, k)]
         w_turned(:, k) = [c*w(1, k) - s*w(2, k), s*w(1, k) + c*w(2, k), w(3, k)]
      end do
   end subroutine turn

   !> The same on plain arrays.
   pure subroutine report_bodies(n, reading, n_body, r, v, a, angle, omega, alpha, n_value, values)
      integer, intent(in) :: n                         !! channels that are read
      type(reading_t), intent(in) :: reading(n)        !! (n) the channels of the bodies
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)           !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: v(3, 0:n_body)           !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: a(3, 0:n_body)           !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(in) :: angle(0:n_body)          !! (0:bodies) angles [rad]
      real(wp), intent(in) :: omega(3, 0:n_body)       !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: alpha(3, 0:n_body)       !! (3, 0:bodies) angular accelerations [rad/s^2]
      integer, intent(in) :: n_value                   !! values of the catalogue
      real(wp), intent(inout) :: values(n_value)       !! (n_value) they, those that are read are set [any]

      integer :: at, k, m

      do m = 1, n
         at = reading(m)%place
         k = reading(m)%item
         select case (reading(m)%code)
         case (of_position)
            values(at + 1) = r(1, k)
            values(at + 2) = r(2, k)
         case (of_velocity)
            values(at + 1) = v(1, k)
            values(at + 2) = v(2, k)
         case (of_acceleration)
            values(at + 1) = a(1, k)
            values(at + 2) = a(2, k)
         case (of_angle)
            values(at + 1) = angle(k)
         case (of_angular_velocity)
            values(at + 1) = omega(3, k)
         case (of_angular_acceleration)
            values(at + 1) = alpha(3, k)
         end select
      end do
   end subroutine report_bodies

end submodule planar_local_changes
