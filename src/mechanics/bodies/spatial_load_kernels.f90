!> Loads on the rates of bodies in space, on plain arrays: forces, and moments along the body's axes less the gyroscopic ones.
!>
!> g = (f, A^T n - w' x J w'), w' along the principal axes.
!> Source: Flores et al. (2008), section 6.2 with the gyroscopic moment of (6.9).
module spatial_load_kernels
   use kinds, only: wp
   use rows, only: n_v => n_v_spatial
   implicit none (type, external)
   private
   public :: spatial_loads, spatial_weights

contains

   !> Without moments, on plain arrays.
   pure subroutine spatial_weights(n, mass, spin, force, g)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: mass(n_v, n)          !! (6, n) masses [kg and kg.m^2]
      real(wp), intent(in) :: spin(3, 0:n)          !! (3, 0:n) angular velocities, body frames [rad/s]
      real(wp), intent(in) :: force(3, 0:n)         !! (3, 0:n) forces [N]
      real(wp), intent(out) :: g(n_v, 0:n)          !! (6, 0:n) loads on the rates [N and N.m]

      integer :: k

      g(:, 0) = 0.0_wp
      do k = 1, n
         g(1:3, k) = force(:, k)
         g(4, k) = (mass(5, k) - mass(6, k))*spin(2, k)*spin(3, k)
         g(5, k) = (mass(6, k) - mass(4, k))*spin(3, k)*spin(1, k)
         g(6, k) = (mass(4, k) - mass(5, k))*spin(1, k)*spin(2, k)
      end do
   end subroutine spatial_weights

   !> With moments, on plain arrays.
   pure subroutine spatial_loads(n, mass, rot, spin, force, moment, g)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: mass(n_v, n)          !! (6, n) masses [kg and kg.m^2]
      real(wp), intent(in) :: rot(3, 3, 0:n)        !! (3, 3, 0:n) body frames to world frame [1]
      real(wp), intent(in) :: spin(3, 0:n)          !! (3, 0:n) angular velocities, body frames [rad/s]
      real(wp), intent(in) :: force(3, 0:n)         !! (3, 0:n) forces [N]
      real(wp), intent(in) :: moment(3, 0:n)        !! (3, 0:n) moments about the centres of mass, world frame [N.m]
      real(wp), intent(out) :: g(n_v, 0:n)          !! (6, 0:n) loads on the rates [N and N.m]

      integer :: k

      g(:, 0) = 0.0_wp
      do k = 1, n
         g(1:3, k) = force(:, k)
         g(4, k) = rot(1, 1, k)*moment(1, k) + rot(2, 1, k)*moment(2, k) + rot(3, 1, k)*moment(3, k) &
                   + (mass(5, k) - mass(6, k))*spin(2, k)*spin(3, k)
         g(5, k) = rot(1, 2, k)*moment(1, k) + rot(2, 2, k)*moment(2, k) + rot(3, 2, k)*moment(3, k) &
                   + (mass(6, k) - mass(4, k))*spin(3, k)*spin(1, k)
         g(6, k) = rot(1, 3, k)*moment(1, k) + rot(2, 3, k)*moment(2, k) + rot(3, 3, k)*moment(3, k) &
                   + (mass(4, k) - mass(5, k))*spin(1, k)*spin(2, k)
      end do
   end subroutine spatial_loads

end module spatial_load_kernels
