!> Which mechanisms the dynamic level runs: a plan of cases, each with the deviations of all parameters.
!>
!> The nominal case comes first. Where each case has one run there follow two on both sides of it for each parameter, a standard
!> deviation away, for derivatives. Then come the members, and where each case has one run the plans of Sobol' indices, unless these
!> come from a polynomial: A, A with a contributor of B, for each, and B. Contributors are parameters and batches. Where cases have
!> several runs, each from another start, their scatter is split instead.
module run_design
   use kinds, only: i8, wp
   use member_draws, only: draw_t, stream_a, stream_b, stream_members
   use tolerance_plan, only: indices_by_plan
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: new_design, run_design_t

   !> The cases.
   type :: run_design_t
      integer :: n_start = 1                       !! runs of a case
      integer :: n_member = 0                      !! members
      integer :: n_point = 0                       !! points of each plan; 0: no indices
      integer :: seed = 0                          !! of the random numbers
      real(wp), allocatable :: steps(:)            !! (parameters) distance of the cases for derivatives; 0: none [any]
      real(wp), allocatable :: deviations(:, :)    !! (parameters, cases) deviations from the nominal values [any]
   contains
      procedure :: beside
      procedure :: member
      procedure :: point
   end type run_design_t

contains

   !> Make the plan of a study.
   subroutine new_design(study, n_start, design)
      type(tolerance_study_t), intent(in) :: study     !! what is asked; no pins
      integer, intent(in) :: n_start                   !! runs of a case
      type(run_design_t), intent(out) :: design        !! the cases

      type(draw_t) :: draw
      real(wp), allocatable :: mixed(:), u_a(:), u_b(:)
      integer :: k, m, n

      n = size(study%plan%parameters) + size(study%plan%batches)
      design%n_start = n_start
      design%n_member = study%plan%sampling%members
      if (n_start == 1 .and. study%plan%sampling%indices == indices_by_plan) design%n_point = study%plan%sampling%points
      design%steps = study%plan%parameters%sigma
      if (n_start > 1) design%steps = 0.0_wp
      call draw%begin(study)
      design%seed = draw%seed
      allocate (design%deviations(size(design%steps), design%point(n + 2, 0)), source=0.0_wp)
      do k = 1, size(design%steps)
         if (n_start > 1) exit
         design%deviations(k, design%beside(k, 1)) = design%steps(k)
         design%deviations(k, design%beside(k, 2)) = -design%steps(k)
      end do
      allocate (u_a(draw%n), u_b(draw%n))
      do m = 1, design%n_member
         call draw%numbers(stream_members, int(m, i8), u_a)
         call take(u_a, design%member(m))
      end do
      do m = 1, design%n_point
         call draw%numbers(stream_a, int(m, i8), u_a)
         call draw%numbers(stream_b, int(m, i8), u_b)
         call take(u_a, design%point(0, m))
         call take(u_b, design%point(n + 1, m))
         do k = 1, n
            mixed = u_a
            mixed(draw%first(k):draw%first(k + 1) - 1) = u_b(draw%first(k):draw%first(k + 1) - 1)
            call take(mixed, design%point(k, m))
         end do
      end do

   contains

      !> Deviations of a case by random numbers.
      subroutine take(u, at)
         real(wp), intent(in) :: u(:)   !! (numbers) random numbers [1]
         integer, intent(in) :: at      !! number of the case

         real(wp) :: no_clearance(0), no_units(2, 0)

         call draw%make(study, 1, u, design%deviations(:, at), no_units, no_clearance)
      end subroutine take

   end subroutine new_design

   !> Number of the case on a side of the nominal one.
   pure integer function beside(self, parameter, side) result(at)
      class(run_design_t), intent(in) :: self   !! the cases
      integer, intent(in) :: parameter          !! number of the parameter
      integer, intent(in) :: side               !! 1: above, 2: below

      at = 1 + 2*(parameter - 1) + side
   end function beside

   !> Number of the case of a member.
   pure integer function member(self, m) result(at)
      class(run_design_t), intent(in) :: self   !! the cases
      integer, intent(in) :: m                  !! number of the member

      at = 1 + m
      if (self%n_start == 1) at = at + 2*size(self%steps)
   end function member

   !> Number of the case of a point; point 0 of the plan after the last one: the last case of all.
   pure integer function point(self, plan, m) result(at)
      class(run_design_t), intent(in) :: self   !! the cases
      integer, intent(in) :: plan               !! 0: plan A, k: A with contributor k of B, contributors + 1: plan B
      integer, intent(in) :: m                  !! number of the point

      at = self%member(self%n_member) + plan*self%n_point + m
   end function point

end module run_design
