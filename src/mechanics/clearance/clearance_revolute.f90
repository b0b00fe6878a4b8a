!> Planar: a revolute joint with clearance, a journal (pin) of body j in a bearing (hole) of body i.
!>
!> Equations: `round_contacts`; forces: `point_contacts`; films: `bearing_films`. The law is fitted to an internal contact of radii
!> R and R - c. `level` says what there is between the surfaces: dry contact (`clearance`), a film that holds them apart
!> (`lubricated`: the run ends where e = eps_max c), or both (`hybrid`): with e_t0 the film goes out and the contact comes in
!> between e = c and c + e_t0, and the film has the clearance c + e_t1, eq. (5.23); without it the film keeps its shape beyond
!> eps_max and the contact adds to it.
!>
!> Signs: the reported force is that on the journal, world frame; the friction force is its component along t = R90 n; the
!> eccentricity is the journal's centre from the bearing's, world frame.
!> Source: Flores et al. (2008), section 4.2, corrected: see `round_contacts`; `form = book` does as the book prints.
!> Limits: both surfaces round; one contact per joint.
module clearance_revolute
   use bodies, only: material_t
   use item, only: item_t, place_of
   use joint_level, only: level_lubricated, level_of
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force
   use revolute_level, only: add_film_channels, add_film_columns, describe_hole, find_level_mistake
   use round_contacts, only: round_contacts_t
   use surfaces, only: surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: clearance_revolute_t

   !> Journals in bearings, in the plane.
   type, extends(round_contacts_t) :: clearance_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure, nopass :: ideal_kind => revolute_ideal_kind
      procedure :: prepare => revolute_prepare
      procedure, nopass :: mistake => revolute_mistake
      procedure, nopass :: describe => revolute_describe
   end type clearance_revolute_t

contains

   !> Description of the geometry.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.revolute"
      info%space = in_plane
      info%help = "a pin with clearance in a hole: dry contact, or a journal bearing with lubricant film"
      info%source = "Flores et al. (2008), section 4.2"
      call add_reference(info, "bearing", "points", "centre of the hole")
      call add_reference(info, "journal", "points", "centre of the pin")
      call add_number(info, "bearing_radius", dim_length, "radius of the hole", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "clearance", dim_length, "radial clearance, radius of the hole minus radius of the pin", &
                      lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of hole and pin, for dry contact", default="none")
      call add_reference(info, "journal_material", "material", "material of the pin, if different", default="none")
      call add_word(info, "level", "model: an ideal pin joint, dry contact, a film, or film and dry contact", &
                    default="clearance", choices="ideal clearance lubricated hybrid")
      call add_reference(info, "law", "contact.", "normal law of dry contact, a row of a contact table", default="none")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_word(info, "form", "formulas: corrected, or as printed in Flores et al. (2008)", default="corrected", &
                    choices="corrected book")
      call add_number(info, "length", dim_length, "length of the bearing along its axis, for laws of cylinders; 0: unknown", &
                      default="0 m", lower=0.0_wp)
      call add_film_columns(info, .false.)
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal relative to that of the bearing", &
                       of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the journal", of_force)
      call add_film_channels(info)
      call add_contact_channels(info, "journal", "t = R90 n")
   end function revolute_info

   !> Without clearance a revolute joint.
   function revolute_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.revolute"
   end function revolute_ideal_kind

   !> Form of each item.
   subroutine revolute_prepare(self, items)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                !! (n) rows of the table

      integer :: k

      self%traits%is_round = .true.
      call self%make_journals()
      do k = 1, self%n
         associate (item => items(k), journal => self%journal(k))
            journal%is_book = item%word("form") == "book"
            if (journal%is_book) journal%share = 0.0_wp
         end associate
      end do
   end subroutine revolute_prepare

   !> A pin in a hole.
   pure subroutine revolute_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call describe_hole(item, materials, pair)
      pair%length = item%number("length")
   end subroutine revolute_describe

   !> The journal must have a radius, and the row what its level needs.
   subroutine revolute_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (radius => item%number("bearing_radius"), clearance => item%number("clearance"))
         if (.not. clearance < radius) then
            column = place_of(item, "clearance")
            message = "clearance must be smaller than bearing_radius"
            help = "the journal radius is bearing_radius minus clearance: here "//to_text(1.0e3_wp*(radius - clearance))//" mm"
            return
         end if
      end associate
      call find_level_mistake(item, column, message, help)
   end subroutine revolute_mistake

end module clearance_revolute
