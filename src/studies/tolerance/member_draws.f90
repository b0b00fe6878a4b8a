!> Draws of members: random numbers by counter, and the deviations and places of pins that they make.
!>
!> A member has a random number for each parameter (two of a fit), for each pin one on its circle or two in it, and for each batch
!> of parameters. They follow from
!> the seed, what they are for and the number of the member alone. In a Latin hypercube of n members the numbers of a column are
!> (o_m - u_m)/n, o a random order of 1 to n. In a Sobol' sequence they are those of a point of it.
!> Source: M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239-245.
module member_draws
   use counter_random, only: random_order, uniform_at
   use kinds, only: i8, two_pi, wp
   use normal_distribution, only: normal_quantile
   use sobol_points, only: sobol_t
   use tolerance_plan, only: pin_circle, pin_disc, pin_force, plan_hypercube, plan_sobol
   use tolerance_results, only: tolerance_study_t
   use tolerated, only: joint_number, most_random
   implicit none (type, external)
   private
   public :: draw_t, random_numbers, stream_a, stream_b, stream_check, stream_members, stream_rare, stream_resamples

   integer, parameter :: stream_members = 1     !! numbers of members
   integer, parameter :: stream_order = 2       !! orders of a Latin hypercube, scrambling of a Sobol' sequence
   integer, parameter :: stream_a = 3           !! plan A of Sobol' indices
   integer, parameter :: stream_b = 4           !! plan B
   integer, parameter :: stream_resamples = 5   !! resamples
   integer, parameter :: stream_check = 6       !! members that check the expansion
   integer, parameter :: stream_rare = 6      !! of channel r the r-th beyond: its failures

   !> What draws members.
   type :: draw_t
      integer :: seed = 0                      !! of the random numbers
      integer :: n = 0                         !! random numbers of a member
      integer, allocatable :: first(:)         !! (contributors + 1) first number of each
      integer :: before_batches = 0            !! contributors before the batches
      integer, allocatable :: orders(:, :)     !! (members, numbers) of a Latin hypercube; unallocated: another plan
      type(sobol_t), allocatable :: sobol      !! the sequence; unallocated: another plan
   contains
      procedure :: begin => draw_begin
      procedure :: count => draw_count
      procedure :: numbers => draw_numbers
      procedure :: make => draw_make
   end type draw_t

contains

   !> Random numbers that a member takes.
   pure integer function random_numbers(study)
      type(tolerance_study_t), intent(in) :: study       !! parameters and pins

      type(draw_t) :: draw

      call draw%count(study)
      random_numbers = draw%n
   end function random_numbers

   !> Count the random numbers of each contributor.
   pure subroutine draw_count(self, study)
      class(draw_t), intent(inout) :: self               !! the draws
      type(tolerance_study_t), intent(in) :: study       !! parameters and pins

      integer :: k, n

      n = size(study%plan%parameters)
      allocate (self%first(n + size(study%pins) + size(study%plan%batches) + 1))
      self%first(1) = 1
      do k = 1, n
         self%first(k + 1) = self%first(k) + study%plan%parameters(k)%n_random()
      end do
      do k = 1, size(study%pins)
         self%first(n + k + 1) = self%first(n + k)
         if (study%pins(k)%position == pin_disc) self%first(n + k + 1) = self%first(n + k) + 2
         if (study%pins(k)%position == pin_circle) self%first(n + k + 1) = self%first(n + k) + 1
      end do
      self%before_batches = n + size(study%pins)
      do k = self%before_batches + 1, size(self%first) - 1
         self%first(k + 1) = self%first(k) + 1
      end do
      self%n = self%first(size(self%first)) - 1
   end subroutine draw_count

   !> Prepare the plan of the members.
   subroutine draw_begin(self, study)
      class(draw_t), intent(inout) :: self               !! the draws
      type(tolerance_study_t), intent(in) :: study       !! parameters and pins

      integer :: k

      self%seed = study%plan%sampling%seed
      call self%count(study)
      if (study%plan%sampling%plan == plan_sobol) then
         allocate (self%sobol)
         call self%sobol%begin(self%n, self%seed, stream_order)
      end if
      if (study%plan%sampling%plan /= plan_hypercube) return
      allocate (self%orders(study%plan%sampling%members, self%n))
      do k = 1, self%n
         call random_order(self%seed, stream_order, k - 1, self%orders(:, k))
      end do
   end subroutine draw_begin

   !> Random numbers of a member.
   subroutine draw_numbers(self, stream, member, u)
      class(draw_t), intent(in) :: self   !! the draws
      integer, intent(in) :: stream       !! what they are for
      integer(i8), intent(in) :: member   !! number of the member, from 1
      real(wp), intent(out) :: u(:)       !! (numbers) between 0 and 1, both excluded [1]

      integer :: k

      if (stream == stream_members .and. allocated(self%sobol)) then
         call self%sobol%point(member - 1_i8, u)
         return
      end if
      do k = 1, self%n
         u(k) = uniform_at(self%seed, stream, member - 1_i8, k - 1)
      end do
      if (stream /= stream_members .or. .not. allocated(self%orders)) return
      u = (self%orders(member, :) - u)/size(self%orders, 1)
   end subroutine draw_numbers

   !> Deviations of the parameters and displacements of the pins that random numbers make, by the linear clearance.
   subroutine draw_make(self, study, at, u, deviations, units, clearances)
      class(draw_t), intent(in) :: self               !! the draws
      type(tolerance_study_t), intent(in) :: study    !! parameters and pins
      integer, intent(in) :: at                       !! number of the output time, for the direction of forces
      real(wp), intent(in) :: u(:)                    !! (numbers) random numbers [1]
      real(wp), intent(out) :: deviations(:)          !! (parameters) deviations [any]
      real(wp), intent(out) :: units(:, :)            !! (2, pins) displacements, of the clearances [1]
      real(wp), intent(out) :: clearances(:)          !! (pins) radial clearances to first order, not negative [m]

      real(wp) :: angle
      integer :: k, n

      n = size(deviations)
      do k = 1, n
         associate (parameter => study%plan%parameters(k), first => self%first(k))
            if (parameter%batch > 0) then
               deviations(k) = parameter%deviation([joint_number(normal_quantile(u(first)), &
                  normal_quantile(u(self%first(self%before_batches + parameter%batch))), parameter%in_batch)])
            else
               deviations(k) = parameter%deviation(u(first:min(first + most_random - 1, size(u))))
            end if
         end associate
      end do
      do k = 1, size(study%pins)
         clearances(k) = max(study%pins(k)%clearance + dot_product(study%derivatives%clearance_slopes(:, k), deviations), 0.0_wp)
         associate (first => self%first(n + k))
            select case (study%pins(k)%position)
            case (pin_disc)
               angle = two_pi*u(first + 1)
               units(:, k) = sqrt(u(first))*[cos(angle), sin(angle)]
            case (pin_circle)
               angle = two_pi*u(first)
               units(:, k) = [cos(angle), sin(angle)]
            case (pin_force)
               units(:, k) = study%derivatives%directions(:, k, at)
            case default
               units(:, k) = 0.0_wp
            end select
         end associate
      end do
   end subroutine draw_make

end module member_draws
