!> Runge-Kutta-Verner, order 6 with an error estimate of order 5, in the manner of DVERK and IVPRK.
!>
!> Eight stages; the weights of order 6 carry the solution, their difference to weights of order 5
!> over the first six stages estimates the local error. A step is accepted if the norm of the
!> estimate is at most TOL. The next step is 0.9 (TOL / estimate)^(1/6) times the present one, not
!> more than 4 times, not less than a tenth, and does not grow right after a rejection.
!>
!> Source: J. H. Verner, Explicit Runge-Kutta methods with estimates of the local truncation error,
!> SIAM J. Numer. Anal. 15 (1978) 772-790; Hull, Enright and Jackson, DVERK (1976), whose
!> coefficients these are. Limits: not for stiff equations.
module verner
   use event_location, only: find_first_event
   use integrator, only: advance_event, advance_failed_evaluation, advance_step, advance_too_many_evaluations, &
      advance_too_many_steps, advance_too_small, integrator_t, norm_absolute, norm_euclidean, norm_mixed, norm_relative
   use kind_info, only: kind_info_t
   use kinds, only: eps, wp
   use memory, only: get, put
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: verner_t

   real(wp), parameter :: c2 = 1.0_wp/6.0_wp, c3 = 4.0_wp/15.0_wp, c4 = 2.0_wp/3.0_wp, c5 = 5.0_wp/6.0_wp, &
      c7 = 1.0_wp/15.0_wp  !! places of the stages; c6 = c8 = 1 [1]
   real(wp), parameter :: a21 = 1.0_wp/6.0_wp, &
      a31 = 4.0_wp/75.0_wp, a32 = 16.0_wp/75.0_wp, &
      a41 = 5.0_wp/6.0_wp, a42 = -8.0_wp/3.0_wp, a43 = 5.0_wp/2.0_wp, &
      a51 = -165.0_wp/64.0_wp, a52 = 55.0_wp/6.0_wp, a53 = -425.0_wp/64.0_wp, a54 = 85.0_wp/96.0_wp, &
      a61 = 12.0_wp/5.0_wp, a62 = -8.0_wp, a63 = 4015.0_wp/612.0_wp, a64 = -11.0_wp/36.0_wp, a65 = 88.0_wp/255.0_wp, &
      a71 = -8263.0_wp/15000.0_wp, a72 = 124.0_wp/75.0_wp, a73 = -643.0_wp/680.0_wp, a74 = -81.0_wp/250.0_wp, &
      a75 = 2484.0_wp/10625.0_wp, &
      a81 = 3501.0_wp/1720.0_wp, a82 = -300.0_wp/43.0_wp, a83 = 297275.0_wp/52632.0_wp, a84 = -319.0_wp/2322.0_wp, &
      a85 = 24068.0_wp/84065.0_wp, a87 = 3850.0_wp/26703.0_wp  !! the method [1]
   real(wp), parameter :: b1 = 3.0_wp/40.0_wp, b3 = 875.0_wp/2244.0_wp, b4 = 23.0_wp/72.0_wp, b5 = 264.0_wp/1955.0_wp, &
      b7 = 125.0_wp/11592.0_wp, b8 = 43.0_wp/616.0_wp  !! weights of order 6 [1]
   real(wp), parameter :: e1 = b1 - 13.0_wp/160.0_wp, e3 = b3 - 2375.0_wp/5984.0_wp, e4 = b4 - 5.0_wp/16.0_wp, &
      e5 = b5 - 12.0_wp/85.0_wp, e6 = -3.0_wp/44.0_wp, e7 = b7, e8 = b8  !! less those of order 5 [1]

   real(wp), parameter :: safety = 0.9_wp         !! of the step that the estimate would allow [1]
   real(wp), parameter :: exponent = 1.0_wp/6.0_wp !! of the estimate, one over its order plus one [1]
   real(wp), parameter :: growth = 4.0_wp         !! greatest ratio of successive steps [1]
   real(wp), parameter :: shrinkage = 0.1_wp      !! least ratio of successive steps [1]
   real(wp), parameter :: near = 1.0e-9_wp        !! of a step: events closer than this count as one [1]
   integer, parameter :: n_newton = 12            !! re-steps towards an event
   integer, parameter :: n_halving = 60           !! halvings if these do not converge

   !> Verner's method with its workspace.
   type, extends(integrator_t) :: verner_t
      real(wp) :: h_next = 0.0_wp                   !! step to try next [s]
      real(wp) :: h_before = 0.0_wp                 !! step before a disturbance began, 0: none [s]
      real(wp), allocatable :: k(:, :)              !! (n, 2:8) derivatives of the stages; the first is step%f0 [any]
      real(wp), allocatable :: y(:)                 !! (n) state of a stage [any]
      real(wp), allocatable :: trial(:)             !! (n) state at the end of a trial step [any]
      real(wp), allocatable :: scale(:)             !! (n) error scales [any]
      real(wp), allocatable :: g0(:), rate0(:)      !! (n_event) event functions and rates at the present state [any]
      real(wp), allocatable :: g1(:), rate1(:)      !! (n_event) at the end of a trial step [any]
      real(wp), allocatable :: g(:), rate(:)        !! (n_event) elsewhere [any]
   contains
      procedure, nopass :: info => verner_info
      procedure :: start => verner_start
      procedure :: advance => verner_advance
      procedure :: restart => verner_restart
      procedure :: refine => verner_refine
      procedure :: memory_size => verner_memory_size
      procedure :: save => verner_save
      procedure :: load => verner_load
   end type verner_t

contains

   !> What the method says of itself.
   function verner_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "verner"
      info%help = "Runge-Kutta-Verner 5(6) as IMSL's IVPRK: explicit, eight stages, events by re-stepping"
      info%source = "Verner (1978); Hull, Enright and Jackson (1976)"
   end function verner_info

   !> Begin at a state: workspace, first derivative, first step.
   subroutine verner_start(self, system, t, y, t_end, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(in) :: t_end                 !! end of the integration [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      integer :: m, n

      n = system%n
      m = system%n_event
      if (.not. allocated(self%y)) then
         allocate (self%k(n, 2:8), self%y(n), self%trial(n), self%scale(n), source=0.0_wp)
         allocate (self%g0(m), self%rate0(m), self%g1(m), self%rate1(m), self%g(m), self%rate(m), source=0.0_wp)
         allocate (self%happened(m), source=0)
         allocate (self%step%y0(n), self%step%y1(n), self%step%f0(n), self%step%f1(n), self%step%inner(n, 2), &
                   self%scratch(n), source=0.0_wp)
      end if
      self%t = t
      self%step%t0 = t
      self%step%h = 0.0_wp
      self%step%y1 = y
      self%h_next = 0.0_wp
      self%h_before = 0.0_wp
      call verner_restart(self, system, 0.0_wp, status)
      if (status /= advance_step) return
      self%h_next = self%controls%initial_step
      if (self%controls%fixed_step > 0.0_wp) self%h_next = self%controls%fixed_step
      if (self%h_next <= 0.0_wp) call choose_first_step(self, system, t_end)
   end subroutine verner_start

   !> First step: where a first-order change would reach a hundredth of the scales, reduced for the tolerance.
   subroutine choose_first_step(self, system, t_end)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_end                 !! end of the integration [s]

      real(wp) :: rate
      integer :: n

      n = system%n - system%n_quadrature
      call system%weights(self%step%y1, self%scale)
      rate = maxval(abs(self%step%f1(1:n))/self%scale(1:n))
      self%h_next = 0.1_wp*(t_end - self%t)
      if (rate > 0.0_wp) self%h_next = min(self%h_next, self%controls%tolerance**exponent/rate)
   end subroutine choose_first_step

   !> Evaluate anew at the present state.
   subroutine verner_restart(self, system, step_hint, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what begins now; 0: as before [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      call system%evaluate(self%t, self%step%y1, self%step%f1, status)
      self%n_evaluations = self%n_evaluations + 1
      if (status /= 0) then
         status = advance_failed_evaluation
         return
      end if
      status = advance_step
      if (system%n_event > 0) call system%last_events(self%t, self%step%y1, self%g1, self%rate1)
      if (step_hint > 0.0_wp) then
         self%h_before = max(self%h_before, self%h_next)
         self%h_next = min(self%h_next, step_hint)
      else
         self%h_next = max(self%h_before, self%h_next)
         self%h_before = 0.0_wp
      end if
   end subroutine verner_restart

   !> Stages of a step of length h from the start of the present step; the end state into `trial`.
   subroutine make_stages(self, system, h, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: t
      integer :: i, n

      n = size(self%y)
      t = self%step%t0
      associate (y0 => self%step%y0, k1 => self%step%f0, k => self%k, y => self%y)
         self%n_evaluations = self%n_evaluations + 7
         do concurrent(i=1:n)
            y(i) = y0(i) + h*a21*k1(i)
         end do
         call system%evaluate(t + c2*h, y, k(:, 2), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a31*k1(i) + a32*k(i, 2))
         end do
         call system%evaluate(t + c3*h, y, k(:, 3), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a41*k1(i) + a42*k(i, 2) + a43*k(i, 3))
         end do
         call system%evaluate(t + c4*h, y, k(:, 4), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a51*k1(i) + a52*k(i, 2) + a53*k(i, 3) + a54*k(i, 4))
         end do
         call system%evaluate(t + c5*h, y, k(:, 5), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a61*k1(i) + a62*k(i, 2) + a63*k(i, 3) + a64*k(i, 4) + a65*k(i, 5))
         end do
         call system%evaluate(t + h, y, k(:, 6), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a71*k1(i) + a72*k(i, 2) + a73*k(i, 3) + a74*k(i, 4) + a75*k(i, 5))
         end do
         call system%evaluate(t + c7*h, y, k(:, 7), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            y(i) = y0(i) + h*(a81*k1(i) + a82*k(i, 2) + a83*k(i, 3) + a84*k(i, 4) + a85*k(i, 5) + a87*k(i, 7))
         end do
         call system%evaluate(t + h, y, k(:, 8), status)
         if (status /= 0) return
         do concurrent(i=1:n)
            self%trial(i) = y0(i) + h*(b1*k1(i) + b3*k(i, 3) + b4*k(i, 4) + b5*k(i, 5) + b7*k(i, 7) + b8*k(i, 8))
         end do
      end associate
   end subroutine make_stages

   !> Norm of the error estimate of the trial step, over the tolerance.
   real(wp) function error_norm(self, system, h) result(norm)
      class(verner_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      real(wp) :: estimate
      integer :: i, n

      n = system%n - system%n_quadrature
      select case (self%controls%norm)
      case (norm_mixed, norm_euclidean)
         self%scale(1:n) = max(abs(self%trial(1:n)), 1.0_wp)
      case (norm_absolute)
         self%scale(1:n) = 1.0_wp
      case (norm_relative)
         self%scale(1:n) = max(abs(self%trial(1:n)), self%controls%floor)
      case default
         call system%weights(self%trial, self%scale)
      end select
      norm = 0.0_wp
      do i = 1, n
         estimate = abs(e1*self%step%f0(i) + e3*self%k(i, 3) + e4*self%k(i, 4) + e5*self%k(i, 5) + e6*self%k(i, 6) &
                        + e7*self%k(i, 7) + e8*self%k(i, 8))/self%scale(i)
         if (self%controls%norm == norm_euclidean) then
            norm = norm + estimate**2
         else if (.not. estimate <= norm) then
            norm = estimate  ! a NaN comes through
         end if
      end do
      if (self%controls%norm == norm_euclidean) norm = sqrt(norm)
      norm = h*norm/self%controls%tolerance
   end function error_norm

   !> One accepted step, to an event if there is one on the way.
   subroutine verner_advance(self, system, t_stop, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: h, least, norm
      logical :: is_fixed, is_last, was_rejected

      self%n_happened = 0
      is_fixed = self%controls%fixed_step > 0.0_wp
      self%step%t0 = self%t
      self%step%y0 = self%step%y1
      self%step%f0 = self%step%f1
      self%g0 = self%g1
      self%rate0 = self%rate1
      self%step%has_inner = .false.
      was_rejected = .false.
      least = max(self%controls%minimum_step, 4.0_wp*eps*abs(self%step%t0), eps*eps*abs(t_stop))
      do
         if (self%controls%maximum_steps > 0 .and. self%n_steps >= self%controls%maximum_steps) then
            status = advance_too_many_steps
            return
         end if
         if (self%controls%maximum_evaluations > 0 .and. self%n_evaluations + 8 > self%controls%maximum_evaluations) then
            status = advance_too_many_evaluations
            return
         end if
         h = max(self%h_next, least)
         if (is_fixed) h = self%controls%fixed_step
         if (self%controls%maximum_step > 0.0_wp) h = min(h, self%controls%maximum_step)
         is_last = self%step%t0 + h*(1.0_wp + 1.0e-10_wp) >= t_stop
         if (is_last) h = t_stop - self%step%t0
         if (.not. is_last .and. merge(t_stop, self%step%t0, is_fixed) + h <= merge(t_stop, self%step%t0, is_fixed)) then
            status = advance_too_small
            return
         end if
         call make_stages(self, system, h, status)
         if (status < 0 .or. (status > 0 .and. is_fixed)) then
            status = advance_failed_evaluation
            return
         end if
         norm = huge(1.0_wp)
         if (status == 0) norm = merge(0.0_wp, error_norm(self, system, h), is_fixed)
         if (norm <= 1.0_wp) then
            ! the derivative at the end belongs to the step: without it the step is tried again, smaller
            call system%evaluate(merge(t_stop, self%step%t0 + h, is_last), self%trial, self%step%f1, status)
            self%n_evaluations = self%n_evaluations + 1
            if (status == 0) exit
            if (status < 0 .or. is_fixed) then
               status = advance_failed_evaluation
               return
            end if
            norm = huge(1.0_wp)
         end if
         self%n_rejected = self%n_rejected + 1
         was_rejected = .true.
         if (h <= least) then
            status = advance_too_small
            return
         end if
         if (norm < huge(1.0_wp)) then
            self%h_next = h*max(shrinkage, safety*norm**(-exponent))
         else
            self%h_next = h*shrinkage
         end if
      end do
      if (.not. is_fixed) call choose_next_step(self, h, norm, was_rejected, is_last)
      self%step%h = h
      self%t = merge(t_stop, self%step%t0 + h, is_last)
      self%step%y1 = self%trial
      call finish_step(self, system, status)
   end subroutine verner_advance

   !> Length of the next step. A step cut short by the end of a stretch says little about it.
   pure subroutine choose_next_step(self, h, norm, was_rejected, is_last)
      class(verner_t), intent(inout) :: self  !! the integrator
      real(wp), intent(in) :: h               !! length of the accepted step [s]
      real(wp), intent(in) :: norm            !! norm of its error estimate over the tolerance [1]
      logical, intent(in) :: was_rejected     !! after a rejection
      logical, intent(in) :: is_last          !! cut short

      real(wp) :: wanted

      wanted = h*min(merge(1.0_wp, growth, was_rejected), safety*max(norm, tiny(1.0_wp))**(-exponent))
      if (is_last) then
         self%h_next = max(self%h_next, wanted)
      else
         self%h_next = wanted
      end if
   end subroutine choose_next_step

   !> Events within the step.
   subroutine finish_step(self, system, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: high, low
      integer :: event

      self%n_steps = self%n_steps + 1
      status = advance_step
      if (system%n_event == 0) return
      call system%last_events(self%t, self%step%y1, self%g1, self%rate1)
      call find_first_event(system, self%step, self%g0, self%rate0, self%g1, self%rate1, self%scratch, self%g, self%rate, &
                            event, low, high)
      if (event == 0) return
      call step_to_event(self, system, event, low, high, status)
   end subroutine finish_step

   !> Shorten the step so that it ends at an event: Newton's iteration on its length, each time by
   !> the method itself; halving if that does not converge.
   subroutine step_to_event(self, system, event, low, high, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(in) :: event                  !! the event function, by the interpolant
      real(wp), intent(in) :: low                   !! place before it, by the interpolant [1]
      real(wp), intent(in) :: high                  !! place after it [1]
      integer, intent(out) :: status                !! advance_step if there is none after all, advance_event, or a failure

      real(wp) :: before, full, h, h_before, h_high, h_low, h_new
      integer :: first, i
      logical :: is_found

      first = event
      full = self%step%h
      h = 0.5_wp*(low + high)*full
      before = huge(1.0_wp)
      h_before = h
      is_found = .false.
      do i = 1, n_newton
         call make_stages(self, system, h, status)
         if (status /= 0) exit
         call system%events(self%step%t0 + h, self%trial, self%g, self%rate)
         if (self%rate(first) <= 0.0_wp) exit
         h_new = h - self%g(first)/self%rate(first)
         ! at round-off the function no longer falls
         is_found = abs(h_new - h) <= near*full .and. abs(self%g(first)) >= 0.25_wp*before
         is_found = is_found .or. abs(h_new - h) <= eps*h
         if (is_found .or. h_new <= 0.0_wp .or. h_new > 1.5_wp*full) exit
         before = abs(self%g(first))
         h_before = h
         h = h_new
      end do
      if (is_found .and. abs(self%g(first)) > before) then
         h = h_before  ! the last correction was noise
         call make_stages(self, system, h, status)
         is_found = status == 0
         if (is_found) call system%events(self%step%t0 + h, self%trial, self%g, self%rate)
      end if
      ! another function that became positive clearly earlier?
      if (is_found) is_found = .not. any(self%g > near*full*abs(self%rate) .and. [(i /= first, i=1, size(self%g))])
      if (.not. is_found) then
         ! a grazing contact, or another function comes first: halve between "none positive" and "one positive"
         h_low = 0.0_wp
         h_high = high*full
         call make_stages(self, system, h_high, status)
         if (status == 0) call system%events(self%step%t0 + h_high, self%trial, self%g, self%rate)
         if (status == 0 .and. all(self%g <= 0.0_wp)) then
            h_high = full
            if (all(self%g1 <= 0.0_wp)) then
               ! the interpolant's maximum was not there: the whole step stands
               call system%evaluate(self%t, self%step%y1, self%step%f1, status)
               self%n_evaluations = self%n_evaluations + 1
               status = merge(advance_step, advance_failed_evaluation, status == 0)
               return
            end if
         end if
         do i = 1, n_halving
            h = 0.5_wp*(h_low + h_high)
            if (h_high - h_low <= eps*abs(self%step%t0 + h)) exit
            call make_stages(self, system, h, status)
            if (status /= 0) exit
            call system%events(self%step%t0 + h, self%trial, self%g, self%rate)
            if (any(self%g > 0.0_wp)) then
               h_high = h
            else
               h_low = h
            end if
         end do
         h = h_high
         if (status == 0) call make_stages(self, system, h, status)
         if (status == 0) call system%events(self%step%t0 + h, self%trial, self%g, self%rate)
         first = maxloc(self%g, dim=1)
      end if
      if (status /= 0) then
         status = advance_failed_evaluation
         return
      end if
      self%step%h = h
      self%t = self%step%t0 + h
      self%step%y1 = self%trial
      self%n_happened = 1
      self%happened(1) = first
      call system%evaluate(self%t, self%step%y1, self%step%f1, status)
      self%n_evaluations = self%n_evaluations + 1
      status = merge(advance_event, advance_failed_evaluation, status == 0)
   end subroutine step_to_event

   !> State within the last step by a shorter step of the method.
   subroutine verner_refine(self, system, s, y, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)                 !! (n) state [any]
      integer, intent(out) :: status                !! advance_step, or a failure

      call make_stages(self, system, s*self%step%h, status)
      if (status /= 0) then
         status = advance_failed_evaluation
         return
      end if
      status = advance_step
      y = self%trial
   end subroutine verner_refine

   !> Numbers that a checkpoint needs.
   integer function verner_memory_size(self) result(n)
      class(verner_t), intent(in) :: self  !! the integrator

      n = self%base_memory_size() + 2 + 2*size(self%g1)
   end function verner_memory_size

   !> Write what the integrator remembers.
   subroutine verner_save(self, row, place)
      class(verner_t), intent(in) :: self   !! the integrator
      real(wp), intent(inout) :: row(:)     !! (any) checkpoint [any]
      integer, intent(inout) :: place       !! last place used

      call self%save_base(row, place)
      call put(row, place, [self%h_next, self%h_before])
      call put(row, place, self%g1)
      call put(row, place, self%rate1)
   end subroutine verner_save

   !> Read what the integrator remembers.
   subroutine verner_load(self, row, place)
      class(verner_t), intent(inout) :: self  !! the integrator
      real(wp), intent(in) :: row(:)          !! (any) checkpoint [any]
      integer, intent(inout) :: place         !! last place used

      call self%load_base(row, place)
      call get(row, place, self%h_next)
      call get(row, place, self%h_before)
      call get(row, place, self%g1)
      call get(row, place, self%rate1)
   end subroutine verner_load

end module verner
