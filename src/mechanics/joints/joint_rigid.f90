!> Planar rigid joint: two bodies move as one.
!>
!> Phi = ( r_i + A_i s'_i - r_j - A_j s'_j;  angle_i - angle_j - (angle_i0 - angle_j0) )   (3 rows)
!> The first two rows are those of the revolute joint, the third has the Jacobian
!> [ 0, 0, 1, 0, 0, -1 ] and gamma = 0.
!>
!> Signs: the force on body i is -lambda_1:2 at its point, the moment about that point -lambda_3.
!> Source: Flores et al. (2008), eqs. (2.5), (2.6). Limits: the angle between the bodies is the one
!> of the deck's start.
module joint_rigid
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_reference, in_plane, kind_info_t, free_none
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: joint_rigid_t

   !> All rigid joints of a planar scene.
   type, extends(joint_set_t) :: joint_rigid_t
      real(wp), allocatable :: difference(:)  !! (n) angle of i less that of j [rad]
   contains
      procedure, nopass :: info => rigid_info
      procedure :: prepare => rigid_prepare
      procedure :: evaluate => rigid_evaluate
   end type joint_rigid_t

contains

   !> Description of the kind.
   function rigid_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.rigid"
      info%space = in_plane
      info%help = "weld: two points coincide and the relative angle is constant"
      info%source = "Flores et al. (2008), eqs. (2.5), (2.6)"
      info%n_row = 3
      info%free = free_none
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_joint_channels(info)
   end function rigid_info

   !> Angle between the bodies of each item.
   subroutine rigid_prepare(self, items, angle)
      class(joint_rigid_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)         !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)            !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_angle(3) = .true.
      self%sides_apart = .true.
      allocate (self%difference(self%n))
      do k = 1, self%n
         self%difference(k) = angle(self%body(1, k)) - angle(self%body(2, k))
      end do
   end subroutine rigid_prepare

   !> Fill the rows of all items.
   subroutine rigid_evaluate(self, t, motion, rows)
      class(joint_rigid_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                 !! time [s]
      type(motion_t), intent(in) :: motion      !! positions and velocities
      type(rows_t), intent(inout) :: rows       !! rows, those of the set are filled

      real(wp) :: s_i(2), s_j(2)
      integer :: i, j, k, row

      do k = 1, self%n
         i = self%body(1, k)
         j = self%body(2, k)
         row = self%first_row + 3*k - 2
         s_i = motion%rot(1:2, 1, i)*self%s_i(1, k) + motion%rot(1:2, 2, i)*self%s_i(2, k)
         s_j = motion%rot(1:2, 1, j)*self%s_j(1, k) + motion%rot(1:2, 2, j)*self%s_j(2, k)
         rows%phi(row:row + 1) = motion%r(1:2, i) + s_i - motion%r(1:2, j) - s_j
         rows%phi(row + 2) = motion%angle(i) - motion%angle(j) - self%difference(k)
         rows%phi_t(row:row + 2) = 0.0_wp
         rows%jac(:, row) = [1.0_wp, 0.0_wp, -s_i(2), -1.0_wp, 0.0_wp, s_j(2)]
         rows%jac(:, row + 1) = [0.0_wp, 1.0_wp, s_i(1), 0.0_wp, -1.0_wp, -s_j(1)]
         rows%jac(:, row + 2) = [0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp]
         rows%gam(row:row + 1) = s_i*motion%omega(3, i)**2 - s_j*motion%omega(3, j)**2
         rows%gam(row + 2) = 0.0_wp
      end do
   end subroutine rigid_evaluate

end module joint_rigid
