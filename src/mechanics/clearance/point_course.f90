!> What the course of a motion asks of contacts at points: gaps, forces and their rates, energy. What an evaluation at the same
!> motion found is not found again.
submodule(point_contacts) point_course
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use normal_law, only: n_law_parameter, normal_law_t
   implicit none (type, external)

contains

   include "press.inc"

   !> Penetration and its rate for all contacts.
   module procedure point_gaps
      integer :: k

      do k = 1, self%n_contact
         call find_depth(self, k, motion, delta(self%before%contacts + k), rate(self%before%contacts + k))
      end do
   end procedure point_gaps

   !> Penetration of a contact and its rate.
   subroutine find_depth(self, k, motion, delta, rate)
      class(point_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions and velocities
      real(wp), intent(out) :: delta               !! penetration [m]
      real(wp), intent(out) :: rate                !! its rate [m/s]

      type(point_contact_t) :: contact

      if (has_forces(self, k, motion)) then
         delta = self%work%contacts(k)%delta
         rate = self%work%contacts(k)%rate
      else
         call self%measure(k, .false., motion, contact)
         delta = contact%delta
         rate = contact%rate
      end if
   end subroutine find_depth

   !> Whether the last evaluation, which was at this motion, measured a contact and found its forces. It is of the contact as it is.
   pure logical function has_forces(self, k, motion)
      class(point_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions and velocities

      has_forces = self%evaluated_at == motion%number .and. motion%number > 0
      if (has_forces) has_forces = self%contact(k)%is_touching .or. self%laws%normal%acts_apart
   end function has_forces

   !> Normal force of a touching contact and its rate, F' = dF/ddelta delta' + dF/drate delta'', of worn surfaces also
   !> F lambda'/lambda.
   module procedure point_monitor
      type(point_contact_t) :: contact
      real(wp), dimension(1) :: d, d_rate, elastic, f, impact_speed, slope_delta, slope_rate

      if (has_forces(self, k, motion) .and. .not. self%traits%has_faces) then
         delta = self%work%contacts(k)%delta
         rate = self%work%contacts(k)%rate
         force = self%work%f_n(k)
         force_rate = self%work%slope_delta(k)*rate &
                      + self%work%slope_rate(k)*self%penetration_acceleration(k, motion, self%work%contacts(k))
         if (self%traits%is_worn) force_rate = force_rate + force*self%lever_growth(k, motion)
         return
      end if
      call self%measure(k, .false., motion, contact)
      delta = contact%delta
      rate = contact%rate
      force = 0.0_wp
      force_rate = 0.0_wp
      if (.not. (self%contact(k)%is_touching .or. self%laws%normal%acts_apart)) return
      call press(1, self%laws%normal, self%contact(k:k), self%laws%parameters(:, k:k), [contact], d, d_rate, impact_speed, f, &
                 slope_delta, &
                 slope_rate, elastic)
      force = f(1)
      force_rate = slope_delta(1)*rate + slope_rate(1)*self%penetration_acceleration(k, motion, contact)
      if (self%traits%is_worn) force_rate = force_rate + force*self%lever_growth(k, motion)
   end procedure point_monitor

   !> Elastic energy that the touching contacts store.
   module procedure point_elastic_energy
      real(wp) :: delta, rate
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n_contact
         if (.not. (self%contact(k)%is_touching .or. self%laws%normal%acts_apart)) cycle
         call find_depth(self, k, motion, delta, rate)
         energy = energy + self%laws%normal%potential(delta, self%laws%parameters(:, k))
      end do
   end procedure point_elastic_energy

end submodule point_course
