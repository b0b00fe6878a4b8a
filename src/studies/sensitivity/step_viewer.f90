!> Who looks at a motion with its derivatives at the start and in every step.
module step_viewer
   use derived_motion, only: motion_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: step_viewer_t

   !> The viewer.
   type, abstract :: step_viewer_t
      integer, allocatable :: channels(:, :)   !! (3, n) group, component and item of the channels it looks at
   contains
      procedure(start_interface), deferred :: see_start
      procedure(step_interface), deferred :: see_step
   end type step_viewer_t

   abstract interface
      !> The motion starts; derivatives are there.
      subroutine start_interface(self, motion)
         import :: motion_t, step_viewer_t
         implicit none (type, external)
         class(step_viewer_t), intent(inout) :: self      !! the viewer
         type(motion_t), intent(inout) :: motion          !! the motion
      end subroutine start_interface

      !> A step was made; the derivatives are those of its start, and its events are not handled.
      subroutine step_interface(self, motion, behind)
         import :: motion_t, step_viewer_t, wp
         implicit none (type, external)
         class(step_viewer_t), intent(inout) :: self      !! the viewer
         type(motion_t), intent(inout) :: motion          !! the motion
         real(wp), intent(in) :: behind                   !! time after an onset at which a force that jumps is seen; 0: none [s]
      end subroutine step_interface
   end interface

end module step_viewer
