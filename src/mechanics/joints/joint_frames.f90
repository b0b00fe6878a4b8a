!> Frames x, y, z of an axis in each of two bodies.
!>
!> z is the axis; where the deck omits that of j, it is that of i as the deck puts the bodies. x is along the part across z
!> of the direction that the deck gives, or else of the body axis that follows (xi, eta, zeta, xi) the one nearest to z. Where the
!> turn counts from the start x of j is that of i instead, as the deck puts the bodies.
!>
!> Source: from the definition. Limits: none.
module joint_frames
   use kind_info, only: add_direction, add_word, kind_info_t
   use kinds, only: wp
   use motion, only: cross, motion_t
   use rotations, only: axes_across
   implicit none (type, external)
   private
   public :: add_zero_columns, find_frames, from_start

   character(*), parameter :: from_start = "start"   !! a word of the column `zero`

contains

   !> Columns that say where an angle is zero.
   subroutine add_zero_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_direction(info, "x_i", "reference direction across the axis, in the frame of the body of i; default: the body axis &
                         &after the one nearest to the axis", default="")
      call add_direction(info, "x_j", "the same of j, in the frame of its body", default="")
      call add_word(info, "zero", "zero of the angle: axes, where the reference directions coincide; start, at the given &
                    &positions of the bodies", default="axes", choices="axes "//from_start)
   end subroutine add_zero_columns

   !> The frames of an item, where the deck puts the bodies.
   subroutine find_frames(motion, body, axis_i, axis_j, is_held, frame_i, frame_j, across)
      type(motion_t), intent(in) :: motion   !! bodies where the deck puts them
      integer, intent(in) :: body(2)         !! (2) bodies i and j
      real(wp), intent(in) :: axis_i(3)      !! (3) axis along the body's own axes, as in the deck [1]
      real(wp), intent(in) :: axis_j(3)      !! (3) the same of j; zero: omitted [1]
      logical, intent(in) :: is_held         !! x of j is that of i
      real(wp), intent(out) :: frame_i(3, 3) !! (3, 3) axes x, y, z as columns, frame of body i [1]
      real(wp), intent(out) :: frame_j(3, 3) !! (3, 3) axes x, y, z as columns, frame of body j [1]
      real(wp), intent(in), optional :: across(3, 2) !! (3, 2) x along the own axes of i and of j; zero: omitted [1]

      real(wp), parameter :: along = 1.0e-6_wp   ! sine of an angle that is none [1]
      real(wp) :: axis(3)
      integer :: k

      associate (own => motion%spatial%own, rot => motion%rot, i => body(1), j => body(2))
         frame_i = matmul(transpose(own(:, :, i)), axes_across(axis_i))
         if (present(across)) call turn_to(matmul(across(:, 1), own(:, :, i)), frame_i)
         axis = axis_j
         if (.not. any(abs(axis) > 0.0_wp)) axis = matmul(own(:, :, j), matmul(matmul(rot(:, :, i), frame_i(:, 3)), rot(:, :, j)))
         frame_j = matmul(transpose(own(:, :, j)), axes_across(axis))
         if (is_held) then
            do k = 1, 2   ! x of i; where that is along z of j, y of i
               axis = matmul(matmul(rot(:, :, i), frame_i(:, k)), rot(:, :, j))
               if (norm2(axis - dot_product(axis, frame_j(:, 3))*frame_j(:, 3)) > along) exit
            end do
            call turn_to(axis, frame_j)
         else if (present(across)) then
            call turn_to(matmul(across(:, 2), own(:, :, j)), frame_j)
         end if
      end associate
   end subroutine find_frames

   !> Turn a frame about its z until x is along the part across z of a direction; a direction of no length leaves it as it is.
   pure subroutine turn_to(direction, frame)
      real(wp), intent(in) :: direction(3)      !! (3) the direction [1]
      real(wp), intent(inout) :: frame(3, 3)    !! (3, 3) axes x, y, z as columns [1]

      real(wp) :: x(3)

      if (.not. any(abs(direction) > 0.0_wp)) return
      associate (z => frame(:, 3))
         x = direction - dot_product(direction, z)*z
         frame(:, 1) = x/norm2(x)
         frame(:, 2) = cross(z, frame(:, 1))
      end associate
   end subroutine turn_to

end module joint_frames
