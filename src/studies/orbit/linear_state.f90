!> The state about which a mechanism is linearised: a static equilibrium, a steady motion, or an instant of the motion.
!>
!> All bodies keep all their coordinates there, and what would stabilise constraints is off. Limits: those of the analyses.
module linear_state
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use errors, only: error_t, exit_assembly, exit_usage, set_error
   use integration_settings, only: chosen
   use item, only: place_of
   use jobs, only: copy_job, job_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use modes_results, only: at_equilibrium, at_time, modes_plan_t
   use mover, only: mover_t
   use prescribed_motion, only: newton_t, solve_rates
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_static, scene_t
   use sensitivity_motion, only: setting_of
   use start_state, only: find_start
   use state_equations, only: refuse_sampled
   use static, only: equilibrium_t, find_equilibrium
   use steady_motion, only: find_steady
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: find_state, linear_state_t

   real(wp), parameter :: lost = 1.0e-3_wp        !! residual of an equilibrium where bodies have gone far, of the forces [1]
   real(wp), parameter :: far = 1.0e6_wp          !! how far, of the size of the bodies [1]
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

      call refuse_sampled(job%scene%states, error)
      if (allocated(error)) return
      call copy_job(job, all)
      all%scene%settings%integration%is_reduced = .false.
      call all%scene%settings%integration%stabilisation%take(chosen)
      allocate (state%warnings(0))
      associate (system => state%mover%system)
         if (plan%at == at_time .and. .not. all%scene%settings%has_analysis(analysis_dynamic)) then
            call set_error(error, exit_usage, "at = time needs [analysis.dynamic]")
         else if (plan%at == at_time) then
            all%scene%analysis = analysis_dynamic
            if (job%scene%analysis == analysis_kinematic) all%levels = levels_as_written
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
         if (plan%at /= at_equilibrium .and. plan%at /= at_time) call find_steady(system, plan%axes, state%y, state%words, error)
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
         call mover%start(job, setting_of(settings), asked, max(time, merge(job%plan%end, 1.0_wp, job%plan%end > 0.0_wp)), error)
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
      if (maxval(abs(system%linkage%motion%r)) > far*system%linkage%scales%length &
          .and. equilibrium%residual > lost*equilibrium%acting) then
         call set_error(error, exit_assembly, "no static equilibrium was found: loads of "// &
                        real_text(equilibrium%residual/equilibrium%acting, 2)//" of the forces that act are not balanced" &
                        //new_line("a")//"  = "//equilibrium%warning)
         return
      end if
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
      call system%begin_states(state%y, error)
      if (allocated(error)) return
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
