!> Derivatives of the results of a motion by parameters, with their errors.
!>
!> The motion is found twice, the second time with a tenth of the tolerance and half the changes of parameters. That one counts.
!> Twice the difference of both is the error of each derivative, or the greatest relative difference of earlier ones where that is
!> more, so that two numbers that agree by chance do not seem exact; at least ten times the tolerance. Beyond the first onset that
!> both motions do not share, derivatives have no meaning.
module find_sensitivity
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use jobs, only: job_t
   use kinds, only: eps, not_a_number, wp
   use parameter_source, only: parameter_source_t
   use sensitivity_motion, only: find_motion
   use sensitivity_results, only: found_t, sensitivity_plan_t, sensitivity_t
   use text, only: real_text, text_t
   implicit none (type, external)
   private
   public :: compare_motions, find_sensitivities

   real(wp), parameter :: part_of_parameter = 1.0e-3_wp  !! changes of parameters, of them; twice that in the first motion [1]
   real(wp), parameter :: noise = 1.0e-12_wp     !! minimum error, or the tolerance: of results, by relative changes [1]
   real(wp), parameter :: of_tolerance = 10.0_wp !! minimum relative error, of the tolerance [1]
   real(wp), parameter :: tighter = 0.1_wp       !! tolerance of the second motion, of that of the first [1]
   real(wp), parameter :: shared = 1.0e-3_wp     !! difference of onsets that are the same, of the mean time between onsets [1]
   real(wp), parameter :: twice = 2.0_wp         !! error of a derivative, of the difference of both motions [1]
   real(wp), parameter :: useless = 0.1_wp       !! error of a derivative that is refused, of it [1]
   real(wp), parameter :: no_effect = 1.0e-9_wp  !! error of a derivative that is zero: of results, by relative changes [1]

contains

   !> Find the derivatives.
   subroutine find_sensitivities(job, source, plan, study, error)
      type(job_t), intent(inout) :: job                              !! scene and times
      class(parameter_source_t), target, intent(inout) :: source     !! where scenes with other parameters come from
      type(sensitivity_plan_t), intent(in) :: plan                   !! what is asked for
      type(sensitivity_t), intent(out) :: study                      !! what is found
      type(error_t), allocatable, intent(out) :: error               !! the motion failed

      type(found_t) :: first, second

      call find_motion(job, source, plan, plan%tolerance/tighter, 2.0_wp*part_of_parameter, first, error)
      if (.not. allocated(error)) call find_motion(job, source, plan, plan%tolerance, part_of_parameter, second, error)
      if (.not. allocated(error)) call compare_motions(plan, first, second, study)
   end subroutine find_sensitivities

   !> Derivatives and errors from two motions.
   subroutine compare_motions(plan, first, second, study)
      type(sensitivity_plan_t), intent(in) :: plan     !! what was asked for
      type(found_t), intent(in) :: first               !! the motion at the greater tolerance
      type(found_t), intent(in) :: second              !! the one that counts
      type(sensitivity_t), intent(out) :: study        !! what is found

      integer :: k, n, p

      study%plan = plan
      n = size(plan%results)
      p = size(plan%parameters)
      study%t = second%t
      study%value = second%value
      study%value_error = abs(second%value - first%value) + 4.0_wp*eps*abs(second%value)
      study%derivative = second%derivative
      study%grazing = second%grazing
      study%n_step = second%n_step
      study%n_event = second%n_event
      study%horizon = horizon_of(first%onset, second%onset)
      allocate (study%error(p, n), source=not_a_number())
      allocate (study%reason(p, n))
      do k = 1, p
         call find_errors(k, first, second, study)
      end do
   end subroutine compare_motions

   !> Errors of the derivatives by one parameter, and which of them are refused.
   subroutine find_errors(p, first, second, study)
      integer, intent(in) :: p                         !! number of the parameter
      type(found_t), intent(in) :: first               !! the motion at the greater tolerance
      type(found_t), intent(in) :: second              !! the one that counts
      type(sensitivity_t), intent(inout) :: study      !! errors and reasons are set

      real(wp) :: difference(size(second%t)), magnitude, relative
      logical :: is_known(size(second%t))
      integer :: k, m

      associate (d => second%derivative(p, :))
         is_known = ieee_is_finite(d) .and. ieee_is_finite(first%derivative(p, :))
         difference = 0.0_wp
         where (is_known) difference = abs(d - first%derivative(p, :))
         magnitude = abs(study%plan%values(p))
         if (.not. magnitude > 0.0_wp) magnitude = 1.0_wp
         do k = 1, size(d)
            study%reason(p, k)%s = reason_of(k)
            if (study%reason(p, k)%s == "") then
               relative = 0.0_wp
               do m = 1, size(d)
                  if (.not. is_known(m)) cycle
                  if (second%t(m) > second%t(k) .or. .not. abs(d(m))*magnitude > no_effect*abs(second%value(m))) cycle
                  if (difference(m) < useless*abs(d(m))) relative = max(relative, difference(m)/abs(d(m)))
               end do
               relative = max(relative, of_tolerance*study%plan%tolerance)
               study%error(p, k) = max(twice*difference(k), relative*abs(d(k)), &
                                       max(noise, study%plan%tolerance)*abs(second%value(k))/magnitude)
               if (study%error(p, k) > useless*abs(d(k)) .and. &
                   study%error(p, k)*magnitude > no_effect*abs(second%value(k))) then
                  study%reason(p, k)%s = "error "//real_text(study%error(p, k), 2)//" of the derivative "//real_text(d(k), 2)// &
                                         ": zero, or beyond the horizon"
               end if
            end if
            if (study%reason(p, k)%s == "") cycle
            study%derivative(p, k) = not_a_number()
            study%error(p, k) = not_a_number()
         end do
      end associate

   contains

      !> Why a derivative is refused, by what both motions have.
      function reason_of(k) result(reason)
         integer, intent(in) :: k                     !! the result
         character(:), allocatable :: reason          !! blank: it is not

         reason = ""
         if (.not. second%is_found(k)) then
            reason = "the motion has none until its end"
            return
         else if (second%t(k) >= study%horizon .or. .not. first%is_found(k)) then
            reason = "beyond the horizon at t = "//real_text(min(study%horizon, second%t(k)), 4)//" s"
         else if (.not. is_known(k)) then
            reason = second%reason(p)%s
            if (reason == "") reason = first%reason(p)%s
            if (reason == "") reason = "the equations cannot be solved beside the motion"
         end if
      end function reason_of

   end subroutine find_errors

   !> The first onset that two motions do not share.
   pure real(wp) function horizon_of(a, b) result(t)
      real(wp), intent(in) :: a(:)    !! (any) onsets of one [s]
      real(wp), intent(in) :: b(:)    !! (any) onsets of the other [s]

      integer :: k

      t = huge(1.0_wp)
      do k = 1, max(size(a), size(b))
         if (k > size(a)) then
            t = b(k)
         else if (k > size(b)) then
            t = a(k)
         else if (abs(a(k) - b(k)) > shared*b(k)/k) then
            t = min(a(k), b(k))
         end if
         if (t < huge(1.0_wp)) return
      end do
   end function horizon_of

end module find_sensitivity
