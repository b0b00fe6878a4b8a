!> The contract of film models: the force of a lubricant film on the journal of a bearing.
!>
!> What a film knows of the motion: e, the journal's centre from that of the bearing, and e' , both in the world frame and in the
!> plane across the bearing's axis; sum and difference of the inertial angular speeds w_J and w_B; the angle of the bearing's body,
!> in which grooves are fixed. Reynolds' equation knows less: e and the velocity that squeezes,
!>
!> v = e' - (w_J + w_B)/2 z x e,
!>
!> so that a bearing which turns as a rigid body has no pressure, and no film divides by e. In terms of eps = |e|/c, n = e/|e| and
!> t = z x n: v.n = c eps', v.t = -c eps Om/2 with Om = w_J + w_B - 2 gamma'. A film that is dissipative has F.v <= 0.
!>
!> Signs: forces are those on the journal, world frame; the bearing gets the opposite ones. Moments: `torques`. In space the frame
!> is one of the bearing, its third axis that of the bearing, and a journal may be tilted: see `tilted_force`.
!>
!> An object is one row of a deck table. What depends on the bearing is fitted once to a column of parameters, so that one row
!> serves bearings of different sizes. Beyond eps_max (of the bearing) the film's shape stays that of eps_max: forces are finite at
!> every eccentricity. Source: Flores et al. (2008), chapter 5, with w_J + w_B for its relative speed: measured in the frame of the
!> bearing, gamma' would be another one. Limits: viscosity the same everywhere; `force` is that of parallel axes.
module film_law
   use finite_flow, only: flow_part
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, pi, wp
   implicit none (type, external)
   private
   public :: basic_parameters, film_bearing_t, film_law_t, film_motion_t, film_slopes_t, film_slot_t, gap_at, n_film_parameter
   public :: film_halves, film_torques, max_eccentricity, own_parameters
   public :: squeezing_velocity
   public :: parameter_clearance, parameter_eps_max, parameter_length, parameter_radius, parameter_viscosity

   integer, parameter :: n_film_parameter = 32    !! numbers of a bearing that a film may keep
   integer, parameter :: parameter_radius = 1     !! R, see `film_bearing_t` [m]
   integer, parameter :: parameter_clearance = 2  !! c [m]
   integer, parameter :: parameter_length = 3     !! L [m]
   integer, parameter :: parameter_viscosity = 4  !! mu [Pa.s]
   integer, parameter :: parameter_eps_max = 5    !! eccentricity ratio beyond which the film's shape stays the same [1]
   integer, parameter :: own_parameters = 5       !! numbers that every film has; its own ones follow

   !> A bearing, as films see it.
   type :: film_bearing_t
      real(wp) :: radius = 0.0_wp      !! R: of the journal [m]
      real(wp) :: clearance = 0.0_wp   !! c: radius of the bearing less that of the journal [m]
      real(wp) :: length = 0.0_wp      !! L: along the axis [m]
      real(wp) :: viscosity = 0.0_wp   !! mu: dynamic viscosity [Pa.s]
      real(wp) :: eps_max = 1.0_wp     !! eccentricity ratio beyond which the film's shape stays the same, below 1 [1]
      logical :: is_sphere = .false.   !! a socket with a ball, which has no length
   end type film_bearing_t

   !> What a film knows of the motion of a bearing.
   type :: film_motion_t
      real(wp) :: e(2) = 0.0_wp            !! (2) centre of the journal from that of the bearing, world frame [m]
      real(wp) :: e_dot(2) = 0.0_wp        !! (2) its rate, world frame [m/s]
      real(wp) :: speed_sum = 0.0_wp       !! w_J + w_B: inertial angular speeds of the bodies of journal and bearing [rad/s]
      real(wp) :: speed_difference = 0.0_wp !! w_J - w_B [rad/s]
      real(wp) :: angle = 0.0_wp           !! of the bearing's body [rad]
      real(wp) :: tilt(2) = 0.0_wp         !! (2) g: what a tilt of the journal adds to e at the end y = 1 [m]
      real(wp) :: tilt_dot(2) = 0.0_wp     !! (2) its rate, as e_dot that of e [m/s]
      real(wp) :: engaged = 1.0_wp         !! part of the film's length that the journal is in [1]
   end type film_motion_t

   !> How the force changes with a small motion of the journal: F = F_0 - K de - B de'.
   type :: film_slopes_t
      real(wp) :: stiffness(2, 2) = 0.0_wp  !! (2, 2) K: component of the force, of the eccentricity; world frame [N/m]
      real(wp) :: damping(2, 2) = 0.0_wp    !! (2, 2) B: component of the force, of the rate; world frame [N.s/m]
      real(wp) :: error = 0.0_wp            !! of the maximum entry of each, as a part of it [1]
   end type film_slopes_t

   !> One row of a table of films.
   type, abstract :: film_law_t
      character(:), allocatable :: name  !! name of the row
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(fit_interface), deferred :: fit
      procedure(force_interface), deferred :: force
      procedure, non_overridable :: force_of_one
      procedure :: tilted_force => film_tilted_force
      procedure :: halves => film_halves
      procedure, nopass :: is_of_sphere => film_false
      procedure, nopass :: knows_tilt => film_false
      procedure :: torques => film_torques
      procedure :: side_flow => film_side_flow
      procedure :: linearise => film_linearise
      procedure, nopass :: has_field => film_false
      procedure :: has_bore => film_has_no_bore
      procedure :: min_thickness => film_min_thickness
      procedure :: field => film_field
      procedure :: mistake => film_mistake
      procedure :: description => film_description
   end type film_law_t

   !> A place for a film of any kind.
   type :: film_slot_t
      class(film_law_t), allocatable :: law  !! the film
   end type film_slot_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and columns
      end function info_interface

      !> Take the parameters from a row of the kind's table.
      subroutine prepare_interface(self, item)
         import :: film_law_t, item_t
         implicit none (type, external)
         class(film_law_t), intent(inout) :: self  !! the film
         type(item_t), intent(in) :: item          !! the row
      end subroutine prepare_interface

      !> Parameters of the film in a bearing, or what is wrong with the bearing: the deck's reader asks this first.
      subroutine fit_interface(self, bearing, parameters, message, help)
         import :: film_bearing_t, film_law_t, n_film_parameter, wp
         implicit none (type, external)
         class(film_law_t), intent(in) :: self                  !! the film
         type(film_bearing_t), intent(in) :: bearing            !! the bearing
         real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) `basic_parameters`, then the film's own [any]
         character(:), allocatable, intent(out) :: message      !! what is wrong, empty: the film fits
         character(:), allocatable, intent(out) :: help         !! what would be right
      end subroutine fit_interface

      !> Forces of n bearings. Finite at any motion: e = 0, e' = 0 and no speed too. No allocation. Not pure: a film on a grid has
      !> a workspace, of which the forces do not depend.
      subroutine force_interface(self, n, motion, parameters, f)
         import :: film_law_t, film_motion_t, n_film_parameter, wp
         implicit none (type, external)
         class(film_law_t), intent(in) :: self                       !! the film
         integer, intent(in) :: n                                    !! number of bearings
         type(film_motion_t), intent(in) :: motion(n)                !! (n) their motion
         real(wp), intent(in) :: parameters(n_film_parameter, n)     !! (n_film_parameter, n) from `fit` [any]
         real(wp), intent(out) :: f(2, n)                            !! (2, n) forces on the journals, world frame [N]
      end subroutine force_interface
   end interface

   interface
      !> Force of one bearing whose journal is tilted, e(y) = e + y g between the ends y = -1 and 1, and its first moment over half
      !> the length, f_1: that about the middle is (L/2) f_1. Of a film that knows aligned journals only: two aligned halves,
      !>
      !> F = (F_+ + F_-)/2,   f_1 = b (F_+ - F_-)/2,   F_+ at e + a g, v + b w,   F_- at e - a g, v - b w,
      !> w = g' - (w_J + w_B)/2 z x g
      !>
      !> with a and b of `halves`. So F.v + f_1.w <= 0 wherever that holds for each half. Source: own derivation; long films: Gauss'
      !> rule of two points. Limits: tilts that are small beside the gap that is left, see
      !> docs/theory/evidence/films.md; a film that knows better overrides this.
      module subroutine film_tilted_force(self, motion, parameters, f, f_1)
         implicit none (type, external)
         class(film_law_t), intent(in) :: self                 !! the film
         type(film_motion_t), intent(in) :: motion             !! motion of the bearing
         real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
         real(wp), intent(out) :: f(2)                         !! (2) force on the journal, frame of the motion [N]
         real(wp), intent(out) :: f_1(2)                       !! (2) its moment along the axis, over half the length [N]
      end subroutine film_tilted_force

      !> Where the aligned halves of a film of finite length are that stand for a tilted one: from the middle, over half the length.
      !>
      !> b^2 = [1/3 - (x coth(x) - 1)/x^2]/[1 - tanh(x)/x],   x = L/D,   a = b [2 - (b^2 - 1/15)/(4/15)]
      !>
      !> b is exact where the journal is in the middle; between short films (b^2 = 1/15, a = 2 b) and long ones (b^2 = 1/3,
      !> a = b), where both are exact to first order of the tilt, a goes with b^2.
      module subroutine film_halves(self, parameters, of_tilt, of_rate)
         implicit none (type, external)
         class(film_law_t), intent(in) :: self                 !! the film
         real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
         real(wp), intent(out) :: of_tilt                      !! a [1]
         real(wp), intent(out) :: of_rate                      !! b [1]
      end subroutine film_halves

      !> Stiffness and damping at a motion, by differences of fourth order of the force; a film that knows them overrides this.
      !>
      !> Steps are 1/1000 and 1/2000 of what is left of the gap, and of the speed at which its surface would be squeezed away; the
      !> results are those of the shorter ones, their error is reported by what both differ by. Where nothing moves the speed is
      !> c/s: films that rupture have no derivative there, and the mean of both senses is given. Source: A. Iserles, A First Course
      !> in the Numerical Analysis of Differential Equations (2009), section 8.1.
      module subroutine film_linearise(self, motion, parameters, slopes)
         implicit none (type, external)
         class(film_law_t), intent(in) :: self                    !! the film
         type(film_motion_t), intent(in) :: motion                !! motion of the bearing
         real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
         type(film_slopes_t), intent(out) :: slopes               !! stiffness and damping
      end subroutine film_linearise
   end interface

contains

   !> The force of one bearing, tilted or not.
   subroutine force_of_one(self, motion, parameters, f, f_1)
      class(film_law_t), intent(in) :: self                 !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: f(2)                         !! (2) force on the journal, frame of the motion [N]
      real(wp), intent(out) :: f_1(2)                       !! (2) its moment along the axis, over half the length [N]

      real(wp) :: one(2, 1)

      if (any(abs([motion%tilt, motion%tilt_dot]) > 0.0_wp)) then
         call self%tilted_force(motion, parameters, f, f_1)
      else
         call self%force(1, [motion], reshape(parameters, [n_film_parameter, 1]), one)
         f = one(:, 1)
         f_1 = 0.0_wp
      end if
   end subroutine force_of_one

   !> Eccentricity of the journal at the end where it is greater.
   pure real(wp) function max_eccentricity(motion) result(distance)
      type(film_motion_t), intent(in) :: motion  !! motion of the bearing

      distance = max(norm2(motion%e + motion%tilt), norm2(motion%e - motion%tilt))
   end function max_eccentricity

   !> Whether the film is that of a ball in a socket, whether its `tilted_force` is right for any tilt, whether it has
   !> pressures that `field` gives, not only a force: one for which that holds overrides this.
   pure logical function film_false()
      film_false = .false.
   end function film_false

   !> Whether the bore of the bearing is not round.
   pure logical function film_has_no_bore(self)
      class(film_law_t), intent(in) :: self  !! the film

      film_has_no_bore = .false.
   end function film_has_no_bore

   !> Minimum thickness of the film of one bearing, not below zero. A film that knows its bore overrides this.
   pure real(wp) function film_min_thickness(self, clearance, motion, parameters) result(thickness)
      class(film_law_t), intent(in) :: self                 !! the film
      real(wp), intent(in) :: clearance                     !! of the surfaces [m]
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]

      thickness = max(clearance - max_eccentricity(motion), 0.0_wp)
   end function film_min_thickness

   !> The parameters that every film has; the others are zero.
   pure subroutine basic_parameters(bearing, parameters)
      type(film_bearing_t), intent(in) :: bearing            !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]

      parameters = 0.0_wp
      parameters(parameter_radius) = bearing%radius
      parameters(parameter_clearance) = bearing%clearance
      parameters(parameter_length) = bearing%length
      parameters(parameter_viscosity) = bearing%viscosity
      parameters(parameter_eps_max) = bearing%eps_max
   end subroutine basic_parameters

   !> Moments of the shear in the film of one bearing, about the centres of journal and bearing, where the forces F and -F act:
   !>
   !> T_J = -2 pi mu L R^3 (w_J - w_B)/(c sqrt(1 - eps^2)) - (e x F)_z/2
   !> T_B = +2 pi mu L R^3 (w_J - w_B)/(c sqrt(1 - eps^2)) - (e x F)_z/2
   !>
   !> so that T_J + T_B + (e x F)_z = 0, and with the forces the film takes 2 pi mu L R^3 (w_J - w_B)^2/(c sqrt(1 - eps^2)) - F.v.
   !> Exact for a long film all round: shear of both walls, of the drag and of the flow that pressure drives. Of the other films: a
   !> journal that is wetted all round. A film that knows better overrides this; so it is not pure, as `force`.
   subroutine film_torques(self, motion, parameters, f, t_j, t_b)
      class(film_law_t), intent(in) :: self                    !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: f(2)                             !! (2) force on the journal, world frame [N]
      real(wp), intent(out) :: t_j                             !! moment on the journal [N.m]
      real(wp), intent(out) :: t_b                             !! moment on the bearing [N.m]

      real(wp) :: drag, eps, half

      associate (c => parameters(parameter_clearance))
         eps = min(hypot(motion%e(1), motion%e(2))/c, parameters(parameter_eps_max))
         drag = 2.0_wp*pi*parameters(parameter_viscosity)*parameters(parameter_length)*parameters(parameter_radius)**3/c &
                *motion%speed_difference/sqrt((1.0_wp - eps)*(1.0_wp + eps))
      end associate
      half = 0.5_wp*(motion%e(1)*f(2) - motion%e(2)*f(1))
      t_j = -drag - half
      t_b = drag - half
   end subroutine film_torques

   !> What leaves at both ends of one bearing: that of a bearing of its length whose pressures are not below zero (`finite_flow`),
   !> whatever the film itself takes the ends for. A film that knows its own overrides this.
   function film_side_flow(self, motion, parameters) result(flow)
      class(film_law_t), intent(in) :: self                    !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      real(wp) :: flow                                         !! volume in a time [m^3/s]

      real(wp) :: e(2), speed, v(2)

      flow = 0.0_wp
      v = squeezing_velocity(motion)
      speed = norm2(v)
      if (.not. speed > 0.0_wp) return
      associate (radius => parameters(parameter_radius), length => parameters(parameter_length))
         e = motion%e/parameters(parameter_clearance)
         e = e*(min(norm2(e), parameters(parameter_eps_max))/max(norm2(e), tiny(1.0_wp)))
         flow = 2.0_wp*length*radius*speed*flow_part(0.5_wp*length/radius, norm2(e), dot_product(e, v)/speed)
      end associate
   end function film_side_flow

   !> The velocity that squeezes, v.
   pure function squeezing_velocity(motion) result(v)
      type(film_motion_t), intent(in) :: motion  !! motion of a bearing
      real(wp) :: v(2)                           !! (2) v, world frame [m/s]

      v = motion%e_dot - 0.5_wp*motion%speed_sum*[-motion%e(2), motion%e(1)]
   end function squeezing_velocity

   !> Pressure and gap of one bearing at places of one's own. A film without pressures gives the gap, and pressures that are no
   !> numbers. Not pure, as `force`.
   subroutine film_field(self, motion, parameters, theta, y, p, h)
      class(film_law_t), intent(in) :: self                 !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: theta(:)                      !! (n) angles, frame of the bearing's body [rad]
      real(wp), intent(in) :: y(:)                          !! (m) places along the axis, from -1 at one end to 1 at the other [1]
      real(wp), intent(out) :: p(:, :)                      !! (m, n) pressures [Pa]
      real(wp), intent(out) :: h(:, :)                      !! (m, n) gaps [m]

      integer :: j, k

      do k = 1, size(theta)
         do j = 1, size(y)
            p(j, k) = not_a_number()
            h(j, k) = gap_at(motion, parameters, theta(k))
         end do
      end do
   end subroutine film_field

   !> The gap of an aligned journal at an angle in the frame of the bearing's body; beyond eps_max that of eps_max.
   pure real(wp) function gap_at(motion, parameters, theta) result(h)
      type(film_motion_t), intent(in) :: motion             !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(in) :: theta                         !! the angle [rad]

      real(wp) :: distance, e(2), longest

      distance = hypot(motion%e(1), motion%e(2))
      longest = parameters(parameter_eps_max)*parameters(parameter_clearance)
      e = motion%e
      if (distance > longest) e = e*(longest/distance)
      h = parameters(parameter_clearance) - e(1)*cos(theta + motion%angle) - e(2)*sin(theta + motion%angle)
   end function gap_at

   !> What is wrong with the row as a whole, empty if nothing is; a film with such rules overrides this.
   function film_mistake(self) result(message)
      class(film_law_t), intent(in) :: self  !! the film
      character(:), allocatable :: message   !! one line, empty: all is well

      message = repeat("", len(self%name))
   end function film_mistake

   !> The parameters of a bearing as text, for `gudgeon explain`; blank: nothing beyond the bearing itself.
   function film_description(self, parameters) result(words)
      class(film_law_t), intent(in) :: self                 !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      character(:), allocatable :: words                    !! as "supplied at 2 bar"

      words = repeat("", len(self%name) + size(parameters))
   end function film_description

end module film_law
