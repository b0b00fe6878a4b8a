!> One page that plays a mechanism, with everything in it: HTML, three.js, our scripts (page/) and the data.
!>
!> The data are one object of JavaScript, `D`: numbers, arrays in base 64, and checked names. Text of the deck stands in strings
!> whose quotes, backslashes, `<`, `>` and `&` are written by their codes, so that it is text in the script and in the page.
!> Positions and rows of joints are thinned until the page is below its limit, and the page says so.
module animation_page
   use catalogue, only: catalogue_t
   use display_units, only: choose_unit, display_unit_t
   use drawing, only: drawing_t, in_both, in_pictures, part_t, stroke_t
   use frames, only: frame_t
   use groups_of_catalogue, only: group_bodies, group_clearances
   use html_text, only: doubles_in_base_64, escaped, floats_in_base_64, integers_in_base_64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use page_files, only: page_body, page_file, page_head, page_licence, page_orbit, page_scripts, page_three
   use rotations, only: euler_parameters_of
   use scene_legends, only: long_legend
   use scene_canvas, only: symbols_t
   use symbol_scales, only: new_symbols
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   use tracks, only: greater, track_t
   implicit none (type, external)
   private
   public :: page_text

   integer, parameter :: digits = 7             !! of numbers that are written as text
   integer, parameter :: most_bytes = 4900000   !! of a page
   integer, parameter :: most_of_track = 900000 !! of them for the rows of joints with clearance
   integer, parameter :: of_float = 6           !! letters of a number in single precision, about
   integer, parameter :: of_double = 11         !! the same in double precision

contains

   !> The page.
   function page_text(title, catalogue, drawing, list, repeats, track, plots, n_left_out) result(text)
      character(*), intent(in) :: title              !! of the scene, any text
      type(catalogue_t), intent(in) :: catalogue     !! what was recorded
      type(drawing_t), intent(in) :: drawing         !! the scene
      type(frame_t), intent(in) :: list(:)           !! (1 or more) frames
      logical, intent(in) :: repeats                 !! the last of them is like the first
      type(track_t), intent(in) :: track             !! eccentricities and forces over the window
      character(*), intent(in) :: plots              !! of `plots_text`
      integer, intent(in) :: n_left_out              !! curves that these do not have
      character(:), allocatable :: text              !! HTML

      type(buffer_t) :: data, page
      type(symbols_t) :: symbols
      character(:), allocatable :: note
      integer :: k, rest, stride

      call new_symbols(catalogue, drawing, list, symbols)
      if (.not. symbols%force > 0.0_wp .and. track%n > 0) symbols%force = maxval(norm2(track%f(:, :, :track%n), dim=1))
      note = ""
      call data%line("const D={spatial:"//truth(drawing%is_spatial)//",repeats:"//truth(repeats)//",size:"//number(symbols%size)// &
                     ",magnified:"//number(symbols%magnified)//",force:"//number(symbols%force)//",legend:"""// &
                     escaped(long_legend(symbols), .false.)//""",")
      call add_names(data, catalogue, drawing)
      call add_parts(data, drawing)
      call add_marks(data, drawing, symbols)
      call add_joints(data, catalogue)
      call add_track(data, track, size(catalogue%item_groups(group_clearances)%names), note)
      call data%line("plots:"//plots//",")
      if (n_left_out > 0) note = note//"Not shown: "//to_text(n_left_out)//" more curves. "
      call page%line("<!DOCTYPE html>")
      call page%line("<html lang=""en""><head><meta charset=""utf-8""><meta name=""viewport"" content=""width=device-width"">"// &
                     "<title>"//escaped(title, .true.)//"</title>")
      call page%add(page_file(page_head))
      call page%line("<h1>"//escaped(title, .true.)//"</h1>")
      call page%add(page_file(page_body))
      call page%line("<!-- "//page_file(page_licence)//"-->")
      do k = 1, 2
         call page%line("<script>"//page_file(merge(page_three, page_orbit, k == 1)))
         call page%line("</script>")
      end do
      rest = page%length() + data%length()
      do k = 1, size(page_scripts)
         rest = rest + len(page_file(page_scripts(k)))
      end do
      stride = stride_of(list, most_bytes - rest)
      if (stride > 1) note = note//"Every "//to_text(stride)//". of "//to_text(size(list))// &
                             " positions, so that the page stays below 5 MB. "
      call add_frames(data, list(::stride))
      call page%line("<script>")
      call page%add(data%get())
      call page%line("note:"""//note//"""};")
      do k = 1, size(page_scripts)
         call page%add(page_file(page_scripts(k)))
      end do
      call page%line("</script></body></html>")
      text = page%get()
   end function page_text

   !> Stride with which frames are kept, so that the page stays within its limit.
   pure integer function stride_of(list, bytes) result(stride)
      type(frame_t), intent(in) :: list(:)     !! (1 or more) frames
      integer, intent(in) :: bytes             !! that they may take

      integer :: of_frame

      associate (f => list(1))
         of_frame = of_double + of_float*(7*size(f%r, 2) + size(f%load))
      end associate
      stride = max(1, min(size(list), 1 + (size(list) - 1)/max(1, bytes/of_frame)))
   end function stride_of

   !> Bodies, the ground first, and points of the deck.
   subroutine add_names(data, catalogue, drawing)
      type(buffer_t), intent(inout) :: data        !! the data
      type(catalogue_t), intent(in) :: catalogue   !! what was recorded
      type(drawing_t), intent(in) :: drawing       !! the scene

      integer :: k

      call data%add("bodies:[""ground"",")
      do k = 1, size(catalogue%item_groups(group_bodies)%names)
         call data%add(""""//escaped(catalogue%item_groups(group_bodies)%names(k)%s, .false.)//""",")
      end do
      call data%line("],")
      call data%add("points:[")
      do k = 1, size(drawing%points)
         if (drawing%body(k) == 0) cycle
         call data%add("{n:"""//escaped(drawing%points(k)%s, .false.)//""",b:"//to_text(drawing%body(k))//",s:"// &
                       triple(drawing%s(:, k))//"},")
      end do
      call data%line("],")
   end subroutine add_names

   !> Outlines: vertices `s`, polygons `f`, triangles `t`, lines `l`. What stands for round bodies in flat pictures is omitted.
   subroutine add_parts(data, drawing)
      type(buffer_t), intent(inout) :: data    !! the data
      type(drawing_t), intent(in) :: drawing   !! the scene

      integer :: j, k

      call data%add("parts:[")
      do k = 1, drawing%n_part
         associate (part => drawing%parts(k))
            if (.not. any([(is_shown(part, part%strokes(j)), j=1, size(part%strokes))])) cycle
            call data%add("{b:"//to_text(part%body)//",s:"""// &
                          floats_in_base_64(reshape(part%s, [size(part%s)]))//""",f:[")
            call add_strokes(data, part, .true.)
            call data%add("],l:[")
            call add_strokes(data, part, .false.)
            call data%add("]")
            if (has_triangles(part)) call data%add(",t:"""//integers_in_base_64(triangles_of(part))//"""")
            call data%line("},")
         end associate
      end do
      call data%line("],")
   end subroutine add_parts

   !> Whether a stroke is drawn: faces but those for pictures, lines but those for files; those for
   !> pictures of a disc (its diameter) and of a shaft (its bar), not of what has several faces.
   pure logical function is_shown(part, stroke)
      type(part_t), intent(in) :: part         !! its part
      type(stroke_t), intent(in) :: stroke     !! the stroke

      if (stroke%is_face) then
         is_shown = stroke%use /= in_pictures
      else
         is_shown = stroke%use == in_both .or. (stroke%use == in_pictures .and. count(part%strokes%is_face) <= 1)
      end if
   end function is_shown

   !> Whether a part is a mesh: more than one face, all of them triangles.
   pure logical function has_triangles(part)
      type(part_t), intent(in) :: part         !! the part

      integer :: k

      has_triangles = count(part%strokes%is_face) > 1
      do k = 1, size(part%strokes)
         if (part%strokes(k)%is_face) has_triangles = has_triangles .and. size(part%strokes(k)%vertices) == 3
      end do
   end function has_triangles

   !> Corners of the triangles of a mesh, from 0.
   pure function triangles_of(part) result(list)
      type(part_t), intent(in) :: part         !! the part
      integer, allocatable :: list(:)          !! (3 faces) numbers

      integer :: k, n

      allocate (list(3*count(part%strokes%is_face)))
      n = 0
      do k = 1, size(part%strokes)
         if (.not. part%strokes(k)%is_face) cycle
         list(n + 1:n + 3) = part%strokes(k)%vertices - 1
         n = n + 3
      end do
   end function triangles_of

   !> Polygons or lines of a part.
   subroutine add_strokes(data, part, are_faces)
      type(buffer_t), intent(inout) :: data    !! the data
      type(part_t), intent(in) :: part         !! the part
      logical, intent(in) :: are_faces         !! polygons, not lines

      integer :: i, k

      if (are_faces .and. has_triangles(part)) return
      do k = 1, size(part%strokes)
         if ((part%strokes(k)%is_face .neqv. are_faces) .or. .not. is_shown(part, part%strokes(k))) cycle
         call data%add("[")
         do i = 1, size(part%strokes(k)%vertices)
            call data%add(to_text(part%strokes(k)%vertices(i) - 1)//",")
         end do
         call data%add("],")
      end do
   end subroutine add_strokes

   !> Joints and elements.
   subroutine add_marks(data, drawing, symbols)
      type(buffer_t), intent(inout) :: data    !! the data
      type(drawing_t), intent(in) :: drawing   !! the scene
      type(symbols_t), intent(in) :: symbols   !! scales

      integer :: k

      call data%add("marks:[")
      do k = 1, drawing%n_mark
         associate (mark => drawing%marks(k))
            call data%line("{k:"//to_text(mark%kind)//",n:"""//escaped(mark%name, .false.)//""",b:["//to_text(mark%body(1))//","// &
                           to_text(mark%body(2))//"],s:["//triple(mark%s(:, 1))//","//triple(mark%s(:, 2))//"],a:"// &
                           triple(mark%axis)//",w:"//pair(symbols%ways(:, k))//",h:"//pair(symbols%walls(:, k))//",l:"// &
                           to_text(symbols%clearance_joints(k))//",g:"//pair(mark%gaps)//",R:"//pair(symbols%bearings(:, k))// &
                           ",d:"//number(mark%half_length)//",aj:"// &
                           triple(mark%axis_j)//",q:"//to_text(symbols%load(k))//",c:"//number(symbols%coils(k))//",z:"// &
                           to_text(symbols%bends(k))//"},")
         end associate
      end do
      call data%line("],")
   end subroutine add_marks

   !> Joints with clearance.
   subroutine add_joints(data, catalogue)
      type(buffer_t), intent(inout) :: data          !! the data
      type(catalogue_t), intent(in) :: catalogue     !! what was recorded

      type(display_unit_t) :: unit
      real(wp) :: clearance
      integer :: k

      associate (joints => catalogue%item_groups(group_clearances))
         call data%add("joints:[")
         do k = 1, size(joints%names)
            clearance = 0.0_wp
            if (.not. ieee_is_nan(joints%radius(k))) clearance = joints%radius(k)
            unit = choose_unit("m", clearance)
            call data%add("{n:"""//escaped(joints%names(k)%s, .false.)//""",c:"//number(clearance)//",cw:"""// &
                          real_text(unit%factor*clearance, 4)//" "//unit%symbol//"""},")
         end do
         call data%line("],")
      end associate
   end subroutine add_joints

   !> Eccentricities and forces of the joints with clearance over the window; where rows are joined, the greatest force stays.
   subroutine add_track(data, track, n_joint, note)
      type(buffer_t), intent(inout) :: data                !! the data
      type(track_t), intent(in) :: track                   !! what was followed
      integer, intent(in) :: n_joint                       !! joints with clearance
      character(:), allocatable, intent(inout) :: note     !! says what is thinned

      integer :: first, k, n, stride
      real(wp), allocatable :: peaks(:, :, :)

      n = 0
      if (n_joint > 0) n = track%n
      stride = 1 + n/max(2, most_of_track/(of_double + 6*of_float*max(1, n_joint)))
      if (stride > 1) note = "Joints: every "//to_text(stride)//". of "//to_text(n)//" rows, with the peaks of the force. "
      call data%add("track:{")
      if (n == 0) then
         call data%line("t:"""",f:[],e:[]},")
         return
      end if
      call data%add("t:"""//doubles_in_base_64(track%t(1:n:stride))//""",f:[")
      peaks = track%f(:, :, 1:n:stride)
      do k = 1, n
         first = 1 + (k - 1)/stride
         peaks(:, :, first) = greater(peaks(:, :, first), track%f(:, :, k))
      end do
      do k = 1, n_joint
         call data%line(""""//floats_in_base_64(reshape(peaks(:, k, :), [3*size(peaks, 3)]))//""",")
      end do
      call data%add("],e:[")
      do k = 1, n_joint
         call data%line(""""//floats_in_base_64(reshape(track%e(:, k, 1:n:stride), [3*size(peaks, 3)]))//""",")
      end do
      call data%line("]},")
   end subroutine add_track

   !> Places, turns and loads at each position, one list each with the positions one after the other.
   subroutine add_frames(data, list)
      type(buffer_t), intent(inout) :: data    !! the data
      type(frame_t), intent(in) :: list(:)     !! (n) frames

      real(wp), allocatable :: turns(:, :)
      real(wp) :: p(4)
      integer :: b, k

      call data%line("t:"""//doubles_in_base_64(list%t)//""",")
      allocate (turns(4*size(list(1)%r, 2), size(list)))
      do k = 1, size(list)
         do b = 0, ubound(list(k)%r, 2)
            p = euler_parameters_of(list(k)%a(:, :, b))
            turns(4*b + 1:4*b + 4, k) = [p(2:4), p(1)]
         end do
      end do
      call data%line("q:"""//floats_in_base_64(reshape(turns, [size(turns)]))//""",")
      call data%line("r:"""//floats_in_base_64([(list(k)%r, k=1, size(list))])//""",")
      call data%line("g:"""//floats_in_base_64([(list(k)%load, k=1, size(list))])//""",")
   end subroutine add_frames

   !> Yes or no.
   pure function truth(is_so) result(s)
      logical, intent(in) :: is_so             !! which
      character(:), allocatable :: s           !! as JavaScript has it

      s = trim(merge("true ", "false", is_so))
   end function truth

   !> Two numbers.
   function pair(x) result(s)
      real(wp), intent(in) :: x(2)             !! (2) the numbers [any]
      character(:), allocatable :: s           !! as `[1,2]`

      s = "["//number(x(1))//","//number(x(2))//"]"
   end function pair

   !> A vector.
   function triple(x) result(s)
      real(wp), intent(in) :: x(3)             !! (3) the vector [any]
      character(:), allocatable :: s           !! as `[1,2,3]`

      s = "["//number(x(1))//","//number(x(2))//","//number(x(3))//"]"
   end function triple

   !> A number.
   function number(x) result(s)
      real(wp), intent(in) :: x                !! the number [any]
      character(:), allocatable :: s           !! its digits

      s = real_text(x, digits)
   end function number

end module animation_page
