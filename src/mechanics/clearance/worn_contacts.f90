!> Planar: a journal of body j in a bearing of body i, one of which is worn, or both: what contacts measure of their overlap.
!>
!> delta, its gradient g by e and its derivatives by the angles of the bodies are those of `surface_overlap`;  lambda = |g|
!> n = g/lambda,  rate = delta'/lambda,  C = P_j + (r - h - delta/2) n + s t,  s = -(d delta/d alpha_j)/lambda
!> rate' = (delta'' - lambda' rate)/lambda,  lambda' = g . g'/lambda,  turn = n x g'/lambda
!>
!> Signs and frames: see `round_contacts`. Source: this program. Limits: those of `surface_overlap`; one contact for all places at
!> which the surfaces meet.
module worn_contacts
   use kinds, only: wp
   use motion, only: motion_t
   use overlap_rays, only: pin_t
   use overlap_sums, only: arc_t, to_gradient, to_rates, to_second
   use planar_contacts, only: planar_sliding
   use point_contact, only: point_contact_t
   use surface_overlap, only: find_overlap, overlap_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: lever_growth, measure_worn, rate_of_rate, turning_of_worn, worn_arc

contains

   !> Normal, penetration, rate, lever, arms and sliding velocity of a contact.
   pure subroutine measure_worn(pair, body, s_bearing, s_journal, motion, contact)
      type(surfaces_t), intent(in) :: pair               !! the surfaces
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)               !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)               !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      type(point_contact_t), intent(inout) :: contact    !! its kinematics

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      real(wp) :: along, s_i(2), s_j(2), shift

      call find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      call find_overlap(pair, pin, to_gradient, overlap)
      associate (g => overlap%gradient)
         contact%lever = sqrt(g(1)**2 + g(2)**2)
         contact%normal(1:2) = g/contact%lever
         contact%delta = overlap%delta
         contact%rate = (dot_product(g, pin%e_dot) + overlap%by_i*pin%omega(1) + overlap%by_j*pin%omega(2))/contact%lever
         shift = -overlap%by_j/contact%lever
      end associate
      along = pair%radius_j - overlap%depth - 0.5_wp*overlap%delta
      contact%arm_j(1) = s_j(1) + along*contact%normal(1) - shift*contact%normal(2)
      contact%arm_j(2) = s_j(2) + along*contact%normal(2) + shift*contact%normal(1)
      contact%arm_i(1:2) = s_i + pin%e + (contact%arm_j(1:2) - s_j)
      contact%v_t_work = planar_sliding(contact, motion%v(:, body(1)), pin%omega(1), motion%v(:, body(2)), pin%omega(2))
      contact%v_t = contact%v_t_work
   end subroutine measure_worn

   !> Rate of the rate.
   pure real(wp) function rate_of_rate(pair, body, s_bearing, s_journal, motion) result(acceleration)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      integer, intent(in) :: body(2)           !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)     !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)     !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion     !! positions, velocities and accelerations

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      real(wp) :: lever, s_i(2), s_j(2)

      call find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      associate (i => body(1), j => body(2))
         pin%alpha = [motion%alpha(3, i), motion%alpha(3, j)]
         pin%e_ddot(1) = motion%a(1, j) - motion%a(1, i) - pin%alpha(2)*s_j(2) - pin%omega(2)**2*s_j(1) &
                         + pin%alpha(1)*s_i(2) + pin%omega(1)**2*s_i(1)
         pin%e_ddot(2) = motion%a(2, j) - motion%a(2, i) + pin%alpha(2)*s_j(1) - pin%omega(2)**2*s_j(2) &
                         - pin%alpha(1)*s_i(1) + pin%omega(1)**2*s_i(2)
      end associate
      call find_overlap(pair, pin, to_second, overlap)
      lever = norm2(overlap%gradient)
      acceleration = (overlap%second - growth_of(overlap)*overlap%rate)/lever
   end function rate_of_rate

   !> Growth of the lever, lambda'/lambda.
   pure real(wp) function lever_growth(pair, body, s_bearing, s_journal, motion) result(growth)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      integer, intent(in) :: body(2)           !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)     !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)     !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion     !! positions and velocities

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      real(wp) :: s_i(2), s_j(2)

      call find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      call find_overlap(pair, pin, to_rates, overlap)
      growth = growth_of(overlap)
   end function lever_growth

   !> lambda'/lambda of an overlap.
   pure real(wp) function growth_of(overlap) result(growth)
      type(overlap_t), intent(in) :: overlap   !! with rates

      growth = dot_product(overlap%gradient, overlap%gradient_rate)/dot_product(overlap%gradient, overlap%gradient)
   end function growth_of

   !> How the normal turns, and how fast the point of contact goes along it from the centres of mass.
   pure subroutine turning_of_worn(pair, body, s_bearing, s_journal, motion, turn, speed_i, speed_j)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      integer, intent(in) :: body(2)           !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)     !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)     !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      real(wp), intent(out) :: turn            !! rate at which the normal turns towards t [rad/s]
      real(wp), intent(out) :: speed_i         !! n . s_i' [m/s]
      real(wp), intent(out) :: speed_j         !! n . s_j' [m/s]

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      real(wp) :: lever, n(2), s_i(2), s_j(2), shift

      call find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      call find_overlap(pair, pin, to_rates, overlap)
      lever = norm2(overlap%gradient)
      n = overlap%gradient/lever
      turn = (n(1)*overlap%gradient_rate(2) - n(2)*overlap%gradient_rate(1))/lever
      shift = -overlap%by_j/lever
      speed_j = pin%omega(2)*(n(2)*s_j(1) - n(1)*s_j(2)) - overlap%depth_rate - 0.5_wp*overlap%rate - shift*turn
      speed_i = pin%omega(1)*(n(2)*s_i(1) - n(1)*s_i(2)) + dot_product(n, pin%e_dot) - overlap%depth_rate &
                - 0.5_wp*overlap%rate - shift*turn
   end subroutine turning_of_worn

   !> Where the surfaces overlap.
   pure subroutine worn_arc(pair, body, s_bearing, s_journal, motion, arc)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      integer, intent(in) :: body(2)           !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)     !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)     !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(arc_t), intent(inout) :: arc        !! its points

      type(overlap_t) :: overlap
      type(pin_t) :: pin
      real(wp) :: s_i(2), s_j(2)

      call find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      call find_overlap(pair, pin, to_gradient, overlap, arc)
   end subroutine worn_arc

   !> Where the pin is in its hole, and how fast it moves there.
   pure subroutine find_pin(body, s_bearing, s_journal, motion, pin, s_i, s_j)
      integer, intent(in) :: body(2)           !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)     !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)     !! (2) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(pin_t), intent(out) :: pin          !! set, but for accelerations
      real(wp), intent(out) :: s_i(2)          !! (2) centre of the bearing from the centre of mass, world frame [m]
      real(wp), intent(out) :: s_j(2)          !! (2) that of the journal [m]

      real(wp) :: e(2), e_dot(2)
      integer :: i, j

      associate (r => motion%r, rot => motion%rot, v => motion%v, omega => motion%omega)
         include "eccentricity.inc"
      end associate
      pin%e = e
      pin%e_dot = e_dot
      pin%angle = [motion%angle(i), motion%angle(j)]
      pin%omega = [motion%omega(3, i), motion%omega(3, j)]
      pin%distance = sqrt(e(1)**2 + e(2)**2)
      if (pin%distance > tiny(1.0_wp)) then
         pin%phi = atan2(e(2), e(1))
      else if (any(abs(e_dot) > tiny(1.0_wp))) then
         pin%phi = atan2(e_dot(2), e_dot(1))
      end if
   end subroutine find_pin

end module worn_contacts
