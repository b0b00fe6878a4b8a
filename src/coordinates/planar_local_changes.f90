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

   !> Values that are read, of all bodies or of one.
   module procedure planar_report
      integer :: k, m

      do m = 1, readings%n
         if (readings%item(m) > 0) then
            call report_body(readings%code(m), readings%item(m), motion, groups(readings%group(m)))
         else
            do k = 1, size(groups(readings%group(m))%data, 2)
               call report_body(readings%code(m), k, motion, groups(readings%group(m)))
            end do
         end if
      end do
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

   !> The value of a channel of one body.
   pure subroutine report_body(code, k, motion, group)
      integer, intent(in) :: code              !! the channel
      integer, intent(in) :: k                 !! the body
      type(motion_t), intent(in) :: motion     !! the motion, accelerations too
      type(group_t), intent(inout) :: group    !! values

      select case (code)
      case (of_position)
         group%data(1, k) = motion%r(1, k)
         group%data(2, k) = motion%r(2, k)
      case (of_velocity)
         group%data(1, k) = motion%v(1, k)
         group%data(2, k) = motion%v(2, k)
      case (of_acceleration)
         group%data(1, k) = motion%a(1, k)
         group%data(2, k) = motion%a(2, k)
      case (of_angle)
         group%data(1, k) = motion%angle(k)
      case (of_angular_velocity)
         group%data(1, k) = motion%omega(3, k)
      case (of_angular_acceleration)
         group%data(1, k) = motion%alpha(3, k)
      end select
   end subroutine report_body

end submodule planar_local_changes
