!> From a deck on disk to a scene, its system and its times; every error of the deck in one error.
module load
   use build_clearances, only: has_ideal
   use build_system, only: levels_as_written, levels_ideal, levels_clearance_joints, new_system
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use change_scene, only: scene_with_changes
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use errors, only: error_t, exit_usage, set_error
   use drawn_figures, only: check_drawn_figures
   use figure_words, only: figure_t
   use fit_plan, only: fit_plan_t
   use fit_words, only: plan_fit
   use formula_words, only: read_formulas
   use function_range, only: check_function_ranges
   use item, only: item_t
   use jobs, only: job_t
   use life_times, only: check_life
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use mechanism_catalogue, only: build_catalogue
   use memory_purpose, only: memory_is_for
   use modes_results, only: modes_plan_t
   use modes_words, only: plan_modes
   use name_table, only: name_table_t
   use option_changes, only: apply_options, choose_analysis
   use options, only: options_t
   use orbit_info, only: orbit_section
   use orbit_results, only: orbit_plan_t
   use orbit_words, only: plan_orbit
   use parameter_change, only: change_parameters
   use read_fit, only: has_fit
   use read_scene, only: scene_from_deck
   use read_tolerance, only: has_tolerances
   use run_limits, only: check_conditions, has_conditions
   use run_profiles, only: set_profile_reader
   use sensitivity_info, only: sensitivity_section
   use sensitivity_results, only: sensitivity_plan_t
   use sensitivity_words, only: plan_sensitivity
   use settings, only: has_section, read_settings
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, scene_t, table_formulas
   use step_check, only: check_steps
   use study_info, only: sweep_info
   use sweep_values, only: read_sweep
   use swept, only: sweep_t
   use text, only: append_text, to_text
   use time_plan, only: new_time_plan
   use tolerance_words, only: check_tolerances
   use word_checks, only: check_words, read_figures
   use worn_file, only: read_worn_file
   implicit none (type, external)
   private
   public :: check_swept_words, find_catalogue, load_case, load_deck, loaded_t

   !> A section [sensitivity].
   type :: sensitivity_request_t
      logical :: is_present = .false.             !! the deck has it
      type(item_t) :: keys                        !! its keys
      type(sensitivity_plan_t) :: plan            !! what it asks for
   end type sensitivity_request_t

   !> A section [orbit].
   type :: orbit_request_t
      logical :: is_present = .false.             !! the deck has it
      type(item_t) :: keys                        !! its keys
      type(orbit_plan_t) :: plan                  !! what it asks for
   end type orbit_request_t

   !> A deck that is ready to run.
   type, extends(job_t) :: loaded_t
      character(:), allocatable :: path           !! of the deck
      type(deck_t) :: deck                        !! its text and parameters
      type(mechanism_t) :: system             !! its equations
      type(catalogue_t), allocatable :: catalogue !! what they can report; of a case of a sweep none until it is requested
      type(figure_t), allocatable :: figures(:)   !! (n) its figures, as its words ask for them
      type(sweep_t) :: sweep                      !! its cases
      type(sensitivity_request_t) :: sensitivity  !! derivatives by parameters, if the deck asks for any
      type(orbit_request_t) :: orbit              !! periodic orbits, if it asks for any
      logical :: is_stream = .false.              !! the deck came through a pipe and cannot be read again
   end type loaded_t

contains

   !> Load the deck that is the verb's operand.
   subroutine load_deck(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck; what it was before is gone
      type(error_t), allocatable, intent(out) :: error     !! errors of the command line or the deck

      type(diagnostics_t) :: mistakes

      call forget(loaded)
      if (size(options%operands) /= 1) then
         call set_error(error, exit_usage, "'gudgeon "//options%verb//"' needs one deck: gudgeon "//options%verb// &
                        " FILE.deck")
         return
      end if
      loaded%path = options%operands(1)%s
      call memory_is_for("the deck "//loaded%path)
      call set_profile_reader(read_worn_file)
      call read_deck(loaded%path, options%change%overrides, loaded%deck, mistakes)
      loaded%is_stream = loaded%deck%sources(1)%is_stream
      if (mistakes%count() == 0) call scene_from_deck(loaded%deck, loaded%scene, mistakes)
      if (mistakes%count() == 0 .and. .not. options%runs%is_member) then
         call read_sweep(loaded%deck, sweep_info(), loaded%sweep, mistakes)
         if (has_section(loaded%deck, "sensitivity")) then
            call read_settings(loaded%deck, sensitivity_section(), loaded%sensitivity%keys, loaded%sensitivity%is_present, mistakes)
         end if
         if (has_section(loaded%deck, "orbit")) then
            call read_settings(loaded%deck, orbit_section(), loaded%orbit%keys, loaded%orbit%is_present, mistakes)
         end if
      end if
      call mistakes%to_error(loaded%deck%sources, error)
      if (.not. allocated(error)) call prepare(options, loaded, error)
   end subroutine load_deck

   !> Forget a deck. Here alone: whoever calls a procedure with such an `intent(out)` has the code that takes a deck apart.
   subroutine forget(loaded)
      type(loaded_t), intent(out) :: loaded   !! new

   end subroutine forget

   !> Load the deck once more with other parameters: what they do not stand in is not read again. It is the very same as if all of
   !> it were (`load_deck`), which is done where words or settings change, and where there are errors, to report these in full.
   subroutine load_case(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line, but for `--set` that of before
      type(loaded_t), intent(inout) :: loaded              !! the deck as it was loaded before
      type(error_t), allocatable, intent(out) :: error     !! errors of the parameters

      logical :: is_done
      logical, allocatable :: is_touched(:)

      is_done = .not. allocated(options%legacy%way)
      if (is_done) call change_parameters(loaded%deck, options%change%overrides, is_touched, is_done)
      if (is_done) call scene_with_changes(loaded%deck, is_touched, loaded%scene, is_done)
      if (is_done) then
         call prepare(options, loaded, error)
         is_done = .not. allocated(error)
      end if
      if (.not. is_done) call load_deck(options, loaded, error)
   end subroutine load_case

   !> From a scene to its system, its times and what it can report.
   subroutine prepare(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! deck and scene are known; the rest is set
      type(error_t), allocatable, intent(out) :: error     !! errors of the command line or the deck

      type(catalogue_t) :: catalogue
      type(diagnostics_t) :: mistakes
      logical :: has_all_words

      call memory_is_for("the equations of "//to_text(size(loaded%scene%bodies%names))//" bodies and their output")
      if (.not. allocated(loaded%figures)) call read_figures(loaded%deck, loaded%scene, loaded%figures, mistakes)
      has_all_words = runs_as_written(options, loaded%scene)
      if (.not. has_all_words) call list_words(loaded%deck, loaded%scene, catalogue, mistakes)
      call choose_analysis(options, loaded%scene, error)
      if (allocated(error)) return
      call apply_options(options, loaded%scene, error)
      if (allocated(error)) return
      loaded%levels = merge(levels_ideal, levels_as_written, loaded%scene%analysis == analysis_kinematic)
      call new_system(loaded%scene, loaded%levels, loaded%system)
      if (allocated(loaded%catalogue)) deallocate (loaded%catalogue)
      if (needs_catalogue(options, loaded%scene)) call find_catalogue(loaded)
      if (size(loaded%scene%tables%requests(table_formulas)%items) > 0) then
         if (has_all_words) call read_formulas(loaded%deck, loaded%catalogue, loaded%scene, mistakes)
         loaded%system%requests%formulas = loaded%scene%requests%formulas
         call build_catalogue(loaded%system, loaded%catalogue)
      end if
      call check_steps(loaded%scene%settings%integration, mistakes)
      call new_time_plan(loaded%scene, loaded%system, loaded%plan, mistakes)
      if (loaded%scene%settings%life%is_present) call check_life(loaded%scene, loaded%system, mistakes)
      if (.not. options%runs%is_member) then
         if (has_all_words) then
            call check_studies(loaded%deck, loaded%scene, loaded%system, loaded%catalogue, mistakes)
         else
            call check_studies(loaded%deck, loaded%scene, loaded%system, catalogue, mistakes)
         end if
      end if
      if (mistakes%count() == 0) call check_function_ranges(loaded%scene, loaded%plan%end, mistakes)
      if (has_all_words) then
         if (.not. options%runs%has_known_words) then
            call check_words(loaded%deck, loaded%scene, loaded%figures, loaded%sweep, loaded%plan%end, loaded%catalogue, mistakes)
         end if
         if (has_conditions(loaded%scene)) call check_conditions(loaded%scene, loaded%catalogue, mistakes)
         if (loaded%sensitivity%is_present .and. loaded%scene%analysis == analysis_dynamic) then
            call plan_sensitivity(loaded%deck, loaded%sensitivity%keys, loaded%system, loaded%catalogue, &
                                  merge(huge(1.0_wp), loaded%plan%end, options%verb == "run"), loaded%sensitivity%plan, &
                                  mistakes)  ! a run may be shorter than what [sensitivity] asks for
         end if
         if (loaded%orbit%is_present .and. loaded%scene%analysis == analysis_dynamic) then
            call plan_orbit(loaded%deck, loaded%orbit%keys, loaded%system, loaded%orbit%plan, mistakes)
         end if
      else
         call check_words(loaded%deck, loaded%scene, loaded%figures, loaded%sweep, loaded%plan%end, catalogue, mistakes)
         call check_conditions(loaded%scene, catalogue, mistakes)
      end if
      if (mistakes%count() == 0 .and. .not. options%runs%is_member) then  ! which draws none
         call check_drawn_figures(loaded%figures, loaded%scene, loaded%system, loaded%plan, mistakes)
      end if
      call mistakes%to_error(loaded%deck%sources, error)
   end subroutine prepare

   !> Check the tables of studies: each checks its own.
   subroutine check_studies(deck, scene, system, catalogue, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(scene_t), intent(in) :: scene              !! its scene
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(catalogue_t), intent(in) :: catalogue      !! all that it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(fit_plan_t) :: fit
      type(modes_plan_t) :: modes
      type(scalar_t), allocatable :: sensors(:)

      if (has_section(deck, "modes")) call plan_modes(deck, scene, system, catalogue, modes, mistakes)
      if (has_fit(deck)) call plan_fit(deck, catalogue, fit, sensors, mistakes)
      if (has_tolerances(deck)) call check_tolerances(deck, scene, catalogue, mistakes)
   end subroutine check_studies

   !> Whether words must be looked up to load a deck: of a case of a sweep whose words are known only expressions and conditions.
   logical function needs_catalogue(options, scene)
      type(options_t), intent(in) :: options  !! the command line
      type(scene_t), intent(in) :: scene      !! the scene of the deck

      needs_catalogue = .not. (options%runs%is_member .and. options%runs%has_known_words)
      if (needs_catalogue) return
      needs_catalogue = size(scene%tables%requests(table_formulas)%items) > 0 .or. has_conditions(scene)
   end function needs_catalogue

   !> Find what a loaded deck can report, unless that is done.
   subroutine find_catalogue(loaded)
      type(loaded_t), intent(inout) :: loaded   !! the deck

      if (allocated(loaded%catalogue)) return
      allocate (loaded%catalogue)
      call build_catalogue(loaded%system, loaded%catalogue)
   end subroutine find_catalogue

   !> Whether the run has all that a deck can have words for: it is the deck's first analysis, and no joint is taken as ideal.
   logical function runs_as_written(options, scene)
      type(options_t), intent(in) :: options  !! the command line
      type(scene_t), intent(in) :: scene      !! the scene of the deck

      runs_as_written = .not. (options%change%is_ideal .or. scene%analysis == analysis_kinematic .or. &
                              has_ideal(scene, levels_as_written))
      if (allocated(options%change%analysis)) then
         runs_as_written = runs_as_written .and. options%change%analysis == analysis_names(scene%analysis)
      end if
   end function runs_as_written

   !> What a deck can have words for: channels and figures of clearance joints and of its first analysis, whatever a run has of
   !> them.
   subroutine list_words(deck, scene, catalogue, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(scene_t), intent(inout) :: scene           !! its scene; expressions over channels are understood
      type(catalogue_t), intent(out) :: catalogue     !! all that it can report
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(mechanism_t) :: clearance_joints

      call new_system(scene, levels_clearance_joints, clearance_joints)
      call build_catalogue(clearance_joints, catalogue)
      if (size(scene%tables%requests(table_formulas)%items) == 0) return
      call read_formulas(deck, catalogue, scene, mistakes)
      clearance_joints%requests%formulas = scene%requests%formulas
      call build_catalogue(clearance_joints, catalogue)
   end subroutine list_words

   !> Every word that a sweep gives to a parameter must make a deck without errors, the other parameters being the deck's own.
   subroutine check_swept_words(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck with one of the words

      type(loaded_t), save :: other
      type(options_t) :: case
      type(name_table_t) :: table
      integer :: i, k, previous

      do k = 1, size(loaded%sweep%parameters)
         associate (parameter => loaded%sweep%parameters(k))
            if (parameter%unit /= "") cycle
            call table%start(size(parameter%texts))
            do i = 1, size(parameter%texts)
               call table%enter(parameter%texts(i)%s, i, previous)
               if (previous > 0) cycle
               case = options
               case%runs%is_member = .true.
               call append_text(case%change%overrides, parameter%name//"="//parameter%texts(i)%s)
               call load_deck(case, other, error)
               if (allocated(error)) return
            end do
         end associate
      end do
   end subroutine check_swept_words

end module load
