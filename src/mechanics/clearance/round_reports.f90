!> What round contacts report.
submodule(round_contacts) round_reports
   use film_law, only: film_motion_t
   use film_places, only: film_state_t
   use friction_law, only: memory_none
   use point_contacts, only: of_eccentricity, of_force, of_friction_force, of_normal_force, of_penetration, of_penetration_rate, &
      of_state, point_report
   use readings, only: reading_t
   use revolute_level, only: of_drag_bearing, of_drag_journal, of_eccentricity_ratio, of_film_force, of_film_power, &
      of_film_pressure, of_film_thickness, of_film_torque, of_side_flow, of_temperature_rise
   use states_of_contacts, only: state_contact, state_film, state_free, state_mixed
   implicit none (type, external)

contains

   !> Values that are read.
   module procedure round_report
      if (readings%most <= of_eccentricity .and. .not. allocated(self%laws%films) .and. self%evaluated_at == motion%number &
          .and. motion%number > 0 .and. self%stick_slip%memory == memory_none) then
         associate (acts_apart => self%laws%normal%acts_apart, items => self%items, work => self%work)
            call report_evaluated(readings%n, readings%of, self%n, self%before%items, self%before%contacts, &
                                  self%n_touching > 0 .or. acts_apart, acts_apart, self%contact, self%journal, items%pairs, &
                                  items%body, items%s_i, items%s_j, work%contacts, work%f_n, work%f_t, &
                                  ubound(motion%angle, 1), motion%r, motion%rot, size(values), values)
         end associate
         return
      end if
      call point_report(self, readings, motion, values)
      if (allocated(self%laws%films)) call report_films(self, readings, motion, values)
   end procedure round_report

   !> Forces, states and eccentricities as the evaluation of this motion found them, on plain arrays. Of a contact that is free it
   !> measures nothing: its penetration follows from the eccentricity.
   pure subroutine report_evaluated(n_reading, reading, n, items_before, contacts_before, acts, acts_apart, memory, journal, &
                                    pairs, body, s_i, s_j, contacts, f_n, f_t, n_body, r, rot, n_value, values)
      integer, intent(in) :: n_reading                   !! channels that are read
      type(reading_t), intent(in) :: reading(n_reading)  !! (n_reading) the channels
      integer, intent(in) :: n                           !! number of joints, and of contacts
      integer, intent(in) :: items_before                !! joints with clearance before these
      integer, intent(in) :: contacts_before             !! contacts before these
      logical, intent(in) :: acts                        !! whether forces were found at all
      logical, intent(in) :: acts_apart                  !! whether those that are free act too
      type(contact_memory_t), intent(in) :: memory(n)    !! (n) states
      type(journal_t), intent(in) :: journal(n)          !! (n) where the surfaces are
      type(surfaces_t), intent(in) :: pairs(n)           !! (n) the surfaces
      integer, intent(in) :: body(2, n)                  !! (2, n) bodies of bearing and journal
      real(wp), intent(in) :: s_i(3, n)                  !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_j(3, n)                  !! (3, n) centre of the journal, frame of its body [m]
      type(point_contact_t), intent(in) :: contacts(n)   !! (n) kinematics of those that act
      real(wp), intent(in) :: f_n(n)                     !! (n) normal forces [N]
      real(wp), intent(in) :: f_t(n)                     !! (n) friction forces on j along t [N]
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      integer, intent(in) :: n_value                     !! values of the catalogue
      real(wp), intent(inout) :: values(n_value)         !! (n_value) they, those that are read are set [any]

      real(wp) :: e(2), friction, normal
      integer :: at, k, m

      do k = 1, n
         call find_eccentricity(body(:, k), s_i(:, k), s_j(:, k), n_body, r, rot, e)
         normal = 0.0_wp
         friction = 0.0_wp
         if (acts) then
            normal = f_n(k)
            friction = f_t(k)
         end if
         do m = 1, n_reading
            at = reading(m)%place + contacts_before + k
            select case (reading(m)%code)
            case (of_eccentricity)
               at = reading(m)%place + 2*(items_before + k - 1)
               values(at + 1) = e(1)
               values(at + 2) = e(2)
            case (of_force)
               at = reading(m)%place + 2*(items_before + k - 1)
               values(at + 1) = 0.0_wp
               values(at + 2) = 0.0_wp
               if (.not. (normal > 0.0_wp .or. abs(friction) > 0.0_wp)) cycle
               values(at + 1) = -normal*contacts(k)%normal(1) - friction*contacts(k)%normal(2)
               values(at + 2) = -normal*contacts(k)%normal(2) + friction*contacts(k)%normal(1)
            case (of_normal_force)
               values(at) = normal
            case (of_friction_force)
               values(at) = friction
            case default
               values(at) = course_of(reading(m)%code, memory(k)%is_touching, acts_apart, contacts(k), journal(k)%side, &
                                     pairs(k)%touch, e)
            end select
         end do
      end do
   end subroutine report_evaluated

   !> Penetration, its rate or the state of a contact.
   pure real(wp) function course_of(code, is_touching, acts_apart, contact, side, touch, e) result(value)
      integer, intent(in) :: code                      !! the channel
      logical, intent(in) :: is_touching               !! its state
      logical, intent(in) :: acts_apart                !! whether it was measured where it is free too
      type(point_contact_t), intent(in) :: contact     !! its kinematics, if it was measured
      real(wp), intent(in) :: side                     !! 1: in a hole; -1: beside a disc [1]
      real(wp), intent(in) :: touch                    !! distance of the centres where it starts [m]
      real(wp), intent(in) :: e(2)                     !! (2) eccentricity [m]

      select case (code)
      case (of_penetration)
         if (is_touching .or. acts_apart) then
            value = max(contact%delta, 0.0_wp)
         else
            value = max(side*sqrt(e(1)**2 + e(2)**2) - touch, 0.0_wp)
         end if
      case (of_penetration_rate)
         value = 0.0_wp
         if (is_touching) value = contact%rate
      case default  ! its state
         value = real(merge(state_contact, state_free, is_touching), wp)
      end select
   end function course_of

   !> Channels of films, and what they add to those of contacts.
   subroutine report_films(self, readings, motion, values)
      class(round_contacts_t), intent(in) :: self  !! the set, with films
      type(readings_t), intent(in) :: readings     !! channels that are read
      type(motion_t), intent(in) :: motion         !! positions and velocities
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      type(film_motion_t) :: film
      type(film_state_t) :: state
      integer :: at, k, m
      logical :: has_state

      do k = 1, self%n
         film = self%laws%films%motion_of(k, self%items%body(:, k), self%items%s_i(:, k), self%items%s_j(:, k), motion)
         has_state = .false.
         do m = 1, readings%n
            select case (readings%of(m)%code)
            case (of_force, of_state, of_film_force, of_film_torque, of_drag_journal:of_temperature_rise)
               if (.not. has_state) state = self%laws%films%state_of(k, self%items%body(:, k), film, motion)
               has_state = .true.
            end select
            if (readings%of(m)%code == of_state) then
               call add_film_state(state, values(readings%of(m)%place + self%before%contacts + k))
            else
               at = readings%of(m)%place + readings%of(m)%width*(self%before%items + k - 1)
               call report_film(self, readings%of(m)%code, k, film, state, values(at + 1:at + readings%of(m)%width))
            end if
         end do
      end do
   end subroutine report_films

   !> What a film makes of the state of a contact.
   pure subroutine add_film_state(state, value)
      type(film_state_t), intent(in) :: state   !! the film
      real(wp), intent(inout) :: value          !! the state [1]

      if (state%share > 0.0_wp) value = real(merge(state_mixed, state_film, nint(value) == state_contact), wp)
   end subroutine add_film_state

   !> A channel that films report, or add to.
   subroutine report_film(self, code, k, film, state, value)
      class(round_contacts_t), intent(in) :: self    !! the set
      integer, intent(in) :: code                    !! the channel
      integer, intent(in) :: k                       !! the item
      type(film_motion_t), intent(in) :: film        !! motion of its film
      type(film_state_t), intent(in) :: state        !! what the film does, where the channel needs it
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      select case (code)
      case (of_force); value(1:2) = value(1:2) + state%force
      case (of_film_force); value(1:2) = state%force
      case (of_film_torque); value(1) = state%torque
      case (of_film_pressure); value(1) = self%laws%films%max_pressure(k, film)
      case (of_eccentricity_ratio); value(1) = norm2(film%e)/self%items%pairs(k)%clearance
      case (of_film_thickness)
         value(1) = self%laws%films%law%min_thickness(self%items%pairs(k)%clearance, film, self%laws%films%parameters(:, k))
      case (of_drag_journal); value(1) = state%drag_journal
      case (of_drag_bearing); value(1) = state%drag_bearing
      case (of_film_power); value(1) = state%power
      case (of_side_flow); value(1) = state%side_flow
      case (of_temperature_rise); value(1) = state%rise
      end select
   end subroutine report_film

   !> The eccentricity.
   module procedure round_report_item
      if (code /= of_eccentricity) return
      call find_eccentricity(self%items%body(:, item), self%items%s_i(:, item), self%items%s_j(:, item), ubound(motion%angle, 1), &
                             motion%r, motion%rot, value)
   end procedure round_report_item

   !> The same on plain arrays.
   pure subroutine find_eccentricity(body, s_bearing, s_journal, n_body, r, rot, e)
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(3)               !! (3) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(3)               !! (3) centre of the journal, frame of its body [m]
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: e(2)                    !! (2) of the journal's centre, world frame [m]

      real(wp) :: s_i, s_j
      integer :: c

      do c = 1, 2
         s_i = rot(c, 1, body(1))*s_bearing(1) + rot(c, 2, body(1))*s_bearing(2)
         s_j = rot(c, 1, body(2))*s_journal(1) + rot(c, 2, body(2))*s_journal(2)
         e(c) = r(c, body(2)) + s_j - r(c, body(1)) - s_i
      end do
   end subroutine find_eccentricity

end submodule round_reports
