!> Distance joint in space: a massless link with a ball at each end.
!>
!> Phi = |d| - l,   d = P_j - P_i                                            (1 row)
!>
!> A row without a length has the distance of the points where the deck puts the bodies. Signs: a positive multiplier, and channel
!> `tension`, pulls the points together. Source: Flores et al. (2008), section 6.2, with |d| - l for d . d - l^2, so that the
!> violation is a length and the multiplier a force. Limits: as joint.distance of the plane.
module spatial_distance
   use joint_distance, only: joint_distance_t
   use joint_set, only: of_own
   use kind_info, only: add_channel, add_number, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: add_joint_columns, add_reaction_channels
   use spatial_rows, only: length_of_span, put_row
   implicit none (type, external)
   private
   public :: spatial_distance_t

   !> All distance joints of a spatial scene.
   type, extends(joint_distance_t) :: spatial_distance_t
   contains
      procedure, nopass :: info => distance_info
      procedure :: evaluate => distance_evaluate
   end type spatial_distance_t

contains

   !> Description of the kind.
   function distance_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.distance"
      info%help = "massless link with spherical joints at both ends: constant distance of two points"
      info%source = "Flores et al. (2008), section 6.2"
      info%n_row = 1
      call add_joint_columns(info)
      call add_number(info, "length", dim_length, "length; default: the distance at the given initial positions", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_reaction_channels(info)
      call add_channel(info, "tension", "N", "none", 1, "force along the link, positive in tension", &
                       of_own)
   end function distance_info

   !> Fill the rows of all items.
   subroutine distance_evaluate(self, t, motion, rows)
      class(spatial_distance_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                      !! time [s]
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(rows_t), intent(inout) :: rows            !! rows, those of the set are filled

      integer :: k

      do k = 1, self%n
         call put_row(rows, self%first_row + k, motion, self%body(:, k), &
                      length_of_span(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k)), self%length(k), 0.0_wp, 0.0_wp)
      end do
   end subroutine distance_evaluate

end module spatial_distance
