!> `gudgeon precision DECK`: how long for how many digits, by which method, and up to what time digits mean anything.
module verb_precision
   use accurate_run, only: budget_of
   use build_info, only: compile_flags, compiler
   use console, only: say
   use csv_table, only: csv_text
   use errors, only: error_t, exit_integration, exit_usage, set_error
   use gnuplot_runs, only: draw_figures, make_folder
   use item, only: place_of
   use json_text, only: json_object_t
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use precision_file, only: write_precision
   use precision_info, only: check_setting_word
   use precision_objects, only: precision_json
   use precision_plots, only: write_precision_plots
   use precision_results, only: error_names, precision_t
   use precision_study, only: study_precision
   use precision_table, only: table_of_tol_runs
   use precision_text, only: precision_report, precision_summary
   use processor, only: processor_name
   use progress, only: progress_t
   use run_limits, only: limits_of
   use run_place, only: directory_of
   use run_plan, only: tell_origin
   use scene, only: analysis_dynamic
   use scene_echo, only: echo_scene
   use text, only: replace, split_blank, text_t
   use text_file, only: replace_file, write_file
   use text_table, only: file_heading
   use version, only: program_version
   implicit none (type, external)
   private
   public :: compare_precision

contains

   !> Compare the settings that the deck, or the command line, names.
   subroutine compare_precision(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors, no directory, or no run came to its end

      type(loaded_t), save :: loaded
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(precision_t) :: study
      type(progress_t) :: display
      type(text_t), allocatable :: pictures(:), warnings(:), words(:)
      character(:), allocatable :: path

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(options, loaded, words, error)
      if (allocated(error)) return
      path = directory_of(options, loaded)
      if (.not. allocated(options%directory)) path = path//"_precision"
      call directory%open(path, error)
      if (allocated(error)) return
      warnings = directory%warnings
      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      call make_plan(options, loaded, directory%path, plan)
      call begin_study(options, loaded, study)
      call display%start(.not. options%is_quiet)
      call study_precision(loaded%job_t, words, display, study, error)
      call display%finish()
      if (allocated(error)) then
         call directory%close()
         return
      end if
      call write_results(loaded, plan, study, pictures, warnings, error)
      if (.not. allocated(error)) call report(options, loaded, plan, study, pictures, warnings, error)
      if (.not. allocated(error) .and. study%reference%what == "") then
         call set_error(error, exit_integration, "no run was completed; "//directory%path//"/precision.txt gives the reasons")
      end if
      call directory%close()
   end subroutine compare_precision

   !> What is compared must be a motion, and the words must name settings.
   subroutine check_request(options, loaded, words, error)
      type(options_t), intent(in) :: options                  !! the command line
      type(loaded_t), intent(in) :: loaded                    !! the deck
      type(text_t), allocatable, intent(out) :: words(:)      !! (n) settings compared
      type(error_t), allocatable, intent(out) :: error        !! what is wrong

      character(:), allocatable :: hint, message
      integer :: k

      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "the comparison needs [analysis.dynamic] as the first analysis section of the deck")
         return
      end if
      words = loaded%scene%settings%precision%values(place_of(loaded%scene%settings%precision, "methods"))%words
      if (allocated(options%methods)) words = split_blank(replace(options%methods, ",", " "))
      if (size(words) == 0) call set_error(error, exit_usage, "option --methods needs settings, as ""verner rk4""")
      do k = 1, size(words)
         call check_setting_word(words(k)%s, message, hint)
         if (message == "") cycle
         call set_error(error, exit_usage, message//" in --methods"//new_line("a")//"  = "//hint)
         return
      end do
   end subroutine check_request

   !> What the study is asked, and where it runs.
   subroutine begin_study(options, loaded, study)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(precision_t), intent(out) :: study              !! asked, not started

      associate (asked => loaded%scene%settings%precision)
         study%budget = budget_of(options, loaded)
         study%accuracy = asked%number("accuracy")
         if (options%digits%accuracy > 0.0_wp) study%accuracy = options%digits%accuracy
         study%wanted = findloc(error_names == asked%word("error"), .true., dim=1)
      end associate
      study%machine%processor = processor_name()
      study%machine%compiler = compiler
      study%machine%flags = compile_flags
   end subroutine begin_study

   !> What the files say of the comparison.
   subroutine make_plan(options, loaded, path, plan)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: path                     !! directory
      type(output_plan_t), intent(out) :: plan             !! the plan

      plan%directory = path
      plan%title = loaded%scene%title
      call tell_origin(options, loaded, plan)
      call plan%complete()
   end subroutine make_plan

   !> The files and figures.
   subroutine write_results(loaded, plan, study, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(precision_t), intent(in) :: study                     !! results
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      call write_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene), error)
      if (.not. allocated(error)) call write_precision(plan, study, error)
      if (.not. allocated(error)) call replace_file(plan%directory//"/precision.csv", csv_text(table_of_tol_runs(study)), error)
      if (.not. allocated(error)) then
         call replace_file(plan%directory//"/precision.txt", precision_report(study, plan%title), error)
      end if
      if (allocated(error)) return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (allocated(error)) return
      call write_precision_plots(folder, plan%title, file_heading(plan), study, names, error)
      if (.not. allocated(error)) call draw_figures(folder, names, pictures, warnings)
   end subroutine write_results

   !> The summaries.
   subroutine report(options, loaded, plan, study, pictures, warnings, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_plan_t), intent(in) :: plan              !! what files say
      type(precision_t), intent(in) :: study               !! results
      type(text_t), intent(in) :: pictures(:)              !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)              !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      type(json_object_t) :: json
      character(:), allocatable :: object, text
      integer :: k

      text = precision_summary(study, plan%title)//"output     "//plan%directory//"/"//new_line("a")// &
             "           precision.txt and .csv (every run), precision.h5"//new_line("a")
      do k = 1, size(pictures)
         text = text//"           "//pictures(k)%s//new_line("a")
      end do
      do k = 1, size(warnings)
         text = text//"warning: "//warnings(k)%s//new_line("a")
      end do
      call json%start(0)
      call json%put_text("program", "gudgeon "//program_version)
      call json%put_text("deck", loaded%path)
      call json%put_text("title", loaded%scene%title)
      call json%put_text("directory", plan%directory)
      call precision_json(study, json)
      call json%put_list("figures", pictures)
      call json%put_list("warnings", warnings)
      object = json%get()
      call replace_file(plan%directory//"/summary.txt", text, error)
      if (.not. allocated(error)) call replace_file(plan%directory//"/summary.json", object//new_line("a"), error)
      if (options%is_json) then
         call say(object)
      else if (.not. options%is_quiet) then
         call say(text(:len(text) - 1))
      end if
   end subroutine report

end module verb_precision
