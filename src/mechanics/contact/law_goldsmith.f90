!> Goldsmith: line contact of a pin in a hole.
!>
!> delta = F (sigma_i + sigma_j) / L [ ln( L (R_i - R_j) / (R_i R_j (sigma_i + sigma_j)) / F ) + 1 ]
!>
!> The logarithm's argument is not a number but one over a squared length: the law depends on the unit of length. In
!> metres it turns back at delta = 1 m^2 (R_i - R_j) / (R_i R_j), beyond reach; in millimetres at 1e-6 of that, at a hundredth
!> of the clearance of a 10 mm bearing, and the force is more than twice as large. The column `unit` says which is meant.
!> Source: Flores et al. (2008), eq. (3.10) with b = 1; Goldsmith, Impact (1960). Limits: see above; those of cylinder_family.
module law_goldsmith
   use cylinder_family, only: add_cylinder_columns, cylinder_family_t, prepare_cylinder
   use item, only: item_t
   use kind_info, only: add_word, kind_info_t
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_goldsmith_t

   !> Line contact of a pin in a hole.
   type, extends(cylinder_family_t) :: law_goldsmith_t
   contains
      procedure, nopass :: info => goldsmith_info
      procedure :: prepare => goldsmith_prepare
      procedure, nopass :: force_constant => goldsmith_force_constant
   end type law_goldsmith_t

contains

   !> Description of the kind.
   function goldsmith_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.goldsmith"
      info%help = "line contact of a pin in a hole; its logarithm depends on the length unit"
      info%source = "Flores et al. (2008), eq. (3.10)"
      call add_cylinder_columns(info)
      call add_word(info, "unit", "length unit of the numerical constants of the law", default="m", choices="m mm")
   end function goldsmith_info

   !> Take the parameters.
   subroutine goldsmith_prepare(self, item)
      class(law_goldsmith_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item               !! the row

      call prepare_cylinder(self, item)
      self%factor = merge(1.0e-6_wp, 1.0_wp, item%word("unit") == "mm")
   end subroutine goldsmith_prepare

   !> B = L c / (R_i R_j sigma) times one square unit of length.
   pure real(wp) function goldsmith_force_constant(pair, length, sigma) result(b)
      type(surfaces_t), intent(in) :: pair  !! radii and clearance
      real(wp), intent(in) :: length        !! length of contact [m]
      real(wp), intent(in) :: sigma         !! sum of the compliances [1/Pa]

      b = length*pair%clearance/(pair%radius_i*pair%radius_j*sigma)
   end function goldsmith_force_constant

end module law_goldsmith
