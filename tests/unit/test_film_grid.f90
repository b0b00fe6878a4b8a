!> The film on a grid as decks have it: scale, frame of the bearing, supplies, grids that are shared.
module test_film_grid
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use film_case, only: components, film_case_t, force_of, make_film, motion_of, unit_bearing
   use film_grid, only: film_grid_t
   use film_grid_case, only: at_widest_gap, make_grid, result_of, steady, two_grooves
   use film_law, only: film_bearing_t, film_law_t, film_motion_t, film_slopes_t, n_film_parameter
   use fixed_random, only: random_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use published_films, only: grooved
   use reynolds_grid, only: boundary_full, boundary_reynolds, new_reynolds_grid, reynolds_grid_t
   use reynolds_results, only: film_result_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_film_grid

contains

   subroutine run_test_film_grid(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("scale", test_scale)
      call suite%test("supplies", test_supplies)
      call suite%test("pressure", test_pressure)
      call suite%test("coefficients", test_coefficients)
      call suite%test("mistakes", test_mistakes)
   end subroutine run_test_film_grid

   !> A film with grooves in a bearing of L/D = 0.5, R = 10 mm, c = 0.1 mm, 0.05 Pa.s.
   subroutine make_grooved(supply, number, angle, width, pressure, case)
      character(*), intent(in) :: supply      !! word of the column
      real(wp), intent(in) :: number          !! of supplies [1]
      real(wp), intent(in) :: angle           !! of the first [rad]
      real(wp), intent(in) :: width           !! of each [rad]
      real(wp), intent(in) :: pressure        !! of the lubricant [Pa]
      type(film_case_t), intent(out) :: case  !! the film

      character(:), allocatable :: help
      type(item_t) :: item
      type(kind_info_t) :: info
      type(random_t) :: random

      allocate (film_grid_t :: case%law)
      info = case%law%info()
      call fill_item(info, 1, random, item)
      item%values%given = .false.
      item%values(column_number(info, "resolution"))%text = "normal"
      item%values(column_number(info, "supply"))%text = supply
      item%values(column_number(info, "number"))%number = number
      item%values(column_number(info, "angle"))%number = angle
      item%values(column_number(info, "width"))%number = width
      item%values(column_number(info, "length"))%number = 1.0_wp
      item%values(column_number(info, "pressure"))%number = pressure
      call case%law%prepare(item)
      case%bearing = film_bearing_t(0.01_wp, 1.0e-4_wp, 0.01_wp, 0.05_wp, 0.999_wp)
      call case%law%fit(case%bearing, case%parameters, case%message, help)
   end subroutine make_grooved

   !> Forces are mu L R^3/c^2 times those of the grid, with either boundary, and a copy of the film has them too.
   subroutine test_scale(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(film_law_t), allocatable :: copy
      type(film_case_t) :: case
      type(film_result_t) :: film
      type(reynolds_grid_t) :: grid
      real(wp) :: f(2, 1)
      integer :: boundary

      do boundary = boundary_reynolds, boundary_full
         call make_film("grid", "boundary", merge("reynolds", "full    ", boundary == boundary_reynolds), &
                        film_bearing_t(0.01_wp, 1.0e-4_wp, 0.015_wp, 0.05_wp, 0.999_wp), case)
         call make_grid(grid, 0.75_wp, 160, 16, boundary)
         film = result_of(grid, steady([0.7_wp, 0.0_wp]))
         call check_close(error, components(case, 0.7_wp, 0.0_wp, 30.0_wp), 0.075_wp*30.0_wp*film%f, &
                          1.0e-9_wp, "scale", relative=.true.)
         allocate (copy, source=case%law)
         call copy%force(1, [motion_of(case, 0.7_wp, 0.0_wp, 30.0_wp, 0.0_wp)], reshape(case%parameters, [n_film_parameter, 1]), f)
         call check_close(error, f(:, 1), components(case, 0.7_wp, 0.0_wp, 30.0_wp), 0.0_wp, "copy")
         deallocate (copy)
      end do
   end subroutine test_scale

   !> Two grooves at the sides, in the frame of the bearing that is turned; a line at the widest gap.
   subroutine test_supplies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: angle = 0.6_wp
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(film_result_t) :: film
      type(reynolds_grid_t) :: grid
      real(wp) :: expected(2), turn(2, 2)

      turn = reshape([cos(angle), sin(angle), -sin(angle), cos(angle)], [2, 2])
      call make_grooved("fixed", 2.0_wp, -0.5_wp*pi, pi/9.0_wp, 0.0_wp, case)
      motion%e = case%bearing%clearance*matmul(turn, [0.3_wp, 0.4_wp])
      motion%speed_sum = 40.0_wp
      motion%angle = angle
      call new_reynolds_grid(grid, 0.5_wp, 160, 16, boundary_reynolds, two_grooves(), .false.)
      film = result_of(grid, steady([0.3_wp, 0.4_wp]))
      expected = 40.0_wp*0.05_wp*0.01_wp*0.01_wp**3/1.0e-4_wp**2*matmul(turn, film%f)
      call check_close(error, force_of(case, motion), expected, 1.0e-9_wp, "two grooves", relative=.true.)
      call make_grooved("widest_gap", 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, case)
      call new_reynolds_grid(grid, 0.5_wp, 160, 16, boundary_reynolds, at_widest_gap(), .false.)
      film = result_of(grid, steady([0.3_wp, 0.4_wp]))
      expected = 40.0_wp*0.05_wp*0.01_wp*0.01_wp**3/1.0e-4_wp**2*matmul(turn, film%f)
      call check_close(error, force_of(case, motion), expected, 1.0e-9_wp, "widest gap", relative=.true.)
      call make_grooved("both", 2.0_wp, -0.5_wp*pi, pi/9.0_wp, 0.0_wp, case)
      call new_reynolds_grid(grid, 0.5_wp, 160, 16, boundary_reynolds, [two_grooves(), at_widest_gap()], .false.)
      film = result_of(grid, steady([0.3_wp, 0.4_wp]))
      expected = 40.0_wp*0.05_wp*0.01_wp*0.01_wp**3/1.0e-4_wp**2*matmul(turn, film%f)
      call check_close(error, force_of(case, motion), expected, 1.0e-9_wp, "both", relative=.true.)
   end subroutine test_supplies

   !> A groove at 2 bar pushes a journal at rest away from it, about with the pressure times what it covers; twice at 4.
   subroutine test_pressure(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case, double
      type(film_motion_t) :: motion
      real(wp) :: f(2)

      call make_grooved("fixed", 1.0_wp, 0.5_wp, 0.8_wp, 2.0e5_wp, case)
      f = force_of(case, motion)
      call check_close(error, f, -norm2(f)*[cos(0.5_wp), sin(0.5_wp)], 1.0e-3_wp*norm2(f), "away from the groove")
      associate (covered => 2.0e5_wp*0.01_wp*2.0_wp*0.01_wp*sin(0.4_wp))
         call check_true(error, norm2(f) > covered .and. norm2(f) < 1.6_wp*covered, "pressure times area, and some more beside it")
      end associate
      call make_grooved("fixed", 1.0_wp, 0.5_wp, 0.8_wp, 4.0e5_wp, double)
      call check_close(error, force_of(double, motion), 2.0_wp*f, 1.0e-9_wp, "twice the pressure", relative=.true.)
   end subroutine test_pressure

   !> Stiffness and damping of the two-groove bearing of Lund and Thomsen where their table has it. Theirs hold the line without
   !> pressure where it is while the journal moves; here it moves along: 3 % or 0.02.
   subroutine test_coefficients(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      type(film_motion_t) :: motion
      type(film_slopes_t) :: slopes
      real(wp) :: computed(7), load
      integer :: i, k

      call make_grooved("both", 2.0_wp, -0.5_wp*pi, pi/9.0_wp, 0.0_wp, case)
      motion%speed_sum = 40.0_wp
      do k = 2, size(grooved, 2), 3
         associate (row => grooved(:, k), c => case%bearing%clearance, angle => grooved(3, k)*pi/180.0_wp)
            motion%e = c*row(2)*[cos(angle), sin(angle)]
            call case%law%linearise(motion, case%parameters, slopes)
            load = norm2(force_of(case, motion))
            associate (s => slopes%stiffness*c/load, b => slopes%damping*c*motion%speed_sum/load)
               computed = [s(1, 1), s(1, 2), s(2, 1), s(2, 2), b(1, 1), b(1, 2), b(2, 2)]
            end associate
            do i = 1, size(computed)
               call check_close(error, computed(i), row(3 + i), max(0.03_wp*abs(row(3 + i)), 0.02_wp), &
                                "coefficient "//to_text(i)//" of row "//to_text(k))
            end do
         end associate
      end do
   end subroutine test_coefficients

   !> Supplies that take all of the bearing are refused as text; the grid is reported.
   subroutine test_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case

      call make_film("grid", " ", " ", unit_bearing(), case)
      call check_equal(error, case%law%mistake(), "", "no supply")
      call check_equal(error, case%law%description(case%parameters), "160 x 16 cells", "story")
      call make_grooved("fixed", 2.0_wp, 0.0_wp, 2.0_wp, 1.0e5_wp, case)
      call check_equal(error, case%law%mistake(), "", "two supplies of 115 deg")
      call check_true(error, index(case%law%description(case%parameters), "supplied at 100000 Pa") > 0, "story of supplies")
      call make_grooved("fixed", 3.0_wp, 0.0_wp, 1.9_wp, 1.0e5_wp, case)
      call check_true(error, index(case%law%mistake(), "3 supplies of this width leave no film") == 1, "too wide")
   end subroutine test_mistakes

end module test_film_grid
