!> Pictures drawn by gnuplot from scripts, several side by side, each whole or not at all.
!>
!> gnuplot is started directly, with fixed file names made of the deck's checked names. That it is not installed, or that one
!> picture fails, is a warning: the scripts remain.
module gnuplot_runs
   use errors, only: error_t
   use kinds, only: i8
   use output_marker, only: enter_file
   use posix, only: is_missing, make_directory, remove_file, system_message
   use processes, only: clock_ms, start_program, wait_group
   use system_file, only: read_file
   use text, only: append_text, starts_with, text_t, to_text
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: draw_figures, make_folder, moving

   integer, parameter :: most_at_once = 4           !! gnuplots running side by side
   integer, parameter :: most_together = 6          !! pictures that one gnuplot draws
   integer, parameter :: patience = 300             !! that a figure may take, unless the environment says otherwise [s]
   character(*), parameter :: patience_variable = "GUDGEON_GNUPLOT_SECONDS"  !! what says so
   integer(i8), parameter :: largest_picture = 1000000000_i8  !! bytes
   character(*), parameter :: moving = ".gif"       !! ending of pictures that move

contains

   !> Make the folder of the figures, if it is not there.
   subroutine make_folder(folder, error)
      character(*), intent(in) :: folder                 !! of the figures
      type(error_t), allocatable, intent(out) :: error   !! it cannot be made

      integer :: code

      code = enter_file(folder//"/")
      if (code == 0) code = make_directory(folder)
      if (code /= 0) call fail_file(error, "cannot make the directory", folder, code, "")
   end subroutine make_folder

   !> Run gnuplot on every script: on some pictures that stand still one after the other, since to start it takes as long as to draw
   !> one, then alone on each that this did not bring about, and on those that move. Several of them run side by side.
   subroutine draw_figures(folder, names, pictures, warnings)
      character(*), intent(in) :: folder                            !! of the figures
      type(text_t), intent(in) :: names(:)                          !! (n) figures
      type(text_t), allocatable, intent(inout) :: pictures(:)       !! (m) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) what was not made, and why

      logical :: is_drawn(size(names))
      integer :: k, seconds

      if (size(names) == 0) return
      call read_patience(seconds, warnings)
      is_drawn = .false.
      call draw_together(folder, names, seconds, is_drawn)
      call draw_alone(folder, names, pack([(k, k=1, size(names))], .not. is_drawn), seconds, is_drawn, warnings)
      do k = 1, size(names)
         if (is_drawn(k)) call append_text(pictures, "figures/"//picture_of(names(k)%s))
      end do
   end subroutine draw_figures

   !> Pictures that stand still, several by each gnuplot. One that is not whole in the end, for whatever reason, is not drawn.
   subroutine draw_together(folder, names, seconds, is_drawn)
      character(*), intent(in) :: folder        !! of the figures
      type(text_t), intent(in) :: names(:)      !! (n) figures
      integer, intent(in) :: seconds            !! that each gnuplot may take
      logical, intent(inout) :: is_drawn(:)     !! (n) which were

      integer(i8) :: until
      integer, allocatable :: still(:)
      integer :: code, first, k, last, n_group, number, process(most_at_once), share
      logical :: is_late, is_none

      still = pack([(k, k=1, size(names))], [(.not. is_moving(names(k)%s), k=1, size(names))])
      if (size(still) < 2) return
      n_group = (size(still) + most_together - 1)/most_together
      share = (size(still) + n_group - 1)/n_group
      do first = 1, size(still), share*most_at_once
         last = min(first + share*most_at_once - 1, size(still))
         process = 0
         do k = first, last, share
            number = (k - first)/share + 1
            call start_drawing(folder, names, still(k:min(k + share - 1, last)), process(number), code)
            if (is_missing(code)) return
         end do
         until = clock_ms() + 1000_i8*seconds
         is_none = .true.
         do k = first, last
            number = (k - first)/share + 1
            if (process(number) > 0) then
               code = wait_group(process(number), until, is_late)
               process(number) = 0
               code = remove_file(folder//"/"//stem(names(still(k))%s)//".log")
            end if
            is_drawn(still(k)) = is_whole_picture(folder//"/"//picture_of(names(still(k))%s))
            is_none = is_none .and. .not. is_drawn(still(k))
         end do
         if (is_none) return
      end do
   end subroutine draw_together

   !> Each picture by a gnuplot of its own, with a warning if it fails.
   subroutine draw_alone(folder, names, which, seconds, is_drawn, warnings)
      character(*), intent(in) :: folder                            !! of the figures
      type(text_t), intent(in) :: names(:)                          !! (n) figures
      integer, intent(in) :: which(:)                               !! (any) numbers of those that are meant
      integer, intent(in) :: seconds                                !! that each may take
      logical, intent(inout) :: is_drawn(:)                         !! (n) which were
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) what was not made, and why

      integer(i8) :: until
      integer :: code, first, k, last, n_late, process(size(which))

      do first = 1, size(which), most_at_once
         last = min(first + most_at_once - 1, size(which))
         do k = first, last
            call start_drawing(folder, names, which(k:k), process(k), code)
            if (code == 0) cycle
            if (is_missing(code)) then
               call append_text(warnings, "gnuplot is not installed: see the scripts of the figures in "//folder)
               last = k - 1
               exit
            end if
            call append_text(warnings, "figure "//names(which(k))%s//": gnuplot cannot be started: "//system_message(code))
         end do
         until = clock_ms() + 1000_i8*seconds
         n_late = 0
         do k = first, last
            if (process(k) > 0) call end_drawing(folder, names(which(k))%s, process(k), until, seconds, n_late, &
                                                 is_drawn(which(k)), warnings)
         end do
         if (last < min(first + most_at_once - 1, size(which))) return
         if (n_late == last - first + 1 .and. last < size(which)) then
            call append_text(warnings, to_text(size(which) - last)//" further figures were not drawn; their scripts are in "// &
               folder// &
                             ", because gnuplot does not stop")
            return
         end if
      end do
   end subroutine draw_alone

   !> How long a figure may take.
   subroutine read_patience(seconds, warnings)
      integer, intent(out) :: seconds                               !! the limit [s]
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) grown if it cannot be read

      character(32) :: word
      integer :: length, status

      seconds = patience
      call get_environment_variable(patience_variable, word, length, status)
      if (status == 1 .or. length == 0) return
      if (status == 0 .and. verify(trim(word), "0123456789") == 0) read (word, *, iostat=status) seconds
      if (status == 0 .and. verify(trim(word), "0123456789") == 0 .and. seconds >= 1) return
      seconds = patience
      call append_text(warnings, patience_variable//" is not a number of seconds from 1 on; "//to_text(patience)//" s are used")
   end subroutine read_patience

   !> Start gnuplot on scripts. Pictures that lie there are removed.
   subroutine start_drawing(folder, names, which, process, code)
      character(*), intent(in) :: folder     !! of the figures
      type(text_t), intent(in) :: names(:)   !! (n) figures
      integer, intent(in) :: which(:)        !! (any) numbers of those that are meant
      integer, intent(out) :: process        !! the running gnuplot, 0 if it could not be started
      integer, intent(out) :: code           !! 0, or the system's error number

      type(text_t), allocatable :: arguments(:)
      integer :: ignored, k

      process = 0
      allocate (arguments(1))
      arguments(1)%s = "-d"
      code = enter_file(folder//"/"//stem(names(which(1))%s)//".log")
      do k = 1, size(which)
         if (code == 0) code = enter_file(folder//"/"//picture_of(names(which(k))%s))
         if (code == 0) ignored = remove_file(folder//"/"//picture_of(names(which(k))%s))
         call append_text(arguments, "./"//stem(names(which(k))%s)//".gp")
      end do
      if (code /= 0) return
      code = start_program(folder, "gnuplot", arguments, stem(names(which(1))%s)//".log", .true., process)
      if (code /= 0) process = 0
   end subroutine start_drawing

   !> Wait for one gnuplot and see what came of it.
   subroutine end_drawing(folder, name, process, until, seconds, n_late, is_drawn, warnings)
      character(*), intent(in) :: folder                            !! of the figures
      character(*), intent(in) :: name                              !! of the figure
      integer, intent(in) :: process                                !! the running gnuplot
      integer(i8), intent(in) :: until                              !! instant at which it is ended, see `clock_ms` [ms]
      integer, intent(in) :: seconds                                !! that it had [s]
      integer, intent(inout) :: n_late                              !! figures that were not ready
      logical, intent(inout) :: is_drawn                            !! whether there is a picture
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) what was not made, and why

      character(:), allocatable :: path
      integer :: code, ignored
      logical :: is_late

      path = folder//"/"//stem(name)
      code = wait_group(process, until, is_late)
      if (is_late) then
         n_late = n_late + 1
         call append_text(warnings, "figure "//name//": gnuplot exceeded "//to_text(seconds)// &
                          " s and was killed (raise "//patience_variable//")")
      else if (code /= 0) then
         call append_text(warnings, "figure "//name//": gnuplot failed with exit code "//to_text(code)// &
                          ", its message is in "//path//".log")
      else if (.not. is_whole_picture(folder//"/"//picture_of(name))) then
         call append_text(warnings, "figure "//name//": gnuplot wrote an incomplete picture without an error; its "// &
                          "message is in "//path//".log")
      else
         ignored = remove_file(path//".log")
         is_drawn = .true.
         return
      end if
      ignored = remove_file(folder//"/"//picture_of(name))
   end subroutine end_drawing

   !> Name of a picture without its ending.
   pure function stem(name) result(start)
      character(*), intent(in) :: name         !! of the figure, as `file_of` has it
      character(:), allocatable :: start       !! what its script is called

      start = name
      if (is_moving(name)) start = name(:len(name) - len(moving))
   end function stem

   !> File of a picture.
   pure function picture_of(name) result(file)
      character(*), intent(in) :: name         !! of the figure, as `file_of` has it
      character(:), allocatable :: file        !! with its ending

      file = name
      if (.not. is_moving(name)) file = name//".png"
   end function picture_of

   !> Whether a picture moves.
   pure logical function is_moving(name)
      character(*), intent(in) :: name  !! of the figure, or its file

      is_moving = .false.
      if (len(name) > len(moving)) is_moving = name(len(name) - len(moving) + 1:) == moving
   end function is_moving

   !> Whether a file is a PNG picture up to its last chunk, or a GIF up to its trailer.
   logical function is_whole_picture(path)
      character(*), intent(in) :: path  !! the file

      character(*), parameter :: start = char(137)//"PNG"//achar(13)//achar(10)//achar(26)//achar(10)
      character(*), parameter :: end = "IEND"                       !! type of the last chunk, before its checksum
      integer, parameter :: checksum = 4                            !! bytes
      character(:), allocatable :: bytes, message
      integer :: n

      call read_file(path, .true., largest_picture, bytes, message)
      n = len(bytes) - checksum
      is_whole_picture = .false.
      if (n < 0) return
      if (is_moving(path)) then
         is_whole_picture = starts_with(bytes, "GIF8") .and. bytes(len(bytes):) == ";"
         return
      end if
      if (n < len(start) + len(end)) return
      is_whole_picture = bytes(1:len(start)) == start .and. bytes(n - len(end) + 1:n) == end
   end function is_whole_picture

end module gnuplot_runs
