!> Squeeze film of an infinitely long bearing: only the approach of the surfaces counts, not their sliding.
!>
!> f_r = -12 pi eps'/q^(3/2),   f_t = 0                                         `pressure = full`
!> f_r = -12 eps' [ pi/(2 q^(3/2)) + s ( asin(eps)/q^(3/2) + eps/q ) ],   f_t = 0      `pressure = positive`, s the sign of eps'
!>
!> Signs: on the journal, n from the bearing's centre to the journal's; q = 1 - eps^2. `full` counts pressures of both signs, so
!> that a journal that parts is held back as strongly as one that approaches; `positive` only the half of the film that is pressed.
!> Source: Flores et al. (2008), eqs. (5.21), (5.22); the half film is `long_exact` without a wedge.
!> Limits: L/D above about 2; no load is carried at rest, whatever the speed. A journal that moves across the line of centres meets
!> no film, so that its force depends on the direction of n even for e -> 0.
module film_squeeze
   use closed_film, only: long_film_t, long_shape
   use film_law, only: n_film_parameter
   use item, only: item_t
   use kind_info, only: add_word, kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_squeeze_t

   !> A squeeze film.
   type, extends(long_film_t) :: film_squeeze_t
      logical :: is_positive = .false.  !! only pressures above zero count
   contains
      procedure, nopass :: info => squeeze_info
      procedure :: prepare => squeeze_prepare
      procedure :: components => squeeze_components
      procedure, nopass :: has_field => squeeze_has_field
      procedure :: shape => squeeze_shape
   end type film_squeeze_t

contains

   !> Description of the kind.
   function squeeze_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.squeeze"
      info%help = "squeeze film of an infinitely long bearing: normal approach only, no effect of sliding"
      info%source = "Flores et al. (2008), eqs. (5.21), (5.22)"
      call add_word(info, "pressure", "pressure of both signs, or only positive", default="full", choices="full positive")
   end function squeeze_info

   !> Take which pressures count.
   subroutine squeeze_prepare(self, item)
      class(film_squeeze_t), intent(inout) :: self  !! the film
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%is_positive = item%word("pressure") == "positive"
   end subroutine squeeze_prepare

   !> Components of the force over its scale.
   pure subroutine squeeze_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_squeeze_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om, of no influence [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t, zero [1/s]

      real(wp) :: q, root

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      f_t = 0.0_wp
      if (self%is_positive) then
         f_r = -12.0_wp*(eps_dot*0.5_wp*pi/(q*root) + abs(eps_dot)*(asin(eps)/(q*root) + eps/q))
      else
         f_r = -12.0_wp*pi*eps_dot/(q*root)
      end if
   end subroutine squeeze_components

   !> It has pressures.
   pure logical function squeeze_has_field() result(has)
      has = .true.
   end function squeeze_has_field

   !> The pressure around the bearing.
   pure real(wp) function squeeze_shape(self, eps, eps_dot, w, theta) result(shape)
      class(film_squeeze_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: eps      !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w        !! eps Om, of no influence [rad/s]
      real(wp), intent(in) :: theta    !! angle from the widest gap, 0 to 2 pi [rad]

      shape = long_shape(eps, eps_dot, 0.0_wp, theta)
      if (self%is_positive) shape = max(shape, 0.0_wp)
   end function squeeze_shape

end module film_squeeze
