!> What a drawn mechanism is made of: styles, sizes of symbols, polylines and circles.
module scene_canvas
   use kinds, only: wp
   use scene_colours, only: dark
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_disc, add_line, add_ring, bearing_size, canvas_t, journal_part, n_style, pin_size, symbols_t
   public :: style_arrow, style_body, style_ground, style_hole, style_journal, style_line, style_name, style_path, style_pin, &
      style_symbol

   ! styles, in the order in which they are drawn
   integer, parameter :: style_ground = 1    !! lines of the ground
   integer, parameter :: style_body = 2      !! filled outlines
   integer, parameter :: style_line = 3      !! lines of bodies
   integer, parameter :: style_path = 4      !! path of a point
   integer, parameter :: style_pin = 5       !! filled symbols of joints
   integer, parameter :: style_symbol = 6    !! lines of symbols, springs and links
   integer, parameter :: style_hole = 7      !! filled holes of clearance joints
   integer, parameter :: style_journal = 8   !! filled journals
   integer, parameter :: style_arrow = 9     !! forces
   integer, parameter :: style_name = 10     !! names, of bodies, joints and points
   integer, parameter :: n_style = 10        !! styles

   real(wp), parameter :: pin_size = 0.014_wp      !! radius of a pin, of the size of the scene [1]
   real(wp), parameter :: bearing_size = 0.034_wp  !! radius of a magnified bearing, of that size [1]
   real(wp), parameter :: journal_part = 0.62_wp   !! radius of its journal, of that of the bearing [1]
   integer, parameter :: n_round(2) = [24, 96]     !! sides of the circle of a pin, and of a larger one
   real(wp), parameter :: turn = 8.0_wp*atan(1.0_wp)  !! [rad]

   !> What is common to all frames of a figure.
   type :: symbols_t
      real(wp) :: size = 1.0_wp                   !! of the scene [m]
      real(wp) :: scale = 1.0_wp                  !! numbers of the picture over lengths [any/m]
      real(wp) :: magnified = 0.0_wp              !! factor of eccentricities; 0: no round joints with clearance [1]
      real(wp) :: force = 0.0_wp                  !! force of the longest arrow; 0: no arrows [N]
      logical :: is_planar = .true.               !! bodies move in the plane
      real(wp), allocatable :: ways(:, :)         !! (2, marks) of slides and slots: range of j along the axis [m]
      real(wp), allocatable :: walls(:, :)        !! (2, marks) of them: from the guide's line to its walls, as `gaps` [m]
      real(wp), allocatable :: bearings(:, :)     !! (2, marks) radii of hole and journal as drawn; 0: no bearing [m]
      real(wp), allocatable :: coils(:)           !! (marks) of springs and dampers: half their width [m]
      integer, allocatable :: bends(:)            !! (marks) of springs: corners of their zigzag
      integer, allocatable :: clearance_joints(:)            !! (marks) number of the joint with clearance, 0: none
      integer, allocatable :: load(:)             !! (marks) of a load: number of the force element, 0: none
   end type symbols_t

   !> What is drawn.
   type :: canvas_t
      type(buffer_t) :: styles(n_style)  !! lines of each style
   end type canvas_t

contains

   !> A circle that faces the eye, filled, with its line.
   subroutine add_disc(canvas, style, symbols, p, radius)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      integer, intent(in) :: style             !! of the filling
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2)             !! (2) its centre [m]
      real(wp), intent(in) :: radius           !! its radius [m]

      call add_ring(canvas, style, symbols, p, reshape([radius, 0.0_wp, 0.0_wp, radius], [2, 2]))
   end subroutine add_disc

   !> A circle in a view, an ellipse.
   subroutine add_ring(canvas, style, symbols, p, half)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      integer, intent(in) :: style             !! of the filling
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2)             !! (2) its centre [m]
      real(wp), intent(in) :: half(2, 2)       !! (2, 2) two radii at right angles, as they are seen [m]

      real(wp) :: angle, q(2, 0:n_round(2))
      integer :: k, n

      n = n_round(merge(1, 2, maxval(abs(half)) <= pin_size*symbols%size))
      do k = 0, n
         angle = turn*real(k, wp)/real(n, wp)
         q(:, k) = p + matmul(half, [cos(angle), sin(angle)])
      end do
      call add_line(canvas, style, symbols, q(:, :n), dark)
   end subroutine add_ring

   !> A polyline.
   subroutine add_line(canvas, style, symbols, p, colour)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      integer, intent(in) :: style             !! its style
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(:, :)          !! (2, n) its points [m]
      integer, intent(in) :: colour            !! red, green, blue in one number

      integer :: k

      associate (buffer => canvas%styles(style))
         do k = 1, size(p, 2)
            call buffer%line(real_text(symbols%scale*p(1, k), 6)//" "//real_text(symbols%scale*p(2, k), 6)//" "//to_text(colour))
         end do
         call buffer%line("")
      end associate
   end subroutine add_line

end module scene_canvas
