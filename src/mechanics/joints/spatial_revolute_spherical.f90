!> A massless link with a pin at one end and a ball at the other: revolute-spherical composite joint.
!>
!> Phi = [ z_i . d,  |d| - l ],   d = P_j - P_i                              (2 rows)
!>
!> The ball at P_j of body j stays at the distance l from the pin at P_i, in the plane across the pin's axis z_i.
!> Signs: the multiplier of the second row is the tension of the link. Frames: `spatial_joint`.
!> Source: Nikravesh (1988), section 7.2.5. Limits: l > 0; the link has no mass and no coordinate of its own.
module spatial_revolute_spherical
   use item, only: item_t
   use kind_info, only: add_direction, add_number, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: add_joint_columns, add_spatial_channels, beside, set_joint_frames, spatial_joint_t
   use spatial_rows, only: length_of_span, put_row, scalar_t
   implicit none (type, external)
   private
   public :: spatial_revolute_spherical_t

   !> All such links.
   type, extends(spatial_joint_t) :: spatial_revolute_spherical_t
      real(wp), allocatable :: length(:)  !! (n) length; zero: that at the start [m]
   contains
      procedure, nopass :: info => link_info
      procedure :: prepare => link_prepare
      procedure :: set_start => link_set_start
      procedure :: evaluate => link_evaluate
   end type spatial_revolute_spherical_t

contains

   !> Description of the kind.
   function link_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.revolute_spherical"
      info%help = "massless link with a revolute joint at one body and a spherical joint at the other"
      info%source = "Nikravesh (1988), section 7.2.5"
      info%n_row = 2
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "axis of the pin, in the frame of the body of i", default='"0 0 1"')
      call add_number(info, "length", dim_length, "length; default: the distance at the given initial positions", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_spatial_channels(info)
   end function link_info

   !> Lengths.
   subroutine link_prepare(self, items, angle)
      class(spatial_revolute_spherical_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                        !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                           !! (0:bodies) not used [rad]

      integer :: k

      call self%take_axes(items, [beside(3)])
      self%length = [(merge(items(k)%number("length"), 0.0_wp, items(k)%is_given("length")), k=1, self%n)]
   end subroutine link_prepare

   !> Lengths that the deck omits.
   subroutine link_set_start(self, motion)
      class(spatial_revolute_spherical_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion                        !! bodies where the deck puts them

      type(scalar_t) :: x
      integer :: k

      call set_joint_frames(self, motion)
      do k = 1, self%n
         x = length_of_span(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k))
         if (.not. self%length(k) > 0.0_wp) self%length(k) = x%value
      end do
   end subroutine link_set_start

   !> Fill the rows of all items.
   subroutine link_evaluate(self, t, motion, rows)
      class(spatial_revolute_spherical_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                                !! time [s]
      type(motion_t), intent(in) :: motion                     !! positions and velocities
      type(rows_t), intent(inout) :: rows                      !! rows, those of the set are filled

      integer :: k

      call self%fill_rows(motion, rows)
      do k = 1, self%n
         call put_row(rows, self%first_row + 2*k, motion, self%body(:, k), &
                      length_of_span(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k)), self%length(k), 0.0_wp, 0.0_wp)
      end do
   end subroutine link_evaluate

end module spatial_revolute_spherical
