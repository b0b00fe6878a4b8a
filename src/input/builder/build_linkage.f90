!> The bodies of a scene with its ideal joints and drivers, and the solver of their equations.
!>
!> Bodies whose motion is a known function of time are omitted of the unknowns, with the rows that fix them.
!> Planar: or spatial, here the coordinates are chosen.
module build_linkage
   use augmented_schur, only: schur_is_cheap
   use build_prescribed, only: choice_t, list_carried, start_angles
   use columns, only: find_column
   use item, only: item_t, take_items
   use joint_friction, only: new_joint_friction
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use rows, only: list_sides, new_rows
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use linkage, only: linkage_t
   use motion, only: motion_t, new_motion
   use planar_coordinates, only: new_planar_coordinates
   use spatial_coordinates, only: new_spatial_coordinates
   use scene, only: scene_t
   use scene_size, only: size_of_bodies
   use ties, only: find_joint, tie_of, tie_set, tie_t
   use solver_registry, only: choose_solver, find_solver
   implicit none (type, external)
   private
   public :: add_joints, begin_linkage, count_sets, declare_rows, set_solver

   integer, parameter :: items_of_set = 256   !! of solved joints, at most: what a set computes stays in the processor's cache

contains

   !> Bodies, masses and sizes; the bodies stand where the deck puts them.
   subroutine begin_linkage(scene, linkage)
      type(scene_t), intent(in) :: scene              !! the scene
      type(linkage_t), intent(inout) :: linkage       !! bodies are set

      real(wp), allocatable :: q(:), v(:)
      integer :: k, n

      n = scene%bodies%n
      linkage%bodies = scene%bodies
      if (scene%settings%is_spatial) then
         allocate (linkage%coordinates, source=new_spatial_coordinates())
      else
         allocate (linkage%coordinates, source=new_planar_coordinates())
      end if
      associate (coordinates => linkage%coordinates)
         allocate (linkage%mass(coordinates%n_v, n), linkage%inverse_mass(coordinates%n_v, 0:n), source=0.0_wp)
         call coordinates%find_masses(scene%bodies, linkage%mass)
      end associate
      linkage%scales%length = size_of_bodies(scene)
      linkage%scales%tolerance = scene%settings%integration%controls%tolerance
      linkage%scales%misfit = scene%settings%header%number("closing_tolerance")
      if (scene%settings%is_spatial) then
         call new_motion(n, linkage%motion, scene%bodies%spatial%own)
      else
         call new_motion(n, linkage%motion)
      end if
      if (scene%states%n > 0) linkage%motion%states = [(scene%states%rows(k)%start, k=1, scene%states%n)]
      call linkage%deck_state(q, v)
      call linkage%place_bodies(q, 0.0_wp*v)
   end subroutine begin_linkage

   !> Places for the sets of joints and drivers.
   subroutine count_sets(scene, choices, is_taken, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(:)  !! (kinds) which rows of each table leave the equations
      logical, intent(in) :: is_taken(:)        !! (kinds) which kinds take part
      type(linkage_t), intent(inout) :: linkage               !! joints are allocated

      integer :: k, n

      n = 0
      do k = 1, n_joint_kinds()
         if (size(scene%joints(k)%items) == 0 .or. .not. is_taken(k)) cycle
         if (any(choices(k)%is_fixing)) n = n + 1
         n = n + n_segment(count(.not. choices(k)%is_fixing))
      end do
      allocate (linkage%joints(n))
   end subroutine count_sets

   !> Sets that the solved joints of a kind make.
   pure integer function n_segment(n)
      integer, intent(in) :: n   !! the joints

      n_segment = (n + items_of_set - 1)/items_of_set
   end function n_segment

   !> Ideal joints and drivers that are solved for, or those that fix prescribed bodies: one set per kind that has such rows. Of
   !> solved ones that are many, one for each `items_of_set`.
   subroutine add_joints(scene, choices, is_taken, is_solved, linkage)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(:)  !! (kinds) which rows of each table leave the equations
      logical, intent(in) :: is_taken(:)        !! (kinds) which kinds take part
      logical, intent(in) :: is_solved                        !! which of them
      type(linkage_t), intent(inout) :: linkage               !! joints are set

      class(joint_set_t), allocatable :: set
      integer, allocatable :: chosen(:)
      integer :: column(2), first, k, last, m, most, n

      n = 0
      if (.not. is_solved) n = count([(allocated(linkage%joints(k)%set), k=1, size(linkage%joints))])
      column = 0
      do k = 1, n_joint_kinds()
         if (size(scene%joints(k)%items) == 0 .or. .not. is_taken(k)) cycle
         chosen = pack([(m, m=1, size(scene%joints(k)%items))], choices(k)%is_fixing .neqv. is_solved)
         most = merge(items_of_set, size(chosen), is_solved)
         last = 0
         do
            first = last + 1
            last = min(last + most, size(chosen))
            call add_set(scene, k, chosen(first:last), is_solved, linkage, set)
            m = merge(2, 1, set%is_driver)
            set%column = column(m) + chosen(first:last)
            if (last < first) exit
            n = n + 1
            call move_alloc(set, linkage%joints(n)%set)
            if (last == size(chosen)) exit
         end do
         column(m) = column(m) + size(scene%joints(k)%items)
      end do
   end subroutine add_joints

   !> A set of some rows of a table, and its place among the constraint rows.
   subroutine add_set(scene, kind, chosen, is_solved, linkage, set)
      type(scene_t), intent(in) :: scene                      !! the scene
      integer, intent(in) :: kind                             !! number of the kind
      integer, intent(in) :: chosen(:)                        !! (n) rows of its table
      logical, intent(in) :: is_solved                        !! whether they are solved for
      type(linkage_t), intent(inout) :: linkage               !! rows are counted
      class(joint_set_t), allocatable, intent(out) :: set     !! the set

      type(item_t), allocatable :: items(:)

      associate (info => scene%joints(kind)%info)
         call new_joint_set(kind, set)
         call take_items(scene%joints(kind)%items, chosen, items)
         call tie_set(scene, info, items, set)
         call set%prepare(items, start_angles(scene))
         call set%set_start(linkage%motion)
         call take_joints(scene, info, items, linkage%motion, set)
         if (is_solved .and. find_column(info, "friction") > 0) then
            call new_joint_friction(items, scene%frictions, set%friction_lengths(), linkage%coordinates%n_v, set%friction)
         end if
         set%is_solved = is_solved
         set%first_row = linkage%rows%n
         linkage%rows%n = linkage%rows%n + set%n*set%n_row_item
      end associate
   end subroutine add_set

   !> Give the items of a set the joints that their rows name, if they name one each, or couple several.
   subroutine take_joints(scene, info, items, motion, set)
      type(scene_t), intent(in) :: scene          !! the scene
      type(kind_info_t), intent(in) :: info       !! kind of the rows
      type(item_t), intent(in) :: items(:)        !! (n) the rows
      type(motion_t), intent(in) :: motion        !! bodies where the deck puts them
      class(joint_set_t), intent(inout) :: set    !! the set, prepared

      class(joint_set_t), allocatable :: joint
      type(tie_t) :: tie
      integer :: end, k, kind, row

      do k = 1, size(items)
         tie = tie_of(scene, info, items(k))
         if (tie%joint(1) == 0 .or. (tie%joint(2) > 0 .and. .not. info%couples_joints)) cycle
         do end = 1, merge(count(tie%joint > 0), 1, info%couples_joints)
            call find_joint(scene, tie%joint(end), kind, row)
            call new_joint_set(kind, joint)
            associate (table => scene%joints(kind))
               call tie_set(scene, table%info, table%items(row:row), joint)
               call joint%prepare(table%items(row:row), start_angles(scene))
            end associate
            call joint%set_start(motion)
            call set%take_joint(k, joint, motion)
         end do
      end do
   end subroutine take_joints

   !> Storage for all constraint rows, and their bodies.
   subroutine declare_rows(linkage)
      type(linkage_t), intent(inout) :: linkage  !! rows are set

      logical :: is_reduced(linkage%bodies%n)
      integer :: k, n, n_more, n_solve

      n_solve = linkage%rows%n_solve
      n = linkage%rows%n
      n_more = 0
      do k = 1, size(linkage%joints)
         n_more = n_more + linkage%joints(k)%set%n_more_blocks()
      end do
      call new_rows(n, linkage%rows, linkage%coordinates%n_v, n_more)
      linkage%rows%n_block = n  ! those that are declared
      linkage%rows%n_solve = n_solve
      do k = 1, size(linkage%joints)
         call linkage%joints(k)%set%declare_rows(linkage%rows)
      end do
      do k = 1, size(linkage%ideal)
         call linkage%ideal(k)%set%declare_rows(linkage%rows)
      end do
      is_reduced = linkage%reduced%is_known
      is_reduced(linkage%reduced%one_dof%held%body) = .true.
      call list_sides(is_reduced, linkage%rows)
      call list_carried(linkage)
      call linkage%make_storage
   end subroutine declare_rows

   !> The solver that is asked for, or that the stabilisation method needs; else the one that suits the equations.
   subroutine set_solver(scene, needed, linkage)
      type(scene_t), intent(in) :: scene              !! the scene
      character(*), intent(in) :: needed              !! solver of the stabilisation method; blank: any
      type(linkage_t), intent(inout) :: linkage       !! the solver is set

      associate (asked => scene%settings%integration%solver%name)
         if (asked /= "") then
            call find_solver(asked, linkage%solution%solver)
         else if (needed /= "") then
            call find_solver(needed, linkage%solution%solver)
         else
            call choose_solver(schur_is_cheap(linkage%rows), linkage%solution%solver)
         end if
      end associate
      call linkage%solution%solver%prepare(linkage%bodies%n, linkage%rows)
   end subroutine set_solver

end module build_linkage
