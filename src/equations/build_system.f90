!> From a scene to the smallest system of equations that it needs.
!>
!> Bodies whose motion is a known function of time are left out of the unknowns, with the rows that fix them.
!> Joints with clearance: see `build_clearances`.
module build_system
   use augmented_schur, only: schur_is_cheap
   use build_clearances, only: add_clearances, levels_as_written, levels_ideal, levels_loose
   use build_known, only: choice_t, choose_bodies, list_carried, reduction_t, set_guided, set_known, start_angles
   use columns, only: column_of
   use find_known, only: has_smooth_cells, joint_bodies, joint_points, ties_bodies
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_slot_t
   use friction_law, only: memory_bristle, memory_slip
   use grip_forces, only: new_grip_forces
   use hold_registry, only: n_hold_kinds, new_hold
   use item, only: option_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t, list_sides, new_rows
   use kinds, only: wp
   use motion, only: new_loads, new_motion, set_planar_motion
   use planar_system, only: n_ledger, planar_system_t
   use scene, only: analysis_dynamic, scene_t
   use scene_size, only: is_large, size_of_bodies
   use solver_registry, only: n_solver_kinds, new_solver
   use start_piece, only: piece_at_start
   implicit none (type, external)
   private
   public :: levels_as_written, levels_ideal, levels_loose, new_system

contains

   !> Build the system of a scene.
   subroutine new_system(scene, levels, system, is_for_start)
      type(scene_t), intent(in) :: scene            !! the scene
      integer, intent(in) :: levels                 !! of joints with clearance, one of the above
      type(planar_system_t), intent(out) :: system  !! the system
      logical, intent(in), optional :: is_for_start !! with the rows that hold only at the start; absent: without

      type(reduction_t) :: reduction
      logical :: is_taken(n_joint_kinds), with_start_rows
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
      system%tolerance = scene%dynamic%values(column_of(scene%dynamic_kind, "tolerance"))%number
      call new_motion(n, system%motion)
      call new_loads(n, system%loads)
      with_start_rows = .false.
      if (present(is_for_start)) with_start_rows = is_for_start
      do k = 1, n_joint_kinds
         is_taken(k) = with_start_rows .or. .not. scene%joints(k)%info%is_start_only
      end do
      call choose_bodies(scene, levels, with_start_rows, reduction)
      associate (choices => reduction%choices)
         call count_sets(scene, choices, is_taken, system)
         call set_planar_motion(n, start_positions(scene), 0.0_wp*start_positions(scene), system%motion)
         call add_joints(scene, choices, is_taken, .true., system)
         call add_clearances(scene, levels, start_angles(scene), reduction%is_driven, system)
         system%rows%n_solve = system%rows%n
         system%n_solved_set = count([(allocated(system%joints(k)%set), k=1, size(system%joints))])
         call add_joints(scene, choices, is_taken, .false., system)
         call set_known(scene, reduction%links, choices, system)
         call set_guided(scene, reduction%guides, choices, system)
      end associate
      call add_forces(scene, system)
      system%piece = piece_at_start(scene)
      call declare_rows(system)
      system%row_weight = merge(1.0_wp, 1.0_wp/system%length_scale, system%rows%is_angle)
      call choose_hold(scene, system)
      call choose_solver(scene, system)
      call system%set_step(huge(1.0_wp))  ! gains and penalties that do not wait for a step
      allocate (system%g(3, 0:n), system%a(3, 0:n), system%rest(3, 0:n), system%losses(2, system%n_contact), source=0.0_wp)
      system%n_position = 3*system%rows%n_unknown + system%guided%n
      system%n_quadrature = merge(n_ledger + 2*system%n_contact, 0, system%with_ledger)
      system%n = 2*system%n_position + system%n_quadrature
      system%n_event = system%n_contact
      call count_grips(system)
      if (any([(system%clearances(k)%set%law%jumps_at_turn, k=1, size(system%clearances))])) then
         system%first_turn = system%n_event
         system%n_event = system%n_event + system%n_contact
      end if
      system%is_large = is_large(scene) .and. system%guided%n == 0 .and. system%grips%n_bristle == 0
      ! forces of contacts that stick hang on all that they are joined with, which the pattern of a Newton matrix does not know
      if (system%grips%n_slip > 0 .and. scene%dynamic%values(column_of(scene%dynamic_kind, "method"))%text == "ida") then
         system%is_large = .false.
      end if
      allocate (system%held(2*system%n_position), source=0.0_wp)
   end subroutine new_system

   !> Room for friction that remembers: a state for each contact with bristles, a second event function for each contact if
   !> any can stick.
   subroutine count_grips(system)
      type(planar_system_t), intent(inout) :: system  !! the system, all else counted

      integer :: k, n_bristle, n_slip

      n_bristle = 0
      n_slip = 0
      do k = 1, size(system%clearances)
         associate (set => system%clearances(k)%set)
            set%grip%first_bristle = n_bristle
            if (set%grip%memory == memory_bristle) n_bristle = n_bristle + set%n_contact
            if (set%grip%memory == memory_slip) n_slip = n_slip + set%n_contact
         end associate
      end do
      system%n = system%n + n_bristle
      if (n_slip > 0) system%n_event = 2*system%n_contact
      call new_grip_forces(n_slip, n_bristle, system%n_body, system%rows%n, system%n, system%grips)
   end subroutine count_grips

   !> Coordinates of the bodies where the deck puts them.
   pure function start_positions(scene) result(q)
      type(scene_t), intent(in) :: scene      !! the scene
      real(wp) :: q(3, scene%bodies%n)        !! (3, bodies) x, y, angle [m, m, rad]

      q(1:2, :) = scene%bodies%r(1:2, :)
      q(3, :) = scene%bodies%angle
   end function start_positions

   !> Places for the sets of joints and drivers: up to two for each kind that has rows.
   subroutine count_sets(scene, choices, is_taken, system)
      type(scene_t), intent(in) :: scene                      !! the scene
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table leave the equations
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
      type(choice_t), intent(in) :: choices(n_joint_kinds)    !! (kinds) which rows of each table leave the equations
      logical, intent(in) :: is_taken(n_joint_kinds)          !! (kinds) which kinds take part
      logical, intent(in) :: is_solved                        !! which of them
      type(planar_system_t), intent(inout) :: system          !! joints are set

      class(joint_set_t), allocatable :: set
      integer, allocatable :: chosen(:), i(:), j(:)
      integer :: body(2), column(2), k, m, n

      n = 0
      if (.not. is_solved) n = count([(allocated(system%joints(k)%set), k=1, size(system%joints))])
      column = 0
      do k = 1, n_joint_kinds
         if (size(scene%joints(k)%items) == 0 .or. .not. is_taken(k)) cycle
         chosen = pack([(m, m=1, size(scene%joints(k)%items))], choices(k)%is_fixing .neqv. is_solved)
         call new_joint_set(k, set)
         allocate (i(size(chosen)), j(size(chosen)))
         if (ties_bodies(scene, k)) then
            do m = 1, size(chosen)
               body = joint_bodies(scene, k, chosen(m))
               i(m) = body(1)
               j(m) = body(2)
            end do
            call set%new_of_bodies(scene%joints(k)%items(chosen), i, j)
         else
            do m = 1, size(chosen)
               call joint_points(scene, k, chosen(m), i(m), j(m))
            end do
            call set%new(scene%joints(k)%items(chosen), i, j, scene%points)
         end if
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

      logical :: is_reduced(system%n_body)
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
      is_reduced = system%is_known
      is_reduced(system%guided%item%body) = .true.
      call list_sides(is_reduced, system%rows)
      call list_carried(system)
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
