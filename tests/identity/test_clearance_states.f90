!> Contacts of every joint with clearance that are free, centred, reported or remembered, for all laws, with and without friction,
!> in all forms.
module test_clearance_states
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use clearance_bench, only: bench_t, claim_all, evaluate_loads, get_gaps, n_all, n_before, n_item
   use clearance_set, only: n_integrand
   use contact_memory, only: contact_memory_t
   use errors, only: error_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t
   use read_channel, only: read_loose
   use recorder, only: event_t
   use round_contacts, only: round_contacts_t
   implicit none (type, external)
   private
   public :: run_test_clearance_states

contains

   subroutine run_test_clearance_states(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("free_items", test_free_items)
      call suite%test("centred_journal", test_centred_journal)
      call suite%test("channels_of_an_evaluation", test_channels_of_an_evaluation)
      call suite%test("watch_of_an_evaluation", test_monitor_of_an_evaluation)
      call suite%test("memory", test_memory)
   end subroutine run_test_clearance_states

   subroutine test_free_items(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, free_items)
   end subroutine test_free_items

   !> A contact that does not touch has no force, whatever its penetration.
   subroutine free_items(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: expected(n_all), integrands(n_integrand, n_all), state(1, n_all)
      type(event_t) :: event
      integer :: k

      do k = 1, size(bench%touching)
         if (bench%set%item_of(bench%touching(k)) == 2) cycle
         call bench%set%end_contact(bench%touching(k), 0.1_wp, 0.0_wp, 0.0_wp, .true., event)
      end do
      call evaluate_loads(bench, loads, integrands)
      call check_close(error, sum(abs(loads%force(:, [1, 2, 4]))) + sum(abs(loads%moment(:, [1, 2, 4]))), 0.0_wp, 0.0_wp, &
                       bench%name//": loads on bodies that do not touch")
      call check_true(error, sum(abs(loads%force(:, 3))) > 100.0_wp, bench%name//": force on the one that does")
      call check_close(error, integrands(:, bench%first), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, bench%name//": what is integrated")
      state = -1.0_wp
      call read_loose(bench%set, "state", bench%motion, state)
      expected = -1.0_wp
      expected(bench%first:bench%last) = 0.0_wp
      do k = 1, size(bench%touching)
         if (bench%set%item_of(bench%touching(k)) == 2) expected(n_before + bench%touching(k)) = 1.0_wp
      end do
      call check_close(error, state(1, :), expected, 0.0_wp, bench%name//": states")
      do k = 1, size(bench%touching)
         if (bench%set%item_of(bench%touching(k)) /= 2) cycle
         call bench%set%end_contact(bench%touching(k), 0.1_wp, 0.0_wp, 0.0_wp, .true., event)
      end do
      call check_equal(error, bench%set%n_touching, 0, bench%name//": contacts touching")
      call evaluate_loads(bench, loads, integrands)
      call check_close(error, sum(abs(loads%force)) + sum(abs(integrands(:, bench%first:bench%last))), 0.0_wp, 0.0_wp, &
                       bench%name//": all free")
   end subroutine free_items

   subroutine test_centred_journal(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, centred_journal)
   end subroutine test_centred_journal

   !> A journal exactly in the middle, moving or at rest: no NaN anywhere, the full clearance, the speed as rate.
   subroutine centred_journal(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(kind_info_t) :: info
      type(loads_t) :: loads
      real(wp) :: delta(n_all), integrands(n_integrand, n_all), rate(n_all), speed(n_item), value(2, n_all)
      integer :: attempt, k

      if (.not. bench%set%traits%is_round) return
      bench%set%contact%is_touching = .false.
      bench%set%n_touching = 0
      bench%set%items%s_j = bench%set%items%s_i
      select type (set => bench%set)
      class is (round_contacts_t)
         do k = 1, n_item
            set%journal(k)%s_j = set%journal(k)%s_i
         end do
      end select
      bench%q = 0.0_wp
      bench%q(3, 1:2) = 1.1_wp
      info = bench%set%info()
      do attempt = 1, 2
         call get_gaps(bench, 0.0_wp, delta, rate)
         speed = 0.0_wp
         do k = 1, n_item
            if (attempt == 1) speed(k) = speed_of_journal(bench, k)
         end do
         call check_close(error, delta(n_before + 1:n_before + n_item), -bench%set%items%pairs%clearance, 0.0_wp, &
                          bench%name//": centred")
         call check_close(error, rate(n_before + 1:n_before + n_item), speed, 1.0e-14_wp, bench%name//": rate when centred")
         call evaluate_loads(bench, loads, integrands)
         call check_close(error, sum(abs(loads%force)), 0.0_wp, 0.0_wp, bench%name//": force when centred")
         do k = 1, size(info%channels)
            if (info%channels(k)%name == "p_v") cycle  ! of pins with a length
            value = 0.0_wp
            call read_loose(bench%set, info%channels(k)%name, bench%motion, value(1:info%channels(k)%components, :))
            call check_true(error, all(ieee_is_finite(value)), bench%name//": "//info%channels(k)%name//" is finite")
         end do
         bench%v = 0.0_wp
      end do
   end subroutine centred_journal

   subroutine test_channels_of_an_evaluation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, channels_of_an_evaluation)
   end subroutine test_channels_of_an_evaluation

   !> Channels that take over what the evaluation found are those that are found anew; without the evaluation they are others.
   subroutine channels_of_an_evaluation(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(kind_info_t) :: info
      type(loads_t) :: loads
      real(wp) :: anew(2, n_all), integrands(n_integrand, n_all), taken(2, n_all)
      integer :: k

      info = bench%set%info()
      bench%motion%number = 1
      call evaluate_loads(bench, loads, integrands)
      do k = 1, size(info%channels)
         anew = 0.0_wp
         taken = 0.0_wp
         associate (n => info%channels(k)%components, name => info%channels(k)%name)
            if (name == "p_v") cycle  ! of pins with a length
            bench%motion%number = 2  ! not the one of the evaluation
            call read_loose(bench%set, name, bench%motion, anew(1:n, :))
            bench%motion%number = 1
            call read_loose(bench%set, name, bench%motion, taken(1:n, :))
            call check_close(error, reshape(taken, [2*n_all]), reshape(anew, [2*n_all]), 1.0e-14_wp*maxval(abs(anew)), &
                             bench%name//": "//name)
         end associate
      end do
   end subroutine channels_of_an_evaluation

   subroutine test_monitor_of_an_evaluation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, monitor_of_an_evaluation)
   end subroutine test_monitor_of_an_evaluation

   !> Gaps, forces and energy that are those of the evaluation are those that are found anew; once a contact has changed, what the
   !> evaluation found does not count.
   subroutine monitor_of_an_evaluation(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp), dimension(2*n_all + 1) :: anew, taken
      real(wp) :: integrands(n_integrand, n_all), watched(4, 2)
      integer :: k

      bench%motion%number = 1
      call evaluate_loads(bench, loads, integrands)
      call look(2, anew)
      call look(1, taken)
      call check_close(error, taken, anew, 1.0e-14_wp*maxval(abs(anew)), bench%name//": gaps, rates, energy")
      do k = 1, bench%set%n_contact
         if (.not. bench%set%contact(k)%is_touching) cycle
         call monitor(2, watched(:, 2))
         call monitor(1, watched(:, 1))
         call check_close(error, watched(:, 1)/watched(:, 2), [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-10_wp, bench%name//": watch")
         call bench%set%set_impact_speed(k, 3.0_wp*bench%set%contact(k)%impact_speed)
         call monitor(2, watched(:, 2))
         call monitor(1, watched(:, 1))
         call check_true(error, all(abs(watched(:, 1) - watched(:, 2)) <= 0.0_wp), bench%name//": after a change")
         call evaluate_loads(bench, loads, integrands)
      end do

   contains

      !> Gaps, their rates and the energy at the motion.
      subroutine look(number, found)
         integer, intent(in) :: number                 !! of the motion
         real(wp), intent(out) :: found(2*n_all + 1)   !! (2 n_all + 1) penetrations, their rates, energy [m, m/s, J]

         found = 0.0_wp
         bench%motion%number = number
         call bench%set%gaps(bench%motion, found(:n_all), found(n_all + 1:2*n_all))
         found(2*n_all + 1) = bench%set%elastic_energy(bench%motion)
         bench%motion%number = 1
      end subroutine look

      !> What is monitored of the contact at the motion.
      subroutine monitor(number, found)
         integer, intent(in) :: number       !! of the motion
         real(wp), intent(out) :: found(4)   !! (4) penetration, its rate, force, its rate [m, m/s, N, N/s]

         bench%motion%number = number
         call bench%set%monitor(k, bench%motion, found(1), found(2), found(3), found(4))
         bench%motion%number = 1
      end subroutine monitor

   end subroutine monitor_of_an_evaluation

   !> Speed of the journal's centre against the bearing's when they coincide.
   function speed_of_journal(bench, item) result(speed)
      type(bench_t), intent(in) :: bench  !! the set, its motion set
      integer, intent(in) :: item         !! the item
      real(wp) :: speed                   !! the speed [m/s]

      real(wp) :: s(2), v(2)
      integer :: i, j

      i = bench%set%items%body(1, item)
      j = bench%set%items%body(2, item)
      s = matmul(bench%motion%rot(1:2, 1:2, i), bench%set%items%s_i(1:2, item))
      v = bench%motion%v(1:2, j) - bench%motion%v(1:2, i) &
          + (bench%motion%omega(3, j) - bench%motion%omega(3, i))*[-s(2), s(1)]
      speed = norm2(v)
   end function speed_of_journal

   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, memory)
   end subroutine test_memory

   !> What a set remembers comes back from a checkpoint, and with it the very same forces.
   subroutine memory(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(contact_memory_t), allocatable :: kept(:)
      type(loads_t) :: again, loads
      type(event_t) :: event
      type(archive_t) :: archive
      real(wp) :: integrands(n_integrand, n_all)
      integer :: k

      associate (set => bench%set)
         call set%end_contact(bench%touching(2), 0.2_wp, 0.0_wp, 0.0_wp, .true., event)
         do k = 1, set%n_contact
            set%contact(k)%onset = 0.1_wp*k
            set%contact(k)%impact_speed = 0.5_wp + k
            set%contact(k)%peak_force = 10.0_wp*k
            set%contact(k)%peak_penetration = 1.0e-5_wp*k
            set%contact(k)%loss_at_onset = k - 2.0_wp
            set%contact(k)%is_cut_off = modulo(k, 2) == 0
            set%contact(k)%held = k - 3.0_wp
            set%contact(k)%amends = k - 4.0_wp
         end do
         kept = set%contact
         call evaluate_loads(bench, loads, integrands)
         call set%save(archive)
         set%contact = contact_memory_t()
         set%contact(bench%touching(2))%is_touching = .true.
         set%n_touching = 1
         call set%load(archive)
         call check_true(error, archive%is_at_end(), bench%name//": as many numbers loaded as saved")
         call check_equal(error, set%n_touching, size(bench%touching) - 1, bench%name//": contacts touching")
         call check_true(error, all(set%contact%is_touching .eqv. kept%is_touching), bench%name//": which touch")
         call check_close(error, set%contact%onset, kept%onset, 0.0_wp, bench%name//": onsets")
         call check_close(error, set%contact%peak_force, kept%peak_force, 0.0_wp, bench%name//": peaks of force")
         call check_close(error, set%contact%peak_penetration, kept%peak_penetration, 0.0_wp, &
                          bench%name//": peaks of penetration")
         call check_close(error, set%contact%loss_at_onset, kept%loss_at_onset, 0.0_wp, bench%name//": losses")
         call check_true(error, all(set%contact%is_cut_off .eqv. kept%is_cut_off), bench%name//": which are cut off")
         call check_close(error, set%contact%held, kept%held, 0.0_wp, bench%name//": held")
         call check_close(error, set%contact%amends, kept%amends, 0.0_wp, bench%name//": amends")
         call evaluate_loads(bench, again, integrands)
         call check_true(error, all(abs(again%force - loads%force) <= 0.0_wp), bench%name//": the same forces")
      end associate
   end subroutine memory

end module test_clearance_states
