!> Wear per cycle of a profile, by a simulation: settling cycles from the start of the deck, whose wear is omitted, then the
!> measured cycles. The rate of a cell is what it lost in these, over their number.
module life_rates
   use build_system, only: levels_as_written
   use extreme_recorder, only: extreme_recorder_t
   use jobs, only: job_t, outcome_t, run_job
   use kinds, only: wp
   use life_results, only: life_plan_t
   use life_state, only: life_state_t
   use output_times, only: new_output_times
   use text, only: real_text
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: simulate, span_t

   integer, parameter :: rows_of_cycle = 64   !! output times of a measured cycle in which channels have extremes [1]

   !> A simulated span.
   type :: span_t
      real(wp) :: from = 0.0_wp    !! start of the measured cycles [s]
      real(wp) :: to = 0.0_wp      !! their end [s]
   end type span_t

contains

   !> Simulate from a start of the ensemble.
   subroutine simulate(job, plan, span, surfaces, start, state, rates, values, loads, reason)
      type(job_t), intent(in) :: job                       !! the scene and its limits
      type(life_plan_t), intent(in) :: plan                !! what is asked of the life
      type(span_t), intent(in) :: span                     !! the measured cycles
      type(worn_surface_t), intent(in) :: surfaces(:)      !! (surfaces) their profiles
      integer, intent(in) :: start                         !! number of the start, 0: that of the deck
      type(life_state_t), intent(in) :: state              !! the surfaces
      real(wp), intent(out) :: rates(:)                    !! (n) volumes and distances per cycle [m^3, m]
      real(wp), intent(out) :: values(:)                   !! (conditions) extremes of their channels [any]
      real(wp), intent(out) :: loads(:)                    !! (n_loads) nodes of the loads per cycle [m, rad, 1, m^3]
      character(:), allocatable, intent(out) :: reason     !! why it failed; blank: it did not

      type(extreme_recorder_t) :: keeper
      type(job_t) :: one
      type(outcome_t) :: outcome
      type(worn_surface_t), allocatable :: worn(:)
      integer :: k

      one = job
      worn = others(job%scene%worn, surfaces)
      one%scene%worn = [surfaces, worn]
      one%levels = levels_as_written
      one%perturbed%start = start
      one%limits%wear_from = span%from
      one%plan%end = span%to
      one%plan%first_output = span%from
      one%plan%every = span%to - span%from
      if (size(values) > 0) one%plan%every = one%plan%every/(rows_of_cycle*plan%measured)
      one%plan%after = 0.0_wp
      one%plan%checkpoint = 0.0_wp
      one%plan%period = 0.0_wp
      one%plan%poincare_samples = [real(wp) ::]
      call new_output_times(one%scene, span%to, .true., one%plan%output_times)
      allocate (keeper%asked(3, size(values)))
      do k = 1, size(values)
         keeper%asked(:, k) = plan%ends%extremes(k)%place
      end do
      keeper%from = span%from
      rates = 0.0_wp
      values = 0.0_wp
      loads = 0.0_wp
      call run_job(one, keeper, outcome)
      reason = outcome%reason
      if (reason == "" .and. outcome%summary%time_end < span%to*(1.0_wp - 1.0e-9_wp)) then
         reason = "a condition of [guards] ended the simulation at "//real_text(outcome%summary%time_end, 6)//" s of "// &
                  real_text(span%to, 6)//" s"
      end if
      if (reason /= "") return
      worn = in_order(outcome%summary%worn, surfaces)
      rates = (state%numbers(worn) - state%numbers(surfaces))/plan%measured
      if (size(loads) > 0) call take_loads(worn, plan%measured, loads)
      do k = 1, size(values)
         values(k) = merge(keeper%maximum(k), keeper%minimum(k), plan%ends%extremes(k)%is_above)
      end do
   end subroutine simulate

   !> Nodes of the loads of all contacts, volumes per cycle; a contact that did not wear has nodes without volumes.
   pure subroutine take_loads(worn, measured, loads)
      type(worn_surface_t), intent(in) :: worn(:)   !! (surfaces) bearing and journal of each contact
      integer, intent(in) :: measured               !! cycles
      real(wp), intent(inout) :: loads(:)           !! (6 nodes contacts) set where something wore [m, rad, 1, m^3]

      real(wp), allocatable :: nodes(:, :)
      integer :: before, k

      do k = 1, size(worn), 2
         nodes = worn(k)%loads
         if (size(nodes) == 0) cycle
         nodes(5:, :) = nodes(5:, :)/measured
         before = size(loads)/(size(worn)/2)*(k/2)
         loads(before + 1:before + size(nodes)) = [nodes]
      end do
   end subroutine take_loads

   !> Surfaces that are worn at the start of the deck and do not wear: their joints have no wear law.
   function others(given, surfaces) result(list)
      type(worn_surface_t), allocatable, intent(in) :: given(:)   !! (any) worn at the start; unallocated: none
      type(worn_surface_t), intent(in) :: surfaces(:)             !! (n) those that wear
      type(worn_surface_t), allocatable :: list(:)                !! (any) the others

      integer :: i, k
      logical :: wears

      allocate (list(0))
      if (.not. allocated(given)) return
      do i = 1, size(given)
         wears = .false.
         do k = 1, size(surfaces)
            wears = wears .or. surfaces(k)%joint == given(i)%joint
         end do
         if (.not. wears) list = [list, given(i)]
      end do
   end function others

   !> Surfaces in the order of others: groups of bodies that are integrated apart have an order of their own.
   function in_order(surfaces, others) result(list)
      type(worn_surface_t), intent(in) :: surfaces(:)          !! (n) the surfaces
      type(worn_surface_t), intent(in) :: others(:)            !! (n) the same ones, as they were
      type(worn_surface_t), allocatable :: list(:)             !! (n) the first in the order of the second

      integer :: i, k

      list = others
      do k = 1, size(others)
         do i = 1, size(surfaces)
            if (surfaces(i)%joint == others(k)%joint .and. surfaces(i)%side == others(k)%side) list(k) = surfaces(i)
         end do
      end do
   end function in_order

end module life_rates
