!> Small changes along the axes of bodies, and those that the rows leave free.
module test_free_directions
   use check, only: check_close, check_equal, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, start_text
   implicit none (type, external)
   private
   public :: run_test_free_directions

   !> Two rods in space: oblique, with a ball between them.
   character(*), parameter :: rods = "[scene]"//nl//"space = spatial"//nl//"[bodies]"//nl// &
      "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] axis angle[deg]"//nl// &
      "one 2 0.15 0.2 0.3 0 0 0 ""1 2 3"" 40"//nl//"two 1 0.12 0.1 0.2 0.4 0.3 -0.1 ""3 -1 1"" 70"//nl// &
      "[points]"//nl//"name body xi[m] eta[m] zeta[m]"//nl//"q one 0.3 0.1 0"//nl//"s two 0.2 0 0"//nl// &
      "[joint.spherical]"//nl//"name i j"//nl//"ball q s"//nl//"[analysis.dynamic]"//nl//"end = 1 s"//nl

   !> Two bars of the plane, oblique, with a pin between them.
   character(*), parameter :: bars = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl// &
      "one 2 0.3 0 0 50"//nl//"two 1 0.1 0.4 0.3 -70"//nl//"[points]"//nl//"name body xi[m] eta[m]"//nl//"q one 0.3 0.1"//nl// &
      "s two 0.2 0"//nl//"[joint.revolute]"//nl//"name i j"//nl//"pin q s"//nl//"[analysis.dynamic]"//nl//"end = 1 s"//nl

contains

   subroutine run_test_free_directions(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("two_rods_in_space", test_in_space)
      call suite%test("two_bars_in_the_plane", test_in_the_plane)
   end subroutine run_test_free_directions

   !> Two bodies with a ball between them.
   subroutine test_in_space(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_directions(rods, 12, 3, error)
   end subroutine test_in_space

   !> Two bodies with a pin between them.
   subroutine test_in_the_plane(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_directions(bars, 6, 2, error)
   end subroutine test_in_the_plane

   !> A local change leads to the state and back; the free directions are as many as rates less rows, do not change the rows, and
   !> R reads them.
   subroutine check_directions(text, n_rate, n_row, error)
      character(*), intent(in) :: text                    !! the deck
      integer, intent(in) :: n_rate                       !! rates
      integer, intent(in) :: n_row                        !! rows
      type(error_t), allocatable, intent(inout) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-6_wp
      real(wp) :: direction(n_rate, n_rate), product(n_rate - n_row), reading(n_rate, n_rate), rows(n_row, 2)
      real(wp), allocatable :: change(:), x(:), x_back(:), y(:)
      type(mechanism_t) :: system
      integer :: i, n_free

      call start_text(text, system, y, error)
      if (allocated(error)) return
      allocate (x(2*n_rate), x_back(2*n_rate), change(system%n - system%n_quadrature), source=0.0_wp)
      x = [(sin(real(i, wp)), i=1, 2*n_rate)]
      call system%from_local(y, x, change)
      call system%to_local(y, change, x_back)
      call check_close(error, x_back, x, 1.0e-13_wp, "there and back")
      call system%free_directions(0.0_wp, y, n_free, direction, reading)
      call check_equal(error, n_free, n_rate - n_row, "free directions")
      do i = 1, n_free
         x = [direction(:, i), spread(0.0_wp, 1, n_rate)]
         call system%from_local(y, x, change)
         call violations(step, rows(:, 1))
         call violations(-step, rows(:, 2))
         call check_close(error, (rows(:, 1) - rows(:, 2))/(2.0_wp*step), spread(0.0_wp, 1, n_row), 1.0e-8_wp, "change of the rows")
         product = matmul(direction(:, i), reading(:, :n_free))
         product(i) = product(i) - 1.0_wp
         call check_close(error, product, spread(0.0_wp, 1, n_free), 1.0e-13_wp, "how much of each")
      end do

   contains

      !> Violations after a part of the change.
      subroutine violations(part, phi)
         real(wp), intent(in) :: part          !! of the change [1]
         real(wp), intent(out) :: phi(n_row)   !! (rows) violations [m]

         real(wp) :: moved(size(y))

         moved = y
         moved(:size(change)) = y(:size(change)) + part*change
         call system%linkage%set_motion(0.0_wp, moved)
         call system%linkage%evaluate_rows(0.0_wp)
         phi = system%linkage%rows%phi(:n_row)
      end subroutine violations

   end subroutine check_directions

end module test_free_directions
