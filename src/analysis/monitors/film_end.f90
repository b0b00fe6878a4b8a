!> Where a film that alone holds the surfaces of a joint apart comes to its end: the journal at e = eps_max c.
!>
!> The end is an event, that of a contact which would start there; but there is none, and the run cannot continue.
!> Source: the pressure of every film grows without bound for e -> c. Limits: joints with `level = lubricated`.
module film_end
   use contact_places, only: touch_function
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: film_that_ended

contains

   !> The joint whose film comes to its end at the events of the last step, as text; blank if there is none.
   function film_that_ended(system, method) result(words)
      type(mechanism_t), intent(in) :: system    !! the system
      class(integrator_t), intent(in) :: method  !! the integrator, at events
      character(:), allocatable :: words         !! a message

      integer :: contact, item, k, slot
      real(wp) :: thickness

      words = ""
      do k = 1, method%events%n_happened
         if (system%clearance_joints%functions%kind_of(method%events%happened(k)) /= touch_function) cycle
         call system%find_contact(method%events%happened(k), slot, contact)
         associate (set => system%clearance_joints%sets(slot)%set)
            if (.not. allocated(set%laws%films)) cycle
            if (.not. set%laws%films%is_alone) cycle
            item = set%item_of(contact)
            thickness = set%items%pairs(item)%clearance*(1.0_wp - set%laws%films%eps_max(item))
            words = "the film of joint '"//set%names(item)%s//"' ("//set%laws%films%law%name//") reached its limit: the "// &
               "eccentricity is "// &
                    real_text(set%laws%films%eps_max(item), 8)//" times the clearance (eps_max), film thickness "// &
                    real_text(1.0e6_wp*thickness, 3)//" um"
            return
         end associate
      end do
   end function film_that_ended

end module film_end
