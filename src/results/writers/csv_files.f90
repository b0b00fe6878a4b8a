!> Time histories and events as comma-separated values: each `.dat` file once more, for programs that read nothing else.
!>
!> The first line has the names of the columns, `channel[unit]`; the other lines of the heading are omitted. Numbers and words
!> are those of the `.dat` file, character by character; a cell of what is not known (`NaN`) is empty. Source: RFC 4180; no name
!> or word has a comma, a quote or a blank.
module csv_files
   use errors, only: error_t
   use kinds, only: i8
   use text, only: append_text, segment, text_t
   use text_file, only: fail_file, text_file_t
   use posix, only: remove_file
   implicit none (type, external)
   private
   public :: write_csv_files

   integer, parameter :: block = 1048576   !! characters that are read at once

   !> Where in a line of a `.dat` file its reading is.
   type :: place_t
      integer(i8) :: line = 1          !! number of the line
      logical :: is_at_start = .true.  !! nothing of the line has been read
      logical :: is_heading = .false.  !! it starts with `#`
      logical :: has_word = .false.    !! a word of it has been taken
      logical :: is_between = .false.  !! blanks have been read since
      integer :: n_missing = 0         !! characters of `NaN` that were read and wait; negative: the word is another
   end type place_t

contains

   !> Write a `.csv` beside each file that ends in `.dat`.
   subroutine write_csv_files(directory, names, made, error)
      character(*), intent(in) :: directory                    !! of the run
      type(text_t), intent(in) :: names(:)                     !! (n) files within it
      type(text_t), allocatable, intent(out) :: made(:)        !! (m) files that were written
      type(error_t), allocatable, intent(out) :: error         !! one cannot be read or written; the others are there

      integer :: at, k

      allocate (made(0))
      do k = 1, size(names)
         at = len(names(k)%s) - 3
         if (at < 1) cycle
         if (names(k)%s(at:) /= ".dat") cycle
         associate (name => names(k)%s)
            call convert(directory//"/"//name, directory//"/"//segment(name, 1, at)//"csv", error)
            if (allocated(error)) return
            call append_text(made, segment(name, 1, at)//"csv")
         end associate
      end do
   end subroutine write_csv_files

   !> Write one file.
   subroutine convert(from, to, error)
      character(*), intent(in) :: from                         !! the `.dat` file
      character(*), intent(in) :: to                           !! the `.csv` file
      type(error_t), allocatable, intent(out) :: error         !! it cannot be read or written

      type(text_file_t) :: file
      type(place_t) :: place
      character(:), allocatable :: store, text
      integer(i8) :: at, length
      integer :: code, n, status, unit

      code = remove_file(to)  ! of a run that continued
      open (newunit=unit, file=from, status="old", action="read", access="stream", form="unformatted", iostat=status)
      if (status /= 0) then
         call fail_file(error, "cannot read", from, code, "")
         return
      end if
      inquire (unit=unit, size=length)
      file%path = to
      at = 0
      do while (at < length)
         n = int(min(int(block, i8), length - at))
         allocate (character(n) :: store)
         read (unit, iostat=status) store
         if (status /= 0) exit
         call take(store, place, text)
         call file%append(text, error)
         if (allocated(error)) exit
         at = at + n
         deallocate (store)
      end do
      close (unit)
      if (status /= 0 .and. .not. allocated(error)) call fail_file(error, "cannot read", from, code, "")
   end subroutine convert

   !> Characters of a `.dat` file as those of the other.
   subroutine take(store, place, text)
      character(*), intent(in) :: store                !! what was read
      type(place_t), intent(inout) :: place            !! where in a line it starts, and then ends
      character(:), allocatable, intent(out) :: text   !! the same with commas

      character(:), allocatable :: line
      integer :: k, n

      allocate (character(2*len(store) + 4) :: line)
      n = 0
      do k = 1, len(store)
         associate (c => store(k:k))
            if (c == new_line("a")) then
               call end_word()
               if (place%has_word) call put(c)
               place = place_t(line=place%line + 1)
            else if (place%is_at_start .and. c == "#") then
               place%is_at_start = .false.
               place%is_heading = place%line > 1
            else if (place%is_heading) then
               cycle
            else if (c == " ") then
               call end_word()
               place%is_at_start = .false.
               place%is_between = place%has_word
            else
               if (place%is_between) call put(",")
               call take_character(c)
               place%is_at_start = .false.
               place%has_word = .true.
               place%is_between = .false.
            end if
         end associate
      end do
      text = line(:n)

   contains

      !> A character of a word; one that may be `NaN` waits.
      subroutine take_character(c)
         character, intent(in) :: c   !! the character

         character(*), parameter :: missing = "NaN"
         integer :: i

         associate (waiting => place%n_missing)
            if (waiting >= 0 .and. waiting < len(missing)) then
               if (c == missing(waiting + 1:waiting + 1)) then
                  waiting = waiting + 1
                  return
               end if
            end if
            do i = 1, waiting
               call put(missing(i:i))
            end do
            waiting = -1
            call put(c)
         end associate
      end subroutine take_character

      !> The end of a word: `NaN` leaves nothing, what only started like it is reported.
      subroutine end_word()
         character(*), parameter :: missing = "NaN"
         integer :: i

         if (place%n_missing > 0 .and. place%n_missing < len(missing)) then
            do i = 1, place%n_missing
               call put(missing(i:i))
            end do
         end if
         place%n_missing = 0
      end subroutine end_word

      !> One more character.
      subroutine put(c)
         character, intent(in) :: c   !! the character

         n = n + 1
         line(n:n) = c
      end subroutine put

   end subroutine take

end module csv_files
