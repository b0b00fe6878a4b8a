!> Films: what holds of every kind, printed values, power, and the states where formulas of books divide by zero.
module test_films
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use film_case, only: components, film_case_t, force_of, make_film, make_film_kind, motion_of, unit_bearing
   use film_law, only: film_bearing_t, film_motion_t
   use film_registry, only: n_film_kinds
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_films

   integer, parameter :: n_random = 10000  !! states of a film

contains

   subroutine run_test_films(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("printed_values", test_printed_values)
      call suite%test("dissipative", test_dissipative)
      call suite%test("book_feeds_energy_in", test_book_feeds_energy_in)
      call suite%test("special_states", test_special_states)
      call suite%test("isotropic_in_the_middle", test_isotropic_in_the_middle)
      call suite%test("turned_and_mirrored", test_turned_and_mirrored)
      call suite%test("rigid_rotation", test_rigid_rotation)
      call suite%test("beyond_the_wall", test_beyond_the_wall)
      call suite%test("many_at_once", test_many_at_once)
      call suite%test("journal_bearing", test_journal_bearing)
      call suite%test("butenschoen_rotation", test_butenschoen_rotation)
      call suite%test("butenschoen_squeeze", test_butenschoen_squeeze)
   end subroutine run_test_films

   !> Components over mu L R^3/c^2 or mu L^3 R/c^2, from quadratures of the pressure and the printed formulas in many digits.
   subroutine test_printed_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(7) = [character(17) :: "short_sommerfeld", "short_gumbel", "short_exact", &
                                             "long_sommerfeld", "long_gumbel", "pinkus_sternlicht", "long_exact"]
      real(wp), parameter :: states(3, 4) = reshape([0.5_wp, 0.3_wp, 1.0_wp, 0.5_wp, -0.3_wp, 1.0_wp, 0.8_wp, 0.1_wp, -1.0_wp, &
                                                     0.2_wp, -0.05_wp, 0.4_wp], [3, 4])
      real(wp), parameter :: f(2, 4, 7) = reshape([ &
                             -2.90207898_wp, 1.20919958_wp, 2.90207898_wp, 1.20919958_wp, -9.21145994_wp, -5.81776417_wp, &
                             0.18787351_wp, 0.13359894_wp, &
                             -1.89548394_wp, 1.13793312_wp, 1.00659505_wp, 0.07126645_wp, 0.33254163_wp, -1.67431419_wp, &
                             0.07657564_wp, 0.04509808_wp, &
                             -2.75916424_wp, 0.90793425_wp, 0.14291475_wp, 0.30126533_wp, -10.98954482_wp, -4.03023694_wp, &
                             0.04808552_wp, 0.05346721_wp, &
                             -17.41247390_wp, 9.67359661_wp, 17.41247390_wp, 9.67359661_wp, -17.45329252_wp, -19.03995548_wp, &
                             2.00398411_wp, 1.50888215_wp, &
                             -4.21111707_wp, 6.97013164_wp, 0.65556152_wp, 2.70346497_wp, 4.71291411_wp, -7.49977572_wp, &
                             0.10769385_wp, 0.63189206_wp, &
                             -14.96141972_wp, 6.76913448_wp, 2.45105418_wp, 2.90446213_wp, -19.90655131_wp, -12.62950363_wp, &
                             0.65171141_wp, 0.60886643_wp, &
                             -14.10053930_wp, 6.17434429_wp, 3.31193459_wp, 3.49925232_wp, -19.43490620_wp, -11.91869032_wp, &
                             0.74154422_wp, 0.67795186_wp], [2, 4, 7])
      type(film_case_t) :: case
      integer :: i, k

      do k = 1, size(names)
         call make_film(trim(names(k)), merge("form", "    ", index(names(k), "gumbel") > 0), "book", unit_bearing(), case)
         do i = 1, size(states, 2)
            call check_close(error, components(case, states(1, i), states(2, i), states(3, i)), f(:, i, k), 5.1e-9_wp, &
                             trim(names(k))//", state "//to_text(i))
         end do
      end do
   end subroutine test_printed_values

   !> Power in the frame that turns with half the sum of the speeds, F.(e' - (w_J + w_B)/2 z x e), is never positive.
   subroutine test_dissipative(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(6) = [character(17) :: "pinkus_sternlicht", "short_exact", "long_exact", &
                                             "short_sommerfeld", "long_sommerfeld", "squeeze"]
      type(film_case_t) :: case
      integer :: k

      do k = 1, size(names)
         call make_film(trim(names(k)), " ", " ", unit_bearing(), case)
         call check_true(error, max_power(case) <= 0.0_wp, trim(names(k))//" feeds energy in")
      end do
      call make_film("squeeze", "pressure", "positive", unit_bearing(), case)
      call check_true(error, max_power(case) <= 0.0_wp, "positive squeeze feeds energy in")
   end subroutine test_dissipative

   !> The printed radial force of a parting journal feeds in what it can, and it jumps at eps' = 0.
   subroutine test_book_feeds_energy_in(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: book, corrected
      real(wp) :: before(2), after(2)

      call make_film("pinkus_sternlicht", "form", "book", unit_bearing(), book)
      call check_true(error, max_power(book) > 0.99_wp, "book: power")
      before = components(book, 0.5_wp, -1.0_wp, 1.0_wp)
      call check_close(error, before(1), -8.44_wp, 5.0e-3_wp, "book: parting")
      before = components(book, 0.5_wp, -1.0e-12_wp, 1.0_wp)
      after = components(book, 0.5_wp, 1.0e-12_wp, 1.0_wp)
      call check_close(error, [before(1), after(1)], [1.778_wp, -1.778_wp], 5.0e-4_wp, "book: jump")
      call make_film("pinkus_sternlicht", "form", "corrected", unit_bearing(), corrected)
      before = components(corrected, 0.5_wp, -1.0e-12_wp, 1.0_wp)
      after = components(corrected, 0.5_wp, 1.0e-12_wp, 1.0_wp)
      call check_close(error, before, after, 1.0e-10_wp, "corrected: continuous")
      ! without squeeze both are the half film of Gumbel
      call make_film("long_gumbel", " ", " ", unit_bearing(), book)
      call check_close(error, components(corrected, 0.7_wp, 0.0_wp, -0.8_wp), components(book, 0.7_wp, 0.0_wp, -0.8_wp), &
                       1.0e-13_wp, "half film")
   end subroutine test_book_feeds_energy_in

   !> Maximum power of random states, of |F| |v|.
   real(wp) function max_power(case) result(maximum)
      type(film_case_t), intent(in) :: case  !! the film

      type(film_motion_t) :: motion
      type(random_t) :: random
      real(wp) :: f(2), v(2)
      integer :: k

      maximum = -1.0_wp
      do k = 1, n_random
         motion = motion_of(case, random%between(0.0_wp, 0.99_wp), 0.0_wp, random%between(-2.0_wp, 2.0_wp), random%between(-pi, pi))
         motion%e_dot = random%vector(2, -1.0_wp, 1.0_wp)*10.0_wp**random%between(-3.0_wp, 1.0_wp)
         f = force_of(case, motion)
         v = motion%e_dot - 0.5_wp*motion%speed_sum*[-motion%e(2), motion%e(1)]
         maximum = max(maximum, dot_product(f, v)/(norm2(f)*norm2(v) + tiny(1.0_wp)))
      end do
   end function max_power

   !> No eccentricity, no squeeze, no speed, and pairs of them, of every kind: finite; nothing moves: no force.
   subroutine test_special_states(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      real(wp) :: f(2), eps, eps_dot, om
      integer :: bits, kind

      do kind = 1, n_film_kinds()
         call make_film_kind(kind, unit_bearing(), case)
         call check_equal(error, case%message, "", case%name//" fits")
         do bits = 0, 7
            eps = merge(0.6_wp, 0.0_wp, btest(bits, 0))
            eps_dot = merge(-0.3_wp, 0.0_wp, btest(bits, 1))
            om = merge(0.7_wp, 0.0_wp, btest(bits, 2))
            f = components(case, eps, eps_dot, om)
            call check_true(error, all(ieee_is_finite(f)), case%name//": not a number in state "//to_text(bits))
            if (bits <= 1 .or. bits == 4) call check_close(error, f, [0.0_wp, 0.0_wp], 0.0_wp, case%name//": force at rest")
            if (bits == 2 .or. bits == 3) call check_true(error, f(1) > 0.0_wp, case%name//": against the squeeze")
         end do
      end do
   end subroutine test_special_states

   !> For e -> 0 damping is the same in all directions, but of films that know only a half or only one direction.
   subroutine test_isotropic_in_the_middle(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(6) = [character(17) :: "short_sommerfeld", "short_gumbel", "short_exact", &
                                             "long_sommerfeld", "pinkus_sternlicht", "long_exact"]
      real(wp), parameter :: damping(6) = pi*[1.0_wp, 0.5_wp, 0.5_wp, 12.0_wp, 6.0_wp, 6.0_wp]
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      integer :: i, k

      do k = 1, size(names)
         call make_film(trim(names(k)), " ", " ", unit_bearing(), case)
         do i = 0, 11
            motion = motion_of(case, merge(0.0_wp, 1.0e-9_wp, i < 6), 0.0_wp, 0.3_wp, 0.4_wp)
            motion%e_dot = [cos(real(i, wp)), sin(real(i, wp))]
            call check_close(error, force_of(case, motion), -damping(k)*motion%e_dot, 1.0e-7_wp, trim(names(k))//": isotropic")
         end do
      end do
   end subroutine test_isotropic_in_the_middle

   !> Forces turn with the bearing, and with the other sense of all speeds they are those of the mirror.
   subroutine test_turned_and_mirrored(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: mirror, motion
      type(random_t) :: random
      real(wp) :: angle, f(2), other(2), rotation(2, 2)
      integer :: kind, sample

      do kind = 1, n_film_kinds()
         call make_film_kind(kind, unit_bearing(), case)
         do sample = 1, 20
            motion = motion_of(case, random%between(0.05_wp, 0.9_wp), 0.0_wp, random%between(-2.0_wp, 2.0_wp), 0.0_wp)
            motion%e_dot = random%vector(2, -1.0_wp, 1.0_wp)
            f = force_of(case, motion)
            mirror = motion
            mirror%e_dot(2) = -motion%e_dot(2)
            mirror%speed_sum = -motion%speed_sum
            mirror%speed_difference = -motion%speed_difference
            other = force_of(case, mirror)
            call check_close(error, other, [f(1), -f(2)], 1.0e-12_wp*norm2(f), case%name//": mirrored")
            angle = random%between(-pi, pi)
            rotation = reshape([cos(angle), sin(angle), -sin(angle), cos(angle)], [2, 2])
            motion%e = matmul(rotation, motion%e)
            motion%e_dot = matmul(rotation, motion%e_dot)
            motion%angle = motion%angle + angle
            call check_close(error, force_of(case, motion), matmul(rotation, f), 1.0e-11_wp*norm2(f), case%name//": turned")
         end do
      end do
   end subroutine test_turned_and_mirrored

   !> A bearing that turns as a rigid body with its journal has no pressure.
   subroutine test_rigid_rotation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: motion
      integer :: kind

      do kind = 1, n_film_kinds()
         call make_film_kind(kind, unit_bearing(), case)
         motion%e = [0.3_wp, -0.5_wp]
         motion%e_dot = 1.7_wp*[0.5_wp, 0.3_wp]
         motion%speed_sum = 2.0_wp*1.7_wp
         call check_close(error, force_of(case, motion), [0.0_wp, 0.0_wp], 1.0e-12_wp, case%name//": rigid rotation")
      end do
   end subroutine test_rigid_rotation

   !> Beyond eps_max forces are finite, and continue from those at it.
   subroutine test_beyond_the_wall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      real(wp) :: far(2), here(2)
      integer :: kind

      do kind = 1, n_film_kinds()
         call make_film_kind(kind, unit_bearing(), case)
         here = components(case, case%bearing%eps_max, 0.1_wp, 0.0_wp)
         far = components(case, 1.5_wp, 0.1_wp, 0.0_wp)
         call check_true(error, here(1) < 0.0_wp, case%name//": pushes back")
         call check_close(error, far, here, 1.0e-12_wp, case%name//": the shape stays", relative=.true.)
         far = components(case, 3.0_wp, -0.2_wp, 0.9_wp)
         call check_true(error, all(ieee_is_finite(far)), case%name//": not a number beyond the wall")
      end do
   end subroutine test_beyond_the_wall

   !> Several bearings in one call have the forces of each by itself.
   subroutine test_many_at_once(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case, other
      type(film_motion_t) :: motions(2)
      real(wp) :: f(2, 2)
      integer :: kind

      do kind = 1, n_film_kinds()
         call make_film_kind(kind, unit_bearing(), case)
         call make_film_kind(kind, film_bearing_t(9.8e-3_wp, 0.2e-3_wp, 15.0e-3_wp, 0.4_wp, 0.999_wp), other)
         motions = [motion_of(case, 0.4_wp, 0.2_wp, 1.0_wp, 0.3_wp), motion_of(other, 0.8_wp, -4.0_wp, 50.0_wp, -1.0_wp)]
         call case%law%force(2, motions, reshape([case%parameters, other%parameters], [size(case%parameters), 2]), f)
         call check_close(error, f(:, 1), force_of(case, motions(1)), 0.0_wp, case%name//": the first")
         call check_close(error, f(:, 2), force_of(other, motions(2)), 0.0_wp, case%name//": the second")
      end do
   end subroutine test_many_at_once

   !> A journal of 9.8 mm at 500 rpm in 400 cP and 0.2 mm of clearance carries 31.2753 N where an independent program has it.
   subroutine test_journal_bearing(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(5) = [character(17) :: "long_sommerfeld", "long_gumbel", "short_sommerfeld", &
                                             "short_gumbel", "pinkus_sternlicht"]
      real(wp), parameter :: eps(5) = [0.08416961233916509_wp, 0.1673187350735297_wp, 0.06029816039349017_wp, &
                                       0.1174337638081649_wp, 0.1673187350735297_wp]
      real(wp), parameter :: angle(5) = [0.0_wp, -6.1664023130215_wp, 0.0_wp, -8.5623163394003_wp, -6.1664023130215_wp]
      type(film_case_t) :: case
      integer :: k

      do k = 1, size(names)
         call make_film(trim(names(k)), " ", " ", film_bearing_t(9.8e-3_wp, 0.2e-3_wp, 40.0e-3_wp, 0.4_wp, 0.999_wp), case)
         call check_close(error, force_of(case, motion_of(case, eps(k), 0.0_wp, 500.0_wp*pi/30.0_wp, angle(k)*pi/180.0_wp)), &
                          [0.0_wp, 30.0_wp + 0.13_wp*9.81_wp], 1.0e-10_wp, trim(names(k)))
      end do
   end subroutine test_journal_bearing

   !> Sommerfeld number and angle of Butenschoen's tables, which his closed form is to approximate.
   subroutine test_butenschoen_rotation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: eps(6) = [0.1_wp, 0.3_wp, 0.5_wp, 0.7_wp, 0.9_wp, 0.95_wp]
      real(wp), parameter :: ratio(4) = [1.0_wp, 0.5_wp, 0.25_wp, 0.125_wp]
      real(wp), parameter :: so(6, 4) = reshape([0.1196_wp, 0.4091_wp, 0.8903_wp, 2.0432_wp, 8.4352_wp, 18.7895_wp, &
                                                 0.0368_wp, 0.1304_wp, 0.3124_wp, 0.8595_wp, 5.0881_wp, 13.3083_wp, &
                                                 0.0098_wp, 0.0354_wp, 0.0888_wp, 0.2708_wp, 2.1595_wp, 6.9248_wp, &
                                                 0.0025_wp, 0.0091_wp, 0.0231_wp, 0.0732_wp, 0.6776_wp, 2.5202_wp], [6, 4])
      real(wp), parameter :: beta(6, 4) = reshape([79.41_wp, 68.264_wp, 56.705_wp, 43.859_wp, 26.482_wp, 19.45_wp, &
                                                   81.767_wp, 68.493_wp, 54.993_wp, 40.803_wp, 23.566_wp, 17.265_wp, &
                                                   82.481_wp, 68.204_wp, 54.069_wp, 39.326_wp, 21.79_wp, 15.632_wp, &
                                                   82.653_wp, 68.211_wp, 53.784_wp, 38.865_wp, 21.089_wp, 14.832_wp], [6, 4])
      type(film_case_t) :: case
      real(wp) :: f(2)
      integer :: i, k

      do k = 1, size(ratio)
         call make_film("butenschoen", " ", " ", film_bearing_t(1.0_wp, 1.0_wp, 2.0_wp*ratio(k), 1.0_wp, 0.9999_wp), case)
         do i = 1, size(eps)
            f = components(case, eps(i), 0.0_wp, 3.0_wp)/(2.0_wp*3.0_wp*case%bearing%length)
            call check_close(error, norm2(f), so(i, k), 0.06_wp, "Sommerfeld number at eps = "//to_text(eps(i)), relative=.true.)
            call check_close(error, atan2(f(2), -f(1))*180.0_wp/pi, beta(i, k), 2.5_wp, "angle at eps = "//to_text(eps(i)))
         end do
      end do
   end subroutine test_butenschoen_rotation

   !> The same of a journal that approaches or parts without turning.
   subroutine test_butenschoen_squeeze(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: eps(7) = [-0.9_wp, -0.5_wp, -0.1_wp, 0.0_wp, 0.3_wp, 0.7_wp, 0.95_wp]
      real(wp), parameter :: ratio(3) = [1.0_wp, 1.0_wp/3.0_wp, 0.125_wp]
      real(wp), parameter :: so(7, 3) = reshape([0.5518_wp, 0.971_wp, 1.9579_wp, 2.4076_wp, 5.0479_wp, 24.842_wp, 490.18_wp, &
                                                 0.0663_wp, 0.1211_wp, 0.2645_wp, 0.3355_wp, 0.8081_wp, 6.0733_wp, 275.76_wp, &
                                                 0.0095_wp, 0.0174_wp, 0.0383_wp, 0.0488_wp, 0.1203_wp, 1.0027_wp, 76.315_wp], &
                                               [7, 3])
      type(film_case_t) :: case
      real(wp) :: f(2)
      integer :: i, k

      do k = 1, size(ratio)
         call make_film("butenschoen", " ", " ", film_bearing_t(1.0_wp, 1.0_wp, 2.0_wp*ratio(k), 1.0_wp, 0.9999_wp), case)
         do i = 1, size(eps)
            f = components(case, abs(eps(i)), sign(1.0_wp, eps(i)), 0.0_wp)/(2.0_wp*case%bearing%length)
            call check_close(error, -f(1)*sign(1.0_wp, eps(i)), so(i, k), 0.06_wp, "squeeze at eps = "//to_text(eps(i)), &
                             relative=.true.)
            call check_close(error, f(2), 0.0_wp, 0.0_wp, "along the line of centres")
         end do
      end do
   end subroutine test_butenschoen_squeeze

end module test_films
