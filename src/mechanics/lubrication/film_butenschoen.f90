!> Butenschoen: bearings of finite length, a closed approximation; rotation and squeeze are added up.
!>
!> So_D = b^2 eps/(2 q^2) sqrt(pi^2 q + 16 eps^2) a1 (eps - 1)/(a2 + eps),   q = 1 - eps^2,   b = L/D
!> beta = (c1 + c2 eps + c3 eps^2 + c4 eps^3 + c5 eps^4) atan( pi sqrt(q)/(2 eps) )
!> So_V = 4 b^2/q^(5/2) [ (pi/2 - acos(x)/2)(1 + 2 eps^2) + 3/2 x sqrt(q) ] b1 (1 - x)/(-b2 - x),   x = eps sgn(eps')
!> f_r = -2 So_D |Om| cos(beta) - 2 So_V eps',   f_t = 2 So_D Om sin(beta)
!>
!> with So = F (c/R)^2/(L D mu |Om|), or |eps'| for |Om|, and the scale mu L R^3/c^2; a, b1, b2 and c are polynomials of b.
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n. Only w = eps Om is needed: So_D/eps is regular.
!> Source: H.-J. Butenschoen, Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter instationaerer Belastung,
!> dissertation, Karlsruhe (1976); all coefficients as the module hydrodynamic_plain_bearing of MBDyn (R. Resch, 2011) has them.
!> Limits: L/D from 1/8 to 1, eps to 0.95, within 6 % of his own tables and 2.5 degrees; where L/D
!> is greater or smaller the polynomials have the nearer of these, which is too small a force above 1. No pressure at the widest
!> gap while it turns. Forces of rotation and squeeze are no sum: where the journal parts fast, the film may feed energy in.
module film_butenschoen
   use closed_film, only: fit_long, long_film_t
   use film_law, only: film_bearing_t, film_halves, n_film_parameter, own_parameters
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: film_butenschoen_t

   real(wp), parameter :: shortest = 0.125_wp  !! minimum L/D of the polynomials [1]
   real(wp), parameter :: longest = 1.0_wp     !! maximum L/D of them [1]

   integer, parameter :: first_own = own_parameters + 2  !! after the scale: b, then the values of the polynomials

   real(wp), parameter :: a1(0:4) = [1.1642_wp, -1.9456_wp, 7.1161_wp, -10.1073_wp, 5.0141_wp]
   real(wp), parameter :: a2(0:4) = [-1.000026_wp, -0.023634_wp, -0.4215_wp, -0.038817_wp, -0.090551_wp]
   real(wp), parameter :: b1(0:4) = [0.70038_wp, 3.2415_wp, -12.2486_wp, 18.895_wp, -9.3561_wp]
   real(wp), parameter :: b2(0:4) = [-0.999935_wp, 0.0157434_wp, -0.74224_wp, 0.42278_wp, -0.368928_wp]
   real(wp), parameter :: turn(0:1, 5) = reshape([1.152624_wp, -0.104565_wp, -2.5905_wp, 0.798745_wp, 8.73393_wp, -2.3291_wp, &
                                                  -13.3414_wp, 3.424337_wp, 6.6294_wp, -1.591732_wp], [2, 5])
      !! coefficients of powers of b: of a1, a2, b1, b2 above and of c1 to c5 here [1]

   !> A bearing of finite length.
   type, extends(long_film_t) :: film_butenschoen_t
   contains
      procedure, nopass :: info => butenschoen_info
      procedure :: fit => butenschoen_fit
      procedure :: components => butenschoen_components
      procedure :: halves => butenschoen_halves
      procedure :: description => butenschoen_description
   end type film_butenschoen_t

contains

   !> Description of the kind.
   function butenschoen_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.butenschoen"
      info%help = "bearing of finite length, closed approximation of rotation and squeeze for L/D from 1/8 to 1"
      info%source = "Butenschoen (1976)"
      allocate (info%columns(0))
   end function butenschoen_info

   !> Tilted: as any film of finite length.
   subroutine butenschoen_halves(self, parameters, of_tilt, of_rate)
      class(film_butenschoen_t), intent(in) :: self         !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      real(wp), intent(out) :: of_tilt                      !! see `film_halves` [1]
      real(wp), intent(out) :: of_rate                      !! see `film_halves` [1]

      call film_halves(self, parameters, of_tilt, of_rate)
   end subroutine butenschoen_halves

   !> Parameters for a bearing.
   subroutine butenschoen_fit(self, bearing, parameters, message, help)
      class(film_butenschoen_t), intent(in) :: self  !! the film
      type(film_bearing_t), intent(in) :: bearing  !! the bearing
      real(wp), intent(out) :: parameters(n_film_parameter)  !! (n_film_parameter) parameters [any]
      character(:), allocatable, intent(out) :: message  !! empty: any bearing will do
      character(:), allocatable, intent(out) :: help  !! empty

      real(wp) :: b, powers(0:4)
      integer :: k

      call fit_long(self, bearing, parameters, message, help)
      b = 0.5_wp*bearing%length/bearing%radius
      parameters(first_own) = b
      b = min(max(b, shortest), longest)
      powers = [(b**k, k=0, 4)]
      parameters(first_own + 1:first_own + 4) = [sum(a1*powers), sum(a2*powers), sum(b1*powers), sum(b2*powers)]
      parameters(first_own + 5:first_own + 9) = turn(0, :) + turn(1, :)*b
   end subroutine butenschoen_fit

   !> Components of the force over its scale.
   pure subroutine butenschoen_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_butenschoen_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: beta, q, rotation, root, squeeze, x

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      x = sign(eps, eps_dot)
      associate (b => parameters(first_own), p => parameters(first_own + 1:first_own + 4), &
                 c => parameters(first_own + 5:first_own + 9))
         rotation = b*b*sqrt(pi*pi*q + 16.0_wp*eps*eps)/(q*q)*p(1)*(eps - 1.0_wp)/(p(2) + eps)
         beta = (c(1) + eps*(c(2) + eps*(c(3) + eps*(c(4) + eps*c(5)))))*atan2(pi*root, 2.0_wp*eps)
         squeeze = 8.0_wp*b*b/(q*q*root)*((0.5_wp*pi - 0.5_wp*acos(x))*(1.0_wp + 2.0_wp*eps*eps) + 1.5_wp*x*root) &
                   *p(3)*(1.0_wp - x)/(-p(4) - x)
      end associate
      f_r = -rotation*abs(w)*cos(beta) - squeeze*eps_dot
      f_t = rotation*w*sin(beta)
   end subroutine butenschoen_components

   !> What the polynomials do not cover.
   function butenschoen_description(self, parameters) result(words)
      class(film_butenschoen_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) from `fit` [any]
      character(:), allocatable :: words  !! as "supplied at 2 bar"

      words = ""
      associate (b => parameters(first_own))
         if (b < shortest .or. b > longest) words = "L/D = "//to_text(b)//" is outside 1/8 to 1, the range of the approximation"
      end associate
   end function butenschoen_description

end module film_butenschoen
