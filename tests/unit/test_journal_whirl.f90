!> Stiffness and damping of films against published formulas and against what isotropy and homogeneity ask for; the limit of whirl.
module test_journal_whirl
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_case, only: film_case_t, force_of, make_film, make_film_kind, motion_of
   use film_law, only: film_bearing_t, film_motion_t, film_slopes_t
   use film_registry, only: n_journal_film_kinds
   use journal_whirl, only: find_whirl, whirl_t
   use kinds, only: pi, wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_journal_whirl

   type(film_bearing_t), parameter :: bearing = film_bearing_t(0.03_wp, 6.0e-5_wp, 0.03_wp, 0.02_wp, 0.9999_wp)  !! L/D = 0.5
   real(wp), parameter :: speed = 300.0_wp  !! of the journal [rad/s]

contains

   subroutine run_test_journal_whirl(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("published_short", test_published_short)
      call suite%test("isotropic_and_homogeneous", test_isotropic_and_homogeneous)
      call suite%test("limit_of_whirl", test_limit_of_whirl)
      call suite%test("film_at_rest", test_film_at_rest)
   end subroutine run_test_journal_whirl

   !> Half film of a short bearing: the closed forms of textbooks (M. I. Friswell et al., Dynamics of Rotating Machines (2010),
   !> section 5.5; load along the second axis).
   subroutine test_published_short(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: eps(4) = [0.05_wp, 0.3_wp, 0.7_wp, 0.95_wp]
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(film_slopes_t) :: slopes
      real(wp) :: b(2, 2), f(2), frame(2, 2), k(2, 2), load
      integer :: i

      call make_film("short_gumbel", " ", " ", bearing, case)
      do i = 1, size(eps)
         motion = motion_of(case, eps(i), 0.0_wp, speed, 0.4_wp)
         call case%law%linearise(motion, case%parameters, slopes)
         f = force_of(case, motion)
         load = norm2(f)
         frame(:, 2) = f/load
         frame(:, 1) = [frame(2, 2), -frame(1, 2)]
         k = matmul(transpose(frame), matmul(slopes%stiffness, frame))*bearing%clearance/load
         b = matmul(transpose(frame), matmul(slopes%damping, frame))*bearing%clearance*speed/load
         call check_close(error, reshape(k, [4]), reshape(short_stiffness(eps(i)), [4]), 1.0e-8_wp*maxval(abs(k)), &
                          "stiffness at "//to_text(eps(i)))
         call check_close(error, reshape(b, [4]), reshape(short_damping(eps(i)), [4]), 1.0e-8_wp*maxval(abs(b)), &
                          "damping at "//to_text(eps(i)))
         call check_true(error, slopes%error < 1.0e-8_wp, "error that is told")
      end do
   end subroutine test_published_short

   !> Stiffness over load and clearance.
   pure function short_stiffness(eps) result(a)
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp) :: a(2, 2)          !! (2, 2) across the load and along it [1]

      real(wp) :: q, root

      q = 1.0_wp - eps**2
      root = sqrt(q)
      a(1, 1) = 4.0_wp*(pi**2*(2.0_wp - eps**2) + 16.0_wp*eps**2)
      a(1, 2) = pi*(pi**2*q**2 - 16.0_wp*eps**4)/(eps*root)
      a(2, 1) = -pi*(pi**2*q*(1.0_wp + 2.0_wp*eps**2) + 32.0_wp*eps**2*(1.0_wp + eps**2))/(eps*root)
      a(2, 2) = 4.0_wp*(pi**2*(1.0_wp + 2.0_wp*eps**2) + 32.0_wp*eps**2*(1.0_wp + eps**2)/q)
      a = a/(pi**2*q + 16.0_wp*eps**2)**1.5_wp
   end function short_stiffness

   !> Damping over load, clearance and speed.
   pure function short_damping(eps) result(b)
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp) :: b(2, 2)          !! (2, 2) across the load and along it [1]

      real(wp) :: q, root

      q = 1.0_wp - eps**2
      root = sqrt(q)
      b(1, 1) = 2.0_wp*pi*root*(pi**2*(1.0_wp + 2.0_wp*eps**2) - 16.0_wp*eps**2)/eps
      b(1, 2) = -8.0_wp*(pi**2*(1.0_wp + 2.0_wp*eps**2) - 16.0_wp*eps**2)
      b(2, 1) = b(1, 2)
      b(2, 2) = 2.0_wp*pi*(pi**2*q**2 + 48.0_wp*eps**2)/(eps*root)
      b = b/(pi**2*q + 16.0_wp*eps**2)**1.5_wp
   end function short_damping

   !> Films without fixed supplies know no direction: a push across the line of centres turns the force with it. They know no frame
   !> that turns: with t e = z x e, B t e = 2 F/(w_J + w_B). Forces with a potential have symmetric damping.
   subroutine test_isotropic_and_homogeneous(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: eps(3) = [0.1_wp, 0.5_wp, 0.9_wp]
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(film_slopes_t) :: slopes
      character(:), allocatable :: what
      real(wp) :: e, f(2), size_b, size_k, tolerance
      integer :: i, kind

      do kind = 1, n_journal_film_kinds()
         call make_film_kind(kind, bearing, case)
         if (case%name == "squeeze") cycle  ! no force of rotation
         tolerance = merge(2.0e-4_wp, 1.0e-7_wp, case%name == "grid")
         do i = 1, size(eps)
            motion = motion_of(case, eps(i), 0.0_wp, speed, 0.0_wp)
            call case%law%linearise(motion, case%parameters, slopes)
            f = force_of(case, motion)
            e = motion%e(1)
            size_k = maxval(abs(slopes%stiffness))
            size_b = maxval(abs(slopes%damping))
            what = case%name//" at "//to_text(eps(i))
            call check_close(error, slopes%stiffness(:, 2), [f(2), -f(1)]/e, tolerance*size_k, what//": turned")
            call check_close(error, slopes%damping(:, 2), 2.0_wp*f/(speed*e), tolerance*size_b, what//": turning frame")
            if (index(" short_exact finite grid ", " "//case%name//" ") > 0) then
               call check_close(error, slopes%damping(1, 2), slopes%damping(2, 1), tolerance*size_b, what//": symmetric")
            end if
         end do
      end do
   end subroutine test_isotropic_and_homogeneous

   !> At the critical mass the determinant of m s^2 + B s + K vanishes at s = i nu, and the whirl of a journal in the middle of a
   !> short half film has half the speed; a full film lets any mass whirl, a stiffness that is symmetric lets none.
   subroutine test_limit_of_whirl(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_slopes_t) :: slopes
      type(whirl_t) :: whirl
      complex(wp) :: determinant, matrix(2, 2)

      call make_film("short_gumbel", " ", " ", bearing, case)
      call case%law%linearise(motion_of(case, 0.4_wp, 0.0_wp, speed, 0.7_wp), case%parameters, slopes)
      call find_whirl(slopes, whirl)
      matrix = cmplx(slopes%stiffness, whirl%frequency*slopes%damping, wp)
      matrix(1, 1) = matrix(1, 1) - whirl%critical_mass*whirl%frequency**2
      matrix(2, 2) = matrix(2, 2) - whirl%critical_mass*whirl%frequency**2
      determinant = matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1)
      call check_close(error, abs(determinant), 0.0_wp, 1.0e-12_wp*maxval(abs(matrix))**2, "determinant")
      call case%law%linearise(motion_of(case, 0.01_wp, 0.0_wp, speed, 0.0_wp), case%parameters, slopes)
      call find_whirl(slopes, whirl)
      call check_close(error, whirl%frequency/speed, 0.5_wp, 1.0e-3_wp, "half the speed")
      call make_film("short_sommerfeld", " ", " ", bearing, case)
      call case%law%linearise(motion_of(case, 0.4_wp, 0.0_wp, speed, 0.7_wp), case%parameters, slopes)
      call find_whirl(slopes, whirl)
      call check_close(error, whirl%critical_mass/bearing%clearance, 0.0_wp, 1.0e-3_wp, "full film: any mass")
      slopes%stiffness = reshape([2.0_wp, 0.5_wp, 0.5_wp, 1.0_wp], [2, 2])
      slopes%damping = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
      call find_whirl(slopes, whirl)
      call check_true(error, .not. ieee_is_finite(whirl%critical_mass), "symmetric stiffness: no mass")
   end subroutine test_limit_of_whirl

   !> Without any motion: finite, and no stiffness.
   subroutine test_film_at_rest(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_slopes_t) :: slopes
      integer :: i, kind

      do kind = 1, n_journal_film_kinds()
         call make_film_kind(kind, bearing, case)
         do i = 0, 1
            call case%law%linearise(motion_of(case, 0.6_wp*i, 0.0_wp, 0.0_wp, 0.0_wp), case%parameters, slopes)
            call check_true(error, all(ieee_is_finite(slopes%damping)), case%name//": damping at rest")
            call check_close(error, maxval(abs(slopes%stiffness)), 0.0_wp, 0.0_wp, case%name//": stiffness")
         end do
      end do
   end subroutine test_film_at_rest

end module test_journal_whirl
