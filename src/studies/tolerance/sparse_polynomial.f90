!> Sparse polynomial chaos: a polynomial of the random numbers of members, fitted to what their runs gave, and its Sobol' indices.
!>
!> $$ f = \sum_\alpha c_\alpha \prod_j p_{\alpha_j}(x_j), \quad D = \sum_{\alpha \ne 0} c_\alpha^2, \quad
!>    S_i = \frac{1}{D}\sum_{\alpha \in A_i} c_\alpha^2, \quad S_{Ti} = \frac{1}{D}\sum_{\alpha \in T_i} c_\alpha^2 , $$
!> p_k orthonormal by the distribution of x_j, A_i terms of contributor i alone, T_i all with it. Terms are those of a total
!> degree; the one that fits the remainder best is added, and as many are kept as make the error of cross-validation least: each
!> fifth of the members is predicted by terms and coefficients from the others, with errors d,
!> $$ \varepsilon = \sum_i d_i^2 \Big/ \sum_i (f_i - \bar f)^2 . $$
!> Intervals of 95 %: each member, of residual r and leverage h, changes the coefficients by R^{-1} q_i r_i/(1 - h_i), Q R the
!> factors of the matrix of terms, and the part of the variance that the polynomial misses may belong to the contributor or to the
!> others:
!> $$ (1 - \varepsilon)(S - 1.96 s), \quad (1 - \varepsilon)(S + 1.96 s) + \varepsilon . $$
!> Sources: G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345-2367 (sparse polynomials); B. Sudret, Reliab. Eng.
!> Syst. Saf. 93 (2008) 964-979 (indices); M. Stone, J. R. Stat. Soc. B 36 (1974) 111-147 (cross-validation); Y. C. Pati,
!> R. Rezaiifar, P. S. Krishnaprasad, Asilomar (1993) (order of terms).
!> Limits: smooth results. In chaotic motion it misses most of the variance.
module sparse_polynomial
   use kinds, only: wp
   use lapack, only: dgemv
   use normal_distribution, only: normal_95
   use orthogonal_polynomials, only: max_degree
   implicit none (type, external)
   private
   public :: fit_polynomial, polynomial_t

   integer, parameter :: most_candidates = 2000             !! terms that are tried
   integer, parameter :: most_terms = 150                   !! terms that are taken
   integer, parameter :: n_fold = 5                         !! parts of the members, each predicted by the others
   real(wp), parameter :: most_values = 4.0e6_wp            !! of candidates at members
   real(wp), parameter :: fits = 1.0e-13_wp                 !! remainder at which a fit is exact, of the values [1]
   real(wp), parameter :: round_off = 1.0e-14_wp            !! shares of a variance below it are round-off [1]

   !> A polynomial.
   type :: polynomial_t
      integer, allocatable :: powers(:, :)        !! (numbers, terms) degree in each number; the first term is constant
      real(wp), allocatable :: c(:)               !! (terms) coefficients [any]
      real(wp) :: missed = 1.0_wp                 !! part of the variance that it misses, by cross-validation [1]
      real(wp), allocatable :: changes(:, :)      !! (terms, members) change of the coefficients that each member makes [any]
   contains
      procedure :: degree => polynomial_degree
      procedure :: indices => polynomial_indices
   end type polynomial_t

contains

   !> Fit a polynomial.
   subroutine fit_polynomial(p, degrees, y, found)
      real(wp), intent(in) :: p(0:, :, :)            !! (0:max_degree, numbers, members) polynomials of each number [1]
      integer, intent(in) :: degrees(:)              !! (numbers) highest one of each
      real(wp), intent(in) :: y(:)                   !! (members) what is fitted [any]
      type(polynomial_t), intent(out) :: found       !! the polynomial

      integer, allocatable :: order(:), powers(:, :)
      real(wp), allocatable :: inverse(:, :), psi(:, :), q(:, :)
      real(wp), allocatable :: error(:), part(:)
      real(wp) :: weights(size(y))
      integer :: best, fold, i, n

      call find_candidates(degrees, size(y), powers)
      call find_values(p, powers, psi)
      n = min(most_terms, max(size(y)/2, 1), size(powers, 2))
      allocate (order(n), q(size(y), n), part(n))
      allocate (error(n), inverse(n, n), source=0.0_wp)
      do fold = 0, n_fold - 1
         weights = [(merge(0.0_wp, 1.0_wp, modulo(i, n_fold) == fold), i=1, size(y))]
         call pursue(psi, y, weights, order, q, inverse, part)
         error = error + part
      end do
      best = minloc(error, dim=1)
      error = error/max(sum((y - sum(y)/size(y))**2), tiny(1.0_wp))
      weights = 1.0_wp
      call pursue(psi, y, weights, order, q, inverse, part)
      best = min(best, count(order > 0))
      found%powers = powers(:, order(:best))
      found%missed = error(best)
      if (found%missed < round_off) found%missed = 0.0_wp
      found%c = matmul(inverse(:best, :best), matmul(y, q(:, :best)))
      call find_changes(y, q(:, :best), inverse(:best, :best), found)
   end subroutine fit_polynomial

   !> Terms of the highest total degree that is not too many.
   pure subroutine find_candidates(degrees, n_member, powers)
      integer, intent(in) :: degrees(:)                  !! (numbers) highest degree of each
      integer, intent(in) :: n_member                    !! members
      integer, allocatable, intent(out) :: powers(:, :)  !! (numbers, terms) of each term

      integer, allocatable :: grown(:, :), next(:, :)
      integer :: d, first, j, k, last

      allocate (powers(size(degrees), 1), source=0)
      first = 1
      do d = 1, max_degree
         last = size(powers, 2)
         allocate (next(size(degrees), (last - first + 1)*size(degrees)))
         k = 0
         do first = first, last
            do j = max(findloc(powers(:, first) > 0, .true., dim=1, back=.true.), 1), size(degrees)
               if (powers(j, first) == degrees(j)) cycle
               k = k + 1
               next(:, k) = powers(:, first)
               next(j, k) = next(j, k) + 1
            end do
         end do
         if (k == 0 .or. last + k > most_candidates .or. real(last + k, wp)*n_member > most_values) return
         allocate (grown(size(degrees), last + k))
         grown(:, :last) = powers
         grown(:, last + 1:) = next(:, :k)
         call move_alloc(grown, powers)
         deallocate (next)
         first = last + 1
      end do
   end subroutine find_candidates

   !> Values of the terms at the members.
   pure subroutine find_values(p, powers, psi)
      real(wp), intent(in) :: p(0:, :, :)              !! (0:max_degree, numbers, members) polynomials [1]
      integer, intent(in) :: powers(:, :)              !! (numbers, terms) of the terms
      real(wp), allocatable, intent(out) :: psi(:, :)  !! (members, terms) values [1]

      integer :: i, j, k

      allocate (psi(size(p, 3), size(powers, 2)), source=1.0_wp)
      do k = 1, size(powers, 2)
         do j = 1, size(powers, 1)
            if (powers(j, k) == 0) cycle
            do i = 1, size(psi, 1)
               psi(i, k) = psi(i, k)*p(powers(j, k), j, i)
            end do
         end do
      end do
   end subroutine find_values

   !> Add terms one by one, the constant first, then always that which fits the remainder best.
   pure subroutine pursue(psi, y, weights, order, q, inverse, error)
      real(wp), intent(in) :: psi(:, :)            !! (members, candidates) values [1]
      real(wp), intent(in) :: y(:)                 !! (members) what is fitted [any]
      real(wp), intent(in) :: weights(:)           !! (members) 1: it is fitted, 0: it is predicted [1]
      integer, intent(out) :: order(:)             !! (n) candidates in their order; 0: no further one
      real(wp), intent(inout) :: q(:, :)           !! (members, n) columns of their values, orthonormal over those fitted [1]
      real(wp), intent(inout) :: inverse(:, :)     !! (n, n) inverse of the triangle R [1]
      real(wp), intent(out) :: error(:)            !! (n) sum of the squares of what is predicted with so many terms [any]

      real(wp) :: column(size(order)), rest(size(y)), sizes(size(psi, 2))
      integer :: n, pass, t

      rest = y
      sizes = sqrt(matmul(weights, psi**2))   ! weights are 0 or 1
      inverse = 0.0_wp
      order = 0
      do n = 1, size(order)
         order(n) = next_term(psi, weights*rest, sizes)
         if (order(n) == 0) exit
         column = 0.0_wp
         sizes(order(n)) = huge(1.0_wp)   ! it is taken
         q(:, n) = psi(:, order(n))
         do pass = 1, 2
            do t = 1, n - 1
               associate (part => dot_product(weights*q(:, t), q(:, n)))
                  column(t) = column(t) + part
                  q(:, n) = q(:, n) - part*q(:, t)
               end associate
            end do
         end do
         column(n) = norm2(weights*q(:, n))
         if (.not. column(n) > epsilon(1.0_wp)*size(y)) order(n) = 0   ! a sum of those before
         if (order(n) == 0) exit
         q(:, n) = q(:, n)/column(n)
         inverse(:n - 1, n) = -matmul(inverse(:n - 1, :n - 1), column(:n - 1))/column(n)
         inverse(n, n) = 1.0_wp/column(n)
         rest = rest - dot_product(weights*q(:, n), rest)*q(:, n)
         error(n) = sum(((1.0_wp - weights)*rest)**2)
         if (norm2(weights*rest) <= fits*norm2(y)) exit
      end do
      n = count(order > 0)
      error(n + 1:) = error(n)
   end subroutine pursue

   !> The candidate that fits the remainder best, the constant first; 0: none does.
   pure integer function next_term(psi, rest, sizes) result(best)
      real(wp), intent(in) :: psi(:, :)     !! (members, candidates) values [1]
      real(wp), intent(in) :: rest(:)       !! (members) the remainder of those that are fitted, of the others 0 [any]
      real(wp), intent(in) :: sizes(:)      !! (candidates) root sum square of those that are fitted; huge: it is taken [1]

      real(wp) :: gains(size(psi, 2))

      best = 1
      if (sizes(1) < huge(1.0_wp)) return
      call dgemv("T", size(psi, 1), size(psi, 2), 1.0_wp, psi, size(psi, 1), rest, 1, 0.0_wp, gains, 1)
      gains = abs(gains)/max(sizes, tiny(1.0_wp))
      where (sizes >= huge(1.0_wp)) gains = 0.0_wp
      best = maxloc(gains, dim=1)
      if (.not. gains(best) > 0.0_wp) best = 0
   end function next_term

   !> What each member changes, by the fit without it.
   pure subroutine find_changes(y, q, inverse, found)
      real(wp), intent(in) :: y(:)                     !! (members) what is fitted [any]
      real(wp), intent(in) :: q(:, :)                  !! (members, terms) orthonormal columns [1]
      real(wp), intent(in) :: inverse(:, :)            !! (terms, terms) inverse of the triangle R [1]
      type(polynomial_t), intent(inout) :: found       !! its changes are set

      real(wp) :: weight(size(y))

      weight = (y - matmul(q, matmul(y, q)))/max(1.0_wp - sum(q**2, dim=2), epsilon(1.0_wp))
      found%changes = matmul(inverse, transpose(q)*spread(weight, 1, size(q, 2)))
   end subroutine find_changes

   !> Its total degree.
   pure integer function polynomial_degree(self) result(degree)
      class(polynomial_t), intent(in) :: self   !! the polynomial

      degree = maxval(sum(self%powers, dim=1))
   end function polynomial_degree

   !> Sobol' indices of contributors.
   pure subroutine polynomial_indices(self, owners, first, total)
      class(polynomial_t), intent(in) :: self    !! the polynomial
      integer, intent(in) :: owners(:)           !! (numbers) contributor of each number
      real(wp), intent(out) :: first(:, :)       !! (3, contributors) value, ends of the interval [1]
      real(wp), intent(out) :: total(:, :)       !! (3, contributors) the same of total indices [1]

      logical :: has(size(self%c)), others(size(self%c))
      integer :: i, k

      do i = 1, size(first, 2)
         do k = 1, size(self%c)
            has(k) = any(self%powers(:, k) > 0 .and. owners == i)
            others(k) = any(self%powers(:, k) > 0 .and. owners /= i)
         end do
         first(:, i) = self_share(has .and. .not. others)
         total(:, i) = self_share(has)
      end do

   contains

      !> The share of some terms with its interval.
      pure function self_share(is_in) result(share)
         logical, intent(in) :: is_in(:)   !! (terms) which
         real(wp) :: share(3)              !! (3) value, ends of the interval [1]

         real(wp) :: half, slope(size(is_in)), variance

         variance = max(sum(self%c(2:)**2), tiny(1.0_wp))
         share(1) = sum(self%c**2, mask=is_in)/variance
         slope = 2.0_wp*self%c/variance*(merge(1.0_wp, 0.0_wp, is_in) - share(1))
         slope(1) = 0.0_wp
         half = normal_95*norm2(matmul(slope, self%changes))
         share(2) = (1.0_wp - self%missed)*(share(1) - half)
         share(3) = (1.0_wp - self%missed)*(share(1) + half) + self%missed
         where (abs(share) < round_off) share = 0.0_wp
      end function self_share

   end subroutine polynomial_indices

end module sparse_polynomial
