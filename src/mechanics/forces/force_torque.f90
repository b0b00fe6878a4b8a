!> A torque on a body, given by an expression in time, about z.
!>
!> power = m(t) w_z
!>
!> Signs: counter-clockwise positive. Source: Flores et al. (2008), section 2.3 (applied moments).
!> Limits: none.
module force_torque
   use bodies, only: points_t
   use expression, only: expression_t
   use force_set, only: force_set_t
   use item, only: item_t, place_of
   use kind_info, only: add_channel, add_expression, add_reference, dim_moment, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use observed_motion, only: value_of
   implicit none (type, external)
   private
   public :: force_torque_t

   ! channels
   integer, parameter :: of_moment = 1  !! moment
   integer, parameter :: of_power = 2   !! power given to the mechanism

   !> All torques.
   type, extends(force_set_t) :: force_torque_t
      integer, allocatable :: body(:)                !! (n) body of each torque
      type(expression_t), allocatable :: moment(:)   !! (n) moment about z [N.m]
   contains
      procedure, nopass :: info => torque_info
      procedure :: prepare => torque_prepare
      procedure :: evaluate => torque_evaluate
      procedure :: load_on => torque_load_on
      procedure :: report => torque_report
      procedure :: bodies_of => torque_bodies
   end type force_torque_t

contains

   !> Description of the kind.
   function torque_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.torque"
      info%space = in_plane
      info%help = "a torque on a body as a function of time and motion, positive counter-clockwise"
      info%source = "Flores et al. (2008), section 2.3"
      call add_reference(info, "body", "bodies", "the body")
      call add_expression(info, "moment", dim_moment, "moment about z", sees_motion=.true.)
      call add_channel(info, "moment", "N.m", "world", 1, "moment on the body", of_moment)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end function torque_info

   !> Make the set.
   subroutine torque_prepare(self, items, points)
      class(force_torque_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      type(points_t), intent(in) :: points          !! all points

      integer :: k

      self%n = size(items)
      allocate (self%names(self%n), self%body(self%n), self%moment(self%n))
      do k = 1, self%n
         self%names(k)%s = items(k)%name
         self%body(k) = items(k)%reference("body")
         self%moment(k) = items(k)%values(place_of(items(k), "moment"))%expression
      end do
   end subroutine torque_prepare

   !> Moment of one item.
   pure real(wp) function moment_of(self, k, t, motion) result(m)
      class(force_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities

      m = value_of(self%moment(k), t, motion)
   end function moment_of

   !> Add the loads of all items.
   subroutine torque_evaluate(self, t, motion, loads, power)
      class(force_torque_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(loads_t), intent(inout) :: loads      !! loads on the bodies
      real(wp), intent(inout) :: power           !! power given to the mechanism [W]

      real(wp) :: m
      integer :: k

      do k = 1, self%n
         m = moment_of(self, k, t, motion)
         loads%moment(3, self%body(k)) = loads%moment(3, self%body(k)) + m
         power = power + m*motion%omega(3, self%body(k))
      end do
   end subroutine torque_evaluate

   !> Load of an item on its body, a couple; there is none on the ground.
   subroutine torque_load_on(self, k, side, t, motion, force, moment, place)
      class(force_torque_t), intent(in) :: self  !! the set
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
      if (side == 2) moment = [0.0_wp, 0.0_wp, moment_of(self, k, t, motion)]
   end subroutine torque_load_on

   !> Values of a channel for all items.
   subroutine torque_report(self, code, t, motion, values)
      class(force_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                !! the channel
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(inout) :: values(:, :)    !! (components, n) values [N.m or W]

      integer :: k

      do k = 1, self%n
         select case (code)
         case (of_moment)
            values(1, k) = moment_of(self, k, t, motion)
         case (of_power)
            values(1, k) = moment_of(self, k, t, motion)*motion%omega(3, self%body(k))
         end select
      end do
   end subroutine torque_report

   !> The bodies that an item acts on.
   pure function torque_bodies(self, i) result(bodies)
      class(force_torque_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                      !! number of the item
      integer :: bodies(2)                          !! ground and the body

      bodies = [0, self%body(i)]
   end function torque_bodies

end module force_torque
