!> Rack and pinion: a gear rolls on a line of another body.
!>
!> With the unit axis s = A_i s' of the rack's pitch line through the point of i, n = R90 s and d = r_j^P - r_i^P to the centre of
!> the pinion:
!> Phi = s . d + R (angle_j - angle_i) - (the same at the start)                                    (1 row)
!> Phi_q = [ -s^T, n . (r_j^P - r_i) - R, s^T, -n . s_j + R ]
!> gamma = s . (s_j w_j^2 - s_i w_i^2) - 2 w_i n . d' + w_i^2 s . d
!>
!> R is positive if the pinion lies to the left of the axis. Phi' = 0 says that line and pitch circle have the same velocity where
!> they touch. Signs: the force on the body of i, where they touch, is s lambda.
!> Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 4.2.4. Limits: other joints hold
!> the pinion
!> at its distance |R| from the line; the force is along the line, what a pressure angle adds is omitted, as is any play.
module joint_rack
   use item, only: item_t
   use joint_set, only: add_joint_channels
   use joint_translational, only: add_axis_columns, joint_translational_t
   use kind_info, only: add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use mesh, only: line_misfit
   use motion, only: motion_t, point_position, point_velocity
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: joint_rack_t

   !> Pinions on racks.
   type :: pinions_t
      real(wp), allocatable :: radius(:)  !! (n) radius of the pinion's pitch circle, negative to the right of the axis [m]
      real(wp), allocatable :: start(:)   !! (n) s . d + R (angle_j - angle_i) at the start [m]
   end type pinions_t

   !> All racks with their pinions of a planar scene.
   type, extends(joint_translational_t) :: joint_rack_t
      type(pinions_t) :: pinion  !! the pinions
   contains
      procedure, nopass :: info => rack_info
      procedure :: prepare => rack_prepare
      procedure :: set_start => rack_set_start
      procedure :: evaluate => rack_evaluate
      procedure :: reaction_point => rack_reaction_point
      procedure :: closing_doubt => rack_closing_doubt
   end type joint_rack_t

contains

   !> Description of the kind.
   function rack_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.rack"
      info%space = in_plane
      info%help = "rack and pinion: a gear rolls on a line of a body; other joints guide it"
      info%source = "Nikravesh (1988), section 4.2.4"
      info%n_row = 1
      call add_reference(info, "i", "points", "point of the rack's pitch line")
      call add_reference(info, "j", "points", "centre of the pinion")
      call add_axis_columns(info, "pitch line")
      call add_number(info, "radius", dim_length, "pitch radius of the pinion; negative: the pinion is on the right of the " &
                      //"axis", not_zero=.true.)
      call add_joint_channels(info)
   end function rack_info

   !> Axes and radii.
   subroutine rack_prepare(self, items, angle)
      class(joint_rack_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)           !! (0:bodies) angles at the start [rad]

      integer :: k

      call self%set_axes(items, angle)
      allocate (self%pinion%radius(self%n), self%pinion%start(self%n), source=0.0_wp)
      do k = 1, self%n
         self%pinion%radius(k) = items(k)%number("radius")
      end do
   end subroutine rack_prepare

   !> The pinion meshes as the deck puts it.
   subroutine rack_set_start(self, motion)
      class(joint_rack_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! bodies where the deck puts them

      integer :: k

      do k = 1, self%n
         self%pinion%start(k) = rolled(self, k, motion)
      end do
   end subroutine rack_set_start

   !> s . d + R (angle_j - angle_i).
   real(wp) function rolled(self, k, motion)
      class(joint_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions

      rolled = dot_product(axis_of(self, k, motion), point_position(motion, self%body(2, k), self%s_j(:, k)) &
                           - point_position(motion, self%body(1, k), self%s_i(:, k))) &
               + self%pinion%radius(k)*(motion%angle(self%body(2, k)) - motion%angle(self%body(1, k)))
   end function rolled

   !> The axis in the world frame.
   pure function axis_of(self, k, motion) result(s)
      class(joint_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      real(wp) :: s(3)                         !! (3) unit vector [1]

      s = motion%rot(:, 1, self%body(1, k))*self%guide%axis(1, k) + motion%rot(:, 2, self%body(1, k))*self%guide%axis(2, k)
   end function axis_of

   !> Fill the rows of all items.
   subroutine rack_evaluate(self, t, motion, rows)
      class(joint_rack_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                !! time [s]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(rows_t), intent(inout) :: rows      !! rows, those of the set are filled

      real(wp) :: d(3), n(3), p_i(3), p_j(3), s(3), s_i(3), s_j(3), v(3)
      integer :: i, j, k, row

      do k = 1, self%n
         row = self%first_row + k
         i = self%body(1, k)
         j = self%body(2, k)
         p_i = point_position(motion, i, self%s_i(:, k))
         p_j = point_position(motion, j, self%s_j(:, k))
         s_i = p_i - motion%r(:, i)
         s_j = p_j - motion%r(:, j)
         d = p_j - p_i
         v = point_velocity(motion, j, p_j) - point_velocity(motion, i, p_i)
         s = axis_of(self, k, motion)
         n = [-s(2), s(1), 0.0_wp]
         rows%phi(row) = rolled(self, k, motion) - self%pinion%start(k)
         rows%phi_t(row) = 0.0_wp
         rows%jac(:, row) = [-s(1), -s(2), dot_product(n, d + s_i) - self%pinion%radius(k), &
                             s(1), s(2), -dot_product(n, s_j) + self%pinion%radius(k)]
         rows%gam(row) = dot_product(s, s_j)*motion%omega(3, j)**2 - dot_product(s, s_i)*motion%omega(3, i)**2 &
                         - 2.0_wp*motion%omega(3, i)*dot_product(n, v) + motion%omega(3, i)**2*dot_product(s, d)
      end do
   end subroutine rack_evaluate

   !> Where the pitch circle touches the line.
   function rack_reaction_point(self, k, motion) result(p)
      class(joint_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      real(wp) :: p(3)                         !! (3) the point, world frame [m]

      real(wp) :: s(3)

      s = axis_of(self, k, motion)
      p = point_position(motion, self%body(2, k), self%s_j(:, k)) - self%pinion%radius(k)*[-s(2), s(1), 0.0_wp]
   end function rack_reaction_point

   !> The pinion is beside the line by its radius.
   function rack_closing_doubt(self, k, motion) result(doubt)
      class(joint_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      character(:), allocatable :: doubt       !! what does not match; blank: nothing

      real(wp) :: d(3), s(3)

      s = axis_of(self, k, motion)
      d = point_position(motion, self%body(2, k), self%s_j(:, k)) - point_position(motion, self%body(1, k), self%s_i(:, k))
      doubt = line_misfit(self%pinion%radius(k), s(1)*d(2) - s(2)*d(1))
   end function rack_closing_doubt

end module joint_rack
