!> Runs that are stopped and continue: what their options go together with, the proof that it makes no difference.
module restart_run
   use errors, only: error_t, exit_different, exit_usage, set_error
   use hdf5_equal, only: compare_files
   use integrator, only: integrator_t
   use kinds, only: i8, wp
   use load, only: loaded_t
   use options, only: options_t
   use scene, only: analysis_dynamic, analysis_names
   use standard_output, only: print_text
   use text, only: to_text
   implicit none (type, external)
   private
   public :: check_restart, check_schedule, compare_restarted

contains

   !> What the options go together with.
   subroutine check_restart(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what they do not go together with

      character(:), allocatable :: option

      option = ""
      if (options%restart%is_resumed) option = "--resume"
      if (options%restart%walltime > 0.0_wp) option = "--walltime"
      if (options%restart%is_verified) option = "--verify-restart"
      if (option == "") return
      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option "//option//" needs [analysis.dynamic]; the analysis of this deck is "// &
                        trim(analysis_names(loaded%scene%analysis)))
      else if (options%digits%accuracy > 0.0_wp) then
         call set_error(error, exit_usage, "options "//option//" and --accuracy exclude each other: --accuracy makes several "// &
                        "runs and does not save them"//new_line("a")//"  = run with the tolerance that --accuracy chooses: "// &
                        "--tolerance X "//option)
      else if (options%restart%is_verified .and. options%restart%is_resumed) then
         call set_error(error, exit_usage, "options --verify-restart and --resume exclude each other: --verify-restart starts "// &
            "a new run")
      else if (options%restart%is_verified .and. loaded%is_stream) then
         call set_error(error, exit_usage, "option --verify-restart reads the deck several times, but "//loaded%path// &
                        " can be read only once")
      end if
   end subroutine check_restart

   !> Runs that can be saved at some instants only need such instants where an option would have them saved.
   subroutine check_schedule(options, loaded, method, n_part, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      class(integrator_t), intent(in) :: method            !! the integrator
      integer, intent(in) :: n_part                        !! groups of bodies that are integrated apart
      type(error_t), allocatable, intent(out) :: error     !! the deck sets no such instants

      if (.not. options%restart%is_verified .and. options%restart%walltime <= 0.0_wp) return
      if (loaded%plan%checkpoint > 0.0_wp .or. .not. (method%begins_anew() .or. n_part > 1)) return
      call set_error(error, exit_usage, "this run can be saved only at times set in the deck: "// &
                     trim(merge("its groups of bodies take separate steps       ", &
                                "its integration method keeps an unsaved history", n_part > 1))//new_line("a")// &
                     "  = add to [analysis.dynamic]: checkpoint = 0.1 s, or checkpoint = 1 turns of a driver")
   end subroutine check_schedule

   !> Compare a run with one that was stopped and continued several times.
   subroutine compare_restarted(one, other, n_restart, is_quiet, error)
      character(*), intent(in) :: one                        !! directory of the run
      character(*), intent(in) :: other                      !! directory of that with restarts
      integer, intent(in) :: n_restart                       !! how many
      logical, intent(in) :: is_quiet                        !! nothing is said if they are equal
      type(error_t), allocatable, intent(out) :: error       !! they are not equal

      character(:), allocatable :: difference
      integer(i8) :: n

      call compare_files(one//"/run.h5", other//"/run.h5", "/provenance", n, difference)
      if (difference /= "") then
         call set_error(error, exit_different, "a run with "//to_text(n_restart)//" restarts differs from the run without: "// &
                        difference//new_line("a")//"  = both are kept: "//one//" and "//other)
      else if (.not. is_quiet) then
         call print_text("restart    "//to_text(n)//" numbers and texts of run.h5 are equal bit for bit after "// &
                         to_text(n_restart)//" restarts"//new_line("a"), error)
      end if
   end subroutine compare_restarted

end module restart_run
