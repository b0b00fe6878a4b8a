!> How large the mechanism of a scene is: the length that error norms and constraint violations are measured by.
module scene_size
   use kinds, only: wp
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: is_large, size_of_bodies

   integer, parameter :: most_dense = 50  !! bodies up to which implicit methods keep full matrices

contains

   !> Size of the bodies: the greatest distance of a point from its body's centre of mass; the greatest radius of gyration
   !> if all points are there. It does not depend on where the mechanism stands.
   pure real(wp) function size_of_bodies(scene) result(length)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: k

      length = 0.0_wp
      do k = 1, scene%points%n
         if (scene%points%body(k) > 0) length = max(length, norm2(scene%points%s(:, k)))
      end do
      if (length <= 0.0_wp) length = maxval(sqrt(scene%bodies%inertia/scene%bodies%mass))
   end function size_of_bodies

   !> Whether implicit methods keep their matrices sparse: a full one has (6 n)^2 entries for n bodies, each found by a difference.
   pure logical function is_large(scene)
      type(scene_t), intent(in) :: scene  !! the scene

      is_large = scene%bodies%n > most_dense
   end function is_large

end module scene_size
