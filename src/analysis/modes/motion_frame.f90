!> Small motions of a mechanism that its rows leave free, as they turn with the motion.
!>
!> $$ \delta Q = D x + W d, \qquad \delta V = \delta \dot Q = D u + W \dot d + E\, (x, d), \qquad u = \dot x $$
!>
!> Q are displacements and turns in axes of the world, D the free directions in the metric of the masses (`free_directions`), W what
!> a unit displacement of a driver moves, $D^T M W = 0$. The rows keep the rates in
!>
!> $$ \Phi_q E = -\frac{\partial \dot\Phi}{\partial q}\, (D, W), \qquad D^T M E = 0 $$
!>
!> so that E is the rate of D and W, which vanishes at rest. In axes that turn with the speed omega the directions turn as D C does,
!> $C = D^T M\, (\omega \times D)$. What is left, $E + D C - \omega \times D$, is how much the motion is not steady in these axes;
!> so is the rate of $D^T M D$ where inertias turn in them.
!>
!> Numbers are resolved along the bodies' axes, as local changes are. Source: Shabana, Dynamics of Multibody Systems (2020),
!> section 3.4 (velocity transformation). Limits: dense.
module motion_frame
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use motion, only: cross
   implicit none (type, external)
   private
   public :: motion_frame_t, stencil, stencil_weight

   real(wp), parameter :: stencil(6) = [-3.0_wp, -2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp, 3.0_wp]   !! places of differences, in steps [1]
   real(wp), parameter :: stencil_weight(6) = [-1.0_wp, 9.0_wp, -45.0_wp, 45.0_wp, -9.0_wp, 1.0_wp]/60.0_wp   !! weights there [1]
   real(wp), parameter :: near = 1.0e-3_wp   !! displacement of rows, of the size of the bodies or a radian [1]

   !> The directions at a state.
   type :: motion_frame_t
      integer :: n_free = 0                        !! free directions
      integer :: n_driver = 0                      !! drivers that are inputs
      integer :: n_rate = 0                        !! rates of the system
      real(wp), allocatable :: direction(:, :)     !! (rates, free + drivers) D and W [any]
      real(wp), allocatable :: reading(:, :)       !! (rates, free) M D [any]
      real(wp), allocatable :: drift(:, :)         !! (rates, free + drivers) E [any]
      real(wp), allocatable :: bend(:, :)          !! (free, free + drivers) what E adds to accelerations [1/s^2]
      real(wp), allocatable :: carry(:, :)         !! (free, free) C [1/s]
      real(wp) :: unsteady = 0.0_wp                !! maximum rate of D and M that the axes do not explain, over speeds [1]
   contains
      procedure :: find => find_frame
      procedure :: to_state
      procedure :: turned
   end type motion_frame_t

contains

   !> Find the directions at a state. Status 0: done.
   subroutine find_frame(self, system, t, y, rows, axes, status)
      class(motion_frame_t), intent(inout) :: self    !! new
      type(mechanism_t), intent(inout) :: system      !! the system, all of whose bodies are unknown
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      integer, intent(in) :: rows(:)                  !! (drivers) their rows
      integer, intent(in) :: axes                     !! body with whose axes the directions turn, 0: those of the world
      integer, intent(out) :: status                  !! 0: found

      real(wp), allocatable :: all(:, :), read_all(:, :)
      integer :: k

      self%n_rate = system%linkage%n_rate
      self%n_driver = size(rows)
      allocate (all(self%n_rate, self%n_rate), read_all(self%n_rate, self%n_rate), source=0.0_wp)
      call system%free_directions(t, y, self%n_free, all, read_all)
      self%reading = read_all(:, :self%n_free)
      allocate (self%direction(self%n_rate, self%n_free + self%n_driver), source=0.0_wp)
      self%direction(:, :self%n_free) = all(:, :self%n_free)
      status = 0
      do k = 1, self%n_driver
         system%linkage%solution%b = 0.0_wp
         system%linkage%solution%b(rows(k)) = 1.0_wp
         call solved_change(system, y, self%direction(:, self%n_free + k), status)
         if (status /= 0) return
      end do
      call find_drift(self, system, t, y, status)
      if (status == 0) call find_turning(self, system, t, y, axes)
   end subroutine find_frame

   !> Local change of the rates that the rows ask for by `b`, the minimum one in the metric of the masses.
   subroutine solved_change(system, y, change, status)
      type(mechanism_t), intent(inout) :: system      !! the system, rows evaluated, b set
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      real(wp), intent(out) :: change(:)              !! (rates) local change [any]
      integer, intent(out) :: status                  !! 0: found

      real(wp) :: local(2*size(change) + size(y)), moved(size(y))

      call system%linkage%solve_rows(status)
      moved = 0.0_wp
      call system%linkage%add_change(.true., moved)
      associate (m => system%n - system%n_quadrature)
         call system%to_local(y, moved(:m), local(:m - system%traits%n_turning))
      end associate
      change = local(size(change) + 1:2*size(change))
   end subroutine solved_change

   !> E, and what it adds to accelerations: $D^T \dot M E + E^T M E$, for $D^T M \dot E$ is minus that.
   subroutine find_drift(self, system, t, y, status)
      class(motion_frame_t), intent(inout) :: self    !! directions found; the rest is set
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      integer, intent(out) :: status                  !! 0: found

      real(wp), dimension(size(self%direction, 1)) :: mass, none
      real(wp) :: change(system%n), moved(system%n), rates(max(1, system%linkage%rows%n))
      real(wp) :: step
      integer :: i, k

      status = 0
      allocate (self%drift(self%n_rate, size(self%direction, 2)), source=0.0_wp)
      allocate (self%bend(self%n_free, size(self%direction, 2)), source=0.0_wp)
      associate (linkage => system%linkage, v => y(system%linkage%n_position + 1:system%linkage%n_position + self%n_rate))
         if (linkage%rows%n_solve == 0 .or. .not. any(abs(v) > 0.0_wp)) return
         none = 0.0_wp
         do k = 1, size(self%direction, 2)
            call self%to_state(system, y, self%direction(:, k), none, change)
            step = near/max(tiny(1.0_wp), maxval(abs(self%direction(:, k)) &
                                                 /linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)))
            rates = 0.0_wp
            do i = 1, size(stencil)
               moved = y + stencil(i)*step*change
               call linkage%set_motion(t, moved)
               call linkage%evaluate_rows(t)
               rates(:linkage%rows%n) = rates(:linkage%rows%n) + stencil_weight(i)/step*linkage%solution%phi_dot
            end do
            call linkage%set_motion(t, y)
            call linkage%evaluate_rows(t)
            linkage%solution%b = -rates(:linkage%rows%n)
            call solved_change(system, y, self%drift(:, k), status)
            if (status /= 0) return
         end do
         mass = reshape(linkage%mass(:, linkage%rows%unknown), [self%n_rate])
         associate (d => self%direction(:, :self%n_free), e => self%drift)
            self%bend = matmul(transpose(e(:, :self%n_free)), scaled(mass, e)) &
                        - matmul(transpose(spun(d)), scaled(mass, e)) - matmul(transpose(scaled(mass, d)), spun(e))
         end associate
      end associate

   contains

      !> Columns, each rotation crossed by the spin of its body.
      function spun(x) result(columns)
         real(wp), intent(in) :: x(:, :)                         !! (rates, n) local changes [any]
         real(wp) :: columns(size(x, 1), size(x, 2))             !! (rates, n) spin times x [any]

         integer :: j

         do j = 1, size(x, 2)
            columns(:, j) = self%turned(system, x(:, j))
         end do
      end function spun

   end subroutine find_drift

   !> Columns times factors of their rows.
   pure function scaled(factor, x) result(columns)
      real(wp), intent(in) :: factor(:)                       !! (rows) factors [any]
      real(wp), intent(in) :: x(:, :)                         !! (rows, n) columns [any]
      real(wp) :: columns(size(x, 1), size(x, 2))             !! (rows, n) factor times x [any]

      columns = spread(factor, 2, size(x, 2))*x
   end function scaled

   !> C, and how much the motion is not steady in the axes.
   subroutine find_turning(self, system, t, y, axes)
      class(motion_frame_t), intent(inout) :: self    !! drift found; the rest is set
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      integer, intent(in) :: axes                     !! body whose axes turn, 0: those of the world

      real(wp), dimension(size(self%direction, 1), self%n_free) :: left, spun, swept
      real(wp) :: inertia(self%n_free, self%n_free), omega(3), rate
      integer :: j

      call system%linkage%set_motion(t, y)
      omega = system%linkage%motion%omega(:, axes)
      do j = 1, self%n_free
         swept(:, j) = self%turned(system, self%direction(:, j), omega)
         spun(:, j) = self%turned(system, self%direction(:, j))
      end do
      inertia = matmul(transpose(self%reading), spun - swept)
      inertia = inertia + transpose(inertia)
      self%carry = matmul(transpose(self%reading), swept)
      left = self%drift(:, :self%n_free) + matmul(self%direction(:, :self%n_free), self%carry) - swept
      rate = max(norm2(omega), maxval([0.0_wp, norm2(system%linkage%motion%omega, dim=1)]))
      self%unsteady = 0.0_wp
      if (self%n_free == 0) return
      associate (root => sqrt(reshape(system%linkage%mass(:, system%linkage%rows%unknown), [self%n_rate])))
         self%unsteady = max(maxval(abs(spread(root, 2, self%n_free)*left)), maxval(abs(inertia)))
      end associate
      if (self%unsteady > 0.0_wp) self%unsteady = self%unsteady/max(rate, self%unsteady)
   end subroutine find_turning

   !> The change of the state that local displacements and rates are; other states and quadratures do not change.
   subroutine to_state(self, system, y, x, w, change)
      class(motion_frame_t), intent(in) :: self       !! the directions
      type(mechanism_t), intent(in) :: system         !! the system
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      real(wp), intent(in) :: x(:)                    !! (rates) local displacements [any]
      real(wp), intent(in) :: w(:)                    !! (rates) local change of the rates [any]
      real(wp), intent(out) :: change(:)              !! (n) change of the state [any]

      real(wp) :: local(2*size(x) + size(y))

      local = 0.0_wp
      local(:self%n_rate) = x
      local(self%n_rate + 1:2*self%n_rate) = w
      change = 0.0_wp
      associate (m => system%n - system%n_quadrature)
         call system%from_local(y, local(:m - system%traits%n_turning), change(:m))
      end associate
   end subroutine to_state

   !> What turning makes of a local change: of each body its rotation crossed by its own spin, or all of it by a given speed.
   function turned(self, system, x, omega) result(rate)
      class(motion_frame_t), intent(in) :: self       !! for the number of rates
      type(mechanism_t), intent(in) :: system         !! the system, its motion set
      real(wp), intent(in) :: x(:)                    !! (rates) local change [any]
      real(wp), intent(in), optional :: omega(3)      !! (3) a speed, world frame; absent: spins, of rotations only [rad/s]
      real(wp) :: rate(self%n_rate)                   !! (rates) its rate [any]

      real(wp) :: axis(3), vector(3)
      integer :: body, first, k, last, n_move, n_turn

      rate = 0.0_wp
      associate (coordinates => system%linkage%coordinates, motion => system%linkage%motion)
         n_turn = count(coordinates%is_turn)
         n_move = coordinates%n_v - n_turn
         do k = 1, system%linkage%rows%n_unknown
            body = system%linkage%rows%unknown(k)
            first = coordinates%n_v*(k - 1)
            last = first + coordinates%n_v
            if (present(omega)) then
               axis = omega
               if (coordinates%turns_in_body) axis = matmul(omega, motion%rot(:, :, body))
               vector = 0.0_wp
               vector(:n_move) = x(first + 1:first + n_move)
               vector = cross(axis, vector)
               rate(first + 1:first + n_move) = vector(:n_move)
            else
               axis = matmul(motion%omega(:, body), motion%rot(:, :, body))
            end if
            if (n_turn < size(vector)) cycle  ! about one axis: turns commute
            rate(first + n_move + 1:last) = cross(axis, x(first + n_move + 1:last))
         end do
      end associate
   end function turned

end module motion_frame
