!> Fits the table of `finite_bearing` to films on a grid.
!>
!> For each of n_ratio Chebyshev nodes of log(L/D): states all over the half disc of the table's coordinates, S and its derivative
!> along the direction of v from the forces of the grid, least squares with weights that make residuals errors of force over
!> force. A little of the second differences holds coefficients outside the disc.
module finite_fit
   use finite_bearing, only: basis, finite_place, finite_place_t, max_lambda, max_ratio, knot_distance, min_ratio, &
      n_local, n_mu, n_nu, n_ratio
   use kinds, only: pi, wp
   use lapack, only: dgels
   use reynolds_grid, only: boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t, get_result
   implicit none (type, external)
   private
   public :: fit_ratio, node_ratio, to_polynomials

   integer, parameter :: n_column = 240                    !! columns of the grid
   integer, parameter :: n_row = 24                        !! rows of the half length
   real(wp), parameter :: lattice = 0.17_wp                !! distance of states in the disc [1]
   integer, parameter :: n_side = ceiling(max_lambda/lattice)  !! states on a side of the disc
   integer, parameter :: n_edge = 60                       !! states on the rim, and on the axis
   integer, parameter :: n_unknown = (n_nu + 1)*(2*n_mu + 1)  !! splines
   real(wp), parameter :: roughness = 1.0e-3_wp            !! weight of second differences [1]

contains

   !> L/D of a node.
   pure real(wp) function node_ratio(k)
      integer, intent(in) :: k  !! which, 1 to n_ratio

      node_ratio = sqrt(min_ratio*max_ratio)*sqrt(max_ratio/min_ratio)**cos(pi*(k - 0.5_wp)/n_ratio)
   end function node_ratio

   !> Splines of one L/D, and the maximum error of force over force at the states.
   subroutine fit_ratio(ratio, coefficient, max_error)
      real(wp), intent(in) :: ratio                                   !! L/D [1]
      real(wp), intent(out) :: coefficient(0:n_nu, -n_mu:n_mu)        !! (0:n_nu, -n_mu:n_mu) splines of S [1]
      real(wp), intent(out) :: max_error                         !! maximum residual [1]

      real(wp), allocatable :: a(:, :), b(:), kept(:, :), work(:)
      integer :: info, n_data, n_row_used

      allocate (a(2*(2*n_side*n_side + 2*n_edge + 2) + 2*n_unknown, n_unknown), source=0.0_wp)
      allocate (b(size(a, 1)), source=0.0_wp)
      allocate (work(64*size(a, 1)), source=0.0_wp)
      n_row_used = 0
      call add_states(ratio, a, b, n_row_used)
      n_data = n_row_used
      call add_roughness(a, n_row_used)
      kept = a(:n_data, :)
      work(:n_data) = b(:n_data)
      kept = reshape([kept, work(:n_data)], [n_data, n_unknown + 1])
      call dgels("N", n_row_used, n_unknown, 1, a, size(a, 1), b, size(b), work, size(work), info)
      if (info /= 0) error stop "the fit has no solution"
      coefficient = reshape(b(:n_unknown), [n_nu + 1, 2*n_mu + 1])
      max_error = maxval(abs(matmul(kept(:, :n_unknown), b(:n_unknown)) - kept(:, n_unknown + 1)))
   end subroutine fit_ratio

   !> States over the disc, each near to the one before, on its axis and on its rim.
   subroutine add_states(ratio, a, b, n)
      real(wp), intent(in) :: ratio         !! L/D [1]
      real(wp), intent(inout) :: a(:, :)    !! (:, n_unknown) equations [1]
      real(wp), intent(inout) :: b(:)       !! (:) right-hand sides [1]
      integer, intent(inout) :: n           !! equations so far

      type(reynolds_grid_t) :: grid
      type(supply_t) :: none(0)
      real(wp) :: angle, mu, nu
      integer :: i, k

      call new_reynolds_grid(grid, ratio, n_column, n_row, boundary_reynolds, none, .false.)
      do k = 1, n_side
         nu = (k - 0.5_wp)*lattice
         do i = 1, 2*n_side
            mu = (-1)**k*(i - n_side - 0.5_wp)*lattice
            if (hypot(mu, nu) < max_lambda) call add_state(grid, mu, nu, a, b, n)
         end do
      end do
      do k = 0, n_edge
         angle = pi*k/n_edge
         call add_state(grid, max_lambda*cos(angle), max_lambda*sin(angle), a, b, n)
      end do
      do k = 0, n_edge
         call add_state(grid, max_lambda*(2.0_wp*k/n_edge - 1.0_wp), 0.0_wp, a, b, n)
      end do
   end subroutine add_states

   !> The two equations of a state: force along v and across it.
   subroutine add_state(grid, mu, nu, a, b, n)
      type(reynolds_grid_t), intent(inout) :: grid  !! the grid
      real(wp), intent(in) :: mu, nu                !! coordinates of the state [1]
      real(wp), intent(inout) :: a(:, :)            !! (:, n_unknown) equations [1]
      real(wp), intent(inout) :: b(:)               !! (:) right-hand sides [1]
      integer, intent(inout) :: n                   !! equations so far

      type(journal_state_t) :: state
      type(film_result_t) :: film
      type(finite_place_t) :: place
      real(wp) :: eps, g, g_turn, lambda, slope(n_unknown), turn, value(n_unknown), x
      integer :: status

      lambda = hypot(mu, nu)
      eps = tanh(lambda)
      x = sinh(mu)/cosh(lambda)
      turn = sqrt(max((eps - x)*(eps + x), 0.0_wp))
      state%e = [eps, 0.0_wp]
      state%v = [1.0_wp, 0.0_wp]
      if (eps > 0.0_wp) state%v = [x, turn]/eps
      call grid%solve(state, status)
      if (status /= 0) error stop "a film has no solution"
      call get_result(grid, film)
      call finite_place(grid%ratio, eps, x, place)
      call spline_row(mu, max(nu, 1.0e-6_wp), value, slope)
      ! f.u = -2 G and f.(z x u) = -dG/d(angle of v); x falls with that angle by `turn`
      g = -0.5_wp*dot_product(film%f, state%v)
      g_turn = -dot_product(film%f, [-state%v(2), state%v(1)])
      associate (weight => 1.0_wp/hypot(2.0_wp, g_turn/g))
         n = n + 1
         a(n, :) = 2.0_wp*weight*value
         b(n) = 2.0_wp*weight*log(g/place%g)
         n = n + 1
         a(n, :) = weight*slope*turn/place%a
         b(n) = weight*(-g_turn/g - place%a_slope*turn/place%a)
      end associate
   end subroutine add_state

   !> Splines at a place, and a times their derivatives over x.
   subroutine spline_row(mu, nu, value, slope)
      real(wp), intent(in) :: mu, nu                !! the place, nu above 0 [1]
      real(wp), intent(out) :: value(n_unknown)     !! (n_unknown) splines [1]
      real(wp), intent(out) :: slope(n_unknown)     !! (n_unknown) a times their derivatives [1]

      real(wp), dimension(n_local) :: b, b_slope, c, c_slope
      integer :: first, i, j, k, second

      first = floor(mu/knot_distance)
      second = floor(nu/knot_distance)
      call basis(mu/knot_distance - first, b, b_slope)
      call basis(nu/knot_distance - second, c, c_slope)
      value = 0.0_wp
      slope = 0.0_wp
      do i = 1, n_local
         do j = 1, n_local
            k = abs(second - 3 + j) + 1 + (n_nu + 1)*(first - 3 + i + n_mu)
            value(k) = value(k) + b(i)*c(j)
            slope(k) = slope(k) + (b_slope(i)*c(j) - mu/nu*b(i)*c_slope(j))/knot_distance
         end do
      end do
   end subroutine spline_row

   !> Second differences of neighbours, which hold what no state reaches.
   pure subroutine add_roughness(a, n)
      real(wp), intent(inout) :: a(:, :)  !! (:, n_unknown) equations [1]
      integer, intent(inout) :: n         !! equations so far

      integer :: i, j, k

      do i = 0, 2*n_mu
         do j = 0, n_nu
            k = j + 1 + (n_nu + 1)*i
            if (j > 0 .and. j < n_nu) then
               n = n + 1
               a(n, [k - 1, k, k + 1]) = roughness*[1.0_wp, -2.0_wp, 1.0_wp]
            end if
            if (i > 0 .and. i < 2*n_mu) then
               n = n + 1
               a(n, [k - n_nu - 1, k, k + n_nu + 1]) = roughness*[1.0_wp, -2.0_wp, 1.0_wp]
            end if
         end do
      end do
   end subroutine add_roughness

   !> Coefficients of Chebyshev polynomials from values at the nodes.
   pure function to_polynomials(values) result(coefficient)
      real(wp), intent(in) :: values(n_ratio)  !! (n_ratio) at the nodes [1]
      real(wp) :: coefficient(n_ratio)         !! (n_ratio) of the polynomials [1]

      integer :: i, k

      do i = 1, n_ratio
         coefficient(i) = 2.0_wp/n_ratio*sum([(values(k)*cos(pi*(i - 1)*(k - 0.5_wp)/n_ratio), k=1, n_ratio)])
      end do
      coefficient(1) = 0.5_wp*coefficient(1)
   end function to_polynomials

end module finite_fit
