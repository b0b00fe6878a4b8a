!> Files of text that never end in half a record: whole files, and files that grow by whole blocks.
module text_file
   use errors, only: error_t, exit_file, set_error
   use kinds, only: i8
   use output_marker, only: enter_file, note_files
   use posix, only: cut_file, remove_file, rename_path, sync_path, system_message, write_at
   implicit none (type, external)
   private
   public :: fail_file, put_in_place, replace_file, text_file_t, write_file

   !> A file that grows at its end. It is open only while it is being written, so that ten thousand
   !> of them are no problem.
   type :: text_file_t
      character(:), allocatable :: path  !! where it is
      integer(i8) :: length = 0          !! bytes that are safely written
   contains
      procedure :: append => append_to_file
      procedure :: go_on => go_on_with_file
   end type text_file_t

contains

   !> Make the error of a system call that failed.
   subroutine fail_file(error, action, path, code, advice)
      type(error_t), allocatable, intent(out) :: error  !! the error
      character(*), intent(in) :: action                !! what could not be done, as `cannot write`
      character(*), intent(in) :: path                  !! to which file
      integer, intent(in) :: code                       !! the system's error number
      character(*), intent(in) :: advice                !! what to do about it, a sentence or blank

      character(:), allocatable :: message

      message = action//" "//path//": "//system_message(code)
      if (len_trim(advice) > 0) message = message//". "//trim(advice)
      call set_error(error, exit_file, message)
   end subroutine fail_file

   !> Append text to a file; if that fails the file stays as it was.
   subroutine append_to_file(self, text, error)
      class(text_file_t), intent(inout) :: self          !! the file
      character(*), intent(in) :: text                   !! whole lines
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      integer :: code

      if (len(text) == 0 .and. self%length > 0) return
      code = 0
      if (self%length == 0) code = enter_file(self%path)
      if (code == 0) code = write_at(self%path, text, self%length)
      if (code /= 0) then
         call fail_file(error, "cannot write", self%path, code, &
                        "Free disk space there, or write elsewhere with --out DIRECTORY.")
         return
      end if
      self%length = self%length + len(text, i8)
   end subroutine append_to_file

   !> Continue with a file that an earlier run has left behind: what it wrote behind some length is dropped.
   subroutine go_on_with_file(self, length, error)
      class(text_file_t), intent(inout) :: self          !! the file
      integer(i8), intent(in) :: length                  !! bytes that stay
      type(error_t), allocatable, intent(out) :: error   !! it is not there, or shorter

      integer :: code

      code = cut_file(self%path, length)
      if (code /= 0) then
         call fail_file(error, "cannot continue", self%path, code, "It differs from the state in the checkpoint; run the "// &
            "deck again without --resume.")
         return
      end if
      self%length = length
   end subroutine go_on_with_file

   !> Write a whole file.
   subroutine write_file(path, text, error)
      character(*), intent(in) :: path                   !! the file
      character(*), intent(in) :: text                   !! all it is to hold
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      type(text_file_t) :: file

      file%path = path
      call file%append(text, error)
   end subroutine write_file

   !> Write a whole file under another name first, so that there is never half of it.
   subroutine replace_file(path, text, error)
      character(*), intent(in) :: path                   !! the file
      character(*), intent(in) :: text                   !! all it is to hold
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      integer :: ignored

      call write_file(path//".part", text, error)
      if (.not. allocated(error)) call put_in_place(path, error)
      if (allocated(error)) ignored = remove_file(path//".part")
   end subroutine replace_file

   !> Give a file that was written as `PATH.part` its name, once it is on the disk: after a power failure either the old file or
   !> the new one is there, whole.
   subroutine put_in_place(path, error)
      character(*), intent(in) :: path                   !! the file
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written to the disk, or renamed

      integer :: code

      code = sync_path(path//".part")
      if (code == 0) code = enter_file(path)
      if (code == 0) code = rename_path(path//".part", path)
      if (code == 0) call note_files(path)
      if (code == 0) code = sync_path(path(1:max(1, index(path, "/", back=.true.) - 1)))
      if (code /= 0) call fail_file(error, "cannot rename "//path//".part to", path, code, "")
   end subroutine put_in_place

end module text_file
