!> Keeps a run: run.h5, time histories, events, figures, summary, as its plan says.
!>
!> The order: deck.echo and the files' headings at the start, data during the run, then the figures,
!> and summary.json as the last. After a failure of the analysis `finish` keeps all that was recorded;
!> after a failed write nothing more is written to that file, and what it holds stays readable.
module run_recorder
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use csv_files, only: write_csv_files
   use channels, only: selection_t
   use errors, only: error_t, exit_file, set_error
   use event_list, only: event_list_t
   use extremes, only: extremes_t, joint_extremes_t, joints_at_extremes
   use drawn_rows, only: drawn_rows_t
   use figure_needs, only: missing_films
   use figure_words, only: figure_t
   use final_values, only: add_finals
   use film_fields, only: append_field, film_field_t
   use frames, only: frame_keeper_t
   use hot_films, only: films_too_hot
   use hdf5_writer, only: hdf5_writer_t
   use kinds, only: i8, wp
   use member_result, only: member_result_t
   use memory_purpose, only: memory_is_for
   use missing_statistics, only: statistics_without_numbers
   use motion_writer, only: motion_name, motion_writer_t
   use output_plan, only: output_plan_t
   use progress, only: progress_t
   use recorder, only: event_t, recorder_t, row_instant, row_jump, row_onset, row_stop, status_complete, status_stopped, summary_t
   use run_tables, only: tables_of_run
   use saved_run, only: saved_run_t
   use scene_poses, only: pose_reader_t
   use statistics, only: statistics_t
   use summary_writer, only: complete_summary, outcome_t
   use text, only: append_text, text_t, to_text
   use text_writer, only: text_writer_t
   use worn_files, only: write_worn_files
   implicit none (type, external)
   private
   public :: append_all, join_errors, run_recorder_t

   !> When a run was looked after, and how long it takes from one instant at which it can be saved to the next.
   type :: pace_t
      integer :: n_step = 0                !! steps since the clock was looked at
      integer(i8) :: saved_at = 0          !! when it was saved, or started [ms]
      integer(i8) :: could_save_at = 0     !! when it could be saved last [ms]
      integer(i8) :: longest = 0           !! time between two such instants [ms]
      integer(i8) :: cost = 0              !! time that it takes to save it [ms]
   end type pace_t

   !> The recorder. Set `plan` and `figures` before `start`.
   type, extends(recorder_t) :: run_recorder_t
      type(output_plan_t) :: plan                             !! what to keep, and where
      type(figure_t), allocatable :: figures(:)               !! (n) figures of the run, then those of a sweep that it is of
      type(drawn_rows_t) :: rows                              !! what they draw
      type(drawn_rows_t) :: ideal_rows                        !! the same of the reference run with ideal joints
      type(catalogue_t), allocatable, private :: items        !! what the run can report, for the figures
      type(selection_t), private :: selection                 !! what of it is kept
      type(event_list_t), private :: events                   !! all events
      type(hdf5_writer_t), private :: hdf5                    !! run.h5
      type(motion_writer_t), private :: motion                !! the motion for other programs
      type(text_writer_t), private :: texts                   !! time histories and events.dat
      type(pose_reader_t), private :: reader                  !! what the motion for other programs reads
      type(frame_keeper_t), private :: keeper                 !! pictures of the motion, for figures
      type(progress_t), private :: display                    !! how far the run is
      type(statistics_t), private :: statistics               !! what is gathered for the statistics
      type(extremes_t), private :: extremes                   !! what the channels go through
      type(film_field_t), allocatable, private :: fields(:)   !! (any) films that were asked for
      real(wp), private :: last_time = 0.0_wp                 !! time of the last sample [s]
      logical, private :: has_started = .false.               !! files were made
      type(summary_t), private :: summary                     !! of the run, once it is finished
      type(outcome_t), private :: outcome                     !! what it left behind
      type(pace_t), private :: pace                           !! when it is to be saved
      logical, private :: is_broken = .false.                 !! a file could not be written
   contains
      procedure :: start => start_run
      procedure :: wants => run_wants
      procedure :: sample => sample_run
      procedure :: further_row => further_row_run
      procedure :: between => between_rows
      procedure :: poincare => poincare_run
      procedure :: field => field_run
      procedure :: event => event_run
      procedure :: progress => progress_run
      procedure :: finish => finish_run
      procedure :: requested_action => action_of_run
      procedure :: save => save_run
      procedure :: go_on => go_on_with_run
      procedure :: forget => forget_checkpoint
      procedure :: conclude => conclude_run
      procedure :: result => result_of_run
   end type run_recorder_t

   interface
      !> Whether the run is to be saved or to end: signals, the time of the wall, and what the plan says.
      module integer function action_of_run(self, can_save) result(requested_action)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder
         logical, intent(in) :: can_save                    !! the run can be saved after this step
      end function action_of_run

      !> Write all that waits, and the checkpoint.
      module subroutine save_run(self, saved, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder
         type(saved_run_t), intent(inout) :: saved          !! what the run remembers; the recorder's is added
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine save_run

      !> Take back what was remembered, and take over the files.
      module subroutine go_on_with_run(self, saved, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder, started
         type(saved_run_t), intent(inout) :: saved          !! what was remembered
         type(error_t), allocatable, intent(out) :: error   !! the files are not as they were
      end subroutine go_on_with_run

      !> The run is complete: its checkpoint is of no use.
      module subroutine forget_checkpoint(self)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder
      end subroutine forget_checkpoint

      !> Write the summaries and show what is requested of them.
      module subroutine write_summary(self, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder, its run finished
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine write_summary

      !> Make the figures.
      module subroutine draw_figures(self, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine draw_figures

      !> The summaries of a run that ends while its figures are made: they are replaced when those are there.
      module subroutine write_without_figures(self, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder, its run finished
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine write_without_figures
   end interface

   interface
      !> Make the files.
      module subroutine start_run(self, catalogue, error)
         implicit none (type, external)
         class(run_recorder_t), intent(inout) :: self       !! the recorder
         type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be made
      end subroutine start_run

      !> Whether files, figures or statistics read the value of a quantity of an item. A dataset of run.h5 holds all items
      !> of its room that appear.
      module pure logical function run_wants(self, group, item) result(wants)
         implicit none (type, external)
         class(run_recorder_t), intent(in) :: self          !! the recorder, started
         integer, intent(in) :: group                       !! its group in the catalogue
         integer, intent(in) :: item                        !! number of the item in the group's room
      end function run_wants
   end interface

contains

   !> Keep the current values.
   subroutine sample_run(self, t, catalogue, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      type(error_t), allocatable :: second

      call keep_row(self, t, row_instant, catalogue, error)
      if (self%keeper%is_wanted) call self%keeper%sample(t, catalogue)
      call self%motion%sample(t, catalogue, second)
      if (allocated(second)) self%is_broken = .true.
      call join_errors(error, second)
      if (size(self%extremes%channels) > 0) call self%extremes%sample(t, catalogue)
      call self%statistics%sample(t, catalogue)
   end subroutine sample_run

   !> Keep the current values as those of an instant of a contact, or of the end of the run.
   subroutine further_row_run(self, t, kind, catalogue, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what it is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      if (self%plan%with%contact_rows .or. kind == row_stop) then
         call keep_row(self, t, kind, catalogue, error)
         if (self%keeper%is_wanted) call self%keeper%follow(t, catalogue)
      end if
      call self%extremes%note(t, catalogue)
      call self%statistics%note_extremes(t, catalogue)
   end subroutine further_row_run

   !> Note the extremes of an instant between rows.
   subroutine between_rows(self, t, catalogue)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t

      call self%extremes%note(t, catalogue)
      call self%statistics%note_extremes(t, catalogue)
   end subroutine between_rows

   !> A row of the time histories.
   subroutine keep_row(self, t, kind, catalogue, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what it is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      type(error_t), allocatable :: second

      self%last_time = t
      if (self%plan%with%hdf5) call self%hdf5%sample(t, kind, catalogue, self%events, error)
      if (self%plan%with%texts) call self%texts%sample(t, kind, catalogue, self%events, second)
      call join_errors(error, second)
      if (allocated(error)) self%is_broken = .true.
      call self%rows%sample(t, catalogue)
   end subroutine keep_row

   !> Keep the current values as those of an instant once per period.
   subroutine poincare_run(self, t, catalogue)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t

      call self%statistics%poincare(t, catalogue)
   end subroutine poincare_run

   !> Keep a film.
   subroutine field_run(self, field)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      type(film_field_t), intent(in) :: field            !! pressures and gaps

      call append_field(self%fields, field)
   end subroutine field_run

   !> Two failures in one.
   subroutine join_errors(error, second)
      type(error_t), allocatable, intent(inout) :: error   !! the first, takes both
      type(error_t), allocatable, intent(inout) :: second  !! the other

      if (.not. allocated(second)) return
      if (allocated(error)) then
         error%message = error%message//new_line("a")//second%message
      else
         call move_alloc(second, error)
      end if
   end subroutine join_errors

   !> Keep an event; it is written with the next block of samples.
   subroutine event_run(self, event, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      type(event_t), intent(in) :: event                 !! what happened
      type(error_t), allocatable, intent(out) :: error   !! there is no memory for it

      logical :: is_added

      call self%events%add(event, is_added)
      if (is_added) return
      self%is_broken = .true.
      call set_error(error, exit_file, "not enough memory for more than "//to_text(self%events%n)//" events (ulimit -v); the "// &
                     "results so far are saved. Raise the limit, or end the run earlier.")
   end subroutine event_run

   !> Show how far the run is.
   subroutine progress_run(self, fraction)
      class(run_recorder_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: fraction              !! of the work done [1]

      call self%display%update(fraction)
   end subroutine progress_run

   !> Finish the files; make the figures and the summary too, unless that is asked for later.
   subroutine finish_run(self, summary, error)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      type(error_t), allocatable :: second
      type(joint_extremes_t), allocatable :: joints(:)
      type(text_t), allocatable :: files(:)
      integer :: k

      call self%display%finish()
      if (.not. self%has_started) return
      call memory_is_for("the statistics and the sorted list of "//to_text(self%events%n)//" events")
      self%summary = complete_summary(summary)
      if (.not. self%plan%with%contact_rows) self%summary%count%rows(row_onset:row_jump) = 0
      call self%keeper%finish()
      associate (outcome => self%outcome, full => self%summary)
         outcome%numbers = self%statistics%numbers(self%items, self%events, full%worn, full%time_end)
         call add_finals(self%statistics, self%items, outcome%numbers)
         call self%extremes%find_noise(self%items, self%plan%mass)
         do k = 1, size(outcome%numbers)
            outcome%numbers(k)%noise = self%extremes%noise_in(outcome%numbers(k)%unit)
         end do
         call joints_at_extremes(self%items, self%events, full%time_start, full%time_end, joints)
         outcome%tables = tables_of_run(self%plan, full, self%statistics, outcome%numbers, self%extremes, joints, self%items, &
                                        self%events)
         allocate (outcome%pictures(0), outcome%warnings(0), outcome%files(0), outcome%csv(0), outcome%solids(0))
         call append_all(outcome%warnings, [self%plan%warnings, full%warnings])
         if (allocated(self%wants_fields)) call append_all(outcome%warnings, missing_films(self%wants_fields, self%fields))
         call append_all(outcome%warnings, films_too_hot(self%extremes, self%items))
         call append_all(outcome%warnings, statistics_without_numbers(self%statistics, self%items, full%time_end))
         if (self%plan%with%hdf5 .and. size(self%extremes%channels) > 0 .and. .not. self%extremes%has_rows()) then
            call append_text(outcome%warnings, "the time histories are empty: the run ended before their start")
         end if
         if (self%plan%with%hdf5) then
            call self%hdf5%finish(full, self%events, outcome%tables, self%fields, outcome%warnings, error)
         end if
         if (self%plan%with%texts) then
            call self%texts%finish(self%last_time, self%events, second)
            call join_errors(error, second)
            outcome%files = self%texts%names
         end if
         if (self%plan%with%csv .and. .not. allocated(error)) then
            files = outcome%files
            call append_text(files, "events.dat")
            call write_csv_files(self%plan%directory, files, outcome%csv, error)
         end if
         if (.not. allocated(error)) call write_worn_files(self%plan, full%worn, outcome%csv, outcome%solids, error)
         call self%motion%finish(full%status, second)
         call join_errors(error, second)
         if (self%plan%with%motion) call append_text(outcome%files, motion_name)
      end associate
      self%is_broken = self%is_broken .or. allocated(error)
      if (self%plan%life%is_concluded_later) then
         call write_without_figures(self, second)
      else
         call self%conclude(second)
      end if
      call join_errors(error, second)
   end subroutine finish_run

   !> Make the figures of a run that was finished, write and show the summary.
   subroutine conclude_run(self, error, warning)
      class(run_recorder_t), intent(inout) :: self       !! the recorder
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      character(*), intent(in), optional :: warning      !! what is to be known besides

      type(error_t), allocatable :: second

      if (.not. self%has_started) return
      if (present(warning)) then
         if (len(warning) > 0) call append_text(self%outcome%warnings, warning)
      end if
      if (self%plan%with%figures .and. self%summary%status == status_stopped) then
         call append_text(self%outcome%warnings, "figures are drawn after a complete run")
      else if (self%plan%with%figures .and. .not. self%is_broken) then
         call draw_figures(self, error)
      end if
      call write_summary(self, second)
      call join_errors(error, second)
      if (self%summary%status == status_complete .and. .not. allocated(error)) call self%forget()
      self%has_started = .false.
   end subroutine conclude_run

   !> What a sweep needs to know of the run; of one that never started, nothing.
   subroutine result_of_run(self, member)
      class(run_recorder_t), intent(in) :: self            !! the recorder, finished
      type(member_result_t), intent(inout) :: member       !! those lists are set that there are

      integer :: k

      if (.not. allocated(self%outcome%numbers)) return
      member%numbers = self%outcome%numbers
      member%warnings = self%outcome%warnings
      associate (n => self%statistics%n_poincare, channels => self%statistics%channels)
         if (n == 0) return
         allocate (member%poincare_names(size(channels)))
         do k = 1, size(channels)
            member%poincare_names(k)%s = scalar_name(self%items, channels(k))
         end do
         member%poincare_times = self%statistics%poincare_times(:n)
         member%poincare_samples = self%statistics%poincare_samples(:size(channels), :n)
      end associate
   end subroutine result_of_run

   !> Append a list to a list.
   subroutine append_all(list, more)
      type(text_t), allocatable, intent(inout) :: list(:)  !! (any) grown
      type(text_t), intent(in) :: more(:)                  !! (any) what is appended

      integer :: k

      do k = 1, size(more)
         call append_text(list, more(k)%s)
      end do
   end subroutine append_all

end module run_recorder
