!> From a scene to the smallest system of equations that it needs.
!>
!> Bodies, ideal joints and drivers: see `build_linkage`; joints with clearance: see `build_clearances`.
module build_system
   use build_clearances, only: add_clearances, levels_as_written, levels_ideal, levels_clearance_joints
   use build_prescribed, only: choose_bodies, reduction_t, set_one_dof, set_prescribed, start_angles
   use build_linkage, only: add_joints, begin_linkage, count_sets, declare_rows, set_solver
   use clearance_set, only: clearance_set_t, n_integrand
   use contact_places, only: place_of_film_loss, slip_function, touch_function, transition_function, turn_function
   use find_prescribed, only: has_smooth_cells
   use force_registry, only: n_force_kinds, new_force_set
   use friction_law, only: memory_bristle, memory_slip
   use stick_slip_forces, only: new_stick_slip_forces
   use stabilisation, only: stabilisation_t
   use stabilisation_registry, only: choose_stabilisation, find_stabilisation
   use integration_method, only: abilities_t
   use joint_registry, only: n_joint_kinds
   use kinds, only: wp
   use loading, only: loading_t, start_loads
   use motion, only: motion_t, new_loads
   use rubbing, only: new_rubbing
   use mechanism, only: mechanism_t
   use reaction_at, only: bind_reactions
   use scene, only: analysis_dynamic, scene_t
   use scene_groups, only: sees_motion
   use scene_size, only: is_large
   use start_segment, only: segment_at_start
   implicit none (type, external)
   private
   public :: levels_as_written, levels_ideal, levels_clearance_joints, new_system

contains

   !> Build the system of a scene.
   subroutine new_system(scene, levels, system, is_for_start)
      type(scene_t), intent(in) :: scene            !! the scene
      integer, intent(in) :: levels                 !! of joints with clearance, one of the above
      type(mechanism_t), intent(inout) :: system    !! the system; what it was before is gone
      logical, intent(in), optional :: is_for_start !! with the rows that hold only at the start; absent: without

      type(abilities_t) :: can
      type(reduction_t) :: reduction
      logical :: is_taken(n_joint_kinds()), with_start_rows
      integer :: k

      call forget(system)
      system%requests = scene%requests
      with_start_rows = .false.
      if (present(is_for_start)) with_start_rows = is_for_start
      is_taken = [(with_start_rows .or. .not. scene%joints(k)%info%is_start_only, k=1, n_joint_kinds())]
      system%ledger%is_kept = scene%settings%integration%has_ledger .and. scene%analysis == analysis_dynamic
      system%ledger%has_energies = system%ledger%is_kept .or. scene%analysis /= analysis_dynamic
      call choose_bodies(scene, levels, with_start_rows, reduction)
      associate (choices => reduction%choices, linkage => system%linkage)
         call begin_linkage(scene, linkage)
         call count_sets(scene, choices, is_taken, linkage)
         call add_joints(scene, choices, is_taken, .true., linkage)
         call add_clearances(scene, levels, start_angles(scene), reduction%is_driven, system)
         linkage%rows%n_solve = linkage%rows%n
         linkage%n_solved_set = count([(allocated(linkage%joints(k)%set), k=1, size(linkage%joints))])
         call add_joints(scene, choices, is_taken, .false., linkage)
         call set_prescribed(scene, reduction%links, choices, linkage)
         call set_one_dof(scene, reduction%guides, choices, linkage)
         linkage%segment = segment_at_start(scene)
         call declare_rows(linkage)
         call new_rubbing(linkage%joints, linkage%n_solved_set, linkage%solution%a, linkage%rows%n, system%friction%rubbing)
         system%n_row = linkage%rows%n_solve
         system%n_position = linkage%n_position
         if (linkage%coordinates%turns_in_body) system%traits%n_turning = linkage%rows%n_unknown
         call set_stabilisation(scene, system)
         call set_solver(scene, system%stabiliser%solver(), linkage)
      end associate
      call system%set_step(huge(1.0_wp))  ! gains and penalties that do not wait for a step
      call add_loads(scene, system%linkage%coordinates%n_v, system%clearance_joints%n, system%linkage%motion, system%loading)
      system%loading%counts_turns = system%loading%counts_turns &
                                    .or. any([(scene%joints(k)%info%counts_turns .and. size(scene%joints(k)%items) > 0, &
                                               k=1, n_joint_kinds())])
      allocate (system%clearance_joints%integrands(n_integrand, system%clearance_joints%n_contact), source=0.0_wp)
      if (scene%analysis == analysis_dynamic) call count_works(system)
      system%n_quadrature = merge(place_of_film_loss(system%clearance_joints%n_contact, system%friction%rubbing%n > 0) &
                                  - merge(0, 1, system%clearance_joints%has_films), 0, &
                                  system%ledger%is_kept) + system%n_wear + system%n_impulse
      system%n = system%linkage%n_position + system%linkage%n_rate + system%loading%states%n_state + system%n_quadrature
      call count_stick_slips(system)
      call add_event_functions(system)
      system%is_large = is_large(scene) .and. system%linkage%reduced%one_dof%n == 0 .and. system%friction%rubbing%n == 0 &
                        .and. system%friction%stick_slips%n_bristle == 0 .and. .not. sees_motion(scene)
      ! forces of contacts that stick hang on all that they are joined with, which the pattern of a Newton matrix does not know
      can = scene%settings%integration%can()
      if (system%friction%stick_slips%n_slip > 0 .and. can%solves_dae) system%is_large = .false.
      call bind_reactions(system)
      call system%choose_form()
   end subroutine new_system

   !> Forget a system. Here alone: whoever calls a procedure with such an `intent(out)` has the code that takes a system apart.
   subroutine forget(system)
      type(mechanism_t), intent(out) :: system   !! new

   end subroutine forget

   !> Contacts whose impulses are integrated, and whose driving work of wear.
   subroutine count_works(system)
      type(mechanism_t), intent(inout) :: system  !! the system, its contacts counted

      integer :: k

      associate (joints => system%clearance_joints)
         system%n_impulse = joints%n_contact
         if (any([(allocated(joints%sets(k)%set%laws%wear), k=1, size(joints%sets))])) system%n_wear = joints%n_contact
      end associate
   end subroutine count_works

   !> The blocks of event functions that the contacts have.
   subroutine add_event_functions(system)
      type(mechanism_t), intent(inout) :: system  !! the system, its contacts and stick-slip states counted

      integer :: k

      system%clearance_joints%functions%n_contact = system%clearance_joints%n_contact
      call system%clearance_joints%functions%add(touch_function)
      if (system%friction%stick_slips%n_slip > 0) call system%clearance_joints%functions%add(slip_function)
      if (any([(system%clearance_joints%sets(k)%set%laws%normal%jumps_at_turn, k=1, size(system%clearance_joints%sets))])) then
         call system%clearance_joints%functions%add(turn_function)
      end if
      if (any([(has_transition(system%clearance_joints%sets(k)%set), k=1, size(system%clearance_joints%sets))])) then
         call system%clearance_joints%functions%add(transition_function)
      end if
      system%n_event = system%clearance_joints%functions%n
   end subroutine add_event_functions

   !> Whether films of a set go out over a transition.
   pure logical function has_transition(set)
      class(clearance_set_t), intent(in) :: set  !! the set

      has_transition = .false.
      if (allocated(set%laws%films)) has_transition = set%laws%films%fades()
   end function has_transition

   !> Storage for friction that remembers: a state for each contact with bristles.
   subroutine count_stick_slips(system)
      type(mechanism_t), intent(inout) :: system  !! the system, all else counted

      integer :: k, n_bristle, n_force, n_slip

      n_bristle = 0
      n_force = 0
      n_slip = 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            call set%place_bristles(n_bristle)
            if (set%stick_slip%memory == memory_bristle) n_bristle = n_bristle + set%stick_slip%n_component*set%n_contact
            if (set%stick_slip%memory /= memory_slip) cycle
            n_slip = n_slip + set%n_contact
            n_force = n_force + set%stick_slip%n_tangent*set%n_contact
         end associate
      end do
      system%friction%rubbing%first_bristle = n_bristle
      n_bristle = n_bristle + system%friction%rubbing%n_bristle
      system%n = system%n + n_bristle
      call new_stick_slip_forces(n_slip, n_force, n_bristle, system%linkage%solution%a, system%linkage%rows%n, system%n, &
                           system%friction%stick_slips)
   end subroutine count_stick_slips

   !> Gravity, and force elements: one set per kind that has rows.
   subroutine add_loads(scene, n_v, n_clearance_joint, motion, loading)
      type(scene_t), intent(in) :: scene              !! the scene
      integer, intent(in) :: n_v                      !! rates of a body
      integer, intent(in) :: n_clearance_joint                  !! clearance joints
      type(motion_t), intent(in) :: motion            !! bodies where the deck puts them
      type(loading_t), intent(inout) :: loading       !! gravity and forces are set

      integer :: k, n

      n = scene%bodies%n
      loading%gravity = scene%gravity
      loading%states = scene%states
      allocate (loading%weight(3, 0:n), loading%g(n_v, 0:n), source=0.0_wp)
      do k = 1, n
         loading%weight(:, k) = scene%bodies%mass(k)*scene%gravity
      end do
      call new_loads(n, loading%loads)
      call start_loads(n, loading%weight, loading%loads%force, loading%loads%moment)
      allocate (loading%forces(count([(size(scene%forces(k)%items) > 0, k=1, n_force_kinds())])))
      loading%n_set = size(loading%forces)
      loading%loads%is_weight = loading%n_set + n_clearance_joint == 0  ! and stays so
      n = 0
      do k = 1, n_force_kinds()
         if (size(scene%forces(k)%items) == 0) cycle
         n = n + 1
         call new_force_set(k, loading%forces(n)%set)
         call loading%forces(n)%set%prepare(scene%forces(k)%items, scene%points)
         call loading%forces(n)%set%set_start(motion)
         loading%counts_turns = loading%counts_turns .or. scene%forces(k)%info%counts_turns
      end do
   end subroutine add_loads

   !> The stabilisation method that is asked for, or the one that suits the system.
   subroutine set_stabilisation(scene, system)
      type(scene_t), intent(in) :: scene              !! the scene
      type(mechanism_t), intent(inout) :: system  !! the stabilisation method is set

      class(stabilisation_t), allocatable :: stabiliser
      type(abilities_t) :: can

      can = scene%settings%integration%can()
      associate (asked => scene%settings%integration%stabilisation)
         if (asked%name /= "") then
            call find_stabilisation(asked%name, stabiliser)
         else
            call choose_stabilisation(system%linkage%rows%n_solve > 0 .and. .not. can%solves_dae, all_smooth(scene), stabiliser)
         end if
         call stabiliser%configure(asked%options, scene%settings%integration%controls%tolerance)
      end associate
      call system%take_stabiliser(stabiliser)
   end subroutine set_stabilisation

   !> Whether no driver jumps.
   pure logical function all_smooth(scene)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: i, k

      all_smooth = .true.
      do k = 1, n_joint_kinds()
         do i = 1, size(scene%joints(k)%items)
            all_smooth = all_smooth .and. has_smooth_cells(scene%joints(k)%items(i))
         end do
      end do
   end function all_smooth

end module build_system
