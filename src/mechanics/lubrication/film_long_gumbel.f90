!> Infinitely long bearing, half film: no pressure at the widest and the narrowest gap, a film on the half that narrows.
!>
!> f_r = -12 [ eps |w|/(s q) + eps'/q^(3/2) (pi/2 - 8/(pi s)) ],   s = 2 + eps^2
!> f_t = 12 sgn(w) [ pi |w|/(2 s sqrt(q)) + 2 eps eps'/(s q) ]
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eqs. (5.12), (5.13): Reynolds' equation with p(0) = p(pi) = 0, for Om >= 0; mirrored at the line of
!> centres for Om < 0, where the other half narrows. `form = book` takes the half from 0 to pi at any Om.
!> Limits: the half is fixed by the sign of Om, not by where the pressure is positive: right for eps' = 0, far off for fast
!> squeezing and suction for fast parting; the force would jump where Om changes its sign while eps' does not vanish, and
!> changes from one side to the other over |w| < 0.01 eps |eps'| instead (`narrowing_side`).
!> It depends on the direction of n even for e -> 0, where that is no direction: its damping is 3.57 along n and 18.85 across.
module film_long_gumbel
   use closed_film, only: half_share, long_film_t, long_shape, narrowing_side
   use film_law, only: n_film_parameter
   use kind_info, only: add_word, kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_long_gumbel_t

   !> A long bearing, half a film.
   type, extends(long_film_t) :: film_long_gumbel_t
   contains
      procedure, nopass :: info => long_gumbel_info
      procedure :: components => long_gumbel_components
      procedure, nopass :: has_field => long_gumbel_has_field
      procedure :: shape => long_gumbel_shape
   end type film_long_gumbel_t

contains

   !> Description of the kind.
   function long_gumbel_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.long_gumbel"
      info%help = "infinitely long bearing, half film (Gumbel condition)"
      info%source = "Flores et al. (2008), eqs. (5.12), (5.13)"
      call add_word(info, "form", "half film: the converging half, or always from 0 to pi as printed in Flores et al. (2008)", &
                    default="corrected", choices="corrected book")
   end function long_gumbel_info

   !> Components of the force over its scale.
   pure subroutine long_gumbel_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_long_gumbel_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: q, root, s, side

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      s = 2.0_wp + eps*eps
      side = 1.0_wp
      if (.not. self%is_book) side = narrowing_side(eps, eps_dot, w)
      f_r = -12.0_wp*(eps*side*w/(s*q) + eps_dot/(q*root)*(0.5_wp*pi - 8.0_wp/(pi*s)))
      f_t = 12.0_wp*side*(0.5_wp*pi*side*w/(s*root) + 2.0_wp*eps*eps_dot/(s*q))
   end subroutine long_gumbel_components

   !> It has pressures.
   pure logical function long_gumbel_has_field() result(has)
      has = .true.
   end function long_gumbel_has_field

   !> The pressure around the bearing.
   pure real(wp) function long_gumbel_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_long_gumbel_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      real(wp) :: mirrored, q, side, x

      side = 1.0_wp
      if (.not. self%is_book) side = narrowing_side(eps, eps_dot, w)
      q = (1.0_wp - eps)*(1.0_wp + eps)
      mirrored = min(theta, 2.0_wp*pi - theta)
      x = atan2(sqrt(q)*sin(mirrored), eps + cos(mirrored))
      shape = long_shape(eps, eps_dot, w, theta) + eps_dot*((2.0_wp + eps)/(1.0_wp + eps)**2 - 8.0_wp/(pi*(2.0_wp + eps*eps)*q**2) &
              *((1.0_wp + 0.5_wp*eps*eps)*x - 2.0_wp*eps*sin(x) + 0.25_wp*eps*eps*sin(2.0_wp*x)))
      shape = half_share(side, theta)*shape
   end function long_gumbel_shape

end module film_long_gumbel
