!> The dynamic level of `gudgeon tolerance`: each member is a run of the deck, or several from the starts of its ensemble.
module dynamic_level
   use changed_deck, only: forget_parameter
   use console, only: say
   use dynamic_runs, only: cases_of_design, collect_runs, make_runs
   use dynamic_setup, only: set_up_numbers
   use errors, only: error_t
   use kinds, only: wp
   use load, only: loaded_t
   use members, only: stamp_of
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use posix, only: own_path
   use run_design, only: new_design, run_design_t
   use run_place, only: directory_of
   use scene, only: analysis_dynamic, analysis_names
   use simulated_study, only: take_runs
   use sweep_journal, only: origin_of_sweep_t
   use sweep_start, only: is_of, tell_changes
   use sweep_work, only: origin_of_sweep, sweep_work_t
   use text, only: append_text, text_t, to_text
   use tolerance_files, only: write_study
   use tolerance_report, only: note_runs, report_tolerances
   use tolerance_results, only: tolerance_study_t
   use tolerance_setup, only: check_sampling
   implicit none (type, external)
   private
   public :: study_runs

contains

   !> Make the study of a deck whose plan is read and settled.
   subroutine study_runs(options, loaded, study, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck, of its dynamic analysis
      type(tolerance_study_t), intent(inout) :: study      !! its plan is known
      type(error_t), allocatable, intent(out) :: error     !! nothing is asked, a file cannot be written, the nominal case failed

      type(options_t) :: member
      type(origin_of_sweep_t) :: origin
      type(output_directory_t) :: directory
      type(run_design_t) :: design
      type(sweep_work_t) :: work
      type(text_t), allocatable :: warnings(:)
      character(:), allocatable :: path, program, stamp
      integer :: k

      program = own_path()
      stamp = stamp_of(program)
      member = options
      member%change%analysis = trim(analysis_names(analysis_dynamic))
      call set_up_numbers(loaded, study, member%runs%observed, error)
      if (.not. allocated(error)) call check_sampling(study, starts_of(loaded), error)
      if (allocated(error)) return
      call new_design(study, starts_of(loaded), design)
      call cases_of_design(study, design, loaded)
      path = directory_of(options, loaded)
      if (options%runs%shard > 0) path = path//".shards/"//to_text(options%runs%shard)//"-of-"//to_text(options%runs%n_shards)
      origin = origin_of_sweep(options, loaded)
      do k = 1, size(study%plan%parameters)   ! what the command line gives them is nominal
         call forget_parameter(member, study%plan%parameters(k)%name)
      end do
      call directory%open(path, error, goes_on=is_of(path, origin))
      if (allocated(error)) return
      warnings = directory%warnings
      call make_runs(member, loaded, directory, origin, work, error)
      if (.not. allocated(error)) call tell_changes(program, stamp, warnings)
      if (.not. allocated(error) .and. options%runs%shard > 0) then
         if (.not. options%is_quiet) call say("part "//to_text(options%runs%shard)//" of "//to_text(options%runs%n_shards)// &
            " done: "//to_text(work%n_mine())//" runs in "//path//"; the study without --shard takes them from there")
      else if (.not. allocated(error)) then
         call conclude(options, loaded, design, work, study, warnings, error)
      end if
      call directory%close()
   end subroutine study_runs

   !> Starts of each case.
   integer function starts_of(loaded) result(n)
      type(loaded_t), intent(in) :: loaded   !! the deck

      n = 1
      if (loaded%scene%settings%ensemble%is_present) n = nint(loaded%scene%settings%ensemble%number("runs"))
   end function starts_of

   !> The study of the runs, its files and summaries.
   subroutine conclude(options, loaded, design, work, study, warnings, error)
      type(options_t), intent(in) :: options                    !! the command line
      type(loaded_t), intent(inout) :: loaded                   !! the deck; defaults are noted
      type(run_design_t), intent(in) :: design                  !! the cases
      type(sweep_work_t), intent(in) :: work                    !! their runs
      type(tolerance_study_t), intent(inout) :: study           !! the study
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (n) grown
      type(error_t), allocatable, intent(out) :: error          !! the nominal case failed, or a file cannot be written

      type(output_plan_t) :: plan
      type(text_t), allocatable :: pictures(:)
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call collect_runs(study, design, work, values, is_failed, warnings, error)
      if (allocated(error)) return
      call take_runs(study, design, loaded%plan%end, values, is_failed)
      study%cpu_members = sum([work%results%runs%cpu(2)])
      call note_runs(study, warnings)
      plan = work%plan
      call write_study(loaded, plan, study, pictures, warnings, error)
      if (.not. allocated(error)) call report_tolerances(options, loaded, plan, study, pictures, warnings, error, &
                                                         work%results)
   end subroutine conclude

end module dynamic_level
