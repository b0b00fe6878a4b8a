!> Joints with clearance of a scene: sorted into sets that share geometry and laws; those that are ideal become ideal joints.
!>
!> Rows that say `level = ideal`, or all of them in the reference run with ideal joints, become the joint that their geometry is
!> without clearance; a geometry that is none keeps its contact.
module build_clearances
   use bearing_films, only: bearing_films_t, new_bearing_films
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t, clearance_slot_t
   use columns, only: cell_index, cell_text
   use friction_law, only: friction_law_t
   use item, only: item_t, take_items
   use joint_level, only: level_hybrid, level_ideal, level_lubricated, level_of
   use joint_registry, only: new_joint_set
   use joint_set, only: joint_set_t, joint_slot_t
   use kind_info, only: in_space, kind_info_t
   use kinds, only: wp
   use law_absent, only: law_absent_t
   use law_faded, only: law_faded_t, new_law_faded
   use law_part, only: law_part_t, new_law_part
   use mechanism, only: mechanism_t
   use motion, only: motion_t
   use normal_law, only: normal_law_t
   use scene, only: scene_t
   use socket_films, only: socket_films_t
   use ties, only: find_joint, kind_number, tie_of, tie_set, tie_t
   use wear_law, only: of_bearing, side_names, wear_law_t
   use surface_profile, only: new_profile
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: add_clearances, has_ideal, is_ideal, levels_as_written, levels_ideal, levels_clearance_joints

   integer, parameter :: levels_as_written = 0  !! every joint with clearance as its row says
   integer, parameter :: levels_ideal = 1       !! every one ideal: the reference run with ideal joints
   integer, parameter :: levels_clearance_joints = 2       !! all with clearance: all that a deck can have words for

contains

   !> Joints with clearance: sets that share geometry and laws, and sets of those that are ideal, one per type of joint.
   subroutine add_clearances(scene, levels, angle, is_driven, system)
      type(scene_t), intent(in) :: scene              !! the scene
      integer, intent(in) :: levels                   !! how they are taken, one of the above
      real(wp), intent(in) :: angle(0:)               !! (0:bodies) angles at the start [rad]
      logical, intent(in) :: is_driven(:)             !! (bodies) whether drivers alone say how they move
      type(mechanism_t), intent(inout) :: system  !! clearances and ideal joints are set

      type(clearance_slot_t), allocatable :: slots(:)
      type(joint_slot_t) :: twins(n_clearance_kinds())
      logical, allocatable :: is_done(:), is_twin(:)
      type(item_t), allocatable :: some(:)
      integer, allocatable :: chosen(:)
      integer :: first, i, k, n, n_ideal

      allocate (slots(count_clearances(scene)))
      n = 0
      n_ideal = 0
      do k = 1, n_clearance_kinds()
         associate (items => scene%clearances(k)%items, info => scene%clearances(k)%info)
            is_twin = is_ideal(items, levels)
            is_done = is_twin
            do first = 1, size(items)
               if (is_done(first)) cycle
               chosen = pack([(i, i=1, size(items))], &
                             [(.not. is_done(i) .and. share_laws(info, items(i), items(first)), i=1, size(items))])
               is_done(chosen) = .true.
               n = n + 1
               call take_items(items, chosen, some)
               call add_clearance_set(scene, k, some, is_driven, slots(n), system)
               if (allocated(scene%worn)) call take_worn(scene%worn, slots(n)%set)
            end do
            if (any(is_twin)) then
               chosen = pack([(i, i=1, size(items))], is_twin)
               n_ideal = n_ideal + 1
               call take_items(items, chosen, some)
               call add_ideal_set(scene, k, some, angle, system%linkage%motion, twins(n_ideal), system%linkage%rows%n)
            end if
         end associate
      end do
      allocate (system%clearance_joints%sets(n), system%linkage%ideal(n_ideal))
      system%clearance_joints%n_set = n
      do k = 1, n
         call move_alloc(slots(k)%set, system%clearance_joints%sets(k)%set)
      end do
      do k = 1, n_ideal
         call move_alloc(twins(k)%set, system%linkage%ideal(k)%set)
      end do
   end subroutine add_clearances

   !> Whether two rows name the same laws.
   logical function share_laws(info, item, other)
      type(kind_info_t), intent(in) :: info       !! the geometry
      type(item_t), intent(in) :: item, other     !! the rows

      integer :: c

      share_laws = .true.
      do c = 1, size(info%columns)
         select case (info%columns(c)%name)
         case ("law", "face_law", "friction", "wear", "film")
            share_laws = share_laws .and. item%values(c)%index == other%values(c)%index
         case ("level", "stiffness")
            share_laws = share_laws .and. item%values(c)%text == other%values(c)%text
         case ("e_t0")
            share_laws = share_laws .and. .not. abs(item%values(c)%number - other%values(c)%number) > 0.0_wp
         end select
      end do
   end function share_laws

   !> Whether a row becomes an ideal joint.
   elemental logical function is_ideal(item, levels)
      type(item_t), intent(in) :: item    !! the row
      integer, intent(in) :: levels       !! how joints with clearance are taken

      is_ideal = (levels == levels_as_written .and. level_of(item) == level_ideal) .or. &
                 (levels == levels_ideal .and. level_of(item) > 0)
   end function is_ideal

   !> Whether any row becomes an ideal joint.
   logical function has_ideal(scene, levels)
      type(scene_t), intent(in) :: scene  !! the scene
      integer, intent(in) :: levels       !! how joints with clearance are taken

      integer :: k

      has_ideal = any([(any(is_ideal(scene%clearances(k)%items, levels)), k=1, n_clearance_kinds())])
   end function has_ideal

   !> Rows of a geometry as the joint that it is without clearance.
   subroutine add_ideal_set(scene, kind, items, angle, motion, slot, n_row)
      type(scene_t), intent(in) :: scene         !! the scene
      integer, intent(in) :: kind                !! number of the geometry
      type(item_t), intent(in) :: items(:)       !! the rows
      real(wp), intent(in) :: angle(0:)          !! (0:bodies) angles at the start [rad]
      type(motion_t), intent(in) :: motion       !! bodies where the deck puts them
      type(joint_slot_t), intent(inout) :: slot  !! the set is made here
      integer, intent(inout) :: n_row            !! constraint rows so far

      class(clearance_set_t), allocatable :: geometry

      call new_clearance_set(kind, geometry)
      call new_joint_set(kind_number(scene, geometry%ideal_kind()), slot%set)
      associate (set => slot%set)
         call tie_set(scene, scene%clearances(kind)%info, items, set)
         call set%prepare(items, angle)
         call set%set_start(motion)
         set%first_row = n_row
         n_row = n_row + set%n*set%n_row_item
      end associate
   end subroutine add_ideal_set

   !> Number of rows of all clearance tables.
   pure integer function count_clearances(scene) result(n)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: k

      n = 0
      do k = 1, n_clearance_kinds()
         n = n + size(scene%clearances(k)%items)
      end do
   end function count_clearances

   !> One set of clearance joints with its laws, fitted to the surfaces.
   subroutine add_clearance_set(scene, kind, items, is_driven, slot, system)
      type(scene_t), intent(in) :: scene              !! the scene
      integer, intent(in) :: kind                     !! number of the geometry
      type(item_t), intent(in) :: items(:)            !! rows that share their laws
      logical, intent(in) :: is_driven(:)             !! (bodies) whether drivers alone say how they move
      type(clearance_slot_t), intent(inout) :: slot   !! the set is made here
      type(mechanism_t), intent(inout) :: system  !! joints and contacts are counted

      class(friction_law_t), allocatable :: friction
      class(normal_law_t), allocatable :: law
      type(joint_slot_t), allocatable :: joints(:)
      type(tie_t), allocatable :: ties(:)
      integer :: face_law, film, friction_law, i

      call new_clearance_set(kind, slot%set)
      call choose_law(scene, scene%clearances(kind)%info, items(1), law)
      friction_law = cell_index(scene%clearances(kind)%info, items(1), "friction")
      if (level_of(items(1)) == level_lubricated) friction_law = 0  ! nothing touches
      face_law = cell_index(scene%clearances(kind)%info, items(1), "face_law")
      if (friction_law > 0) allocate (friction, source=scene%frictions(friction_law)%law)
      ties = [(tie_of(scene, scene%clearances(kind)%info, items(i)), i=1, size(items))]
      call slot%set%new(items, ties%point(1), ties%point(2), scene%points, law, friction)
      call slot%set%take_surfaces(items, scene%materials, scene%bodies%mass, is_driven)
      if (face_law > 0) allocate (slot%set%laws%face, source=scene%laws(face_law)%law)
      call choose_wear(scene, scene%clearances(kind)%info, items(1), slot%set%laws%wear)
      slot%set%items%free = [(0, i=1, size(items))]
      allocate (slot%set%items%slide_axis(2, size(items)), source=0.0_wp)
      allocate (joints(size(items)))
      do i = 1, size(items)
         if (.not. ties(i)%by_joint) cycle
         call make_joint(scene, ties(i)%joint(1), system%linkage%motion, joints(i)%set, slot%set%items%free(i))
         slot%set%items%slide_axis(:, i) = joints(i)%set%slide_axis_of(1)
      end do
      slot%set%before%items = system%clearance_joints%n
      slot%set%before%contacts = system%clearance_joints%n_contact
      system%clearance_joints%n = system%clearance_joints%n + slot%set%n
      system%clearance_joints%n_contact = system%clearance_joints%n_contact + slot%set%n_contact
      film = cell_index(scene%clearances(kind)%info, items(1), "film")
      if (film > 0) then
         if (scene%clearances(kind)%info%space == in_space) then
            allocate (socket_films_t :: slot%set%laws%films)
         else
            allocate (bearing_films_t :: slot%set%laws%films)
         end if
         call new_bearing_films(items, scene%lubrication%films(film)%law, scene%lubrication%oils, slot%set%laws%films)
         system%clearance_joints%has_films = system%clearance_joints%has_films .or. slot%set%laws%films%acts
      end if
      call slot%set%prepare(items)
      if (film > 0) then
         if (slot%set%laws%films%acts) system%clearance_joints%film_clearance = min(system%clearance_joints%film_clearance, &
                                                                         minval(slot%set%items%pairs%clearance))
      end if
      do i = 1, size(items)
         if (ties(i)%by_joint) call slot%set%take_joint(i, joints(i)%set)
      end do
      call slot%set%set_start(system%linkage%motion)
      do i = 1, size(items)
         call slot%set%fit(i)
      end do
   end subroutine add_clearance_set

   !> The normal law of a row: none where a film alone holds the surfaces apart, or the row names none; half of one at each of two
   !> bases that carry together; one that comes in by degrees where a film goes out by degrees.
   subroutine choose_law(scene, info, item, law)
      type(scene_t), intent(in) :: scene                     !! the scene
      type(kind_info_t), intent(in) :: info                  !! the geometry
      type(item_t), intent(in) :: item                       !! the row
      class(normal_law_t), allocatable, intent(out) :: law   !! its law

      class(normal_law_t), allocatable :: whole
      type(law_faded_t), allocatable :: faded
      type(law_part_t), allocatable :: part
      integer :: number

      number = cell_index(info, item, "law")
      if (level_of(item) == level_lubricated) number = 0
      if (number == 0) then
         allocate (law_absent_t :: law)
         law%name = "none"
         return
      end if
      allocate (law, source=scene%laws(number)%law)
      if (cell_text(info, item, "stiffness") == "half") then
         allocate (part)
         call new_law_part(law, 0.5_wp, part)
         call move_alloc(part, law)
      end if
      if (level_of(item) /= level_hybrid) return
      if (.not. item%number("e_t0") > 0.0_wp) return
      call move_alloc(law, whole)
      allocate (faded)
      call new_law_faded(whole, item%number("e_t0"), faded)
      call move_alloc(faded, law)
   end subroutine choose_law

   !> The wear law of a row, if it names one.
   subroutine choose_wear(scene, info, item, law)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(kind_info_t), intent(in) :: info                 !! the geometry
      type(item_t), intent(in) :: item                      !! the row
      class(wear_law_t), allocatable, intent(out) :: law    !! its law; unallocated: none

      integer :: number

      number = cell_index(info, item, "wear")
      if (number > 0) allocate (law, source=scene%wears(number)%law)
   end subroutine choose_wear

   !> Profiles of the surfaces that are worn at the start.
   subroutine take_worn(worn, set)
      type(worn_surface_t), intent(in) :: worn(:)           !! (any) surfaces, of any joints
      class(clearance_set_t), intent(inout) :: set          !! the set, its surfaces taken

      real(wp), allocatable :: hole(:)
      integer :: i, k

      do k = 1, set%n
         associate (pair => set%items%pairs(k))
            if (allocated(hole)) deallocate (hole)
            do i = 1, size(worn)
               if (worn(i)%joint /= set%names(k)%s) cycle
               if (.not. allocated(pair%worn)) allocate (pair%worn)
               pair%worn%distance = max(pair%worn%distance, worn(i)%distance)
               if (worn(i)%side == side_names(of_bearing)) then
                  hole = worn(i)%volume
               else if (any(worn(i)%volume > 0.0_wp)) then
                  call new_profile(pair%worn%pin, .false., pair%radius_j, pair%length, worn(i)%volume)
               end if
               if (.not. allocated(hole)) hole = 0.0_wp*worn(i)%volume  ! `surface_overlap` goes by the intervals of the hole
            end do
            if (.not. allocated(pair%worn)) cycle
            set%traits%is_worn = .true.
            call new_profile(pair%worn%hole, .true., pair%radius_i, pair%length, hole)
         end associate
      end do
   end subroutine take_worn

   !> A joint that a row names, by itself.
   subroutine make_joint(scene, number, motion, set, free)
      type(scene_t), intent(in) :: scene                    !! the scene
      integer, intent(in) :: number                         !! the joint, among all joints
      type(motion_t), intent(in) :: motion                  !! bodies where the deck puts them
      class(joint_set_t), allocatable, intent(out) :: set   !! a set of one item, with its start
      integer, intent(out) :: free                        !! what of the freedom of its bodies its kind says

      real(wp) :: angle(0:scene%bodies%n)
      integer :: kind, row

      call find_joint(scene, number, kind, row)
      call new_joint_set(kind, set)
      associate (table => scene%joints(kind))
         free = table%info%free
         call tie_set(scene, table%info, table%items(row:row), set)
         angle(0) = 0.0_wp
         angle(1:) = scene%bodies%angle
         call set%prepare(table%items(row:row), angle)
      end associate
      call set%set_start(motion)
   end subroutine make_joint

end module build_clearances
