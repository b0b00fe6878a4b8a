!> Small changes of coordinates in space, along the bodies' axes too, and what is reported of them.
submodule(spatial_coordinates) spatial_local_changes
   implicit none (type, external)

contains

   !> Along the bodies' axes, where turns and angular velocities are already.
   module procedure spatial_to_local
      real(wp) :: rot(3, 3)
      integer :: k

      do k = 1, n
         rot = rotation_of_parameters(q(4:7, k))
         x(1:3, k) = matmul(q_change(1:3, k), rot)
         x(4:6, k) = spin_of(q(4:7, k), q_change(4:7, k))
         w(1:3, k) = matmul(v_change(1:3, k), rot)
         w(4:6, k) = v_change(4:6, k)
      end do
   end procedure spatial_to_local

   !> Along the world's axes, and the change of Euler parameters that a turn makes.
   module procedure spatial_from_local
      real(wp) :: rot(3, 3)
      integer :: k

      do k = 1, n
         rot = rotation_of_parameters(q(4:7, k))
         q_change(1:3, k) = matmul(rot, x(1:3, k))
         q_change(4:7, k) = rate_of_parameters(q(4:7, k), x(4:6, k))
         v_change(1:3, k) = matmul(rot, w(1:3, k))
         v_change(4:6, k) = w(4:6, k)
      end do
   end procedure spatial_from_local

   !> Values that are read, body by body. What is along a body's axes is along those of the deck.
   module procedure spatial_report
      real(wp) :: p(4)
      integer :: at, k, m

      do m = 1, readings%n
         at = readings%of(m)%place
         k = readings%of(m)%item
         select case (readings%of(m)%code)
         case (of_position)
            values(at + 1:at + 3) = motion%r(:, k)
         case (of_velocity)
            values(at + 1:at + 3) = motion%v(:, k)
         case (of_acceleration)
            values(at + 1:at + 3) = motion%a(:, k)
         case (of_orientation)
            ! of the own axes, on the side of the parameters that are integrated, so that the curves have no jumps
            p = euler_parameters_of(motion%spatial%own(:, :, k))
            values(at + 1:at + 4) = product_of(motion%spatial%p(:, k), [p(1), -p(2:4)])/norm2(motion%spatial%p(:, k))
         case (of_angular_velocity)
            values(at + 1:at + 3) = motion%omega(:, k)
         case (of_angular_acceleration)
            values(at + 1:at + 3) = motion%alpha(:, k)
         case (of_spin)
            values(at + 1:at + 3) = matmul(motion%spatial%own(:, :, k), motion%spatial%spin(:, k))
         end select
      end do
   end procedure spatial_report

   !> Displacements, and turns about axes of the body; Euler parameters come out at length one.
   module procedure spatial_add_change
      integer :: k

      do k = 1, n
         q(1:3, k) = q(1:3, k) + x(1:3, k)
         q(4:7, k) = turned_by(q(4:7, k), x(4:6, k))
      end do
   end procedure spatial_add_change

   !> Displacements and turns from one position to another.
   module procedure spatial_difference
      integer :: k

      do k = 1, n
         x(1:3, k) = to(1:3, k) - from(1:3, k)
         x(4:6, k) = rotation_vector_of(from(4:7, k), to(4:7, k))
      end do
   end procedure spatial_difference

end submodule spatial_local_changes
