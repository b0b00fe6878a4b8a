!> The constraint rows of a mechanism: places for their values, and which bodies they tie.
!>
!> A body has n_v rates: in the plane those of x, y and the angle, in space three of its position and three of its rotation. A row
!> has 2 n_v columns, those of body i before those of body j: a block. A row that ties more than two bodies has further blocks,
!> which stand behind those of all rows. Loops over all rows take the blocks as one sequence; where in it the entries of a body
!> start is said here and nowhere else.
module rows
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: before_side, block_of_side, body_of_side, coordinate_place, list_sides, list_sides_of_rows, n_v_planar, n_v_spatial
   public :: new_rows, next_block, place_of_side, rows_t, side_place

   integer, parameter :: n_v_planar = 3    !! rates of a body in the plane
   integer, parameter :: n_v_spatial = 6   !! rates of a body in space

   !> The constraint rows.
   !>
   !> The first `n_solve` rows are solved for; those after them only fix the motion of bodies that are known
   !> functions of time, and are evaluated when their reactions are requested.
   !>
   !> Components: arrays over the rows, each of which the loops of the solvers use alone.
   type :: rows_t
      integer :: n_v = n_v_planar               !! rates of a body
      integer :: n = 0                          !! number of rows
      integer :: n_solve = 0                    !! rows that are solved for, the first ones
      integer :: n_block = 0                    !! blocks: one of each row, then further ones
      integer, allocatable :: owner(:)          !! (n_block) row of each block
      integer, allocatable :: body(:, :)        !! (2, n_block) bodies i and j of each block, 0: ground
      logical, allocatable :: is_angle(:)       !! (n) whether the row is an angle [rad] or a length [m]
      integer :: n_unknown = 0                  !! bodies whose motion is unknown
      integer, allocatable :: unknown(:)        !! (unknown bodies) their numbers, rising
      integer :: n_side = 0                     !! sides of solved rows that are unknown bodies
      integer, allocatable :: side(:)           !! (sides) numbers: 2 (block - 1) for body i, one more for body j; sorted by body
      integer, allocatable :: side_row(:)       !! (sides) row of each
      integer, allocatable :: last_side(:)      !! (0:bodies) last side of each body; of body 0: 0
      integer, allocatable :: known(:, :)       !! (3, sides of solved rows that are prescribed bodies, the ground none) row, place
                                                !! before its entries in `jac`, body
      real(wp), allocatable :: phi(:)           !! (n) Phi [m or rad]
      real(wp), allocatable :: phi_t(:)         !! (n) partial time derivative of Phi [m/s or rad/s]
      real(wp), allocatable :: jac(:, :)        !! (2 n_v, n_block) Phi_q [1 or m]
      real(wp), allocatable :: gam(:)           !! (n) gamma [m/s^2 or rad/s^2]
   end type rows_t

contains

   !> Storage for n rows.
   subroutine new_rows(n, rows, n_v, n_more)
      integer, intent(in) :: n                 !! number of rows
      type(rows_t), intent(out) :: rows        !! the rows, zero, all to be solved for
      integer, intent(in), optional :: n_v     !! rates of a body; those of the plane if it is not given
      integer, intent(in), optional :: n_more  !! blocks behind those of the rows, of row 1 until they are declared; none if absent

      integer :: k

      if (present(n_v)) rows%n_v = n_v
      rows%n = n
      rows%n_solve = n
      rows%n_block = n
      if (present(n_more)) rows%n_block = n + n_more
      rows%owner = [(merge(k, 1, k <= n), k=1, rows%n_block)]
      allocate (rows%body(2, rows%n_block), source=0)
      allocate (rows%is_angle(n), source=.false.)
      allocate (rows%known(3, 0))
      allocate (rows%phi(n), rows%phi_t(n), rows%gam(n), rows%jac(2*rows%n_v, rows%n_block), source=0.0_wp)
   end subroutine new_rows

   !> List the sides of the solved rows: those of unknown bodies body by body, which loops over the Jacobian
   !> need, and those of known ones.
   subroutine list_sides(is_known, rows)
      logical, intent(in) :: is_known(:)   !! (bodies) whether the motion of a body is a known function of time
      type(rows_t), intent(inout) :: rows  !! rows; their sides are listed

      integer :: block, body, k, n_body, n_known, side

      n_body = size(is_known)
      rows%unknown = pack([(body, body=1, n_body)], .not. is_known)
      rows%n_unknown = size(rows%unknown)
      allocate (rows%last_side(0:n_body), source=0)
      n_known = 0
      do block = 1, rows%n_block
         if (rows%owner(block) > rows%n_solve) cycle
         do side = 1, 2
            body = rows%body(side, block)
            if (body == 0) cycle
            if (is_known(body)) then
               n_known = n_known + 1
            else
               rows%last_side(body) = rows%last_side(body) + 1
            end if
         end do
      end do
      do body = 1, n_body
         rows%last_side(body) = rows%last_side(body - 1) + rows%last_side(body)
      end do
      rows%n_side = rows%last_side(n_body)
      deallocate (rows%known)
      allocate (rows%side(rows%n_side), rows%side_row(rows%n_side), rows%known(3, n_known), source=0)
      n_known = 0
      do block = rows%n_block, 1, -1
         if (rows%owner(block) > rows%n_solve) cycle
         do side = 2, 1, -1
            body = rows%body(side, block)
            if (body == 0) cycle
            if (is_known(body)) then
               n_known = n_known + 1
               rows%known(:, n_known) = [rows%owner(block), side_place(rows%n_v, block, side), body]
            else
               k = rows%last_side(body)
               rows%last_side(body) = k - 1
               rows%side(k) = 2*(block - 1) + side - 1
               rows%side_row(k) = rows%owner(block)
            end if
         end do
      end do
      ! the loop above has moved each entry to the end of the body before
      do body = 0, n_body - 1
         rows%last_side(body) = rows%last_side(body + 1)
      end do
      rows%last_side(n_body) = rows%n_side
   end subroutine list_sides

   !> Sides of each solved row that are unknown bodies.
   pure subroutine list_sides_of_rows(rows, last, sides)
      type(rows_t), intent(in) :: rows                !! rows, their sides listed
      integer, allocatable, intent(out) :: last(:)    !! (0:solved rows) last place in the list of each row; of row 0: 0
      integer, allocatable, intent(out) :: sides(:)   !! (sides) which sides, row by row, in their order

      integer :: k, row

      allocate (last(0:rows%n_solve), sides(rows%n_side), source=0)
      do k = 1, rows%n_side
         last(rows%side_row(k)) = last(rows%side_row(k)) + 1
      end do
      do row = 1, rows%n_solve
         last(row) = last(row) + last(row - 1)
      end do
      do k = rows%n_side, 1, -1
         row = rows%side_row(k)
         sides(last(row)) = k
         last(row) = last(row) - 1
      end do
      ! the loop above has moved each entry to the end of the row before
      last(:rows%n_solve - 1) = last(1:)
      last(rows%n_solve) = rows%n_side
   end subroutine list_sides_of_rows

   !> The next block of a row after one of its own, 0: none; the first is that of the row's number.
   pure integer function next_block(rows, block) result(next)
      type(rows_t), intent(in) :: rows   !! the rows
      integer, intent(in) :: block       !! one of its blocks

      integer :: k

      next = 0
      do k = max(block, rows%n) + 1, rows%n_block
         if (rows%owner(k) /= rows%owner(block)) cycle
         next = k
         return
      end do
   end function next_block

   !> Coordinates before those of body k, where those of all bodies follow one another.
   elemental integer function coordinate_place(n_v, k) result(place)
      integer, intent(in) :: n_v   !! rates of a body
      integer, intent(in) :: k     !! number of the body, 1: the first

      place = n_v*(k - 1)
   end function coordinate_place

   !> Entries of Phi_q before those of one side of a block, where the columns of all blocks follow one another.
   elemental integer function side_place(n_v, block, side) result(place)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: block  !! number of the block, that of a row is the first of its own
      integer, intent(in) :: side   !! 1: body i, 2: body j

      place = coordinate_place(n_v, 2*(block - 1) + side)
   end function side_place

   !> Block of a side, from its number.
   elemental integer function block_of_side(side) result(block)
      integer, intent(in) :: side   !! its number in `rows%side`

      block = shiftr(side, 1) + 1
   end function block_of_side

   !> Body of a side, from its number.
   pure integer function body_of_side(rows, side) result(body)
      type(rows_t), intent(in) :: rows   !! the rows
      integer, intent(in) :: side        !! its number in `rows%side`

      body = rows%body(iand(side, 1) + 1, block_of_side(side))
   end function body_of_side

   !> Entries of Phi_q before those of a side, from its number.
   elemental integer function place_of_side(n_v, side) result(place)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: side   !! its number in `rows%side`

      place = n_v*side
   end function place_of_side

   !> Entries of its block before those of a side, from its number.
   elemental integer function before_side(n_v, side) result(before)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: side   !! its number in `rows%side`

      before = n_v*iand(side, 1)
   end function before_side

end module rows
