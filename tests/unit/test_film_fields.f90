!> Pressures of films: their integral is the film's force, at any motion; gaps; films without pressures.
module test_film_fields
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_case, only: film_case_t, force_of, make_film, make_film_kind
   use film_law, only: film_bearing_t, film_motion_t
   use film_registry, only: n_journal_film_kinds
   use fixed_random, only: random_t
   use kinds, only: pi, two_pi, wp
   implicit none (type, external)
   private
   public :: run_test_film_fields

   integer, parameter :: n = 1440    !! angles of an integral
   integer, parameter :: m = 40      !! places of an integral
   type(film_bearing_t), parameter :: bearing = film_bearing_t(radius=10.0e-3_wp, clearance=50.0e-6_wp, length=15.0e-3_wp, &
                                                              viscosity=0.05_wp, eps_max=0.999_wp) !! the bearing

contains

   subroutine run_test_film_fields(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("force", test_force)
      call suite%test("forms", test_forms)
      call suite%test("gap", test_gap)
      call suite%test("without", test_without)
   end subroutine run_test_film_fields

   !> The force by the integral of the pressure over the journal, world frame, by the midpoint rule.
   function integral_of(case, motion) result(f)
      type(film_case_t), intent(in) :: case      !! the film
      type(film_motion_t), intent(in) :: motion  !! the motion
      real(wp) :: f(2)                           !! (2) force [N]

      real(wp), allocatable :: h(:, :), p(:, :), theta(:), y(:)
      integer :: j, k

      allocate (h(m, n), p(m, n))
      theta = [((k - 0.5_wp)*two_pi/n, k=1, n)]
      y = [((2*j - 1.0_wp)/m - 1.0_wp, j=1, m)]
      call case%law%field(motion, case%parameters, theta, y, p, h)
      f = 0.0_wp
      do k = 1, n
         f = f - sum(p(:, k))*bearing%length/m*bearing%radius*two_pi/n*[cos(theta(k) + motion%angle), sin(theta(k) + motion%angle)]
      end do
   end function integral_of

   !> A motion anywhere in the bearing, fast enough in both ways.
   subroutine random_motion(random, motion)
      type(random_t), intent(inout) :: random     !! random numbers
      type(film_motion_t), intent(out) :: motion  !! the motion

      real(wp) :: away, eps, gamma, speed

      eps = 0.05_wp + 0.8_wp*random%between(0.0_wp, 1.0_wp)
      gamma = two_pi*random%between(0.0_wp, 1.0_wp)
      away = two_pi*random%between(0.0_wp, 1.0_wp)
      speed = bearing%clearance*50.0_wp*random%between(0.0_wp, 1.0_wp)
      motion%e = bearing%clearance*eps*[cos(gamma), sin(gamma)]
      motion%e_dot = speed*[cos(away), sin(away)]
      motion%speed_sum = merge(100.0_wp, -100.0_wp, random%between(0.0_wp, 1.0_wp) > 0.5_wp)
      motion%speed_difference = motion%speed_sum
      motion%angle = two_pi*random%between(0.0_wp, 1.0_wp)
   end subroutine random_motion

   !> Force and integral of one film at random motions, the difference over the size of both.
   subroutine compare(case, tolerance, n_motion, error)
      type(film_case_t), intent(in) :: case              !! the film
      real(wp), intent(in) :: tolerance                  !! of the force [1]
      integer, intent(in) :: n_motion                    !! motions
      type(error_t), allocatable, intent(out) :: error   !! what failed

      type(film_motion_t) :: motion
      type(random_t) :: random
      real(wp) :: f(2)
      integer :: k

      do k = 1, n_motion
         call random_motion(random, motion)
         f = force_of(case, motion)
         call check_close(error, integral_of(case, motion), f, tolerance*norm2(f), case%name)
         if (allocated(error)) return
      end do
   end subroutine compare

   !> All kinds with pressures, their columns at their defaults.
   subroutine test_force(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      integer :: found, kind

      found = 0
      do kind = 1, n_journal_film_kinds()
         call make_film_kind(kind, bearing, case)
         if (.not. case%law%has_field()) cycle
         found = found + 1
         ! the half of a short film ends with a jump of the pressure, between two angles
         call compare(case, merge(1.0e-2_wp, 3.0e-3_wp, case%name == "grid" .or. case%name == "short_gumbel"), &
                      merge(3, 12, case%name == "grid"), error)
         if (allocated(error)) return
      end do
      call check_true(error, found >= 8, "films with pressures")
   end subroutine test_force

   !> Kinds with other forms.
   subroutine test_forms(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case

      call make_film("squeeze", "pressure", "positive", bearing, case)
      call compare(case, 3.0e-3_wp, 12, error)
      if (allocated(error)) return
      call make_film("short_gumbel", "form", "book", bearing, case)
      call compare(case, 1.0e-2_wp, 12, error)
      if (allocated(error)) return
      call make_film("long_gumbel", "form", "book", bearing, case)
      call compare(case, 3.0e-3_wp, 12, error)
   end subroutine test_forms

   !> The gap is smallest where the journal is, and the clearance less the eccentricity; the same of every film.
   subroutine test_gap(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: motion
      real(wp) :: h(1, 3), p(1, 3)
      integer :: kind

      motion%e = bearing%clearance*0.6_wp*[cos(2.0_wp), sin(2.0_wp)]
      motion%angle = 0.7_wp
      do kind = 1, n_journal_film_kinds()
         call make_film_kind(kind, bearing, case)
         call case%law%field(motion, case%parameters, 2.0_wp - 0.7_wp + [0.0_wp, 0.5_wp*pi, pi], [0.3_wp], p, h)
         call check_close(error, h(1, :)/bearing%clearance, [0.4_wp, 1.0_wp, 1.6_wp], 1.0e-12_wp, case%name)
         if (allocated(error)) return
      end do
   end subroutine test_gap

   !> A film that is a force only has pressures that are no numbers.
   subroutine test_without(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: motion
      real(wp) :: h(2, 2), p(2, 2)
      integer :: kind

      motion%e = [1.0e-5_wp, 0.0_wp]
      motion%speed_sum = 1.0_wp
      do kind = 1, n_journal_film_kinds()
         call make_film_kind(kind, bearing, case)
         call case%law%field(motion, case%parameters, [0.1_wp, 4.0_wp], [-0.5_wp, 0.0_wp], p, h)
         call check_true(error, all(ieee_is_nan(p)) .neqv. case%law%has_field(), case%name)
         if (allocated(error)) return
      end do
   end subroutine test_without

end module test_film_fields
