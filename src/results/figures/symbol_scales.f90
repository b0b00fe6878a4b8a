!> Sizes of the symbols of a drawn mechanism, and what they report of its motion: ways of slides, forces, magnified clearances.
module symbol_scales
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances, group_forces
   use drawing, only: drawing_t, mark_bearing, mark_damper, mark_load, mark_plane, mark_slide, mark_slot, mark_spring, mark_t
   use frames, only: frame_t
   use kinds, only: wp
   use scene_canvas, only: bearing_size, journal_part, pin_size, symbols_t
   use scene_strokes, only: arrow_at
   implicit none (type, external)
   private
   public :: arrow_tips, largest_force, new_symbols

   real(wp), parameter :: slot_size = 1.3_wp*pin_size  !! half the width of a slot, of the size of the scene [1]
   real(wp), parameter :: min_wall = 0.0425_wp  !! from the middle of a guide to its walls, of the size of the scene, at least [1]

contains

   !> Scales of symbols, ways of slides, and the joints with clearance of the marks.
   subroutine new_symbols(catalogue, drawing, list, symbols)
      type(catalogue_t), intent(in) :: catalogue    !! what was recorded
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(frame_t), intent(in) :: list(:)          !! (n) frames
      type(symbols_t), intent(out) :: symbols       !! scales

      real(wp), parameter :: of_way = 0.5_wp  ! size of symbols over the extent of the motion, at least [1]
      real(wp) :: across, along, axis(3), half(2), x(3, 2)
      integer :: f, i, k

      symbols%size = max(drawing%size, of_way*extent_of_motion(drawing, list))
      symbols%is_planar = .not. drawing%is_spatial
      call measure_bearings(drawing, symbols)
      allocate (symbols%ways(2, drawing%n_mark), symbols%clearance_joints(drawing%n_mark))
      allocate (symbols%load(drawing%n_mark), source=0)
      symbols%ways = 0.0_wp
      symbols%clearance_joints = 0
      allocate (symbols%walls(2, drawing%n_mark), source=min_wall*symbols%size)
      do k = 1, drawing%n_mark
         associate (mark => drawing%marks(k), names => catalogue%item_groups(group_clearances)%names)
            do i = 1, size(names)
               if (names(i)%s == mark%name) symbols%clearance_joints(k) = i
            end do
            if (mark%kind == mark_load) symbols%load(k) = number_of(catalogue, mark%name)
            if (all(mark%kind /= [mark_slide, mark_plane, mark_slot])) cycle
            symbols%ways(:, k) = [huge(1.0_wp), -huge(1.0_wp)]
            do f = 1, size(list)
               do i = 1, 2
                  x(:, i) = list(f)%r(:, mark%body(i)) + matmul(list(f)%a(:, :, mark%body(i)), mark%s(:, i))
               end do
               axis = matmul(list(f)%a(:, :, mark%body(1)), mark%axis)
               if (mark%kind == mark_plane .and. .not. drawing%is_spatial) axis = [axis(2), -axis(1), 0.0_wp]
               along = dot_product(axis, x(:, 2) - x(:, 1))
               across = along
               if (mark%kind == mark_plane .and. drawing%is_spatial) then  ! in the plane, whichever way
                  along = norm2(x(:, 2) - x(:, 1) - along*axis)
                  across = -along
               end if
               symbols%ways(:, k) = [min(symbols%ways(1, k), across), max(symbols%ways(2, k), along)]
            end do
            if (mark%kind == mark_slot) symbols%walls(:, k) = slot_size*symbols%size
            if (drawing%is_spatial .or. mark%kind /= mark_slide) cycle
            half = mark%sides
            if (maxval(half) > 0.0_wp) then
               symbols%walls(:, k) = half(2) + mark%gaps
            else
               half = half_sides(drawing, list, mark, symbols%size)
               symbols%walls(:, k) = max(symbols%walls(:, k), half(2))
            end if
            symbols%ways(:, k) = symbols%ways(:, k) + [-half(1), half(1)]
         end associate
      end do
      call measure_springs(drawing, list, symbols)
      symbols%force = largest_force(symbols, list)
   end subroutine new_symbols

   !> Widths of springs and dampers, and corners of springs: in proportion to the scene, fewer and narrower where one is short, by
   !> its maximum length, so that they are the same in all frames.
   pure subroutine measure_springs(drawing, list, symbols)
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(frame_t), intent(in) :: list(:)          !! (n) frames
      type(symbols_t), intent(inout) :: symbols     !! scales, with the size

      real(wp), parameter :: widest = 0.02_wp       ! half a width, of the size of the scene [1]
      real(wp), parameter :: slender = 0.2_wp       ! the same of the length, at most [1]
      real(wp), parameter :: apart = 0.015_wp       ! corners along a spring, of the size of the scene, at least [1]
      integer, parameter :: fewest = 4, most = 12   ! corners
      real(wp) :: length, x(3, 2)
      integer :: f, i, k

      allocate (symbols%coils(drawing%n_mark), source=0.0_wp)
      allocate (symbols%bends(drawing%n_mark), source=0)
      do k = 1, drawing%n_mark
         associate (mark => drawing%marks(k))
            if (mark%kind /= mark_spring .and. mark%kind /= mark_damper) cycle
            length = 0.0_wp
            do f = 1, size(list)
               do i = 1, 2
                  x(:, i) = list(f)%r(:, mark%body(i)) + matmul(list(f)%a(:, :, mark%body(i)), mark%s(:, i))
               end do
               length = max(length, norm2(x(:, 2) - x(:, 1)))
            end do
         end associate
         symbols%coils(k) = min(widest*symbols%size, slender*length)
         symbols%bends(k) = max(fewest, min(most, 2*int(0.5_wp*length/(apart*symbols%size))))
      end do
   end subroutine measure_springs

   !> The diagonal of the box in which the centres of mass of all bodies are, with the size of the largest outline.
   pure real(wp) function extent_of_motion(drawing, list) result(length)
      type(drawing_t), intent(in) :: drawing !! outlines
      type(frame_t), intent(in) :: list(:)   !! (n) frames

      real(wp) :: maximum(3), minimum(3), radius
      integer :: k

      maximum = -huge(1.0_wp)
      minimum = huge(1.0_wp)
      do k = 1, size(list)
         minimum = min(minimum, minval(list(k)%r(:, 1:), dim=2))
         maximum = max(maximum, maxval(list(k)%r(:, 1:), dim=2))
      end do
      radius = 0.0_wp
      do k = 1, drawing%n_part
         if (drawing%parts(k)%body > 0) radius = max(radius, maxval(norm2(drawing%parts(k)%s, dim=1)))
      end do
      length = norm2(maximum - minimum) + 2.0_wp*radius
   end function extent_of_motion

   !> Number of a force element among those of the run, 0: it is none of them.
   pure integer function number_of(catalogue, name) result(number)
      type(catalogue_t), intent(in) :: catalogue    !! what was recorded
      character(*), intent(in) :: name              !! of the element

      do number = size(catalogue%item_groups(group_forces)%names), 1, -1
         if (catalogue%item_groups(group_forces)%names(number)%s == name) return
      end do
   end function number_of

   !> Half the sides of what slides in a guide of the plane, along and across it; 0 where it turns in it or is far too wide.
   pure function half_sides(drawing, list, mark, size_of_symbols) result(half)
      type(drawing_t), intent(in) :: drawing         !! outlines
      type(frame_t), intent(in) :: list(:)           !! (n) frames
      type(mark_t), intent(in) :: mark               !! the slide
      real(wp), intent(in) :: size_of_symbols        !! of the scene [m]
      real(wp) :: half(2)                            !! (2) along and across [m]

      real(wp), parameter :: steady = 0.05_wp        ! turn that is none [rad]
      real(wp), parameter :: widest = 0.5_wp         ! of the size of the scene [1]
      real(wp) :: axes(3, 2), turn(3, 3)
      integer :: i, j, k

      half = 0.0_wp
      do k = 1, size(list)
         turn = matmul(transpose(list(k)%a(:, :, mark%body(2))), list(k)%a(:, :, mark%body(1)))
         if (k == 1) axes = matmul(turn, reshape([mark%axis, -mark%axis(2), mark%axis(1), 0.0_wp], [3, 2]))
         if (abs(dot_product(axes(:, 2), matmul(turn, mark%axis))) > steady) return
      end do
      do k = 1, drawing%n_part
         associate (part => drawing%parts(k))
            if (part%body /= mark%body(2) .or. .not. any(part%strokes%is_face)) cycle
            do j = 1, size(part%s, 2)
               do i = 1, 2
                  half(i) = max(half(i), abs(dot_product(axes(:, i), part%s(:, j) - mark%s(:, 2))))
               end do
            end do
         end associate
      end do
      if (half(2) > widest*size_of_symbols) half = 0.0_wp
   end function half_sides

   !> Bearings: each in its size where that is larger than the symbol, with a journal that touches it at its clearance, magnified by
   !> one factor for all: the largest clearance fills the gap of the symbol, or a part of the smallest bearing that is drawn.
   pure subroutine measure_bearings(drawing, symbols)
      type(drawing_t), intent(in) :: drawing        !! the scene
      type(symbols_t), intent(inout) :: symbols     !! scales, with the size

      real(wp), parameter :: gap = 0.1_wp   ! of the radius of the smallest bearing [1]
      real(wp) :: clearance, smallest
      integer :: k

      allocate (symbols%bearings(2, drawing%n_mark), source=0.0_wp)
      clearance = 0.0_wp
      smallest = huge(1.0_wp)
      do k = 1, drawing%n_mark
         if (drawing%marks(k)%kind /= mark_bearing) cycle
         symbols%bearings(:, k) = max(bearing_size*symbols%size, drawing%marks(k)%radius)
         smallest = min(smallest, symbols%bearings(1, k))
         clearance = max(clearance, drawing%marks(k)%clearance)
      end do
      if (.not. clearance > 0.0_wp) return
      symbols%magnified = max((1.0_wp - journal_part)*bearing_size*symbols%size, gap*smallest)/clearance
      do k = 1, drawing%n_mark
         symbols%bearings(2, k) = symbols%bearings(2, k) - symbols%magnified*drawing%marks(k)%clearance
      end do
   end subroutine measure_bearings

   !> Where the arrows of some frames end.
   pure function arrow_tips(drawing, symbols, list) result(tips)
      type(drawing_t), intent(in) :: drawing         !! the scene
      type(symbols_t), intent(in) :: symbols         !! scales
      type(frame_t), intent(in) :: list(:)           !! (n) frames
      real(wp) :: tips(3, size(list)*drawing%n_mark) !! (3, n marks) ends of the arrows, world frame [m]

      integer :: f, k

      do f = 1, size(list)
         do k = 1, drawing%n_mark
            associate (mark => drawing%marks(k))
               tips(:, (f - 1)*drawing%n_mark + k) = list(f)%r(:, mark%body(2)) &
                  + matmul(list(f)%a(:, :, mark%body(2)), mark%s(:, 2)) + arrow_at(symbols, list(f), k)
            end associate
         end do
      end do
   end function arrow_tips

   !> The maximum force of the joints with clearance, and of the loads that are drawn, in some frames.
   pure real(wp) function largest_force(symbols, list) result(force)
      type(symbols_t), intent(in) :: symbols  !! which loads are drawn
      type(frame_t), intent(in) :: list(:)    !! (n) frames

      integer :: i, k

      force = 0.0_wp
      do k = 1, size(list)
         do i = 1, size(list(k)%f, 2)
            force = max(force, norm2(list(k)%f(:, i)))
         end do
         do i = 1, size(symbols%load)
            if (symbols%load(i) > 0) force = max(force, norm2(list(k)%load(:, symbols%load(i))))
         end do
      end do
   end function largest_force

end module symbol_scales
