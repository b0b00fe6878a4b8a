!> Planar: a roller, a point or a flat face of body j on the closed profile of a cam, fixed in body i.
!>
!> The profile is a radius r(angle) about the point of i, its angle counter-clockwise from the xi axis of the body, or a smooth
!> curve through points. A number is a circle; an eccentric one has its centre in the point of i.
!> delta = R - (p - q) . nu,   nu outwards, q the place nearest to the centre p of the roller; a face: delta = n . (P - q), n out
!> of j. See `curve_contacts`; forces: `point_contacts`.
!>
!> Signs: the reported force is that on the follower, world frame; the friction force is its component along t = R90 n, n into the
!> cam. Source: Norton, Cam design and manufacturing handbook (2002), chapter 7 (radius of curvature, undercutting). Limits: a
!> roller fits every hollow of the profile, so that it touches at one place; a face is on a convex profile; the profile has no
!> corners.
module clearance_cam
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: material_t
   use curve_contacts, only: curve_contacts_t, meets_cam, meets_face
   use curve_stiffness, only: put_curved
   use item, only: item_t, place_of
   use kind_info, only: add_channel, add_expression, add_number, add_reference, add_word, dim_angle, dim_length, in_plane, &
      kind_info_t
   use kinds, only: pi, wp
   use point_contacts, only: add_contact_channels, of_force
   use profile_columns, only: add_point_columns, cam_profile, check_closed, check_points, fault_t, has_points
   use profile_curve, only: curvature_at, find_nearest, foot_t, profile_t
   use surfaces, only: surfaces_t, take_materials
   use text, only: real_text
   implicit none (type, external)
   private
   public :: clearance_cam_t

   real(wp), parameter :: same = 1.0e-9_wp    !! penetration elsewhere that is round-off, of the radius of the roller [1]
   real(wp), parameter :: degree = pi/180.0_wp !! [rad]

   !> Cams and their followers.
   type, extends(curve_contacts_t) :: clearance_cam_t
   contains
      procedure, nopass :: info => cam_info
      procedure :: prepare => cam_prepare
      procedure, nopass :: mistake => cam_mistake
      procedure, nopass :: describe => describe_cam
   end type clearance_cam_t

contains

   !> Description of the geometry.
   function cam_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.cam"
      info%space = in_plane
      info%help = "a roller, a point or a flat face on the profile of a cam; --ideal keeps its contact, as no ideal joint " &
                  //"corresponds to it"
      info%source = "Norton (2002), chapter 7"
      call add_reference(info, "cam", "points", "point of the cam that the profile is about")
      call add_reference(info, "follower", "points", "centre of the roller, the point, or a point of the flat face")
      call add_expression(info, "profile", dim_length, "radius of the profile as a function of angle, counter-clockwise from " &
                          //"the xi axis of the cam; a number: a circle; or give points", default="0 m", variable="angle", &
                          argument=[dim_angle])
      call add_point_columns(info, "profile")
      call add_word(info, "contact", "shape of the follower: a roller of column radius, or a flat face", default="roller", &
                    choices="roller flat")
      call add_number(info, "radius", dim_length, "radius of the roller; 0: a point", default="0 m", lower=0.0_wp)
      call add_word(info, "face_axis", "direction of the normal of a flat face, out of the follower: an axis of its body", &
                    default="x", choices="x y")
      call add_number(info, "face_angle", dim_angle, "angle from that axis to the normal, counter-clockwise", default="0 rad")
      call add_reference(info, "material", "material", "material of cam and follower", default="none")
      call add_reference(info, "follower_material", "material", "material of the follower, if different", default="none")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the follower", of_force)
      call add_contact_channels(info, "follower", "t = R90 n")
   end function cam_info

   !> Profiles and followers.
   subroutine cam_prepare(self, items)
      class(clearance_cam_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table

      real(wp) :: angle
      integer :: k

      call self%make_curves()
      do k = 1, self%n
         associate (curved => self%curved(k), item => items(k))
            call cam_profile(item, curved%profile)
            self%items%pairs(k)%clearance = maxval(abs(curved%profile%q))
            if (is_flat(item)) then
               curved%meets = meets_face
               angle = item%number("face_angle")
               curved%normal_j = merge([cos(angle), sin(angle)], [-sin(angle), cos(angle)], item%word("face_axis") == "x")
            else
               curved%meets = meets_cam
               curved%radius = item%number("radius")
               curved%offset = curved%radius
               if (curved%radius > 0.0_wp) self%items%pairs(k)%clearance = min(curved%radius, self%items%pairs(k)%clearance)
            end if
         end associate
      end do
   end subroutine cam_prepare

   !> Whether the follower has a flat face.
   pure logical function is_flat(item)
      type(item_t), intent(in) :: item  !! the row

      is_flat = item%word("contact") == "flat"
   end function is_flat

   !> Whether a row gives a radius over the angle. A radius of zero counts as omitted.
   pure logical function has_radius(item)
      type(item_t), intent(in) :: item  !! the row

      associate (value => item%values(place_of(item, "profile")))
         has_radius = value%given
         if (has_radius .and. value%expression%is_constant) has_radius = abs(value%number) > 0.0_wp
      end associate
   end function has_radius

   !> The surfaces where the profile is least convex, which a law must fit.
   pure subroutine describe_cam(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      real(wp) :: curvature, u
      type(profile_t) :: profile

      call take_materials(pair, materials, item%reference("material"), item%reference("follower_material"))
      call cam_profile(item, profile)
      call find_hollow(profile, u, curvature)
      call put_curved(pair, item%number("radius"), is_flat(item), curvature)
   end subroutine describe_cam

   !> Where a profile is least convex.
   pure subroutine find_hollow(profile, u, curvature)
      type(profile_t), intent(in) :: profile   !! the profile
      real(wp), intent(out) :: u               !! where [any]
      real(wp), intent(out) :: curvature       !! its curvature there [1/m]

      integer :: k

      curvature = huge(1.0_wp)
      do k = 1, size(profile%u)
         if (.not. curvature_at(profile, profile%u(k)) < curvature) cycle
         u = profile%u(k)
         curvature = curvature_at(profile, u)
      end do
   end subroutine find_hollow

   !> A profile there must be, which closes, and which the follower can follow.
   subroutine cam_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      type(fault_t) :: fault
      type(profile_t) :: profile

      call fault%set("", "", "")
      if (has_points(item) .and. has_radius(item)) then
         call fault%set("profile", "the profile is given twice", "give profile, or points")
      else if (.not. (has_points(item) .or. has_radius(item))) then
         call fault%set("cam", "cam '"//item%name//"' has no profile", "give column profile, or points: x and y, or a file")
      else if (has_points(item)) then
         call check_points(item, .true., fault)
      end if
      if (is_flat(item) .and. item%number("radius") > 0.0_wp) then
         call fault%set("radius", "a flat face has no radius", "omit column radius, or use contact = roller")
      else if (is_flat(item) .and. max(item%reference("material"), item%reference("follower_material")) == 0) then
         call fault%set("cam", "cam '"//item%name//"' has no material", "give column material")
      else if (item%number("radius") > 0.0_wp .and. max(item%reference("material"), item%reference("follower_material")) == 0) then
         call fault%set("cam", "cam '"//item%name//"' has no material", "give column material")
      end if
      if (fault%column == "" .and. has_radius(item)) call check_radius(item, fault)
      if (fault%column == "") then
         call cam_profile(item, profile)
         call check_closed(profile, fault)
         if (fault%column == "") call check_follower(item, profile, fault)
         if (has_points(item) .and. fault%column == "profile") fault%column = "x"
      end if
      column = 0
      if (fault%column /= "") column = place_of(item, fault%column)
      message = fault%message
      help = fault%help
   end subroutine cam_mistake

   !> A radius is a positive number all around.
   subroutine check_radius(item, fault)
      type(item_t), intent(in) :: item          !! the row
      type(fault_t), intent(inout) :: fault     !! set where something is wrong

      integer, parameter :: n_angle = 720  ! directions in a turn
      character(:), allocatable :: radius
      real(wp) :: r(3)
      integer :: k, place
      logical :: is_number

      place = place_of(item, "profile")
      do k = 0, n_angle
         call item%values(place)%expression%evaluate(2.0_wp*pi*k/n_angle, r(1), r(2), r(3))
         is_number = all(ieee_is_finite(r))
         if (is_number) is_number = r(1) > 0.0_wp
         if (is_number) cycle
         radius = "not finite"
         if (ieee_is_finite(r(1))) radius = real_text(1.0e3_wp*r(1), 4)//" mm"
         call fault%set("profile", "the radius of the profile is "//radius//" at "//real_text(360.0_wp*k/n_angle, 4)//" deg", &
                        "it must be positive, with two derivatives, all around")
         return
      end do
   end subroutine check_radius

   !> A face needs a convex profile; a roller fits the hollows, and touches at one place wherever it is on the profile.
   subroutine check_follower(item, profile, fault)
      type(item_t), intent(in) :: item          !! the row
      type(profile_t), intent(in) :: profile    !! its profile
      type(fault_t), intent(inout) :: fault     !! set where something is wrong

      real(wp) :: curvature, p(2), radius, u
      integer :: k
      type(foot_t) :: elsewhere, foot

      radius = item%number("radius")
      call find_hollow(profile, u, curvature)
      if (is_flat(item)) then
         if (.not. curvature > 0.0_wp) call fault%set("profile", "the profile is not convex at "//angle_text(profile, u)// &
                                                      ", where a flat face would touch at two places", &
                                                      "use contact = roller, or a convex profile")
         return
      end if
      if (.not. curvature*radius > -1.0_wp) then
         call fault%set("profile", "a roller of radius "//real_text(1.0e3_wp*radius, 4)//" mm is too large for the hollow of " &
                        //"the profile at "//angle_text(profile, u)//", whose radius of curvature is " &
                        //real_text(-1.0e3_wp/curvature, 4)//" mm", "use a smaller roller, or a wider hollow")
         return
      end if
      if (.not. radius > 0.0_wp) return
      do k = 1, size(profile%u)
         call find_nearest(profile, profile%q(k, :), foot)
         p = profile%q(k, :) + radius*[foot%tangent(2), -foot%tangent(1)]
         call find_nearest(profile, p, elsewhere)
         if (norm2(p - elsewhere%q) >= radius*(1.0_wp - same)) cycle
         call fault%set("profile", "a roller of radius "//real_text(1.0e3_wp*radius, 4)//" mm on the profile at " &
                        //angle_text(profile, profile%u(k))//" touches at "//angle_text(profile, elsewhere%u)//" too", &
                        "use a smaller roller, or a wider hollow")
         return
      end do
   end subroutine check_follower

   !> The direction of a place of the profile.
   function angle_text(profile, u) result(words)
      type(profile_t), intent(in) :: profile    !! the profile
      real(wp), intent(in) :: u                 !! where [any]
      character(:), allocatable :: words        !! as "30 deg"

      integer :: k

      k = minloc(abs(profile%u - profile%range(1) - modulo(u - profile%range(1), profile%range(2) - profile%range(1))), dim=1)
      words = real_text(modulo(atan2(profile%q(k, 2), profile%q(k, 1))/degree, 360.0_wp), 4)//" deg"
   end function angle_text

end module clearance_cam
