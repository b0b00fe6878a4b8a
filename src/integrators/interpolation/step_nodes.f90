!> States within a step, the nodes of a polynomial with the two ends of the step.
!>
!> With places s_k of the step, 0 and 1 among them, and l_k the polynomials of Lagrange through them,
!>
!> $$ y(s) = \sum_k H_k(s) y_k + h G_k(s) f_k, H_k = (1 - 2 (s - s_k) l_k'(s_k)) l_k^2, G_k = (s - s_k) l_k^2 $$
!>
!> has the states y_k and the derivatives f_k there. With n places its error is h^(2n) y^(2n)/(2n)! times the product of
!> (s - s_k)^2. Where the step is stiff, derivatives multiply the errors of states, and the polynomial of Lagrange through the
!> states alone is taken. Source: J. Stoer and R. Bulirsch, Introduction to Numerical Analysis, 3rd ed. (2002), section 2.1.5.
module step_nodes
   use interpolation, only: step_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: step_nodes_t

   integer, parameter :: most = 5                      !! nodes within a step, at most
   real(wp), parameter :: min_distance = 0.02_wp     !! between two nodes, over the length of the step [1]
   real(wp), parameter :: wide = 4.0_wp                !! gap between nodes over the distance of rows, from which on a node between
                                                       !! them saves rows [1]

   !> The states of one step.
   type :: step_nodes_t
      logical :: are_of_use = .true.       !! whether the polynomial may be accurate enough
      logical, private :: with_rates = .true.  !! whether it has the derivatives of the nodes
      real(wp), private :: t0 = 0.0_wp     !! start of the step [s]
      real(wp), private :: h = 0.0_wp      !! its length, 0 before the first step [s]
      real(wp), private :: s_row = 0.0_wp  !! place of the last row [1]
      real(wp), allocatable, private :: y_row(:)  !! (all) its state: a row has one, whoever asks for it [any]
      integer, private :: n = 0            !! states within it
      real(wp), private :: s(most) = 0.0_wp  !! (n) their places in the step [1]
      real(wp), allocatable, private :: y(:, :)  !! (all, most) the states [any]
      real(wp), allocatable, private :: f(:, :)  !! (all, most) their derivatives [any]
   contains
      procedure :: open => nodes_open
      procedure :: begin => nodes_begin
      procedure :: add => nodes_add
      procedure :: is_full => nodes_is_full
      procedure :: place_for => nodes_place_for
      procedure :: keep_row => nodes_keep_row
      procedure :: has_row => nodes_has_row
      procedure :: interpolate => nodes_interpolate
   end type step_nodes_t

contains

   !> Storage for states.
   pure subroutine nodes_open(self, n)
      class(step_nodes_t), intent(inout) :: self  !! the states
      integer, intent(in) :: n                    !! entries of a state

      allocate (self%y(n, most), self%f(n, most), self%y_row(n), source=0.0_wp)
   end subroutine nodes_open

   !> Discard the nodes of another step.
   pure subroutine nodes_begin(self, step, with_rates)
      class(step_nodes_t), intent(inout) :: self  !! the states
      type(step_t), intent(in) :: step            !! the step
      logical, intent(in) :: with_rates           !! whether the polynomial is to have the derivatives of the nodes

      self%with_rates = with_rates
      if (abs(self%t0 - step%t0) <= 0.0_wp .and. abs(self%h - step%h) <= 0.0_wp) return
      self%t0 = step%t0
      self%h = step%h
      self%n = 0
      self%s_row = 0.0_wp
      self%are_of_use = .true.
   end subroutine nodes_begin

   !> Add a node, unless the storage is full or another node is too near.
   pure subroutine nodes_add(self, s, y, f)
      class(step_nodes_t), intent(inout) :: self  !! the states
      real(wp), intent(in) :: s                   !! its place in the step, 0 to 1 [1]
      real(wp), intent(in) :: y(:)                !! (all) the state [any]
      real(wp), intent(in), optional :: f(:)      !! (all) its derivative; absent: the polynomial is that of Lagrange [any]

      if (self%n == most .or. any(abs(s - [0.0_wp, self%s(:self%n), 1.0_wp]) < min_distance)) return
      self%n = self%n + 1
      self%s(self%n) = s
      self%y(:, self%n) = y
      if (present(f)) self%f(:, self%n) = f
   end subroutine nodes_add

   !> Whether the storage is full.
   pure logical function nodes_is_full(self)
      class(step_nodes_t), intent(in) :: self  !! the states

      nodes_is_full = self%n == most
   end function nodes_is_full

   !> Place of the node that serves a row: the row itself, or the middle of the gap between nodes that it lies in, where many rows
   !> may follow in that gap.
   pure real(wp) function nodes_place_for(self, s) result(place)
      class(step_nodes_t), intent(in) :: self  !! the states
      real(wp), intent(in) :: s                !! place of the row, 0 to 1 [1]

      real(wp) :: after, before

      before = max(0.0_wp, maxval(self%s(:self%n), mask=self%s(:self%n) <= s))
      after = min(1.0_wp, minval(self%s(:self%n), mask=self%s(:self%n) > s))
      place = s
      if (self%n < most .and. after - before > max(2.0_wp*min_distance, wide*abs(s - self%s_row))) place = 0.5_wp*(before + after)
   end function nodes_place_for

   !> A row was given at a place.
   pure subroutine nodes_keep_row(self, s, y)
      class(step_nodes_t), intent(inout) :: self  !! the states
      real(wp), intent(in) :: s                   !! the place, 0 to 1 [1]
      real(wp), intent(in) :: y(:)                !! (all) its state [any]

      self%s_row = s
      self%y_row(:) = y
   end subroutine nodes_keep_row

   !> Whether the last row was at just this place of the step; then its state.
   pure subroutine nodes_has_row(self, s, y, has_row)
      class(step_nodes_t), intent(in) :: self     !! the states
      real(wp), intent(in) :: s                   !! the place, above 0, to 1 [1]
      real(wp), intent(inout) :: y(:)             !! (all) the state, if it was [any]
      logical, intent(out) :: has_row             !! whether it was

      has_row = abs(s - self%s_row) <= 0.0_wp
      if (has_row) y(:) = self%y_row
   end subroutine nodes_has_row

   !> State and derivative at a place of the step.
   pure subroutine nodes_interpolate(self, step, s, y, f)
      class(step_nodes_t), intent(in) :: self  !! the states
      type(step_t), intent(in) :: step         !! the step that they are of
      real(wp), intent(in) :: s                !! the place, 0 to 1 [1]
      real(wp), intent(out) :: y(:)            !! (all) the state [any]
      real(wp), intent(out) :: f(:)            !! (all) its derivative [any]

      real(wp), dimension(most + 2) :: places
      real(wp) :: factor(4)
      integer :: k, n

      n = self%n + 2
      places(:n) = [0.0_wp, self%s(:self%n), 1.0_wp]
      factor = factors(places(:n), 1, s, step%h, self%with_rates)
      y = factor(1)*step%y0 + factor(2)*step%f0
      f = factor(3)*step%y0 + factor(4)*step%f0
      factor = factors(places(:n), n, s, step%h, self%with_rates)
      y = y + factor(1)*step%y1 + factor(2)*step%f1
      f = f + factor(3)*step%y1 + factor(4)*step%f1
      do k = 1, self%n
         factor = factors(places(:n), k + 1, s, step%h, self%with_rates)
         y = y + factor(1)*self%y(:, k) + factor(2)*self%f(:, k)
         f = f + factor(3)*self%y(:, k) + factor(4)*self%f(:, k)
      end do
   end subroutine nodes_interpolate

   !> Coefficients of y_k and f_k in y(s), and in its derivative by time.
   pure function factors(places, k, s, h, with_rates) result(found)
      real(wp), intent(in) :: places(:)   !! (any) s_k [1]
      integer, intent(in) :: k            !! the node
      real(wp), intent(in) :: s           !! the place, 0 to 1 [1]
      real(wp), intent(in) :: h           !! length of the step [s]
      logical, intent(in) :: with_rates   !! whether the polynomial is that of Hermite, else that of Lagrange
      real(wp) :: found(4)                !! (4) of y_k [1], of f_k [s], and their derivatives [1/s, 1]

      real(wp) :: a, b, d, l, l_rate
      integer :: j, m

      l = 1.0_wp
      l_rate = 0.0_wp
      d = 0.0_wp
      do j = 1, size(places)
         if (j == k) cycle
         b = 1.0_wp/(places(k) - places(j))
         d = d + b
         a = b
         do m = 1, size(places)
            if (m == k .or. m == j) cycle
            a = a*(s - places(m))/(places(k) - places(m))
         end do
         l_rate = l_rate + a
         l = l*(s - places(j))*b
      end do
      if (.not. with_rates) then
         found = [l, 0.0_wp, l_rate/h, 0.0_wp]
         return
      end if
      a = s - places(k)
      b = 1.0_wp - 2.0_wp*a*d
      found = [b*l*l, h*a*l*l, (2.0_wp*b*l*l_rate - 2.0_wp*d*l*l)/h, l*l + 2.0_wp*a*l*l_rate]
   end function factors

end module step_nodes
