!> From a scene to the smallest system of equations that it needs.
!>
!> Loose joints whose row says `level = ideal`, or all of them in the ideal twin, become revolute
!> joints; laws without effect are dropped; loose joints are sorted into sets that share their laws.
module build_system
   use augmented_lapack, only: augmented_lapack_t
   use augmented_schur, only: augmented_schur_t
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_slot_t
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_slot_t
   use friction_law, only: friction_law_t
   use item, only: item_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_slot_t, list_sides, new_rows
   use kinds, only: wp
   use motion, only: new_loads, new_motion
   use planar_system, only: n_ledger, planar_system_t
   use scene, only: analysis_dynamic, scene_t
   use section_info, only: column_of
   implicit none (type, external)
   private
   public :: levels_as_written, levels_ideal, levels_loose, new_system

   integer, parameter :: levels_as_written = 0  !! every joint with clearance as its row says
   integer, parameter :: levels_ideal = 1       !! every one ideal: the ideal twin
   integer, parameter :: levels_loose = 2       !! every one loose: all that a deck can have words for

   integer, parameter :: revolute_kind = 1   !! number of the revolute joint in the registry

contains

   !> Build the system of a scene.
   subroutine new_system(scene, levels, system)
      type(scene_t), intent(in) :: scene            !! the scene
      integer, intent(in) :: levels                 !! of joints with clearance, one of the above
      type(planar_system_t), intent(out) :: system  !! the system

      integer :: k, n

      n = scene%bodies%n
      system%n_body = n
      system%bodies = scene%bodies
      system%gravity = scene%gravity
      system%with_ledger = scene%dynamic%values(column_of(scene%dynamic_kind, "ledger"))%flag &
                           .and. scene%analysis == analysis_dynamic
      system%with_energies = system%with_ledger .or. scene%analysis /= analysis_dynamic
      call set_stabilisation(scene, system)
      allocate (system%inverse_mass(3, 0:n), system%weight(3, 0:n), source=0.0_wp)
      do k = 1, n
         system%inverse_mass(:, k) = 1.0_wp/[scene%bodies%mass(k), scene%bodies%mass(k), scene%bodies%inertia(k)]
         system%weight(:, k) = scene%bodies%mass(k)*scene%gravity
      end do
      system%length_scale = size_of_bodies(scene)
      call new_motion(n, system%motion)
      call new_loads(n, system%loads)
      call add_joints(scene, system)
      call add_forces(scene, system)
      call add_clearances(scene, levels, system)
      call declare_rows(system)
      call choose_solver(scene, system)
      allocate (system%g(3, 0:n), system%a(3, 0:n), system%losses(2, system%n_loose), source=0.0_wp)
      system%n_position = 3*n
      system%n_quadrature = merge(n_ledger + 2*system%n_loose, 0, system%with_ledger)
      system%n = 6*n + system%n_quadrature
      system%n_event = system%n_loose
   end subroutine new_system

   !> Baumgarte's gains.
   subroutine set_stabilisation(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! gains are set

      integer :: k

      associate (value => scene%dynamic%values(column_of(scene%dynamic_kind, "stabilise")))
         if (value%text /= "baumgarte") return
         system%alpha = 5.0_wp
         system%beta = 5.0_wp
         if (.not. allocated(value%options)) return
         do k = 1, size(value%options)
            if (value%options(k)%name == "alpha") system%alpha = value%options(k)%number
            if (value%options(k)%name == "beta") system%beta = value%options(k)%number
         end do
      end associate
   end subroutine set_stabilisation

   !> Size of the bodies: the greatest distance of a point from its body's centre of mass, or radius of
   !> gyration. It does not depend on where the mechanism stands.
   pure real(wp) function size_of_bodies(scene) result(length)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: k

      length = maxval(sqrt(scene%bodies%inertia/scene%bodies%mass))
      do k = 1, scene%points%n
         if (scene%points%body(k) > 0) length = max(length, norm2(scene%points%s(:, k)))
      end do
   end function size_of_bodies

   !> Angles of the bodies at the start, with that of the ground.
   pure function start_angles(scene) result(angle)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp) :: angle(0:scene%bodies%n)        !! (0:bodies) angles [rad]

      angle(0) = 0.0_wp
      angle(1:) = scene%bodies%angle
   end function start_angles

   !> Ideal joints, then drivers: one set per kind that has rows.
   subroutine add_joints(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! joints are set

      integer, allocatable :: i(:), j(:)
      integer :: k, n, row

      n = 0
      do k = 1, n_joint_kinds
         if (size(scene%joints(k)%items) > 0) n = n + 1
      end do
      allocate (system%joints(n))
      n = 0
      row = 0
      do k = 1, n_joint_kinds
         if (size(scene%joints(k)%items) == 0) cycle
         n = n + 1
         call points_of(scene, k, i, j)
         call new_joint_set(k, system%joints(n)%set)
         associate (set => system%joints(n)%set)
            call set%new(scene%joints(k)%items, i, j, scene%points)
            call set%prepare(scene%joints(k)%items, start_angles(scene))
            set%first_row = row
            row = row + set%n*set%n_row_item
         end associate
      end do
      system%rows%n = row
   end subroutine add_joints

   !> Points i and j of the rows of a joint kind; a driver's are those of its joint.
   subroutine points_of(scene, kind, i, j)
      type(scene_t), intent(in) :: scene           !! the scene
      integer, intent(in) :: kind                  !! number of the kind
      integer, allocatable, intent(out) :: i(:)    !! (rows) points of body i
      integer, allocatable, intent(out) :: j(:)    !! (rows) points of body j

      integer :: k

      associate (table => scene%joints(kind))
         allocate (i(size(table%items)), j(size(table%items)), source=0)
         do k = 1, size(table%items)
            if (table%info%columns(1)%name == "joint") then
               associate (driven => scene%joints(revolute_kind)%items(table%items(k)%values(1)%index))
                  i(k) = driven%values(1)%index
                  j(k) = driven%values(2)%index
               end associate
            else
               i(k) = table%items(k)%values(1)%index
               j(k) = table%items(k)%values(2)%index
            end if
         end do
      end associate
   end subroutine points_of

   !> Force elements: one set per kind that has rows.
   subroutine add_forces(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! forces are set

      integer :: k, n

      n = 0
      do k = 1, n_force_kinds
         if (size(scene%forces(k)%items) > 0) n = n + 1
      end do
      allocate (system%forces(n))
      n = 0
      do k = 1, n_force_kinds
         if (size(scene%forces(k)%items) == 0) cycle
         n = n + 1
         call new_force_set(k, system%forces(n)%set)
         call system%forces(n)%set%prepare(scene%forces(k)%items, scene%points)
      end do
   end subroutine add_forces

   !> Joints with clearance: sets of loose ones that share geometry and laws, and one set of ideal ones.
   subroutine add_clearances(scene, levels, system)
      type(scene_t), intent(in) :: scene              !! the scene
      integer, intent(in) :: levels                   !! how they are taken
      type(planar_system_t), intent(inout) :: system  !! clearances and ideal joints are set

      type(clearance_slot_t), allocatable :: slots(:)
      type(item_t), allocatable :: ideal(:), loose(:)
      logical, allocatable :: is_done(:)
      integer :: first, friction, i, k, law, level, n

      allocate (ideal(0), slots(count_clearances(scene)))
      n = 0
      do k = 1, n_clearance_kinds
         associate (items => scene%clearances(k)%items, info => scene%clearances(k)%info)
            level = column_of(info, "level")
            law = column_of(info, "law")
            friction = column_of(info, "friction")
            allocate (is_done(size(items)), source=.false.)
            do first = 1, size(items)
               if (is_done(first)) cycle
               allocate (loose(0))
               do i = first, size(items)
                  if (is_done(i)) cycle
                  if (levels == levels_ideal .or. &
                      (levels == levels_as_written .and. items(i)%values(level)%text == "ideal")) then
                     call append_item(ideal, items(i))
                  else if (items(i)%values(law)%index == items(first)%values(law)%index .and. &
                           items(i)%values(friction)%index == items(first)%values(friction)%index) then
                     call append_item(loose, items(i))
                  else
                     cycle
                  end if
                  is_done(i) = .true.
               end do
               if (size(loose) > 0) then
                  n = n + 1
                  call add_loose_set(scene, k, loose, slots(n), system%n_loose)
               end if
               deallocate (loose)
            end do
            deallocate (is_done)
         end associate
      end do
      allocate (system%clearances(n))
      do k = 1, n
         call move_alloc(slots(k)%set, system%clearances(k)%set)
      end do
      allocate (system%ideal(merge(1, 0, size(ideal) > 0)))
      if (size(ideal) == 0) return
      call new_joint_set(revolute_kind, system%ideal(1)%set)
      associate (set => system%ideal(1)%set)
         ! bearing and journal are the first columns of every geometry, as the points of every joint
         call set%new(ideal, [(ideal(i)%values(1)%index, i=1, size(ideal))], &
                      [(ideal(i)%values(2)%index, i=1, size(ideal))], scene%points)
         call set%prepare(ideal, start_angles(scene))
         set%first_row = system%rows%n
         system%rows%n = system%rows%n + set%n*set%n_row_item
      end associate
   end subroutine add_clearances

   !> Number of rows of all clearance tables.
   pure integer function count_clearances(scene) result(n)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: k

      n = 0
      do k = 1, n_clearance_kinds
         n = n + size(scene%clearances(k)%items)
      end do
   end function count_clearances

   !> Append a row to a list.
   subroutine append_item(list, item)
      type(item_t), allocatable, intent(inout) :: list(:)  !! list, grown
      type(item_t), intent(in) :: item                     !! the row

      type(item_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(size(list) + 1))
      do k = 1, size(list)
         grown(k) = list(k)
      end do
      grown(size(grown)) = item
      call move_alloc(grown, list)
   end subroutine append_item

   !> One set of loose joints with its laws and stiffnesses.
   subroutine add_loose_set(scene, kind, items, slot, n_loose)
      type(scene_t), intent(in) :: scene             !! the scene
      integer, intent(in) :: kind                    !! number of the geometry
      type(item_t), intent(in) :: items(:)           !! rows that share their laws
      type(clearance_slot_t), intent(inout) :: slot  !! the set is made here
      integer, intent(inout) :: n_loose              !! loose joints so far

      class(friction_law_t), allocatable :: friction
      integer :: friction_law, i, normal_law

      call new_clearance_set(kind, slot%set)
      normal_law = items(1)%values(column_of(scene%clearances(kind)%info, "law"))%index
      friction_law = items(1)%values(column_of(scene%clearances(kind)%info, "friction"))%index
      if (friction_law > 0) allocate (friction, source=scene%frictions(friction_law)%law)
      call slot%set%new(items, [(items(i)%values(1)%index, i=1, size(items))], &
                        [(items(i)%values(2)%index, i=1, size(items))], scene%points, scene%laws(normal_law)%law, friction)
      slot%set%first = n_loose
      n_loose = n_loose + size(items)
      call slot%set%prepare(items, scene%materials)
   end subroutine add_loose_set

   !> Room for all constraint rows, and their bodies.
   subroutine declare_rows(system)
      type(planar_system_t), intent(inout) :: system  !! rows are set

      integer :: k, n

      n = system%rows%n
      call new_rows(n, system%rows)
      do k = 1, size(system%joints)
         call system%joints(k)%set%declare_rows(system%rows)
      end do
      do k = 1, size(system%ideal)
         call system%ideal(k)%set%declare_rows(system%rows)
      end do
      call list_sides(system%n_body, system%rows)
      allocate (system%phi_dot(n), system%b(n), system%lambda(n), source=0.0_wp)
   end subroutine declare_rows

   !> The solver the deck asks for; `auto` is the Schur complement, equal to round-off and faster.
   subroutine choose_solver(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! the solver is set

      select case (scene%dynamic%values(column_of(scene%dynamic_kind, "solver"))%text)
      case ("lapack")
         allocate (augmented_lapack_t :: system%solver)
      case default
         allocate (augmented_schur_t :: system%solver)
      end select
      call system%solver%prepare(system%n_body, system%rows)
   end subroutine choose_solver

end module build_system
