!> The film of a bearing of finite length: a stored potential, for L/D from 1/4 to 4.
!>
!> The force of a film at pressures that are not below zero is minus the gradient, over the velocity v that squeezes, of a potential
!> of degree 2 (`reynolds_grid`). It is stored as one function of where the journal is and how v lies to it. With e in parts of the
!> clearance, eps = |e|, q^2 = 1 - eps^2, u = v/|v| and x = e.u,
!>
!> Psi = |v|^2 G,   log G = log(m^(3/2) a^(1/2)/q^3) - log(1 + 2 a (a - x)/(L/D)^2) + S,   a = sqrt(x^2 + q^2),   m = (a + x)/2
!> f = -grad Psi = -|v| G [(2 - x G_x/G) u + (G_x/G) e]
!>
!> where the first two terms have the powers of q of a long film that approaches (-3), slides (-1) and parts (0), and their short
!> counterparts; what is left, S, is tame: a tensor product of uniform quintic splines over
!>
!> mu = asinh(x/q) from -lambda to lambda,   nu = sqrt(lambda^2 - mu^2),   lambda = atanh(eps),
!>
!> even in nu, and of Chebyshev polynomials of log(L/D). In this half plane S is smooth everywhere, at e = 0 too, and no part
!> of it needs a finer grid than others. So f.v = -2 Psi <= 0 by construction, f is homogeneous of degree 1 in v and has
!> continuous second derivatives wherever v is not zero.
!>
!> Beyond lambda = 4.2 (eps = 0.99955) S grows still towards its value at 4.6, while the powers of q continue. Forces are those on
!> the journal over mu L R^3/c^2. Source: fitted to `reynolds_grid`; `make film-table` writes finite_table.inc anew. Limits: L/D
!> from 1/4 to 4, no grooves, lubricant at no pressure at the ends.
module finite_bearing
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: basis, finite_force, finite_place, finite_place_t, finite_weights, max_lambda, max_ratio, knot_distance
   public :: min_ratio, n_local, n_mu, n_nu, n_ratio

   integer, parameter :: n_ratio = 8   !! polynomials of log(L/D)
   integer, parameter :: n_nu = 12     !! splines over nu: 0 to n_nu, two more below zero that are mirrored
   integer, parameter :: n_mu = 12     !! splines over mu: -n_mu to n_mu
   integer, parameter :: n_local = 6   !! splines that are not zero at a place, one more than their degree
   real(wp), parameter :: knot_distance = 0.5_wp    !! of the splines [1]
   real(wp), parameter :: min_ratio = 0.25_wp     !! minimum L/D [1]
   real(wp), parameter :: max_ratio = 4.0_wp   !! maximum L/D [1]
   real(wp), parameter :: fitted_lambda = 4.2_wp    !! up to here S is that of the grid [1]
   real(wp), parameter :: max_lambda = 4.6_wp  !! where it ends [1]
   real(wp), parameter :: blend = 2.0_wp            !! of short and long powers [1]
   real(wp), parameter :: min_nu = 1.0e-6_wp      !! S is even in nu: closer to zero it does not matter [1]

   include "finite_table.inc"

   !> Where a state lies in the table, and what is known of its potential.
   type :: finite_place_t
      real(wp) :: mu = 0.0_wp         !! first coordinate [1]
      real(wp) :: nu = 0.0_wp         !! second coordinate, above 0 [1]
      real(wp) :: narrowed = 1.0_wp   !! both were multiplied by it beyond fitted_lambda [1]
      real(wp) :: a = 1.0_wp          !! a [1]
      real(wp) :: g = 1.0_wp          !! G without exp(S) [1]
      real(wp) :: a_slope = 0.0_wp    !! a times d(log G)/dx without that of S [1]
   end type finite_place_t

contains

   !> What the polynomials of log(L/D) are for a bearing.
   pure function finite_weights(ratio) result(weights)
      real(wp), intent(in) :: ratio  !! L/D, from least_ratio to greatest_ratio [1]
      real(wp) :: weights(n_ratio)   !! (n_ratio) Chebyshev polynomials [1]

      real(wp) :: z
      integer :: k

      z = log(ratio/sqrt(min_ratio*max_ratio))/log(sqrt(max_ratio/min_ratio))
      weights(1:2) = [1.0_wp, z]
      do k = 3, n_ratio
         weights(k) = 2.0_wp*z*weights(k - 1) - weights(k - 2)
      end do
   end function finite_weights

   !> Coordinates of a state and the known part of its potential.
   pure subroutine finite_place(ratio, eps, x, place)
      real(wp), intent(in) :: ratio               !! L/D [1]
      real(wp), intent(in) :: eps                 !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: x                   !! e.u [1]
      type(finite_place_t), intent(out) :: place  !! the place

      real(wp) :: a_less_x, large, lambda, long, q, q2, short

      q2 = (1.0_wp - eps)*(1.0_wp + eps)
      q = sqrt(q2)
      place%a = sqrt(x*x + q2)
      large = place%a + abs(x)
      a_less_x = merge(q2/large, large, x >= 0.0_wp)
      long = 0.5_wp*q2/a_less_x
      short = blend*a_less_x/(ratio*ratio)
      place%g = long*sqrt(long*place%a)/(q*q2*(1.0_wp + short*place%a))
      place%a_slope = 1.5_wp + 0.5_wp*x/place%a + short*a_less_x/(1.0_wp + short*place%a)
      lambda = log((1.0_wp + eps)/q)
      place%mu = sign(log(large/q), x)
      place%narrowed = 1.0_wp
      if (lambda > fitted_lambda) place%narrowed = (fitted_lambda + (max_lambda - fitted_lambda) &
                                                    *tanh((lambda - fitted_lambda)/(max_lambda - fitted_lambda)))/lambda
      place%nu = place%narrowed*max(sqrt(max((lambda - place%mu)*(lambda + place%mu), 0.0_wp)), min_nu)
      place%mu = place%narrowed*place%mu
   end subroutine finite_place

   !> The six splines that are not zero at t of an interval, 0 to 1, and their derivatives over t: centred at knots -2 to 3 from the
   !> start of the interval.
   pure subroutine basis(t, value, slope)
      real(wp), intent(in) :: t                  !! place in the interval [1]
      real(wp), intent(out) :: value(n_local)    !! (n_local) splines [1]
      real(wp), intent(out) :: slope(n_local)    !! (n_local) their derivatives [1]

      real(wp), parameter :: power(n_local, 0:5) = reshape([ &
                             1.0_wp, 26.0_wp, 66.0_wp, 26.0_wp, 1.0_wp, 0.0_wp, &
                             -5.0_wp, -50.0_wp, 0.0_wp, 50.0_wp, 5.0_wp, 0.0_wp, &
                             10.0_wp, 20.0_wp, -60.0_wp, 20.0_wp, 10.0_wp, 0.0_wp, &
                             -10.0_wp, 20.0_wp, 0.0_wp, -20.0_wp, 10.0_wp, 0.0_wp, &
                             5.0_wp, -20.0_wp, 30.0_wp, -20.0_wp, 5.0_wp, 0.0_wp, &
                             -1.0_wp, 5.0_wp, -10.0_wp, 10.0_wp, -5.0_wp, 1.0_wp], [n_local, 6])/120.0_wp
         !! (n_local, 0:5) coefficients of powers of t [1]
      integer :: k

      value = power(:, 5)
      slope = 5.0_wp*power(:, 5)
      do k = 4, 1, -1
         value = value*t + power(:, k)
         slope = slope*t + real(k, wp)*power(:, k)
      end do
      value = value*t + power(:, 0)
   end subroutine basis

   !> S and its derivatives over mu and nu.
   pure subroutine remainder(weights, mu, nu, s, s_mu, s_nu)
      real(wp), intent(in) :: weights(n_ratio)  !! (n_ratio) of the bearing [1]
      real(wp), intent(in) :: mu, nu            !! place in the table [1]
      real(wp), intent(out) :: s                !! S [1]
      real(wp), intent(out) :: s_mu, s_nu       !! its derivatives [1]

      real(wp), dimension(n_local) :: b, b_slope, c, c_slope
      real(wp), dimension(n_ratio) :: all, all_mu, all_nu, row, row_nu
      integer :: i, i_first, j_first

      ! within the table even for what is no number
      i_first = min(max(floor(mu/knot_distance), n_local/2 - 1 - n_mu), n_mu - n_local/2)
      j_first = min(max(floor(nu/knot_distance), 0), n_nu - n_local/2)
      call basis(mu/knot_distance - real(i_first, wp), b, b_slope)
      call basis(nu/knot_distance - real(j_first, wp), c, c_slope)
      all = 0.0_wp
      all_mu = 0.0_wp
      all_nu = 0.0_wp
      do i = 1, n_local
         call contract(table(1, j_first - 2, i_first - 3 + i), c, c_slope, row, row_nu)
         all = all + b(i)*row
         all_mu = all_mu + b_slope(i)*row
         all_nu = all_nu + b(i)*row_nu
      end do
      s = sum(weights*all)
      s_mu = sum(weights*all_mu)/knot_distance
      s_nu = sum(weights*all_nu)/knot_distance
   end subroutine remainder

   !> Sums over the splines of nu.
   pure subroutine contract(block, c, c_slope, row, row_nu)
      real(wp), intent(in) :: block(n_ratio, n_local)  !! (n_ratio, n_local) part of the table [1]
      real(wp), intent(in) :: c(n_local)               !! (n_local) splines [1]
      real(wp), intent(in) :: c_slope(n_local)         !! (n_local) their derivatives [1]
      real(wp), intent(out) :: row(n_ratio)            !! (n_ratio) sums with the splines [1]
      real(wp), intent(out) :: row_nu(n_ratio)         !! (n_ratio) sums with their derivatives [1]

      row = c(1)*block(:, 1) + c(2)*block(:, 2) + c(3)*block(:, 3) + c(4)*block(:, 4) + c(5)*block(:, 5) + c(6)*block(:, 6)
      row_nu = c_slope(1)*block(:, 1) + c_slope(2)*block(:, 2) + c_slope(3)*block(:, 3) + c_slope(4)*block(:, 4) &
               + c_slope(5)*block(:, 5) + c_slope(6)*block(:, 6)
   end subroutine contract

   !> The force. Zero with v; |e| below 1.
   pure subroutine finite_force(ratio, weights, e, v, f)
      real(wp), intent(in) :: ratio             !! L/D [1]
      real(wp), intent(in) :: weights(n_ratio)  !! (n_ratio) `finite_weights` of it [1]
      real(wp), intent(in) :: e(2)              !! (2) eccentricity, in any frame [1]
      real(wp), intent(in) :: v(2)              !! (2) e' - (w_J + w_B)/2 z x e, same frame [1/s]
      real(wp), intent(out) :: f(2)             !! (2) force on the journal over mu L R^3/c^2, same frame [1/s]

      type(finite_place_t) :: place
      real(wp) :: s, s_mu, s_nu, slope, speed, u(2), x

      f = 0.0_wp
      speed = sqrt(v(1)*v(1) + v(2)*v(2))
      if (.not. speed > tiny(1.0_wp)) return
      u = v/speed
      x = e(1)*u(1) + e(2)*u(2)
      call finite_place(ratio, sqrt(e(1)*e(1) + e(2)*e(2)), x, place)
      call remainder(weights, place%mu, place%nu, s, s_mu, s_nu)
      slope = (place%a_slope + place%narrowed*(s_mu - place%mu*s_nu/place%nu))/place%a
      f = -speed*place%g*exp(s)*((2.0_wp - x*slope)*u + slope*e)
   end subroutine finite_force

end module finite_bearing
