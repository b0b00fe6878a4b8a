!> Planar: two discs or balls that touch from outside: rollers, billiard balls, the stop on a pin.
!>
!> delta = R_i + R_j - |e|,  e = r_j^P - r_i^P,  n = -e / |e|: that of a pin in a hole of radius -R_i, see
!> `round_contacts`, which has rates and sliding velocities; forces: `point_contacts`.
!>
!> Signs: the reported force is that on the second disc, world frame; the friction force is its component along t = R90 n.
!> Source: Flores et al. (2008), sections 3.1 and 4.2; (3.3) for the stiffness of two balls. Limits: stiffness of the balls of these
!> radii, also for discs, unless a law says otherwise; centres that coincide have no normal.
module clearance_discs
   use bodies, only: material_t
   use item, only: item_t
   use kind_info, only: add_channel, add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force
   use round_contacts, only: round_contacts_t
   use surfaces, only: put_beside, surfaces_t, take_materials
   implicit none (type, external)
   private
   public :: add_disc_columns, clearance_discs_t, describe_discs

   !> Pairs of discs.
   type, extends(round_contacts_t) :: clearance_discs_t
   contains
      procedure, nopass :: info => discs_info
      procedure :: prepare => discs_prepare
      procedure, nopass :: describe => describe_discs
   end type clearance_discs_t

contains

   !> Description of the geometry.
   function discs_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.discs"
      info%space = in_plane
      info%help = "external contact of two discs or balls; --ideal keeps it, as no ideal joint corresponds to it"
      info%source = "Flores et al. (2008), sections 3.1 and 4.2"
      call add_disc_columns(info, "disc")
      call add_contact_channels(info, "second disc", "t = R90 n")
   end function discs_info

   !> Columns of two discs or balls, and the channels of the pair.
   subroutine add_disc_columns(info, disc)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: disc          !! what they are, as "disc"

      call add_reference(info, "i", "points", "centre of the first "//disc)
      call add_reference(info, "j", "points", "centre of the second "//disc)
      call add_number(info, "radius_i", dim_length, "radius of the first "//disc, lower=0.0_wp, open_lower=.true.)
      call add_number(info, "radius_j", dim_length, "radius of the second "//disc, lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of both "//disc//"s")
      call add_reference(info, "material_j", "material", "material of the second "//disc//", if different", default="none")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the second "//disc//" relative to that of the first", &
                       of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the second "//disc, of_force)
   end subroutine add_disc_columns

   !> The second disc is beside the first.
   subroutine discs_prepare(self, items)
      class(clearance_discs_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      call self%make_journals()
      self%journal%side = -1.0_wp
   end subroutine discs_prepare

   !> Two convex surfaces.
   pure subroutine describe_discs(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call put_beside(pair, item%number("radius_i"), item%number("radius_j"))
      call take_materials(pair, materials, item%reference("material"), item%reference("material_j"))
   end subroutine describe_discs

end module clearance_discs
