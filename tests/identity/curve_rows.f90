!> Rows of cams and slots for the tests of all geometries.
module curve_rows
   use generic_item, only: column_number, make_expression, set_number
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: shape_curve

contains

   !> Curves of cams and slots: an eccentric circle about a point that is not its centre, whose curvature is the same all around; a
   !> straight slot, a circular groove, and a centreline through points.
   subroutine shape_curve(info, k, radius, width, item)
      type(kind_info_t), intent(in) :: info   !! the geometry
      integer, intent(in) :: k                !! number of the item
      real(wp), intent(in) :: radius          !! of the arc [m]
      real(wp), intent(in) :: width           !! of the slot [m]
      type(item_t), intent(inout) :: item     !! its row

      character(*), parameter :: circle = "0.004*cos(1 rad/s*t) + sqrt(0.0009 - 0.000016*sin(1 rad/s*t)^2)"
      integer :: c, n

      call give(info, "x", .false., item)
      call give(info, "y", .false., item)
      c = column_number(info, "profile")
      if (c > 0) then
         item%values(c)%expression = make_expression(circle, info%columns(c))
         if (item%word("contact") == "flat") call set_number(info, "radius", 0.0_wp, item)
      end if
      if (column_number(info, "arc_radius") == 0) return
      call set_number(info, "arc_radius", radius, item)
      call set_number(info, "arc", 2.0_wp*pi, item)  ! closed: from its centre a pin would come to where an end starts
      call set_number(info, "width", width, item)
      call give(info, "length", k == 1, item)
      call give(info, "arc_radius", k == 2, item)
      call give(info, "x", k == 3, item)
      call give(info, "y", k == 3, item)
      item%values(column_number(info, "closed"))%flag = .false.
      item%values(column_number(info, "open_end"))%flag = k == 1
      c = column_number(info, "x")
      item%values(c)%table(:, 1) = [(0.02_wp*n, n=1, size(item%values(c)%table, 1))]
      c = column_number(info, "y")
      item%values(c)%table(:, 1) = [(0.01_wp*sin(0.6_wp*n), n=1, size(item%values(c)%table, 1))]
   end subroutine shape_curve

   !> Whether a column of a row is given, if the kind has it.
   subroutine give(info, name, is_given, item)
      type(kind_info_t), intent(in) :: info   !! the kind
      character(*), intent(in) :: name        !! of the column
      logical, intent(in) :: is_given         !! what it shall be
      type(item_t), intent(inout) :: item     !! the row

      integer :: c

      c = column_number(info, name)
      if (c > 0) item%values(c)%given = is_given
   end subroutine give

end module curve_rows
