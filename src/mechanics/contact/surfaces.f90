!> A pair of surfaces that may touch: what a normal law needs to know of them.
!>
!> sigma_k = (1 - nu_k^2) / E_k;   impact speed from which on waves in the bodies matter: `elastic_waves`
!>
!> The one place of radii, clearance, lengths and materials of an item: geometry, normal law and film read them here. After a change
!> `fit` of the set fits laws and films to them anew.
!> Source: Flores et al. (2008), eq. (3.4) and section 3.2 (the factor 1e-5 is that of Love).
module surfaces
   use bodies, only: material_t
   use elastic_waves, only: speed_of_share
   use kinds, only: wp
   use surface_profile, only: worn_pair_t
   implicit none (type, external)
   private
   public :: put_beside, put_inside, set_materials, shape_external, shape_face, shape_internal, shape_plane, surfaces_t
   public :: take_materials

   integer, parameter :: shape_internal = 1  !! a pin in a hole, a ball in a socket
   integer, parameter :: shape_external = 2  !! two pins or balls side by side
   integer, parameter :: shape_plane = 3     !! a ball, a disc or a rounded corner of radius_j against a plane
   integer, parameter :: shape_face = 4      !! a plane face, length by width, against a plane

   !> Two surfaces; what a shape does not have is zero.
   type :: surfaces_t
      integer :: shape = shape_internal      !! one of the above
      real(wp) :: radius_i = 0.0_wp          !! radius of the surface of i, of the hole if there is one [m]
      real(wp) :: radius_j = 0.0_wp          !! radius of the surface of j, of the pin in the hole [m]
      real(wp) :: clearance = 0.0_wp         !! radius_i less radius_j of an internal pair; of others a length like it [m]
      real(wp) :: touch = 0.0_wp             !! distance of the centres where a contact starts, negative of an external pair [m]
      real(wp) :: length = 0.0_wp            !! length of cylinders along their axes, or of a face; 0: not known [m]
      real(wp) :: length_j = huge(1.0_wp)    !! length of the pin; huge: as long as the hole [m]
      real(wp) :: width = 0.0_wp             !! width of a face, across the plane of motion; 0: not known [m]
      real(wp) :: sigma_i = 0.0_wp           !! (1 - nu^2)/E of the material of i [1/Pa]
      real(wp) :: sigma_j = 0.0_wp           !! (1 - nu^2)/E of the material of j [1/Pa]
      real(wp) :: speed_limit = huge(1.0_wp) !! impact speed up to which contact is quasi-static; huge: not known [m/s]
      real(wp) :: strength = huge(1.0_wp)    !! maximum pressure that both surfaces bear; huge: not known [Pa]
      real(wp) :: inverse_mass = 0.0_wp      !! 1/m_i + 1/m_j of the bodies, 0 for the ground [1/kg]
      type(worn_pair_t), allocatable :: worn !! profiles of a pin in a hole that are worn; unallocated: both are round
   end type surfaces_t

contains

   !> A pin in a hole, or a ball in a socket.
   pure subroutine put_inside(pair, radius, clearance, part)
      type(surfaces_t), intent(inout) :: pair   !! the pair
      real(wp), intent(in) :: radius            !! of the hole [m]
      real(wp), intent(in) :: clearance         !! radius of the hole less that of the pin [m]
      real(wp), intent(in), optional :: part    !! of the clearance where a contact starts; absent: all of it [1]

      pair%shape = shape_internal
      pair%radius_i = radius
      pair%radius_j = radius - clearance
      pair%clearance = clearance
      pair%touch = clearance
      if (present(part)) pair%touch = part*clearance
   end subroutine put_inside

   !> Two discs or balls side by side.
   pure subroutine put_beside(pair, radius_i, radius_j)
      type(surfaces_t), intent(inout) :: pair   !! the pair
      real(wp), intent(in) :: radius_i          !! of that of i [m]
      real(wp), intent(in) :: radius_j          !! of that of j [m]

      pair%shape = shape_external
      pair%radius_i = radius_i
      pair%radius_j = radius_j
      pair%clearance = radius_i + radius_j
      pair%touch = -pair%clearance
   end subroutine put_beside

   !> Compliances and speed limit from the materials; a density that is not given limits nothing.
   pure subroutine set_materials(surfaces, material_i, material_j)
      type(surfaces_t), intent(inout) :: surfaces  !! the pair
      type(material_t), intent(in) :: material_i   !! material of the surface of i
      type(material_t), intent(in) :: material_j   !! material of the surface of j

      surfaces%sigma_i = (1.0_wp - material_i%poisson**2)/material_i%young
      surfaces%sigma_j = (1.0_wp - material_j%poisson**2)/material_j%young
      surfaces%speed_limit = min(speed_limit(material_i), speed_limit(material_j))
      surfaces%strength = huge(1.0_wp)
      if (material_i%strength > 0.0_wp) surfaces%strength = material_i%strength
      if (material_j%strength > 0.0_wp) surfaces%strength = min(surfaces%strength, material_j%strength)
   end subroutine set_materials

   !> Compliances and speed limit from materials by number, of which one may be omitted; without any the pair is left alone.
   pure subroutine take_materials(surfaces, materials, of_i, of_j)
      type(surfaces_t), intent(inout) :: surfaces   !! the pair
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      integer, intent(in) :: of_i                   !! that of the surface of i, 0: as j
      integer, intent(in) :: of_j                   !! that of the surface of j, 0: as i

      if (max(of_i, of_j) == 0) return
      call set_materials(surfaces, materials(merge(of_i, of_j, of_i > 0)), materials(merge(of_j, of_i, of_j > 0)))
   end subroutine take_materials

   !> Impact speed up to which contact is taken as quasi-static: where elastic waves take a tenth of the energy.
   pure real(wp) function speed_limit(material) result(speed)
      type(material_t), intent(in) :: material  !! of one surface

      speed = huge(1.0_wp)
      if (material%density > 0.0_wp) speed = speed_of_share(sqrt(material%young/material%density))
   end function speed_limit

end module surfaces
