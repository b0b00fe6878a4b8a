!> Errors of quadratures over what is allowed.
!>
!> Nothing depends on quadratures, and steps that follow a motion integrate its powers as well. Where drivers prescribe the motion
!> the estimates of its error are next to nothing, and only those of the quadratures limit the step. So they count in scenes with
!> drivers (those that have scales of quadratures), by one-step methods where the norm of the motion is below a thousandth of what
!> is allowed. A quadrature may have a number of tolerances of its scale, which is the largest energy or work so far: many by
!> one-step methods, whose estimates are those of a lower order and far beyond the error; by multistep methods, whose estimates are
!> the errors and add up, less than one, and some where the motion limits the steps as well and no events cut it.
module quadrature_error
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: allowed_by_multistep, by_one_step, counts_quadratures, max_error

   real(wp), parameter :: idle = 1.0e-3_wp        !! norm of a motion that does not limit the step, of what is allowed [1]
   real(wp), parameter :: by_one_step = 20.0_wp   !! estimate of a quadrature in a step, of the tolerance of its scale [1]
   real(wp), parameter :: by_multistep = 0.3_wp   !! the same of multistep methods [1]
   real(wp), parameter :: of_moving = 3.0_wp      !! the same where the motion limits their steps, too [1]

contains

   !> Whether the quadratures of a system limit a step.
   pure logical function counts_quadratures(system, norm)
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: norm               !! of the error of the motion, over what is allowed [1]

      counts_quadratures = norm <= idle .and. system%n_quadrature > 0 .and. system%traits%with_quadratures &
                           .and. allocated(system%traits%quadrature_scale)
   end function counts_quadratures

   !> Estimate of a quadrature that a multistep method allows, of the tolerance of its scale.
   pure real(wp) function allowed_by_multistep(norm) result(allowed)
      real(wp), intent(in) :: norm  !! of the error of the motion [1]

      allowed = merge(by_multistep, of_moving, norm <= idle)
   end function allowed_by_multistep

   !> Maximum error over its scale and what is allowed of it. An error that is not a number is skipped: no shorter step corrects it.
   pure real(wp) function max_error(n, error, scale, allowed) result(norm)
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
   end function max_error

end module quadrature_error
