!> When a rigid rotor on a film starts to whirl: from the eight coefficients of the film, for a mass that moves in the plane.
!>
!> m x'' + B x' + K x = 0; where it neither grows nor dies, x = a exp(i nu t), real and imaginary part of the determinant give
!>
!> K_eq = m nu^2 = (Kxx Byy + Kyy Bxx - Kxy Byx - Kyx Bxy)/(Bxx + Byy)
!> nu^2 = [ (K_eq - Kxx)(K_eq - Kyy) - Kxy Kyx ]/(Bxx Byy - Bxy Byx)
!>
!> so that masses above m_c = K_eq/nu^2 whirl, at first with the frequency nu. Of a symmetric rotor m is the part of its mass that
!> one bearing carries. K_eq <= 0: any mass whirls. nu^2 <= 0: no mass does, and there is no number to give.
!>
!> Source: J. W. Lund, The stability of an elastic rotor in journal bearings with flexible, damped supports, J. Applied Mechanics 32
!> (1965) 911-920; review of the concept of dynamic coefficients for fluid film journal bearings, J. Tribology 109 (1987) 37-41.
!> Limits: rigid rotor, alone on its film, B positive definite; nothing else holds it. The stability of a whole mechanism comes
!> from its own eigenvalues (`steady_stability`).
module journal_whirl
   use film_law, only: film_slopes_t
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: find_whirl, whirl_t

   !> The limit of stability of a rigid rotor.
   type :: whirl_t
      real(wp) :: equivalent_stiffness = 0.0_wp  !! K_eq [N/m]
      real(wp) :: frequency = 0.0_wp             !! nu; NaN: no mass whirls, or B is not positive definite [rad/s]
      real(wp) :: critical_mass = 0.0_wp         !! m_c; 0: any mass whirls; NaN as above [kg]
   end type whirl_t

contains

   !> The limit of stability.
   pure subroutine find_whirl(slopes, whirl)
      type(film_slopes_t), intent(in) :: slopes  !! stiffness and damping of the film
      type(whirl_t), intent(out) :: whirl        !! the limit

      real(wp) :: damping, square

      whirl%frequency = not_a_number()
      whirl%critical_mass = not_a_number()
      associate (k => slopes%stiffness, b => slopes%damping)
         damping = b(1, 1)*b(2, 2) - b(1, 2)*b(2, 1)
         if (.not. (b(1, 1) + b(2, 2) > 0.0_wp .and. damping > 0.0_wp)) return
         whirl%equivalent_stiffness = (k(1, 1)*b(2, 2) + k(2, 2)*b(1, 1) - k(1, 2)*b(2, 1) - k(2, 1)*b(1, 2))/(b(1, 1) + b(2, 2))
         associate (k_eq => whirl%equivalent_stiffness)
            square = ((k_eq - k(1, 1))*(k_eq - k(2, 2)) - k(1, 2)*k(2, 1))/damping
            if (square > 0.0_wp) then
               whirl%frequency = sqrt(square)
               whirl%critical_mass = max(k_eq/square, 0.0_wp)
            else if (.not. k_eq > 0.0_wp) then
               whirl%critical_mass = 0.0_wp
            end if
         end associate
      end associate
   end subroutine find_whirl

end module journal_whirl
