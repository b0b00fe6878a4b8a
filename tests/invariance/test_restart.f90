!> Saved, loaded into fresh objects and continued with, a run is equal bit for bit; so is a run repeated.
!>
!> What is saved and refused by name: test_restart_refused.
module test_restart
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_bodies
   use check, only: check_close, check_equal, check_true, suite_t
   use archive, only: archive_t
   use deck_scene, only: dry_deck, keeper_t, load_file, loaded_t, run_to_end
   use errors, only: error_t
   use guards, only: guards_t
   use integrator, only: advance_event
   use kinds, only: wp
   use moving_part, only: advance_part, begin_part, handle_part_events, moving_part_t, new_part
   use recorder, only: event_t, summary_t
   use run_memory, only: load_part_memory, save_part_memory
   use run_tally, only: run_tally_t
   use scratch_deck, only: remove_scratch, write_scratch
   implicit none (type, external)
   private
   public :: run_test_restart

   real(wp), parameter :: t_end = 3.0e-3_wp      !! end of the runs [s]

   !> A run in hand.
   type :: run_t
      type(loaded_t) :: loaded                   !! deck, system, integrator
      type(moving_part_t) :: part                !! these in motion
      type(run_tally_t) :: tally                 !! contacts that started
      type(keeper_t) :: keeper                   !! what is reported of contacts that ended
   end type run_t

contains

   subroutine run_test_restart(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("goes_on_bitwise", test_goes_on)
      call suite%test("goes_on_bitwise_where_the_penetration_turns", test_goes_on_turning)
      call suite%test("goes_on_bitwise_with_friction_that_sticks", test_goes_on_sticking)
      call suite%test("goes_on_bitwise_with_bristles", test_goes_on_bristling)
      call suite%test("goes_on_bitwise_with_films", test_goes_on_lubricated)
      call suite%test("load_reads_what_save_writes", test_memory_size)
      call suite%test("loading_what_was_saved", test_loading)
      call suite%test("repeated_run_is_bitwise_equal", test_repeated)
   end subroutine run_test_restart

   !> Load a deck and start: the dry slider-crank with friction, if none is given.
   subroutine begin(run, error, deck, setting, end)
      type(run_t), intent(out), target :: run            !! the run, at t = 0
      type(error_t), allocatable, intent(out) :: error   !! an error
      character(*), intent(in), optional :: deck         !! its path
      character(*), intent(in), optional :: setting      !! a parameter, as name=value
      real(wp), intent(in), optional :: end              !! no step goes beyond; absent: t_end [s]

      type(catalogue_t) :: catalogue
      type(guards_t) :: none
      real(wp) :: latest

      if (present(deck)) then
         call load_file(deck, run%loaded, error, setting)
      else
         call load_file(dry_deck, run%loaded, error, "friction=0.03")
      end if
      if (allocated(error)) return
      latest = t_end
      if (present(end)) latest = end
      call new_part(run%loaded%system, run%loaded%method, run%loaded%plan%output_times, none, run%part)
      call run%keeper%start(catalogue, error)
      if (.not. allocated(error)) call begin_part(run%part, run%loaded%y, latest, run%tally, run%keeper, error)
   end subroutine begin

   !> One step and what belongs to it, as an analysis does it.
   subroutine make_step(run, error)
      type(run_t), intent(inout) :: run                     !! the run
      type(error_t), allocatable, intent(inout) :: error    !! it failed

      call advance_part(run%part, run%tally, error)
      if (allocated(error)) return
      if (run%part%status == advance_event) call handle_part_events(run%part, run%tally, run%keeper, error)
   end subroutine make_step

   !> Write all that a run must remember.
   subroutine save_run(run, checkpoint)
      type(run_t), intent(in) :: run                     !! the run
      type(archive_t), intent(inout) :: checkpoint    !! its memory

      call save_part_memory(run%part, checkpoint)
   end subroutine save_run

   !> Take it back into a run that has just started.
   subroutine load_run(run, checkpoint, error)
      type(run_t), intent(inout) :: run                     !! a fresh run
      type(archive_t), intent(inout) :: checkpoint          !! memory
      type(error_t), allocatable, intent(out) :: error      !! it was refused

      call load_part_memory(checkpoint, run%part, error)
   end subroutine load_run

   !> Step to the onset of the third contact.
   subroutine go_to_third_contact(run, error)
      type(run_t), intent(inout) :: run                     !! the run
      type(error_t), allocatable, intent(inout) :: error    !! it failed

      do while (.not. allocated(error) .and. run%tally%contacts < 3)
         call make_step(run, error)
      end do
      call check_true(error, run%keeper%n_event == 2 .and. run%loaded%method%t < t_end, "at the onset of the third contact")
   end subroutine go_to_third_contact

   !> Saved after every step of the third contact, the ones just before its peaks among them, loaded, and run on to the end.
   subroutine test_goes_on(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: most = 100  ! checkpoints
      type(run_t), allocatable, target :: second
      type(run_t), target :: first
      type(archive_t) :: saved(most)
      integer :: k, n_save

      call begin(first, error)
      if (.not. allocated(error)) call go_to_third_contact(first, error)
      if (allocated(error)) return
      n_save = 0
      do while (first%loaded%method%t < t_end .and. .not. allocated(error))
         if (first%keeper%n_event == 2 .and. n_save < most) then
            n_save = n_save + 1
            call save_run(first, saved(n_save))
         end if
         call make_step(first, error)
      end do
      call check_true(error, n_save > 10 .and. n_save < most, "checkpoints through the whole contact")
      call check_true(error, first%keeper%n_event > 4, "several contacts")
      do k = 1, n_save
         if (allocated(error)) return
         allocate (second)
         call begin(second, error)
         if (.not. allocated(error)) call load_run(second, saved(k), error)
         if (allocated(error)) return
         do while (second%loaded%method%t < t_end .and. .not. allocated(error))
            call make_step(second, error)
         end do
         call compare(second)
         deallocate (second)
      end do

   contains

      !> State, counters, memory and events of both runs are equal.
      subroutine compare(run)
         type(run_t), intent(in) :: run  !! that was loaded

         type(archive_t) :: one, other
         integer :: missed

         call check_close(error, run%loaded%method%step%y1, first%loaded%method%step%y1, 0.0_wp, "state at the end")
         call check_close(error, run%loaded%method%step%f1, first%loaded%method%step%f1, 0.0_wp, "derivative at the end")
         associate (count => run%loaded%method%count, first_count => first%loaded%method%count)
            call check_equal(error, int(count%n_steps), int(first_count%n_steps), "steps")
            call check_equal(error, int(count%n_rejected), int(first_count%n_rejected), "rejected steps")
            call check_equal(error, int(count%n_evaluations), int(first_count%n_evaluations), "evaluations")
         end associate
         call check_equal(error, int(run%loaded%system%n_evaluations), int(first%loaded%system%n_evaluations), &
                          "evaluations of the system")
         call save_run(first, one)
         call save_run(run, other)
         call check_close(error, other%row(:other%n), one%row(:one%n), 0.0_wp, "all that is saved")
         missed = first%keeper%n_event - run%keeper%n_event
         call check_true(error, missed == 2 .and. run%keeper%n_event > 2, "contacts before and after")
         if (allocated(error)) return
         call check_close(error, told(run%keeper%events(:run%keeper%n_event)), &
                          told(first%keeper%events(missed + 1:first%keeper%n_event)), 0.0_wp, "events")
      end subroutine compare

   end subroutine test_goes_on

   !> The numbers of events.
   pure function told(events) result(numbers)
      type(event_t), intent(in) :: events(:)      !! (any) events
      real(wp) :: numbers(7*size(events))         !! (7 events) what is reported of each [any]

      numbers = [events%time, events%impact_speed, events%peak_force, events%peak_penetration, events%duration, &
                 events%release_speed, events%energy_lost]
   end function told

   !> A law whose force jumps where the penetration turns: impacts, and a pin that comes to rest.
   subroutine test_goes_on_turning(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call go_on_from_anywhere("inputs/slider_crank_dry.deck", "law=kelvin_voigt", 5.0e-4_wp, error)
      if (.not. allocated(error)) call go_on_from_anywhere("inputs/hard/pin_at_rest.deck", "law=kelvin_voigt", 0.02_wp, error)
   end subroutine test_goes_on_turning

   !> A disc thrown along a floor slides until it rolls.
   subroutine test_goes_on_sticking(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call go_on_thrown("coulomb", error)
   end subroutine test_goes_on_sticking

   !> The same with bristles.
   subroutine test_goes_on_bristling(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call go_on_thrown("lugre", error)
   end subroutine test_goes_on_bristling

   !> Films: of pressures on a grid, which start with those of the solution before; and one that goes over into dry contact.
   subroutine test_goes_on_lubricated(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = "inputs/slider_crank_lubricated.deck"

      call go_on_from_anywhere(deck, "film=grid;turns=1", 1.0e-4_wp, error, has_contact=.false.)
      if (.not. allocated(error)) call go_on_from_anywhere(deck, "film=finite;viscosity=40cP;turns=1", 1.0e-3_wp, error, &
                                                           has_contact=.false.)
      if (.not. allocated(error)) then
         call go_on_from_anywhere(deck, "film=squeeze;level=hybrid;viscosity=4cP;turns=1", 4.0e-4_wp, error)
      end if
   end subroutine test_goes_on_lubricated

   !> A disc thrown along a floor, with a friction law that remembers.
   subroutine go_on_thrown(friction, error)
      character(*), intent(in) :: friction                 !! friction law
      type(error_t), allocatable, intent(out) :: error     !! what failed

      character(*), parameter :: nl = new_line("a")
      character(:), allocatable :: path

      call write_scratch("deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl//"[parameters]"//nl//"law = none"//nl// &
                         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[mm] y[mm] angle[deg] vx[m/s]"//nl// &
                         "disc 1 1.25e-3 0 50.01 0 0.1"//nl//"[points]"//nl//"name body xi[mm] eta[mm]"//nl// &
                         "foot ground 0 0"//nl//"centre disc 0 0"//nl//"[material]"//nl//"name young[GPa] poisson"//nl// &
                         "steel 207 0.3"//nl//"[clearance.plane]"//nl// &
                         "name plane ball axis radius[mm] material law friction"//nl// &
                         "floor foot centre y 50 steel spring {law}"//nl//"[contact.kelvin_voigt]"//nl// &
                         "name stiffness[N/m] restitution form"//nl//"spring 1e5 0.2 dashpot"//nl//"[friction.coulomb]"//nl// &
                         "name coefficient"//nl//"coulomb 0.3"//nl//"[friction.lugre]"//nl// &
                         "name coefficient"//nl//"lugre 0.3"//nl// &
                         "[analysis.dynamic]"//nl//"start = given"//nl//"end = 0.03 s"//nl// &
                         "tolerance = 1e-8"//nl//"[output]"//nl//"every = 1 ms"//nl, path)
      call go_on_from_anywhere(path, "law="//friction, 0.03_wp, error)
      call remove_scratch(path)
   end subroutine go_on_thrown

   !> Saved after every fifth step, loaded, and run on to the end: state and memory are equal bit for bit.
   subroutine go_on_from_anywhere(deck, setting, t_stop, error, has_contact)
      character(*), intent(in) :: deck                     !! path of the deck
      character(*), intent(in) :: setting                  !! a parameter, as name=value
      real(wp), intent(in) :: t_stop                       !! no checkpoint, and no step, after this time [s]
      type(error_t), allocatable, intent(out) :: error     !! what failed
      logical, intent(in), optional :: has_contact         !! a contact starts; absent: it does

      integer, parameter :: every = 2, most = 1000  ! steps between checkpoints; checkpoints
      type(run_t), allocatable, target :: second
      type(run_t), target :: first
      type(archive_t) :: one, other
      type(archive_t), allocatable :: saved(:)
      integer :: k, n, n_step
      logical :: is_touching

      call begin(first, error, deck, setting, t_stop)
      allocate (saved(most))
      n = 0
      n_step = 0
      do while (.not. allocated(error) .and. first%loaded%method%t < t_stop .and. n < most)
         if (modulo(n_step, every) == 0) then
            n = n + 1
            call save_run(first, saved(n))
         end if
         call make_step(first, error)
         n_step = n_step + 1
      end do
      call check_true(error, n > 5 .and. n < most, "checkpoints")
      is_touching = .true.
      if (present(has_contact)) is_touching = has_contact
      if (is_touching .and. .not. allocated(error)) call check_true(error, first%tally%contacts > 0, "through a contact")
      do k = 1, n
         if (allocated(error)) return
         allocate (second)
         call begin(second, error, deck, setting, t_stop)
         if (.not. allocated(error)) call load_run(second, saved(k), error)
         if (allocated(error)) return
         do while (second%loaded%method%t < t_stop .and. .not. allocated(error))
            call make_step(second, error)
         end do
         call save_run(first, one)
         call save_run(second, other)
         call check_close(error, second%loaded%method%step%y1, first%loaded%method%step%y1, 0.0_wp, "state at the end")
         call check_close(error, other%row(:other%n), one%row(:one%n), 0.0_wp, "all that is saved")
         deallocate (second)
      end do
   end subroutine go_on_from_anywhere

   !> Each part reads as many numbers as it writes.
   subroutine test_memory_size(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(run_t), target :: run
      type(archive_t) :: archive

      call begin(run, error)
      if (allocated(error)) return
      call run%loaded%method%save(archive)
      call run%loaded%method%load(archive)
      call check_true(error, archive%is_at_end(), "read by the integrator")
      call run%loaded%system%save(archive)
      call run%loaded%system%load(archive)
      call check_true(error, archive%is_at_end(), "read by the system")
   end subroutine test_memory_size

   !> What was loaded is what was saved, number by number; the last step is over.
   subroutine test_loading(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(run_t), target :: first, second
      type(archive_t) :: again, saved
      real(wp), allocatable :: y(:)

      call begin(first, error)
      if (.not. allocated(error)) call go_to_third_contact(first, error)
      if (.not. allocated(error)) call begin(second, error)
      if (allocated(error)) return
      call save_run(first, saved)
      call load_run(second, saved, error)
      if (allocated(error)) return
      call save_run(second, again)
      call check_close(error, again%row(:again%n), saved%row(:saved%n), 0.0_wp, "saved again")
      call check_equal(error, second%loaded%system%clearance_joints%sets(1)%set%n_touching, 1, "contacts")
      allocate (y(second%loaded%system%n), source=0.0_wp)
      call second%loaded%method%state_at(second%loaded%system, second%loaded%method%t, y)
      call check_close(error, y, first%loaded%method%step%y1, 0.0_wp, "present state")
   end subroutine test_loading

   !> Two runs in one process: samples, events and the summary.
   subroutine test_repeated(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keepers(2)
      type(summary_t) :: summaries(2)
      integer :: k

      do k = 1, 2
         call one_run(keepers(k), summaries(k))
         if (allocated(error)) return
      end do
      associate (a => keepers(1), b => keepers(2))
         call check_equal(error, b%n_sample, a%n_sample, "samples")
         call check_equal(error, b%n_event, a%n_event, "events")
         if (allocated(error)) return
         call check_close(error, b%time(:b%n_sample), a%time(:a%n_sample), 0.0_wp, "times")
         call check_close(error, b%value(:b%n_sample), a%value(:a%n_sample), 0.0_wp, "slider's accelerations")
         call check_true(error, maxval(abs(a%value(:a%n_sample))) > 1.0e4_wp, "they are something")
         do k = 1, a%n_event
            call check_close(error, [b%events(k)%time, b%events(k)%peak_force, b%events(k)%peak_penetration, &
                                     b%events(k)%impact_speed, b%events(k)%energy_lost], &
                             [a%events(k)%time, a%events(k)%peak_force, a%events(k)%peak_penetration, &
                              a%events(k)%impact_speed, a%events(k)%energy_lost], 0.0_wp, "events")
         end do
      end associate
      associate (a => summaries(1)%quality, b => summaries(2)%quality)
         call check_close(error, [b%energy_max, b%energy_residual_max, b%violation_max, b%violation_rate_max], &
                          [a%energy_max, a%energy_residual_max, a%violation_max, a%violation_rate_max], 0.0_wp, "accuracy")
      end associate
      associate (a => summaries(1)%count, b => summaries(2)%count)
         call check_equal(error, int(b%rhs_evaluations), int(a%rhs_evaluations), "evaluations")
         call check_equal(error, int(b%factorisations), int(a%factorisations), "factorisations")
      end associate

   contains

      !> A run to 3 ms with the slider's acceleration kept.
      subroutine one_run(keeper, summary)
         type(keeper_t), intent(out) :: keeper      !! keeps the results
         type(summary_t), intent(out) :: summary    !! cost and errors

         type(loaded_t) :: loaded

         keeper%item_group = group_bodies
         keeper%channel = "acceleration"
         call load_file(dry_deck, loaded, error, "friction=0.03")
         if (allocated(error)) return
         loaded%plan%end = t_end
         call run_to_end(loaded, keeper, summary, error)
      end subroutine one_run

   end subroutine test_repeated

end module test_restart
