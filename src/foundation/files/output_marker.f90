!> The marker of an output directory, a file `.gudgeon` in it: who made the directory, and every file that was made there.
!>
!> It is text: a line that says what it is, `key = value` lines, then one path a line, that of a directory with a slash at its
!> end, and `ended` as the last. A file is entered before it is made, so that the marker of a run that was killed has all of
!> them; once it is made a line `= NUMBER BYTES PATH` says which file it is: its number in the file system, and its bytes, which
!> count once the run has ended. What is there under the name and is another file was not made by the run. A process writes to one
!> directory; what is made elsewhere is not entered.
module output_marker
   use checksum, only: identity_of
   use kinds, only: i8
   use name_table, only: name_table_t
   use posix, only: host_name, process_number, random_name, write_at
   use system_file, only: read_file
   use text, only: printable, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   use version, only: program_version
   implicit none (type, external)
   private
   public :: begin_marker, end_marker, enter_file, is_as_made, marker_name, marker_t, note_files, read_marker

   character(*), parameter :: marker_name = ".gudgeon"                     !! file in the directory
   character(*), parameter :: first_line = "gudgeon output directory, format 2"  !! by which it is known
   character(*), parameter :: older_line = "gudgeon output directory, format 1"  !! one that does not say which files they are
   character(*), parameter :: files_line = "files:"                        !! after it come the paths
   character(*), parameter :: made_word = "= "                             !! starts the line of a file that was made
   character(*), parameter :: last_line = "ended"                          !! the run closed the directory
   integer(i8), parameter :: largest_marker = 1000000000_i8                !! bytes

   !> What a marker says.
   type :: marker_t
      logical :: is_ours = .false.              !! it is a marker of this program
      logical :: is_empty = .false.             !! nothing in it yet
      logical :: has_ended = .false.            !! the run closed the directory
      character(:), allocatable :: id           !! by which a copy is known
      character(:), allocatable :: host         !! machine of the process
      integer(i8) :: process = 0                !! that wrote it, 0 if not known
      type(text_t), allocatable :: files(:)     !! (n) paths of all files made, in their order
      integer(i8), allocatable :: made(:, :)    !! (2, n) which file each is: number and bytes; 0: not known
   end type marker_t

   !> The directory that this process writes to.
   type :: open_marker_t
      character(:), allocatable :: directory    !! unallocated: none
      integer(i8) :: length = 0                 !! bytes in the marker
      integer :: n = 0                          !! files entered
      integer :: n_noted = 0                    !! those of which it was noted which they are, if they were there
      type(text_t), allocatable :: files(:)     !! (n or more) their paths
      logical, allocatable :: is_own(:)         !! (n or more) this process made it, or it is as an earlier run of the same left it
      type(name_table_t) :: table               !! the same
   end type open_marker_t

   type(open_marker_t), target :: here  !! of this process

contains

   !> No marker is open.
   subroutine forget(marker)
      type(open_marker_t), intent(out) :: marker   !! that of this process
   end subroutine forget

   !> Say in a marker whose directory this is, and which files are in it already.
   integer function begin_marker(directory, older) result(code)
      character(*), intent(in) :: directory           !! as all paths of its files start
      type(marker_t), intent(in), optional :: older   !! that of an earlier run that continues; absent: a new one

      type(buffer_t) :: lines
      character(:), allocatable :: name
      integer :: k, n, previous

      call forget(here)
      n = 0
      name = random_name()
      if (present(older)) then
         n = size(older%files)
         name = older%id
      end if
      call lines%line(first_line)
      call lines%line("id = "//name)
      call lines%line("program = gudgeon "//program_version)
      call lines%line("host = "//printable(host_name()))
      call lines%line("process = "//to_text(process_number()))
      call lines%line(files_line)
      allocate (here%files(max(64, 2*n)), here%is_own(max(64, 2*n)))
      call here%table%start(size(here%files))
      do k = 1, n
         here%files(k)%s = older%files(k)%s
         here%is_own(k) = is_as_made(directory, older, k)
         call here%table%enter(here%files(k)%s, k, previous)
         call lines%line(here%files(k)%s)
         if (here%is_own(k)) call add_made(directory, here%files(k)%s, lines)
      end do
      code = write_at(directory//"/"//marker_name, lines%get(), 0_i8)
      if (code /= 0) then
         call forget(here)
         return
      end if
      here%length = lines%length()
      here%directory = directory
      here%n = n
      here%n_noted = n
   end function begin_marker

   !> Enter a file that is about to be made, or a directory with a slash at its end, unless it is there.
   integer function enter_file(path) result(code)
      character(*), intent(in) :: path  !! of the file

      character(:), allocatable :: name
      type(buffer_t) :: lines
      integer :: k, previous

      code = 0
      if (.not. allocated(here%directory)) return
      if (.not. starts_with(path, here%directory//"/")) return
      name = path(len(here%directory) + 2:)
      k = here%table%find(name)
      if (k > 0) then
         here%is_own(k) = .true.
         return
      end if
      call add_unnoted(lines)
      call lines%line(name)
      code = append(lines)
      if (code /= 0) return
      if (here%n == size(here%files)) call grow()
      here%n_noted = here%n
      here%n = here%n + 1
      here%files(here%n)%s = name
      here%is_own(here%n) = .true.
      call here%table%enter(name, here%n, previous)
   end function enter_file

   !> Say which files those are that were entered and are there by now, and one that took the place of another.
   subroutine note_files(path)
      character(*), intent(in), optional :: path  !! that one

      type(buffer_t) :: lines

      if (.not. allocated(here%directory)) return
      call add_unnoted(lines)
      if (present(path)) then
         if (starts_with(path, here%directory//"/")) call add_made(here%directory, path(len(here%directory) + 2:), lines)
      end if
      if (append(lines) == 0) here%n_noted = here%n
   end subroutine note_files

   !> Lines of the files that were not noted yet.
   subroutine add_unnoted(lines)
      type(buffer_t), intent(inout) :: lines  !! grown

      integer :: k

      do k = here%n_noted + 1, here%n
         call add_made(here%directory, here%files(k)%s, lines)
      end do
   end subroutine add_unnoted

   !> The line that says which file one is, if it is there.
   subroutine add_made(directory, name, lines)
      character(*), intent(in) :: directory   !! the directory
      character(*), intent(in) :: name        !! path within it
      type(buffer_t), intent(inout) :: lines  !! grown

      integer(i8) :: made(2)

      if (index(name, "/", back=.true.) == len(name)) return  ! only empty directories are ever removed
      made = identity_of(directory//"/"//name)
      if (made(1) /= 0) call lines%line(made_word//to_text(made(1))//" "//to_text(made(2))//" "//name)
   end subroutine add_made

   !> Append lines to the marker.
   integer function append(lines) result(code)
      type(buffer_t), intent(inout) :: lines  !! what is to be said

      code = 0
      if (lines%length() == 0) return
      code = write_at(here%directory//"/"//marker_name, lines%get(), here%length)
      if (code == 0) here%length = here%length + lines%length()
   end function append

   !> Make storage for more names.
   subroutine grow()
      type(text_t), allocatable :: larger(:)
      logical, allocatable :: own(:)
      integer :: k, previous

      allocate (larger(2*here%n), own(2*here%n))
      own(:here%n) = here%is_own(:here%n)
      call here%table%start(size(larger))
      do k = 1, here%n
         call move_alloc(here%files(k)%s, larger(k)%s)
         call here%table%enter(larger(k)%s, k, previous)
      end do
      call move_alloc(larger, here%files)
      call move_alloc(own, here%is_own)
   end subroutine grow

   !> Say which files the run leaves, and that it has ended; nothing is entered any more.
   subroutine end_marker()
      type(buffer_t) :: lines
      integer :: ignored, k

      if (.not. allocated(here%directory)) return
      do k = 1, here%n
         if (here%is_own(k)) call add_made(here%directory, here%files(k)%s, lines)
      end do
      call lines%line(last_line)
      ignored = append(lines)
      call forget(here)
   end subroutine end_marker

   !> Whether what is under a name of a marker is what the run made there; or it is a directory, or nothing.
   logical function is_as_made(directory, marker, k)
      character(*), intent(in) :: directory    !! the directory
      type(marker_t), intent(in) :: marker     !! its marker
      integer, intent(in) :: k                 !! number of the name

      integer(i8) :: now(2)

      associate (name => marker%files(k)%s)
         is_as_made = index(name, "/", back=.true.) == len(name)
         if (is_as_made) return
         now = identity_of(directory//"/"//name)
         is_as_made = now(1) == 0 .or. (now(1) == marker%made(1, k) .and. &
                                        (now(2) == marker%made(2, k) .or. .not. marker%has_ended))
      end associate
   end function is_as_made

   !> Read the marker of a directory.
   subroutine read_marker(directory, marker)
      character(*), intent(in) :: directory    !! the directory
      type(marker_t), intent(out) :: marker    !! what it says; not ours if it cannot be read

      character(:), allocatable :: line, message, text
      type(name_table_t) :: table
      integer :: first, k, last, n, n_line, previous, status
      logical :: lists_files

      marker%id = ""
      marker%host = ""
      call read_file(directory//"/"//marker_name, .true., largest_marker, text, message)
      marker%is_empty = len(text) == 0 .and. len(message) == 0
      marker%is_ours = starts_with(text, first_line//new_line("a")) .or. starts_with(text, older_line//new_line("a"))
      n = 0
      do k = 1, len(text)
         if (text(k:k) == new_line("a")) n = n + 1
      end do
      if (.not. marker%is_ours) n = 0
      allocate (marker%files(n), marker%made(2, n))
      marker%made = 0
      call table%start(n)
      lists_files = .false.
      first = 1
      n_line = n
      n = 0
      do k = 1, n_line  ! what has no end was not written whole
         last = index(text(first:), new_line("a")) + first - 2
         line = text(first:last)
         first = last + 2
         if (lists_files) then
            if (line == last_line) then
               marker%has_ended = .true.
            else if (starts_with(line, made_word)) then
               call take_made(line, table, marker)
            else
               n = n + 1
               marker%files(n)%s = line
               call table%enter(line, n, previous)
            end if
         else if (line == files_line) then
            lists_files = .true.
         else if (starts_with(line, "id = ")) then
            marker%id = line(6:)
         else if (starts_with(line, "host = ")) then
            marker%host = line(8:)
         else if (starts_with(line, "process = ")) then
            read (line(11:), *, iostat=status) marker%process
            if (status /= 0) marker%process = 0
         end if
      end do
      marker%files = marker%files(1:n)
      marker%made = marker%made(:, 1:n)
   end subroutine read_marker

   !> Take the line that says which file a name is.
   subroutine take_made(line, table, marker)
      character(*), intent(in) :: line         !! as `= NUMBER BYTES PATH`
      type(name_table_t), intent(in) :: table  !! the names so far
      type(marker_t), intent(inout) :: marker  !! its file is known

      integer(i8) :: made(2)
      integer :: at, k, status

      at = index(line(len(made_word) + 1:), " ") + len(made_word)
      at = index(line(at + 1:), " ") + at
      read (line(len(made_word) + 1:at), *, iostat=status) made
      if (status /= 0) return
      k = table%find(line(at + 1:))
      if (k > 0) marker%made(:, k) = made
   end subroutine take_made

end module output_marker
