!> Depths of worn surfaces and shares of their cells, against quadratures and closed forms.
module test_wear_profiles
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use wear_arc, only: add_swept_arc, half_angles
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: run_test_wear_profiles

contains

   !> Register the tests.
   subroutine run_test_wear_profiles(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("arc_of_overlap", test_half_angles)
      call suite%test("shares_of_a_swept_arc", test_shares)
      call suite%test("depths_of_a_hole_and_a_pin", test_depths)
   end subroutine run_test_wear_profiles

   !> Half angles of a pin that has worn 1 um and 100 um into a hole: those of 30 digits. Both see one chord.
   subroutine test_half_angles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: big = 10.0e-3_wp, small = 9.5e-3_wp, depth(2) = [1.0e-6_wp, 1.0e-4_wp]
      real(wp), parameter :: expected(2) = [3.71487234677_wp, 34.5446836933_wp]
      real(wp) :: angles(2)
      integer :: k

      do k = 1, 2
         angles = half_angles(big, small, big - small + depth(k))
         call check_close(error, angles(2)*180.0_wp/pi, expected(k), 1.0e-8_wp, "half angle from the pin")
         if (allocated(error)) return
         call check_close(error, big*sin(angles(1)), small*sin(angles(2)), 1.0e-15_wp, "half chord")
         if (allocated(error)) return
      end do
      call check_true(error, all(half_angles(big, small, big - small) <= 0.0_wp), "surfaces that just touch have no arc")
   end subroutine test_half_angles

   !> Shares of arcs at random against a quadrature over sweep and cell; they are not negative and their sum is the amount.
   subroutine test_shares(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 24, fine = 3000, cases = 40
      real(wp) :: b, cells(n), expected(n), from, phi, theta, to
      type(random_t) :: random
      integer :: i, k, m

      random%state = 2
      do k = 1, cases
         from = random%between(-9.0_wp, 9.0_wp)
         b = 1.5_wp*10.0_wp**random%between(-4.0_wp, 0.0_wp)
         to = from + merge(random%between(-3.0_wp, 3.0_wp), 1.0e-5_wp*b, modulo(k, 4) > 0)
         cells = 0.0_wp
         call add_swept_arc(cells, from, to, b, 2.0_wp)
         call check_close(error, sum(cells), 2.0_wp, 1.0e-14_wp, "sum")
         if (allocated(error)) return
         call check_true(error, all(cells >= 0.0_wp), "no share is negative")
         if (allocated(error)) return
         expected = 0.0_wp
         do m = 1, fine  ! equal parts of the work: theta by the inverse of the distribution
            phi = from + (to - from)*modulo(m*0.6180339887498949_wp, 1.0_wp)
            theta = phi + asin(sin(b)*(2.0_wp*(m - 0.5_wp)/fine - 1.0_wp))
            i = modulo(floor(theta*n/(2.0_wp*pi)), n) + 1
            expected(i) = expected(i) + 2.0_wp/fine
         end do
         call check_close(error, cells, expected, 0.01_wp, "shares")
         if (allocated(error)) return
      end do
   end subroutine test_shares

   !> Volumes come back from the squares of radii; the deepest cell is found.
   subroutine test_depths(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 720, deepest = 400
      real(wp) :: angle, depth, depths(n), volume
      type(worn_surface_t) :: surface
      integer :: k, side

      surface%radius = 10.0e-3_wp
      surface%length = 15.0e-3_wp
      allocate (surface%volume(n))
      surface%volume = [(1.0e-9_wp*(1.0_wp + cos(2.0_wp*pi*(k - deepest)/n)), k=1, n)]
      do side = 1, 2
         surface%is_hole = side == 1
         depths = surface%depths()
         volume = surface%length*pi/n*sum(merge((surface%radius + depths)**2 - surface%radius**2, &
                                                surface%radius**2 - (surface%radius - depths)**2, surface%is_hole))
         call check_close(error, volume, sum(surface%volume), 1.0e-12_wp, "volume", relative=.true.)
         if (allocated(error)) return
         call surface%max_depth(depth, angle)
         call check_close(error, angle, 2.0_wp*pi*((deepest - 0.5_wp)/n - 1.0_wp), 1.0e-14_wp, "where it is deepest")
         if (allocated(error)) return
         volume = 1.0e-9_wp*(1.0_wp + pi/n/sin(pi/n))*n/(pi*surface%length)  ! of a cosine with these means
         call check_close(error, depth, abs(sqrt(surface%radius**2 + merge(volume, -volume, surface%is_hole)) - surface%radius), &
                          1.0e-6_wp, "maximum depth", relative=.true.)
         if (allocated(error)) return
      end do
      surface%volume = surface%volume(1)
      call surface%max_depth(depth, angle)
      volume = pi*surface%length*(surface%radius**2 - (surface%radius - depth)**2)
      call check_close(error, volume, sum(surface%volume), 1.0e-12_wp, &
                       "a pin that is worn all round", relative=.true.)
      if (allocated(error)) return
      call check_true(error, .not. surface%is_through(), "not worn through")
      if (allocated(error)) return
      surface%volume = 1.1_wp*pi*surface%length*surface%radius**2/n
      call surface%max_depth(depth, angle)
      call check_true(error, surface%is_through() .and. abs(depth - surface%radius) <= 0.0_wp, "worn through")
   end subroutine test_depths

end module test_wear_profiles
