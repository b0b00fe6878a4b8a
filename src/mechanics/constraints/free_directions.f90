!> Directions in which the rows let bodies move, resolved along the bodies' axes, in the metric of the masses.
!>
!> $$ \Phi_q D = 0, \quad D^T M D = I, \quad R = M D, $$
!>
!> from a QR factorisation of M^{-1/2} \Phi_q^T with exchange of columns: those of Q beyond the rank, times M^{-1/2}. R^T x is how
!> much of each direction a change x has, and x - D R^T x is what changes of the rows make in that metric.
!> Source: G. H. Golub and C. F. Van Loan, Matrix Computations, 4th ed. (2013), sections 5.4 and 6.2. Limits: dense. Rows whose
!> independence is in doubt count as dependent, so that there may be a direction too many, never one too few.
module free_directions
   use kinds, only: wp
   use lapack, only: dgeqp3, dormqr
   use linkage, only: linkage_t
   use rows, only: before_side, block_of_side, body_of_side
   implicit none (type, external)
   private
   public :: find_free_directions

   real(wp), parameter :: rank_tolerance = 1.0e-7_wp   !! of the maximum pivot, below which rows are dependent [1]
   integer, parameter :: block = 32                    !! columns that LAPACK takes together

contains

   !> Directions of the unknown bodies, and how to read them, at the position where the rows were evaluated. Where there are more
   !> than storage for them, only their number is found.
   subroutine find_free_directions(linkage, y, n, direction, reading)
      type(linkage_t), intent(in) :: linkage       !! the bodies and their rows
      real(wp), intent(in) :: y(:)                 !! (any) the state where they are [any]
      integer, intent(out) :: n                    !! number of directions
      real(wp), intent(inout) :: direction(:, :)   !! (rates of the bodies, room) D; columns found are set [any]
      real(wp), intent(inout) :: reading(:, :)     !! (rates of the bodies, room) R; columns found are set [any]

      real(wp) :: root(size(direction, 1)), rows(size(direction, 1), max(1, linkage%rows%n_solve))
      real(wp) :: tau(max(1, linkage%rows%n_solve))
      real(wp) :: work(block*(linkage%rows%n_solve + size(direction, 2) + 1))
      integer :: info, k, n_rate, order(max(1, linkage%rows%n_solve)), rank

      n_rate = size(direction, 1)
      call weighed_rows(linkage, y, root, rows)
      rank = 0
      associate (m => linkage%rows%n_solve)
         if (m > 0 .and. n_rate > 0) then
            order = 0
            call dgeqp3(n_rate, m, rows, n_rate, order, tau, work, size(work), info)
            do k = 1, min(m, n_rate)
               if (abs(rows(k, k)) > rank_tolerance*abs(rows(1, 1))) rank = k
            end do
         end if
         n = n_rate - rank
         if (n > size(direction, 2)) return
         do k = 1, n
            direction(:, k) = 0.0_wp
            direction(rank + k, k) = 1.0_wp
         end do
         if (rank > 0 .and. n > 0) then
            call dormqr("L", "N", n_rate, n, min(m, n_rate), rows, n_rate, tau, direction, n_rate, work, size(work), info)
         end if
      end associate
      do k = 1, n
         reading(:, k) = direction(:, k)*root
         direction(:, k) = direction(:, k)/root
      end do
   end subroutine find_free_directions

   !> M^{-1/2} Phi_q^T along the bodies' axes, and the roots of the masses.
   subroutine weighed_rows(linkage, y, root, rows)
      type(linkage_t), intent(in) :: linkage   !! the bodies and their rows
      real(wp), intent(in) :: y(:)             !! (any) state [any]
      real(wp), intent(out) :: root(:)         !! (rates) roots of the masses [any]
      real(wp), intent(out) :: rows(:, :)      !! (rates, rows) a row of the constraints in each column [any]

      real(wp) :: nothing(linkage%coordinates%n_q), unused(linkage%coordinates%n_v), along(linkage%coordinates%n_v)
      integer :: k, number(0:linkage%bodies%n), place, side

      rows = 0.0_wp
      number = 0
      nothing = 0.0_wp
      associate (n_v => linkage%coordinates%n_v, n_q => linkage%coordinates%n_q)
         do k = 1, linkage%rows%n_unknown
            number(linkage%rows%unknown(k)) = k
            root(n_v*(k - 1) + 1:n_v*k) = sqrt(linkage%mass(:, linkage%rows%unknown(k)))
         end do
         do side = 1, linkage%rows%n_side
            associate (row => linkage%rows%side_row(side), body => body_of_side(linkage%rows, linkage%rows%side(side)))
               place = before_side(n_v, linkage%rows%side(side))
               call linkage%coordinates%to_local(1, y(n_q*(number(body) - 1) + 1:), nothing, &
                                                 linkage%rows%jac(place + 1:place + n_v, block_of_side(linkage%rows%side(side))), &
                                                 unused, along)
               k = n_v*(number(body) - 1)
               rows(k + 1:k + n_v, row) = rows(k + 1:k + n_v, row) + along/root(k + 1:k + n_v)
            end associate
         end do
      end associate
   end subroutine weighed_rows

end module free_directions
