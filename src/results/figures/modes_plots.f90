!> The Campbell diagram as a figure: frequencies and real parts over the parameter, one line for each branch, changes of
!> stability as marks.
!>
!> `campbell.dat` has a block for each branch: parameter, natural frequency, real part, imaginary part over 2 pi; then one of the
!> changes of stability.
module modes_plots
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use kinds, only: two_pi, wp
   use modes_results, only: frequency_of, modes_study_t
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: write_modes_plots

contains

   !> Write numbers and script into the folder of the figures.
   subroutine write_modes_plots(folder, title, heading, study, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(modes_study_t), intent(in) :: study                 !! the study
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      integer :: k, n_branch

      allocate (names(0))
      n_branch = maxval([0, (maxval([0, study%points(k)%branch]), k=1, size(study%points))])
      if (size(study%points) < 2 .or. n_branch == 0) return
      call write_file(folder//"/campbell.dat", heading//rows_of(study, n_branch), error)
      if (.not. allocated(error)) call write_file(folder//"/campbell.gp", script_of(study, n_branch, title), error)
      if (.not. allocated(error)) call append_text(names, "campbell")
   end subroutine write_modes_plots

   !> The numbers.
   function rows_of(study, n_branch) result(text)
      type(modes_study_t), intent(in) :: study    !! the study
      integer, intent(in) :: n_branch             !! branches
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      integer :: branch, i, k

      do branch = 1, n_branch
         call lines%line("# branch "//to_text(branch)//": "//study%plan%parameter//", frequency, real part, imaginary part/(2 pi)")
         do k = 1, size(study%points)
            associate (point => study%points(k))
               do i = 1, size(point%branch)
                  if (point%branch(i) == branch) call lines%line(row_of(point%p, point%eigenvalues(i)))
               end do
            end associate
         end do
         call lines%line("")
         call lines%line("")
      end do
      if (size(study%onsets) > 0) call lines%line("# changes of stability")
      do k = 1, size(study%onsets)
         call lines%line(row_of(study%onsets(k)%p, study%onsets(k)%eigenvalue))
      end do
      text = lines%get()
   end function rows_of

   !> A row.
   function row_of(p, value) result(row)
      real(wp), intent(in) :: p                   !! the parameter [any]
      complex(wp), intent(in) :: value            !! the eigenvalue [1/s]
      character(:), allocatable :: row            !! numbers

      row = number_row([p, frequency_of(value), value%re, value%im/two_pi])
   end function row_of

   !> Two panels over the parameter.
   function script_of(study, n_branch, title) result(script)
      type(modes_study_t), intent(in) :: study    !! the study
      integer, intent(in) :: n_branch             !! branches
      character(*), intent(in) :: title           !! of the scene, any text
      character(:), allocatable :: script         !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      character(:), allocatable :: words
      integer :: branch, panel

      unit = choose_unit(study%plan%unit, max(abs(study%plan%from), abs(study%plan%to)))
      call preamble(lines, "campbell", 1200, 1100)
      call lines%line("set multiplot layout 2,1 title "//quoted(title)//" font ',17'; set lmargin 13; set rmargin 5; unset key")
      call lines%line("set format x '%g'; f = "//real_text(unit%factor, 9))
      words = study%plan%parameter
      if (unit%symbol /= "" .and. unit%symbol /= "1") words = words//" ["//unit%symbol//"]"
      call lines%line("set xlabel "//quoted(words))
      do panel = 1, 2
         if (panel == 1) then
            call lines%line("set ylabel 'natural frequency [Hz]'; set yrange [0:*]")
         else
            call lines%line("set ylabel 'real part [1/s]'; set yrange [*:*]; set arrow 1 from graph 0, first 0 to graph 1, " &
                            //"first 0 nohead dashtype 3 linecolor rgb '#808080'")
         end if
         words = "plot "
         do branch = 1, n_branch
            if (branch > 1) words = words//", \"//new_line("a")//"   "
            words = words//"'campbell.dat' index "//to_text(branch - 1)//" using ($1*f):"//to_text(panel + 1)// &
                    " with linespoints pointtype 7 pointsize 0.5 linewidth 2 linecolor rgb '"// &
                    colours(modulo(branch - 1, size(colours)) + 1)//"'"
         end do
         if (size(study%onsets) > 0) words = words//", \"//new_line("a")//"   'campbell.dat' index "//to_text(n_branch)// &
            " using ($1*f):"//to_text(panel + 1)//" with points pointtype 4 pointsize 2 linecolor rgb '#000000'"
         call lines%line(words)
      end do
      call lines%line("unset multiplot")
      script = lines%get()
   end function script_of

end module modes_plots
