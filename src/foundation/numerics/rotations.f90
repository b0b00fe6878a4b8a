!> Rotations in space: Euler parameters, matrices, axes and angles, and the principal axes of a tensor.
!>
!> A rotation matrix A turns components in a body's frame into those in the world's. Euler parameters p = (e0, e) make it,
!>
!> A(p) = [ (e0^2 - e.e) I + 2 e e^T + 2 e0 ~e ] / p.p
!>
!> whatever their length: what an integration adds to it does not matter. With w' the angular velocity in the body's frame
!> p' = L(p)^T w'/2,   w' = 2 L(p) p' / p.p,   p'' = L(p)^T w''/2 - |w'|^2 p/4
!> where w'' is the derivative of w' and L(p) = [ -e, e0 I - ~e ].
!>
!> Source: Flores et al. (2008), eqs. (6.3) to (6.6), with the factor two that (6.4) lacks. Limits: none.
module rotations
   use kinds, only: wp
   use lapack, only: dsyev
   implicit none (type, external)
   private
   public :: axes_across, euler_parameters_of, principal_axes, product_of, rate_of_parameters, rotation_about, rotation_of_axes
   public :: rotation_of_parameters, rotation_of_sequence, rotation_vector_of, second_rate_of_parameters, spin_of, turned_by
   public :: turned_onto

contains

   !> Rotation matrix of Euler parameters of any length but zero.
   pure function rotation_of_parameters(p) result(a)
      real(wp), intent(in) :: p(4)   !! (4) Euler parameters [1]
      real(wp) :: a(3, 3)            !! (3, 3) body frame to world frame [1]

      real(wp) :: twice, x(3), y(3), w(3)

      twice = 2.0_wp/(p(1)*p(1) + p(2)*p(2) + p(3)*p(3) + p(4)*p(4))
      w = twice*p(1)*p(2:4)
      x = twice*p(2)*p(2:4)
      y(2:3) = twice*p(3)*p(3:4)
      y(1) = twice*p(4)*p(4)
      a(1, 1) = 1.0_wp - y(2) - y(1)
      a(2, 1) = x(2) + w(3)
      a(3, 1) = x(3) - w(2)
      a(1, 2) = x(2) - w(3)
      a(2, 2) = 1.0_wp - x(1) - y(1)
      a(3, 2) = y(3) + w(1)
      a(1, 3) = x(3) + w(2)
      a(2, 3) = y(3) - w(1)
      a(3, 3) = 1.0_wp - x(1) - y(2)
   end function rotation_of_parameters

   !> Euler parameters of a rotation matrix, of length one, the maximum of them positive.
   pure function euler_parameters_of(a) result(p)
      real(wp), intent(in) :: a(3, 3)  !! (3, 3) rotation [1]
      real(wp) :: p(4)                 !! (4) Euler parameters [1]

      real(wp) :: squares(4)
      integer :: k

      squares(1) = 1.0_wp + a(1, 1) + a(2, 2) + a(3, 3)
      squares(2) = 1.0_wp + a(1, 1) - a(2, 2) - a(3, 3)
      squares(3) = 1.0_wp - a(1, 1) + a(2, 2) - a(3, 3)
      squares(4) = 1.0_wp - a(1, 1) - a(2, 2) + a(3, 3)
      k = maxloc(squares, dim=1)
      select case (k)
      case (1); p = [squares(1), a(3, 2) - a(2, 3), a(1, 3) - a(3, 1), a(2, 1) - a(1, 2)]
      case (2); p = [a(3, 2) - a(2, 3), squares(2), a(1, 2) + a(2, 1), a(1, 3) + a(3, 1)]
      case (3); p = [a(1, 3) - a(3, 1), a(1, 2) + a(2, 1), squares(3), a(2, 3) + a(3, 2)]
      case default; p = [a(2, 1) - a(1, 2), a(1, 3) + a(3, 1), a(2, 3) + a(3, 2), squares(4)]
      end select
      p = p/norm2(p)
   end function euler_parameters_of

   !> Euler parameters of one rotation after another: A(p q) = A(p) A(q).
   pure function product_of(p, q) result(r)
      real(wp), intent(in) :: p(4)   !! (4) Euler parameters of the outer rotation [1]
      real(wp), intent(in) :: q(4)   !! (4) those of the inner one [1]
      real(wp) :: r(4)               !! (4) those of both [1]

      r(1) = p(1)*q(1) - p(2)*q(2) - p(3)*q(3) - p(4)*q(4)
      r(2) = p(1)*q(2) + p(2)*q(1) + p(3)*q(4) - p(4)*q(3)
      r(3) = p(1)*q(3) - p(2)*q(4) + p(3)*q(1) + p(4)*q(2)
      r(4) = p(1)*q(4) + p(2)*q(3) - p(3)*q(2) + p(4)*q(1)
   end function product_of

   !> Euler parameters, of length one, after a turn about an axis of the body's frame.
   pure function turned_by(p, x) result(q)
      real(wp), intent(in) :: p(4)   !! (4) Euler parameters before [1]
      real(wp), intent(in) :: x(3)   !! (3) axis times angle, body's frame [rad]
      real(wp) :: q(4)               !! (4) Euler parameters after [1]

      real(wp) :: half, part

      half = 0.5_wp*norm2(x)
      part = 0.5_wp
      if (half > 0.0_wp) part = 0.5_wp*sin(half)/half
      q = product_of(p, [cos(half), part*x])
      q = q/norm2(q)
   end function turned_by

   !> A frame turned about the common perpendicular of its z and an axis, until z is along the axis; about x by half a turn if it
   !> points the other way.
   pure function turned_onto(frame, axis) result(a)
      real(wp), intent(in) :: frame(3, 3)  !! (3, 3) axes x, y, z as columns [1]
      real(wp), intent(in) :: axis(3)      !! (3) where z goes, of length one [1]
      real(wp) :: a(3, 3)                  !! (3, 3) the frame there [1]

      real(wp), parameter :: opposed = 1.0e-10_wp  ! angle of z to where it is opposed: nearer, a direction is round-off
      real(wp) :: q(4), z(3)

      z = frame(:, 3)
      ! twice the square of the cosine of half the angle is 1 + cos
      q = [1.0_wp + dot_product(z, axis), z(2)*axis(3) - z(3)*axis(2), z(3)*axis(1) - z(1)*axis(3), z(1)*axis(2) - z(2)*axis(1)]
      if (.not. norm2(q) > opposed) q = [0.0_wp, frame(:, 1)]
      a = matmul(rotation_of_parameters(q), frame)
   end function turned_onto

   !> The turn, at most half a revolution, that leads from one orientation to another: axis times angle, body's frame.
   pure function rotation_vector_of(from, to) result(x)
      real(wp), intent(in) :: from(4)  !! (4) Euler parameters before [1]
      real(wp), intent(in) :: to(4)    !! (4) Euler parameters after [1]
      real(wp) :: x(3)                 !! (3) axis times angle, body's frame [rad]

      real(wp) :: length, q(4)

      q = product_of([from(1), -from(2:4)], to)
      q = q/norm2(q)
      if (q(1) < 0.0_wp) q = -q
      length = norm2(q(2:4))
      x = 2.0_wp*q(2:4)
      if (length > 0.0_wp) x = 2.0_wp*atan2(length, q(1))*q(2:4)/length
   end function rotation_vector_of

   !> Rate of Euler parameters.
   pure function rate_of_parameters(p, w) result(rate)
      real(wp), intent(in) :: p(4)   !! (4) Euler parameters [1]
      real(wp), intent(in) :: w(3)   !! (3) angular velocity, body's frame [rad/s]
      real(wp) :: rate(4)            !! (4) their rate [1/s]

      rate(1) = -0.5_wp*(p(2)*w(1) + p(3)*w(2) + p(4)*w(3))
      rate(2) = 0.5_wp*(p(1)*w(1) - p(4)*w(2) + p(3)*w(3))
      rate(3) = 0.5_wp*(p(4)*w(1) + p(1)*w(2) - p(2)*w(3))
      rate(4) = 0.5_wp*(-p(3)*w(1) + p(2)*w(2) + p(1)*w(3))
   end function rate_of_parameters

   !> Second derivative of Euler parameters.
   pure function second_rate_of_parameters(p, w, w_dot) result(second)
      real(wp), intent(in) :: p(4)       !! (4) Euler parameters [1]
      real(wp), intent(in) :: w(3)       !! (3) angular velocity, body's frame [rad/s]
      real(wp), intent(in) :: w_dot(3)   !! (3) its derivative [rad/s^2]
      real(wp) :: second(4)              !! (4) second derivative [1/s^2]

      second = rate_of_parameters(p, w_dot) - 0.25_wp*(w(1)*w(1) + w(2)*w(2) + w(3)*w(3))*p
   end function second_rate_of_parameters

   !> Angular velocity, body's frame, from Euler parameters of any length and their rate.
   pure function spin_of(p, rate) result(w)
      real(wp), intent(in) :: p(4)      !! (4) Euler parameters [1]
      real(wp), intent(in) :: rate(4)   !! (4) their rate [1/s]
      real(wp) :: w(3)                  !! (3) angular velocity, body's frame [rad/s]

      w(1) = -p(2)*rate(1) + p(1)*rate(2) + p(4)*rate(3) - p(3)*rate(4)
      w(2) = -p(3)*rate(1) - p(4)*rate(2) + p(1)*rate(3) + p(2)*rate(4)
      w(3) = -p(4)*rate(1) + p(3)*rate(2) - p(2)*rate(3) + p(1)*rate(4)
      w = 2.0_wp*w/dot_product(p, p)
   end function spin_of

   !> Rotation about an axis.
   pure function rotation_about(axis, angle) result(a)
      real(wp), intent(in) :: axis(3)   !! (3) axis, of any length but zero [1]
      real(wp), intent(in) :: angle     !! angle, counter-clockwise observed from its tip [rad]
      real(wp) :: a(3, 3)               !! (3, 3) the rotation [1]

      a = rotation_of_parameters([cos(0.5_wp*angle), sin(0.5_wp*angle)*axis/norm2(axis)])
   end function rotation_about

   !> Rotation of three turns, each about an axis of the frame that the turns before it have made.
   pure function rotation_of_sequence(sequence, angles) result(a)
      character(3), intent(in) :: sequence   !! axes, as zxz
      real(wp), intent(in) :: angles(3)      !! (3) angles in this order [rad]
      real(wp) :: a(3, 3)                    !! (3, 3) the rotation [1]

      real(wp) :: axis(3)
      integer :: k

      a = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      do k = 1, 3
         axis = 0.0_wp
         axis(index("xyz", sequence(k:k))) = 1.0_wp
         a = matmul(a, rotation_about(axis, angles(k)))
      end do
   end function rotation_of_sequence

   !> Rotation whose first column is along one direction, and whose second lies in the plane of both, on the side of the other.
   !> Directions that are along one another, or zero, give a matrix of zeros.
   pure function rotation_of_axes(first, second) result(a)
      real(wp), intent(in) :: first(3)    !! (3) direction of the first axis [1]
      real(wp), intent(in) :: second(3)   !! (3) direction near the second axis [1]
      real(wp) :: a(3, 3)                 !! (3, 3) the rotation [1]

      real(wp), parameter :: minimum = 1.0e-6_wp  ! sine of the angle between them, at least [1]

      a = 0.0_wp
      if (.not. (norm2(first) > 0.0_wp .and. norm2(second) > 0.0_wp)) return
      a(:, 1) = first/norm2(first)
      a(:, 2) = second/norm2(second)
      a(:, 2) = a(:, 2) - dot_product(a(:, 1), a(:, 2))*a(:, 1)
      if (norm2(a(:, 2)) < minimum) then
         a = 0.0_wp
         return
      end if
      a(:, 2) = a(:, 2)/norm2(a(:, 2))
      a(:, 3) = across(a(:, 1), a(:, 2))
   end function rotation_of_axes

   !> The frame of an axis: its third column is along it, its first along the part across it of the coordinate axis that
   !> follows (x, y, z, x) the one nearest to it. So the frame of z is the frame itself.
   pure function axes_across(axis) result(a)
      real(wp), intent(in) :: axis(3)   !! (3) direction, not zero [1]
      real(wp) :: a(3, 3)               !! (3, 3) the frame's axes as columns [1]

      real(wp) :: reference(3), z(3)

      z = axis/norm2(axis)
      reference = 0.0_wp
      reference(modulo(maxloc(abs(z), dim=1), 3) + 1) = 1.0_wp
      a(:, 3) = z
      a(:, 1) = reference - dot_product(reference, z)*z
      a(:, 1) = a(:, 1)/norm2(a(:, 1))
      a(:, 2) = across(z, a(:, 1))
   end function axes_across

   !> a x b.
   pure function across(a, b) result(c)
      real(wp), intent(in) :: a(3)  !! (3) first factor [1]
      real(wp), intent(in) :: b(3)  !! (3) second factor [1]
      real(wp) :: c(3)              !! (3) product [1]

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function across

   !> Principal moments and axes of a symmetric tensor: its own axes, in their order, where it is diagonal; else each principal
   !> axis takes the place of the axis it is nearest to, and points the same way.
   subroutine principal_axes(tensor, moments, axes)
      real(wp), intent(in) :: tensor(3, 3)   !! (3, 3) the tensor [kg.m^2]
      real(wp), intent(out) :: moments(3)    !! (3) principal moments [kg.m^2]
      real(wp), intent(out) :: axes(3, 3)    !! (3, 3) principal axes as columns, right-handed [1]

      real(wp) :: found(3, 3), values(3), work(64)
      integer :: info, k, m, place(2)
      logical :: is_free(3, 3)

      moments = [(tensor(k, k), k=1, 3)]
      axes = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      if (.not. max(abs(tensor(2, 1)), abs(tensor(3, 1)), abs(tensor(3, 2))) > 0.0_wp) return
      found = tensor
      call dsyev("V", "L", 3, found, 3, values, work, size(work), info)
      if (info /= 0) error stop "principal_axes: no convergence"
      is_free = .true.
      do m = 1, 3
         place = maxloc(abs(found), mask=is_free)
         moments(place(1)) = values(place(2))
         axes(:, place(1)) = sign(1.0_wp, found(place(1), place(2)))*found(:, place(2))
         is_free(place(1), :) = .false.
         is_free(:, place(2)) = .false.
      end do
      if (dot_product(across(axes(:, 1), axes(:, 2)), axes(:, 3)) < 0.0_wp) axes(:, 3) = -axes(:, 3)
   end subroutine principal_axes

end module rotations
