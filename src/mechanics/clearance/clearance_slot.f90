!> Planar: a round pin of body j with clearance in a slot of body i: between both walls and the round ends, or an open mouth.
!>
!> delta = |p - q| - c,   c = width/2 - radius,   n = (p - q)/|p - q|
!>
!> with p the centre of the pin and q the nearest place of the centreline: a straight one from the point of i along the axis, an arc
!> about that point from the axis on, counter-clockwise, or a smooth curve through points. A last end that is open has a mouth with
!> two sharp corners instead of a half circle; a pin whose centre is neither in the slot nor near a corner is free.
!> See `curve_contacts`; forces: `point_contacts`.
!>
!> Signs: the reported force is that on the pin, world frame; the friction force is its component along t = R90 n, n into the wall.
!> Source: Flores et al. (2008), sections 4.2 and 4.3. Limits: laws see a circle of the pin's radius on a plane, at the ends too,
!> so that the stored energy is one function of the penetration; a slot is wider than the pin, and its centreline bends less than
!> its walls.
module clearance_slot
   use bodies, only: material_t
   use curve_contacts, only: curve_contacts_t, meets_slot
   use item, only: item_t, place_of
   use joint_translational, only: add_axis_columns
   use kind_info, only: add_channel, add_flag, add_number, add_reference, dim_angle, dim_length, in_plane, kind_info_t
   use kinds, only: pi, wp
   use point_contacts, only: add_contact_channels, of_force
   use profile_columns, only: add_point_columns, check_points, fault_t, has_points, slot_profile
   use profile_curve, only: curvature_at, profile_t
   use surfaces, only: shape_plane, surfaces_t, take_materials
   use text, only: real_text
   implicit none (type, external)
   private
   public :: clearance_slot_kind_t

   !> Pins in slots.
   type, extends(curve_contacts_t) :: clearance_slot_kind_t
   contains
      procedure, nopass :: info => slot_info
      procedure :: prepare => slot_prepare
      procedure, nopass :: mistake => slot_mistake
      procedure, nopass :: describe => describe_slot
   end type clearance_slot_kind_t

contains

   !> Description of the geometry.
   function slot_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.slot"
      info%space = in_plane
      info%help = "a pin with clearance in a slot with round ends: straight, an arc, or along points; --ideal keeps its contact, " &
                  //"as no ideal joint corresponds to it"
      info%source = "Flores et al. (2008), sections 4.2 and 4.3"
      call add_reference(info, "slot", "points", "start of a straight centreline, centre of an arc, or origin of points")
      call add_reference(info, "pin", "points", "centre of the pin")
      call add_axis_columns(info, "centreline, or of the start of an arc from its centre,")
      call add_number(info, "length", dim_length, "length of a straight centreline; 0: a round hole", default="", lower=0.0_wp)
      call add_number(info, "arc_radius", dim_length, "radius of the centreline of an arc", default="", lower=0.0_wp, &
                      open_lower=.true.)
      call add_number(info, "arc", dim_angle, "angle of an arc, counter-clockwise; 360 deg: a closed groove", default="0 rad", &
                      lower=0.0_wp, upper=2.0_wp*pi)
      call add_point_columns(info, "centreline")
      call add_flag(info, "closed", "points are those of a closed groove", default="off")
      call add_flag(info, "open_end", "the last end of the centreline is an open mouth with sharp corners, through which the pin " &
                    //"comes and goes", default="off")
      call add_number(info, "width", dim_length, "width of the slot", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "radius", dim_length, "radius of the pin", lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of slot and pin")
      call add_reference(info, "pin_material", "material", "material of the pin, if different", default="none")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the pin", of_force)
      call add_contact_channels(info, "pin", "t = R90 n")
   end function slot_info

   !> Centrelines and pins.
   subroutine slot_prepare(self, items)
      class(clearance_slot_kind_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                 !! (n) rows of the table

      integer :: k

      call self%make_curves()
      self%traits%is_gap = .true.
      do k = 1, self%n
         associate (curved => self%curved(k), item => items(k))
            call slot_profile(item, curved%profile)
            curved%meets = meets_slot
            curved%radius = item%number("radius")
            self%items%pairs(k)%clearance = 0.5_wp*item%number("width") - curved%radius
            curved%offset = -self%items%pairs(k)%clearance
         end associate
      end do
   end subroutine slot_prepare

   !> A pin on a wall.
   pure subroutine describe_slot(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      pair%shape = shape_plane
      pair%radius_j = item%number("radius")
      pair%clearance = 0.5_wp*item%number("width") - pair%radius_j
      call take_materials(pair, materials, item%reference("material"), item%reference("pin_material"))
   end subroutine describe_slot

   !> One centreline there must be, and room for the pin.
   subroutine slot_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      character(*), parameter :: one = "give length, or arc_radius and arc, or points: x and y, or a file"
      type(fault_t) :: fault
      logical :: is_given(3)

      call fault%set("", "", "")
      is_given = [item%is_given("length"), item%is_given("arc_radius"), has_points(item)]
      if (count(is_given) == 0) then
         call fault%set("slot", "slot '"//item%name//"' has no centreline", one)
      else if (count(is_given) > 1) then
         call fault%set("slot", "the centreline of slot '"//item%name//"' is given twice", one)
      else if (item%is_given("arc_radius") .neqv. item%number("arc") > 0.0_wp) then
         call fault%set(merge("arc_radius", "arc       ", item%is_given("arc_radius")), "an arc has a radius and an angle", one)
      else if (item%flag("closed") .and. .not. is_given(3)) then
         call fault%set("closed", "only a groove through points is closed by this column", "an arc of 360 deg is closed")
      else if (item%flag("open_end") .and. is_endless(item)) then
         call fault%set("open_end", "the centreline of slot '"//item%name//"' has no end that could be open", &
                        "give a length, an arc of less than 360 deg, or points with closed = off")
      else if (.not. 2.0_wp*item%number("radius") < item%number("width")) then
         call fault%set("radius", "the pin has a diameter of "//real_text(2.0e3_wp*item%number("radius"), 6)//" mm, the slot is " &
                        //real_text(1.0e3_wp*item%number("width"), 6)//" mm wide", "a pin is thinner than its slot")
      else if (is_given(3)) then
         call check_points(item, item%flag("closed"), fault)
      end if
      if (fault%column == "") call check_bend(item, fault)
      column = 0
      if (fault%column /= "") column = place_of(item, trim(fault%column))
      message = fault%message
      help = fault%help
   end subroutine slot_mistake

   !> Whether a centreline has no last end: a point, a circle, or a closed groove.
   pure logical function is_endless(item)
      type(item_t), intent(in) :: item   !! the row

      type(profile_t) :: profile

      is_endless = item%flag("closed")
      if (has_points(item)) return
      call slot_profile(item, profile)
      is_endless = profile%is_closed .or. .not. profile%range(2) > profile%range(1)
   end function is_endless

   !> The inner wall must not fold: half the width is less than the radius of curvature of the centreline.
   subroutine check_bend(item, fault)
      type(item_t), intent(in) :: item          !! the row
      type(fault_t), intent(inout) :: fault     !! set where something is wrong

      real(wp) :: bend
      integer :: k
      type(profile_t) :: profile

      call slot_profile(item, profile)
      bend = 0.0_wp
      do k = 1, size(profile%u)
         bend = max(bend, abs(curvature_at(profile, profile%u(k))))
      end do
      if (0.5_wp*bend*item%number("width") < 1.0_wp) return
      call fault%set("width", "the slot is "//real_text(1.0e3_wp*item%number("width"), 4)//" mm wide, and the radius of " &
                     //"curvature of its centreline goes down to "//real_text(1.0e3_wp/bend, 4)//" mm", &
                     "half the width must be less than that")
   end subroutine check_bend

end module clearance_slot
