!> Planar: two equal rollers that touch from outside, with one column for their radius.
!>
!> delta = 2 R - |e|; everything else is that of `clearance_discs`, which has the equations, signs, source and limits.
module clearance_rollers
   use bodies, only: material_t
   use clearance_discs, only: clearance_discs_t
   use item, only: item_t
   use kind_info, only: add_channel, add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use point_contacts, only: add_contact_channels, of_force
   use surfaces, only: put_beside, surfaces_t, take_materials
   implicit none (type, external)
   private
   public :: clearance_rollers_t

   !> Pairs of equal rollers.
   type, extends(clearance_discs_t) :: clearance_rollers_t
   contains
      procedure, nopass :: info => rollers_info
      procedure, nopass :: describe => describe_rollers
   end type clearance_rollers_t

contains

   !> Description of the geometry.
   function rollers_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.rollers"
      info%space = in_plane
      info%help = "external contact of two equal rollers"
      info%source = "Flores et al. (2008), sections 3.1 and 4.2"
      call add_reference(info, "i", "points", "centre of the first roller")
      call add_reference(info, "j", "points", "centre of the second roller")
      call add_number(info, "radius", dim_length, "radius of both rollers", lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of both rollers")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the second roller", of_force)
      call add_contact_channels(info, "second roller", "t = R90 n")
   end function rollers_info

   !> Two convex surfaces.
   pure subroutine describe_rollers(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call put_beside(pair, item%number("radius"), item%number("radius"))
      call take_materials(pair, materials, item%reference("material"), item%reference("material"))
   end subroutine describe_rollers

end module clearance_rollers
