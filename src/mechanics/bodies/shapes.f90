!> What a user needs drawn of bodies: rows of the table [shapes], in the own frames of the bodies.
!>
!> polygon: corners `points`, two numbers each in the plane, three in space. circle, cylinder, sphere: `radius` about the centre
!> (xi, eta, zeta), the first two across `axis`, a cylinder of that `length` with the centre in its middle. box: `length`, `width`
!> and `height` along xi, eta and zeta about the centre, turned by `angle` about `axis`; without height a rectangle. mesh: the
!> triangles of `file`, an STL file (text or binary) or an OBJ file, whose numbers are in `file_unit`; its origin is at the centre,
!> turned by `angle` about `axis`.
!>
!> They have no part in the motion. Source: none. Limits: faces of spheres and cylinders are flat; 50,000 triangles in a deck.
module shapes
   use drawing, only: add_stroke, in_both, in_files, in_pictures, part_t, round_part, start_part
   use item, only: item_t, place_of
   use kind_info, only: add_direction, add_file, add_list, add_number, add_reference, add_word, dim_angle, dim_length, &
      kind_info_t, same_dimension
   use kinds, only: wp
   use mesh_part, only: part_of_mesh
   use rotations, only: axes_across, rotation_about
   implicit none (type, external)
   private
   public :: box_part, mistake_of_shape, part_of_shape, shapes_info, sphere_part

   integer, parameter :: n_side = 24                  !! sides of a cylinder, meridians of a sphere
   integer, parameter :: n_belt = 12                  !! belts of a sphere
   real(wp), parameter :: half_turn = 4.0_wp*atan(1.0_wp)  !! [rad]

contains

   !> The deck table of shapes.
   function shapes_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "shapes"
      info%help = "shapes of bodies for figures and for other programs; default: lines between the points of the body"
      info%source = ""
      call add_reference(info, "body", "bodies", "the body, or ground")
      call add_word(info, "shape", "type of the shape", choices="polygon circle box cylinder sphere mesh")
      call add_list(info, "points", "of a polygon: its corners, xi and eta of each, in space zeta too", default="")
      call add_number(info, "radius", dim_length, "of a circle, cylinder or sphere", default="0 m", lower=0.0_wp)
      call add_number(info, "length", dim_length, "length of a box along xi, of a cylinder along its axis", default="0 m", &
         lower=0.0_wp)
      call add_number(info, "width", dim_length, "width of a box along eta", default="0 m", lower=0.0_wp)
      call add_number(info, "height", dim_length, "height of a box along zeta; 0: a rectangle", default="0 m", lower=0.0_wp)
      call add_number(info, "xi", dim_length, "centre of the shape, except polygons, in the body frame", default="0 m")
      call add_number(info, "eta", dim_length, "the same, second coordinate", default="0 m")
      call add_number(info, "zeta", dim_length, "the same, third coordinate", default="0 m")
      call add_direction(info, "axis", "axis of a circle or cylinder; rotation axis of a box or mesh", default='"0 0 1"')
      call add_number(info, "angle", dim_angle, "rotation angle of a box or mesh about the axis", default="0 rad")
      call add_file(info, "file", "of a mesh: an STL or OBJ file, relative to the deck", default="")
      info%columns(size(info%columns))%size = 9  ! numbers of a triangle
      call add_number(info, "file_unit", dim_length, "length that is 1 in the file of a mesh", default="1 mm", lower=0.0_wp, &
         open_lower=.true.)
   end function shapes_info

   !> What is wrong with a row; blank: nothing.
   function mistake_of_shape(item, is_spatial) result(message)
      type(item_t), intent(in) :: item         !! the row
      logical, intent(in) :: is_spatial        !! the scene is in space
      character(:), allocatable :: message     !! what is wrong with it

      integer :: n, of_corner

      message = ""
      if (item%is_given("file") .and. item%word("shape") /= "mesh") then
         message = "a "//item%word("shape")//" has no file: write shape mesh"
         return
      end if
      select case (item%word("shape"))
      case ("mesh")
         if (.not. item%is_given("file")) message = "the mesh '"//item%name//"' needs an STL or OBJ file in column file"
      case ("polygon")
         associate (list => item%values(place_of(item, "points")))
            n = 0
            of_corner = merge(3, 2, is_spatial)
            if (allocated(list%table)) n = size(list%table)
            if (n < 3*of_corner .or. mod(n, of_corner) /= 0) then
               message = "the polygon '"//item%name//"' needs at least three corners, "// &
                         trim(merge("three", "two  ", is_spatial))//" coordinates each, in column points"
            else if (.not. same_dimension(list%dimensions(1), dim_length)) then
               message = "the corners of polygon '"//item%name//"' are not lengths"
            end if
         end associate
      case ("box")
         if (item%number("length") <= 0.0_wp .or. item%number("width") <= 0.0_wp) then
            message = "the box '"//item%name//"' needs a length and a width"
         end if
      case default
         if (item%number("radius") <= 0.0_wp) message = "the "//item%word("shape")//" '"//item%name//"' needs a radius"
         if (item%word("shape") == "cylinder" .and. item%number("length") <= 0.0_wp) then
            message = "the cylinder '"//item%name//"' needs a radius and a length"
         end if
      end select
   end function mistake_of_shape

   !> The part that a row describes, of which `mistake_of_shape` finds nothing wrong.
   subroutine part_of_shape(item, is_spatial, part)
      type(item_t), intent(in) :: item      !! the row, its body resolved
      logical, intent(in) :: is_spatial     !! the scene is in space
      type(part_t), intent(out) :: part     !! what is drawn

      real(wp) :: axes(3, 3), centre(3)
      integer :: body, points

      body = item%reference("body")
      centre = [item%number("xi"), item%number("eta"), item%number("zeta")]
      axes = axes_across(item%direction("axis"))
      select case (item%word("shape"))
      case ("polygon")
         points = place_of(item, "points")
         call take_polygon(item%values(points)%table(:, 1), merge(3, 2, is_spatial), body, part)
      case ("box")
         call box_part(0.5_wp*[item%number("length"), item%number("width"), item%number("height")], centre, &
                       rotation_about(item%direction("axis"), item%number("angle")), body, part)
      case ("mesh")
         points = place_of(item, "file")
         call part_of_mesh(item%values(points)%table, item%number("file_unit"), &
                           rotation_about(item%direction("axis"), item%number("angle")), centre, body, part)
      case ("circle")
         call round_part(part, body, centre, axes(:, 1:2), item%number("radius"))
      case ("cylinder")
         call take_cylinder(item%number("radius"), 0.5_wp*item%number("length"), centre, axes, body, part)
      case default
         call sphere_part(item%number("radius"), centre, is_spatial, body, part)
      end select
   end subroutine part_of_shape

   !> A polygon.
   subroutine take_polygon(numbers, of_corner, body, part)
      real(wp), intent(in) :: numbers(:)    !! (corners times of_corner) coordinates [m]
      integer, intent(in) :: of_corner      !! 2 or 3
      integer, intent(in) :: body           !! its body
      type(part_t), intent(out) :: part     !! what is drawn

      real(wp), allocatable :: s(:, :)
      integer :: k, n

      n = size(numbers)/of_corner
      allocate (s(3, n), source=0.0_wp)
      s(:of_corner, :) = reshape(numbers, [of_corner, n])
      call start_part(part, body, s)
      call add_stroke(part, [(k, k=1, n)], .true., in_both)
   end subroutine take_polygon

   !> A box, or a rectangle.
   subroutine box_part(half, centre, rotation, body, part)
      real(wp), intent(in) :: half(3)           !! (3) half its sides [m]
      real(wp), intent(in) :: centre(3)         !! (3) its centre [m]
      real(wp), intent(in) :: rotation(3, 3)    !! (3, 3) its turn [1]
      integer, intent(in) :: body               !! its body
      type(part_t), intent(out) :: part         !! what is drawn

      integer, parameter :: faces(4, 6) = reshape([1, 2, 3, 4, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8], [4, 6])
      real(wp), parameter :: corners(2, 4) = reshape([-1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], [2, 4])
      real(wp) :: s(3, 8)
      integer :: k, side

      do side = 0, 1
         do k = 1, 4
            s(:, 4*side + k) = centre + matmul(rotation, half*[corners(:, k), real(2*side - 1, wp)])
         end do
      end do
      if (half(3) > 0.0_wp) then
         call start_part(part, body, s)
         do k = 1, size(faces, 2)
            call add_stroke(part, faces(:, k), .true., in_both)
         end do
      else
         call start_part(part, body, s(:, :4))
         call add_stroke(part, [1, 2, 3, 4], .true., in_both)
      end if
   end subroutine box_part

   !> A cylinder.
   subroutine take_cylinder(radius, half, centre, axes, body, part)
      real(wp), intent(in) :: radius        !! its radius [m]
      real(wp), intent(in) :: half          !! half its length [m]
      real(wp), intent(in) :: centre(3)     !! (3) its centre [m]
      real(wp), intent(in) :: axes(3, 3)    !! (3, 3) two directions across its axis, and the axis [1]
      integer, intent(in) :: body           !! its body
      type(part_t), intent(out) :: part     !! what is drawn

      real(wp) :: angle, s(3, 2*n_side)
      integer :: k, next

      do k = 1, n_side
         angle = 2.0_wp*half_turn*real(k - 1, wp)/real(n_side, wp)
         s(:, k) = centre + radius*(cos(angle)*axes(:, 1) + sin(angle)*axes(:, 2)) - half*axes(:, 3)
         s(:, n_side + k) = s(:, k) + 2.0_wp*half*axes(:, 3)
      end do
      call start_part(part, body, s)
      call add_stroke(part, [(k, k=1, n_side)], .true., in_both)
      call add_stroke(part, [(n_side + k, k=1, n_side)], .true., in_both)
      do k = 1, n_side
         next = mod(k, n_side) + 1
         call add_stroke(part, [k, next, n_side + next, n_side + k], .true., in_files)
      end do
      do k = 1, n_side, n_side/4
         call add_stroke(part, [k, n_side + k], .false., in_pictures)
      end do
   end subroutine take_cylinder

   !> A sphere; in the plane, a circle.
   subroutine sphere_part(radius, centre, is_spatial, body, part)
      real(wp), intent(in) :: radius        !! its radius [m]
      real(wp), intent(in) :: centre(3)     !! (3) its centre [m]
      logical, intent(in) :: is_spatial     !! the scene is in space
      integer, intent(in) :: body           !! its body
      type(part_t), intent(out) :: part     !! what is drawn

      real(wp) :: across, angle, latitude, s(3, n_side*(n_belt + 1))
      integer :: at, belt, k, next

      if (.not. is_spatial) then
         call round_part(part, body, centre, reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], [3, 2]), radius)
         return
      end if
      do belt = 0, n_belt
         latitude = half_turn*(real(belt, wp)/real(n_belt, wp) - 0.5_wp)
         do k = 1, n_side
            angle = 2.0_wp*half_turn*real(k - 1, wp)/real(n_side, wp)
            across = cos(latitude)
            s(:, belt*n_side + k) = centre + radius*[across*cos(angle), across*sin(angle), sin(latitude)]
         end do
      end do
      call start_part(part, body, s)
      do belt = 0, n_belt - 1
         at = belt*n_side
         do k = 1, n_side
            next = mod(k, n_side) + 1
            call add_stroke(part, [at + k, at + next, at + n_side + next, at + n_side + k], .true., in_files)
         end do
      end do
      at = n_belt/2*n_side
      call add_stroke(part, [(at + k, k=1, n_side), at + 1], .false., in_pictures)
      do k = 1, n_side/2, n_side/4  ! meridians, there and back
         call add_stroke(part, [(belt*n_side + k, belt=0, n_belt), ((n_belt - belt)*n_side + k + n_side/2, belt=0, n_belt)], &
                         .false., in_pictures)
      end do
   end subroutine sphere_part

end module shapes
