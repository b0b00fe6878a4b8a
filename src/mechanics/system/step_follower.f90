!> What continues from the end of a step: counts of turns of force elements and gears, and the ways of contacts that slide in
!> space; and whether joints and force elements are still where their rows and angles mean what they should.
module step_follower
   use joint_set, only: joint_set_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use motion, only: motion_t
   use spatial_frame_spring, only: frame_spring_t, words_of_half_turn
   use spatial_gear, only: gear_is_lost, spatial_gear_t, words_of_lost_gear
   use spatial_joint, only: is_turned_over, spatial_joint_t, words_of_turned_over
   use spatial_rack, only: rack_is_lost, spatial_rack_t, words_of_lost_rack
   use spatial_torsion_spring, only: spatial_torsion_spring_t, words_of_lost_angle
   implicit none (type, external)
   private
   public :: find_off_branch, follow_motion, has_branches, must_follow

contains

   !> Whether something of a system continues from step to step.
   pure logical function must_follow(system)
      type(mechanism_t), intent(in) :: system   !! the system

      must_follow = system%loading%counts_turns .or. system%friction%stick_slips%have_ways
   end function must_follow

   !> Whether a motion can bring a joint to a branch that nobody means, or a joint or force element to where its angle has no value.
   logical function has_branches(system)
      type(mechanism_t), intent(in) :: system   !! the system

      integer :: k

      has_branches = system%loading%counts_turns
      do k = 1, size(system%linkage%joints)
         select type (set => system%linkage%joints(k)%set)
         class is (spatial_joint_t)
            has_branches = has_branches .or. set%axes%holds_parallel
         end select
      end do
   end function has_branches

   !> The joint or force element that has come there: what to say of it.
   subroutine find_off_branch(system, words)
      type(mechanism_t), intent(in) :: system           !! the system, its motion that of the end of a step, followed
      character(:), allocatable, intent(out) :: words   !! name and what is wrong; unallocated: nothing

      integer :: i, k

      do k = 1, size(system%linkage%joints)
         associate (joint => system%linkage%joints(k)%set)
            do i = 1, joint%n
               call look_at_joint(joint, i, system%linkage%motion, words)
               if (allocated(words)) return
            end do
         end associate
      end do
      if (.not. system%loading%counts_turns) return
      do k = 1, size(system%loading%forces)
         select type (set => system%loading%forces(k)%set)
         class is (spatial_torsion_spring_t)
            i = findloc(set%cosine > 0.0_wp, .false., dim=1)
            if (i > 0) words = "force element '"//set%names(i)%s//"' "//words_of_lost_angle(set, i)
         class is (frame_spring_t)
            i = findloc(set%is_lost, .true., dim=1)
            if (i > 0) words = "force element '"//set%names(i)%s//"' "//words_of_half_turn()
         end select
      end do
   end subroutine find_off_branch

   !> Whether a joint has come there.
   subroutine look_at_joint(joint, i, motion, words)
      class(joint_set_t), intent(in) :: joint                     !! its set
      integer, intent(in) :: i                                    !! item of the set
      type(motion_t), intent(in) :: motion                        !! positions
      character(:), allocatable, intent(inout) :: words           !! name and what is wrong; left alone: nothing

      select type (joint)
      class is (spatial_gear_t)
         if (gear_is_lost(joint, i, motion)) words = words_of_lost_gear(joint, i, motion)
      type is (spatial_rack_t)
         if (rack_is_lost(joint, i, motion)) words = words_of_lost_rack(joint, i, motion)
      class is (spatial_joint_t)
         if (is_turned_over(joint, i, motion)) words = words_of_turned_over(joint, i, motion)
      end select
      if (allocated(words)) words = "joint '"//joint%names(i)%s//"' "//words
   end subroutine look_at_joint

   !> A step has ended: take its end as what counts continue from.
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
         do k = 1, size(system%clearance_joints%sets)
            call system%clearance_joints%sets(k)%set%follow_sliding(motion)
         end do
      end associate
   end subroutine follow_motion

end module step_follower
