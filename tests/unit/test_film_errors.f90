!> docs/data/film_errors.csv says what the films do: some of its rows computed anew, and the claims that are made of them.
module test_film_errors
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use film_comparison, only: column_names, error_row_t, grid_force, motion_names, ratios, row_of, steps_of_eps
   use film_registry, only: n_journal_film_kinds
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_film_errors

   !> A row of the file.
   type :: line_t
      character(24) :: film = " "    !! name of the film
      character(16) :: motion = " "  !! name of the motion
      real(wp) :: ratio = 0.0_wp     !! L/D [1]
      real(wp) :: eps = 0.0_wp       !! eccentricity ratio [1]
      type(error_row_t) :: row       !! errors
   end type line_t

   integer, parameter :: n_line_of_film = size(motion_names)*size(ratios)*size(steps_of_eps)  !! rows of a film in the file

contains

   subroutine run_test_film_errors(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rows", test_rows)
      call suite%test("claims", test_claims)
   end subroutine run_test_film_errors

   !> Read the file.
   subroutine read_lines(error, lines)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      type(line_t), intent(out) :: lines(:)               !! (rows of the file) its rows

      character(200) :: text
      integer :: io, k, unit

      open (newunit=unit, file="docs/data/film_errors.csv", status="old", action="read", iostat=io)
      call check_equal(error, io, 0, "docs/data/film_errors.csv can be read")
      if (allocated(error)) return
      read (unit, "(a)") text
      call check_equal(error, trim(text), column_names, "columns")
      do k = 1, size(lines)
         read (unit, "(a)", iostat=io) text
         call check_equal(error, io, 0, "rows: make film-errors")
         if (allocated(error)) exit
         associate (line => lines(k))
            read (text, *) line%film, line%motion, line%ratio, line%eps, line%row%force, line%row%angle, line%row%error
         end associate
      end do
      close (unit)
   end subroutine read_lines

   !> One row in 53, of which each film and each motion has some.
   subroutine test_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(line_t), allocatable :: lines(:)
      type(error_row_t) :: row
      character(:), allocatable :: name
      integer :: k, kind, motion

      allocate (lines(n_journal_film_kinds()*n_line_of_film))
      call read_lines(error, lines)
      if (allocated(error)) return
      do k = 7, size(lines), 53
         associate (line => lines(k))
            kind = 1 + (k - 1)/n_line_of_film
            motion = findloc(motion_names == line%motion, .true., dim=1)
            call row_of(kind, line%ratio, line%eps, motion, grid_force(line%ratio, line%eps, motion), name, row)
            call check_equal(error, trim(line%film), name, "film")
            call check_close(error, row%force, line%row%force, 1.0e-4_wp*line%row%force, name//": force")
            call check_close(error, row%angle, line%row%angle, 2.0e-3_wp, name//": angle")
            call check_close(error, row%error, line%row%error, 1.0e-4_wp*line%row%error + 2.0e-4_wp, name//": error")
         end associate
      end do
   end subroutine test_rows

   !> `finite` is within 0.5 % of the grid, the grid of every day within 0.3 % of a finer one, no other film everywhere within 10 %.
   subroutine test_claims(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(line_t), allocatable :: lines(:)
      real(wp) :: maximum
      integer :: k, kind

      allocate (lines(n_journal_film_kinds()*n_line_of_film))
      call read_lines(error, lines)
      if (allocated(error)) return
      do kind = 1, n_journal_film_kinds()
         k = (kind - 1)*n_line_of_film
         maximum = maxval(lines(k + 1:k + n_line_of_film)%row%error)
         select case (lines(k + 1)%film)
         case ("finite"); call check_true(error, maximum < 0.5_wp, "finite: within 0.5 %")
         case ("grid"); call check_true(error, maximum < 0.3_wp, "grid: within 0.3 %")
         case default; call check_true(error, maximum > 10.0_wp, trim(lines(k + 1)%film)//": not so right everywhere")
         end select
      end do
   end subroutine test_claims

end module test_film_errors
