!> What a study of tolerances is asked: parameters with their tolerances, pins with clearance, limits, sampling.
module tolerance_plan
   use item, only: location_t
   use kind_info, only: dim_t
   use kinds, only: not_a_number, wp
   use text, only: text_t
   use tolerated, only: tolerated_t
   implicit none (type, external)
   private
   public :: indices_by_plan, indices_by_polynomial, level_auto, level_dynamic, level_kinematic, limit_t, method_auto, &
      method_exact, method_expansion, pin_circle, pin_disc, pin_force, pin_t, pin_worst, plan_hypercube, plan_sobol, &
      tolerance_plan_t

   integer, parameter :: pin_disc = 1     !! anywhere in the circle of the clearance, uniform
   integer, parameter :: pin_circle = 2   !! on the circle, uniform
   integer, parameter :: pin_force = 3    !! where the force of the ideal joint presses it
   integer, parameter :: pin_worst = 4    !! where it is worst for each request

   integer, parameter :: method_auto = 1       !! by the expansion if it is accurate
   integer, parameter :: method_expansion = 2  !! by the expansion of second order
   integer, parameter :: method_exact = 3      !! each member is assembled

   integer, parameter :: plan_monte_carlo = 1   !! independent members
   integer, parameter :: plan_hypercube = 2     !! a Latin hypercube
   integer, parameter :: plan_sobol = 3         !! points of a Sobol' sequence

   integer, parameter :: indices_by_plan = 1         !! by members of a plan of their own
   integer, parameter :: indices_by_polynomial = 2   !! by a polynomial through the members

   integer, parameter :: level_auto = 1        !! kinematic where the deck has [analysis.kinematic], else dynamic
   integer, parameter :: level_kinematic = 2   !! positions by a kinematic analysis
   integer, parameter :: level_dynamic = 3     !! each member is a run of the dynamic analysis

   integer, parameter :: usual_members(2) = [10000, 200]   !! members of the kinematic and of the dynamic level
   integer, parameter :: usual_points(2) = [1000, 50]      !! points of both

   !> A joint with clearance.
   type :: pin_t
      character(:), allocatable :: joint   !! name of the joint
      integer :: position = pin_disc       !! one of the above
      type(location_t) :: location         !! of its row
   end type pin_t

   !> Limits of a channel.
   type :: limit_t
      character(:), allocatable :: channel           !! as written
      real(wp) :: lower = -huge(1.0_wp)              !! lower limit, SI [any]
      real(wp) :: upper = huge(1.0_wp)               !! upper limit, SI [any]
      type(location_t) :: location                   !! of the channel
      type(location_t) :: at(2)                      !! (2) of the limits
      logical :: has(2) = .false.                    !! (2) whether it has a lower and an upper one
      type(dim_t) :: dimensions(2)                   !! (2) of the limits
   end type limit_t

   !> Sampling.
   type :: sampling_t
      integer :: members = 0                    !! mechanisms that are sampled; 0: as the level has
      integer :: seed = 0                       !! of the random numbers
      integer :: plan = plan_monte_carlo        !! one of the above
      integer :: method = method_auto           !! one of the above
      real(wp) :: accuracy = 0.0_wp             !! accepted error of the expansion, of a standard deviation [1]
      real(wp) :: budget = 0.0_wp               !! time to assemble all members, if the method is chosen [s]
      integer :: checked = 0                    !! members that are assembled to find it
      integer :: indices = indices_by_plan      !! one of the above
      integer :: points = 0                     !! of the plan of Sobol' indices; 0: as the level has
      integer :: resamples = 0                  !! for their intervals
      integer :: bins = 0                       !! of histograms
      integer :: rare = 0                       !! members that find rare failures of a channel; 0: these are not asked for
      real(wp) :: target = 0.0_wp               !! yield that cheapest tolerances must reach [1]
   end type sampling_t

   !> All of it.
   type :: tolerance_plan_t
      type(tolerated_t), allocatable :: parameters(:)  !! (parameters) with their tolerances
      type(text_t), allocatable :: batches(:)          !! (batches) of parameters that deviate together
      real(wp), allocatable :: costs(:)                !! (parameters) cost of a part that goes with one over the width; 0: none [1]
      type(pin_t), allocatable :: pins(:)              !! (any) rows of [tolerance.joint]
      type(limit_t), allocatable :: limits(:)          !! (any) rows of [tolerance.limit]
      type(text_t), allocatable :: requests(:)         !! (any) channels that are named as requests
      type(location_t), allocatable :: places(:)       !! (any) where they stand
      integer :: level = level_auto                    !! one of the above
      type(sampling_t) :: sampling                     !! of the members
   contains
      procedure :: settle
   end type tolerance_plan_t

contains

   !> Settle what is left open: the level, and how many members and points it has.
   pure subroutine settle(self, has_kinematic)
      class(tolerance_plan_t), intent(inout) :: self   !! the plan, read
      logical, intent(in) :: has_kinematic             !! the deck has [analysis.kinematic]

      if (self%level == level_auto) self%level = merge(level_kinematic, level_dynamic, has_kinematic)
      associate (k => merge(1, 2, self%level == level_kinematic))
         if (self%sampling%members == 0) self%sampling%members = usual_members(k)
         if (self%sampling%points == 0) self%sampling%points = usual_points(k)
      end associate
   end subroutine settle

end module tolerance_plan
