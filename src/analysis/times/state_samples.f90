!> Samples of the state equations of a deck: instants k T of each sampling period T, at which steps end.
module state_samples
   use kinds, only: i8, wp
   use state_equations, only: sampled, state_equations_t
   implicit none (type, external)
   private
   public :: samples_t

   !> Sampling periods, each once, and the next sample of each.
   type :: samples_t
      integer :: n = 0                          !! periods
      real(wp), allocatable :: every(:)         !! (n) they [s]
      integer(i8), allocatable :: number(:)     !! (n) number of the next sample, 0 at t = 0
   contains
      procedure :: start => samples_start
      procedure :: next => samples_next
      procedure :: pass => samples_pass
   end type samples_t

contains

   !> The periods of a deck; the samples of t = 0 are those of the start.
   pure subroutine samples_start(self, states)
      class(samples_t), intent(inout) :: self           !! set
      type(state_equations_t), intent(in) :: states     !! the equations

      integer :: k

      allocate (self%every(0))
      do k = 1, states%n
         if (states%rows(k)%sort /= sampled) cycle
         if (any(.not. abs(self%every - states%rows(k)%every) > 0.0_wp)) cycle
         self%every = [self%every, states%rows(k)%every]
      end do
      self%n = size(self%every)
      allocate (self%number(self%n), source=1_i8)
   end subroutine samples_start

   !> Time of the next sample of any period, and of the last one that is not after a limit.
   pure subroutine samples_next(self, limit, first, last)
      class(samples_t), intent(in) :: self       !! the samples
      real(wp), intent(in) :: limit              !! the limit [s]
      real(wp), intent(out) :: first             !! huge if no state is sampled [s]
      real(wp), intent(out) :: last              !! -huge if no sample is up to the limit [s]

      integer :: k

      first = huge(1.0_wp)
      last = -huge(1.0_wp)
      do k = 1, self%n
         associate (at => real(self%number(k), wp)*self%every(k))
            first = min(first, at)
            if (at <= limit) last = max(last, at)
         end associate
      end do
   end subroutine samples_next

   !> The samples up to a time are behind.
   pure subroutine samples_pass(self, t)
      class(samples_t), intent(inout) :: self    !! the samples
      real(wp), intent(in) :: t                  !! the time [s]

      integer :: k

      do k = 1, self%n
         if (real(self%number(k), wp)*self%every(k) <= t) self%number(k) = self%number(k) + 1
      end do
   end subroutine samples_pass

end module state_samples
