!> Wear over many cycles by jumps between simulated cycles, with control of their error.
!>
!> The volumes x of all cells follow dx/dN = v(x), v what simulated cycles take per cycle. A jump over J cycles from x_n is
!>
!> predictor   x* = x_n + J v_n + J^2 (v_n - v_(n-1))/(2 J_(n-1)),   of the first jump  x* = x_n + J v_n
!> corrector   x_(n+1) = x_n + J (v_n + v(x*))/2
!>
!> With an ensemble all predictors are that of the first jump: the difference of two rates that scatter says little. The rates v(x*)
!> are those of the next start, so that a jump costs one simulation. The method is of second order (the first jump is Heun's). Its
!> local error follows from the difference of the corrector and the first predictor,
!>
!> e = -(x_(n+1) - x*)/(3 (1 + J_(n-1)/J)),   of the first jump the difference from x* itself.
!>
!> A jump is accepted if e, as depth, is for each surface at most
!>
!> g (tolerance + depth_tolerance/(h + g)),   g what the jump adds to the maximum depth h,
!>
!> wherever the depth exceeds h/2 (at the ends of an arc, which move, cells are worn in part, and their errors have both signs), and
!> if J |v(x*) - v_n|/2, on average over the surface, is at most a tenth of what the jump adds on average; else it is made again
!> with fewer cycles. So the depth at the end has about the relative error `tolerance`, and in any case some `depth_tolerance`.
!> What the scatter between starts explains of both (two standard errors) is not counted: shorter jumps would not reduce it. A jump
!> over the measured cycles is always accepted: it is the simulation.
!> Volumes are sums of rates, so that nothing is lost: the volume is what all cycles take, by the trapezoidal rule.
!>
!> Within a jump rates are linear in N. Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd
!> ed. (1993), section III.5. Signs: rates are not negative; a predictor that would be below its start is bounded by it. Limits:
!> rates depend on the profile only, not on the number of the cycle.
module life_jumps
   use errors, only: error_t, exit_integration, set_error
   use kinds, only: wp
   use life_ends, only: approach, find_end, is_beyond
   use life_errors, only: measure_errors, settling_errors
   use life_results, only: life_plan_t, life_t, node_t
   use rate_source, only: rate_source_t
   use text, only: to_text
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: find_life

   real(wp), parameter :: first_part = 0.02_wp      !! what the first jump adds, of the maximum depth at the start [1]
   real(wp), parameter :: longest_growth = 10.0_wp  !! of a jump over the one before [1]
   real(wp), parameter :: shortest_part = 0.2_wp    !! of a jump that is made again [1]
   real(wp), parameter :: careful = 0.9_wp          !! part of the jump that would just be accepted [1]
   real(wp), parameter :: no_error = 1.0e-6_wp      !! part of what is allowed that limits no jump [1]
   real(wp), parameter :: explained = 2.0_wp        !! standard errors of an error that scatter explains [1]
   real(wp), parameter :: deep = 0.5_wp             !! part of the maximum depth above which errors of cells count [1]
   real(wp), parameter :: most_change = 0.1_wp      !! mean of J |v(x*) - v_n|/2 over that of what the jump adds, at most [1]

   !> Where the life is.
   type :: march_t
      real(wp) :: cycles = 0.0_wp                   !! cycles so far [1]
      real(wp), allocatable :: x(:)                 !! (n) volumes and distances [m^3, m]
      real(wp), allocatable :: place(:)             !! (n) those for which the rates were found [m^3, m]
      real(wp), allocatable :: rates(:, :)          !! (n, starts) per cycle [m^3, m]
      real(wp), allocatable :: values(:)            !! (conditions) extremes of channels [any]
      real(wp), allocatable :: before(:, :)         !! (n, starts) rates at the start of the last jump [m^3, m]
      real(wp) :: last = 0.0_wp                     !! cycles of the last jump, 0: none [1]
      real(wp), allocatable :: sums(:, :)           !! (n, starts) what each start would have taken so far [m^3, m]
      real(wp), allocatable :: error(:)             !! (n) sum of the local errors [m^3, m]
   end type march_t

   !> A jump that was tried.
   type :: trial_t
      real(wp), allocatable :: place(:)             !! (n) the predictor [m^3, m]
      real(wp), allocatable :: rates(:, :)          !! (n, starts) rates there [m^3, m]
      real(wp), allocatable :: values(:)            !! (conditions) extremes of channels there [any]
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
      real(wp) :: jump, wish

      call begin(plan, surfaces, source, life, march, error)
      if (allocated(error)) return
      wish = first_jump(life, march)
      do while (.not. is_over(life, march))
         jump = bounded(life, march, wish)
         do
            call try_jump(life, march, source, jump, trial, error)
            if (allocated(error)) exit
            if (trial%ratio <= 1.0_wp .or. jump <= plan%measured*(1.0_wp + epsilon(jump))) exit
            life%rejected = life%rejected + 1
            jump = max(jump*factor(trial%ratio, march%last > 0.0_wp), real(plan%measured, wp))
         end do
         if (allocated(error)) exit
         wish = jump*factor(trial%ratio, march%last > 0.0_wp)
         call take_jump(life, march, jump, trial)
         call source%show(part_done(life, march))
      end do
      if (life%last == 0) life%last = life%n
      if (.not. allocated(error)) call settling_errors(life, source, march%place, march%rates, error)
   end subroutine find_life

   !> The start, and the rates there.
   subroutine begin(plan, surfaces, source, life, march, error)
      type(life_plan_t), intent(in) :: plan              !! what is asked
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) at the start
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      type(life_t), intent(inout) :: life                !! its first node is set
      type(march_t), intent(out) :: march                !! where it starts
      type(error_t), allocatable, intent(out) :: error   !! the simulation failed

      life%plan = plan
      life%reason = ""
      allocate (life%nodes(64))
      call life%state%start(surfaces)
      associate (n => life%state%n)
         march%x = life%state%numbers(surfaces)
         march%place = march%x
         allocate (march%rates(n, plan%starts), march%before(n, plan%starts), march%sums(n, plan%starts), march%error(n), &
                   source=0.0_wp)
         allocate (march%values(size(plan%ends%extremes)), source=0.0_wp)
      end associate
      call source%find(surfaces, 1, 1, march%rates, march%values, error)
      if (allocated(error)) return
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
   real(wp) function bounded(life, march, wish) result(jump)
      type(life_t), intent(in) :: life       !! the life
      type(march_t), intent(in) :: march     !! where it is
      real(wp), intent(in) :: wish           !! cycles that the error allows [1]

      real(wp) :: left

      jump = max(wish, real(life%plan%measured, wp))
      if (life%last == 0) jump = min(jump, max(approach(life, march%x, mean_of(march%rates)), real(life%plan%measured, wp)))
      if (life%plan%ends%cycles >= huge(1.0_wp)) return
      left = life%plan%ends%cycles*merge(1.0_wp, life%plan%stretch, life%last == 0) - march%cycles
      if (jump < left) jump = min(jump, max(0.5_wp*left, real(life%plan%measured, wp)))
      jump = min(jump, left)
   end function bounded

   !> Factor for the next jump, or for the same once more.
   pure real(wp) function factor(ratio, has_history)
      real(wp), intent(in) :: ratio              !! error over what is allowed [1]
      logical, intent(in) :: has_history         !! the error over what is added falls as J^2, else as J

      factor = huge(1.0_wp)
      if (ratio <= no_error) return
      factor = max(shortest_part, min(longest_growth, careful*ratio**merge(-0.5_wp, -1.0_wp, has_history)))
   end function factor

   !> Try a jump.
   subroutine try_jump(life, march, source, jump, trial, error)
      type(life_t), intent(inout) :: life                !! the life; counts the simulation
      type(march_t), intent(in) :: march                 !! where it is
      class(rate_source_t), intent(inout) :: source      !! what gives the rates
      real(wp), intent(in) :: jump                       !! cycles [1]
      type(trial_t), intent(inout) :: trial              !! what came of it
      type(error_t), allocatable, intent(out) :: error   !! the simulation failed

      real(wp), allocatable :: change(:, :)
      real(wp) :: share

      if (life%simulated >= life%plan%simulations) then
         call set_error(error, exit_integration, "the limit of "//to_text(life%plan%simulations)//" simulated profiles is " &
                        //"reached after "//to_text(march%cycles)//" cycles"//new_line("a")//"  = raise tolerance or " &
                        //"simulations in [life]; chaotic motion needs [ensemble] with more runs")
         return
      end if
      change = jump*march%rates
      if (march%last > 0.0_wp) change = change + (0.5_wp*jump**2/march%last)*(march%rates - march%before)
      trial%place = march%x + max(mean_of(change), 0.0_wp)
      if (life%plan%starts > 1) trial%place = march%x + jump*mean_of(march%rates)
      trial%rates = march%rates
      trial%values = march%values
      call source%find(life%state%worn(trial%place), life%simulated + 1, 1, trial%rates, trial%values, error)
      if (allocated(error)) then
         error%message = error%message//new_line("a")//"  = the profile is that after "//to_text(march%cycles + jump)// &
                         " cycles, a jump of "//to_text(jump)
         return
      end if
      life%simulated = life%simulated + 1
      share = 1.0_wp
      if (march%last > 0.0_wp) share = -1.0_wp/(3.0_wp*(1.0_wp + march%last/jump))
      trial%local = share*(0.5_wp*jump*(march%rates + trial%rates) - change)
      change = 0.5_wp*jump*(trial%rates - march%rates)
      trial%ratio = error_ratio(life, march%x, 0.5_wp*jump*(mean_of(march%rates) + mean_of(trial%rates)), trial%local, change)
   end subroutine try_jump

   !> Maximum over the surfaces of the error of depth, and of the change of the rates, over what is allowed. The change falls as J,
   !> the error over what is added as J^2: the square of the first stands beside the second.
   real(wp) function error_ratio(life, x, gain, local, change) result(ratio)
      type(life_t), intent(in) :: life       !! the life
      real(wp), intent(in) :: x(:)           !! (n) where the jump starts [m^3, m]
      real(wp), intent(in) :: gain(:)        !! (n) what it adds [m^3, m]
      real(wp), intent(in) :: local(:, :)    !! (n, starts) its local errors [m^3, m]
      real(wp), intent(in) :: change(:, :)   !! (n, starts) what the change of the rates makes [m^3, m]

      type(worn_surface_t), allocatable :: surfaces(:)
      real(wp), allocatable :: added(:), errors(:)
      real(wp) :: most
      integer :: k

      ratio = 0.0_wp
      surfaces = life%state%worn(x)
      do k = 1, size(surfaces)
         allocate (added(size(surfaces(k)%volume)))
         call life%state%smooth_depths(k, x + gain, gain, added)
         most = maxval(added)
         if (most > 0.0_wp) then
            associate (depths => surfaces(k)%depths() + added)
               errors = merge(unexplained(life, k, x + gain, local), 0.0_wp, depths > deep*maxval(depths))
               ratio = max(ratio, maxval(errors)/(most*(life%plan%tolerance + life%plan%depth_tolerance/maxval(depths))))
            end associate
            errors = unexplained(life, k, x + gain, change)
            ratio = max(ratio, (sum(errors)/(most_change*sum(added)))**2)
         end if
         deallocate (added)
      end do
   end function error_ratio

   !> Depths of a change of a surface, less what the scatter between starts explains.
   function unexplained(life, k, x, change) result(errors)
      type(life_t), intent(in) :: life       !! the life
      integer, intent(in) :: k               !! number of the surface
      real(wp), intent(in) :: x(:)           !! (n) where [m^3, m]
      real(wp), intent(in) :: change(:, :)   !! (n, starts) the change [m^3, m]

      real(wp) :: errors(size(life%state%surfaces(k)%volume))   !! (cells) magnitudes [m]

      real(wp) :: depths(size(errors), size(change, 2)), scatter(size(errors))
      integer :: m

      do m = 1, size(change, 2)
         call life%state%smooth_depths(k, x, change(:, m), depths(:, m))
      end do
      scatter = 0.0_wp
      associate (n => size(change, 2))
         if (n > 1) scatter = sqrt(sum((depths - spread(mean_of(depths), 2, n))**2, dim=2)/(n*(n - 1.0_wp)))
      end associate
      errors = max(abs(mean_of(depths)) - explained*scatter, 0.0_wp)
   end function unexplained

   !> Take a jump; a limit that it crosses ends the life there.
   subroutine take_jump(life, march, jump, trial)
      type(life_t), intent(inout) :: life       !! the life
      type(march_t), intent(inout) :: march     !! where it is
      real(wp), intent(in) :: jump              !! cycles [1]
      type(trial_t), intent(in) :: trial        !! the jump

      type(march_t) :: part
      real(wp) :: cycles

      associate (node => life%nodes(life%n))
         node%jump = jump
         node%rates = reshape([mean_of(march%rates), mean_of(trial%rates)], [size(march%x), 2])
         cycles = jump
         if (life%last == 0) call find_end(life, march%x, trial%values, cycles)
      end associate
      if (life%last == 0 .and. life%reason /= "" .and. .not. life%ends_by_cycles) then
         part = march
         call advance(part, jump, cycles, trial)
         call add_node(life, part)
         life%last = life%n
      end if
      call advance(march, jump, jump, trial)
      march%last = jump
      march%before = march%rates
      march%rates = trial%rates
      march%values = trial%values
      march%place = trial%place
      if (life%last > 0 .and. .not. life%ends_by_cycles) return
      call add_node(life, march)
      if (life%last == 0 .and. life%reason /= "") life%last = life%n
   end subroutine take_jump

   !> Go a part of a jump.
   subroutine advance(march, jump, cycles, trial)
      type(march_t), intent(inout) :: march     !! where it is
      real(wp), intent(in) :: jump              !! cycles of the whole jump [1]
      real(wp), intent(in) :: cycles            !! cycles of the part [1]
      type(trial_t), intent(in) :: trial        !! the jump

      real(wp), allocatable :: change(:, :)

      change = cycles*march%rates + (0.5_wp*cycles**2/jump)*(trial%rates - march%rates)
      march%sums = march%sums + change
      march%x = march%x + mean_of(change)
      march%error = march%error + (cycles/jump)**3*mean_of(trial%local)
      march%values = march%values + (cycles/jump)*(trial%values - march%values)
      march%cycles = march%cycles + cycles
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

   !> How far the life is, by the nearest limit.
   real(wp) function part_done(life, march)
      type(life_t), intent(in) :: life          !! the life
      type(march_t), intent(in) :: march        !! where it is

      associate (ends => life%plan%ends)
         part_done = max(march%cycles/(ends%cycles*life%plan%stretch), life%state%max_depth(march%x)/ends%depth)
         if (ends%clearance < huge(1.0_wp)) then
            part_done = max(part_done, maxval(life%state%added_clearance(march%x)/(ends%clearance - life%plan%clearances)))
         end if
      end associate
   end function part_done

   !> Mean over the starts.
   pure function mean_of(list) result(mean)
      real(wp), intent(in) :: list(:, :)        !! (n, starts) one of each start [any]
      real(wp) :: mean(size(list, 1))           !! (n) their mean [any]

      mean = sum(list, dim=2)/size(list, 2)
   end function mean_of

end module life_jumps
