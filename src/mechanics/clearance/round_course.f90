!> How round contacts change with time: second derivatives of penetrations, and how normals turn.
submodule(round_contacts) round_course
   use worn_contacts, only: lever_growth, rate_of_rate, turning_of_worn
   implicit none (type, external)

contains

   !> Growth of a lever.
   module procedure round_lever_growth
      growth = 0.0_wp
      if (.not. allocated(self%items%pairs(k)%worn)) return
      growth = lever_growth(self%items%pairs(k), self%journal(k)%body, self%journal(k)%s_i, self%journal(k)%s_j, motion)
   end procedure round_lever_growth

   !> Rate of the rate of a penetration.
   module procedure round_penetration_acceleration
      associate (journal => self%journal(k))
         if (allocated(self%items%pairs(k)%worn)) then
            acceleration = rate_of_rate(self%items%pairs(k), journal%body, journal%s_i, journal%s_j, motion)
            return
         end if
         acceleration = acceleration_along(journal%body, journal%s_i, journal%s_j, journal%side, &
                                           journal%side*(contact%delta + self%items%pairs(k)%touch), &
                                           ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, motion%a, &
                                           motion%alpha, contact%normal, contact%rate)
      end associate
   end procedure round_penetration_acceleration

   !> The same on plain arrays.
   pure real(wp) function acceleration_along(body, s_bearing, s_journal, side, distance, n_body, r, rot, v, omega, a, alpha, &
                                             normal, rate) result(acceleration)
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)               !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)               !! (2) centre of the journal, frame of its body [m]
      real(wp), intent(in) :: side                       !! 1: in a hole; -1: beside a disc [1]
      real(wp), intent(in) :: distance                   !! of the centres [m]
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: a(3, 0:n_body)             !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)         !! (3, 0:bodies) angular accelerations [rad/s^2]
      real(wp), intent(in) :: normal(3)                  !! (3) normal of the contact [1]
      real(wp), intent(in) :: rate                       !! rate of the penetration [m/s]

      real(wp) :: e(2), e_ddot(2), e_dot(2), s_i(2), s_j(2)
      integer :: i, j

      include "eccentricity.inc"
      e_ddot(1) = a(1, j) - a(1, i) - alpha(3, j)*s_j(2) - omega(3, j)**2*s_j(1) + alpha(3, i)*s_i(2) + omega(3, i)**2*s_i(1)
      e_ddot(2) = a(2, j) - a(2, i) + alpha(3, j)*s_j(1) - omega(3, j)**2*s_j(2) - alpha(3, i)*s_i(1) + omega(3, i)**2*s_i(2)
      acceleration = normal(1)*e_ddot(1) + normal(2)*e_ddot(2) &
                     + (e_dot(1)**2 + e_dot(2)**2 - rate**2)/(side*max(distance, tiny(1.0_wp)))
   end function acceleration_along

   !> The normal turns with e' . t / |e|, and the point of contact goes along with it: of its velocity only the part along the
   !> normal counts, that of the centre P_k and the rate at which it comes nearer to it.
   module procedure round_turning
      real(wp) :: distance, longer, p_i(2), p_j(2), s_i(2), s_j(2)
      integer :: i, j

      if (allocated(self%items%pairs(k)%worn)) then
         call turning_of_worn(self%items%pairs(k), self%journal(k)%body, self%journal(k)%s_i, self%journal(k)%s_j, motion, turn, &
                              speed_i, speed_j)
         return
      end if
      i = self%items%body(1, k)
      j = self%items%body(2, k)
      call find_centres(self, k, motion, s_i, s_j, distance)
      longer = merge(0.0_wp, 0.5_wp*contact%rate, self%journal(k)%is_book)  ! rate of the distance from the bearing's centre
      p_i = motion%omega(3, i)*[-s_i(2), s_i(1)]  ! of the centres, from those of mass
      p_j = motion%omega(3, j)*[-s_j(2), s_j(1)]
      turn = dot_product(motion%v(1:2, j) + p_j - motion%v(1:2, i) - p_i, [-contact%normal(2), contact%normal(1)]) &
             /(self%journal(k)%side*max(distance, tiny(1.0_wp)))
      speed_i = dot_product(contact%normal(1:2), p_i) + longer
      speed_j = dot_product(contact%normal(1:2), p_j) - longer
   end procedure round_turning

   !> Centres of bearing and journal, from the centres of mass of their bodies, and how far they are apart.
   pure subroutine find_centres(self, k, motion, s_i, s_j, distance)
      class(round_contacts_t), intent(in) :: self      !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions
      real(wp), intent(out) :: s_i(2)                  !! (2) centre of the bearing, world frame [m]
      real(wp), intent(out) :: s_j(2)                  !! (2) centre of the journal, world frame [m]
      real(wp), intent(out) :: distance                !! of the centres [m]

      real(wp) :: e(2)
      integer :: i, j

      i = self%items%body(1, k)
      j = self%items%body(2, k)
      s_i = motion%rot(1:2, 1, i)*self%items%s_i(1, k) + motion%rot(1:2, 2, i)*self%items%s_i(2, k)
      s_j = motion%rot(1:2, 1, j)*self%items%s_j(1, k) + motion%rot(1:2, 2, j)*self%items%s_j(2, k)
      e = motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i
      distance = sqrt(e(1)**2 + e(2)**2)
   end subroutine find_centres

end submodule round_course
