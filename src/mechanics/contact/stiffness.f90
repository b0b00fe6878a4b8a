!> Contact stiffness from shape and materials.
!>
!> curved surfaces, force K delta^1.5, sigma = sigma_i + sigma_j, sigma_k = (1 - nu_k^2) / E_k:
!>    internal (a pin in a hole, a ball in a socket)   K = 4 / (3 sigma) sqrt( R_i R_j / (R_i - R_j) )   eq. (3.3)
!>    external (two balls)                             K = 4 / (3 sigma) sqrt( R_i R_j / (R_i + R_j) )   eq. (3.3)
!>    a ball on a plane                                K = 4 / (3 sigma) sqrt( R_j )                     eq. (3.5)
!> a plane face of sides a and b on a plane, force K delta:
!>    K = sqrt(a b) / (m sigma)                                                                          eq. (4.26)
!> where m belongs to the mean displacement of a uniformly loaded rectangle.
!>
!> Source: Flores et al. (2008), eqs. (3.3)-(3.5), (4.26). The book prints R_i + R_j for both pairs of balls: 10 and
!> 9.5 mm of steel then give 1.06e10 instead of its own 6.6e10 N/m^1.5. For a square it gives m = 0.95 (K = a/(0.475
!> sigma) with a half the side), which is 0.9464 rounded up; other rectangles have another m: Timoshenko and Goodier,
!> Theory of elasticity (1970), section 139. Limits: surfaces of infinite bodies, small areas of contact on curved ones.
module stiffness
   use kinds, only: wp
   use surfaces, only: shape_external, shape_internal, shape_plane, surfaces_t
   implicit none (type, external)
   private
   public :: curved_stiffness, face_stiffness

contains

   !> Stiffness K of K delta^1.5; zero for a face, which is not curved.
   pure real(wp) function curved_stiffness(pair) result(k)
      type(surfaces_t), intent(in) :: pair  !! the surfaces

      real(wp) :: radius

      select case (pair%shape)
      case (shape_internal)
         radius = pair%radius_i*pair%radius_j/pair%clearance
      case (shape_external)
         radius = pair%radius_i*pair%radius_j/(pair%radius_i + pair%radius_j)
      case (shape_plane)
         radius = pair%radius_j
      case default
         radius = 0.0_wp
      end select
      k = 4.0_wp/(3.0_wp*(pair%sigma_i + pair%sigma_j))*sqrt(radius)
   end function curved_stiffness

   !> Stiffness K of K delta for a rectangular face; zero if it has no sides.
   pure real(wp) function face_stiffness(pair) result(k)
      type(surfaces_t), intent(in) :: pair  !! the surfaces

      k = 0.0_wp
      if (pair%length <= 0.0_wp .or. pair%width <= 0.0_wp) return
      k = sqrt(pair%length*pair%width)/(mean_displacement(pair%length, pair%width)*(pair%sigma_i + pair%sigma_j))
   end function face_stiffness

   !> Factor m of the mean displacement under a uniform pressure p on a rectangle: m p sqrt(a b) sigma. The integral of
   !> 1/(pi r) over the rectangle twice, in closed form: with r = a/b >= 1, s = sqrt(1 + r^2),
   !> m = 2/(pi sqrt(r)) [ arsinh(r) + r arsinh(1/r) - ( s^3 - r^3 - 1 )/(3 r) ].
   pure real(wp) function mean_displacement(a, b) result(m)
      real(wp), intent(in) :: a  !! one side [m]
      real(wp), intent(in) :: b  !! the other [m]

      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: r, s

      r = max(a, b)/min(a, b)
      s = sqrt(1.0_wp + r*r)
      m = 2.0_wp/(pi*sqrt(r))*(asinh(r) + r*asinh(1.0_wp/r) - (s**3 - r**3 - 1.0_wp)/(3.0_wp*r))
   end function mean_displacement

end module stiffness
