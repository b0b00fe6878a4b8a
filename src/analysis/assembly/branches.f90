!> Ways in which a mechanism can close that nobody means.
!>
!> Rows that hold two axes at right angles to a third keep it parallel to them, and opposed as well. Which of both an assembly
!> comes to is decided by where the deck puts the bodies; what it came to is looked at here. So are dimensions that rows do not ask
!> for, as the distance of two gears.
module branches
   use errors, only: error_t, exit_assembly, set_error
   use joint_set, only: joint_slot_t
   use linkage, only: linkage_t
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: check_branches, find_doubts

contains

   !> Joints that are closed in such a way: the deck put the bodies nearer to that.
   subroutine check_branches(linkage, error)
      type(linkage_t), intent(in) :: linkage             !! the system, assembled
      type(error_t), allocatable, intent(out) :: error   !! the message

      character(:), allocatable :: fault
      integer :: item, k

      do k = 1, size(linkage%joints)
         call look(linkage%joints(k))
      end do
      do k = 1, size(linkage%ideal)
         call look(linkage%ideal(k))
      end do

   contains

      !> Look at one set.
      subroutine look(slot)
         type(joint_slot_t), intent(in) :: slot  !! the set

         do item = 1, slot%set%n
            if (allocated(error)) return
            fault = slot%set%closing_fault(item, linkage%motion)
            if (fault /= "") call set_error(error, exit_assembly, "joint '"//slot%set%names(item)%s//"' "//fault)
         end do
      end subroutine look

   end subroutine check_branches

   !> What of joints does not match where they are closed: warnings.
   subroutine find_doubts(linkage, warnings)
      type(linkage_t), intent(in) :: linkage                   !! the system, assembled
      type(text_t), allocatable, intent(inout) :: warnings(:)  !! (n) grown

      character(:), allocatable :: doubt
      integer :: item, k

      do k = 1, size(linkage%joints)
         associate (set => linkage%joints(k)%set)
            do item = 1, set%n
               doubt = set%closing_doubt(item, linkage%motion)
               if (doubt /= "") call append_text(warnings, "joint '"//set%names(item)%s//"' "//doubt)
            end do
         end associate
      end do
   end subroutine find_doubts

end module branches
