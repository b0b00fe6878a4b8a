!> Comparing settings: words for settings, distances of runs, contacts one by one, growth of reference runs, order, front and
!> choice.
module test_precision
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use growth, only: find_growth, growth_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kept_run, only: contact_t, kept_run_t, n_sort, sort_positions, sort_reactions, sort_velocities
   use integrator_registry, only: n_integrator_kinds
   use kinds, only: eps, not_a_number, wp
   use precision_choice, only: choose_best, find_orders
   use precision_info, only: check_setting_word, setting_t, settings_of
   use precision_results, only: error_motion, tol_sweep_t, median, precision_t, tol_run_done, tol_run_failed
   use run_difference, only: compare_contacts, compare_sorts, distances, scales_of
   use text, only: split_blank
   implicit none (type, external)
   private
   public :: run_test_precision

contains

   subroutine run_test_precision(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("words", test_words)
      call suite%test("wrong_words", test_wrong_words)
      call suite%test("distances", test_distances)
      call suite%test("scales_at_rest", test_scales_at_rest)
      call suite%test("same_contacts", test_same_contacts)
      call suite%test("other_contacts", test_other_contacts)
      call suite%test("exponential_growth", test_exponential_growth)
      call suite%test("regular_growth", test_regular_growth)
      call suite%test("order", test_order)
      call suite%test("choice", test_choice)
      call suite%test("median", test_median)
   end subroutine run_test_precision

   !> Words stand for methods, ways and solvers; `*` for all of them, each setting once.
   subroutine test_words(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(setting_t), allocatable :: settings(:)

      call settings_of(split_blank("verner rk4.projection.schur"), settings)
      call check_equal(error, size(settings), 2, "two words")
      call check_equal(error, settings(1)%word(), "verner", "the first word")
      call check_equal(error, settings(2)%method, "rk4", "method of the second")
      call check_equal(error, settings(2)%stabiliser, "projection", "way of the second")
      call check_equal(error, settings(2)%solver, "schur", "solver of the second")
      call settings_of(split_blank("verner.* verner.projection"), settings)
      call check_equal(error, size(settings), 7, "all ways, one of them named twice")
      call settings_of(split_blank("*"), settings)
      call check_equal(error, size(settings), n_integrator_kinds() - 1, "all methods but auto")
      call settings_of(split_blank("*.none.*"), settings)
      call check_equal(error, size(settings), 5*(n_integrator_kinds() - 1), "all methods but auto, and all solvers")
      call settings_of(split_blank("verner.auto verner.baumgarte.auto"), settings)
      call check_equal(error, settings(1)%stabiliser, "auto", "the way chosen for the scene, whatever the deck has")
      call check_equal(error, settings(2)%solver, "auto", "the solver chosen for the scene")
   end subroutine test_words

   !> A wrong part is reported with the nearest word.
   subroutine test_wrong_words(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: hint, message

      call check_setting_word("verner.projektion", message, hint)
      call check_equal(error, message, "unknown stabilisation method 'projektion'", "a wrong way")
      call check_true(error, index(hint, "did you mean 'projection'?") == 1, "the nearest way")
      call check_setting_word("auto", message, hint)
      call check_equal(error, message, "", "auto is a method")
      call check_setting_word("verner.auto.auto", message, hint)
      call check_equal(error, message, "", "auto is a word of the way and of the solver")
      call check_setting_word("verner..schur", message, hint)
      call check_true(error, message /= "", "an empty part")
      call check_setting_word("verner.none.schur.lapack", message, hint)
      call check_true(error, index(message, "has more parts than") > 0, "a fourth part")
      call check_setting_word("*.baumgarte.*", message, hint)
      call check_equal(error, message, "", "stars")
   end subroutine test_wrong_words

   !> A run of two numbers of each sort at instants 0, 1, 2, ... s.
   subroutine make_run(x, v, f, run)
      real(wp), intent(in) :: x(:)           !! (n) a position, beside one that does not change [m]
      real(wp), intent(in) :: v(:)           !! (n) a velocity [m/s]
      real(wp), intent(in) :: f(:)           !! (n) a reaction [N]
      type(kept_run_t), intent(out) :: run   !! the run

      integer :: k

      run%n = size(x)
      run%sort = [sort_positions, sort_positions, sort_velocities, sort_reactions]
      run%t = [(real(k - 1, wp), k=1, run%n)]
      allocate (run%values(4, run%n), source=100.0_wp)
      run%values(1, :) = x
      run%values(3, :) = v
      run%values(4, :) = f
      allocate (run%contacts(0))
   end subroutine make_run

   !> Positions are measured by their range, wherever the origin is, velocities and reactions by the maximum of them.
   subroutine test_distances(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), allocatable :: d(:, :)
      real(wp) :: maximum(n_sort), motion, scale(n_sort)
      type(kept_run_t) :: a, b

      call make_run([1000.0_wp, 1001.0_wp, 1004.0_wp], [0.0_wp, -5.0_wp, 1.0_wp], [7.0_wp, 8.0_wp, -2.0_wp], a)
      call make_run([1000.0_wp, 1001.1_wp, 1004.4_wp], [0.0_wp, -5.0_wp, 1.5_wp], [7.0_wp, 8.0_wp, -6.0_wp], b)
      scale = scales_of(a, 1.0_wp, 2.0_wp)
      call check_close(error, scale, [4.0_wp, 5.0_wp, 8.0_wp], 1.0e-15_wp, "scales")
      call distances(b, a, scale, d)
      call compare_sorts(d, a%t, 1.5_wp, maximum, motion)
      call check_close(error, maximum, [0.025_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp, "up to 1.5 s")
      call compare_sorts(d, a%t, 2.0_wp, maximum, motion)
      call check_close(error, maximum, [0.1_wp, 0.1_wp, 0.5_wp], 1.0e-12_wp, "up to the end")
      call check_close(error, motion, 0.1_wp, 1.0e-12_wp, "of the motion")
   end subroutine test_distances

   !> What rests is measured by the size of the mechanism.
   subroutine test_scales_at_rest(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_run_t) :: a

      call make_run([1.0_wp, 1.0_wp + 1.0e-12_wp], [0.0_wp, 1.0e-12_wp], [7.0_wp, 7.0_wp], a)
      call check_close(error, scales_of(a, 3.0_wp, 2.0_wp), [3.0_wp, 1.5_wp, 7.0_wp], 1.0e-15_wp, "scales")
   end subroutine test_scales_at_rest

   !> Contacts are reported when they end, so their order in the list says nothing.
   subroutine test_same_contacts(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: onset, peak, restitution
      type(kept_run_t) :: a, b
      logical :: is_other

      a%contacts = [contact_t(2, 2.0_wp, 1.0_wp, 50.0_wp, 0.5_wp), contact_t(1, 1.0_wp, 2.0_wp, 100.0_wp, 1.0_wp), &
                    contact_t(1, 3.0_wp, 1.0_wp, 10.0_wp, not_a_number())]
      b%contacts = [contact_t(1, 1.1_wp, 2.0_wp, 101.0_wp, 1.2_wp), contact_t(1, 3.05_wp, 1.0_wp, 99.0_wp, 0.1_wp), &
                    contact_t(2, 2.2_wp, 1.0_wp, 47.0_wp, 0.75_wp)]
      call compare_contacts(b, a, 4.0_wp, onset, peak, restitution, is_other)
      call check_true(error, .not. is_other, "the same sequence")
      call check_close(error, onset, 0.2_wp, 1.0e-12_wp, "onset times")
      call check_close(error, peak, 0.03_wp, 1.0e-12_wp, "peak forces, without the contact that has not ended")
      call check_close(error, restitution, 0.125_wp, 1.0e-12_wp, "restitution, a quarter at half the highest speed")
      call compare_contacts(b, a, 0.5_wp, onset, peak, restitution, is_other)
      call check_true(error, .not. is_other .and. ieee_is_nan(onset), "no contacts up to 0.5 s")
   end subroutine test_same_contacts

   !> One contact more, one less, or two the other way round are another sequence, not a large error.
   subroutine test_other_contacts(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: onset, peak, restitution
      type(contact_t) :: first, second
      type(kept_run_t) :: a, b
      logical :: is_other

      first = contact_t(1, 1.0_wp, 2.0_wp, 100.0_wp, 1.0_wp)
      second = contact_t(2, 2.0_wp, 2.0_wp, 100.0_wp, 1.0_wp)
      a%contacts = [first, second]
      b%contacts = [first]
      call compare_contacts(b, a, 4.0_wp, onset, peak, restitution, is_other)
      call check_true(error, is_other .and. ieee_is_nan(onset), "a contact less")
      b%contacts = [first, first, second]
      b%contacts(2)%onset = 1.5_wp
      call compare_contacts(b, a, 4.0_wp, onset, peak, restitution, is_other)
      call check_true(error, is_other, "a contact more")
      b%contacts = [first, second]
      b%contacts%onset = [2.0_wp, 1.0_wp]
      call compare_contacts(b, a, 4.0_wp, onset, peak, restitution, is_other)
      call check_true(error, is_other, "the other way round")
      a%contacts%onset = 1.0_wp
      b%contacts%onset = [1.0_wp + 1.0e-12_wp, 1.0_wp]
      call compare_contacts(b, a, 4.0_wp, onset, peak, restitution, is_other)
      call check_true(error, .not. is_other, "contacts together have no order")
   end subroutine test_other_contacts

   !> reference runs that part as exp(3 t), one after a while: the rate, and the times at which eps exp(3 t) = 10^-k.
   subroutine test_exponential_growth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: k
      real(wp) :: expected
      type(growth_t) :: twins

      twins%n_twin = 2
      twins%t = [(0.05_wp*k, k=0, 200)]
      allocate (twins%ratio(201, 2), source=1.0_wp)
      twins%ratio(:, 1) = min(exp(3.0_wp*twins%t), 0.5e9_wp)
      twins%ratio(:, 2) = min(0.5_wp*exp(3.0_wp*twins%t) + 0.5_wp*exp(-3.0_wp*twins%t), 0.5e9_wp)
      twins%reason = ""
      call find_growth(twins, 1.0e-9_wp)
      call check_equal(error, twins%reason, "", "a law is found")
      call check_true(error, twins%is_exponential, "exponential growth")
      call check_close(error, twins%rate, 3.0_wp, 1.0e-2_wp, "rate")
      call check_true(error, abs(twins%rate - 3.0_wp) <= twins%rate_interval, "the rate is in its interval")
      do k = 4, 12
         expected = log(10.0_wp**(-k)/eps)/3.0_wp
         call check_close(error, twins%horizon(k), expected, 0.12_wp, "horizon")
      end do
   end subroutine test_exponential_growth

   !> reference runs that part as t^2 and less are regular, and keep their digits to the end.
   subroutine test_regular_growth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: k
      type(growth_t) :: twins

      twins%n_twin = 2
      twins%t = [(0.05_wp*k, k=0, 200)]
      allocate (twins%ratio(201, 2), source=1.0_wp)
      twins%ratio(:, 1) = 1.0_wp + twins%t**2
      twins%ratio(:, 2) = 1.0_wp + 0.1_wp*twins%t**2
      twins%reason = ""
      call find_growth(twins, 1.0e-9_wp)
      call check_true(error, .not. twins%is_exponential, "no exponential growth")
      call check_close(error, twins%power, 1.7_wp, 0.3_wp, "power of time")
      call check_true(error, all(ieee_is_nan(twins%horizon)), "all digits to the end")
   end subroutine test_regular_growth

   !> A tolerance sweep with errors c h^4 above round-off, and one with errors in proportion to the tolerance.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(precision_t) :: study
      integer :: k

      call make_study(study)
      call find_orders(study)
      call check_close(error, study%tol_sweeps(1)%order, 4.0_wp, 0.05_wp, "order of fixed steps")
      call check_true(error, ieee_is_nan(study%tol_sweeps(1)%exponent), "steps have no proportionality")
      call check_close(error, study%tol_sweeps(2)%exponent, 1.0_wp, 1.0e-9_wp, "proportionality")
      call check_close(error, study%tol_sweeps(2)%ratio, 20.0_wp, 1.0e-9_wp, "error over tolerance")
      study%tol_sweeps(2)%tol_runs%count%steps = [(100 + k, k=1, 13)]
      call find_orders(study)
      call check_true(error, ieee_is_nan(study%tol_sweeps(2)%order), &
                      "errors that something else than the steps makes have no order")
      call check_close(error, study%tol_sweeps(2)%exponent, 1.0_wp, 1.0e-9_wp, "proportionality all the same")
   end subroutine test_order

   !> Two tolerance sweeps: fixed steps 10^-k/4 of a method of order 4 with a floor of round-off, a cheaper one of tolerances.
   subroutine make_study(study)
      type(precision_t), intent(out) :: study   !! costs and errors are set

      integer :: k

      allocate (study%tol_sweeps(2))
      study%reference%bar = 1.0e-13_wp
      study%accuracy = 1.0e-6_wp
      do k = 1, 2
         allocate (study%tol_sweeps(k)%tol_runs(13))
         study%tol_sweeps(k)%tol_runs%state = tol_run_done
      end do
      study%tol_sweeps(1)%is_fixed = .true.
      do k = 1, 13
         associate (fixed => study%tol_sweeps(1)%tol_runs(k), variable => study%tol_sweeps(2)%tol_runs(k))
            fixed%asked = 10.0_wp**(-0.25_wp*k)
            fixed%count%steps = nint(1.0e4_wp/fixed%asked)
            fixed%error(error_motion) = fixed%asked**4 + 1.0e-15_wp/fixed%asked
            fixed%cpu = 1.0e-3_wp/fixed%asked
            variable%asked = 10.0_wp**(-k)
            variable%count%steps = 100*k
            variable%error(error_motion) = 20.0_wp*variable%asked
            variable%cpu = 1.0e-3_wp*k
         end associate
      end do
   end subroutine make_study

   !> The cheapest run that reaches the error requested, and the front; what failed or is dearer for less is not on it.
   subroutine test_choice(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(precision_t) :: study

      call make_study(study)
      study%tol_sweeps(2)%tol_runs(8)%state = tol_run_failed
      call choose_best(study)
      call check_equal(error, study%choice%tol_sweep, 2, "ladder of the choice")
      call check_equal(error, study%choice%tol_run, 9, "the first rung below the error wanted that did not fail")
      call check_true(error, study%tol_sweeps(2)%tol_runs(9)%is_front, "the choice is on the front")
      call check_true(error, .not. study%tol_sweeps(2)%tol_runs(8)%is_front, "a failure is not")
      call check_true(error, .not. any(study%tol_sweeps(1)%tol_runs(6:11)%is_front), "a dear method is not")
      study%tol_sweeps(2)%tol_runs(11)%error(error_motion) = 2.0e-6_wp
      call choose_best(study)
      call check_equal(error, study%choice%tol_run, 12, "a run is not chosen if a tighter one misses the error wanted")
      study%accuracy = 1.0e-14_wp
      call choose_best(study)
      call check_equal(error, study%choice%tol_sweep, 0, "nothing reaches an error below the reference's own")
   end subroutine test_choice

   !> Medians of an odd and of an even number.
   subroutine test_median(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_close(error, median([3.0_wp, 1.0_wp, 2.0_wp]), 2.0_wp, 0.0_wp, "of three")
      call check_close(error, median([4.0_wp, 1.0_wp, 2.0_wp, 3.0_wp]), 2.5_wp, 0.0_wp, "of four")
      call check_close(error, median([7.0_wp]), 7.0_wp, 0.0_wp, "of one")
      call check_true(error, ieee_is_nan(median([real(wp) ::])), "of none")
   end subroutine test_median

end module test_precision
