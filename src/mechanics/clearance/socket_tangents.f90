!> How balls in sockets and pins in bushings slide: how the normal of a contact turns, and how C moves.
!>
!> Signs, n and C: see `socket_contacts`; tangents: see `space_tangents`. Limits: those of both.
submodule(socket_contacts) socket_tangents
   use space_tangents, only: lie_in_space
   implicit none (type, external)

contains

   !> How a contact lies.
   module procedure socket_lie
      type(point_contact_t) :: contact
      real(wp) :: arm_rate(3), m(3), m_rate(3)
      integer :: item

      item = self%item_of(k)
      call measure_one(self, k, .true., motion, contact)
      call turning_of(self, k, motion, contact, m, m_rate, arm_rate)
      call lie_in_space(motion, self%items%body(1, item), self%items%body(2, item), contact, m, m_rate, arm_rate, tangent)
   end procedure socket_lie

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
      at = station_of(self%socket(item), self%items%pairs(item), k - (item - 1)*self%n_contact_item, self%items%s_i(:, item), &
                      self%items%s_j(:, item), i, j, motion)
      length = max(norm2(at%e), tiny(1.0_wp))
      n = self%socket(item)%side*direction_of(at, norm2(at%e))
      w = at%w
      glide = 0.0_wp
      if (any(abs(at%pin) > 0.0_wp)) then
         glide = -dot_product(at%u, at%w)/dot_product(at%u, at%pin)
         w = at%w + glide*at%pin
      end if
      w = w - dot_product(w, at%u)*at%u
      n_rate = self%socket(item)%side*(w - dot_product(n, w)*n)/length  ! as body i sees it
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
      associate (reach => self%items%pairs(item)%radius_j - 0.5_wp*contact%delta)
         arm_rate = cross(motion%omega(:, j), at%arm_j) + glide*at%pin + reach*n_rate - 0.5_wp*contact%rate*n
      end associate
      length = norm2(n)
      m = n/length
      m_rate = (n_rate - dot_product(m, n_rate)*m)/length
   end subroutine turning_of

end submodule socket_tangents
