!> The constraint rows of a mechanism: places for their values, and which bodies they tie.
!>
!> A planar row has six columns: x_i, y_i, angle_i, x_j, y_j, angle_j.
module rows
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: list_sides, new_rows, rows_t

   !> The constraint rows.
   !>
   !> The first `n_solve` rows are solved for; those after them only fix the motion of bodies that are known
   !> functions of time, and are evaluated when their reactions are wanted.
   type :: rows_t
      integer :: n = 0                          !! number of rows
      integer :: n_solve = 0                    !! rows that are solved for, the first ones
      integer, allocatable :: body(:, :)        !! (2, n) bodies i and j of each row, 0: ground
      logical, allocatable :: is_angle(:)       !! (n) whether the row is an angle [rad] or a length [m]
      integer :: n_unknown = 0                  !! bodies whose motion is unknown
      integer, allocatable :: unknown(:)        !! (unknown bodies) their numbers, rising
      integer :: n_side = 0                     !! sides of solved rows that are unknown bodies
      integer, allocatable :: side(:, :)        !! (3, sides) row, place before its entries in `jac`, body; sorted by body
      integer, allocatable :: last_side(:)      !! (0:bodies) last side of each body; of body 0: 0
      integer :: n_known = 0                    !! sides of solved rows that are known bodies other than the ground
      integer, allocatable :: known(:, :)       !! (3, known sides) row, place before its entries in `jac`, body
      real(wp), allocatable :: phi(:)           !! (n) Phi [m or rad]
      real(wp), allocatable :: phi_t(:)         !! (n) partial time derivative of Phi [m/s or rad/s]
      real(wp), allocatable :: jac(:, :)        !! (6, n) Phi_q [1 or m]
      real(wp), allocatable :: gam(:)           !! (n) gamma [m/s^2 or rad/s^2]
   end type rows_t

contains

   !> Room for n rows.
   subroutine new_rows(n, rows)
      integer, intent(in) :: n           !! number of rows
      type(rows_t), intent(out) :: rows  !! the rows, zero, all to be solved for

      rows%n = n
      rows%n_solve = n
      allocate (rows%body(2, n), source=0)
      allocate (rows%is_angle(n), source=.false.)
      allocate (rows%phi(n), rows%phi_t(n), rows%gam(n), rows%jac(6, n), source=0.0_wp)
   end subroutine new_rows

   !> List the sides of the solved rows: those of unknown bodies body by body, which loops over the Jacobian
   !> need, and those of known ones.
   subroutine list_sides(is_known, rows)
      logical, intent(in) :: is_known(:)   !! (bodies) whether the motion of a body is a known function of time
      type(rows_t), intent(inout) :: rows  !! rows; their sides are listed

      integer :: body, k, n_body, row, side

      n_body = size(is_known)
      rows%unknown = pack([(body, body=1, n_body)], .not. is_known)
      rows%n_unknown = size(rows%unknown)
      allocate (rows%last_side(0:n_body), source=0)
      rows%n_known = 0
      do row = 1, rows%n_solve
         do side = 1, 2
            body = rows%body(side, row)
            if (body == 0) cycle
            if (is_known(body)) then
               rows%n_known = rows%n_known + 1
            else
               rows%last_side(body) = rows%last_side(body) + 1
            end if
         end do
      end do
      do body = 1, n_body
         rows%last_side(body) = rows%last_side(body - 1) + rows%last_side(body)
      end do
      rows%n_side = rows%last_side(n_body)
      allocate (rows%side(3, rows%n_side), rows%known(3, rows%n_known), source=0)
      rows%n_known = 0
      do row = rows%n_solve, 1, -1
         do side = 2, 1, -1
            body = rows%body(side, row)
            if (body == 0) cycle
            if (is_known(body)) then
               rows%n_known = rows%n_known + 1
               rows%known(:, rows%n_known) = [row, 6*(row - 1) + 3*(side - 1), body]
            else
               k = rows%last_side(body)
               rows%last_side(body) = k - 1
               rows%side(:, k) = [row, 6*(row - 1) + 3*(side - 1), body]
            end if
         end do
      end do
      ! the loop above has moved each entry to the end of the body before
      do body = 0, n_body - 1
         rows%last_side(body) = rows%last_side(body + 1)
      end do
      rows%last_side(n_body) = rows%n_side
   end subroutine list_sides

end module rows
