!> Contact stiffness from radii and materials.
!>
!> sigma_k = (1 - nu_k^2) / E_k                                              eq. (3.4)
!> internal contact (a pin in a hole, a ball in a socket):
!> K = 4 / (3 (sigma_i + sigma_j)) sqrt( R_i R_j / (R_i - R_j) )             eq. (3.3)
!>
!> Source: Flores et al. (2008), eqs. (3.3), (3.4); the book prints R_i + R_j, which is the external
!> contact of two balls: 10 and 9.5 mm of steel then give 1.06e10 instead of its own 6.6e10 N/m^1.5.
module stiffness
   use bodies, only: material_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: internal_stiffness

contains

   !> Stiffness of an internal contact.
   pure real(wp) function internal_stiffness(radius_i, clearance, material_i, material_j) result(k)
      real(wp), intent(in) :: radius_i            !! radius of the hole [m]
      real(wp), intent(in) :: clearance           !! radius of the hole less that of the pin, R_i - R_j [m]
      type(material_t), intent(in) :: material_i  !! material of the hole
      type(material_t), intent(in) :: material_j  !! material of the pin

      real(wp) :: sigma

      sigma = (1.0_wp - material_i%poisson**2)/material_i%young + (1.0_wp - material_j%poisson**2)/material_j%young
      k = 4.0_wp/(3.0_wp*sigma)*sqrt(radius_i*(radius_i - clearance)/clearance)
   end function internal_stiffness

end module stiffness
