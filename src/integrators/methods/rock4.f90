!> Orthogonal Runge-Kutta-Chebyshev method of order 4: an explicit method for what dampers and films make stiff.
!>
!> A step has as many stages s as the fastest decay asks for: its stability reaches to -0.35 s^2 along the negative real axis, so
!> that the work grows with the square root of the stiffness, and no Jacobian is needed. A recurrence of s - 4 stages is followed
!> by four stages of a Runge-Kutta method (`rock4_stages`):
!>
!> $$ g_j = \mu_j h f(g_{j-1}) + \nu_j g_{j-1} + \kappa_j g_{j-2}, k_i = f(g_m + h \sum a_{ij} k_j), y_1 = g_m + h \sum b_i k_i $$
!>
!> The fastest decay is the spectral radius of the Jacobian, found anew after every event, every 25 steps and after a step that
!> was rejected (`spectral_radius`). Parts of a step, in search of an event, have the degree of the whole.
!>
!> Error: the combination of the last five derivatives that vanishes up to order 3. That says little of what is over early in a
!> step: one that starts in a contact and continues far beyond its end has all five behind it. So the part of a step that ends at an
!> event is tested as well, and the step is repeated, shorter, if that has too great an error.
!> Between the ends of a step: the quintic of `interpolation`, without evaluations within the step, which stiff forces would make
!> worse. Rows of a step in which something decays, and where films act, are reached by a step of that length from its start
!> (`rock4_reach`).
!>
!> Source: A. Abdulle, Fourth order Chebyshev methods with recurrence relation, SIAM J. Sci. Comput. 23 (2002) 2041-2054, with
!> coefficients of our own. Limits: stiff springs that no damper goes with are followed, not damped: their steps are those of
!> other explicit methods.
module rock4
   use integrator, only: advance_event, advance_step
   use integrator_controls, only: norm_euclidean, onset_located
   use integration_method, only: abilities_t
   use kind_info, only: kind_info_t
   use kinds, only: eps, wp
   use archive, only: archive_t
   use ode_system, only: ode_system_t
   use one_step, only: one_step_advance, one_step_load, one_step_restart, one_step_save, &
      one_step_t
   use quadrature_error, only: by_one_step, counts_quadratures, max_error
   use rock4_stages, only: end_coefficients, estimate_coefficients, find_recurrence, min_degree, longest_stretch, most_stages, &
      n_recurrence, recurrence
   use spectral_radius, only: find_radius, most_iterations
   use diverged_stages, only: judge_stage
   implicit none (type, external)
   private
   public :: rock4_t

   integer, parameter :: n_step_radius = 25   !! steps after which the spectral radius is found anew
   real(wp), parameter :: smooth = 1.0_wp     !! product of step and spectral radius up to which curves follow the motion [1]

   !> The method with its workspace.
   type, extends(one_step_t) :: rock4_t
      private
      real(wp), allocatable :: g(:, :)              !! (n, 2) last states of the recurrence [any]
      real(wp), allocatable :: k(:, :)              !! (n, 0:4) last derivative of the recurrence, and those of the end [any]
      real(wp), allocatable :: y(:)                 !! (n) state of a stage [any]
      integer :: degree = 0                         !! number of the degree of the step in hand
      ! the spectral radius
      real(wp), allocatable :: direction(:)         !! (n) of the fastest change [any]
      real(wp) :: radius = 0.0_wp                   !! the radius [1/s]
      real(wp) :: t_radius = -huge(1.0_wp)          !! start of the step that it was found at [s]
      real(wp) :: t_step = -huge(1.0_wp)            !! start of the step in hand [s]
      integer :: age = n_step_radius                !! steps since it was found
   contains
      procedure, nopass :: info => rock4_info
      procedure, nopass :: abilities => rock4_abilities
      procedure :: prepare => rock4_prepare
      procedure :: restart => rock4_restart
      procedure :: advance => rock4_advance
      procedure :: make_stages => rock4_make_stages
      procedure :: error_norm => rock4_error_norm
      procedure :: prepare_output => rock4_prepare_output
      procedure :: reach => rock4_reach
      procedure :: save => rock4_save
      procedure :: load => rock4_load
   end type rock4_t

contains

   !> Description of the method.
   function rock4_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "rock4"
      info%help = "Runge-Kutta-Chebyshev of order 4, explicit: for stiffness from dampers and films, with a " &
                  //"variable number of stages"
      info%source = "Abdulle (2002)"
   end function rock4_info

   !> What decays fast does not keep its steps short.
   pure type(abilities_t) function rock4_abilities() result(can)
      can = abilities_t(is_explicit=.false.)
   end function rock4_abilities

   !> Storage for the stages.
   subroutine rock4_prepare(self, n)
      class(rock4_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n               !! entries of the state

      self%order = 4
      self%n_new_stage = most_stages + most_iterations + 1
      if (.not. allocated(self%g)) allocate (self%g(n, 2), self%k(n, 0:4), self%y(n), self%direction(n), source=0.0_wp)
   end subroutine rock4_prepare

   !> Evaluate anew at the present state: what decays fastest may be another.
   subroutine rock4_restart(self, system, step_hint, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      self%age = n_step_radius
      call one_step_restart(self, system, step_hint, status)
   end subroutine rock4_restart

   !> One accepted step, to an event if there is one on the way: the part up to it is within the tolerance too.
   subroutine rock4_advance(self, system, t_stop, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: h_event, norm

      h_event = self%pace%h_event
      do
         call one_step_advance(self, system, t_stop, status)
         if (status /= advance_event .or. self%controls%fixed_step > 0.0_wp .or. self%controls%onset /= onset_located) return
         norm = self%error_norm(system, self%step%h)
         if (norm <= 1.0_wp .or. self%step%h <= max(self%controls%minimum_step, 4.0_wp*eps*abs(self%step%t0))) return
         self%count%n_steps = self%count%n_steps - 1
         self%count%n_rejected = self%count%n_rejected + 1
         call self%pace%reject(self%step%h, min(norm, huge(1.0_wp)))
         self%pace%h_event = h_event
         self%t = self%step%t0
         self%step%y1 = self%step%y0
         self%step%f1 = self%step%f0
         self%events%g1 = self%events%g0
         self%events%rate1 = self%events%rate0
      end do
   end subroutine rock4_advance

   !> Stages of a step of length h from the start of the present step; the end state into `trial`.
   subroutine rock4_make_stages(self, system, h, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: c(10), t
      integer :: j, m, n

      status = 0
      if (self%t <= self%step%t0) call choose_degree(self, system, h, status)  ! else a part of the step
      if (status /= 0) return
      n = size(self%y)
      m = n_recurrence(self%degree)
      t = self%step%t0
      self%count%n_evaluations = self%count%n_evaluations + m + 3
      call recur(self, system, h, m, status)
      if (status /= 0) return
      c = end_coefficients(self%degree)
      t = t + h*recurrence(4, m, self%degree)
      associate (g => self%g(:, 1), k => self%k, y => self%y)
         call system%evaluate(t, g, k(:, 1), status)
         call judge_stage(n, k(:, 1), status)
         if (status /= 0) return
         do concurrent(j=1:n)
            y(j) = g(j) + h*c(1)*k(j, 1)
         end do
         call system%evaluate(t + h*c(1), y, k(:, 2), status)
         call judge_stage(n, k(:, 2), status)
         if (status /= 0) return
         do concurrent(j=1:n)
            y(j) = g(j) + h*(c(2)*k(j, 1) + c(3)*k(j, 2))
         end do
         call system%evaluate(t + h*(c(2) + c(3)), y, k(:, 3), status)
         call judge_stage(n, k(:, 3), status)
         if (status /= 0) return
         do concurrent(j=1:n)
            y(j) = g(j) + h*(c(4)*k(j, 1) + c(5)*k(j, 2) + c(6)*k(j, 3))
         end do
         call system%evaluate(t + h*(c(4) + c(5) + c(6)), y, k(:, 4), status)
         call judge_stage(n, k(:, 4), status)
         if (status /= 0) return
         do concurrent(j=1:n)
            self%trial(j) = g(j) + h*(c(7)*k(j, 1) + c(8)*k(j, 2) + c(9)*k(j, 3) + c(10)*k(j, 4))
         end do
      end associate
   end subroutine rock4_make_stages

   !> The recurrence: its last state into g(:, 1), the last derivative into k(:, 0).
   subroutine recur(self, system, h, m, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(in) :: m                      !! states of the recurrence
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: new
      integer :: i, j

      status = 0
      associate (c => recurrence(:, :, self%degree), y0 => self%step%y0, g => self%g, f => self%k(:, 0))
         f = self%step%f0
         do concurrent(i=1:size(y0))
            g(i, 2) = y0(i)
            g(i, 1) = y0(i) + h*c(1, 1)*f(i)
         end do
         do j = 2, m
            call system%evaluate(self%step%t0 + h*c(4, j - 1), g(:, 1), f, status)
            call judge_stage(size(f), f, status)
            if (status /= 0) return
            do i = 1, size(y0)
               new = h*c(1, j)*f(i) + c(2, j)*g(i, 1) + c(3, j)*g(i, 2)
               g(i, 2) = g(i, 1)
               g(i, 1) = new
            end do
         end do
      end associate
   end subroutine recur

   !> The degree of a step, with the spectral radius if that is due: after a while, or where a step from here was rejected.
   subroutine choose_degree(self, system, h, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! 0 done, > 0 retry with a smaller step, < 0 give up

      integer :: n_evaluation

      status = 0
      associate (step => self%step)
         if (self%t_step < step%t0) then
            self%age = self%age + 1
            self%t_step = step%t0
         else if (self%t_radius < step%t0) then
            self%age = n_step_radius
         end if
         if (self%age >= n_step_radius) then
            call self%set_scales(system, step%y0)
            ! differences from the state itself: behind a force that jumps there the derivative is another
            call system%evaluate(step%t0, step%y0, self%k(:, 2), status)
            self%count%n_evaluations = self%count%n_evaluations + 1
            if (status /= 0) return
            call find_radius(system, step%t0, step%y0, self%k(:, 2), self%scale, self%direction, self%y, self%k(:, 1), &
                             self%radius, n_evaluation, status)
            self%count%n_evaluations = self%count%n_evaluations + n_evaluation
            if (status /= 0) return
            self%age = 0
            self%t_radius = step%t0
            self%pace%h_most = longest_stretch()/max(self%radius, tiny(1.0_wp))
         end if
      end associate
      self%degree = min_degree(h*self%radius)
      if (self%degree > 0) then
         call find_recurrence(self%degree)
      else
         status = 1
      end if
   end subroutine choose_degree

   !> Norm of the error estimate of the trial step, over the tolerance.
   real(wp) function rock4_error_norm(self, system, h) result(norm)
      class(rock4_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      real(wp) :: e(0:4), estimate
      integer :: i

      call self%set_scales(system, self%trial)
      e = estimate_coefficients(self%degree)
      norm = 0.0_wp
      do i = 1, system%n - system%n_quadrature
         estimate = abs(e(0)*self%k(i, 0) + e(1)*self%k(i, 1) + e(2)*self%k(i, 2) + e(3)*self%k(i, 3) + e(4)*self%k(i, 4)) &
                    /self%scale(i)
         if (self%controls%norm == norm_euclidean) then
            norm = norm + estimate**2
         else if (.not. estimate <= norm) then
            norm = estimate  ! a NaN comes through
         end if
      end do
      if (self%controls%norm == norm_euclidean) norm = sqrt(norm)
      norm = h*norm/self%controls%tolerance
      if (counts_quadratures(system, norm)) norm = max(norm, quadrature_norm(self, system, h))
   end function rock4_error_norm

   !> Norm of the error estimates of the quadratures.
   real(wp) function quadrature_norm(self, system, h) result(norm)
      class(rock4_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      real(wp) :: e(0:4)
      integer :: i, n

      n = system%n - system%n_quadrature
      e = h/self%controls%tolerance*estimate_coefficients(self%degree)
      do i = 1, system%n_quadrature
         self%scratch(n + i) = e(0)*self%k(n + i, 0) + e(1)*self%k(n + i, 1) + e(2)*self%k(n + i, 2) + e(3)*self%k(n + i, 3) &
                    + e(4)*self%k(n + i, 4)
      end do
      norm = max_error(system%n_quadrature, self%scratch(n + 1:), system%traits%quadrature_scale, by_one_step)
   end function quadrature_norm

   !> No evaluations within the step.
   subroutine rock4_prepare_output(self, system, status)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! 0

      status = 0
   end subroutine rock4_prepare_output

   !> State at a time in the last step. Accelerations at its ends carry no information of what decays within it, and films
   !> multiply what a curve is wrong by: then by a step of that length.
   subroutine rock4_reach(self, system, t, y)
      class(rock4_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(system%n)        !! (n) state [any]

      integer :: status

      if (t > self%step%t0 .and. t < self%t .and. (self%step%h*self%radius > smooth .or. system%traits%has_films)) then
         self%count%n_output_evaluations = self%count%n_output_evaluations - self%count%n_evaluations
         call self%refine(system, (t - self%step%t0)/self%step%h, y, status)
         self%count%n_output_evaluations = self%count%n_output_evaluations + self%count%n_evaluations
         if (status == advance_step) return
      end if
      call self%state_at(system, t, y)
   end subroutine rock4_reach

   !> Write what the integrator remembers.
   subroutine rock4_save(self, archive)
      class(rock4_t), intent(in) :: self         !! the integrator
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      call one_step_save(self, archive)
      call archive%put([self%radius, self%t_radius, self%t_step, self%pace%h_most])
      call archive%put(self%age)
      call archive%put(self%direction)
   end subroutine rock4_save

   !> Read what the integrator remembers.
   subroutine rock4_load(self, archive)
      class(rock4_t), intent(inout) :: self      !! the integrator
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      call one_step_load(self, archive)
      call archive%get(self%radius)
      call archive%get(self%t_radius)
      call archive%get(self%t_step)
      call archive%get(self%pace%h_most)
      call archive%get(self%age)
      call archive%get(self%direction)
   end subroutine rock4_load

end module rock4
