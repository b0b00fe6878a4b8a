!> Instants at which functions of time are not smooth, and how long a step may be so that it passes over nothing.
!>
!> The expressions of loads and drivers are searched as the motion continues (`root_scan`, `rate_scan`). An instant ends a step
!> exactly; up to it the system evaluates all functions on their left side, then on their right one, and the integrator
!> restarts (`smooth_segment`). Samples of state equations are such instants too. Between instants a step is not longer than the
!> functions' characteristic rate, nor than a quarter of a turn of any body that a contact may touch, unless the user has set a
!> maximum or fixed step. A body whose motion is known has no
!> error that would keep steps short where it does work on what cannot move: in a step it turns by 8 tolerance^(1/7) rad at most
!> (unless the method has a history that ends of steps disturb), and by 5 tolerance^(1/6) rad, as an integral over the angle allows,
!> where nothing else can move.
!>
!> Limits: laws of springs and contacts, and what loads see of the motion, are functions of the state; their kinks are left to the
!> control of the step. Of a load that sees the motion the parts that are functions of the time are monitored.
module output_times
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_halting_mode, ieee_set_status, ieee_status_type, ieee_usual
   use expression, only: expression_t
   use expression_switches, only: find_switches, switch_t, time_parts
   use integrator, only: integrator_t
   use kind_info, only: cell_expression, dim_angle, same_dimension
   use kinds, only: eps, pi, wp
   use rate_scan, only: new_rate_scan, rate_scan_t
   use mechanism, only: mechanism_t
   use root_scan, only: new_root_scan, place_t, root_scan_t
   use scene, only: scene_t, table_t
   use smooth_segment, only: smooth_segment_t
   use state_equations, only: sampled, state_prefix
   use state_samples, only: samples_t
   implicit none (type, external)
   private
   public :: output_times_t, new_output_times, watched_t

   real(wp), parameter :: one = 16.0_wp*eps     !! of the time: instants closer than this are one [1]
   real(wp), parameter :: turn = 0.5_wp*pi      !! maximum turn of a body with contacts in a step [rad]
   ! maximum turn of a body of known motion at a tolerance of one, and the root of the tolerance that it falls with [rad, 1]
   real(wp), parameter :: beside(2) = [8.0_wp, 7.0_wp]  !! others that can move
   real(wp), parameter :: alone(2) = [5.0_wp, 6.0_wp]   !! none that can

   !> A cell of the deck whose expression is monitored.
   type :: watched_t
      character(:), allocatable :: name        !! of the cell, as `hand.fx`
      type(root_scan_t), allocatable :: scans(:)  !! (n) where it is not smooth
      type(place_t), allocatable :: next(:)    !! (n) the next place of each
      type(rate_scan_t) :: pace                !! how long a step may be
   end type watched_t

   !> All of them, and where the motion is.
   type :: output_times_t
      type(watched_t), allocatable :: cells(:)   !! (cells or more) what is monitored
      integer :: n = 0                           !! cells
      type(samples_t) :: samples                 !! of the state equations
      type(place_t) :: next                      !! the next instant
      real(wp) :: end = 0.0_wp                   !! end of the motion [s]
      logical :: paces = .false.                 !! some function limits the step
      real(wp) :: omega = 0.0_wp                 !! maximum angular speed of a body that a contact may touch [rad/s]
      real(wp) :: prescribed_omega = 0.0_wp           !! maximum one of a body whose motion is known [rad/s]
      logical :: is_still = .false.              !! whether nothing else can move
      real(wp) :: tolerance = -1.0_wp            !! that the next are of [1]
      real(wp) :: prescribed_turn(2) = 0.0_wp  !! (2) maximum turns of such a body in a step: others move too; none does [rad]
   contains
      procedure :: begin => output_times_begin
      procedure :: is_at => output_times_is_at
      procedure :: pass => output_times_pass
      procedure :: note_turning => output_times_note_turning
      procedure :: stop_after => output_times_stop_after
   end type output_times_t

contains

   !> Monitor the expressions of a scene.
   subroutine new_output_times(scene, end, has_contacts, output_times)
      type(scene_t), intent(in) :: scene           !! the scene
      real(wp), intent(in) :: end                  !! end of the motion [s]
      logical, intent(in) :: has_contacts          !! whether anything may touch
      type(output_times_t), intent(out) :: output_times    !! nothing found yet

      type(ieee_status_type) :: status
      integer :: k

      output_times%end = end
      if (.not. end > 0.0_wp) return
      allocate (output_times%cells(sum([(functions_of_time(scene%joints(k)), k=1, size(scene%joints))]) &
                               + sum([(functions_of_time(scene%forces(k)), k=1, size(scene%forces))]) &
                               + sum([(parts_of_time(scene%states%rows(k)%expression), k=1, scene%states%n)])))
      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      do k = 1, size(scene%joints)
         call monitor_table(scene%joints(k), has_contacts, output_times)
      end do
      do k = 1, size(scene%forces)
         call monitor_table(scene%forces(k), .false., output_times)
      end do
      do k = 1, scene%states%n
         associate (row => scene%states%rows(k))
            if (row%sort /= sampled) call monitor_expression(row%expression, state_prefix//row%name, .false., output_times)
         end associate
      end do
      call output_times%samples%start(scene%states)
      call ieee_set_status(status)
   end subroutine new_output_times

   !> Monitor the expressions of a table.
   subroutine monitor_table(table, turns_count, output_times)
      type(table_t), intent(in) :: table              !! rows of a kind
      logical, intent(in) :: turns_count              !! whether angles must not turn by much in a step
      type(output_times_t), intent(inout) :: output_times     !! cells are added

      integer :: c, i

      do c = 1, size(table%info%columns)
         do i = 1, size(table%items)
            if (.not. is_function_of_time(table, c, i)) cycle
            associate (expression => table%items(i)%values(c)%expression)
               call monitor_expression(expression, table%items(i)%name//"."//table%info%columns(c)%name, &
                                       turns_count .and. same_dimension(expression%dimension, dim_angle), output_times)
            end associate
         end do
      end do
   end subroutine monitor_table

   !> Monitor the parts of an expression that are functions of the time.
   subroutine monitor_expression(expression, name, is_turning, output_times)
      type(expression_t), intent(in) :: expression            !! the expression
      character(*), intent(in) :: name                        !! of its cell
      logical, intent(in) :: is_turning                       !! it is an angle that must not turn by much in a step
      type(output_times_t), intent(inout) :: output_times     !! cells are added

      type(expression_t), allocatable :: parts(:)
      type(watched_t) :: cell
      integer :: k

      if (parts_of_time(expression) == 0) return
      cell%name = name
      call time_parts(expression, parts)
      do k = 1, size(parts)
         call monitor(parts(k), output_times%end, is_turning, cell)
         if (size(cell%scans) == 0 .and. cell%pace%is_calm) cycle
         output_times%n = output_times%n + 1
         output_times%cells(output_times%n) = cell
         output_times%paces = output_times%paces .or. .not. cell%pace%is_calm
      end do
   end subroutine monitor_expression

   !> Functions of time in the cells of a table.
   integer function functions_of_time(table) result(n)
      type(table_t), intent(in) :: table   !! rows of a kind

      integer :: c, i

      n = 0
      do c = 1, size(table%info%columns)
         do i = 1, size(table%items)
            if (is_function_of_time(table, c, i)) n = n + parts_of_time(table%items(i)%values(c)%expression)
         end do
      end do
   end function functions_of_time

   !> Parts of an expression that are functions of the time.
   integer function parts_of_time(expression) result(n)
      type(expression_t), intent(in) :: expression   !! the expression

      type(expression_t), allocatable :: parts(:)

      n = 0
      if (expression%is_constant .or. .not. allocated(expression%code)) return
      call time_parts(expression, parts)
      n = size(parts)
   end function parts_of_time

   !> Whether a cell is a function of time, and no constant.
   pure logical function is_function_of_time(table, c, i) result(is_one)
      type(table_t), intent(in) :: table   !! rows of a kind
      integer, intent(in) :: c             !! column
      integer, intent(in) :: i             !! row

      is_one = table%info%columns(c)%cell == cell_expression .and. table%info%columns(c)%variable == "t"
      if (.not. is_one) return
      associate (expression => table%items(i)%values(c)%expression)
         is_one = .not. expression%is_constant .and. allocated(expression%code)
      end associate
   end function is_function_of_time

   !> Monitor an expression.
   subroutine monitor(expression, end, is_turning, cell)
      type(expression_t), intent(in) :: expression   !! the expression
      real(wp), intent(in) :: end                    !! end of the motion [s]
      logical, intent(in) :: is_turning              !! it is an angle that must not turn by much in a step
      type(watched_t), intent(inout) :: cell         !! receives the searches

      type(switch_t), allocatable :: switches(:)
      integer :: k

      call find_switches(expression, switches)
      if (allocated(cell%scans)) deallocate (cell%scans, cell%next)
      allocate (cell%scans(size(switches)), cell%next(size(switches)))
      do k = 1, size(switches)
         call new_root_scan(switches(k), 0.0_wp, end, cell%scans(k))
      end do
      call new_rate_scan(expression, 0.0_wp, end, merge(turn, 0.0_wp, is_turning), cell%pace)
   end subroutine monitor

   !> The motion starts at t = 0: functions take their right side there.
   subroutine output_times_begin(self, end, segment)
      class(output_times_t), intent(inout) :: self       !! the instants
      real(wp), intent(in) :: end                    !! end of the motion [s]
      type(smooth_segment_t), intent(out) :: segment     !! the first stretch

      type(ieee_status_type) :: status
      integer :: i, k

      self%end = end
      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      do i = 1, self%n
         do k = 1, size(self%cells(i)%scans)
            call self%cells(i)%scans(k)%next(self%cells(i)%next(k))
         end do
      end do
      call find_next(self)
      call ieee_set_status(status)
      segment%high = self%next%low
      segment%end = self%next%at
      do while (self%next%at <= 0.0_wp)
         call self%pass(segment)
      end do
   end subroutine output_times_begin

   !> Whether an instant has been reached.
   pure logical function output_times_is_at(self, t) result(is_at)
      class(output_times_t), intent(in) :: self  !! the instants
      real(wp), intent(in) :: t              !! the time [s]

      is_at = t >= self%next%at
   end function output_times_is_at

   !> Pass the next instant: functions take their right side, and the one after it is searched.
   subroutine output_times_pass(self, segment)
      class(output_times_t), intent(inout) :: self       !! the instants
      type(smooth_segment_t), intent(inout) :: segment   !! the stretch that starts

      type(ieee_status_type) :: status
      integer :: i, k

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      segment%low = self%next%high
      call self%samples%pass(self%next%at)
      do i = 1, self%n
         associate (cell => self%cells(i))
            do k = 1, size(cell%scans)
               do while (cell%next(k)%at <= self%next%at)
                  call cell%scans(k)%next(cell%next(k))
               end do
            end do
         end associate
      end do
      call find_next(self)
      call ieee_set_status(status)
      segment%high = self%next%low
      segment%end = self%next%at
   end subroutine output_times_pass

   !> The next instant; places that are round-off apart are one.
   subroutine find_next(self)
      class(output_times_t), intent(inout) :: self  !! the instants

      real(wp) :: first, last_sample, sample
      integer :: i, k

      self%next = place_t()
      first = huge(1.0_wp)
      do i = 1, self%n
         if (size(self%cells(i)%next) > 0) first = min(first, minval(self%cells(i)%next%at))
      end do
      call self%samples%next(huge(1.0_wp), sample, last_sample)
      first = min(first, sample)
      if (.not. first < huge(1.0_wp)) return
      self%next = place_t(first, first, first)
      do i = 1, self%n
         do k = 1, size(self%cells(i)%next)
            associate (next => self%cells(i)%next(k))
               if (next%at > first + one*abs(first)) cycle
               self%next = place_t(min(self%next%low, next%low), max(self%next%at, next%at), max(self%next%high, next%high))
            end associate
         end do
      end do
      call self%samples%next(first + one*abs(first), sample, last_sample)
      if (last_sample < first) return
      self%next = place_t(min(self%next%low, sample), max(self%next%at, last_sample), max(self%next%high, last_sample))
   end subroutine find_next

   !> Note how fast the bodies of contacts turn, and those of known motion: it limits the next step.
   pure subroutine output_times_note_turning(self, system)
      class(output_times_t), intent(inout) :: self   !! the instants
      type(mechanism_t), intent(in) :: system    !! the system, its motion that of the start of the next step

      integer :: k

      self%omega = 0.0_wp
      self%prescribed_omega = 0.0_wp
      associate (linkage => system%linkage, known => system%linkage%reduced%known, omega => system%linkage%motion%omega)
         do k = 1, known%n
            associate (w => omega(:, known%held(k)%body))
               self%prescribed_omega = max(self%prescribed_omega, abs(w(1)), abs(w(2)), abs(w(3)))
            end associate
         end do
         self%is_still = linkage%n_rate <= linkage%rows%n_solve .and. .not. linkage%solution%is_redundant
      end associate
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set, linkage => system%linkage)
            self%omega = max(self%omega, fastest(set%n, set%items%body, linkage%bodies%n, linkage%motion%omega))
         end associate
      end do
   end subroutine output_times_note_turning

   !> Maximum component of the angular velocities of some pairs of bodies.
   pure real(wp) function fastest(n, body, n_body, omega)
      integer, intent(in) :: n                        !! number of pairs
      integer, intent(in) :: body(2, n)               !! (2, n) their bodies
      integer, intent(in) :: n_body                   !! number of bodies
      real(wp), intent(in) :: omega(3, 0:n_body)      !! (3, 0:bodies) angular velocities [rad/s]

      integer :: i, k

      fastest = 0.0_wp
      do k = 1, n
         do i = 1, 2
            associate (w => omega(:, body(i, k)))
               fastest = max(fastest, abs(w(1)), abs(w(2)), abs(w(3)))
            end associate
         end do
      end do
   end function fastest

   !> Latest end of the step that starts; how fast bodies turn there has been noted.
   subroutine output_times_stop_after(self, method, stop)
      class(output_times_t), intent(inout) :: self       !! the instants
      class(integrator_t), intent(in) :: method      !! the integrator, at the start of the step
      real(wp), intent(out) :: stop                  !! its latest end [s]

      type(ieee_status_type) :: status
      real(wp) :: prescribed_turn, latest
      integer :: i

      stop = min(self%end, self%next%at)
      if (method%controls%maximum_step > 0.0_wp .or. method%controls%fixed_step > 0.0_wp) return
      latest = stop
      if (self%paces) then
         call ieee_get_status(status)
         call ieee_set_halting_mode(ieee_usual, .false.)
         do i = 1, self%n
            call self%cells(i)%pace%stop_after(method%t, latest)
            stop = min(stop, latest)
         end do
         call ieee_set_status(status)
      end if
      if (self%omega*(stop - method%t) > turn) stop = method%t + turn/self%omega
      if (self%prescribed_omega > 0.0_wp) then
         if (abs(method%controls%tolerance - self%tolerance) > 0.0_wp) then
            self%tolerance = method%controls%tolerance
            self%prescribed_turn(1) = min(turn, beside(1)*self%tolerance**(1.0_wp/beside(2)))
            self%prescribed_turn(2) = min(turn, alone(1)*self%tolerance**(1.0_wp/alone(2)))
            if (method%begins_anew()) self%prescribed_turn(1) = huge(1.0_wp)
         end if
         prescribed_turn = merge(self%prescribed_turn(2), self%prescribed_turn(1), self%is_still)
         if (self%prescribed_omega*(stop - method%t) > prescribed_turn) stop = method%t + prescribed_turn/self%prescribed_omega
      end if
   end subroutine output_times_stop_after

end module output_times
