!> Radzimovsky: line contact of a pin in a hole, the approach of the two axes.
!>
!> delta = F / (pi E L) [ 2/3 + ln(4 R_i / b) + ln(4 R_j / b) ],   b = 1.60 sqrt( F K / (E L) ),   1/E = sigma_i + sigma_j
!>
!> b is the full width of contact if K is made of the diameters, K = D_i D_j / (D_i - D_j), which is how handbooks have it (Hertz's
!> own width is 0.3 % less than that). The literature of clearance joints has K = R_i R_j / (R_i - R_j) with the same
!> formula, a width that is too small by the square root of two; the column `width` says which is meant.
!> The law turns back where the bracket is one.
!> Source: E. I. Radzimovsky, Stress distribution and strength condition of two rolling cylinders pressed together, University of
!> Illinois Bulletin 408 (1953); with radii as in C. M. Pereira, A. L. Ramalho and J. A. Ambrosio, Nonlinear Dynamics 63
!> (2011), 681-697. Limits: those of cylinder_family.
module law_radzimovsky
   use cylinder_family, only: add_line_columns, cylinder_family_t, prepare_line
   use item, only: item_t
   use kind_info, only: add_word, kind_info_t
   use kinds, only: pi, wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: law_radzimovsky_t

   !> Line contact of a pin in a hole.
   type, extends(cylinder_family_t) :: law_radzimovsky_t
   contains
      procedure, nopass :: info => radzimovsky_info
      procedure :: prepare => radzimovsky_prepare
      procedure, nopass :: force_constant => radzimovsky_force_constant
   end type law_radzimovsky_t

contains

   !> Description of the kind.
   function radzimovsky_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.radzimovsky"
      info%help = "line contact of a pin in a hole from the width of contact, inverted"
      info%source = "Radzimovsky (1953); Pereira, Ramalho and Ambrosio (2011)"
      call add_line_columns(info)
      call add_word(info, "width", "length scale of the contact width: diameters, or radii as in the literature on " &
                    //"clearance joints", default="diameters", choices="diameters radii")
   end function radzimovsky_info

   !> Take the parameters. With radii the square of the width is half of that with diameters, and B twice as large.
   subroutine radzimovsky_prepare(self, item)
      class(law_radzimovsky_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                 !! the row

      call prepare_line(self, item)
      if (item%word("width") == "radii") self%factor = 2.0_wp
   end subroutine radzimovsky_prepare

   !> B = 16 exp(-1/3) L c / (2 * 1.60^2 pi sigma): 16 R_i R_j / b^2 is 16 E L c / (1.60^2 * 2 F).
   pure real(wp) function radzimovsky_force_constant(pair, length, sigma) result(b)
      type(surfaces_t), intent(in) :: pair  !! radii and clearance
      real(wp), intent(in) :: length        !! length of contact [m]
      real(wp), intent(in) :: sigma         !! sum of the compliances over pi, 1/(pi E) [1/Pa]

      b = 16.0_wp/(2.0_wp*1.60_wp**2)*exp(-1.0_wp/3.0_wp)*length*pair%clearance/(pi*sigma)
   end function radzimovsky_force_constant

end module law_radzimovsky
