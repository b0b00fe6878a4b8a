!> Surfaces that a deck gives as worn at the start: rows of tables become the worn volumes of the scene.
module read_worn
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use columns, only: cell_index, column_of, find_column
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use item, only: item_t, location_of, location_t
   use joint_level, only: level_hybrid, level_lubricated, level_of
   use kind_info, only: kind_info_t
   use kind_list, only: worn_info
   use kinds, only: wp
   use references, only: add_names
   use scene, only: scene_t
   use surfaces, only: surfaces_t
   use tables, only: read_items
   use text, only: join, text_t, to_text
   use wear_law, only: of_bearing, side_names
   use worn_kind, only: worn_kind_t, worn_mistake_t
   use worn_registry, only: n_worn_kinds, new_worn_kind
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: find_worn_mistake, make_worn_surfaces, worn_from_deck

   integer, parameter :: usual_cells = 360   !! of a circumference without a wear law

contains

   !> Read the tables.
   subroutine worn_from_deck(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! tables are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      do k = 1, n_worn_kinds()
         scene%tables%worn(k)%info => worn_info(k)
         call read_items(deck, scene%tables%worn(k)%info, scene%tables%worn(k)%items, diagnostics)
      end do
   end subroutine worn_from_deck

   !> The surfaces of all rows, each once.
   subroutine make_worn_surfaces(scene, diagnostics)
      type(scene_t), intent(inout) :: scene               !! tables, laws and materials are there; worn surfaces are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      class(worn_kind_t), allocatable :: kind
      type(location_t), allocatable :: places(:)
      type(worn_surface_t), allocatable :: list(:)
      integer :: i, k, m, n

      if (allocated(scene%worn)) deallocate (scene%worn)
      allocate (scene%worn(0), places(0))
      do k = 1, n_worn_kinds()
         call new_worn_kind(k, kind)
         associate (info => scene%tables%worn(k)%info, items => scene%tables%worn(k)%items)
            do i = 1, size(items)
               call kind%surfaces(items(i), list)
               if (size(list) == 0) call diagnostics%add(items(i)%location, "'"//items(i)%name//"' of "//info%name// &
                                                         " gives no surface", "the run did not wear what this row asks for")
               do m = 1, size(list)
                  n = diagnostics%count()
                  call make_surface(scene, kind, info, items(i), list(m), diagnostics)
                  if (diagnostics%count() == n) call check_twice(scene%worn, places, items(i), list(m), diagnostics)
                  if (diagnostics%count() > n) exit
                  scene%worn = [scene%worn, list(m)]
                  places = [places, items(i)%location]
               end do
            end do
         end associate
      end do
   end subroutine make_worn_surfaces

   !> A surface of a row.
   subroutine make_surface(scene, kind, info, item, surface, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      class(worn_kind_t), intent(in) :: kind              !! of the row
      type(kind_info_t), intent(in) :: info               !! its columns
      type(item_t), intent(inout) :: item                 !! the row
      type(worn_surface_t), intent(inout) :: surface      !! joint and side; its volumes are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      class(clearance_set_t), allocatable :: set
      type(location_t) :: at
      type(surfaces_t) :: pair
      type(worn_mistake_t), allocatable :: mistake
      real(wp) :: other_radius
      character(:), allocatable :: help, mark, message
      integer :: cells, geometry, law, row

      at = item%values(column_of(info, "joint"))%location
      call find_row(scene, surface%joint, geometry, row)
      if (row == 0) then
         call diagnostics%add(at, "the earlier run wore '"//surface%joint//"', which is no joint with clearance of this deck", &
                              "", "name the joint that is taken in column joint; joints with clearance: "//names_of(scene))
         return
      end if
      associate (joint => scene%clearances(geometry)%items(row), joint_info => scene%clearances(geometry)%info)
         if (find_column(joint_info, "wear") == 0) then
            call diagnostics%add(at, "joint '"//joint%name//"' is a "//joint_info%name//", whose surfaces cannot be worn", &
                                 "not worn yet", "surfaces of clearance.revolute in the plane can be worn")
            return
         end if
         call new_clearance_set(geometry, set)
         call set%describe(joint, scene%materials, pair)
         if (.not. pair%length > 0.0_wp) then
            call diagnostics%add(at, "joint '"//joint%name//"' is worn but has no length", "without a length", &
                                 "a worn volume is area times length: give the length of the joint along its axis")
            return
         end if
         call find_worn_mistake(joint, message, mark, help)
         if (message /= "") then
            call diagnostics%add(at, message, mark, help)
            return
         end if
         law = cell_index(joint_info, joint, "wear")
      end associate
      cells = usual_cells
      if (law > 0) cells = nint(scene%wears(law)%law%cells)
      surface%is_hole = surface%side == trim(side_names(of_bearing))
      surface%radius = merge(pair%radius_i, pair%radius_j, surface%is_hole)
      surface%length = pair%length
      other_radius = merge(pair%radius_j, pair%radius_i, surface%is_hole)
      call kind%fill(item, cells, other_radius, surface, mistake)
      if (.not. allocated(mistake)) return
      at = item%values(column_of(info, mistake%column))%location
      if (mistake%place > 0) at = location_of(item%values(column_of(info, mistake%column)), mistake%place)
      call diagnostics%add(at, "'"//item%name//"' of "//info%name//" is invalid", mistake%message, mistake%help)
   end subroutine make_surface

   !> A surface has one profile.
   subroutine check_twice(worn, places, item, surface, diagnostics)
      type(worn_surface_t), intent(in) :: worn(:)         !! (n) surfaces so far
      type(location_t), intent(in) :: places(:)           !! (n) where they stand
      type(item_t), intent(in) :: item                    !! the row
      type(worn_surface_t), intent(in) :: surface         !! its surface
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      do k = 1, size(worn)
         if (worn(k)%joint /= surface%joint .or. worn(k)%side /= surface%side) cycle
         call diagnostics%add(item%location, "the "//surface%side//" of '"//surface%joint//"' is worn twice", &
                              "already given", "first in line "//to_text(places(k)%line)//"; a surface has one profile")
      end do
   end subroutine check_twice

   !> The row of a joint with clearance.
   subroutine find_row(scene, joint, geometry, row)
      type(scene_t), intent(in) :: scene        !! the scene
      character(*), intent(in) :: joint         !! its name
      integer, intent(out) :: geometry          !! number of its kind
      integer, intent(out) :: row               !! in the table of the kind; 0: not found

      integer :: k

      row = 0
      do geometry = 1, n_clearance_kinds()
         associate (items => scene%clearances(geometry)%items)
            row = findloc([(items(k)%name == joint, k=1, size(items))], .true., dim=1)
         end associate
         if (row > 0) return
      end do
   end subroutine find_row

   !> Names of all joints with clearance.
   function names_of(scene) result(words)
      type(scene_t), intent(in) :: scene       !! the scene
      character(:), allocatable :: words       !! with blanks between

      type(text_t), allocatable :: names(:)
      integer :: k

      allocate (names(0))
      do k = 1, n_clearance_kinds()
         call add_names(scene%clearances(k)%items, names)
      end do
      words = join(names, " ")
   end function names_of

   !> Why the contact of a joint with clearance cannot be one of worn surfaces.
   subroutine find_worn_mistake(joint, message, mark, help)
      type(item_t), intent(in) :: joint                      !! its row
      character(:), allocatable, intent(out) :: message      !! what is wrong; blank: nothing
      character(:), allocatable, intent(out) :: mark         !! the same in some words
      character(:), allocatable, intent(out) :: help         !! what to do

      message = ""
      mark = ""
      help = ""
      if (any(level_of(joint) == [level_lubricated, level_hybrid])) then
         message = "joint '"//joint%name//"' with level = "//joint%word("level")//" is worn"
         mark = "with a film"
         help = "films are those of round surfaces: use level = clearance"
      else if (joint%word("form") == "book") then
         message = "joint '"//joint%name//"' with form = book is worn"
         mark = "with form = book"
         help = "Flores et al. (2008) have no worn surfaces: use form = corrected"
      end if
   end subroutine find_worn_mistake

end module read_worn
