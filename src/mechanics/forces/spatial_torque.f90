!> A torque on a body in space, given by expressions in time, along the axes of the world or of the body.
!>
!> m = ( mx(t), my(t), mz(t) );   power = m . omega
!>
!> Signs: counter-clockwise observed from the tips of the axes named. Source: Flores et al. (2008), section 6.2. Limits: none.
module spatial_torque
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, add_expression, add_reference, add_word, dim_moment, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use vector_load, only: vector_load_t
   implicit none (type, external)
   private
   public :: spatial_torque_t

   ! channels
   integer, parameter :: of_moment = 1  !! moment
   integer, parameter :: of_power = 2   !! power given to the mechanism

   !> All torques of a spatial scene.
   type, extends(force_set_t) :: spatial_torque_t
      integer, allocatable :: body(:)                !! (n) body of each item
      type(vector_load_t), allocatable :: moment(:)  !! (n) the torques [N.m]
   contains
      procedure, nopass :: info => torque_info
      procedure :: prepare => torque_prepare
      procedure :: evaluate => torque_evaluate
      procedure :: load_on => torque_load_on
      procedure :: report => torque_report
      procedure :: bodies_of => torque_bodies
   end type spatial_torque_t

contains

   !> Description of the kind.
   function torque_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.torque"
      info%space = in_space
      info%help = "a torque on a body, components as functions of time and motion"
      info%source = "Flores et al. (2008), section 6.2"
      call add_reference(info, "body", "bodies", "the body")
      call add_expression(info, "mx", dim_moment, "component along x", default="0 N.m", sees_motion=.true.)
      call add_expression(info, "my", dim_moment, "component along y", default="0 N.m", sees_motion=.true.)
      call add_expression(info, "mz", dim_moment, "component along z", default="0 N.m", sees_motion=.true.)
      call add_word(info, "frame", "frame of the components", default="world", choices="world body")
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the body", of_moment)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end function torque_info

   !> Make the set.
   subroutine torque_prepare(self, items, points)
      class(spatial_torque_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table
      type(points_t), intent(in) :: points            !! all points

      integer :: k

      self%n = size(items)
      allocate (self%names(self%n), self%body(self%n), self%moment(self%n))
      do k = 1, self%n
         self%names(k)%s = items(k)%name
         self%body(k) = items(k)%reference("body")
         call self%moment(k)%prepare(items(k), ["mx", "my", "mz"])
      end do
   end subroutine torque_prepare

   !> Add the loads of all items.
   subroutine torque_evaluate(self, t, motion, loads, power)
      class(spatial_torque_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(loads_t), intent(inout) :: loads        !! loads on the bodies
      real(wp), intent(inout) :: power             !! power given to the mechanism [W]

      real(wp) :: m(3)
      integer :: k

      do k = 1, self%n
         m = self%moment(k)%at(t, motion, self%body(k))
         loads%moment(:, self%body(k)) = loads%moment(:, self%body(k)) + m
         power = power + dot_product(m, motion%omega(:, self%body(k)))
      end do
   end subroutine torque_evaluate

   !> Load of an item on its body, a couple; there is none on the ground.
   subroutine torque_load_on(self, k, side, t, motion, force, moment, place)
      class(spatial_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: side                !! 2: on the body
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: force(3)          !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)         !! (3) about the place, world frame [N.m]
      real(wp), intent(out) :: place(3)          !! (3) the centre of mass, world frame [m]

      force = 0.0_wp
      moment = 0.0_wp
      place = motion%r(:, self%body(k))
      if (side == 2) moment = self%moment(k)%at(t, motion, self%body(k))
   end subroutine torque_load_on

   !> Values of a channel for all items.
   subroutine torque_report(self, code, t, motion, values)
      class(spatial_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                  !! the channel
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      real(wp), intent(inout) :: values(:, :)      !! (components, n) values [N.m or W]

      real(wp) :: m(3)
      integer :: k

      do k = 1, self%n
         m = self%moment(k)%at(t, motion, self%body(k))
         if (code == of_moment) values(:, k) = m
         if (code == of_power) values(1, k) = dot_product(m, motion%omega(:, self%body(k)))
      end do
   end subroutine torque_report

   !> The bodies that an item acts on.
   pure function torque_bodies(self, i) result(bodies)
      class(spatial_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                     !! number of the item
      integer :: bodies(2)                         !! ground and the body

      bodies = [0, self%body(i)]
   end function torque_bodies

end module spatial_torque
