!> What the deck gives but the motion does not need, for `gudgeon explain`.
!>
!> Whether a row is used follows from the references of all columns of all tables, as each kind's own `info` reports them.
module explain_dropped
   use console, only: say
   use kind_info, only: cell_reference
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene, only: analysis_kinematic, scene_t, table_lubricants, table_t
   implicit none (type, external)
   private
   public :: say_dropped

contains

   !> Say what was dropped.
   subroutine say_dropped(scene, system)
      type(scene_t), intent(in) :: scene            !! the scene
      type(mechanism_t), intent(in) :: system   !! its system

      integer :: k
      logical :: is_nothing, is_used(max(size(scene%frictions), size(scene%laws), size(scene%materials), size(scene%wears), &
                                         size(scene%lubrication%films), size(scene%lubrication%oils)))

      call say("")
      call say("not used")
      is_nothing = .true.
      if (.not. norm2(system%loading%gravity) > 0.0_wp) call drop("gravity: zero")
      call find_used(scene, "friction.", is_used)
      do k = 1, size(scene%frictions)
         if (.not. scene%frictions(k)%law%is_active()) then
            call drop("friction law '"//scene%frictions(k)%law%name//"': zero coefficient")
         else if (.not. is_used(k)) then
            call drop("friction law '"//scene%frictions(k)%law%name//"': no joint refers to it")
         end if
      end do
      call find_used(scene, "contact.", is_used)
      do k = 1, size(scene%laws)
         if (.not. is_used(k)) call drop("contact law '"//scene%laws(k)%law%name//"': no joint refers to it")
      end do
      call find_used(scene, "material", is_used)
      do k = 1, size(scene%materials)
         if (.not. is_used(k)) call drop("material '"//scene%materials(k)%name%s//"': no joint refers to it")
      end do
      call find_used(scene, "wear.", is_used)
      do k = 1, size(scene%wears)
         if (.not. is_used(k)) call drop("wear law '"//scene%wears(k)%law%name//"': no joint refers to it")
      end do
      call find_used(scene, "film.", is_used)
      do k = 1, size(scene%lubrication%films)
         if (.not. is_used(k)) call drop("film '"//scene%lubrication%films(k)%law%name//"': no joint refers to it")
      end do
      call find_used(scene, "lubricant", is_used)
      do k = 1, size(scene%lubrication%oils)
         if (.not. is_used(k)) then
            call drop("lubricant '"//scene%tables%base(table_lubricants)%items(k)%name//"': no joint refers to it")
         end if
      end do
      if (.not. system%ledger%is_kept) call drop("energy balance: off")
      if (scene%analysis == analysis_kinematic .and. size(system%linkage%ideal) > 0) then
         call drop("clearances: a kinematic analysis treats all joints as ideal")
      end if
      if (is_nothing) call say("nothing", 2)

   contains

      !> Say one thing that was dropped.
      subroutine drop(line)
         character(*), intent(in) :: line  !! what, and why

         call say(line, 2)
         is_nothing = .false.
      end subroutine drop
   end subroutine say_dropped

   !> Which rows of a group of kinds any row of the deck refers to.
   subroutine find_used(scene, group, is_used)
      type(scene_t), intent(in) :: scene       !! the scene
      character(*), intent(in) :: group        !! what columns say that they refer to
      logical, intent(out) :: is_used(:)       !! (rows of the group, or more) whether a row is referred to

      integer :: k

      is_used = .false.
      do k = 1, size(scene%tables%base)
         call look(scene%tables%base(k))
      end do
      do k = 1, size(scene%joints)
         call look(scene%joints(k))
      end do
      do k = 1, size(scene%forces)
         call look(scene%forces(k))
      end do
      do k = 1, size(scene%clearances)
         call look(scene%clearances(k))
      end do

   contains

      !> Mark what the rows of a table refer to.
      subroutine look(table)
         type(table_t), intent(in) :: table  !! the table

         integer :: c, i

         do c = 1, size(table%info%columns)
            if (table%info%columns(c)%cell /= cell_reference) cycle
            if (table%info%columns(c)%refers_to /= group) cycle
            do i = 1, size(table%items)
               associate (index => table%items(i)%values(c)%index)
                  if (index > 0) is_used(index) = .true.
               end associate
            end do
         end do
      end subroutine look

   end subroutine find_used

end module explain_dropped
