!> Friction forces of contacts that stick as far as each can hold, and slip where that is not enough.
!>
!> With x the forces along the tangents of n contacts, A = G K^-1 G^T and A x - r their sliding accelerations:
!>
!> minimise x^T A x/2 - r^T x   subject to   |x_c| <= L_c for each contact c,
!>
!> whose solution is that of the complementarity problem: a contact within its limit does not slip (A x = r there); one at its
!> limit slips against its force, r_c - (A x)_c = mu x_c with mu >= 0. Normal forces are given, so L_c is a number. A is positive
!> semidefinite: the accelerations are unique. The forces are not where contacts share a load; those found are near the forces that
!> the iteration starts with.
!>
!> Solved contact by contact (block Gauss-Seidel), each exactly: in space by the root of |x_c(mu)| = L_c (More and Sorensen).
!> Source: F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), section 5.3; J. J. More and
!> D. C. Sorensen, SIAM J. Sci. Stat. Comput. 4 (1983), 553-572. Limits: one or two tangents of a contact.
module friction_limits
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: limit_forces

   integer, parameter :: n_sweep = 2000               !! sweeps over all contacts, at most
   integer, parameter :: n_newton = 30                !! iterations for a root
   real(wp), parameter :: converged = 1.0e-14_wp      !! change of a force that ends the iteration, of the maximum limit [1]
   real(wp), parameter :: singular = 1.0e-14_wp       !! mobility taken as zero, of the maximum one [1]

contains

   !> Forces within their limits from forces without.
   pure subroutine limit_forces(n, n_tangent, lead, matrix, r, limit, x, against)
      integer, intent(in) :: n                          !! contacts
      integer, intent(in) :: n_tangent                  !! tangents of each, 1 or 2
      integer, intent(in) :: lead                       !! first extent of the matrix
      real(wp), intent(in) :: matrix(lead, n_tangent*n) !! (lead, n_tangent n) A [1/kg]
      real(wp), intent(in) :: r(n_tangent*n)            !! (n_tangent n) r [m/s^2]
      real(wp), intent(in) :: limit(n)                  !! (n) limits, not negative [N]
      real(wp), intent(inout) :: x(n_tangent*n)         !! (n_tangent n) forces to start with, then those found [N]
      real(wp), intent(out) :: against(n_tangent*n)     !! (n_tangent n) r - A x: against the sliding accelerations [m/s^2]

      real(wp) :: before(2), change, maximum, rest(2)
      integer :: a, c, first, last, sweep

      maximum = maxval([(abs(matrix(a, a)), a=1, n_tangent*n)])
      do c = 1, n
         first = n_tangent*(c - 1) + 1
         call shorten(n_tangent, limit(c), x(first))
      end do
      do sweep = 1, n_sweep
         change = 0.0_wp
         do c = 1, n
            first = n_tangent*(c - 1) + 1
            last = n_tangent*c
            before(:n_tangent) = x(first:last)
            do a = first, last
               rest(a - first + 1) = r(a) - dot_product(matrix(a, :), x) + dot_product(matrix(a, first:last), x(first:last))
            end do
            if (n_tangent == 1) then
               if (matrix(first, first) > singular*maximum) then
                  x(first) = min(max(rest(1)/matrix(first, first), -limit(c)), limit(c))
               end if
            else
               call limit_pair(matrix(first:last, first:last), rest, limit(c), singular*maximum, x(first:last))
            end if
            change = max(change, maxval(abs(x(first:last) - before(:n_tangent))))
         end do
         if (.not. change > converged*maxval(limit)) exit
      end do
      do a = 1, n_tangent*n
         against(a) = r(a) - dot_product(matrix(a, :), x)
      end do
   end subroutine limit_forces

   !> Shorten a force to its limit.
   pure subroutine shorten(n, limit, x)
      integer, intent(in) :: n            !! its components
      real(wp), intent(in) :: limit       !! the limit [N]
      real(wp), intent(inout) :: x(n)     !! (n) the force [N]

      real(wp) :: length

      length = norm2(x)
      if (length > limit) x = x*(limit/length)
   end subroutine shorten

   !> The force of one contact in space with all others as they are: x = (A + mu I)^-1 r, mu = 0 or |x| = L.
   pure subroutine limit_pair(matrix, r, limit, minimum, x)
      real(wp), intent(in) :: matrix(2, 2)   !! (2, 2) A of the contact [1/kg]
      real(wp), intent(in) :: r(2)           !! (2) r less what other forces do [m/s^2]
      real(wp), intent(in) :: limit          !! L [N]
      real(wp), intent(in) :: minimum          !! mobility taken as zero [1/kg]
      real(wp), intent(inout) :: x(2)        !! (2) the force; left alone where it moves nothing [N]

      real(wp) :: along(2, 2), length, mean, mobility(2), mu, part(2), slope, spread
      integer :: i

      mean = 0.5_wp*(matrix(1, 1) + matrix(2, 2))
      spread = hypot(0.5_wp*(matrix(1, 1) - matrix(2, 2)), matrix(1, 2))
      if (mean + spread <= minimum) return
      if (limit <= 0.0_wp) then
         x = 0.0_wp
         return
      end if
      mobility = [mean + spread, max(mean - spread, minimum)]
      along(:, 1) = [1.0_wp, 0.0_wp]
      if (spread > epsilon(1.0_wp)*mean) then
         along(:, 1) = [0.5_wp*(matrix(1, 1) - matrix(2, 2)) + spread, matrix(1, 2)]
         if (matrix(1, 1) < matrix(2, 2)) along(:, 1) = [matrix(1, 2), spread - 0.5_wp*(matrix(1, 1) - matrix(2, 2))]
         along(:, 1) = along(:, 1)/norm2(along(:, 1))
      end if
      along(:, 2) = [-along(2, 1), along(1, 1)]
      part = matmul(r, along)
      mu = 0.0_wp
      do i = 1, n_newton
         length = norm2(part/(mobility + mu))
         if (length <= limit*(1.0_wp + epsilon(1.0_wp))) exit
         slope = sum(part**2/(mobility + mu)**3)/length
         mu = mu + (length - limit)/limit*length/slope
      end do
      x = matmul(along, part/(mobility + mu))
      call shorten(2, limit, x)
   end subroutine limit_pair

end module friction_limits
