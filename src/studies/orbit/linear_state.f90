!> The state about which a mechanism is linearised: a static equilibrium, a steady motion, or an instant of the motion.
!>
!> All bodies keep all their coordinates there, and what would stabilise constraints is off. A steady motion has
!>
!> $$ D^T M (\dot V - \omega \times V) = 0 $$
!>
!> with V the speeds of the start, in axes that turn with a body those of the bodies turning with it, both as near as the rows
!> allow in the metric of the masses. Newton's iteration with the matrix of `linear_model` finds it from the start of the deck.
!> Source: Meirovitch, Methods of Analytical Dynamics (1970), section 6.8 (steady motions). Limits: the one near the start.
module linear_state
   use assembly_report, only: assembly_t
   use build_system, only: new_system
   use catalogue, only: catalogue_t
   use errors, only: error_t, exit_assembly, set_error
   use integration_settings, only: chosen
   use item, only: place_of
   use jobs, only: job_t
   use kinds, only: wp
   use lapack, only: dgelsd
   use linear_model, only: linearise
   use mechanism, only: mechanism_t
   use modes_results, only: at_equilibrium, at_time, linear_model_t, modes_input_t, modes_plan_t
   use motion, only: cross
   use motion_frame, only: motion_frame_t
   use mover, only: mover_t
   use prescribed_motion, only: newton_t, solve_rates
   use scene, only: analysis_static, scene_t
   use sensitivity_motion, only: setting_of
   use start_state, only: find_start
   use state_slopes, only: slopes_t
   use static, only: equilibrium_t, find_equilibrium
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: find_state, linear_state_t

   real(wp), parameter :: found = 1.0e-12_wp      !! residual of a steady motion that is none [1]
   real(wp), parameter :: good = 1.0e-8_wp        !! residual that is allowed where no step makes it less [1]
   real(wp), parameter :: longest = 0.3_wp        !! step of Newton's iteration, in sizes of the bodies or radians [1]
   integer, parameter :: most = 50                !! its steps
   integer, parameter :: most_halvings = 8        !! of a step
   integer, parameter :: n_round = 3              !! rounds of positions and free speeds
   real(wp), parameter :: edge = 1.0e-6_wp        !! penetration or gap of a contact at its edge, of the clearance [1]

   !> The state. It must be a target, as a mover.
   type :: linear_state_t
      type(mover_t) :: mover                         !! for its system, with the contacts in their states
      real(wp) :: t = 0.0_wp                         !! time [s]
      real(wp), allocatable :: y(:)                  !! (n) state [any]
      character(:), allocatable :: words             !! what it is
      type(text_t), allocatable :: warnings(:)       !! (n) what was noticed
   end type linear_state_t

contains

   !> Find the state that the plan asks for.
   subroutine find_state(job, plan, state, error)
      type(job_t), intent(in) :: job                         !! the deck
      type(modes_plan_t), intent(in) :: plan                 !! what is asked for
      type(linear_state_t), target, intent(inout) :: state   !! new
      type(error_t), allocatable, intent(out) :: error       !! there is none

      type(job_t) :: all

      all = job
      all%scene%settings%integration%is_reduced = .false.
      call all%scene%settings%integration%stabilisation%take(chosen)
      allocate (state%warnings(0))
      associate (system => state%mover%system)
         if (plan%at == at_time) then
            call move_to(all, plan%time, state, error)
         else
            all%scene%analysis = analysis_static
            call new_system(all%scene, all%levels, system)
            if (plan%at == at_equilibrium .or. system%clearance_joints%has_films) then
               call rest_at(all%scene, system, state, error)
            else
               call start_at(all, system, state, error)
            end if
         end if
         if (allocated(error)) return
         system%traits%with_quadratures = .false.
         call system%linkage%solution%set_gains(0.0_wp, 0.0_wp)
         if (plan%at /= at_time) then
            call system%begin_pace(state%t, state%y, max(job%plan%end, 1.0_wp))
            call system%decide_slips(state%t, state%y, .true.)
         end if
         if (plan%at /= at_equilibrium .and. plan%at /= at_time) call find_steady(system, plan, state, error)
      end associate
      if (.not. allocated(error)) call note_edges(state)
   end subroutine find_state

   !> An instant of the motion.
   subroutine move_to(job, time, state, error)
      type(job_t), intent(inout) :: job                      !! the deck
      real(wp), intent(in) :: time                           !! the instant [s]
      type(linear_state_t), target, intent(inout) :: state   !! state and words are set
      type(error_t), allocatable, intent(out) :: error       !! the motion does not reach it

      real(wp) :: asked

      associate (settings => job%scene%settings%integration, mover => state%mover)
         asked = settings%controls%tolerance
         if (settings%controls%fixed_step > 0.0_wp) asked = settings%controls%fixed_step
         call mover%start(job, setting_of(settings), asked, max(time, job%plan%end), error)
         if (.not. allocated(error) .and. time > 0.0_wp) call mover%advance(time, error)
         if (allocated(error)) return
         state%t = mover%method%t
         state%y = mover%method%step%y1
         state%words = "the motion at t = "//real_text(state%t, 6)//" s"
      end associate
   end subroutine move_to

   !> The static equilibrium; where films act the drivers turn.
   subroutine rest_at(scene, system, state, error)
      type(scene_t), intent(inout) :: scene                  !! the scene; no whirl is searched
      type(mechanism_t), intent(inout) :: system             !! its system
      type(linear_state_t), intent(inout) :: state           !! state and words are set
      type(error_t), allocatable, intent(out) :: error       !! there is none

      type(assembly_t) :: report
      type(equilibrium_t) :: equilibrium
      type(newton_t) :: newton
      real(wp), allocatable :: accelerations(:), q(:), v(:)
      integer :: k, outcome

      scene%settings%static%values(place_of(scene%settings%static%item_t, "whirl_search"))%number = 0.0_wp
      call system%linkage%deck_state(q, v)
      call find_equilibrium(scene, system, q, report, equilibrium, error, in_full=.true.)
      if (allocated(error)) return
      do k = 1, size(system%clearance_joints%sets)
         call system%clearance_joints%sets(k)%set%begin_at_rest()
      end do
      v = 0.0_wp
      if (system%clearance_joints%has_films) then
         accelerations = v
         call solve_rates(system%linkage, 0.0_wp, newton, q, v, accelerations, outcome)
      end if
      allocate (state%y(system%n), source=0.0_wp)
      call system%linkage%take_state(q, v, state%y)
      state%words = trim(merge("the steady state on films", "the static equilibrium   ", system%clearance_joints%has_films)) &
                    //": "//equilibrium%words
      if (equilibrium%warning /= "") call append_text(state%warnings, equilibrium%warning)
   end subroutine rest_at

   !> Where the deck starts, from which a steady motion is searched.
   subroutine start_at(job, system, state, error)
      type(job_t), intent(in) :: job                         !! the deck
      type(mechanism_t), intent(inout) :: system             !! its system
      type(linear_state_t), intent(inout) :: state           !! the state is set
      type(error_t), allocatable, intent(out) :: error       !! it cannot be assembled

      type(assembly_t) :: report

      call find_start(job%scene, job%levels, system, state%y, report, error)
   end subroutine start_at

   !> Newton's iteration for a steady motion: positions, then, in axes at rest, the free speeds, and again.
   subroutine find_steady(system, plan, state, error)
      type(mechanism_t), intent(inout) :: system             !! the system
      type(modes_plan_t), intent(in) :: plan                 !! for the axes
      type(linear_state_t), intent(inout) :: state           !! start, then the steady motion
      type(error_t), allocatable, intent(out) :: error       !! none was found

      type(linear_model_t) :: model
      real(wp), allocatable :: start(:)
      real(wp) :: omega(3)
      integer :: round, status

      start = state%y
      call system%linkage%set_motion(0.0_wp, start)
      omega = system%linkage%motion%omega(:, plan%axes)
      do round = 1, n_round
         call balance_positions(system, plan%axes, omega, start, state%y, model, status)
         if (status /= 0 .or. plan%axes > 0 .or. round == n_round) exit
         call still_rates(system, model, state%y, start, status)
         if (status /= 0) exit
      end do
      state%words = "a steady motion"
      if (status /= 0) then
         call set_error(error, exit_assembly, "no steady motion was found: the equations cannot be solved near the start")
      else if (model%residual > good) then
         call set_error(error, exit_assembly, "no steady motion was found: loads of "//real_text(model%residual, 2) &
                        //" of the forces that act are not balanced, allowed "//real_text(good, 2)//new_line("a") &
                        //"  = start nearer to it, let the motion settle (at = time), or name the body that turns (axes)")
      end if
   end subroutine find_steady

   !> Positions at which no free acceleration is left.
   subroutine balance_positions(system, axes, omega, start, y, model, status)
      type(mechanism_t), intent(inout) :: system             !! the system
      integer, intent(in) :: axes                            !! body that turns, 0: none
      real(wp), intent(in) :: omega(3)                       !! (3) its speed [rad/s]
      real(wp), intent(in) :: start(:)                       !! (n) state with the speeds of the start [any]
      real(wp), intent(inout) :: y(:)                        !! (n) where it starts, then the balance [any]
      type(linear_model_t), intent(out) :: model             !! matrices there
      integer, intent(out) :: status                         !! 0: done

      type(linear_model_t) :: next
      real(wp) :: part, trial(size(y))
      integer :: halving, k

      call correct_rates(system, start, axes, omega, y, status)
      if (status == 0) call linearise_here(y, model, status)
      steps: do k = 1, most
         if (status /= 0 .or. model%residual <= found) exit
         part = 1.0_wp
         do halving = 1, most_halvings
            call step_along(system, model, part, trial, y, status)
            if (status == 0) call correct_rates(system, start, axes, omega, trial, status)
            if (status == 0) call linearise_here(trial, next, status)
            if (status == 0) then
               if (norm2(next%rest) < norm2(model%rest)) exit
            end if
            part = 0.5_wp*part
            status = 0
         end do
         if (halving > most_halvings) exit steps
         y = trial
         model = next
      end do steps

   contains

      !> Matrices at a state, without inputs and outputs.
      subroutine linearise_here(at, here, outcome)
         real(wp), intent(in) :: at(:)                     !! (n) the state [any]
         type(linear_model_t), intent(out) :: here         !! its matrices
         integer, intent(out) :: outcome                   !! 0: done

         type(catalogue_t) :: nothing
         type(modes_input_t) :: none(0)

         call linearise(system, 0.0_wp, at, axes, none, [integer ::], nothing, here, outcome)
      end subroutine linearise_here

   end subroutine balance_positions

   !> Change the free speeds of the start so that the motion takes the mechanism to no other free accelerations: what springs hold
   !> stands still, what turns freely turns on.
   subroutine still_rates(system, model, y, start, status)
      type(mechanism_t), intent(inout) :: system             !! the system
      type(linear_model_t), intent(in) :: model              !! matrices at the state
      real(wp), intent(in) :: y(:)                           !! (n) the state [any]
      real(wp), intent(inout) :: start(:)                    !! (n) speeds of the start, changed [any]
      integer, intent(out) :: status                         !! 0: done

      type(catalogue_t) :: nothing
      type(motion_frame_t) :: frame
      type(slopes_t) :: slopes
      real(wp), dimension(size(y)) :: acceleration, change, speed
      real(wp) :: none(0), outputs(0), slope(system%n - system%n_quadrature - system%traits%n_turning), u(model%n_free)
      real(wp) :: others(size(slope) - 2*system%linkage%n_rate)

      status = 0
      if (model%n_free == 0) return
      call frame%find(system, 0.0_wp, y, [integer ::], 0, status)
      if (status /= 0) return
      call slopes%begin(system, 0.0_wp, y, [integer ::])
      change = 0.0_wp
      call slopes%evaluate(system, nothing, y, change, none, status)
      if (status /= 0) return
      associate (n => frame%n_rate, m => system%n - system%n_quadrature)
         call system%to_local(y, change(:m), acceleration(:size(slope)))
         call system%to_local(y, y(:m), speed(:size(slope)))
         others = 0.0_wp
         call slopes%along(system, nothing, frame, speed(n + 1:2*n), acceleration(n + 1:2*n), others, slope, outputs, status)
         if (status /= 0) return
         call system%linkage%set_motion(0.0_wp, y)
         u = matmul(slope(n + 1:2*n) + frame%turned(system, acceleration(n + 1:2*n)), frame%reading)
         call solve_stiffness(model, u, status)
         if (status /= 0) return
         call frame%to_state(system, y, 0.0_wp*speed(:n), matmul(frame%direction(:, :frame%n_free), u), change)
      end associate
      start = start + change
   end subroutine still_rates

   !> Solve A21 x = -b with the minimum x.
   subroutine solve_stiffness(model, b, status)
      type(linear_model_t), intent(in) :: model         !! the matrices
      real(wp), intent(inout) :: b(:)                   !! (freedoms) b, then x [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp), parameter :: same = 1.0e-10_wp          ! singular values that are none, of the maximum one [1]
      real(wp) :: a(model%n_free, model%n_free), s(model%n_free), x(model%n_free, 1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n, rank

      n = model%n_free
      a = model%a(n + 1:2*n, :n)
      x(:, 1) = -b
      allocate (work(1000 + 100*n + 2*n*n), source=0.0_wp)
      allocate (iwork(100 + 60*n), source=0)
      call dgelsd(n, n, 1, a, n, x, n, s, same, rank, work, size(work), iwork, status)
      b = x(:, 1)
   end subroutine solve_stiffness

   !> A step of Newton's iteration: A21 x = -rest with the minimum x, no longer than allowed, brought onto the constraints.
   subroutine step_along(system, model, part, y, from, status)
      type(mechanism_t), intent(inout) :: system        !! the system
      type(linear_model_t), intent(in) :: model         !! the matrices where the step starts
      real(wp), intent(in) :: part                      !! of the step [1]
      real(wp), intent(out) :: y(:)                     !! (n) its end [any]
      real(wp), intent(in) :: from(:)                   !! (n) its start [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp) :: change(size(from)), size_of, x(model%n_free)
      real(wp), allocatable :: local(:)

      status = merge(1, 0, model%n_free == 0)
      if (status /= 0) return
      x = model%rest
      call solve_stiffness(model, x, status)
      if (status /= 0) return
      associate (linkage => system%linkage, m => system%n - system%n_quadrature)
         allocate (local(m), source=0.0_wp)
         local(:linkage%n_rate) = matmul(model%direction, x)
         size_of = maxval(abs(local(:linkage%n_rate))/linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n))
         local = local*part*min(1.0_wp, longest/max(size_of, tiny(1.0_wp)))
         change = 0.0_wp
         call system%from_local(from, local(:m - system%traits%n_turning), change(:m))
         y = from + change
         call system%project_state(0.0_wp, y, status)
      end associate
   end subroutine step_along

   !> Give a state the speeds of a steady motion.
   subroutine correct_rates(system, start, axes, omega, y, status)
      type(mechanism_t), intent(inout) :: system        !! the system
      real(wp), intent(in) :: start(:)                  !! (n) state with the speeds of the start [any]
      integer, intent(in) :: axes                       !! body that turns, 0: none
      real(wp), intent(in) :: omega(3)                  !! (3) its speed [rad/s]
      real(wp), intent(inout) :: y(:)                   !! (n) positions; the rates are set [any]
      integer, intent(out) :: status                    !! 0: done

      integer :: body, k

      associate (linkage => system%linkage, coordinates => system%linkage%coordinates, nq => system%linkage%n_position)
         y(nq + 1:nq + linkage%n_rate) = start(nq + 1:nq + linkage%n_rate)
         if (axes > 0) then
            call linkage%set_motion(0.0_wp, y)
            associate (motion => linkage%motion, n_v => linkage%coordinates%n_v)
               do k = 1, linkage%rows%n_unknown
                  body = linkage%rows%unknown(k)
                  if (body /= axes) motion%v(:, body) = motion%v(:, axes) &
                                                        + cross(omega, motion%r(:, body) - motion%r(:, axes))
                  motion%omega(:, body) = omega
                  call read_rates(body, y(nq + n_v*(k - 1) + 1:nq + n_v*k))
               end do
            end associate
         end if
      end associate
      call system%project_state(0.0_wp, y, status)

   contains

      !> Rates of a body from the motion.
      subroutine read_rates(of_body, v)
         integer, intent(in) :: of_body          !! the body
         real(wp), intent(out) :: v(:)           !! (n_v) its rates [any]

         real(wp) :: q(system%linkage%coordinates%n_q)

         if (allocated(system%linkage%motion%spatial%spin)) then
            system%linkage%motion%spatial%spin(:, of_body) = matmul(omega, system%linkage%motion%rot(:, :, of_body))
         end if
         call system%linkage%coordinates%read_motion(system%linkage%motion, of_body, q, v)
      end subroutine read_rates

   end subroutine correct_rates

   !> Warn of contacts that are at the edge of contact: derivatives there are the mean of both sides.
   subroutine note_edges(state)
      type(linear_state_t), intent(inout) :: state      !! the state; warnings are added

      real(wp), dimension(state%mover%system%clearance_joints%n_contact) :: delta, rate
      integer :: i, k

      associate (system => state%mover%system)
         call system%linkage%set_motion(state%t, state%y)
         do k = 1, size(system%clearance_joints%sets)
            associate (set => system%clearance_joints%sets(k)%set)
               call set%gaps(system%linkage%motion, delta, rate)
               do i = 1, set%n_contact
                  associate (item => set%item_of(i))
                     if (abs(delta(set%before%contacts + i)) > edge*abs(set%items%pairs(item)%clearance)) cycle
                     call append_text(state%warnings, "joint '"//set%names(item)%s//"' is at the edge of contact: its stiffness " &
                                      //"is one-sided, and "//trim(merge("the mean of both sides", "none                  ", &
                                                                          set%contact(i)%is_touching))//" is taken")
                  end associate
               end do
            end associate
         end do
      end associate
   end subroutine note_edges

end module linear_state
