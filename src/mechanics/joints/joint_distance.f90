!> Distance joint: a massless link of constant length between two pins, a point of i and a point of j.
!>
!> With d = r_j + s_j - r_i - s_i, u = d/|d| and the length l:
!> Phi = |d| - l                                                            (1 row)
!> Phi_q = [ -u^T, -u . (R90 s_i), u^T, u . (R90 s_j) ]
!> gamma = -(d' . d' - (u . d')^2)/|d| + u . (s_j w_j^2 - s_i w_i^2)
!> A row without a length has the distance of the points where the deck puts the bodies at the start.
!>
!> Signs: the force on the body of i is u lambda, at its point, and -u lambda on the body of j: a positive
!> multiplier, and channel `tension`, pulls the points together. Source: Flores et al. (2008), section 2.2, with
!> |d| - l instead of d . d - l^2, so that the violation is a length and the multiplier a force.
!> Limits: l > 0. Where the points coincide there is no direction: the world's x stands in for u and the term
!> with 1/|d| is omitted; an assembled mechanism is never there.
module joint_distance
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t, of_own
   use rows, only: rows_t
   use kind_info, only: add_channel, add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use span, only: span_of
   implicit none (type, external)
   private
   public :: joint_distance_t, write_distance_row

   !> All distance joints of a planar scene.
   type, extends(joint_set_t) :: joint_distance_t
      real(wp), allocatable :: length(:)  !! (n) length [m]
      logical, allocatable :: is_open(:)  !! (n) whether the length is that at the start
   contains
      procedure, nopass :: info => distance_info
      procedure :: prepare => distance_prepare
      procedure :: set_start => distance_set_start
      procedure :: evaluate => distance_evaluate
      procedure :: coordinate => distance_coordinate
      procedure :: report_own => distance_report_own
   end type joint_distance_t

contains

   !> Description of the kind.
   function distance_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.distance"
      info%space = in_plane
      info%help = "massless link: the distance of two points is constant"
      info%source = "Flores et al. (2008), section 2.2"
      info%n_row = 1
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_number(info, "length", dim_length, "length; default: the distance at the given initial positions", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_joint_channels(info)
      call add_channel(info, "tension", "N", "none", 1, "force along the link, positive in tension", &
                       of_own)
   end function distance_info

   !> Lengths that the deck gives.
   subroutine distance_prepare(self, items, angle)
      class(joint_distance_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)               !! (0:bodies) angles at the start [rad]

      integer :: k

      allocate (self%length(self%n), self%is_open(self%n))
      do k = 1, self%n
         self%length(k) = items(k)%number("length")
         self%is_open(k) = .not. items(k)%is_given("length")
      end do
   end subroutine distance_prepare

   !> Lengths that the deck omits.
   subroutine distance_set_start(self, motion)
      class(joint_distance_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion            !! bodies where the deck puts them

      real(wp) :: rate
      integer :: k

      do k = 1, self%n
         if (self%is_open(k)) call self%coordinate(k, motion, self%length(k), rate)
      end do
   end subroutine distance_set_start

   !> Fill the rows of all items.
   subroutine distance_evaluate(self, t, motion, rows)
      class(joint_distance_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                    !! time [s]
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(rows_t), intent(inout) :: rows          !! rows, those of the set are filled

      integer :: k

      do k = 1, self%n
         call write_distance_row(self%first_row + k, motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), &
                                 self%length(k), 0.0_wp, 0.0_wp, rows)
      end do
   end subroutine distance_evaluate

   !> Distance of the two points, and its rate.
   subroutine distance_coordinate(self, k, motion, value, rate)
      class(joint_distance_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! item
      type(motion_t), intent(in) :: motion         !! positions and velocities
      real(wp), intent(out) :: value               !! distance [m]
      real(wp), intent(out) :: rate                !! its rate [m/s]

      real(wp) :: u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, value, rate)
   end subroutine distance_coordinate

   !> The tension, which is the multiplier of the row.
   subroutine distance_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(joint_distance_t), intent(in) :: self      !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      if (code == of_own) value(1) = lambda(self%first_row + k)
   end subroutine distance_report_own

   !> One row: the distance is l(t).
   pure subroutine write_distance_row(row, motion, body, s_i, s_j, l, l_dot, l_dot_dot, rows)
      integer, intent(in) :: row            !! number of the row
      type(motion_t), intent(in) :: motion  !! positions and velocities
      integer, intent(in) :: body(2)        !! (2) bodies i and j
      real(wp), intent(in) :: s_i(3)        !! (3) point of body i, its frame [m]
      real(wp), intent(in) :: s_j(3)        !! (3) point of body j, its frame [m]
      real(wp), intent(in) :: l             !! prescribed distance [m]
      real(wp), intent(in) :: l_dot         !! its first time derivative [m/s]
      real(wp), intent(in) :: l_dot_dot     !! its second time derivative [m/s^2]
      type(rows_t), intent(inout) :: rows   !! rows

      real(wp) :: bend, d(2), d_dot(2), length, p_i(2), p_j(2), u(2), w_i, w_j
      integer :: i, j

      i = body(1)
      j = body(2)
      w_i = motion%omega(3, i)
      w_j = motion%omega(3, j)
      ! points from the centres of mass, world frame
      p_i = motion%rot(1:2, 1, i)*s_i(1) + motion%rot(1:2, 2, i)*s_i(2)
      p_j = motion%rot(1:2, 1, j)*s_j(1) + motion%rot(1:2, 2, j)*s_j(2)
      d = motion%r(1:2, j) + p_j - motion%r(1:2, i) - p_i
      d_dot(1) = motion%v(1, j) - w_j*p_j(2) - motion%v(1, i) + w_i*p_i(2)
      d_dot(2) = motion%v(2, j) + w_j*p_j(1) - motion%v(2, i) - w_i*p_i(1)
      length = sqrt(d(1)*d(1) + d(2)*d(2))
      if (length > 0.0_wp) then
         u = d/length
         bend = (u(1)*d_dot(2) - u(2)*d_dot(1))**2/length
      else
         u = [1.0_wp, 0.0_wp]
         bend = 0.0_wp
      end if
      rows%phi(row) = length - l
      rows%phi_t(row) = -l_dot
      rows%jac(1:2, row) = -u
      rows%jac(3, row) = u(1)*p_i(2) - u(2)*p_i(1)
      rows%jac(4:5, row) = u
      rows%jac(6, row) = u(2)*p_j(1) - u(1)*p_j(2)
      rows%gam(row) = l_dot_dot - bend + u(1)*(p_j(1)*w_j*w_j - p_i(1)*w_i*w_i) + u(2)*(p_j(2)*w_j*w_j - p_i(2)*w_i*w_i)
   end subroutine write_distance_row

end module joint_distance
