!> Saved at any step of a motion whose load jumps and bends, loaded into fresh objects and continued with, a run is equal bit for
!> bit.
!>
!> The stretch of smooth time is part of the system's memory; the search for instants, started anew, is brought to it.
!> The history of a multistep method is not saved: the run that is not disturbed takes its own checkpoints back, as runs with
!> checkpoints do.
module test_restart_instants
   use check, only: check_close, check_equal, check_true, suite_t
   use catalogue, only: catalogue_t
   use archive, only: archive_t
   use deck_scene, only: keeper_t, load_text, loaded_t
   use errors, only: error_t
   use guards, only: guards_t
   use kinds, only: wp
   use moving_part, only: advance_part, begin_part, moving_part_t, new_part, pass_part_instant
   use run_memory, only: load_part_memory, save_part_memory
   use run_tally, only: run_tally_t
   implicit none (type, external)
   private
   public :: run_test_restart_instants

   real(wp), parameter :: t_end = 1.5_wp      !! end of the runs [s]
   integer, parameter :: n_instant = 3        !! instants after t = 0
   integer, parameter :: most = 2000          !! checkpoints

   !> A run in hand.
   type :: run_t
      type(loaded_t) :: loaded                !! deck, system, integrator
      type(moving_part_t) :: part             !! these in motion
      type(run_tally_t) :: tally              !! of it
      type(keeper_t) :: keeper                !! what it reports
      integer :: n_passed = 0                 !! instants passed
      logical :: begins = .true.              !! it stands at t = 0, or behind an instant
   end type run_t

contains

   subroutine run_test_restart_instants(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("goes_on_bitwise_across_instants", test_goes_on)
   end subroutine run_test_restart_instants

   !> One-step and multistep methods.
   subroutine test_goes_on(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call go_on("verner", .false., error)
      if (.not. allocated(error)) call go_on("adams", .true., error)
      if (.not. allocated(error)) call go_on("bdf", .true., error)
   end subroutine test_goes_on

   !> Saved after every step, at the instants before and behind them.
   subroutine go_on(method, has_history, error)
      character(*), intent(in) :: method                  !! name of the integrator
      logical, intent(in) :: has_history                  !! whether it is saved at instants only
      type(error_t), allocatable, intent(out) :: error    !! what failed

      type(run_t), allocatable, target :: second
      type(run_t), target :: first
      type(archive_t), allocatable :: saved(:)
      type(archive_t) :: at_end, other
      integer :: k, n_save

      call begin(method, first, error)
      if (allocated(error)) return
      allocate (saved(most))
      n_save = 0
      do while (first%part%method%t < t_end .and. .not. allocated(error))
         call check_true(error, n_save < most, "room for the checkpoints")
         if (.not. allocated(error)) call save_here(first, has_history, error, saved, n_save)
         if (.not. allocated(error)) call go_one_step(first, error)
      end do
      call check_equal(error, first%n_passed, n_instant, "instants passed")
      if (allocated(error)) return
      call save_part_memory(first%part, at_end)
      do k = 1, n_save
         allocate (second)
         call begin(method, second, error)
         if (.not. allocated(error)) call load_part_memory(saved(k), second%part, error)
         if (.not. allocated(error)) second%begins = second%part%output_times%is_at(second%part%method%t)
         if (.not. allocated(error)) call go_one_step(second, error)
         do while (second%part%method%t < t_end .and. .not. allocated(error))
            call save_here(second, has_history, error)
            if (.not. allocated(error)) call go_one_step(second, error)
         end do
         if (allocated(error)) return
         call check_close(error, second%part%method%step%y1, first%part%method%step%y1, 0.0_wp, "state at the end")
         call save_part_memory(second%part, other)
         call check_close(error, other%row(:other%n), at_end%row(:at_end%n), 0.0_wp, "all that is saved")
         if (allocated(error)) return
         deallocate (second)
      end do
   end subroutine go_on

   !> Save a run that has come to where it is saved; with a history it takes that back, as runs with checkpoints do.
   subroutine save_here(run, has_history, error, saved, n_save)
      type(run_t), intent(inout) :: run                   !! the run
      logical, intent(in) :: has_history                  !! whether it is saved at instants only
      type(error_t), allocatable, intent(inout) :: error  !! it cannot continue
      type(archive_t), intent(inout), optional :: saved(:) !! (most) where it is kept
      integer, intent(inout), optional :: n_save              !! kept so far

      type(archive_t) :: checkpoint
      logical :: ends

      ends = run%part%output_times%is_at(run%part%method%t)
      if (run%begins .or. ends .or. .not. has_history) then
         call save_part_memory(run%part, checkpoint)
         if (present(saved) .and. present(n_save)) then
            n_save = n_save + 1
            saved(n_save) = checkpoint
         end if
         if (has_history) call load_part_memory(checkpoint, run%part, error)
      end if
      run%begins = ends
   end subroutine save_here

   !> A mass on a guide and a spring; the load jumps at 0, 0.4 and 0.5 s and bends at 0.9 s.
   subroutine begin(method, run, error)
      character(*), intent(in) :: method                 !! name of the integrator
      type(run_t), intent(out), target :: run            !! the run, at t = 0
      type(error_t), allocatable, intent(out) :: error   !! an error

      character(*), parameter :: nl = new_line("a")
      type(catalogue_t) :: catalogue
      type(guards_t) :: none

      call load_text("deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl//"p 1 1 1 0 0"//nl// &
                     "[points]"//nl//"name body xi[m] eta[m]"//nl//"o ground 0 0"//nl//"c p 0 0"//nl// &
                     "[joint.translational]"//nl//"name i j axis"//nl//"j o c x"//nl// &
                     "[force.point]"//nl//"name point fx"//nl// &
                     "f c {1N*step(t)+10N*(step(t-0.4s)-step(t-0.5s))+1N/s*max(0s,t-0.9s)}"//nl// &
                     "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"s o c 100 2 1"//nl// &
                     "[analysis.dynamic]"//nl//"start = given"//nl//"end = 1.5 s"//nl//"method = "//method//nl// &
                     "tolerance = 1e-6"//nl//"[output]"//nl//"every = 0.1 s"//nl, run%loaded, error)
      if (allocated(error)) return
      call new_part(run%loaded%system, run%loaded%method, run%loaded%plan%output_times, none, run%part)
      call run%keeper%start(catalogue, error)
      if (.not. allocated(error)) call begin_part(run%part, run%loaded%y, t_end, run%tally, run%keeper, error)
   end subroutine begin

   !> One step, to the next instant at the latest; or on behind that instant.
   subroutine go_one_step(run, error)
      type(run_t), intent(inout) :: run                     !! the run
      type(error_t), allocatable, intent(inout) :: error    !! it failed

      if (run%part%output_times%is_at(run%part%method%t)) then
         call pass_part_instant(run%part, run%tally, run%keeper, error)
         run%n_passed = run%n_passed + 1
      else
         call advance_part(run%part, run%tally, error)
      end if
   end subroutine go_one_step

end module test_restart_instants
