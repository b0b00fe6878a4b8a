!> Channels of a motion at many times, and their derivatives by its parameters, in one pass.
!>
!> The state at a time within a step is that of the method's own step to there; so are the states beside, whose central differences
!> are the derivatives at a fixed time.
module channel_samples
   use derived_motion, only: motion_t
   use kinds, only: not_a_number, wp
   use mechanism_report, only: report_state
   use sensitivity_column, only: column_t, derivative
   use step_viewer, only: step_viewer_t
   use varied_system, only: varied_t
   implicit none (type, external)
   private
   public :: channel_samples_t

   real(wp), parameter :: beside = 1.0e-3_wp   !! distance of the states that a rate is found from, of the step [1]

   !> The samples.
   type, extends(step_viewer_t) :: channel_samples_t
      real(wp), allocatable :: times(:)               !! (times) ascending [s]
      logical :: has_rates = .false.                  !! rates of the channels are wanted
      real(wp), allocatable :: values(:, :)           !! (channels, times) values; NaN: none [any]
      real(wp), allocatable :: rates(:, :)            !! (channels, times) their rates [any]
      real(wp), allocatable :: derivatives(:, :, :)   !! (channels, parameters, times) NaN: none [any]
      integer, private :: next = 1                    !! first time that is not passed
   contains
      procedure :: begin => begin_samples
      procedure :: see_start
      procedure :: see_step
      procedure, private :: read_values
   end type channel_samples_t

contains

   !> Prepare for a motion.
   subroutine begin_samples(self, times, n_parameter)
      class(channel_samples_t), intent(inout) :: self   !! the samples, channels are set
      real(wp), intent(in) :: times(:)                  !! (times) ascending [s]
      integer, intent(in) :: n_parameter                !! parameters by which the channels are derived

      self%times = times
      self%next = 1
      associate (n => size(self%channels, 2), m => size(times))
         if (allocated(self%values)) deallocate (self%values, self%rates, self%derivatives)
         allocate (self%values(n, m), self%rates(n, m), self%derivatives(n, n_parameter, m), source=not_a_number())
      end associate
   end subroutine begin_samples

   !> Samples at the start.
   subroutine see_start(self, motion)
      class(channel_samples_t), intent(inout) :: self   !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion

      real(wp) :: later(size(self%channels, 2)), values(size(self%channels, 2), 4)
      integer :: c, i, k, status
      real(wp), parameter :: soon = 1.0e-7_wp   ! of the motion, to a state that the rate is found from [1]

      associate (method => motion%mover%method, system => motion%mover%system)
         do while (self%next <= size(self%times))
            if (self%times(self%next) > method%t) exit
            call self%read_values(motion, method%t, method%step%y1, self%values(:, self%next), status)
            if (self%has_rates .and. status == 0) then
               associate (dt => soon*self%times(size(self%times)))
                  call self%read_values(motion, method%t + dt, method%step%y1 + dt*method%step%f1, later, status)
                  self%rates(:, self%next) = (later - self%values(:, self%next))/dt
               end associate
            end if
            do c = 1, size(motion%columns)
               if (.not. motion%columns(c)%is_active .or. status /= 0) cycle
               associate (column => motion%columns(c))
                  do k = 1, 4
                     associate (b => column%beside(k))
                        b%y = method%step%y1 + b%e*column%s
                        call read_beside(self, b, method%t + b%e*column%theta, values(:, k), status)
                     end associate
                     if (status /= 0) exit
                  end do
                  if (status /= 0) cycle
                  do i = 1, size(values, 1)
                     self%derivatives(i, c, self%next) = derivative(values(i, :), column%beside%e)
                  end do
               end associate
            end do
            self%next = self%next + 1
         end do
      end associate
   end subroutine see_start

   !> Samples in a step.
   subroutine see_step(self, motion, behind)
      class(channel_samples_t), intent(inout) :: self   !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion
      real(wp), intent(in) :: behind                    !! time after an onset at which a force that jumps is seen; 0: none [s]

      real(wp) :: s
      integer :: c, status

      associate (method => motion%mover%method)
         do while (self%next <= size(self%times))
            if (self%times(self%next) > method%t) exit
            s = (self%times(self%next) - method%step%t0)/method%step%h
            call read_place(self, motion, s, self%values(:, self%next), status)
            if (self%has_rates .and. status == 0) call find_rates(self, motion, s)
            do c = 1, size(motion%columns)
               if (.not. motion%columns(c)%is_active .or. status /= 0) cycle
               call derive_one(self, motion, motion%columns(c), c, behind)
            end do
            self%next = self%next + 1
         end do
      end associate
   end subroutine see_step

   !> Derivatives at the next time by one parameter.
   subroutine derive_one(self, motion, column, c, behind)
      class(channel_samples_t), intent(inout) :: self   !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion
      type(column_t), intent(inout) :: column           !! derivatives at the start of the step
      integer, intent(in) :: c                          !! number of the parameter
      real(wp), intent(in) :: behind                    !! as of `see_step` [s]

      real(wp) :: values(size(self%channels, 2), 4)
      integer :: i, k, status

      associate (map => motion%map, method => motion%mover%method, t => self%times(self%next))
         call map%take_step(method)
         do k = 1, 4
            associate (b => column%beside(k))
               call map%start_beside(method, b, column%s, column%theta, behind, status)
               if (status == 0) call map%end_after(b, t - map%tool%step%t0, status)
               if (status == 0) call read_beside(self, b, b%t, values(:, k), status)
            end associate
            if (status /= 0) return
         end do
         do i = 1, size(values, 1)
            self%derivatives(i, c, self%next) = derivative(values(i, :), column%beside%e)
         end do
      end associate
   end subroutine derive_one

   !> Rates of the channels next to a place of the step.
   subroutine find_rates(self, motion, s)
      class(channel_samples_t), intent(inout) :: self   !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion
      real(wp), intent(in) :: s                         !! the place [1]

      real(wp), dimension(size(self%channels, 2)) :: before, behind
      integer :: status

      associate (first => max(0.0_wp, s - beside), last => min(1.0_wp, s + beside), h => motion%mover%method%step%h)
         call read_place(self, motion, first, before, status)
         if (status == 0) call read_place(self, motion, last, behind, status)
         if (status == 0) self%rates(:, self%next) = (behind - before)/((last - first)*h)
      end associate
   end subroutine find_rates

   !> The channels at a place of the step.
   subroutine read_place(self, motion, s, x, status)
      class(channel_samples_t), intent(inout) :: self   !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion
      real(wp), intent(in) :: s                         !! the place [1]
      real(wp), intent(out) :: x(:)                     !! (channels) values [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp) :: y(motion%mover%system%n)

      associate (method => motion%mover%method)
         y = method%step%y1
         status = 0
         if (s <= 0.0_wp) y = method%step%y0
         if (s > 0.0_wp .and. s < 1.0_wp) call method%refine(motion%mover%system, s, y, status)
         x = not_a_number()
         if (status /= 0) return
         call self%read_values(motion, method%step%t0 + s*method%step%h, y, x, status)
      end associate
   end subroutine read_place

   !> The channels at a state.
   subroutine read_values(self, motion, t, y, x, status)
      class(channel_samples_t), intent(in) :: self      !! the samples
      type(motion_t), intent(inout) :: motion           !! the motion
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: y(:)                      !! (n) the state [any]
      real(wp), intent(out) :: x(:)                     !! (channels) values [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp) :: ydot(size(y))
      integer :: i

      call report_state(motion%mover%system, t, y, ydot, 0.0_wp, motion%catalogue, status)
      x = not_a_number()
      if (status /= 0) return
      do i = 1, size(x)
         x(i) = motion%catalogue%values(motion%catalogue%place(self%channels(1, i), self%channels(2, i), self%channels(3, i)))
      end do
   end subroutine read_values

   !> The channels of a mechanism beside at its state.
   subroutine read_beside(self, varied, t, x, status)
      class(channel_samples_t), intent(in) :: self      !! the samples
      type(varied_t), intent(inout) :: varied           !! the mechanism beside; y is set
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(out) :: x(:)                     !! (channels) values [any]
      integer, intent(out) :: status                    !! 0: done

      integer :: i

      call report_state(varied%system, t, varied%y, varied%ydot, 0.0_wp, varied%catalogue, status)
      x = not_a_number()
      if (status /= 0) return
      do i = 1, size(x)
         x(i) = varied%catalogue%values(varied%catalogue%place(self%channels(1, i), self%channels(2, i), self%channels(3, i)))
      end do
   end subroutine read_beside

end module channel_samples
