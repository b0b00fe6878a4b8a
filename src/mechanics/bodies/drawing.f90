!> What a mechanism looks like: outlines of its bodies, its joints, and the points that a user may name.
!>
!> A part is fixed in a body and given in the body's own frame, as the deck gives points: vertices, and strokes between them. A
!> stroke is a line or a face; round bodies have many faces for files that are seen in space, and few lines for pictures.
module drawing
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: add_mark, add_part, add_stroke, add_teeth, drawing_t, mark_t, part_t, round_part, start_part, stroke_t
   public :: in_both, in_files, in_pictures
   public :: mark_bearing, mark_damper, mark_guide, mark_link, mark_load, mark_pin, mark_plane, mark_slide, mark_slot, mark_spring

   integer, parameter :: in_both = 0      !! a stroke for files and pictures
   integer, parameter :: in_files = 1     !! a stroke for files only
   integer, parameter :: in_pictures = 2  !! a stroke for pictures only

   integer, parameter :: mark_pin = 1      !! a joint at a point
   integer, parameter :: mark_slide = 2    !! a body slides along an axis of another
   integer, parameter :: mark_link = 3     !! a massless link between two points
   integer, parameter :: mark_spring = 4   !! a spring between two points
   integer, parameter :: mark_bearing = 5  !! a clearance joint: a journal or ball in a bearing or socket
   integer, parameter :: mark_guide = 6    !! another clearance joint
   integer, parameter :: mark_plane = 7    !! a plane that a body may touch
   integer, parameter :: mark_damper = 8   !! a damper or actuator between two points, without a spring
   integer, parameter :: mark_load = 9     !! a force at a point of body j
   integer, parameter :: mark_slot = 10    !! a pin of body j in a slot along an axis of body i, of the plane

   integer, parameter :: n_round = 96  !! sides of what is drawn for a circle

   !> A line or a face.
   type :: stroke_t
      integer, allocatable :: vertices(:)  !! (n) numbers of its vertices in the part, in order; a closed line ends with its first
      logical :: is_face = .false.         !! it is a polygon, not a line
      integer :: use = in_both             !! what it is for, one of the above
   end type stroke_t

   !> What is fixed in one body.
   type :: part_t
      integer :: body = 0                        !! the body, 0: ground
      real(wp), allocatable :: s(:, :)           !! (3, n) vertices in the body's own frame, from its centre of mass [m]
      type(stroke_t), allocatable :: strokes(:)  !! (any) lines and faces
   end type part_t

   !> A joint, or an element between two points.
   type :: mark_t
      integer :: kind = mark_pin            !! one of the above
      character(:), allocatable :: name     !! of the joint or element
      integer :: body(2) = 0                !! (2) bodies i and j, 0: ground
      real(wp) :: s(3, 2) = 0.0_wp          !! (3, 2) their points, own frames [m]
      real(wp) :: axis(3) = 0.0_wp          !! (3) of a slide; normal of a plane; own frame of i, zero: none [1]
      real(wp) :: radius = 0.0_wp           !! of a bearing: of its hole; 0: not known [m]
      real(wp) :: clearance = 0.0_wp        !! of a bearing: radial clearance [m]
      real(wp) :: gaps(2) = 0.0_wp          !! (2) of a slide with clearance: on the side of R90 axis, and on the other; 0: none [m]
      real(wp) :: sides(2) = 0.0_wp         !! (2) of a slide: half length and height of what slides; 0: as its shapes [m]
      real(wp) :: half_length = 0.0_wp      !! of a slide with clearance: of what slides [m]
      real(wp) :: axis_j(3) = 0.0_wp        !! (3) of a loose slide: direction of its length, own frame of j [1]
   end type mark_t

   !> What a scene looks like.
   type :: drawing_t
      logical :: is_spatial = .false.             !! bodies move in space
      real(wp) :: size = 1.0_wp                   !! of the scene where the deck puts it [m]
      integer :: n_part = 0                       !! number of outlines
      integer :: n_mark = 0                       !! number of joints and elements
      type(part_t), allocatable :: parts(:)       !! (n_part or more) outlines
      type(mark_t), allocatable :: marks(:)       !! (n_mark or more) joints and elements
      type(text_t), allocatable :: points(:)      !! (n) names of the deck's points
      integer, allocatable :: body(:)             !! (n) their bodies
      real(wp), allocatable :: s(:, :)            !! (3, n) where they are in these, own frames [m]
   end type drawing_t

contains

   !> Start a part with no vertices but these, and no strokes.
   subroutine start_part(part, body, s)
      type(part_t), intent(out) :: part   !! the part
      integer, intent(in) :: body         !! its body
      real(wp), intent(in) :: s(:, :)     !! (3, n) its vertices [m]

      part%body = body
      part%s = s
      allocate (part%strokes(0))
   end subroutine start_part

   !> Add a line or a face to a part.
   subroutine add_stroke(part, vertices, is_face, use)
      type(part_t), intent(inout) :: part   !! the part
      integer, intent(in) :: vertices(:)    !! (n) its vertices in order; of a face, the first stands once
      logical, intent(in) :: is_face        !! a polygon, not a line
      integer, intent(in) :: use            !! `in_both`, `in_files` or `in_pictures`

      type(stroke_t), allocatable :: grown(:)
      integer :: k, n

      n = size(part%strokes)
      allocate (grown(n + 1))
      do k = 1, n
         call move_alloc(part%strokes(k)%vertices, grown(k)%vertices)
         grown(k)%is_face = part%strokes(k)%is_face
         grown(k)%use = part%strokes(k)%use
      end do
      grown(n + 1)%vertices = vertices
      grown(n + 1)%is_face = is_face
      grown(n + 1)%use = use
      call move_alloc(grown, part%strokes)
   end subroutine add_stroke

   !> A circle across an axis, as a face; in pictures with a diameter if it is about the centre of mass, so that its turn is seen.
   subroutine round_part(part, body, centre, across, radius)
      type(part_t), intent(out) :: part    !! the part
      integer, intent(in) :: body          !! its body
      real(wp), intent(in) :: centre(3)    !! (3) its centre, own frame [m]
      real(wp), intent(in) :: across(3, 2) !! (3, 2) two unit vectors across its axis, own frame [1]
      real(wp), intent(in) :: radius       !! its radius [m]

      real(wp), parameter :: turn = 8.0_wp*atan(1.0_wp)
      real(wp), parameter :: concentric = 1.0e-6_wp  ! distance of the centres, of the radius [1]
      real(wp) :: angle, s(3, n_round)
      integer :: k

      do k = 1, n_round
         angle = turn*real(k - 1, wp)/real(n_round, wp)
         s(:, k) = centre + radius*(cos(angle)*across(:, 1) + sin(angle)*across(:, 2))
      end do
      call start_part(part, body, s)
      call add_stroke(part, [(k, k=1, n_round)], .true., in_both)
      if (norm2(centre) < concentric*radius) call add_stroke(part, [1, 1 + n_round/2], .false., in_pictures)
   end subroutine round_part

   !> Teeth of a gear in pictures: short lines across its circle, apart by about a pitch.
   subroutine add_teeth(part, centre, across, radius, pitch)
      type(part_t), intent(inout) :: part  !! the circle
      real(wp), intent(in) :: centre(3)    !! (3) its centre, own frame [m]
      real(wp), intent(in) :: across(3, 2) !! (3, 2) two unit vectors across its axis, own frame [1]
      real(wp), intent(in) :: radius       !! its radius [m]
      real(wp), intent(in) :: pitch        !! distance of two teeth along the circle, about [m]

      integer, parameter :: fewest = 8, most = 120
      real(wp), parameter :: turn = 8.0_wp*atan(1.0_wp)
      real(wp) :: angle, way(3)
      real(wp), allocatable :: s(:, :)
      integer :: k, n, before

      n = max(fewest, min(most, nint(min(turn*radius/pitch, real(most, wp)))))
      before = size(part%s, 2)
      allocate (s(3, before + 2*n))
      s(:, :before) = part%s
      do k = 1, n
         angle = turn*real(k - 1, wp)/real(n, wp)
         way = cos(angle)*across(:, 1) + sin(angle)*across(:, 2)
         s(:, before + 2*k - 1) = centre + (radius - 0.4_wp*pitch)*way
         s(:, before + 2*k) = centre + (radius + 0.4_wp*pitch)*way
         call add_stroke(part, before + [2*k - 1, 2*k], .false., in_pictures)
      end do
      call move_alloc(s, part%s)
   end subroutine add_teeth

   !> Add a part to a drawing.
   subroutine add_part(drawing, part)
      type(drawing_t), intent(inout) :: drawing  !! the drawing
      type(part_t), intent(in) :: part           !! the part

      type(part_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(drawing%parts)) allocate (drawing%parts(8))
      if (drawing%n_part == size(drawing%parts)) then
         allocate (grown(2*drawing%n_part))
         do k = 1, drawing%n_part
            grown(k)%body = drawing%parts(k)%body
            call move_alloc(drawing%parts(k)%s, grown(k)%s)
            call move_alloc(drawing%parts(k)%strokes, grown(k)%strokes)
         end do
         call move_alloc(grown, drawing%parts)
      end if
      drawing%n_part = drawing%n_part + 1
      drawing%parts(drawing%n_part) = part
   end subroutine add_part

   !> Add a joint or element to a drawing.
   subroutine add_mark(drawing, mark)
      type(drawing_t), intent(inout) :: drawing  !! the drawing
      type(mark_t), intent(in) :: mark           !! the joint

      type(mark_t), allocatable :: grown(:)
      integer :: k

      if (.not. allocated(drawing%marks)) allocate (drawing%marks(8))
      if (drawing%n_mark == size(drawing%marks)) then
         allocate (grown(2*drawing%n_mark))
         do k = 1, drawing%n_mark
            grown(k) = drawing%marks(k)
         end do
         call move_alloc(grown, drawing%marks)
      end if
      drawing%n_mark = drawing%n_mark + 1
      drawing%marks(drawing%n_mark) = mark
   end subroutine add_mark

end module drawing
