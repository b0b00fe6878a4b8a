!> What a run of a deck is to write and to say: the plan that its recorder follows.
module run_plan
   use assembly_report, only: assembly_t
   use blas_threads, only: blas_kernels
   use branches, only: find_doubts
   use build_info, only: compile_flags, compiler, git_sha1
   use channel_names, only: scalar_t
   use channels, only: find_scalars, item_finder_t
   use deck_texts, only: deck_text, get_includes
   use drawn_figures, only: plan_drawn_figures
   use figure_binding, only: bind_figure
   use figure_phrase, only: mistake_t
   use figure_words, only: append_figure, figure_t, is_of_run
   use item, only: place_of
   use kinds, only: i8, wp
   use libraries, only: library_versions
   use load, only: loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t, show_json, show_nothing
   use plausibility, only: find_notes
   use row_plan, only: contact_rows_text, has_contact_rows
   use scene, only: analysis_dynamic, analysis_names, analysis_static
   use scene_drawing, only: drawing_of_scene
   use scene_echo, only: echo_scene
   use start_state, only: redundancy_text
   use statistics, only: statistics_plan_t
   use text, only: append_text, real_text, text_t, to_text
   use text_list, only: text_list_t
   use time_plan, only: last_instant
   use version, only: program_version
   implicit none (type, external)
   private
   public :: make_plan, tell_origin

   real(wp), parameter :: negligible = 1.0e-6_wp  !! change of a given velocity that is not worth a word [1]

contains

   !> What the recorder is reported.
   subroutine make_plan(options, loaded, directory, assembly, plan, figures)
      type(options_t), intent(in) :: options       !! the command line
      type(loaded_t), intent(in) :: loaded         !! the deck
      type(output_directory_t), intent(in) :: directory  !! of the run
      type(assembly_t), intent(in) :: assembly     !! how the start was found
      type(output_plan_t), intent(out) :: plan     !! the plan
      type(figure_t), allocatable, intent(out) :: figures(:)   !! (n) figures of the run, bound; those of a sweep last

      logical :: is_drawn

      plan%warnings = directory%warnings
      plan%directory = directory%path
      call tell_origin(options, loaded, plan)
      if (options%write /= "nothing") plan%origin%deck_echo = echo_scene(loaded%deck, loaded%scene)
      plan%title = loaded%scene%title
      plan%moved = assembly%moved
      if (loaded%scene%analysis /= analysis_static) plan%n_instant = last_instant(loaded%plan) + 1_i8
      plan%n_freedom = size(loaded%system%linkage%mass) - loaded%system%linkage%rows%n
      plan%mass = minval(loaded%system%linkage%mass(1, :))  ! the first rate of a body is of its place
      if (allocated(assembly%dependent)) plan%n_freedom = plan%n_freedom + size(assembly%dependent)
      call plan_statistics(options, loaded, plan%statistics)
      call find_known_words(loaded, plan, figures)
      if (assembly%rate_changed > negligible*(1.0_wp + maxval(abs(loaded%scene%bodies%v)))) then
         call append_text(plan%warnings, "inconsistent initial velocity: that of body '"// &
                          loaded%scene%bodies%names(assembly%changed_body)%s// &
                          "' violates the constraints and was changed by "//real_text(assembly%rate_changed, 3)//" m/s")
      end if
      if (loaded%system%linkage%solution%is_redundant) call append_text(plan%warnings, redundancy_text(loaded%system, assembly))
      call find_doubts(loaded%system%linkage, plan%warnings)
      call find_notes(loaded%scene, loaded%system, assembly, plan%notes)
      plan%with%contact_rows = has_contact_rows(loaded%scene, loaded%system)
      plan%contact_rows = contact_rows_text(loaded%scene, loaded%system)
      plan%with%hdf5 = options%write /= "nothing"
      plan%with%summary = options%write /= "nothing"
      plan%with%histories = options%write == "all" .or. options%write == "channels"
      plan%with%texts = options%write == "all"
      plan%with%figures = options%write == "all"
      plan%with%report = loaded%scene%settings%output%flag("report") .and. options%write == "all"
      plan%with%csv = options%write == "all" .and. (options%is_csv .or. loaded%scene%settings%output%flag("csv"))
      if (options%write == "all") plan%with%worn_stl = loaded%scene%settings%output%number("worn_stl")
      plan%with%motion = loaded%scene%settings%output%word("motion") /= "off" .and. options%write == "all"
      if (plan%with%figures .and. loaded%scene%analysis /= analysis_static) then
         call plan_drawn_figures(figures, loaded%scene, loaded%system, loaded%plan, plan%looks%frames)
      end if
      is_drawn = plan%with%motion
      if (allocated(plan%looks%frames%wanted)) is_drawn = is_drawn .or. size(plan%looks%frames%wanted) > 0
      if (is_drawn) call drawing_of_scene(loaded%scene, plan%looks%drawing)
      call tell_left_out(options, loaded, plan%warnings)
      if (loaded%sweep%is_present .and. options%write == "all") then
         call append_text(plan%warnings, "the deck has a sweep of "//to_text(loaded%sweep%n_cases())// &
                          " cases; this run uses the parameters of the deck ('gudgeon sweep' runs the cases)")
      end if
      if (options%is_json) plan%show = show_json
      if (options%is_quiet) then
         plan%with%progress = .false.
         plan%with%warnings = .false.
         if (.not. options%is_json) plan%show = show_nothing
      end if
   end subroutine make_plan

   !> What is asked for and has no place in this run.
   subroutine tell_left_out(options, loaded, warnings)
      type(options_t), intent(in) :: options                    !! the command line
      type(loaded_t), intent(in) :: loaded                      !! the deck
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grows

      character(:), allocatable :: motion, reason

      associate (settings => loaded%scene%settings)
         if (options%write /= "all" .and. .not. options%runs%is_member) then
            reason = " omitted: --write "//options%write
            motion = settings%output%word("motion")
            if (motion /= "off") call append_text(warnings, "motion = "//motion//reason)
            if (options%is_csv .or. settings%output%flag("csv")) call append_text(warnings, "csv"//reason)
            if (settings%output%number("worn_stl") > 0.0_wp) call append_text(warnings, "worn_stl"//reason)
            if (settings%output%flag("report")) call append_text(warnings, "report"//reason)
         end if
         if (loaded%scene%analysis == analysis_dynamic) return
         reason = " not used: not available in a "//trim(analysis_names(loaded%scene%analysis))//" analysis"
         if (settings%statistics%is_present) call append_text(warnings, "section [statistics]"//reason)
         if (settings%guards%is_present) call append_text(warnings, "section [guards]"//reason)
         if (settings%ensemble%is_present) call append_text(warnings, "section [ensemble]"//reason)
      end associate
   end subroutine tell_left_out

   !> Which deck, program and command the results are of.
   subroutine tell_origin(options, loaded, plan)
      type(options_t), intent(in) :: options       !! the command line
      type(loaded_t), intent(in) :: loaded         !! the deck
      type(output_plan_t), intent(inout) :: plan   !! its origin is set, but for the deck's echo

      integer :: k

      plan%origin%deck_name = loaded%path
      plan%origin%deck_text = deck_text(loaded%deck)
      plan%origin%program_version = program_version
      plan%origin%git_sha1 = git_sha1
      plan%origin%compiler = compiler
      plan%origin%libraries = library_versions()
      plan%origin%command = options%command
      plan%origin%flags = compile_flags
      plan%origin%kernels = blas_kernels()
      plan%origin%choices = "--write "//options%write
      if (options%change%member > 0) plan%origin%choices = plan%origin%choices//" --member "//to_text(options%change%member)
      if (options%digits%with_horizon) plan%origin%choices = plan%origin%choices//" --horizon"
      plan%life%begun = options%restart%begun
      plan%life%walltime = options%restart%walltime
      call get_includes(loaded%deck, plan%origin%include_names, plan%origin%include_texts)
      allocate (plan%origin%parameter_names(loaded%deck%symbols%n_parameter))
      do k = 1, loaded%deck%symbols%n_parameter
         plan%origin%parameter_names(k)%s = loaded%deck%symbols%list(k)%name
      end do
      plan%origin%parameter_texts = loaded%deck%parameter_text(:loaded%deck%symbols%n_parameter)
   end subroutine tell_origin

   !> What the deck asks of the statistics of a motion.
   subroutine plan_statistics(options, loaded, plan)
      type(options_t), intent(in) :: options          !! the command line, or what a study makes of it
      type(loaded_t), intent(in) :: loaded            !! the deck
      type(statistics_plan_t), intent(out) :: plan    !! what is asked for

      associate (settings => loaded%scene%settings%statistics)
         plan%has_finals = allocated(options%runs%observed)
         plan%is_wanted = (settings%is_present .or. plan%has_finals) .and. loaded%scene%analysis == analysis_dynamic
         if (.not. plan%is_wanted) return
         plan%after = loaded%plan%after
         plan%end = loaded%plan%end
         plan%period = loaded%plan%period
         if (plan%has_finals) plan%channels = options%runs%observed
         if (.not. settings%is_present) return
         plan%bins = nint(settings%number("bins"))
         if (plan%has_finals) return
         plan%channels = settings%values(place_of(settings, "channels"))%words
         plan%spectra = settings%values(place_of(settings, "spectra"))%words
      end associate
   end subroutine plan_statistics

   !> The deck's channels and figures, without those that the joints taken as ideal do not have.
   subroutine find_known_words(loaded, plan, figures)
      type(loaded_t), intent(in) :: loaded                      !! the deck
      type(output_plan_t), intent(inout) :: plan                !! channels are set, what is dropped becomes warnings
      type(figure_t), allocatable, intent(out) :: figures(:)    !! (n) figures, those of a sweep last

      type(figure_t) :: figure
      type(item_finder_t) :: finder
      type(mistake_t), allocatable :: mistake
      type(scalar_t), allocatable :: scalars(:)
      type(text_list_t) :: list
      character(:), allocatable :: hint, message, reason
      integer :: k, pass

      reason = "' omitted: the joint is ideal"
      if (loaded%scene%analysis /= analysis_dynamic) then
         reason = "' omitted: not available in a "//trim(analysis_names(loaded%scene%analysis))//" analysis"
      end if
      call finder%start(loaded%catalogue)
      associate (words => loaded%scene%settings%output%values(place_of(loaded%scene%settings%output, "channels"))%words)
         do k = 1, size(words)
            call find_scalars(words(k)%s, loaded%catalogue, finder, scalars, message, hint)
            if (len(message) == 0) call list%add(words(k)%s)
            if (len(message) > 0) call append_text(plan%warnings, "channel '"//words(k)%s//reason)
         end do
      end associate
      plan%channels = list%get()
      allocate (figures(0))
      do pass = 1, 2
         do k = 1, size(loaded%figures)
            figure = loaded%figures(k)
            if (is_of_run(figure) .neqv. pass == 1) cycle
            call bind_figure(figure, loaded%catalogue, mistake)
            if (allocated(mistake)) then
               call append_text(plan%warnings, "figure '"//figure%word//reason)
            else
               call append_figure(figures, figure)
            end if
         end do
      end do
   end subroutine find_known_words

end module run_plan
