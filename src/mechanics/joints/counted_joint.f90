!> Joints of space whose rows count turns: angles are taken next to those at the end of the last step, which are their memory.
!>
!> Signs, frames: `spatial_joint`. Source: from the definition. Limits: less than half a turn in a step.
module counted_joint
   use kinds, only: wp
   use archive, only: archive_t
   use motion, only: motion_t
   use spatial_joint, only: spatial_joint_t
   use spatial_rows, only: scalar_t
   implicit none (type, external)
   private
   public :: counted_joint_t, most_angles

   integer, parameter :: most_angles = 2   !! angles of an item, at most

   !> All joints of a kind that counts turns. `prepare` makes storage for the angles.
   type, abstract, extends(spatial_joint_t) :: counted_joint_t
      real(wp), allocatable :: angle(:, :)   !! (angles of an item, n) at the end of the last step [rad]
   contains
      procedure(angles_interface), deferred :: find_angles
      procedure :: follow => counted_follow
      procedure :: save => counted_save
      procedure :: load => counted_load
   end type counted_joint_t

   abstract interface
      !> Angles of an item, next to those at the end of the last step. No allocation.
      pure subroutine angles_interface(self, k, motion, phi)
         import :: counted_joint_t, most_angles, motion_t, scalar_t
         implicit none (type, external)
         class(counted_joint_t), intent(in) :: self        !! the set
         integer, intent(in) :: k                          !! item
         type(motion_t), intent(in) :: motion              !! positions and velocities
         type(scalar_t), intent(inout) :: phi(most_angles) !! (most_angles) those that there are are set [rad]
      end subroutine angles_interface
   end interface

contains

   !> A step has ended: angles are counted from there.
   subroutine counted_follow(self, motion)
      class(counted_joint_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion           !! positions at the end of the step

      type(scalar_t) :: phi(most_angles)
      integer :: k

      do k = 1, self%n
         call self%find_angles(k, motion, phi)
         self%angle(:, k) = phi(:size(self%angle, 1))%value
      end do
   end subroutine counted_follow

   !> Write the angles.
   subroutine counted_save(self, archive)
      class(counted_joint_t), intent(in) :: self  !! the set
      type(archive_t), intent(inout) :: archive   !! the checkpoint

      integer :: k

      do k = 1, self%n
         call archive%put(self%angle(:, k))
      end do
   end subroutine counted_save

   !> Read the angles.
   subroutine counted_load(self, archive)
      class(counted_joint_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      integer :: a, k

      do k = 1, self%n
         do a = 1, size(self%angle, 1)
            call archive%get(self%angle(a, k))
         end do
      end do
   end subroutine counted_load

end module counted_joint
