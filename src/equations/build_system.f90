!> From a scene to the smallest system of equations that it needs.
!>
!> Bodies whose motion is a known function of time are left out of the unknowns, with the rows that fix them.
!> Joints with clearance: see `build_clearances`.
module build_system
   use augmented_schur, only: schur_is_cheap
   use build_clearances, only: add_clearances, levels_as_written, levels_ideal, levels_loose
   use find_known, only: find_known_bodies, has_smooth_cells, joint_points, link_t
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_slot_t
   use hold_registry, only: n_hold_kinds, new_hold
   use item, only: option_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t, list_sides, new_rows
   use kinds, only: wp
   use motion, only: new_loads, new_motion, set_planar_motion
   use planar_system, only: n_ledger, planar_system_t
   use scene, only: analysis_dynamic, scene_t
   use scene_size, only: size_of_bodies
   use section_info, only: column_of
   use solver_registry, only: n_solver_kinds, new_solver
   implicit none (type, external)
   private
   public :: levels_as_written, levels_ideal, levels_loose, new_system

   !> Which rows of a table of joints fix known bodies.
   type :: choice_t
      logical, allocatable :: is_fixing(:)  !! (rows of the table)
   end type choice_t

contains

   !> Build the system of a scene.
   subroutine new_system(scene, levels, system, is_for_start)
      type(scene_t), intent(in) :: scene            !! the scene
      integer, intent(in) :: levels                 !! of joints with clearance, one of the above
      type(planar_system_t), intent(out) :: system  !! the system
      logical, intent(in), optional :: is_for_start !! with the rows that hold only at the start; absent: without

      type(choice_t) :: choices(n_joint_kinds)
      type(link_t), allocatable :: links(:)
      logical :: is_taken(n_joint_kinds)
      integer :: k, n

      n = scene%bodies%n
      system%n_body = n
      system%bodies = scene%bodies
      system%gravity = scene%gravity
      system%with_ledger = scene%dynamic%values(column_of(scene%dynamic_kind, "ledger"))%flag &
                           .and. scene%analysis == analysis_dynamic
      system%with_energies = system%with_ledger .or. scene%analysis /= analysis_dynamic
      allocate (system%mass(3, n), system%inverse_mass(3, 0:n), system%weight(3, 0:n), source=0.0_wp)
      do k = 1, n
         system%mass(:, k) = [scene%bodies%mass(k), scene%bodies%mass(k), scene%bodies%inertia(k)]
         system%weight(:, k) = scene%bodies%mass(k)*scene%gravity
      end do
      system%length_scale = size_of_bodies(scene)
      call new_motion(n, system%motion)
      call new_loads(n, system%loads)
      is_taken = .true.
      do k = 1, n_joint_kinds
         if (scene%joints(k)%info%is_start_only) is_taken(k) = .false.
      end do
      if (present(is_for_start)) is_taken = is_taken .or. is_for_start
      call choose_known(scene, links, choices)
      call count_sets(scene, choices, is_taken, system)
      call set_planar_motion(n, start_positions(scene), 0.0_wp*start_positions(scene), system%motion)
      call add_joints(scene, choices, is_taken, .true., system)
      call add_clearances(scene, levels, start_angles(scene), system)
      system%rows%n_solve = system%rows%n
      system%n_solved_set = count([(allocated(system%joints(k)%set), k=1, size(system%joints))])
      call add_joints(scene, choices, is_taken, .false., system)
      call set_known(scene, links, choices, system)
      call add_forces(scene, system)
      call declare_rows(system)
      system%row_weight = merge(1.0_wp, 1.0_wp/system%length_scale, system%rows%is_angle)
      call choose_hold(scene, system)
      call choose_solver(scene, system)
      call system%set_step(huge(1.0_wp))  ! gains and penalties that do not wait for a step
      allocate (system%g(3, 0:n), system%a(3, 0:n), system%rest(3, 0:n), system%losses(2, system%n_contact), source=0.0_wp)
      system%n_position = 3*system%rows%n_unknown
      system%n_quadrature = merge(n_ledger + 2*system%n_contact, 0, system%with_ledger)
      system%n = 2*system%n_position + system%n_quadrature
      system%n_event = system%n_contact
      allocate (system%held(2*system%n_position), source=0.0_wp)
   end subroutine new_system

   !> Angles of the bodies at the start, with that of the ground.
   pure function start_angles(scene) result(angle)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp) :: angle(0:scene%bodies%n)        !! (0:bodies) angles [rad]

      angle(0) = 0.0_wp
      angle(1:) = scene%bodies%angle
   end function start_angles

   !> Coordinates of the bodies where the deck puts them.
   pure function start_positions(scene) result(q)
      type(scene_t), intent(in) :: scene      !! the scene
      real(wp) :: q(3, scene%bodies%n)        !! (3, bodies) x, y, angle [m, m, rad]

      q(1:2, :) = scene%bodies%r(1:2, :)
      q(3, :) = scene%bodies%angle
   end function start_positions

   !> The bodies that are known functions of time, unless the deck wants them among the unknowns, and the rows that fix them.
   !> Only an integration has unknowns: elsewhere all bodies stay together.
   subroutine choose_known(scene, links, choices)
      type(scene_t), intent(in) :: scene                       !! the scene
      type(link_t), allocatable, intent(out) :: links(:)       !! (known bodies) how they are fixed
      type(choice_t), intent(out) :: choices(n_joint_kinds)    !! (kinds) which rows of each table fix them

      integer :: k

      do k = 1, n_joint_kinds
         allocate (choices(k)%is_fixing(size(scene%joints(k)%items)), source=.false.)
      end do
      allocate (links(0))
      if (scene%analysis /= analysis_dynamic) return
      if (scene%dynamic%values(column_of(scene%dynamic_kind, "driven_bodies"))%text == "unknown") return
      call find_known_bodies(scene, links)
      ! without any unknown nothing would control the step, and the works would be as good as chance
      if (size(links) == scene%bodies%n) links = links(:0)
      do k = 1, size(links)
         choices(links(k)%kind)%is_fixing(links(k)%item) = .true.
         if (links(k)%driver > 0) choices(links(k)%driver)%is_fixing(links(k)%driving) = .true.
      end do
   end subroutine choose_known

   !> Places for the sets of joints and drivers: up to two for each kind that has rows.
   subroutine count_sets(scene, choices, is_taken, system)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table fix known bodies
      logical, intent(in) :: is_taken(n_joint_kinds)          !! (kinds) which kinds take part
      type(planar_system_t), intent(inout) :: system          !! joints are allocated

      integer :: k, n

      n = 0
      do k = 1, n_joint_kinds
         if (size(scene%joints(k)%items) == 0 .or. .not. is_taken(k)) cycle
         if (any(choices(k)%is_fixing)) n = n + 1
         if (.not. all(choices(k)%is_fixing)) n = n + 1
      end do
      allocate (system%joints(n))
   end subroutine count_sets

   !> Ideal joints and drivers that are solved for, or those that fix known bodies: one set per kind that has such rows.
   subroutine add_joints(scene, choices, is_taken, is_solved, system)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table fix known bodies
      logical, intent(in) :: is_taken(n_joint_kinds)          !! (kinds) which kinds take part
      logical, intent(in) :: is_solved                        !! which of them
      type(planar_system_t), intent(inout) :: system          !! joints are set

      class(joint_set_t), allocatable :: set
      integer, allocatable :: chosen(:), i(:), j(:)
      integer :: column(2), k, m, n

      n = 0
      if (.not. is_solved) n = count([(allocated(system%joints(k)%set), k=1, size(system%joints))])
      column = 0
      do k = 1, n_joint_kinds
         if (size(scene%joints(k)%items) == 0 .or. .not. is_taken(k)) cycle
         chosen = pack([(m, m=1, size(scene%joints(k)%items))], choices(k)%is_fixing .neqv. is_solved)
         call new_joint_set(k, set)
         allocate (i(size(chosen)), j(size(chosen)))
         do m = 1, size(chosen)
            call joint_points(scene, k, chosen(m), i(m), j(m))
         end do
         call set%new(scene%joints(k)%items(chosen), i, j, scene%points)
         call set%prepare(scene%joints(k)%items(chosen), start_angles(scene))
         call set%set_start(system%motion)
         deallocate (i, j)
         m = merge(2, 1, set%is_driver)
         set%column = column(m) + chosen
         column(m) = column(m) + size(scene%joints(k)%items)
         if (size(chosen) == 0) cycle
         set%is_solved = is_solved
         set%first_row = system%rows%n
         system%rows%n = system%rows%n + set%n*set%n_row_item
         n = n + 1
         call move_alloc(set, system%joints(n)%set)
      end do
   end subroutine add_joints

   !> How the known bodies are moved, and which rows fix them.
   subroutine set_known(scene, links, choices, system)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(link_t), intent(in) :: links(:)                    !! (known bodies) how they are fixed
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table fix known bodies
      type(planar_system_t), intent(inout) :: system          !! known bodies are set; joints are there

      real(wp) :: angle(0:scene%bodies%n)
      integer :: body(2), item, k, n, point(2), side, slot

      n = size(links)
      angle = start_angles(scene)
      associate (known => system%known)
         known%n = n
         allocate (known%body(n), known%base(n), known%slot(n), known%item(n), known%row(3, n), known%side(3, n), source=0)
         allocate (known%s_body(3, n), known%s_base(3, n), known%sign(n), known%offset(n), source=0.0_wp)
         do k = 1, n
            associate (link => links(k))
               call joint_points(scene, link%kind, link%item, point(1), point(2))
               body = scene%points%body(point)
               side = merge(1, 2, body(1) == link%body)
               known%body(k) = body(side)
               known%base(k) = body(3 - side)
               known%s_body(:, k) = scene%points%s(:, point(side))
               known%s_base(:, k) = scene%points%s(:, point(3 - side))
               known%side(:, k) = side
               call find_fixing(scene, choices, system, link%kind, link%item, slot, item)
               call take_rows(system%joints(slot)%set, item, known%row(:, k))
               if (link%driver == 0) then
                  known%offset(k) = angle(body(side)) - angle(body(3 - side))
               else
                  call find_fixing(scene, choices, system, link%driver, link%driving, known%slot(k), known%item(k))
                  call take_rows(system%joints(known%slot(k))%set, known%item(k), known%row(3:3, k))
                  known%sign(k) = merge(1.0_wp, -1.0_wp, side == 2)
               end if
            end associate
         end do
      end associate
      allocate (system%is_known(system%n_body), source=.false.)
      system%is_known(system%known%body) = .true.
      do k = 1, system%n_body
         if (.not. system%is_known(k)) system%inverse_mass(:, k) = 1.0_wp/system%mass(:, k)
      end do

   contains

      !> Rows of an item, as many as there is room for.
      subroutine take_rows(set, item, row)
         class(joint_set_t), intent(in) :: set   !! the set
         integer, intent(in) :: item             !! its item
         integer, intent(out) :: row(:)          !! (any) its rows

         integer :: i

         row = [(set%first_row + (item - 1)*set%n_row_item + i, i=1, size(row))]
      end subroutine take_rows

   end subroutine set_known

   !> Set and item of a row of a joint table that fixes a known body.
   subroutine find_fixing(scene, choices, system, kind, row, slot, item)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table fix known bodies
      type(planar_system_t), intent(in) :: system             !! its joints
      integer, intent(in) :: kind                             !! number of the kind
      integer, intent(in) :: row                              !! row of its table
      integer, intent(out) :: slot                            !! the set
      integer, intent(out) :: item                            !! its item

      item = count(choices(kind)%is_fixing(:row))
      do slot = 1, size(system%joints)
         associate (set => system%joints(slot)%set)
            if (set%is_solved) cycle
            if (set%names(min(item, set%n))%s == scene%joints(kind)%items(row)%name) return
         end associate
      end do
   end subroutine find_fixing

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

   !> Room for all constraint rows, and their bodies.
   subroutine declare_rows(system)
      type(planar_system_t), intent(inout) :: system  !! rows are set

      integer :: k, n, n_solve

      n_solve = system%rows%n_solve
      n = system%rows%n
      call new_rows(n, system%rows)
      system%rows%n_solve = n_solve
      do k = 1, size(system%joints)
         call system%joints(k)%set%declare_rows(system%rows)
      end do
      do k = 1, size(system%ideal)
         call system%ideal(k)%set%declare_rows(system%rows)
      end do
      call list_sides(system%is_known, system%rows)
      system%n_row = system%rows%n_solve
      allocate (system%phi_dot(n), system%b(n), system%lambda(n), source=0.0_wp)
   end subroutine declare_rows

   !> The way of holding the constraints that the deck asks for. `auto` is projection, which leaves neither violations nor the
   !> traces of gains in the motion; nothing where there is nothing to hold or the integrator holds by itself; Baumgarte's
   !> stabilisation where a driver jumps, because a jump cannot be projected.
   subroutine choose_hold(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! the way is set

      character(:), allocatable :: word
      integer :: k

      associate (value => scene%dynamic%values(column_of(scene%dynamic_kind, "stabilise")))
         word = value%text
         if (word == "auto") then
            word = "projection"
            if (.not. all_smooth(scene)) word = "baumgarte"
            if (system%rows%n_solve == 0 .or. scene%dynamic%values(column_of(scene%dynamic_kind, "method"))%text == "ida") then
               word = "none"
            end if
         end if
         do k = 1, n_hold_kinds
            call new_hold(k, system%way)
            if (system%way%name() == word) exit
         end do
         if (allocated(value%options)) then
            call system%way%configure(value%options, scene%dynamic%values(column_of(scene%dynamic_kind, "tolerance"))%number)
         else
            call system%way%configure([option_t ::], scene%dynamic%values(column_of(scene%dynamic_kind, "tolerance"))%number)
         end if
      end associate
      system%holds = system%way%at_steps
      system%follows_step = system%way%follows_step
   end subroutine choose_hold

   !> Whether no driver jumps.
   pure logical function all_smooth(scene)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: i, k

      all_smooth = .true.
      do k = 1, n_joint_kinds
         do i = 1, size(scene%joints(k)%items)
            all_smooth = all_smooth .and. has_smooth_cells(scene%joints(k)%items(i))
         end do
      end do
   end function all_smooth

   !> The solver the deck asks for; `auto` is the cheaper of the Schur complement and the sparse matrix.
   subroutine choose_solver(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(planar_system_t), intent(inout) :: system  !! the solver is set

      character(:), allocatable :: word
      integer :: k

      word = scene%dynamic%values(column_of(scene%dynamic_kind, "solver"))%text
      if (word == "auto") then
         word = "sparse"
         if (schur_is_cheap(system%rows)) word = "schur"
         if (system%way%name() == "augmented_lagrangian") word = system%way%name()
      end if
      do k = 1, n_solver_kinds
         call new_solver(k, system%solver)
         if (system%solver%name() == word) exit
      end do
      call system%solver%prepare(system%n_body, system%rows)
   end subroutine choose_solver

end module build_system
