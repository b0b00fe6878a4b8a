!> Bodies that hang on known ones only: their accelerations and multipliers in closed form.
!>
!> The rows of such a body stand alone in S = Phi_q M^-1 Phi_q^T: a block of one or two rows,
!>
!> S lambda = Phi_b M_b^-1 g_b - b,   a_b = M_b^-1 (g_b - Phi_b^T lambda),
!>
!> solved without assembling it. In a crank mechanism with a loose joint all bodies are such.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: one or two rows a body; other bodies are not lone.
module lone_bodies
   use rows, only: rows_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: find_lone_bodies, lone_t, solve_lone_bodies

   !> The lone bodies, those with one row before those with two.
   type :: lone_t
      integer :: n(2) = 0                   !! (2) bodies with one row, and with two
      integer, allocatable :: body(:)       !! (bodies) their numbers
      integer, allocatable :: row(:, :)     !! (2, bodies) their rows
      integer, allocatable :: place(:, :)   !! (2, bodies) place in the Jacobian before the entries of the body in each row
   end type lone_t

contains

   !> Find the lone bodies of declared rows.
   subroutine find_lone_bodies(rows, lone)
      type(rows_t), intent(in) :: rows    !! rows, declared
      type(lone_t), intent(out) :: lone   !! the bodies

      logical :: is_lone(rows%n_unknown)
      integer :: body, i, in_row(rows%n_solve), k, m, n

      in_row = 0
      do k = 1, rows%n_side
         in_row(rows%side(1, k)) = in_row(rows%side(1, k)) + 1
      end do
      do i = 1, rows%n_unknown
         body = rows%unknown(i)
         associate (first => rows%last_side(body - 1) + 1, last => rows%last_side(body))
            is_lone(i) = last >= first .and. last - first <= 1 .and. all(in_row(rows%side(1, first:last)) == 1)
         end associate
      end do
      n = count(is_lone)
      allocate (lone%body(n), lone%row(2, n), lone%place(2, n), source=0)
      n = 0
      do m = 1, 2
         do i = 1, rows%n_unknown
            body = rows%unknown(i)
            associate (first => rows%last_side(body - 1) + 1, last => rows%last_side(body))
               if (.not. is_lone(i) .or. last - first + 1 /= m) cycle
               n = n + 1
               lone%n(m) = lone%n(m) + 1
               lone%body(n) = body
               lone%row(:m, n) = rows%side(1, first:last)
               lone%place(:m, n) = rows%side(2, first:last)
            end associate
         end do
      end do
   end subroutine find_lone_bodies

   !> Accelerations and multipliers of the lone bodies.
   pure subroutine solve_lone_bodies(n, body, row, place, n_body, n_row, inverse_mass, jac, g, b, threshold, a, lambda, bad_row)
      integer, intent(in) :: n(2)                          !! (2) bodies with one row, and with two
      integer, intent(in) :: body(n(1) + n(2))             !! (bodies) their numbers
      integer, intent(in) :: row(2, n(1) + n(2))           !! (2, bodies) their rows
      integer, intent(in) :: place(2, n(1) + n(2))         !! (2, bodies) place in the Jacobian before their entries
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(in) :: threshold                    !! least pivot, as a part of its diagonal [1]
      real(wp), intent(inout) :: a(3, 0:n_body)            !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: lambda(n_row)             !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                      !! a row that depends on the other, or nearly so, 0: none

      real(wp) :: factor, free(3), l1, l2, m(3), p(3), pivot, q(3), s11, s12, s22, w_p(3), w_q(3), x1, x2
      integer :: c, k, i1, i2

      bad_row = 0
      do k = 1, n(1)
         c = body(k)
         i1 = place(1, k)
         m = inverse_mass(:, c)
         p = jac(i1 + 1:i1 + 3)
         w_p = p*m
         free = g(:, c)*m
         l1 = (p(1)*free(1) + p(2)*free(2) + p(3)*free(3) - b(row(1, k))) &
              /(w_p(1)*p(1) + w_p(2)*p(2) + w_p(3)*p(3))
         lambda(row(1, k)) = l1
         a(:, c) = free - w_p*l1
      end do
      do k = n(1) + 1, n(1) + n(2)
         c = body(k)
         i1 = place(1, k)
         i2 = place(2, k)
         m = inverse_mass(:, c)
         p = jac(i1 + 1:i1 + 3)
         q = jac(i2 + 1:i2 + 3)
         w_p = p*m
         w_q = q*m
         free = g(:, c)*m
         x1 = p(1)*free(1) + p(2)*free(2) + p(3)*free(3) - b(row(1, k))
         x2 = q(1)*free(1) + q(2)*free(2) + q(3)*free(3) - b(row(2, k))
         s11 = w_p(1)*p(1) + w_p(2)*p(2) + w_p(3)*p(3)
         s12 = w_p(1)*q(1) + w_p(2)*q(2) + w_p(3)*q(3)
         s22 = w_q(1)*q(1) + w_q(2)*q(2) + w_q(3)*q(3)
         factor = s12/s11
         pivot = s22 - factor*s12
         if (.not. pivot > threshold*s22) then
            bad_row = row(2, k)
            return
         end if
         l2 = (x2 - factor*x1)/pivot
         l1 = (x1 - s12*l2)/s11
         lambda(row(1, k)) = l1
         lambda(row(2, k)) = l2
         a(:, c) = free - w_p*l1 - w_q*l2
      end do
   end subroutine solve_lone_bodies

end module lone_bodies
