!> The map of one step of a method, from another start and for another mechanism than that of the deck.
!>
!> With Phi_h the map of a step of length h, a step from y_0 at t_0 leads to Phi_h(t_0, y_0; p). Here it is asked for beside the
!> step that was made: from y_0 + e s at t_0 + e theta, with the parameter p + e, for the same length, up to a given time, or up to
!> where an event function has a given value. The method is another one of the type that made the step: the map is the same.
!>
!> Limits: one-step methods.
module step_map
   use force_jumps, only: find_derivative_behind
   use integration_settings, only: integration_t
   use integrator, only: advance_step, integrator_t
   use kinds, only: eps, wp
   use ode_system, only: ode_system_t
   use varied_system, only: varied_t
   implicit none (type, external)
   private
   public :: section_function, section_length, section_t, section_time, step_map_t

   integer, parameter :: section_length = 0     !! a step beside is as long as the step
   integer, parameter :: section_time = 1       !! it ends at the same time
   integer, parameter :: section_function = 2   !! it ends where an event function has the same value

   integer, parameter :: most_corrections = 6        !! of the length of a step
   real(wp), parameter :: close_enough = 1.0e-7_wp   !! correction that is the last, of the difference of lengths [1]
   real(wp), parameter :: longest = 10.0_wp          !! difference of lengths that is given up, of the step [1]

   !> Where steps beside end.
   type :: section_t
      integer :: kind = section_length     !! one of the above
      integer :: number = 0                !! of the event function
      real(wp) :: target = 0.0_wp          !! its value [any]
   end type section_t

   !> The map.
   type :: step_map_t
      class(integrator_t), allocatable :: tool        !! a method as the one that makes the steps
      real(wp), allocatable :: y(:), ydot(:)          !! (n) scratch [any]
      real(wp), allocatable :: g(:), rate(:)          !! (events) functions at the last end [any]
   contains
      procedure :: begin => begin_map
      procedure :: take_step
      procedure :: start_beside
      procedure :: end_after
      procedure :: end_at_section
   end type step_map_t

contains

   !> Start another method of the same type.
   subroutine begin_map(self, settings, system, y, end, status)
      class(step_map_t), intent(inout) :: self        !! the map
      type(integration_t), intent(in) :: settings     !! of the method
      class(ode_system_t), intent(inout) :: system    !! the system
      real(wp), intent(in) :: y(:)                    !! (n) its state at t = 0 [any]
      real(wp), intent(in) :: end                     !! of the motion [s]
      integer, intent(out) :: status                  !! 0: done

      call settings%new_method(self%tool)
      call self%tool%start(system, 0.0_wp, y, end, status)
      if (status == advance_step) status = 0
      allocate (self%y(system%n), self%ydot(system%n), self%g(system%n_event), self%rate(system%n_event), source=0.0_wp)
   end subroutine begin_map

   !> Take over a step.
   subroutine take_step(self, method)
      class(step_map_t), intent(inout) :: self        !! the map
      class(integrator_t), intent(in) :: method       !! the method that made it

      self%tool%step = method%step
   end subroutine take_step

   !> Start beside the step: y_0 + e s at t_0 + e theta.
   subroutine start_beside(self, method, varied, s, theta, behind, status)
      class(step_map_t), intent(inout) :: self        !! the map, of the step
      class(integrator_t), intent(in) :: method       !! the method after the step
      type(varied_t), intent(inout) :: varied         !! the mechanism beside
      real(wp), intent(in) :: s(:)                    !! (n) derivative of the state [any]
      real(wp), intent(in) :: theta                   !! derivative of the time [any]
      real(wp), intent(in) :: behind                  !! time after an onset at which a force that jumps there is seen; 0: none [s]
      integer, intent(out) :: status                  !! 0: done

      associate (step => self%tool%step)
         step%t0 = method%step%t0 + varied%e*theta
         step%y0(:) = method%step%y0 + varied%e*s
         step%course = method%step%course
         step%has_inner = .false.
         call varied%system%evaluate(step%t0, step%y0, step%f0, status)
         if (status /= 0 .or. behind <= 0.0_wp) return
         self%tool%t = step%t0
         step%y1(:) = step%y0
         step%f1(:) = step%f0
         call find_derivative_behind(varied%system, self%tool, behind, self%y, self%ydot, status)
         step%f0(:) = step%f1
      end associate
   end subroutine start_beside

   !> The end of a step of a given length from there.
   subroutine end_after(self, varied, h, status)
      class(step_map_t), intent(inout) :: self        !! the map, started
      type(varied_t), intent(inout) :: varied         !! the mechanism beside; y, t and h are set
      real(wp), intent(in) :: h                       !! the length [s]
      integer, intent(out) :: status                  !! 0: done

      self%tool%step%h = h
      self%tool%t = self%tool%step%t0 + max(abs(h), 4.0_wp*eps*abs(self%tool%step%t0))  ! behind the start: a part of a step
      call self%tool%refine(varied%system, 1.0_wp, varied%y, status)
      if (status == advance_step) status = 0
      varied%h = h
      varied%t = self%tool%step%t0 + h
   end subroutine end_after

   !> The end of a step from there in the section of the step that was made: Newton's iteration for its length.
   subroutine end_at_section(self, method, varied, section, status)
      class(step_map_t), intent(inout) :: self        !! the map, started; event functions there are set
      class(integrator_t), intent(in) :: method       !! the method after the step
      type(varied_t), intent(inout) :: varied         !! the mechanism beside; y, t and h are set
      type(section_t), intent(in) :: section          !! where the step ends
      integer, intent(out) :: status                  !! 0: done; > 0: there is no such end nearby

      real(wp) :: correction, h
      integer :: k

      h = method%step%h
      if (section%kind == section_time) h = method%t - self%tool%step%t0
      call self%end_after(varied, h, status)
      if (status /= 0 .or. section%kind /= section_function) return
      do k = 1, most_corrections
         call varied%system%events(varied%t, varied%y, self%g, self%rate)
         if (.not. abs(self%rate(section%number)) > 0.0_wp) exit
         correction = -(self%g(section%number) - section%target)/self%rate(section%number)
         if (abs(correction) <= max(close_enough*abs(h - method%step%h), 4.0_wp*eps*method%t) .and. k > 1) return
         h = h + correction
         if (abs(h - method%step%h) > longest*method%step%h) exit
         call self%end_after(varied, h, status)
         if (status /= 0) return
      end do
      if (k > most_corrections) return
      status = 1
   end subroutine end_at_section

end module step_map
