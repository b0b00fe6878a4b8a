!> Bores that are not round: round bores off the centre, the step in closed form, quadrature of the long film, dissipation, the gap.
module test_bore_profile
   use bore_profile, only: bore_t
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_case, only: film_case_t, force_of
   use film_grid, only: film_grid_t
   use film_grid_case, only: make_grid, result_of
   use film_law, only: film_bearing_t, film_motion_t
   use fixed_random, only: random_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: kind_info_t
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
      call suite%test("round_off_centre", test_round_off_centre)
      call suite%test("even_depth", test_even_depth)
      call suite%test("step", test_step)
      call suite%test("long_lobes", test_long_lobes)
      call suite%test("order", test_order)
      call suite%test("turning_frame", test_turning_frame)
      call suite%test("dissipation", test_dissipation)
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

   !> A film whose bore is a lobe or lobes, R = 10 mm, c = 0.1 mm (or another), L/D = 1.
   subroutine make_lobed(boundary, n, preload, offset, start, clearance, case)
      character(*), intent(in) :: boundary      !! word of the column
      integer, intent(in) :: n                  !! lobes, 0: round
      real(wp), intent(in) :: preload           !! of each [1]
      real(wp), intent(in) :: offset            !! of each [1]
      real(wp), intent(in) :: start             !! of the first [rad]
      real(wp), intent(in) :: clearance         !! of the inscribed circle [m]
      type(film_case_t), intent(out) :: case    !! the film

      character(:), allocatable :: help
      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random

      allocate (film_grid_t :: case%law)
      info = case%law%info()
      call fill_item(info, 1, random, item)
      item%values%given = .false.
      item%values(column_number(info, "preload"))%given = n > 0
      item%values(column_number(info, "boundary"))%text = boundary
      item%values(column_number(info, "resolution"))%text = "fine"
      item%values(column_number(info, "bore"))%text = merge("round", "lobes", n == 0)
      item%values(column_number(info, "lobes"))%number = real(n, wp)
      item%values(column_number(info, "preload"))%number = preload
      item%values(column_number(info, "offset"))%number = offset
      item%values(column_number(info, "bore_angle"))%number = start
      call case%law%prepare(item)
      if (case%law%mistake() /= "") error stop "the bore has a mistake"
      case%bearing = film_bearing_t(0.01_wp, clearance, 0.02_wp, 0.05_wp, 0.9999_wp)
      call case%law%fit(case%bearing, case%parameters, case%message, help)
   end subroutine make_lobed

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

   !> One lobe is a round bore of a larger radius whose centre lies off that of the body, and goes around with it: forces and
   !> moments are those of the round film there, whatever turns. So the motion of the bore is in the equation as it shall be.
   subroutine test_round_off_centre(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp, m = 0.4_wp, w_j = 70.0_wp, w_b = -40.0_wp, start = 0.3_wp, angle = 0.8_wp
      type(film_case_t) :: lobe, round
      type(film_motion_t) :: motion, shifted
      real(wp) :: d(2), f(2), f_round(2), size_of_moment, t_b, t_b_round, t_j, t_j_round
      integer :: boundary

      do boundary = boundary_reynolds, boundary_full
         call make_lobed(merge("reynolds", "full    ", boundary == boundary_reynolds), 1, m, 0.25_wp, start, c, lobe)
         call make_lobed(merge("reynolds", "full    ", boundary == boundary_reynolds), 0, m, 0.25_wp, start, c/(1.0_wp - m), round)
         motion%e = c*[0.3_wp, -0.5_wp]
         motion%e_dot = c*[11.0_wp, 17.0_wp]
         motion%speed_sum = w_j + w_b
         motion%speed_difference = w_j - w_b
         motion%angle = angle
         associate (place => angle + start + 0.25_wp*two_pi)
            d = c*m/(1.0_wp - m)*[cos(place), sin(place)]
         end associate
         shifted = motion
         shifted%e = motion%e + d
         shifted%e_dot = motion%e_dot + w_b*[-d(2), d(1)]
         f = force_of(lobe, motion)
         f_round = force_of(round, shifted)
         call check_close(error, f, f_round, 1.5e-3_wp*norm2(f_round), "force, boundary "//to_text(boundary))
         call lobe%law%torques(motion, lobe%parameters, f, t_j, t_b)
         call round%law%torques(shifted, round%parameters, f_round, t_j_round, t_b_round)
         size_of_moment = abs(t_j_round) + abs(t_b_round)
         call check_close(error, t_j, t_j_round, 1.5e-3_wp*size_of_moment, "moment on the journal")
         call check_close(error, t_b, t_b_round + (d(1)*f_round(2) - d(2)*f_round(1)), 1.5e-3_wp*size_of_moment, &
                          "moment on the bearing, about the centre of its body")
         call check_close(error, lobe%law%min_thickness(c, motion, lobe%parameters), c/(1.0_wp - m) - norm2(shifted%e), &
                          1.0e-12_wp*c, "thickness")
         call check_close(error, lobe%law%side_flow(motion, lobe%parameters), round%law%side_flow(shifted, round%parameters), &
                          5.0e-3_wp, "side flow", relative=.true.)
      end do
   end subroutine test_round_off_centre

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
      real(wp) :: constant, g, h, rate, source(n), theta(n), width(n)
      integer :: k

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

   !> Half the cell, a quarter of the error: a lemon bore, and offset halves, with both boundaries.
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
            call check_true(error, log(change(1)/change(3))/log(4.0_wp) > 1.7_wp, "order is 2, not " &
                            //to_text(log(change(1)/change(3))/log(4.0_wp))//", boundary "//to_text(boundary))
            call check_true(error, change(3) < 2.0e-3_wp*norm2(f(:, 4)), "small error, boundary "//to_text(boundary))
         end do
      end do
   end subroutine test_order

   !> Pressures in a frame that turns with the bearing are those of a bearing at rest; what turns as one body has none.
   subroutine test_turning_frame(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp, w = 33.0_wp, theta(5) = [0.1_wp, 1.0_wp, 2.5_wp, 4.0_wp, 5.5_wp]
      type(film_case_t) :: case
      type(film_motion_t) :: rest, turning
      real(wp) :: gap(2, 5), gap_turning(2, 5), p(2, 5), p_turning(2, 5)

      call make_lobed("reynolds", 3, 0.6_wp, 0.7_wp, 0.2_wp, c, case)
      rest%e = c*[0.2_wp, -0.6_wp]
      rest%e_dot = c*[3.0_wp, 5.0_wp]
      rest%speed_sum = 50.0_wp
      rest%speed_difference = 50.0_wp
      turning = rest
      turning%angle = 1.1_wp
      turning%e = turned(rest%e)
      turning%e_dot = turned(rest%e_dot) + w*[-turning%e(2), turning%e(1)]
      turning%speed_sum = rest%speed_sum + 2.0_wp*w
      call case%law%field(rest, case%parameters, theta, [0.0_wp, 0.5_wp], p, gap)
      call case%law%field(turning, case%parameters, theta, [0.0_wp, 0.5_wp], p_turning, gap_turning)
      call check_close(error, p_turning, p, 1.0e-9_wp*maxval(p), "pressures")
      call check_true(error, maxval(p) > 0.0_wp, "there are pressures")
      call check_close(error, gap_turning, gap, 1.0e-12_wp*c, "gaps")
      rest%speed_sum = 2.0_wp*w
      rest%speed_difference = 0.0_wp
      rest%e_dot = w*[-rest%e(2), rest%e(1)]
      call check_close(error, force_of(case, rest), [0.0_wp, 0.0_wp], 1.0e-9_wp, "one body")

   contains

      !> A vector that is turned with the bearing.
      pure function turned(x) result(y)
         real(wp), intent(in) :: x(2)  !! (2) the vector [any]
         real(wp) :: y(2)              !! (2) turned [any]

         y = [cos(1.1_wp)*x(1) - sin(1.1_wp)*x(2), sin(1.1_wp)*x(1) + cos(1.1_wp)*x(2)]
      end function turned

   end subroutine test_turning_frame

   !> No bore gives energy back: forces and moments of shear together take what the gap takes, whatever moves.
   subroutine test_dissipation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: c = 1.0e-4_wp
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(random_t) :: random
      real(wp) :: balance, f(2), power, t_b, t_j, w(2)
      integer :: k

      call make_lobed("reynolds", 2, 0.7_wp, 1.0_wp, 0.0_wp, c, case)
      do k = 1, 40
         motion%e = c*[random%between(-0.6_wp, 0.6_wp), random%between(-0.6_wp, 0.6_wp)]
         motion%e_dot = c*[random%between(-30.0_wp, 30.0_wp), random%between(-30.0_wp, 30.0_wp)]
         w = [random%between(-30.0_wp, 30.0_wp), random%between(-30.0_wp, 30.0_wp)]
         motion%speed_sum = sum(w)
         motion%speed_difference = w(1) - w(2)
         motion%angle = random%between(-3.0_wp, 3.0_wp)
         f = force_of(case, motion)
         call case%law%torques(motion, case%parameters, f, t_j, t_b)
         power = -dot_product(f, motion%e_dot) - t_j*w(1) - t_b*w(2)
         call check_true(error, power > 0.0_wp, "power is taken, state "//to_text(k))
         balance = t_j + t_b + motion%e(1)*f(2) - motion%e(2)*f(1)
         call check_close(error, balance, 0.0_wp, 1.0e-12_wp*(abs(t_j) + abs(t_b)), "moments balance")
      end do
   end subroutine test_dissipation

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
