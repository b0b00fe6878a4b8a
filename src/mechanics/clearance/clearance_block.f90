!> A translational joint with clearance in space: a block of body j in a straight guide of rectangular section of body i.
!>
!> The guide's line goes through its point along z, its four surfaces lie on both sides of it along x and y, at half the
!> block's width (x) and height (y) plus the gap. The block has the same axes in body j where the deck puts the bodies, and is
!> `length` long. Its corners are A, B, C, D, counter-clockwise about z from the one at -x, -y, at the end of -z, and E, F, G, H at
!> the other. Each may touch the surface on its side along x and along y: contacts A_x, A_y ... H_y, with n = +-x or +-y and
!> h = half + gap in `plane_contacts`. A guide that ends, at `guide_start` and `guide_end` along z, has a front there, which a
!> corner that comes at it touches.
!>
!> Signs: the reported force is that on the block, world frame; the moment is that of the contact forces on it about its point.
!> Source: Flores et al. (2008), section 4.3, with the surfaces of space; stiffness that of a rounded corner on a plane. Limits: a
!> guide is not shorter than its block; faces and edges that lie flat touch with their corners.
module clearance_block
   use clearance_translational, only: add_guide_ends, describe_corner, find_end_mistake
   use item, only: item_t
   use kind_info, only: add_channel, add_direction, add_number, add_reference, add_word, dim_length, in_space, kind_info_t
   use kinds, only: wp
   use plane_contacts, only: plane_contacts_t
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force, of_moment, of_tilt
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_block_t

   integer, parameter :: n_corner = 8             !! corners of a block
   integer, parameter :: n_each = 2*n_corner      !! contacts of an item
   integer, parameter :: side(3, n_corner) = &    !! (3, corners) where they are along x, y and z
                         reshape([-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, &
                                  -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, n_corner])

   !> Blocks in guides, in space.
   type, extends(plane_contacts_t) :: clearance_block_t
   contains
      procedure, nopass :: info => block_info
      procedure, nopass :: contact_labels => block_labels
      procedure, nopass :: ideal_kind => block_ideal_kind
      procedure :: prepare => block_prepare
      procedure, nopass :: mistake => find_end_mistake
      procedure, nopass :: describe => describe_corner
   end type clearance_block_t

contains

   !> Description of the geometry.
   function block_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.translational"
      info%space = in_space
      info%help = "a block with clearance in a straight guide: dry contact of its corners with four surfaces"
      info%source = "Flores et al. (2008), section 4.3"
      call add_reference(info, "guide", "points", "point on the guide axis")
      call add_reference(info, "slider", "points", "centre of the block")
      call add_direction(info, "axis_i", "axis of the guide, in the frame of its body", default='"0 0 1"')
      call add_direction(info, "axis_j", "axis of the block, in the frame of its body; default: consistent with the given "// &
         "positions", &
                         default="")
      call add_direction(info, "width_axis", "direction of the width, in the frame of the guide's body; default: x of &
                         &the joint", default="")
      call add_number(info, "width", dim_length, "width of the block, across", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "height", dim_length, "height of the block, across axis and width", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "length", dim_length, "length of the block, along the axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "gap", dim_length, "clearance on each of the four sides", lower=0.0_wp)
      call add_number(info, "corner_radius", dim_length, "radius of the block corners, for the contact stiffness", lower=0.0_wp, &
                      open_lower=.true.)
      call add_guide_ends(info)
      call add_reference(info, "material", "material", "material of block and guide")
      call add_reference(info, "guide_material", "material", "material of the guide, if different", default="none")
      call add_word(info, "level", "model: an ideal translational joint, or clearance", default="clearance", &
                    choices="ideal clearance")
      call add_reference(info, "law", "contact.", "normal law of the corners, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the block relative to the guide axis", of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the block", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the block about its centre", of_moment)
      call add_channel(info, "tilt", "rad", "joint", 1, "angle between the axes of block and guide", of_tilt)
      call add_contact_channels(info, "block", "its sliding velocity")
   end function block_info

   !> Two contacts at each corner.
   pure function block_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (contacts of an item) names

      integer :: c

      allocate (labels(n_each))
      do c = 1, n_corner
         labels(2*c - 1)%s = achar(iachar("A") + c - 1)//"_x"
         labels(2*c)%s = achar(iachar("A") + c - 1)//"_y"
      end do
   end function block_labels

   !> Without clearance a translational joint.
   function block_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.translational"
   end function block_ideal_kind

   !> Corners and surfaces of each item.
   subroutine block_prepare(self, items)
      class(clearance_block_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      real(wp) :: half(3)
      integer :: across, corner, k, m

      call self%make_planes(items)
      self%traits%is_gap = .true.
      m = 0
      do k = 1, self%n
         associate (item => items(k))
            self%items%pairs(k)%clearance = item%number("gap")
            self%axes(k)%across = item%direction("width_axis")
            half = 0.5_wp*[item%number("width"), item%number("height"), item%number("length")]
            if (has_ends(item)) self%axes(k)%ends = [item%number("guide_start"), item%number("guide_end")]
         end associate
         do corner = 1, n_corner
            do across = 1, 2
               m = m + 1
               self%planes%normal(across, m) = side(across, corner)
               self%planes%point(:, m) = side(:, corner)*half
               self%planes%height(m) = half(across) + self%items%pairs(k)%clearance
            end do
         end do
      end do
   end subroutine block_prepare

   !> Whether the guide of a row has ends.
   pure logical function has_ends(item)
      type(item_t), intent(in) :: item  !! the row

      has_ends = max(abs(item%number("guide_start")), abs(item%number("guide_end"))) > 0.0_wp
   end function has_ends

end module clearance_block
