!> Pinkus and Sternlicht: infinitely long bearing, a closed approximation of the film that carries no tension.
!>
!> f_r = -6/(s q^(3/2)) [ 4 eps S + pi s eps' r ],   f_t = 6 pi w r/(s sqrt(q)),   s = 2 + eps^2
!> S = sqrt( q ((w/2)^2 + eps'^2) ),   r = (S + 3 eps max(eps', 0))/(S + 3/2 eps |eps'|),   r = 1 if S = 0
!>
!> Signs: on the journal, n from the bearing's centre to the journal's, t = z x n; w = eps Om, q = 1 - eps^2.
!> Source: Flores et al. (2008), eqs. (5.14)-(5.18), without their divisions by eps and eps', and with |eps'| before the bracket of
!> (5.16): as printed the radial force of a parting journal has the other sign (`form = book`), jumps at eps' = 0 and feeds energy
!> in.
!> Limits: L/D above about 2, where the force is still too large. Off `long_exact`, the film that it approximates, by up to 8 %
!> while the journal approaches and by more while it parts.
module film_pinkus_sternlicht
   use closed_film, only: long_film_t
   use film_law, only: n_film_parameter
   use kind_info, only: add_word, kind_info_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: film_pinkus_sternlicht_t

   !> A long bearing as Pinkus and Sternlicht have it.
   type, extends(long_film_t) :: film_pinkus_sternlicht_t
   contains
      procedure, nopass :: info => pinkus_sternlicht_info
      procedure :: components => pinkus_sternlicht_components
   end type film_pinkus_sternlicht_t

contains

   !> Description of the kind.
   function pinkus_sternlicht_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "film.pinkus_sternlicht"
      info%help = "infinitely long bearing without negative pressure, approximate (Pinkus and Sternlicht)"
      info%source = "Flores et al. (2008), eqs. (5.14)-(5.18)"
      call add_word(info, "form", "sign of the radial force during separation: corrected, or as printed in Flores et al. (2008)", &
                    default="corrected", choices="corrected book")
   end function pinkus_sternlicht_info

   !> Components of the force over its scale.
   pure subroutine pinkus_sternlicht_components(self, parameters, eps, eps_dot, w, f_r, f_t)
      class(film_pinkus_sternlicht_t), intent(in) :: self  !! the film
      real(wp), intent(in) :: parameters(n_film_parameter)  !! (n_film_parameter) of the bearing [any]
      real(wp), intent(in) :: eps  !! eccentricity ratio [1]
      real(wp), intent(in) :: eps_dot  !! its rate [1/s]
      real(wp), intent(in) :: w  !! eps Om [rad/s]
      real(wp), intent(out) :: f_r  !! along n [1/s]
      real(wp), intent(out) :: f_t  !! along t [1/s]

      real(wp) :: q, ratio, root, s, size

      q = (1.0_wp - eps)*(1.0_wp + eps)
      root = sqrt(q)
      s = 2.0_wp + eps*eps
      size = root*sqrt(0.25_wp*w*w + eps_dot*eps_dot)
      ratio = 1.0_wp
      if (size > 0.0_wp) ratio = (size + 3.0_wp*eps*max(eps_dot, 0.0_wp))/(size + 1.5_wp*eps*abs(eps_dot))
      f_r = -6.0_wp/(s*q*root)*(4.0_wp*eps*size + pi*s*eps_dot*ratio)
      if (self%is_book .and. eps_dot < 0.0_wp) f_r = -f_r
      f_t = 6.0_wp*pi*w*ratio/(s*root)
   end subroutine pinkus_sternlicht_components

end module film_pinkus_sternlicht
