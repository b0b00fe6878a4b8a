!> Follows the friction of contacts that slip or stick: one row for each change.
module slip_watch
   use contact_grip, only: is_undecided, sticks
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
   public :: decide_next, find_reversal, handle_slip, note_jumps, sliding_way, unsettle

   character(*), parameter :: word_slip = "slip"    !! kind of event, and state of a contact
   character(*), parameter :: word_stick = "stick"  !! kind of event, and state of a contact

contains

   !> A located event of friction: slip ended, or a contact that sticks gives way. It may go on slipping, the other way; that is
   !> told by `find_reversal` when all contacts are decided. Where a slip ended, others that slide with no speed to speak of are to
   !> be decided anew: they may have to hold their part of the load. Where a contact gives way they are not: it leaves more to
   !> them, and they are at their limits already. Tried all the same, they would hold beside it by a last digit, be held by it
   !> again, and give way at once, in turn and without end.
   subroutine handle_slip(system, t, y, slot, k, has_row, row)
      type(mechanism_t), intent(inout) :: system   !! the system; the contact's state is changed
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in) :: y(:)                     !! (n) state [any]
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: k                         !! contact of the set
      logical, intent(out) :: has_row                  !! it sticks now, or does no more: `row` tells of it
      type(event_t), intent(out) :: row                !! what happened

      integer :: slip
      logical :: is_any, stuck

      stuck = system%loose%sets(slot)%set%grip%slip(k) == sticks
      call system%decide_slip(t, y, slot, k)
      slip = system%loose%sets(slot)%set%grip%slip(k)
      has_row = (slip == sticks) .neqv. stuck
      if (.not. stuck) call unsettle(system, is_any)
      call system%loose%sets(slot)%set%slip_as(k, slip)
      if (has_row) call tell(system, t, slot, k, merge(word_stick//" ", word_slip//"  ", stuck), row)
   end subroutine handle_slip

   !> Where the contact of an event function slides to: a unit vector, in the plane its sign along x; zero if it does not slide, or
   !> has no friction that may stick.
   function sliding_way(system, number) result(way)
      type(mechanism_t), intent(in) :: system   !! the system
      integer, intent(in) :: number             !! number of the event function
      real(wp) :: way(3)                        !! (3) where to, world frame [1]

      integer :: k, slot

      way = 0.0_wp
      if (system%loose%functions%kind_of(number) /= slip_function) return
      call system%find_contact(number, slot, k)
      associate (grip => system%loose%sets(slot)%set%grip)
         if (abs(grip%slip(k)) /= 1) return
         way(1) = real(grip%slip(k), wp)
         if (grip%n_tangent > 1) way = grip%tangent(k)%way
      end associate
   end function sliding_way

   !> Whether a contact that slid slides the other way now, all contacts being decided.
   subroutine find_reversal(system, t, number, before, has_row, row)
      type(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: t                 !! time [s]
      integer, intent(in) :: number             !! number of the contact's event function
      real(wp), intent(in) :: before(3)         !! (3) its `sliding_way` before the event [1]
      logical, intent(out) :: has_row           !! it does: `row` tells of it
      type(event_t), intent(out) :: row         !! what happened

      integer :: k, slot

      has_row = dot_product(before, sliding_way(system, number)) < 0.0_wp
      if (.not. has_row) return
      call system%find_contact(number, slot, k)
      call tell(system, t, slot, k, word_slip, row)
   end subroutine find_reversal

   !> Contacts that slide with no speed to speak of are not decided any more.
   subroutine unsettle(system, is_any)
      type(mechanism_t), intent(inout) :: system   !! the system; states of its contacts are changed
      logical, intent(out) :: is_any               !! there were some

      integer :: k, slot

      is_any = .false.
      do slot = 1, size(system%loose%sets)
         associate (set => system%loose%sets(slot)%set)
            if (set%grip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. slides_slowly(system, slot, k)) cycle
               is_any = .true.
               call set%slip_as(k, is_undecided)
            end do
         end associate
      end do
   end subroutine unsettle

   !> Whether a contact slides with no speed to speak of.
   pure logical function slides_slowly(system, slot, k) result(is_slow)
      type(mechanism_t), intent(in) :: system   !! the system, its contacts laid
      integer, intent(in) :: slot               !! set of the contact
      integer, intent(in) :: k                  !! contact of the set

      is_slow = .false.
      associate (set => system%loose%sets(slot)%set, scales => system%linkage%scales)
         if (set%grip%memory /= memory_slip) return
         if (.not. set%contact(k)%is_touching .or. abs(set%grip%slip(k)) /= 1) return
         is_slow = norm2(set%grip%tangent(k)%v) < 0.5_wp*at_rest*scales%pace*scales%length
      end associate
   end function slides_slowly

   !> Decide about the first contact that has begun, or was unsettled, and is not decided. The row tells of it if it sticks.
   subroutine decide_next(system, t, y, is_found, has_row, row)
      type(mechanism_t), intent(inout) :: system   !! the system, its motion that of the state
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in) :: y(:)                     !! (n) state [any]
      logical, intent(out) :: is_found                 !! there was one
      logical, intent(out) :: has_row                  !! it sticks: `row` tells of it
      type(event_t), intent(out) :: row                !! what happened

      integer :: k, slot

      is_found = .false.
      has_row = .false.
      do slot = 1, size(system%loose%sets)
         associate (set => system%loose%sets(slot)%set)
            if (set%grip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. set%grip%slip(k) /= is_undecided) cycle
               is_found = .true.
               call system%decide_slip(t, y, slot, k)
               has_row = set%grip%slip(k) == sticks
               if (.not. has_row) return
               if (set%contact(k)%onset < t) then
                  call tell(system, t, slot, k, word_slip, row)
               else
                  call tell(system, t, slot, k, state_name(state_free), row)
               end if
               return
            end do
         end associate
      end do
   end subroutine decide_next

   !> The row of a change.
   subroutine tell(system, t, slot, k, before, row)
      type(mechanism_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: t                     !! time [s]
      integer, intent(in) :: slot                   !! set of the contact
      integer, intent(in) :: k                      !! contact of the set
      character(*), intent(in) :: before            !! its state before
      type(event_t), intent(out) :: row             !! what happened

      associate (set => system%loose%sets(slot)%set)
         row%time = t
         row%kind = trim(merge(word_stick//" ", word_slip//"  ", set%grip%slip(k) == sticks))
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
   !> happened at the end of the last step: `g` holds the event functions before the jump, the integrator was begun anew behind it.
   !> So do those that slip with no speed to speak of: drivers may have come to rest, but for round-off, or may be about to turn.
   subroutine note_jumps(system, method)
      type(mechanism_t), intent(in) :: system       !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator

      integer :: contact, k, number, slot
      logical :: is_slow

      method%events%n_happened = 0
      if (system%loose%functions%has_turn) then
         do k = 1, system%loose%n_contact
            number = system%loose%functions%place(turn_function, k)
            if (method%events%g(number) > 0.0_wp .or. .not. method%events%g1(number) > 0.0_wp) cycle
            method%events%n_happened = method%events%n_happened + 1
            method%events%happened(method%events%n_happened) = number
         end do
      end if
      if (.not. system%loose%functions%has_slip) return
      do k = 1, system%loose%n_contact
         number = system%loose%functions%place(slip_function, k)
         call system%find_contact(number, slot, contact)
         is_slow = slides_slowly(system, slot, contact)
         if (.not. is_slow .and. (method%events%g(number) > 0.0_wp .or. .not. method%events%g1(number) > 0.0_wp)) cycle
         method%events%n_happened = method%events%n_happened + 1
         method%events%happened(method%events%n_happened) = number
      end do
   end subroutine note_jumps

end module slip_watch
