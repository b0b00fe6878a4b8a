!> The unwrapped film: a short film's pressure in closed form, what the cells have, seams and ends.
module test_reynolds_field
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_grid_case, only: make_grid, result_of, steady
   use kinds, only: pi, two_pi, wp
   use reynolds_field, only: film_field
   use reynolds_grid, only: boundary_full, boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t
   implicit none (type, external)
   private
   public :: run_test_reynolds_field

contains

   subroutine run_test_reynolds_field(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("short_film", test_short_film)
      call suite%test("cells", test_cells)
      call suite%test("force", test_force)
   end subroutine run_test_reynolds_field

   !> Where the film is short p = 6 (L/D)^2 (1 - y^2) v.u/h^3, with the wide gap of the journal where it belongs.
   subroutine test_short_film(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: ratio = 0.02_wp, y(3) = [-0.6_wp, 0.0_wp, 0.9_wp]
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      type(journal_state_t) :: state
      real(wp) :: expected, h(3, 7), p(3, 7), theta(7)
      integer :: j, k

      state%e = [0.4_wp, 0.3_wp]
      state%v = [0.2_wp, -0.7_wp]
      call make_grid(grid, ratio, 200, 30, boundary_full)
      film = result_of(grid, state)
      theta = [-3.0_wp, -1.0_wp, 0.0_wp, 0.6435_wp, 2.0_wp, 3.2_wp, 9.0_wp]
      call film_field(grid, theta, y, p, h)
      do k = 1, size(theta)
         do j = 1, size(y)
            associate (u => [cos(theta(k)), sin(theta(k))])
               call check_close(error, h(j, k), 1.0_wp - dot_product(state%e, u), 1.0e-14_wp, "gap")
               expected = 6.0_wp*ratio**2*(1.0_wp - y(j)**2)*dot_product(state%v, u)/h(j, k)**3
            end associate
            call check_close(error, p(j, k), expected, 4.0e-3_wp*maxval(abs(p)), "pressure")
         end do
      end do
   end subroutine test_short_film

   !> In the middles of cells it is their pressure; a turn later the same; nothing at the ends; even over the length.
   subroutine test_cells(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      real(wp), allocatable :: h(:, :), p(:, :), theta(:), y(:)
      integer :: m, n

      call make_grid(grid, 1.0_wp, 40, 8, boundary_reynolds)
      film = result_of(grid, steady([-0.5_wp, 0.4_wp]))
      n = grid%film%n
      m = grid%film%m
      theta = 0.5_wp*(grid%theta(0:n - 1) + grid%theta(1:n))
      y = 0.5_wp*(grid%y(0:m - 1) + grid%y(1:m))
      allocate (h(m, n), p(m, n), source=0.0_wp)
      call film_field(grid, theta, y, p, h)
      call check_close(error, reshape(p, [m*n]), reshape(grid%film%p, [m*n]), 1.0e-10_wp*film%p_max, "cells")
      call check_true(error, film%p_max > 0.0_wp, "there is pressure")
      call film_field(grid, theta - two_pi, -y, p, h)
      call check_close(error, reshape(p, [m*n]), reshape(grid%film%p, [m*n]), 1.0e-10_wp*film%p_max, "a turn later, mirrored")
      y = 1.0_wp
      call film_field(grid, theta, y, p, h)
      call check_close(error, reshape(p, [m*n]), 0.0_wp*reshape(p, [m*n]), 1.0e-12_wp*film%p_max, "at the end")
   end subroutine test_cells

   !> The field of a film with a tilted journal and a hole, integrated on a lattice of its own, is the force of the grid.
   subroutine test_force(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 360, m = 80
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      type(journal_state_t) :: state
      type(supply_t) :: hole(1)
      real(wp), allocatable :: h(:, :), p(:, :)
      real(wp) :: f(2), theta(n), y(m)
      integer :: k

      allocate (h(m, n), p(m, n), source=0.0_wp)
      hole%angle = 2.0_wp
      hole%width = 0.3_wp
      hole%length = 0.3_wp
      hole%pressure = 0.4_wp
      call new_reynolds_grid(grid, 1.0_wp, 120, 16, boundary_reynolds, hole, .true.)
      state = steady([0.3_wp, -0.5_wp])
      state%g = [0.1_wp, 0.15_wp]
      film = result_of(grid, state)
      theta = [((k - 0.5_wp)*two_pi/n, k=1, n)]
      y = [(-1.0_wp + (k - 0.5_wp)*2.0_wp/m, k=1, m)]
      call film_field(grid, theta, y, p, h)
      f = 0.0_wp
      do k = 1, n
         f = f - sum(p(:, k))/m*2.0_wp*pi/n*[cos(theta(k)), sin(theta(k))]
      end do
      call check_close(error, f, film%f, 6.0e-3_wp, "force", relative=.true.)
      call check_close(error, minval(h), film%h_min, 2.0e-2_wp, "least gap")
      call check_close(error, maxval(p), film%p_max, 2.0e-2_wp*film%p_max, "greatest pressure")
   end subroutine test_force

end module test_reynolds_field
