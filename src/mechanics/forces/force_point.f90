!> A force that acts at a body-fixed point, given by expressions in time and motion, world frame.
!>
!> f = ( fx, fy ) at r + A s';   power = f . v_P
!>
!> Signs: along the world axes. Source: Flores et al. (2008), section 2.3 (applied forces). Limits: none.
module force_point
   use bodies, only: points_t
   use expression, only: expression_t
   use force_set, only: force_set_t
   use item, only: item_t, place_of
   use kind_info, only: add_channel, add_expression, add_reference, dim_force, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: apply_force, loads_t, motion_t, point_position, point_velocity
   use observed_motion, only: value_of
   implicit none (type, external)
   private
   public :: force_point_t

   ! channels
   integer, parameter :: of_force = 1  !! force
   integer, parameter :: of_power = 2  !! power given to the mechanism

   !> All point forces.
   type, extends(force_set_t) :: force_point_t
      integer, allocatable :: body(:)             !! (n) body of each point
      real(wp), allocatable :: s(:, :)            !! (3, n) point in the body's frame [m]
      type(expression_t), allocatable :: fx(:)    !! (n) component along world x [N]
      type(expression_t), allocatable :: fy(:)    !! (n) component along world y [N]
   contains
      procedure, nopass :: info => point_info
      procedure :: prepare => point_prepare
      procedure :: evaluate => point_evaluate
      procedure :: load_on => point_load_on
      procedure :: report => point_report
      procedure :: bodies_of => point_bodies
   end type force_point_t

contains

   !> Description of the kind.
   function point_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.point"
      info%space = in_plane
      info%help = "a force at a body-fixed point; components along the world axes as functions of time and motion"
      info%source = "Flores et al. (2008), section 2.3"
      call add_reference(info, "point", "points", "where the force acts")
      call add_expression(info, "fx", dim_force, "component along world x", default="0 N", sees_motion=.true.)
      call add_expression(info, "fy", dim_force, "component along world y", default="0 N", sees_motion=.true.)
      call add_channel(info, "force", "N", "world", 2, "force on the body", of_force)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end function point_info

   !> Make the set.
   subroutine point_prepare(self, items, points)
      class(force_point_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)         !! (n) rows of the table
      type(points_t), intent(in) :: points         !! all points

      integer :: k, point

      self%n = size(items)
      allocate (self%names(self%n), self%body(self%n), self%s(3, self%n), self%fx(self%n), self%fy(self%n))
      do k = 1, self%n
         point = items(k)%reference("point")
         self%names(k)%s = items(k)%name
         self%body(k) = points%body(point)
         self%s(:, k) = points%s(:, point)
         self%fx(k) = items(k)%values(place_of(items(k), "fx"))%expression
         self%fy(k) = items(k)%values(place_of(items(k), "fy"))%expression
      end do
   end subroutine point_prepare

   !> Force of one item.
   pure function force_of(self, k, t, motion) result(f)
      class(force_point_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                  !! item
      real(wp), intent(in) :: t                 !! time [s]
      type(motion_t), intent(in) :: motion      !! positions and velocities
      real(wp) :: f(3)                          !! (3) force, world frame [N]

      f = [value_of(self%fx(k), t, motion), value_of(self%fy(k), t, motion), 0.0_wp]
   end function force_of

   !> Add the loads of all items.
   subroutine point_evaluate(self, t, motion, loads, power)
      class(force_point_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                 !! time [s]
      type(motion_t), intent(in) :: motion      !! positions and velocities
      type(loads_t), intent(inout) :: loads     !! loads on the bodies
      real(wp), intent(inout) :: power          !! power given to the mechanism [W]

      real(wp) :: f(3), p(3)
      integer :: k

      do k = 1, self%n
         f = force_of(self, k, t, motion)
         p = point_position(motion, self%body(k), self%s(:, k))
         call apply_force(loads, motion, self%body(k), p, f)
         power = power + dot_product(f, point_velocity(motion, self%body(k), p))
      end do
   end subroutine point_evaluate

   !> Load of an item on its body, at its point; there is none on the ground.
   subroutine point_load_on(self, k, side, t, motion, force, moment, place)
      class(force_point_t), intent(in) :: self  !! the set
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
      if (side == 2) force = force_of(self, k, t, motion)
   end subroutine point_load_on

   !> Values of a channel for all items.
   subroutine point_report(self, code, t, motion, values)
      class(force_point_t), intent(in) :: self  !! the set
      integer, intent(in) :: code               !! the channel
      real(wp), intent(in) :: t                 !! time [s]
      type(motion_t), intent(in) :: motion      !! positions and velocities
      real(wp), intent(inout) :: values(:, :)   !! (components, n) values [N or W]

      real(wp) :: f(3), p(3)
      integer :: k

      do k = 1, self%n
         f = force_of(self, k, t, motion)
         select case (code)
         case (of_force)
            values(:, k) = f(1:size(values, 1))
         case (of_power)
            p = point_position(motion, self%body(k), self%s(:, k))
            values(1, k) = dot_product(f, point_velocity(motion, self%body(k), p))
         end select
      end do
   end subroutine point_report

   !> The bodies that an item acts on.
   pure function point_bodies(self, i) result(bodies)
      class(force_point_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                     !! number of the item
      integer :: bodies(2)                         !! ground and the body

      bodies = [0, self%body(i)]
   end function point_bodies

end module force_point
