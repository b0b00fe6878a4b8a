!> The films of pins in bushings and of balls in sockets, in space.
!>
!> With P the point of body i, u the axis of the bushing, Q the point of the pin and u_j = (u + t) (u . u_j) its axis, where t is
!> its slope; x the point of the pin's axis at the middle of the film, z along u from there, half from -H to H; w and w_r velocity
!> of x and angular velocity of the pin as body i sees them:
!>
!> e(z) = e + z t,   g = H t,   e_m' = w_e - (w.u) t/2,   g_m' = H [ (w_r x (u + t))_e - ((w_r x t).u) t/2 ]
!>
!> ( _e : the part across u). The law of the film gets e, g and, for their rates, e_m' + w_B u x e and g_m' + w_B u x g, with w_B
!> and w_J the inertial spins of bushing and pin along u. What pressure and the shear that it drives do at z is f - (f.t) u/2, so
!> that it does the work that the film takes; -(w.u) t/2 is that of a surface that glides along the axis. With the law's force F and
!> its first moment H f_1, and K = H (f_1 - (f_1.t) u/2),
!>
!> on the pin at x:  F - (F.t) u/2,   and the couple (u + t) x K;   on the bushing the opposite of both at x,
!>
!> and with `film_torque` the shear of the motion itself: T u with T = -D (w_J - w_B) - [e x F + g x f_1].u/2, and -(D/R^2) (w.u) u
!> at x, with D (w_J - w_B) the drag of `torques`, its mean over the length by Gauss' rule. Then the film takes
!> -F.v - f_1.v_g + D (w_J - w_B)^2 + (D/R^2) (w.u)^2 exactly, however the pin is tilted.
!>
!> Ball: e and v = w - w_r x e/2 are given to the law in their plane; the couple is -(mu R^4/c) [S w_r] - e x F/2, see
!> `sphere_shear`.
!>
!> Source: own derivation from Reynolds' equation, see `film_law`. Limits: a film is as long as the shorter of pin and bushing, and
!> is in the middle of that; where the pin leaves it at an end, the film acts by the part of its length that the pin is in. A pin
!> that leans by more than 60 degrees has none.
module socket_films
   use bearing_films, only: bearing_films_t, films_fit
   use film_law, only: film_motion_t, parameter_clearance, parameter_eps_max, parameter_radius, &
      parameter_viscosity
   use film_places, only: film_state_t, finish_state, share_of
   use film_spherical, only: sphere_shear
   use kinds, only: wp
   use motion, only: cross, loads_t, motion_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: film_seat_t, socket_films_t

   real(wp), parameter :: min_cosine = 0.5_wp  !! of the angle between the axes [1]

   !> Gauss' rule of 4 points on (-1, 1).
   real(wp), parameter :: places(4) = [-0.861136311594052575224_wp, -0.339981043584856264803_wp, 0.339981043584856264803_wp, &
                                       0.861136311594052575224_wp]
   real(wp), parameter :: weights(4) = [0.347854845137453857373_wp, 0.652145154862546142627_wp, 0.652145154862546142627_wp, &
                                        0.347854845137453857373_wp]

   !> Where the film of a joint is.
   type :: film_seat_t
      integer :: body(2) = 0                !! (2) bodies of bearing and journal
      real(wp) :: s_i(3) = 0.0_wp           !! (3) P, frame of body i [m]
      real(wp) :: s_j(3) = 0.0_wp           !! (3) Q, frame of body j [m]
      logical :: has_axis = .false.         !! a pin in a bushing, not a ball in a socket
      logical :: has_ends = .false.         !! the bushing ends
      logical :: is_of_pin = .false.        !! the pin is shorter, and the film about its middle
      real(wp) :: frame(3, 3) = 0.0_wp      !! (3, 3) two axes across that of the bushing and that, as columns, frame of body i [1]
      real(wp) :: axis_j(3) = 0.0_wp        !! (3) axis of the pin, frame of body j [1]
      real(wp) :: half_i = 0.0_wp           !! half the length of the bushing [m]
      real(wp) :: half_j = 0.0_wp           !! half the length of the pin [m]
   end type film_seat_t

   !> Where a film is at a motion, world frame.
   type :: seated_t
      real(wp) :: frame(3, 3) = 0.0_wp  !! (3, 3) of the film, as columns: two axes across u, and u [1]
      real(wp) :: arm_i(3) = 0.0_wp     !! (3) x from the centre of mass of i [m]
      real(wp) :: arm_j(3) = 0.0_wp     !! (3) x from that of j [m]
      real(wp) :: off(3) = 0.0_wp       !! (3) x from Q [m]
      real(wp) :: slope(3) = 0.0_wp     !! (3) t [1]
      real(wp) :: e(3) = 0.0_wp         !! (3) eccentricity [m]
      real(wp) :: w(3) = 0.0_wp         !! (3) velocity of x, as body i sees it [m/s]
      real(wp) :: turn(3) = 0.0_wp      !! (3) w_r [rad/s]
      real(wp) :: half = 0.0_wp         !! H [m]
   end type seated_t

   !> Films of pins or of balls.
   type, extends(bearing_films_t) :: socket_films_t
      type(film_seat_t), allocatable :: seat(:)  !! (n) where they are
   contains
      procedure :: fit => socket_fit
      procedure :: bear => socket_bear
      procedure :: motion_of => socket_motion_of
      procedure :: state_of => socket_state_of
   end type socket_films_t

contains

   !> Fit the film of an item to its surfaces.
   subroutine socket_fit(self, k, pair)
      class(socket_films_t), intent(inout) :: self   !! the films
      integer, intent(in) :: k                       !! item
      type(surfaces_t), intent(in) :: pair           !! its surfaces

      call films_fit(self, k, pair)
      self%seat(k)%half_i = 0.5_wp*pair%length
      self%seat(k)%half_j = 0.5_wp*pair%length_j
      self%seat(k)%is_of_pin = pair%length_j < pair%length
   end subroutine socket_fit

   !> Add what the films do to the loads, and find the power that they take.
   subroutine socket_bear(self, body, s_i, s_j, motion, loads)
      class(socket_films_t), intent(inout) :: self         !! the films
      integer, intent(in), contiguous :: body(:, :)        !! (2, n) bodies of bearing and journal
      real(wp), intent(in), contiguous :: s_i(:, :)        !! (3, n) point of the bearing, frame of its body [m]
      real(wp), intent(in), contiguous :: s_j(:, :)        !! (3, n) point of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      type(loads_t), intent(inout) :: loads                !! loads on the bodies

      type(film_motion_t) :: film
      type(film_state_t) :: state
      type(seated_t) :: at
      real(wp) :: couple(3), force(3)
      integer :: k

      self%power = 0.0_wp
      do k = 1, size(body, 2)
         call find_seat(self%seat(k), self%place(k)%is_relative, motion, at, film)
         state%share = share_of(self%place(k), film)
         if (.not. state%share > 0.0_wp) cycle
         call press(self, k, at, film, self%place(k)%has_torque, state, force, couple)
         associate (i => body(1, k), j => body(2, k))
            loads%force(:, i) = loads%force(:, i) - force
            loads%force(:, j) = loads%force(:, j) + force
            loads%moment(:, i) = loads%moment(:, i) - cross(at%arm_i, force) - couple
            loads%moment(:, j) = loads%moment(:, j) + cross(at%arm_j, force) + couple
         end associate
         self%power = self%power - dot_product(force, at%w) - dot_product(couple, at%turn)
      end do
   end subroutine socket_bear

   !> Force on the journal at x and the couple with it.
   subroutine press(self, k, at, film, with_shear, state, force, couple)
      class(socket_films_t), intent(in) :: self        !! the films
      integer, intent(in) :: k                         !! item
      type(seated_t), intent(in) :: at                 !! where its film is
      type(film_motion_t), intent(in) :: film          !! its motion
      logical, intent(in) :: with_shear                !! shear acts
      type(film_state_t), intent(inout) :: state       !! its share is set; force and drags are set here
      real(wp), intent(out) :: force(3)                !! (3) force, world frame [N]
      real(wp), intent(out) :: couple(3)               !! (3) couple, world frame [N.m]

      real(wp) :: drag, f_1(2), first(3), glide, half
      real(wp), parameter :: of_two(2) = [1.0_wp, -1.0_wp]

      call self%law%force_of_one(film, self%parameters(:, k), state%force, f_1)
      state%force = state%share*state%force
      f_1 = state%share*f_1
      force = matmul(at%frame(:, 1:2), state%force)
      if (.not. self%seat(k)%has_axis) then
         couple = 0.0_wp
         if (with_shear) couple = state%share*ball_drag(self, k, at) - 0.5_wp*cross(at%e, force)
         return
      end if
      associate (u => at%frame(:, 3))
         first = at%half*matmul(at%frame(:, 1:2), f_1)
         first = first - 0.5_wp*dot_product(first, at%slope)*u
         couple = cross(u + at%slope, first)
         force = force - 0.5_wp*dot_product(force, at%slope)*u
         half = 0.5_wp*(dot_product(film%e, of_two*state%force([2, 1])) + dot_product(film%tilt, of_two*f_1([2, 1])))
         drag = state%share*drag_factor(self, k, film)
         state%drag_journal = -drag*film%speed_difference - half
         state%drag_bearing = drag*film%speed_difference - half
         if (.not. with_shear) return
         glide = dot_product(at%w, u)
         force = force - drag/self%parameters(parameter_radius, k)**2*glide*u
         couple = couple + state%drag_journal*u
      end associate
   end subroutine press

   !> D: moment of the drag over the difference of the angular speeds, its mean over the length [N.m.s/rad].
   function drag_factor(self, k, film) result(drag)
      class(socket_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                   !! item
      type(film_motion_t), intent(in) :: film    !! its motion
      real(wp) :: drag                           !! D

      type(film_motion_t) :: section
      real(wp) :: t_b, t_j
      integer :: m

      section = film
      section%speed_difference = 1.0_wp
      drag = 0.0_wp
      do m = 1, size(places)
         section%e = film%e + places(m)*film%tilt
         call self%law%torques(section, self%parameters(:, k), [0.0_wp, 0.0_wp], t_j, t_b)
         drag = drag + 0.5_wp*weights(m)*t_b
      end do
   end function drag_factor

   !> Moment of the shear on a ball, of its turning against the socket.
   pure function ball_drag(self, k, at) result(moment)
      class(socket_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                   !! item
      type(seated_t), intent(in) :: at           !! where its film is
      real(wp) :: moment(3)                      !! (3) world frame [N.m]

      real(wp) :: about, across, spin(3)

      associate (c => self%parameters(parameter_clearance, k), n => at%frame(:, 1))
         call sphere_shear(min(norm2(at%e)/c, self%parameters(parameter_eps_max, k)), about, across)
         spin = dot_product(at%turn, n)*n
         moment = -self%parameters(parameter_viscosity, k)*self%parameters(parameter_radius, k)**4/c &
                  *(about*spin + across*(at%turn - spin))
      end associate
   end function ball_drag

   !> Where a film is, and its motion.
   pure subroutine find_seat(seat, is_relative, motion, at, film)
      type(film_seat_t), intent(in) :: seat       !! where the film is in the bodies
      logical, intent(in) :: is_relative          !! entrained by the difference of the speeds
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(seated_t), intent(out) :: at           !! where it is
      type(film_motion_t), intent(out) :: film    !! its motion

      real(wp) :: from_i(3), span(3)

      associate (i => seat%body(1), j => seat%body(2))
         from_i = matmul(motion%rot(:, :, i), seat%s_i)
         at%arm_j = matmul(motion%rot(:, :, j), seat%s_j)
         span = motion%r(:, j) + at%arm_j - motion%r(:, i) - from_i
         at%turn = motion%omega(:, j) - motion%omega(:, i)
         if (seat%has_axis) call lay_pin(seat, motion, span, at, film)
         at%arm_j = at%arm_j + at%off
         at%arm_i = motion%r(:, j) + at%arm_j - motion%r(:, i)
         at%w = motion%v(:, j) + cross(motion%omega(:, j), at%arm_j) - motion%v(:, i) - cross(motion%omega(:, i), at%arm_i)
         if (seat%has_axis) then
            call move_pin(motion%omega(:, i), motion%omega(:, j), is_relative, at, film)
         else
            at%e = span
            call move_ball(at, film)
         end if
      end associate
   end subroutine find_seat

   !> Where a pin lies in its bushing, and how much of the film's length it is in.
   pure subroutine lay_pin(seat, motion, span, at, film)
      type(film_seat_t), intent(in) :: seat         !! where the film is in the bodies
      type(motion_t), intent(in) :: motion          !! positions
      real(wp), intent(in) :: span(3)               !! (3) Q from P [m]
      type(seated_t), intent(inout) :: at           !! frame, x from Q, slope, eccentricity and H are set
      type(film_motion_t), intent(inout) :: film    !! the engaged part is set

      real(wp) :: cosine, pin(3), zeta

      at%frame = matmul(motion%rot(:, :, seat%body(1)), seat%frame)
      pin = matmul(motion%rot(:, :, seat%body(2)), seat%axis_j)
      associate (u => at%frame(:, 3))
         at%half = min(seat%half_i, seat%half_j)
         cosine = dot_product(u, pin)
         if (abs(cosine) < min_cosine) then
            film%engaged = 0.0_wp
            return
         end if
         zeta = dot_product(span, u)
         at%slope = pin/cosine - u
         if (.not. seat%is_of_pin) at%off = -zeta*(u + at%slope)
         at%e = span + at%off
         at%e = at%e - dot_product(at%e, u)*u
         if (.not. seat%has_ends) return
         film%engaged = min(seat%half_i, zeta + seat%half_j) - max(-seat%half_i, zeta - seat%half_j)
         film%engaged = min(max(0.5_wp*film%engaged/at%half, 0.0_wp), 1.0_wp)
      end associate
   end subroutine lay_pin

   !> How a pin moves, in the plane across the bushing's axis.
   pure subroutine move_pin(omega_i, omega_j, is_relative, at, film)
      real(wp), intent(in) :: omega_i(3), omega_j(3)   !! (3) angular velocities of both bodies [rad/s]
      logical, intent(in) :: is_relative               !! entrained by the difference of the speeds
      type(seated_t), intent(in) :: at                 !! where the film is
      type(film_motion_t), intent(inout) :: film       !! its motion is set

      real(wp) :: of_tilt(3), spin

      associate (u => at%frame(:, 3), across => at%frame(:, 1:2), t => at%slope)
         spin = dot_product(omega_i, u)
         film%speed_difference = dot_product(omega_j, u) - spin
         film%speed_sum = film%speed_difference
         if (.not. is_relative) film%speed_sum = film%speed_difference + 2.0_wp*spin
         film%e = matmul(at%e, across)
         film%e_dot = matmul(at%w - 0.5_wp*dot_product(at%w, u)*t, across) + spin*[-film%e(2), film%e(1)]
         if (.not. (any(abs(t) > 0.0_wp) .or. any(abs(matmul(cross(at%turn, u), across)) > 0.0_wp))) return
         of_tilt = cross(at%turn, u + t) - 0.5_wp*dot_product(cross(at%turn, t), u)*t
         film%tilt = at%half*matmul(t, across)
         film%tilt_dot = at%half*matmul(of_tilt, across) + spin*[-film%tilt(2), film%tilt(1)]
      end associate
   end subroutine move_pin

   !> How a ball moves, in the plane of its eccentricity and the velocity that squeezes.
   pure subroutine move_ball(at, film)
      type(seated_t), intent(inout) :: at          !! where it is; its frame is set: line of centres, across it, normal to both
      type(film_motion_t), intent(inout) :: film   !! its motion is set

      real(wp) :: distance, n(3), t(3), v(3)

      v = at%w - 0.5_wp*cross(at%turn, at%e)
      distance = norm2(at%e)
      n = [1.0_wp, 0.0_wp, 0.0_wp]
      if (norm2(v) > tiny(1.0_wp)) n = v/norm2(v)
      if (distance > tiny(1.0_wp)) n = at%e/distance
      t = v - dot_product(v, n)*n
      if (norm2(t) > tiny(1.0_wp)) then
         t = t/norm2(t)
         t = t - dot_product(t, n)*n
      else
         t = 0.0_wp
         t(minloc(abs(n), dim=1)) = 1.0_wp
         t = t - dot_product(t, n)*n
      end if
      t = t/norm2(t)
      at%frame = reshape([n, t, cross(n, t)], [3, 3])
      film%e = [distance, 0.0_wp]
      film%e_dot = [dot_product(v, n), dot_product(v, t)]
   end subroutine move_ball

   !> The motion of one item.
   function socket_motion_of(self, k, body, s_i, s_j, motion) result(film)
      class(socket_films_t), intent(in) :: self   !! the films
      integer, intent(in) :: k                    !! item
      integer, intent(in) :: body(2)              !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_i(3)              !! (3) point of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_j(3)              !! (3) point of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(film_motion_t) :: film                 !! motion of the bearing

      type(seated_t) :: at

      call find_seat(self%seat(k), self%place(k)%is_relative, motion, at, film)
   end function socket_motion_of

   !> What the film of one item does at a motion.
   function socket_state_of(self, k, body, film, motion) result(state)
      class(socket_films_t), intent(in) :: self   !! the films
      integer, intent(in) :: k                    !! item
      integer, intent(in) :: body(2)              !! (2) bodies of bearing and journal
      type(film_motion_t), intent(in) :: film     !! its motion
      type(motion_t), intent(in) :: motion        !! that of the bodies
      type(film_state_t) :: state                 !! what it does

      type(film_motion_t) :: same
      type(seated_t) :: at
      real(wp) :: couple(3), force(3)

      if (.not. self%acts) return
      call find_seat(self%seat(k), self%place(k)%is_relative, motion, at, same)
      state%share = share_of(self%place(k), film)
      call press(self, k, at, film, .true., state, force, couple)
      state%power = -dot_product(force, at%w) - dot_product(couple, at%turn)
      if (self%place(k)%has_torque) then
         state%torque = state%drag_journal
         state%shear = couple
      else
         call press(self, k, at, film, .false., state, force, couple)
      end if
      state%load = force
      state%moment = couple + cross(at%off, force)
      state%side_flow = state%share*self%law%side_flow(film, self%parameters(:, k))
      if (.not. self%seat(k)%has_axis) return
      call finish_state(self%parameters(:, k), self%oil(k)%heat, sum(abs(matmul(at%frame(:, 3), motion%omega(:, body)))), state)
   end function socket_state_of

end module socket_films
