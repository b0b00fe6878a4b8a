!> Errors of quadratures over what is allowed.
!>
!> Nothing depends on quadratures, so what their error does not spoil need not be accurate for their sake: where the motion is
!> prescribed the estimates of its error are zero, and only those of the quadratures limit the step. The greatest of both norms
!> counts. A quadrature may have a number of tolerances of its scale, which is the largest energy or work so far: many by one-step
!> methods, whose estimates are those of a lower order and far beyond the error, less than one by multistep methods, whose
!> estimates are the errors and add up. A scene whose steps follow its motion within that keeps them to the last bit.
module quadrature_error
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: by_multistep, by_one_step, counts_quadratures, greatest_error

   real(wp), parameter :: by_one_step = 20.0_wp   !! estimate of a quadrature in a step, of the tolerance of its scale [1]
   real(wp), parameter :: by_multistep = 0.3_wp   !! the same of multistep methods [1]

contains

   !> Whether the quadratures of a system are under error control.
   pure logical function counts_quadratures(system)
      class(ode_system_t), intent(in) :: system  !! the system

      counts_quadratures = system%n_quadrature > 0 .and. system%traits%with_quadratures &
                           .and. allocated(system%traits%quadrature_scale)
   end function counts_quadratures

   !> Greatest error over its scale and what is allowed of it. An error that is not a number is skipped: no shorter step mends it.
   pure real(wp) function greatest_error(n, error, scale, allowed) result(norm)
      integer, intent(in) :: n          !! number of quadratures
      real(wp), intent(in) :: error(n)  !! (n) estimates of their errors [any]
      real(wp), intent(in) :: scale(n)  !! (n) their scales [any]
      real(wp), intent(in) :: allowed   !! error that is allowed, of the scale [1]

      integer :: i

      norm = 0.0_wp
      do i = 1, n
         if (abs(error(i)) > norm*scale(i)) norm = abs(error(i))/scale(i)
      end do
      norm = norm/allowed
   end function greatest_error

end module quadrature_error
