!> Where bodies and contacts are at a sample: read from the catalogue, for what draws a mechanism.
module scene_poses
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_bodies, group_clearances, group_contacts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use rotations, only: rotation_about, rotation_of_parameters
   implicit none (type, external)
   private
   public :: at_contact, contact_value, pose_reader_t, velocity_at

   !> Numbers of a contact that are read, in this order.
   integer, parameter, public :: contact_penetration = 1, contact_force = 2, contact_state = 3

   !> The groups of the catalogue that are read, 0: there is none.
   type :: pose_reader_t
      integer :: n_body = 0               !! bodies without the ground
      integer :: n_contact = 0            !! contacts
      integer :: position = 0             !! of centres of mass
      integer :: turn = 0                 !! angle, in space Euler parameters
      integer :: velocity = 0             !! of centres of mass
      integer :: spin = 0                 !! angular velocity
      integer :: point = 0                !! of contacts
      integer :: of_contact(3) = 0        !! (3) numbers of contacts, see above
      integer :: joint_force = 0          !! of joints with clearance: on the journal
   contains
      procedure :: bind
      procedure :: reads
      procedure :: frames
      procedure :: rates
   end type pose_reader_t

contains

   !> Find the groups.
   subroutine bind(self, catalogue)
      class(pose_reader_t), intent(out) :: self   !! the groups
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded

      self%n_body = size(catalogue%item_groups(group_bodies)%names)
      self%n_contact = size(catalogue%item_groups(group_contacts)%names)
      self%position = catalogue%find_group(group_bodies, "position")
      self%turn = catalogue%find_group(group_bodies, "angle")
      if (self%turn == 0) self%turn = catalogue%find_group(group_bodies, "orientation")
      self%velocity = catalogue%find_group(group_bodies, "velocity")
      self%spin = catalogue%find_group(group_bodies, "angular_velocity")
      self%point = catalogue%find_group(group_contacts, "contact_point")
      self%of_contact(contact_penetration) = catalogue%find_group(group_contacts, "penetration")
      self%of_contact(contact_force) = catalogue%find_group(group_contacts, "normal_force")
      self%of_contact(contact_state) = catalogue%find_group(group_contacts, "state")
      self%joint_force = catalogue%find_group(group_clearances, "force")
   end subroutine bind

   !> Whether a group is read.
   pure logical function reads(self, group)
      class(pose_reader_t), intent(in) :: self  !! the groups
      integer, intent(in) :: group              !! number of the group

      reads = any([self%position, self%turn, self%velocity, self%spin, self%point, self%of_contact, self%joint_force] == group)
   end function reads

   !> Places and orientations of all bodies, the ground among them.
   pure subroutine frames(self, catalogue, r, a)
      class(pose_reader_t), intent(in) :: self    !! the groups
      type(catalogue_t), intent(in) :: catalogue  !! values
      real(wp), intent(out) :: r(:, 0:)           !! (3, 0:bodies) centres of mass, world frame [m]
      real(wp), intent(out) :: a(:, :, 0:)        !! (3, 3, 0:bodies) own frames to the world's [1]

      integer :: k, n

      r = 0.0_wp
      a(:, :, 0) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      n = catalogue%n_coordinates
      do k = 1, self%n_body
         r(:n, k) = catalogue%value(self%position, k)
         associate (turn => catalogue%value(self%turn, k))
            if (size(turn) == 1) then
               a(:, :, k) = rotation_about([0.0_wp, 0.0_wp, 1.0_wp], turn(1))
            else
               a(:, :, k) = rotation_of_parameters(turn)
            end if
         end associate
      end do
   end subroutine frames

   !> Velocities of all bodies, the ground among them.
   pure subroutine rates(self, catalogue, v, w)
      class(pose_reader_t), intent(in) :: self    !! the groups
      type(catalogue_t), intent(in) :: catalogue  !! values
      real(wp), intent(out) :: v(:, 0:)           !! (3, 0:bodies) of centres of mass, world frame [m/s]
      real(wp), intent(out) :: w(:, 0:)           !! (3, 0:bodies) angular velocities, world frame [rad/s]

      integer :: k, n

      v = 0.0_wp
      w = 0.0_wp
      n = catalogue%n_coordinates
      do k = 1, self%n_body
         v(:n, k) = catalogue%value(self%velocity, k)
         associate (spin => catalogue%value(self%spin, k))
            if (size(spin) == 1) then
               w(3, k) = spin(1)
            else
               w(:, k) = spin
            end if
         end associate
      end do
   end subroutine rates

   !> Velocity of a place of a body.
   pure function velocity_at(v, w, arm) result(velocity)
      real(wp), intent(in) :: v(3)     !! (3) of the centre of mass [m/s]
      real(wp), intent(in) :: w(3)     !! (3) angular velocity [rad/s]
      real(wp), intent(in) :: arm(3)   !! (3) the place from the centre of mass, world frame [m]
      real(wp) :: velocity(3)          !! (3) world frame [m/s]

      velocity = v + [w(2)*arm(3) - w(3)*arm(2), w(3)*arm(1) - w(1)*arm(3), w(1)*arm(2) - w(2)*arm(1)]
   end function velocity_at

   !> Where a contact is; the origin if that is not known.
   pure function at_contact(reader, catalogue, k) result(x)
      type(pose_reader_t), intent(in) :: reader   !! the groups
      type(catalogue_t), intent(in) :: catalogue  !! values
      integer, intent(in) :: k                    !! the contact
      real(wp) :: x(3)                            !! (3) world frame [m]

      x = 0.0_wp
      if (reader%point == 0) return
      associate (values => catalogue%value(reader%point, k))
         if (.not. any(ieee_is_nan(values))) x(:size(values)) = values
      end associate
   end function at_contact

   !> A number of a contact; zero if it is not known.
   pure real(wp) function contact_value(reader, catalogue, quantity, k) result(value)
      type(pose_reader_t), intent(in) :: reader   !! the groups
      type(catalogue_t), intent(in) :: catalogue  !! values
      integer, intent(in) :: quantity             !! one of `contact_...`
      integer, intent(in) :: k                    !! the contact

      value = 0.0_wp
      if (reader%of_contact(quantity) == 0) return
      value = catalogue%values(catalogue%place(reader%of_contact(quantity), 1, k))
      if (ieee_is_nan(value)) value = 0.0_wp
   end function contact_value

end module scene_poses
