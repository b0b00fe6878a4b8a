!> Driver of a distance as a function of time: between a point of body i and a point of body j.
!>
!> With d = r_j + s_j - r_i - s_i, u = d/|d|:
!> Phi = |d| - f(t)                                                         (1 row)
!> Phi_q as joint.distance,   Phi_t = -f',   gamma = f'' + gamma of joint.distance
!>
!> Signs: the driving force is positive if it pushes the points apart: -u lambda . u on body j.
!> Source: Flores et al. (2008), section 2.2. Limits: f positive and twice differentiable; what a jump of f
!> or f' does is said at driver.angle.
module driver_distance
   use expression, only: expression_t
   use item, only: item_t, place_of
   use joint_distance, only: write_distance_row
   use joint_set, only: joint_set_t, of_coordinate, of_force, of_power
   use rows, only: n_v_planar, rows_t
   use kind_info, only: add_channel, add_expression, add_reference, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use span, only: span_of
   use spatial_rows, only: length_of_span, put_row
   implicit none (type, external)
   private
   public :: add_length_channels, driver_distance_t

   !> All distance drivers.
   type, extends(joint_set_t) :: driver_distance_t
      type(expression_t), allocatable :: f(:)  !! (n) distance [m]
   contains
      procedure, nopass :: info => driven_info
      procedure :: prepare => driven_prepare
      procedure :: evaluate => driven_evaluate
      procedure :: coordinate => driven_coordinate
   end type driver_distance_t

contains

   !> Description of the kind.
   function driven_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.distance"
      info%help = "prescribes the distance of two points as a function of time, like a hydraulic cylinder"
      info%source = "Flores et al. (2008), section 2.2"
      info%n_row = 1
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_expression(info, "distance", dim_length, "distance of the points, positive")
      call add_length_channels(info, "driving force on the body of j, positive away from the point of i", &
                               "distance of the points")
   end function driven_info

   !> Function of each item.
   subroutine driven_prepare(self, items, angle)
      class(driver_distance_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_driver = .true.
      allocate (self%f(self%n))
      do k = 1, self%n
         self%f(k) = items(k)%values(place_of(items(k), "distance"))%expression
      end do
   end subroutine driven_prepare

   !> Fill the rows of all items.
   subroutine driven_evaluate(self, t, motion, rows)
      class(driver_distance_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                     !! time [s]
      type(motion_t), intent(in) :: motion          !! positions and velocities
      type(rows_t), intent(inout) :: rows           !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      do k = 1, self%n
         call self%f(k)%evaluate(t, f, f_dot, f_dot_dot)
         if (rows%n_v == n_v_planar) then
            call write_distance_row(self%first_row + k, motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), &
                                    f, f_dot, f_dot_dot, rows)
         else
            call put_row(rows, self%first_row + k, motion, self%body(:, k), &
                         length_of_span(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k)), f, f_dot, f_dot_dot)
         end if
      end do
   end subroutine driven_evaluate

   !> Distance of the points, and its rate.
   subroutine driven_coordinate(self, k, motion, value, rate)
      class(driver_distance_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                      !! item
      type(motion_t), intent(in) :: motion          !! positions and velocities
      real(wp), intent(out) :: value                !! distance [m]
      real(wp), intent(out) :: rate                 !! its rate [m/s]

      real(wp) :: u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, value, rate)
   end subroutine driven_coordinate

   !> The channels that every driver of a length has.
   subroutine add_length_channels(info, force, displacement)
      type(kind_info_t), intent(inout) :: info    !! the kind
      character(*), intent(in) :: force           !! what the force is
      character(*), intent(in) :: displacement    !! what the coordinate is

      call add_channel(info, "force", "N", "joint", 1, force, of_force)
      call add_channel(info, "displacement", "m", "joint", 1, displacement, of_coordinate)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end subroutine add_length_channels

end module driver_distance
