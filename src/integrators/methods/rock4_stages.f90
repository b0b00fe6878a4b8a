!> The coefficients of `rock4` for each degree: recurrences from orthogonal polynomials, last stages from a table.
!>
!> With x = a + z/d, a = 1 - 1/s^2, a step of degree s of y' = z y multiplies by w(x) p(x) / (w(a) p(a)); p is the orthogonal
!> polynomial of degree s - 4 for the weight w^2/sqrt(1 - x^2). Its recurrence p_j = (x - A_j) p_{j-1} - B_j p_{j-2}, with P_j =
!> p_j(a), becomes that of the states
!>
!> $$ g_j = \mu_j h f(g_{j-1}) + \nu_j g_{j-1} + \kappa_j g_{j-2}, \mu_j = P_{j-1}/(d P_j), \nu_j = (a - A_j) P_{j-1}/P_j,
!>    \kappa_j = -B_j P_{j-2}/P_j $$
!>
!> Source: A. Abdulle, Fourth order Chebyshev methods with recurrence relation, SIAM J. Sci. Comput. 23 (2002) 2041-2054; the
!> numbers are those of scripts/make_rock4_table. Limits: degrees up to 162. Recurrences are found when a degree is first requested,
!> and kept.
module rock4_stages
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: end_coefficients, estimate_coefficients, find_recurrence, min_degree, longest_stretch, most_stages, n_recurrence
   public :: recurrence

   include "rock4_table.inc"

   integer, parameter :: most_stages = degree(n_degree)   !! of a step
   real(wp), parameter :: pi = acos(-1.0_wp)              !! [1]

   real(wp), protected :: recurrence(4, most_stages, n_degree) = 0.0_wp  !! (4, stage, degree) mu, nu, kappa, place of g_j [1]
   logical :: is_known(n_degree) = .false.                               !! (n_degree) recurrences that were found

contains

   !> Number of the minimum degree that is stable for the eigenvalues between -z and 0, 0 if there is none.
   pure integer function min_degree(z) result(k)
      real(wp), intent(in) :: z  !! step times spectral radius [1]

      do k = 1, n_degree
         if (stretch(k) >= z) return
      end do
      k = 0
   end function min_degree

   !> Maximum step times spectral radius of all degrees.
   pure real(wp) function longest_stretch()
      longest_stretch = stretch(n_degree)
   end function longest_stretch

   !> How far the stability of a degree reaches: x from a to -1.
   pure real(wp) function stretch(k)
      integer, intent(in) :: k  !! number of the degree

      stretch = table(1, k)*(2.0_wp - 1.0_wp/real(degree(k), wp)**2)
   end function stretch

   !> States that the recurrence of a degree makes.
   pure integer function n_recurrence(k)
      integer, intent(in) :: k  !! number of the degree

      n_recurrence = degree(k) - 4
   end function n_recurrence

   !> Coefficients of the last four stages: a21, a31, a32, a41, a42, a43, b1 to b4.
   pure function end_coefficients(k) result(c)
      integer, intent(in) :: k  !! number of the degree
      real(wp) :: c(10)         !! (10) the coefficients [1]

      c = table(6:15, k)
   end function end_coefficients

   !> Coefficients of the estimate of the error: of the last derivative of the recurrence and of the four of the end.
   pure function estimate_coefficients(k) result(e)
      integer, intent(in) :: k  !! number of the degree
      real(wp) :: e(5)          !! (5) the coefficients [1]

      e = table(16:20, k)
   end function estimate_coefficients

   !> Find the recurrence of a degree: sums over the places of Gauss and Chebyshev's quadrature, exact for these polynomials.
   subroutine find_recurrence(k)
      integer, intent(in) :: k  !! number of the degree

      real(wp), dimension(most_stages + 2) :: before, mass, new, now, x
      real(wp) :: a, a_j, b_j, here, here_before, here_new, s2, size_before, size_now
      integer :: j, n

      if (is_known(k)) return
      s2 = real(degree(k), wp)**2
      a = 1.0_wp - 1.0_wp/s2
      n = degree(k) + 2
      x(:n) = cos([(real(2*j - 1, wp), j=1, n)]*pi/real(2*n, wp))
      associate (u => table(2:5, k))
         mass(:n) = (((x(:n) - 1.0_wp + u(1)/s2)**2 + (u(2)/s2)**2)*((x(:n) - 1.0_wp + u(3)/s2)**2 + (u(4)/s2)**2))**2
      end associate
      before(:n) = 0.0_wp
      now(:n) = 1.0_wp
      here_before = 0.0_wp
      here = 1.0_wp
      size_before = 1.0_wp
      associate (c => recurrence(:, :, k))
         do j = 1, n_recurrence(k)
            size_now = sum(mass(:n)*now(:n)**2)
            a_j = sum(mass(:n)*x(:n)*now(:n)**2)/size_now
            b_j = merge(size_now/size_before, 0.0_wp, j > 1)
            new(:n) = (x(:n) - a_j)*now(:n) - b_j*before(:n)
            here_new = (a - a_j)*here - b_j*here_before
            c(1, j) = here/(table(1, k)*here_new)
            c(2, j) = (a - a_j)*here/here_new
            c(3, j) = -b_j*here_before/here_new
            c(4, j) = c(1, j)
            if (j > 1) c(4, j) = c(4, j) + c(2, j)*c(4, j - 1)
            if (j > 2) c(4, j) = c(4, j) + c(3, j)*c(4, j - 2)
            before(:n) = now(:n)
            now(:n) = new(:n)
            here_before = here
            here = here_new
            size_before = size_now
         end do
      end associate
      is_known(k) = .true.
   end subroutine find_recurrence

end module rock4_stages
