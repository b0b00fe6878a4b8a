!> How contacts in space slide: the sliding velocity, two tangents and what of their rates does not depend on accelerations.
!>
!> t_1 along the way of the contact, t_2 = m x t_1, m the unit normal; v_a = t_a . v, v the velocity of the material points of j
!> against those of i at C, and v_a' = t_a . (what accelerations give) + t_a' . v + t_a . (omega_j x s_j' - omega_i x s_i'), for the
!> normal turns, and C moves through the bodies.
!>
!> Signs, n and C: see `point_contact`; what is asked for: see `contact_stick_slip`. Source: from the definition. Limits: none.
module space_tangents
   use contact_stick_slip, only: tangent_t
   use kinds, only: wp
   use motion, only: motion_t
   use point_contact, only: point_contact_t
   implicit none (type, external)
   private
   public :: lie_in_space, set_sliding, spatial_force

contains

   include "../../foundation/numerics/across.inc"

   !> Force of a contact on body j.
   pure function spatial_force(contact, f_n, f_t) result(f)
      type(point_contact_t), intent(in) :: contact  !! its kinematics
      real(wp), intent(in) :: f_n                   !! normal force [N]
      real(wp), intent(in) :: f_t                   !! friction force on j along t [N]
      real(wp) :: f(3)                              !! (3) world frame [N]

      f = -f_n*contact%normal + f_t*contact%tangent
   end function spatial_force

   !> Sliding velocity of a contact at its arms, and its direction; normals may have any length, none where there is no contact.
   pure subroutine set_sliding(motion, i, j, contact)
      type(motion_t), intent(in) :: motion             !! positions and velocities
      integer, intent(in) :: i                         !! body i
      integer, intent(in) :: j                         !! body j
      type(point_contact_t), intent(inout) :: contact  !! normal and arms; sliding velocities and t are set

      real(wp) :: slip(3), speed, square

      square = dot_product(contact%normal, contact%normal)
      slip = motion%v(:, j) + across(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - across(motion%omega(:, i), contact%arm_i)
      speed = 0.0_wp
      if (square > 0.0_wp) then
         slip = slip - dot_product(slip, contact%normal)/square*contact%normal
         speed = norm2(slip)
      end if
      contact%v_t = speed
      contact%v_t_work = speed
      contact%tangent = 0.0_wp
      if (speed > 0.0_wp) contact%tangent = slip/speed
   end subroutine set_sliding

   !> How a contact lies.
   pure subroutine lie_in_space(motion, i, j, contact, m, m_rate, arm_rate, tangent)
      type(motion_t), intent(in) :: motion           !! positions and velocities
      integer, intent(in) :: i                       !! body i
      integer, intent(in) :: j                       !! body j
      type(point_contact_t), intent(in) :: contact   !! its kinematics, sliding among them
      real(wp), intent(in) :: m(3)                   !! (3) unit normal, world frame [1]
      real(wp), intent(in) :: m_rate(3)              !! (3) its rate [1/s]
      real(wp), intent(in) :: arm_rate(3)            !! (3) rate of C from the centre of mass of j, world frame [m/s]
      type(tangent_t), intent(inout) :: tangent      !! how it lies; its forces and its way are left alone

      real(wp) :: span_rate(3), t_rate(3, 2), v(3)
      integer :: a

      span_rate = motion%v(:, j) - motion%v(:, i) + arm_rate
      tangent%arm_i = contact%arm_i
      tangent%arm_j = contact%arm_j
      v = motion%v(:, j) + across(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - across(motion%omega(:, i), contact%arm_i)
      call find_tangents(tangent%slip_direction, contact%tangent, m, m_rate, tangent%t, t_rate)
      do a = 1, 2
         tangent%v(a) = dot_product(tangent%t(:, a), v)
         tangent%drift(a) = dot_product(t_rate(:, a), v) + dot_product(tangent%t(:, a), across(motion%omega(:, j), arm_rate) &
                                                                       - across(motion%omega(:, i), span_rate))
      end do
      tangent%spin = across(m, m_rate) + 0.5_wp*dot_product(m, motion%omega(:, i) + motion%omega(:, j))*m
   end subroutine lie_in_space

   !> Two tangents of a plane and their rates: the first along a fixed direction; without one along the sliding velocity, or any.
   !> The direction of a sliding velocity that is round-off may be that of the normal.
   pure subroutine find_tangents(way, sliding, m, m_rate, t, t_rate)
      real(wp), intent(in) :: way(3)          !! (3) the direction, world frame; zero: none yet [1]
      real(wp), intent(in) :: sliding(3)      !! (3) direction of sliding, zero of none; world frame [1]
      real(wp), intent(in) :: m(3)            !! (3) unit normal, world frame [1]
      real(wp), intent(in) :: m_rate(3)       !! (3) its rate [1/s]
      real(wp), intent(out) :: t(3, 2)        !! (3, 2) tangents, world frame [1]
      real(wp), intent(out) :: t_rate(3, 2)   !! (3, 2) their rates [1/s]

      real(wp), parameter :: minimum = 1.0e-3_wp  ! part of a direction in the plane that is enough [1]
      real(wp) :: along(3), b(3), b_rate(3), length

      along = way
      b = along - dot_product(along, m)*m
      if (norm2(b) < minimum) then
         along = sliding
         b = along - dot_product(along, m)*m
      end if
      if (norm2(b) < minimum) then
         along = 0.0_wp
         along(minloc(abs(m), dim=1)) = 1.0_wp
         b = along - dot_product(along, m)*m
      end if
      length = norm2(b)
      b_rate = -dot_product(along, m_rate)*m - dot_product(along, m)*m_rate
      t(:, 1) = b/length
      t_rate(:, 1) = (b_rate - dot_product(t(:, 1), b_rate)*t(:, 1))/length
      t(:, 2) = across(m, t(:, 1))
      t_rate(:, 2) = across(m_rate, t(:, 1)) + across(m, t_rate(:, 1))
   end subroutine find_tangents

end module space_tangents
