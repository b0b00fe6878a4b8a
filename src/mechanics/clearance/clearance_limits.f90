!> Stops of a joint in space: limits of its angle or of its way, with a normal law where it goes beyond them.
!>
!> turning:   delta_upper = l sin(angle - upper),   delta_lower = l sin(lower - angle)
!> sliding:   delta_upper = z . d - upper,          delta_lower = lower - z . d
!>
!> angle, of j against i, and z are those of the joint (`spatial_joint`), d = r_j^P - r_i^P. A stop of an angle is a bumper on body
!> j along x of the joint, the lever l from its axis, against a flat face of body i through the axis; one of a way is the point of j
!> against a plane across the axis. So each is a point against a plane, see `plane_contacts`.
!>
!> Signs: the reported force is that on body j. Source: Flores et al. (2008), section 3.1, a point against a plane. Limits: those of
!> `clearance_stop`; the face of an angle is as long as the joint's way.
module clearance_limits
   use clearance_stop, only: add_stop_columns, check_stop, describe_stop, limits, lower, never, stop_labels, upper
   use item, only: item_t, place_of
   use joint_set, only: joint_set_t
   use kind_info, only: dim_angle, in_space, kind_info_t, same_dimension
   use kinds, only: wp
   use motion, only: motion_t
   use plane_contacts, only: plane_contacts_t
   use point_contacts, only: add_contact_channels
   use spatial_joint, only: spatial_joint_t
   implicit none (type, external)
   private
   public :: clearance_limits_t

   !> Stops of joints, in space.
   type, extends(plane_contacts_t) :: clearance_limits_t
   contains
      procedure, nopass :: info => limits_info
      procedure, nopass :: contact_labels => stop_labels
      procedure :: prepare => limits_prepare
      procedure :: take_joint => limits_take_joint
      procedure :: find_axes => limits_find_axes
      procedure, nopass :: mistake => check_stop
      procedure, nopass :: describe => describe_stop
   end type clearance_limits_t

contains

   !> Description of the geometry.
   function limits_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.stop"
      info%space = in_space
      info%help = "stops for the angle or displacement of a joint; --ideal keeps them, as no ideal joint corresponds to them"
      info%source = "Flores et al. (2008), section 3.1"
      call add_stop_columns(info, "joint.revolute joint.cylindrical joint.translational joint.screw")
      call add_contact_channels(info, "body of j", "its sliding velocity")
   end function limits_info

   !> Planes and points of each item.
   subroutine limits_prepare(self, items)
      class(clearance_limits_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)              !! (n) rows of the table

      real(wp) :: limit, side
      integer :: c, k, m

      call self%make_planes(items)
      do k = 1, self%n
         self%items%pairs(k)%clearance = items(k)%number("lever")
         do c = lower, upper
            m = 2*(k - 1) + c
            self%planes%height(m) = never
            if (.not. items(k)%is_given(limits(c))) cycle
            limit = items(k)%number(limits(c))
            side = merge(1.0_wp, -1.0_wp, c == upper)
            if (same_dimension(items(k)%values(place_of(items(k), limits(c)))%dimensions(1), dim_angle)) then
               self%planes%point(1, m) = items(k)%number("lever")
               self%planes%normal(:, m) = side*[-sin(limit), cos(limit), 0.0_wp]
               self%planes%height(m) = 0.0_wp
            else
               self%planes%normal(:, m) = side*[0.0_wp, 0.0_wp, 1.0_wp]
               self%planes%height(m) = side*limit
            end if
         end do
      end do
   end subroutine limits_prepare

   !> The axes of an item are those of its joint.
   subroutine limits_take_joint(self, k, joint)
      class(clearance_limits_t), intent(inout) :: self  !! the set, prepared
      integer, intent(in) :: k                          !! item
      class(joint_set_t), intent(in) :: joint           !! a set of one item, the joint, with its start

      select type (joint)
      class is (spatial_joint_t)
         self%axes(k)%frame_i = joint%axes%frame_i(:, :, 1)
         self%axes(k)%frame_j = joint%axes%frame_j(:, :, 1)
      end select
   end subroutine limits_take_joint

   !> They are known.
   subroutine limits_find_axes(self, motion)
      class(clearance_limits_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion              !! bodies where the deck puts them
   end subroutine limits_find_axes

end module clearance_limits
