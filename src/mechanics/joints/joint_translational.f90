!> Planar translational joint: a guide of body i carries body j along an axis fixed in body i.
!>
!> With the unit axis s = A_i s', n = R90 s and d = r_j^P - r_i^P:
!> Phi_1 = n . d,   Phi_2 = angle_i - angle_j - (angle_i0 - angle_j0)        (2 rows)
!> Phi_1q = [ -n^T, -s . (r_j^P - r_i), n^T, s . s_j ]
!> gamma_1 = (n . d) w_i^2 + 2 w_i (s . d') + n . (s_j w_j^2 - s_i w_i^2),   gamma_2 = 0
!>
!> A slider of length L bears on the guide with both its ends, at L/2 before and behind the point of j: there the reaction and its
!> moment are the forces lambda_1/2 +- lambda_2/L, so that N = |lambda_1/2 + lambda_2/L| + |lambda_1/2 - lambda_2/L| + preload.
!> Without a length N = |lambda_1| + preload. It has friction along the axis with the velocity v = s . (v_j^P - v_i there).
!>
!> Signs: the force on body j is -n lambda_1. The moment is reported about the point of j.
!> Source: Flores et al. (2008), eqs. (2.6), (2.8), with a unit axis. Limits: the angle between the
!> bodies is the one of the deck's start.
module joint_translational
   use item, only: item_t
   use joint_friction, only: add_friction_columns
   use joint_set, only: add_joint_channels, joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_number, add_reference, add_word, dim_angle, in_plane, kind_info_t, free_translation
   use kinds, only: wp
   use motion, only: motion_t, point_position
   implicit none (type, external)
   private
   public :: add_axis_columns, joint_translational_t

   !> Ways of sliders.
   type :: slideways_t
      real(wp), allocatable :: axis(:, :)      !! (2, n) unit axis in the frame of body i [1]
      real(wp), allocatable :: difference(:)   !! (n) angle of i less that of j [rad]
   end type slideways_t

   !> All translational joints of a planar scene.
   type, extends(joint_set_t) :: joint_translational_t
      type(slideways_t) :: guide   !! their ways
   contains
      procedure, nopass :: info => translational_info
      procedure :: prepare => translational_prepare
      procedure :: set_axes
      procedure :: fill_rows
      procedure :: evaluate => translational_evaluate
      procedure :: reaction_point => translational_reaction_point
      procedure :: slide_axis_of => translational_slide_axis_of
      procedure, nopass :: friction_lengths => translational_friction_lengths
      procedure :: slide => translational_slide
      procedure :: press => translational_press
   end type joint_translational_t

contains

   !> Description of the kind.
   function translational_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.translational"
      info%space = in_plane
      info%help = "ideal guide: a point of j stays on a line of i, and the relative angle is constant"
      info%source = "Flores et al. (2008), eqs. (2.6), (2.8)"
      info%n_row = 2
      info%free = free_translation
      call add_reference(info, "i", "points", "point of the guide")
      call add_reference(info, "j", "points", "point of the slider")
      call add_axis_columns(info, "guide")
      call add_joint_channels(info)
      call add_friction_columns(info, "slider_length", "distance between the slider ends, which carry its moment; 0: friction "// &
         "by the " &
                                //"force only", "preload: normal force of the slider without load, as of a clamped guide", &
                                "friction_force", "N", "friction force on the body of j along the axis, for a joint with friction")
   end function translational_info

   !> The columns of a direction fixed in body i: numbers 3 and 4 of a kind.
   subroutine add_axis_columns(info, what)
      type(kind_info_t), intent(inout) :: info  !! the kind
      character(*), intent(in) :: what          !! what has the direction

      call add_word(info, "axis", "direction of the "//what//": an axis of the body of i", choices="x y")
      call add_number(info, "axis_angle", dim_angle, "angle from that axis to the "//what//", counter-clockwise", default="0 rad")
   end subroutine add_axis_columns

   !> Axis and angle of each item.
   subroutine translational_prepare(self, items, angle)
      class(joint_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                 !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                    !! (0:bodies) angles at the start [rad]

      self%is_angle(2) = .true.
      call self%set_axes(items, angle)
   end subroutine translational_prepare

   !> Axes and angles of the items.
   subroutine set_axes(self, items, angle)
      class(joint_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                 !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                    !! (0:bodies) angles at the start [rad]

      real(wp) :: c, s
      integer :: k

      allocate (self%guide%axis(2, self%n), self%guide%difference(self%n))
      do k = 1, self%n
         c = cos(items(k)%number("axis_angle"))
         s = sin(items(k)%number("axis_angle"))
         self%guide%axis(:, k) = merge([c, s], [-s, c], items(k)%word("axis") == "x")
         self%guide%difference(k) = angle(self%body(1, k)) - angle(self%body(2, k))
      end do
   end subroutine set_axes

   !> The point of j.
   function translational_reaction_point(self, k, motion) result(p)
      class(joint_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                          !! item
      type(motion_t), intent(in) :: motion              !! positions
      real(wp) :: p(3)                                  !! (3) the point, world frame [m]

      p = point_position(motion, self%body(2, k), self%s_j(:, k))
   end function translational_reaction_point

   !> The axis.
   pure function translational_slide_axis_of(self, k) result(axis)
      class(joint_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                          !! item
      real(wp) :: axis(2)                               !! (2) unit vector, frame of body i [1]

      axis = self%guide%axis(:, k)
   end function translational_slide_axis_of

   !> Column of the slider's length.
   function translational_friction_lengths() result(name)
      character(:), allocatable :: name   !! the column

      name = "slider_length"
   end function translational_friction_lengths

   !> Sliding velocities of the guides with friction.
   subroutine translational_slide(self, motion)
      class(joint_translational_t), intent(inout) :: self  !! the set; `friction` is set
      type(motion_t), intent(in) :: motion                 !! positions and velocities

      real(wp) :: d(2), p(3), s(2)
      integer :: m

      do m = 1, self%friction%n
         associate (k => self%friction%item(m), row => self%friction%row(:, m))
            associate (i => self%body(1, k), j => self%body(2, k))
               s = motion%rot(1:2, 1, i)*self%guide%axis(1, k) + motion%rot(1:2, 2, i)*self%guide%axis(2, k)
               p = point_position(motion, j, self%s_j(:, k))
               d = p(1:2) - motion%r(1:2, i)
               row(1:3) = -[s(1), s(2), s(2)*d(1) - s(1)*d(2)]
               d = p(1:2) - motion%r(1:2, j)
               row(4:6) = [s(1), s(2), s(2)*d(1) - s(1)*d(2)]
               self%friction%v(m) = dot_product(row(1:2), motion%v(1:2, i)) + row(3)*motion%omega(3, i) &
                                    + dot_product(row(4:5), motion%v(1:2, j)) + row(6)*motion%omega(3, j)
            end associate
         end associate
      end do
   end subroutine translational_slide

   !> Normal force of a guide that has friction: of both ends of its slider.
   pure subroutine translational_press(self, m, lambda, normal, slope)
      class(joint_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                          !! place among the items with friction
      real(wp), intent(in) :: lambda(:)                 !! (2 or more) multipliers [N, N.m]
      real(wp), intent(out) :: normal                   !! normal force [N]
      real(wp), intent(out) :: slope(:)                 !! (size of lambda) its derivatives [1, 1/m]

      real(wp) :: behind, before, turn

      turn = 0.0_wp
      if (self%friction%length(1, m) > 0.0_wp) turn = 1.0_wp/self%friction%length(1, m)
      before = 0.5_wp*lambda(1) + turn*lambda(2)
      behind = 0.5_wp*lambda(1) - turn*lambda(2)
      normal = abs(before) + abs(behind) + self%friction%preload(m)
      slope = 0.0_wp
      slope(1) = 0.5_wp*(sign(1.0_wp, before) + sign(1.0_wp, behind))
      slope(2) = turn*(sign(1.0_wp, before) - sign(1.0_wp, behind))
   end subroutine translational_press

   !> Fill the rows of all items.
   subroutine translational_evaluate(self, t, motion, rows)
      class(joint_translational_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                         !! time [s]
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(rows_t), intent(inout) :: rows               !! rows, those of the set are filled

      call self%fill_rows(motion, rows)
   end subroutine translational_evaluate

   !> Fill the rows of all items: that of the line, and with two rows an item that of the angle.
   subroutine fill_rows(self, motion, rows)
      class(joint_translational_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(rows_t), intent(inout) :: rows               !! rows, those of the set are filled

      call translational_rows(self%n, self%n_row_item, self%body, self%s_i, self%s_j, self%guide%axis, self%guide%difference, &
                              ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, motion%angle, &
                              self%first_row, rows%n, rows%phi, rows%phi_t, rows%jac, rows%gam)
   end subroutine fill_rows

   !> The rows on plain arrays.
   pure subroutine translational_rows(n, n_row_item, body, s_i, s_j, axis, difference, n_body, r, rot, v, omega, angle, &
                                      first, n_row, phi, phi_t, jac, gam)
      integer, intent(in) :: n                          !! number of joints
      integer, intent(in) :: n_row_item                 !! rows of a joint: 1 the line, 2 the line and the angle
      integer, intent(in) :: body(2, n)                 !! (2, n) bodies i and j
      real(wp), intent(in) :: s_i(3, n)                 !! (3, n) point of body i, its frame [m]
      real(wp), intent(in) :: s_j(3, n)                 !! (3, n) point of body j, its frame [m]
      real(wp), intent(in) :: axis(2, n)                !! (2, n) unit axis in the frame of body i [1]
      real(wp), intent(in) :: difference(n)             !! (n) angle of i less that of j [rad]
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)            !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)       !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)            !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)        !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: angle(0:n_body)           !! (0:bodies) angles [rad]
      integer, intent(in) :: first                      !! rows before those of the set
      integer, intent(in) :: n_row                      !! number of rows
      real(wp), intent(inout) :: phi(n_row)             !! (rows) violations [m or rad]
      real(wp), intent(inout) :: phi_t(n_row)           !! (rows) their partial time derivatives [m/s or rad/s]
      real(wp), intent(inout) :: jac(6, n_row)          !! (6, rows) Phi_q [1 or m]
      real(wp), intent(inout) :: gam(n_row)             !! (rows) gamma [m/s^2 or rad/s^2]

      real(wp) :: a(2), d(2), d_dot(2), p_i(2), p_j(2), w_i, w_j
      integer :: i, j, k, row

      do k = 1, n
         i = body(1, k)
         j = body(2, k)
         row = first + n_row_item*(k - 1) + 1
         w_i = omega(3, i)
         w_j = omega(3, j)
         ! axis a, normal (-a_y, a_x), points from the centres of mass p_i and p_j, all in the world frame
         a = rot(1:2, 1, i)*axis(1, k) + rot(1:2, 2, i)*axis(2, k)
         p_i = rot(1:2, 1, i)*s_i(1, k) + rot(1:2, 2, i)*s_i(2, k)
         p_j = rot(1:2, 1, j)*s_j(1, k) + rot(1:2, 2, j)*s_j(2, k)
         d = r(1:2, j) + p_j - r(1:2, i) - p_i
         d_dot(1) = v(1, j) - w_j*p_j(2) - v(1, i) + w_i*p_i(2)
         d_dot(2) = v(2, j) + w_j*p_j(1) - v(2, i) - w_i*p_i(1)
         phi(row) = a(1)*d(2) - a(2)*d(1)
         phi_t(row) = 0.0_wp
         jac(1, row) = a(2)
         jac(2, row) = -a(1)
         jac(3, row) = -(a(1)*(d(1) + p_i(1)) + a(2)*(d(2) + p_i(2)))
         jac(4, row) = -a(2)
         jac(5, row) = a(1)
         jac(6, row) = a(1)*p_j(1) + a(2)*p_j(2)
         gam(row) = phi(row)*w_i*w_i + 2.0_wp*w_i*(a(1)*d_dot(1) + a(2)*d_dot(2)) &
                    + a(1)*(p_j(2)*w_j*w_j - p_i(2)*w_i*w_i) - a(2)*(p_j(1)*w_j*w_j - p_i(1)*w_i*w_i)
         if (n_row_item == 1) cycle
         phi(row + 1) = angle(i) - angle(j) - difference(k)
         phi_t(row + 1) = 0.0_wp
         jac(1:2, row + 1) = 0.0_wp
         jac(3, row + 1) = 1.0_wp
         jac(4:5, row + 1) = 0.0_wp
         jac(6, row + 1) = -1.0_wp
         gam(row + 1) = 0.0_wp
      end do
   end subroutine translational_rows

end module joint_translational
