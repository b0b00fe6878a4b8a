!> The bifurcation diagram of a branch of periodic orbits: stable parts solid, unstable ones dashed, bifurcations as marks.
!>
!> `orbit_branch.dat` has a block for each part of the branch with one stability, and one for each kind of bifurcation: parameter,
!> impact speed, maximum modulus of the multipliers, phase. Without onsets the first free component takes the place of the speed.
module orbit_plots
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use kinds, only: wp
   use orbit_results, only: bifurcation_names, n_bifurcation, orbit_study_t, orbit_t
   use orbit_tables, only: first_speed
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: write_orbit_plots

   real(wp), parameter :: linear = 30.0_wp     !! maximum modulus on a linear axis [1]

   !> Parts of the branch with one stability.
   type :: part_t
      integer :: first = 0              !! its first orbit; parts share their ends
      integer :: last = 0               !! the last one
      logical :: is_stable = .false.    !! all but perhaps the shared ends
   end type part_t

contains

   !> Write numbers and script into the folder of the figures.
   subroutine write_orbit_plots(folder, title, heading, study, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(orbit_study_t), intent(in) :: study                 !! the study
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      type(part_t), allocatable :: parts(:)

      allocate (names(0))
      if (size(study%branch%orbits) < 2) return
      parts = parts_of(study)
      call write_file(folder//"/orbit_branch.dat", heading//rows_of(study, parts), error)
      if (.not. allocated(error)) call write_file(folder//"/orbit_branch.gp", script_of(study, parts, title), error)
      if (.not. allocated(error)) call append_text(names, "orbit_branch")
   end subroutine write_orbit_plots

   !> The parts of the branch.
   pure function parts_of(study) result(parts)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(part_t), allocatable :: parts(:)       !! (n) from its start to its end

      integer :: first, k

      allocate (parts(0))
      first = 1
      associate (orbits => study%branch%orbits)
         do k = 2, size(orbits)
            if ((orbits(k)%is_stable .eqv. orbits(k - 1)%is_stable) .and. k < size(orbits)) cycle
            parts = [parts, part_t(first, k, orbits(k - 1)%is_stable)]
            first = k
         end do
      end associate
   end function parts_of

   !> The numbers.
   function rows_of(study, parts) result(text)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(part_t), intent(in) :: parts(:)        !! (n) of the branch
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      integer :: k, kind

      do k = 1, size(parts)
         call lines%line("# "//trim(merge("stable  ", "unstable", parts(k)%is_stable))//": "//study%plan%parameter//", "// &
                         "impact speed, modulus, phase")
         call add_rows(study%branch%orbits(parts(k)%first:parts(k)%last))
      end do
      do kind = 1, n_bifurcation
         associate (some => study%branch%bifurcations)
            if (.not. any(some%kind == kind)) cycle
            call lines%line("# "//trim(bifurcation_names(kind)))
            do k = 1, size(some)
               if (some(k)%kind == kind) call lines%line(number_row(row_of(study, some(k)%orbit)))
            end do
            call lines%line("")
            call lines%line("")
         end associate
      end do
      text = lines%get()

   contains

      !> A block.
      subroutine add_rows(orbits)
         type(orbit_t), intent(in) :: orbits(:)   !! (n) its rows

         integer :: i

         if (size(orbits) == 0) return
         do i = 1, size(orbits)
            call lines%line(number_row(row_of(study, orbits(i))))
         end do
         call lines%line("")
         call lines%line("")
      end subroutine add_rows

   end function rows_of

   !> A row.
   pure function row_of(study, orbit) result(row)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(orbit_t), intent(in) :: orbit          !! the orbit
      real(wp) :: row(4)                          !! (4) parameter, ordinate, modulus, phase [any]

      row = [orbit%p, first_speed(study, orbit), maxval(abs(orbit%multipliers)), orbit%phase]
      if (.not. row(2) > -huge(1.0_wp)) row(2) = orbit%z(1)*study%scale(1)
   end function row_of

   !> Two panels over the parameter.
   function script_of(study, parts, title) result(script)
      type(orbit_study_t), intent(in) :: study    !! the study
      type(part_t), intent(in) :: parts(:)        !! (n) of the branch
      character(*), intent(in) :: title           !! of the scene, any text
      character(:), allocatable :: script         !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      integer :: k, panel

      unit = choose_unit(study%plan%unit, maxval(abs(study%branch%orbits%p)))
      call preamble(lines, "orbit_branch", 1200, 1100)
      call lines%line("set multiplot layout 2,1 title "//quoted(title)//" font ',17'; set lmargin 13; set rmargin 5")
      call lines%line("set format x '%g'; f = "//real_text(unit%factor, 9))
      do panel = 1, 2
         call lines%line("set xlabel "//quoted(study%plan%parameter//in_brackets(unit%symbol)))
         if (panel == 1) then
            call lines%line("set key below; set ylabel "//trim(merge("'impact speed [m/s]'      ", "'first component at start'", &
                                                                     size(study%orbit%onset) > 0)))
         else
            call lines%line("unset key; set ylabel 'maximum modulus of the multipliers'; set arrow 1 from graph 0, first 1 to " &
                            //"graph 1, first 1 nohead dashtype 3 linecolor rgb '#808080'")
            if (maxval([(maxval(abs(study%branch%orbits(k)%multipliers)), k=1, size(study%branch%orbits))]) > linear) &
               call lines%line("set logscale y; set format y '%g'")
         end if
         call add_curves(lines, study, parts, panel + 1)
      end do
      call lines%line("unset multiplot")
      script = lines%get()

   contains

      !> A unit behind a name.
      function in_brackets(symbol) result(words)
         character(*), intent(in) :: symbol       !! of the unit; 1: none
         character(:), allocatable :: words       !! with a blank before it

         words = ""
         if (symbol /= "" .and. symbol /= "1") words = " ["//symbol//"]"
      end function in_brackets

   end function script_of

   !> The curves and marks of a panel.
   subroutine add_curves(lines, study, parts, column)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(orbit_study_t), intent(in) :: study    !! the study
      type(part_t), intent(in) :: parts(:)        !! (n) of the branch
      integer, intent(in) :: column               !! of the ordinate

      character(:), allocatable :: words
      integer :: block, k, kind
      logical :: is_named(2)

      is_named = .false.
      words = "plot "
      do k = 1, size(parts)
         associate (i => merge(1, 2, parts(k)%is_stable))
            words = words//"'orbit_branch.dat' index "//to_text(k - 1)//" using ($1*f):"//to_text(column)// &
                    " with lines linewidth 2 linecolor rgb '"//colours(i)//"' dashtype "//to_text(i)
            if (is_named(i)) then
               words = words//" notitle, \"//new_line("a")//"   "
            else
               words = words//" title '"//trim(merge("stable  ", "unstable", i == 1))//"', \"//new_line("a")//"   "
            end if
            is_named(i) = .true.
         end associate
      end do
      block = size(parts)
      do kind = 1, n_bifurcation
         if (.not. any(study%branch%bifurcations%kind == kind)) cycle
         words = words//"'orbit_branch.dat' index "//to_text(block)//" using ($1*f):"//to_text(column)// &
                 " with points pointtype "//to_text(4 + 2*kind - merge(1, 0, kind == 1))//" pointsize 2 "// &
                 "linecolor rgb '#000000' title "//quoted(spaced(trim(bifurcation_names(kind))))//", \"//new_line("a")//"   "
         block = block + 1
      end do
      call lines%line(words(:len(words) - 7))
   end subroutine add_curves

   !> Blanks for underscores.
   pure function spaced(name) result(words)
      character(*), intent(in) :: name            !! of a kind of bifurcation
      character(len(name)) :: words               !! as they are shown

      integer :: k

      words = name
      do k = 1, len(name)
         if (name(k:k) == "_") words(k:k) = " "
      end do
   end function spaced

end module orbit_plots
