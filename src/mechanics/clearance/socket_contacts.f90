!> A ball of body j in a socket of body i or beside a ball of it, or a pin with round bases in a bushing, in space.
!>
!> With rho = r_j^P - r_i^P the place of a ball, or of a base of the pin, as body i sees it, and u the bushing's axis:
!>
!> ball   e = rho                  base   e = rho - (rho . u) u,   zeta = rho . u
!> n = e/|e|,   delta = |e| - c,   rate = n . w,   w = rho' - omega_i x rho  (the velocity that body i sees)
!> delta'' = n . a + (|w_e|^2 - rate^2)/|e|,   a = rho'' - alpha_i x rho - omega_i x (omega_i x rho) - 2 omega_i x w
!>
!> with w_e the part of w that changes e. A pin that reaches beyond an end of the bushing touches it there: its station on the
!> pin's axis u_j is then the one with zeta at the end, which moves along the pin with -(w . u)/(u_j . u). So that the force does
!> the work that it stores, its direction is n - (n . u_j)/(u . u_j) u there, across the pin.
!>
!> C = r_j^P + (R_j - delta/2) n is the point of both bodies where the forces act, half way between the two surfaces, which are
!> R_j n and (R_j - delta) n away; of a pin r_j^P is the base or the station, and n the direction of the force:
!> f_j = -F_N n + F_T t. t is the direction of sliding, v_T = v - (v . n) n with v the velocity of the material points of j
!> against those of i at C.
!> With e = 0 the normal is taken along w. Beside a ball |e|, n, c and the ball's radius have the other sign, and all of this holds
!> as it stands.
!>
!> Source: Flores et al. (2008), sections 6.2 and 6.3, corrected: velocities are those of material points, (6.22), (6.23), (6.62),
!> (6.63); the normal is one of the world, (6.66); moments are turned to the bodies' axes, (6.29), (6.69); both forces act
!> at one point.
!> Limits: what the rim of a tilted base adds to the penetration, R_j (1 - cos of the tilt), is omitted, and so is any contact
!> of the pin's end faces; a pin that has left the bushing altogether touches nothing, see `engagement`.
module socket_contacts
   use contact_stick_slip, only: tangent_t
   use kinds, only: wp
   use motion, only: cross, motion_t
   use point_contact, only: point_contact_t
   use point_contacts, only: of_axial_displacement, of_eccentricity, of_moment, of_tilt
   use space_tangents, only: set_sliding
   use spatial_contacts, only: spatial_contacts_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: direction_of, measure_one, station_of  ! for its submodule
   public :: of_engagement, socket_contacts_t, socket_t

   integer, parameter :: of_engagement = 43          !! channel: length of the pin in the bushing

   !> Where the surfaces of one joint are.
   type :: socket_t
      real(wp) :: side = 1.0_wp                   !! 1: j is in a hole; -1: beside a ball, distance and normal reversed [1]
      logical :: has_axis = .false.               !! a bushing, not a socket
      logical :: has_ends = .false.               !! whose ends count
      real(wp) :: axis_i(3) = 0.0_wp              !! (3) unit axis of the bushing, frame of body i [1]
      real(wp) :: axis_j(3) = 0.0_wp              !! (3) unit axis of the pin, frame of body j [1]
      real(wp) :: across(3) = 0.0_wp              !! (3) unit vector across the first, where angles are zero, frame of body i [1]
   end type socket_t

   !> Where a ball or base is, and how it moves, as body i sees it; world frame.
   type :: station_t
      real(wp) :: arm_j(3) = 0.0_wp    !! (3) the station from the centre of mass of j [m]
      real(wp) :: rho(3) = 0.0_wp      !! (3) the station from the point of i [m]
      real(wp) :: w(3) = 0.0_wp        !! (3) velocity of the material point there, as body i sees it [m/s]
      real(wp) :: u(3) = 0.0_wp        !! (3) axis of the bushing, zero: a ball [1]
      real(wp) :: pin(3) = 0.0_wp      !! (3) axis of the pin, zero where the station is fixed in it [1]
      real(wp) :: e(3) = 0.0_wp        !! (3) eccentricity [m]
      logical :: is_there = .true.     !! false: the pin has left the bushing
   end type station_t

   !> Balls in sockets or pins in bushings. `prepare` of a geometry says where they are.
   type, abstract, extends(spatial_contacts_t) :: socket_contacts_t
      type(socket_t), allocatable :: socket(:)         !! (n) where the surfaces are
   contains
      procedure :: measure_acting => socket_measure_acting
      procedure :: measure => socket_measure
      procedure :: penetration_acceleration => socket_penetration_acceleration
      procedure :: lie => socket_lie
      procedure :: report_item => socket_report_item
   end type socket_contacts_t

   interface
      !> How a contact lies: see `socket_tangents`.
      module subroutine socket_lie(self, k, motion, tangent)
         implicit none (type, external)
         class(socket_contacts_t), intent(in) :: self   !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions and velocities
         type(tangent_t), intent(inout) :: tangent      !! how it lies; its forces and its way are left alone
      end subroutine socket_lie
   end interface

contains

   include "../../foundation/numerics/across.inc"
   include "../../foundation/numerics/turned.inc"

   !> Measure the contacts that act.
   subroutine socket_measure_acting(self, motion)
      class(socket_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion             !! positions and velocities

      include "measure_acting.inc"
   end subroutine socket_measure_acting

   !> Normal, penetration, its rate and arms of a contact; its sliding velocity where it is asked for.
   pure subroutine socket_measure(self, k, with_sliding, motion, contact)
      class(socket_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      call measure_one(self, k, with_sliding, motion, contact)
   end subroutine socket_measure

   !> The same, not for overriding.
   pure subroutine measure_one(self, k, with_sliding, motion, contact)
      class(socket_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      integer :: item

      item = (k - 1)/self%n_contact_item + 1
      call measure_socket(self%socket(item), self%items%pairs(item), k - (item - 1)*self%n_contact_item, &
                          self%items%s_i(:, item), self%items%s_j(:, item), self%items%body(1, item), self%items%body(2, item), &
                          ubound(motion%r, 2), motion%r, motion%rot, motion%v, motion%omega, contact)
      if (with_sliding) call set_sliding(motion, self%items%body(1, item), self%items%body(2, item), contact)
   end subroutine measure_one

   !> All but the sliding velocity, on plain arrays.
   pure subroutine measure_socket(socket, pair, base, s_i, s_j, i, j, n_body, r, rot, v, omega, contact)
      type(socket_t), intent(in) :: socket                !! where the surfaces are
      type(surfaces_t), intent(in) :: pair                !! the surfaces
      integer, intent(in) :: base                         !! of a bushing: 1 or 2, of the two ends of the pin
      real(wp), intent(in) :: s_i(3)                      !! (3) centre of socket or bushing, frame of body i [m]
      real(wp), intent(in) :: s_j(3)                      !! (3) centre of ball or pin, frame of body j [m]
      integer, intent(in) :: i                            !! body i
      integer, intent(in) :: j                            !! body j
      integer, intent(in) :: n_body                       !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)              !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)         !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)              !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)          !! (3, 0:bodies) angular velocities, world frame [rad/s]
      type(point_contact_t), intent(inout) :: contact     !! its kinematics

      type(station_t) :: at
      real(wp) :: distance, normal(3), reach

      call find_station(socket, pair, base, s_i, s_j, i, j, n_body, r, rot, v, omega, at)
      distance = sqrt(at%e(1)**2 + at%e(2)**2 + at%e(3)**2)
      normal = socket%side*direction_of(at, distance)
      contact%delta = socket%side*distance - pair%touch
      if (.not. at%is_there) contact%delta = -pair%touch
      if (socket%has_axis) then
         if (any(abs(at%pin) > 0.0_wp)) normal = normal - dot_product(normal, at%pin)/dot_product(at%u, at%pin)*at%u
      end if
      contact%normal = normal
      contact%rate = normal(1)*at%w(1) + normal(2)*at%w(2) + normal(3)*at%w(3)
      reach = pair%radius_j - 0.5_wp*contact%delta
      contact%arm_j = at%arm_j + reach*normal
      contact%arm_i = r(:, j) + contact%arm_j - r(:, i)
   end subroutine measure_socket

   !> Where a ball or base is, at a motion.
   pure function station_of(socket, pair, base, s_i, s_j, i, j, motion) result(at)
      type(socket_t), intent(in) :: socket   !! where the surfaces are
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      integer, intent(in) :: base            !! of a bushing: 1 or 2, of the two ends of the pin
      real(wp), intent(in) :: s_i(3)         !! (3) centre of socket or bushing, frame of body i [m]
      real(wp), intent(in) :: s_j(3)         !! (3) centre of ball or pin, frame of body j [m]
      integer, intent(in) :: i               !! body i
      integer, intent(in) :: j               !! body j
      type(motion_t), intent(in) :: motion   !! positions and velocities
      type(station_t) :: at                  !! the station

      call find_station(socket, pair, base, s_i, s_j, i, j, ubound(motion%r, 2), motion%r, motion%rot, motion%v, motion%omega, at)
   end function station_of

   !> The same on plain arrays.
   pure subroutine find_station(socket, pair, base, s_i, s_j, i, j, n_body, r, rot, v, omega, at)
      type(socket_t), intent(in) :: socket            !! where the surfaces are
      type(surfaces_t), intent(in) :: pair            !! the surfaces
      integer, intent(in) :: base                     !! of a bushing: 1 or 2, of the two ends of the pin
      real(wp), intent(in) :: s_i(3)                  !! (3) centre of socket or bushing, frame of body i [m]
      real(wp), intent(in) :: s_j(3)                  !! (3) centre of ball or pin, frame of body j [m]
      integer, intent(in) :: i                        !! body i
      integer, intent(in) :: j                        !! body j
      integer, intent(in) :: n_body                   !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)          !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)     !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)          !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)      !! (3, 0:bodies) angular velocities, world frame [rad/s]
      type(station_t), intent(out) :: at              !! the station

      real(wp) :: arm_i(3), cosine, half_i, half_j, place, side, zeta

      arm_i = turned(rot(:, :, i), s_i)
      at%arm_j = turned(rot(:, :, j), s_j)
      if (socket%has_axis) then
         side = real(2*base - 3, wp)
         half_i = 0.5_wp*pair%length
         half_j = 0.5_wp*pair%length_j
         place = side*half_j
         at%u = turned(rot(:, :, i), socket%axis_i)
         at%pin = turned(rot(:, :, j), socket%axis_j)
         if (socket%has_ends) then
            ! stations of the pin's axis in the bushing: zeta(place) = zeta + place u . u_j, between the ends
            cosine = dot_product(at%u, at%pin)
            zeta = dot_product(r(:, j) + at%arm_j - r(:, i) - arm_i, at%u)
            at%is_there = abs(zeta) < half_i + half_j*abs(cosine)
            if (abs(zeta + place*cosine) > half_i .and. at%is_there) then
               place = (sign(half_i, zeta + place*cosine) - zeta)/cosine
               at%arm_j = at%arm_j + place*at%pin
            else
               at%arm_j = at%arm_j + place*at%pin
               at%pin = 0.0_wp
            end if
         else
            at%arm_j = at%arm_j + place*at%pin
            at%pin = 0.0_wp
         end if
      end if
      at%rho = r(:, j) + at%arm_j - r(:, i) - arm_i
      at%w = v(:, j) + across(omega(:, j), at%arm_j) - v(:, i) - across(omega(:, i), arm_i + at%rho)
      at%e = at%rho
      if (socket%has_axis) at%e = at%rho - dot_product(at%rho, at%u)*at%u
   end subroutine find_station

   !> Direction of the eccentricity; of none, that of the velocity, or any across the axis.
   pure function direction_of(at, distance) result(normal)
      type(station_t), intent(in) :: at      !! the station
      real(wp), intent(in) :: distance       !! its eccentricity [m]
      real(wp) :: normal(3)                  !! (3) world frame [1]

      if (distance > tiny(1.0_wp)) then
         normal = at%e/distance
         return
      end if
      normal = at%w - dot_product(at%w, at%u)*at%u
      if (norm2(normal) > tiny(1.0_wp)) then
         normal = normal/norm2(normal)
      else if (any(abs(at%u) > 0.0_wp)) then
         normal = 0.0_wp
         normal(minloc(abs(at%u), dim=1)) = 1.0_wp
         normal = normal - dot_product(normal, at%u)*at%u
         normal = normal/norm2(normal)
      else
         normal = [1.0_wp, 0.0_wp, 0.0_wp]
      end if
   end function direction_of

   !> Second derivative of a penetration by time.
   pure real(wp) function socket_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(socket_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact   !! its kinematics

      type(station_t) :: at
      real(wp) :: a(3), along, arm_i(3), distance, glide, pin_rate(3), to_i(3), w(3), w_e(3)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%items%body(1, item)
      j = self%items%body(2, item)
      at = station_of(self%socket(item), self%items%pairs(item), k - (item - 1)*self%n_contact_item, self%items%s_i(:, item), &
                      self%items%s_j(:, item), i, j, motion)
      associate (w_i => motion%omega(:, i), w_j => motion%omega(:, j))
         to_i = motion%r(:, j) + at%arm_j - motion%r(:, i)
         arm_i = to_i - at%rho
         a = motion%a(:, j) + cross(motion%alpha(:, j), at%arm_j) + cross(w_j, cross(w_j, at%arm_j)) - motion%a(:, i) &
             - cross(motion%alpha(:, i), to_i) - cross(w_i, cross(w_i, to_i)) - 2.0_wp*cross(w_i, at%w)
         w = at%w
         if (any(abs(at%pin) > 0.0_wp)) then
            ! the station glides along the pin so that it stays at the end: w + glide u_j, and twice the change of u_j
            along = dot_product(at%u, at%pin)
            glide = -dot_product(at%u, at%w)/along
            pin_rate = cross(w_j - w_i, at%pin)
            w = at%w + glide*at%pin
            a = a + 2.0_wp*glide*pin_rate
            a = a - dot_product(at%u, a)/along*at%pin
         end if
      end associate
      distance = max(norm2(at%e), tiny(1.0_wp))
      w_e = w - dot_product(w, at%u)*at%u
      acceleration = self%socket(item)%side*(dot_product(at%e/distance, a) + (dot_product(w_e, w_e) - contact%rate**2)/distance)
   end function socket_penetration_acceleration

   !> Eccentricity of centres, tilt, and how much of the pin is in the bushing.
   subroutine socket_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(socket_contacts_t), intent(in) :: self        !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) their kinematics
      real(wp), intent(in) :: f_n(self%n_contact_item)    !! (n_contact_item) normal forces [N]
      real(wp), intent(in) :: f_t(self%n_contact_item)    !! (n_contact_item) friction forces on j along t [N]
      real(wp), intent(inout), contiguous :: value(:)     !! (components) the value [any]

      real(wp) :: cosine, d(3), half_i, pin(3), u(3), zeta
      integer :: c

      associate (socket => self%socket(item), i => self%items%body(1, item), j => self%items%body(2, item))
         d = motion%r(:, j) + turned(motion%rot(:, :, j), self%items%s_j(:, item)) - motion%r(:, i) &
             - turned(motion%rot(:, :, i), self%items%s_i(:, item))
         u = turned(motion%rot(:, :, i), socket%axis_i)
         pin = turned(motion%rot(:, :, j), socket%axis_j)
         cosine = dot_product(u, pin)
         zeta = dot_product(d, u)
         select case (code)
         case (of_eccentricity)
            value = d - zeta*u  ! of a ball u is zero
         case (of_moment)
            value = 0.0_wp
            do c = 1, size(contacts)
               value = value + cross(contacts(c)%arm_j - turned(motion%rot(:, :, j), self%items%s_j(:, item)), &
                                     self%force_on_j(contacts(c), f_n(c), f_t(c)))
            end do
         case (of_tilt)
            value = atan2(norm2(cross(u, pin)), abs(cosine))
         case (of_axial_displacement)
            value = zeta
         case (of_engagement)
            cosine = 0.5_wp*self%items%pairs(item)%length_j*abs(cosine)
            half_i = 0.5_wp*self%items%pairs(item)%length
            value = max(min(cosine, half_i - zeta) - max(-cosine, -half_i - zeta), 0.0_wp)
         end select
      end associate
   end subroutine socket_report_item

end module socket_contacts
