!> Infinitely short bearing, half film: the pressure of the full film on the half of the gap that narrows.
!>
!> f_r = -1/(2 q^2) [ pi eps' (1 + 2 eps^2)/sqrt(q) + 2 eps |w| ]
!> f_t = sgn(w)/(2 q^2) [ 4 eps eps' + pi/2 |w| sqrt(q) ]
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eqs. (5.3), (5.8), (5.9), which hold for Om >= 0; mirrored at the line of centres for Om < 0,
!> where the other half narrows. `form = book` takes the half from 0 to pi at any Om.
!> Limits: the half is fixed by the sign of Om, not by where the pressure is positive: right for eps' = 0, far off for fast
!> squeezing and suction for fast parting; the force would jump where Om changes its sign while eps' does not vanish, and
!> changes from one side to the other over |w| < 0.01 eps |eps'| instead (`narrowing_side`).
module film_short_gumbel
   use closed_film, only: half_share, narrowing_side, short_film_t, short_shape
   use film_law, only: film_motion_t, n_film_parameter, parameter_length, parameter_radius, squeezing_velocity
   use kind_info, only: add_word, kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_short_gumbel_t

   !> A short bearing, half a film.
   type, extends(short_film_t) :: film_short_gumbel_t
   contains
      procedure, nopass :: info => short_gumbel_info
      procedure :: components => short_gumbel_components
      procedure :: side_flow => short_gumbel_flow
      procedure, nopass :: has_field => short_gumbel_has_field
      procedure :: shape => short_gumbel_shape
   end type film_short_gumbel_t

contains

   !> Description of the kind.
   function short_gumbel_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.short_gumbel"
      info%help = "infinitely short bearing, half film (Gumbel condition)"
      info%source = "Flores et al. (2008), eqs. (5.8), (5.9)"
      call add_word(info, "form", "half film: the converging half, or always from 0 to pi as printed in Flores et al. (2008)", &
                    default="corrected", choices="corrected book")
   end function short_gumbel_info

   !> Components of the force over its scale.
   pure subroutine short_gumbel_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_short_gumbel_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: q, root, side

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      side = 1.0_wp
      if (.not. self%is_book) side = narrowing_side(eps, eps_dot, w)
      f_r = -0.5_wp*(pi*eps_dot*(1.0_wp + 2.0_wp*eps*eps)/root + 2.0_wp*eps*side*w)/(q*q)
      f_t = 0.5_wp*side*(4.0_wp*eps*eps_dot + 0.5_wp*pi*side*w*root)/(q*q)
   end subroutine short_gumbel_components

   !> What leaves at the ends of the half film where the pressure is positive: L R (|v| + |v.t|).
   function short_gumbel_flow(self, motion, parameters) result(flow)
      class(film_short_gumbel_t), intent(in) :: self           !! the film
      type(film_motion_t), intent(in) :: motion                !! motion of the bearing
      real(wp), intent(in) :: parameters(n_film_parameter)     !! (n_film_parameter) from `fit` [any]
      real(wp) :: flow                                         !! volume in a time [m^3/s]

      real(wp) :: across, v(2)

      v = squeezing_velocity(motion)
      across = 0.0_wp
      if (norm2(motion%e) > tiny(1.0_wp)) across = abs(motion%e(1)*v(2) - motion%e(2)*v(1))/norm2(motion%e)
      flow = parameters(parameter_length)*parameters(parameter_radius)*(norm2(v) + across)
   end function short_gumbel_flow

   !> It has pressures.
   pure logical function short_gumbel_has_field() result(has)
      has = .true.
   end function short_gumbel_has_field

   !> The pressure around the bearing.
   pure real(wp) function short_gumbel_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_short_gumbel_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      real(wp) :: side

      side = 1.0_wp
      if (.not. self%is_book) side = narrowing_side(eps, eps_dot, w)
      shape = half_share(side, theta)*short_shape(eps, eps_dot, w, theta)
   end function short_gumbel_shape

end module film_short_gumbel
