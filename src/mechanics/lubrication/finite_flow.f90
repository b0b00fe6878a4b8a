!> What flows out of the ends of a bearing of finite length: fitted to Reynolds' equation on a grid.
!>
!> Q = 2 L R |v| phi,   log phi = sum of C(k, b, a) T_k(log(L/D)/log 4) eps^(2b) x^a,   x = e.v/(c |v|)
!> v = e' - (w_J + w_B)/2 z x e
!>
!> phi is the part that leaves at the ends of all that the journal squeezes away; 1 of a short bearing. While it turns in a place
!> that is steady, Q = L R c eps |w_J + w_B| phi.
!>
!> Source: fitted to `reynolds_grid`; `make film-table` writes finite_flow.inc anew. Limits: no grooves, no pressure at the ends;
!> from L/D = 1/4 to 4 within 1 %. Below, phi goes to 1 with the square of L/D; beyond, the ends do not feel each other: phi goes
!> with D/L.
module finite_flow
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: flow_part, flow_terms, n_flow_ratio, n_flow_terms

   integer, parameter :: n_flow_ratio = 4   !! degree in log(L/D)
   integer, parameter :: n_flow_eps = 2     !! degree in eps^2
   integer, parameter :: n_flow_x = 4       !! degree in x
   integer, parameter :: n_flow_terms = (n_flow_ratio + 1)*(n_flow_eps + 1)*(n_flow_x + 1)  !! coefficients
   real(wp), parameter :: min_ratio = 0.25_wp   !! minimum L/D of the fit [1]
   real(wp), parameter :: max_ratio = 4.0_wp !! maximum [1]

   include "finite_flow.inc"

contains

   !> What the coefficients are multiplied by.
   pure function flow_terms(ratio, eps, x) result(terms)
      real(wp), intent(in) :: ratio        !! L/D, from 1/4 to 4 [1]
      real(wp), intent(in) :: eps          !! eccentricity ratio [1]
      real(wp), intent(in) :: x            !! its part along v [1]
      real(wp) :: terms(n_flow_terms)      !! (n_flow_terms) products [1]

      real(wp) :: t(0:n_flow_ratio), z
      integer :: a, b, k, n

      z = log(ratio)/log(max_ratio)
      t(0:1) = [1.0_wp, z]
      do k = 2, n_flow_ratio
         t(k) = 2.0_wp*z*t(k - 1) - t(k - 2)
      end do
      n = 0
      do a = 0, n_flow_x
         do b = 0, n_flow_eps
            terms(n + 1:n + n_flow_ratio + 1) = t*(x**a*eps**(2*b))
            n = n + n_flow_ratio + 1
         end do
      end do
   end function flow_terms

   !> phi.
   pure real(wp) function flow_part(ratio, eps, x) result(phi)
      real(wp), intent(in) :: ratio   !! L/D [1]
      real(wp), intent(in) :: eps     !! eccentricity ratio, at most 1 [1]
      real(wp), intent(in) :: x       !! its part along v [1]

      phi = exp(sum(flow_coefficient*flow_terms(min(max(ratio, min_ratio), max_ratio), eps, x)))
      if (ratio < min_ratio) phi = 1.0_wp - (1.0_wp - phi)*(ratio/min_ratio)**2
      if (ratio > max_ratio) phi = phi*max_ratio/ratio
   end function flow_part

end module finite_flow
