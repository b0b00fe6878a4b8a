!> Constant relative angle: two bodies keep the angle between them and are free to move apart. It takes bodies, not points.
!>
!> Phi = angle_i - angle_j - (angle_i0 - angle_j0)                                    (1 row)
!> Phi_q = [ 0, 0, 1, 0, 0, -1 ],   gamma = 0
!>
!> Signs: the moment on body i is -lambda; there is no force.
!> Source: as the third row of the rigid joint, Flores et al. (2008), eqs. (2.5), (2.6); parallel-axes primitive of P. E. Nikravesh,
!> Computer-Aided Analysis of Mechanical Systems (1988), section 4.2. Limits: the angle between the bodies is the one of the
!> deck's start.
module joint_parallel
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_reference, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: joint_parallel_t

   !> All joints of parallel axes of a planar scene.
   type, extends(joint_set_t) :: joint_parallel_t
      real(wp), allocatable :: difference(:)  !! (n) angle of i less that of j [rad]
   contains
      procedure, nopass :: info => parallel_info
      procedure :: prepare => parallel_prepare
      procedure :: evaluate => parallel_evaluate
   end type joint_parallel_t

contains

   !> Description of the kind.
   function parallel_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.parallel"
      info%space = in_plane
      info%help = "constant relative angle of two bodies; translation is free"
      info%source = "Nikravesh (1988), section 4.2"
      info%n_row = 1
      call add_reference(info, "i", "bodies", "the first body, or ground")
      call add_reference(info, "j", "bodies", "the second body, or ground")
      call add_joint_channels(info)
   end function parallel_info

   !> Angle between the bodies of each item.
   subroutine parallel_prepare(self, items, angle)
      class(joint_parallel_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)               !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_angle(1) = .true.
      self%sides_apart = .true.
      allocate (self%difference(self%n))
      do k = 1, self%n
         self%difference(k) = angle(self%body(1, k)) - angle(self%body(2, k))
      end do
   end subroutine parallel_prepare

   !> Fill the rows of all items.
   subroutine parallel_evaluate(self, t, motion, rows)
      class(joint_parallel_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(rows_t), intent(inout) :: rows          !! rows, those of the set are filled

      integer :: k, row

      do k = 1, self%n
         row = self%first_row + k
         rows%phi(row) = motion%angle(self%body(1, k)) - motion%angle(self%body(2, k)) - self%difference(k)
         rows%phi_t(row) = 0.0_wp
         rows%jac(:, row) = [0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp]
         rows%gam(row) = 0.0_wp
      end do
   end subroutine parallel_evaluate

end module joint_parallel
