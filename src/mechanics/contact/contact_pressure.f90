!> Maximum pressure between two curved surfaces, and the force that brings it.
!>
!> balls, E* = 1/(sigma_i + sigma_j):       p = ( 6 F E*^2 / (pi^3 R^2) )^(1/3)
!> cylinders of length L beside each other: p = ( F E* / (pi L R) )^(1/2)
!> 1/R = 1/R_i + 1/R_j, with -1/R_i for a hole; a plane has no curvature.
!>
!> Source: K. L. Johnson, Contact mechanics (1985), eqs. (3.24), (4.45). A pin whose bearing has a length is a cylinder, else
!> it is a ball, as Hertz's law takes it. Limits: small areas of contact; a flat face has no such pressure.
module contact_pressure
   use kinds, only: wp
   use surfaces, only: shape_external, shape_internal, shape_plane, surfaces_t
   implicit none (type, external)
   private
   public :: force_at_pressure

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> Force at which the maximum pressure reaches a value; huge for a face, or a value that is not known (huge).
   pure real(wp) function force_at_pressure(pair, pressure) result(force)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      real(wp), intent(in) :: pressure       !! maximum pressure [Pa]

      real(wp) :: curvature, modulus

      force = huge(1.0_wp)
      if (pressure >= huge(1.0_wp)) return
      select case (pair%shape)
      case (shape_internal)
         curvature = 1.0_wp/pair%radius_j - 1.0_wp/pair%radius_i
      case (shape_external)
         curvature = 1.0_wp/pair%radius_j + 1.0_wp/pair%radius_i
      case (shape_plane)
         curvature = 1.0_wp/pair%radius_j
      case default
         return
      end select
      modulus = 1.0_wp/(pair%sigma_i + pair%sigma_j)
      if (pair%length > 0.0_wp .and. pair%shape /= shape_plane) then
         force = pi*pair%length*pressure**2/(modulus*curvature)
      else
         force = pi**3*pressure**3/(6.0_wp*(modulus*curvature)**2)
      end if
   end function force_at_pressure

end module contact_pressure
