!> A translational joint with clearance in space: a block of body j loose in a straight guide of rectangular section of body i.
!>
!> The guide's line goes through its point along z, its four surfaces lie on both sides of it along x and y, at half the
!> block's width (x) and height (y) plus the gap. The block has the same axes in body j where the deck puts the bodies, and is
!> `length` long. Its corners are A, B, C, D, counter-clockwise about z from the one at -x, -y, at the end of -z, and E, F, G, H at
!> the other. Each may touch the surface on its side along x and along y: contacts A_x, A_y ... H_y. With a = +-x or +-y, fixed in
!> i, and d from the point of the guide to a corner
!>
!> n = a,   delta = a . d - (half + gap),   rate = a . w,   w = d' - omega_i x d,   delta'' = a . (w' as body i sees it),
!>
!> forces as in `point_contacts`, at the corner: C is the corner.
!>
!> Signs: the reported force is that on the block, world frame; the moment is that of the contact forces on it about its point.
!> Source: Flores et al. (2008), section 4.3, with the surfaces of space; stiffness that of a rounded corner on a plane. Limits: the
!> guide has no ends; faces and edges that lie flat touch with their corners.
module clearance_block
   use clearance_translational, only: describe_corner
   use clearance_set, only: loss_contact, loss_friction, no_mistake
   use contact_grip, only: tangent_t
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use item, only: item_t
   use joint_frames, only: find_frames
   use kind_info, only: add_channel, add_direction, add_number, add_reference, add_word, dim_length, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: cross, loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: point_contact_t
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force, of_moment, point_contacts_t
   use space_tangents, only: lie_in_space, set_sliding, spatial_force
   use spatial_rows, only: axis_of
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_block_t

   integer, parameter :: of_tilt = 41             !! channel: angle between the axes of block and guide
   integer, parameter :: n_corner = 8             !! corners of a block
   integer, parameter :: n_each = 2*n_corner      !! contacts of an item
   integer, parameter :: side(3, n_corner) = &    !! (3, corners) where they are along x, y and z
                         reshape([-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, &
                                  -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, n_corner])

   !> Block and guide of an item.
   type :: block_t
      real(wp) :: axis_i(3) = 0.0_wp          !! (3) of the guide, as in the deck [1]
      real(wp) :: axis_j(3) = 0.0_wp          !! (3) of the block, as in the deck; zero: left out [1]
      real(wp) :: width_axis(3) = 0.0_wp      !! (3) x in the body of i, as in the deck; zero: left out [1]
      real(wp) :: half(3) = 0.0_wp            !! (3) half of width, height and length [m]
      real(wp) :: frame_i(3, 3) = 0.0_wp      !! (3, 3) x, y, z as columns, frame of body i [1]
      real(wp) :: frame_j(3, 3) = 0.0_wp      !! (3, 3) the same, frame of body j [1]
   end type block_t

   !> Blocks in guides, in space.
   type, extends(point_contacts_t) :: clearance_block_t
      type(block_t), allocatable, private :: block(:)   !! (n) blocks and guides
   contains
      procedure, nopass :: info => block_info
      procedure, nopass :: contact_labels => block_labels
      procedure, nopass :: ideal_kind => block_ideal_kind
      procedure :: prepare => block_prepare
      procedure :: set_start => block_set_start
      procedure, nopass :: mistake => no_mistake
      procedure, nopass :: describe => describe_corner
      procedure :: span_of => block_span_of
      procedure :: evaluate => block_evaluate
      procedure :: measure => block_measure
      procedure :: penetration_acceleration => block_penetration_acceleration
      procedure :: lie => block_lie
      procedure, nopass :: force_on_j => spatial_force
      procedure :: report_item => block_report_item
   end type clearance_block_t

contains

   !> What the geometry says of itself.
   function block_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.translational"
      info%space = in_space
      info%help = "a block loose in a straight guide: dry contact of its corners with four surfaces"
      info%source = "Flores et al. (2008), section 4.3"
      call add_reference(info, "guide", "points", "point on the guide's line")
      call add_reference(info, "slider", "points", "centre of the block")
      call add_direction(info, "axis_i", "axis of the guide, in the frame of its body", default='"0 0 1"')
      call add_direction(info, "axis_j", "axis of the block, in the frame of its body; left out: as the deck puts the bodies", &
                         default="")
      call add_direction(info, "width_axis", "direction of the width, in the frame of the guide's body; left out: x of &
                         &the joint", default="")
      call add_number(info, "width", dim_length, "width of the block, across", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "height", dim_length, "height of the block, across axis and width", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "length", dim_length, "length of the block, along the axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "gap", dim_length, "clearance on each of the four sides", lower=0.0_wp)
      call add_number(info, "corner_radius", dim_length, "radius of the block's corners, for their stiffness", lower=0.0_wp, &
                      open_lower=.true.)
      call add_reference(info, "material", "material", "material of block and guide")
      call add_reference(info, "guide_material", "material", "material of the guide, if another", default="none")
      call add_word(info, "level", "fidelity: an ideal translational joint, or clearance", default="clearance", &
                    choices="ideal clearance")
      call add_reference(info, "law", "contact.", "normal law of the corners, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the block from the guide's line", of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the block", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the block about its centre", of_moment)
      call add_channel(info, "tilt", "rad", "joint", 1, "angle between the axes of block and guide", of_tilt)
      call add_contact_channels(info, "block", "its sliding velocity")
   end function block_info

   !> Two contacts at each corner.
   function block_labels() result(labels)
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

   !> Sizes and axes of each item, these as in the deck.
   subroutine block_prepare(self, items)
      class(clearance_block_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      integer :: k

      call self%make_room()
      allocate (self%block(self%n))
      do k = 1, self%n
         associate (item => items(k), block => self%block(k))
            self%items%clearance(k) = item%number("gap")
            block%half = 0.5_wp*[item%number("width"), item%number("height"), item%number("length")]
            block%axis_i = item%direction("axis_i")
            block%axis_j = item%direction("axis_j")
            block%width_axis = item%direction("width_axis")
         end associate
      end do
   end subroutine block_prepare

   !> Axes in the frames of the bodies.
   subroutine block_set_start(self, motion)
      class(clearance_block_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion             !! bodies where the deck puts them

      real(wp) :: turn(3, 3), x(3)
      integer :: k

      do k = 1, self%n
         associate (block => self%block(k), own => motion%spatial%own, i => self%items%body(1, k))
            call find_frames(motion, self%items%body(:, k), block%axis_i, block%axis_j, .true., block%frame_i, block%frame_j)
            if (.not. any(abs(block%width_axis) > 0.0_wp)) cycle
            x = matmul(block%width_axis, matmul(own(:, :, i), block%frame_i))  ! along the joint's axes
            x(3) = 0.0_wp
            if (.not. norm2(x) > 0.0_wp) cycle
            x = x/norm2(x)
            turn = reshape([x(1), x(2), 0.0_wp, -x(2), x(1), 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
            block%frame_i = matmul(block%frame_i, turn)
            block%frame_j = matmul(block%frame_j, turn)
         end associate
      end do
   end subroutine block_set_start

   !> How far what takes part in a contact is from the centres of mass of both bodies.
   pure function block_span_of(self, contact) result(span)
      class(clearance_block_t), intent(in) :: self    !! the set
      integer, intent(in) :: contact                  !! contact of the set
      real(wp) :: span(2)                             !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))), sum(abs(self%items%s_j(:, item)))] + sum(self%block(item)%half) &
                + self%items%clearance(item)
      end associate
   end function block_span_of

   !> Add the contact forces of the touching contacts.
   subroutine block_evaluate(self, motion, loads, losses)
      class(clearance_block_t), intent(inout) :: self       !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout), contiguous :: losses(:, :)   !! (2, all contacts) power lost [W]

      include "point_way.inc"
   end subroutine block_evaluate

   include "press.inc"
   include "spatial_loads.inc"

   !> Measure the contacts that touch, all of them where they act apart, with their sliding velocities where there is friction.
   subroutine measure_touching(self, motion)
      class(clearance_block_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion             !! positions and velocities

      integer :: k

      do k = 1, self%n_contact
         if (.not. (self%contact(k)%is_touching .or. self%laws%normal%acts_apart)) cycle
         call block_measure(self, k, allocated(self%laws%friction), motion, self%work%contacts(k))
      end do
   end subroutine measure_touching

   !> Normal, penetration, its rate and arms of a contact; its sliding velocity where it is asked for.
   pure subroutine block_measure(self, k, with_sliding, motion, contact)
      class(clearance_block_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      real(wp) :: arm(3), d(3), w(3)
      integer :: across, corner, item

      item = (k - 1)/n_each + 1
      corner = (k - (item - 1)*n_each + 1)/2
      across = k - (item - 1)*n_each - 2*(corner - 1)
      associate (block => self%block(item), i => self%items%body(1, item), j => self%items%body(2, item))
         contact%normal = axis_of(motion, i, side(across, corner)*block%frame_i(:, across))
         arm = self%items%s_j(:, item) + matmul(block%frame_j, side(:, corner)*block%half)
         contact%arm_j = axis_of(motion, j, arm)
         contact%arm_i = motion%r(:, j) + contact%arm_j - motion%r(:, i)
         d = contact%arm_i - axis_of(motion, i, self%items%s_i(:, item))
         w = motion%v(:, j) + cross(motion%omega(:, j), contact%arm_j) - motion%v(:, i) - cross(motion%omega(:, i), contact%arm_i)
         contact%delta = dot_product(contact%normal, d) - block%half(across) - self%items%clearance(item)
         contact%rate = dot_product(contact%normal, w)
         if (with_sliding) call set_sliding(motion, i, j, contact)
      end associate
   end subroutine block_measure

   !> Second derivative of a penetration by time.
   pure real(wp) function block_penetration_acceleration(self, k, motion, contact) result(acceleration)
      class(clearance_block_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contact   !! its kinematics

      real(wp) :: a(3), turn_i(3), turn_j(3)
      integer :: item

      item = (k - 1)/n_each + 1
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         turn_i = cross(motion%omega(:, i), contact%arm_i)
         turn_j = cross(motion%omega(:, j), contact%arm_j)
         a = motion%a(:, j) + cross(motion%alpha(:, j), contact%arm_j) + cross(motion%omega(:, j), turn_j) - motion%a(:, i) &
             - cross(motion%alpha(:, i), contact%arm_i) - cross(motion%omega(:, i), turn_i) &
             - 2.0_wp*cross(motion%omega(:, i), motion%v(:, j) + turn_j - motion%v(:, i) - turn_i)
      end associate
      acceleration = dot_product(contact%normal, a)
   end function block_penetration_acceleration

   !> How a contact lies: the normal turns with body i, C stays in body j.
   subroutine block_lie(self, k, motion, tangent)
      class(clearance_block_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                       !! contact
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(tangent_t), intent(inout) :: tangent      !! how it lies; its forces and its way are left alone

      type(point_contact_t) :: contact
      integer :: item

      item = (k - 1)/n_each + 1
      call block_measure(self, k, .true., motion, contact)
      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         call lie_in_space(motion, i, j, contact, contact%normal, cross(motion%omega(:, i), contact%normal), &
                           cross(motion%omega(:, j), contact%arm_j), tangent)
      end associate
   end subroutine block_lie

   !> Centre of the block from the guide's line, moment of the forces about it, and tilt.
   subroutine block_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(clearance_block_t), intent(in) :: self        !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(:)    !! (contacts of an item) their kinematics
      real(wp), intent(in) :: f_n(:)                      !! (contacts of an item) normal forces [N]
      real(wp), intent(in) :: f_t(:)                      !! (contacts of an item) friction forces on j along t [N]
      real(wp), intent(inout) :: value(:)                 !! (components) the value [any]

      real(wp) :: centre(3), d(3), u(3)
      integer :: c

      associate (i => self%items%body(1, item), j => self%items%body(2, item))
         centre = axis_of(motion, j, self%items%s_j(:, item))
         u = axis_of(motion, i, self%block(item)%frame_i(:, 3))
         select case (code)
         case (of_eccentricity)
            d = motion%r(:, j) + centre - motion%r(:, i) - axis_of(motion, i, self%items%s_i(:, item))
            value = d - dot_product(d, u)*u
         case (of_moment)
            value = 0.0_wp
            do c = 1, size(contacts)
               value = value + cross(contacts(c)%arm_j - centre, self%force_on_j(contacts(c), f_n(c), f_t(c)))
            end do
         case (of_tilt)
            d = axis_of(motion, j, self%block(item)%frame_j(:, 3))
            value = atan2(norm2(cross(u, d)), dot_product(u, d))
         end select
      end associate
   end subroutine block_report_item

end module clearance_block
