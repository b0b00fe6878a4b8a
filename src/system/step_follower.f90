!> What goes on from the end of a step: counts of turns of force elements and gears, and the ways of contacts that slide in space.
module step_follower
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: follow_motion, must_follow

contains

   !> Whether something of a system goes on from step to step.
   pure logical function must_follow(system)
      type(mechanism_t), intent(in) :: system   !! the system

      must_follow = system%loading%counts_turns .or. system%friction%grips%have_ways
   end function must_follow

   !> A step has ended: take its end as what counts go on from.
   subroutine follow_motion(system)
      type(mechanism_t), intent(inout) :: system   !! the system, its motion that of the end of the step

      integer :: k

      associate (motion => system%linkage%motion)
         do k = 1, size(system%linkage%joints)
            call system%linkage%joints(k)%set%follow(motion)
         end do
         do k = 1, size(system%loading%forces)
            call system%loading%forces(k)%set%follow(motion)
         end do
         do k = 1, size(system%loose%sets)
            call system%loose%sets(k)%set%follow_sliding(motion)
         end do
      end associate
   end subroutine follow_motion

end module step_follower
