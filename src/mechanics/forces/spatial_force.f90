!> A force that acts at a body-fixed point in space, given by expressions in time, along the axes of the world or of the body.
!>
!> f = ( fx(t), fy(t), fz(t) ) at r + A s';   power = f . v_P
!>
!> Signs: along the axes named. Source: Flores et al. (2008), section 6.2 (applied forces). Limits: none.
module spatial_force
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, add_expression, add_reference, add_word, dim_force, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: apply_force, loads_t, motion_t, point_position, point_velocity
   use vector_load, only: vector_load_t
   implicit none (type, external)
   private
   public :: spatial_force_t

   ! channels
   integer, parameter :: of_force = 1  !! force
   integer, parameter :: of_power = 2  !! power given to the mechanism

   !> All point forces of a spatial scene.
   type, extends(force_set_t) :: spatial_force_t
      integer, allocatable :: body(:)               !! (n) body of each point
      real(wp), allocatable :: s(:, :)              !! (3, n) point in the body's frame [m]
      type(vector_load_t), allocatable :: force(:)  !! (n) the forces [N]
   contains
      procedure, nopass :: info => force_info
      procedure :: prepare => force_prepare
      procedure :: evaluate => force_evaluate
      procedure :: load_on => force_load_on
      procedure :: report => force_report
      procedure :: bodies_of => force_bodies
   end type spatial_force_t

contains

   !> Description of the kind.
   function force_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.point"
      info%space = in_space
      info%help = "a force at a body-fixed point, components as functions of time and motion"
      info%source = "Flores et al. (2008), section 6.2"
      call add_reference(info, "point", "points", "where the force acts")
      call add_expression(info, "fx", dim_force, "component along x", default="0 N", sees_motion=.true.)
      call add_expression(info, "fy", dim_force, "component along y", default="0 N", sees_motion=.true.)
      call add_expression(info, "fz", dim_force, "frame of the components", default="0 N", sees_motion=.true.)
      call add_word(info, "frame", "whose axes x, y, z are", default="world", choices="world body")
      call add_channel(info, "force", "N", "world", 2, "force on the body", of_force)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end function force_info

   !> Make the set.
   subroutine force_prepare(self, items, points)
      class(spatial_force_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      type(points_t), intent(in) :: points           !! all points

      integer :: k, point

      self%n = size(items)
      allocate (self%names(self%n), self%body(self%n), self%s(3, self%n), self%force(self%n))
      do k = 1, self%n
         point = items(k)%reference("point")
         self%names(k)%s = items(k)%name
         self%body(k) = points%body(point)
         self%s(:, k) = points%s(:, point)
         call self%force(k)%prepare(items(k), ["fx", "fy", "fz"])
      end do
   end subroutine force_prepare

   !> Add the loads of all items.
   subroutine force_evaluate(self, t, motion, loads, power)
      class(spatial_force_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                   !! time [s]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(loads_t), intent(inout) :: loads       !! loads on the bodies
      real(wp), intent(inout) :: power            !! power given to the mechanism [W]

      real(wp) :: f(3), p(3)
      integer :: k

      do k = 1, self%n
         f = self%force(k)%at(t, motion, self%body(k))
         p = point_position(motion, self%body(k), self%s(:, k))
         call apply_force(loads, motion, self%body(k), p, f)
         power = power + dot_product(f, point_velocity(motion, self%body(k), p))
      end do
   end subroutine force_evaluate

   !> Load of an item on its body, at its point; there is none on the ground.
   subroutine force_load_on(self, k, side, t, motion, force, moment, place)
      class(spatial_force_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: side                !! 2: on the body
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: force(3)          !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)         !! (3) about the place, world frame [N.m]
      real(wp), intent(out) :: place(3)          !! (3) the point, world frame [m]

      force = 0.0_wp
      moment = 0.0_wp
      place = point_position(motion, self%body(k), self%s(:, k))
      if (side == 2) force = self%force(k)%at(t, motion, self%body(k))
   end subroutine force_load_on

   !> Values of a channel for all items.
   subroutine force_report(self, code, t, motion, values)
      class(spatial_force_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                 !! the channel
      real(wp), intent(in) :: t                   !! time [s]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(inout) :: values(:, :)     !! (components, n) values [N or W]

      real(wp) :: f(3), p(3)
      integer :: k

      do k = 1, self%n
         f = self%force(k)%at(t, motion, self%body(k))
         p = point_position(motion, self%body(k), self%s(:, k))
         if (code == of_force) values(:, k) = f
         if (code == of_power) values(1, k) = dot_product(f, point_velocity(motion, self%body(k), p))
      end do
   end subroutine force_report

   !> The bodies that an item acts on.
   pure function force_bodies(self, i) result(bodies)
      class(spatial_force_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                    !! number of the item
      integer :: bodies(2)                        !! ground and the body

      bodies = [0, self%body(i)]
   end function force_bodies

end module spatial_force
