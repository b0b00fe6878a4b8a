!> The film on a grid against published tables: Butenschoen's rotation and squeeze, Lund and Thomsen's two-groove bearing.
module test_film_tables
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use film_grid_case, only: at_widest_gap, make_grid, result_of, steady, two_grooves
   use kinds, only: pi, wp
   use published_films, only: grooved, rotation_angle, rotation_eps, rotation_flow, rotation_load, rotation_ratio, squeeze_eps, &
      squeeze_load, squeeze_ratio
   use reynolds_grid, only: boundary_reynolds, journal_state_t, new_reynolds_grid, reynolds_grid_t
   use reynolds_mesh, only: supply_t
   use reynolds_results, only: film_result_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_film_tables

   integer, parameter :: n_column = 160              !! columns of the grid
   integer, parameter :: n_row = 16                  !! rows of the half length
   real(wp), parameter :: last_digit = 1.0e-4_wp     !! unit of the last digit of numbers below 10 [1]
   real(wp), parameter :: step = 1.0e-3_wp           !! of differences for stiffness and damping [1]

contains

   subroutine run_test_film_tables(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rotation", test_rotation)
      call suite%test("squeeze", test_squeeze)
      call suite%test("two_grooves", test_two_grooves)
   end subroutine run_test_film_tables

   !> What a load may differ by: 0.5 %, 1 % beyond 0.97, or a unit of the last of five digits, of four behind the point.
   pure real(wp) function allowed(load, eps)
      real(wp), intent(in) :: load  !! printed [1]
      real(wp), intent(in) :: eps   !! eccentricity ratio [1]

      allowed = max(merge(0.005_wp, 0.01_wp, abs(eps) < 0.975_wp)*load, last_digit, 10.0_wp**(floor(log10(load)) - 4))
   end function allowed

   !> Every cell of the journal that turns: load, angle and side flow.
   subroutine test_rotation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      character(:), allocatable :: cell
      integer :: i, k

      do k = 1, size(rotation_ratio)
         call new_reynolds_grid(grid, rotation_ratio(k), n_column, n_row, boundary_reynolds, at_widest_gap(), .false.)
         do i = 1, size(rotation_eps)
            film = result_of(grid, steady([rotation_eps(i), 0.0_wp]))
            cell = " at L/D "//to_text(rotation_ratio(k))//", eps "//to_text(rotation_eps(i))
            call check_close(error, 0.5_wp*norm2(film%f), rotation_load(i, k), allowed(rotation_load(i, k), rotation_eps(i)), &
                             "So"//cell)
            call check_close(error, atan2(film%f(2), -film%f(1))*180.0_wp/pi, rotation_angle(i, k), 0.1_wp, "beta"//cell)
            call check_close(error, film%side_flow/(6.0_wp*rotation_ratio(k)), rotation_flow(i, k), &
                             0.007_wp*rotation_flow(i, k), "side flow"//cell)
         end do
      end do
   end subroutine test_rotation

   !> Every cell of the journal that approaches or parts: load, and side flow between the volumes that the loaded cells lose,
   !> with and without the empty ones beside.
   subroutine test_squeeze(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(journal_state_t) :: state
      type(film_result_t) :: film
      character(:), allocatable :: cell
      integer :: i, k

      do k = 1, size(squeeze_ratio)
         call make_grid(grid, squeeze_ratio(k), n_column, n_row, boundary_reynolds)
         do i = 1, size(squeeze_eps)
            if (.not. squeeze_load(i, k) > 0.0_wp) cycle
            state%e = [abs(squeeze_eps(i)), 0.0_wp]
            state%v = [merge(1.0_wp, -1.0_wp, squeeze_eps(i) >= 0.0_wp), 0.0_wp]
            film = result_of(grid, state)
            cell = " at L/D "//to_text(squeeze_ratio(k))//", eps "//to_text(squeeze_eps(i))
            call check_close(error, -0.5_wp*film%f(1)*state%v(1), squeeze_load(i, k), allowed(squeeze_load(i, k), squeeze_eps(i)), &
                             "So"//cell)
            call check_close(error, film%f(2), 0.0_wp, 1.0e-10_wp*norm2(film%f), "across"//cell)
            call check_true(error, film%side_flow < squeezed_out(grid, .false.)*(1.0_wp + 1.0e-10_wp), "at most"//cell)
            call check_true(error, film%side_flow > squeezed_out(grid, .true.)*(1.0_wp - 1.0e-10_wp), "at least"//cell)
         end do
      end do
   end subroutine test_squeeze

   !> Volume per time that the gap loses where there is pressure, over c R^3/(3 L): 12 (L/D)^2 times the integral of v . u. No
   !> surface slides: what does not leave at the ends goes into empty cells beside, which take at most what their own gap wins.
   pure real(wp) function squeezed_out(grid, with_neighbours)
      type(reynolds_grid_t), intent(in) :: grid   !! a half length, solved for a journal that does not turn
      logical, intent(in) :: with_neighbours      !! count the empty cells beside those with pressure too

      logical, allocatable :: counts(:, :)
      real(wp) :: closing
      integer :: j, k

      counts = grid%film%p > 0.0_wp
      if (with_neighbours) counts = counts .or. cshift(counts, 1, 2) .or. cshift(counts, -1, 2) .or. eoshift(counts, 1, dim=1) &
         .or. eoshift(counts, -1, dim=1)
      squeezed_out = 0.0_wp
      do k = 1, size(counts, 2)
         associate (theta => grid%theta(k - 1:k), v => grid%state%v)
            closing = v(1)*(sin(theta(2)) - sin(theta(1))) - v(2)*(cos(theta(2)) - cos(theta(1)))
         end associate
         do j = 1, size(counts, 1)
            if (counts(j, k)) squeezed_out = squeezed_out + 12.0_wp*grid%ratio**2*(grid%y(j) - grid%y(j - 1))*closing
         end do
      end do
   end function squeezed_out

   !> Where the two-groove bearing carries its load, and its eight coefficients. The printed ones are of a film with p = 0 along
   !> the widest gap too, that line held where it is while the journal moves a little.
   subroutine test_two_grooves(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid, held
      type(supply_t) :: line(1)
      real(wp) :: b(2, 2), e(2), f(2), k(2, 2), load
      integer :: i, iteration

      call new_reynolds_grid(grid, 0.5_wp, 2*n_column, n_row, boundary_reynolds, [two_grooves(), at_widest_gap()], .false.)
      do i = 1, size(grooved, 2)
         associate (row => grooved(:, i))
            load = 1.0_wp/(pi*row(1))
            e = 0.95_wp*row(2)*[cos(row(3)*pi/180.0_wp), sin(row(3)*pi/180.0_wp)]
            do iteration = 1, 8
               call differentiate(grid, e, f, k, b)
               f(1) = f(1) + load
               e = e + [k(2, 2)*f(1) - k(1, 2)*f(2), k(1, 1)*f(2) - k(2, 1)*f(1)]/(k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1))
            end do
            call check_close(error, f/load, [0.0_wp, 0.0_wp], 1.0e-8_wp, "equilibrium "//to_text(i))
            call check_close(error, norm2(e), row(2), 1.0e-3_wp, "eps "//to_text(i))
            call check_close(error, atan2(e(2), e(1))*180.0_wp/pi, row(3), 0.1_wp, "attitude "//to_text(i))
            line%angle = atan2(e(2), e(1)) + pi
            call new_reynolds_grid(held, 0.5_wp, 2*n_column, n_row, boundary_reynolds, [two_grooves(), line], .false.)
            call differentiate(held, e, f, k, b)
            k = k/load
            b = b/load
            call check_coefficients(error, [k(1, 1), k(1, 2), k(2, 1), k(2, 2), b(1, 1), b(1, 2), b(2, 2)], row(4:10), i)
            call check_close(error, b(1, 2), b(2, 1), 2.0e-3_wp*b(1, 1), "damping is symmetric "//to_text(i))
         end associate
      end do
   end subroutine test_two_grooves

   !> Coefficients: within 1.5 %, a small one within 0.01.
   subroutine check_coefficients(error, computed, printed, row)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      real(wp), intent(in) :: computed(7)                 !! (7) Kxx, Kxy, Kyx, Kyy, Bxx, Bxy, Byy [1]
      real(wp), intent(in) :: printed(7)                  !! (7) the same, of the table [1]
      integer, intent(in) :: row                          !! of the table

      integer :: i

      do i = 1, size(printed)
         call check_close(error, computed(i), printed(i), max(0.015_wp*abs(printed(i)), 0.01_wp), &
                          "coefficient "//to_text(i)//" of row "//to_text(row))
      end do
   end subroutine check_coefficients

   !> Force, stiffness -df/de with w_J + w_B = 1 and the centre at rest, and damping -df/de', by differences.
   subroutine differentiate(grid, e, f, k, b)
      type(reynolds_grid_t), intent(inout) :: grid  !! the grid
      real(wp), intent(in) :: e(2)                  !! (2) eccentricity [1]
      real(wp), intent(out) :: f(2)                 !! (2) force [1]
      real(wp), intent(out) :: k(2, 2)              !! (2, 2) stiffness [1]
      real(wp), intent(out) :: b(2, 2)              !! (2, 2) damping [1]

      type(journal_state_t) :: state
      type(film_result_t) :: high, low
      real(wp) :: move(2)
      integer :: i

      do i = 1, 2
         move = 0.0_wp
         move(i) = step
         high = result_of(grid, steady(e + move))
         low = result_of(grid, steady(e - move))
         k(:, i) = (low%f - high%f)/(2.0_wp*step)
         state = steady(e)
         state%v = state%v + move
         high = result_of(grid, state)
         state%v = state%v - 2.0_wp*move
         low = result_of(grid, state)
         b(:, i) = (low%f - high%f)/(2.0_wp*step)
      end do
      high = result_of(grid, steady(e))
      f = high%f
   end subroutine differentiate

end module test_film_tables
