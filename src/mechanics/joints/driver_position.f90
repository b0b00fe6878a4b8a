!> Driver of a position along a line as a function of time: a point of body j along an axis fixed in body i.
!>
!> With the unit axis s = A_i s' and d = r_j^P - r_i^P:
!> Phi = s . d - f(t)                                                       (1 row)
!> Phi_q = [ -s^T, n . (r_j^P - r_i), s^T, -n . s_j ],   n = R90 s,   Phi_t = -f'
!> gamma = f'' + (s . d) w_i^2 - 2 w_i (n . d') + s . (s_j w_j^2 - s_i w_i^2)
!> It drives a slider along the guide of joint.translational or joint.pin_in_slot with the same points and
!> axis, or any point over any other.
!>
!> Signs: the driving force on body j is -s lambda, positive along the axis.
!> Source: Flores et al. (2008), section 2.2: eq. (2.8) with the axis turned by -90 degrees.
!> Limits: f twice differentiable; what a jump of f or f' does is said at driver.angle.
module driver_position
   use driver_distance, only: add_length_channels
   use expression, only: expression_t
   use item, only: item_t, place_of
   use rows, only: rows_t
   use joint_translational, only: add_axis_columns, joint_translational_t
   use kind_info, only: add_expression, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, point_position, point_velocity
   implicit none (type, external)
   private
   public :: driver_position_t

   !> All position drivers of a planar scene. `axis` is s turned by -90 degrees, whose R90 is s.
   type, extends(joint_translational_t) :: driver_position_t
      type(expression_t), allocatable :: f(:)  !! (n) position [m]
   contains
      procedure, nopass :: info => position_info
      procedure :: prepare => position_prepare
      procedure :: evaluate => position_evaluate
      procedure :: coordinate => position_coordinate
   end type driver_position_t

contains

   !> Description of the kind.
   function position_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.position"
      info%space = in_plane
      info%help = "prescribes the position of a point along an axis as a function of time"
      info%source = "Flores et al. (2008), section 2.2"
      info%n_row = 1
      call add_reference(info, "i", "points", "origin of the axis")
      call add_reference(info, "j", "points", "the point that is driven")
      call add_axis_columns(info, "motion")
      call add_expression(info, "position", dim_length, "position of j relative to i along the axis")
      call add_length_channels(info, "driving force on the body of j along the axis", "position of j relative to i along the axis")
   end function position_info

   !> Axis and function of each item.
   subroutine position_prepare(self, items, angle)
      class(driver_position_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                !! (0:bodies) angles at the start [rad]

      integer :: k

      self%is_driver = .true.
      call self%set_axes(items, angle)
      allocate (self%f(self%n))
      do k = 1, self%n
         self%f(k) = items(k)%values(place_of(items(k), "position"))%expression
         self%guide%axis(:, k) = [self%guide%axis(2, k), -self%guide%axis(1, k)]
      end do
   end subroutine position_prepare

   !> Fill the rows of all items.
   subroutine position_evaluate(self, t, motion, rows)
      class(driver_position_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                     !! time [s]
      type(motion_t), intent(in) :: motion          !! positions and velocities
      type(rows_t), intent(inout) :: rows           !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k, row

      call self%fill_rows(motion, rows)
      do k = 1, self%n
         row = self%first_row + k
         call self%f(k)%evaluate(t, f, f_dot, f_dot_dot)
         rows%phi(row) = rows%phi(row) - f
         rows%phi_t(row) = -f_dot
         rows%gam(row) = rows%gam(row) + f_dot_dot
      end do
   end subroutine position_evaluate

   !> Position along the axis, and its rate.
   subroutine position_coordinate(self, k, motion, value, rate)
      class(driver_position_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                      !! item
      type(motion_t), intent(in) :: motion          !! positions and velocities
      real(wp), intent(out) :: value                !! position [m]
      real(wp), intent(out) :: rate                 !! its rate [m/s]

      real(wp) :: p_i(3), p_j(3), s(3)

      associate (i => self%body(1, k), j => self%body(2, k))
         s = motion%rot(:, 2, i)*self%guide%axis(1, k) - motion%rot(:, 1, i)*self%guide%axis(2, k)
         p_i = point_position(motion, i, self%s_i(:, k))
         p_j = point_position(motion, j, self%s_j(:, k))
         value = dot_product(s, p_j - p_i)
         ! the point of body i that is where P_j is now moves with the axis
         rate = dot_product(s, point_velocity(motion, j, p_j) - point_velocity(motion, i, p_j))
      end associate
   end subroutine position_coordinate

end module driver_position
