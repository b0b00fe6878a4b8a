!> The directory of a run: made, locked against a second run, an older run kept beside it.
!>
!> A directory is ours if the marker in it says so (`output_marker`). The marker is locked with flock(2) as long as the run lasts;
!> the lock moves with the directory, and that of a process that died is free. An older run in the directory is renamed to
!> `DIRECTORY.1`, and the files of the one that was there before are removed: those that its marker names and knows as the ones that
!> the run made, and nothing else.
!> What is in use, not ours or a link is neither renamed nor removed.
module output_directory
   use errors, only: error_t, exit_file, set_error
   use output_marker, only: begin_marker, end_marker, marker_name, marker_t, read_marker
   use output_tree, only: inspect, remove_run, tree_t
   use posix, only: close_file, host_name, is_alive, is_busy, is_directory, is_link, is_missing, list_directory, lock_file
   use posix, only: make_directory, path_exists, real_path, remove_file, rename_path
   use text, only: append_text, text_t, to_text
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: output_directory_t

   integer, parameter :: most_attempts = 20  !! at a directory that others change at the same time
   integer, parameter :: most_kept = 9999    !! runs kept beside a directory because of other files in them

   character(*), parameter :: elsewhere = "choose another directory with --out DIRECTORY"  !! what to do

   !> A directory that belongs to this run until it is closed.
   type :: output_directory_t
      character(:), allocatable :: path                     !! the directory as named, without a slash at its end
      type(text_t), allocatable :: warnings(:)              !! (n) what was kept, and why
      character(:), allocatable, private :: place           !! the directory behind links
      type(marker_t), allocatable, private :: older         !! that of an older run that continues
      integer, private :: descriptor = -1                   !! of the locked marker, -1: not open
   contains
      procedure :: open => open_directory
      procedure :: close => close_directory
      procedure :: open_again => open_directory_again
      procedure :: leave => leave_directory
   end type output_directory_t

contains

   !> Make the directory of a run empty and ours; or continue in that of an older run of the same, whose files stay.
   subroutine open_directory(self, path, error, goes_on)
      class(output_directory_t), intent(inout) :: self   !! the directory
      character(*), intent(in) :: path                   !! where it is to be
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made, or is not free
      logical, intent(in), optional :: goes_on           !! an older run there is continued with, not moved away

      integer :: attempt
      logical :: keeps

      keeps = .false.
      if (present(goes_on)) keeps = goes_on
      call self%close()
      if (allocated(self%older)) deallocate (self%older)
      if (allocated(self%warnings)) deallocate (self%warnings)
      allocate (self%warnings(0))
      self%path = without_slash(path)
      if (len(self%path) == 0) then
         call set_error(error, exit_file, "the output directory has no name; give one with --out DIRECTORY")
         return
      end if
      self%place = self%path
      if (path_exists(self%place)) then
         self%place = real_path(self%place)
      else if (is_link(self%place)) then
         call set_error(error, exit_file, self%path//" is a symbolic link to a missing target; "//elsewhere)
         return
      end if
      call make_parent(self%place, error)
      do attempt = 1, most_attempts
         if (allocated(error) .or. self%descriptor >= 0) exit
         call enter(self, keeps, error)
      end do
      if (allocated(error)) return
      if (self%descriptor < 0) then
         call set_error(error, exit_file, "other programs change "//self%path//" continually; "//elsewhere)
         return
      end if
      if (allocated(self%older)) then
         attempt = begin_marker(self%path, self%older)
      else
         attempt = begin_marker(self%path)
      end if
      if (attempt == 0) return
      call fail_file(error, "cannot write", self%path//"/"//marker_name, attempt, "Free disk space there, or "//elsewhere//".")
      attempt = remove_file(self%path//"/"//marker_name)
      call close_file(self%descriptor)
      self%descriptor = -1
   end subroutine open_directory

   !> Take the directory of an earlier run of ours as it is, to continue with that.
   subroutine open_directory_again(self, path, error)
      class(output_directory_t), intent(inout) :: self   !! the directory
      character(*), intent(in) :: path                   !! where it is
      type(error_t), allocatable, intent(out) :: error   !! it is in use, or not ours

      type(marker_t) :: marker
      integer :: code

      call self%close()
      if (allocated(self%warnings)) deallocate (self%warnings)
      allocate (self%warnings(0))
      self%path = without_slash(path)
      self%place = real_path(self%path)
      call lock_marker(self%place, .false., "resume in "//self%path, self%descriptor, error)
      if (allocated(error)) return
      if (self%descriptor >= 0) call read_marker(self%place, marker)
      if (.not. marker%is_ours) then
         call set_error(error, exit_file, self%path//" is not an output directory of gudgeon: it has no marker "//marker_name)
      else
         code = begin_marker(self%path, marker)
         if (code /= 0) call fail_file(error, "cannot write", self%path//"/"//marker_name, code, "")
      end if
      if (.not. allocated(error)) return
      if (self%descriptor >= 0) call close_file(self%descriptor)
      self%descriptor = -1
   end subroutine open_directory_again

   !> Give the directory free for other runs; what is in it stays.
   subroutine close_directory(self)
      class(output_directory_t), intent(inout) :: self  !! the directory

      if (self%descriptor < 0) return
      call end_marker()
      call close_file(self%descriptor)
      self%descriptor = -1
   end subroutine close_directory

   !> In a copy of the process: let go of the lock, which stays with the process that opened the directory.
   subroutine leave_directory(self)
      class(output_directory_t), intent(inout) :: self  !! the directory

      if (self%descriptor >= 0) call close_file(self%descriptor)
      self%descriptor = -1
   end subroutine leave_directory

   !> A path without slashes at its end.
   pure function without_slash(path) result(short)
      character(*), intent(in) :: path     !! any path
      character(:), allocatable :: short   !! the same; `/` stays

      integer :: n

      n = len_trim(path)
      do while (n > 1)
         if (path(n:n) /= "/") exit
         n = n - 1
      end do
      short = path(1:n)
   end function without_slash

   !> Make the directories above a path.
   subroutine make_parent(path, error)
      character(*), intent(in) :: path                   !! directory of the run
      type(error_t), allocatable, intent(out) :: error   !! one of them cannot be made

      integer :: at, code

      at = index(path, "/", back=.true.)
      if (at <= 1) return
      code = make_directory(path(1:at - 1))
      if (code /= 0) call fail_file(error, "cannot make the directory", path(1:at - 1), code, &
                                    "Choose another one with --out DIRECTORY.")
   end subroutine make_parent

   !> One step on the way in: a new or empty directory is taken, an older run is moved out of the way. Then, or if another
   !> process was faster, there is no error and the directory is not open yet: once more.
   subroutine enter(self, keeps, error)
      type(output_directory_t), intent(inout) :: self    !! the directory; `descriptor` is set once it is ours
      logical, intent(in) :: keeps                       !! an older run there is continued with
      type(error_t), allocatable, intent(out) :: error   !! it is not free, or not ours

      type(marker_t) :: marker
      type(text_t), allocatable :: names(:)
      integer :: code, file

      code = make_directory(self%place)
      if (code == 0) call list_directory(self%place, names, code)
      if (code /= 0) then
         if (path_exists(self%place) .and. .not. is_directory(self%place)) then
            call set_error(error, exit_file, self%path//" is a file, not a directory; choose another one with --out DIRECTORY")
         else
            call fail_file(error, "cannot make the directory", self%path, code, "Choose another one with --out DIRECTORY.")
         end if
         return
      end if
      if (size(names) == 0) then
         call lock_marker(self%place, .true., "write to "//self%path, file, error)
         if (file >= 0) call take_new(self, file)
         return
      end if
      if (.not. has_marker(names)) then
         call refuse(self%path, names, error)
         return
      end if
      call lock_marker(self%place, .false., "write to "//self%path, file, error)
      if (file < 0) return
      call read_marker(self%place, marker)
      if (size(names) == 1 .and. marker%is_empty) then  ! left by a run that could not even start
         call take_new(self, file)
         return
      end if
      if (.not. marker%is_ours) then
         call set_error(error, exit_file, self%path//"/"//marker_name//" was not made by gudgeon, so "//self%path// &
                        " stays unchanged; "//elsewhere)
      else if (keeps) then
         self%descriptor = file
         self%older = marker
         return
      else if (size(names) == 1) then
         code = remove_file(self%place//"/"//marker_name)
         if (code /= 0) call fail_file(error, "cannot remove", self%path//"/"//marker_name, code, "")
      else
         call make_way(self, marker, error)
      end if
      call close_file(file)
   end subroutine enter

   !> Whether a directory has a marker.
   pure logical function has_marker(names)
      type(text_t), intent(in) :: names(:)  !! (n) what it holds

      integer :: k

      has_marker = .false.
      do k = 1, size(names)
         if (names(k)%s == marker_name) has_marker = .true.
      end do
   end function has_marker

   !> Take a directory that holds an empty, locked marker and nothing else.
   subroutine take_new(self, file)
      type(output_directory_t), intent(inout) :: self    !! the directory
      integer, intent(in) :: file                        !! the marker

      type(marker_t) :: marker
      type(text_t), allocatable :: names(:)
      integer :: code

      call list_directory(self%place, names, code)
      call read_marker(self%place, marker)
      if (code == 0 .and. size(names) == 1 .and. marker%is_empty) then
         self%descriptor = file
         return
      end if
      if (marker%is_empty) code = remove_file(self%place//"/"//marker_name)  ! something came in before it
      call close_file(file)
   end subroutine take_new

   !> Say why a directory without a marker is left alone.
   subroutine refuse(path, names, error)
      character(*), intent(in) :: path                   !! the directory
      type(text_t), intent(in) :: names(:)               !! (n) what it holds
      type(error_t), allocatable, intent(out) :: error   !! always set

      integer :: k

      do k = 1, size(names)
         select case (names(k)%s)
         case ("run.h5", "sweep.h5", "sweep.runs", "deck.echo", "summary.json")
            call set_error(error, exit_file, path//" holds "//names(k)%s//", but no marker "//marker_name//" that marks "// &
                           "it as output of gudgeon (old versions wrote none); it stays unchanged. Move it "// &
                           "away, or "//elsewhere)
            return
         end select
      end do
      call set_error(error, exit_file, path//" contains files not made by gudgeon ("//names(1)%s// &
                     ") and stays unchanged; "//elsewhere)
   end subroutine refuse

   !> Take the lock of a directory's marker.
   subroutine lock_marker(place, make, action, file, error)
      character(*), intent(in) :: place                  !! the directory
      logical, intent(in) :: make                        !! whether a marker is made if there is none
      character(*), intent(in) :: action                 !! what it is requested for, as `write to DIRECTORY`
      integer, intent(out) :: file                       !! descriptor; -1 without an error: there is no marker
      type(error_t), allocatable, intent(out) :: error   !! another run has it, or it is no file

      type(marker_t) :: marker
      character(:), allocatable :: who
      integer :: code
      logical :: is_in_use, is_locked

      code = lock_file(place//"/"//marker_name, make, file, is_locked)
      if (code /= 0) file = -1
      if (is_missing(code)) return
      call read_marker(place, marker)
      is_in_use = is_busy(code)
      if (code == 0 .and. .not. is_locked .and. marker%is_ours .and. .not. marker%has_ended) then
         ! no locks here: the marker's word counts, that of another machine until the run has ended
         is_in_use = .true.
         if (marker%host == host_name()) is_in_use = is_alive(marker%process)
         if (is_in_use) call close_file(file)
         if (is_in_use) file = -1
      end if
      if (is_in_use) then
         who = "another run"
         if (marker%process > 0) who = who//" (process "//to_text(marker%process)//" on "//marker%host//")"
         call set_error(error, exit_file, "cannot "//action//": "//who//" is writing to "//place//"; wait for it, or "//elsewhere)
      else if (code /= 0) then
         call fail_file(error, "cannot "//action//": cannot lock", place//"/"//marker_name, code, &
                        "The marker of an output directory must be writable; "//elsewhere//".")
      end if
   end subroutine lock_marker

   !> Move an older run out of the way.
   subroutine make_way(self, marker, error)
      type(output_directory_t), intent(inout) :: self    !! the directory, locked
      type(marker_t), intent(in) :: marker               !! its marker
      type(error_t), allocatable, intent(out) :: error   !! something else is in the way, or in use

      type(tree_t) :: tree
      integer :: code

      call inspect(self%place, marker, tree)
      if (allocated(tree%in_use)) then
         call set_error(error, exit_file, "another run is writing to "//self%path//"/"//tree%in_use//"; wait for it, or "// &
                        elsewhere)
         return
      end if
      call free_older(self, marker, error)
      if (allocated(error)) return
      code = rename_path(self%place, self%place//".1")
      if (code /= 0) call fail_file(error, "cannot keep the older run as", self%path//".1", code, &
                                    "Move it away, or "//elsewhere//".")
   end subroutine make_way

   !> Remove the run that was kept before, or rename it if it holds files that are not of gudgeon.
   subroutine free_older(self, marker, error)
      type(output_directory_t), intent(inout) :: self    !! the directory, locked
      type(marker_t), intent(in) :: marker               !! its marker
      type(error_t), allocatable, intent(out) :: error   !! it is no run, in use, or cannot be removed

      type(marker_t) :: older
      type(text_t), allocatable :: names(:)
      type(tree_t) :: tree
      character(:), allocatable :: place
      integer :: code, file

      place = self%place//".1"
      if (.not. path_exists(place) .and. .not. is_link(place)) return
      if (is_directory(place) .and. .not. is_link(place)) then
         call list_directory(place, names, code)
         if (code == 0 .and. size(names) == 0) return
         if (code == 0 .and. has_marker(names)) then
            call lock_marker(place, .false., "keep the older run of "//self%path, file, error)
            if (allocated(error) .or. file < 0) return
            call read_marker(place, older)
            if (older%is_ours) then
               call inspect(place, older, tree)
               if (allocated(tree%in_use)) then
                  call set_error(error, exit_file, "cannot keep the older run of "//self%path//": another run is writing to "// &
                                 place//"/"//tree%in_use//"; wait for it, or "//elsewhere)
               else if (older%id == marker%id) then
                  call keep(self, place, "it is a copy", error)
               else if (allocated(tree%foreign)) then
                  call keep(self, place, "it contains files not made by gudgeon ("//tree%foreign//")", error)
               else
                  call remove_run(place, code)
                  if (code /= 0) call fail_file(error, "cannot remove the older run", place, code, "Remove it by hand.")
               end if
               call close_file(file)
               return
            end if
            call close_file(file)
         end if
      end if
      call set_error(error, exit_file, "the older run cannot be kept as "//self%path//".1: that directory "// &
                     "is not output of gudgeon (no marker "//marker_name//"); move it away, or "//elsewhere)
   end subroutine free_older

   !> Keep an older run under the next free number.
   subroutine keep(self, place, why, error)
      type(output_directory_t), intent(inout) :: self    !! the directory
      character(*), intent(in) :: place                  !! the older run
      character(*), intent(in) :: why                    !! why it is not removed
      type(error_t), allocatable, intent(out) :: error   !! it cannot be renamed

      character(:), allocatable :: kept
      integer :: code, k

      do k = 2, most_kept
         kept = self%place//"."//to_text(k)
         if (path_exists(kept) .or. is_link(kept)) cycle
         code = rename_path(place, kept)
         if (code /= 0) then
            call fail_file(error, "cannot keep an older run as", kept, code, "Move "//place//" away, or "//elsewhere//".")
         else
            call append_text(self%warnings, "an older run, "//place//", was kept as "//kept//", because "//why)
         end if
         return
      end do
      call set_error(error, exit_file, "too many runs are kept beside "//self%path//"; remove some, or "//elsewhere)
   end subroutine keep

end module output_directory
