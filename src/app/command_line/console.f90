!> What the verbs say on the standard output: collected, and written at the end in one piece, so that a
!> full disk is noticed (gfortran's own output unit reports no error).
module console
   use errors, only: error_t
   use posix, only: is_pipe_gone, write_output
   use text_buffer, only: buffer_t
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: say, write_said

   type(buffer_t) :: said  !! lines said so far

contains

   !> Say a line.
   subroutine say(line, indent, second, column)
      character(*), intent(in) :: line               !! the line, or its first part
      integer, intent(in), optional :: indent        !! blanks before it
      character(*), intent(in), optional :: second   !! its second part
      integer, intent(in), optional :: column        !! where that starts

      character(:), allocatable :: whole

      whole = line
      if (present(indent)) whole = repeat(" ", indent)//whole
      if (present(second) .and. present(column)) whole = whole//repeat(" ", max(1, column - 1 - len(whole)))//second
      call said%line(whole)
   end subroutine say

   !> Write everything said; a reader that has seen enough and went away is no error.
   subroutine write_said(error)
      type(error_t), allocatable, intent(out) :: error   !! the standard output cannot be written

      integer :: code

      code = 0
      if (said%length() > 0) code = write_output(said%get())
      if (code /= 0 .and. .not. is_pipe_gone(code)) call fail_file(error, "cannot write to", "the standard output", code, "")
   end subroutine write_said

end module console
