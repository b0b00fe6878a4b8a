!> Planar: what contacts in the plane share, whatever their geometry: tangent, sliding velocity, force. Loads: `planar_loads.inc`.
!>
!> t = R90 n;  v_T = t . (v_j - v_i), velocities of the material points at C
!> v_T' = t . (a_j + alpha_j R90 s_j - a_i - alpha_i R90 s_i) + drift, with the arms s of C:
!> drift = -turn delta' + omega_j n . s_j' - omega_i n . s_i',  turn the rate of the normal's angle.
!>
!> Signs: forces are those on body j. Source: see `contact_stick_slip`. Limits: numbers along z are neither read nor written.
module planar_contacts
   use contact_stick_slip, only: tangent_t
   use kinds, only: wp
   use point_contact, only: point_contact_t
   implicit none (type, external)
   private
   public :: lie_in_plane, planar_force, planar_sliding

contains

   !> Force of a contact on body j.
   pure function planar_force(contact, f_n, f_t) result(f)
      type(point_contact_t), intent(in) :: contact  !! its kinematics
      real(wp), intent(in) :: f_n                   !! normal force [N]
      real(wp), intent(in) :: f_t                   !! friction force on j along t [N]
      real(wp) :: f(3)                              !! (3) world frame [N]

      f(1) = -f_n*contact%normal(1) - f_t*contact%normal(2)
      f(2) = -f_n*contact%normal(2) + f_t*contact%normal(1)
      f(3) = 0.0_wp
   end function planar_force

   !> Sliding velocity of the material points at the arms of a contact, of j relative to i along t.
   pure real(wp) function planar_sliding(contact, v_i, omega_i, v_j, omega_j) result(v_t)
      type(point_contact_t), intent(in) :: contact  !! normal and arms
      real(wp), intent(in) :: v_i(3)                !! (3) velocity of the centre of mass of body i [m/s]
      real(wp), intent(in) :: omega_i               !! its angular velocity [rad/s]
      real(wp), intent(in) :: v_j(3)                !! (3) velocity of the centre of mass of body j [m/s]
      real(wp), intent(in) :: omega_j               !! its angular velocity [rad/s]

      real(wp) :: at_i(2), at_j(2), tangent(2)

      tangent = [-contact%normal(2), contact%normal(1)]
      at_i = v_i(1:2) + omega_i*[-contact%arm_i(2), contact%arm_i(1)]
      at_j = v_j(1:2) + omega_j*[-contact%arm_j(2), contact%arm_j(1)]
      v_t = dot_product(at_j - at_i, tangent)
   end function planar_sliding

   !> How a contact lies: tangent, arms, sliding velocity, and the part of its rate that does not depend on accelerations, for the
   !> normal turns, and the points of contact move through the bodies.
   pure subroutine lie_in_plane(contact, omega_i, omega_j, turn, speed_i, speed_j, tangent)
      type(point_contact_t), intent(in) :: contact  !! its kinematics
      real(wp), intent(in) :: omega_i               !! angular velocity of body i [rad/s]
      real(wp), intent(in) :: omega_j               !! angular velocity of body j [rad/s]
      real(wp), intent(in) :: turn                  !! rate of the normal's angle [rad/s]
      real(wp), intent(in) :: speed_i               !! n . s_i', speed of the point of contact from the centre of mass of i [m/s]
      real(wp), intent(in) :: speed_j               !! n . s_j', the same of j [m/s]
      type(tangent_t), intent(inout) :: tangent     !! how it lies; its forces are left alone

      tangent%t(1:2, 1) = [-contact%normal(2), contact%normal(1)]
      tangent%arm_i(1:2) = contact%arm_i(1:2)
      tangent%arm_j(1:2) = contact%arm_j(1:2)
      tangent%v(1) = contact%v_t_work
      tangent%drift(1) = -turn*contact%rate + omega_j*speed_j - omega_i*speed_i
   end subroutine lie_in_plane

end module planar_contacts
