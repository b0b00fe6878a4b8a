!> Contacts that stick whose friction forces are not unique, as those of a block that rests on two feet.
!>
!> Forces of several contacts may hold one another and change no acceleration. Those of least norm are taken (`stick_slip_forces`),
!> so
!> the accelerations are exact; the force of a single contact, and which of them slips first, is a matter of that choice.
!>
!> Source: F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), section 5.3. Limits: judged where
!> contacts are decided (`slip_decision`).
module shared_sticking
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: warn_of_shared_sticking

contains

   !> Append a warning that names all such contacts of a system.
   subroutine warn_of_shared_sticking(system, warnings)
      type(mechanism_t), intent(in) :: system                    !! a part of the mechanism
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      character(:), allocatable :: names
      real(wp) :: first
      integer :: i, k

      names = ""
      first = huge(1.0_wp)
      do k = 1, size(system%clearance_joints%sets)
         if (.not. allocated(system%clearance_joints%sets(k)%set%stick_slip%shared_from)) cycle
         do i = 1, system%clearance_joints%sets(k)%set%n
            call add_joint(i)
         end do
      end do
      if (names == "") return
      call append_text(warnings, "friction forces of sticking contacts are not unique in"//names//", first at t = "// &
                       real_text(first, 6)//" s: the minimum-norm forces are used; accelerations are exact, but the onset of "// &
                       "slip may depend on these forces; use friction with bristles (friction.dahl, friction.lugre), which "// &
                       "makes them unique, or fewer simultaneous contacts")

   contains

      !> Those of one joint.
      subroutine add_joint(item)
         integer, intent(in) :: item   !! its place in set k

         integer :: c
         logical :: is_named

         is_named = .false.
         associate (set => system%clearance_joints%sets(k)%set)
            do c = (item - 1)*set%n_contact_item + 1, item*set%n_contact_item
               if (.not. set%stick_slip%shared_from(c) < huge(1.0_wp)) cycle
               if (.not. is_named) names = names//" '"//set%names(item)%s//"'"
               is_named = .true.
               if (set%label_of(c) /= "") names = names//" "//set%label_of(c)
               first = min(first, set%stick_slip%shared_from(c))
            end do
         end associate
      end subroutine add_joint

   end subroutine warn_of_shared_sticking

end module shared_sticking
