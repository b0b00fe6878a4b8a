!> The summary of a run on the standard output.
module standard_output
   use errors, only: error_t
   use posix, only: is_pipe_gone, write_output
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: print_text

contains

   !> Print on the standard output, which may be a full disk; a reader that has seen enough is none.
   subroutine print_text(text, error)
      character(*), intent(in) :: text                   !! whole lines
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      integer :: code

      code = write_output(text)
      if (is_pipe_gone(code)) return
      if (code /= 0) call fail_file(error, "cannot write the summary to", "the standard output", code, &
                                    "The summary is in the output directory.")
   end subroutine print_text

end module standard_output
