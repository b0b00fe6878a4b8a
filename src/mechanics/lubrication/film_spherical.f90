!> Film of a ball in a socket that surrounds it on all sides: squeeze, and what rotation entrains.
!>
!> Gap h = c (1 - eps cos(a)), a from the line of centres; with n the direction from the centre of the socket and v = e' - (w_J +
!> w_B)/2 x e, as body frames that turn with the mean angular velocity see it, Reynolds' equation on the sphere is div(h^3 grad p) =
!> -12 mu R^2 v.n, and its solution
!>
!> p = 12 mu (R^2/c^3) (2 - eps cos(a))/(1 - eps cos(a))^2 [ v_r cos(a)/4 + v_t sin(a) cos(b)/(4 + eps^2) ]
!>
!> with b about the line of centres from v_t, the part of v across it. p is zero on the plane through the centre that is across
!> (v_r/4, v_t/(4 + eps^2)): `pressure = positive` counts the half where it is positive, `full` both. In parts of mu R^4/c^2 and
!> with eps' = v_r/c, w = -2 v_t/c, q = 1 - eps^2:
!>
!> full       f_r = -12 pi eps' [eps/q - artanh(eps)]/eps^3,   f_t = 12 pi w/(4 + eps^2) [(1 + eps^2) artanh(eps) - eps]/eps^3
!> positive   an integral over cos(a), or over the logarithm of the gap where eps > 0.3, by Gauss' rule; exact to 1e-6
!>
!> Signs: on the ball, n from the socket's centre to the ball's. Moments of shear about the centres: `sphere_shear`.
!> Source: own derivation from Reynolds (1886); without rotation as O. Pinkus & B. Sternlicht, Theory of Hydrodynamic Lubrication
!> (1961), have squeezed spheres. Limits: the socket is a whole sphere without openings, so that a full film could have any pressure
!> added, and nothing flows out; h much less than R; isoviscous.
module film_spherical
   use closed_film, only: closed_film_t
   use film_law, only: basic_parameters, film_bearing_t, film_motion_t, n_film_parameter, own_parameters
   use item, only: item_t
   use kind_info, only: add_word, in_space, kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_spherical_t, sphere_shear

   integer, parameter :: parameter_scale = own_parameters + 1  !! as that of `closed_film`: mu R^4/c^2 [N.s]
   real(wp), parameter :: small = 0.05_wp                      !! eps below which brackets are series [1]
   real(wp), parameter :: by_logarithm = 0.3_wp                !! eps above which the integral is one over the gap's logarithm [1]
   integer, parameter :: n_gauss = 16                          !! points of a rule

   !> Half of Gauss' rule of 16 points on (-1, 1). Source: M. Abramowitz & I. A. Stegun (1964), table 25.4.
   real(wp), parameter :: half_place(8) = [0.095012509837637440185_wp, 0.281603550779258913230_wp, 0.458016777657227386342_wp, &
                                           0.617876244402643748447_wp, 0.755404408355003033895_wp, 0.865631202387831743880_wp, &
                                           0.944575023073232576078_wp, 0.989400934991649932596_wp]
   real(wp), parameter :: half_weight(8) = [0.189450610455068496285_wp, 0.182603415044923588867_wp, 0.169156519395002538189_wp, &
                                            0.149595988816576732081_wp, 0.124628971255533872052_wp, 0.095158511682492784810_wp, &
                                            0.062253523938647892863_wp, 0.027152459411754094852_wp]
   real(wp), parameter :: places(n_gauss) = [-half_place(8:1:-1), half_place]      !! the whole rule [1]
   real(wp), parameter :: weights(n_gauss) = [half_weight(8:1:-1), half_weight]    !! the whole rule [1]

   !> A ball in a socket.
   type, extends(closed_film_t) :: film_spherical_t
      logical :: is_positive = .true.  !! only pressures above zero count
   contains
      procedure, nopass :: info => spherical_info
      procedure, nopass :: is_of_sphere => spherical_is_of_sphere
      procedure :: prepare => spherical_prepare
      procedure :: fit => spherical_fit
      procedure :: components => spherical_components
      procedure :: side_flow => spherical_side_flow
   end type film_spherical_t

contains

   !> Description of the kind.
   function spherical_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.spherical"
      info%space = in_space
      info%help = "film all round a ball in a socket: squeeze and entrainment by rotation"
      info%source = "Reynolds (1886), solved for the gap of two spheres"
      call add_word(info, "pressure", "only positive pressure, or both signs", default="positive", &
                    choices="positive full")
   end function spherical_info

   !> It is.
   pure logical function spherical_is_of_sphere() result(is)
      is = .true.
   end function spherical_is_of_sphere

   !> Take which pressures count.
   subroutine spherical_prepare(self, item)
      class(film_spherical_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item                !! the row

      self%name = item%name
      self%is_positive = item%word("pressure") == "positive"
   end subroutine spherical_prepare

   !> Parameters of a ball.
   subroutine spherical_fit(self, bearing, parameters, message, help)
      class(film_spherical_t), intent(in) :: self            !! the film
      type(film_bearing_t), intent(in) :: bearing            !! the socket, whose length does not count
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message      !! empty: any ball will do
      character(:), allocatable, intent(out) :: help         !! empty

      message = ""
      help = ""
      call basic_parameters(bearing, parameters)
      parameters(parameter_scale) = bearing%viscosity*bearing%radius**4/bearing%clearance**2
   end subroutine spherical_fit

   !> Components of the force over its scale.
   pure subroutine spherical_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_spherical_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the ball [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! -2 v_t/c [1/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: along, across

      if (self%is_positive) then
         call press_half(eps, 0.25_wp*eps_dot, 0.5_wp*abs(w)/(4.0_wp + eps**2), along, across)
         f_r = -12.0_wp*along
         f_t = sign(12.0_wp*across, w)
      else
         call full_brackets(eps, along, across)
         f_r = -12.0_wp*pi*eps_dot*along
         f_t = 12.0_wp*pi*w/(4.0_wp + eps**2)*across
      end if
   end subroutine spherical_components

   !> [eps/q - artanh(eps)]/eps^3 and [(1 + eps^2) artanh(eps) - eps]/eps^3.
   pure subroutine full_brackets(eps, along, across)
      real(wp), intent(in) :: eps      !! eccentricity ratio [1]
      real(wp), intent(out) :: along   !! the first [1]
      real(wp), intent(out) :: across  !! the second [1]

      real(wp) :: power
      integer :: k

      if (eps < small) then
         along = 0.0_wp
         across = 0.0_wp
         power = 1.0_wp
         do k = 1, 6  ! eps^(2k - 2): of eps/q it is 1, of artanh(eps) 1/(2k + 1)
            along = along + power*2*k/(2*k + 1)
            across = across + power*(1.0_wp/(2*k + 1) + 1.0_wp/(2*k - 1))
            power = power*eps**2
         end do
      else
         along = (eps/((1.0_wp - eps)*(1.0_wp + eps)) - atanh(eps))/eps**3
         across = ((1.0_wp + eps**2)*atanh(eps) - eps)/eps**3
      end if
   end subroutine full_brackets

   !> Integrals of (2 - eps x)/(1 - eps x)^2 (m.n) n over the half sphere m.n > 0, x = n_1, along the first axis and the second.
   !> A circle x = constant between both cuts is cut by the plane m.n = 0, beyond them it lies on one side of it.
   pure subroutine press_half(eps, m_1, m_2, along, across)
      real(wp), intent(in) :: eps      !! eccentricity ratio [1]
      real(wp), intent(in) :: m_1      !! of m along the first axis [1/s]
      real(wp), intent(in) :: m_2      !! of m along the second axis, not below zero [1/s]
      real(wp), intent(out) :: along   !! along the first axis [1/s]
      real(wp), intent(out) :: across  !! along the second axis [1/s]

      real(wp) :: cut(2), ends(2), half, size_of_m
      integer :: k

      along = 0.0_wp
      across = 0.0_wp
      size_of_m = sqrt(m_1**2 + m_2**2)
      if (.not. size_of_m > 0.0_wp) return
      cut = [coordinate_of(eps, -m_2/size_of_m), coordinate_of(eps, m_2/size_of_m)]
      half = 0.5_wp*(cut(2) - cut(1))
      do k = 1, n_gauss  ! sin(angle) takes the roots at both ends away
         associate (angle => 0.5_wp*pi*places(k))
            call add_circle(eps, m_1, m_2, .true., 0.5_wp*(cut(1) + cut(2)) + half*sin(angle), &
                            0.5_wp*pi*half*cos(angle)*weights(k), along, across)
         end associate
      end do
      if (.not. abs(m_1) > 0.0_wp) return
      ends = [coordinate_of(eps, -1.0_wp), cut(1)]
      if (m_1 > 0.0_wp) ends = [cut(2), coordinate_of(eps, 1.0_wp)]
      half = 0.5_wp*(ends(2) - ends(1))
      do k = 1, n_gauss
         call add_circle(eps, m_1, m_2, .false., 0.5_wp*sum(ends) + half*places(k), half*weights(k), along, across)
      end do
   end subroutine press_half

   !> The coordinate of the integral: x, or less the logarithm of the gap.
   pure real(wp) function coordinate_of(eps, x) result(u)
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: x    !! cosine of the angle from the line of centres [1]

      u = x
      if (eps > by_logarithm) u = -log(1.0_wp - eps*x)
   end function coordinate_of

   !> Add a circle, the part of it where m.n > 0 or all of it.
   pure subroutine add_circle(eps, m_1, m_2, is_cut, u, weight, along, across)
      real(wp), intent(in) :: eps          !! eccentricity ratio [1]
      real(wp), intent(in) :: m_1, m_2     !! m along both axes [1/s]
      logical, intent(in) :: is_cut        !! a part of it
      real(wp), intent(in) :: u            !! which circle, see `coordinate_of` [1]
      real(wp), intent(in) :: weight       !! d(u) [1]
      real(wp), intent(inout) :: along     !! added to [1/s]
      real(wp), intent(inout) :: across    !! added to [1/s]

      real(wp) :: angle, cosine, gap, part, root, sine, x

      if (eps > by_logarithm) then
         gap = exp(-u)
         x = (1.0_wp - gap)/eps
         part = weight*(1.0_wp + gap)/(eps*gap)
      else
         x = u
         gap = 1.0_wp - eps*x
         part = weight*(1.0_wp + gap)/gap**2
      end if
      root = sqrt(max((1.0_wp - x)*(1.0_wp + x), 0.0_wp))
      angle = pi
      sine = 0.0_wp
      cosine = -1.0_wp
      if (is_cut) then
         cosine = min(max(-m_1*x/max(m_2*root, tiny(1.0_wp)), -1.0_wp), 1.0_wp)
         angle = acos(cosine)
         sine = sqrt((1.0_wp - cosine)*(1.0_wp + cosine))
      end if
      along = along + 2.0_wp*part*x*(m_1*x*angle + m_2*root*sine)
      across = across + part*root*(2.0_wp*m_1*x*sine + m_2*root*(angle + sine*cosine))
   end subroutine add_circle

   !> Nothing leaves a socket all round.
   function spherical_side_flow(self, motion, parameters) result(flow)
      class(film_spherical_t), intent(in) :: self           !! the film
      type(film_motion_t), intent(in) :: motion             !! motion of the ball
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp) :: flow                                      !! zero [m^3/s]

      flow = 0.0_wp
   end function spherical_side_flow

   !> Moment of the shear on a ball about its centre, but for what the pressure drives, -(e x F)/2: -(mu R^4/c) times
   !>
   !> about n   (I_0 - I_2) w_n,   across it   (I_0 + I_2)/2 w_t,   I_0 = 4 pi artanh(eps)/eps,
   !> I_2 = 4 pi [artanh(eps) - eps]/eps^3
   !>
   !> of the angular velocity w of the ball against the socket: a film all round.
   pure subroutine sphere_shear(eps, about, across)
      real(wp), intent(in) :: eps      !! eccentricity ratio [1]
      real(wp), intent(out) :: about   !! factor about the line of centres [1]
      real(wp), intent(out) :: across  !! factor across it [1]

      real(wp) :: i_0, i_2

      if (eps < small) then
         i_0 = 4.0_wp*pi*(1.0_wp + eps**2*(1.0_wp/3.0_wp + eps**2*(1.0_wp/5.0_wp + eps**2*(1.0_wp/7.0_wp + eps**2/9.0_wp))))
         i_2 = 4.0_wp*pi*(1.0_wp/3.0_wp + eps**2*(1.0_wp/5.0_wp + eps**2*(1.0_wp/7.0_wp + eps**2*(1.0_wp/9.0_wp + eps**2/11.0_wp))))
      else
         i_0 = 4.0_wp*pi*atanh(eps)/eps
         i_2 = 4.0_wp*pi*(atanh(eps) - eps)/eps**3
      end if
      about = i_0 - i_2
      across = 0.5_wp*(i_0 + i_2)
   end subroutine sphere_shear

end module film_spherical
