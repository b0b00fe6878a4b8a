!> Follows the friction of contacts that slip or stick: one row for each change.
module slip_monitor
   use contact_stick_slip, only: gives_way, is_undecided, sticks
   use contact_places, only: slip_function, turn_function
   use floors, only: at_rest
   use friction_law, only: memory_slip
   use integrator, only: integrator_t
   use kinds, only: not_a_number, wp
   use mechanism, only: mechanism_t
   use recorder, only: event_t
   use states_of_contacts, only: state_free, state_name
   implicit none (type, external)
   private
   public :: find_change, find_reversal, handle_slip, note_jumps, sliding_way

   character(*), parameter :: word_slip = "slip"    !! kind of event, and state of a contact
   character(*), parameter :: word_stick = "stick"  !! kind of event, and state of a contact

contains

   !> A located event of friction: slip ended, or a contact that sticks gives way. What comes of it is decided when all events of
   !> the instant are known.
   subroutine handle_slip(system, slot, k)
      type(mechanism_t), intent(inout) :: system   !! the system; the contact's state is changed
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: k                     !! contact of the set

      associate (set => system%clearance_joints%sets(slot)%set)
         call set%open_decision(k, merge(gives_way, is_undecided, set%stick_slip%slip(k) == sticks))
      end associate
   end subroutine handle_slip

   !> Where the contact of an event function slides to: a unit vector, in the plane its sign along x; zero if it does not slide, or
   !> has no friction that may stick.
   function sliding_way(system, number) result(way)
      type(mechanism_t), intent(in) :: system   !! the system
      integer, intent(in) :: number             !! number of the event function
      real(wp) :: way(3)                        !! (3) where to, world frame [1]

      integer :: k, slot

      way = 0.0_wp
      if (system%clearance_joints%functions%kind_of(number) /= slip_function) return
      call system%find_contact(number, slot, k)
      associate (stick_slip => system%clearance_joints%sets(slot)%set%stick_slip)
         if (abs(stick_slip%slip(k)) /= 1) return
         way(1) = real(stick_slip%slip(k), wp)
         if (stick_slip%n_tangent > 1) way = stick_slip%tangent(k)%slip_direction
      end associate
   end function sliding_way

   !> Whether a contact that slid slides the other way now, all contacts being decided.
   subroutine find_reversal(system, t, number, before, has_row, row)
      type(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: t                 !! time [s]
      integer, intent(in) :: number             !! number of the contact's event function
      real(wp), intent(in) :: before(3)         !! (3) its `sliding_way` before the event [1]
      logical, intent(out) :: has_row           !! it does: `row` reports of it
      type(event_t), intent(out) :: row         !! what happened

      integer :: k, slot

      has_row = dot_product(before, sliding_way(system, number)) < 0.0_wp
      if (.not. has_row) return
      call system%find_contact(number, slot, k)
      call tell(system, t, slot, k, word_slip, row)
   end subroutine find_reversal

   !> Whether a contact slides with no speed to speak of.
   pure logical function slides_slowly(system, slot, k) result(is_slow)
      type(mechanism_t), intent(in) :: system   !! the system, its contacts laid
      integer, intent(in) :: slot               !! set of the contact
      integer, intent(in) :: k                  !! contact of the set

      is_slow = .false.
      associate (set => system%clearance_joints%sets(slot)%set, scales => system%linkage%scales)
         if (set%stick_slip%memory /= memory_slip) return
         if (.not. set%contact(k)%is_touching .or. abs(set%stick_slip%slip(k)) /= 1) return
         is_slow = norm2(set%stick_slip%tangent(k)%v) < 0.5_wp*at_rest*scales%pace*scales%length
      end associate
   end function slides_slowly

   !> Whether a contact started to stick in the last decision, or does so no more, at this instant.
   subroutine find_change(system, t, slot, k, has_row, row)
      type(mechanism_t), intent(in) :: system   !! the system, its contacts decided
      real(wp), intent(in) :: t                 !! time [s]
      integer, intent(in) :: slot               !! set of the contact
      integer, intent(in) :: k                  !! contact of the set
      logical, intent(out) :: has_row           !! it did: `row` reports of it
      type(event_t), intent(out) :: row         !! what happened

      logical :: stuck

      has_row = .false.
      associate (set => system%clearance_joints%sets(slot)%set)
         if (set%stick_slip%memory /= memory_slip) return
         if (.not. set%contact(k)%is_touching) return
         stuck = set%stick_slip%was(k) == sticks .or. set%stick_slip%was(k) == gives_way
         has_row = stuck .neqv. set%stick_slip%slip(k) == sticks
         if (.not. has_row) return
         if (stuck) then
            call tell(system, t, slot, k, word_stick, row)
         else if (set%contact(k)%onset < t) then
            call tell(system, t, slot, k, word_slip, row)
         else
            call tell(system, t, slot, k, state_name(state_free), row)
         end if
      end associate
   end subroutine find_change

   !> The row of a change.
   subroutine tell(system, t, slot, k, before, row)
      type(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: t                     !! time [s]
      integer, intent(in) :: slot                   !! set of the contact
      integer, intent(in) :: k                      !! contact of the set
      character(*), intent(in) :: before            !! its state before
      type(event_t), intent(out) :: row             !! what happened

      associate (set => system%clearance_joints%sets(slot)%set)
         row%time = t
         row%kind = trim(merge(word_stick//" ", word_slip//"  ", set%stick_slip%slip(k) == sticks))
         row%item = set%names(set%item_of(k))%s
         row%contact = set%label_of(k)
         row%impact_speed = not_a_number()
         row%peak_force = not_a_number()
         row%peak_penetration = not_a_number()
         row%duration = not_a_number()
         row%release_speed = not_a_number()
         row%energy_lost = not_a_number()
         row%impulse = not_a_number()
         row%peak_force_time = not_a_number()
         row%peak_penetration_time = not_a_number()
         row%state_before = trim(before)
         row%state_after = row%kind
      end associate
   end subroutine tell

   !> Contacts whose event of friction, or whose turn, a jump of a load or of the velocity of a driver brought about, as what
   !> happened at the end of the last step: `g` holds the event functions before the jump, the integrator was started anew behind
   !> it. So do those that slip with no speed to speak of: drivers may have come to rest, but for round-off, or may be about to
   !> turn.
   subroutine note_jumps(system, method)
      type(mechanism_t), intent(in) :: system       !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator

      integer :: contact, k, number, slot
      logical :: is_slow

      method%events%n_happened = 0
      if (system%clearance_joints%functions%has_turn) then
         do k = 1, system%clearance_joints%n_contact
            number = system%clearance_joints%functions%place(turn_function, k)
            if (method%events%g(number) > 0.0_wp .or. .not. method%events%g1(number) > 0.0_wp) cycle
            method%events%n_happened = method%events%n_happened + 1
            method%events%happened(method%events%n_happened) = number
         end do
      end if
      if (.not. system%clearance_joints%functions%has_slip) return
      do k = 1, system%clearance_joints%n_contact
         number = system%clearance_joints%functions%place(slip_function, k)
         call system%find_contact(number, slot, contact)
         is_slow = slides_slowly(system, slot, contact)
         if (.not. is_slow .and. (method%events%g(number) > 0.0_wp .or. .not. method%events%g1(number) > 0.0_wp)) cycle
         method%events%n_happened = method%events%n_happened + 1
         method%events%happened(method%events%n_happened) = number
      end do
   end subroutine note_jumps

end module slip_monitor
