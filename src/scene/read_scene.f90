!> From a deck to a scene: reads every table, looks up names, checks what tables cannot say of themselves.
module read_scene
   use item, only: place_of
   use bodies, only: bodies_info, material_info, new_bodies, new_materials, new_points, points_info
   use clearance_registry, only: n_clearance_kinds
   use columns, only: column_of
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use deck_types, only: deck_t, location_of_end
   use diagnostics, only: diagnostics_t
   use force_registry, only: n_force_kinds
   use guard_info, only: guards_info
   use item, only: place_of
   use imsl_names, only: fold_imsl_names
   use joint_registry, only: n_joint_kinds
   use kind_info, only: kind_info_t
   use kind_list, only: all_kinds, clearance_info, force_info, friction_info, joint_info, law_info
   use option_check, only: check_options
   use precision_info, only: check_precision, precision_section
   use read_functions, only: functions_from_deck
   use references, only: add_names, directory_t, resolve
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, friction_slot_t, law_slot_t, n_analysis, n_base, &
      scene_t, table_bodies, table_materials, table_points
   use scene_checks, only: check_meaning, check_names, report_doubled
   use section_info, only: dynamic_info, kinematic_info, output_info, scene_info, static_info
   use settings, only: check_sections, has_section, read_settings
   use study_info, only: ensemble_info, statistics_info
   use tables, only: read_items
   implicit none (type, external)
   private
   public :: scene_from_deck

contains

   !> Read and validate a scene. Mistakes are collected; the scene is of use only if there are none.
   subroutine scene_from_deck(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(out) :: scene                 !! what it means
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      type(kind_info_t), allocatable :: kinds(:)
      type(directory_t) :: directory
      logical :: is_present

      call all_kinds(kinds)
      call check_sections(deck, kinds, diagnostics)
      scene%guards_kind = guards_info()
      scene%output_kind = output_info()
      call functions_from_deck(deck, scene, diagnostics)
      call read_settings(deck, scene_info(), scene%header, is_present, diagnostics)
      call read_analyses(deck, scene, diagnostics)
      call read_settings(deck, scene%guards_kind, scene%guards, is_present, diagnostics)
      call read_settings(deck, scene%output_kind, scene%output, is_present, diagnostics)
      call read_studies(deck, scene, diagnostics)
      call read_tables(deck, scene, diagnostics)
      call add_names(scene%base(table_bodies)%items, directory%bodies)
      call add_names(scene%base(table_points)%items, directory%points)
      call add_names(scene%base(table_materials)%items, directory%materials)
      call add_joints(scene, directory)
      call read_laws(deck, scene, directory, diagnostics)
      if (size(scene%base(table_bodies)%items) == 0 .and. diagnostics%count() == 0) then
         call diagnostics%add(location_of_end(deck), "no bodies", "a scene needs at least one", "add a table [bodies]")
      end if
      call resolve_tables(directory, scene, diagnostics)
      call check_names(scene, diagnostics)
      if (diagnostics%count() > 0) return

      scene%title = scene%header%word("title")
      scene%gravity(1:2) = scene%header%values(place_of(scene%header, "gravity"))%vector(1:2)
      call new_bodies(scene%base(table_bodies)%items, scene%bodies)
      call new_points(scene%base(table_points)%items, scene%points)
      call new_materials(scene%base(table_materials)%items, scene%materials)
      call check_meaning(deck, scene, diagnostics)
   end subroutine scene_from_deck

   !> The sections of the analyses. The one that runs is the first that the deck has; a deck without
   !> any is a dynamic one whose section is missing.
   subroutine read_analyses(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! settings are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      integer :: k
      logical :: is_present

      do k = 1, n_analysis
         scene%has_analysis(k) = has_section(deck, "analysis."//trim(analysis_names(k)))
      end do
      if (.not. any(scene%has_analysis)) scene%has_analysis(analysis_dynamic) = .true.
      scene%analysis = findloc(scene%has_analysis, .true., dim=1)
      scene%dynamic_kind = dynamic_info()
      scene%kinematic_kind = kinematic_info()
      scene%static_kind = static_info()
      ! what the equations ask of [analysis.dynamic] has defaults in the other analyses
      if (.not. scene%has_analysis(analysis_dynamic)) then
         scene%dynamic_kind%columns(column_of(scene%dynamic_kind, "end"))%default = "0 s"
      end if
      call read_settings(deck, scene%dynamic_kind, scene%dynamic, is_present, diagnostics)
      do k = 1, size(scene%dynamic_kind%columns)
         associate (column => scene%dynamic_kind%columns(k))
            if (.not. allocated(column%options)) cycle
            call check_options(column%name, scene%dynamic%values(k), column%choices, column%options, diagnostics)
         end associate
      end do
      call fold_imsl_names(scene%dynamic_kind, scene%dynamic, diagnostics)
      call read_settings(deck, scene%static_kind, scene%static, is_present, diagnostics)
      if (scene%has_analysis(analysis_kinematic)) then
         call read_settings(deck, scene%kinematic_kind, scene%kinematic, is_present, diagnostics)
      end if
   end subroutine read_analyses

   !> The sections of statistics and of many runs, if the deck has them.
   subroutine read_studies(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! settings are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      logical :: is_present

      scene%statistics_kind = statistics_info()
      scene%has_statistics = has_section(deck, scene%statistics_kind%name)
      if (scene%has_statistics) then
         call read_settings(deck, scene%statistics_kind, scene%statistics, is_present, diagnostics)
      end if
      scene%ensemble_kind = ensemble_info()
      scene%has_ensemble = has_section(deck, scene%ensemble_kind%name)
      if (scene%has_ensemble) call read_settings(deck, scene%ensemble_kind, scene%ensemble, is_present, diagnostics)
      scene%precision_kind = precision_section()
      call read_settings(deck, scene%precision_kind, scene%precision, scene%has_precision, diagnostics)
      if (scene%has_precision) call check_precision(scene%precision, diagnostics)
   end subroutine read_studies

   !> The tables of joints, forces and clearances.
   subroutine read_tables(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! tables are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      integer :: k

      scene%base(table_bodies)%info = bodies_info()
      scene%base(table_points)%info = points_info()
      scene%base(table_materials)%info = material_info()
      do k = 1, n_base
         call read_items(deck, scene%base(k)%info, scene%base(k)%items, diagnostics)
      end do
      do k = 1, n_joint_kinds
         scene%joints(k)%info = joint_info(k)
         call read_items(deck, scene%joints(k)%info, scene%joints(k)%items, diagnostics)
      end do
      do k = 1, n_force_kinds
         scene%forces(k)%info = force_info(k)
         call read_items(deck, scene%forces(k)%info, scene%forces(k)%items, diagnostics)
      end do
      do k = 1, n_clearance_kinds
         scene%clearances(k)%info = clearance_info(k)
         call read_items(deck, scene%clearances(k)%info, scene%clearances(k)%items, diagnostics)
      end do
   end subroutine read_tables

   !> Normal laws and friction laws: one object per row, names unique over all kinds of laws.
   subroutine read_laws(deck, scene, directory, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! laws are set
      type(directory_t), intent(inout) :: directory       !! names of the laws are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      integer :: before, i, k, n

      allocate (scene%laws(0), scene%frictions(0), directory%laws(0), directory%frictions(0))
      do k = 1, n_law_kinds
         scene%law_tables(k)%info = law_info(k)
         before = diagnostics%count()
         call read_items(deck, scene%law_tables(k)%info, scene%law_tables(k)%items, diagnostics)
         associate (items => scene%law_tables(k)%items)
            n = size(scene%laws)
            call grow_laws(scene%laws, n + size(items))
            call report_doubled(items, directory%laws, diagnostics)
            do i = 1, size(items)
               call new_normal_law(k, scene%laws(n + i)%law)
               if (diagnostics%count() > before) cycle  ! no law is made of rows with mistakes
               call scene%laws(n + i)%law%prepare(items(i))
               if (scene%laws(n + i)%law%mistake() == "") cycle
               call diagnostics%add(items(i)%location, scene%laws(n + i)%law%mistake(), "in this row")
            end do
            call add_names(items, directory%laws)
         end associate
      end do
      do k = 1, n_friction_kinds
         scene%friction_tables(k)%info = friction_info(k)
         before = diagnostics%count()
         call read_items(deck, scene%friction_tables(k)%info, scene%friction_tables(k)%items, diagnostics)
         associate (items => scene%friction_tables(k)%items)
            n = size(scene%frictions)
            call grow_frictions(scene%frictions, n + size(items))
            call report_doubled(items, directory%frictions, diagnostics)
            do i = 1, size(items)
               call new_friction_law(k, scene%frictions(n + i)%law)
               if (diagnostics%count() > before) cycle
               call scene%frictions(n + i)%law%prepare(items(i))
               if (scene%frictions(n + i)%law%mistake() == "") cycle
               call diagnostics%add(items(i)%location, scene%frictions(n + i)%law%mistake(), "in this row")
            end do
            call add_names(items, directory%frictions)
         end associate
      end do
   end subroutine read_laws

   !> Longer list of laws.
   subroutine grow_laws(laws, n)
      type(law_slot_t), allocatable, intent(inout) :: laws(:)  !! list, grown
      integer, intent(in) :: n                                 !! new length

      type(law_slot_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(n))
      do k = 1, size(laws)
         call move_alloc(laws(k)%law, grown(k)%law)
      end do
      call move_alloc(grown, laws)
   end subroutine grow_laws

   !> Longer list of friction laws.
   subroutine grow_frictions(laws, n)
      type(friction_slot_t), allocatable, intent(inout) :: laws(:)  !! list, grown
      integer, intent(in) :: n                                      !! new length

      type(friction_slot_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(n))
      do k = 1, size(laws)
         call move_alloc(laws(k)%law, grown(k)%law)
      end do
      call move_alloc(grown, laws)
   end subroutine grow_frictions

   !> Names and kinds of all joints and drivers.
   subroutine add_joints(scene, directory)
      type(scene_t), intent(in) :: scene              !! tables
      type(directory_t), intent(inout) :: directory   !! joints are set

      integer :: i, k, n

      n = sum([(size(scene%joints(k)%items), k=1, n_joint_kinds)])
      allocate (directory%joints(n), directory%kinds(n))
      n = 0
      do k = 1, n_joint_kinds
         do i = 1, size(scene%joints(k)%items)
            n = n + 1
            directory%joints(n)%s = scene%joints(k)%items(i)%name
            directory%kinds(n)%s = scene%joints(k)%info%name
         end do
      end do
   end subroutine add_joints

   !> Look up the references of all tables.
   subroutine resolve_tables(directory, scene, diagnostics)
      type(directory_t), intent(in) :: directory          !! names known
      type(scene_t), intent(inout) :: scene               !! tables, indices are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      integer :: k

      do k = 1, n_base
         call resolve(directory, scene%base(k)%info, scene%base(k)%items, diagnostics)
      end do
      do k = 1, n_joint_kinds
         call resolve(directory, scene%joints(k)%info, scene%joints(k)%items, diagnostics)
      end do
      do k = 1, n_force_kinds
         call resolve(directory, scene%forces(k)%info, scene%forces(k)%items, diagnostics)
      end do
      do k = 1, n_clearance_kinds
         call resolve(directory, scene%clearances(k)%info, scene%clearances(k)%items, diagnostics)
      end do
   end subroutine resolve_tables

end module read_scene
