!> Wear over many cycles by jumps between simulated cycles, with control of their error.
!>
!> The volumes x of all cells follow dx/dN = v(x), v what simulated cycles take per cycle. With v_n(x) the rates of a profile
!> under the loads of simulation n (`held_loads`) a jump over J cycles from x_n is
!>
!> predictor   dx*/ds = v_n(x*) + s (v_n(x_n) - v_(n-1)(x_n))/J_(n-1),   of the first jump  dx*/ds = v_n(x*)
!> corrector   dx/ds  = (1 - s/J) v_n(x) + s/J v_(n+1)(x),   v_(n+1) under the loads of a simulation with x*
!>
!> in sub-jumps (`held_jump`). With an ensemble all predictors are that of the first jump: the difference of two rates that
!> scatter says little. A jump costs one simulation; the method is of second order. Its local error follows from the difference,
!>
!> e = -(x_(n+1) - x*)/(3 (1 + J_(n-1)/J)),   of the first jump the difference from x* itself.
!>
!> A jump is accepted if e, as depth, is for each surface at most
!>
!> g (tolerance + depth_tolerance/(h + g)),   g what the jump adds to the maximum depth h,
!>
!> wherever the depth exceeds h/2 (at the ends of an arc, which move, cells are worn in part, and their errors have both signs), and
!> if J |v_(n+1)(x*) - v_n(x*)|/2, on average over the surface, is at most a tenth of what the jump adds; else it is made again with
!> fewer cycles. So the depth at the end has about the relative error `tolerance`, and in any case some `depth_tolerance`.
!> What the scatter between starts explains of both (two standard errors) is not counted: shorter jumps would not reduce it. A jump
!> over the measured cycles is always accepted: it is the simulation.
!> Volumes are sums of rates, so that nothing is lost. Within a sub-jump rates are linear in N.
!>
!> Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), section III.5.
!> Signs: rates are not negative. Limits: rates depend on the profile only, not on the number of the cycle.
module life_jumps
   use errors, only: error_t, exit_integration, set_error
   use kinds, only: wp
   use life_ends, only: approach, find_end, is_beyond, part_done
   use held_jump, only: follow, mean_of, path_t
   use held_loads, only: held_t, new_held
   use life_errors, only: beyond_scatter, error_ratio, measure_errors, settling_errors
   use life_results, only: life_plan_t, life_t, node_t
   use rate_source, only: rate_source_t
   use text, only: to_text
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: find_life

   real(wp), parameter :: first_part = 0.02_wp      !! what the first jump adds, of the maximum depth at the start [1]
   real(wp), parameter :: longest_growth = 5.0_wp   !! of a jump over the one before [1]
   real(wp), parameter :: shortest_part = 0.2_wp, careful = 0.9_wp   !! of a jump made again; of one that would just do [1]
   real(wp), parameter :: no_error = 1.0e-6_wp      !! part of what is allowed that limits no jump [1]

   !> Where the life is.
   type :: march_t
      real(wp) :: cycles = 0.0_wp                   !! cycles so far [1]
      real(wp), allocatable :: x(:)                 !! (n) volumes and distances [m^3, m]
      real(wp), allocatable :: place(:)             !! (n) those for which the loads were found [m^3, m]
      type(held_t) :: now                           !! loads and rates there
      real(wp), allocatable :: rates(:, :)          !! (n, starts) under these loads, of x, per cycle [m^3, m]
      real(wp), allocatable :: values(:)            !! (conditions) extremes of channels [any]
      type(held_t) :: before                        !! loads at the start of the last jump
      real(wp) :: sub_jump = huge(1.0_wp)           !! last sub-jump [1]
      real(wp) :: last = 0.0_wp                     !! cycles of the last jump, 0: none [1]
      real(wp), allocatable :: sums(:, :)           !! (n, starts) what each start would have taken so far [m^3, m]
      real(wp), allocatable :: error(:)             !! (n) sum of the local errors [m^3, m]
   end type march_t

   !> A jump that was tried.
   type :: trial_t
      real(wp), allocatable :: place(:)             !! (n) the predictor [m^3, m]
      type(held_t) :: held                          !! loads and rates there
      type(path_t) :: path                          !! the profiles of the corrector
      real(wp), allocatable :: values(:)            !! (conditions) extremes of channels there [any]
      real(wp), allocatable :: rates(:, :)          !! (n, starts) at the end of the jump, under the loads there [m^3, m]
      real(wp), allocatable :: local(:, :)          !! (n, starts) local errors [m^3, m]
      real(wp) :: ratio = 0.0_wp                    !! maximum error over what is allowed [1]
   end type trial_t

contains

   !> Follow the profiles to the end of the life, and beyond where the spread of k needs it.
   subroutine find_life(plan, surfaces, source, life, error)
      type(life_plan_t), intent(in) :: plan              !! what is asked
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) at the start
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      type(life_t), intent(out) :: life                  !! what came of it; with an error, what was reached
      type(error_t), allocatable, intent(out) :: error   !! a simulation failed

      type(march_t) :: march
      type(trial_t) :: trial
      real(wp) :: jump, allowed

      call begin(plan, surfaces, source, life, march, error)
      if (allocated(error)) return
      allowed = first_jump(life, march)
      do while (.not. is_over(life, march))
         jump = bounded(life, march, allowed)
         do
            call try_jump(life, march, source, jump, trial, error)
            if (allocated(error)) exit
            if (trial%ratio <= 1.0_wp) exit
            if (jump <= plan%measured*(1.0_wp + epsilon(jump))) then
               if (trial%ratio >= huge(1.0_wp)) call set_error(error, exit_integration, "held loads have no equilibrium after "// &
                                                               to_text(march%cycles)//" cycles")
               exit
            end if
            life%rejected = life%rejected + 1
            jump = max(jump*factor(trial%ratio, march%last > 0.0_wp, plan%starts), real(plan%measured, wp))
         end do
         if (allocated(error)) exit
         allowed = jump*factor(trial%ratio, march%last > 0.0_wp, plan%starts)
         call take_jump(life, march, jump, trial)
         call source%show(part_done(life, march%cycles, march%x))
      end do
      if (life%last == 0) life%last = life%n
      if (.not. allocated(error)) call settling_errors(life, source, march%place, march%now%rates, error)
   end subroutine find_life

   !> The start, and the rates there.
   subroutine begin(plan, surfaces, source, life, march, error)
      type(life_plan_t), intent(in) :: plan              !! what is asked
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) at the start
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      type(life_t), intent(inout) :: life                !! its first node is set
      type(march_t), intent(out) :: march                !! where it starts
      type(error_t), allocatable, intent(out) :: error   !! the simulation failed

      real(wp), allocatable :: loads(:, :)

      life%plan = plan
      life%reason = ""
      allocate (life%nodes(64))
      call life%state%start(surfaces)
      associate (n => life%state%n)
         march%x = life%state%numbers(surfaces)
         march%place = march%x
         allocate (march%rates(n, plan%starts), march%sums(n, plan%starts), march%error(n), source=0.0_wp)
         allocate (loads(plan%n_loads, plan%starts))
         allocate (march%values(size(plan%ends%extremes)), source=0.0_wp)
      end associate
      call source%find(surfaces, 1, 1, march%rates, march%values, loads, error)
      if (allocated(error)) return
      call new_held(life%state, march%x, march%rates, loads, march%now)
      march%rates = march%now%rates
      life%simulated = 1
      call add_node(life, march)
      if (is_beyond(life, march%x, march%values)) call find_end(life, march%x, march%values)
   end subroutine begin

   !> Whether nothing more is asked; where nothing wears there is no end but one of cycles.
   logical function is_over(life, march)
      type(life_t), intent(inout) :: life     !! the life; its reason is set where nothing wears
      type(march_t), intent(in) :: march      !! where it is

      if (life%last > 0) then
         is_over = .not. life%ends_by_cycles
         if (life%ends_by_cycles) is_over = march%cycles >= life%plan%ends%cycles*life%plan%stretch*(1.0_wp - 1.0e-12_wp)
         return
      end if
      is_over = life%plan%ends%cycles >= huge(1.0_wp) .and. .not. any(march%rates(:life%state%n - size(life%state%surfaces), :) &
                                                                      > 0.0_wp)
      if (is_over) life%reason = "nothing wears in the measured cycles"
   end function is_over

   !> Cycles of the first jump: what they add to the depth is small, or within what is accepted.
   real(wp) function first_jump(life, march) result(jump)
      type(life_t), intent(in) :: life       !! the life
      type(march_t), intent(in) :: march     !! its start

      real(wp) :: rate

      rate = depth_of(life, march%x, mean_of(march%rates))
      jump = huge(1.0_wp)
      if (rate > 0.0_wp) jump = max(first_part*life%state%max_depth(march%x), life%plan%depth_tolerance)/rate
   end function first_jump

   !> Maximum depth that a change of the volumes makes.
   real(wp) function depth_of(life, x, change) result(depth)
      type(life_t), intent(in) :: life       !! the life
      real(wp), intent(in) :: x(:)           !! (n) where [m^3, m]
      real(wp), intent(in) :: change(:)      !! (n) the change [m^3, m]

      real(wp), allocatable :: depths(:)
      integer :: k

      depth = 0.0_wp
      do k = 1, size(life%state%surfaces)
         allocate (depths(size(life%state%surfaces(k)%volume)))
         call life%state%smooth_depths(k, x, change, depths)
         depth = max(depth, maxval(depths))
         deallocate (depths)
      end do
   end function depth_of

   !> A jump within what is left to the limits; the measured cycles at least.
   real(wp) function bounded(life, march, allowed) result(jump)
      type(life_t), intent(in) :: life       !! the life
      type(march_t), intent(in) :: march     !! where it is
      real(wp), intent(in) :: allowed        !! cycles that the error allows [1]

      real(wp) :: left

      jump = max(allowed, real(life%plan%measured, wp))
      if (life%last == 0) jump = min(jump, max(approach(life, march%x, mean_of(march%rates)), real(life%plan%measured, wp)))
      if (life%plan%ends%cycles >= huge(1.0_wp)) return
      left = life%plan%ends%cycles*merge(1.0_wp, life%plan%stretch, life%last == 0) - march%cycles
      if (jump < left) jump = min(jump, max(0.5_wp*left, real(life%plan%measured, wp)))
      jump = min(jump, left)
   end function bounded

   !> Factor for the next jump, or for the same once more.
   pure real(wp) function factor(ratio, has_history, starts)
      real(wp), intent(in) :: ratio              !! error over what is allowed [1]
      logical, intent(in) :: has_history         !! the error over what is added falls as J^2, else as J
      integer, intent(in) :: starts              !! of the ensemble; rates that scatter say little of much longer jumps

      factor = merge(longest_growth, huge(1.0_wp), starts > 1)
      if (ratio <= no_error) return
      factor = max(shortest_part, min(longest_growth, careful*ratio**merge(-0.5_wp, -1.0_wp, has_history)))
   end function factor

   !> Try a jump.
   subroutine try_jump(life, march, source, jump, trial, error)
      type(life_t), intent(inout) :: life                !! the life; counts the simulation
      type(march_t), intent(inout) :: march              !! where it is; its loads remember where pins are
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      real(wp), intent(in) :: jump                       !! cycles [1]
      type(trial_t), intent(inout) :: trial              !! what came of it
      type(error_t), allocatable, intent(out) :: error   !! the simulation failed

      real(wp), allocatable :: change(:, :), loads(:, :), rates(:, :)
      logical :: is_good

      if (life%simulated >= life%plan%simulations) then
         call set_error(error, exit_integration, "the limit of "//to_text(life%plan%simulations)//" simulated profiles is " &
                        //"reached after "//to_text(march%cycles)//" cycles"//new_line("a")//"  = raise tolerance or " &
                        //"simulations in [life]; chaotic motion needs [ensemble] with more runs")
         return
      end if
      call predict(life, march, jump, trial, change, is_good)
      if (.not. is_good) return
      rates = march%rates
      trial%values = march%values
      allocate (loads(life%plan%n_loads, life%plan%starts))
      call source%find(life%state%worn(trial%place), life%simulated + 1, 1, rates, trial%values, loads, error)
      if (allocated(error)) then
         error%message = error%message//new_line("a")//"  = the profile is that after "//to_text(march%cycles + jump)// &
                         " cycles, a jump of "//to_text(jump)
         return
      end if
      life%simulated = life%simulated + 1
      call new_held(life%state, trial%place, rates, loads, trial%held)
      call correct(life, march, jump, trial, change)
   end subroutine try_jump

   !> Predict the profiles at the end of a jump; where pins are not found the jump is to be made with fewer cycles.
   subroutine predict(life, march, jump, trial, change, is_good)
      type(life_t), intent(in) :: life                     !! the life
      type(march_t), intent(inout) :: march                !! where it is
      real(wp), intent(in) :: jump                         !! cycles [1]
      type(trial_t), intent(inout) :: trial                !! place and ratio are set
      real(wp), allocatable, intent(out) :: change(:, :)   !! (n, starts) what the predictor adds, with the drift [m^3, m]
      logical, intent(out) :: is_good                      !! there is a prediction

      real(wp), allocatable :: drift(:, :)

      trial%ratio = huge(1.0_wp)
      trial%path%allowed = march%sub_jump
      drift = 0.0_wp*march%rates
      if (march%last > 0.0_wp) then
         call march%before%at(life%state, march%x, drift, is_good)
         drift = merge((march%rates - drift)/march%last, 0.0_wp, is_good)
      end if
      if (life%plan%starts > 1) then
         call follow(life%state, march%x, jump, tolerance_of(life, march, jump), march%now, trial%path, is_good)
      else
         call follow(life%state, march%x, jump, tolerance_of(life, march, jump), march%now, trial%path, is_good, drift=drift)
      end if
      if (.not. is_good) return
      change = trial%path%sums(:, :, trial%path%n)
      trial%place = march%x + max(mean_of(change), 0.0_wp)
      if (life%plan%starts > 1) change = change + (0.5_wp*jump**2)*drift
   end subroutine predict

   !> The jump under the loads at both of its ends, and its error.
   subroutine correct(life, march, jump, trial, predicted)
      type(life_t), intent(in) :: life               !! the life
      type(march_t), intent(inout) :: march          !! where it is
      real(wp), intent(in) :: jump                   !! cycles [1]
      type(trial_t), intent(inout) :: trial          !! path, local errors and ratio are set
      real(wp), intent(in) :: predicted(:, :)        !! (n, starts) what the predictor adds [m^3, m]

      real(wp), allocatable :: change(:, :)
      real(wp) :: share
      logical :: is_good

      trial%path%allowed = march%sub_jump
      call follow(life%state, march%x, jump, tolerance_of(life, march, jump), march%now, trial%path, is_good, b=trial%held)
      if (.not. is_good) return
      change = trial%path%sums(:, :, trial%path%n)
      share = 1.0_wp
      if (march%last > 0.0_wp) share = -1.0_wp/(3.0_wp*(1.0_wp + march%last/jump))
      trial%local = beyond_scatter(share*(change - predicted))
      trial%rates = trial%held%rates
      call march%now%at(life%state, trial%place, trial%rates, is_good)
      if (.not. is_good) return
      trial%ratio = error_ratio(life, march%x, mean_of(change), trial%local, 0.5_wp*jump*(trial%held%rates - trial%rates))
      call trial%held%at(life%state, march%x + mean_of(change), trial%rates, is_good)
      if (.not. is_good) trial%ratio = huge(1.0_wp)
   end subroutine correct

   !> Tolerance of a jump, over what it adds.
   real(wp) function tolerance_of(life, march, jump) result(tolerance)
      type(life_t), intent(in) :: life       !! the life
      type(march_t), intent(in) :: march     !! where it is
      real(wp), intent(in) :: jump           !! cycles [1]

      tolerance = life%state%max_depth(march%x) + depth_of(life, march%x, jump*mean_of(march%rates))
      tolerance = life%plan%tolerance + life%plan%depth_tolerance/max(tolerance, tiny(1.0_wp))
   end function tolerance_of

   !> Take a jump, sub-jump by sub-jump; a limit that it crosses ends the life there.
   subroutine take_jump(life, march, jump, trial)
      type(life_t), intent(inout) :: life       !! the life
      type(march_t), intent(inout) :: march     !! where it is
      real(wp), intent(in) :: jump              !! cycles [1]
      type(trial_t), intent(in) :: trial        !! the jump

      type(march_t) :: start
      real(wp), allocatable :: before(:), values(:)
      real(wp) :: cycles
      integer :: k

      start = march
      march%before = start%now
      march%now = trial%held
      march%last = jump
      march%rates = trial%rates
      march%place = trial%place
      march%sub_jump = trial%path%allowed
      do k = 1, trial%path%n
         associate (path => trial%path, node => life%nodes(life%n))
            node%jump = path%cycles(k) - path%cycles(k - 1)
            before = mean_of(path%sums(:, :, k) - path%sums(:, :, k - 1))
            node%rates = reshape([path%slope(:, k - 1), 2.0_wp*before/node%jump - path%slope(:, k - 1)], [size(before), 2])
            cycles = node%jump
            values = start%values + (path%cycles(k)/jump)*(trial%values - start%values)
            if (life%last == 0) call find_end(life, march%x, values, cycles)
            call advance(life, start, jump, k, cycles/node%jump, trial, march)
         end associate
         call add_node(life, march)
         if (life%last > 0 .or. life%reason == "") cycle
         life%last = life%n
         if (.not. life%ends_by_cycles) return
      end do
      march%values = trial%values
   end subroutine take_jump

   !> Go a part of a sub-jump, within which volumes are quadratic in the cycles.
   subroutine advance(life, start, jump, k, part, trial, march)
      type(life_t), intent(in) :: life          !! the life; its last node is the start of the sub-jump
      type(march_t), intent(in) :: start        !! where the jump starts
      real(wp), intent(in) :: jump              !! cycles of the whole jump [1]
      integer, intent(in) :: k                  !! number of the sub-jump
      real(wp), intent(in) :: part              !! of it, 1: all [1]
      type(trial_t), intent(in) :: trial        !! the jump
      type(march_t), intent(inout) :: march     !! at the start of the sub-jump; cycles, x, sums, error and values are set

      real(wp) :: share

      associate (path => trial%path, node => life%nodes(life%n))
         share = (path%cycles(k - 1) + part*node%jump)/jump
         if (part >= 1.0_wp) then
            march%x = start%x + mean_of(path%sums(:, :, k))
         else
            march%x = march%x + part*node%jump*(node%rates(:, 1) + 0.5_wp*part*(node%rates(:, 2) - node%rates(:, 1)))
         end if
         march%sums = start%sums + path%sums(:, :, k - 1) + part*(path%sums(:, :, k) - path%sums(:, :, k - 1))
      end associate
      march%error = start%error + share**3*mean_of(trial%local)
      march%values = start%values + share*(trial%values - start%values)
      march%cycles = start%cycles + share*jump
   end subroutine advance

   !> Append a node with its errors.
   subroutine add_node(life, march)
      type(life_t), intent(inout) :: life       !! the life
      type(march_t), intent(in) :: march        !! where it is

      type(node_t), allocatable :: longer(:)

      if (life%n == size(life%nodes)) then
         allocate (longer(2*life%n))
         longer(:life%n) = life%nodes
         call move_alloc(longer, life%nodes)
      end if
      life%n = life%n + 1
      associate (node => life%nodes(life%n))
         node%cycles = march%cycles
         node%x = march%x
         node%values = march%values
         call measure_errors(life%state, march%x, march%error, march%sums, node)
      end associate
   end subroutine add_node

end module life_jumps
