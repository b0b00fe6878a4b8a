!> How a small change of a motion is carried along: the tangent of its flow, through events too.
!>
!> Between events the change w of the state y obeys the variational equation
!> $$ w' = \frac{\partial f}{\partial y} w + \frac{\partial f}{\partial u} w_u, \quad w_u' = 0, $$
!> u the impact speeds that contacts remember. The products are central differences of the mechanism's own right-hand side beside
!> the interpolant of each step; w goes from end to end of it by the classical Runge-Kutta method, in as many parts as it takes.
!> Forces may jump at events, and these are at the ends of steps: there the products are those a thousandth of the step inside, and
!> the states beside are so near that the event is not between; of steps too short for that, those at the time from which on it is
!> not, before the event or behind it.
!> What happens at events and instants is in `tangent_events`. Directions that constraints forbid, and those that are no motion (the
!> length of Euler parameters, which does not decay as changes of a damped motion do), are taken away by `project`.
!>
!> Lengths: |w_q| is the maximum of the changes of positions over the scales of the error norm, |w_v| that of rates.
!> Source: P. C. Mueller, Chaos, Solitons & Fractals 5 (1995) 1671-1681 (exponents of systems that are not smooth).
!> Limits: one direction, which tends to that of the largest exponent; kinks of laws within a part are passed over.
module tangent
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: tangent_t

   real(wp), parameter :: nearness = 1.0e-9_wp   !! of the positions beside the motion, of the scales [1]
   real(wp), parameter :: rate_nearness = 1.0e-5_wp  !! of the rates there: while a stiff contact lasts, rates change most [1]
   real(wp), parameter :: allowed = 1.0e-5_wp    !! error of w over a step, of its length [1]
   integer, parameter :: most_parts = 64         !! of a step
   real(wp), parameter :: edge = 1.0e-3_wp       !! of a step, at both ends: no states beside are looked at there [1]
   real(wp), parameter :: slow = 0.01_wp         !! speed that takes a contact away from its event, of the mechanism's [1]
   real(wp), parameter :: nearest = 1.0e-13_wp   !! of these states, however near an event is [1]

   !> A direction that goes along with a motion.
   type :: tangent_t
      real(wp), allocatable :: w(:)         !! (n) change of the state, over exp(level); none of quadratures [any]
      real(wp), allocatable :: impact(:)    !! (contacts) change of the impact speeds of those that touch, over exp(level) [m/s]
      real(wp), allocatable :: scale(:)     !! (positions + rates) what lengths are measured by [any]
      real(wp) :: level = 0.0_wp            !! ln of what the change was divided by so far [1]
      real(wp) :: t_event = -huge(1.0_wp)   !! time of the last event [s]
      integer :: n_crossed = 0              !! events with a jump of their own
      integer :: n_grazed = 0               !! events that were passed as if nothing jumped: their functions hardly rise
      integer :: n_together = 0             !! instants of several events, of which the first one counts
      integer, private :: parts = 1         !! parts of a step
      real(wp), private :: min_rate = 0.0_wp  !! that rates are measured by at least [1/s]
      real(wp), allocatable :: minus(:), plus(:)      !! (n) scratch: of the states beside [any]
      real(wp), allocatable :: speed(:)               !! (contacts) scratch: impact speeds [m/s]
      real(wp), allocatable, private :: y(:), once(:), twice(:)  !! (n) scratch [any]
      real(wp), allocatable, private :: k(:, :)       !! (n, 4) scratch: rates of w [any]
   contains
      procedure :: begin
      procedure :: follow
      procedure :: project
      procedure :: renew
      procedure :: lengths
      procedure :: pace
      procedure :: beside
      procedure :: part_of
      procedure :: take_speeds
      procedure :: give_speeds
   end type tangent_t

contains

   !> Start with a direction in which everything that is free takes part.
   subroutine begin(self, system, method, min_rate, status)
      class(tangent_t), intent(inout) :: self       !! the direction
      type(mechanism_t), intent(inout) :: system    !! the system, at the start
      class(integrator_t), intent(in) :: method     !! the integrator, started
      real(wp), intent(in) :: min_rate            !! that rates are measured by, of mechanisms that hardly move [1/s]
      integer, intent(out) :: status                !! 0: done; else nothing is free, or the equations cannot be solved

      real(wp), parameter :: irrational = 0.618033988749895_wp  ! parts of its multiples are spread evenly [1]
      real(wp), parameter :: minimum = 1.0e-5_wp                  ! of a direction, that constraints leave if anything is free [1]
      integer :: i, m, n

      n = system%n
      m = n - system%n_quadrature
      self%min_rate = min_rate
      allocate (self%w(n), self%y(n), self%once(n), self%twice(n), self%minus(n), self%plus(n), source=0.0_wp)
      allocate (self%k(n, 4), self%impact(system%clearance_joints%n_contact), self%speed(system%clearance_joints%n_contact), &
                source=0.0_wp)
      call system%weights(method%step%y1, self%plus)
      self%scale = self%plus(:system%linkage%n_position + system%linkage%n_rate)
      associate (nq => system%linkage%n_position)
         self%scale(nq + 1:) = self%scale(nq + 1:)*(maxval(self%scale(:nq))/maxval(self%scale(nq + 1:)))
         do i = 1, size(self%scale)
            self%w(i) = self%scale(i)*(0.5_wp + modulo(i*irrational, 1.0_wp))
            if (i > nq) self%w(i) = self%w(i)*self%pace(system)
         end do
      end associate
      status = merge(0, 1, m > 0)
      if (status /= 0) return
      call self%renew(system)
      call self%project(system, method, status)
      self%level = 0.0_wp
      call self%renew(system)
      if (.not. self%level > log(minimum) .or. .not. any(abs(self%w) > 0.0_wp)) status = 1
      self%level = 0.0_wp
   end subroutine begin

   !> Follow the last step of a method, whose events are not handled yet.
   subroutine follow(self, system, method, status)
      class(tangent_t), intent(inout) :: self       !! the direction
      type(mechanism_t), intent(inout) :: system    !! the system, as it was in the step
      class(integrator_t), intent(inout) :: method  !! the integrator, after the step
      integer, intent(out) :: status                !! 0: done

      real(wp) :: difference, length

      status = 0
      if (method%step%h <= 0.0_wp) return
      call method%prepare_output(system, status)
      if (status == 0) call go(self, system, method, self%parts, self%once, status)
      do while (status == 0)
         call go(self, system, method, 2*self%parts, self%twice, status)
         if (status /= 0) exit
         length = maxval(abs(self%twice(:size(self%scale)))/self%scale)
         difference = maxval(abs(self%twice(:size(self%scale)) - self%once(:size(self%scale)))/self%scale)
         if (difference <= allowed*length .or. self%parts >= most_parts) exit
         self%once = self%twice
         self%parts = 2*self%parts
      end do
      if (status /= 0) return
      self%w = self%twice + (self%twice - self%once)/15.0_wp
      if (difference < allowed*length/64.0_wp .and. self%parts > 1) self%parts = self%parts/2
      call self%renew(system)
      call system%evaluate(method%t, method%step%y1, self%y, status)
   end subroutine follow

   !> The direction at the end of a step, in equal parts of it.
   subroutine go(self, system, method, n, w, status)
      class(tangent_t), intent(inout) :: self       !! the direction
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, after the step
      integer, intent(in) :: n                      !! parts
      real(wp), intent(out) :: w(:)                 !! (n) direction at the end [any]
      integer, intent(out) :: status                !! 0: done

      real(wp) :: aside, h, t
      integer :: i

      aside = edge*method%step%h
      h = (method%step%h - 2.0_wp*aside)/real(n, wp)
      w = self%w
      status = 0
      call slope(method%step%t0 + aside, w, 1)
      w = w + aside*self%k(:, 1)
      do i = 1, n
         t = method%step%t0 + aside + real(i - 1, wp)*h
         call slope(t, w, 1)
         call slope(t + 0.5_wp*h, w + 0.5_wp*h*self%k(:, 1), 2)
         call slope(t + 0.5_wp*h, w + 0.5_wp*h*self%k(:, 2), 3)
         call slope(t + h, w + h*self%k(:, 3), 4)
         if (status /= 0) return
         w = w + h/6.0_wp*(self%k(:, 1) + 2.0_wp*(self%k(:, 2) + self%k(:, 3)) + self%k(:, 4))
      end do
      w = w + aside*self%k(:, 4)

   contains

      !> Rate of a direction at a time within the step.
      subroutine slope(at, direction, stage)
         real(wp), intent(in) :: at             !! time [s]
         real(wp), intent(in) :: direction(:)   !! (n) the direction [any]
         integer, intent(in) :: stage           !! where its rate goes

         real(wp) :: clear, inside, near, time

         if (status /= 0) return
         clear = nearest/(slow*self%pace(system))
         inside = max(at, self%t_event + clear)
         if (method%events%n_happened > 0) inside = min(inside, method%t - clear)
         time = inside - self%t_event
         if (method%events%n_happened > 0) time = min(time, method%t - inside)
         near = self%part_of(system, direction, slow*self%pace(system)*time)
         call method%state_at(system, inside, self%y)
         call self%beside(system, inside, self%y, direction, near, self%plus, status)
         if (status == 0) call self%beside(system, inside, self%y, direction, -near, self%minus, status)
         associate (m => system%n - system%n_quadrature)
            self%k(:m, stage) = (self%plus(:m) - self%minus(:m))/(2.0_wp*near)
         end associate
      end subroutine slope

   end subroutine go

   !> How far to go along a direction: as far as positions or rates allow, whose changes round-off must not hide.
   pure real(wp) function part_of(self, system, direction, most)
      class(tangent_t), intent(in) :: self          !! the direction, for the scales
      type(mechanism_t), intent(in) :: system       !! the system
      real(wp), intent(in) :: direction(:)          !! (n) the direction [any]
      real(wp), intent(in) :: most                  !! maximum change of positions and rates, as an event is near [1]

      real(wp) :: position, rate

      associate (nq => system%linkage%n_position, n => size(self%scale))
         position = maxval(abs(direction(:nq))/self%scale(:nq))
         rate = maxval(abs(direction(nq + 1:n))/self%scale(nq + 1:))/self%pace(system)
      end associate
      part_of = 1.0_wp/max(position/max(nearest, min(nearness, most)), rate/max(nearest, min(rate_nearness, most)), tiny(1.0_wp))
   end function part_of

   !> The right-hand side beside the motion, with the impact speeds there.
   subroutine beside(self, system, t, y, direction, part, ydot, status)
      class(tangent_t), intent(inout) :: self       !! the direction, for its impact speeds
      type(mechanism_t), intent(inout) :: system    !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(in) :: direction(:)          !! (n) change of it [any]
      real(wp), intent(in) :: part                  !! how far to go that way [1]
      real(wp), intent(out) :: ydot(:)              !! (n) the derivative there [any]
      integer, intent(out) :: status                !! 0: done

      call self%take_speeds(system)
      call self%give_speeds(system, part)
      call system%evaluate(t, y + part*direction, ydot, status)
      call self%give_speeds(system, 0.0_wp)
   end subroutine beside

   !> Note the impact speeds of all contacts.
   subroutine take_speeds(self, system)
      class(tangent_t), intent(inout) :: self       !! the direction; `speed` is set
      type(mechanism_t), intent(in) :: system       !! the system

      integer :: k

      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            self%speed(set%before%contacts + 1:set%before%contacts + set%n_contact) = set%contact%impact_speed
         end associate
      end do
   end subroutine take_speeds

   !> Give contacts that touch the impact speeds that were noted, with a part of their changes.
   subroutine give_speeds(self, system, part)
      class(tangent_t), intent(in) :: self          !! the direction, speeds noted
      type(mechanism_t), intent(inout) :: system    !! the system
      real(wp), intent(in) :: part                  !! of the changes [1]

      integer :: i, k

      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            if (set%n_touching == 0) cycle
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               call set%set_impact_speed(i, self%speed(set%before%contacts + i) + part*self%impact(set%before%contacts + i))
            end do
         end associate
      end do
   end subroutine give_speeds

   !> Take away what constraints forbid, and what is no motion: the difference of the states beside, each brought onto them.
   subroutine project(self, system, method, status)
      class(tangent_t), intent(inout) :: self       !! the direction
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, for the present state
      integer, intent(out) :: status                !! 0: done, or nothing to do

      real(wp), parameter :: beside = 1.0e-6_wp  ! distance of the states, of the scales [1]
      real(wp) :: length, part

      status = 0
      associate (coordinates => system%linkage%coordinates)
         if (system%linkage%rows%n_solve == 0 .and. coordinates%n_q == coordinates%n_v) return
      end associate
      length = maxval(abs(self%w(:size(self%scale)))/self%scale)
      if (.not. length > 0.0_wp) return
      associate (y => method%step%y1, m => system%n - system%n_quadrature)
         part = beside/length
         self%plus = y + part*self%w
         self%minus = y - part*self%w
         call system%project_state(method%t, self%plus, status)
         if (status == 0) call system%project_state(method%t, self%minus, status)
         call system%linkage%tidy(self%plus)
         call system%linkage%tidy(self%minus)
         if (status == 0) self%w(:m) = (self%plus(:m) - self%minus(:m))/(2.0_wp*part)
         call system%evaluate(method%t, y, self%y, status)
      end associate
   end subroutine project

   !> Bring the direction to length one, by the present characteristic rate of the mechanism; its level rises by as much.
   subroutine renew(self, system)
      class(tangent_t), intent(inout) :: self       !! the direction
      type(mechanism_t), intent(in) :: system       !! the system

      real(wp) :: length

      associate (nq => system%linkage%n_position, w => self%w(:size(self%scale)))
         length = max(maxval(abs(w(:nq))/self%scale(:nq)), maxval(abs(w(nq + 1:))/self%scale(nq + 1:))/self%pace(system))
      end associate
      if (.not. length > 0.0_wp) return
      self%w = self%w/length
      self%impact = self%impact/length
      self%level = self%level + log(length)
   end subroutine renew

   !> What rates are measured by: the characteristic rate of the mechanism, or of one that hardly moves the rate given.
   pure real(wp) function pace(self, system)
      class(tangent_t), intent(in) :: self          !! the direction
      type(mechanism_t), intent(in) :: system       !! the system

      pace = max(self%min_rate, system%linkage%scales%pace)
   end function pace

   !> Logarithms of the lengths of the change itself: of positions, and of rates [ln 1 and ln s^-1].
   pure function lengths(self, system) result(logs)
      class(tangent_t), intent(in) :: self          !! the direction
      type(mechanism_t), intent(in) :: system       !! the system
      real(wp) :: logs(2)                           !! (2) of positions and of rates [1]

      associate (nq => system%linkage%n_position, w => self%w(:size(self%scale)))
         logs = self%level + log(max(tiny(1.0_wp), [maxval(abs(w(:nq))/self%scale(:nq)), &
                                                    maxval(abs(w(nq + 1:))/self%scale(nq + 1:))]))
      end associate
   end function lengths

end module tangent
