!> gudgeon: mechanisms whose joints are not perfect. Reads the command line, prints errors, sets the exit code.
program gudgeon
   use, intrinsic :: ieee_arithmetic, only: ieee_set_underflow_mode, ieee_support_underflow_control
   use blas_threads, only: use_one_blas_thread
   use console, only: write_said
   use errors, only: error_t, exit_different, exit_ok, exit_stopped
   use kinds, only: wp
   use options, only: options_t, read_options
   use posix, only: write_error
   use processes, only: begin_process, end_process
   use study_verbs, only: make_study
   use text, only: starts_with
   use verb_explain, only: check_deck, explain_deck
   use verb_compare, only: compare_runs
   use verb_import, only: import_model
   use verb_help, only: list_kinds, show_help, show_version
   use verb_merge, only: merge_sweep
   use verb_new, only: new_deck
   use verb_run, only: run_deck
   use verb_sweep, only: sweep_deck
   implicit none (type, external)

   type(error_t), allocatable :: console_error, error
   type(options_t) :: options

   call begin_process()
   call use_one_blas_thread(error)
   ! Forces that fade along a chain below the least normal number are zero: some processors take a hundred times as long there.
   if (ieee_support_underflow_control(1.0_wp)) call ieee_set_underflow_mode(gradual=.false.)
   if (.not. allocated(error)) call read_options(options, error)
   if (.not. allocated(error)) then
      select case (options%verb)
      case ("run")
         call run_deck(options, error)
      case ("check")
         call check_deck(options, error)
      case ("explain")
         call explain_deck(options, error)
      case ("sweep")
         call sweep_deck(options, error)
      case ("merge")
         call merge_sweep(options, error)
      case ("life", "sensitivity", "orbit", "modes", "fit", "tolerance", "precision")
         call make_study(options, error)
      case ("compare")
         call compare_runs(options, error)
      case ("import")
         call import_model(options, error)
      case ("new")
         call new_deck(options, error)
      case ("list")
         call list_kinds(options, error)
      case ("version")
         call show_version()
      case default
         call show_help(options, error)
      end select
   end if
   call write_said(console_error)
   if (allocated(console_error) .and. .not. allocated(error)) call move_alloc(console_error, error)
   if (allocated(error)) then
      if (all(error%code /= [exit_different, exit_stopped]) .and. .not. starts_with(error%message, "error: ")) &
         error%message = "error: "//error%message
      call write_error(error%message//new_line("a"))
      call end_process(error%code)
   end if
   call end_process(exit_ok)
end program gudgeon
