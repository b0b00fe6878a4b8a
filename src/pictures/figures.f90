!> Finished figures at the end of a run: one gnuplot script each, and the picture it draws.
!>
!> gnuplot is started directly, with fixed file names made of the deck's checked names; text of the
!> deck reaches it only inside single-quoted strings of the scripts. That gnuplot is not installed,
!> fails, takes too long or leaves no whole picture is a warning: the scripts stay.
module figures
   use catalogue, only: catalogue_t
   use animation_page, only: page_text
   use curve_script, only: curve_text
   use drawing, only: drawing_t
   use envelope_data, only: count_turns, envelope_t, make_envelope
   use errors, only: error_t
   use field_plot, only: write_field_plot
   use figure_data, only: curve_t, data_files_t, find_curves
   use figure_script, only: figure_text
   use figure_words, only: draws_mechanism, figure_animation, figure_film, figure_history, figure_portrait, figure_t
   use frames, only: frame_keeper_t
   use film_fields, only: film_field_t
   use plot_table, only: plot_table_t, write_plot
   use kinds, only: i8, wp
   use output_marker, only: enter_file
   use posix, only: is_missing, make_directory, remove_file, system_message
   use processes, only: clock_ms, start_program, wait_group
   use scene_plot, only: write_scene_plot
   use system_file, only: read_file
   use text, only: append_text, starts_with, text_t, to_text
   use text_file, only: fail_file, write_file
   implicit none (type, external)
   private
   public :: draw_figures, make_figures

   integer, parameter :: most_at_once = 4           !! gnuplots running side by side
   integer, parameter :: most_together = 6          !! pictures that one gnuplot draws
   integer, parameter :: patience = 300             !! that a figure may take, unless the environment says otherwise [s]
   character(*), parameter :: patience_variable = "GUDGEON_GNUPLOT_SECONDS"  !! what says so
   integer(i8), parameter :: largest_picture = 1000000000_i8  !! bytes
   character(*), parameter :: moving = ".gif"       !! ending of pictures that move
   character(*), parameter :: ideal_suffix = ".ideal"  !! of the files of the ideal twin

contains

   !> Write the scripts of all figures and draw them.
   subroutine make_figures(directory, title, list, catalogue, tables, fields, drawing, keeper, pictures, warnings, error)
      character(*), intent(in) :: directory                        !! of the run
      character(*), intent(in) :: title                            !! of the scene, any text
      type(figure_t), intent(in) :: list(:)                        !! (n) figures
      type(catalogue_t), intent(in) :: catalogue                   !! what was recorded
      type(plot_table_t), intent(in) :: tables(:)                  !! (n) numbers of those that are no histories
      type(film_field_t), intent(in) :: fields(:)                  !! (any) films
      type(drawing_t), intent(in) :: drawing                       !! what the scene looks like
      type(frame_keeper_t), intent(in) :: keeper                   !! pictures of its motion
      type(text_t), allocatable, intent(out) :: pictures(:)        !! (m) pictures made, paths within the directory
      type(text_t), allocatable, intent(out) :: warnings(:)        !! (k) what was not made, and why
      type(error_t), allocatable, intent(out) :: error             !! a script cannot be written

      type(text_t), allocatable :: names(:), pages(:)
      type(data_files_t) :: files
      integer :: code, k
      logical :: is_written

      allocate (pictures(0), warnings(0), names(0), pages(0))
      if (size(list) == 0) return
      code = enter_file(directory//"/figures/")
      if (code == 0) code = make_directory(directory//"/figures")
      if (code /= 0) then
         call fail_file(error, "cannot make the directory", directory//"/figures", code, "")
         return
      end if
      do k = 1, size(list)
         if (is_named(file_of(list(k)), names)) cycle
         if (draws_mechanism(list(k))) then
            call write_scene(directory//"/figures", title, list(k), catalogue, drawing, keeper, is_written, pages, error)
         else if (list(k)%kind == figure_film) then
            call write_field_plot(directory//"/figures", title, tables(k)%heading, list(k)%name, fields, is_written, error)
         else if (list(k)%kind > figure_portrait) then
            call write_plot(directory//"/figures", title, tables(k), is_written, error)
         else
            call write_curves(directory, title, tables(k)%heading, list(k), catalogue, files, is_written, error)
         end if
         if (allocated(error)) return
         if (is_written) then
            call append_text(names, file_of(list(k)))
         else if (list(k)%kind /= figure_film) then  ! of a film that is missing the recorder tells
            call append_text(warnings, "figure "//list(k)%word//": no numbers to draw")
         end if
      end do
      call draw_figures(directory//"/figures", names, pictures, warnings)
      do k = 1, size(pages)
         call append_text(pictures, pages(k)%s)
      end do
   end subroutine make_figures

   !> What a figure is called among the pictures: those that move by the name of their file.
   pure function file_of(figure) result(name)
      type(figure_t), intent(in) :: figure     !! the figure
      character(:), allocatable :: name        !! without the ending of a picture that stands still

      name = figure%name
      if (figure%kind == figure_animation) name = name//moving
   end function file_of

   !> Time histories, orbits and portraits.
   subroutine write_curves(directory, title, heading, figure, catalogue, files, is_written, error)
      character(*), intent(in) :: directory               !! of the run
      character(*), intent(in) :: title                   !! of the scene, any text
      character(*), intent(in) :: heading                 !! lines with `#` for a table
      type(figure_t), intent(in) :: figure                !! the figure
      type(catalogue_t), intent(in) :: catalogue          !! what was recorded
      type(data_files_t), intent(inout) :: files          !! files of numbers looked at so far
      logical, intent(out) :: is_written                  !! there are numbers to draw
      type(error_t), allocatable, intent(out) :: error    !! the script cannot be written

      type(curve_t), allocatable :: curves(:), ideal(:)
      type(envelope_t) :: envelope
      character(:), allocatable :: script
      real(wp) :: window(2)
      integer :: n_turn

      is_written = .false.
      call find_curves(figure, catalogue, directory, "", files, curves)
      call find_curves(figure, catalogue, directory, ideal_suffix, files, ideal)
      if (figure%kind == figure_history .and. size(curves) > 0) then
         window = curves(1)%x_range
         if (figure%curves%x%has_range) window = figure%curves%x%range
         call make_envelope(directory//"/figures", figure%name, heading, curves, window, envelope, error)
         if (allocated(error)) return
         script = curve_text(figure, catalogue, title, curves, ideal, envelope)
      else
         n_turn = 0
         if (figure%kind == figure_portrait .and. size(curves) > 0) then
            n_turn = count_turns(directory//"/figures/"//curves(1)%path, curves(1))
         end if
         script = figure_text(figure, catalogue, title, curves, ideal, n_turn)
      end if
      is_written = len(script) > 0
      if (is_written) call write_file(directory//"/figures/"//figure%name//".gp", script, error)
   end subroutine write_curves

   !> A figure of the mechanism, and of an animation its page.
   subroutine write_scene(folder, title, figure, catalogue, drawing, keeper, is_written, pages, error)
      character(*), intent(in) :: folder                         !! of the figures
      character(*), intent(in) :: title                          !! of the scene, any text
      type(figure_t), intent(in) :: figure                       !! the figure
      type(catalogue_t), intent(in) :: catalogue                 !! what was recorded
      type(drawing_t), intent(in) :: drawing                     !! what the scene looks like
      type(frame_keeper_t), intent(in) :: keeper                 !! pictures of its motion
      logical, intent(out) :: is_written                         !! the run came to its instants
      type(text_t), allocatable, intent(inout) :: pages(:)       !! (any) pages written
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      integer :: k

      is_written = .false.
      do k = 1, size(keeper%n)
         if (keeper%plan%wanted(k)%name /= figure%name .or. keeper%n(k) == 0) cycle
         is_written = .true.
         call write_scene_plot(folder, title, figure, catalogue, drawing, keeper%frames(:keeper%n(k), k), keeper%tracks(k), error)
         if (allocated(error)) return
         if (figure%kind /= figure_animation) return
         call write_file(folder//"/"//figure%name//".html", &
                         page_text(title, catalogue, drawing, keeper%frames(:keeper%n(k), k), keeper%tracks(k)), error)
         call append_text(pages, "figures/"//figure%name//".html")
         return
      end do
   end subroutine write_scene

   !> Whether a figure is already in the list.
   pure logical function is_named(name, names)
      character(*), intent(in) :: name      !! of a figure
      type(text_t), intent(in) :: names(:)  !! (n) figures so far

      integer :: k

      is_named = .false.
      do k = 1, size(names)
         if (names(k)%s == name) is_named = .true.
      end do
   end function is_named

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
               call append_text(warnings, "gnuplot is not installed: the figures are left as scripts in "//folder)
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
            call append_text(warnings, to_text(size(which) - last)//" further figures were left as scripts in "//folder// &
                             ", because gnuplot does not end")
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
      call append_text(warnings, patience_variable//" is not a number of seconds from 1 on; "//to_text(patience)//" s are taken")
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
         call append_text(warnings, "figure "//name//": gnuplot was not ready after "//to_text(seconds)// &
                          " s and was ended ("//patience_variable//"=SECONDS gives it more)")
      else if (code /= 0) then
         call append_text(warnings, "figure "//name//": gnuplot ended with code "//to_text(code)// &
                          ", its message is in "//path//".log")
      else if (.not. is_whole_picture(folder//"/"//picture_of(name))) then
         call append_text(warnings, "figure "//name//": gnuplot left no whole picture, though it reported no failure; its "// &
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

end module figures
