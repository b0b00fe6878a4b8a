!> Infinitely short bearing, full film: pressures of both signs count, all round.
!>
!> p = 3 mu/c^2 (L^2/4 - z^2) [ w sin(theta) - 2 eps' cos(theta) ]/(1 + eps cos(theta))^3
!> f_r = -pi eps' (1 + 2 eps^2)/q^(5/2),   f_t = pi w/(2 q^(3/2))
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eqs. (5.3), (5.6), (5.7). Limits: L/D below about 1/2, where the force is still too large; carries
!> tension as well as pressure, so that a load at rest has no damping: the centre whirls.
module film_short_sommerfeld
   use closed_film, only: short_film_t, short_shape
   use film_law, only: n_film_parameter
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_short_sommerfeld_t

   !> A short bearing, full of lubricant all round.
   type, extends(short_film_t) :: film_short_sommerfeld_t
   contains
      procedure, nopass :: info => short_sommerfeld_info
      procedure :: components => short_sommerfeld_components
      procedure, nopass :: has_field => short_sommerfeld_has_field
      procedure :: shape => short_sommerfeld_shape
   end type film_short_sommerfeld_t

contains

   !> Description of the kind.
   function short_sommerfeld_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.short_sommerfeld"
      info%help = "infinitely short bearing, full film (Sommerfeld condition)"
      info%source = "Flores et al. (2008), eqs. (5.6), (5.7)"
      allocate (info%columns(0))
   end function short_sommerfeld_info

   !> Components of the force over its scale.
   pure subroutine short_sommerfeld_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_short_sommerfeld_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: q, root

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      f_r = -pi*eps_dot*(1.0_wp + 2.0_wp*eps*eps)/(q*q*root)
      f_t = 0.5_wp*pi*w/(q*root)
   end subroutine short_sommerfeld_components

   !> It has pressures.
   pure logical function short_sommerfeld_has_field() result(has)
      has = .true.
   end function short_sommerfeld_has_field

   !> The pressure around the bearing.
   pure real(wp) function short_sommerfeld_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_short_sommerfeld_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      shape = short_shape(eps, eps_dot, w, theta)
   end function short_sommerfeld_shape

end module film_short_sommerfeld
