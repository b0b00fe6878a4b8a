!> The directory of a run: made, locked against a second run, an older run kept beside it.
!>
!> The lock is a file `DIRECTORY.lock` held with flock(2) as long as the run lasts; the lock of a
!> process that died is free, its file is taken over. An older run in the directory is renamed to
!> `DIRECTORY.1`, and the one that was there before is removed. Nothing is renamed or removed that
!> does not look like the output of a run.
module output_directory
   use errors, only: error_t, exit_file, set_error
   use kinds, only: i8
   use posix, only: is_busy, is_directory, is_empty_directory, lock_file, make_directory, path_exists
   use posix, only: real_path, remove_tree, rename_path, unlock_file
   use text, only: to_text
   use text_file, only: fail_file, write_file
   implicit none (type, external)
   private
   public :: looks_like_a_run, output_directory_t

   !> A directory that belongs to this run until it is closed.
   type :: output_directory_t
      character(:), allocatable :: path             !! the directory as named, without a slash at its end
      character(:), allocatable, private :: lock    !! lock file
      integer, private :: descriptor = -1           !! of the lock file, -1: not open
   contains
      procedure :: open => open_directory
      procedure :: close => close_directory
   end type output_directory_t

contains

   !> Make the directory of a run empty and ours.
   subroutine open_directory(self, path, error)
      class(output_directory_t), intent(inout) :: self   !! the directory
      character(*), intent(in) :: path                   !! where it is to be
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made, or is not free

      character(:), allocatable :: place

      call self%close()
      self%path = without_slash(path)
      if (len(self%path) == 0) then
         call set_error(error, exit_file, "the output directory has no name; name one with --out DIRECTORY")
         return
      end if
      place = self%path
      if (path_exists(place)) place = real_path(place)
      self%lock = place//".lock"
      call make_parent(place, error)
      if (allocated(error)) return
      call take_lock(self, error)
      if (allocated(error)) return
      call make_way(place, error)
      if (.not. allocated(error)) call make_empty(place, error)
      if (allocated(error)) call self%close()
   end subroutine open_directory

   !> Give the directory free for other runs; what is in it stays.
   subroutine close_directory(self)
      class(output_directory_t), intent(inout) :: self  !! the directory

      if (self%descriptor >= 0) call unlock_file(self%lock, self%descriptor)
      self%descriptor = -1
   end subroutine close_directory

   !> Whether a directory looks like the output of a run.
   logical function looks_like_a_run(path)
      character(*), intent(in) :: path  !! the directory

      looks_like_a_run = .false.
      if (.not. is_directory(path)) return
      looks_like_a_run = path_exists(path//"/run.h5") .or. path_exists(path//"/deck.echo") .or. &
         path_exists(path//"/summary.txt") .or. path_exists(path//"/summary.json")
   end function looks_like_a_run

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
                                    "Name another one with --out DIRECTORY.")
   end subroutine make_parent

   !> Take the lock of the directory.
   subroutine take_lock(self, error)
      type(output_directory_t), intent(inout) :: self    !! the directory
      type(error_t), allocatable, intent(out) :: error   !! another run has it

      character(:), allocatable :: who
      integer(i8) :: holder
      integer :: code

      code = lock_file(self%lock, self%descriptor, holder)
      if (code == 0) return
      self%descriptor = -1
      if (is_busy(code)) then
         who = "another run"
         if (holder > 0) who = who//" (process "//to_text(holder)//")"
         call set_error(error, exit_file, who//" is writing to "//self%path// &
                        "; wait for it, or name another directory with --out DIRECTORY")
      else
         call fail_file(error, "cannot make the lock file", self%lock, code, &
                        "Name another directory with --out DIRECTORY.")
      end if
   end subroutine take_lock

   !> Move an older run out of the way.
   subroutine make_way(path, error)
      character(*), intent(in) :: path                   !! directory of the run
      type(error_t), allocatable, intent(out) :: error   !! something else is in the way

      character(:), allocatable :: older
      integer :: code

      if (.not. path_exists(path)) return
      if (.not. is_directory(path)) then
         call set_error(error, exit_file, path//" is a file, not a directory; name another place with --out DIRECTORY")
         return
      end if
      if (is_empty_directory(path)) return
      if (.not. looks_like_a_run(path)) then
         call set_error(error, exit_file, path//" holds files that are not the output of a run (no run.h5, "// &
                        "summary or deck.echo), so it is left alone; name another directory with --out DIRECTORY")
         return
      end if
      older = path//".1"
      call remove_older(older, error)
      if (allocated(error)) return
      code = rename_path(path, older)
      if (code /= 0) call fail_file(error, "cannot keep the older run as", older, code, &
                                    "Move it away, or name another directory with --out DIRECTORY.")
   end subroutine make_way

   !> Remove the run that was kept before.
   subroutine remove_older(path, error)
      character(*), intent(in) :: path                   !! its directory
      type(error_t), allocatable, intent(out) :: error   !! it is no run, or cannot be removed

      integer :: code

      if (.not. path_exists(path)) return
      if (.not. looks_like_a_run(path)) then
         if (.not. (is_directory(path) .and. is_empty_directory(path))) then
            call set_error(error, exit_file, "the older run cannot be kept as "//path//", because what is there "// &
                           "is not the output of a run; move it away, or name another directory with --out DIRECTORY")
            return
         end if
      end if
      code = remove_tree(path)
      if (code /= 0) call fail_file(error, "cannot remove the older run", path, code, "Remove it by hand.")
   end subroutine remove_older

   !> Make the directory itself and mark it as that of a run, which also shows whether it can be used.
   subroutine make_empty(path, error)
      character(*), intent(in) :: path                   !! directory of the run
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made

      integer :: code

      code = make_directory(path)
      if (code /= 0) then
         call fail_file(error, "cannot make the directory", path, code, "Name another one with --out DIRECTORY.")
         return
      end if
      call write_file(path//"/deck.echo", "", error)
   end subroutine make_empty

end module output_directory
