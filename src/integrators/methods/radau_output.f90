!> States of Radau IIA between the ends of a step.
!>
!> The quintic of `interpolation` takes the accelerations at both ends. In a film of a thousandth of its clearance these are the
!> product of a damping of 1e11 N.s/m and of what is left of the iteration: a curve with them leaves the clearance between
!> two states that are within it. There the positions are the integral of the cubic through their derivatives at the start and
!> at the stages, of order 5, and the rates are the collocation polynomial itself, of order 3.
!> Source: Hairer and Wanner (1996), section IV.8.
submodule(radau) radau_output
   use interpolation, only: interpolate
   implicit none (type, external)

   real(wp), parameter :: hopeless = 100.0_wp  !! error over the one allowed, above which more nodes are not tried [1]

contains

   !> No evaluations, or those of stages of another length.
   module procedure radau_prepare_output
      status = 0
      if (self%step%h <= 0.0_wp .or. has_stages(self, self%step)) return
      self%count%n_output_evaluations = self%count%n_output_evaluations - self%count%n_evaluations
      call self%refine(system, 1.0_wp, self%y, status)
      self%count%n_output_evaluations = self%count%n_output_evaluations + self%count%n_evaluations
   end procedure radau_prepare_output

   !> Film forces amplify errors of interpolated states. The Hermite polynomial gives the row if its residual is small; else a step
   !> of that length does, whose end becomes another node.
   module procedure radau_reach
      logical :: is_accurate
      integer :: status

      if ((self%is_stiff .or. system%traits%has_films) .and. t > self%step%t0 .and. t < self%t) then
         self%count%n_output_evaluations = self%count%n_output_evaluations - self%count%n_evaluations
         call self%nodes%begin(self%step)
         status = advance_step
         is_accurate = .false.
         if (self%nodes%are_of_use) call interpolate_nodes(self, system, t, y, is_accurate)
         if (.not. is_accurate) call make_node(self, system, t, y, status)
         self%count%n_output_evaluations = self%count%n_output_evaluations + self%count%n_evaluations
         if (status == advance_step) return
      end if
      if (t < self%t) call self%prepare_output(system, status)
      call self%state_at(system, t, y)
   end procedure radau_reach

   !> State at a time within the last step by the Hermite polynomial. It is accurate if its error, estimated by the residual f - y',
   !> is at most that which Newton's iteration may leave in a row.
   subroutine interpolate_nodes(self, system, t, y, is_accurate)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(:)               !! (n) state [any]
      logical, intent(out) :: is_accurate           !! whether it is

      real(wp) :: error
      integer :: i, status

      is_accurate = .false.
      associate (f => self%scratch, f_here => self%y)
         call self%nodes%interpolate(self%step, (t - self%step%t0)/self%step%h, y, f)
         status = 0
         if (system%holds) call system%hold(t, y, status)
         self%count%n_evaluations = self%count%n_evaluations + 1
         if (status == 0) call system%evaluate(t, y, f_here, status)
         if (status /= 0) return
         do i = 1, self%n
            self%side(i) = f_here(i) - f(i)
         end do
      end associate
      call filter_residual(self, system, error, status)
      is_accurate = status == 0 .and. error <= 1.0_wp
      self%nodes%are_of_use = is_accurate .or. error <= hopeless
   end subroutine interpolate_nodes

   !> State at a time within the last step by a step of that length; it becomes a node. Restores what the next step depends on.
   subroutine make_node(self, system, t, y, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(:)               !! (n) state [any]
      integer, intent(out) :: status                !! advance_step, or a failure

      real(wp) :: contraction, s
      logical :: is_stale

      s = (t - self%step%t0)/self%step%h
      contraction = self%contraction
      is_stale = self%is_stale
      self%is_row = .true.
      call self%refine(system, s, y, status)
      self%is_row = .false.
      self%contraction = contraction
      self%is_stale = is_stale
      if (status /= advance_step .or. .not. self%nodes%are_of_use) return
      self%count%n_evaluations = self%count%n_evaluations + 1
      call system%evaluate(t, y, self%scratch, status)
      if (status == 0) call self%nodes%add(s, y, self%scratch)
      status = advance_step
   end subroutine make_node

   !> Whether the derivatives at hand are those of the last step.
   pure logical function has_stages(self, step)
      class(radau_t), intent(in) :: self  !! the integrator
      type(step_t), intent(in) :: step    !! the last step

      has_stages = abs(self%stage%t - step%t0) <= 0.0_wp .and. abs(self%stage%h - step%h) <= 0.0_wp
   end function has_stages

   !> Of the step in hand.
   module procedure radau_within
      call self%within_step(self%step, system, s, y)
   end procedure radau_within

   !> By the quintic, the cubics, or the stages.
   module procedure radau_within_step
      real(wp) :: p(0:3), q(3)
      integer :: first, i, n

      n = system%n
      if (.not. system%traits%with_quadratures) n = n - system%n_quadrature
      call interpolate(step, system%n_position, system%traits%n_turning, s, n, y)
      if (.not. has_stages(self, step)) return
      p = integrals(s)
      first = 2*system%n_position - system%traits%n_turning + 1
      if (self%is_stiff) then
         q = [s*(s - c(2))*(s - c(3))/(c(1)*(c(1) - c(2))*(c(1) - c(3))), &
              s*(s - c(1))*(s - c(3))/(c(2)*(c(2) - c(1))*(c(2) - c(3))), &
              s*(s - c(1))*(s - c(2))/(c(3)*(c(3) - c(1))*(c(3) - c(2)))]
         do i = system%n_position + 1, first - 1
            y(i) = step%y0(i) + q(1)*self%z(i, 1) + q(2)*self%z(i, 2) + q(3)*self%z(i, 3)
         end do
      end if
      associate (f => self%stage%f)
         do i = 1, n
            if (i < first .and. .not. (self%is_stiff .and. i <= system%n_position)) cycle
            y(i) = step%y0(i) + step%h*(p(0)*step%f0(i) + p(1)*f(i, 1) + p(2)*f(i, 2) + p(3)*f(i, 3))
         end do
      end associate
   end procedure radau_within_step

   !> Integrals from 0 to s of the cubics of Lagrange through 0 and the places of the stages.
   pure function integrals(s) result(p)
      real(wp), intent(in) :: s  !! place in the step [1]
      real(wp) :: p(0:3)         !! (0:3) the integrals [1]

      real(wp), parameter :: places(0:3) = [0.0_wp, c]
      real(wp) :: others(3)
      integer :: k

      do k = 0, 3
         others = pack(places, [0, 1, 2, 3] /= k)
         p(k) = s*(-product(others) + s*(0.5_wp*(others(1)*others(2) + others(1)*others(3) + others(2)*others(3)) &
                                         + s*(-sum(others)/3.0_wp + s*0.25_wp)))/product(places(k) - others)
      end do
   end function integrals

end submodule radau_output
