!> What a contact does to its surfaces at a motion, for their wear.
module wear_contact
   use kinds, only: wp
   use overlap_sums, only: arc_t
   use wear_law, only: n_side
   implicit none (type, external)
   private
   public :: wear_contact_t

   !> A contact that wears its surfaces. Directions are those of the normal into the bearing, in the frames of the bodies.
   type :: wear_contact_t
      real(wp) :: force = 0.0_wp                 !! normal force; 0: it does not act [N]
      real(wp) :: power = 0.0_wp                 !! rate of the driving work, see `wear_law` [W]
      real(wp) :: speed = 0.0_wp                 !! magnitude of the sliding velocity [m/s]
      real(wp) :: direction(n_side) = 0.0_wp     !! (2) direction of the middle of the arc on each surface [rad]
      real(wp) :: turn(n_side) = 0.0_wp          !! (2) rates of these directions [rad/s]
      real(wp) :: half_angle(n_side) = 0.0_wp    !! (2) half angles of the arc of round surfaces, from their centres [rad]
      real(wp) :: place(2) = 0.0_wp              !! (2) centre of the pin from that of the hole, frame of the hole's body [m]
      real(wp) :: turned = 0.0_wp                !! angle of the pin's body less that of the hole's [rad]
      real(wp) :: exponent = 0.0_wp              !! d ln F/d ln delta of the normal law there [1]
      logical :: is_worn = .false.               !! the surfaces have profiles: `arc` has the arc
      type(arc_t) :: arc                         !! points of the arc of worn surfaces
   end type wear_contact_t

end module wear_contact
