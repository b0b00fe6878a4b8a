!> Names of bodies, joints, force elements and points in a picture of the mechanism, each beside what it names.
!>
!> Of the places around it a name takes the one with the fewest strokes, without another name, within the picture, and near. In an
!> animation it stays where it was from picture to picture unless that is much worse. A point has a name where no joint or element
!> stands on it, and a dot.
module scene_names
   use drawing, only: drawing_t, mark_bearing, mark_damper, mark_link, mark_spring
   use frames, only: frame_t
   use kinds, only: wp
   use scene_colours, only: body_colour, dark, grey
   use scene_canvas, only: add_disc, bearing_size, canvas_t, n_style, pin_size, style_name, style_pin, symbols_t
   use scene_views, only: extents_t, projected, view_t
   use text, only: real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: add_names, count_names, names_t, start_names

   integer, parameter :: n_side = 9               !! directions from what is named: none, and eight
   integer, parameter :: n_ring = 4               !! distances
   real(wp), parameter :: dot_size = 0.4_wp       !! radius of a point, of that of a pin [1]
   real(wp), parameter :: bonus = 4.0_wp          !! cost that it may have more to stay where it was [1]

   !> One name.
   type :: name_t
      character(:), allocatable :: text    !! the name
      integer :: body(2) = 0               !! (2) what it names is fixed in them, halfway between two places [1]
      real(wp) :: s(3, 2) = 0.0_wp         !! (3, 2) these places, own frames [m]
      real(wp) :: radius = 0.0_wp          !! of its symbol [m]
      integer :: colour = dark             !! of its letters
      logical :: has_dot = .false.         !! it is that of a point
      integer :: choice = 0                !! place that it had last; 0: none
   end type name_t

   !> Names of a figure.
   type :: names_t
      type(name_t), allocatable :: list(:)   !! (n) names
      real(wp) :: letter(2) = 0.0_wp         !! (2) width and height of a letter [m]
   end type names_t

contains

   !> How many names a scene has.
   integer function count_names(drawing, bodies) result(n)
      type(drawing_t), intent(in) :: drawing   !! the scene
      type(text_t), intent(in) :: bodies(:)    !! (n) names of its bodies

      type(names_t) :: names

      call start_names(drawing, bodies, 1.0_wp, [0.0_wp, 0.0_wp], names)
      n = size(names%list)
   end function count_names

   !> The names of a scene.
   subroutine start_names(drawing, bodies, size_of_symbols, letter, names)
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(text_t), intent(in) :: bodies(:)         !! (n) names of its bodies
      real(wp), intent(in) :: size_of_symbols       !! of the scene [m]
      real(wp), intent(in) :: letter(2)             !! (2) width and height of a letter [m]
      type(names_t), intent(out) :: names           !! not placed yet

      type(name_t) :: name
      integer :: k

      names%letter = letter
      allocate (names%list(0))
      do k = 1, size(bodies)
         name = new_name(bodies(k)%s, [k, k], spread(middle_of(drawing, k), 2, 2), 0.0_wp, body_colour(k, 0.0_wp))
         names%list = [names%list, name]
      end do
      do k = 1, drawing%n_mark
         associate (mark => drawing%marks(k))
            name = new_name(mark%name, mark%body, mark%s, pin_size*size_of_symbols, dark)
            if (mark%kind == mark_bearing) name%radius = max(bearing_size*size_of_symbols, mark%radius)
            if (all(mark%kind /= [mark_spring, mark_damper, mark_link])) then
               name%body = mark%body(2)
               name%s = spread(mark%s(:, 2), 2, 2)
            end if
            names%list = [names%list, name]
         end associate
      end do
      do k = 1, size(drawing%points)
         if (has_mark(drawing, k)) cycle
         name = new_name(drawing%points(k)%s, spread(drawing%body(k), 1, 2), spread(drawing%s(:, k), 2, 2), &
                         dot_size*pin_size*size_of_symbols, grey)
         name%has_dot = .true.
         names%list = [names%list, name]
      end do
   end subroutine start_names

   !> A name that is not placed yet.
   pure function new_name(text, body, s, radius, colour) result(name)
      character(*), intent(in) :: text     !! the name
      integer, intent(in) :: body(2)       !! (2) what it names is fixed in them
      real(wp), intent(in) :: s(3, 2)      !! (3, 2) where, own frames [m]
      real(wp), intent(in) :: radius       !! of its symbol [m]
      integer, intent(in) :: colour        !! of its letters
      type(name_t) :: name                 !! the name

      name%text = text
      name%body = body
      name%s = s
      name%radius = radius
      name%colour = colour
   end function new_name

   !> The middle of a body's outline.
   pure function middle_of(drawing, body) result(s)
      type(drawing_t), intent(in) :: drawing   !! the scene
      integer, intent(in) :: body              !! the body
      real(wp) :: s(3)                         !! (3) own frame [m]

      integer :: k

      s = 0.0_wp
      do k = 1, drawing%n_part
         if (drawing%parts(k)%body /= body) cycle
         s = 0.5_wp*(minval(drawing%parts(k)%s, dim=2) + maxval(drawing%parts(k)%s, dim=2))
         return
      end do
   end function middle_of

   !> Whether a joint or element stands on a point.
   pure logical function has_mark(drawing, point)
      type(drawing_t), intent(in) :: drawing   !! the scene
      integer, intent(in) :: point             !! the point

      real(wp), parameter :: same = 1.0e-6_wp  ! distance of places that are one, of the size of the scene [1]
      integer :: i, k

      has_mark = .true.
      do k = 1, drawing%n_mark
         do i = 1, 2
            if (drawing%marks(k)%body(i) /= drawing%body(point)) cycle
            if (norm2(drawing%marks(k)%s(:, i) - drawing%s(:, point)) < same*drawing%size) return
         end do
      end do
      has_mark = .false.
   end function has_mark

   !> Place all names of a picture, whose strokes are drawn.
   subroutine add_names(names, frame, view, symbols, extents, canvas)
      type(names_t), intent(inout) :: names        !! the names; where they stand is kept
      type(frame_t), intent(in) :: frame           !! where the bodies are
      type(view_t), intent(in) :: view             !! from where they are seen
      type(symbols_t), intent(in) :: symbols       !! scales
      type(extents_t), intent(in) :: extents       !! of the picture [m]
      type(canvas_t), intent(inout) :: canvas      !! strokes, gets names

      real(wp), allocatable :: strokes(:, :)
      real(wp) :: at(2), box(4), boxes(4, size(names%list)), cost, least, p(2, 2)
      integer :: before, choice, k

      do k = 1, size(names%list)
         if (.not. names%list(k)%has_dot) cycle
         call find_ends(names%list(k), p)
         call add_disc(canvas, style_pin, symbols, p(:, 1), names%list(k)%radius)
      end do
      strokes = stroke_points(canvas, symbols%scale, 0.4_wp*names%letter(2))
      do k = 1, size(names%list)
         associate (name => names%list(k))
            call find_ends(name, p)
            before = name%choice
            least = huge(1.0_wp)
            do choice = 1, n_side*n_ring
               box = box_of(0.5_wp*sum(p, dim=2), name%radius, names%letter*[real(len(name%text), wp), 1.0_wp], choice)
               cost = cost_of(box, strokes, boxes(:, :k - 1), extents) + real((choice - 1)/n_side, wp) + 0.01_wp*real(choice, wp)
               if (choice == before) cost = cost - bonus
               if (cost >= least) cycle
               least = cost
               name%choice = choice
               boxes(:, k) = box
            end do
            at = 0.5_wp*symbols%scale*(boxes(1:2, k) + boxes(3:4, k))
            call canvas%styles(style_name)%line(real_text(at(1), 6)//" "//real_text(at(2), 6)//" "//to_text(name%colour)// &
                                                " """//name%text//"""")
         end associate
      end do
      if (size(names%list) > 0) call canvas%styles(style_name)%line("")

   contains

      !> The two places of what is named, in the picture.
      subroutine find_ends(name, p)
         type(name_t), intent(in) :: name   !! the name
         real(wp), intent(out) :: p(2, 2)   !! (2, 2) the places [m]

         integer :: j

         do j = 1, 2
            p(:, j) = projected(view, frame%r(:, name%body(j)) + matmul(frame%a(:, :, name%body(j)), name%s(:, j)))
         end do
      end subroutine find_ends

   end subroutine add_names

   !> The box of a name at one of the places around what it names: on it, or beside it in one of eight directions, nearer or
   !> farther.
   pure function box_of(place, radius, extent, choice) result(box)
      real(wp), intent(in) :: place(2)   !! (2) what is named [m]
      real(wp), intent(in) :: radius     !! of its symbol [m]
      real(wp), intent(in) :: extent(2)  !! (2) width and height of the name [m]
      integer, intent(in) :: choice      !! number of the place
      real(wp) :: box(4)                 !! (4) lower left and upper right corner [m]

      integer, parameter :: sides(2, n_side) = reshape([0, 0, 1, 1, -1, 1, 1, -1, -1, -1, 1, 0, -1, 0, 0, 1, 0, -1], [2, n_side])
      real(wp) :: centre(2), gap

      associate (side => real(sides(:, modulo(choice - 1, n_side) + 1), wp))
         gap = radius + extent(2)*(0.35_wp + 0.7_wp*real((choice - 1)/n_side, wp))
         if (all(abs(side) > 0.0_wp)) gap = gap*sqrt(0.5_wp)
         centre = place + side*(gap + 0.5_wp*extent)
      end associate
      box = [centre - 0.5_wp*extent, centre + 0.5_wp*extent]
   end function box_of

   !> What a place costs: the strokes in it, other names, what is beyond the picture.
   pure real(wp) function cost_of(box, strokes, others, extents) result(cost)
      real(wp), intent(in) :: box(4)              !! (4) lower left and upper right corner [m]
      real(wp), intent(in) :: strokes(:, :)       !! (2, any) points of strokes [m]
      real(wp), intent(in) :: others(:, :)        !! (4, any) boxes of other names [m]
      type(extents_t), intent(in) :: extents      !! of the picture [m]

      real(wp), parameter :: never = 1.0e3_wp     ! strokes that are better [1]
      integer :: i

      cost = 0.0_wp
      do i = 1, size(strokes, 2)
         if (all(strokes(:, i) > box(1:2) .and. strokes(:, i) < box(3:4))) cost = cost + 2.0_wp
      end do
      do i = 1, size(others, 2)
         if (all(box(1:2) < others(3:4, i) .and. box(3:4) > others(1:2, i))) cost = cost + never
      end do
      if (any(box(1:2) < extents%minimum .or. box(3:4) > extents%maximum)) cost = cost + never
   end function cost_of

   !> Points along all strokes of a canvas, at equal distances.
   function stroke_points(canvas, scale, distance) result(points)
      type(canvas_t), intent(in) :: canvas      !! the strokes, as lines of text
      real(wp), intent(in) :: scale             !! its numbers over lengths [any/m]
      real(wp), intent(in) :: distance          !! between two points, at most [m]
      real(wp), allocatable :: points(:, :)     !! (2, any) the points [m]

      character(:), allocatable :: text
      real(wp) :: last(2), next(2)
      integer :: i, k, length, n, parts, pass, start, status
      logical :: has_last

      do pass = 1, 2
         n = 0
         do k = 1, n_style
            text = canvas%styles(k)%get()
            if (k == style_name) cycle
            has_last = .false.
            last = 0.0_wp
            start = 1
            do while (start <= len(text))
               length = index(text(start:), new_line("a")) - 1
               if (length < 0) exit
               status = 1
               if (length > 0) read (text(start:start + length - 1), *, iostat=status) next
               start = start + length + 1
               if (status == 0) then
                  next = next/scale
                  parts = 1
                  if (has_last) parts = max(1, ceiling(norm2(next - last)/distance))
                  do i = 1, parts
                     n = n + 1
                     if (pass == 2) points(:, n) = next - merge((next - last)*real(parts - i, wp)/real(parts, wp), 0.0_wp, has_last)
                  end do
                  last = next
               end if
               has_last = status == 0
            end do
         end do
         if (pass == 1) allocate (points(2, n))
      end do
   end function stroke_points

end module scene_names
