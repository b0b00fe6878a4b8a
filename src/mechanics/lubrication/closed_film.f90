!> Films whose force is a closed form: components along and across the line of centres.
!>
!> F = s [ f_r(eps, eps', w) n + f_t(eps, eps', w) t ],   eps' = e'.n/c,   w = eps Om = ((w_J + w_B)|e| - 2 e'.t)/c
!> s = mu L R^3/c^2 of a long bearing, mu L^3 R/c^2 of a short one.
!>
!> With e = 0 the direction n is that of e', and with both zero any: forms that are isotropic there do not see it. Only the product
!> w is formed, never gamma', so that nothing is divided by e. Beyond eps_max the form has eps_max for eps, but eps' and w as they
!> are, so that F.v <= 0 stays.
!>
!> A kind whose force is the integral of a pressure gives that too: p = s_p(y) P(theta), with theta from the widest gap on, s_p =
!> 6 mu (R/c)^2 of a long bearing, 3 mu (L/(2 c))^2 (1 - y^2) of a short one, y from -1 to 1 along the axis.
!>
!> Source: Flores et al. (2008), eqs. (5.6)-(5.18), (5.24)-(5.30). Limits: of each form; one length, no grooves.
module closed_film
   use film_law, only: basic_parameters, film_bearing_t, film_law_t, film_motion_t, gap_at, n_film_parameter, own_parameters, &
      parameter_clearance, parameter_eps_max, parameter_length, parameter_radius, parameter_viscosity, squeezing_velocity
   use item, only: find_place, item_t
   use kinds, only: not_a_number, pi, wp
   implicit none (type, external)
   private
   public :: closed_film_t, fit_long, half_share, long_film_t, long_shape, narrowing_side, positive_part, short_film_t, short_shape

   integer, parameter :: parameter_scale = own_parameters + 1  !! s [N.s]

   !> A film in closed form.
   type, abstract, extends(film_law_t) :: closed_film_t
      logical :: is_book = .false.  !! as the book prints it
   contains
      procedure :: prepare => closed_prepare
      procedure :: force => closed_force
      procedure :: field => closed_field
      procedure :: shape => closed_shape
      procedure, nopass :: profile => closed_profile
      procedure(components_interface), deferred :: components
   end type closed_film_t

   !> One whose force grows with the length.
   type, abstract, extends(closed_film_t) :: long_film_t
   contains
      procedure :: fit => fit_long
      procedure :: halves => long_halves
      procedure, nopass :: profile => long_profile
   end type long_film_t

   !> One whose force grows with the cube of the length.
   type, abstract, extends(closed_film_t) :: short_film_t
   contains
      procedure :: fit => fit_short
      procedure :: side_flow => short_side_flow
      procedure :: halves => short_halves
      procedure, nopass :: profile => short_profile
   end type short_film_t

   abstract interface
      !> Components of the force on the journal over the scale.
      pure subroutine components_interface(self, parameters, eps, eps_dot, w, f_r, f_t)
         import :: closed_film_t, n_film_parameter, wp
         implicit none (type, external)
         class(closed_film_t), intent(in) :: self  !! the film
         real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
         real(wp), intent(in) :: eps               !! eccentricity ratio, below 1 [1]
         real(wp), intent(in) :: eps_dot           !! its rate [1/s]
         real(wp), intent(in) :: w                 !! eps Om [rad/s]
         real(wp), intent(out) :: f_r              !! along n, from the bearing's centre to the journal's [1/s]
         real(wp), intent(out) :: f_t              !! along t = z x n [1/s]
      end subroutine components_interface
   end interface

contains

   !> The name, and the form where the kind has one.
   subroutine closed_prepare(self, item)
      class(closed_film_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item             !! the row

      self%name = item%name
      if (find_place(item, "form") > 0) self%is_book = item%word("form") == "book"
   end subroutine closed_prepare

   !> Parameters of a long bearing.
   subroutine fit_long(self, bearing, parameters, message, help)
      class(long_film_t), intent(in) :: self                   !! the film
      type(film_bearing_t), intent(in) :: bearing            !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message      !! empty: any bearing will do
      character(:), allocatable, intent(out) :: help         !! empty

      message = ""
      help = ""
      call basic_parameters(bearing, parameters)
      parameters(parameter_scale) = bearing%viscosity*bearing%length*bearing%radius**3/bearing%clearance**2
   end subroutine fit_long

   !> Parameters of a short bearing.
   subroutine fit_short(self, bearing, parameters, message, help)
      class(short_film_t), intent(in) :: self                   !! the film
      type(film_bearing_t), intent(in) :: bearing            !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message      !! empty: any bearing will do
      character(:), allocatable, intent(out) :: help         !! empty

      message = ""
      help = ""
      call basic_parameters(bearing, parameters)
      parameters(parameter_scale) = bearing%viscosity*bearing%length**3*bearing%radius/bearing%clearance**2
   end subroutine fit_short

   !> What leaves at the ends of a short bearing where the pressure is positive: all that is squeezed away there, 2 L R |v|. A full
   !> film takes in as much where it is negative.
   function short_side_flow(self, motion, parameters) result(flow)
      class(short_film_t), intent(in) :: self                  !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      real(wp) :: flow                                         !! volume in a time [m^3/s]

      flow = 2.0_wp*parameters(parameter_length)*parameters(parameter_radius)*norm2(squeezing_velocity(motion))
   end function short_side_flow

   !> Tilted: sections of a long bearing are independent of one another, and Gauss' rule of two of them is exact to third order.
   subroutine long_halves(self, parameters, of_tilt, of_rate)
      class(long_film_t), intent(in) :: self                !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: of_tilt                      !! see `film_halves` [1]
      real(wp), intent(out) :: of_rate                      !! see `film_halves` [1]

      of_tilt = 1.0_wp/sqrt(3.0_wp)
      of_rate = of_tilt
   end subroutine long_halves

   !> Tilted: (h^3 p')' = -s with a gap and a source that change along the axis has the first moment of two such halves, to first
   !> order of the tilt.
   subroutine short_halves(self, parameters, of_tilt, of_rate)
      class(short_film_t), intent(in) :: self               !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: of_tilt                      !! see `film_halves` [1]
      real(wp), intent(out) :: of_rate                      !! see `film_halves` [1]

      of_rate = 1.0_wp/sqrt(15.0_wp)
      of_tilt = 2.0_wp*of_rate
   end subroutine short_halves

   !> Forces of n bearings.
   pure subroutine closed_force(self, n, motion, parameters, f)
      class(closed_film_t), intent(in) :: self                   !! the film
      integer, intent(in) :: n                                   !! number of bearings
      type(film_motion_t), intent(in) :: motion(n)               !! (n) their motion
      real(wp), intent(in) :: parameters(n_film_parameter, n)    !! (n_film_parameter, n) from `fit` [any]
      real(wp), intent(out) :: f(2, n)                           !! (2, n) forces on the journals, world frame [N]

      real(wp) :: eps, eps_dot, f_r, f_t, n_x, n_y, w
      integer :: k

      do k = 1, n
         call line_of_centres(motion(k), parameters(:, k), n_x, n_y, eps, eps_dot, w)
         call self%components(parameters(:, k), eps, eps_dot, w, f_r, f_t)
         f(1, k) = parameters(parameter_scale, k)*(f_r*n_x - f_t*n_y)
         f(2, k) = parameters(parameter_scale, k)*(f_r*n_y + f_t*n_x)
      end do
   end subroutine closed_force

   !> The motion along the line of centres and across it.
   pure subroutine line_of_centres(motion, parameters, n_x, n_y, eps, eps_dot, w)
      type(film_motion_t), intent(in) :: motion             !! the motion
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: n_x, n_y                     !! direction from the bearing's centre to the journal's, world frame [1]
      real(wp), intent(out) :: eps                          !! eccentricity ratio, at most eps_max [1]
      real(wp), intent(out) :: eps_dot                      !! its rate [1/s]
      real(wp), intent(out) :: w                            !! eps Om [rad/s]

      real(wp) :: distance, per_c, per_distance, speed

      associate (e => motion%e, e_dot => motion%e_dot, c => parameters(parameter_clearance))
         distance = sqrt(e(1)**2 + e(2)**2)
         n_x = 1.0_wp
         n_y = 0.0_wp
         if (distance > tiny(1.0_wp)) then
            per_distance = 1.0_wp/distance
            n_x = e(1)*per_distance
            n_y = e(2)*per_distance
         else
            speed = sqrt(e_dot(1)**2 + e_dot(2)**2)
            if (speed > tiny(1.0_wp)) then
               n_x = e_dot(1)/speed
               n_y = e_dot(2)/speed
            end if
         end if
         per_c = 1.0_wp/c
         w = (motion%speed_sum*distance - 2.0_wp*(e_dot(2)*n_x - e_dot(1)*n_y))*per_c
         eps = min(distance*per_c, parameters(parameter_eps_max))
         eps_dot = (e_dot(1)*n_x + e_dot(2)*n_y)*per_c
      end associate
   end subroutine line_of_centres

   !> Pressures and gaps of one bearing.
   subroutine closed_field(self, motion, parameters, theta, y, p, h)
      class(closed_film_t), intent(in) :: self              !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: theta(:)                      !! (n) angles, frame of the bearing's body [rad]
      real(wp), intent(in) :: y(:)                          !! (m) places along the axis, from -1 at one end to 1 at the other [1]
      real(wp), intent(out) :: p(:, :)                      !! (m, n) pressures [Pa]
      real(wp), intent(out) :: h(:, :)                      !! (m, n) gaps [m]

      real(wp) :: eps, eps_dot, from_widest, n_x, n_y, shape, w
      integer :: j, k

      call line_of_centres(motion, parameters, n_x, n_y, eps, eps_dot, w)
      do k = 1, size(theta)
         from_widest = modulo(theta(k) + motion%angle - atan2(-n_y, -n_x), 2.0_wp*pi)
         shape = self%shape(eps, eps_dot, w, from_widest)
         do j = 1, size(y)
            p(j, k) = self%profile(parameters, y(j))*shape
            h(j, k) = gap_at(motion, parameters, theta(k))
         end do
      end do
   end subroutine closed_field

   !> The pressure around the bearing: of a film that has none it is no number.
   pure real(wp) function closed_shape(self, eps, eps_dot, w, theta) result(shape)
      class(closed_film_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps               !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot           !! its rate [1/s]
      real(wp), intent(in) :: w                 !! eps Om [rad/s]
      real(wp), intent(in) :: theta             !! angle from the widest gap, 0 to 2 pi [rad]

      shape = not_a_number()
   end function closed_shape

   !> The pressure along the bearing: of a film that has none it is no number.
   pure real(wp) function closed_profile(parameters, y) result(profile)
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: y                             !! place, from -1 to 1 [1]

      profile = not_a_number()
   end function closed_profile

   !> The same of a long bearing: even.
   pure real(wp) function long_profile(parameters, y) result(profile)
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: y                             !! place, from -1 to 1 [1]

      profile = 6.0_wp*parameters(parameter_viscosity)*(parameters(parameter_radius)/parameters(parameter_clearance))**2
   end function long_profile

   !> The same of a short bearing: a parabola.
   pure real(wp) function short_profile(parameters, y) result(profile)
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: y                             !! place, from -1 to 1 [1]

      profile = 3.0_wp*parameters(parameter_viscosity)*(0.5_wp*parameters(parameter_length)/parameters(parameter_clearance))**2 &
                *(1.0_wp - y)*(1.0_wp + y)
   end function short_profile

   !> Pressure of a full short film around the bearing, eq. (5.3).
   pure real(wp) function short_shape(eps, eps_dot, w, theta) result(shape)
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap [rad]

      shape = (w*sin(theta) - 2.0_wp*eps_dot*cos(theta))/(1.0_wp + eps*cos(theta))**3
   end function short_shape

   !> Pressure of a full long film around the bearing, eq. (5.5), with p = 0 at +-90 degrees, eq. (5.21).
   pure real(wp) function long_shape(eps, eps_dot, w, theta) result(shape)
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap [rad]

      shape = (w/(2.0_wp + eps*eps)*sin(theta) - eps_dot*cos(theta))*(2.0_wp + eps*cos(theta))/(1.0_wp + eps*cos(theta))**2
   end function long_shape

   !> How much a half film counts at an angle: 1 on its half, 0 on the other; between, as long as its half changes
   !> (`narrowing_side`).
   pure real(wp) function half_share(side, theta) result(share)
      real(wp), intent(in) :: side   !! from -1, the half from pi to 2 pi, to 1, that from 0 to pi [1]
      real(wp), intent(in) :: theta  !! angle from the widest gap, 0 to 2 pi [rad]

      share = 0.5_wp*(1.0_wp + merge(side, -side, theta < pi))
   end function half_share

   !> Which half of the gap narrows, for half films: the sign of Om, smooth over |w| < 0.01 eps |eps'| or so, since such films jump
   !> there while the journal moves along the line of centres, and a motion would stick in the jump.
   pure real(wp) function narrowing_side(eps, eps_dot, w) result(side)
      real(wp), intent(in) :: eps       !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot   !! its rate [1/s]
      real(wp), intent(in) :: w         !! eps Om [rad/s]

      real(wp), parameter :: part = 1.0e-2_wp  ! of eps eps' over which the sign changes [1]
      real(wp) :: size

      size = sqrt(w*w + (part*eps*eps_dot)**2)
      side = 1.0_wp
      if (size > tiny(1.0_wp)) side = w/size
   end function narrowing_side

   !> Where a pressure that goes with a sin(theta) - b cos(theta) is positive, half the film from theta_1 = atan2(b, a) on, in
   !> Sommerfeld's variable, cos x = (cos theta + eps)/(1 + eps cos theta), sin x = sqrt(q) sin theta/(1 + eps cos theta): the ends
   !> x0 and x1 by their sines and cosines, and their distance x1 - x0, between 0 and 2 pi.
   pure subroutine positive_part(eps, root_q, a, b, sine, cosine, width)
      use kinds, only: pi
      real(wp), intent(in) :: eps        !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: root_q     !! sqrt(1 - eps^2) [1]
      real(wp), intent(in) :: a, b       !! as above, the sum of their squares not zero [any]
      real(wp), intent(out) :: sine(2)   !! (2) sin x0, sin x1 [1]
      real(wp), intent(out) :: cosine(2) !! (2) cos x0, cos x1 [1]
      real(wp), intent(out) :: width     !! x1 - x0 [rad]

      real(wp) :: c, r, s, first, second

      r = 1.0_wp/sqrt(a*a + b*b)
      c = a*r
      s = b*r
      r = 1.0_wp/((1.0_wp + eps*c)*(1.0_wp - eps*c))
      first = (1.0_wp - eps*c)*r
      second = (1.0_wp + eps*c)*r
      sine(1) = root_q*s*first
      sine(2) = -root_q*s*second
      cosine(1) = (eps + c)*first
      cosine(2) = (eps - c)*second
      width = atan2(-2.0_wp*root_q*eps*s, eps*eps*(1.0_wp + s*s) - 1.0_wp)
      if (width <= 0.0_wp) width = width + 2.0_wp*pi
   end subroutine positive_part

end module closed_film
