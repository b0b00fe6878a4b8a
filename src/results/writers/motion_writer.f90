!> Writes motion.vtkhdf: the moving mechanism for other programs, one step for each output instant (layout: `motion_layout`).
!>
!> As of run.h5, steps wait in memory until there is a block of them, or ten seconds have passed, and a block finds its space
!> before it is written. Then `NSteps` is written and after it the times, each in a flush of its own: a run that is killed,
!> whenever, leaves a file that can be read, with as many steps as it has times. (VTK 9.7 has storage for `NSteps` times and writes
!> beyond it where there are more; between the two flushes there are fewer, and it takes those that lack as 0.)
module motion_writer
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_bodies, group_contacts
   use channel_names, only: item_name, label_in_name
   use checksum, only: survives
   use drawing, only: drawing_t
   use errors, only: error_t, exit_file, set_error
   use hdf5, only: h5dclose_f, h5fclose_f, h5fflush_f, h5f_scope_local_f, hid_t
   use hdf5_attributes, only: text_attribute
   use hdf5_calls, only: is_memory_short, new_file, open_file, open_library
   use hdf5_copy, only: copy_rows
   use hdf5_datasets, only: text_dataset
   use hdf5_layout, only: write_status
   use hdf5_rows, only: write_rows
   use hdf5_probe, only: file_can_be_read, row_sums_t
   use kinds, only: i8, wp
   use motion_layout, only: growing_t, make_cells, make_steps, most_growing, point_layout_t, set_steps
   use output_marker, only: enter_file, note_files
   use output_plan, only: output_plan_t
   use posix, only: path_exists, release_space, remove_file, rename_path, reserve_space, sync_path, system_message
   use recorder, only: status_failed, status_running
   use scene_poses, only: at_contact, contact_force, contact_penetration, contact_state, contact_value, pose_reader_t, velocity_at
   use archive, only: archive_t
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: motion_name, motion_writer_t

   character(*), parameter :: motion_name = "motion.vtkhdf"       !! name of the file
   integer, parameter :: most_steps = 128, fewest_steps = 4        !! of a block
   integer(i8), parameter :: bytes_of_block = 2097152_i8          !! of the points of a block, from which its steps follow
   integer(i8), parameter :: metadata_of_block = 262144_i8        !! bytes that headers and indices may grow by
   real(wp), parameter :: longest_wait = 10.0_wp                  !! time after which steps are written anyway [s]

   !> The open file.
   type :: motion_writer_t
      private
      character(:), allocatable :: path                 !! where it is
      integer(hid_t) :: file = -1                       !! the open file
      type(drawing_t) :: drawing                        !! outlines
      type(pose_reader_t) :: reader                     !! what is read of the catalogue
      type(point_layout_t) :: layout                    !! points of a step
      type(growing_t) :: list(most_growing)             !! datasets that grow
      integer :: waiting = 0                            !! steps in memory
      integer :: written = 0                            !! steps in the file
      integer(i8) :: flushed_at = 0                     !! clock at the last flush
      type(row_sums_t) :: sums(most_growing)            !! of the rows that a checkpoint reports of
      real(wp), allocatable :: r(:, :)                  !! (3, 0:bodies) centres of mass [m]
      real(wp), allocatable :: a(:, :, :)               !! (3, 3, 0:bodies) orientations [1]
      real(wp), allocatable :: v(:, :)                  !! (3, 0:bodies) velocities [m/s]
      real(wp), allocatable :: w(:, :)                  !! (3, 0:bodies) angular velocities [rad/s]
   contains
      procedure, public :: start => start_file
      procedure, public :: sample => sample_file
      procedure, public :: flush => write_block
      procedure, public :: save => save_file
      procedure, public :: go_on => go_on_with_file
      procedure, public :: finish => finish_file
   end type motion_writer_t

contains

   !> Make the file with all that does not move.
   subroutine start_file(self, plan, catalogue, error)
      class(motion_writer_t), intent(inout) :: self      !! the file
      type(output_plan_t), intent(in) :: plan            !! what it says of the run
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made

      integer :: block, closed, status

      self%path = plan%directory//"/"//motion_name
      if (plan%life%goes_on) self%path = self%path//".part"  ! that of the run that continues stays until its steps are here
      self%drawing = plan%looks%drawing
      call self%reader%bind(catalogue)
      status = enter_file(self%path)
      if (status /= 0) then
         call fail(self, "cannot make", system_message(status), error)
         return
      end if
      call open_library(status)
      call new_file(self%path, self%file, status)
      call text_attribute(self%file, "filetype", "gudgeon motion", status)
      call text_attribute(self%file, "program_version", plan%origin%program_version, status)
      call text_attribute(self%file, "title", plan%title, status)
      call write_status(self%file, status_running, status)
      call text_dataset(self%file, "bodies", catalogue%item_groups(group_bodies)%names, .false., &
                        "bodies, from 1; 0 is the ground", &
                        status)
      call text_dataset(self%file, "contacts", contact_names(catalogue), .false., "contacts, from 1", status)
      call make_cells(self%file, self%drawing, self%reader%n_contact, self%layout, status)
      block = int(max(int(fewest_steps, i8), min(int(most_steps, i8), bytes_of_block/(24*max(self%layout%n, 1)))))
      call make_steps(self%file, self%layout, block, self%list, status)
      allocate (self%r(3, 0:self%reader%n_body), self%v(3, 0:self%reader%n_body), self%w(3, 0:self%reader%n_body))
      allocate (self%a(3, 3, 0:self%reader%n_body))
      if (status >= 0) call flush_file(self, status)
      call note_files()
      if (status >= 0) return
      closed = remove_file(self%path)
      call fail(self, "cannot make", "no disk space, or no write permission there", error)
   end subroutine start_file

   !> Names of the contacts.
   function contact_names(catalogue) result(names)
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      type(text_t), allocatable :: names(:)        !! (contacts) as in channels

      integer :: k

      allocate (names(size(catalogue%item_groups(group_contacts)%names)))
      do k = 1, size(names)
         names(k)%s = item_name(catalogue, group_contacts, k)
         if (len(label_in_name(catalogue, group_contacts, k)) > 0) then
            names(k)%s = names(k)%s//"."//label_in_name(catalogue, group_contacts, k)
         end if
      end do
   end function contact_names

   !> Keep a step; write the block if it is full.
   subroutine sample_file(self, t, catalogue, error)
      class(motion_writer_t), intent(inout) :: self      !! the file
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      real(wp) :: arm(3)
      integer :: at, body, j, k

      if (self%file < 0) return
      self%waiting = self%waiting + 1
      call self%reader%frames(catalogue, self%r, self%a)
      call self%reader%rates(catalogue, self%v, self%w)
      at = 0
      do k = 1, self%drawing%n_part
         body = self%drawing%parts(k)%body
         do j = 1, size(self%drawing%parts(k)%s, 2)
            arm = matmul(self%a(:, :, body), self%drawing%parts(k)%s(:, j))
            call put_point(self, at, self%r(:, body) + arm, velocity_at(self%v(:, body), self%w(:, body), arm), &
                           [0.0_wp, 0.0_wp, -1.0_wp])
            at = at + 1
         end do
      end do
      do k = 1, self%reader%n_contact
         call put_point(self, at, at_contact(self%reader, catalogue, k), [0.0_wp, 0.0_wp, 0.0_wp], &
                        [contact_value(self%reader, catalogue, contact_force, k), &
                         contact_value(self%reader, catalogue, contact_penetration, k), &
                         contact_value(self%reader, catalogue, contact_state, k)])
         at = at + 1
      end do
      do k = 6, 10
         self%list(k)%rows(1, self%waiting) = real(self%written + self%waiting - 1, wp)*self%list(k)%per_step
      end do
      self%list(most_growing)%rows(1, self%waiting) = t
      if (self%waiting == size(self%list(1)%rows, 2) .or. has_waited(self)) call write_block(self, error)
   end subroutine sample_file

   !> Put a point and its data into the step that waits last.
   subroutine put_point(self, at, place, velocity, values)
      type(motion_writer_t), intent(inout) :: self   !! the file
      integer, intent(in) :: at                      !! points before it
      real(wp), intent(in) :: place(3)               !! (3) where it is, world frame [m]
      real(wp), intent(in) :: velocity(3)            !! (3) its velocity, world frame [m/s]
      real(wp), intent(in) :: values(3)              !! (3) normal force, penetration, state [N, m, 1]

      integer :: k

      self%list(1)%rows(3*at + 1:3*at + 3, self%waiting) = place
      self%list(2)%rows(3*at + 1:3*at + 3, self%waiting) = velocity
      do k = 1, 3
         self%list(2 + k)%rows(at + 1, self%waiting) = values(k)
      end do
   end subroutine put_point

   !> Whether the steps in memory have waited long enough.
   logical function has_waited(self)
      type(motion_writer_t), intent(in) :: self  !! the file

      integer(i8) :: now, rate

      call system_clock(now, rate)
      has_waited = real(now - self%flushed_at, wp) > longest_wait*real(rate, wp)
   end function has_waited

   !> Write where the file stands: all steps must be in it.
   subroutine save_file(self, archive)
      class(motion_writer_t), intent(inout) :: self  !! the file, flushed
      type(archive_t), intent(inout) :: archive            !! receives it

      integer :: k, status

      status = 0
      call archive%put(self%written)
      do k = 1, most_growing
         call self%sums(k)%extend([self%list(k)%id], self%written*self%list(k)%n_row, status)
         call archive%put(transfer(self%sums(k)%sums, [0]))
      end do
   end subroutine save_file

   !> Take over the steps that the file of an earlier run had when it was saved, and its place.
   subroutine go_on_with_file(self, archive, error)
      class(motion_writer_t), intent(inout) :: self      !! the file, made
      type(archive_t), intent(inout) :: archive                !! holds where that file stood
      type(error_t), allocatable, intent(out) :: error   !! it is not as it was, or cannot be read

      character(:), allocatable :: path
      integer(hid_t) :: earlier
      integer :: closed, i, k, status, sum(2)

      status = 0
      path = self%path(:len(self%path) - len(".part"))
      call archive%get(self%written)
      if (.not. survives(file_can_be_read, path)) status = -1
      call open_file(path, earlier, status)
      do k = 1, most_growing
         do i = 1, 2
            call archive%get(sum(i))
         end do
         call copy_rows(earlier, self%list(k)%id, self%written*self%list(k)%n_row, status)
         call self%sums(k)%extend([self%list(k)%id], self%written*self%list(k)%n_row, status)
         if (status >= 0) status = merge(0, -1, all(transfer(self%sums(k)%sums, sum) == sum))
      end do
      if (earlier >= 0) call h5fclose_f(earlier, closed)
      if (status < 0) then
         call set_error(error, exit_file, "cannot append to "//path//": it has fewer than the "//to_text(self%written)// &
                        " steps recorded in the checkpoint; run the deck again without --resume")
         return
      end if
      call set_steps(self%file, self%written, status)
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

   !> Write the waiting steps.
   subroutine write_block(self, error)
      class(motion_writer_t), intent(inout) :: self       !! the file
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      integer(i8) :: bytes
      integer :: code, k, status

      bytes = metadata_of_block
      do k = 1, most_growing
         bytes = bytes + 8_i8*size(self%list(k)%rows, kind=i8)
      end do
      code = reserve_space(self%path, bytes)
      if (code /= 0) then
         call fail(self, "cannot write to", system_message(code), error)
         return
      end if
      status = 0
      do k = 1, most_growing
         associate (this => self%list(k))
            if (k == most_growing) then  ! the times: what they report of is there
               if (status >= 0) call flush_file(self, status)
               call set_steps(self%file, self%written + self%waiting, status)
               if (status >= 0) call flush_file(self, status)
            end if
            call write_rows(this%id, this%shape, this%rows(:, 1:self%waiting), self%written*this%n_row, self%waiting*this%n_row, &
                            status)
         end associate
      end do
      if (status >= 0) call flush_file(self, status)
      if (status < 0) then  ! the file stays as it was flushed last: to close it would write of an end that it has not
         self%file = -1
         call fail(self, "cannot write to", "the disk may be full", error)
         return
      end if
      self%written = self%written + self%waiting
      self%waiting = 0
   end subroutine write_block

   !> Hand all to the operating system.
   subroutine flush_file(self, status)
      class(motion_writer_t), intent(inout) :: self  !! the file
      integer, intent(inout) :: status              !! negative: failed

      call h5fflush_f(self%file, h5f_scope_local_f, status)
      call system_clock(self%flushed_at)
   end subroutine flush_file

   !> Close the file after a failure, unless it is left alone, and say what is safe.
   subroutine fail(self, action, why, error)
      class(motion_writer_t), intent(inout) :: self       !! the file
      character(*), intent(in) :: action                 !! what failed
      character(*), intent(in) :: why                    !! why, as far as known
      type(error_t), allocatable, intent(out) :: error   !! the error

      character(:), allocatable :: reason, saved
      integer :: status

      status = 0
      reason = why
      saved = "saved and readable: "//to_text(self%written)//" steps"
      if (.not. path_exists(self%path)) saved = "the file was removed during the run"
      if (is_memory_short()) reason = "out of memory (ulimit -v)"
      if (self%file >= 0) call write_status(self%file, status_failed, status)
      if (self%file >= 0) call close_all(self, status)
      call set_error(error, exit_file, action//" "//self%path//": "//reason//"; "//saved// &
                     ". Free disk space, write elsewhere with --out DIRECTORY, or omit the file (motion = off).")
   end subroutine fail

   !> Write what waits and how the run went, and close the file.
   subroutine finish_file(self, word, error)
      class(motion_writer_t), intent(inout) :: self      !! the file
      character(*), intent(in) :: word                   !! one of `status_...` of the recorder
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      integer :: status

      if (self%file < 0) return
      if (self%waiting > 0) call write_block(self, error)
      if (allocated(error)) return
      status = 0
      call write_status(self%file, word, status)
      call close_all(self, status)
      call release_space(self%path)
      if (sync_path(self%path) /= 0) status = -1
      if (status < 0) call fail(self, "cannot finish", "the disk may be full", error)
   end subroutine finish_file

   !> Close the file and all in it.
   subroutine close_all(self, status)
      class(motion_writer_t), intent(inout) :: self  !! the file
      integer, intent(inout) :: status              !! negative: failed

      integer :: closed, k

      do k = 1, most_growing
         if (self%list(k)%id >= 0) call h5dclose_f(self%list(k)%id, closed)
         self%list(k)%id = -1
      end do
      if (self%file < 0) return
      call h5fclose_f(self%file, closed)
      if (closed < 0) status = closed
      self%file = -1
   end subroutine close_all

end module motion_writer
