!> Floquet multipliers of a matrix, and the functions that vanish where orbits bifurcate.
module multipliers
   use kinds, only: wp
   use lapack, only: dgeev, dgetrf, dgetrs
   implicit none (type, external)
   private
   public :: find_multipliers, solve, test_flip, test_one, test_torus

contains

   !> Eigenvalues by descending modulus; of a complex pair that with the positive imaginary part first.
   function find_multipliers(matrix) result(values)
      real(wp), intent(in) :: matrix(:, :)                 !! (m, m) derivative of the map of a period [1]
      complex(wp) :: values(size(matrix, 1))               !! (m) multipliers [1]

      real(wp), dimension(size(matrix, 1)) :: im, re
      real(wp) :: a(size(matrix, 1), size(matrix, 1)), left(1, 1), right(1, 1), work(8*size(matrix, 1) + 8)
      complex(wp) :: value
      integer :: info, k, l

      if (size(values) == 0) return
      a = matrix
      call dgeev("N", "N", size(re), a, size(re), re, im, left, 1, right, 1, work, size(work), info)
      values = cmplx(re, im, wp)
      do k = 2, size(values)
         value = values(k)
         do l = k - 1, 1, -1
            if (abs(values(l)) > abs(value) .or. (abs(abs(values(l)) - abs(value)) <= 0.0_wp .and. &
                                                  values(l)%im >= value%im)) exit
            values(l + 1) = values(l)
         end do
         values(l + 1) = value
      end do
   end function find_multipliers

   !> Solve linear equations. Info 0: done.
   subroutine solve(matrix, right, x, info)
      real(wp), intent(in) :: matrix(:, :)                 !! (m, m) [any]
      real(wp), intent(in) :: right(:)                     !! (m) right-hand side [any]
      real(wp), intent(out) :: x(:)                        !! (m) solution [any]
      integer, intent(out) :: info                         !! 0: done; else the matrix is singular

      real(wp) :: a(size(x), size(x)), b(size(x), 1)
      integer :: pivots(size(x))

      a = matrix
      b(:, 1) = right
      call dgetrf(size(x), size(x), a, size(x), pivots, info)
      if (info == 0) call dgetrs("N", size(x), 1, a, size(x), pivots, b, size(x), info)
      x = b(:, 1)
   end subroutine solve

   !> Product of (mu - 1), which changes its sign at folds and where symmetry breaks.
   pure real(wp) function test_one(mu) result(test)
      complex(wp), intent(in) :: mu(:)                     !! (m) multipliers [1]

      complex(wp), parameter :: one = (1.0_wp, 0.0_wp)

      test = real(product((mu - one)/(one + abs(mu))), wp)
   end function test_one

   !> Product of (mu + 1), which changes its sign at period doublings.
   pure real(wp) function test_flip(mu) result(test)
      complex(wp), intent(in) :: mu(:)                     !! (m) multipliers [1]

      complex(wp), parameter :: one = (1.0_wp, 0.0_wp)

      test = real(product((mu + one)/(one + abs(mu))), wp)
   end function test_flip

   !> Product of (|mu|^2 - 1) over complex pairs and of (mu_i mu_j - 1) over real ones, which changes its sign where a pair has the
   !> product 1; at a Neimark-Sacker bifurcation that pair is complex.
   pure real(wp) function test_torus(mu) result(test)
      complex(wp), intent(in) :: mu(:)                     !! (m) multipliers [1]

      complex(wp) :: value
      integer :: i, j

      value = 1.0_wp
      do i = 1, size(mu)
         do j = 1, i - 1
            value = value*(mu(i)*mu(j) - 1.0_wp)/(1.0_wp + abs(mu(i)*mu(j)))
         end do
      end do
      test = real(value, wp)
   end function test_torus

end module multipliers
