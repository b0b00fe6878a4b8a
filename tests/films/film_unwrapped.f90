!> The unwrapped film of a bearing of L/D = 1 at eps = 0.6 that turns: film_unwrapped none|grooves > FILE
!>
!> Columns: angle from the wide gap [deg], place along the bearing over its length, P over w_J + w_B, gap over c; a blank line
!> between columns of the film, as gnuplot needs it.
program film_unwrapped
   use, intrinsic :: iso_fortran_env, only: output_unit
   use film_grid_case, only: result_of, steady, two_grooves
   use kinds, only: pi, wp
   use reynolds_field, only: film_field
   use reynolds_grid, only: boundary_reynolds, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t
   implicit none (type, external)

   integer, parameter :: n = 181, m = 41  !! lattice
   type(reynolds_grid_t) :: grid
   type(film_result_t) :: film
   type(supply_t), allocatable :: supply(:)
   real(wp) :: h(m, n), p(m, n), theta(n), y(m)
   character(16) :: word
   integer :: j, k

   call get_command_argument(1, word)
   allocate (supply(0))
   if (word == "grooves") supply = two_grooves()
   call new_reynolds_grid(grid, 1.0_wp, 240, 24, boundary_reynolds, supply, .false.)
   film = result_of(grid, steady([0.6_wp*cos(0.75_wp), 0.6_wp*sin(0.75_wp)]))
   theta = [(0.75_wp - pi + 2.0_wp*pi*(k - 1)/(n - 1), k=1, n)]
   y = [(-1.0_wp + 2.0_wp*(j - 1)/(m - 1), j=1, m)]
   call film_field(grid, theta, y, p, h)
   do k = 1, n
      do j = 1, m
         write (output_unit, "(4es14.6)") (theta(k) - theta(1))*180.0_wp/pi, 0.5_wp*y(j), p(j, k), h(j, k)
      end do
      write (output_unit, "(a)") ""
   end do
end program film_unwrapped
