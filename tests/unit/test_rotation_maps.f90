!> Rates of rotation vectors against differences.
module test_rotation_maps
   use check, only: check_close, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use kinds, only: wp
   use rotation_maps, only: inverse_map_of, map_of
   use rotations, only: rotation_about
   implicit none (type, external)
   private
   public :: run_test_rotation_maps

contains

   subroutine run_test_rotation_maps(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("maps", test_maps)
   end subroutine run_test_rotation_maps

   !> w = J psi' against differences of a rotation, and the inverse; in the range of the series and out of it.
   subroutine test_maps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-3_wp, direction(3) = [0.48_wp, -0.6_wp, 0.64_wp], rate(3) = [0.3_wp, 0.9_wp, -0.4_wp], &
                             sizes(6) = [1.0e-9_wp, 1.0e-3_wp, 0.09999_wp, 0.10001_wp, 1.0_wp, 3.1_wp]
      real(wp) :: a(3, 3, 4), psi(3), spin(3, 3), w(3), z(3)
      integer :: i, j, k, m

      do m = 1, size(sizes)
         psi = sizes(m)*direction
         do k = 1, 4
            z = psi + places(k)*step*rate
            a(:, :, k) = rotation_about(z, norm2(z))
         end do
         do i = 1, 3
            do j = 1, 3
               spin(i, j) = five_point(a(i, j, :), step)
            end do
         end do
         spin = matmul(spin, transpose(rotation_about(psi, norm2(psi))))
         w = map_of(rate, psi, .false.)
         call check_close(error, w, [spin(3, 2), spin(1, 3), spin(2, 1)], 1.0e-11_wp, "J by differences")
         call check_close(error, inverse_map_of(w, psi, .false.), rate, 1.0e-14_wp, "inverse")
         call check_close(error, inverse_map_of(map_of(rate, psi, .true.), psi, .true.), rate, 1.0e-14_wp, "inverse of transpose")
         call check_close(error, dot_product(direction([2, 3, 1]), w), &
                          dot_product(map_of(direction([2, 3, 1]), psi, .true.), rate), 1.0e-14_wp, "transpose")
      end do
   end subroutine test_maps

end module test_rotation_maps
