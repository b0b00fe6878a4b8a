!> `gudgeon explain DECK` and `gudgeon check DECK`: what would run, without running it.
module verb_explain
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, levels_ideal, new_system
   use console, only: say
   use echo, only: all_defaults
   use errors, only: error_t
   use explain_adams, only: explain_adams_parameters
   use explain_dropped, only: say_dropped
   use explain_films, only: explain_steady_films
   use explain_floors, only: floors_of_scene
   use explain_friction, only: explain_rubbing_joints
   use explain_guards, only: say_guards
   use explain_output_times, only: explain_output_times_of
   use explain_clearances, only: explain_clearance_joints
   use explain_method, only: explain_method_and_times
   use explain_model, only: explain_notes, explain_size, explain_start
   use imsl_names, only: is_imsl_name
   use integration_settings, only: start_static
   use item, only: item_t, place_of
   use kinds, only: wp
   use kinematic_start, only: find_kinematic_start
   use load, only: check_swept_words, load_deck, loaded_t
   use mechanism, only: mechanism_t
   use mobility, only: mobility_t
   use options, only: options_t
   use precision_info, only: setting_t, settings_of
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, analysis_static, n_analysis, scene_t
   use start_state, only: find_start
   use static, only: equilibrium_t, find_equilibrium
   use text, only: counted, real_text, replace, text_t, to_text
   implicit none (type, external)
   private
   public :: check_deck, explain_deck

contains

   !> Find every error without integrating.
   subroutine check_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, or no assembly

      type(assembly_t) :: assembly
      type(loaded_t), save :: loaded
      real(wp), allocatable :: y(:)

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_swept_words(options, loaded, error)
      if (.not. allocated(error)) call find_begin(loaded, y, assembly, error)
      if (allocated(error)) return
      call say(loaded%path//": no errors; "//counted(loaded%system%linkage%bodies%n, "body", "bodies")//", "// &
               counted(loaded%system%linkage%rows%n, "constraint row", "constraint rows")//" ("//mobility_text(loaded)//"), "// &
               counted(loaded%system%clearance_joints%n, "joint with clearance", "joints with clearance")//"; assembled to "// &
               real_text(assembly%residual, 2)//" m or rad, maximum displacement of a body "//real_text(assembly%moved, 3)//" m"// &
               sweep_text(loaded)//comparison_text(loaded))
      call explain_notes(loaded%scene, loaded%system, assembly)
   end subroutine check_deck

   !> Velocities minus rows, those of drivers included, as the deck is written and with ideal joints.
   function mobility_text(loaded) result(words)
      type(loaded_t), intent(in) :: loaded     !! the deck
      character(:), allocatable :: words       !! as `mobility 3, 1 with all joints ideal`

      type(mechanism_t) :: ideal

      words = "mobility "//to_text(size(loaded%system%linkage%mass) - loaded%system%linkage%rows%n)
      if (loaded%system%clearance_joints%n == 0) return
      call new_system(loaded%scene, levels_ideal, ideal)
      words = words//", "//to_text(size(ideal%linkage%mass) - ideal%linkage%rows%n)//" with all joints ideal"
   end function mobility_text

   !> How many cases and runs a sweep of the deck has; blank if it has none.
   function sweep_text(loaded) result(words)
      type(loaded_t), intent(in) :: loaded     !! the deck
      character(:), allocatable :: words       !! as `; a sweep of 4 cases, 16 runs each`

      words = ""
      if (loaded%sweep%is_present) words = "; a sweep of "//counted(loaded%sweep%n_cases(), "case", "cases")
      if (.not. loaded%scene%settings%ensemble%is_present) return
      if (words == "") words = "; an ensemble"
      associate (n => nint(loaded%scene%settings%ensemble%number("runs")))
         words = words//", "//counted(n, "run", "runs")//" each"
      end associate
   end function sweep_text

   !> How many settings a comparison of the deck has; blank if it has none.
   function comparison_text(loaded) result(words)
      type(loaded_t), intent(in) :: loaded     !! the deck
      character(:), allocatable :: words       !! as `; a comparison of 3 settings`

      type(setting_t), allocatable :: settings(:)

      words = ""
      if (.not. loaded%scene%settings%precision%is_present) return
      associate (asked => loaded%scene%settings%precision)
         call settings_of(asked%values(place_of(asked, "methods"))%words, settings)
      end associate
      words = "; a comparison of "//counted(size(settings), "setting", "settings")
   end function comparison_text

   !> Where the analysis of the deck starts; the equilibrium of a static one.
   subroutine find_begin(loaded, y, assembly, error)
      type(loaded_t), intent(inout) :: loaded              !! the deck
      real(wp), allocatable, intent(out) :: y(:)           !! (at least 6 bodies) positions and velocities [any]
      type(assembly_t), intent(out) :: assembly            !! how it was found
      type(error_t), allocatable, intent(out) :: error     !! there is none

      type(equilibrium_t) :: equilibrium
      type(mobility_t) :: mobility
      real(wp), allocatable :: q(:), v(:)

      select case (loaded%scene%analysis)
      case (analysis_kinematic)
         call find_kinematic_start(loaded%scene, loaded%system, q, assembly, mobility, error)
         if (.not. allocated(error)) y = [q, 0.0_wp*q]
      case (analysis_static)
         call loaded%system%linkage%deck_state(q, v)
         call find_equilibrium(loaded%scene, loaded%system, q, assembly, equilibrium, error, .false.)
         if (.not. allocated(error)) y = [q, 0.0_wp*q]
      case default
         call find_start(loaded%scene, levels_as_written, loaded%system, y, assembly, error)
      end select
   end subroutine find_begin

   !> Say what is modelled and what was dropped.
   subroutine explain_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, or no assembly

      type(assembly_t) :: assembly
      type(error_t), allocatable :: start_error
      type(loaded_t), save :: loaded
      type(mechanism_t) :: twin
      type(text_t), allocatable :: defaults(:)
      real(wp), allocatable :: y(:)
      integer :: k

      call load_deck(options, loaded, error)
      if (allocated(error)) return
      call new_system(loaded%scene, levels_ideal, twin)
      call find_begin(loaded, y, assembly, start_error)
      call say(loaded%path//": "//loaded%scene%title)
      call explain_size(loaded%scene, loaded%system, twin)
      call explain_start(loaded, assembly, allocated(start_error))
      if (allocated(start_error) .and. allocated(y)) deallocate (y)
      if (.not. allocated(start_error)) call explain_notes(loaded%scene, loaded%system, assembly)
      call explain_rubbing_joints(loaded%scene, loaded%system)
      call explain_clearance_joints(loaded, y)
      if (options%legacy%with_adams) call explain_adams_parameters(loaded)
      call explain_steady_films(loaded)
      call say_dropped(loaded%scene, loaded%system)
      call explain_method_and_times(loaded)
      call explain_output_times_of(loaded)
      call say_guards(loaded)
      if (allocated(y) .and. loaded%scene%analysis == analysis_dynamic) call floors_of_scene(loaded%system, y, loaded%plan%end)
      if (len(sweep_text(loaded)) > 0) call say("'gudgeon sweep' runs"//replace(sweep_text(loaded), ";", ""))
      if (loaded%scene%settings%precision%is_present) then
         call say("'gudgeon precision' makes"//replace(comparison_text(loaded), ";", ""))
      end if
      defaults = all_defaults(loaded%deck)
      call say("")
      call say("defaults used (0 often means: none, no limit, or computed; see gudgeon help TABLE)")
      do k = 1, size(defaults)
         if (is_worth(loaded%scene, defaults(k)%s)) call say(defaults(k)%s, 2)
      end do
      if (allocated(start_error)) call move_alloc(start_error, error)
   end subroutine explain_deck

   !> Whether a default says something: not if it is an IMSL name, or a control that was given under that, or of a comparison
   !> that the deck does not ask for.
   logical function is_worth(scene, line)
      type(scene_t), intent(in) :: scene   !! the scene
      character(*), intent(in) :: line     !! `kind item key = default`

      type(item_t) :: dynamic
      integer :: k

      is_worth = scene%settings%precision%is_present .or. index(line, scene%settings%precision%info%name//" ") /= 1
      if (.not. is_worth) return
      do k = 1, n_analysis
         if (index(line, "analysis."//trim(analysis_names(k))//" ") == 0) cycle
         is_worth = k == scene%analysis .or. (k == analysis_static .and. scene%analysis == analysis_dynamic .and. &
                                              scene%settings%integration%start == start_static)
      end do
      if (.not. is_worth) return
      dynamic = scene%settings%dynamic%item_t
      call scene%settings%integration%write(dynamic)
      do k = 1, size(scene%settings%dynamic%info%columns)
         associate (name => scene%settings%dynamic%info%columns(k)%name)
            if (index(line, "analysis.dynamic "//name//" = ") == 0) cycle
            is_worth = .not. (is_imsl_name(name) .or. dynamic%values(k)%given)
         end associate
      end do
   end function is_worth

end module verb_explain
