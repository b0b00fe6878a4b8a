!> One page that plays a mechanism, with everything in it: HTML, SVG and a few lines of script (`animation_script`).
!>
!> The data are numbers and checked names; text of the deck stands in strings whose quotes, backslashes, `<`, `>` and `&` are
!> written by their codes, so that it is text in the script and in the page.
module animation_page
   use animation_script, only: page_head, page_script
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances
   use display_units, only: choose_unit, display_unit_t
   use drawing, only: drawing_t, in_files
   use frames, only: frame_t
   use html_text, only: escaped
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use scene_legends, only: long_legend
   use scene_strokes, only: symbols_t
   use symbol_scales, only: new_symbols
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   use tracks, only: track_t
   implicit none (type, external)
   private
   public :: page_text

   integer, parameter :: digits = 6  !! of numbers

contains

   !> The page.
   function page_text(title, catalogue, drawing, list, track) result(text)
      character(*), intent(in) :: title              !! of the scene, any text
      type(catalogue_t), intent(in) :: catalogue     !! what was recorded
      type(drawing_t), intent(in) :: drawing         !! the scene
      type(frame_t), intent(in) :: list(:)           !! (1 or more) frames
      type(track_t), intent(in) :: track             !! eccentricities and forces over the window
      character(:), allocatable :: text              !! HTML

      type(buffer_t) :: page
      type(symbols_t) :: symbols
      integer :: k

      call new_symbols(catalogue, drawing, list, symbols)
      call page%line("<!DOCTYPE html>")
      call page%line("<html lang=""en""><head><meta charset=""utf-8""><title>"//escaped(title, .true.)//"</title>")
      do k = 1, size(page_head)
         if (index(page_head(k), "<nav>") == 1) call page%line("<h1>"//escaped(title, .true.)//"</h1>")
         call page%line(trim(page_head(k)))
      end do
      call page%line("const D={spatial:"//trim(merge("true ", "false", drawing%is_spatial))//",size:"//number(symbols%size)// &
                     ",magnified:"//number(symbols%magnified)//",force:"//number(symbols%force)//",legend:"""// &
                     escaped(long_legend(symbols), .false.)//""",")
      call add_parts(page, drawing)
      call add_marks(page, drawing, symbols)
      call add_frames(page, list)
      call add_track(page, catalogue, track)
      call page%line("};")
      do k = 1, size(page_script)
         call page%line(trim(page_script(k)))
      end do
      text = page%get()
   end function page_text

   !> Outlines.
   subroutine add_parts(page, drawing)
      type(buffer_t), intent(inout) :: page    !! the page
      type(drawing_t), intent(in) :: drawing   !! the scene

      integer :: i, j, k

      call page%add("parts:[")
      do k = 1, drawing%n_part
         associate (part => drawing%parts(k))
            call page%add("{b:"//to_text(part%body)//",s:[")
            do j = 1, size(part%s, 2)
               call page%add(triple(part%s(:, j))//",")
            end do
            call page%add("],k:[")
            do j = 1, size(part%strokes)
               if (part%strokes(j)%use == in_files) cycle
               call page%add("{f:"//trim(merge("1", "0", part%strokes(j)%is_face))//",v:[")
               do i = 1, size(part%strokes(j)%vertices)
                  call page%add(to_text(part%strokes(j)%vertices(i) - 1)//",")
               end do
               call page%add("]},")
            end do
            call page%line("]},")
         end associate
      end do
      call page%line("],")
   end subroutine add_parts

   !> Joints.
   subroutine add_marks(page, drawing, symbols)
      type(buffer_t), intent(inout) :: page    !! the page
      type(drawing_t), intent(in) :: drawing   !! the scene
      type(symbols_t), intent(in) :: symbols   !! scales

      integer :: k

      call page%add("marks:[")
      do k = 1, drawing%n_mark
         associate (mark => drawing%marks(k))
            call page%line("{k:"//to_text(mark%kind)//",b:["//to_text(mark%body(1))//","//to_text(mark%body(2))//"],s:["// &
                           triple(mark%s(:, 1))//","//triple(mark%s(:, 2))//"],a:"//triple(mark%axis)//",w:"// &
                           pair(symbols%ways(:, k))//",h:"//pair(symbols%walls(:, &
                                k))//",l:"//to_text(symbols%clearance_joints(k))//",g:"// &
                           pair(mark%gaps)//",n:"//number(mark%half_length)//",aj:"//triple(mark%axis_j)//",q:"// &
                           to_text(symbols%load(k))//",c:"//number(symbols%coils(k))//",z:"//to_text(symbols%bends(k))//"},")
         end associate
      end do
      call page%line("],")
   end subroutine add_marks

   !> Places at each picture.
   subroutine add_frames(page, list)
      type(buffer_t), intent(inout) :: page    !! the page
      type(frame_t), intent(in) :: list(:)     !! (n) frames

      integer :: j, k

      call page%add("frames:[")
      do k = 1, size(list)
         call page%add("{t:"//number(list(k)%t)//",r:[")
         call add_numbers(page, reshape(list(k)%r, [size(list(k)%r)]))
         call page%add("],a:[")
         call add_numbers(page, reshape(list(k)%a, [size(list(k)%a)]))
         call page%add("],e:[")
         do j = 1, size(list(k)%e, 2)
            call page%add(triple(list(k)%e(:, j))//",")
         end do
         call page%add("],f:[")
         do j = 1, size(list(k)%f, 2)
            call page%add(triple(list(k)%f(:, j))//",")
         end do
         call page%add("],g:[")
         do j = 1, size(list(k)%load, 2)
            call page%add(triple(list(k)%load(:, j))//",")
         end do
         call page%line("]},")
      end do
      call page%line("],")
   end subroutine add_frames

   !> Clearance joints, their eccentricities and forces over the window.
   subroutine add_track(page, catalogue, track)
      type(buffer_t), intent(inout) :: page          !! the page
      type(catalogue_t), intent(in) :: catalogue     !! what was recorded
      type(track_t), intent(in) :: track             !! what was followed

      type(display_unit_t) :: unit
      real(wp) :: clearance
      integer :: j, k

      associate (room => catalogue%item_groups(group_clearances))
         call page%add("loose:[")
         do k = 1, size(room%names)
            clearance = 0.0_wp
            if (.not. ieee_is_nan(room%radius(k))) clearance = room%radius(k)
            unit = choose_unit("m", clearance)
            call page%add("{name:"""//escaped(room%names(k)%s, .false.)//""",c:"//number(clearance)//",cw:"""// &
                          real_text(unit%factor*clearance, 4)//" "//unit%symbol//"""},")
         end do
         call page%add("],track:{t:[")
         if (track%n > 0) call add_numbers(page, track%t(:track%n))
         call page%add("],f:[")
         do k = 1, size(room%names)
            call page%add("[")
            if (track%n > 0) call add_numbers(page, track%f(k, :track%n))
            call page%line("],")
         end do
         call page%add("],e:[")
         do k = 1, size(room%names)
            call page%add("[")
            do j = 1, track%n
               call page%add(triple(track%e(:, k, j))//",")
            end do
            call page%line("],")
         end do
         call page%line("]}")
      end associate
   end subroutine add_track

   !> Numbers with commas.
   subroutine add_numbers(page, values)
      type(buffer_t), intent(inout) :: page    !! the page
      real(wp), intent(in) :: values(:)        !! (n) the numbers [any]

      integer :: k

      do k = 1, size(values)
         call page%add(number(values(k))//",")
      end do
   end subroutine add_numbers

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
