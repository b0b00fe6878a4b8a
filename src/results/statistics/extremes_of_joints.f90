!> What clearance joints went through, from the list of events.
submodule(extremes) extremes_of_joints
   implicit none (type, external)

contains

   !> What the contacts of all clearance joints went through between two instants.
   module procedure joints_at_extremes
      type(joint_statistics_t), allocatable :: found(:)
      type(name_table_t) :: table
      type(text_t), allocatable :: names(:)
      integer :: j, k

      names = joints_of(catalogue)
      call statistics_of_joints(names, events, from, until, found)
      call table%list(names)
      allocate (joints(size(names)))
      do j = 1, size(joints)
         joints(j)%name = names(j)%s
         joints(j)%contact_fraction = found(j)%contact_fraction
      end do
      do k = 1, events%n
         if (events%word(k, 1) /= "contact") cycle
         j = table%find(events%word(k, 2))
         if (j > 0) call add_contact(events%numbers(k), joints(j))
      end do
   end procedure joints_at_extremes

   !> Add a contact to what a joint went through.
   pure subroutine add_contact(numbers, joint)
      real(wp), intent(in) :: numbers(:)              !! (10) of the event, see `event_list` [any]
      type(joint_extremes_t), intent(inout) :: joint  !! the joint

      real(wp) :: at

      at = 0.0_wp
      joint%impacts = joint%impacts + 1
      call raise(numbers(2), numbers(1), joint%speed, joint%speed_onset, at)
      call raise(numbers(3), numbers(9), joint%force, joint%force_onset, joint%force_time)
      call raise(numbers(4), numbers(10), joint%penetration, joint%penetration_onset, joint%penetration_time)
      joint%impulse = joint%impulse + numbers(8)
      if (.not. ieee_is_finite(joint%energy_lost)) return
      if (ieee_is_finite(numbers(7))) then
         joint%energy_lost = joint%energy_lost + numbers(7)
      else
         joint%energy_lost = not_a_number()
      end if

   contains

      !> Take a value that is greater than those before.
      pure subroutine raise(x, t, maximum, onset, when)
         real(wp), intent(in) :: x            !! the value [any]
         real(wp), intent(in) :: t            !! when it was there [s]
         real(wp), intent(inout) :: maximum  !! the maximum so far [any]
         real(wp), intent(inout) :: onset     !! of its contact [s]
         real(wp), intent(inout) :: when      !! when it was there [s]

         if (.not. ieee_is_finite(x)) return
         if (joint%impacts > 1 .and. x <= maximum) return
         maximum = x
         onset = numbers(1)
         when = t
      end subroutine raise

   end subroutine add_contact

end submodule extremes_of_joints
