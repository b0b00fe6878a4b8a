!> Contacts of the revolute clearance written out by hand; the description that any contact leaves behind.
module test_clearance_revolute
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_equal, check_true, suite_t
   use clearance_set, only: n_integrand
   use clearance_bench, only: bench_t, claim_all, evaluate_loads, make_bench, n_all, n_before, n_body, n_item
   use errors, only: error_t
   use friction_law, only: memory_bristle, memory_none
   use free_impact, only: impact_t, run_impact
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t
   use read_channel, only: read_loose
   use recorder, only: event_t
   implicit none (type, external)
   private
   public :: run_test_clearance_revolute

contains

   subroutine run_test_clearance_revolute(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("channels", test_channels)
      call suite%test("story_of_a_contact", test_description_of_a_contact)
      call suite%test("contact_time", test_contact_time)
   end subroutine run_test_clearance_revolute

   subroutine test_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, channels)
   end subroutine test_channels

   !> The channels of a revolute clearance and its loads against formulas written out with the angle of e.
   subroutine channels(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(kind_info_t) :: info
      type(loads_t) :: loads
      real(wp) :: integrands(n_integrand, n_all), one(1), f(2), force(2, n_all), friction(1, n_all), normal(1, n_all)
      real(wp) :: expected, sliding
      real(wp) :: e(2), e_dot(2), n(2), p(2, 2), s(2), t(2), v(2, 2), w(2)
      integer :: body, k, side

      info = bench%set%info()
      if (info%name /= "clearance.revolute") return
      ! a force that depends on a state, or always on material velocities: test_friction_memory
      if (bench%set%stick_slip%memory == memory_bristle .or. (bench%is_book &
                                                              .and. bench%set%stick_slip%memory /= memory_none)) return
      call evaluate_loads(bench, loads, integrands)
      force = 0.0_wp
      friction = 0.0_wp
      normal = 0.0_wp
      call read_loose(bench%set, "force", bench%motion, force)
      call read_loose(bench%set, "friction_force", bench%motion, friction)
      call read_loose(bench%set, "normal_force", bench%motion, normal)
      do k = 1, n_item
         do side = 1, 2
            body = bench%set%items%body(side, k)
            s = merge(bench%set%items%s_i(1:2, k), bench%set%items%s_j(1:2, k), side == 1)
            s = matmul(bench%motion%rot(1:2, 1:2, body), s)
            w(side) = bench%motion%omega(3, body)
            p(:, side) = bench%motion%r(1:2, body) + s
            v(:, side) = bench%motion%v(1:2, body) + w(side)*[-s(2), s(1)]
         end do
         e = p(:, 2) - p(:, 1)
         e_dot = v(:, 2) - v(:, 1)
         n = e/norm2(e)
         t = [-n(2), n(1)]
         ! radii 9.5 and 10 mm, each less or more by half the penetration of 0.02 mm
         sliding = dot_product(e_dot, t) + 9.49e-3_wp*w(2) - 10.01e-3_wp*w(1)
         if (bench%is_book) sliding = 2.0e-5_wp*dot_product(e_dot, t)/norm2(e)
         expected = 0.0_wp
         if (allocated(bench%set%laws%friction)) then
            call bench%set%laws%friction%force(1, normal(1, n_before + k:n_before + k), [abs(sliding)], one)
            expected = -sign(one(1), sliding)
         end if
         call check_close(error, friction(1, n_before + k), expected, 1.0e-9_wp*normal(1, n_before + k), &
                          bench%name//": friction on the journal")
         f = -normal(1, n_before + k)*n + expected*t
         call check_close(error, force(:, n_before + k), f, 1.0e-9_wp, bench%name//": force on the journal", relative=.true.)
         ! the ground has the journal of item 3 and the bearing of item 2
         if (bench%set%items%body(2, k) == 0) f = f - force(:, n_before + 2)
         call check_close(error, loads%force(1:2, bench%set%items%body(2, k)), f, 1.0e-9_wp, bench%name//": load", relative=.true.)
      end do
   end subroutine channels

   !> The row that a contact leaves behind, over or cut off by the end of the run.
   subroutine test_description_of_a_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(event_t) :: event

      call make_bench(1, 1, 0, 1, bench)
      associate (set => bench%set)
         call set%begin_contact(1, 0.5_wp, 2.0_wp, 3.0_wp)
         set%contact(1)%peak_force = 700.0_wp
         set%contact(1)%peak_penetration = 1.0e-6_wp
         call set%end_contact(1, 0.75_wp, 1.5_wp, 3.5_wp, .true., event)
         call check_close(error, [event%time, event%duration, event%impact_speed, event%release_speed, event%peak_force, &
                                  event%peak_penetration, event%energy_lost], &
                          [0.5_wp, 0.25_wp, 2.0_wp, 1.5_wp, 700.0_wp, 1.0e-6_wp, 0.5_wp], 0.0_wp, "a contact that is over")
         call check_equal(error, event%item//" "//event%state_before//" "//event%state_after, "item_1 free free", "its words")
         call check_true(error, .not. set%contact(1)%is_touching, "it is over")
         call set%end_contact(2, 0.75_wp, 0.0_wp, 0.0_wp, .false., event)
         call check_true(error, .not. ieee_is_finite(event%duration), "the duration is not known")
         call check_true(error, .not. ieee_is_finite(event%release_speed), "nor the release speed")
         call check_equal(error, event%state_after, "contact", "the run ended within it")
      end associate
   end subroutine test_description_of_a_contact

   !> The duration of an elastic impact against its integration, with the reduced mass of the two bodies.
   subroutine test_contact_time(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: inverse_mass(0:n_body) = [0.0_wp, 5.0_wp, 3.0_wp, 4.0_wp, 2.0_wp]
      real(wp), parameter :: reduced(n_item) = [0.125_wp, 0.25_wp, 0.5_wp]
      type(bench_t) :: bench
      type(impact_t) :: impact
      integer :: k

      call make_bench(1, 1, 0, 1, bench)
      do k = 1, n_item
         call run_impact(bench%set%laws%normal, bench%set%laws%parameters(:, k), reduced(k), 0.7_wp, impact)
         call check_close(error, bench%set%contact_time(k, 0.7_wp, inverse_mass), impact%duration, 1.0e-4_wp, &
                          "duration of an elastic impact", relative=.true.)
      end do
   end subroutine test_contact_time

end module test_clearance_revolute
