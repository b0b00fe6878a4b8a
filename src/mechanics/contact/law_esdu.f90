!> ESDU-78035: line contact of a pin in a hole.
!>
!> delta = F (sigma_i + sigma_j) / L [ ln( 4 L (R_i - R_j) / (sigma_i + sigma_j) / F ) + 1 ]
!>
!> The law turns back at delta = 4 (R_i - R_j), whatever length and radii.
!> Source: Flores et al. (2008), eq. (3.11); Engineering Sciences Data Unit, Contact phenomena I, item 78035 (1978).
!> Limits: radii nearly equal; those of cylinder_family.
module law_esdu
   use cylinder_family, only: add_cylinder_columns, cylinder_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_esdu_t

   !> Line contact of a pin in a hole.
   type, extends(cylinder_family_t) :: law_esdu_t
   contains
      procedure, nopass :: info => esdu_info
      procedure, nopass :: force_constant => esdu_force_constant
   end type law_esdu_t

contains

   !> Description of the kind.
   function esdu_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.esdu"
      info%help = "line contact of a pin in a hole after ESDU-78035, inverted"
      info%source = "Flores et al. (2008), eq. (3.11)"
      call add_cylinder_columns(info)
   end function esdu_info

   !> B = 4 L c / sigma.
   pure real(wp) function esdu_force_constant(pair, length, sigma) result(b)
      type(surfaces_t), intent(in) :: pair  !! radii and clearance
      real(wp), intent(in) :: length        !! length of contact [m]
      real(wp), intent(in) :: sigma         !! sum of the compliances [1/Pa]

      b = 4.0_wp*length*pair%clearance/sigma
   end function esdu_force_constant

end module law_esdu
