!> What counts as nothing in a scene: every number of the module `floors`, in the scene's own measure.
module explain_floors
   use channel_noise, only: noise_words
   use console, only: say
   use floors, only: all_floors, floor_t, of_acceleration, of_contact, of_mobility, of_pace, of_run, of_speed, of_step, of_time, &
      of_tolerance
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: floors_manual, floors_of_scene

contains

   !> For `gudgeon explain`: the pace of a mechanism at its start, and what is small beside it. The system is evaluated.
   subroutine floors_of_scene(system, y, end)
      type(mechanism_t), intent(inout) :: system  !! the system; its pace is set
      real(wp), intent(in) :: y(:)                    !! (n) state at the start [any]
      real(wp), intent(in) :: end                     !! end of the run [s]

      type(floor_t), allocatable :: list(:)
      real(wp) :: own_speed
      integer :: k

      call system%begin_pace(0.0_wp, y, end)
      call say("")
      call say("what counts as nothing")
      call say("the pace of the mechanism at the start is "//real_text(system%linkage%scales%pace, 3)//"/s, its size "// &
               real_text(1.0e3_wp*system%linkage%scales%length, 3)//" mm; the pace follows its greatest rate", 2)
      list = all_floors()
      own_speed = system%linkage%scales%pace*system%linkage%scales%length
      do k = 1, size(list)
         select case (list(k)%of)
         case (of_speed)
            call say(trim(list(k)%meaning)//": "//real_text(list(k)%part*own_speed, 3)//" m/s ("// &
                     real_text(list(k)%part, 3)//" "//measure(list(k)%of)//")", 2)
         case (of_pace)
            call say(trim(list(k)%meaning)//": "//real_text(list(k)%part*system%linkage%scales%pace, 3)//"/s ("// &
                     real_text(list(k)%part, 3)//" "//measure(list(k)%of)//")", 2)
         case (of_run)
            call say(trim(list(k)%meaning)//": "//real_text(list(k)%part*system%linkage%scales%length/end, 3)//" m/s ("// &
                     real_text(list(k)%part, 3)//" "//measure(list(k)%of)//")", 2)
         case default
            call say(trim(list(k)%meaning)//": "//real_text(list(k)%part, 3)//" "//measure(list(k)%of), 2)
         end select
      end do
      call say(noise_words(), 2)
   end subroutine floors_of_scene

   !> For the manual: all of them, and what they are parts of.
   subroutine floors_manual()
      type(floor_t), allocatable :: list(:)
      integer :: k

      call say("")
      call say("## What counts as nothing")
      call say("")
      call say("No law has a least speed, length, time or force of its own: what is small is a part of what the scene has.")
      call say("The pace of a mechanism is its greatest rate so far, |v| over its size or angular speed; its speed is pace")
      call say("times size. `gudgeon explain` prints the numbers for a deck.")
      call say("")
      call say("```")
      list = all_floors()
      do k = 1, size(list)
         call say(real_text(list(k)%part, 3)//" "//measure(list(k)%of), 2, trim(list(k)%meaning), 44)
      end do
      call say("```")
   end subroutine floors_manual

   !> What a number is a part of, in words.
   pure function measure(of) result(words)
      integer, intent(in) :: of            !! of what, as in `floors`
      character(:), allocatable :: words   !! as "of the mechanism's speed"

      select case (of)
      case (of_speed)
         words = "of the mechanism's speed"
      case (of_pace)
         words = "of its pace"
      case (of_step)
         words = "of the step"
      case (of_contact)
         words = "of the contact's own"
      case (of_acceleration)
         words = "of what the normal force would give"
      case (of_mobility)
         words = "of that of free bodies"
      case (of_run)
         words = "of its size in the whole run"
      case (of_time)
         words = "spacings of numbers at the time"
      case (of_tolerance)
         words = "of the tolerance times the mechanism's speed"
      case default
         words = ""
      end select
   end function measure

end module explain_floors
