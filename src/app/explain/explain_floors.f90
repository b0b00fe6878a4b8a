!> What is negligible in a scene: every number of the module `floors`, in the scene's own measure.
module explain_floors
   use channel_noise, only: noise_words
   use console, only: say
   use friction_law, only: memory_slip
   use floors, only: all_floors, floor_t, for_adaptive, for_contacts, for_sticking, of_acceleration, of_contact, of_mobility, &
      of_pace, of_run, of_speed, of_step, of_time, of_tolerance
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: floors_manual, floors_of_scene

contains

   !> For `gudgeon explain`: the characteristic rate of a mechanism at its start, and what is small beside it. The system is
   !> evaluated.
   subroutine floors_of_scene(system, y, end)
      type(mechanism_t), intent(inout) :: system  !! the system; its characteristic rate is set
      real(wp), intent(in) :: y(:)                    !! (n) state at the start [any]
      real(wp), intent(in) :: end                     !! end of the run [s]

      type(floor_t), allocatable :: list(:)
      real(wp) :: own_speed
      integer :: k

      call system%begin_pace(0.0_wp, y, end)
      call say("")
      call say("numerical thresholds")
      call say("each is a small part of a scale of this model; none is a setting", 2)
      call say("initial characteristic rate of the mechanism "//real_text(system%linkage%scales%pace, 3)//"/s, its size "// &
               real_text(1.0e3_wp*system%linkage%scales%length, 3)//" mm; the rate follows the maximum speed or angular speed "// &
                  "so far", 2)
      list = all_floors()
      own_speed = system%linkage%scales%pace*system%linkage%scales%length
      do k = 1, size(list)
         if (.not. is_needed(system, list(k)%needed)) cycle
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

   !> Whether a system has what a threshold is for.
   logical function is_needed(system, needed)
      type(mechanism_t), intent(in) :: system   !! the system
      integer, intent(in) :: needed             !! as in `floors`

      integer :: k

      is_needed = .true.
      select case (needed)
      case (for_contacts)
         is_needed = system%clearance_joints%n_contact > 0
      case (for_sticking)
         is_needed = .false.
         do k = 1, size(system%clearance_joints%sets)
            associate (laws => system%clearance_joints%sets(k)%set%laws)
               if (.not. allocated(laws%friction)) cycle
               is_needed = is_needed .or. laws%friction%memory == memory_slip
            end associate
         end do
      case (for_adaptive)
         is_needed = index(system%stabiliser%words(), "adaptive") > 0
      end select
   end function is_needed

   !> For the manual: all of them, and what they are parts of.
   subroutine floors_manual()
      type(floor_t), allocatable :: list(:)
      integer :: k

      call say("")
      call say("## Numerical thresholds")
      call say("")
      call say("No law has an absolute minimum speed, length, time or force: each threshold is relative to a scale of the model.")
      call say("The characteristic rate of a mechanism is its maximum rate so far: |v| over its size, or angular speed.")
      call say("Its characteristic speed is that rate times its size. `gudgeon explain` prints the values for a deck.")
      call say("")
      call say("```")
      list = all_floors()
      do k = 1, size(list)
         call say(real_text(list(k)%part, 3)//" "//measure(list(k)%of), 2, trim(list(k)%meaning), 44)
      end do
      call say("```")
   end subroutine floors_manual

   !> What a number is a part of, as text.
   pure function measure(of) result(words)
      integer, intent(in) :: of            !! of what, as in `floors`
      character(:), allocatable :: words   !! as "of the mechanism's speed"

      select case (of)
      case (of_speed)
         words = "times the characteristic speed"
      case (of_pace)
         words = "times the characteristic rate"
      case (of_step)
         words = "times the step size"
      case (of_contact)
         words = "(ratio)"
      case (of_acceleration)
         words = "times the acceleration by the normal force"
      case (of_mobility)
         words = "times the mobility of free bodies"
      case (of_run)
         words = "times size over duration of the run"
      case (of_time)
         words = "times the spacing of floating-point numbers at t"
      case (of_tolerance)
         words = "times the tolerance times the characteristic speed"
      case default
         words = ""
      end select
   end function measure

end module explain_floors
