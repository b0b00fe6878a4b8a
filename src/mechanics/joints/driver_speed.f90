!> Driver of constant speed: turns body j against body i of a revolute joint at a constant rate.
!>
!> Phi = angle_j - angle_i - (f0 + W t)                                      (1 row)
!> Phi_q = [ 0, 0, -1, 0, 0, 1 ],   Phi_t = -W,   gamma = 0
!> f0 is the angle that the deck gives the bodies at the start.
!>
!> Signs: the coordinate is that of j relative to i, counter-clockwise positive; the driving moment
!> on body j is -lambda. Source: Flores et al. (2008), section 2.2, with the opposite sign of Phi.
!> Limits: revolute joints.
module driver_speed
   use item, only: item_t
   use joint_set, only: joint_set_t, of_coordinate, of_moment, of_power
   use rows, only: rows_t
   use kind_info, only: add_channel, add_number, add_reference, dim_angular_speed, in_plane, kind_info_t
   use kinds, only: two_pi, wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: add_driver_channels, driver_speed_t, write_driver_row

   !> All drivers of constant speed of a planar scene.
   type, extends(joint_set_t) :: driver_speed_t
      real(wp), allocatable :: start(:)  !! (n) coordinate at t = 0 [rad]
      real(wp), allocatable :: speed(:)  !! (n) constant speed [rad/s]
   contains
      procedure, nopass :: info => speed_info
      procedure :: prepare => speed_prepare
      procedure :: evaluate => speed_evaluate
      procedure :: prescription => speed_prescription
      procedure :: time_of_turns => speed_time_of_turns
      procedure :: time_before => speed_time_before
   end type driver_speed_t

contains

   !> Description of the kind.
   function speed_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.speed"
      info%space = in_plane
      info%help = "prescribes a constant speed of a revolute joint"
      info%source = "Flores et al. (2008), section 2.2"
      info%n_row = 1
      info%drives_turn = .true.
      call add_reference(info, "joint", "joint.revolute", "the revolute joint that is driven")
      call add_number(info, "speed", dim_angular_speed, "speed of j relative to i, counter-clockwise positive")
      call add_driver_channels(info)
   end function speed_info

   !> Speed and first angle of each item.
   subroutine speed_prepare(self, items, angle)
      class(driver_speed_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)             !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_driver = .true.
      self%is_angle(1) = .true.
      allocate (self%start(self%n), self%speed(self%n))
      do k = 1, self%n
         self%start(k) = angle(self%body(2, k)) - angle(self%body(1, k))
         self%speed(k) = items(k)%number("speed")
      end do
   end subroutine speed_prepare

   !> Fill the rows of all items.
   subroutine speed_evaluate(self, t, motion, rows)
      class(driver_speed_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(rows_t), intent(inout) :: rows        !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      do k = 1, self%n
         call speed_prescription(self, k, t, f, f_dot, f_dot_dot)
         call write_driver_row(self%first_row + k, motion%angle(self%body(1, k)), motion%angle(self%body(2, k)), &
                               f, f_dot, f_dot_dot, rows)
      end do
   end subroutine speed_evaluate

   !> The angle that an item prescribes.
   subroutine speed_prescription(self, k, t, f, f_dot, f_dot_dot)
      class(driver_speed_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(out) :: f                 !! angle of j relative to i [rad]
      real(wp), intent(out) :: f_dot             !! its first time derivative [rad/s]
      real(wp), intent(out) :: f_dot_dot         !! its second time derivative [rad/s^2]

      f = self%start(k) + self%speed(k)*t
      f_dot = self%speed(k)
      f_dot_dot = 0.0_wp
   end subroutine speed_prescription

   !> Time of a number of turns.
   function speed_time_of_turns(self, k, turns) result(t)
      class(driver_speed_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: turns              !! turns, of either sense [1]
      real(wp) :: t                              !! the time, negative if never [s]

      t = -1.0_wp
      if (abs(self%speed(k)) > 0.0_wp) t = two_pi*turns/abs(self%speed(k))
   end function speed_time_of_turns

   !> Start of a number of turns that end at a time.
   function speed_time_before(self, k, turns, t_end) result(t)
      class(driver_speed_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: turns              !! turns, of either sense [1]
      real(wp), intent(in) :: t_end              !! end of the turns [s]
      real(wp) :: t                              !! their start, negative if there were not so many [s]

      t = -1.0_wp
      if (abs(self%speed(k)) > 0.0_wp) t = t_end - two_pi*turns/abs(self%speed(k))
   end function speed_time_before

   !> One row of an angle driver with the function value f and its derivatives.
   pure subroutine write_driver_row(row, angle_i, angle_j, f, f_dot, f_dot_dot, rows)
      integer, intent(in) :: row           !! number of the row
      real(wp), intent(in) :: angle_i      !! angle of body i [rad]
      real(wp), intent(in) :: angle_j      !! angle of body j [rad]
      real(wp), intent(in) :: f            !! prescribed coordinate [rad]
      real(wp), intent(in) :: f_dot        !! its first time derivative [rad/s]
      real(wp), intent(in) :: f_dot_dot    !! its second time derivative [rad/s^2]
      type(rows_t), intent(inout) :: rows  !! rows

      rows%phi(row) = angle_j - angle_i - f
      rows%phi_t(row) = -f_dot
      rows%jac(:, row) = [0.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
      rows%gam(row) = f_dot_dot
   end subroutine write_driver_row

   !> The channels that every rotational driver has.
   subroutine add_driver_channels(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_channel(info, "moment", "N.m", "world", 1, "driving moment on the body of j", of_moment)
      call add_channel(info, "coordinate", "rad", "joint", 1, "angle of j relative to i, counter-clockwise, accumulated over "// &
         "revolutions", &
                       of_coordinate)
      call add_channel(info, "power", "W", "none", 1, "power given to the mechanism", of_power)
   end subroutine add_driver_channels

end module driver_speed
