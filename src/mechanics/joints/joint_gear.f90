!> Gears: two gears roll on one another, wherever their centres move.
!>
!> With d = r_j^P - r_i^P from centre to centre, L = |d|, u = d/L, n = R90 u, phi the angle of d and R = R_i + R_j:
!> Phi = R (phi - phi_0) - R_i (angle_i - angle_i0) - R_j (angle_j - angle_j0)                     (1 row)
!> Phi_q = [ -R n/L, -R_i - R u . s_i/L, R n/L, -R_j + R u . s_j/L ]
!> gamma = R [ n . (s_j w_j^2 - s_i w_i^2)/L + 2 (u . d') (n . d')/L^2 ]
!>
!> Phi is taken next to zero: turns of phi are not counted, because a whole one adds 2 pi R. Phi' = 0 says that both pitch circles
!> have the same velocity where they touch, so that a carrier may turn (planetary gears). A ring gear has a negative radius.
!> Signs: the force on the body of i, where the circles touch, is (R/L) n lambda.
!> Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 4.2.4, with the line of centres in place
!> of a carrier. Limits: other joints hold the centres, |R| apart; the force is along the common tangent: what a pressure
!> angle adds along the line of centres is omitted, as is any play.
module joint_gear
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t
   use kind_info, only: add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: pi, wp
   use mesh, only: distance_misfit, two_rings
   use motion, only: motion_t, point_position
   use rows, only: rows_t
   use span, only: span_of
   implicit none (type, external)
   private
   public :: joint_gear_t

   !> All pairs of gears of a planar scene.
   type, extends(joint_set_t) :: joint_gear_t
      real(wp), allocatable :: radius(:, :)  !! (2, n) radii of the pitch circles of i and j, of a ring gear negative [m]
      real(wp), allocatable :: start(:)      !! (n) R phi_0 - R_i angle_i0 - R_j angle_j0 [m]
   contains
      procedure, nopass :: info => gear_info
      procedure :: prepare => gear_prepare
      procedure :: set_start => gear_set_start
      procedure :: evaluate => gear_evaluate
      procedure :: reaction_point => gear_reaction_point
      procedure :: closing_fault => gear_closing_fault
      procedure :: closing_doubt => gear_closing_doubt
   end type joint_gear_t

contains

   !> Description of the kind.
   function gear_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.gear"
      info%space = in_plane
      info%help = "two gears in mesh; other joints guide their centres, on a carrier that may move"
      info%source = "Nikravesh (1988), section 4.2.4"
      info%n_row = 1
      call add_reference(info, "i", "points", "centre of the first gear")
      call add_reference(info, "j", "points", "centre of the second gear")
      call add_number(info, "radius_i", dim_length, "radius of the pitch circle of the first gear; negative: a ring gear", &
                      not_zero=.true.)
      call add_number(info, "radius_j", dim_length, "radius of the pitch circle of the second gear; negative: a ring gear", &
                      not_zero=.true.)
      call add_joint_channels(info)
   end function gear_info

   !> Radii.
   subroutine gear_prepare(self, items, angle)
      class(joint_gear_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)           !! (0:bodies) angles at the start [rad]

      integer :: k

      allocate (self%radius(2, self%n), self%start(self%n), source=0.0_wp)
      do k = 1, self%n
         self%radius(:, k) = [items(k)%number("radius_i"), items(k)%number("radius_j")]
      end do
   end subroutine gear_prepare

   !> The gears mesh as the deck puts them.
   subroutine gear_set_start(self, motion)
      class(joint_gear_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! bodies where the deck puts them

      real(wp) :: length, rate, u(3)
      integer :: k

      do k = 1, self%n
         call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
         self%start(k) = sum(self%radius(:, k))*atan2(u(2), u(1)) - dot_product(self%radius(:, k), motion%angle(self%body(:, k)))
      end do
   end subroutine gear_set_start

   !> One of two gears at most is a ring gear.
   function gear_closing_fault(self, k, motion) result(fault)
      class(joint_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      character(:), allocatable :: fault       !! what is wrong; blank: nothing

      fault = repeat("", size(motion%angle))
      if (all(self%radius(:, k) < 0.0_wp)) fault = two_rings
   end function gear_closing_fault

   !> The centres of gears that touch are as far apart as the radii make it; where they coincide, the row is one of angles.
   function gear_closing_doubt(self, k, motion) result(doubt)
      class(joint_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      character(:), allocatable :: doubt       !! what does not match; blank: nothing

      real(wp) :: length, rate, u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
      doubt = distance_misfit(self%radius(:, k), length)
   end function gear_closing_doubt

   !> Fill the rows of all items. Centres that coincide have no line: a row of angles remains.
   subroutine gear_evaluate(self, t, motion, rows)
      class(joint_gear_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                !! time [s]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(rows_t), intent(inout) :: rows      !! rows, those of the set are filled

      real(wp) :: along, length, n(3), r, s_i(3), s_j(3), tangential, turn, u(3)
      integer :: i, j, k, row

      do k = 1, self%n
         row = self%first_row + k
         i = self%body(1, k)
         j = self%body(2, k)
         s_i = point_position(motion, i, self%s_i(:, k)) - motion%r(:, i)
         s_j = point_position(motion, j, self%s_j(:, k)) - motion%r(:, j)
         call span_of(motion, [i, j], self%s_i(:, k), self%s_j(:, k), u, length, along)
         n = [-u(2), u(1), 0.0_wp]
         r = sum(self%radius(:, k))/max(length, tiny(1.0_wp))
         turn = 2.0_wp*pi*abs(sum(self%radius(:, k)))
         ! n . d', with d' = v_j + w_j R90 s_j - v_i - w_i R90 s_i
         tangential = dot_product(n, motion%v(:, j) - motion%v(:, i)) + dot_product(u, s_j)*motion%omega(3, j) &
                      - dot_product(u, s_i)*motion%omega(3, i)
         rows%phi(row) = sum(self%radius(:, k))*atan2(u(2), u(1)) - dot_product(self%radius(:, k), motion%angle([i, j])) &
                         - self%start(k)
         if (turn > 0.0_wp) rows%phi(row) = rows%phi(row) - turn*anint(rows%phi(row)/turn)
         rows%phi_t(row) = 0.0_wp
         rows%jac(:, row) = [-r*n(1), -r*n(2), -self%radius(1, k) - r*dot_product(u, s_i), &
                             r*n(1), r*n(2), -self%radius(2, k) + r*dot_product(u, s_j)]
         rows%gam(row) = r*(dot_product(n, s_j)*motion%omega(3, j)**2 - dot_product(n, s_i)*motion%omega(3, i)**2 &
                            + 2.0_wp*along*tangential/max(length, tiny(1.0_wp)))
      end do
   end subroutine gear_evaluate

   !> Where the pitch circles touch: it divides the line of centres as the radii do.
   function gear_reaction_point(self, k, motion) result(p)
      class(joint_gear_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                 !! item
      type(motion_t), intent(in) :: motion     !! positions
      real(wp) :: p(3)                         !! (3) the point, world frame [m]

      real(wp) :: length, rate, u(3)

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
      p = point_position(motion, self%body(1, k), self%s_i(:, k)) + length*self%radius(1, k)/sum(self%radius(:, k))*u
   end function gear_reaction_point

end module joint_gear
