!> Deck text: whole files in memory, cut into lines.
!>
!> Lines end with LF or CR LF. A tab counts as one column. A byte order mark of UTF-8 is skipped.
!> A file that is missing, a directory, a device, empty, too large or not text is refused with a clear message.
module source_text
   use file_store, only: read_kept
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: line_of, n_line_of, new_source, read_source, source_t

   integer(i8), parameter :: largest_file = 64000000_i8  !! bytes

   !> One text: a file, an override of the command line, or a default.
   type :: source_t
      character(:), allocatable :: name   !! as shown in messages
      character(:), allocatable :: text   !! verbatim
      character(:), allocatable :: place  !! path beside which the files lie that it names; blank: the current directory
      logical :: is_file = .false.        !! its lines have numbers
      logical :: is_stream = .false.      !! it came through a pipe and cannot be read again
      integer, allocatable :: first(:)    !! (lines) first character of each line
      integer, allocatable :: last(:)     !! (lines) last character of each line, without its end
   end type source_t

contains

   !> Make a source from a string.
   pure subroutine new_source(source, name, content)
      type(source_t), intent(out) :: source  !! the new source
      character(*), intent(in) :: name       !! as shown in messages
      character(*), intent(in) :: content    !! its text

      source%name = name
      source%place = name
      source%text = content
      call cut_lines(source)
   end subroutine new_source

   !> Read a file; a deck may also come through a pipe, which is read to its end.
   subroutine read_source(path, source, message, may_be_stream)
      character(*), intent(in) :: path                   !! of the file, also its name in messages
      type(source_t), intent(out) :: source              !! its text; empty if it cannot be read
      character(:), allocatable, intent(out) :: message  !! empty: success; else why not
      logical, intent(in) :: may_be_stream               !! whether a pipe will do

      character(:), allocatable :: bytes

      call new_source(source, path, "")
      source%is_file = .true.
      call read_kept(path, .not. may_be_stream, largest_file, bytes, message, source%is_stream)
      if (source%is_stream) source%place = ""
      if (len(message) > 0) return
      message = why_not_text(bytes)
      if (len(message) > 0) return
      call move_alloc(bytes, source%text)
      call cut_lines(source)
   end subroutine read_source

   !> Why a string is not text; empty if it is.
   pure function why_not_text(string) result(message)
      character(*), intent(in) :: string    !! content of a file
      character(:), allocatable :: message  !! the reason

      integer :: code, i, n_odd

      message = ""
      if (index(string, achar(0)) > 0) then
         message = "not a text file: it contains zero bytes (a binary file, or UTF-16; a deck is UTF-8)"
         return
      end if
      n_odd = 0
      do i = 1, len(string)
         code = iachar(string(i:i))
         if ((code < 32 .and. (code < 9 .or. code > 13)) .or. code == 127) n_odd = n_odd + 1
      end do
      if (n_odd > len(string)/50) message = "not a text file: it contains too many control characters"
      if (verify(string, " "//achar(9)//achar(10)//achar(13)) == 0) message = "it is empty"
   end function why_not_text

   !> Find the lines of a source.
   pure subroutine cut_lines(source)
      type(source_t), intent(inout) :: source  !! the source

      integer :: at, i, n

      n = 1
      do i = 1, len(source%text)
         if (source%text(i:i) == achar(10)) n = n + 1
      end do
      if (len(source%text) > 0) then
         if (source%text(len(source%text):) == achar(10)) n = n - 1
      end if
      if (allocated(source%first)) deallocate (source%first, source%last)
      allocate (source%first(n), source%last(n))
      at = 1
      if (starts_with_mark(source%text)) at = 4
      do i = 1, n
         source%first(i) = at
         source%last(i) = index(source%text(at:), achar(10)) + at - 2
         if (source%last(i) < at - 1) source%last(i) = len(source%text)
         at = source%last(i) + 2
         if (source%last(i) < source%first(i)) cycle
         if (source%text(source%last(i):source%last(i)) == achar(13)) source%last(i) = source%last(i) - 1
      end do
   end subroutine cut_lines

   !> Whether a text starts with the byte order mark of UTF-8.
   pure logical function starts_with_mark(string)
      character(*), intent(in) :: string  !! any text

      starts_with_mark = .false.
      if (len(string) < 3) return
      starts_with_mark = iachar(string(1:1)) == 239 .and. iachar(string(2:2)) == 187 .and. iachar(string(3:3)) == 191
   end function starts_with_mark

   !> Number of lines.
   pure integer function n_line_of(source)
      type(source_t), intent(in) :: source  !! the source

      n_line_of = 0
      if (allocated(source%first)) n_line_of = size(source%first)
   end function n_line_of

   !> One line, without its end; empty if there is none.
   pure function line_of(source, k) result(line)
      type(source_t), intent(in) :: source  !! the source
      integer, intent(in) :: k              !! number of the line from 1
      character(:), allocatable :: line     !! its text

      line = ""
      if (k < 1 .or. k > n_line_of(source)) return
      line = source%text(source%first(k):source%last(k))
   end function line_of

end module source_text
