!> Newton's equations of Radau IIA in the directions: A^{-1} falls into its eigenvalues, so that the factors are of the order of K.
!>
!> The eigenvectors of A^{-1} are w_i = sum_j M^{(j)}(c_i) l^{-j}, j = 1 to 3, of the eigenvalue l, where M is the polynomial whose
!> zeros are the places c of the stages: the polynomial sum_j M^{(j)} l^{-j}, j = 0 to 3, satisfies p' = l p at these places, and
!> that it vanishes at the start is the equation of the eigenvalues.
!> Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.8 and (IV.3.24).
submodule(radau_matrix) radau_matrix_equations
   use lapack, only: dgetrf, dgetrs, zgetrf, zgetrs
   use radau_products, only: a, c, real_eigenvalue
   implicit none (type, external)

   complex(wp), parameter :: complex_eigenvalue = &
      cmplx(3.0_wp + 0.5_wp*(3.0_wp**(1.0_wp/3.0_wp) - 3.0_wp**(2.0_wp/3.0_wp)), &
            0.5_wp*(3.0_wp**(5.0_wp/6.0_wp) + 3.0_wp**(7.0_wp/6.0_wp)), wp)   !! of A^-1 [1]

contains

   !> Eigenvectors of A^-1, the inverse of their matrix, and A^-1 itself.
   module procedure find_eigenvectors
      complex(wp) :: last(3)

      self%right(:, 1) = eigenvector(cmplx(real_eigenvalue, 0.0_wp, wp))
      self%right(:, 2) = eigenvector(complex_eigenvalue)
      last = conjg(self%right(:, 2))
      associate (first => self%right(:, 1), second => self%right(:, 2))
         self%left(1, :) = product_across(second, last)/sum(first*product_across(second, last))
         self%left(2, :) = product_across(last, first)/sum(second*product_across(last, first))
      end associate
      self%inverse_a = real(real_eigenvalue*dyad(self%right(:, 1), self%left(1, :)) &
                            + 2.0_wp*complex_eigenvalue*dyad(self%right(:, 2), self%left(2, :)))
   end procedure find_eigenvectors

   !> Eigenvector of A^-1.
   pure function eigenvector(l) result(w)
      complex(wp), intent(in) :: l   !! eigenvalue [1]
      complex(wp) :: w(3)            !! (3) the eigenvector [1]

      real(wp) :: first(3), second(3)

      first = [(c(1) - c(2))*(c(1) - c(3)), (c(2) - c(1))*(c(2) - c(3)), (c(3) - c(1))*(c(3) - c(2))]
      second = 6.0_wp*c - 2.0_wp*sum(c)
      w = first/l + second/l**2 + 6.0_wp/l**3
   end function eigenvector

   !> Vector product, nothing conjugated.
   pure function product_across(p, q) result(r)
      complex(wp), intent(in) :: p(3)   !! (3) first factor [1]
      complex(wp), intent(in) :: q(3)   !! (3) second factor [1]
      complex(wp) :: r(3)               !! (3) product [1]

      r = [p(2)*q(3) - p(3)*q(2), p(3)*q(1) - p(1)*q(3), p(1)*q(2) - p(2)*q(1)]
   end function product_across

   !> Products of all entries, nothing conjugated.
   pure function dyad(p, q) result(r)
      complex(wp), intent(in) :: p(3)   !! (3) of the rows [1]
      complex(wp), intent(in) :: q(3)   !! (3) of the columns [1]
      complex(wp) :: r(3, 3)            !! (3, 3) products [1]

      r = spread(p, 2, 3)*spread(q, 1, 3)
   end function dyad

   !> Factors for steps of a length.
   module procedure factorise
      integer :: i, info(2)

      if (abs(self%h - h) <= 0.0_wp) return
      associate (n => self%n, room => size(self%k, 1))
         self%real_lu(:n, :n) = -self%k(:n, :n)
         self%complex_lu(:n, :n) = -self%k(:n, :n)
         do i = 1, n
            self%real_lu(i, i) = self%real_lu(i, i) + real_eigenvalue/h
            self%complex_lu(i, i) = self%complex_lu(i, i) + complex_eigenvalue/h
         end do
         call dgetrf(n, n, self%real_lu, room, self%pivot(:, 1), info(1))
         call zgetrf(n, n, self%complex_lu, room, self%pivot(:, 2), info(2))
      end associate
      self%h = h
      if (any(info /= 0)) self%is_known = .false.
   end procedure factorise

   !> Changes of the stages. What of R has no local change, as the length of Euler parameters, stays in them.
   module procedure solve_stages
      real(wp) :: z_here(size(self%z, 1))
      integer :: info, j

      associate (n => self%n, room => size(self%k, 1), x => self%x, z => self%z, left => self%left, right => self%right)
         do j = 1, 3
            self%change(:) = self%inverse_a(j, 1)*side(:, 1) + self%inverse_a(j, 2)*side(:, 2) + self%inverse_a(j, 3)*side(:, 3)
            call to_directions(self, system, y(:, j), self%change, x(:, j), z(:, j))
         end do
         ! h A r at each stage, what of it is across, and what that makes
         x = matmul(x, transpose(a))
         do j = 1, 3
            z_here = a(j, 1)*z(:, 1) + a(j, 2)*z(:, 2) + a(j, 3)*z(:, 3)
            call add_directions(self, -1.0_wp, z_here, x(:, j))
         end do
         z = z/self%h
         do j = 1, 3
            associate (rates => z(self%n_free + 1:2*self%n_free, j))
               rates = rates + matmul(self%across(:self%n_free, :), x(:2*self%n_rate, j))
            end associate
         end do
         self%single(:n) = real(left(1, 1))*z(:n, 1) + real(left(1, 2))*z(:n, 2) + real(left(1, 3))*z(:n, 3)
         self%pair(:n) = left(2, 1)*z(:n, 1) + left(2, 2)*z(:n, 2) + left(2, 3)*z(:n, 3)
         call dgetrs("N", n, 1, self%real_lu, room, self%pivot(:, 1), self%single, room, info)
         call zgetrs("N", n, 1, self%complex_lu, room, self%pivot(:, 2), self%pair, room, info)
         do j = 1, 3
            z(:n, j) = real(right(j, 1))*self%single(:n) + 2.0_wp*real(right(j, 2)*self%pair(:n))
            call add_directions(self, 1.0_wp, z(:, j), x(:, j))
            call system%to_local(y(:, j), side(:, j), self%local)
            self%local(:) = x(:, j) - self%local
            call system%from_local(y(:, j), self%local, self%change)
            change(:, j) = side(:, j) + self%change
         end do
      end associate
   end procedure solve_stages

   !> The filter of the error: b + T ((I - h K/u)^-1 - I) T^+ b.
   module procedure solve_filter
      integer :: info

      associate (n => self%n, room => size(self%k, 1), z => self%z)
         call to_directions(self, system, y, b, self%local, z(:, 1))
         z(:n, 2) = matmul(self%k(:n, :n), z(:n, 1))
         call dgetrs("N", n, 1, self%real_lu, room, self%pivot(:, 1), z(:, 2), room, info)
         self%local(:) = 0.0_wp
         call add_directions(self, 1.0_wp, z(:, 2), self%local)
      end associate
      call system%from_local(y, self%local, self%change)
      x = b + self%change
   end procedure solve_filter

   !> A change of the state, local and in the directions: z = T^+ x.
   module procedure to_directions
      integer :: i

      call system%to_local(y, change, x)
      associate (m => self%n_free, n => self%n_rate)
         do i = 1, m
            z(i) = dot_product(self%reading(:, i), x(:n))
            z(m + i) = dot_product(self%reading(:, i), x(n + 1:2*n))
         end do
         z(2*m + 1:self%n) = x(2*n + 1:)
      end associate
   end procedure to_directions

   !> Add to a local change some change in the directions: x + factor T z.
   module procedure add_directions
      integer :: i

      associate (m => self%n_free, n => self%n_rate)
         do i = 1, m
            x(:n) = x(:n) + (factor*z(i))*self%direction(:, i)
            x(n + 1:2*n) = x(n + 1:2*n) + (factor*z(m + i))*self%direction(:, i)
         end do
         x(2*n + 1:) = x(2*n + 1:) + factor*z(2*m + 1:self%n)
      end associate
   end procedure add_directions

end submodule radau_matrix_equations
