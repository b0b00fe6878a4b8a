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

   real(wp), parameter :: hopeless = 100.0_wp  !! error over the one allowed, above which a full set of nodes is of no use [1]
   integer, parameter :: most_residuals = 3    !! of a row by the polynomial
   real(wp), parameter :: falls = 0.5_wp       !! ratio of an error to the one before, at most, where corrections help [1]

contains

   !> No evaluations, or those of stages of another length.
   module procedure radau_prepare_output
      status = 0
      if (self%step%h <= 0.0_wp .or. has_stages(self, self%step)) return
      self%count%n_output_evaluations = self%count%n_output_evaluations - self%count%n_evaluations
      call self%refine(system, 1.0_wp, self%y, status)
      self%count%n_output_evaluations = self%count%n_output_evaluations + self%count%n_evaluations
   end procedure radau_prepare_output

   !> Film forces amplify errors of interpolated states. The polynomial through the nodes gives the row if its residual is small.
   !> Else nodes are added where they lie far apart, and in the end the row itself becomes one, by a step of that length.
   module procedure radau_reach
      logical :: is_given
      integer :: status

      if ((self%is_stiff .or. system%traits%has_films) .and. t > self%step%t0 .and. t < self%t) then
         self%count%n_output_evaluations = self%count%n_output_evaluations - self%count%n_evaluations
         call reach_by_nodes(self, system, t, y, is_given)
         self%count%n_output_evaluations = self%count%n_output_evaluations + self%count%n_evaluations
         if (is_given) return
      end if
      if (t < self%t) call self%prepare_output(system, status)
      call self%state_at(system, t, y)
   end procedure radau_reach

   !> State at a time within the last step by the polynomial through the nodes, or by a step of that length.
   subroutine reach_by_nodes(self, system, t, y, is_given)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(:)               !! (n) state [any]
      logical, intent(out) :: is_given              !! whether one of them has given it

      real(wp) :: error, place, s
      integer :: status

      s = (t - self%step%t0)/self%step%h
      call self%nodes%begin(self%step, with_rates=.not. self%is_stiff)
      call self%nodes%has_row(s, y, is_given)
      if (is_given) return
      do
         error = huge(1.0_wp)
         if (self%nodes%are_of_use) call interpolate_nodes(self, system, t, y, error)
         is_given = error <= 1.0_wp
         if (is_given) exit
         place = s
         if (self%nodes%are_of_use) place = self%nodes%place_for(s)
         if (abs(place - s) > 0.0_wp) then
            call make_node(self, system, place, y, status)
            if (status == advance_step) cycle
         end if
         self%nodes%are_of_use = self%nodes%are_of_use .and. (error <= hopeless .or. .not. self%nodes%is_full())
         call make_node(self, system, s, y, status)
         is_given = status == advance_step
         exit
      end do
      if (is_given) call self%nodes%keep_row(s, y)
   end subroutine reach_by_nodes

   !> State at a time within the last step by the polynomial through the nodes. The residual f - y' there, filtered, estimates its
   !> error. Of what decays fast this is the error itself: it is added as long as that makes the residual smaller.
   subroutine interpolate_nodes(self, system, t, y, error)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(:)               !! (n) state [any]
      real(wp), intent(out) :: error                !! over the error that a row may have [1]

      real(wp) :: before
      integer :: i, k, status

      error = huge(1.0_wp)
      associate (f => self%scratch, f_here => self%y)
         call self%nodes%interpolate(self%step, (t - self%step%t0)/self%step%h, y, f)
         do k = 1, most_residuals
            before = error
            status = 0
            if (system%holds) call system%hold(t, y, status)
            self%count%n_evaluations = self%count%n_evaluations + 1
            if (status == 0) call system%evaluate(t, y, f_here, status)
            if (status == 0) then
               do i = 1, self%n
                  self%side(i) = f_here(i) - f(i)
               end do
               call filter_residual(self, system, error, status)
            end if
            if (status /= 0) error = huge(1.0_wp)
            if (error <= 1.0_wp .or. error > falls*before .or. status /= 0) return
            do i = 1, self%n
               y(i) = y(i) + self%change(i)
            end do
         end do
      end associate
   end subroutine interpolate_nodes

   !> State within the last step by a shorter step; it becomes a node. Restores what the next step depends on.
   subroutine make_node(self, system, s, y, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: s                     !! its place, 0 to 1 [1]
      real(wp), intent(inout) :: y(:)               !! (n) state [any]
      integer, intent(out) :: status                !! advance_step, or a failure

      real(wp) :: contraction
      logical :: is_stale

      contraction = self%contraction
      is_stale = self%is_stale
      self%is_row = .true.
      call self%refine(system, s, y, status)
      self%is_row = .false.
      self%contraction = contraction
      self%is_stale = is_stale
      if (status /= advance_step .or. .not. self%nodes%are_of_use) return
      if (self%is_stiff) then  ! the polynomial has states only
         call self%nodes%add(s, y)
         return
      end if
      self%count%n_evaluations = self%count%n_evaluations + 1
      call system%evaluate(self%step%t0 + s*self%step%h, y, self%scratch, status)
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
