!> Groups of bodies that nothing joins, as systems of their own: each is integrated with its own steps, so that what happens to one
!> costs the others nothing.
module subsystems
   use build_system, only: new_system
   use output_times, only: output_times_t, new_output_times
   use integrator, only: integrator_t
   use integrator_registry, only: find_integrator
   use force_registry, only: n_force_kinds
   use joint_registry, only: n_joint_kinds
   use item, only: place_of
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use name_table, only: name_table_t
   use scene, only: scene_t
   use scene_groups, only: begin_group_scene, find_groups, groups_t, sees_motion, set_group_scene
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: grouping_words, new_subsystems, subsystem_t

   !> A group of bodies, and where its parts are in the whole.
   type :: subsystem_t
      type(mechanism_t) :: system                       !! its equations
      class(integrator_t), allocatable :: method        !! its integrator, not started
      type(output_times_t) :: output_times                      !! when its functions of time are not smooth
      integer, allocatable :: body(:)                   !! (bodies) numbers in the whole
      integer, allocatable :: slot(:)                   !! (contacts) sets of the whole
      integer, allocatable :: contact(:)                !! (contacts) contacts of these sets
      integer, allocatable :: rubbing(:)                !! (joints with friction) their numbers among those of the whole
   end type subsystem_t

contains

   !> The subsystems of a scene; none if all of it is one, or must be integrated as one.
   subroutine new_subsystems(scene, levels, system, method, end, subsystems)
      type(scene_t), intent(in) :: scene                               !! the scene
      integer, intent(in) :: levels                                    !! of joints with clearance, as of `system`
      type(mechanism_t), intent(in) :: system                          !! the whole, with its start
      class(integrator_t), intent(in) :: method                        !! the integrator, not started
      real(wp), intent(in) :: end                                      !! end of the motion [s]
      type(subsystem_t), allocatable, intent(out) :: subsystems(:)     !! (groups or 0) the groups apart

      type(groups_t) :: groups
      type(scene_t) :: one
      type(name_table_t) :: rubbing, table
      integer, allocatable :: item(:), slot(:)
      integer :: g

      if (reason_to_stay(scene) == "" .and. size(system%linkage%solution%set_aside) == 0) call find_groups(scene, groups)
      if (groups%n <= 1) then
         allocate (subsystems(0))
         return
      end if
      allocate (subsystems(groups%n))
      call list_clearance_joints(system, table, slot, item)
      call rubbing%list(rubbing_names(system))
      call begin_group_scene(scene, one)
      do g = 1, groups%n
         call set_group_scene(scene, groups, g, one)
         associate (subsystem => subsystems(g))
            subsystem%body = groups%bodies_of(g)
            call new_system(one, levels, subsystem%system)
            subsystem%system%linkage%solution%is_redundant = system%linkage%solution%is_redundant
            call subsystem%system%linkage%solution%take_min_pivot(system%linkage%solution%min_pivot)
            call find_contacts(system, table, slot, item, subsystem)
            subsystem%rubbing = numbers_of(rubbing_names(subsystem%system), rubbing)
            call find_integrator(scene%settings%integration%method, subsystem%method)
            subsystem%method%controls = method%controls
            call new_output_times(one, end, subsystem%system%clearance_joints%n > 0, subsystem%output_times)
         end associate
      end do
   end subroutine new_subsystems

   !> Why a scene is integrated as one whatever its groups are; blank if it need not.
   function reason_to_stay(scene) result(reason)
      type(scene_t), intent(in) :: scene      !! the scene
      character(:), allocatable :: reason     !! as text

      integer :: k

      reason = ""
      associate (settings => scene%settings%integration, guards => scene%settings%guards)
         if (.not. settings%is_apart) then
            reason = "groups = together"
         else if (size(guards%values(place_of(guards, "stop"))%conditions) > 0) then
            reason = "a stop condition applies to all of them"
         else if (settings%controls%maximum_steps > 0 .or. settings%controls%maximum_evaluations > 0) then
            reason = "a limit applies to the sum of their steps or evaluations"
         else if (any([(scene%forces(k)%info%counts_turns .and. size(scene%forces(k)%items) > 0, k=1, n_force_kinds())]) .or. &
                  any([(scene%joints(k)%info%counts_turns .and. size(scene%joints(k)%items) > 0, k=1, n_joint_kinds())])) then
            reason = "accumulated angles need common steps"
         else if (sees_motion(scene)) then
            reason = "loads depend on the motion"
         end if
      end associate
   end function reason_to_stay

   !> How the bodies of a scene are integrated, blank if they are one group.
   function grouping_words(scene) result(words)
      type(scene_t), intent(in) :: scene      !! the scene
      character(:), allocatable :: words      !! as in `3 groups of bodies that nothing joins, integrated apart`

      type(groups_t) :: groups
      character(:), allocatable :: reason

      words = ""
      call find_groups(scene, groups)
      if (groups%n <= 1) return
      reason = reason_to_stay(scene)
      words = to_text(groups%n)//" independent groups of bodies, integrated separately"
      if (reason /= "") words = to_text(groups%n)//" independent groups of bodies, integrated together ("//reason//")"
   end function grouping_words

   !> The clearance joints of the whole, by name.
   subroutine list_clearance_joints(system, table, slot, item)
      type(mechanism_t), intent(in) :: system            !! the whole
      type(name_table_t), intent(out) :: table           !! their names
      integer, allocatable, intent(out) :: slot(:)       !! (clearance joints) set of each
      integer, allocatable, intent(out) :: item(:)       !! (clearance joints) its number there

      type(text_t), allocatable :: names(:)
      integer :: i, k, n

      allocate (names(system%clearance_joints%n), slot(system%clearance_joints%n), item(system%clearance_joints%n))
      n = 0
      do k = 1, size(system%clearance_joints%sets)
         do i = 1, system%clearance_joints%sets(k)%set%n
            n = n + 1
            names(n)%s = system%clearance_joints%sets(k)%set%names(i)%s
            slot(n) = k
            item(n) = i
         end do
      end do
      call table%list(names)
   end subroutine list_clearance_joints

   !> The ideal joints with friction, by name.
   function rubbing_names(system) result(names)
      type(mechanism_t), intent(in) :: system    !! a system
      type(text_t), allocatable :: names(:)      !! (joints with friction) in the order of its list

      integer :: k

      allocate (names(system%friction%rubbing%n))
      do k = 1, size(names)
         associate (set => system%linkage%joints(system%friction%rubbing%slot(k))%set)
            names(k)%s = set%names(set%friction%item(system%friction%rubbing%place(k)))%s
         end associate
      end do
   end function rubbing_names

   !> Numbers of names in a table.
   pure function numbers_of(names, table) result(numbers)
      type(text_t), intent(in) :: names(:)         !! (n) names, all in the table
      type(name_table_t), intent(in) :: table      !! the table
      integer, allocatable :: numbers(:)           !! (n) their numbers

      integer :: k

      allocate (numbers(size(names)))
      do k = 1, size(names)
         numbers(k) = table%find(names(k)%s)
      end do
   end function numbers_of

   !> Where the contacts of a subsystem are in the whole; what they remember is taken over.
   subroutine find_contacts(system, table, slot, item, subsystem)
      type(mechanism_t), intent(in) :: system            !! the whole
      type(name_table_t), intent(in) :: table            !! names of its clearance joints
      integer, intent(in) :: slot(:)                     !! (clearance joints) set of each
      integer, intent(in) :: item(:)                     !! (clearance joints) its number there
      type(subsystem_t), intent(inout) :: subsystem      !! its places are set

      integer :: i, joint, k, m

      allocate (subsystem%slot(subsystem%system%clearance_joints%n_contact), &
                subsystem%contact(subsystem%system%clearance_joints%n_contact))
      m = 0
      do k = 1, size(subsystem%system%clearance_joints%sets)
         associate (set => subsystem%system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               m = m + 1
               joint = table%find(set%names(set%item_of(i))%s)
               subsystem%slot(m) = slot(joint)
               subsystem%contact(m) = (item(joint) - 1)*set%n_contact_item + modulo(i - 1, set%n_contact_item) + 1
               call set%adopt(i, system%clearance_joints%sets(subsystem%slot(m))%set, subsystem%contact(m))
            end do
         end associate
      end do
   end subroutine find_contacts

end module subsystems
