!> Dubowsky and Freudenstein: line contact of a pin in a hole.
!>
!> delta = F (sigma_i + sigma_j) / L [ ln( L^3 (R_i - R_j) / (R_i R_j (sigma_i + sigma_j)) / F ) + 1 ]
!>
!> The law turns back at delta = L^2 (R_i - R_j) / (R_i R_j), which is little for a short bearing.
!> Source: Flores et al. (2008), eq. (3.10) with b = 3; Dubowsky and Freudenstein, Dynamic analysis of mechanical systems
!> with clearances, Journal of Engineering for Industry 93 (1971), 305-316.
!> Limits: bearings about as long as wide; those of cylinder_family.
module law_dubowsky_freudenstein
   use cylinder_family, only: add_cylinder_columns, cylinder_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_dubowsky_freudenstein_t

   !> Line contact of a pin in a hole.
   type, extends(cylinder_family_t) :: law_dubowsky_freudenstein_t
   contains
      procedure, nopass :: info => dubowsky_freudenstein_info
      procedure, nopass :: force_constant => dubowsky_freudenstein_force_constant
   end type law_dubowsky_freudenstein_t

contains

   !> Description of the kind.
   function dubowsky_freudenstein_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.dubowsky_freudenstein"
      info%help = "line contact of a pin in a hole, inverted from penetration as a function of force"
      info%source = "Flores et al. (2008), eq. (3.10)"
      call add_cylinder_columns(info)
   end function dubowsky_freudenstein_info

   !> B = L^3 c / (R_i R_j sigma).
   pure real(wp) function dubowsky_freudenstein_force_constant(pair, length, sigma) result(b)
      type(surfaces_t), intent(in) :: pair  !! radii and clearance
      real(wp), intent(in) :: length        !! length of contact [m]
      real(wp), intent(in) :: sigma         !! sum of the compliances [1/Pa]

      b = length**3*pair%clearance/(pair%radius_i*pair%radius_j*sigma)
   end function dubowsky_freudenstein_force_constant

end module law_dubowsky_freudenstein
