!> Jumps of a life against rate laws with known solutions: order, error estimate, ends, a moving edge, scatter between starts.
module test_life
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use life_ends, only: rate_of_end
   use life_jumps, only: find_life
   use life_results, only: life_plan_t, life_t
   use life_spread, only: measures_at
   use life_state, only: measure_arc, measure_depth, measure_volume
   use rate_source, only: rate_source_t
   use wear_arc, only: half_angles
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: run_test_life

   real(wp), parameter :: radius = 10.0e-3_wp, shaft = 9.5e-3_wp, length = 15.0e-3_wp   ! [m]
   real(wp), parameter :: per_cycle = 6.0e-15_wp   ! volume per cycle of new surfaces [m^3]

   !> dV/dN = a (1 + noise)/(1 + V/V_0) in each of all cells of the bearing.
   type, extends(rate_source_t) :: slowing_t
      real(wp) :: first = per_cycle          !! sum of a over the cells [m^3]
      real(wp) :: half_volume = huge(1.0_wp) !! V_0 of all cells [m^3]
      real(wp) :: noise = 0.0_wp             !! amplitude of the scatter between starts [1]
      real(wp) :: transient = 0.0_wp         !! part that vanishes with twice the settling [1]
      integer :: fails_at = huge(0)          !! number of the request that fails
      type(random_t) :: random               !! of the scatter
   contains
      procedure :: find => find_slowing
   end type slowing_t

   !> A shaft in a bush that conforms to it: cells lose what the arc of the shaft takes as it sinks.
   type, extends(rate_source_t) :: bush_t
   contains
      procedure :: find => find_bush
   end type bush_t

contains

   !> Register the tests.
   subroutine run_test_life(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_and_estimate", test_order)
      call suite%test("constant_rates", test_constant)
      call suite%test("ends", test_ends)
      call suite%test("bush_with_a_moving_edge", test_bush)
      call suite%test("scatter_between_starts", test_scatter)
      call suite%test("settling", test_settling)
      call suite%test("failed_simulation", test_failure)
   end subroutine run_test_life

   !> Rates of the first law.
   subroutine find_slowing(self, surfaces, number, settling, rates, values, loads, error)
      class(slowing_t), intent(inout) :: self            !! the law
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (2) bearing and journal
      integer, intent(in) :: number                      !! of the request
      integer, intent(in) :: settling                    !! settling cycles, as a multiple of those of the plan
      real(wp), intent(out) :: rates(:, :)               !! (n, starts) volumes and distances per cycle [m^3, m]
      real(wp), intent(out) :: values(:)                 !! (conditions) the rate over that of new surfaces [1]
      real(wp), intent(out) :: loads(:, :)               !! (0, starts) none are known
      type(error_t), allocatable, intent(out) :: error   !! the request that fails

      real(wp) :: rate
      integer :: k

      loads = 0.0_wp
      call check_true(error, number < self%fails_at, "simulation failed")
      associate (n => size(surfaces(1)%volume))
         rate = self%first/(1.0_wp + sum(surfaces(1)%volume)/self%half_volume)
         if (settling == 1) rate = rate*(1.0_wp + self%transient)
         rates = 0.0_wp
         do k = 1, size(rates, 2)
            rates(:n, k) = rate/n*(1.0_wp + self%random%between(-self%noise, self%noise))
         end do
         rates(size(rates, 1) - 1:, :) = 2.0_wp*pi*shaft
         values = 1.0_wp/(1.0_wp + sum(surfaces(1)%volume)/self%half_volume)
      end associate
   end subroutine find_slowing

   !> Rates of the second law: V_i(e) of the section of a circle of the shaft's radius, e by the total volume.
   subroutine find_bush(self, surfaces, number, settling, rates, values, loads, error)
      class(bush_t), intent(inout) :: self               !! the law
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (2) bearing and journal
      integer, intent(in) :: number                      !! of the request
      integer, intent(in) :: settling                    !! settling cycles, as a multiple of those of the plan
      real(wp), intent(out) :: rates(:, :)               !! (n, starts) volumes and distances per cycle [m^3, m]
      real(wp), intent(out) :: values(:)                 !! (0) no conditions
      real(wp), intent(out) :: loads(:, :)               !! (0, starts) none are known
      type(error_t), allocatable, intent(out) :: error   !! never set

      real(wp), parameter :: small = 1.0e-5_wp
      real(wp) :: left, middle, right, step(size(surfaces(1)%volume))
      integer :: k

      loads = 0.0_wp
      left = 0.0_wp
      right = 1.0e-3_wp
      do k = 1, 100
         middle = 0.5_wp*(left + right)
         if (bush_volume(middle) < sum(surfaces(1)%volume)) then
            left = middle
         else
            right = middle
         end if
      end do
      step = bush_cells((1.0_wp + small)*middle, size(step)) - bush_cells(middle, size(step))
      rates = 0.0_wp
      rates(:size(step), :) = spread(per_cycle*step/sum(step), 2, size(rates, 2))
      values = 0.0_wp
   end subroutine find_bush

   !> Volume of a bush that a shaft has worn to a depth, in closed form.
   pure real(wp) function bush_volume(e) result(volume)
      real(wp), intent(in) :: e   !! depth [m]

      real(wp) :: a, b

      associate (angles => half_angles(radius, shaft, radius - shaft + e))
         b = angles(1)
         a = angles(2)
      end associate
      volume = length*(shaft**2*(a - sin(a)*cos(a)) - radius**2*(b - sin(b)*cos(b)))
   end function bush_volume

   !> Volumes of its cells, the direction of the load in the middle of them all.
   pure function bush_cells(e, n) result(cells)
      real(wp), intent(in) :: e      !! depth [m]
      integer, intent(in) :: n       !! cells
      real(wp) :: cells(n)           !! (n) [m^3]

      integer, parameter :: parts = 40
      real(wp) :: d, theta, reach
      integer :: i, k

      d = radius - shaft + e
      cells = 0.0_wp
      do i = 1, n
         do k = 1, parts
            theta = 2.0_wp*pi*(i - 1 + (k - 0.5_wp)/parts)/n - pi
            if (cos(theta) <= 0.0_wp) cycle
            reach = d*cos(theta) + sqrt(shaft**2 - (d*sin(theta))**2)
            cells(i) = cells(i) + length*pi/(n*parts)*max(reach**2 - radius**2, 0.0_wp)
         end do
      end do
   end function bush_cells

   !> Bearing and journal, new, or the bearing worn to a depth.
   function new_surfaces(n, e) result(surfaces)
      integer, intent(in) :: n                 !! cells
      real(wp), intent(in), optional :: e      !! depth [m]
      type(worn_surface_t) :: surfaces(2)      !! both

      surfaces(1)%joint = "pin"
      surfaces(2)%joint = "pin"
      surfaces(1)%side = "bearing"
      surfaces(2)%side = "journal"
      surfaces%is_hole = [.true., .false.]
      surfaces%length = length
      surfaces%distance = 0.0_wp
      surfaces(1)%radius = radius
      surfaces(2)%radius = shaft
      allocate (surfaces(1)%volume(n), surfaces(2)%volume(n), source=0.0_wp)
      if (present(e)) surfaces(1)%volume = bush_cells(e, n)
   end function new_surfaces

   !> A plan without ends.
   function plan_of(tolerance, starts) result(plan)
      real(wp), intent(in) :: tolerance               !! of depth [1]
      integer, intent(in), optional :: starts         !! of the ensemble
      type(life_plan_t) :: plan                       !! the plan

      plan%tolerance = tolerance
      plan%cycle = 2.0_wp
      if (present(starts)) plan%starts = starts
      allocate (plan%clearances(1), source=radius - shaft)
      allocate (plan%spreads(2), source=1.0_wp)
      allocate (plan%ends%extremes(0))
   end function plan_of

   !> Second order: errors fall as the tolerance does, jumps grow as its root; the estimate bounds the error.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: cycles = 1.0e8_wp
      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law
      real(wp) :: exact, errors(3), halves(3)
      integer :: jumps(3), k

      law%half_volume = 2.0e-8_wp
      exact = law%half_volume*(sqrt(1.0_wp + 2.0_wp*law%first*cycles/law%half_volume) - 1.0_wp)
      do k = 1, 3
         plan = plan_of(1.0e-2_wp/16.0_wp**(k - 1))
         plan%depth_tolerance = 1.0e-14_wp
         plan%ends%cycles = cycles
         call find_life(plan, new_surfaces(8), law, life, error)
         if (allocated(error)) return
         call check_close(error, life%nodes(life%last)%cycles, cycles, 1.0e-6_wp, "cycles at the end")
         if (allocated(error)) return
         errors(k) = abs(life%nodes(life%last)%measures(measure_volume, 1)/exact - 1.0_wp)
         associate (half => life%nodes(life%last)%half())
            halves(k) = half(measure_volume, 1)/exact
         end associate
         jumps(k) = life%last - 1
      end do
      call check_true(error, all(errors < halves) .and. all(halves < 10.0_wp*errors), "estimate bounds the error")
      if (allocated(error)) return
      call check_true(error, errors(1) < 1.0e-2_wp .and. errors(3) < 1.0e-2_wp/256.0_wp, "error within the tolerance")
      if (allocated(error)) return
      associate (order => -log(errors(1:2)/errors(2:3))/log(real(jumps(1:2), wp)/jumps(2:3)))
         call check_true(error, all(order > 1.8_wp), "second order in the number of jumps")
      end associate
   end subroutine test_order

   !> Constant rates: few jumps, exact volumes, conservation; where nothing wears the life jumps to its end, or says so.
   subroutine test_constant(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law

      plan = plan_of(1.0e-4_wp)
      plan%ends%cycles = 1.0e9_wp
      call find_life(plan, new_surfaces(12), law, life, error)
      if (allocated(error)) return
      call check_true(error, life%simulated <= 6 .and. life%rejected == 0, "a jump to the end")
      if (allocated(error)) return
      call check_close(error, life%nodes(life%last)%measures(measure_volume, 1), per_cycle*1.0e9_wp, 1.0e-12_wp, "volume", .true.)
      if (allocated(error)) return
      call check_close(error, life%nodes(life%last)%x(size(life%nodes(1)%x)), 2.0_wp*pi*shaft*1.0e9_wp, 1.0e-12_wp, "distance", &
                       .true.)
      if (allocated(error)) return
      law%first = 0.0_wp
      call find_life(plan, new_surfaces(12), law, life, error)
      if (allocated(error)) return
      call check_true(error, life%nodes(life%last)%cycles >= 1.0e9_wp .and. life%simulated <= 4, "nothing wears: to the end")
      if (allocated(error)) return
      plan = plan_of(1.0e-4_wp)
      plan%ends%depth = 1.0e-4_wp
      call find_life(plan, new_surfaces(12), law, life, error)
      if (allocated(error)) return
      call check_equal(error, life%reason, "nothing wears in the measured cycles", "no end by depth")
   end subroutine test_constant

   !> Depth, clearance and a condition end a life where they are reached; the profiles at other cycles follow.
   subroutine test_ends(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: depth = 2.0e-5_wp, volume = 0.5_wp*length*2.0_wp*pi*((radius + depth)**2 - radius**2)
      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law
      real(wp) :: exact, half, rate, measures(3, 2)
      integer :: k

      law%half_volume = 4.0e-9_wp
      exact = (0.5_wp*volume**2/law%half_volume + volume)/law%first
      do k = 1, 3
         plan = plan_of(1.0e-4_wp)
         if (k == 1) plan%ends%depth = depth
         if (k == 2) plan%ends%clearance = depth + radius - shaft
         if (k == 3) then
            deallocate (plan%ends%extremes)
            allocate (plan%ends%extremes(1))
            plan%ends%extremes(1)%words = "rate < limit"
            plan%ends%extremes(1)%is_above = .false.
            plan%ends%extremes(1)%limit = 1.0_wp/(1.0_wp + volume/law%half_volume)
         end if
         call find_life(plan, new_surfaces(8), law, life, error)
         if (allocated(error)) return
         call check_close(error, life%nodes(life%last)%cycles, exact, 1.0e-3_wp, "cycles at the end", .true.)
         if (allocated(error)) return
         call check_true(error, .not. life%ends_by_cycles .and. life%reason /= "", "reason of the end")
         if (allocated(error)) return
         if (k == 3) cycle
         call rate_of_end(life, rate, half)
         call check_true(error, abs(life%nodes(life%last)%cycles - exact) < half/rate, "interval of the cycles")
         if (allocated(error)) return
      end do
      measures = measures_at(life, 0.25_wp*exact)
      exact = law%half_volume*(sqrt(1.0_wp + 0.5_wp*law%first*exact/law%half_volume) - 1.0_wp)
      call check_close(error, measures(measure_volume, 1), exact, 1.0e-3_wp, "volume at a quarter of the life", .true.)
   end subroutine test_ends

   !> A shaft that sinks into a bush: time, volume and arc from 10 um to 100 um of depth by default settings.
   subroutine test_bush(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: from = 1.0e-5_wp, to = 1.0e-4_wp
      type(bush_t) :: law
      type(life_plan_t) :: plan
      type(life_t) :: life

      plan = plan_of(2.0e-4_wp)
      plan%ends%depth = to
      call find_life(plan, new_surfaces(360, from), law, life, error)
      if (allocated(error)) return
      associate (node => life%nodes(life%last), angles => half_angles(radius, shaft, radius - shaft + to))
         call check_close(error, node%cycles, (bush_volume(to) - bush_volume(from))/per_cycle, 1.0e-3_wp, "cycles", .true.)
         if (allocated(error)) return
         call check_close(error, node%measures(measure_volume, 1), bush_volume(to), 1.0e-3_wp, "volume", .true.)
         if (allocated(error)) return
         call check_close(error, node%measures(measure_arc, 1), 2.0_wp*angles(1), 0.035_wp, "arc to a cell on each side")
         if (allocated(error)) return
         call check_close(error, sum(node%x(:360)), sum(bush_cells(from, 360)) + node%cycles*per_cycle, 1.0e-12_wp, &
                          "conservation of volume", .true.)
      end associate
   end subroutine test_bush

   !> Starts that scatter by a tenth: the interval holds the mean, and jumps do not shrink to nothing.
   subroutine test_scatter(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: cycles = 1.0e8_wp
      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law
      real(wp) :: exact
      integer :: k, held

      law%half_volume = 2.0e-7_wp
      law%noise = 0.1_wp
      law%random%state = 11
      exact = law%half_volume*(sqrt(1.0_wp + 2.0_wp*law%first*cycles/law%half_volume) - 1.0_wp)
      held = 0
      do k = 1, 40
         plan = plan_of(1.0e-4_wp, starts=8)
         plan%ends%cycles = cycles
         call find_life(plan, new_surfaces(8), law, life, error)
         if (allocated(error)) return
         call check_true(error, life%simulated < 60, "number of profiles")
         if (allocated(error)) return
         associate (node => life%nodes(life%last), half => life%nodes(life%last)%by_starts)
            if (abs(node%measures(measure_volume, 1) - exact) < half(measure_volume, 1)) held = held + 1
            call check_true(error, half(measure_volume, 1) < 0.1_wp*exact, "width of the interval")
            if (allocated(error)) return
         end associate
      end do
      call check_true(error, held >= 34, "the interval by starts holds the mean in 85 % of lives at least")
   end subroutine test_scatter

   !> A transient that the settling cycles leave is in the interval.
   subroutine test_settling(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law

      law%transient = 0.03_wp
      plan = plan_of(1.0e-4_wp)
      plan%ends%cycles = 1.0e8_wp
      call find_life(plan, new_surfaces(8), law, life, error)
      if (allocated(error)) return
      associate (half => life%nodes(life%last)%by_settling)
         call check_close(error, half(measure_volume, 1), 0.03_wp*per_cycle*1.0e8_wp, 1.0e-9_wp, "error by settling", .true.)
      end associate
   end subroutine test_settling

   !> A simulation that fails: the error names the profile, and what was reached is kept.
   subroutine test_failure(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: failure
      type(life_plan_t) :: plan
      type(life_t) :: life
      type(slowing_t) :: law

      law%half_volume = 2.0e-8_wp
      law%fails_at = 6
      plan = plan_of(1.0e-4_wp)
      plan%ends%cycles = 1.0e8_wp
      call find_life(plan, new_surfaces(8), law, life, failure)
      call check_true(error, allocated(failure), "the failure is reported")
      if (allocated(error)) return
      call check_true(error, index(failure%message, "the profile is that after") > 0, "the profile is named")
      if (allocated(error)) return
      call check_true(error, life%n >= 3 .and. life%nodes(life%n)%measures(measure_depth, 1) > 0.0_wp, "what was reached is kept")
   end subroutine test_failure

end module test_life
