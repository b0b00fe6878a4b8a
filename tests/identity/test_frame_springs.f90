!> Bushings and beams: the textbooks' matrices, frequencies of a chain of beams, moments of large rotations.
module test_frame_springs
   use bodies, only: points_t
   use check, only: check_close, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use frame_spring_rows, only: find_set, make_item
   use force_set, only: force_set_t
   use generic_item, only: column_number
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use lapack, only: dsygv
   use motion, only: loads_t, motion_t, new_loads, new_motion
   use planar_coordinates, only: set_planar_motion
   use rotations, only: rotation_about
   implicit none (type, external)
   private
   public :: run_test_frame_springs

   real(wp), parameter :: e = 3.0_wp, g = 1.3_wp, area = 0.7_wp, i_y = 0.5_wp, i_z = 0.4_wp, twist = 0.6_wp, a_y = 1.2_wp, &
                          a_z = 1.1_wp, l = 1.7_wp   ! a beam, SI

contains

   subroutine run_test_frame_springs(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("spatial_beam_matrix", test_spatial_beam_matrix)
      call suite%test("planar_beam_matrix", test_planar_beam_matrix)
      call suite%test("frequencies", test_frequencies)
      call suite%test("large_rotation", test_large_rotation)
      call suite%test("half_a_turn", test_half_a_turn)
   end subroutine run_test_frame_springs

   !> Loads of a beam along x between two bodies of space by small displacements of its ends: the matrix of 12 x 12.
   subroutine test_spatial_beam_matrix(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-3_wp
      class(force_set_t), allocatable :: set
      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(loads_t) :: loads
      type(motion_t) :: motion
      type(points_t) :: points
      real(wp) :: found(12, 12), f(12, 4), matrix(12, 12), own(3, 3, 0:2), power, turn(3)
      integer :: body, c, column, k

      call find_set("force.beam", .true., set, info)
      call make_item(info, [character(16) :: "modulus", "shear_modulus", "area", "second_moment_y", "second_moment_z", &
                            "torsion_constant", "shear_ratio_y", "shear_ratio_z"], &
                     [e, g, area, i_y, i_z, twist, a_y, a_z], items(1))
      points%n = 2
      points%body = [1, 2]
      allocate (points%s(3, 2), source=0.0_wp)
      own = 0.0_wp
      do k = 1, 3
         own(k, k, :) = 1.0_wp
      end do
      call new_motion(2, motion, own)
      motion%r(1, 2) = l
      call set%prepare(items, points)
      call set%set_start(motion)
      do column = 1, 12
         body = 1 + (column - 1)/6
         c = column - 6*(body - 1)
         do k = 1, 4
            turn = 0.0_wp
            if (c > 3) turn(c - 3) = places(k)*step
            if (c <= 3) motion%r(c, body) = motion%r(c, body) + places(k)*step
            if (c > 3) motion%rot(:, :, body) = rotation_about(turn, norm2(turn))
            call new_loads(2, loads)
            power = 0.0_wp
            call set%evaluate(0.0_wp, motion, loads, power)
            f(:, k) = [loads%force(:, 1), loads%moment(:, 1), loads%force(:, 2), loads%moment(:, 2)]
            if (c <= 3) motion%r(c, body) = motion%r(c, body) - places(k)*step
            motion%rot(:, :, body) = own(:, :, 0)
         end do
         do k = 1, 12
            found(k, column) = -five_point(f(k, :), step)
         end do
      end do
      matrix = 0.0_wp
      call put([1, 7], e*area/l*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2]))
      call put([4, 10], g*twist/l*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2]))
      call put([2, 6, 8, 12], bending(e*i_z, a_y, 1.0_wp))
      call put([3, 5, 9, 11], bending(e*i_y, a_z, -1.0_wp))
      do column = 1, 12
         call check_close(error, found(:, column), matrix(:, column), 1.0e-9_wp, "column of the matrix")
      end do

   contains

      !> Put a block into the matrix.
      subroutine put(places_in, block)
         integer, intent(in) :: places_in(:)   !! (n) rows
         real(wp), intent(in) :: block(:, :)   !! (n, n) the block [any]

         matrix(places_in, places_in) = block
      end subroutine put

   end subroutine test_spatial_beam_matrix

   !> The matrix of bending in one plane for w_1, theta_1, w_2, theta_2, as the textbooks print it.
   pure function bending(rigidity, ratio, sign) result(k)
      real(wp), intent(in) :: rigidity   !! E I [N.m^2]
      real(wp), intent(in) :: ratio      !! area over shear area [1]
      real(wp), intent(in) :: sign       !! -1: a positive rotation lowers the far end [1]
      real(wp) :: k(4, 4)                !! (4, 4) matrix [any]

      real(wp) :: c, phi

      phi = 12.0_wp*rigidity*ratio/(g*area*l**2)
      c = rigidity/(l**3*(1.0_wp + phi))
      k(:, 1) = c*[12.0_wp, sign*6.0_wp*l, -12.0_wp, sign*6.0_wp*l]
      k(:, 2) = c*[sign*6.0_wp*l, (4.0_wp + phi)*l**2, -sign*6.0_wp*l, (2.0_wp - phi)*l**2]
      k(:, 3) = c*[-12.0_wp, -sign*6.0_wp*l, 12.0_wp, -sign*6.0_wp*l]
      k(:, 4) = c*[sign*6.0_wp*l, (2.0_wp - phi)*l**2, -sign*6.0_wp*l, (4.0_wp + phi)*l**2]
   end function bending

   !> The matrix of 6 x 6 of a beam in the plane.
   subroutine test_planar_beam_matrix(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: found(6, 6), matrix(6, 6)
      integer :: c

      call chain_matrix(2, 0, l, [e*area, e*i_z, a_y, g, area], found)
      matrix = 0.0_wp
      matrix([1, 4], [1, 4]) = e*area/l*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      matrix([2, 3, 5, 6], [2, 3, 5, 6]) = bending(e*i_z, a_y, 1.0_wp)
      do c = 1, 6
         call check_close(error, found(:, c), matrix(:, c), 1.0e-9_wp, "column of the matrix")
      end do
   end subroutine test_planar_beam_matrix

   !> Stiffness matrix of a straight chain of planar beams along x by differences of the loads.
   subroutine chain_matrix(n, first, length, of, matrix)
      integer, intent(in) :: n                      !! bodies
      integer, intent(in) :: first                  !! 1: a beam from the ground to the first body too; 0: not
      real(wp), intent(in) :: length                !! of each beam [m]
      real(wp), intent(in) :: of(5)                 !! (5) E A, E I, ratio of areas, G, A [N, N.m^2, 1, Pa, m^2]
      real(wp), intent(out) :: matrix(3*n, 3*n)     !! (3 n, 3 n) the matrix [any]

      real(wp), parameter :: step = 1.0e-4_wp
      class(force_set_t), allocatable :: set
      type(item_t) :: items(n - 1 + first)
      type(kind_info_t) :: info
      type(loads_t) :: loads
      type(motion_t) :: motion
      type(points_t) :: points
      real(wp) :: f(3*n, 4), power, q(3, n), start(3, n)
      integer :: b, c, k, row

      call find_set("force.beam", .false., set, info)
      points%n = n + 1
      points%body = [(k, k=0, n)]
      allocate (points%s(3, n + 1), source=0.0_wp)
      start = 0.0_wp
      start(1, :) = [(length*(k - 1 + first), k=1, n)]
      do k = 1, size(items)
         call make_item(info, [character(16) :: "modulus", "area", "second_moment", "shear_ratio", "shear_modulus"], &
                        [of(1)/of(5), of(5), of(2)*of(5)/of(1), of(3), of(4)], items(k))
         items(k)%values(1)%index = k + 1 - first
         items(k)%values(2)%index = k + 2 - first
      end do
      call new_motion(n, motion)
      call set_planar_motion(n, start, 0.0_wp*start, motion)
      call set%prepare(items, points)
      call set%set_start(motion)
      do c = 1, 3*n
         do k = 1, 4
            q = start
            b = 1 + (c - 1)/3
            q(c - 3*(b - 1), b) = q(c - 3*(b - 1), b) + places(k)*step
            call set_planar_motion(n, q, 0.0_wp*q, motion)
            call new_loads(n, loads)
            power = 0.0_wp
            call set%evaluate(0.0_wp, motion, loads, power)
            do b = 1, n
               f(3*b - 2:3*b, k) = [loads%force(1:2, b), loads%moment(3, b)]
            end do
         end do
         do row = 1, 3*n
            matrix(row, c) = -five_point(f(row, :), step)
         end do
      end do
   end subroutine chain_matrix

   !> The first five bending frequencies of a cantilever of n beams with lumped masses against Timoshenko's, which are those of
   !> Euler and Bernoulli for a slender one; the error falls by four where n doubles.
   subroutine test_frequencies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: slender(5) = [1.8751040687119611_wp, 4.6940911329741745_wp, 7.8547574382376126_wp, &
                                           10.995540734875467_wp, 14.137168391046471_wp]   ! cos b cosh b = -1
      real(wp), parameter :: radius(2) = [1.0e-4_wp, 0.04_wp]   ! of gyration, length 1 [m]
      real(wp) :: by_form(5), coarse(5), fine(5)
      integer :: k, m

      do m = 1, 2
         call form_frequencies(radius(m), by_form)
         if (m == 1) call check_close(error, by_form/slender**2, [(1.0_wp, k=1, 5)], 1.0e-5_wp, "Timoshenko's of a slender beam")
         call chain_frequencies(20, radius(m), coarse)
         call chain_frequencies(40, radius(m), fine)
         call check_true(error, maxval(abs(fine/by_form - 1.0_wp)) < 0.01_wp, "five frequencies of 40 beams within 1 %")
         do k = 1, 5
            call check_close(error, (coarse(k) - by_form(k))/(fine(k) - by_form(k)), 4.0_wp, 0.08_wp, "second order")
         end do
      end do
   end subroutine test_frequencies

   !> Frequencies of Timoshenko's cantilever, E I = rho A = L = 1: roots of Huang's equation (J. Appl. Mech. 28 (1961) 579-584).
   subroutine form_frequencies(radius, found)
      real(wp), intent(in) :: radius      !! of gyration [m]
      real(wp), intent(out) :: found(5)   !! (5) angular frequencies [rad/s]

      real(wp), parameter :: step = 0.05_wp
      real(wp) :: high, low, middle
      integer :: n

      n = 0
      high = 0.5_wp
      do while (n < 5)
         low = high
         high = low + step
         if (form(low)*form(high) > 0.0_wp) cycle
         n = n + 1
         found(n) = low
         middle = high
         do while (middle - found(n) > 1.0e-12_wp*middle)
            if (form(found(n))*form(0.5_wp*(found(n) + middle)) > 0.0_wp) then
               found(n) = 0.5_wp*(found(n) + middle)
            else
               middle = 0.5_wp*(found(n) + middle)
            end if
         end do
      end do

   contains

      !> The equation whose roots are frequencies.
      real(wp) function form(b) result(value)
         real(wp), intent(in) :: b   !! frequency [rad/s]

         real(wp) :: alpha, beta, r2, root, s2

         r2 = radius**2
         s2 = radius**2*e/g*a_y
         root = sqrt((r2 - s2)**2 + 4.0_wp/b**2)
         alpha = sqrt(0.5_wp*(root - r2 - s2))
         beta = sqrt(0.5_wp*(root + r2 + s2))
         value = 2.0_wp + (b**2*(r2 - s2)**2 + 2.0_wp)*cosh(b*alpha)*cos(b*beta) &
                 - b*(r2 + s2)/sqrt(1.0_wp - b**2*r2*s2)*sinh(b*alpha)*sin(b*beta)
      end function form

   end subroutine form_frequencies

   !> Frequencies of a cantilever of n beams, E I = rho A = L = 1, masses and inertias lumped at their ends.
   subroutine chain_frequencies(n, radius, found)
      integer, intent(in) :: n            !! beams
      real(wp), intent(in) :: radius      !! of gyration [m]
      real(wp), intent(out) :: found(5)   !! (5) angular frequencies of bending [rad/s]

      real(wp), allocatable :: k(:, :), mass(:, :), squares(:), whole(:, :), work(:)
      integer, allocatable :: across(:)
      real(wp) :: h
      integer :: b, info

      h = 1.0_wp/n
      allocate (whole(3*n, 3*n), mass(2*n, 2*n), squares(2*n), work(100*n))
      ! E I = 1 and A = 1: E = 1/r^2, G = E g/e
      call chain_matrix(n, 1, h, [1.0_wp/radius**2, 1.0_wp, a_y, g/e/radius**2, 1.0_wp], whole)
      across = pack([(b, b=1, 3*n)], [(modulo(b, 3) /= 1, b=1, 3*n)])
      k = whole(across, across)
      mass = 0.0_wp
      do b = 1, n
         mass(2*b - 1, 2*b - 1) = merge(0.5_wp*h, h, b == n)
         mass(2*b, 2*b) = radius**2*mass(2*b - 1, 2*b - 1)
      end do
      call dsygv(1, "N", "L", 2*n, k, 2*n, mass, 2*n, squares, work, size(work), info)
      if (info /= 0) error stop "test_frame_springs: no frequencies"
      found = sqrt(squares(1:5))
   end subroutine chain_frequencies

   !> A bushing turned far about one of its axes: its moment is stiffness times angle, and its energy that of the angle.
   subroutine test_large_rotation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(force_set_t), allocatable :: set
      type(loads_t) :: loads
      type(motion_t) :: motion
      real(wp), parameter :: angles(4) = [1.0e-7_wp, 0.4_wp, -2.5_wp, 3.14_wp], k(3) = [2.0_wp, 3.0_wp, 5.0_wp]
      real(wp) :: power, turn(3)
      integer :: axis, m

      call make_bushing(set, motion)
      do axis = 1, 3
         do m = 1, 4
            turn = 0.0_wp
            turn(axis) = angles(m)
            motion%rot(:, :, 2) = rotation_about(abs(turn), angles(m))
            call new_loads(2, loads)
            power = 0.0_wp
            call set%evaluate(0.0_wp, motion, loads, power)
            call check_close(error, loads%moment(:, 1), k(axis)*turn, 1.0e-14_wp, "moment on i")
            call check_close(error, loads%moment(:, 2), -k(axis)*turn, 1.0e-14_wp, "moment on j")
            call check_close(error, set%elastic_energy(motion), 0.5_wp*k(axis)*angles(m)**2, 1.0e-14_wp, "energy")
         end do
      end do
   end subroutine test_large_rotation

   !> A bushing in the origin between bodies 1 and 2, angular stiffnesses 2, 3 and 5 N.m/rad.
   subroutine make_bushing(set, motion)
      class(force_set_t), allocatable, intent(out) :: set   !! the bushing
      type(motion_t), intent(out) :: motion                 !! the bodies, not turned

      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(points_t) :: points
      real(wp) :: own(3, 3, 0:2)
      integer :: c

      call find_set("force.bushing", .true., set, info)
      call make_item(info, [character(20) :: "angular_stiffness_x", "angular_stiffness_y", "angular_stiffness_z"], &
                     [2.0_wp, 3.0_wp, 5.0_wp], items(1))
      c = column_number(info, "axis_i")
      items(1)%values(c)%table = reshape([0.0_wp, 0.0_wp, 1.0_wp], [3, 1])
      points%n = 2
      points%body = [1, 2]
      allocate (points%s(3, 2), source=0.0_wp)
      own = 0.0_wp
      do c = 1, 3
         own(c, c, :) = 1.0_wp
      end do
      call new_motion(2, motion, own)
      call set%prepare(items, points)
      call set%set_start(motion)
   end subroutine make_bushing

   !> A way through half a turn is noticed; one to there and back is not lost, and stores nothing at its end.
   subroutine test_half_a_turn(error)
      use spatial_frame_spring, only: frame_spring_t
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(force_set_t), allocatable :: set
      type(motion_t) :: motion
      real(wp), parameter :: axis(3) = [1.0_wp, 2.0_wp, -1.0_wp]
      integer :: k

      call make_bushing(set, motion)
      do k = 0, 62
         motion%rot(:, :, 2) = rotation_about(axis, min(k, 62 - k)*0.1_wp)
         call set%follow(motion)
      end do
      call check_close(error, set%elastic_energy(motion), 0.0_wp, 1.0e-28_wp, "energy after the way back")
      select type (set)
      class is (frame_spring_t)
         call check_true(error, .not. set%is_lost(1), "not lost below half a turn")
         do k = 0, 40
            motion%rot(:, :, 2) = rotation_about(axis, k*0.1_wp)
            call set%follow(motion)
            call check_true(error, set%is_lost(1) .eqv. k*0.1_wp > pi, "lost beyond half a turn")
         end do
      end select
   end subroutine test_half_a_turn

end module test_frame_springs
