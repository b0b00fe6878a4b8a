!> The registered stabilisation methods on a free four-bar, whose motion is known from its energy; dependent coordinates
!> that are chosen anew, and runs that are continued with.
module test_hold_kinds
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use free_four_bar, only: four_bar, n_turn, run_four_bar
   use stabilisation_partitioning, only: stabilisation_partitioning_t
   use stabilisation_registry, only: n_stabilisation_kinds
   use kinds, only: two_pi, wp
   use mechanism_energy, only: energy_of, energy_t
   use recorder, only: summary_t
   use scene_fixture, only: nl
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_hold_kinds

contains

   subroutine run_test_hold_kinds(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("four_bar", test_four_bar)
      call suite%test("nothing_held", test_nothing_held)
      call suite%test("partition_follows", test_partition_follows)
      call suite%test("goes_on_bitwise", test_goes_on)
   end subroutine run_test_hold_kinds

   !> Every way: the crank has made whole turns when the energy says so, the violation and the ledger keep their limits.
   subroutine test_four_bar(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: by_verner = nl//"tolerance = 1e-11", by_steps = nl//"method = rk4"//nl//"step = 0.1 ms"
      integer :: n_way

      n_way = 0
      ! limits: angle [rad], violation [m], work of the stabilisation as a part of the energy [1]
      call check_way("none"//by_verner, 1.0e-7_wp, 1.0e-7_wp, 1.0e-6_wp)
      call check_way("baumgarte alpha=20s^-1 beta=20s^-1"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("baumgarte_step alpha=0.1 beta=0.1"//by_steps, 1.0e-6_wp, 1.0e-8_wp, 1.0e-5_wp)
      call check_way("baumgarte_adaptive target=1e-9"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("augmented_lagrangian omega=20s^-1"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("partitioning"//by_verner, 1.0e-7_wp, 1.0e-12_wp, 1.0e-7_wp)
      call check_way("projection"//by_verner, 1.0e-7_wp, 1.0e-12_wp, 1.0e-7_wp)
      call check_way("projection"//by_steps, 1.0e-6_wp, 1.0e-12_wp, 1.0e-5_wp)
      call check_equal(error, n_way, n_stabilisation_kinds() + 1, "ways that were looked at, one of them twice")

   contains

      !> One way.
      subroutine check_way(setting, angle_limit, violation_limit, work_limit)
         character(*), intent(in) :: setting           !! after `stabilise =`
         real(wp), intent(in) :: angle_limit           !! of the crank's angle at the end [rad]
         real(wp), intent(in) :: violation_limit       !! at all samples [m]
         real(wp), intent(in) :: work_limit            !! of the stabilisation, of the energy [1]

         type(energy_t) :: energy
         type(loaded_t) :: loaded
         type(summary_t) :: summary

         call run_four_bar("stabilise = "//setting, loaded, summary, error)
         if (allocated(error)) return
         n_way = n_way + 1
         energy = energy_of(loaded%system, loaded%method%step%y1)
         call check_close(error, loaded%method%step%y1(3), n_turn*two_pi, angle_limit, "angle of the crank with "//setting)
         call check_true(error, summary%quality%violation_max <= violation_limit, "violation "// &
                         to_text(summary%quality%violation_max)//" with "//setting//" keeps its limit")
         call check_true(error, abs(energy%stabilisation_work) <= work_limit*energy%kinetic, "work "// &
                         to_text(energy%stabilisation_work)//" of the stabilisation with "//setting//" keeps its limit")
         call check_true(error, summary%quality%energy_residual_max <= 10.0_wp*work_limit*energy%kinetic, &
                         "the ledger closes with "//setting)
      end subroutine check_way

   end subroutine test_four_bar

   !> Without anything the violation grows with time: after four times the time it is more than four times as large.
   subroutine test_nothing_held(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper(2)
      type(loaded_t), allocatable :: loaded(:)
      type(summary_t) :: summary(2)
      integer :: k

      allocate (loaded(2))
      do k = 1, 2
         call load_text(four_bar//"end = 2 s"//nl//"stabilise = none"//nl//"method = rk4"//nl//"step = 1 ms"//nl, loaded(k), error)
         if (allocated(error)) return
         if (k == 1) loaded(k)%plan%end = 0.5_wp
         call run_to_end(loaded(k), keeper(k), summary(k), error)
         if (allocated(error)) return
      end do
      call check_true(error, summary(1)%quality%violation_max > 1.0e-12_wp, "there is a violation")
      call check_true(error, summary(2)%quality%violation_max > 4.0_wp*summary(1)%quality%violation_max, &
                      "it grows faster than time")
   end subroutine test_nothing_held

   !> A free slider-crank through both dead centres: where the slider stands still it cannot stand for the crank. The dependent
   !> coordinates are chosen anew, and nothing is seen of that in energy or violation.
   subroutine test_partition_follows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded
      type(energy_t) :: energy
      integer, allocatable :: before(:)
      real(wp) :: kinetic, worst
      integer :: n_change, status

      call load_text("deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl// &
                     "crank 0.3 1e-4 0 0.025 {90 deg}"//nl// &
                     "rod 0.2 2e-4 {0.5m*sqrt(0.12^2 - 0.05^2)} 0.025 {-asin(0.05/0.12)}"//nl// &
                     "slider 0.2 1e-4 {1m*sqrt(0.12^2 - 0.05^2)} 0 0"//nl// &
                     "[points]"//nl//"name body xi[mm] eta[mm]"//nl//"main ground 0 0"//nl//"heel crank -25 0"//nl// &
                     "throw crank 25 0"//nl//"big rod -60 0"//nl//"small rod 60 0"//nl//"pin slider 0 0"//nl// &
                     "[joint.revolute]"//nl//"name i j"//nl//"bearing main heel"//nl//"big_end throw big"//nl// &
                     "gudgeon small pin"//nl// &
                     "[joint.translational]"//nl//"name i j axis"//nl//"guide main pin x"//nl// &
                     "[initial.speed]"//nl//"name joint speed[rad/s]"//nl//"kick bearing 60"//nl// &
                     "[analysis.dynamic]"//nl//"end = 0.5 s"//nl//"tolerance = 1e-10"//nl// &
                     "stabilise = partitioning"//nl, loaded, error)
      if (allocated(error)) return
      associate (system => loaded%system, method => loaded%method)
         call method%start(system, 0.0_wp, loaded%y, 0.5_wp, status)
         energy = energy_of(system, loaded%y)
         kinetic = energy%kinetic
         n_change = 0
         worst = 0.0_wp
         ! as if the place of the slider had been chosen to stand for all
         select type (way => system%stabiliser)
         type is (stabilisation_partitioning_t)
            way%order = [1, 2, 3, 4, 5, 6, 8, 9, 7]
            before = way%order
            way%rank = 8
            way%quality = 0.1_wp
         end select
         do while (method%t < 0.5_wp .and. .not. allocated(error))
            call method%advance(system, 0.5_wp, status)
            call check_true(error, status >= 0, "a step is made")
            select type (way => system%stabiliser)
            type is (stabilisation_partitioning_t)
               call check_equal(error, way%rank, 8, "dependent coordinates")
               if (any(before /= way%order)) n_change = n_change + 1
               before = way%order
            end select
            worst = max(worst, maxval(system%linkage%solution%row_weight*abs(system%linkage%rows%phi)))
         end do
         call check_true(error, n_change >= 1, "coordinates are sorted anew, "//to_text(n_change)//" times")
         call check_true(error, worst < 1.0e-12_wp, "violation "//to_text(worst))
         energy = energy_of(system, method%step%y1)
         call check_close(error, energy%kinetic, kinetic, 1.0e-6_wp*kinetic, "energy at the end")
         call check_true(error, method%step%y1(3) > 2.0_wp*two_pi, "several turns")
      end associate
   end subroutine test_partition_follows

   !> Saved in the middle, loaded into fresh objects and continued with, a run is equal bit for bit.
   subroutine test_goes_on(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_restart("baumgarte_adaptive")
      call check_restart("partitioning")
      call check_restart("baumgarte_step alpha=0.1 beta=0.1"//nl//"method = rk4"//nl//"step = 1 ms")

   contains

      !> One way.
      subroutine check_restart(setting)
         character(*), intent(in) :: setting  !! after `stabilise =`

         type(loaded_t), allocatable :: runs(:)
         type(archive_t) :: archive
         integer :: k, status

         allocate (runs(2))
         if (allocated(error)) return
         do k = 1, 2
            call load_text(four_bar//"end = 1 s"//nl//"stabilise = "//setting//nl, runs(k), error)
            if (allocated(error)) return
            call runs(k)%method%start(runs(k)%system, 0.0_wp, runs(k)%y, 1.0_wp, status)
         end do
         call go_to(runs(1), 0.4_wp)
         if (allocated(error)) return
         associate (first => runs(1), second => runs(2))
            call first%method%save(archive)
            call first%system%save(archive)
            call second%method%load(archive)
            call second%system%load(archive)
            call check_true(error, archive%is_at_end(), "as many numbers loaded as saved with "//setting)
            call go_to(first, 1.0_wp)
            call go_to(second, 1.0_wp)
            if (allocated(error)) return
            call check_close(error, second%method%step%y1, first%method%step%y1, 0.0_wp, "state at the end with "//setting)
            call check_equal(error, int(second%method%count%n_steps), int(first%method%count%n_steps), "steps with "//setting)
         end associate
      end subroutine check_restart

      !> Steps until a time is passed.
      subroutine go_to(run, t)
         type(loaded_t), intent(inout) :: run  !! the run
         real(wp), intent(in) :: t             !! the time [s]

         integer :: status

         do while (run%method%t < t .and. .not. allocated(error))
            call run%method%advance(run%system, 1.0_wp, status)
            call check_true(error, status >= 0, "a step is made with "//run%system%stabiliser%words())
         end do
      end subroutine go_to

   end subroutine test_goes_on

end module test_hold_kinds
