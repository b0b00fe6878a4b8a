!> From a deck to a scene: reads every table, looks up names, checks what tables cannot say of themselves.
module read_scene
   use bodies, only: new_bodies, new_materials, new_points
   use clearance_registry, only: n_clearance_kinds
   use contact_registry, only: n_friction_kinds, n_law_kinds, n_wear_kinds
   use columns, only: column_of
   use deck_types, only: deck_t, location_of_end
   use diagnostics, only: diagnostics_t
   use figure_list, only: join_figures
   use film_registry, only: n_film_kinds
   use force_registry, only: n_force_kinds
   use function_registry, only: n_function_kinds
   use item, only: place_of
   use imsl_names, only: fold_imsl_names
   use integration_settings, only: read_integration
   use joint_registry, only: n_joint_kinds
   use kind_info, only: is_of_space, kind_info_t
   use kind_list, only: clearance_info, force_info, joint_info, kind_named, known
   use mesh_file, only: most_triangles
   use option_check, only: check_options
   use precision_info, only: check_precision
   use lubricant, only: oil_of_row
   use read_films, only: check_lubricants, films_from_deck
   use read_laws, only: laws_from_deck
   use read_functions, only: functions_from_deck
   use read_worn, only: make_worn_surfaces, worn_from_deck
   use read_states, only: place_states, states_from_deck
   use read_requests, only: make_requests, place_observables, requests_from_deck
   use references, only: add_names, directory_t, resolve
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, n_analysis, n_base, &
      scene_t, section_t, settings_t, table_bodies, table_lubricants, table_materials, table_points, table_shapes, table_t
   use scene_checks, only: check_meaning, check_names
   use shapes, only: mistake_of_shape
   use settings, only: check_sections, has_section, read_settings
   use spatial_bodies, only: mistake_of_body, new_spatial_bodies, new_spatial_points
   use tables, only: read_items
   use text, only: to_text
   use worn_registry, only: n_worn_kinds
   implicit none (type, external)
   private
   public :: check_space, finish_scene, list_names, resolve_tables, scene_from_deck

   type(kind_info_t), target :: equations  !! keys of [analysis.dynamic] where another analysis needs its equations; set once

contains

   !> Read and validate a scene. Errors are collected; the scene is of use only if there are none.
   subroutine scene_from_deck(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(out) :: scene                 !! what it means
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(directory_t) :: directory

      allocate (scene%joints(n_joint_kinds()), scene%forces(n_force_kinds()), scene%clearances(n_clearance_kinds()))
      associate (tables => scene%tables)
         allocate (tables%functions(n_function_kinds()), tables%laws(n_law_kinds()), tables%frictions(n_friction_kinds()), &
                   tables%wears(n_wear_kinds()), tables%films(n_film_kinds()), tables%worn(n_worn_kinds()))
      end associate
      call read_section(deck, kind_named("scene", .false.), scene%settings%header, diagnostics)
      scene%settings%is_spatial = scene%settings%header%word("space") == "spatial"
      associate (gravity => scene%settings%header%values(place_of(scene%settings%header, "gravity")))
         if (.not. gravity%given) gravity%vector%n = merge(3, 2, scene%settings%is_spatial)
      end associate
      call check_sections(deck, known, scene%settings%is_spatial, diagnostics)
      call functions_from_deck(deck, scene, diagnostics)
      call read_analyses(deck, scene%settings, diagnostics)
      call states_from_deck(deck, scene, diagnostics)
      call read_section(deck, kind_named("guards", .false.), scene%settings%guards, diagnostics)
      call read_section(deck, kind_named("output", .false.), scene%settings%output, diagnostics)
      call join_figures(scene%settings%output%values(place_of(scene%settings%output, "figures")), diagnostics)
      call read_studies(deck, scene%settings, diagnostics)
      call read_tables(deck, scene, diagnostics)
      call list_names(scene, directory)
      call laws_from_deck(deck, scene, directory, diagnostics)
      call films_from_deck(deck, scene, directory, diagnostics)
      call worn_from_deck(deck, scene, diagnostics)
      call requests_from_deck(deck, directory, scene, diagnostics)
      if (size(scene%tables%base(table_bodies)%items) == 0 .and. diagnostics%count() == 0) then
         call diagnostics%add(location_of_end(deck), "no bodies", "a model needs at least one", "add a table [bodies]")
      end if
      call resolve_tables(directory, scene, diagnostics)
      call check_names(scene, diagnostics)
      call check_lubricants(scene, diagnostics)
      call check_space(scene, diagnostics)
      if (diagnostics%count() > 0) return
      deck%n_written = deck%defaults%n
      call finish_scene(deck, scene, diagnostics)
   end subroutine scene_from_deck

   !> From tables without errors, their references resolved, to what they mean.
   subroutine finish_scene(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck; defaults that follow from values are noted
      type(scene_t), intent(inout) :: scene               !! sections, tables, laws and films are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      call read_integration(scene%settings%dynamic%item_t, scene%settings%integration)
      scene%analysis = findloc(scene%settings%has_analysis, .true., dim=1)
      scene%title = scene%settings%header%word("title")
      scene%gravity = scene%settings%header%values(place_of(scene%settings%header, "gravity"))%vector%x
      if (scene%settings%is_spatial) then
         call new_spatial_bodies(scene%tables%base(table_bodies)%items, scene%bodies)
         call new_spatial_points(scene%tables%base(table_points)%items, scene%bodies%spatial%own, scene%points)
      else
         call new_bodies(scene%tables%base(table_bodies)%items, scene%bodies)
         call new_points(scene%tables%base(table_points)%items, scene%points)
      end if
      call new_materials(scene%tables%base(table_materials)%items, scene%materials)
      associate (items => scene%tables%base(table_lubricants)%items)
         scene%lubrication%oils = [(oil_of_row(items(k)), k=1, size(items))]
      end associate
      call make_requests(scene, diagnostics)
      call place_observables(scene, diagnostics)
      call place_states(scene, diagnostics)
      call check_meaning(deck, scene, diagnostics)
      if (diagnostics%count() == 0) call make_worn_surfaces(scene, diagnostics)
   end subroutine finish_scene

   !> One section of settings: defaults if the deck has none.
   subroutine read_section(deck, info, section, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(kind_info_t), intent(in), pointer :: info      !! keys of the section
      type(section_t), intent(out) :: section             !! what it sets
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      section%info => info
      call read_settings(deck, section%info, section%item_t, section%is_present, diagnostics)
   end subroutine read_section

   !> The sections of the analyses. The one that runs is the first that the deck has; a deck without
   !> any is a dynamic one whose section is missing.
   subroutine read_analyses(deck, sections, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(settings_t), intent(inout) :: sections         !! those of the analyses are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(kind_info_t), pointer :: info
      integer :: k

      do k = 1, n_analysis
         sections%has_analysis(k) = has_section(deck, "analysis."//trim(analysis_names(k)))
      end do
      if (.not. any(sections%has_analysis)) sections%has_analysis(analysis_dynamic) = .true.
      info => kind_named("analysis.dynamic", .false.)
      ! what the equations ask of [analysis.dynamic] has defaults in the other analyses
      if (.not. sections%has_analysis(analysis_dynamic)) then
         if (.not. allocated(equations%columns)) then
            equations = info
            equations%columns(column_of(info, "end"))%default = "0 s"
         end if
         info => equations
      end if
      call read_section(deck, info, sections%dynamic, diagnostics)
      do k = 1, size(info%columns)
         associate (column => info%columns(k))
            if (.not. allocated(column%options)) cycle
            call check_options(column%name, sections%dynamic%values(k), column%choices, column%options, diagnostics)
         end associate
      end do
      call fold_imsl_names(sections%dynamic%info, sections%dynamic%item_t, diagnostics)
      call read_section(deck, kind_named("analysis.static", .false.), sections%static, diagnostics)
      info => kind_named("analysis.kinematic", .false.)
      sections%kinematic%info => info
      if (sections%has_analysis(analysis_kinematic)) call read_section(deck, info, sections%kinematic, diagnostics)
   end subroutine read_analyses

   !> The sections of statistics and of many runs, if the deck has them; that of a comparison has defaults.
   subroutine read_studies(deck, sections, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(settings_t), intent(inout) :: sections         !! those of studies are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      call read_if_there(kind_named("statistics", .false.), sections%statistics)
      call read_if_there(kind_named("ensemble", .false.), sections%ensemble)
      call read_if_there(kind_named("life", .false.), sections%life)
      call read_section(deck, kind_named("precision", .false.), sections%precision, diagnostics)
      if (sections%precision%is_present) call check_precision(sections%precision%item_t, diagnostics)

   contains

      !> Read a section that has no values unless the deck has it.
      subroutine read_if_there(info, section)
         type(kind_info_t), intent(in), pointer :: info   !! keys of the section
         type(section_t), intent(inout) :: section        !! what it sets

         section%info => info
         if (has_section(deck, info%name)) call read_section(deck, info, section, diagnostics)
      end subroutine read_if_there

   end subroutine read_studies

   !> The tables of joints, forces and clearances.
   subroutine read_tables(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck
      type(scene_t), intent(inout) :: scene               !! tables are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      associate (base => scene%tables%base, is_spatial => scene%settings%is_spatial)
         base(table_bodies)%info => kind_named("bodies", is_spatial)
         base(table_points)%info => kind_named("points", is_spatial)
         base(table_materials)%info => kind_named("material", is_spatial)
         base(table_lubricants)%info => kind_named("lubricant", is_spatial)
         base(table_shapes)%info => kind_named("shapes", is_spatial)
      end associate
      do k = 1, n_base
         call read_items(deck, scene%tables%base(k)%info, scene%tables%base(k)%items, diagnostics)
      end do
      do k = 1, n_joint_kinds()
         scene%joints(k)%info => joint_info(k)
         call read_if_known(scene%joints(k))
      end do
      do k = 1, n_force_kinds()
         scene%forces(k)%info => force_info(k)
         call read_if_known(scene%forces(k))
      end do
      do k = 1, n_clearance_kinds()
         scene%clearances(k)%info => clearance_info(k)
         call read_if_known(scene%clearances(k))
      end do

   contains

      !> Read the rows of a kind; it has none where the scene is not of its space.
      subroutine read_if_known(table)
         type(table_t), intent(inout) :: table   !! the kind is set; rows are

         if (is_of_space(table%info, scene%settings%is_spatial)) then
            call read_items(deck, table%info, table%items, diagnostics)
         else
            allocate (table%items(0))
         end if
      end subroutine read_if_known

   end subroutine read_tables

   !> What a row of bodies or shapes, or the direction of gravity, must be in the plane or in space.
   subroutine check_space(scene, diagnostics)
      type(scene_t), intent(in) :: scene                  !! tables, references resolved
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k, n

      associate (gravity => scene%settings%header%values(place_of(scene%settings%header, "gravity")))
         if (gravity%given .and. gravity%vector%n /= merge(3, 2, scene%settings%is_spatial)) then
            call diagnostics%add(gravity%location, "gravity has "//trim(merge("three", "two  ", gravity%vector%n == 3))// &
                                 " components", "wrong number of components", &
                                 trim(merge("give three components in a spatial model", "give two components in a planar model "// &
                                    "  ", &
                                            scene%settings%is_spatial)))
         end if
      end associate
      if (diagnostics%count() > 0) return
      associate (items => scene%tables%base(table_shapes)%items)
         do k = 1, size(items)
            if (mistake_of_shape(items(k), scene%settings%is_spatial) == "") cycle
            call diagnostics%add(items(k)%location, mistake_of_shape(items(k), scene%settings%is_spatial), "in this row")
         end do
         n = 0
         do k = 1, size(items)
            if (.not. items(k)%is_given("file")) cycle
            n = n + size(items(k)%values(place_of(items(k), "file"))%table, 1)
            if (n > most_triangles) call diagnostics%add(items(k)%location, "the meshes of all shapes up to this one have "// &
                                      to_text(n)//" triangles (allowed "//to_text(most_triangles)//")", "in this row", &
                                                         "save meshes with fewer triangles")
            if (n > most_triangles) exit
         end do
      end associate
      if (.not. scene%settings%is_spatial) return
      associate (items => scene%tables%base(table_bodies)%items)
         do k = 1, size(items)
            if (mistake_of_body(items(k)) == "") cycle
            call diagnostics%add(items(k)%location, mistake_of_body(items(k)), "in this row")
         end do
      end associate
   end subroutine check_space

   !> Names of all that can be referred to, but for laws and films.
   subroutine list_names(scene, directory)
      type(scene_t), intent(in) :: scene              !! tables
      type(directory_t), intent(inout) :: directory   !! names are set

      call add_names(scene%tables%base(table_bodies)%items, directory%bodies)
      call add_names(scene%tables%base(table_points)%items, directory%points)
      call add_names(scene%tables%base(table_materials)%items, directory%materials)
      call add_names(scene%tables%base(table_lubricants)%items, directory%lubricants)
      call add_joints(scene, directory)
   end subroutine list_names

   !> Names and kinds of all joints and drivers, joints with clearance last.
   subroutine add_joints(scene, directory)
      type(scene_t), intent(in) :: scene              !! tables
      type(directory_t), intent(inout) :: directory   !! joints are set

      integer :: k, n

      n = sum([(size(scene%joints(k)%items), k=1, n_joint_kinds())])
      n = n + sum([(size(scene%clearances(k)%items), k=1, n_clearance_kinds())])
      allocate (directory%joints(n), directory%kinds(n))
      n = 0
      do k = 1, n_joint_kinds()
         call add_table(scene%joints(k))
      end do
      do k = 1, n_clearance_kinds()
         call add_table(scene%clearances(k))
      end do

   contains

      !> Those of one kind.
      subroutine add_table(table)
         type(table_t), intent(in) :: table   !! the kind and its rows

         integer :: i

         do i = 1, size(table%items)
            n = n + 1
            directory%joints(n)%s = table%items(i)%name
            directory%kinds(n)%s = table%info%name
         end do
      end subroutine add_table

   end subroutine add_joints

   !> Look up the references of all tables.
   subroutine resolve_tables(directory, scene, diagnostics)
      type(directory_t), intent(in) :: directory          !! names known
      type(scene_t), intent(inout) :: scene               !! tables, indices are set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      do k = 1, n_base
         call resolve(directory, scene%tables%base(k)%info, scene%tables%base(k)%items, diagnostics)
      end do
      do k = 1, n_joint_kinds()
         call resolve(directory, scene%joints(k)%info, scene%joints(k)%items, diagnostics)
      end do
      do k = 1, n_force_kinds()
         call resolve(directory, scene%forces(k)%info, scene%forces(k)%items, diagnostics)
      end do
      do k = 1, n_clearance_kinds()
         call resolve(directory, scene%clearances(k)%info, scene%clearances(k)%items, diagnostics)
      end do
      do k = 1, n_worn_kinds()
         call resolve(directory, scene%tables%worn(k)%info, scene%tables%worn(k)%items, diagnostics)
      end do
   end subroutine resolve_tables

end module read_scene
