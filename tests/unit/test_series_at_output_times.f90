!> A history at other instants: what is smooth, states, angles that jump by a turn, and rows without a number.
module test_series_at_output_times
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: not_a_number, pi, wp
   use series_at_output_times, only: smooth_at, state_at, unwind
   implicit none (type, external)
   private
   public :: run_test_series_at_output_times

contains

   !> Register the tests.
   subroutine run_test_series_at_output_times(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rows_without_numbers", test_rows_without_numbers)
      call suite%test("states", test_states)
      call suite%test("turns", test_turns)
   end subroutine run_test_series_at_output_times

   !> A polynomial of order 5 is met beside rows without a number, by those of its own side; between the last row that has one and
   !> the first that has none it is not known where it ends.
   subroutine test_rows_without_numbers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: times(6) = [0.5_wp, 6.5_wp, 7.0_wp, 7.5_wp, 8.5_wp, 10.0_wp]
      real(wp) :: t(20), values(6), worst, x(20)
      logical :: is_settled(6)
      integer :: k

      t = [(real(k, wp), k=0, 19)]
      x = [(quintic(t(k)), k=1, 20)]
      x(9:10) = not_a_number()
      call smooth_at(t, x, times, values, is_settled, worst)
      call check_close(error, values([1, 2, 3, 6]), [quintic(0.5_wp), quintic(6.5_wp), quintic(7.0_wp), quintic(10.0_wp)], &
                       1.0e-12_wp, "numbers")
      if (.not. allocated(error)) call check_true(error, all(ieee_is_nan(values(4:5))), "none between rows that have none")
      if (.not. allocated(error)) call check_true(error, all(is_settled .eqv. [.true., .true., .true., .false., .true., .true.]), &
            "settled")
   end subroutine test_rows_without_numbers

   !> A polynomial that six rows determine.
   pure real(wp) function quintic(t)
      real(wp), intent(in) :: t  !! abscissa [s]

      quintic = 1.0_wp + 0.1_wp*t - 1.0e-4_wp*(t - 4.0_wp)**5
   end function quintic

   !> States are whole numbers of the row before, and settled where the rows on both sides agree; of several rows at an instant all.
   subroutine test_states(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: t(7) = [0.0_wp, 1.0_wp, 1.4_wp, 2.0_wp, 3.0_wp, 3.0_wp, 4.0_wp]
      real(wp), parameter :: x(7) = [0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp]
      real(wp), parameter :: times(7) = [0.5_wp, 1.2_wp, 1.6_wp, 2.0_wp, 3.0_wp, 3.5_wp, 4.0_wp]
      real(wp) :: values(7)
      logical :: is_settled(7)

      call state_at(t, x, times, values, is_settled)
      call check_close(error, values, [0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp], 0.0_wp, "states")
      if (.not. allocated(error)) call check_true(error, all(is_settled .eqv. [.true., .false., .true., .true., .false., .true., &
            .true.]), "settled")
   end subroutine test_states

   !> An angle from -pi to pi becomes the one that counts turns; one that counts them, or goes beyond one turn, stays as it is.
   subroutine test_turns(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: angle(41), x(41)
      integer :: k

      angle = [(0.4_wp*real(k, wp), k=0, 40)]
      x = atan2(sin(angle), cos(angle))
      x(7) = not_a_number()
      call unwind(x, 2.0_wp*pi)
      call check_close(error, [x(:6), x(8:)], [angle(:6), angle(8:)], 1.0e-13_wp, "unwound")
      if (allocated(error)) return
      x = 12.5_wp*angle
      call unwind(x, 2.0_wp*pi)
      call check_close(error, x, 12.5_wp*angle, 0.0_wp, "turns counted")
   end subroutine test_turns

end module test_series_at_output_times
