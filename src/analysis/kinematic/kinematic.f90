!> Kinematic analysis: positions, velocities and accelerations that joints and drivers determine, and the
!> driving and reaction forces by inverse dynamics, at every output instant.
!>
!> From instant to instant the positions are predicted, q + h v + h^2/2 a, and corrected by Newton's iteration.
!> A step in which a body would turn by more than 0.3 rad, or in which the correction turns one by more
!> than 0.05 rad, is divided, so that the mechanism stays on its branch. When no step however small gets on,
!> a driver has met a dead centre (or jumps), and the run ends there.
!>
!> Where a driver or a load jumps or bends between two output instants, the values of both sides count among the extremes.
!>
!> Source: Flores et al. (2008), section 2.4, figure 2.5. Limits: all joints ideal; no integrated works.
module kinematic
   use catalogue, only: catalogue_t
   use channel_peaks, only: channel_peaks_t, tell_between
   use cpu_budget, only: cpu_budget_t
   use errors, only: error_t, exit_integration, set_error
   use output_times, only: output_times_t
   use kinds, only: i8, not_a_number, wp
   use kinematic_report, only: report_motion
   use linkage, only: linkage_t
   use mobility, only: find_mobility, mobility_t, stiffest_driver
   use mechanism_energy, only: energy_of, energy_t
   use mechanism_catalogue, only: build_catalogue
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, not_finite_rows, open_rows, singular, solve_positions, solve_rates, solved
   use recorder, only: recorder_t, status_complete, status_failed, status_stopped, summary_t
   use row_corrections, only: evaluate_rows
   use saved_run, only: action_stop
   use text, only: append_text, real_text
   use shaky, only: dead_centre_line
   use step_follower, only: find_off_branch, follow_motion, must_follow
   use time_plan, only: instant, last_instant, time_plan_t
   implicit none (type, external)
   private
   public :: run_kinematic

   real(wp), parameter :: longest_turn = 0.3_wp        !! predicted turn of a body in one step [rad]
   real(wp), parameter :: longest_correction = 0.05_wp !! turn by which a prediction may be wrong [rad]
   real(wp), parameter :: min_step = 1.0e-9_wp       !! shortest step, of the output interval [1]
   integer(i8), parameter :: progress_every = 64_i8    !! instants between two reports of progress

   !> The motion at one instant.
   type :: state_t
      real(wp) :: t = 0.0_wp            !! time [s]
      real(wp), allocatable :: q(:)     !! (n_q bodies) positions [any]
      real(wp), allocatable :: v(:)     !! (n_v bodies) velocities [m/s or rad/s]
      real(wp), allocatable :: a(:)     !! (n_v bodies) accelerations [m/s^2 or rad/s^2]
   end type state_t

contains

   !> Run from assembled positions at t = 0 to the end.
   subroutine run_kinematic(system, q, plan, newton, limit_cpu, recorder, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system, all joints ideal
      real(wp), intent(in) :: q(:)                        !! (n_q bodies) positions at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      type(newton_t), intent(inout) :: newton             !! controls
      real(wp), intent(in) :: limit_cpu                   !! processor time allowed, 0: no limit [s]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(summary_t), intent(out) :: summary             !! cost and errors
      type(error_t), allocatable, intent(out) :: error    !! a dead centre, or a file could not be written

      type(catalogue_t) :: catalogue
      type(cpu_budget_t) :: budget
      type(error_t), allocatable :: late_error
      real(wp) :: cpu_0, cpu_1
      integer(i8) :: clock_0, clock_1, ticks

      call system_clock(clock_0, ticks)
      call build_catalogue(system, catalogue)
      summary%method%integrator = "newton"
      summary%method%solver = "lapack (singular values)"
      summary%method%tolerance = newton%tolerance
      summary%quality%has_ledger = .false.
      summary%quality%energy_residual_max = not_a_number()
      allocate (summary%warnings(0))
      if (size(system%linkage%ideal) > 0) then
         call append_text(summary%warnings, "a kinematic analysis treats joints with clearance as ideal")
      end if
      call recorder%start(catalogue, error)
      call cpu_time(cpu_0)
      call budget%begin(limit_cpu)
      if (.not. allocated(error)) call follow(system, q, plan, newton, budget, recorder, catalogue, summary, error)
      call cpu_time(cpu_1)
      call system_clock(clock_1)
      summary%cpu_seconds = cpu_1 - cpu_0
      summary%wall_seconds = real(clock_1 - clock_0, wp)/real(ticks, wp)
      summary%count%factorisations = newton%n_solved
      if (.not. allocated(summary%status)) then
         summary%status = status_complete
         if (allocated(error)) summary%status = status_failed
      end if
      summary%message = ""
      if (allocated(error)) then
         summary%message = error%message
      end if
      call recorder%finish(summary, late_error)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
   end subroutine run_kinematic

   !> From output instant to output instant.
   subroutine follow(system, q, plan, newton, budget, recorder, catalogue, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: q(:)                        !! (n_q bodies) positions at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      type(newton_t), intent(inout) :: newton             !! controls and cost
      type(cpu_budget_t), intent(inout) :: budget         !! processor time left
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(catalogue_t), intent(inout) :: catalogue       !! what is reported
      type(summary_t), intent(inout) :: summary           !! cost and errors so far
      type(error_t), allocatable, intent(out) :: error    !! a dead centre, or a file could not be written

      type(channel_peaks_t) :: peaks
      type(output_times_t) :: output_times
      type(state_t) :: state
      integer(i8) :: k
      integer :: outcome

      output_times = plan%output_times
      if (output_times%n > 0) call output_times%begin(plan%end, system%linkage%segment)
      if (allocated(recorder%located%place)) call peaks%begin(catalogue, recorder%located%place, recorder%located%from, 0)
      state%q = q
      allocate (state%v(size(system%linkage%mass)), state%a(size(system%linkage%mass)), source=0.0_wp)
      call solve_instant(system, newton, state, outcome)
      if (outcome /= solved) then
         call describe_failure(system, state, 0.0_wp, outcome, newton, error)
         return
      end if
      do k = 0, last_instant(plan)
         do while (output_times%next%at <= min(instant(plan, k), plan%end) .and. output_times%next%at < plan%end)
            call pass_instant(system, state, plan, newton, output_times, peaks, recorder, catalogue, summary, error)
            if (allocated(error)) return
         end do
         call move_to(system, instant(plan, k), min_step*plan%every, newton, state, summary, error)
         if (allocated(error)) return
         call report(system, state, catalogue, summary)
         call recorder%sample(state%t, catalogue, error)
         if (allocated(error)) return
         if (allocated(peaks%place)) call find_extremes(system, state, .true., newton, peaks, recorder, catalogue, summary)
         summary%count%samples = summary%count%samples + 1
         if (mod(k, progress_every) == 0_i8) call recorder%progress(state%t/plan%end)
         if (recorder%requested_action(.false.) == action_stop .and. k < last_instant(plan)) then
            summary%status = status_stopped
            call set_error(error, exit_integration, "stopped by "//trim(recorder%stopped_by)//" at t = "//real_text(state%t, 9)// &
                           " s; the results written so far are readable")
            return
         end if
         if (budget%is_spent() .and. k < last_instant(plan)) then
            call budget%refuse(state%t, error)
            return
         end if
      end do
   end subroutine follow

   !> Pass an instant at which functions of time are not smooth: values before and behind it count among the extremes.
   subroutine pass_instant(system, state, plan, newton, output_times, peaks, recorder, catalogue, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      type(state_t), intent(inout) :: state               !! the motion, moved to the instant
      type(time_plan_t), intent(in) :: plan               !! times
      type(newton_t), intent(inout) :: newton             !! controls and cost
      type(output_times_t), intent(inout) :: output_times         !! the next one is passed
      type(channel_peaks_t), intent(inout) :: peaks       !! start anew
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(catalogue_t), intent(inout) :: catalogue       !! what is reported
      type(summary_t), intent(inout) :: summary           !! cost and errors so far
      type(error_t), allocatable, intent(out) :: error    !! there is no way on

      type(state_t) :: behind
      integer :: outcome

      call move_to(system, output_times%next%at, min_step*plan%every, newton, state, summary, error)
      if (allocated(error)) return
      call tell_side(state)
      call output_times%pass(system%linkage%segment)
      call peaks%forget()
      behind = state
      call try(system, newton, behind, outcome)
      if (outcome /= solved) then
         call describe_failure(system, state, state%t, outcome, newton, error)
         return
      end if
      state = behind
      call tell_side(state)

   contains

      !> Values on one side of the instant.
      subroutine tell_side(side)
         type(state_t), intent(in) :: side   !! the motion there

         if (side%t < plan%first_output) return
         call report(system, side, catalogue, summary)
         call recorder%between(side%t, catalogue)
         if (allocated(peaks%place)) call find_extremes(system, side, .false., newton, peaks, recorder, catalogue, summary)
      end subroutine tell_side

   end subroutine pass_instant

   !> Extremes between an instant and those before, each found by a solution there. The system comes back to the instant.
   subroutine find_extremes(system, state, is_written, newton, peaks, recorder, catalogue, summary)
      type(mechanism_t), intent(inout) :: system      !! the system
      type(state_t), intent(in) :: state                  !! the motion at the instant
      logical, intent(in) :: is_written                   !! the instant is an output instant
      type(newton_t), intent(inout) :: newton             !! controls and cost
      type(channel_peaks_t), intent(inout) :: peaks       !! the instants before, this one is added
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(catalogue_t), intent(inout) :: catalogue       !! values at the instant
      type(summary_t), intent(inout) :: summary           !! maxima are raised

      type(state_t) :: between
      real(wp), parameter :: none(0) = 0.0_wp
      integer :: outcome
      logical :: counts, has_moved, is_there

      call peaks%add_row(state%t, catalogue%values, none, none, is_written)
      has_moved = .false.
      do
         call peaks%ask(between%t, is_there)
         if (.not. is_there) exit
         has_moved = .true.
         between%q = state%q
         between%v = state%v
         between%a = state%a
         associate (h => between%t - state%t)
            call system%linkage%coordinates%add_change(system%linkage%bodies%n, h*(state%v + 0.5_wp*h*state%a), between%q)
         end associate
         call solve_instant(system, newton, between, outcome)
         if (outcome /= solved) exit
         call report(system, between, catalogue, summary)
         call peaks%answer(catalogue%values, catalogue%values(peaks%asked_for()), counts)
         if (counts) call tell_between(between%t, peaks%asked_for(), catalogue, recorder)
      end do
      if (has_moved) call evaluate_rows(system%linkage, state%t, state%q, state%v)
   end subroutine find_extremes

   !> Move to a later time in as many steps as it takes to stay on the branch.
   subroutine move_to(system, t, shortest, newton, state, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system, evaluated at the state
      real(wp), intent(in) :: t                           !! the time [s]
      real(wp), intent(in) :: shortest                    !! step that is given up [s]
      type(newton_t), intent(inout) :: newton             !! controls and cost
      type(state_t), intent(inout) :: state               !! the motion, moved
      type(summary_t), intent(inout) :: summary           !! steps are counted
      type(error_t), allocatable, intent(out) :: error    !! there is no way on

      type(state_t) :: next
      character(:), allocatable :: words
      real(wp) :: h
      integer :: outcome

      h = t - state%t
      do while (state%t < t)
         do while (turn_in(system%linkage, state, h) > longest_turn .and. h > shortest)
            h = 0.5_wp*h
         end do
         next%t = state%t + h
         if (h >= t - state%t) next%t = t
         next%q = state%q
         call system%linkage%coordinates%add_change(system%linkage%bodies%n, h*(state%v + 0.5_wp*h*state%a), next%q)
         next%v = 0.0_wp*state%v
         next%a = state%a
         call try(system, newton, next, outcome)
         if (outcome == solved) then
            state = next
            if (must_follow(system)) call follow_motion(system)
            call find_off_branch(system, words)
            if (allocated(words)) then
               call set_error(error, exit_integration, words//" at t = "//real_text(state%t, 9)//" s")
               return
            end if
            summary%count%steps = summary%count%steps + 1_i8
            summary%time_end = state%t
            h = min(2.0_wp*h, t - state%t)
         else
            summary%count%rejected_steps = summary%count%rejected_steps + 1_i8
            h = 0.5_wp*h
            if (h < shortest) then
               call describe_failure(system, state, next%t, outcome, newton, error)
               return
            end if
         end if
      end do
   end subroutine move_to

   !> Predicted turn of the body that turns most in a step.
   pure real(wp) function turn_in(linkage, state, h) result(turn)
      type(linkage_t), intent(in) :: linkage   !! the bodies
      type(state_t), intent(in) :: state       !! the motion
      real(wp), intent(in) :: h                !! the step [s]

      turn = linkage%coordinates%max_turn(linkage%bodies%n, abs(h*state%v) + abs(0.5_wp*h*h*state%a))
   end function turn_in

   !> Solve a predicted instant; a correction that turns a body by much is not trusted.
   subroutine try(system, newton, next, outcome)
      type(mechanism_t), intent(inout) :: system  !! the system
      type(newton_t), intent(inout) :: newton         !! controls and cost
      type(state_t), intent(inout) :: next            !! predicted, then solved
      integer, intent(out) :: outcome                 !! as of `prescribed_motion`

      real(wp) :: correction(size(next%v)), predicted(size(next%q))

      predicted = next%q
      call solve_instant(system, newton, next, outcome)
      if (outcome /= solved) return
      associate (coordinates => system%linkage%coordinates, n => system%linkage%bodies%n)
         call coordinates%difference(n, predicted, next%q, correction)
         if (coordinates%max_turn(n, correction) > longest_correction) outcome = open_rows
      end associate
   end subroutine try

   !> Positions, velocities and accelerations at the time of a state, from its positions.
   subroutine solve_instant(system, newton, state, outcome)
      type(mechanism_t), intent(inout) :: system  !! the system
      type(newton_t), intent(inout) :: newton         !! controls and cost
      type(state_t), intent(inout) :: state           !! guess, then solved
      integer, intent(out) :: outcome                 !! as of `prescribed_motion`

      call solve_positions(system%linkage, state%t, newton, state%q, outcome)
      if (outcome == solved) call solve_rates(system%linkage, state%t, newton, state%q, state%v, state%a, outcome)
   end subroutine solve_instant

   !> Forces at a solved instant, and all values of the catalogue.
   subroutine report(system, state, catalogue, summary)
      type(mechanism_t), intent(inout) :: system    !! the system, rows evaluated at the state
      type(state_t), intent(in) :: state                !! the motion
      type(catalogue_t), intent(inout) :: catalogue     !! values
      type(summary_t), intent(inout) :: summary         !! maxima are raised

      type(energy_t) :: energy

      call report_motion(system, state%t, state%q, state%v, state%a, catalogue)
      energy = energy_of(system, [state%q, state%v])
      summary%quality%energy_max = max(summary%quality%energy_max, energy%kinetic + energy%elastic)
      summary%quality%violation_max = max(summary%quality%violation_max, maxval(abs(system%linkage%rows%phi)))
      summary%quality%violation_rate_max = max(summary%quality%violation_rate_max, maxval(abs(system%linkage%solution%phi_dot)))
   end subroutine report

   !> Say when, where and why the motion cannot continue, and what to try.
   subroutine describe_failure(system, state, t, outcome, newton, error)
      type(mechanism_t), intent(inout) :: system      !! the system, rows evaluated at the instant that failed
      type(state_t), intent(in) :: state                  !! the last motion found
      real(wp), intent(in) :: t                           !! the instant that failed [s]
      integer, intent(in) :: outcome                      !! how it failed
      type(newton_t), intent(in) :: newton                !! controls
      type(error_t), allocatable, intent(out) :: error    !! the message

      type(mobility_t) :: mobility
      character(:), allocatable :: driver, message
      integer :: row

      row = maxloc(abs(system%linkage%rows%phi)*system%linkage%solution%row_weight, dim=1)
      select case (outcome)
      case (not_finite_rows)
         message = new_line("a")//"  = a driver, or one of its derivatives, is not finite there"
      case (open_rows)
         message = new_line("a")//"  = '"//system%linkage%row_name(row)//"' has a position residual of "// &
                   real_text(abs(system%linkage%rows%phi(row)), 3)//trim(merge(" rad", " m  ", &
                          system%linkage%rows%is_angle(row)))// &
                   " at t = "//real_text(t, 9)//" s: a dead centre, or a jump of a driver"
      case (singular)
         message = new_line("a")//"  = constraint rows are linearly dependent there: a dead centre, or a bifurcation of the motion"
      case default
         message = new_line("a")//"  = no finite velocities and accelerations satisfy all constraints there"
      end select
      call evaluate_rows(system%linkage, state%t, state%q, state%v)
      call find_mobility(system%linkage, mobility)
      driver = system%linkage%row_name(stiffest_driver(mobility))
      call set_error(error, exit_integration, "the mechanism cannot follow driver '"//driver//"' beyond t = "// &
                     real_text(state%t, 9)//" s"//message//dead_centre_line(system%linkage)//new_line("a")// &
                     "  = results up to the last output time are saved; end the run earlier, reverse the driver "// &
                     "earlier, drive another joint, or shift the output times away from the dead centre")
   end subroutine describe_failure

end module kinematic
