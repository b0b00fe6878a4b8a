!> Bodies that hang on known ones only: their accelerations and multipliers in closed form.
!>
!> The rows of such a body stand alone in S = Phi_q M^-1 Phi_q^T: a block of one or two rows,
!>
!> S lambda = Phi_b M_b^-1 g_b - b,   a_b = M_b^-1 (g_b - Phi_b^T lambda),
!>
!> solved without assembling it (`solve_lone_bodies` of `body_kernels.inc`). In a crank mechanism with a clearance joint all bodies
!> are such.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: one or two rows a body; other bodies are not lone.
module lone_bodies
   use rows, only: place_of_side, rows_t
   implicit none (type, external)
   private
   public :: find_lone_bodies, lone_t

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
         associate (row => rows%side_row(k))
            in_row(row) = in_row(row) + 1
         end associate
      end do
      do i = 1, rows%n_unknown
         body = rows%unknown(i)
         associate (first => rows%last_side(body - 1) + 1, last => rows%last_side(body))
            is_lone(i) = last >= first .and. last - first <= 1 .and. all(in_row(rows%side_row(first:last)) == 1)
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
               lone%row(:m, n) = rows%side_row(first:last)
               lone%place(:m, n) = place_of_side(rows%n_v, rows%side(first:last))
            end associate
         end do
      end do
   end subroutine find_lone_bodies

end module lone_bodies
