!> Held loads of a shaft in a bush: its place in a wider bush, derivatives against differences, jumps that are stiff, both sides.
module test_held_loads
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use held_jump, only: follow, mean_of, path_t
   use held_loads, only: held_t, new_held
   use held_slopes, only: depth_by_volume, implicit_t
   use kinds, only: pi, wp
   use life_state, only: life_state_t
   use wear_loads, only: most_nodes, n_load
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: run_test_held_loads

   real(wp), parameter :: radius = 10.0e-3_wp, shaft = 9.5e-3_wp, length = 15.0e-3_wp   ! [m]
   real(wp), parameter :: clearance = radius - shaft                                    ! [m]
   real(wp), parameter :: per_cycle = 1.0e-15_wp                                        ! volume per cycle [m^3]

contains

   !> Register the tests.
   subroutine run_test_held_loads(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("equilibrium_in_a_wider_bush", test_equilibrium)
      call suite%test("derivatives", test_derivatives)
      call suite%test("stiff_jump", test_stiff_jump)
      call suite%test("shaft_wears_linearly", test_shaft)
      call suite%test("both_sides", test_both)
   end subroutine run_test_held_loads

   !> A bush with a groove that the shaft has worn, and the load of a shaft that overlaps it there.
   subroutine set_up(cells, depth, delta, lost, turning, state, x, held)
      integer, intent(in) :: cells             !! of each surface
      real(wp), intent(in) :: depth            !! of the groove, at -90 degrees [m]
      real(wp), intent(in) :: delta            !! overlap of the shaft [m]
      real(wp), intent(in) :: lost(2)          !! (2) what bush and shaft lose per cycle [m^3]
      logical, intent(in) :: turning           !! the shaft turns within the cycle
      type(life_state_t), intent(out) :: state !! the surfaces
      real(wp), allocatable, intent(out) :: x(:)   !! (n) their profiles [m^3, m]
      type(held_t), intent(out) :: held        !! the loads

      integer, parameter :: points = 40
      real(wp), allocatable :: loads(:, :), rates(:, :)
      type(worn_surface_t) :: surfaces(2)
      real(wp) :: angle, h
      integer :: i, k

      surfaces%is_hole = [.true., .false.]
      surfaces%radius = [radius, shaft]
      surfaces%length = length
      do k = 1, 2
         surfaces(k)%joint = "bearing"
         surfaces(k)%side = merge("bearing", "journal", k == 1)
         allocate (surfaces(k)%volume(cells), source=0.0_wp)
      end do
      do i = 1, cells
         do k = 1, points
            angle = 2.0_wp*pi/cells*(i - 1 + (k - 0.5_wp)/points) + 0.5_wp*pi
            h = max((clearance + depth)*cos(angle) + sqrt(shaft**2 - ((clearance + depth)*sin(angle))**2) - radius, 0.0_wp)
            associate (v => surfaces(1)%volume(i))
               v = v + length*2.0_wp*pi/cells/points*(radius*h + 0.5_wp*h**2)
            end associate
         end do
      end do
      call state%start(surfaces)
      x = state%numbers(surfaces)
      allocate (loads(n_load*most_nodes, 1), rates(state%n, 1))
      do k = 1, most_nodes
         loads(n_load*(k - 1) + 1:n_load*k, 1) = [0.0_wp, -(clearance + depth + delta), 0.0_wp, 1.5_wp, lost/most_nodes]
         if (turning) loads(n_load*(k - 1) + 3, 1) = 2.0_wp*pi*(k - 0.5_wp)/most_nodes
      end do
      rates = 0.0_wp
      call new_held(state, x, rates, loads, held)      ! where they go by the model
      rates = -held%defect
      rates(state%n - 1:, 1) = 1.0_wp
      call new_held(state, x, rates, loads, held)
   end subroutine set_up

   !> In a bush that is wider by w the centre of the shaft is w lower, under the same force.
   subroutine test_equilibrium(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: wider = 3.0e-6_wp, delta = 2.0e-6_wp   ! [m]
      type(held_t) :: held
      type(life_state_t) :: state
      real(wp), allocatable :: rates(:, :), x(:)
      logical :: is_good

      call set_up(720, 0.0_wp, delta, [per_cycle, 0.0_wp], .false., state, x, held)
      x(:720) = length*pi/720*((radius + wider)**2 - radius**2)
      rates = held%rates
      call held%at(state, x, rates, is_good)
      call check_true(error, is_good, "found")
      if (allocated(error)) return
      call check_close(error, held%nodes(2, 1, 1, 1), -(clearance + delta + wider), 2.0e-3_wp*wider, "centre")
      if (allocated(error)) return
      call check_close(error, sum(rates(:720, 1)), per_cycle, 1.0e-14_wp*per_cycle, "volume")
   end subroutine test_equilibrium

   !> Products of the matrix against differences of rates, on a groove that fits.
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: cells = 360
      real(wp), parameter :: h = 1.0e9_wp, small = 1.0e-4_wp   ! cycles, part of the overlap [1]
      type(held_t), target :: held
      type(implicit_t) :: matrix
      type(life_state_t) :: state
      real(wp), allocatable :: high(:, :), low(:, :), product(:), v(:), x(:)
      logical :: is_good
      integer :: k

      call set_up(cells, 1.0e-4_wp, 2.0e-6_wp, [per_cycle, 0.0_wp], .false., state, x, held)
      low = held%rates
      high = held%rates
      product = 0.0_wp*x
      v = 0.0_wp*x
      matrix%by = depth_by_volume(state, x)
      do k = 1, cells
         v(k) = small*2.0e-6_wp/matrix%by(k)*(1.0_wp + sin(3.0_wp*2.0_wp*pi*k/cells))
      end do
      call held%at(state, x + v, high, is_good)
      if (is_good) call held%at(state, x - v, low, is_good)
      if (is_good) call held%at(state, x, held%rates, is_good)
      call check_true(error, is_good, "found")
      if (allocated(error)) return
      matrix%a => held%slopes
      call matrix%prepare(h, 0.0_wp)
      call matrix%apply(v*matrix%diagonal, product)
      product = (v - product)/h
      call check_true(error, norm2(product) > 1.0e-6_wp*norm2(held%rates(:cells, 1)), "they change")
      if (allocated(error)) return
      call check_close(error, norm2(product - 0.5_wp*(high(:, 1) - low(:, 1)))/norm2(product), 0.0_wp, 0.1_wp, "differences")
   end subroutine test_derivatives

   !> A groove from 20 to about 40 um: the depth is that of the volume. In a groove an overlap that is 20^(3/2) = 89 times smaller
   !> takes at most three times as many sub-jumps: an explicit method would take 89 times as many.
   subroutine test_stiff_jump(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: cells = 360
      real(wp), parameter :: first = 20.0e-6_wp, last = 40.0e-6_wp   ! [m]
      real(wp), parameter :: overlaps(2) = [1.0e-6_wp, 5.0e-8_wp]    ! of a round shaft [m]
      type(held_t) :: held
      type(life_state_t) :: state
      type(path_t) :: path
      real(wp), allocatable :: x(:)
      real(wp) :: cycles, depth
      logical :: is_good
      integer :: k, n(size(overlaps))

      cycles = (groove(last) - groove(first))/per_cycle
      do k = 1, size(overlaps)
         path%allowed = huge(1.0_wp)
         call set_up(cells, first, overlaps(k), [per_cycle, 0.0_wp], .false., state, x, held)
         call follow(state, x, cycles, 1.0e-3_wp, held, path, is_good)
         call check_true(error, is_good, "followed")
         if (allocated(error)) return
         n(k) = path%n
         depth = state%max_depth(x + mean_of(path%sums(:, :, path%n)))
         call check_close(error, depth, last, 4.0e-3_wp*last, "depth")
         if (allocated(error)) return
         call check_path(error, state, path, [per_cycle, 0.0_wp])
         if (allocated(error)) return
      end do
      call check_true(error, n(2) <= 3*n(1), "sub-jumps")
   end subroutine test_stiff_jump

   !> Volume of a groove of the shaft's radius, see inputs/worn_bush.deck.
   pure real(wp) function groove(depth) result(volume)
      real(wp), intent(in) :: depth   !! its depth [m]

      real(wp) :: a, b, d

      d = clearance + depth
      a = acos((radius**2 - shaft**2 - d**2)/(2.0_wp*shaft*d))
      b = atan2(shaft*sin(a), d + shaft*cos(a))
      volume = length*(shaft**2*(a - sin(a)*cos(a)) - radius**2*(b - sin(b)*cos(b)))
   end function groove

   !> A shaft that turns under a load fixed in space loses the same all round: pi L (r^2 - (r - h)^2) = V.
   subroutine test_shaft(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: cycles = 1.0e6_wp
      type(held_t) :: held
      type(life_state_t) :: state
      type(path_t) :: path
      type(worn_surface_t), allocatable :: surfaces(:)
      real(wp), allocatable :: depths(:), x(:)
      logical :: is_good

      call set_up(80, 0.0_wp, 2.0e-6_wp, [0.0_wp, per_cycle], .true., state, x, held)
      call follow(state, x, cycles, 1.0e-3_wp, held, path, is_good)
      call check_true(error, is_good, "followed")
      if (allocated(error)) return
      call check_path(error, state, path, [0.0_wp, per_cycle])
      if (allocated(error)) return
      surfaces = state%worn(x + mean_of(path%sums(:, :, path%n)))
      depths = surfaces(2)%depths()
      call check_close(error, depths, spread(shaft - sqrt(shaft**2 - cycles*per_cycle/(pi*length)), 1, 80), 1.0e-10_wp, "depths")
   end subroutine test_shaft

   !> Bush and shaft wear, under loads that change within a jump.
   subroutine test_both(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(held_t) :: end, held
      type(life_state_t) :: state
      type(path_t) :: path
      real(wp), allocatable :: x(:)
      logical :: is_good

      call set_up(120, 2.0e-6_wp, 2.0e-6_wp, [per_cycle, 0.5_wp*per_cycle], .true., state, x, held)
      call set_up(120, 2.0e-6_wp, 4.0e-7_wp, [per_cycle, 0.5_wp*per_cycle], .true., state, x, end)
      call follow(state, x, 1.0e6_wp, 1.0e-3_wp, held, path, is_good, b=end)
      call check_true(error, is_good, "followed")
      if (.not. allocated(error)) call check_path(error, state, path, [per_cycle, 0.5_wp*per_cycle])
   end subroutine test_both

   !> Every sub-jump loses the volumes of its cycles, and fills no cell.
   subroutine check_path(error, state, path, lost)
      type(error_t), allocatable, intent(out) :: error   !! what failed
      type(life_state_t), intent(in) :: state            !! the surfaces
      type(path_t), intent(in) :: path                   !! the sub-jumps
      real(wp), intent(in) :: lost(2)                    !! (2) what bush and shaft lose per cycle [m^3]

      real(wp), allocatable :: gain(:)
      integer :: k, s

      do k = 1, path%n
         gain = mean_of(path%sums(:, :, k) - path%sums(:, :, k - 1))
         call check_true(error, all(gain >= 0.0_wp), "no cell is filled")
         if (allocated(error)) return
         do s = 1, 2
            associate (n => size(state%surfaces(s)%volume), cycles => path%cycles(k))
               call check_close(error, sum(path%sums(state%before(s) + 1:state%before(s) + n, :, k)), lost(s)*cycles, &
                                1.0e-12_wp*sum(lost)*cycles, "conservation")
            end associate
            if (allocated(error)) return
         end do
      end do
   end subroutine check_path

end module test_held_loads
