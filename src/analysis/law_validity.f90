!> Whether the contacts of a run stayed within the range of their laws: one warning per joint that did not.
!>
!> Quasi-static contact holds for impact speeds below 1e-5 sqrt(E/rho) of the materials; some laws hold up to a
!> penetration. Both are checked against the fastest impact and the deepest contact, which cost nothing to keep.
!>
!> Source: Flores et al. (2008), section 3.2. The limit is one of principle: impacts above it are common practice, so it
!> is told and nothing is stopped.
module law_validity
   use clearance_set, only: clearance_set_t
   use kinds, only: wp
   use normal_law, only: parameter_deepest
   use planar_system, only: planar_system_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: warn_of_laws

contains

   !> Append a warning for each joint whose contacts left the range of its law.
   subroutine warn_of_laws(system, warnings)
      type(planar_system_t), intent(in) :: system                !! the system at the end of a run
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      character(:), allocatable :: words
      integer :: i, k

      do k = 1, size(system%clearances)
         do i = 1, system%clearances(k)%set%n
            words = complaint(system%clearances(k)%set, i)
            if (len(words) > 0) call append_text(warnings, words)
         end do
      end do
   end subroutine warn_of_laws

   !> What is to be said of one joint, empty if nothing is.
   function complaint(set, k) result(words)
      class(clearance_set_t), intent(in) :: set   !! its set
      integer, intent(in) :: k                    !! item of the set
      character(:), allocatable :: words          !! one line

      real(wp) :: deepest, limit
      integer :: contact, first, last

      words = ""
      first = (k - 1)*set%n_contact_item + 1
      last = k*set%n_contact_item
      associate (limit => set%pairs(k)%speed_limit, fastest => maxval(set%greatest_speed(first:last)))
         if (fastest > limit) then
            words = "impacts of up to "//real_text(fastest, 3)//" m/s, but the law is quasi-static: strictly below "// &
                    real_text(limit, 3)//" m/s (1e-5 sqrt(E/rho))"
         end if
      end associate
      do contact = first, last
         limit = set%parameters(parameter_deepest, contact)
         deepest = set%greatest_penetration(contact)
         if (deepest <= limit) cycle
         if (len(words) > 0) words = words//"; "
         words = words//"penetrations of up to "//real_text(1.0e3_wp*deepest, 3)//" mm, but the law ends at "// &
                 real_text(1.0e3_wp*limit, 3)//" mm and was continued along its tangent"
         exit
      end do
      if (len(words) > 0) words = "joint '"//set%names(k)%s//"', law '"//set%law%name//"': "//words
   end function complaint

end module law_validity
