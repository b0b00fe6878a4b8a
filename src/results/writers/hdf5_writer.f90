!> Writes run.h5 (layout: hdf5_layout.f90 and docs/reference/output.md).
!>
!> Rows wait in memory until there is a block of them, or until ten seconds have passed; then they
!> are written and the file is flushed. Its metadata goes to the disk in an order in which it never
!> points to rows that are not there (ordered_file.c), the length of /time as the last: a run that is
!> killed, whenever, leaves a readable file with whole rows. Before a block is written its space on the
!> disk is reserved: a full disk is noticed before the file is touched, and what it held stays whole.
module hdf5_writer
   use catalogue, only: catalogue_t
   use channels, only: selection_t
   use errors, only: error_t, exit_file, set_error
   use checksum, only: seal_file, survives
   use event_list, only: event_list_t
   use film_fields, only: film_field_t
   use hdf5, only: h5dclose_f, h5fclose_f, h5fflush_f, h5gclose_f, h5f_scope_local_f, hid_t, hsize_t
   use hdf5_attributes, only: text_attribute
   use hdf5_calls, only: is_memory_short, new_file, new_group, open_file, open_library
   use hdf5_copy, only: copy_rows
   use hdf5_datasets, only: text_dataset
   use hdf5_events, only: event_table_t
   use hdf5_fields, only: bytes_of_fields, write_fields
   use hdf5_layout, only: dataset_t, make_quantities, make_root, make_row_kind, make_time, rows_of_block, write_status
   use hdf5_probe, only: file_can_be_read, row_sums_t
   use hdf5_rows, only: write_rows, write_states
   use hdf5_scales, only: add_scale, close_scales, scales_t
   use hdf5_table, only: bytes_of_table, write_tables
   use horizon_table, only: table_of_digits, table_of_horizon
   use kinds, only: i8, wp
   use output_marker, only: enter_file, note_files
   use output_plan, only: output_plan_t
   use provenance, only: make_provenance
   use posix, only: path_exists, release_space, remove_file, rename_path, reserve_space, sync_path, system_message
   use recorder, only: status_failed, summary_t
   use result_table, only: result_table_t
   use archive, only: archive_t
   use table_list, only: list_of
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: hdf5_writer_t

   integer(i8), parameter :: metadata_of_dataset = 8192_i8     !! bytes that the index of a dataset may grow by
   integer(i8), parameter :: metadata_of_file = 131072_i8      !! bytes for all else
   real(wp), parameter :: longest_wait = 10.0_wp               !! time after which rows are written anyway [s]

   !> The open file.
   type :: hdf5_writer_t
      private
      character(:), allocatable :: path                !! where it is
      integer(hid_t) :: file = -1                      !! the open file
      integer(hid_t) :: time = -1                      !! the open dataset of times
      type(dataset_t) :: kinds                         !! what each row is
      type(dataset_t), allocatable :: datasets(:)      !! (n) quantities
      type(event_table_t) :: events                    !! table of events
      real(wp), allocatable :: times(:)                !! (block) times of the waiting rows [s]
      integer :: waiting = 0                           !! rows in memory
      integer :: written = 0                           !! rows in the file
      real(wp) :: last_time = 0.0_wp                   !! time of the last row in the file [s]
      integer(i8) :: flushed_at = 0                    !! clock at the last flush
      logical :: with_histories = .true.               !! whether rows are kept
      logical :: is_broken = .false.                   !! a write failed: nothing more is written
      type(row_sums_t) :: sums                         !! of the rows that a checkpoint reports of
   contains
      procedure, public :: start => start_file
      procedure, public :: sample => sample_file
      procedure, public :: flush => write_block
      procedure, public :: save => save_file
      procedure, public :: go_on => go_on_with_file
      procedure, public :: finish => finish_file
   end type hdf5_writer_t

contains

   !> Make the file with all that is known before the run.
   subroutine start_file(self, plan, catalogue, selection, error)
      class(hdf5_writer_t), intent(inout) :: self        !! the file
      type(output_plan_t), intent(in) :: plan            !! what it says of the run
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(selection_t), intent(in) :: selection         !! what is
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made

      integer(hid_t) :: group
      integer :: block, closed, status

      self%path = plan%directory//"/run.h5"
      if (plan%life%goes_on) self%path = self%path//".part"  ! that of the run that continues stays until its rows are here
      self%with_histories = plan%with%histories
      block = rows_of_block(catalogue, plan%n_instant)
      allocate (self%times(block))
      status = enter_file(self%path)
      if (status /= 0) then
         call fail(self, "cannot make", system_message(status), error)
         return
      end if
      call open_library(status)
      call new_file(self%path, self%file, status)
      allocate (self%datasets(0))
      if (status >= 0) call reserve(self, len(plan%origin%deck_text, i8) + &
                                    metadata_of_dataset*size(catalogue%groups, kind=i8), error)
      if (allocated(error)) then
         closed = remove_file(self%path)
         return
      end if
      call make_root(self%file, plan, status)
      if (status >= 0) call make_time(self%file, block, self%time, status)
      if (status >= 0) call make_row_kind(self%file, block, self%kinds, status)
      if (status >= 0) call make_quantities(self%file, catalogue, selection, block, self%kinds, self%datasets, status)
      call self%events%make(self%file, catalogue, status)
      call new_group(self%file, "summary", group, status)
      if (status >= 0) call h5gclose_f(group, closed)
      call make_provenance(self%file, plan, status)
      if (allocated(plan%horizon%t)) then
         call write_tables(self%file, list_of(table_of_horizon(plan%horizon), table_of_digits(plan%horizon)), status)
      end if
      if (status >= 0) call flush_file(self, status)
      call note_files()
      if (status >= 0) return
      closed = remove_file(self%path)
      call fail(self, "cannot make", "no disk space, or no write permission there", error)
   end subroutine start_file

   !> Keep a row; write the block and the new events if it is full.
   subroutine sample_file(self, t, kind, catalogue, events, error)
      class(hdf5_writer_t), intent(inout) :: self        !! the file
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what the row is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(event_list_t), intent(in) :: events           !! all events so far
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      integer :: k

      if (self%is_broken .or. .not. self%with_histories) return
      self%waiting = self%waiting + 1
      self%times(self%waiting) = t
      self%kinds%rows(1, self%waiting) = real(kind, wp)
      do k = 1, size(self%datasets)
         associate (this => self%datasets(k))
            call pick(size(this%place), this%place, size(catalogue%values), catalogue%values, this%rows(:, self%waiting))
         end associate
      end do
      if (self%waiting == size(self%times) .or. waited(self)) call write_block(self, events, error)
   end subroutine sample_file

   !> Some values of many.
   pure subroutine pick(n, place, n_value, values, picked)
      integer, intent(in) :: n                     !! how many
      integer, intent(in) :: place(n)              !! (n) where they stand
      integer, intent(in) :: n_value               !! of how many
      real(wp), intent(in) :: values(n_value)      !! (n_value) all [any]
      real(wp), intent(inout) :: picked(n)         !! (n) those [any]

      integer :: i

      !GCC$ novector
      do i = 1, n
         picked(i) = values(place(i))
      end do
   end subroutine pick

   !> Whether the rows in memory have waited long enough.
   logical function waited(self)
      type(hdf5_writer_t), intent(in) :: self  !! the file

      integer(i8) :: now, rate

      call system_clock(now, rate)
      waited = real(now - self%flushed_at, wp) > longest_wait*real(rate, wp)
   end function waited

   !> Write where the file stands: all rows and events must be in it.
   subroutine save_file(self, archive)
      class(hdf5_writer_t), intent(inout) :: self  !! the file, flushed
      type(archive_t), intent(inout) :: archive          !! receives it

      integer :: status

      status = 0
      call self%sums%extend([self%kinds%id, self%datasets%id, self%time], self%written, status)
      call archive%put([self%written, self%events%written, transfer(self%sums%sums, [0])])
      call archive%put(self%last_time)
   end subroutine save_file

   !> Take over the rows and events that the file of an earlier run had when it was saved, and its place.
   subroutine go_on_with_file(self, archive, error)
      class(hdf5_writer_t), intent(inout) :: self        !! the file, made
      type(archive_t), intent(inout) :: archive                !! holds where that file stood
      type(error_t), allocatable, intent(out) :: error   !! it is not as it was, or cannot be read

      character(:), allocatable :: path
      integer(hid_t) :: earlier
      integer(i8) :: bytes
      integer :: closed, k, status, sums(2*(size(self%datasets) + 2))

      status = 0
      path = self%path(:len(self%path) - len(".part"))
      call archive%get(self%written)
      call archive%get(self%events%written)
      do k = 1, size(sums)
         call archive%get(sums(k))
      end do
      call archive%get(self%last_time)
      bytes = 9_i8*self%written
      do k = 1, size(self%datasets)
         bytes = bytes + 8_i8*size(self%datasets(k)%rows, 1, i8)*self%written
      end do
      call reserve(self, bytes + int(self%events%record, i8)*self%events%written, error)
      if (allocated(error)) return
      if (.not. survives(file_can_be_read, path)) status = -1
      call open_file(path, earlier, status)
      call copy_rows(earlier, self%kinds%id, self%written, status)
      do k = 1, size(self%datasets)
         call copy_rows(earlier, self%datasets(k)%id, self%written, status)
      end do
      call copy_rows(earlier, self%events%id, self%events%written, status)
      call copy_rows(earlier, self%time, self%written, status)
      if (earlier >= 0) call h5fclose_f(earlier, closed)
      call self%sums%extend([self%kinds%id, self%datasets%id, self%time], self%written, status)
      if (status >= 0) status = merge(0, -1, all(transfer(self%sums%sums, sums) == sums))
      if (status < 0) then
         self%is_broken = .true.
         call set_error(error, exit_file, "cannot append to "//path//": it has fewer than the "//to_text(self%written)// &
                        " rows recorded in the checkpoint; run the deck again without --resume")
         return
      end if
      call flush_file(self, status)
      if (status >= 0) status = -enter_file(path)
      if (status >= 0) status = -rename_path(self%path, path)
      call note_files(path)
      if (status < 0) then
         call fail(self, "cannot make", "no disk space, or no write permission there", error)
         return
      end if
      self%path = path
   end subroutine go_on_with_file

   !> Write the waiting rows and events.
   subroutine write_block(self, events, error)
      class(hdf5_writer_t), intent(inout) :: self         !! the file
      type(event_list_t), intent(in) :: events           !! all events so far
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      integer(i8) :: bytes
      integer :: k, status

      bytes = 9_i8*size(self%times, kind=i8) + self%events%bytes(events)
      do k = 1, size(self%datasets)
         bytes = bytes + 8_i8*size(self%datasets(k)%rows, kind=i8)
      end do
      call reserve(self, bytes, error)
      if (allocated(error)) return
      status = 0
      call write_states(self%kinds, self%written, self%waiting, status)
      do k = 1, size(self%datasets)
         associate (this => self%datasets(k))
            if (this%is_state) then
               call write_states(this, self%written, self%waiting, status)
            else
               call write_rows(this%id, this%shape, this%rows(:, 1:self%waiting), self%written, self%waiting, status)
            end if
         end associate
      end do
      call self%events%append(events, status)
      if (status >= 0) call flush_file(self, status)
      ! the last to grow: what /time reports of is there
      call write_rows(self%time, [integer(hsize_t) ::], self%times(1:self%waiting), self%written, self%waiting, status)
      if (status >= 0) call flush_file(self, status)
      if (status < 0) then
         call fail(self, "cannot write to", "the disk may be full", error)
         return
      end if
      if (self%waiting == 0) return
      self%written = self%written + self%waiting
      self%last_time = self%times(self%waiting)
      self%waiting = 0
   end subroutine write_block

   !> Make sure that what is written next finds its space.
   subroutine reserve(self, bytes, error)
      class(hdf5_writer_t), intent(inout) :: self         !! the file
      integer(i8), intent(in) :: bytes                   !! of data
      type(error_t), allocatable, intent(out) :: error   !! there is no space

      integer :: code

      code = reserve_space(self%path, bytes + metadata_of_file + metadata_of_dataset*size(self%datasets, kind=i8))
      if (code /= 0) call fail(self, "cannot write to", system_message(code), error)
   end subroutine reserve

   !> Hand all to the operating system.
   subroutine flush_file(self, status)
      class(hdf5_writer_t), intent(inout) :: self  !! the file
      integer, intent(inout) :: status            !! negative: failed

      call h5fflush_f(self%file, h5f_scope_local_f, status)
      call system_clock(self%flushed_at)
   end subroutine flush_file

   !> Note that nothing more can be written, and say what is safe.
   subroutine fail(self, action, why, error)
      class(hdf5_writer_t), intent(inout) :: self         !! the file
      character(*), intent(in) :: action                 !! what failed
      character(*), intent(in) :: why                    !! why, as far as known
      type(error_t), allocatable, intent(out) :: error   !! the error

      character(:), allocatable :: reason, saved

      self%is_broken = .true.
      saved = "nothing was saved"
      reason = why
      if (is_memory_short()) reason = "out of memory (ulimit -v)"
      if (.not. path_exists(self%path)) saved = "the file was removed during the run"
      if (path_exists(self%path) .and. self%written > 0) saved = "saved and readable: "//to_text(self%written)// &
                                    " rows up to t = "//to_text(self%last_time)//" s"
      call set_error(error, exit_file, action//" "//self%path//": "//reason//"; "//saved// &
                     ". Free disk space, or write elsewhere with --out DIRECTORY.")
   end subroutine fail

   !> Write what waits, the statistics, the warnings and how the run went, and close the file.
   subroutine finish_file(self, summary, events, tables, fields, warnings, error)
      class(hdf5_writer_t), intent(inout) :: self        !! the file
      type(summary_t), intent(in) :: summary             !! how the run ended
      type(event_list_t), intent(in) :: events           !! all events
      type(result_table_t), intent(in) :: tables(:)      !! (any) results
      type(film_field_t), intent(in) :: fields(:)        !! (any) films
      type(text_t), intent(in) :: warnings(:)            !! (any) what a careful reader should know
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      type(scales_t) :: scales
      integer :: k, status

      if (self%file < 0) return
      status = 0
      if (.not. self%is_broken) call write_block(self, events, error)
      if (.not. self%is_broken) then
         call reserve(self, sum([(len(warnings(k)%s, i8), k=1, size(warnings))]) + bytes_of_fields(fields) &
                      + sum(bytes_of_table(tables)), error)
      end if
      if (self%is_broken) then
         ! only what needs no new space
         call write_status(self%file, status_failed, status)
      else
         call self%events%sort(events, status)
         call write_tables(self%file, tables, status)
         call write_fields(self%file, fields, status)
         call text_dataset(self%file, "warnings", warnings, .false., "warnings", status)
         call add_scale(scales, self%file, "warnings", status)
         call self%events%number(self%file, scales, status)
         call close_scales(scales, self%file, status)
         call text_attribute(self%file, "status_message", summary%message, status)
         call write_status(self%file, summary%status, status)
      end if
      call close_all(self, status)
      call release_space(self%path)
      if (status >= 0 .and. .not. self%is_broken) status = -seal_file(self%path)
      if (sync_path(self%path) /= 0) status = -1
      if (status < 0 .and. .not. allocated(error)) then
         call fail(self, "cannot finish", "the disk may be full", error)
      end if
   end subroutine finish_file

   !> Close the file and all in it.
   subroutine close_all(self, status)
      type(hdf5_writer_t), intent(inout) :: self  !! the file
      integer, intent(inout) :: status            !! negative: failed

      integer :: closed, k

      do k = 1, size(self%datasets)
         if (self%datasets(k)%id >= 0) call h5dclose_f(self%datasets(k)%id, closed)
      end do
      if (self%kinds%id >= 0) call h5dclose_f(self%kinds%id, closed)
      if (self%time >= 0) call h5dclose_f(self%time, closed)
      call self%events%close()
      call h5fclose_f(self%file, closed)
      if (closed < 0) status = closed
      self%file = -1
   end subroutine close_all

end module hdf5_writer
