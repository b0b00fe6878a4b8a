!> Saved at any step of a motion whose load jumps and bends, loaded into fresh objects and gone on with, a run is equal bit for bit.
!>
!> The stretch of smooth time is part of the system's memory; the search for instants is begun anew and brought to it.
!> The history of a multistep method is not saved: its runs go on bit for bit from where it begins anew.
module test_restart_instants
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use instants, only: instants_t
   use kinds, only: wp
   use smooth_piece, only: smooth_piece_t
   implicit none (type, external)
   private
   public :: run_test_restart_instants

   real(wp), parameter :: t_end = 1.5_wp      !! end of the runs [s]
   integer, parameter :: n_instant = 3        !! instants after t = 0
   integer, parameter :: most = 2000          !! checkpoints

   !> A run in hand.
   type :: run_t
      type(loaded_t) :: loaded                !! deck, system, integrator
      type(instants_t) :: instants            !! when the load is not smooth
      integer :: n_passed = 0                 !! instants passed
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

      type(run_t), allocatable :: second
      type(run_t) :: first
      real(wp), allocatable :: rows(:, :), row(:)
      integer :: k, n_save
      logical :: begins, ends

      call begin(method, first, error)
      if (allocated(error)) return
      allocate (row(memory_size(first)), source=0.0_wp)
      allocate (rows(size(row), most), source=0.0_wp)
      n_save = 0
      begins = .true.
      do while (first%loaded%method%t < t_end .and. .not. allocated(error))
         ends = first%instants%is_at(first%loaded%method%t)
         if (begins .or. ends .or. .not. has_history) then
            n_save = n_save + 1
            call save_run(first, rows(:, n_save))
         end if
         begins = ends
         if (ends) then
            call pass(first, error)
         else
            call make_step(first, error)
         end if
         call check_true(error, n_save < most, "room for the checkpoints")
      end do
      call check_equal(error, first%n_passed, n_instant, "instants passed")
      if (allocated(error)) return
      call save_run(first, row)
      do k = 1, n_save
         allocate (second)
         call begin(method, second, error)
         if (allocated(error)) return
         call load_run(second, rows(:, k))
         do while (second%loaded%method%t < t_end .and. .not. allocated(error))
            if (second%instants%is_at(second%loaded%method%t)) then
               call pass(second, error)
            else
               call make_step(second, error)
            end if
         end do
         call check_close(error, second%loaded%method%step%y1, first%loaded%method%step%y1, 0.0_wp, "state at the end")
         call save_run(second, rows(:, k))
         call check_close(error, rows(:, k), row, 0.0_wp, "all that is saved")
         if (allocated(error)) return
         deallocate (second)
      end do
   end subroutine go_on

   !> A mass on a guide and a spring; the load jumps at 0, 0.4 and 0.5 s and bends at 0.9 s.
   subroutine begin(method, run, error)
      character(*), intent(in) :: method                 !! name of the integrator
      type(run_t), intent(out) :: run                    !! the run, at t = 0
      type(error_t), allocatable, intent(out) :: error   !! a mistake

      character(*), parameter :: nl = new_line("a")
      integer :: status

      call load_text("deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl//"p 1 1 1 0 0"//nl// &
                     "[points]"//nl//"name body xi[m] eta[m]"//nl//"o ground 0 0"//nl//"c p 0 0"//nl// &
                     "[joint.translational]"//nl//"name i j axis"//nl//"j o c x"//nl// &
                     "[force.point]"//nl//"name point fx"//nl// &
                     "f c {1N*step(t)+10N*(step(t-0.4s)-step(t-0.5s))+1N/s*max(0s,t-0.9s)}"//nl// &
                     "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"s o c 100 2 1"//nl// &
                     "[analysis.dynamic]"//nl//"start = given"//nl//"end = 1.5 s"//nl//"method = "//method//nl// &
                     "tolerance = 1e-6"//nl//"[output]"//nl//"every = 0.1 s"//nl, run%loaded, error)
      if (allocated(error)) return
      run%instants = run%loaded%plan%instants
      call run%instants%begin(t_end, run%loaded%system%linkage%piece)
      call run%loaded%method%start(run%loaded%system, 0.0_wp, run%loaded%y, t_end, status)
      call check_equal(error, status, 0, "start")
   end subroutine begin

   !> One step, to the next instant at the latest.
   subroutine make_step(run, error)
      type(run_t), intent(inout) :: run                     !! the run
      type(error_t), allocatable, intent(inout) :: error    !! it failed

      real(wp) :: t_stop
      integer :: status

      call run%instants%stop_after(run%loaded%system, run%loaded%method, t_stop)
      call run%loaded%method%advance(run%loaded%system, t_stop, status)
      call check_equal(error, status, 0, "a step is made")
   end subroutine make_step

   !> Go on behind an instant.
   subroutine pass(run, error)
      type(run_t), intent(inout) :: run                     !! the run
      type(error_t), allocatable, intent(inout) :: error    !! it failed

      integer :: status

      call run%instants%pass(run%loaded%system%linkage%piece)
      run%n_passed = run%n_passed + 1
      call run%loaded%method%restart(run%loaded%system, 0.0_wp, status)
      call check_equal(error, status, 0, "restart")
   end subroutine pass

   !> Numbers of a checkpoint.
   integer function memory_size(run)
      type(run_t), intent(in) :: run  !! the run

      memory_size = run%loaded%method%memory_size() + run%loaded%system%memory_size()
   end function memory_size

   !> Write all that a run must remember.
   subroutine save_run(run, row)
      type(run_t), intent(in) :: run        !! the run
      real(wp), intent(inout) :: row(:)     !! (numbers) its memory [any]

      integer :: place

      place = 0
      call run%loaded%method%save(row, place)
      call run%loaded%system%save(row, place)
   end subroutine save_run

   !> Take it back into a run that has just begun, and bring the search for instants to where the motion is.
   subroutine load_run(run, row)
      type(run_t), intent(inout) :: run     !! a fresh run
      real(wp), intent(in) :: row(:)        !! (numbers) memory [any]

      type(smooth_piece_t) :: piece
      integer :: place

      place = 0
      call run%loaded%method%load(row, place)
      call run%loaded%system%load(row, place)
      do while (run%instants%next%at < run%loaded%system%linkage%piece%end)
         call run%instants%pass(piece)
      end do
   end subroutine load_run

end module test_restart_instants
