!> Which contacts stick and which slip, and which way, at an instant: decided for all of them together.
!>
!> Candidates are contacts that have just started without sliding, those whose slip ended, those that stick, and, where a slip
!> ended or a contact started, those that slide slower than its speed of rest. Their friction forces are the solution of one
!> complementarity problem (`friction_limits`), L_c = c_s F_N: contacts within their limits stick, the others slip against their
!> forces. These have the force of sliding then, L_c = c_f F_N, and the problem is solved again, until no further contact slips. A
!> contact that gives way slips, whatever the last digits of the forces say, and so does each other one at its limit. While all
!> hold, contacts that share a load take the same part of what each can hold (`solve_stick_slips`).
!>
!> Contacts that start together have no forces at first but what round-off makes of their gaps: all stick while the sliding
!> accelerations are `slight`. Contacts that drivers move are decided before, each for itself: see `mechanism_friction`.
!>
!> A slip that ends at once again and again ends at a small speed the wrong way, which doubles each time up to a limit, and
!> sticking is asked for less by as many parts: so round-off alone cannot make events without end.
!>
!> Source and limits: see `friction_limits`.
submodule(mechanism:mechanism_friction) slip_decision
   use contact_stick_slip, only: gives_way, is_undecided
   use floors, only: at_rest, chatter_time, min_band, look_ahead, torn, widest_band
   use friction_limits, only: limit_forces
   implicit none (type, external)

   real(wp), parameter :: at_limit = 1.0e-9_wp   !! less of its limit: a force is at it [1]
   real(wp), parameter :: together = 1.0e-6_wp   !! the same where another contact gives way, well above round-off [1]
   real(wp), parameter :: less_of_speed = 0.5_wp  !! of a slow slip, at which it ends [1]
   real(wp), parameter :: more_of_speed = 1.5_wp  !! of one against its way [1]
   real(wp), parameter :: against_way = 0.1_wp    !! of the widest band: what it may be, for friction gives energy to it [1]
   real(wp), parameter :: slight = 1.0e-6_wp     !! sliding acceleration that decides nothing, of rate times speed [1]
   real(wp), parameter :: not_held = 1.0e-9_wp   !! sliding acceleration that counts, of the maximum that is asked for [1]

contains

   !> Decide about all contacts that touch at a state.
   module procedure mechanism_decide_slips
      integer :: status

      if (self%friction%stick_slips%n_slip == 0) return
      call open_decisions(self)
      if (only_new .and. .not. any_undecided(self)) return
      call self%linkage%set_motion(t, y)  ! rows and energies of other times may have been asked for since
      if (.not. choose_candidates(self, t)) return
      call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
      if (status /= 0) return
      call decide_driven(self, t, y)
      if (.not. all_hold(self)) call limit_stick_slips(self)
      call widen_bands(self)
      call note_shared_forces(self, t)
      call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
   end procedure mechanism_decide_slips

   !> What contacts did until now that no event of their own has opened.
   subroutine open_decisions(self)
      class(mechanism_t), intent(inout) :: self   !! the system

      integer :: k, slot

      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (set%stick_slip%slip(k) /= is_undecided .and. set%stick_slip%slip(k) /= gives_way) call set%open_decision(k, &
                    set%stick_slip%slip(k))
            end do
         end associate
      end do
   end subroutine open_decisions

   !> Whether there is a contact that touches and is not decided.
   pure logical function any_undecided(self)
      class(mechanism_t), intent(in) :: self   !! the system

      integer :: slot

      any_undecided = .false.
      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            any_undecided = any_undecided .or. any(set%contact%is_touching .and. set%stick_slip%slip == is_undecided)
         end associate
      end do
   end function any_undecided

   !> Let the candidates stick; those that start to slide do so. Whether there is any candidate.
   logical function choose_candidates(self, t) result(is_any)
      class(mechanism_t), intent(inout) :: self   !! the system, its motion set
      real(wp), intent(in) :: t                   !! time [s]

      integer :: k, slot
      logical :: is_candidate, some_ended

      is_any = .false.
      some_ended = .false.
      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching) cycle
               call look_at_contact(self, t, slot, k, is_candidate)
               is_any = is_any .or. is_candidate
               some_ended = some_ended .or. (is_candidate .and. set%stick_slip%slip(k) == is_undecided)
            end do
         end associate
      end do
      if (.not. is_any) return
      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching) cycle
               if (abs(set%stick_slip%slip(k)) == 1) then
                  if (.not. (some_ended .and. slides_slowly(self, slot, k))) cycle
                  call note(self, t, slot, k)
               end if
               call set%slip_as(k, sticks)
            end do
         end associate
      end do
   end function choose_candidates

   !> Whether a contact is a candidate of its own; one that starts to slide, or is torn off, slides.
   subroutine look_at_contact(self, t, slot, k, is_candidate)
      class(mechanism_t), intent(inout) :: self   !! the system, its motion set
      real(wp), intent(in) :: t                   !! time [s]
      integer, intent(in) :: slot                 !! set of the contact
      integer, intent(in) :: k                    !! contact of the set
      logical, intent(out) :: is_candidate        !! whether it is one

      logical :: slides
      real(wp) :: speed

      associate (set => self%clearance_joints%sets(slot)%set)
         is_candidate = abs(set%stick_slip%slip(k)) /= 1
         call set%lay(k, self%linkage%motion)
         speed = size_of(set%stick_slip%tangent(k)%v)
         select case (set%stick_slip%slip(k))
         case (is_undecided)
            slides = (set%stick_slip%was(k) == is_undecided .or. set%stick_slip%n_tangent > 1) &
                     .and. speed > rest_speed(self, slot, k)
         case (gives_way)
            slides = speed > 0.5_wp*torn*own_speed(self)
         case default
            return
         end select
         call note(self, t, slot, k)
         is_candidate = .not. slides
         if (slides) call set%slip_toward(k, set%stick_slip%tangent(k)%v)
      end associate
   end subroutine look_at_contact

   !> Note that a contact is decided, and what the next end of its slip is to bear: more and more while decisions follow quickly.
   subroutine note(self, t, slot, k)
      class(mechanism_t), intent(inout) :: self   !! the system, its motion set
      real(wp), intent(in) :: t                   !! time [s]
      integer, intent(in) :: slot                 !! set of the contact
      integer, intent(in) :: k                    !! contact of the set

      real(wp) :: band, delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact), speed

      speed = own_speed(self)
      associate (set => self%clearance_joints%sets(slot)%set)
         call set%gaps(self%linkage%motion, delta, rate)
         band = 0.0_wp
         if (t - set%stick_slip%since(k) < chatter_time*own_time(self, slot, k, delta(set%before%contacts + k))) then
            band = speed*min(max(2.0_wp*set%stick_slip%band(k)/speed, min_band), widest_band)
         end if
         call set%note_decision(k, t, band, rest_speed(self, slot, k), 0.0_wp)
      end associate
   end subroutine note

   !> In space: a contact that slides on more slowly than slip ends is at no end of its slip until it has lost half of that speed;
   !> one that slides against its way, until that has grown by half. `follow_sliding` ends that when it has become faster.
   subroutine widen_bands(self)
      class(mechanism_t), intent(inout) :: self   !! the system, its contacts decided

      real(wp) :: along, minimum
      integer :: k, slot

      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0 .or. set%stick_slip%n_tangent == 1) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. abs(set%stick_slip%slip(k)) /= 1) cycle
               associate (tangent => set%stick_slip%tangent(k), still => rest_speed(self, slot, k))
                  along = dot_product(matmul(tangent%t, tangent%v), tangent%slip_direction)
                  if (along > still) cycle
                  minimum = end_speed(self, slot, k) - merge(less_of_speed, more_of_speed, along > 0.0_wp)*along
                  call set%note_decision(k, set%stick_slip%since(k), max(set%stick_slip%band(k), minimum), still, &
                                         widest_band*own_speed(self))
               end associate
            end do
         end associate
      end do
   end subroutine widen_bands

   !> Decide about the contacts that drivers move.
   subroutine decide_driven(self, t, y)
      class(mechanism_t), intent(inout) :: self   !! the system, evaluated with all candidates sticking; so it is afterwards
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(in) :: y(:)                !! (n) state [any]

      integer :: k, slot, status

      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set, still => at_rest*own_speed(self))
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               associate (tangent => set%stick_slip%tangent(k))
                  if (.not. set%contact(k)%is_touching .or. set%stick_slip%slip(k) /= sticks .or. .not. tangent%is_driven) cycle
                  if (set%stick_slip%was(k) == sticks) cycle
                  call set%note_decision(k, t, 0.0_wp, still, 0.0_wp)
                  call go_with_drivers(self, t, y, slot, k, still)
                  if (set%stick_slip%was(k) == gives_way .and. set%stick_slip%slip(k) == sticks .and. &
                      size_of(tangent%f_t) > set%laws%friction%stick_limit(tangent%f_n)) call set%slip_toward(k, -tangent%f_t)
                  if (set%stick_slip%slip(k) /= sticks) call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
               end associate
            end do
         end associate
      end do
   end subroutine decide_driven

   !> Whether every contact that is tried as sticking holds, and none of them is to give way.
   pure logical function all_hold(self)
      class(mechanism_t), intent(in) :: self   !! the system, evaluated with all candidates sticking

      integer :: k, slot

      all_hold = .true.
      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. set%stick_slip%slip(k) /= sticks &
                   .or. set%stick_slip%tangent(k)%is_driven) cycle
               all_hold = all_hold .and. set%stick_slip%was(k) /= gives_way &
                          .and. size_of(set%stick_slip%tangent(k)%f_t) <= limit_of(self, set, k)
            end do
         end associate
      end do
   end function all_hold

   !> Maximum force that a contact is asked to hold: less of one that starts to, while it chatters.
   pure real(wp) function limit_of(self, set, k) result(limit)
      class(mechanism_t), intent(in) :: self           !! the system, evaluated
      class(clearance_set_t), intent(in) :: set        !! set of the contact
      integer, intent(in) :: k                         !! contact of the set

      limit = set%laws%friction%stick_limit(set%stick_slip%tangent(k)%f_n)
      if (set%stick_slip%was(k) /= sticks) limit = (1.0_wp - set%stick_slip%band(k)/max(own_speed(self), tiny(1.0_wp)))*limit
   end function limit_of

   !> Let those of the contacts that are tried as sticking slip that cannot hold.
   subroutine limit_stick_slips(self)
      class(mechanism_t), intent(inout) :: self   !! the system, evaluated with all candidates sticking

      integer :: m, n_tangent

      call list_stick_slips(self, .false., m)
      if (m == 0) return
      n_tangent = self%clearance_joints%sets(self%friction%stick_slips%at(1)%slot)%set%stick_slip%n_tangent
      call limit_listed(self, m/n_tangent, n_tangent)
   end subroutine limit_stick_slips

   !> The same of the contacts on the list.
   subroutine limit_listed(self, n, n_tangent)
      class(mechanism_t), intent(inout) :: self   !! the system, evaluated with all candidates sticking
      integer, intent(in) :: n                    !! contacts on the list
      integer, intent(in) :: n_tangent            !! tangents of each

      real(wp), dimension(n_tangent*n) :: against, force, r
      real(wp) :: asked, limit(n), nothing
      integer :: c, pass, status
      logical :: is_new, slips(n)

      associate (stick_slips => self%friction%stick_slips, m => n_tangent*n)
         do c = 1, m
            associate (at => stick_slips%at(c))
               force(c) = self%clearance_joints%sets(at%slot)%set%stick_slip%tangent(at%contact)%f_t(at%axis)
               slips((c - 1)/n_tangent + 1) = self%clearance_joints%sets(at%slot)%set%stick_slip%was(at%contact) == gives_way
            end associate
         end do
         if (any(slips)) then
            do c = 1, n
               slips(c) = slips(c) .or. norm2(force(n_tangent*(c - 1) + 1:n_tangent*c)) &
                          >= (1.0_wp - together)*limit_of_listed(self, stick_slips%at(n_tangent*c), .false.)
            end do
         end if
         call find_mobilities(self, m, mobility_of_depth(self, m), nothing, status)
         if (status /= 0) return
         r = matmul(stick_slips%matrix(:m, :m), force)  ! what no force can change is omitted
         asked = maxval(abs(r))
         if (asked <= slight*self%linkage%scales%pace*own_speed(self) .and. .not. any(slips)) return
         do pass = 1, n + 1
            limit = [(limit_of_listed(self, stick_slips%at(n_tangent*c), slips(c)), c=1, n)]
            call limit_forces(n, n_tangent, size(stick_slips%matrix, 1), stick_slips%matrix(:, :m), r, limit, force, against)
            is_new = .false.
            do c = 1, n
               if (slips(c)) cycle
               associate (first => n_tangent*(c - 1) + 1, last => n_tangent*c)
                  slips(c) = norm2(force(first:last)) >= (1.0_wp - at_limit)*limit(c) &
                             .and. norm2(against(first:last)) > not_held*asked
               end associate
               is_new = is_new .or. slips(c)
            end do
            if (.not. is_new) exit
         end do
         do c = 1, n
            if (.not. slips(c)) cycle
            associate (first => n_tangent*(c - 1) + 1, last => n_tangent*c)
               call let_slip(self, stick_slips%at(last)%slot, stick_slips%at(last)%contact, n_tangent, force(first:last), &
                             against(first:last))
            end associate
         end do
      end associate
   end subroutine limit_listed

   !> Maximum friction force of a contact on the list: that of sliding, if it slips.
   real(wp) function limit_of_listed(self, at, slips) result(limit)
      class(mechanism_t), intent(in) :: self   !! the system, evaluated
      type(gripped_t), intent(in) :: at        !! a tangent of the contact
      logical, intent(in) :: slips             !! whether it slips

      real(wp) :: f(1)

      associate (set => self%clearance_joints%sets(at%slot)%set)
         if (slips) then
            call set%laws%friction%force(1, [set%stick_slip%tangent(at%contact)%f_n], [1.0_wp], f)
            limit = f(1)
         else
            limit = limit_of(self, set, at%contact)
         end if
      end associate
   end function limit_of_listed

   !> Let a contact slip against its force; where it has none, the way it goes.
   subroutine let_slip(self, slot, k, n_tangent, force, against)
      class(mechanism_t), intent(inout) :: self        !! the system
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: k                         !! contact of the set
      integer, intent(in) :: n_tangent                 !! its tangents
      real(wp), intent(in) :: force(n_tangent)         !! (n_tangent) its friction force [N]
      real(wp), intent(in) :: against(n_tangent)       !! (n_tangent) against its sliding acceleration [m/s^2]

      real(wp) :: way(2)

      way = 0.0_wp
      associate (set => self%clearance_joints%sets(slot)%set)
         associate (v => set%stick_slip%tangent(k)%v)
            if (any(abs(force) > 0.0_wp)) then
               way(:n_tangent) = -force/maxval(abs(force))  ! squares of small numbers are zero
               way = way/norm2(way)
               if (-more_of_speed*dot_product(v, way) > against_way*widest_band*own_speed(self) - end_speed(self, slot, k)) way = v
            else if (size_of(v) > 0.0_wp) then
               way = v
            else
               way(:n_tangent) = -against
            end if
         end associate
         call set%slip_toward(k, way)
      end associate
   end subroutine let_slip

   !> Let a contact that drivers move go their way, by its speed now and a little later; it sticks if it does not move then either.
   subroutine go_with_drivers(self, t, y, slot, k, still)
      class(mechanism_t), intent(inout) :: self  !! the system, evaluated at the state with the contact sticking
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      integer, intent(in) :: slot                    !! set of the contact
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: still                  !! speed taken as zero [m/s]

      real(wp) :: later, v(2)
      integer :: status

      later = max(look_ahead*self%friction%stick_slips%h, self%time_of_difference(t))
      associate (set => self%clearance_joints%sets(slot)%set)
         v = set%stick_slip%tangent(k)%v
         if (size_of(v) < 0.5_wp*still) then
            self%friction%stick_slips%trial%y = y + later*self%friction%stick_slips%trial%ydot
            call self%linkage%set_motion(t + later, self%friction%stick_slips%trial%y)
            call set%lay(k, self%linkage%motion)
            v = set%stick_slip%tangent(k)%v
            call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
         end if
         if (size_of(v) >= 0.5_wp*still) call set%slip_toward(k, v)
      end associate
   end subroutine go_with_drivers

   !> Whether a contact that slides is slower than its speed of rest.
   logical function slides_slowly(self, slot, k) result(is_slow)
      class(mechanism_t), intent(in) :: self   !! the system, its contacts laid
      integer, intent(in) :: slot              !! set of the contact
      integer, intent(in) :: k                 !! contact of the set

      associate (set => self%clearance_joints%sets(slot)%set)
         is_slow = size_of(set%stick_slip%tangent(k)%v) < merge(0.5_wp, 1.0_wp, set%stick_slip%n_tangent == 1) &
                   *rest_speed(self, slot, k)
      end associate
   end function slides_slowly

end submodule slip_decision
