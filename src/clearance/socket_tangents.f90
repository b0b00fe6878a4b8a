!> How balls in sockets and pins in bushings slide: tangents of a contact, and how they turn.
!>
!> m = n/|n|,  t_1 along the way of the contact, t_2 = m x t_1,  v_a = t_a . v,  v_a' = t_a . (what accelerations give) + drift_a
!>
!> Signs, n and C: see `socket_contacts`; what is asked for: see `contact_grip`. Limits: those of both.
submodule(socket_contacts) socket_tangents
   implicit none (type, external)

contains

   !> How a contact lies: two tangents, of which the first is along its way; sliding velocities of the material points at C, and
   !> what of their rates does not depend on accelerations, t' . v + t . (omega_j x s_j' - omega_i x s_i'), for the normal turns,
   !> and C moves through the bodies.
   module procedure socket_lie
      type(point_contact_t) :: contact
      real(wp) :: arm_rate(3), m(3), m_rate(3), span_rate(3), t_rate(3, 2), v(3)
      integer :: a, i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      call measure_one(self, k, .true., motion, contact)
      call turning_of(self, k, motion, contact, m, m_rate, arm_rate)
      span_rate = motion%v(:, j) - motion%v(:, i) + arm_rate
      tangent%arm_i = contact%arm_i
      tangent%arm_j = contact%arm_j
      v = motion%v(:, j) + cross(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - cross(motion%omega(:, i), contact%arm_i)
      call find_tangents(tangent%way, contact%tangent, m, m_rate, tangent%t, t_rate)
      do a = 1, 2
         tangent%v(a) = dot_product(tangent%t(:, a), v)
         tangent%drift(a) = dot_product(t_rate(:, a), v) + dot_product(tangent%t(:, a), cross(motion%omega(:, j), arm_rate) &
                                                                       - cross(motion%omega(:, i), span_rate))
      end do
      tangent%spin = cross(m, m_rate) + 0.5_wp*dot_product(m, motion%omega(:, i) + motion%omega(:, j))*m
   end procedure socket_lie

   !> Two tangents of a plane and their rates: the first along a fixed direction; without one along the sliding velocity, or any.
   pure subroutine find_tangents(way, sliding, m, m_rate, t, t_rate)
      real(wp), intent(in) :: way(3)          !! (3) the direction, world frame; zero: none yet [1]
      real(wp), intent(in) :: sliding(3)      !! (3) direction of sliding, zero of none; world frame [1]
      real(wp), intent(in) :: m(3)            !! (3) unit normal, world frame [1]
      real(wp), intent(in) :: m_rate(3)       !! (3) its rate [1/s]
      real(wp), intent(out) :: t(3, 2)        !! (3, 2) tangents, world frame [1]
      real(wp), intent(out) :: t_rate(3, 2)   !! (3, 2) their rates [1/s]

      real(wp), parameter :: least = 1.0e-3_wp  ! part of a direction in the plane that is enough [1]
      real(wp) :: along(3), b(3), b_rate(3), length

      along = way
      b = along - dot_product(along, m)*m
      if (norm2(b) < least) then
         along = sliding
         if (.not. any(abs(along) > 0.0_wp)) then
            along = 0.0_wp
            along(minloc(abs(m), dim=1)) = 1.0_wp
         end if
         b = along - dot_product(along, m)*m
      end if
      length = norm2(b)
      b_rate = -dot_product(along, m_rate)*m - dot_product(along, m)*m_rate
      t(:, 1) = b/length
      t_rate(:, 1) = (b_rate - dot_product(t(:, 1), b_rate)*t(:, 1))/length
      t(:, 2) = cross(m, t(:, 1))
      t_rate(:, 2) = cross(m_rate, t(:, 1)) + cross(m, t_rate(:, 1))
   end subroutine find_tangents

   !> The unit normal of a contact, how it turns, and how C moves.
   pure subroutine turning_of(self, k, motion, contact, m, m_rate, arm_rate)
      class(socket_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(point_contact_t), intent(in) :: contact   !! its kinematics
      real(wp), intent(out) :: m(3)                  !! (3) unit normal, world frame [1]
      real(wp), intent(out) :: m_rate(3)             !! (3) its rate [1/s]
      real(wp), intent(out) :: arm_rate(3)           !! (3) rate of C from the centre of mass of j, world frame [m/s]

      type(station_t) :: at
      real(wp) :: glide, length, n(3), n_rate(3), p_rate(3), pin_part, q, q_rate, u_part, w(3)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      at = station_of(self%socket(item), k - (item - 1)*self%n_contact_item, self%items%s_i(:, item), self%items%s_j(:, item), &
                      i, j, motion)
      length = max(norm2(at%e), tiny(1.0_wp))
      n = direction_of(at, norm2(at%e))
      w = at%w
      glide = 0.0_wp
      if (any(abs(at%pin) > 0.0_wp)) then
         glide = -dot_product(at%u, at%w)/dot_product(at%u, at%pin)
         w = at%w + glide*at%pin
      end if
      w = w - dot_product(w, at%u)*at%u
      n_rate = (w - dot_product(n, w)*n)/length  ! as body i sees it
      if (any(abs(at%pin) > 0.0_wp)) then
         ! the direction of the force is n - q u at an end of the bushing
         u_part = dot_product(at%u, at%pin)
         pin_part = dot_product(n, at%pin)
         p_rate = cross(motion%omega(:, j) - motion%omega(:, i), at%pin)
         q = pin_part/u_part
         q_rate = (dot_product(n_rate, at%pin) + dot_product(n, p_rate) - q*dot_product(at%u, p_rate))/u_part
         n = n - q*at%u
         n_rate = n_rate - q_rate*at%u
      end if
      n_rate = n_rate + cross(motion%omega(:, i), n)
      associate (reach => self%socket(item)%radius_j - 0.5_wp*contact%delta)
         arm_rate = cross(motion%omega(:, j), at%arm_j) + glide*at%pin + reach*n_rate - 0.5_wp*contact%rate*n
      end associate
      length = norm2(n)
      m = n/length
      m_rate = (n_rate - dot_product(m, n_rate)*m)/length
   end subroutine turning_of

end submodule socket_tangents
