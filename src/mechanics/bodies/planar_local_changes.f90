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

   include "report_bodies.inc"

end submodule planar_local_changes
