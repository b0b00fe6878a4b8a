!> Particles among walls, run through all their events, for the tests of event location.
module event_description
   use check, only: check_close, check_equal, check_true
   use errors, only: error_t
   use integrator, only: advance_event, integrator_t
   use kinds, only: wp
   use ode_examples, only: particles_t
   implicit none (type, external)
   private
   public :: check_description, run_through, description_t

   integer, parameter :: most_steps = 2000  !! more are an endless loop

   !> What happened in a run.
   type :: description_t
      integer :: n_step = 0                       !! steps
      integer :: n_event = 0                      !! events
      integer :: number(most_steps) = 0           !! (events) number of the function
      real(wp) :: time(most_steps) = 0.0_wp       !! (events) when [s]
      real(wp) :: residual = 0.0_wp               !! maximum |g| at an event [m]
      real(wp) :: overlap = 0.0_wp                !! maximum g at the end of a step without event [m]
      logical :: is_complete = .false.            !! the end was reached
   end type description_t

contains

   !> Run to the end. At an event the particle continues through the wall: the function changes its sign.
   subroutine run_through(system, y, t_end, method, description, restitution)
      type(particles_t), intent(inout) :: system         !! the system
      real(wp), intent(in) :: y(:)                       !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                      !! end [s]
      class(integrator_t), intent(inout) :: method       !! the integrator, with its controls
      type(description_t), intent(out) :: description                !! what happened
      real(wp), intent(in), optional :: restitution      !! the particles bounce instead of continuing [1]

      real(wp) :: g(system%n_event), rate(system%n_event)
      integer :: k, n, status

      n = system%n_position
      call method%start(system, 0.0_wp, y, t_end, status)
      do while (method%t < t_end .and. status >= 0 .and. description%n_step < most_steps)
         call method%advance(system, t_end, status)
         description%n_step = description%n_step + 1
         call system%events(method%t, method%step%y1, g, rate)
         if (status /= advance_event) then
            description%overlap = max(description%overlap, maxval(g))
            cycle
         end if
         do k = 1, method%events%n_happened
            associate (number => method%events%happened(k))
               description%n_event = description%n_event + 1
               description%number(description%n_event) = number
               description%time(description%n_event) = method%t
               description%residual = max(description%residual, abs(g(number)))
               if (present(restitution)) then
                  method%step%y1(n + system%subject(number)) = -restitution*method%step%y1(n + system%subject(number))
               else
                  system%side(number) = -system%side(number)
               end if
            end associate
         end do
         call method%restart(system, 0.0_wp, status)
      end do
      description%is_complete = method%t == t_end .and. status >= 0
   end subroutine run_through

   !> The run came to its end, with this many events, no overlap, all at round-off.
   subroutine check_description(error, description, n_event, round_off, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      type(description_t), intent(in) :: description                   !! what happened
      integer, intent(in) :: n_event                       !! events expected
      real(wp), intent(in) :: round_off                    !! maximum |g| at an event [m]
      character(*), intent(in) :: what                     !! the case

      call check_true(error, description%is_complete, what//": comes to its end")
      call check_equal(error, description%n_event, n_event, what//": events")
      call check_close(error, description%residual, 0.0_wp, round_off, what//": event function at the events")
      call check_close(error, description%overlap, 0.0_wp, round_off, what//": event function at the ends of other steps")
   end subroutine check_description

end module event_description
