!> The stretch of time on which all functions of time are smooth, and the times at which they are evaluated.
!>
!> At an instant where a function jumps or bends, a step that ends there needs the value before it, one that starts there
!> the value behind it. So that each evaluation is on the right side, times are brought into the stretch: what lies outside,
!> by a last digit, becomes the nearest number inside.
module smooth_segment
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: smooth_segment_t

   !> A stretch of time; before it is set it is all of time.
   type :: smooth_segment_t
      real(wp) :: low = -huge(1.0_wp)   !! first number in it [s]
      real(wp) :: high = huge(1.0_wp)   !! last number in it [s]
      real(wp) :: end = huge(1.0_wp)    !! instant that ends it: `high` or the next number [s]
   contains
      procedure :: inside
   end type smooth_segment_t

contains

   !> A time, brought into the stretch.
   pure real(wp) function inside(self, t)
      class(smooth_segment_t), intent(in) :: self  !! the stretch
      real(wp), intent(in) :: t                  !! the time [s]

      inside = min(max(t, self%low), self%high)
   end function inside

end module smooth_segment
