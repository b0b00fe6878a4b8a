!> How large the mechanism of a scene is: the length that error norms and constraint violations are measured by.
module scene_size
   use kinds, only: wp
   use rotations, only: rotation_of_parameters
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: extent_of_scene, is_large, size_of_bodies, start_direction, start_position

   integer, parameter :: most_dense = 50  !! bodies up to which implicit methods keep full matrices

contains

   !> Size of the bodies: the maximum distance of a point from its body's centre of mass; the maximum radius of gyration
   !> if all points are there. It does not depend on where the mechanism stands. A group of bodies is measured by the whole.
   pure real(wp) function size_of_bodies(scene) result(length)
      type(scene_t), intent(in) :: scene  !! the scene

      integer :: k

      length = scene%size_of_whole
      if (length > 0.0_wp) return
      do k = 1, scene%points%n
         if (scene%points%body(k) > 0) length = max(length, norm2(scene%points%s(:, k)))
      end do
      if (length <= 0.0_wp) length = maxval(sqrt(scene%bodies%inertia/scene%bodies%mass))
   end function size_of_bodies

   !> Size of a scene where the deck puts it: the diagonal of the box around all centres of mass and points; 0: a single place.
   pure real(wp) function extent_of_scene(scene) result(length)
      type(scene_t), intent(in) :: scene    !! the scene

      real(wp) :: maximum(3), minimum(3), place(3)
      integer :: k

      maximum = -huge(1.0_wp)
      minimum = huge(1.0_wp)
      do k = 1, scene%bodies%n
         maximum = max(maximum, scene%bodies%r(:, k))
         minimum = min(minimum, scene%bodies%r(:, k))
      end do
      do k = 1, scene%points%n
         place = start_position(scene, k)
         maximum = max(maximum, place)
         minimum = min(minimum, place)
      end do
      length = norm2(maximum - minimum)
   end function extent_of_scene

   !> Where the deck puts a point at the start.
   pure function start_position(scene, point) result(p)
      type(scene_t), intent(in) :: scene  !! the scene
      integer, intent(in) :: point        !! the point
      real(wp) :: p(3)                    !! (3) its position, world frame [m]

      real(wp) :: c, s

      p = scene%points%s(:, point)
      associate (body => scene%points%body(point))
         if (body == 0) return
         if (scene%settings%is_spatial) then
            p = scene%bodies%r(:, body) + matmul(rotation_of_parameters(scene%bodies%spatial%p(:, body)), p)
         else
            c = cos(scene%bodies%angle(body))
            s = sin(scene%bodies%angle(body))
            p = scene%bodies%r(:, body) + [c*p(1) - s*p(2), s*p(1) + c*p(2), p(3)]
         end if
      end associate
   end function start_position

   !> Where the deck lets a direction of a body in space point at the start.
   pure function start_direction(scene, body, x) result(z)
      type(scene_t), intent(in) :: scene  !! the scene, in space
      integer, intent(in) :: body         !! the body, 0: ground
      real(wp), intent(in) :: x(3)        !! (3) along the body's own axes, not zero [1]
      real(wp) :: z(3)                    !! (3) unit vector, world frame [1]

      z = x/norm2(x)
      if (body == 0) return
      associate (spatial => scene%bodies%spatial)
         z = matmul(rotation_of_parameters(spatial%p(:, body)), matmul(z, spatial%own(:, :, body)))
      end associate
   end function start_direction

   !> Whether implicit methods keep their matrices sparse: a full one has (6 n)^2 entries for n bodies, each found by a difference.
   pure logical function is_large(scene)
      type(scene_t), intent(in) :: scene  !! the scene

      is_large = scene%bodies%n > most_dense
   end function is_large

end module scene_size
