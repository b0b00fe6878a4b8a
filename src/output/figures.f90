!> Finished figures at the end of a run: one gnuplot script each, and the picture it draws.
!>
!> gnuplot is started directly, with fixed file names made of the deck's checked names; text of the
!> deck reaches it only inside single-quoted strings of the scripts. That gnuplot is not installed,
!> or fails, is a warning: the scripts stay.
module figures
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use figure_data, only: curve_t, data_files_t, find_curves
   use figure_script, only: figure_text
   use figure_words, only: figure_portrait, figure_t
   use plot_table, only: plot_table_t, write_plot
   use posix, only: is_missing, make_directory, remove_file, start_program, system_message, wait_program
   use text, only: append_text, text_t, to_text
   use text_file, only: fail_file, write_file
   implicit none (type, external)
   private
   public :: draw_figures, make_figures

   integer, parameter :: most_at_once = 4           !! gnuplots running side by side
   character(*), parameter :: ideal_suffix = ".ideal"  !! of the files of the ideal twin

contains

   !> Write the scripts of all figures and draw them.
   subroutine make_figures(directory, title, list, catalogue, tables, pictures, warnings, error)
      character(*), intent(in) :: directory                        !! of the run
      character(*), intent(in) :: title                            !! of the scene, any text
      type(figure_t), intent(in) :: list(:)                        !! (n) figures
      type(catalogue_t), intent(in) :: catalogue                   !! what was recorded
      type(plot_table_t), intent(in) :: tables(:)                  !! (n) numbers of those that are no histories
      type(text_t), allocatable, intent(out) :: pictures(:)        !! (m) pictures made, paths within the directory
      type(text_t), allocatable, intent(out) :: warnings(:)        !! (k) what was not made, and why
      type(error_t), allocatable, intent(out) :: error             !! a script cannot be written

      type(text_t), allocatable :: names(:)
      type(curve_t), allocatable :: curves(:), ideal(:)
      type(data_files_t) :: files
      character(:), allocatable :: script
      integer :: code, k
      logical :: is_written

      allocate (pictures(0), warnings(0), names(0))
      if (size(list) == 0) return
      code = make_directory(directory//"/figures")
      if (code /= 0) then
         call fail_file(error, "cannot make the directory", directory//"/figures", code, "")
         return
      end if
      do k = 1, size(list)
         if (is_named(list(k)%name, names)) cycle
         if (list(k)%kind > figure_portrait) then
            call write_plot(directory//"/figures", title, tables(k), is_written, error)
            if (allocated(error)) return
            if (is_written) then
               call append_text(names, list(k)%name)
            else
               call append_text(warnings, "figure "//list(k)%word//": no numbers to draw")
            end if
            cycle
         end if
         call find_curves(list(k), catalogue, directory, "", files, curves)
         call find_curves(list(k), catalogue, directory, ideal_suffix, files, ideal)
         script = figure_text(list(k), catalogue, title, curves, ideal)
         if (len(script) == 0) then
            call append_text(warnings, "figure "//list(k)%word//": no numbers to draw")
            cycle
         end if
         call write_file(directory//"/figures/"//list(k)%name//".gp", script, error)
         if (allocated(error)) return
         call append_text(names, list(k)%name)
      end do
      call draw_figures(directory//"/figures", names, pictures, warnings)
   end subroutine make_figures

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

   !> Run gnuplot on every script, some of them side by side.
   subroutine draw_figures(folder, names, pictures, warnings)
      character(*), intent(in) :: folder                            !! of the figures
      type(text_t), intent(in) :: names(:)                          !! (n) figures
      type(text_t), allocatable, intent(inout) :: pictures(:)       !! (m) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) what was not made, and why

      integer :: code, first, k, last, process(size(names))

      do first = 1, size(names), most_at_once
         last = min(first + most_at_once - 1, size(names))
         do k = first, last
            code = start_program(folder, "gnuplot", [text_t("-d"), text_t(names(k)%s//".gp")], names(k)%s//".log", process(k))
            if (code == 0) cycle
            process(k) = 0
            if (is_missing(code)) then
               call append_text(warnings, "gnuplot is not installed: the figures are left as scripts in "//folder)
               last = k - 1
               exit
            end if
            call append_text(warnings, "figure "//names(k)%s//": gnuplot cannot be started: "//system_message(code))
         end do
         do k = first, last
            if (process(k) > 0) call end_drawing(folder, names(k)%s, process(k), pictures, warnings)
         end do
         if (last < min(first + most_at_once - 1, size(names))) return
      end do
   end subroutine draw_figures

   !> Wait for one gnuplot and see what came of it.
   subroutine end_drawing(folder, name, process, pictures, warnings)
      character(*), intent(in) :: folder                            !! of the figures
      character(*), intent(in) :: name                              !! of the figure
      integer, intent(in) :: process                                !! the running gnuplot
      type(text_t), allocatable, intent(inout) :: pictures(:)       !! (m) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)       !! (k) what was not made, and why

      integer :: code, ignored

      code = wait_program(process)
      if (code == 0) then
         ignored = remove_file(folder//"/"//name//".log")
         call append_text(pictures, "figures/"//name//".png")
      else
         call append_text(warnings, "figure "//name//": gnuplot ended with code "//to_text(code)// &
                          ", its message is in "//folder//"/"//name//".log")
      end if
   end subroutine end_drawing

end module figures
