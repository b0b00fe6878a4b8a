!> Polynomials of one random number that are orthonormal by its distribution.
!>
!> By Stieltjes' procedure on nodes x_i with weights w_i, in z = (x - mu)/s:
!> $$ \sqrt{b_{k+1}} p_{k+1} = (z - a_k) p_k - \sqrt{b_k} p_{k-1}, \quad a_k = E[z p_k^2], \quad E[p_j p_k] = \delta_{jk} . $$
!> Uniform numbers have Legendre's polynomials, normal ones Hermite's; a distribution of n values has n of them.
!> Source: W. Gautschi, Orthogonal Polynomials: Computation and Approximation (2004), section 2.2.
module orthogonal_polynomials
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: family_t, max_degree, new_family

   integer, parameter :: max_degree = 8                   !! of the polynomials
   real(wp), parameter :: nothing_left = 1.0e-10_wp       !! b below which there is no further polynomial [1]

   !> The polynomials of a distribution.
   type :: family_t
      real(wp) :: mean = 0.0_wp                !! mu [any]
      real(wp) :: sigma = 0.0_wp               !! s; 0: one value, the constant alone [any]
      integer :: degree = 0                    !! highest one
      real(wp) :: a(0:max_degree) = 0.0_wp     !! (0:max_degree) a_k [1]
      real(wp) :: b(0:max_degree) = 0.0_wp     !! (0:max_degree) b_k [1]
   contains
      procedure :: values
   end type family_t

contains

   !> The polynomials of a distribution given by nodes.
   pure type(family_t) function new_family(x, w) result(family)
      real(wp), intent(in) :: x(:)   !! (n) values [any]
      real(wp), intent(in) :: w(:)   !! (n) their probabilities; their sum is 1 [1]

      real(wp), dimension(size(x)) :: before, next, now, z
      integer :: k

      family%mean = sum(w*x)
      family%sigma = sqrt(sum(w*(x - family%mean)**2))
      if (.not. family%sigma > epsilon(1.0_wp)*maxval(abs(x))) family%sigma = 0.0_wp
      if (.not. family%sigma > 0.0_wp) return
      z = (x - family%mean)/family%sigma
      before = 0.0_wp
      now = 1.0_wp
      do k = 0, max_degree - 1
         family%a(k) = sum(w*z*now**2)
         next = (z - family%a(k))*now - sqrt(family%b(k))*before
         family%b(k + 1) = sum(w*next**2)
         if (.not. family%b(k + 1) > nothing_left) return
         family%degree = k + 1
         before = now
         now = next/sqrt(family%b(k + 1))
      end do
   end function new_family

   !> Values of all polynomials; beyond the highest one zero.
   pure function values(self, x) result(p)
      class(family_t), intent(in) :: self   !! the polynomials
      real(wp), intent(in) :: x             !! the number [any]
      real(wp) :: p(0:max_degree)           !! (0:max_degree) p_0 to p_n [1]

      real(wp) :: before, z
      integer :: k

      p = 0.0_wp
      p(0) = 1.0_wp
      if (self%degree == 0) return
      z = (x - self%mean)/self%sigma
      before = 0.0_wp
      do k = 0, self%degree - 1
         p(k + 1) = ((z - self%a(k))*p(k) - sqrt(self%b(k))*before)/sqrt(self%b(k + 1))
         before = p(k)
      end do
   end function values

end module orthogonal_polynomials
