!> Differences of runs by channels, their scales, and the first contact that is another one, on runs made by hand.
module test_channel_difference
   use groups_of_catalogue, only: group_clearances, group_energy
   use channel_difference, only: channel_scales, set_differences
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_channels, only: channel_kind_t, class_energy, class_other, kept_channels_t
   use kept_run, only: contact_t, n_sort, sort_positions, sort_reactions, sort_velocities
   use kinds, only: not_a_number, wp
   use run_difference, only: first_other_contact
   implicit none (type, external)
   private
   public :: run_test_channel_difference

   integer, parameter :: n_instant = 4  !! instants of the runs
   integer, parameter :: n_kind = n_sort + 3  !! kinds of channels: three further ones
   real(wp), parameter :: pi = acos(-1.0_wp)  !! half a turn [rad]

contains

   !> Register the tests.
   subroutine run_test_channel_difference(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("by_instant_and_channel", test_by_instant_and_channel)
      call suite%test("values_that_are_none", test_values_that_are_none)
      call suite%test("place_of_a_contact", test_place_of_a_contact)
      call suite%test("angles_that_go_round", test_angles_that_go_round)
      call suite%test("scales", test_scales)
      call suite%test("first_other_contact", test_first_other_contact)
   end subroutine run_test_channel_difference

   !> A run of two channels, x = t and x = 10 t: a position, and a moment that counts at an arm of 2 m.
   subroutine new_run(run)
      type(kept_channels_t), intent(out) :: run  !! the run

      integer :: i

      run%n = n_instant
      run%t = [(real(i - 1, wp), i=1, n_instant)]
      run%kind = [sort_positions, sort_reactions]
      run%factor_of = [1.0_wp, 0.5_wp]
      run%goes_round = [.false., .false.]
      run%state_of = [0, 0]
      allocate (run%further(3))
      run%further(1) = channel_kind_t(group_energy, class_energy, 0, "")
      run%further(2) = channel_kind_t(group_clearances, class_other, 0, "Pa")
      run%further(3) = channel_kind_t(group_clearances, class_other, 0, "m^3/s")
      run%sort = [sort_positions, sort_velocities]
      allocate (run%values(2, n_instant), run%series%x(2, n_instant), source=0.0_wp)
      run%values(1, :) = run%t
      run%values(2, :) = 1.0_wp
      run%series%x(1, :) = run%t
      run%series%x(2, :) = 10.0_wp*run%t
      allocate (run%series%low(2, n_instant), source=0.0_wp)
      run%series%high = run%series%x
      run%series%minimum = [0.0_wp, 0.0_wp]
      run%series%most = run%series%x(:, n_instant)
      allocate (run%magnitude(n_kind), source=0.0_wp)
   end subroutine new_run

   subroutine test_by_instant_and_channel(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_channels_t) :: a, b
      real(wp) :: by_channel(2), by_instant(n_instant), scale(n_kind)
      integer :: worst(n_instant)

      call new_run(a)
      b = a
      b%series%x(1, 2) = b%series%x(1, 2) + 0.03_wp     ! 0.01 of a scale of 3
      b%series%x(2, 3) = b%series%x(2, 3) - 8.0_wp      ! 0.5 8/20 = 0.2
      b%series%high(2, 4) = b%series%high(2, 4) + 2.0_wp  ! 0.05
      scale = 1.0_wp
      scale(sort_positions) = 3.0_wp
      scale(sort_reactions) = 20.0_wp
      by_instant = 0.0_wp
      by_channel = 0.0_wp
      worst = 0
      call set_differences(a, b, scale, 2.0_wp, by_instant, by_channel, worst)
      call check_close(error, by_instant, [0.0_wp, 0.01_wp, 0.2_wp, 0.05_wp], 1.0e-14_wp, "by instant")
      call check_close(error, by_channel, [0.03_wp, 8.0_wp], 1.0e-14_wp, "by channel, up to 2 s")
      call check_true(error, all(worst == [0, 1, 2, 2]), "the channel that has it")
      b%series%most(2) = b%series%most(2) + 40.0_wp     ! a peak behind the last instant: 1
      call set_differences(a, b, scale, 2.0_wp, by_instant, by_channel, worst)
      call check_close(error, by_instant(n_instant), 1.0_wp, 1.0e-14_wp, "a peak at the end")
   end subroutine test_by_instant_and_channel

   subroutine test_values_that_are_none(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_channels_t) :: a, b
      real(wp) :: by_channel(2), by_instant(n_instant), scale(n_kind)
      integer :: worst(n_instant)

      call new_run(a)
      a%series%x(1, 2) = not_a_number()
      b = a
      scale = 1.0_wp
      by_instant = 0.0_wp
      by_channel = 0.0_wp
      worst = 0
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_true(error, all(by_instant <= 0.0_wp), "what is no number in both runs is no difference")
      b%series%x(1, 2) = 1.0_wp
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_true(error, by_instant(2) > 1.0e90_wp, "a number in one run only")
      b%n = n_instant - 2
      by_instant = 0.0_wp
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_true(error, all(by_instant(3:) > 1.0e90_wp), "a run that ends much earlier")
   end subroutine test_values_that_are_none

   !> Where a contact acts is no number while it does not touch: compared where it does in both runs, its extremes from there on.
   subroutine test_place_of_a_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_channels_t) :: a, b
      real(wp) :: by_channel(2), by_instant(n_instant), scale(n_kind)
      integer :: worst(n_instant)

      call new_run(a)
      a%state_of(1) = 7
      a%series%x(1, :2) = not_a_number()
      a%series%low(1, :) = [huge(1.0_wp), huge(1.0_wp), 2.0_wp, 2.0_wp]
      a%series%high(1, :) = [-huge(1.0_wp), -huge(1.0_wp), 2.0_wp, 3.0_wp]
      a%series%minimum(1) = 2.0_wp
      b = a
      b%series%x(1, 2) = 1.9_wp      ! it touches here a little before
      b%series%low(1, 2:) = 1.9_wp
      b%series%high(1, 2) = 1.9_wp
      b%series%minimum(1) = 1.9_wp
      scale = 1.0_wp
      by_instant = 0.0_wp
      by_channel = 0.0_wp
      worst = 0
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_close(error, by_instant, [0.0_wp, 0.0_wp, 0.1_wp, 0.1_wp], 1.0e-14_wp, "by instant")
   end subroutine test_place_of_a_contact

   !> An angle that jumps from pi to -pi is not a turn off where one run is before the jump and the other behind it.
   subroutine test_angles_that_go_round(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: apart = 1.0e-9_wp  ! of the runs [rad]
      type(kept_channels_t) :: a, b
      real(wp) :: by_channel(2), by_instant(n_instant), scale(n_kind)
      integer :: i, worst(n_instant)

      call new_run(a)
      a%factor_of = 1.0_wp
      a%goes_round(1) = .true.
      a%series%x(1, :) = [0.0_wp, 0.9_wp*pi, pi - apart/2.0_wp, -0.5_wp*pi]
      b = a
      b%series%x(1, 3) = -pi + apart/2.0_wp
      do i = 1, n_instant
         call bound(a, i)
         call bound(b, i)
      end do
      a%series%minimum = a%series%low(:, n_instant)
      b%series%minimum = b%series%low(:, n_instant)
      a%series%most = a%series%high(:, n_instant)
      b%series%most = b%series%high(:, n_instant)
      scale = 1.0_wp
      by_instant = 0.0_wp
      by_channel = 0.0_wp
      worst = 0
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_close(error, by_instant(3), apart, 1.0e-5_wp*apart, "across the jump")
      a%goes_round(1) = .false.
      call set_differences(a, b, scale, 9.0_wp, by_instant, by_channel, worst)
      call check_true(error, by_instant(3) > 6.0_wp, "what is no such angle is a turn off")

   contains

      !> Extremes so far.
      subroutine bound(run, i)
         type(kept_channels_t), intent(inout) :: run  !! a run
         integer, intent(in) :: i                     !! instant

         run%series%low(1, i) = minval(run%series%x(1, :i))
         run%series%high(1, i) = maxval(run%series%x(1, :i))
      end subroutine bound

   end subroutine test_angles_that_go_round

   subroutine test_scales(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_channels_t) :: a
      real(wp), allocatable :: scale(:)

      call new_run(a)
      a%summary%quality%energy_max = 7.0_wp
      a%magnitude(sort_velocities) = 4.0_wp   ! a row between two instants
      a%magnitude(sort_reactions) = 30.0_wp
      a%magnitude(n_sort + 2:) = [2.0e6_wp, 3.0e-6_wp]   ! a pressure and a flow of the same joint
      scale = channel_scales(a, 5.0_wp, 3.0_wp)
      call check_close(error, scale(:n_sort), [3.0_wp, 4.0_wp, 30.0_wp], 1.0e-14_wp, "range of positions, greatest of the others")
      call check_true(error, all(scale > 0.0_wp), "every kind has a scale")
      call check_close(error, scale(n_sort + 1:), [7.0_wp, 2.0e6_wp, 3.0e-6_wp], 1.0e-9_wp, &
                       "energies by the largest energy, each other unit by itself")
   end subroutine test_scales

   subroutine test_first_other_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kept_channels_t) :: a, b

      call new_run(a)
      a%contacts = [contact_t(1, 0.2_wp), contact_t(2, 0.9_wp), contact_t(1, 1.7_wp)]
      b = a
      call check_true(error, .not. ieee_is_finite(first_other_contact(a, b, 3.0_wp)), "the same contacts")
      b%contacts(3)%number = 2
      associate (from => first_other_contact(b, a, 3.0_wp))
         call check_close(error, from, 1.7_wp, 3.0e-3_wp, "to a thousandth of the motion, the first other one")
      end associate
   end subroutine test_first_other_contact

end module test_channel_difference
