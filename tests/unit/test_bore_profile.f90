!> Bores that are not round: the step in closed form, quadrature of the long film, order of convergence, the gap.
module test_bore_profile
   use bore_profile, only: bore_t
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_grid_case, only: make_grid, result_of
   use fixed_random, only: random_t
   use kinds, only: two_pi, wp
   use reynolds_field, only: film_field
   use reynolds_grid, only: boundary_full, boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_bore_profile

contains

   subroutine run_test_bore_profile(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("no_depth", test_no_depth)
      call suite%test("even_depth", test_even_depth)
      call suite%test("step", test_step)
      call suite%test("long_lobes", test_long_lobes)
      call suite%test("order", test_order)
      call suite%test("min_gap", test_min_gap)
      call suite%test("short_dam", test_short_dam)
   end subroutine run_test_bore_profile

   !> Lobes without dam and points.
   pure function lobes_of(n, preload, offset, start) result(bore)
      integer, intent(in) :: n                !! lobes
      real(wp), intent(in) :: preload         !! of each [1]
      real(wp), intent(in) :: offset          !! of each [1]
      real(wp), intent(in) :: start           !! of the first [rad]
      type(bore_t) :: bore                    !! the bore

      bore%lobes = n
      bore%preload = preload
      bore%offset = offset
      bore%start = start
      allocate (bore%angle(0), bore%depth(0))
   end function lobes_of

   !> A dam 1/c deep in a round bore.
   pure function dam_of(start, arc, length) result(bore)
      real(wp), intent(in) :: start           !! where it starts [rad]
      real(wp), intent(in) :: arc             !! how far it reaches [rad]
      real(wp), intent(in) :: length          !! part of the length [1]
      type(bore_t) :: bore                    !! the bore

      bore = lobes_of(0, 0.0_wp, 0.5_wp, 0.0_wp)
      bore%dam_start = start
      bore%dam_arc = arc
      bore%dam_depth = 1.0_wp
      bore%dam_length = length
   end function dam_of

   !> A grid of a bore without supplies; 1/c is a factor of depths.
   subroutine make_bored(grid, ratio, n, m, boundary, bore)
      type(reynolds_grid_t), intent(out) :: grid  !! the grid
      real(wp), intent(in) :: ratio               !! L/D [1]
      integer, intent(in) :: n, m                 !! columns and rows, about
      integer, intent(in) :: boundary             !! which boundary condition
      type(bore_t), intent(in) :: bore            !! the bore

      type(supply_t) :: none(0)

      call new_reynolds_grid(grid, ratio, n, m, boundary, none, .false., bore)
   end subroutine make_bored

   !> A journal that turns about its centre in a bearing at rest, and moves.
   pure function state_of(e, e_dot, w_j, depth) result(state)
      real(wp), intent(in) :: e(2)            !! (2) eccentricity [1]
      real(wp), intent(in) :: e_dot(2)        !! (2) its rate [1/s]
      real(wp), intent(in) :: w_j             !! speed of the journal [rad/s]
      real(wp), intent(in) :: depth           !! what depths of the bore are multiplied by [1]
      type(journal_state_t) :: state          !! the state

      state%e = e
      state%v = e_dot - 0.5_wp*w_j*[-e(2), e(1)]
      state%spin = w_j
      state%per_clearance = depth
   end function state_of

   !> A bore without depth that goes through all that a bore does: forces of the round one to round-off.
   subroutine test_no_depth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bore_t) :: bore
      type(reynolds_grid_t) :: bored, grid
      type(film_result_t) :: film, same
      integer :: boundary

      bore = lobes_of(0, 0.0_wp, 0.5_wp, 0.0_wp)
      bore%angle = [0.0_wp, 2.0_wp, 4.0_wp]
      bore%depth = [1.0_wp, 1.0_wp, 2.0_wp]
      do boundary = boundary_reynolds, boundary_full
         call make_bored(bored, 1.0_wp, 80, 10, boundary, bore)
         call make_grid(grid, 1.0_wp, 80, 10, boundary)
         film = result_of(bored, state_of([0.5_wp, 0.2_wp], [0.1_wp, -0.3_wp], 1.0_wp, 0.0_wp))
         same = result_of(grid, state_of([0.5_wp, 0.2_wp], [0.1_wp, -0.3_wp], 1.0_wp, 0.0_wp))
         call check_close(error, film%f, same%f, 1.0e-11_wp, "force", relative=.true.)
         call check_close(error, [film%side_flow, film%shear_all, film%shear_wet], &
                          [same%side_flow, same%shear_all, same%shear_wet], 1.0e-11_wp, "flow and shear", relative=.true.)
         call check_close(error, film%h_min, same%h_min, 1.0e-14_wp, "gap")
         call check_close(error, film%f_bore, 0.0_wp, 1.0e-12_wp, "no slope")
      end do
   end subroutine test_no_depth

   !> A bore that is as much deeper everywhere is one of a larger clearance.
   subroutine test_even_depth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bore_t) :: bore
      type(reynolds_grid_t) :: bored, grid
      type(film_result_t) :: film, same

      bore = lobes_of(0, 0.0_wp, 0.5_wp, 0.0_wp)
      bore%angle = [0.0_wp, 2.0_wp, 4.0_wp]
      bore%depth = [1.0_wp, 1.0_wp, 1.0_wp]
      call make_bored(bored, 1.0_wp, 240, 24, boundary_reynolds, bore)
      call make_grid(grid, 1.0_wp, 240, 24, boundary_reynolds)
      film = result_of(bored, state_of([0.6_wp, 0.0_wp], [0.1_wp, 0.0_wp], 1.0_wp, 0.5_wp))
      same = result_of(grid, state_of([0.4_wp, 0.0_wp], [0.1_wp/1.5_wp, 0.0_wp], 1.0_wp, 0.0_wp))
      call check_close(error, film%f, same%f/1.5_wp**2, 1.0e-3_wp*norm2(film%f), "force")
      call check_close(error, film%h_min, 0.9_wp, 1.0e-14_wp, "gap")
   end subroutine test_even_depth

   !> Rayleigh's step around a journal in the middle, of a long full film: slopes of the pressure are constant on both sides of it,
   !>
   !> P_1' = 6 w (h_1 - h_2)/(h_1^3 + h_2^3 l_1/l_2),   P_2' = -P_1' l_1/l_2
   !>
   !> and differences of the pressure in the middle of the length are exact, on any grid.
   subroutine test_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: depth = 1.3_wp, arc = 2.1_wp, start = 0.7_wp, w = 1.7_wp
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      real(wp) :: h(1, 3), p(1, 3), slope

      call make_bored(grid, 20.0_wp, 40, 8, boundary_full, dam_of(start, arc, 1.0_wp))
      film = result_of(grid, state_of([0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], w, depth))
      slope = 6.0_wp*w*depth/((1.0_wp + depth)**3 + arc/(two_pi - arc))
      call film_field(grid, start + [0.2_wp, 0.8_wp, 0.5_wp]*arc, [0.0_wp], p, h)
      call check_close(error, p(1, 2) - p(1, 1), slope*0.6_wp*arc, 1.0e-6_wp, "slope in the pocket", relative=.true.)
      call check_close(error, h(1, :), [2.3_wp, 2.3_wp, 2.3_wp], 1.0e-14_wp, "gap in the pocket")
      call film_field(grid, start + arc + [0.1_wp, 0.9_wp, 0.5_wp]*(two_pi - arc), [0.0_wp], p, h)
      call check_close(error, p(1, 1) - p(1, 2), slope*0.8_wp*arc, 1.0e-6_wp, "slope behind it", relative=.true.)
      call check_close(error, h(1, :), [1.0_wp, 1.0_wp, 1.0_wp], 1.0e-14_wp, "gap behind it")
      call check_close(error, film%h_min, 1.0_wp, 1.0e-14_wp, "smallest gap")
   end subroutine test_step

   !> Lobes of a long full film against the quadrature of h^3 P' = 6 w G - 12 (v x u)_z + C, with the ends taken off by comparing
   !> L/D = 20 and 40; offset halves, whose gap jumps, too.
   subroutine test_long_lobes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: offset(3) = [0.5_wp, 1.0_wp, 0.3_wp]
      integer, parameter :: lobes(3) = [2, 2, 3]
      type(reynolds_grid_t) :: longer, long
      type(film_result_t) :: film, other
      type(journal_state_t) :: state
      type(bore_t) :: bore
      real(wp) :: expected(3)
      integer :: i

      state = state_of([0.35_wp, -0.4_wp], [0.2_wp, -0.1_wp], 1.0_wp, 1.0_wp)
      do i = 1, size(lobes)
         bore = lobes_of(lobes(i), 0.5_wp, offset(i), 0.4_wp)
         call make_bored(long, 20.0_wp, 240, 24, boundary_full, bore)
         call make_bored(longer, 40.0_wp, 240, 24, boundary_full, bore)
         film = result_of(long, state)
         other = result_of(longer, state)
         expected = quadrature(bore, state)
         call check_close(error, 2.0_wp*[other%f, other%f_bore] - [film%f, film%f_bore], expected, 1.0e-3_wp*norm2(expected), &
                          "lobes, case "//to_text(i))
      end do
   end subroutine test_long_lobes

   !> f and f_G of an infinitely long full film.
   pure function quadrature(bore, state) result(f)
      type(bore_t), intent(in) :: bore             !! lobes
      type(journal_state_t), intent(in) :: state   !! state of the journal
      real(wp) :: f(3)                             !! (3) force and pressure on the slopes, as the grid has them [1/s]

      integer, parameter :: n = 40000
      real(wp) :: constant, g, h, rate
      real(wp), allocatable :: source(:), theta(:), width(:)
      integer :: k

      allocate (source(n), theta(n), width(n))
      theta = [(bore%start + two_pi*(k - 0.5_wp)/n, k=1, n)]
      do k = 1, n
         g = bore%depth_at(theta(k), theta(k), 1.0_wp)
         h = 1.0_wp + g - dot_product(state%e, [cos(theta(k)), sin(theta(k))])
         source(k) = 6.0_wp*state%spin*g - 12.0_wp*(state%v(1)*sin(theta(k)) - state%v(2)*cos(theta(k)))
         width(k) = 1.0_wp/h**3
      end do
      constant = -sum(source*width)/sum(width)
      f = 0.0_wp
      do k = 1, n
         rate = (source(k) + constant)*width(k)*two_pi/n
         f = f + rate*[sin(theta(k)), -cos(theta(k)), -bore%depth_at(theta(k), theta(k), 1.0_wp)]
      end do
   end function quadrature

   !> Half the cell, a quarter of the error of full films: a lemon bore, and offset halves. A film that ruptures at the step of
   !> offset halves is of first order at last.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n(4) = [24, 48, 96, 192]
      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      real(wp) :: change(3), f(3, 4), offset
      integer :: boundary, i, k

      do i = 1, 2
         offset = 0.5_wp*i
         do boundary = boundary_reynolds, boundary_full
            do k = 1, size(n)
               call make_bored(grid, 1.0_wp, n(k), n(k)/8, boundary, lobes_of(2, 0.5_wp, offset, 0.0_wp))
               film = result_of(grid, state_of([0.3_wp, -0.6_wp], [0.1_wp, 0.0_wp], 1.0_wp, 0.0_wp))
               f(:, k) = [film%f, film%f_bore]
            end do
            change = norm2(f(:, 2:4) - f(:, 1:3), 1)
            call check_true(error, log(change(1)/change(3))/log(4.0_wp) > merge(1.8_wp, 1.4_wp, boundary == boundary_full), &
                            "order "//to_text(log(change(1)/change(3))/log(4.0_wp))//", boundary "//to_text(boundary)//", offset " &
                            //to_text(offset))
            call check_true(error, change(3) < 4.0e-3_wp*norm2(f(:, 4)), "small error, boundary "//to_text(boundary))
         end do
      end do
   end subroutine test_order

   !> The smallest gap against 100000 samples.
   subroutine test_min_gap(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 100000
      type(bore_t) :: bore(4)
      type(random_t) :: random
      real(wp) :: e(2), least, theta
      integer :: i, j, k

      bore(1) = lobes_of(2, 0.6_wp, 0.5_wp, 0.3_wp)
      bore(2) = lobes_of(3, 0.8_wp, 0.9_wp, -2.0_wp)
      bore(3) = dam_of(1.0_wp, 4.0_wp, 1.0_wp)
      bore(4) = lobes_of(0, 0.0_wp, 0.5_wp, 0.0_wp)
      bore(4)%angle = [0.1_wp, 1.0_wp, 3.0_wp, 4.5_wp]
      bore(4)%depth = [0.0_wp, 0.7_wp, 0.1_wp, 1.2_wp]
      do i = 1, size(bore)
         do j = 1, 20
            e = [random%between(-0.7_wp, 0.7_wp), random%between(-0.7_wp, 0.7_wp)]
            least = huge(1.0_wp)
            do k = 1, n
               theta = two_pi*k/n
               associate (g => bore(i)%depth_at(theta, theta, 0.5_wp) + merge(0.5_wp, 0.0_wp, bore(i)%in_dam(theta)))
                  least = min(least, 1.0_wp + g - e(1)*cos(theta) - e(2)*sin(theta))
               end associate
            end do
            call check_close(error, bore(i)%min_gap(e, 0.5_wp), least, 1.0e-4_wp, "bore "//to_text(i)//", place "//to_text(j))
            call check_true(error, bore(i)%min_gap(e, 0.5_wp) <= least + 1.0e-12_wp, "it is the smallest, bore "//to_text(i))
         end do
      end do
   end subroutine test_min_gap

   !> A dam of part of the length is not one of all of it; its edges are edges of rows, so that grids agree.
   subroutine test_short_dam(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: coarse, fine, grid
      type(film_result_t) :: all_along, coarser, finer, part
      type(journal_state_t) :: state

      state = state_of([0.1_wp, -0.3_wp], [0.0_wp, 0.0_wp], 1.0_wp, 2.0_wp)
      call make_bored(grid, 1.0_wp, 160, 16, boundary_reynolds, dam_of(0.5_wp, 2.0_wp, 1.0_wp))
      all_along = result_of(grid, state)
      call make_bored(grid, 1.0_wp, 160, 16, boundary_reynolds, dam_of(0.5_wp, 2.0_wp, 0.7_wp))
      part = result_of(grid, state)
      call make_bored(coarse, 1.0_wp, 80, 8, boundary_reynolds, dam_of(0.5_wp, 2.0_wp, 0.7_wp))
      coarser = result_of(coarse, state)
      call make_bored(fine, 1.0_wp, 320, 32, boundary_reynolds, dam_of(0.5_wp, 2.0_wp, 0.7_wp))
      finer = result_of(fine, state)
      call check_close(error, part%f, finer%f, 6.0e-3_wp*norm2(finer%f), "grid of every day")
      call check_true(error, norm2(part%f - finer%f) < 0.6_wp*norm2(coarser%f - finer%f), "a finer grid is nearer")
      call check_true(error, norm2(part%f - all_along%f) > 0.02_wp*norm2(part%f), "the length counts")
   end subroutine test_short_dam

end module test_bore_profile
