!> Bushings, fields and beams of an Adams dataset as rows of a deck.
!>
!> | Adams | deck |
!> |---|---|
!> | BUSHING | `force.bushing` along the axes of J |
!> | FIELD with KMATRIX | `force.bushing` with couplings; FORCE and LENGTH as preload |
!> | BEAM | `force.beam`, x along that of the markers |
!>
!> i is the marker J, whose axes count in Adams, and j is I. In Adams the load is that on I, F = -K x - C x' + FORCE; a preload of a
!> deck acts on i: it has the other sign. A beam of Adams has the axes of J, that of a deck lies halfway between both ends: for
!> small deflections both have the same matrix.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: no CMATRIX but the diagonal one of a FIELD; KMATRIX
!> symmetric.
module adams_elastic
   use adams_joints, only: named, two_markers
   use adams_model, only: adams_model_t, leave_out
   use adams_numbers, only: argument_numbers, mistake
   use dataset, only: find_argument, statement_t
   use deck_draft, only: body_axis, deck_draft_t, tab
   use deck_table, only: direction_cell, number_cell
   use diagnostics, only: diagnostics_t
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: add_elastic

   character(*), parameter :: bushing_header = "name i j axis_i axis_j x_i x_j " &
      //"stiffness_x[N/m] stiffness_y[N/m] stiffness_z[N/m] " &
      //"angular_stiffness_x[N.m/rad] angular_stiffness_y[N.m/rad] angular_stiffness_z[N.m/rad] " &
      //"damping_x[N.s/m] damping_y[N.s/m] damping_z[N.s/m] " &
      //"angular_damping_x[N.m.s/rad] angular_damping_y[N.m.s/rad] angular_damping_z[N.m.s/rad] damping_time[s] " &
      //"preload_x[N] preload_y[N] preload_z[N] preload_moment_x[N.m] preload_moment_y[N.m] preload_moment_z[N.m] " &
      //"coupling[N/m] angular_coupling[N.m/rad] cross_coupling[N/rad]"
   character(*), parameter :: beam_header = "name i j length[m] axis_i axis_j y_i y_j modulus[Pa] shear_modulus[Pa] area[m^2] " &
      //"second_moment_y[m^4] second_moment_z[m^4] torsion_constant[m^4] shear_ratio_y shear_ratio_z damping_time[s]"

contains

   !> All of them.
   subroutine add_elastic(model, draft, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: k, marker(2)

      do k = 1, size(model%statements)
         associate (it => model%statements(k))
            if (.not. any(it%keyword == [character(7) :: "BUSHING", "FIELD", "BEAM"])) cycle
            call two_markers(model, it, marker, mistakes)
            if (any(marker == 0)) cycle
            if (it%keyword == "BUSHING") call add_bushing(model, draft, it, marker, mistakes)
            if (it%keyword == "FIELD") call add_field(model, draft, it, marker, mistakes)
            if (it%keyword == "BEAM") call add_beam(model, draft, it, marker, mistakes)
         end associate
      end do
   end subroutine add_elastic

   !> Numbers of an argument, a fixed count of them; zeros without it.
   subroutine take_numbers(statement, name, numbers, mistakes, minimum, is_needed)
      type(statement_t), intent(in) :: statement            !! the statement
      character(*), intent(in) :: name                      !! of the argument
      real(wp), intent(out) :: numbers(:)                   !! (n) the numbers [any]
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is wrong
      integer, intent(in) :: minimum                        !! letters that do for the name
      logical, intent(in), optional :: is_needed            !! without it there is no such element

      real(wp), allocatable :: found(:)
      logical :: may_be_omitted

      call argument_numbers(statement, name, found, mistakes, minimum)
      numbers = 0.0_wp
      may_be_omitted = .true.
      if (present(is_needed)) may_be_omitted = .not. is_needed
      if (size(found) == size(numbers)) then
         numbers = found
      else if (size(found) > 0 .or. .not. may_be_omitted) then
         call mistake(mistakes, statement%at, name//" of "//statement%keyword//"/"//to_text(statement%id)//" has "// &
                      to_text(size(found))//" numbers where "//to_text(size(numbers))//" are expected", "")
      end if
   end subroutine take_numbers

   !> Whether an argument is there.
   logical function has(statement, name, minimum)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! of the argument
      integer, intent(in) :: minimum               !! letters that do for the name

      has = find_argument(statement, name, minimum) > 0
   end function has

   !> A bushing.
   subroutine add_bushing(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp) :: damping(6), k(6, 6), load(6), stiffness(6)
      integer :: c

      call take_numbers(statement, "K", stiffness(1:3), mistakes, 1)
      call take_numbers(statement, "KT", stiffness(4:6), mistakes, 2)
      call take_numbers(statement, "C", damping(1:3), mistakes, 1)
      call take_numbers(statement, "CT", damping(4:6), mistakes, 2)
      call take_numbers(statement, "FORCE", load(1:3), mistakes, 1)
      call take_numbers(statement, "TORQUE", load(4:6), mistakes, 1)
      k = 0.0_wp
      do c = 1, 6
         k(c, c) = stiffness(c)
      end do
      call put_bushing(model, draft, statement, marker, k, damping, 0.0_wp, -load)
   end subroutine add_bushing

   !> A field: a bushing with all couplings. Its load F = -K (x - LENGTH) + FORCE has the preload -FORCE - K LENGTH.
   subroutine add_field(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      real(wp), parameter :: same = 1.0e-9_wp   ! entries of a matrix, of the largest one [1]
      real(wp) :: c(6, 6), damping(6), k(6, 6), length(6), load(6), numbers(36), ratio(1)
      integer :: i

      if (.not. has(statement, "KMATRIX", 1)) then
         call mistake(mistakes, statement%at, "FIELD/"//to_text(statement%id)//" has no KMATRIX", "user code is not supported")
         return
      end if
      call take_numbers(statement, "KMATRIX", numbers, mistakes, 1)
      k = reshape(numbers, [6, 6])
      call take_numbers(statement, "CMATRIX", numbers, mistakes, 2)
      c = reshape(numbers, [6, 6])
      call take_numbers(statement, "CRATIO", ratio, mistakes, 2)
      call take_numbers(statement, "FORCE", load, mistakes, 1)
      call take_numbers(statement, "LENGTH", length, mistakes, 1)
      do i = 1, 6
         damping(i) = c(i, i)
         c(i, i) = 0.0_wp
      end do
      if (maxval(abs(c)) > 0.0_wp .or. maxval(abs(k - transpose(k))) > same*maxval(abs(k))) then
         call mistake(mistakes, statement%at, "FIELD/"//to_text(statement%id)//" has a CMATRIX that is not diagonal, or a KMATRIX &
                      &that is not symmetric", "a deck has no such element; use CRATIO")
         return
      end if
      call put_bushing(model, draft, statement, marker, k, damping, ratio(1), -load - matmul(k, length))
   end subroutine add_field

   !> A row of a bushing.
   subroutine put_bushing(model, draft, statement, marker, k, damping, ratio, preload)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      real(wp), intent(in) :: k(6, 6)                    !! (6, 6) stiffness, units of the dataset [any]
      real(wp), intent(in) :: damping(6)                 !! (6) damping, units of the dataset [any]
      real(wp), intent(in) :: ratio                      !! damping over stiffness, units of the dataset [any]
      real(wp), intent(in) :: preload(6)                 !! (6) on i, units of the dataset [any]

      character(:), allocatable :: cells, name, point_i, point_j
      real(wp) :: linear, angular, cross

      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(2), point_i)
      call draft%point(model, marker(1), point_j)
      linear = model%units%force/model%units%length
      angular = model%units%force*model%units%length
      cross = model%units%force
      cells = name//tab//point_i//tab//point_j//tab//axis_cell(2, 3)//tab//axis_cell(1, 3)//tab//axis_cell(2, 1)//tab// &
              axis_cell(1, 1)
      call add_cells(linear*[k(1, 1), k(2, 2), k(3, 3)])
      call add_cells(angular*[k(4, 4), k(5, 5), k(6, 6)])
      call add_cells(linear*model%units%time*damping(1:3))
      call add_cells(angular*model%units%time*damping(4:6))
      call add_cells([ratio*model%units%time])
      call add_cells(model%units%force*preload(1:3))
      call add_cells(angular*preload(4:6))
      call add_list(linear*[k(1, 2), k(1, 3), k(2, 3)])
      call add_list(angular*[k(4, 5), k(4, 6), k(5, 6)])
      call add_list(cross*reshape(transpose(k(1:3, 4:6)), [9]))
      call draft%put("force.bushing", bushing_header, cells)

   contains

      !> An axis of marker I or J.
      function axis_cell(m, axis) result(words)
         integer, intent(in) :: m                 !! 1: I, 2: J
         integer, intent(in) :: axis              !! 1 to 3
         character(:), allocatable :: words       !! as a cell

         words = direction_cell(body_axis(model, marker(m), axis))
      end function axis_cell

      !> Cells of numbers.
      subroutine add_cells(x)
         real(wp), intent(in) :: x(:)   !! (n) numbers [any]

         integer :: i

         do i = 1, size(x)
            cells = cells//tab//number_cell(x(i), 0.0_wp)
         end do
      end subroutine add_cells

      !> A cell with a list of numbers; blank if all are zero.
      subroutine add_list(x)
         real(wp), intent(in) :: x(:)   !! (n) numbers [any]

         cells = cells//tab
         if (any(abs(x) > 0.0_wp)) cells = cells//list_cell(x)
      end subroutine add_list

   end subroutine put_bushing

   !> Numbers as a list in quotes.
   pure function list_cell(x) result(words)
      real(wp), intent(in) :: x(:)             !! (n) numbers [any]
      character(:), allocatable :: words       !! the cell

      character(:), allocatable :: one
      integer :: i

      words = ""
      do i = 1, size(x)
         one = number_cell(x(i), 0.0_wp)
         if (one == "") one = "0"
         if (i > 1) words = words//" "
         words = words//one
      end do
      words = """"//words//""""
   end function list_cell

   !> A beam.
   subroutine add_beam(model, draft, statement, marker, mistakes)
      type(adams_model_t), intent(inout) :: model        !! the dataset
      type(deck_draft_t), intent(inout) :: draft         !! the deck
      type(statement_t), intent(in) :: statement         !! the statement
      integer, intent(in) :: marker(2)                   !! (2) I and J
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      character(*), parameter :: names(10) = [character(8) :: "LENGTH", "EMODULUS", "GMODULUS", "AREA", "IYY", "IZZ", "IXX", &
                                              "ASY", "ASZ", "CRATIO"]
      integer, parameter :: letters(10) = [1, 1, 1, 2, 2, 2, 2, 3, 3, 2], n_needed = 7
      character(:), allocatable :: cells, name, point_i, point_j
      real(wp) :: scale(10), x(10)
      integer :: i

      do i = 1, size(names)
         call take_numbers(statement, trim(names(i)), x(i:i), mistakes, letters(i), i <= n_needed)
      end do
      if (has(statement, "CMATRIX", 2)) then
         call leave_out(model, statement, "its CMATRIX has no equivalent in a deck, so that the beam has no damping; use CRATIO")
      end if
      associate (u => model%units)
         scale = [u%length, u%force/u%length**2, u%force/u%length**2, u%length**2, u%length**4, u%length**4, u%length**4, &
                  1.0_wp, 1.0_wp, u%time]
      end associate
      call draft%new_name(named(statement), statement%id, name)
      call draft%point(model, marker(2), point_i)
      call draft%point(model, marker(1), point_j)
      cells = name//tab//point_i//tab//point_j//tab//number_cell(scale(1)*x(1), 0.0_wp)//tab// &
              direction_cell(body_axis(model, marker(2), 1))//tab//direction_cell(body_axis(model, marker(1), 1))//tab// &
              direction_cell(body_axis(model, marker(2), 2))//tab//direction_cell(body_axis(model, marker(1), 2))
      do i = 2, size(names)
         cells = cells//tab//number_cell(scale(i)*x(i), 0.0_wp)
      end do
      call draft%put("force.beam", beam_header, cells)
   end subroutine add_beam

end module adams_elastic
