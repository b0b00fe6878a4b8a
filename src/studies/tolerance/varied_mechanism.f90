!> A mechanism of a deck with changed parameters, at instants of the nominal motion: its rows, its assembly, its channels.
!>
!> All joints are ideal. The pin of a joint with clearance may stand at e from the centre of its bearing: the rows of the joint are
!> Phi = r_i + s_i - r_j - s_j, so that they are -e there, and
!> $$ \Phi(q, t, p) + e = 0 . $$
!> A member is assembled by Newton's iteration from a prediction. Where that fails, or turns a body by more than a third of a
!> radian, it follows the solution of Phi(q) + e = (1 - s)(Phi(q_0) + e) from the nominal position q_0 at s = 0 to s = 1.
!> Velocities, accelerations and forces are those of a pin that stays where it is.
!> Source: E. L. Allgower, K. Georg, Numerical Continuation Methods (1990), chapter 2.
!> Limits: as many independent rows as coordinates.
module varied_mechanism
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances, group_drivers, group_energy, group_forces, group_joints
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use kinematic_report, only: report_motion
   use lapack, only: dgetrf, dgetrs
   use mechanism, only: mechanism_t
   use mechanism_catalogue, only: bind_channels, build_catalogue
   use mechanism_report, only: fill_catalogue
   use prescribed_motion, only: newton_t, open_rows, solve_rates, solved
   use row_corrections, only: evaluate_rows, limit_step, min_correction, scaled_jacobian
   use smooth_segment, only: smooth_segment_t
   use step_follower, only: follow_motion, must_follow
   implicit none (type, external)
   private
   public :: instant_t, varied_t

   real(wp), parameter :: closed = 1.0e-10_wp           !! scaled violation that counts as closed [1]
   real(wp), parameter :: round_off = 1.0e-15_wp        !! scaled violation at which the iteration ends early [1]
   integer, parameter :: most_corrections = 25          !! of Newton's iteration
   real(wp), parameter :: longest_turn = 1.0_wp/3.0_wp  !! of a body between prediction and solution that is accepted [rad]
   real(wp), parameter :: shortest_part = 1.0e-3_wp     !! of the way from the nominal position that is still tried [1]
   character(*), parameter :: of_positions = " position angle orientation distance "  !! channels that follow from positions

   !> An instant of the nominal motion.
   type :: instant_t
      real(wp) :: t = 0.0_wp                  !! time [s]
      type(smooth_segment_t) :: segment       !! where functions of time are evaluated
      real(wp), allocatable :: q(:)           !! (n_q bodies) positions [any]
   end type instant_t

   !> A mechanism, what is read of it, and scratch.
   type :: varied_t
      type(mechanism_t) :: system             !! its equations, all joints ideal
      type(catalogue_t) :: catalogue          !! its channels, only what is read is bound
      integer, allocatable :: place(:)        !! (requests) where they stand in the catalogue
      logical :: needs_rates = .true.         !! what is read needs velocities and forces
      logical :: needs_forces = .true.        !! forces are read by others
   contains
      procedure :: bind => varied_bind
      procedure :: rows_at => varied_rows_at
      procedure :: values_at => varied_values_at
      procedure :: assemble => varied_assemble
      procedure :: follow => varied_follow
   end type varied_t

contains

   !> Bind the channels that are read. The system is built.
   subroutine varied_bind(self, requested)
      class(varied_t), intent(inout) :: self       !! the mechanism
      integer, intent(in) :: requested(:, :)       !! (3, requests) group, component and item of each in the catalogue

      integer :: k

      call build_catalogue(self%system, self%catalogue)
      do k = 1, size(self%catalogue%groups)
         self%catalogue%groups(k)%is_wanted = .false.
      end do
      self%place = [(self%catalogue%place(requested(1, k), requested(2, k), requested(3, k)), k=1, size(requested, 2))]
      do k = 1, size(requested, 2)
         self%catalogue%groups(requested(1, k))%is_wanted(requested(3, k)) = .true.
      end do
      call bind_channels(self%system, self%catalogue)
      self%needs_rates = .false.
      do k = 1, size(self%catalogue%groups)
         associate (group => self%catalogue%groups(k))
            if (.not. any(group%is_wanted)) cycle
            if (any(self%catalogue%formulas%group == k)) cycle  ! what it reads is requested too
            self%needs_rates = self%needs_rates .or. index(of_positions, " "//group%channel%name//" ") == 0 .or. &
                               any(group%item_group == [group_clearances, group_drivers, group_energy, group_forces, group_joints])
         end associate
      end do
      self%needs_forces = .false.
   end subroutine varied_bind

   !> Violations of the rows at an instant and a position.
   subroutine varied_rows_at(self, instant, q, phi)
      class(varied_t), intent(inout) :: self     !! the mechanism
      type(instant_t), intent(in) :: instant     !! the instant
      real(wp), intent(in) :: q(:)               !! (n_q bodies) positions [any]
      real(wp), intent(out) :: phi(:)            !! (rows) violations [m or rad]

      real(wp) :: rest(self%system%linkage%coordinates%n_v*self%system%linkage%bodies%n)

      rest = 0.0_wp
      self%system%linkage%segment = instant%segment
      call evaluate_rows(self%system%linkage, instant%t, q, rest)
      phi = self%system%linkage%rows%phi
   end subroutine varied_rows_at

   !> Channels that are read, at an instant and a position, with the rates and forces that go with it.
   subroutine varied_values_at(self, instant, q, values, outcome)
      class(varied_t), intent(inout) :: self     !! the mechanism
      type(instant_t), intent(in) :: instant     !! the instant
      real(wp), intent(in) :: q(:)               !! (n_q bodies) positions [any]
      real(wp), intent(out) :: values(:)         !! (requests) values [any]
      integer, intent(out) :: outcome            !! as of `prescribed_motion`

      real(wp), dimension(self%system%linkage%coordinates%n_v*self%system%linkage%bodies%n) :: a, v
      type(newton_t) :: newton

      self%system%linkage%segment = instant%segment
      outcome = solved
      if (self%needs_rates .or. self%needs_forces) then
         call solve_rates(self%system%linkage, instant%t, newton, q, v, a, outcome)
         call report_motion(self%system, instant%t, q, v, a, self%catalogue)
      else
         v = 0.0_wp
         call evaluate_rows(self%system%linkage, instant%t, q, v)
         call fill_catalogue(self%system, instant%t, [q, v], 0.0_wp, self%catalogue)
      end if
      values = self%catalogue%values(self%place)
      if (outcome == solved .and. .not. all(ieee_is_finite(values))) outcome = open_rows
   end subroutine varied_values_at

   !> Positions that fulfil the rows at an instant, the pins displaced.
   subroutine varied_assemble(self, instant, displaced, q, outcome)
      class(varied_t), intent(inout) :: self     !! the mechanism
      type(instant_t), intent(in) :: instant     !! the instant of the nominal motion
      real(wp), intent(in) :: displaced(:)       !! (rows) e of the rows of pins, 0 of the others [m]
      real(wp), intent(inout) :: q(:)            !! (n_q bodies) prediction, then positions [any]
      integer, intent(out) :: outcome            !! as of `prescribed_motion`

      real(wp) :: first(size(displaced)), next(size(q)), part, step

      self%system%linkage%segment = instant%segment
      call correct(self, instant%t, displaced, q, outcome)
      if (outcome == solved) return
      call self%rows_at(instant, instant%q, first)
      first = first + displaced
      q = instant%q
      part = 0.0_wp
      step = 0.25_wp
      do while (part < 1.0_wp)
         next = q
         call correct(self, instant%t, displaced - (1.0_wp - min(part + step, 1.0_wp))*first, next, outcome)
         if (outcome == solved) then
            part = min(part + step, 1.0_wp)
            q = next
            step = 2.0_wp*step
         else
            step = 0.5_wp*step
            if (step < shortest_part) return
         end if
      end do
   end subroutine varied_assemble

   !> Newton's iteration from a prediction; what turns a body too far from it is not accepted.
   subroutine correct(self, t, right, q, outcome)
      class(varied_t), intent(inout) :: self     !! the mechanism
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: right(:)           !! (rows) solved is Phi + right = 0 [m or rad]
      real(wp), intent(inout) :: q(:)            !! (n_q bodies) prediction, then positions [any]
      integer, intent(out) :: outcome            !! as of `prescribed_motion`

      real(wp), dimension(self%system%linkage%coordinates%n_v*self%system%linkage%bodies%n) :: change, rest
      real(wp) :: before, now, predicted(size(q))
      integer :: k

      rest = 0.0_wp
      predicted = q
      before = huge(1.0_wp)
      outcome = open_rows
      associate (linkage => self%system%linkage)
         do k = 0, most_corrections
            call evaluate_rows(linkage, t, q, rest)
            if (.not. (all(ieee_is_finite(linkage%rows%phi)) .and. all(ieee_is_finite(linkage%rows%jac)))) return
            now = maxval(abs(linkage%rows%phi + right)*linkage%solution%row_weight)
            if (now <= round_off .or. (now <= closed .and. now >= 0.5_wp*before)) exit
            if (k == most_corrections) return
            before = now
            call find_change(self, -(linkage%rows%phi + right), change)
            call linkage%coordinates%add_change(linkage%bodies%n, limit_step(linkage, change), q)
         end do
         call linkage%coordinates%difference(linkage%bodies%n, predicted, q, change)
         if (linkage%coordinates%max_turn(linkage%bodies%n, change) <= longest_turn) outcome = solved
      end associate
   end subroutine correct

   !> Change of the coordinates that changes the rows as requested: by elimination, or where that fails by singular values.
   subroutine find_change(self, right, x)
      class(varied_t), intent(in) :: self        !! the mechanism, rows evaluated
      real(wp), intent(in) :: right(:)           !! (rows) what the rows should change by [m or rad]
      real(wp), intent(out) :: x(:)              !! (n_v bodies) change [m or rad]

      real(wp), allocatable :: b(:, :), jac(:, :)
      real(wp) :: ease(size(x))
      integer :: info, n, pivots(size(x)), rank

      n = size(x)
      associate (linkage => self%system%linkage)
         if (linkage%rows%n == n) then
            call scaled_jacobian(linkage, jac)
            call dgetrf(n, n, jac, n, pivots, info)
            if (info == 0) then
               b = reshape(right*linkage%solution%row_weight, [n, 1])
               call dgetrs("N", n, 1, jac, n, pivots, b, n, info)
               x = b(:, 1)*linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)
               if (all(ieee_is_finite(x))) return
            end if
         end if
         ease = 1.0_wp
         call min_correction(linkage, right, ease, x, rank)
      end associate
   end subroutine find_change

   !> Counts of turns continue from this instant; the motion is that of the last evaluation.
   subroutine varied_follow(self)
      class(varied_t), intent(inout) :: self     !! the mechanism

      if (must_follow(self%system)) call follow_motion(self%system)
   end subroutine varied_follow

end module varied_mechanism
