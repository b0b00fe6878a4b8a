!> Curves of cams and slots from the rows of a deck, and what is wrong with them.
!>
!> Points become cubic splines x(u), y(u) over the length u of the polygon through them: periodic ones if the curve is closed, else
!> not-a-knot. A closed curve is put counter-clockwise; a last point that is the first one again is left out.
!>
!> Source: see `spline`. Limits: at least four points.
module profile_columns
   use curve, only: beyond_periodic, beyond_same
   use item, only: item_t, place_of
   use kind_info, only: add_file, add_list, dim_length, kind_info_t, same_dimension
   use kinds, only: pi, wp
   use profile_curve, only: curvature_at, place_nodes, profile_arc, profile_line, profile_points, profile_polar, profile_t
   use spline, only: ends_not_a_knot, ends_periodic, min_samples, new_spline
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: add_point_columns, cam_profile, check_closed, check_points, fault_t, has_points, slot_profile

   real(wp), parameter :: same = 1.0e-9_wp    !! distance of points that are one, of the extent [1]
   real(wp), parameter :: smooth = 1.0e-6_wp  !! difference of slopes that are one, of the radius [1]

   !> What is wrong with a row.
   type :: fault_t
      character(:), allocatable :: column   !! where; blank: nothing is wrong
      character(:), allocatable :: message  !! what is wrong
      character(:), allocatable :: help     !! what to do
   contains
      procedure :: set => fault_set
   end type fault_t

contains

   !> Say what is wrong.
   pure subroutine fault_set(self, column, message, help)
      class(fault_t), intent(inout) :: self   !! the fault
      character(*), intent(in) :: column      !! where; blank: nothing is wrong
      character(*), intent(in) :: message     !! what is wrong
      character(*), intent(in) :: help        !! what to do

      self%column = column
      self%message = message
      self%help = help
   end subroutine fault_set

   !> Columns of points.
   subroutine add_point_columns(info, what)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: what          !! what has them, as "profile"

      call add_list(info, "x", "points of the "//what//": xi from the point of the first column, in the frame of its body", &
                    default="")
      call add_list(info, "y", "points of the "//what//": eta from that point", default="")
      call add_file(info, "file", "two-column file of x and y, relative to the deck, with names and units in the first line; " &
                    //"instead of x and y", default="")
   end subroutine add_point_columns

   !> Whether a row gives points.
   pure logical function has_points(item)
      type(item_t), intent(in) :: item  !! the row

      has_points = item%is_given("x") .or. item%is_given("y")
   end function has_points

   !> The profile of a cam.
   pure subroutine cam_profile(item, profile)
      type(item_t), intent(in) :: item          !! the row, without faults
      type(profile_t), intent(out) :: profile   !! its curve, with nodes

      if (has_points(item)) then
         call curve_of_points(item, .true., profile)
      else
         profile%polar = item%values(place_of(item, "profile"))%expression
         profile%radius = item%number("profile")
         profile%form = merge(profile_arc, profile_polar, profile%polar%is_constant)
      end if
      call place_nodes(profile)
   end subroutine cam_profile

   !> The centreline of a slot.
   pure subroutine slot_profile(item, profile)
      type(item_t), intent(in) :: item          !! the row, without faults
      type(profile_t), intent(out) :: profile   !! its curve, with nodes

      real(wp) :: angle

      angle = item%number("axis_angle")
      if (item%word("axis") == "y") angle = angle + 0.5_wp*pi
      if (has_points(item)) then
         call curve_of_points(item, item%flag("closed"), profile)
      else if (item%is_given("arc_radius")) then
         profile%radius = item%number("arc_radius")
         profile%range = angle + [0.0_wp, item%number("arc")]
         profile%is_closed = item%number("arc") >= 2.0_wp*pi*(1.0_wp - same)
      else
         profile%form = profile_line
         profile%is_closed = .false.
         profile%range = [0.0_wp, item%number("length")]
         profile%axis = [cos(angle), sin(angle)]
         if (abs(item%number("axis_angle")) <= 0.0_wp) profile%axis = merge([1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], &
                                                                            item%word("axis") == "x")
      end if
      if (item%flag("open_end")) profile%mouth = 0.5_wp*item%number("width")
      call place_nodes(profile)
   end subroutine slot_profile

   !> The splines through the points of a row.
   pure subroutine curve_of_points(item, is_closed, profile)
      type(item_t), intent(in) :: item          !! the row, without faults
      logical, intent(in) :: is_closed          !! the last point is joined to the first one
      type(profile_t), intent(out) :: profile   !! the curve

      real(wp), allocatable :: s(:, :), u(:)
      integer :: k, n

      call take_points(item, is_closed, s)
      n = size(s, 1)
      allocate (u(n))
      u(1) = 0.0_wp
      do k = 2, n
         u(k) = u(k - 1) + norm2(s(k, :) - s(k - 1, :))
      end do
      profile%form = profile_points
      profile%is_closed = is_closed
      profile%range = [0.0_wp, u(n)]
      associate (ends => merge(ends_periodic, ends_not_a_knot, is_closed), beyond => merge(beyond_periodic, beyond_same, is_closed))
         call new_spline(u, s(:, 1), ends, beyond, profile%x)
         call new_spline(u, s(:, 2), ends, beyond, profile%y)
      end associate
   end subroutine curve_of_points

   !> The points of a row; of a closed curve counter-clockwise, the first one again at the end.
   pure subroutine take_points(item, is_closed, s)
      type(item_t), intent(in) :: item            !! the row
      logical, intent(in) :: is_closed            !! the last point is joined to the first one
      real(wp), allocatable, intent(out) :: s(:, :)  !! (n, 2) the points [m]

      real(wp), allocatable :: x(:), y(:)
      real(wp) :: area
      integer :: k, n

      k = place_of(item, "x")
      n = place_of(item, "y")
      x = item%values(k)%table(:, 1)
      y = item%values(n)%table(:, 1)
      n = size(x)
      if (is_closed .and. hypot(x(n) - x(1), y(n) - y(1)) <= same*maxval(hypot(x - x(1), y - y(1)))) n = n - 1
      s = reshape([x(:n), y(:n)], [n, 2])
      if (.not. is_closed) return
      s = reshape([s(:, 1), s(1, 1), s(:, 2), s(1, 2)], [n + 1, 2])
      area = 0.0_wp
      do k = 1, n
         area = area + s(k, 1)*s(k + 1, 2) - s(k + 1, 1)*s(k, 2)
      end do
      if (area < 0.0_wp) s = s(n + 1:1:-1, :)
   end subroutine take_points

   !> Whether the points of a row make a curve.
   subroutine check_points(item, is_closed, fault)
      type(item_t), intent(in) :: item      !! the row, with points
      logical, intent(in) :: is_closed      !! the last point is joined to the first one
      type(fault_t), intent(inout) :: fault !! set where something is wrong

      real(wp), allocatable :: s(:, :)
      integer :: k

      if (.not. (item%is_given("x") .and. item%is_given("y"))) then
         call fault%set(merge("x", "y", item%is_given("x")), "the points have one coordinate", "give both x and y, or a file")
         return
      end if
      associate (x => item%values(place_of(item, "x")), y => item%values(place_of(item, "y")))
         if (.not. (same_dimension(x%dimensions(1), dim_length) .and. same_dimension(y%dimensions(1), dim_length))) then
            call fault%set(merge("y", "x", same_dimension(x%dimensions(1), dim_length)), "a coordinate is not a length", &
                           "give a unit of lengths, as mm")
         else if (size(x%table) /= size(y%table)) then
            call fault%set("y", to_text(size(y%table))//" ordinates of "//to_text(size(x%table))//" points", "")
         else if (size(x%table) < min_samples) then
            call fault%set("x", "there are "//to_text(size(x%table))//" points, a smooth curve needs at least " &
                           //to_text(min_samples), "")
         end if
      end associate
      if (fault%column /= "") return
      call take_points(item, is_closed, s)
      do k = 2, size(s, 1)
         if (norm2(s(k, :) - s(k - 1, :)) > same*maxval(abs(s))) cycle
         call fault%set("x", "points "//to_text(k - 1)//" and "//to_text(k)//" coincide", "leave one of them out")
         return
      end do
      if (size(s, 1) <= min_samples .and. is_closed) call fault%set("x", "there are "//to_text(size(s, 1) - 1)// &
                                                            " different points, a closed curve needs at least 4", "")
   end subroutine check_points

   !> Whether a profile is a closed curve that winds once, and a polar one smooth where it closes.
   subroutine check_closed(profile, fault)
      type(profile_t), intent(in) :: profile   !! the curve, with nodes
      type(fault_t), intent(inout) :: fault    !! set where something is wrong

      real(wp) :: end(3), h, start(3), turned
      integer :: k

      if (profile%form == profile_polar) then
         call profile%polar%evaluate(profile%range(1), start(1), start(2), start(3))
         call profile%polar%evaluate(profile%range(2), end(1), end(2), end(3))
         if (.not. abs(end(1) - start(1)) <= same*start(1)) then
            call fault%set("profile", "the profile does not close: its radius is "//real_text(1.0e3_wp*start(1), 6) &
                           //" mm at 0 and "//real_text(1.0e3_wp*end(1), 6)//" mm at 360 deg", &
                           "the radius repeats after a turn; give a function a period")
         else if (.not. abs(end(2) - start(2)) <= smooth*start(1)) then
            call fault%set("profile", "the profile has a corner where it closes, at 0", &
                           "the slope of the radius repeats after a turn")
         end if
         return
      else if (profile%form == profile_arc) then
         if (.not. profile%radius > 0.0_wp) call fault%set("profile", "the radius of the profile is not positive", "")
         return
      end if
      turned = 0.0_wp
      h = (profile%range(2) - profile%range(1))/size(profile%u)
      do k = 1, size(profile%u)
         turned = turned + h*curvature_at(profile, profile%u(k))*pace_at(k)
      end do
      if (abs(turned - 2.0_wp*pi) > 0.5_wp*pi) call fault%set("x", "the profile through the points crosses itself", &
                                                              "give the points in the order of the profile")

   contains

      !> Length of the curve per u at a node, by its neighbours.
      real(wp) function pace_at(k)
         integer, intent(in) :: k   !! the node

         associate (n => size(profile%u))
            pace_at = norm2(profile%q(modulo(k, n) + 1, :) - profile%q(modulo(k - 2, n) + 1, :))/(2.0_wp*h)
         end associate
      end function pace_at

   end subroutine check_closed

end module profile_columns
