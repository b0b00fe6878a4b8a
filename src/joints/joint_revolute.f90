!> Planar revolute joint: the points P_i and P_j coincide.
!>
!> Phi = r_i + A_i s'_i - r_j - A_j s'_j                                    (2 rows)
!> Phi_q = [ I, R90 s_i, -I, -R90 s_j ],   gamma = s_i w_i^2 - s_j w_j^2
!>
!> Signs: the force on body i is -lambda, on body j +lambda, at the pin.
!> Source: Flores et al. (2008), eq. (2.5). Limits: none.
module joint_revolute
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t, rows_t
   use kind_info, only: add_reference, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: joint_revolute_t

   !> All revolute joints of a planar scene.
   type, extends(joint_set_t) :: joint_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure :: prepare => revolute_prepare
      procedure :: evaluate => revolute_evaluate
   end type joint_revolute_t

contains

   !> What the kind says of itself.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.revolute"
      info%help = "ideal pin: two points coincide"
      info%source = "Flores et al. (2008), eq. (2.5)"
      info%n_row = 2
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_joint_channels(info)
   end function revolute_info

   !> Nothing beyond the points.
   subroutine revolute_prepare(self, items, angle)
      class(joint_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)               !! (0:bodies) angles at the start [rad]
   end subroutine revolute_prepare

   !> Fill the rows of all items.
   subroutine revolute_evaluate(self, t, motion, rows)
      class(joint_revolute_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(rows_t), intent(inout) :: rows          !! rows, those of the set are filled

      real(wp) :: w2_i, w2_j, x_i, x_j, y_i, y_j
      integer :: i, j, k, row

      do k = 1, self%n
         i = self%body(1, k)
         j = self%body(2, k)
         row = self%first_row + 2*k - 1
         x_i = motion%rot(1, 1, i)*self%s_i(1, k) + motion%rot(1, 2, i)*self%s_i(2, k)
         y_i = motion%rot(2, 1, i)*self%s_i(1, k) + motion%rot(2, 2, i)*self%s_i(2, k)
         x_j = motion%rot(1, 1, j)*self%s_j(1, k) + motion%rot(1, 2, j)*self%s_j(2, k)
         y_j = motion%rot(2, 1, j)*self%s_j(1, k) + motion%rot(2, 2, j)*self%s_j(2, k)
         rows%phi(row) = motion%r(1, i) + x_i - motion%r(1, j) - x_j
         rows%phi(row + 1) = motion%r(2, i) + y_i - motion%r(2, j) - y_j
         rows%phi_t(row) = 0.0_wp
         rows%phi_t(row + 1) = 0.0_wp
         rows%jac(1, row) = 1.0_wp
         rows%jac(2, row) = 0.0_wp
         rows%jac(3, row) = -y_i
         rows%jac(4, row) = -1.0_wp
         rows%jac(5, row) = 0.0_wp
         rows%jac(6, row) = y_j
         rows%jac(1, row + 1) = 0.0_wp
         rows%jac(2, row + 1) = 1.0_wp
         rows%jac(3, row + 1) = x_i
         rows%jac(4, row + 1) = 0.0_wp
         rows%jac(5, row + 1) = -1.0_wp
         rows%jac(6, row + 1) = -x_j
         w2_i = motion%omega(3, i)*motion%omega(3, i)
         w2_j = motion%omega(3, j)*motion%omega(3, j)
         rows%gam(row) = x_i*w2_i - x_j*w2_j
         rows%gam(row + 1) = y_i*w2_i - y_j*w2_j
      end do
   end subroutine revolute_evaluate

end module joint_revolute
