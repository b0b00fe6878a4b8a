!> What tables cannot say of themselves: names that are doubled or reserved, joints of a body with itself, journals that do not fit.
module scene_checks
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use columns, only: cell_index, column_of, find_column
   use coupler_checks, only: check_coupler
   use deck_types, only: add_default, deck_t
   use diagnostics, only: diagnostics_t
   use friction_law, only: memory_slip
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use item, only: item_t
   use joint_registry, only: n_joint_kinds
   use kind_info, only: dim_angle, dim_length, dim_t, kind_info_t, free_rotation, free_translation, same_dimension
   use kinds, only: wp
   use name_table, only: name_table_t
   use references, only: add_names
   use scene, only: scene_t, table_bodies, table_motions, table_points, table_reactions
   use scene_size, only: start_direction, start_position
   use surface_checks, only: check_law
   use text, only: text_t, to_text
   use ties, only: find_joint, tie_of, tie_t
   implicit none (type, external)
   private
   public :: check_meaning, check_names, report_doubled

   character(*), parameter :: reserved = " ground none energy request events summary ideal "
      !! words that no item may have as its name

contains

   !> Rows whose names stand in a list already.
   subroutine report_doubled(items, names, diagnostics)
      type(item_t), intent(in) :: items(:)                !! rows
      type(text_t), intent(in) :: names(:)                !! names taken
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(name_table_t) :: table
      integer :: k

      if (size(items) == 0) return
      call table%list(names)
      do k = 1, size(items)
         if (table%find(items(k)%name) == 0) cycle
         call diagnostics%add(items(k)%location, "name '"//items(k)%name//"' is used twice", &
                              "already used", "names of the same type must differ")
      end do
   end subroutine report_doubled

   !> Names must be unique among everything that has channels, and must not be reserved words.
   subroutine check_names(scene, diagnostics)
      type(scene_t), intent(in) :: scene                  !! tables
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(text_t), allocatable :: names(:)
      integer :: k

      allocate (names(0))
      call look(scene%tables%base(table_bodies)%items)
      do k = 1, n_joint_kinds()
         call look(scene%joints(k)%items)
      end do
      do k = 1, n_force_kinds()
         call look(scene%forces(k)%items)
      end do
      do k = 1, n_clearance_kinds()
         call look(scene%clearances(k)%items)
      end do
      call look(scene%tables%requests(table_motions)%items)
      call look(scene%tables%requests(table_reactions)%items)
      associate (points => scene%tables%base(table_points)%items)
         do k = 1, size(points)
            if (points(k)%name == "none" .or. is_state(points(k))) call report_reserved(points(k))
         end do
      end associate

   contains

      !> Check the names of a table against all earlier ones.
      subroutine look(items)
         type(item_t), intent(in) :: items(:)  !! rows

         integer :: i

         call report_doubled(items, names, diagnostics)
         do i = 1, size(items)
            if (index(reserved, " "//items(i)%name//" ") > 0 .or. is_state(items(i))) call report_reserved(items(i))
         end do
         call add_names(items, names)
      end subroutine look

      !> Whether an item has the name that is that of the state equations, where there are some.
      pure logical function is_state(item)
         type(item_t), intent(in) :: item  !! the row

         is_state = item%name == "state" .and. scene%states%n > 0
      end function is_state

      !> A reserved word was taken as a name.
      subroutine report_reserved(item)
         type(item_t), intent(in) :: item  !! the row

         call diagnostics%add(item%location, "name '"//item%name//"' is reserved", "choose another name", &
                              "reserved:"//reserved)
      end subroutine report_reserved

   end subroutine check_names

   !> What rows of tables cannot say of themselves: joints of a body with itself, journals that do not fit.
   subroutine check_meaning(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck; lengths of the start are noted as defaults
      type(scene_t), intent(in) :: scene                  !! the scene
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      class(clearance_set_t), allocatable :: set
      class(force_set_t), allocatable :: forces
      character(:), allocatable :: help, message
      integer :: column, i, k

      do k = 1, n_joint_kinds()
         do i = 1, size(scene%joints(k)%items)
            call check_pair(scene%joints(k)%info, scene%joints(k)%items(i))
            call check_start_length(scene%joints(k)%info, scene%joints(k)%items(i))
            call check_references(scene%joints(k)%info, scene%joints(k)%items(i))
            call check_friction(scene%joints(k)%info, scene%joints(k)%items(i))
            if (scene%joints(k)%info%couples_joints) call check_coupler(scene, scene%joints(k)%info, scene%joints(k)%items(i), &
                                                                        diagnostics)
         end do
      end do
      do k = 1, n_force_kinds()
         call new_force_set(k, forces)
         do i = 1, size(scene%forces(k)%items)
            call check_force(scene%forces(k)%info, scene%forces(k)%items(i))
         end do
      end do
      do k = 1, n_clearance_kinds()
         call new_clearance_set(k, set)
         do i = 1, size(scene%clearances(k)%items)
            call check_pair(scene%clearances(k)%info, scene%clearances(k)%items(i))
            associate (item => scene%clearances(k)%items(i))
               call set%mistake(item, column, message, help)
               if (column == 0) call check_limits(scene%clearances(k)%info, item, column, message, help)
               if (column == 0) call check_law(scene, scene%clearances(k)%info, item, set, column, message, help)
               if (column == 0) cycle
               call diagnostics%add(item%values(column)%location, message, "does not match", help)
            end associate
         end do
      end do

   contains

      !> The two points of a joint or spring must belong to different bodies, and two bodies must differ.
      subroutine check_pair(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         character(:), allocatable :: group, name
         type(tie_t) :: tie

         tie = tie_of(scene, info, item)
         if (tie%n < 2 .or. tie%body(1) /= tie%body(2)) return
         name = "ground"
         if (tie%body(1) > 0) name = scene%bodies%names(tie%body(1))%s
         group = "joint"
         if (index(info%name, "force.") == 1) group = "force"
         call diagnostics%add(item%values(tie%column(2))%location, group//" '"//item%name//"' connects '"//name//"' to itself", &
                              "the same body", "columns "//info%columns(tie%column(1))%name//" and "// &
                              info%columns(tie%column(2))%name//" must name two different bodies, or points of them")
      end subroutine check_pair

      !> A row of a force element.
      subroutine check_force(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         call check_pair(info, item)
         call check_start_axes(info, item)
         call check_references(info, item)
         call check_start_length(info, item)
         call forces%mistake(item, column, message, help)
         if (column > 0) call diagnostics%add(item%values(column)%location, message, "does not match", help)
      end subroutine check_force

      !> The two axes of a torsional spring, which some joint holds parallel, must be so at the start, or nearly.
      subroutine check_start_axes(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         real(wp), parameter :: minimum = 0.5_wp  ! cosine of the angle between axes that count as parallel [1]
         type(tie_t) :: tie
         integer :: c

         c = find_column(info, "axis_j")
         if (c == 0) return
         if (.not. item%values(c)%given .or. .not. any(abs(item%direction("axis_i")) > 0.0_wp)) return
         tie = tie_of(scene, info, item)
         if (dot_product(start_direction(scene, tie%body(1), item%direction("axis_i")), &
                         start_direction(scene, tie%body(2), item%direction("axis_j"))) > minimum) return
         call diagnostics%add(item%values(c)%location, "the axes of '"//item%name//"' are not parallel", &
                              "differs in direction from axis_i at the given positions", &
                              "omit axis_j, or rotate one of the bodies")
      end subroutine check_start_axes

      !> Reference directions of an angle may not lie along the axis.
      subroutine check_references(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         real(wp), parameter :: minimum = 1.0e-6_wp  ! sine of an angle that is none [1]
         character(6), parameter :: axis(2) = ["axis_i", "axis_j"]
         character(3), parameter :: reference(2, 2) = reshape(["x_i", "x_j", "y_i", "y_j"], [2, 2])
         type(tie_t) :: tie
         real(wp) :: x(3), z(3)
         integer :: c, set, side

         set = merge(1, 2, find_column(info, "x_i") > 0)
         if (find_column(info, reference(1, set)) == 0) return
         tie = tie_of(scene, info, item)
         do side = 1, 2
            c = column_of(info, reference(side, set))
            if (.not. item%values(c)%given) cycle
            z = item%direction("axis_i")
            if (any(abs(z) > 0.0_wp)) then
               z = start_direction(scene, tie%body(1), z)
            else   ! along the line of the points
               z = start_position(scene, tie%point(2)) - start_position(scene, tie%point(1))
               z = z/max(norm2(z), tiny(1.0_wp))
            end if
            if (item%is_given(axis(side))) z = start_direction(scene, tie%body(side), item%direction(axis(side)))
            x = start_direction(scene, tie%body(side), item%direction(reference(side, set)))
            if (1.0_wp - dot_product(x, z)**2 > minimum**2) cycle
            call diagnostics%add(item%values(c)%location, "the reference direction of '"//item%name//"' is parallel to its axis", &
                                 "its component normal to the axis is zero", "give a direction across the axis, or omit the column")
         end do
      end subroutine check_references

      !> A length that is omitted is the distance of the points at the start, which must not coincide.
      subroutine check_start_length(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         real(wp), parameter :: minimum = 1.0e-9_wp  ! distance that counts as none, of the points' coordinates [1]
         type(tie_t) :: tie
         real(wp) :: length, p(3, 2)
         integer :: c, end

         c = find_column(info, "length")
         if (c == 0) return
         if (item%values(c)%given) return
         tie = tie_of(scene, info, item)
         do end = 1, 2
            p(:, end) = start_position(scene, tie%point(end))
         end do
         length = norm2(p(:, 2) - p(:, 1))
         if (length > minimum*maxval(abs(p))) then
            call add_default(deck, info%name//" "//item%name//" length = "//to_text(length)//" m, the initial distance")
            return
         end if
         call diagnostics%add(item%values(tie%column(2))%location, "'"//item%name//"' has zero length", &
                              "the two points coincide initially", "set the column length, or move the bodies")
      end subroutine check_start_length

      !> Numbers of any dimension in a row that is tied by a joint are angles if the joint turns, lengths if it slides; either if it
      !> does both.
      subroutine check_limits(info, item, column, message, help)
         type(kind_info_t), intent(in) :: info                  !! the kind
         type(item_t), intent(in) :: item                       !! the row
         integer, intent(inout) :: column                       !! column at fault, 0: all is well
         character(:), allocatable, intent(inout) :: message    !! what is wrong
         character(:), allocatable, intent(inout) :: help       !! what would be right

         type(dim_t) :: wanted
         type(tie_t) :: tie
         integer :: c, kind, row

         tie = tie_of(scene, info, item)
         if (.not. tie%by_joint .or. info%couples_joints) return
         call find_joint(scene, tie%joint(1), kind, row)
         if (.not. any(scene%joints(kind)%info%free == [free_rotation, free_translation])) return
         wanted = dim_length
         if (scene%joints(kind)%info%free == free_rotation) wanted = dim_angle
         do c = 1, size(info%columns)
            if (.not. (info%columns(c)%is_any .and. item%values(c)%given)) cycle
            if (same_dimension(item%values(c)%dimensions(1), wanted)) cycle
            column = c
            message = "'"//item%name//"' acts on '"//scene%joints(kind)%items(row)%name//"', a "//scene%joints(kind)%info%name
            help = "column "//info%columns(c)%name//" is a length there"
            if (scene%joints(kind)%info%free == free_rotation) help = "column "//info%columns(c)%name//" is an angle there"
            return
         end do
      end subroutine check_limits

      !> Friction in an ideal joint needs a law that gives a force at any motion, and a pin with a radius.
      subroutine check_friction(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         integer :: law

         law = cell_index(info, item, "friction")
         if (law == 0) return
         if (scene%frictions(law)%law%memory == memory_slip) then
            call diagnostics%add(item%values(column_of(info, "friction"))%location, "friction law '"//item%word("friction")// &
                                 "' needs stick-slip events, which ideal joints do not support", "invalid for an ideal joint", &
                                 "use a smooth law, or friction.dahl or friction.lugre, which stick by bristles")
         end if
         if (find_column(info, "radius") == 0) return
         if (item%number("radius") > 0.0_wp) return
         call diagnostics%add(item%values(column_of(info, "friction"))%location, "joint '"//item%name//"' has friction but no "// &
            "radius", &
                              "this law needs the column radius", "give the radius of the pin")
      end subroutine check_friction

   end subroutine check_meaning

end module scene_checks
