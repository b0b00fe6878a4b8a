!> The runs of the dynamic level: a sweep through the cases of a design, in parallel, with its journal and its parts.
!>
!> What an earlier study of the same deck into the same directory has run is taken from its journal, and so is what parts of it have
!> (`--shard I/N`, each into DIR.shards/I-of-N); the rest is run.
module dynamic_runs
   use errors, only: error_t, exit_integration, set_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dimension_text, only: unit_text
   use kinds, only: wp
   use load, only: loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use posix, only: list_directory, remove_within
   use recorder, only: status_complete
   use run_design, only: run_design_t
   use sweep_journal, only: differences, journal_t, origin_of_sweep_t
   use sweep_runs, only: run_all
   use sweep_start, only: begin_sweep
   use sweep_work, only: failure_text, runs_folder, sweep_work_t, take_journal, write_results
   use text, only: append_text, exact_text, text_t, to_text
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: cases_of_design, collect_runs, make_runs

contains

   !> The cases of a design as those of a sweep, instead of those of the deck.
   subroutine cases_of_design(study, design, loaded)
      type(tolerance_study_t), intent(in) :: study    !! the study
      type(run_design_t), intent(in) :: design        !! the cases
      type(loaded_t), intent(inout) :: loaded         !! the deck; its sweep is set

      integer :: k, m

      loaded%sweep%is_present = .true.
      loaded%sweep%is_paired = .true.
      loaded%sweep%keeps_channels = .false.
      if (allocated(loaded%sweep%parameters)) deallocate (loaded%sweep%parameters)
      allocate (loaded%sweep%parameters(size(study%plan%parameters)))
      do k = 1, size(study%plan%parameters)
         associate (parameter => study%plan%parameters(k), swept => loaded%sweep%parameters(k))
            swept%name = parameter%name
            swept%unit = unit_text(parameter%dimension)
            swept%numbers = parameter%nominal + design%deviations(k, :)
            allocate (swept%texts(size(swept%numbers)))
            do m = 1, size(swept%numbers)
               swept%texts(m)%s = exact_text(swept%numbers(m))
               if (swept%unit /= "1") swept%texts(m)%s = swept%texts(m)%s//swept%unit
            end do
         end associate
      end do
   end subroutine cases_of_design

   !> Make the runs that are not done.
   subroutine make_runs(options, loaded, directory, origin, work, error)
      type(options_t), intent(in) :: options                 !! the command line, with the channels that runs observe
      type(loaded_t), intent(in) :: loaded                   !! the deck, with the cases
      type(output_directory_t), intent(inout) :: directory   !! of the study
      type(origin_of_sweep_t), intent(in) :: origin          !! what the runs are of
      type(sweep_work_t), intent(inout) :: work              !! the runs
      type(error_t), allocatable, intent(out) :: error       !! a process cannot be started, or a file not be written

      type(text_t) :: no_channels(0)
      integer :: ignored

      call begin_sweep(options, loaded, directory%path, origin, work, error)
      if (.not. allocated(error) .and. work%shard == 0) call take_parts(directory%path, origin, work, error)
      if (.not. allocated(error)) call run_all(options, loaded, directory, work, error)
      if (.not. allocated(error) .and. work%shard == 0) then
         call write_results(work, status_complete, failure_text(work), no_channels, error)
      end if
      if (.not. allocated(error)) call work%journal%end(error)
      ignored = remove_within(work%plan%directory, runs_folder(2:)//"/")
   end subroutine make_runs

   !> Take the runs of parts of the same study, and note them in the journal.
   subroutine take_parts(path, origin, work, error)
      character(*), intent(in) :: path                   !! directory of the study
      type(origin_of_sweep_t), intent(in) :: origin      !! what its runs are of
      type(sweep_work_t), intent(inout) :: work          !! the runs
      type(error_t), allocatable, intent(out) :: error   !! the journal cannot be written

      type(journal_t) :: part
      type(text_t), allocatable :: names(:)
      integer :: code, i, k

      call list_directory(path//".shards", names, code)
      if (code /= 0) return
      do k = 1, size(names)
         if (index(names(k)%s, "/") /= len(names(k)%s)) cycle
         associate (folder => path//".shards/"//names(k)%s(:len(names(k)%s) - 1))
            call part%read(folder)
            if (.not. part%is_there) cycle
            if (differences(part%origin, origin) /= "") cycle
            do i = 1, size(part%runs)
               if (.not. allocated(error)) call work%journal%add(part%runs(i), error)
            end do
            call take_journal(work, part, folder)
         end associate
      end do
   end subroutine take_parts

   !> Values of all requests in all runs. One that has no value of a request counts as failed.
   subroutine collect_runs(study, design, work, values, is_failed, warnings, error)
      type(tolerance_study_t), intent(in) :: study                !! the study
      type(run_design_t), intent(in) :: design                    !! the cases
      type(sweep_work_t), intent(in) :: work                      !! the runs
      real(wp), allocatable, intent(out) :: values(:, :, :)       !! (requests, starts, cases) values; of failed runs zero [any]
      logical, allocatable, intent(out) :: is_failed(:, :)        !! (starts, cases) runs that failed
      type(text_t), allocatable, intent(inout) :: warnings(:)     !! (n) grown
      type(error_t), allocatable, intent(out) :: error            !! the nominal case failed

      integer :: at(size(study%requests)), case, k, n_without, r, start

      do r = 1, size(at)
         at(r) = 0
         do k = 1, size(work%results%names)
            if (work%results%names(k)%s == study%requests(r)%name) at(r) = k
         end do
      end do
      allocate (values(size(at), design%n_start, size(design%deviations, 2)), source=0.0_wp)
      allocate (is_failed(design%n_start, size(design%deviations, 2)), source=.true.)
      n_without = 0
      do case = 1, size(is_failed, 2)
         do start = 1, design%n_start
            associate (run => work%results%runs((case - 1)*design%n_start + start))
               if (run%exit_code /= 0) cycle
               is_failed(start, case) = any(at == 0 .or. at > size(run%numbers))
               if (.not. is_failed(start, case)) is_failed(start, case) = .not. all(ieee_is_finite(run%numbers(at)))
               if (is_failed(start, case)) n_without = n_without + 1
               if (.not. is_failed(start, case)) values(:, start, case) = run%numbers(at)
            end associate
         end do
      end do
      if (any(is_failed(:, 1))) then
         call set_error(error, exit_integration, "the nominal mechanism failed: "//reason())
      else if (n_without > 0) then
         call append_text(warnings, to_text(n_without)//" of "//to_text(size(is_failed))//" runs have no value of a request, "// &
                          "as an impact speed without impacts: they count as failed")
      end if

   contains

      !> Why a run of the nominal case failed.
      function reason() result(words)
         character(:), allocatable :: words   !! one line

         integer :: i

         words = "a request has no value"
         do i = 1, design%n_start
            if (work%results%runs(i)%exit_code /= 0) words = work%results%runs(i)%message
         end do
      end function reason

   end subroutine collect_runs

end module dynamic_runs
