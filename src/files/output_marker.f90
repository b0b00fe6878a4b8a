!> The marker of an output directory, a file `.gudgeon` in it: who made the directory, and every file that was made there.
!>
!> It is text: a line that says what it is, `key = value` lines, then one path a line, that of a directory with a slash at its
!> end, and `ended` as the last. A file is entered before it is made, so that the marker of a run that was killed has all of
!> them. A process writes to one directory; what is made elsewhere is not entered.
module output_marker
   use kinds, only: i8
   use name_table, only: name_table_t
   use posix, only: host_name, process_number, random_name, write_at
   use system_file, only: read_file
   use text, only: printable, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   use version, only: program_version
   implicit none (type, external)
   private
   public :: begin_marker, end_marker, go_on_with_marker, enter_file, marker_name, marker_t, read_marker

   character(*), parameter :: marker_name = ".gudgeon"                     !! file in the directory
   character(*), parameter :: first_line = "gudgeon output directory, format 1"  !! by which it is known
   character(*), parameter :: files_line = "files:"                        !! after it come the paths
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
   end type marker_t

   !> The directory that this process writes to.
   type :: open_marker_t
      character(:), allocatable :: directory    !! unallocated: none
      integer(i8) :: length = 0                 !! bytes in the marker
      integer :: n = 0                          !! files entered
      type(text_t), allocatable :: files(:)     !! (n or more) their paths
      type(name_table_t) :: table               !! the same
   end type open_marker_t

   type(open_marker_t), target :: here  !! of this process

contains

   !> Say in a marker whose directory this is, and which files are in it already.
   integer function begin_marker(directory, files, id) result(code)
      character(*), intent(in) :: directory     !! as all paths of its files begin
      type(text_t), intent(in) :: files(:)      !! (n) paths of files that an earlier run of the same made
      character(*), intent(in), optional :: id  !! by which a copy is known; absent: a new one

      type(buffer_t) :: names
      character(:), allocatable :: name, text
      integer :: k, previous

      here = open_marker_t()
      name = random_name()
      if (present(id)) name = id
      text = first_line//new_line("a")//"id = "//name//new_line("a")//"program = gudgeon "//program_version// &
             new_line("a")//"host = "//printable(host_name())//new_line("a")//"process = "//to_text(process_number())// &
             new_line("a")//files_line//new_line("a")
      do k = 1, size(files)
         call names%line(files(k)%s)
      end do
      text = text//names%get()
      code = write_at(directory//"/"//marker_name, text, 0_i8)
      if (code /= 0) return
      here%length = len(text, i8)
      here%directory = directory
      here%n = size(files)
      allocate (here%files(max(64, 2*here%n)))
      call here%table%start(size(here%files))
      do k = 1, here%n
         here%files(k)%s = files(k)%s
         call here%table%enter(files(k)%s, k, previous)
      end do
   end function begin_marker

   !> Say in the marker of an earlier run that this process goes on with it.
   integer function go_on_with_marker(directory, marker) result(code)
      character(*), intent(in) :: directory     !! as all paths of its files begin
      type(marker_t), intent(in) :: marker      !! what the marker says

      code = begin_marker(directory, marker%files, marker%id)
   end function go_on_with_marker

   !> Enter a file that is about to be made, or a directory with a slash at its end, unless it is there.
   integer function enter_file(path) result(code)
      character(*), intent(in) :: path  !! of the file

      character(:), allocatable :: name
      integer :: previous

      code = 0
      if (.not. allocated(here%directory)) return
      if (.not. starts_with(path, here%directory//"/")) return
      name = path(len(here%directory) + 2:)
      if (here%table%find(name) > 0) return
      code = write_at(here%directory//"/"//marker_name, name//new_line("a"), here%length)
      if (code /= 0) return
      here%length = here%length + len(name, i8) + 1
      if (here%n == size(here%files)) call grow()
      here%n = here%n + 1
      here%files(here%n)%s = name
      call here%table%enter(name, here%n, previous)
   end function enter_file

   !> Make room for more names.
   subroutine grow()
      type(text_t), allocatable :: larger(:)
      integer :: k, previous

      allocate (larger(2*here%n))
      call here%table%start(size(larger))
      do k = 1, here%n
         call move_alloc(here%files(k)%s, larger(k)%s)
         call here%table%enter(larger(k)%s, k, previous)
      end do
      call move_alloc(larger, here%files)
   end subroutine grow

   !> Say that the run has ended; nothing is entered any more.
   subroutine end_marker()
      integer :: ignored

      if (.not. allocated(here%directory)) return
      ignored = write_at(here%directory//"/"//marker_name, last_line//new_line("a"), here%length)
      here = open_marker_t()
   end subroutine end_marker

   !> Read the marker of a directory.
   subroutine read_marker(directory, marker)
      character(*), intent(in) :: directory    !! the directory
      type(marker_t), intent(out) :: marker    !! what it says; not ours if it cannot be read

      character(:), allocatable :: line, message, text
      integer :: first, k, last, n, status
      logical :: lists_files

      marker%id = ""
      marker%host = ""
      call read_file(directory//"/"//marker_name, .true., largest_marker, text, message)
      marker%is_empty = len(text) == 0 .and. len(message) == 0
      marker%is_ours = starts_with(text, first_line//new_line("a"))
      n = 0
      do k = 1, len(text)
         if (text(k:k) == new_line("a")) n = n + 1
      end do
      if (.not. marker%is_ours) n = 0
      allocate (marker%files(n))
      n = 0
      lists_files = .false.
      first = 1
      do k = 1, size(marker%files)  ! what has no end was not written whole
         last = index(text(first:), new_line("a")) + first - 2
         line = text(first:last)
         first = last + 2
         if (lists_files) then
            if (line == last_line) then
               marker%has_ended = .true.
            else
               n = n + 1
               marker%files(n)%s = line
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
   end subroutine read_marker

end module output_marker
