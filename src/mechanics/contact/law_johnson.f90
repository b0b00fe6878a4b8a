!> Johnson: line contact of a pin in a hole, the strain along the axis of the load summed up.
!>
!> delta = F / (pi E L) [ ln( 4 pi E L (R_i - R_j) / F ) - 1 ],   1/E = sigma_i + sigma_j
!>
!> The law turns back at F = 4 pi E L (R_i - R_j) / e^2, delta = 4 (R_i - R_j) / e^2.
!> Source: K. L. Johnson, Contact Mechanics (1985), for a pin in a hole as in C. M. Pereira, A. L. Ramalho and J. A. Ambrosio, A
!> critical overview of internal and external cylinder contact force models, Nonlinear Dynamics 63 (2011), 681-697.
!> Limits: those of cylinder_family; forces well below pi E L (R_i - R_j).
module law_johnson
   use cylinder_family, only: add_line_columns, cylinder_family_t, prepare_line
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_johnson_t

   !> Line contact of a pin in a hole.
   type, extends(cylinder_family_t) :: law_johnson_t
   contains
      procedure, nopass :: info => johnson_info
      procedure :: prepare => johnson_prepare
      procedure, nopass :: force_constant => johnson_force_constant
   end type law_johnson_t

contains

   !> Description of the kind.
   function johnson_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.johnson"
      info%help = "line contact of a pin in a hole from the strain along the axis of the load, inverted"
      info%source = "Johnson (1985); Pereira, Ramalho and Ambrosio (2011)"
      call add_line_columns(info)
   end function johnson_info

   !> Take the parameters.
   subroutine johnson_prepare(self, item)
      class(law_johnson_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item             !! the row

      call prepare_line(self, item)
   end subroutine johnson_prepare

   !> B = 4 L c / (e^2 sigma): ln(B/F) + 1 is ln(e^2 B/F) - 1.
   pure real(wp) function johnson_force_constant(pair, length, sigma) result(b)
      type(surfaces_t), intent(in) :: pair  !! radii and clearance
      real(wp), intent(in) :: length        !! length of contact [m]
      real(wp), intent(in) :: sigma         !! sum of the compliances over pi, 1/(pi E) [1/Pa]

      b = 4.0_wp*exp(-2.0_wp)*length*pair%clearance/sigma
   end function johnson_force_constant

end module law_johnson
