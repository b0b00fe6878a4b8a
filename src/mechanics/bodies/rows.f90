!> The constraint rows of a mechanism: places for their values, and which bodies they tie.
!>
!> A body has n_v rates: in the plane those of x, y and the angle, in space three of its position and three of its rotation. A row
!> has 2 n_v columns, those of body i before those of body j. Loops over all rows take the columns as one sequence; where in it
!> the entries of a body start is said here and nowhere else.
module rows
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: before_side, body_of_side, coordinate_place, list_sides, n_v_planar, n_v_spatial, new_rows, place_in_row
   public :: place_of_side, row_of_side, rows_t, side_place

   integer, parameter :: n_v_planar = 3    !! rates of a body in the plane
   integer, parameter :: n_v_spatial = 6   !! rates of a body in space

   !> The constraint rows.
   !>
   !> The first `n_solve` rows are solved for; those after them only fix the motion of bodies that are known
   !> functions of time, and are evaluated when their reactions are requested.
   type :: rows_t
      integer :: n_v = n_v_planar               !! rates of a body
      integer :: n = 0                          !! number of rows
      integer :: n_solve = 0                    !! rows that are solved for, the first ones
      integer, allocatable :: body(:, :)        !! (2, n) bodies i and j of each row, 0: ground
      logical, allocatable :: is_angle(:)       !! (n) whether the row is an angle [rad] or a length [m]
      integer :: n_unknown = 0                  !! bodies whose motion is unknown
      integer, allocatable :: unknown(:)        !! (unknown bodies) their numbers, rising
      integer :: n_side = 0                     !! sides of solved rows that are unknown bodies
      integer, allocatable :: side(:)           !! (sides) numbers: 2 (row - 1) for body i, one more for body j; sorted by body
      integer, allocatable :: last_side(:)      !! (0:bodies) last side of each body; of body 0: 0
      integer, allocatable :: known(:, :)       !! (3, sides of solved rows that are prescribed bodies, the ground none) row, place
                                                !! before its entries in `jac`, body
      real(wp), allocatable :: phi(:)           !! (n) Phi [m or rad]
      real(wp), allocatable :: phi_t(:)         !! (n) partial time derivative of Phi [m/s or rad/s]
      real(wp), allocatable :: jac(:, :)        !! (2 n_v, n) Phi_q [1 or m]
      real(wp), allocatable :: gam(:)           !! (n) gamma [m/s^2 or rad/s^2]
   end type rows_t

contains

   !> Storage for n rows.
   subroutine new_rows(n, rows, n_v)
      integer, intent(in) :: n               !! number of rows
      type(rows_t), intent(out) :: rows      !! the rows, zero, all to be solved for
      integer, intent(in), optional :: n_v   !! rates of a body; those of the plane if it is not given

      if (present(n_v)) rows%n_v = n_v
      rows%n = n
      rows%n_solve = n
      allocate (rows%body(2, n), source=0)
      allocate (rows%is_angle(n), source=.false.)
      allocate (rows%known(3, 0))
      allocate (rows%phi(n), rows%phi_t(n), rows%gam(n), rows%jac(2*rows%n_v, n), source=0.0_wp)
   end subroutine new_rows

   !> List the sides of the solved rows: those of unknown bodies body by body, which loops over the Jacobian
   !> need, and those of known ones.
   subroutine list_sides(is_known, rows)
      logical, intent(in) :: is_known(:)   !! (bodies) whether the motion of a body is a known function of time
      type(rows_t), intent(inout) :: rows  !! rows; their sides are listed

      integer :: body, k, n_body, n_known, row, side

      n_body = size(is_known)
      rows%unknown = pack([(body, body=1, n_body)], .not. is_known)
      rows%n_unknown = size(rows%unknown)
      allocate (rows%last_side(0:n_body), source=0)
      n_known = 0
      do row = 1, rows%n_solve
         do side = 1, 2
            body = rows%body(side, row)
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
      allocate (rows%side(rows%n_side), rows%known(3, n_known), source=0)
      n_known = 0
      do row = rows%n_solve, 1, -1
         do side = 2, 1, -1
            body = rows%body(side, row)
            if (body == 0) cycle
            if (is_known(body)) then
               n_known = n_known + 1
               rows%known(:, n_known) = [row, side_place(rows%n_v, row, side), body]
            else
               k = rows%last_side(body)
               rows%last_side(body) = k - 1
               rows%side(k) = 2*(row - 1) + side - 1
            end if
         end do
      end do
      ! the loop above has moved each entry to the end of the body before
      do body = 0, n_body - 1
         rows%last_side(body) = rows%last_side(body + 1)
      end do
      rows%last_side(n_body) = rows%n_side
   end subroutine list_sides

   !> Coordinates before those of body k, where those of all bodies follow one another.
   elemental integer function coordinate_place(n_v, k) result(place)
      integer, intent(in) :: n_v   !! rates of a body
      integer, intent(in) :: k     !! number of the body, 1: the first

      place = n_v*(k - 1)
   end function coordinate_place

   !> Entries of Phi_q before those of one side of a row, where the columns of all rows follow one another.
   elemental integer function side_place(n_v, row, side) result(place)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: row    !! number of the row
      integer, intent(in) :: side   !! 1: body i, 2: body j

      place = coordinate_place(n_v, 2*(row - 1) + side)
   end function side_place

   !> Row of a side, from its number.
   elemental integer function row_of_side(side) result(row)
      integer, intent(in) :: side   !! its number in `rows%side`

      row = shiftr(side, 1) + 1
   end function row_of_side

   !> Body of a side, from its number.
   pure integer function body_of_side(rows, side) result(body)
      type(rows_t), intent(in) :: rows   !! the rows
      integer, intent(in) :: side        !! its number in `rows%side`

      body = rows%body(iand(side, 1) + 1, row_of_side(side))
   end function body_of_side

   !> Entries of Phi_q before those of a side, from its number.
   elemental integer function place_of_side(n_v, side) result(place)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: side   !! its number in `rows%side`

      place = n_v*side
   end function place_of_side

   !> Entries of its row before those of a side, from its number.
   elemental integer function before_side(n_v, side) result(before)
      integer, intent(in) :: n_v    !! rates of a body
      integer, intent(in) :: side   !! its number in `rows%side`

      before = n_v*iand(side, 1)
   end function before_side

   !> Entries of a row before those of one of its sides, from its place among all.
   elemental integer function place_in_row(n_v, row, place) result(before)
      integer, intent(in) :: n_v     !! rates of a body
      integer, intent(in) :: row     !! number of the row
      integer, intent(in) :: place   !! of the side, as `side_place` says

      before = place - side_place(n_v, row, 1)
   end function place_in_row

end module rows
