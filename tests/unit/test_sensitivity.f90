!> Derivatives of a ball that falls on a linear spring, against closed forms; what is refused.
module test_sensitivity
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use find_sensitivity, only: find_sensitivities
   use jobs, only: job_t
   use kinds, only: pi, wp
   use parameter_source, only: parameter_source_t
   use scene_fixture, only: nl
   use sensitivity_results, only: result_duration, result_impact_speed, result_names, result_onset, &
      result_peak_force, result_peak_penetration, result_release_speed, sensitivity_plan_t, sensitivity_t
   use text, only: exact_text
   implicit none (type, external)
   private
   public :: run_test_sensitivity

   real(wp), parameter :: gravity = 10.0_wp                              ! [m/s^2]
   real(wp), parameter :: values(3) = [0.05_wp, 1.0e5_wp, 0.5_wp]        ! height [m], stiffness [N/m], mass [kg]
   integer, parameter :: kinds_asked(6) = [result_onset, result_impact_speed, result_peak_force, result_peak_penetration, &
                                           result_duration, result_release_speed]

   !> The ball: height, stiffness and mass are its parameters.
   type, extends(parameter_source_t) :: ball_t
      character(:), allocatable :: method    !! of the integration
      real(wp) :: most = huge(1.0_wp)        !! maximum of each parameter that it takes [any]
   contains
      procedure :: make => make_ball
   end type ball_t

contains

   !> Register the tests.
   subroutine run_test_sensitivity(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("closed_forms", test_closed_forms)
      call suite%test("other_methods", test_other_methods)
      call suite%test("parameter_at_a_bound", test_bound)
   end subroutine run_test_sensitivity

   !> The deck with some values.
   function deck_of(x, method) result(deck)
      real(wp), intent(in) :: x(3)              !! (3) height, stiffness, mass [m, N/m, kg]
      character(*), intent(in) :: method        !! of the integration
      character(:), allocatable :: deck         !! its text

      deck = "deck = 1"//nl//"[scene]"//nl//"gravity = 0 -10 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] y[m]"//nl// &
             "ball "//exact_text(x(3))//" 0.1 "//exact_text(x(1) + 0.1_wp)//nl// &
             "[points]"//nl//"name body"//nl//"origin ground"//nl//"centre ball"//nl// &
             "[material]"//nl//"name young[GPa] poisson density[kg/m^3]"//nl//"steel 207 0.3 7850"//nl// &
             "[clearance.plane]"//nl//"name plane ball axis radius[m] material law"//nl// &
             "floor origin centre y 0.1 steel spring"//nl// &
             "[contact.kelvin_voigt]"//nl//"name stiffness[N/m] restitution"//nl//"spring "//exact_text(x(2))//" 1"//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"end = 0.15 s"//nl//"method = "//method//nl
   end function deck_of

   !> The ball with one parameter changed.
   subroutine make_ball(self, parameter, value, job, reason)
      class(ball_t), intent(inout) :: self                !! the ball
      integer, intent(in) :: parameter                    !! number of the parameter
      real(wp), intent(in) :: value                       !! its value [any]
      type(job_t), intent(inout) :: job                   !! the scene with it
      character(:), allocatable, intent(out) :: reason    !! its bound, if it is beyond

      type(error_t), allocatable :: error
      real(wp) :: x(3)

      x = values
      x(parameter) = value
      reason = ""
      if (value > self%most*values(parameter)) reason = "beyond its bound"
      if (reason == "") call job_of(x, self%method, job, error)
      if (allocated(error)) reason = error%message
   end subroutine make_ball

   !> The job of a ball.
   subroutine job_of(x, method, job, error)
      real(wp), intent(in) :: x(3)                        !! (3) height, stiffness, mass [m, N/m, kg]
      character(*), intent(in) :: method                  !! of the integration
      type(job_t), intent(out) :: job                     !! the job
      type(error_t), allocatable, intent(out) :: error    !! the deck has an error

      type(loaded_t) :: loaded

      call load_text(deck_of(x, method), loaded, error)
      if (allocated(error)) return
      job%scene = loaded%scene
      job%plan = loaded%plan
   end subroutine job_of

   !> Results of contact 1 by all parameters.
   subroutine derive(method, most, study, error)
      character(*), intent(in) :: method                  !! of the integration
      real(wp), intent(in) :: most                        !! maximum of parameters, over their values [1]
      type(sensitivity_t), intent(out) :: study           !! what is found
      type(error_t), allocatable, intent(out) :: error    !! what failed

      type(ball_t), target :: ball
      type(job_t) :: job
      type(sensitivity_plan_t) :: plan
      integer :: k

      ball%method = method
      ball%most = most
      call job_of(values, method, job, error)
      if (allocated(error)) return
      allocate (plan%parameters(3), plan%results(size(kinds_asked)))
      plan%parameters(1)%s = "height"
      plan%parameters(2)%s = "stiffness"
      plan%parameters(3)%s = "mass"
      plan%units = plan%parameters
      plan%values = values
      plan%tolerance = 1.0e-11_wp
      plan%end = 0.15_wp
      do k = 1, size(kinds_asked)
         associate (asked => plan%results(k))
            asked%word = trim(result_names(kinds_asked(k)))
            asked%unit = ""
            asked%kind = kinds_asked(k)
            asked%first = 1
            asked%last = 1
            asked%ordinal = 1
         end associate
      end do
      call find_sensitivities(job, ball, plan, study, error)
   end subroutine derive

   !> Results and derivatives. With v^2 = 2 g H, s = m g/k, w^2 = k/m the penetration is s (1 - cos w t) + (v/w) sin w t.
   pure subroutine closed_forms(value, derivative)
      real(wp), intent(out) :: value(6)            !! (6) results [any]
      real(wp), intent(out) :: derivative(3, 6)    !! (3, 6) by height, stiffness, mass [any]

      real(wp) :: dr(3), dratio(3), ds(3), dv(3), dw(3), r, ratio, s, v, w

      associate (height => values(1), stiffness => values(2), mass => values(3))
         v = sqrt(2.0_wp*gravity*height)
         s = mass*gravity/stiffness
         w = sqrt(stiffness/mass)
         r = sqrt(s**2 + (v/w)**2)
         ratio = s*w/v
         dv = [gravity/v, 0.0_wp, 0.0_wp]
         ds = [0.0_wp, -s/stiffness, s/mass]
         dw = [0.0_wp, 0.5_wp*w/stiffness, -0.5_wp*w/mass]
         dr = (s*ds + v/w*(dv/w - v*dw/w**2))/r
         dratio = ratio*(ds/s + dw/w - dv/v)
         value = [v/gravity, v, stiffness*(s + r), s + r, (pi + 2.0_wp*atan(ratio))/w, v]
         derivative(:, 1) = dv/gravity
         derivative(:, 2) = dv
         derivative(:, 3) = stiffness*(ds + dr)
         derivative(2, 3) = derivative(2, 3) + s + r
         derivative(:, 4) = ds + dr
         derivative(:, 5) = 2.0_wp*dratio/(1.0_wp + ratio**2)/w - value(5)*dw/w
         derivative(:, 6) = dv
      end associate
   end subroutine closed_forms

   !> All results by all parameters, within the stated errors, which are small.
   subroutine compare(method, tolerance, error)
      character(*), intent(in) :: method                   !! of the integration
      real(wp), intent(in) :: tolerance                    !! of a derivative times its parameter, of the result [1]
      type(error_t), allocatable, intent(inout) :: error   !! what failed

      type(sensitivity_t) :: study
      real(wp) :: derivative(3, 6), scale, value(6)
      integer :: k, p

      call derive(method, huge(1.0_wp), study, error)
      if (allocated(error)) return
      call closed_forms(value, derivative)
      do k = 1, 6
         call check_close(error, study%value(k), value(k), 1.0e-9_wp, method//": "//study%plan%results(k)%word, .true.)
         do p = 1, 3
            scale = value(k)/values(p)
            associate (what => method//": "//study%plan%results(k)%word//" by "//study%plan%parameters(p)%s)
               call check_equal(error, len(study%reason(p, k)%s), 0, what//": not refused")
               call check_close(error, study%derivative(p, k), derivative(p, k), tolerance*scale, what)
               call check_close(error, study%derivative(p, k), derivative(p, k), 3.0_wp*study%error(p, k), what//": stated error")
               call check_true(error, study%error(p, k) <= 30.0_wp*tolerance*scale, what//": the stated error is small")
            end associate
         end do
      end do
   end subroutine compare

   !> The explicit method that stands for `auto`.
   subroutine test_closed_forms(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("auto", 3.0e-10_wp, error)
   end subroutine test_closed_forms

   !> Another explicit one, and an implicit one.
   subroutine test_other_methods(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("verner", 3.0e-10_wp, error)
      if (.not. allocated(error)) call compare("dop853", 3.0e-10_wp, error)
      if (.not. allocated(error)) call compare("radau", 1.0e-7_wp, error)
   end subroutine test_other_methods

   !> A parameter next to its bound has derivatives; one at it is refused, with the reason.
   subroutine test_bound(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(sensitivity_t) :: study

      call derive("verner", 1.0_wp + 1.0e-5_wp, study, error)
      if (allocated(error)) return
      call check_equal(error, len(study%reason(1, 3)%s), 0, "next to the bound")
      call derive("verner", 1.0_wp, study, error)
      if (allocated(error)) return
      call check_true(error, index(study%reason(1, 3)%s, "beyond its bound") > 0, "at the bound: "//study%reason(1, 3)%s)
      call check_true(error, ieee_is_nan(study%derivative(1, 3)), "no derivative")
   end subroutine test_bound

end module test_sensitivity
