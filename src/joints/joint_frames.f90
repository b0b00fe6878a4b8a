!> Frames x, y, z of an axis in each of two bodies.
!>
!> z is the axis; where the deck leaves out that of j, it is that of i as the deck puts the bodies. x is along the part across z
!> of the body axis that follows (xi, eta, zeta, xi) the one nearest to z. Where the turn counts from the start x of j is that of i
!> instead, as the deck puts the bodies.
!>
!> Source: from the definition. Limits: none.
module joint_frames
   use kind_info, only: add_word, kind_info_t
   use kinds, only: wp
   use motion, only: cross, motion_t
   use rotations, only: axes_across
   implicit none (type, external)
   private
   public :: add_zero_column, find_frames, from_start

   character(*), parameter :: from_start = "start"   !! a word of the column `zero`

contains

   !> Column that says where an angle is zero.
   subroutine add_zero_column(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_word(info, "zero", "where the angle is zero: axes, with the reference directions of both bodies together; start, as &
                    &the deck puts the bodies", default="axes", choices="axes "//from_start)
   end subroutine add_zero_column

   !> The frames of an item, where the deck puts the bodies.
   subroutine find_frames(motion, body, axis_i, axis_j, is_held, frame_i, frame_j)
      type(motion_t), intent(in) :: motion   !! bodies where the deck puts them
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: axis_i(3)      !! (3) axis along the body's own axes, as in the deck [1]
      real(wp), intent(in) :: axis_j(3)      !! (3) the same of j; zero: left out [1]
      logical, intent(in) :: is_held         !! x of j is that of i
      real(wp), intent(out) :: frame_i(3, 3) !! (3, 3) axes x, y, z as columns, frame of body i [1]
      real(wp), intent(out) :: frame_j(3, 3) !! (3, 3) axes x, y, z as columns, frame of body j [1]

      real(wp), parameter :: along = 1.0e-6_wp   ! sine of an angle that is none [1]
      real(wp) :: axis(3), x(3), z(3)
      integer :: k

      associate (own => motion%spatial%own, rot => motion%rot, i => body(1), j => body(2))
         frame_i = matmul(transpose(own(:, :, i)), axes_across(axis_i))
         axis = axis_j
         if (.not. any(abs(axis) > 0.0_wp)) axis = matmul(own(:, :, j), matmul(matmul(rot(:, :, i), frame_i(:, 3)), rot(:, :, j)))
         frame_j = matmul(transpose(own(:, :, j)), axes_across(axis))
         if (.not. is_held) return
         z = frame_j(:, 3)
         do k = 1, 2   ! across z of j; where x of i is along it, y of i
            x = matmul(matmul(rot(:, :, i), frame_i(:, k)), rot(:, :, j))
            x = x - dot_product(x, z)*z
            if (norm2(x) > along) exit
         end do
         frame_j(:, 1) = x/norm2(x)
         frame_j(:, 2) = cross(z, frame_j(:, 1))
      end associate
   end subroutine find_frames

end module joint_frames
