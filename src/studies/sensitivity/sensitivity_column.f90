!> The derivative of a motion by one parameter, carried from step to step.
!>
!> What goes along is the derivative at corresponding places: at equal times after corresponding events,
!>
!> $$ \hat s = \frac{d}{dp} y(t_e(p) + \tau; p), \qquad s = \hat s - f \theta, \qquad \theta = \frac{d t_e}{d p} . $$
!>
!> A step of length h with the map Phi_h carries it along by the derivative of this map (internal differentiation),
!>
!> $$ \hat s^+ = \frac{d}{de} \Phi_{h(e)} (t_0 + e \theta, y_0 + e \hat s; p + e) |_{e=0} , $$
!>
!> where h(e) is h, or ends the step at the same event: then theta^+ = theta + h'. So the states beside meet every event when the
!> motion does, and what an event does to the state needs no saltation matrix: forces that start, end or jump there do so for all
!> of them. As a contact parts, steps beside end at equal penetrations, so that they separate with it.
!>
!> The derivative is the central difference over +-e and +-e/2, extrapolated: D = D_2 + (D_2 - D_1)/3. D_2 - D_1 says whether e is
!> small enough; so do second differences, of which less remains than of a kink that lies between:
!>
!> $$ Q_e = (y(e) - 2 y(0) + y(-e))/e, \qquad Q_{e/2} - Q_e/2 = O(e^3) . $$
!>
!> Else the mechanisms beside are made with a quarter of e. Where that makes the differences greater they are round-off, and the e
!> before is taken. Every few steps a greater e is tried: round-off over e is not extrapolated away.
!>
!> Source: H. G. Bock, Numerical treatment of inverse problems in chemical reaction kinetics, Springer Series in Chemical Physics
!> 18 (1981) 102-125 (internal differentiation). Limits: kinks of laws between events are passed over.
module sensitivity_column
   use contact_peaks, only: look, trend_t
   use integrator, only: integrator_t
   use kinds, only: eps, wp
   use observed, only: observed_t
   use step_map, only: section_t, section_time, step_map_t
   use text, only: real_text
   use varied_system, only: free_mechanisms, variation_t, varied_t
   implicit none (type, external)
   private
   public :: column_t, derivative

   real(wp), parameter :: finer = 0.25_wp          !! ratio of e to the next one [1]
   integer, parameter :: finest = 15               !! e is at least so many times finer
   real(wp), parameter :: rough = 2.0e-5_wp        !! D_2 - D_1 of a step, of D, that is too much [1]
   real(wp), parameter :: noisy = 5.0e-2_wp        !! the same, above which it is not taken for round-off [1]
   real(wp), parameter :: growing = 2.0_wp         !! growth of it with a finer e that is round-off [1]
   real(wp), parameter :: round_off = 8.0_wp*eps   !! of states, of them or of the scales [1]
   real(wp), parameter :: visible = 1.0e-10_wp     !! distance of states beside, likewise, below which that is noise [1]
   integer, parameter :: patience = 10             !! steps after which a greater e is tried
   integer, parameter :: failed = -30              !! count of steps after a greater e was too great

   !> Mechanisms beside for an e.
   type :: made_t
      type(varied_t), pointer :: beside(:) => null()   !! (4) as below; null: not made
   end type made_t

   !> The derivative by one parameter.
   type :: column_t
      integer :: number = 0                        !! of the parameter
      real(wp) :: p = 0.0_wp                       !! its value [any]
      real(wp) :: size = 1.0_wp                    !! what e is measured by [any]
      real(wp) :: part = 0.0_wp                    !! first e, of that [1]
      integer :: n_finer = 0                       !! how many times e was made finer
      logical :: is_active = .true.                !! it can be carried on
      character(:), allocatable :: reason          !! why not
      real(wp), allocatable :: s(:)                !! (n) derivative of the state at corresponding places [any]
      real(wp) :: theta = 0.0_wp                   !! derivative of the time there [any]
      real(wp), allocatable :: u(:)                !! (contacts) derivative of remembered impact speeds [any]
      real(wp), allocatable :: rate(:)             !! (contacts) derivative of penetration rates at the events in hand [any]
      real(wp), allocatable :: gap(:)              !! (events) derivative of event functions at the end of the step [any]
      type(varied_t), pointer :: beside(:) => null()  !! (4) mechanisms with p + e, p - e, p + e/2, p - e/2
      type(made_t), private :: made(0:finest)      !! (0:finest) those of each e, once they were made
      real(wp), allocatable, private :: scale(:)   !! (positions + rates) of the error norm [any]
      integer, private :: n_smooth = 0             !! steps with the same e
      logical, private :: is_tried = .false.       !! a greater e is being tried
   contains
      procedure :: begin => begin_column
      procedure :: free => free_column
      procedure :: follow => follow_step
      procedure :: remember => remember_events
      procedure :: probe
      procedure :: differ
      procedure, private :: make
      procedure, private :: try_greater
      procedure, private :: find_roughness
   end type column_t

contains

   !> Derivative from the values of a number with p + e, p - e, p + e/2, p - e/2.
   pure real(wp) function derivative(x, e) result(d)
      real(wp), intent(in) :: x(4)     !! (4) its values [any]
      real(wp), intent(in) :: e(4)     !! (4) the parameter less its value [any]

      real(wp) :: near

      near = (x(3) - x(4))/(e(3) - e(4))
      d = near + (near - (x(1) - x(2))/(e(1) - e(2)))/3.0_wp
   end function derivative

   !> Start: mechanisms beside, and the derivative of the start.
   subroutine begin_column(self, variation, number, p, part, method, span)
      class(column_t), intent(inout) :: self            !! the column, new
      type(variation_t), intent(inout) :: variation     !! how mechanisms beside are made
      integer, intent(in) :: number                     !! of the parameter
      real(wp), intent(in) :: p                         !! its value in the deck [any]
      real(wp), intent(in) :: part                      !! first e, of the parameter [1]
      class(integrator_t), intent(in) :: method         !! the method, started
      real(wp), intent(in), optional :: span            !! what e is measured by; default: |p| [any]

      integer :: i

      self%number = number
      self%p = p
      self%part = part
      self%size = merge(abs(p), 1.0_wp, abs(p) > 0.0_wp)
      if (present(span)) self%size = span
      self%reason = ""
      associate (base => variation%base)
         allocate (self%s(base%n), self%u(base%clearance_joints%n_contact), self%rate(base%clearance_joints%n_contact), &
                   self%gap(base%n_event), source=0.0_wp)
         allocate (self%scale(base%n))
         call base%weights(method%step%y1, self%scale)
         self%scale = self%scale(:base%linkage%n_position + base%linkage%n_rate)
      end associate
      do
         call self%make(variation)
         if (self%is_active .or. self%n_finer == finest) exit
         self%n_finer = self%n_finer + 1  ! a bound of the parameter may be near
         self%is_active = .true.
      end do
      if (.not. self%is_active) return
      associate (b => self%beside)
         do i = 1, size(self%s)
            self%s(i) = derivative([b(1)%start(i), b(2)%start(i), b(3)%start(i), b(4)%start(i)], b%e)
         end do
      end associate
   end subroutine begin_column

   !> The mechanisms beside are gone.
   subroutine free_column(self)
      class(column_t), intent(inout) :: self    !! the column, at the end of the motion

      integer :: k

      do k = 0, finest
         if (associated(self%made(k)%beside)) call free_mechanisms(self%made(k)%beside)
      end do
      nullify (self%beside)
   end subroutine free_column

   !> Make the mechanisms beside for the present e, unless they are there; they remember what that of the deck does.
   subroutine make(self, variation)
      class(column_t), intent(inout) :: self            !! the column
      type(variation_t), intent(inout) :: variation     !! how they are made

      real(wp), parameter :: parts(4) = [1.0_wp, -1.0_wp, 0.5_wp, -0.5_wp]
      real(wp) :: value
      integer :: k
      logical :: is_lasting

      associate (made => self%made(self%n_finer))
         if (.not. associated(made%beside)) then
            allocate (made%beside(4))
            do k = 1, 4
               value = self%p + parts(k)*self%part*self%size*finer**self%n_finer
               call made%beside(k)%make(variation, self%number, value, self%reason, is_lasting)
               made%beside(k)%e = value - self%p
               if (self%reason /= "") exit
            end do
            if (self%reason /= "") then
               call free_mechanisms(made%beside)
               self%is_active = .false.
               if (is_lasting) self%n_finer = finest
               return
            end if
         end if
         self%beside => made%beside
      end associate
      if (variation%memory%n > 0) call self%remember(variation)
   end subroutine make

   !> Carry the derivative over a step, whose events are not handled yet.
   subroutine follow_step(self, map, method, variation, section, behind, touched)
      class(column_t), intent(inout) :: self            !! the column
      type(step_map_t), intent(inout) :: map            !! the map of the step
      class(integrator_t), intent(in) :: method         !! the method after the step
      type(variation_t), intent(inout) :: variation     !! how mechanisms beside are made
      type(section_t), intent(in) :: section            !! where the step ends
      real(wp), intent(in) :: behind                    !! time after an onset at which a force that jumps is seen; 0: none [s]
      integer, intent(in) :: touched(:, :)              !! (3, any) contacts that start or end: set, contact of it, number

      real(wp) :: g(size(self%gap), 4)
      real(wp) :: best, measure
      integer :: k, n_best, status
      logical :: is_accepted, is_visible(2)

      best = huge(1.0_wp)
      n_best = -1
      do
         do k = 1, 4
            call map%start_beside(method, self%beside(k), self%s, self%theta, behind, status)
            if (status == 0) call map%end_at_section(method, self%beside(k), section, status)
            if (status /= 0) exit
            if (size(self%gap) > 0) call self%beside(k)%system%events(self%beside(k)%t, self%beside(k)%y, g(:, k), map%rate)
            call find_rates(self%beside(k), touched)
         end do
         is_accepted = .false.
         if (status == 0) then
            call self%find_roughness(method%step%y1, n_best < 0, is_visible, measure)
            is_accepted = measure <= rough .or. self%n_finer == n_best
            if (.not. is_accepted .and. best <= noisy .and. measure > growing*best) then
               self%n_finer = n_best
               call self%make(variation)
               cycle
            else if (measure < best) then
               best = measure
               n_best = self%n_finer
            end if
         end if
         if (is_accepted) exit
         if (self%n_finer == finest) then
            self%is_active = .false.
            self%reason = "motions with the parameter changed by "//real_text(self%beside(1)%e, 2)// &
                          " SI units do not stay beside that of the deck"
            return
         end if
         self%n_finer = self%n_finer + 1
         self%n_smooth = merge(failed, 0, self%is_tried)
         self%is_tried = .false.
         call self%make(variation)
         if (.not. self%is_active) return
      end do
      call derive_end(self, section, touched, g)
      call self%try_greater(variation)
   end subroutine follow_step

   !> Derivatives at the end of a step from the states beside.
   subroutine derive_end(self, section, touched, g)
      class(column_t), intent(inout) :: self            !! the column
      type(section_t), intent(in) :: section            !! where the step ends
      integer, intent(in) :: touched(:, :)              !! (3, any) contacts that start or end: set, contact of it, number
      real(wp), intent(in) :: g(:, :)                   !! (events, 4) event functions beside [any]

      integer :: i

      associate (b => self%beside)
         self%theta = self%theta + derivative(b%h, b%e)
         if (section%kind == section_time) self%theta = 0.0_wp
         do i = 1, size(self%s)
            self%s(i) = derivative([b(1)%y(i), b(2)%y(i), b(3)%y(i), b(4)%y(i)], b%e)
         end do
         do i = 1, size(self%gap)
            self%gap(i) = derivative(g(i, :), b%e)
         end do
         self%rate = 0.0_wp
         do i = 1, size(touched, 2)
            associate (n => touched(3, i))
               self%rate(n) = derivative([b(1)%speed(n), b(2)%speed(n), b(3)%speed(n), b(4)%speed(n)], b%e)
            end associate
         end do
      end associate
   end subroutine derive_end

   !> Try a greater e, now and then.
   subroutine try_greater(self, variation)
      class(column_t), intent(inout) :: self            !! the column
      type(variation_t), intent(inout) :: variation     !! how mechanisms beside are made

      self%n_smooth = self%n_smooth + 1
      self%is_tried = .false.
      if (self%n_smooth < patience .or. self%n_finer == 0) return
      self%n_finer = self%n_finer - 1
      self%n_smooth = 0
      call self%make(variation)
      self%is_tried = self%is_active
      if (self%is_active) return
      self%n_finer = self%n_finer + 1  ! a bound of the parameter is near
      self%n_smooth = failed
      self%is_active = .true.
      call self%make(variation)
   end subroutine try_greater

   !> Penetration rates of contacts that start or end, at the end of a step beside.
   subroutine find_rates(beside, touched)
      type(varied_t), intent(inout) :: beside           !! the mechanism beside
      integer, intent(in) :: touched(:, :)              !! (3, any) the contacts: set, contact of it, number

      type(trend_t) :: force, penetration
      integer :: k

      if (size(touched, 2) == 0) return
      call beside%system%linkage%set_motion(beside%t, beside%y)
      do k = 1, size(touched, 2)
         call look(beside%system, touched(1, k), touched(2, k), force, penetration)
         beside%speed(touched(3, k)) = penetration%rate
      end do
   end subroutine find_rates

   !> How much e is too great for the step: D_2 - D_1 and Q_2 - Q_1/2 over D_2, in the norm of errors, of positions or of rates.
   !> It is at least what round-off makes; states beside that differ by no more than that, with the greatest e, do not count.
   subroutine find_roughness(self, y, is_first, is_visible, measure)
      class(column_t), intent(in) :: self          !! the column
      real(wp), intent(in) :: y(:)                 !! (n) state of the motion at the end of the step [any]
      logical, intent(in) :: is_first              !! this is the greatest e tried in the step
      logical, intent(inout) :: is_visible(2)      !! positions, rates: they count; set with the greatest e
      real(wp), intent(out) :: measure             !! how much [1]

      real(wp) :: d(4), difference(2), length(2), magnitude(2)
      integer :: i, kind

      difference = 0.0_wp
      length = 0.0_wp
      magnitude = 1.0_wp
      associate (b => self%beside, n_position => self%beside(1)%system%linkage%n_position)
         do i = 1, size(self%scale)
            d = [b(1)%y(i) - y(i), b(2)%y(i) - y(i), b(3)%y(i) - y(i), b(4)%y(i) - y(i)]/(b%e*self%scale(i))
            kind = merge(1, 2, i <= n_position)
            difference(kind) = max(difference(kind), 0.5_wp*abs(d(3) + d(4) - d(1) - d(2)), &
                                   abs(d(3) - d(4) - 0.5_wp*(d(1) - d(2))))
            length(kind) = max(length(kind), 0.5_wp*abs(d(3) + d(4)))
            magnitude(kind) = max(magnitude(kind), abs(y(i))/self%scale(i))
         end do
         if (is_first) is_visible = length*abs(b(1)%e) > visible*magnitude
         difference = max(difference, round_off*magnitude/abs(b(1)%e))
      end associate
      measure = 0.0_wp
      do kind = 1, 2
         if (is_visible(kind)) measure = max(measure, difference(kind)/max(length(kind), tiny(1.0_wp)))
      end do
   end subroutine find_roughness

   !> The mechanism of the deck has handled events: those beside follow.
   subroutine remember_events(self, variation)
      class(column_t), intent(inout) :: self         !! the column; changes of impact speeds are set
      type(variation_t), intent(in) :: variation     !! what the mechanism of the deck remembers

      integer :: k

      do k = 1, 4
         call self%beside(k)%remember(variation, self%u)
      end do
   end subroutine remember_events

   !> Derivative of a number within the last step, before the derivative is carried over it: at a place of the step, or at a time.
   subroutine probe(self, map, method, what, behind, d, status, length, time)
      class(column_t), intent(inout) :: self            !! the column at the start of the step
      type(step_map_t), intent(inout) :: map            !! the map of the step
      class(integrator_t), intent(in) :: method         !! the method after the step
      type(observed_t), intent(in) :: what              !! which number
      real(wp), intent(in) :: behind                    !! as in `follow` [s]
      real(wp), intent(out) :: d                        !! the derivative [any]
      integer, intent(out) :: status                    !! 0: found
      real(wp), intent(in), optional :: length          !! after the start of the step [s]
      real(wp), intent(in), optional :: time            !! or this time [s]

      type(trend_t) :: x
      real(wp) :: h, values(4)
      integer :: k

      d = 0.0_wp
      do k = 1, 4
         associate (b => self%beside(k))
            call map%start_beside(method, b, self%s, self%theta, behind, status)
            if (status /= 0) return
            if (present(length)) h = length
            if (present(time)) h = time - map%tool%step%t0
            call map%end_after(b, h, status)
            if (status == 0) call what%at(b%system, b%catalogue, b%t, b%y, b%ydot, x, status)
            if (status /= 0) return
            values(k) = x%value
         end associate
      end do
      d = derivative(values, self%beside%e)
   end subroutine probe

   !> Derivative of a number at the place that the derivative of the state is at.
   subroutine differ(self, t, y, what, d, status)
      class(column_t), intent(inout) :: self            !! the column
      real(wp), intent(in) :: t                         !! time of the motion there [s]
      real(wp), intent(in) :: y(:)                      !! (n) its state [any]
      type(observed_t), intent(in) :: what              !! which number
      real(wp), intent(out) :: d                        !! the derivative [any]
      integer, intent(out) :: status                    !! 0: found

      type(trend_t) :: x
      real(wp) :: values(4)
      integer :: k

      d = 0.0_wp
      do k = 1, 4
         associate (b => self%beside(k))
            b%y = y + b%e*self%s
            call what%at(b%system, b%catalogue, t + b%e*self%theta, b%y, b%ydot, x, status)
            if (status /= 0) return
            values(k) = x%value
         end associate
      end do
      d = derivative(values, self%beside%e)
   end subroutine differ

end module sensitivity_column
