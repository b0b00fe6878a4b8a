!> The film on a grid: closed forms of short, long and still films, order of convergence, dissipation, tilt, supplies.
module test_reynolds_grid
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_case, only: components, film_case_t, make_film, unit_bearing
   use film_grid_case, only: at_widest_gap, make_grid, result_of, steady, two_grooves
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use reynolds_grid, only: boundary_full, boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_reynolds_grid

contains

   subroutine run_test_reynolds_grid(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("short_film", test_short_film)
      call suite%test("long_film", test_long_film)
      call suite%test("order", test_order)
      call suite%test("large_eccentricity", test_large_eccentricity)
      call suite%test("potential", test_potential)
      call suite%test("special_states", test_special_states)
      call suite%test("turned_and_mirrored", test_turned_and_mirrored)
      call suite%test("tilt", test_tilt)
      call suite%test("line_of_pressure", test_line_of_pressure)
      call suite%test("hole_and_groove", test_hole_and_groove)
      call suite%test("warm_start", test_warm_start)
   end subroutine run_test_reynolds_grid

   !> A state with e along x.
   pure function state_of(eps, v_r, v_t) result(state)
      real(wp), intent(in) :: eps       !! eccentricity ratio [1]
      real(wp), intent(in) :: v_r, v_t  !! velocity along and across e [1/s]
      type(journal_state_t) :: state       !! the state

      state%e = [eps, 0.0_wp]
      state%v = [v_r, v_t]
   end function state_of

   !> L/D = 0.02: the short forms, full film and positive part; forces of mu L^3 R/c^2 are 4 (L/D)^2 of mu L R^3/c^2.
   subroutine test_short_film(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: ratio = 0.02_wp
      real(wp), parameter :: states(3, 4) = reshape([0.3_wp, 0.0_wp, 1.0_wp, 0.6_wp, 0.2_wp, -0.4_wp, 0.8_wp, 1.0_wp, 0.0_wp, &
                                                     0.5_wp, -0.3_wp, 1.0_wp], [3, 4])
      type(film_case_t) :: closed
      type(film_result_t) :: film
      type(reynolds_grid_t) :: grid
      character(16) :: name
      integer :: boundary, i

      do boundary = boundary_reynolds, boundary_full
         call make_grid(grid, ratio, 160, 16, boundary)
         name = merge("short_exact     ", "short_sommerfeld", boundary == boundary_reynolds)
         call make_film(trim(name), " ", " ", unit_bearing(), closed)
         do i = 1, size(states, 2)
            associate (eps => states(1, i), eps_dot => states(2, i), om => states(3, i))
               film = result_of(grid, state_of(eps, eps_dot, -0.5_wp*eps*om))
               call check_close(error, film%f/(4.0_wp*ratio**2), components(closed, eps, eps_dot, om), 3.0e-3_wp, &
                                trim(name)//", state "//to_text(i), relative=.true.)
            end associate
         end do
      end do
   end subroutine test_short_film

   !> Full film of L/D = 20 and 40: the ends take a part that goes with D/L; without them it is the long form.
   subroutine test_long_film(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: states(3, 3) = reshape([0.3_wp, 0.0_wp, 1.0_wp, 0.6_wp, 0.2_wp, -0.4_wp, &
                                                     0.8_wp, 1.0_wp, 0.0_wp], [3, 3])
      type(film_case_t) :: closed
      type(film_result_t) :: film, longer
      type(reynolds_grid_t) :: grid, long_grid
      real(wp) :: expected(2)
      integer :: i

      call make_grid(grid, 20.0_wp, 160, 24, boundary_full)
      call make_grid(long_grid, 40.0_wp, 160, 24, boundary_full)
      call make_film("long_sommerfeld", " ", " ", unit_bearing(), closed)
      do i = 1, size(states, 2)
         associate (eps => states(1, i), eps_dot => states(2, i), om => states(3, i))
            expected = components(closed, eps, eps_dot, om)
            film = result_of(grid, state_of(eps, eps_dot, -0.5_wp*eps*om))
            longer = result_of(long_grid, state_of(eps, eps_dot, -0.5_wp*eps*om))
            call check_close(error, film%f, expected, 0.06_wp, "L/D = 20, state "//to_text(i), relative=.true.)
            call check_close(error, 2.0_wp*longer%f - film%f, expected, 1.0e-3_wp, "without ends, state "//to_text(i), &
                             relative=.true.)
         end associate
      end do
   end subroutine test_long_film

   !> Half the cell, a quarter of the error; with rupture too, about.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n(4) = [24, 48, 96, 192]
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      real(wp) :: change(3), f(2, 4)
      integer :: boundary, k

      do boundary = boundary_reynolds, boundary_full
         do k = 1, size(n)
            call make_grid(grid, 1.0_wp, n(k), n(k)/8, boundary)
            film = result_of(grid, state_of(0.7_wp, 0.1_wp, -0.3_wp))
            f(:, k) = film%f
         end do
         change = norm2(f(:, 2:4) - f(:, 1:3), 1)
         call check_true(error, log(change(1)/change(3))/log(4.0_wp) > 1.8_wp, "order is 2, boundary "//to_text(boundary))
         call check_true(error, change(3) < 1.0e-3_wp*norm2(f(:, 4)), "small error, boundary "//to_text(boundary))
      end do
   end subroutine test_order

   !> At eps = 0.999 the grid of every day and one twice as fine agree, in all directions of the motion.
   subroutine test_large_eccentricity(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: fine, grid
      type(film_result_t) :: film, finer
      integer :: k

      call make_grid(grid, 1.0_wp, 120, 12, boundary_reynolds)
      call make_grid(fine, 1.0_wp, 240, 24, boundary_reynolds)
      do k = 0, 6
         associate (angle => pi*k/6.0_wp)
            film = result_of(grid, state_of(0.999_wp, cos(angle), sin(angle)))
            finer = result_of(fine, state_of(0.999_wp, cos(angle), sin(angle)))
            call check_close(error, film%f, finer%f, 6.0e-3_wp, "direction "//to_text(k), relative=.true.)
         end associate
      end do
   end subroutine test_large_eccentricity

   !> Without supplies the force is -grad over v of a convex potential of degree 2, -f.v/2: degree 1, symmetric derivative, f.v <=
   !> 0.
   subroutine test_potential(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-3_wp
      type(reynolds_grid_t) :: grid
      type(journal_state_t) :: state
      type(film_result_t) :: film
      type(random_t) :: random
      real(wp) :: change(2, 2), potential(-1:1), f(2), g(2, 2), v(2)
      integer :: i, k, sign_of

      call make_grid(grid, 0.8_wp, 48, 8, boundary_reynolds)
      do k = 1, 40
         state%e = random%between(0.0_wp, 0.95_wp)*unit(random%between(-pi, pi))
         v = unit(random%between(-pi, pi))
         state%v = v
         film = result_of(grid, state)
         f = film%f
         call check_true(error, dot_product(f, v) < 0.0_wp, "dissipative")
         do i = 1, 2
            do sign_of = -1, 1, 2
               state%v = v
               state%v(i) = state%v(i) + sign_of*step
               film = result_of(grid, state)
               g(:, i) = film%f
               potential(sign_of) = -0.5_wp*dot_product(film%f, state%v)
               change(:, i) = sign_of*film%f + merge(0.0_wp, change(:, i), sign_of < 0)
            end do
            call check_close(error, f(i), -(potential(1) - potential(-1))/(2.0_wp*step), 2.0e-4_wp*norm2(f), "gradient")
         end do
         change = -change/(2.0_wp*step)
         call check_close(error, change(1, 2), change(2, 1), 5.0e-3_wp*maxval(abs(change)), "symmetric")
         call check_true(error, change(1, 1) > 0.0_wp .and. change(1, 1)*change(2, 2) > change(1, 2)*change(2, 1), "convex")
         state%v = 3.7_wp*v
         film = result_of(grid, state)
         call check_close(error, film%f, 3.7_wp*f, 1.0e-9_wp, "degree 1", relative=.true.)
      end do
   end subroutine test_potential

   !> A unit vector.
   pure function unit(angle) result(u)
      real(wp), intent(in) :: angle  !! its angle [rad]
      real(wp) :: u(2)               !! (2) the vector [1]

      u = [cos(angle), sin(angle)]
   end function unit

   !> Exactly e = 0, v = 0, both; and no motion where the gap is not even.
   subroutine test_special_states(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film, other
      integer :: boundary

      do boundary = boundary_reynolds, boundary_full
         call make_grid(grid, 1.0_wp, 40, 6, boundary)
         film = result_of(grid, state_of(0.0_wp, 0.0_wp, 0.0_wp))
         call check_close(error, [film%f, film%side_flow, film%p_max], [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "e = v = 0")
         call check_close(error, film%shear_all, 2.0_wp*pi, 1.0e-12_wp, "shear of an even gap")
         film = result_of(grid, state_of(0.6_wp, 0.0_wp, 0.0_wp))
         call check_close(error, film%f, [0.0_wp, 0.0_wp], 0.0_wp, "v = 0")
         call check_close(error, film%shear_all, 2.0_wp*pi/0.8_wp, 2.0e-3_wp, "shear of an uneven gap")
         call check_close(error, film%h_min, 0.4_wp, 1.0e-14_wp, "least film")
         film = result_of(grid, state_of(0.0_wp, 0.6_wp, 0.8_wp))
         call check_close(error, film%f, -norm2(film%f)*[0.6_wp, 0.8_wp], 1.0e-12_wp, "e = 0: against the motion")
         other = result_of(grid, state_of(1.0e-9_wp, 0.6_wp, 0.8_wp))
         call check_close(error, other%f, film%f, 5.0e-3_wp, "e = 0 and nearly", relative=.true.)
      end do
   end subroutine test_special_states

   !> Without supplies no direction is special, and a mirror image of the motion has that of the force.
   subroutine test_turned_and_mirrored(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(journal_state_t) :: state
      type(film_result_t) :: film, other
      real(wp) :: turn(2, 2)

      call make_grid(grid, 1.0_wp, 60, 8, boundary_reynolds)
      film = result_of(grid, state_of(0.8_wp, 0.1_wp, -0.3_wp))
      turn = reshape([0.28_wp, 0.96_wp, -0.96_wp, 0.28_wp], [2, 2])
      state%e = matmul(turn, [0.8_wp, 0.0_wp])
      state%v = matmul(turn, [0.1_wp, -0.3_wp])
      other = result_of(grid, state)
      call check_close(error, other%f, matmul(turn, film%f), 1.0e-10_wp, "turned", relative=.true.)
      other = result_of(grid, state_of(0.8_wp, 0.1_wp, 0.3_wp))
      call check_close(error, other%f, [film%f(1), -film%f(2)], 1.0e-10_wp, "mirrored", relative=.true.)
   end subroutine test_turned_and_mirrored

   !> The whole length without tilt is the half; a tilt to the other side changes the sign of the couple only; both ends take power.
   subroutine test_tilt(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(supply_t) :: none(0)
      type(reynolds_grid_t) :: half, whole
      type(journal_state_t) :: state
      type(film_result_t) :: film, other

      call make_grid(half, 1.0_wp, 60, 8, boundary_reynolds)
      call new_reynolds_grid(whole, 1.0_wp, 60, 8, boundary_reynolds, none, .true.)
      film = result_of(half, steady([0.3_wp, 0.5_wp]))
      other = result_of(whole, steady([0.3_wp, 0.5_wp]))
      call check_close(error, other%f, film%f, 1.0e-10_wp, "no tilt: force", relative=.true.)
      call check_close(error, [other%side_flow, other%shear_wet], [film%side_flow, film%shear_wet], 1.0e-10_wp, "no tilt: flow")
      call check_close(error, other%f_1, [0.0_wp, 0.0_wp], 1.0e-10_wp, "no tilt: couple")
      state = steady([0.3_wp, 0.5_wp])
      state%g = [0.1_wp, 0.25_wp]
      state%w = [0.2_wp, -0.1_wp]
      film = result_of(whole, state)
      call check_true(error, dot_product(film%f, state%v) + dot_product(film%f_1, state%w) < 0.0_wp, "dissipative")
      call check_true(error, norm2(film%f_1) > 0.05_wp*norm2(film%f), "a tilt has a couple")
      state%g = -state%g
      state%w = -state%w
      other = result_of(whole, state)
      call check_close(error, other%f, film%f, 1.0e-10_wp, "other side: force", relative=.true.)
      call check_close(error, other%f_1, -film%f_1, 1.0e-10_wp, "other side: couple", relative=.true.)
   end subroutine test_tilt

   !> A line along the even gap at P = 1 pushes the journal away: a series,
   !> f = -u sum 2/((i - 1/2) pi)^2 2 k tanh(k pi)/(k^2 + 1), k = (i - 1/2) pi D/L.
   subroutine test_line_of_pressure(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: ratio = 1.5_wp, angle = 0.7_wp
      type(supply_t) :: line(1)
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      real(wp) :: expected, k, part
      integer :: i

      line%angle = angle
      line%pressure = 1.0_wp
      call new_reynolds_grid(grid, ratio, 160, 20, boundary_full, line, .false.)
      film = result_of(grid, state_of(0.0_wp, 0.0_wp, 0.0_wp))
      expected = 0.0_wp
      do i = 1, 4000
         part = (i - 0.5_wp)*pi
         k = part/ratio
         expected = expected + 2.0_wp/part**2*2.0_wp*k*tanh(k*pi)/(k*k + 1.0_wp)
      end do
      call check_close(error, film%f, -expected*[cos(angle), sin(angle)], 5.0e-3_wp*expected, "force of a line")
   end subroutine test_line_of_pressure

   !> A groove over all of the length is one that is nearly so; a hole pushes less; both are where they are in the bearing.
   subroutine test_hole_and_groove(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(supply_t) :: supply(1)
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: groove, hole, nearly
      type(journal_state_t) :: state

      state = steady([0.5_wp, 0.1_wp])
      supply%angle = 2.5_wp
      supply%width = 0.4_wp
      supply%pressure = 0.5_wp
      call new_reynolds_grid(grid, 1.0_wp, 120, 16, boundary_reynolds, supply, .false.)
      groove = result_of(grid, state)
      supply%length = 0.995_wp
      call new_reynolds_grid(grid, 1.0_wp, 120, 16, boundary_reynolds, supply, .false.)
      nearly = result_of(grid, state)
      call check_close(error, nearly%f, groove%f, 0.02_wp, "a groove and nearly one", relative=.true.)
      supply%length = 0.2_wp
      call new_reynolds_grid(grid, 1.0_wp, 120, 16, boundary_reynolds, supply, .false.)
      hole = result_of(grid, state)
      call check_close(error, maxval(grid%film%p, mask=grid%film%is_known), 0.5_wp, 0.0_wp, "pressure in the hole")
      call check_true(error, count(grid%film%is_known) > 0, "some cells are in the hole")
      state%e = 0.0_wp
      state%v = 0.0_wp
      hole = result_of(grid, state)
      call check_close(error, hole%f, -norm2(hole%f)*[cos(2.5_wp), sin(2.5_wp)], 1.0e-3_wp*norm2(hole%f), "away from the hole")
      call check_true(error, hole%side_flow > 0.0_wp, "what comes in goes out")
   end subroutine test_hole_and_groove

   !> A solution does not depend on the one before it.
   subroutine test_warm_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: fresh, grid
      type(journal_state_t) :: state
      type(film_result_t) :: cold, warm
      type(random_t) :: random
      integer :: k

      call new_reynolds_grid(grid, 0.7_wp, 60, 8, boundary_reynolds, two_grooves(), .false.)
      do k = 1, 15
         state%e = random%between(0.0_wp, 0.99_wp)*unit(random%between(-pi, pi))
         state%v = unit(random%between(-pi, pi))
         warm = result_of(grid, state)
         call new_reynolds_grid(fresh, 0.7_wp, 60, 8, boundary_reynolds, two_grooves(), .false.)
         cold = result_of(fresh, state)
         call check_close(error, warm%f, cold%f, 1.0e-9_wp, "state "//to_text(k), relative=.true.)
      end do
      call new_reynolds_grid(grid, 0.7_wp, 60, 8, boundary_reynolds, at_widest_gap(), .false.)
      warm = result_of(grid, steady([0.5_wp, 0.0_wp]))
      cold = result_of(grid, steady([0.0_wp, 0.5_wp]))
      call check_close(error, [-cold%f(2), cold%f(1)], [-warm%f(1), -warm%f(2)], 1.0e-9_wp, "the line turns with e")
   end subroutine test_warm_start

end module test_reynolds_grid
