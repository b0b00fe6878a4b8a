!> Planar: the films of journals in bearings: their motion, what they do to the bodies, and the power that they take.
!>
!> on body j: F at the journal's centre, T_J;   on body i: -F at the journal's centre, or, with the moments of shear, -F at the
!> bearing's centre and T_B:
!> lost = -(F.v_J + T_J w_J - F.v_B + T_B w_B),   v_B the velocity of body i where -F acts
!>
!> Over a transition of depth d (e_t0) film and contact share the force: film times (c + d - e)/d between e = c and c + d, none
!> beyond, and its clearance is c + e_t1, so that it stays finite.
!>
!> Signs: forces and moments on the journal. Source: Flores et al. (2008), eqs. (5.23)-(5.32). Without the moments of shear what is
!> lost may be negative: the shaft that would give the energy back is not asked for its moment. Limits: journals in the plane.
module bearing_films
   use film_fields, only: film_field_t
   use film_law, only: film_law_t, film_motion_t, film_slopes_t, n_film_parameter, parameter_clearance, &
      parameter_length
   use film_places, only: film_bearing_of, film_place_t, film_state_t, finish_state, place_of_film, share_of
   use item, only: item_t
   use joint_level, only: level_hybrid, level_lubricated, level_of
   use kinds, only: two_pi, wp
   use lubricant, only: oil_t, viscosity_at
   use motion, only: loads_t, motion_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: bearing_films_t, films_fit, new_bearing_films

   integer, parameter :: n_around = 360, n_along = 40  !! parts of the angle and of the length of an unwrapped film

   !> Films of the items of a set.
   type :: bearing_films_t
      class(film_law_t), allocatable :: law           !! the film of all items
      logical :: acts = .false.                       !! it acts; otherwise it is there for its channels only
      logical :: is_alone = .false.                   !! there is no dry contact
      logical :: may_tilt = .false.                   !! journals may be tilted, and the film holds for small tilts only
      real(wp) :: power = 0.0_wp                      !! taken in the last evaluation by all items [W]
      real(wp), allocatable :: eps_max(:)             !! (n) eccentricity over clearance where it ends if it is alone [1]
      real(wp), allocatable :: roughness(:)           !! (n) of the surfaces, 0: not known [m]
      real(wp), allocatable :: parameters(:, :)       !! (n_film_parameter, n) fitted to the bearings [any]
      type(film_place_t), allocatable :: place(:)     !! (n) how they act
      type(oil_t), allocatable :: oil(:)              !! (n) lubricants
      type(film_motion_t), allocatable :: motion(:)   !! (n) of an evaluation
      real(wp), allocatable :: f(:, :)                !! (2, n) of an evaluation [N]
      real(wp), allocatable :: s(:, :, :)             !! (2, 2, n) centres of bearing and journal, of an evaluation [m]
   contains
      procedure :: fit => films_fit
      procedure :: bear => films_bear
      procedure :: state_of => films_state_of
      procedure :: slopes_of => films_slopes_of
      procedure, non_overridable :: slopes_at => films_slopes_at
      procedure :: fades => films_fade
      procedure :: warm => films_warm
      procedure :: max_pressure => films_max_pressure
      procedure :: decay_of => films_decay_of
      procedure :: motion_of => films_motion_of
      procedure :: unwrap => films_unwrap
   end type bearing_films_t

contains

   !> Films of the rows of a set.
   subroutine new_bearing_films(items, law, oils, films)
      type(item_t), intent(in) :: items(:)       !! (n) rows
      class(film_law_t), intent(in) :: law       !! their film
      type(oil_t), intent(in) :: oils(:)         !! (lubricants) all of them
      class(bearing_films_t), intent(inout) :: films !! the films, new

      integer :: k, n

      n = size(items)
      allocate (films%law, source=law)
      allocate (films%parameters(n_film_parameter, n), films%eps_max(n), films%roughness(n), films%place(n), films%motion(n))
      allocate (films%f(2, n), films%s(2, 2, n), films%oil(n))
      films%is_alone = level_of(items(1)) == level_lubricated
      films%acts = films%is_alone .or. level_of(items(1)) == level_hybrid
      do k = 1, n
         if (items(k)%reference("lubricant") > 0) films%oil(k) = oils(items(k)%reference("lubricant"))
         films%place(k) = place_of_film(items(k), oils)
         films%roughness(k) = items(k)%number("roughness")
         films%eps_max(k) = items(k)%number("eps_max")
      end do
   end subroutine new_bearing_films

   !> Fit the film of an item to its surfaces and to its temperature.
   subroutine films_fit(self, k, pair)
      class(bearing_films_t), intent(inout) :: self  !! the films
      integer, intent(in) :: k                       !! item
      type(surfaces_t), intent(in) :: pair           !! its surfaces

      character(:), allocatable :: help, message

      self%place(k)%gone = pair%clearance + self%place(k)%depth
      call self%law%fit(film_bearing_of(pair, self%place(k)), self%parameters(:, k), message, help)
   end subroutine films_fit

   !> Add what the films do to the loads, and find the power that they take.
   subroutine films_bear(self, body, s_i, s_j, motion, loads)
      class(bearing_films_t), intent(inout) :: self        !! the films
      integer, intent(in), contiguous :: body(:, :)        !! (2, n) bodies of bearing and journal
      real(wp), intent(in), contiguous :: s_i(:, :)        !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), intent(in), contiguous :: s_j(:, :)        !! (3, n) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion                 !! positions and velocities
      type(loads_t), intent(inout) :: loads                !! loads on the bodies

      integer :: n

      n = size(body, 2)
      call measure_films(n, self%place, body, s_i, s_j, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, &
                         motion%angle, self%motion, self%s)
      call self%law%force(n, self%motion, self%parameters, self%f)
      call add_film_loads(n, self%law, self%parameters, self%place, self%motion, self%f, self%s, body, ubound(motion%angle, 1), &
                          motion%omega, loads%force, loads%moment, self%power)
   end subroutine films_bear

   !> Motion of the bearings.
   pure subroutine measure_films(n, place, body, s_bearing, s_journal, n_body, r, rot, v, omega, angle, films, s)
      integer, intent(in) :: n                            !! number of bearings
      type(film_place_t), intent(in) :: place(n)          !! (n) how the films act
      integer, intent(in) :: body(2, n)                   !! (2, n) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(3, n)             !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(3, n)             !! (3, n) centre of the journal, frame of its body [m]
      integer, intent(in) :: n_body                       !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)              !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)         !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)              !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)          !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: angle(0:n_body)             !! (0:bodies) angles [rad]
      type(film_motion_t), intent(inout) :: films(n)      !! (n) motion of the bearings
      real(wp), intent(inout) :: s(2, 2, n)               !! (2, 2, n) centres of bearing and journal, from those of mass [m]

      integer :: k

      do k = 1, n
         call find_eccentricity(body(:, k), s_bearing(:, k), s_journal(:, k), n_body, r, rot, v, omega, s(:, 1, k), s(:, 2, k), &
                                films(k)%e, films(k)%e_dot)
         films(k)%speed_difference = omega(3, body(2, k)) - omega(3, body(1, k))
         films(k)%speed_sum = omega(3, body(2, k)) + omega(3, body(1, k))
         if (place(k)%is_relative) films(k)%speed_sum = films(k)%speed_difference
         films(k)%angle = angle(body(1, k))
      end do
   end subroutine measure_films

   !> Centres of bearing and journal from the centres of mass of their bodies, the eccentricity and its rate, world frame.
   pure subroutine find_eccentricity(body, s_bearing, s_journal, n_body, r, rot, v, omega, s_i, s_j, e, e_dot)
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(3)               !! (3) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(3)               !! (3) centre of the journal, frame of its body [m]
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(out) :: s_i(2), s_j(2)            !! (2) centres of bearing and journal [m]
      real(wp), intent(out) :: e(2), e_dot(2)            !! (2) the journal's from the bearing's, and its rate [m or m/s]

      integer :: i, j

      include "eccentricity.inc"
   end subroutine find_eccentricity

   !> Add forces and moments of the films to the loads.
   subroutine add_film_loads(n, law, parameters, place, films, f, s, body, n_body, omega, force, moment, power)
      integer, intent(in) :: n                                  !! number of bearings
      class(film_law_t), intent(in) :: law                      !! the film
      real(wp), intent(in) :: parameters(n_film_parameter, n)   !! (n_film_parameter, n) of the bearings [any]
      type(film_place_t), intent(in) :: place(n)                !! (n) how the films act
      type(film_motion_t), intent(in) :: films(n)               !! (n) motion of the bearings
      real(wp), intent(in) :: f(2, n)                           !! (2, n) forces of the whole films [N]
      real(wp), intent(in) :: s(2, 2, n)                        !! (2, 2, n) centres of bearing and journal, from those of mass [m]
      integer, intent(in) :: body(2, n)                         !! (2, n) bodies of bearing and journal
      integer, intent(in) :: n_body                             !! number of bodies
      real(wp), intent(in) :: omega(3, 0:n_body)                !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(inout) :: force(3, 0:n_body)             !! (3, 0:bodies) forces [N]
      real(wp), intent(inout) :: moment(3, 0:n_body)            !! (3, 0:bodies) moments about the centres of mass [N.m]
      real(wp), intent(out) :: power                            !! taken by all films [W]

      real(wp) :: f_j(2), m_b, share, t_b, t_j
      integer :: i, j, k

      power = 0.0_wp
      do k = 1, n
         i = body(1, k)
         j = body(2, k)
         share = share_of(place(k), films(k))
         if (.not. share > 0.0_wp) cycle
         f_j(1) = share*f(1, k)
         f_j(2) = share*f(2, k)
         if (place(k)%has_torque) then
            call law%torques(films(k), parameters(:, k), f(:, k), t_j, t_b)
            t_j = share*t_j
            m_b = share*t_b
         else
            t_j = 0.0_wp
            m_b = -(films(k)%e(1)*f_j(2) - films(k)%e(2)*f_j(1))
         end if
         force(1, i) = force(1, i) - f_j(1)
         force(2, i) = force(2, i) - f_j(2)
         force(1, j) = force(1, j) + f_j(1)
         force(2, j) = force(2, j) + f_j(2)
         moment(3, i) = moment(3, i) - (s(1, 1, k)*f_j(2) - s(2, 1, k)*f_j(1)) + m_b
         moment(3, j) = moment(3, j) + (s(1, 2, k)*f_j(2) - s(2, 2, k)*f_j(1)) + t_j
         power = power - (f_j(1)*films(k)%e_dot(1) + f_j(2)*films(k)%e_dot(2)) - t_j*omega(3, j) - m_b*omega(3, i)
      end do
   end subroutine add_film_loads

   !> Give the film of one item another temperature, and its viscosity.
   subroutine films_warm(self, k, pair, temperature)
      class(bearing_films_t), intent(inout) :: self  !! the films
      integer, intent(in) :: k                       !! item
      type(surfaces_t), intent(in) :: pair           !! its surfaces
      real(wp), intent(in) :: temperature            !! of the film [K]

      self%place(k)%temperature = temperature
      self%place(k)%viscosity = viscosity_at(self%oil(k), temperature)
      call self%fit(k, pair)
   end subroutine films_warm

   !> Whether films go out over a transition, which items of a set share.
   pure logical function films_fade(self)
      class(bearing_films_t), intent(in) :: self  !! the films

      films_fade = self%acts .and. self%place(1)%depth > 0.0_wp
   end function films_fade

   !> What the film of one item does at a motion.
   function films_state_of(self, k, body, film, motion) result(state)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      integer, intent(in) :: body(2)              !! (2) bodies of bearing and journal
      type(film_motion_t), intent(in) :: film     !! its motion
      type(motion_t), intent(in) :: motion        !! that of the bodies
      type(film_state_t) :: state                 !! what it does

      real(wp) :: f(2, 1)

      if (.not. self%acts) return
      state%share = share_of(self%place(k), film)
      call self%law%force(1, [film], self%parameters(:, k:k), f)
      call self%law%torques(film, self%parameters(:, k), f(:, 1), state%drag_journal, state%drag_bearing)
      state%force = state%share*f(:, 1)
      state%drag_journal = state%share*state%drag_journal
      state%drag_bearing = state%share*state%drag_bearing
      if (self%place(k)%has_torque) state%torque = state%drag_journal
      state%power = -dot_product(state%force, film%e_dot) - state%drag_journal*motion%omega(3, body(2)) &
                    - state%drag_bearing*motion%omega(3, body(1))
      state%side_flow = state%share*self%law%side_flow(film, self%parameters(:, k))
      call finish_state(self%parameters(:, k), self%oil(k)%heat, sum(abs(motion%omega(3, body))), state)
   end function films_state_of

   !> Maximum pressure in the middle of the length, at whole degrees around the bearing; 0 of a film that does not act.
   real(wp) function films_max_pressure(self, k, motion) result(pressure)
      class(bearing_films_t), intent(in) :: self  !! the films, which have pressures
      integer, intent(in) :: k                    !! item
      type(film_motion_t), intent(in) :: motion   !! its motion

      real(wp) :: h(1, n_around), p(1, n_around), theta(n_around)
      integer :: i

      pressure = 0.0_wp
      if (.not. self%acts) return
      theta = [(two_pi*i/n_around, i=1, n_around)]
      call self%law%field(motion, self%parameters(:, k), theta, [0.0_wp], p, h)
      pressure = share_of(self%place(k), motion)*maxval(p)
   end function films_max_pressure

   !> How fast the film of one item brings the way of the journal along the line of centres to rest, while it approaches [1/s].
   real(wp) function films_decay_of(self, k, motion, inverse_mass) result(decay)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      type(film_motion_t), intent(in) :: motion   !! its motion
      real(wp), intent(in) :: inverse_mass        !! sum of those of journal and bearing [1/kg]

      real(wp), parameter :: part = 1.0e-3_wp  ! change of the speed, of itself or of a clearance in a second [1]
      type(film_motion_t) :: two(2)
      real(wp) :: change, f(2, 2), n(2)

      decay = 0.0_wp
      if (.not. self%acts .or. .not. norm2(motion%e) > 0.0_wp) return
      n = motion%e/norm2(motion%e)
      change = part*max(norm2(motion%e_dot), self%parameters(parameter_clearance, k))
      two = motion
      two(2)%e_dot = motion%e_dot + change*n
      call self%law%force(2, two, self%parameters(:, [k, k]), f)
      decay = share_of(self%place(k), motion)*abs(dot_product(f(:, 2) - f(:, 1), n))/change*inverse_mass
   end function films_decay_of

   !> The motion of one item.
   function films_motion_of(self, k, body, s_i, s_j, motion) result(film)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      integer, intent(in) :: body(2)              !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_i(3)              !! (3) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_j(3)              !! (3) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(film_motion_t) :: film                 !! motion of the bearing

      type(film_motion_t) :: one(1)
      real(wp) :: s(2, 2, 1)

      call measure_films(1, self%place(k:k), reshape(body, [2, 1]), reshape(s_i, [3, 1]), reshape(s_j, [3, 1]), &
                         ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, motion%angle, one, s)
      film = one(1)
   end function films_motion_of

   !> Pressures and gaps of the film of one item, what of it acts in a transition.
   subroutine films_unwrap(self, k, motion, field)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      type(film_motion_t), intent(in) :: motion   !! its motion
      type(film_field_t), intent(inout) :: field  !! pressures, gaps and where they are

      integer :: i

      field%film = self%law%name
      field%clearance = self%parameters(parameter_clearance, k)
      field%angle = motion%angle
      field%e = [cos(motion%angle)*motion%e(1) + sin(motion%angle)*motion%e(2), &
                 cos(motion%angle)*motion%e(2) - sin(motion%angle)*motion%e(1)]
      field%theta = [(two_pi*i/n_around, i=0, n_around)]
      field%y = [(real(2*i - n_along, wp)/n_along, i=0, n_along)]
      allocate (field%pressure(n_along + 1, n_around + 1), field%gap(n_along + 1, n_around + 1))
      call self%law%field(motion, self%parameters(:, k), field%theta, field%y, field%pressure, field%gap)
      field%pressure = share_of(self%place(k), motion)*field%pressure
      field%y = 0.5_wp*self%parameters(parameter_length, k)*field%y
   end subroutine films_unwrap

   !> How the force of one item's film changes with a small motion of its journal. In a transition to dry contact the film's part of
   !> it counts, and how that changes.
   subroutine films_slopes_of(self, k, body, s_i, s_j, motion, one, slopes)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      integer, intent(in) :: body(2)              !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_i(3)              !! (3) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_j(3)              !! (3) centre of the journal, frame of its body [m]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(film_motion_t), intent(out) :: one     !! motion of the bearing
      type(film_slopes_t), intent(out) :: slopes  !! stiffness and damping

      one = self%motion_of(k, body, s_i, s_j, motion)
      call self%slopes_at(k, one, slopes)
   end subroutine films_slopes_of

   !> The same, of a motion of the bearing.
   subroutine films_slopes_at(self, k, one, slopes)
      class(bearing_films_t), intent(in) :: self  !! the films
      integer, intent(in) :: k                    !! item
      type(film_motion_t), intent(in) :: one      !! motion of the bearing
      type(film_slopes_t), intent(out) :: slopes  !! stiffness and damping

      real(wp) :: distance, f(2, 1), share
      integer :: i

      call self%law%linearise(one, self%parameters(:, k), slopes)
      share = share_of(self%place(k), one)
      slopes%stiffness = share*slopes%stiffness
      slopes%damping = share*slopes%damping
      if (.not. (share > 0.0_wp .and. share < 1.0_wp)) return
      distance = norm2(one%e)
      call self%law%force(1, [one], self%parameters(:, k:k), f)
      do i = 1, 2
         slopes%stiffness(:, i) = slopes%stiffness(:, i) + f(:, 1)*one%e(i)/(distance*self%place(k)%depth)
      end do
   end subroutine films_slopes_at

end module bearing_films
