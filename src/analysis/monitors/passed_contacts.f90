!> What a run has to say of contacts that its integrator passed over, see `passed_onsets`.
module passed_contacts
   use contact_places, only: touch_function
   use guards, only: joint_words
   use integrator, only: integrator_t
   use integrator_controls, only: onset_interpolate, onset_located, onset_reject
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: append_text, real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: warn_of_passed

contains

   !> Append a warning for each joint that had contacts which were passed over.
   subroutine warn_of_passed(system, method, warnings)
      type(mechanism_t), intent(in) :: system                    !! a part of the mechanism
      class(integrator_t), intent(in) :: method                  !! its integrator
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      integer :: i, k

      if (method%controls%onset == onset_located) return
      do k = 1, size(system%clearance_joints%sets)
         do i = 1, system%clearance_joints%sets(k)%set%n
            call warn_of_joint(k, i)
         end do
      end do

   contains

      !> Of one joint.
      subroutine warn_of_joint(slot, item)
         integer, intent(in) :: slot    !! its set
         integer, intent(in) :: item    !! its place there

         real(wp) :: first
         integer :: c, deepest, n, place

         associate (set => system%clearance_joints%sets(slot)%set, passed => method%onset%passed)
            n = 0
            do c = (item - 1)*set%n_contact_item + 1, item*set%n_contact_item
               place = system%clearance_joints%functions%place(touch_function, set%before%contacts + c)
               if (passed%n(place) == 0) cycle
               if (n == 0) then
                  deepest = c
                  first = passed%first(place)
               end if
               n = n + passed%n(place)
               first = min(first, passed%first(place))
               if (passed%deepest(place) > passed%deepest(place - c + deepest)) deepest = c
            end do
            if (n == 0) return
            place = system%clearance_joints%functions%place(touch_function, set%before%contacts + deepest)
            call append_text(warnings, joint_words(set, deepest)//": "//to_text(n)// &
                             trim(merge(" contact was  ", " contacts were", n == 1))//" missed, with onset and separation "// &
                                "within one "// &
                             "step (contact_onset = "//onset_word()//"): maximum penetration "// &
                             real_text(1.0e3_wp*passed%deepest(place), 3)//" mm at t = "//real_text(passed%at(place), 6)// &
                             " s, the first at "//real_text(first, 6)//" s; use shorter steps (step, maximum_step) or "// &
                             "contact_onset = located")
         end associate
      end subroutine warn_of_joint

      !> The word of the deck.
      function onset_word() result(word)
         character(:), allocatable :: word   !! as in `contact_onset = word`

         select case (method%controls%onset)
         case (onset_interpolate); word = "interpolate"
         case (onset_reject); word = "reject"
         case default; word = "uncontrolled"
         end select
      end function onset_word

   end subroutine warn_of_passed

end module passed_contacts
