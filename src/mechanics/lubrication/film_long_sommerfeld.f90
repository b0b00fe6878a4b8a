!> Infinitely long bearing, full film: pressures of both signs count, all round.
!>
!> p = 6 mu (R/c)^2 [ w sin(theta) (2 + eps cos(theta))/(s h^2) + eps'/eps (1/h^2 - 1/(1 + eps)^2) ],   h = 1 + eps cos(theta)
!> f_r = -12 pi eps'/q^(3/2),   f_t = 12 pi w/(s sqrt(q)),   s = 2 + eps^2
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eqs. (5.5), (5.10), (5.11). Limits: L/D above about 2, where the force is still too large; carries
!> tension as well as pressure, so that a load at rest has no damping: the centre whirls at about half the speed of the shaft.
module film_long_sommerfeld
   use closed_film, only: long_film_t, long_shape
   use film_law, only: n_film_parameter
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_long_sommerfeld_t

   !> A long bearing, full of lubricant all round.
   type, extends(long_film_t) :: film_long_sommerfeld_t
   contains
      procedure, nopass :: info => long_sommerfeld_info
      procedure :: components => long_sommerfeld_components
      procedure, nopass :: has_field => long_sommerfeld_has_field
      procedure :: shape => long_sommerfeld_shape
   end type film_long_sommerfeld_t

contains

   !> Description of the kind.
   function long_sommerfeld_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.long_sommerfeld"
      info%help = "infinitely long bearing, full film (Sommerfeld condition)"
      info%source = "Flores et al. (2008), eqs. (5.10), (5.11)"
      allocate (info%columns(0))
   end function long_sommerfeld_info

   !> Components of the force over its scale.
   pure subroutine long_sommerfeld_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_long_sommerfeld_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: q, root

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      f_r = -12.0_wp*pi*eps_dot/(q*root)
      f_t = 12.0_wp*pi*w/((2.0_wp + eps*eps)*root)
   end subroutine long_sommerfeld_components

   !> It has pressures.
   pure logical function long_sommerfeld_has_field() result(has)
      has = .true.
   end function long_sommerfeld_has_field

   !> The pressure around the bearing.
   pure real(wp) function long_sommerfeld_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_long_sommerfeld_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      shape = long_shape(eps, eps_dot, w, theta) + eps_dot*(2.0_wp + eps)/(1.0_wp + eps)**2
   end function long_sommerfeld_shape

end module film_long_sommerfeld
