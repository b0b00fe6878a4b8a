!> Planar revolute joint: the points P_i and P_j coincide.
!>
!> Phi = r_i + A_i s'_i - r_j - A_j s'_j                                    (2 rows)
!> Phi_q = [ I, R90 s_i, -I, -R90 s_j ],   gamma = s_i w_i^2 - s_j w_j^2
!>
!> A pin of radius R has friction with the sliding velocity v = R (w_j - w_i) under the normal force N = |lambda| + preload.
!>
!> Signs: the force on body i is -lambda, on body j +lambda, at the pin.
!> Source: Flores et al. (2008), eq. (2.5). Limits: none.
module joint_revolute
   use item, only: item_t
   use joint_friction, only: add_friction_columns
   use joint_set, only: add_joint_channels, joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_reference, in_plane, kind_info_t, free_rotation
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: joint_revolute_t

   !> All revolute joints of a planar scene.
   type, extends(joint_set_t) :: joint_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure :: prepare => revolute_prepare
      procedure :: evaluate => revolute_evaluate
      procedure, nopass :: friction_lengths => revolute_friction_lengths
      procedure :: slide => revolute_slide
      procedure :: press => revolute_press
   end type joint_revolute_t

contains

   !> Description of the kind.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.revolute"
      info%space = in_plane
      info%help = "ideal pin: two points coincide"
      info%source = "Flores et al. (2008), eq. (2.5)"
      info%n_row = 2
      info%free = free_rotation
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_joint_channels(info)
      call add_friction_columns(info, "radius", "radius of the pin, for friction", &
                                "preload: normal force between pin and hole without load, as of a press fit", &
                                "friction_moment", "N.m", "friction moment on the body of j, for a joint with friction")
   end function revolute_info

   !> Nothing beyond the points.
   subroutine revolute_prepare(self, items, angle)
      class(joint_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)               !! (0:bodies) angles at the start [rad]

      self%sides_apart = .true.
   end subroutine revolute_prepare

   !> Column of the pin's radius.
   function revolute_friction_lengths() result(name)
      character(:), allocatable :: name   !! the column

      name = "radius"
   end function revolute_friction_lengths

   !> Sliding velocities of the pins with friction.
   subroutine revolute_slide(self, motion)
      class(joint_revolute_t), intent(inout) :: self  !! the set; `friction` is set
      type(motion_t), intent(in) :: motion            !! positions and velocities

      integer :: m

      do m = 1, self%friction%n
         associate (item => self%friction%item(m), radius => self%friction%length(1, m))
            self%friction%row(:, m) = [0.0_wp, 0.0_wp, -radius, 0.0_wp, 0.0_wp, radius]
            self%friction%v(m) = radius*(motion%omega(3, self%body(2, item)) - motion%omega(3, self%body(1, item)))
         end associate
      end do
   end subroutine revolute_slide

   !> Normal force of a pin that has friction.
   pure subroutine revolute_press(self, m, lambda, normal, slope)
      class(joint_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                     !! place among the items with friction
      real(wp), intent(in) :: lambda(:)            !! (2 or more) multipliers [N]
      real(wp), intent(out) :: normal              !! normal force [N]
      real(wp), intent(out) :: slope(:)            !! (size of lambda) its derivatives [1]

      real(wp) :: reaction

      reaction = sqrt(lambda(1)**2 + lambda(2)**2)
      normal = reaction + self%friction%preload(m)
      slope = 0.0_wp
      if (reaction > 0.0_wp) slope(1:2) = lambda(1:2)/reaction
   end subroutine revolute_press

   !> Fill the rows of all items.
   subroutine revolute_evaluate(self, t, motion, rows)
      class(joint_revolute_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(rows_t), intent(inout) :: rows          !! rows, those of the set are filled

      call revolute_rows(self%n, self%body, self%s_i, self%s_j, ubound(motion%angle, 1), motion%r, motion%rot, &
                         motion%omega, self%first_row, rows%n, rows%phi, rows%phi_t, rows%jac, rows%gam)
   end subroutine revolute_evaluate

   !> The rows on plain arrays.
   pure subroutine revolute_rows(n, body, s_i, s_j, n_body, r, rot, omega, first, n_row, phi, phi_t, jac, gam)
      integer, intent(in) :: n                          !! number of joints
      integer, intent(in) :: body(2, n)                 !! (2, n) bodies i and j
      real(wp), intent(in) :: s_i(3, n)                 !! (3, n) point of body i, its frame [m]
      real(wp), intent(in) :: s_j(3, n)                 !! (3, n) point of body j, its frame [m]
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)            !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)       !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: omega(3, 0:n_body)        !! (3, 0:bodies) angular velocities [rad/s]
      integer, intent(in) :: first                      !! rows before those of the set
      integer, intent(in) :: n_row                      !! number of rows
      real(wp), intent(inout) :: phi(n_row)             !! (rows) violations [m]
      real(wp), intent(inout) :: phi_t(n_row)           !! (rows) their partial time derivatives [m/s]
      real(wp), intent(inout) :: jac(6, n_row)          !! (6, rows) Phi_q [1 or m]
      real(wp), intent(inout) :: gam(n_row)             !! (rows) gamma [m/s^2]

      real(wp) :: w2_i, w2_j, x_i, x_j, y_i, y_j
      integer :: i, j, k, row

      do k = 1, n
         i = body(1, k)
         j = body(2, k)
         row = first + 2*k - 1
         x_i = rot(1, 1, i)*s_i(1, k) + rot(1, 2, i)*s_i(2, k)
         y_i = rot(2, 1, i)*s_i(1, k) + rot(2, 2, i)*s_i(2, k)
         x_j = rot(1, 1, j)*s_j(1, k) + rot(1, 2, j)*s_j(2, k)
         y_j = rot(2, 1, j)*s_j(1, k) + rot(2, 2, j)*s_j(2, k)
         phi(row) = r(1, i) + x_i - r(1, j) - x_j
         phi(row + 1) = r(2, i) + y_i - r(2, j) - y_j
         phi_t(row) = 0.0_wp
         phi_t(row + 1) = 0.0_wp
         jac(1, row) = 1.0_wp
         jac(2, row) = 0.0_wp
         jac(3, row) = -y_i
         jac(4, row) = -1.0_wp
         jac(5, row) = 0.0_wp
         jac(6, row) = y_j
         jac(1, row + 1) = 0.0_wp
         jac(2, row + 1) = 1.0_wp
         jac(3, row + 1) = x_i
         jac(4, row + 1) = 0.0_wp
         jac(5, row + 1) = -1.0_wp
         jac(6, row + 1) = -x_j
         w2_i = omega(3, i)*omega(3, i)
         w2_j = omega(3, j)*omega(3, j)
         gam(row) = x_i*w2_i - x_j*w2_j
         gam(row + 1) = y_i*w2_i - y_j*w2_j
      end do
   end subroutine revolute_rows

end module joint_revolute
