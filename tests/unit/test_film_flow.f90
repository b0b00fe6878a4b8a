!> What leaves at the ends of a bearing: closed forms against the pressure field, the fit and the grid against published numbers.
module test_film_flow
   use check, only: check_close, suite_t
   use errors, only: error_t
   use film_case, only: film_case_t, make_film, motion_of
   use film_law, only: film_bearing_t, film_motion_t
   use finite_flow, only: flow_part
   use fixed_random, only: random_t
   use kinds, only: pi, two_pi, wp
   use published_films, only: rotation_eps, rotation_flow, rotation_ratio
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_film_flow

   real(wp), parameter :: speed = 300.0_wp  !! w_J + w_B [rad/s]

contains

   subroutine run_test_film_flow(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("short_films", test_short_films)
      call suite%test("fit", test_fit)
      call suite%test("published", test_published)
      call suite%test("limits", test_limits)
   end subroutine run_test_film_flow

   !> A bearing by its L/D.
   pure function bearing_of(ratio) result(bearing)
      real(wp), intent(in) :: ratio     !! L/D [1]
      type(film_bearing_t) :: bearing   !! the bearing

      bearing = film_bearing_t(0.03_wp, 6.0e-5_wp, 0.06_wp*ratio, 0.02_wp, 0.9999_wp)
   end function bearing_of

   !> Flow out of the ends of a short film where its pressure is positive, from the slope of the pressure there: with theta from the
   !> widest gap, p = 3 mu/c^2 (L^2/4 - z^2) [w sin(theta) - 2 eps' cos(theta)]/(1 + eps cos(theta))^3, between two angles.
   pure real(wp) function flow_of_pressure(bearing, eps, eps_dot, w, from, to) result(flow)
      type(film_bearing_t), intent(in) :: bearing  !! the bearing
      real(wp), intent(in) :: eps                  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot              !! its rate [1/s]
      real(wp), intent(in) :: w                    !! eps Om [rad/s]
      real(wp), intent(in) :: from, to             !! the angles [rad]

      integer, parameter :: n = 100000
      real(wp) :: gap, slope, theta
      integer :: k

      flow = 0.0_wp
      do k = 1, n
         theta = from + (to - from)*(k - 0.5_wp)/n
         gap = bearing%clearance*(1.0_wp + eps*cos(theta))
         slope = -3.0_wp*bearing%viscosity/bearing%clearance**2*bearing%length*(w*sin(theta) - 2.0_wp*eps_dot*cos(theta)) &
                 /(1.0_wp + eps*cos(theta))**3
         flow = flow + max(-2.0_wp*gap**3/(12.0_wp*bearing%viscosity)*slope, 0.0_wp)*bearing%radius*(to - from)/n
      end do
   end function flow_of_pressure

   !> Short films: all of the gap, or half of it.
   subroutine test_short_films(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: eps_dot(4) = [0.0_wp, 40.0_wp, -40.0_wp, 200.0_wp]
      type(film_bearing_t) :: bearing
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      integer :: k

      bearing = bearing_of(0.2_wp)
      do k = 1, size(eps_dot)
         call make_film("short_exact", " ", " ", bearing, case)
         motion = motion_of(case, 0.6_wp, eps_dot(k), speed, 0.3_wp)
         call check_close(error, case%law%side_flow(motion, case%parameters), &
                          flow_of_pressure(bearing, 0.6_wp, eps_dot(k), 0.6_wp*speed, 0.0_wp, two_pi), 1.0e-6_wp, "exact", &
                          relative=.true.)
         call make_film("short_sommerfeld", " ", " ", bearing, case)
         call check_close(error, case%law%side_flow(motion, case%parameters), &
                          flow_of_pressure(bearing, 0.6_wp, eps_dot(k), 0.6_wp*speed, 0.0_wp, two_pi), 1.0e-6_wp, "full", &
                          relative=.true.)
         call make_film("short_gumbel", " ", " ", bearing, case)
         call check_close(error, case%law%side_flow(motion, case%parameters), &
                          flow_of_pressure(bearing, 0.6_wp, eps_dot(k), 0.6_wp*speed, 0.0_wp, pi), 1.0e-6_wp, "half", &
                          relative=.true.)
      end do
   end subroutine test_short_films

   !> The fit against the film on a grid at states that it has not seen, for each film that has no flow of its own.
   subroutine test_fit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(17), parameter :: kinds(3) = ["finite           ", "pinkus_sternlicht", "long_exact       "]
      type(film_case_t) :: case, judge
      type(film_motion_t) :: motion
      type(random_t) :: random
      real(wp) :: eps, ratio
      integer :: k

      do k = 1, 40
         ratio = 0.25_wp*16.0_wp**random%between(0.0_wp, 1.0_wp)
         eps = random%between(0.0_wp, 0.98_wp)
         call make_film("grid", " ", " ", bearing_of(ratio), judge)
         call make_film(trim(kinds(1 + modulo(k, 3))), " ", " ", bearing_of(ratio), case)
         motion = motion_of(case, eps, random%between(-100.0_wp, 100.0_wp), speed, 0.7_wp)
         call check_close(error, case%law%side_flow(motion, case%parameters), judge%law%side_flow(motion, judge%parameters), &
                          0.01_wp, "L/D "//to_text(ratio)//", eps "//to_text(eps), relative=.true.)
      end do
   end subroutine test_fit

   !> Butenschoen's side flow of journals that turn: the film on a grid as its table means it, and the fit, which has no line
   !> without pressure at the widest gap, so that more leaves: 15 % at L/D = 1, 4 % from 1/2 down.
   subroutine test_published(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: motion
      real(wp) :: printed
      integer :: i, k

      do k = 1, size(rotation_ratio)
         do i = 1, size(rotation_eps), 3
            call make_film("grid", "supply", "widest_gap", bearing_of(rotation_ratio(k)), case)
            motion = motion_of(case, rotation_eps(i), 0.0_wp, speed, 0.3_wp)
            associate (b => case%bearing)
               printed = rotation_flow(i, k)*6.0_wp*rotation_ratio(k)*speed*b%clearance*b%radius**3/(3.0_wp*b%length)
               call check_close(error, case%law%side_flow(motion, case%parameters), printed, 0.008_wp, "grid", relative=.true.)
               call check_close(error, 2.0_wp*b%length*b%radius*0.5_wp*speed*b%clearance*rotation_eps(i) &
                                *flow_part(rotation_ratio(k), rotation_eps(i), 0.0_wp), printed, merge(0.15_wp, 0.04_wp, &
                                rotation_ratio(k) > 0.75_wp), "fit at L/D "//to_text(rotation_ratio(k))//", eps "// &
                                to_text(rotation_eps(i)), relative=.true.)
            end associate
         end do
      end do
   end subroutine test_published

   !> Beyond the fit: a short bearing gives out all that is squeezed away; a long one as much as its ends do by themselves.
   subroutine test_limits(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_close(error, flow_part(1.0e-3_wp, 0.5_wp, 0.2_wp), 1.0_wp, 1.0e-5_wp, "short")
      call check_close(error, flow_part(0.25_wp*(1.0_wp - 1.0e-9_wp), 0.5_wp, 0.2_wp), flow_part(0.25_wp, 0.5_wp, 0.2_wp), &
                       1.0e-9_wp, "no jump at 1/4")
      call check_close(error, 8.0_wp*flow_part(8.0_wp, 0.5_wp, 0.2_wp), 4.0_wp*flow_part(4.0_wp, 0.5_wp, 0.2_wp), &
                       1.0e-12_wp, "long")
   end subroutine test_limits

end module test_film_flow
