!> Chain drive: two sprockets turn so that the chain between them does not slip.
!>
!> Phi = R_i (angle_i - angle_i0) - R_j (angle_j - angle_j0)                          (1 row)
!> Phi_q = [ 0, 0, R_i, 0, 0, -R_j ],   gamma = 0
!>
!> Signs: both radii positive, an open chain; one negative, a crossed one. The multiplier is the chain's pull.
!> Source: rolling without slip, as for gears. Limits: a chain without mass that does not stretch;
!> sprockets whose frame does not turn.
module joint_chain
   use item, only: item_t
   use joint_set, only: add_joint_channels, joint_set_t
   use rows, only: rows_t
   use kind_info, only: add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   implicit none (type, external)
   private
   public :: joint_chain_t

   !> All chain drives of a planar scene.
   type, extends(joint_set_t) :: joint_chain_t
      real(wp), allocatable :: radius(:, :)  !! (2, n) of the sprockets [m]
      real(wp), allocatable :: start(:)      !! (n) R_i angle_i0 - R_j angle_j0 [m]
   contains
      procedure, nopass :: info => chain_info
      procedure :: prepare => chain_prepare
      procedure :: evaluate => chain_evaluate
   end type joint_chain_t

contains

   !> Description of the kind.
   function chain_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.chain"
      info%space = in_plane
      info%help = "chain drive of two sprockets, without slip"
      info%source = "rolling without slip"
      info%n_row = 1
      call add_reference(info, "i", "bodies", "the first sprocket")
      call add_reference(info, "j", "bodies", "the second sprocket")
      call add_number(info, "radius_i", dim_length, "radius of the first sprocket", not_zero=.true.)
      call add_number(info, "radius_j", dim_length, "radius of the second sprocket; negative: the chain is crossed", &
                      not_zero=.true.)
      call add_joint_channels(info)
   end function chain_info

   !> Radii, and the angles at the start.
   subroutine chain_prepare(self, items, angle)
      class(joint_chain_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)        !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)           !! (0:bodies) angles at the start [rad]

      integer :: k

      self%sides_apart = .true.
      allocate (self%radius(2, self%n), self%start(self%n))
      do k = 1, self%n
         self%radius(:, k) = [items(k)%number("radius_i"), items(k)%number("radius_j")]
         self%start(k) = self%radius(1, k)*angle(self%body(1, k)) - self%radius(2, k)*angle(self%body(2, k))
      end do
   end subroutine chain_prepare

   !> Fill the rows of all items.
   subroutine chain_evaluate(self, t, motion, rows)
      class(joint_chain_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                !! time [s]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(rows_t), intent(inout) :: rows      !! rows, those of the set are filled

      integer :: k, row

      do k = 1, self%n
         row = self%first_row + k
         associate (i => self%body(1, k), j => self%body(2, k), r => self%radius(:, k))
            rows%phi(row) = r(1)*motion%angle(i) - r(2)*motion%angle(j) - self%start(k)
            rows%phi_t(row) = 0.0_wp
            rows%jac(:, row) = [0.0_wp, 0.0_wp, r(1), 0.0_wp, 0.0_wp, -r(2)]
            rows%gam(row) = 0.0_wp
         end associate
      end do
   end subroutine chain_evaluate

end module joint_chain
