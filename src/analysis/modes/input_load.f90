!> A load that is an input of a linearised mechanism: a force on a point of a body, or a moment, in axes of the world.
!>
!> It stands beside the loads of the deck while derivatives by it are taken. Limits: none.
module input_load
   use bodies, only: points_t
   use force_set, only: force_set_t, force_slot_t
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use loading, only: loading_t
   use motion, only: cross, loads_t, motion_t
   implicit none (type, external)
   private
   public :: add_input_load, input_load_t, set_input_load

   !> The load; its amplitude is set by who takes derivatives.
   type, extends(force_set_t) :: input_load_t
      integer :: body = 0                    !! it acts on
      real(wp) :: arm(3) = 0.0_wp            !! (3) point of the force, body frame, from the centre of mass [m]
      real(wp) :: force(3) = 0.0_wp          !! (3) world frame [N]
      real(wp) :: moment(3) = 0.0_wp         !! (3) world frame [N.m]
   contains
      procedure, nopass :: info => input_info
      procedure :: prepare => input_prepare
      procedure :: evaluate => input_evaluate
      procedure :: report => input_report
      procedure :: bodies_of => input_bodies
   end type input_load_t

contains

   !> Put a load without amplitude beside the loads of a mechanism.
   subroutine add_input_load(loading)
      type(loading_t), intent(inout) :: loading    !! loads of the mechanism

      type(force_slot_t), allocatable :: slots(:)
      integer :: k

      allocate (slots(size(loading%forces) + 1))
      do k = 1, size(loading%forces)
         call move_alloc(loading%forces(k)%set, slots(k)%set)
      end do
      allocate (input_load_t :: slots(size(slots))%set)
      call move_alloc(slots, loading%forces)
      loading%n_set = loading%n_set + 1
      loading%loads%is_weight = .false.
   end subroutine add_input_load

   !> Set the load that was added.
   subroutine set_input_load(loading, body, arm, force, moment)
      type(loading_t), intent(inout) :: loading    !! loads of the mechanism
      integer, intent(in) :: body                  !! it acts on
      real(wp), intent(in) :: arm(3)               !! (3) point of the force, body frame [m]
      real(wp), intent(in) :: force(3)             !! (3) world frame [N]
      real(wp), intent(in) :: moment(3)            !! (3) world frame [N.m]

      select type (set => loading%forces(size(loading%forces))%set)
      type is (input_load_t)
         set%body = body
         set%arm = arm
         set%force = force
         set%moment = moment
      end select
   end subroutine set_input_load

   !> It stands in no deck.
   function input_info() result(info)
      type(kind_info_t) :: info  !! a name only

      info%name = "input"
      info%help = "a load that is an input of a linearised mechanism"
      info%source = ""
   end function input_info

   !> It has no rows.
   subroutine input_prepare(self, items, points)
      class(input_load_t), intent(inout) :: self    !! the load
      type(item_t), intent(in) :: items(:)          !! (0) rows of a table
      type(points_t), intent(in) :: points          !! all points

      self%n = 0*(size(items) + size(points%body))
   end subroutine input_prepare

   !> Add the load.
   subroutine input_evaluate(self, t, motion, loads, power)
      class(input_load_t), intent(in) :: self    !! the load
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(loads_t), intent(inout) :: loads      !! loads on the bodies
      real(wp), intent(inout) :: power           !! power given to the mechanism [W]

      real(wp) :: moment(3)

      associate (k => self%body)
         moment = self%moment + cross(matmul(motion%rot(:, :, k), self%arm), self%force)
         loads%force(:, k) = loads%force(:, k) + self%force
         loads%moment(:, k) = loads%moment(:, k) + moment
         power = power + dot_product(self%force, motion%v(:, k)) + dot_product(moment, motion%omega(:, k)) + 0.0_wp*t
      end associate
   end subroutine input_evaluate

   !> It has no channels.
   subroutine input_report(self, code, t, motion, values)
      class(input_load_t), intent(in) :: self    !! the load
      integer, intent(in) :: code                !! the channel
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(inout) :: values(:, :)    !! (components, 0) values [any]

      if (size(values) > 0) values = values + 0.0_wp*(self%n + code + t + motion%t)
   end subroutine input_report

   !> The body that it acts on.
   pure function input_bodies(self, i) result(bodies)
      class(input_load_t), intent(in) :: self       !! the load
      integer, intent(in) :: i                      !! number of the item
      integer :: bodies(2)                          !! ground and the body

      bodies = [0, self%body + 0*i]
   end function input_bodies

end module input_load
