!> Planar: stops of a joint: limits of its angle or its way, with a normal law where it goes beyond them.
!>
!> turning:   delta_upper = l sin(angle - upper),   delta_lower = l sin(lower - angle)
!> sliding:   delta_upper = s . d - upper,          delta_lower = lower - s . d
!>
!> angle = angle_j - angle_i, counter-clockwise; s the axis of the guide and d = r_j^P - r_i^P. A stop of an angle is a bumper on
!> body j, the lever l from the pin, against a flat face of body i through the pin: the hinge feels its force. Each is a
!> point against a plane, see `flat_contacts`, which has forces, rates, memory and energies.
!>
!> Signs: the reported force is that on body j. Source: Flores et al. (2008), section 3.1, a point against a plane. Limits: the
!> angles between the limits are less than half a turn, and none is farther than that beyond one of them; turns are not counted;
!> the law has a stiffness of its own, because a stop has no shape; masses of both bodies, not their moments of inertia, say how
!> hard an impact is for laws that ask.
module clearance_stop
   use bodies, only: material_t
   use flat_contacts, only: flat_contacts_t
   use item, only: item_t, place_of
   use kind_info, only: add_any_number, add_channel, add_number, add_reference, dim_angle, dim_length, &
      in_plane, kind_info_t, free_rotation, &
      same_dimension
   use kinds, only: pi, wp
   use point_contacts, only: add_contact_channels, of_force
   use surfaces, only: shape_face, surfaces_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: add_stop_columns, check_stop, clearance_stop_t, describe_stop, limits, lower, never, stop_labels, upper

   integer, parameter :: lower = 1               !! contact at the lower limit
   integer, parameter :: upper = 2               !! contact at the upper limit
   real(wp), parameter :: never = 1.0_wp         !! distance from a limit that a row omits, whatever the motion [m]
   character(5), parameter :: limits(2) = [character(5) :: "lower", "upper"]  !! their columns
   real(wp), parameter :: no_material = 1.0_wp   !! compliance of surfaces without a material: no stiffness comes of it [1/Pa]

   !> Stops of joints.
   type, extends(flat_contacts_t) :: clearance_stop_t
   contains
      procedure, nopass :: info => stop_info
      procedure, nopass :: contact_labels => stop_labels
      procedure :: prepare => stop_prepare
      procedure, nopass :: mistake => check_stop
      procedure, nopass :: describe => describe_stop
   end type clearance_stop_t

contains

   !> Description of the geometry.
   function stop_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.stop"
      info%space = in_plane
      info%help = "stops for the angle of a pin or the displacement of a guide; --ideal keeps them, as no ideal joint "// &
         "corresponds to them"
      info%source = "Flores et al. (2008), section 3.1"
      call add_stop_columns(info, "joint.revolute joint.translational")
      call add_contact_channels(info, "body of j", "t = R90 n")
   end function stop_info

   !> Columns of a stop, and its force.
   subroutine add_stop_columns(info, joints)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: joints        !! kinds of joints that it stops, blank-separated

      call add_reference(info, "joint", joints, "the joint with stops")
      call add_any_number(info, "lower", "lower limit of the angle of j relative to i, or of the displacement along the axis; "// &
         "default: none", default="")
      call add_any_number(info, "upper", "upper limit of the angle or displacement; default: none", default="")
      call add_number(info, "lever", dim_length, "for an angle: lever arm of the stop about the pin", default="0 m", lower=0.0_wp)
      call add_reference(info, "law", "contact.", "normal law with a stiffness, a row of a contact table")
      call add_channel(info, "force", "N", "world", 2, "force on the body of j", of_force)
   end subroutine add_stop_columns

   !> A contact for each limit.
   pure function stop_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (2) names

      allocate (labels(2))
      labels(lower)%s = "lower"
      labels(upper)%s = "upper"
   end function stop_labels

   !> Planes and points of each item.
   subroutine stop_prepare(self, items)
      class(clearance_stop_t), intent(inout) :: self   !! the set; what its joints leave is set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      real(wp) :: limit, side
      integer :: c, k, m

      call self%make_planes()
      do k = 1, self%n
         self%items%pairs(k)%clearance = items(k)%number("lever")
         do c = lower, upper
            m = 2*(k - 1) + c
            self%plane%point_j(:, m) = self%items%s_j(1:2, k)
            self%plane%height(m) = never
            if (.not. items(k)%is_given(limits(c))) cycle
            limit = items(k)%number(limits(c))
            side = merge(1.0_wp, -1.0_wp, c == upper)
            if (self%items%free(k) == free_rotation) then
               self%plane%point_j(1, m) = self%plane%point_j(1, m) + items(k)%number("lever")
               self%plane%normal_i(:, m) = side*[-sin(limit), cos(limit)]
               self%plane%height(m) = 0.0_wp
            else
               self%plane%normal_i(:, m) = side*self%items%slide_axis(:, k)
               self%plane%height(m) = side*limit
            end if
         end do
      end do
   end subroutine stop_prepare

   !> Limits there must be, of one dimension, in order, and less than half a turn apart; an angle needs a lever.
   subroutine check_stop(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      logical :: is_angle
      integer :: first

      column = 0
      message = ""
      help = "give lower, upper, or both"
      if (.not. (item%is_given("lower") .or. item%is_given("upper"))) then
         column = place_of(item, "joint")
         message = "stop '"//item%name//"' has no limit"
         return
      end if
      first = place_of(item, "lower")
      if (.not. item%is_given("lower")) first = place_of(item, "upper")
      associate (low => item%values(first), high => item%values(place_of(item, "upper")))
         is_angle = same_dimension(low%dimensions(1), dim_angle)
         if (high%given .and. .not. same_dimension(low%dimensions(1), high%dimensions(1))) then
            column = place_of(item, "upper")
            message = "the limits of stop '"//item%name//"' have different dimensions"
            help = "two angles, or two lengths"
         else if (.not. is_angle .and. .not. same_dimension(low%dimensions(1), dim_length)) then
            column = first
            message = "a limit of stop '"//item%name//"' is neither an angle nor a length"
            help = "an angle for a pin, a length for a guide"
         else if (item%is_given("lower") .and. high%given .and. high%number <= low%number) then
            column = place_of(item, "upper")
            message = "stop '"//item%name//"' leaves no range of motion"
            help = "upper must be greater than lower"
         else if (is_angle .and. item%is_given("lower") .and. high%given .and. high%number - low%number >= pi) then
            column = place_of(item, "upper")
            message = "the limits of stop '"//item%name//"' are half a revolution apart or more"
            help = "two stops with one limit each have the same restriction"
         else if (is_angle .and. item%number("lever") <= 0.0_wp) then
            column = place_of(item, "lever")
            message = "stop '"//item%name//"' of an angle has no lever arm"
            help = "give the lever arm of the stop about the pin"
         end if
      end associate
   end subroutine check_stop

   !> Faces without sides or material: only a law with a stiffness of its own fits them.
   pure subroutine describe_stop(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      pair%shape = shape_face
      pair%sigma_i = no_material
      pair%sigma_j = no_material
   end subroutine describe_stop

end module clearance_stop
