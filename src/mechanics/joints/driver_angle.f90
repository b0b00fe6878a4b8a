!> Driver of an angle as a function of time: body j against body i of a revolute joint.
!>
!> Phi = angle_j - angle_i - f(t)                                            (1 row)
!> Phi_q = [ 0, 0, -1, 0, 0, 1 ],   Phi_t = -f',   gamma = f''
!> f is an expression in t with exact derivatives; it gives the angle itself, not a change.
!>
!> Signs: as driver.speed. Source: Flores et al. (2008), section 2.2. Limits: revolute joints; f twice
!> differentiable: after a jump of f or f' only the stabilisation brings the joint back, which the run
!> warns of; a jump of more than a radian ends it.
module driver_angle
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use driver_speed, only: add_driver_channels, write_driver_row
   use expression, only: expression_t
   use item, only: item_t, place_of
   use joint_set, only: joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_expression, add_reference, dim_angle, in_plane, kind_info_t
   use kinds, only: two_pi, wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: driver_angle_t

   !> All angle drivers of a planar scene.
   type, extends(joint_set_t) :: driver_angle_t
      type(expression_t), allocatable :: f(:)  !! (n) angle of j relative to i [rad]
   contains
      procedure, nopass :: info => angle_info
      procedure :: prepare => angle_prepare
      procedure :: evaluate => angle_evaluate
      procedure :: prescription => angle_prescription
      procedure :: time_of_turns => angle_time_of_turns
      procedure :: time_before => angle_time_before
   end type driver_angle_t

contains

   !> Description of the kind.
   function angle_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.angle"
      info%space = in_plane
      info%help = "prescribes the angle of a revolute joint as a function of time"
      info%source = "Flores et al. (2008), section 2.2"
      info%n_row = 1
      info%drives_turn = .true.
      call add_reference(info, "joint", "joint.revolute", "the revolute joint that is driven")
      call add_expression(info, "angle", dim_angle, "angle of j relative to i, counter-clockwise positive")
      call add_driver_channels(info)
   end function angle_info

   !> Function of each item.
   subroutine angle_prepare(self, items, angle)
      class(driver_angle_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)             !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_driver = .true.
      self%is_angle(1) = .true.
      allocate (self%f(self%n))
      do k = 1, self%n
         self%f(k) = items(k)%values(place_of(items(k), "angle"))%expression
      end do
   end subroutine angle_prepare

   !> Fill the rows of all items.
   subroutine angle_evaluate(self, t, motion, rows)
      class(driver_angle_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(rows_t), intent(inout) :: rows        !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      do k = 1, self%n
         call angle_prescription(self, k, t, f, f_dot, f_dot_dot)
         call write_driver_row(self%first_row + k, motion%angle(self%body(1, k)), motion%angle(self%body(2, k)), &
                               f, f_dot, f_dot_dot, rows)
      end do
   end subroutine angle_evaluate

   !> The angle that an item prescribes.
   subroutine angle_prescription(self, k, t, f, f_dot, f_dot_dot)
      class(driver_angle_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(out) :: f                 !! angle of j relative to i [rad]
      real(wp), intent(out) :: f_dot             !! its first time derivative [rad/s]
      real(wp), intent(out) :: f_dot_dot         !! its second time derivative [rad/s^2]

      call self%f(k)%evaluate(t, f, f_dot, f_dot_dot)
   end subroutine angle_prescription

   !> First time at which |f(t) - f(0)| reaches a number of turns.
   function angle_time_of_turns(self, k, turns) result(t)
      class(driver_angle_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: turns              !! turns, of either sense [1]
      real(wp) :: t                              !! the time, negative if never [s]

      t = time_to_travel(self%f(k), 0.0_wp, 1.0_wp, huge(1.0_wp), turns)
   end function angle_time_of_turns

   !> Last time t before t_end with |f(t_end) - f(t)| of a number of turns.
   function angle_time_before(self, k, turns, t_end) result(t)
      class(driver_angle_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: turns              !! turns, of either sense [1]
      real(wp), intent(in) :: t_end              !! end of the turns [s]
      real(wp) :: t                              !! their start, negative if there were not so many [s]

      real(wp) :: duration

      duration = time_to_travel(self%f(k), t_end, -1.0_wp, t_end, turns)
      t = -1.0_wp
      if (duration >= 0.0_wp) t = t_end - duration
   end function angle_time_before

   !> Time from `start` forwards or backwards until the angle has changed by a number of turns: times
   !> growing by a hundredth up to 1e12 s, then bisection. A function that oscillates faster than
   !> that is not followed.
   function time_to_travel(f, start, direction, longest, turns) result(duration)
      type(expression_t), intent(in) :: f    !! angle [rad]
      real(wp), intent(in) :: start          !! where to start [s]
      real(wp), intent(in) :: direction      !! 1 forwards, -1 backwards [1]
      real(wp), intent(in) :: longest        !! not to be passed [s]
      real(wp), intent(in) :: turns          !! turns, of either sense [1]
      real(wp) :: duration                   !! the time it takes, negative if never [s]

      real(wp), parameter :: first = 1.0e-6_wp   ! first time looked at [s]
      real(wp), parameter :: growth = 1.01_wp    ! ratio of times looked at [1]
      integer, parameter :: n_search = 4200      ! times looked at
      real(wp) :: high, low
      integer :: step

      duration = min(turns, 0.0_wp)
      if (turns <= 0.0_wp) return
      duration = -1.0_wp
      low = 0.0_wp
      high = min(first, longest)
      do step = 1, n_search
         if (travel(high) >= two_pi*turns .or. high >= longest) exit
         low = high
         high = min(growth*high, longest)
      end do
      if (travel(high) < two_pi*turns) return
      do step = 1, 200
         duration = 0.5_wp*(low + high)
         if (duration <= low .or. duration >= high) exit
         if (travel(duration) >= two_pi*turns) then
            high = duration
         else
            low = duration
         end if
      end do
      duration = high

   contains

      !> Change of the angle in a time, of either sense; negative where the function does not exist.
      function travel(time)
         real(wp), intent(in) :: time  !! time from the start [s]
         real(wp) :: travel            !! absolute change [rad]

         real(wp) :: after, before, first_derivative, second_derivative

         call f%evaluate(start, before, first_derivative, second_derivative)
         call f%evaluate(start + direction*time, after, first_derivative, second_derivative)
         travel = -1.0_wp
         if (.not. ieee_is_nan(after - before)) travel = abs(after - before)
      end function travel

   end function time_to_travel

end module driver_angle
