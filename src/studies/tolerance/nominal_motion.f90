!> The nominal motion of a kinematic analysis: positions of all bodies at the output times.
module nominal_motion
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use jobs, only: job_t, run_started, start_job, started_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use recorder, only: event_t, recorder_t, summary_t
   use varied_mechanism, only: instant_t
   implicit none (type, external)
   private
   public :: find_motion

   !> A recorder that keeps positions.
   type, extends(recorder_t) :: position_recorder_t
      type(mechanism_t), pointer :: system => null()   !! the mechanism that moves
      real(wp) :: from = 0.0_wp                        !! first output time [s]
      integer :: n = 0                                 !! instants kept
      type(instant_t), allocatable :: instants(:)      !! (n or more) the instants
   contains
      procedure :: start => start_positions
      procedure :: wants => wants_nothing
      procedure :: sample => keep_positions
      procedure :: event => no_event
      procedure :: progress => no_progress
      procedure :: finish => finish_positions
   end type position_recorder_t

contains

   !> Follow the nominal motion.
   subroutine find_motion(job, system, instants, warnings, error)
      type(job_t), intent(in) :: job                            !! the kinematic analysis
      type(mechanism_t), intent(inout), target :: system        !! its system, all joints ideal
      type(instant_t), allocatable, intent(out) :: instants(:)  !! (n) output times with their positions
      type(summary_t), intent(out) :: warnings                  !! summary of the run, for its warnings
      type(error_t), allocatable, intent(out) :: error          !! it cannot be assembled, or comes to a dead centre

      type(position_recorder_t) :: recorder
      type(started_t) :: start
      integer :: k

      call start_job(job, system, start, error)
      if (allocated(error)) return
      recorder%system => system
      call run_started(job, system, start, recorder, warnings, error)
      if (allocated(error)) return
      allocate (instants(recorder%n))
      do k = 1, recorder%n
         instants(k) = recorder%instants(k)
      end do
   end subroutine find_motion

   !> Make storage.
   subroutine start_positions(self, catalogue, error)
      class(position_recorder_t), intent(inout) :: self  !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! never set

      self%n = 0
      allocate (self%instants(64))
   end subroutine start_positions

   !> No value of the catalogue is read.
   pure logical function wants_nothing(self, group, item) result(wants)
      class(position_recorder_t), intent(in) :: self   !! the recorder
      integer, intent(in) :: group                     !! its group in the catalogue
      integer, intent(in) :: item                      !! number of the item in the group

      wants = .false.
   end function wants_nothing

   !> Keep the positions of an output time.
   subroutine keep_positions(self, t, catalogue, error)
      class(position_recorder_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      type(instant_t), allocatable :: more(:)
      integer :: k

      if (self%n == size(self%instants)) then
         allocate (more(2*self%n))
         do k = 1, self%n
            more(k)%t = self%instants(k)%t
            more(k)%segment = self%instants(k)%segment
            call move_alloc(self%instants(k)%q, more(k)%q)
         end do
         call move_alloc(more, self%instants)
      end if
      self%n = self%n + 1
      associate (instant => self%instants(self%n), linkage => self%system%linkage)
         instant%t = t
         instant%segment = linkage%segment
         call read_positions(self%system, instant%q)
      end associate
   end subroutine keep_positions

   !> Positions of all bodies.
   subroutine read_positions(system, q)
      type(mechanism_t), intent(in) :: system           !! the mechanism, moved
      real(wp), allocatable, intent(out) :: q(:)        !! (n_q bodies) positions [any]

      integer :: k

      associate (linkage => system%linkage)
         block
            real(wp) :: one(linkage%coordinates%n_q), rate(linkage%coordinates%n_v)

            allocate (q(0))
            do k = 1, linkage%bodies%n
               call linkage%coordinates%read_motion(linkage%motion, k, one, rate)
               q = [q, one]
            end do
         end block
      end associate
   end subroutine read_positions

   !> Events are not kept.
   subroutine no_event(self, event, error)
      class(position_recorder_t), intent(inout) :: self  !! the recorder
      type(event_t), intent(in) :: event                 !! what happened
      type(error_t), allocatable, intent(out) :: error   !! never set
   end subroutine no_event

   !> Progress is not shown.
   subroutine no_progress(self, fraction)
      class(position_recorder_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: fraction                   !! of the work done, 0 to 1 [1]
   end subroutine no_progress

   !> Nothing is closed.
   subroutine finish_positions(self, summary, error)
      class(position_recorder_t), intent(inout) :: self  !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! never set
   end subroutine finish_positions

end module nominal_motion
