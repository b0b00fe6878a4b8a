!> A vector whose components are functions of time and motion, along the axes of the world or of a body, as its deck gives them.
module vector_load
   use expression, only: expression_t
   use item, only: item_t, place_of
   use kinds, only: wp
   use motion, only: motion_t
   use observed_motion, only: value_of
   implicit none (type, external)
   private
   public :: vector_load_t

   !> A force or a moment.
   type :: vector_load_t
      type(expression_t) :: component(3)   !! (3) along x, y, z [N or N.m]
      logical :: is_in_body = .false.      !! along the axes of the body, not the world's
   contains
      procedure :: prepare => load_prepare
      procedure :: at => load_at
   end type vector_load_t

contains

   !> Take a row of a table.
   subroutine load_prepare(self, item, names)
      class(vector_load_t), intent(inout) :: self  !! the vector
      type(item_t), intent(in) :: item             !! the row, with a column `frame`
      character(*), intent(in) :: names(3)         !! (3) columns of its components

      integer :: c

      do c = 1, 3
         self%component(c) = item%values(place_of(item, names(c)))%expression
      end do
      self%is_in_body = item%word("frame") == "body"
   end subroutine load_prepare

   !> The vector at a time, for a body at its motion.
   pure function load_at(self, t, motion, body) result(f)
      class(vector_load_t), intent(in) :: self   !! the vector
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      integer, intent(in) :: body                !! the body
      real(wp) :: f(3)                           !! (3) world frame [N or N.m]

      integer :: c

      do c = 1, 3
         f(c) = value_of(self%component(c), t, motion)
      end do
      if (self%is_in_body) f = matmul(motion%rot(:, :, body), matmul(f, motion%spatial%own(:, :, body)))
   end function load_at

end module vector_load
