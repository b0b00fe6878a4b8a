!> From a deck to a scene: reads every table, looks up names, checks what tables cannot say of themselves.
module read_scene
   use bodies, only: bodies_info, material_info, new_bodies, new_materials, new_points, points_info
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use columns, only: cell_index, cell_text, column_of, find_column
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use deck_reader, only: check_sections, has_section, read_items, read_settings
   use deck_types, only: add_default, deck_t, location_of_end
   use diagnostics, only: diagnostics_t
   use force_registry, only: n_force_kinds
   use guard_info, only: guards_info
   use imsl_names, only: fold_imsl_names
   use item, only: item_t
   use joint_registry, only: n_joint_kinds
   use kind_info, only: kind_info_t
   use kind_list, only: all_kinds, clearance_info, force_info, friction_info, joint_info, law_info
   use kinds, only: wp
   use name_table, only: name_table_t
   use normal_law, only: n_law_parameter
   use option_check, only: check_options
   use read_functions, only: functions_from_deck
   use references, only: add_names, directory_t, resolve
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, friction_slot_t, law_slot_t, &
      n_analysis, n_base, scene_t, table_bodies, table_materials, table_points
   use section_info, only: dynamic_info, kinematic_info, output_info, scene_info, static_info
   use study_info, only: ensemble_info, statistics_info
   use surfaces, only: shape_face, surfaces_t
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: scene_from_deck

   character(*), parameter :: reserved = " ground none energy events summary ideal "
      !! words that no item may have as its name

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
      call add_names(scene%joints(1)%items, directory%revolutes)
      call read_laws(deck, scene, directory, diagnostics)
      if (size(scene%base(table_bodies)%items) == 0 .and. diagnostics%count() == 0) then
         call diagnostics%add(location_of_end(deck), "no bodies", "a scene needs at least one", "add a table [bodies]")
      end if
      call resolve_tables(directory, scene, diagnostics)
      call check_names(scene, diagnostics)
      if (diagnostics%count() > 0) return

      scene%title = scene%header%values(1)%text
      scene%gravity(1:2) = scene%header%values(3)%vector(1:2)
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

   !> Rows whose names stand in a list already.
   subroutine report_doubled(items, names, diagnostics)
      type(item_t), intent(in) :: items(:)                !! rows
      type(text_t), intent(in) :: names(:)                !! names taken
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      type(name_table_t) :: table
      integer :: k

      if (size(items) == 0) return
      call table%list(names)
      do k = 1, size(items)
         if (table%find(items(k)%name) == 0) cycle
         call diagnostics%add(items(k)%location, "name '"//items(k)%name//"' is used twice", &
                              "the name of another item already", "names of one sort must differ")
      end do
   end subroutine report_doubled

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

   !> Names must be unique among everything that has channels, and must not be reserved words.
   subroutine check_names(scene, diagnostics)
      type(scene_t), intent(in) :: scene                  !! tables
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      type(text_t), allocatable :: names(:)
      integer :: k

      allocate (names(0))
      call look(scene%base(table_bodies)%items)
      do k = 1, n_joint_kinds
         call look(scene%joints(k)%items)
      end do
      do k = 1, n_force_kinds
         call look(scene%forces(k)%items)
      end do
      do k = 1, n_clearance_kinds
         call look(scene%clearances(k)%items)
      end do
      associate (points => scene%base(table_points)%items)
         do k = 1, size(points)
            if (points(k)%name == "none") call report_reserved(points(k))
         end do
      end associate

   contains

      !> Check the names of a table against all earlier ones.
      subroutine look(items)
         type(item_t), intent(in) :: items(:)  !! rows

         integer :: i

         call report_doubled(items, names, diagnostics)
         do i = 1, size(items)
            if (index(reserved, " "//items(i)%name//" ") > 0) call report_reserved(items(i))
         end do
         call add_names(items, names)
      end subroutine look

      !> A reserved word was taken as a name.
      subroutine report_reserved(item)
         type(item_t), intent(in) :: item  !! the row

         call diagnostics%add(item%location, "name '"//item%name//"' is reserved", "choose another name", &
                              "reserved:"//reserved)
      end subroutine report_reserved

   end subroutine check_names

   !> What rows of tables cannot say of themselves: joints of a body with itself, journals that do not fit.
   subroutine check_meaning(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                 !! the deck; lengths of the start are noted as defaults
      type(scene_t), intent(in) :: scene                  !! the scene
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      class(clearance_set_t), allocatable :: set
      character(:), allocatable :: help, message
      integer :: column, i, k

      do k = 1, n_joint_kinds
         if (scene%joints(k)%info%columns(1)%name == "joint") cycle
         do i = 1, size(scene%joints(k)%items)
            call check_pair(scene%joints(k)%info, scene%joints(k)%items(i))
            call check_start_length(scene%joints(k)%info, scene%joints(k)%items(i))
         end do
      end do
      do k = 1, n_force_kinds
         if (scene%forces(k)%info%columns(1)%name /= "i") cycle
         do i = 1, size(scene%forces(k)%items)
            call check_pair(scene%forces(k)%info, scene%forces(k)%items(i))
         end do
      end do
      do k = 1, n_clearance_kinds
         call new_clearance_set(k, set)
         do i = 1, size(scene%clearances(k)%items)
            call check_pair(scene%clearances(k)%info, scene%clearances(k)%items(i))
            associate (item => scene%clearances(k)%items(i))
               call set%mistake(item, column, message, help)
               if (column == 0) call check_law(scene, scene%clearances(k)%info, item, set, column, message, help)
               if (column == 0) cycle
               call diagnostics%add(item%values(column)%location, message, "does not fit", help)
            end associate
         end do
      end do

   contains

      !> The two points of a joint or spring must belong to different bodies, and two bodies must differ.
      subroutine check_pair(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         character(:), allocatable :: group, name
         integer :: body(2), end

         do end = 1, 2
            body(end) = item%values(end)%index
            if (info%columns(end)%refers_to == "points") body(end) = scene%points%body(body(end))
         end do
         if (body(1) /= body(2)) return
         name = "ground"
         if (body(1) > 0) name = scene%bodies%names(body(1))%s
         group = "joint"
         if (index(info%name, "force.") == 1) group = "force"
         call diagnostics%add(item%values(2)%location, group//" '"//item%name//"' ties '"//name//"' to itself", &
                              "the same body", "columns "//info%columns(1)%name//" and "//info%columns(2)%name// &
                              " must name two bodies or points of them")
      end subroutine check_pair

      !> A length that is left out is the distance of the points at the start, which must not coincide.
      subroutine check_start_length(info, item)
         type(kind_info_t), intent(in) :: info  !! the kind
         type(item_t), intent(in) :: item       !! the row

         real(wp), parameter :: least = 1.0e-9_wp  ! distance that counts as none, of the points' coordinates [1]
         real(wp) :: length, p(3, 2)
         integer :: c, end

         c = find_column(info, "length")
         if (c == 0) return
         if (item%values(c)%given) return
         do end = 1, 2
            p(:, end) = start_position(scene, item%values(end)%index)
         end do
         length = norm2(p(:, 2) - p(:, 1))
         if (length > least*maxval(abs(p))) then
            call add_default(deck, info%name//" "//item%name//" length = "//to_text(length)//" m, the distance at the start")
            return
         end if
         call diagnostics%add(item%values(2)%location, "joint '"//item%name//"' has no length", &
                              "the two points coincide at the start", "give the column length, or move the bodies")
      end subroutine check_start_length

   end subroutine check_meaning

   !> The normal law of a loose joint must fit its surfaces.
   subroutine check_law(scene, info, item, set, column, message, help)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(kind_info_t), intent(in) :: info               !! the geometry
      type(item_t), intent(in) :: item                    !! the row
      class(clearance_set_t), intent(in) :: set           !! any set of the geometry
      integer, intent(out) :: column                      !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message   !! what is wrong
      character(:), allocatable, intent(out) :: help      !! what would be right

      type(kind_info_t) :: law_info
      type(surfaces_t) :: pair
      real(wp) :: parameters(n_law_parameter)
      integer :: face_law

      column = 0
      message = ""
      help = ""
      if (cell_text(info, item, "level") == "ideal") return
      call set%describe(item, scene%materials, pair)
      call scene%laws(cell_index(info, item, "law"))%law%fit(pair, parameters, message, help)
      if (message /= "") column = column_of(info, "law")
      if (column > 0) return
      face_law = cell_index(info, item, "face_law")
      if (face_law == 0) return
      pair%shape = shape_face
      associate (law => scene%laws(face_law)%law)
         law_info = law%info()
         call law%fit(pair, parameters, message, help)
         if (law_info%name /= "contact.plane_face") then
            message = "'"//law%name//"' is no law of a plane face"
            help = "name a row of contact.plane_face"
         end if
      end associate
      if (message /= "") column = column_of(info, "face_law")
   end subroutine check_law

   !> Where the deck puts a point at the start.
   pure function start_position(scene, point) result(p)
      type(scene_t), intent(in) :: scene  !! the scene
      integer, intent(in) :: point        !! the point
      real(wp) :: p(3)                    !! (3) its position, world frame [m]

      real(wp) :: c, s

      p = scene%points%s(:, point)
      associate (body => scene%points%body(point))
         if (body == 0) return
         c = cos(scene%bodies%angle(body))
         s = sin(scene%bodies%angle(body))
         p = scene%bodies%r(:, body) + [c*p(1) - s*p(2), s*p(1) + c*p(2), p(3)]
      end associate
   end function start_position

end module read_scene
