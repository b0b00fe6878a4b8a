!> Bodies and points of a spatial scene, as its deck gives them.
!>
!> The tensor of inertia about the centre of mass, in the body's own axes,
!>
!> J = [ ixx -ixy -ixz; -ixy iyy -iyz; -ixz -iyz izz ],   ixy = integral of x y dm, ...
!>
!> is turned to its principal axes: inside the program they are the body's frame, in which masses are diagonal. What the deck gives
!> in the body's own frame (points, axes of joints) is turned into it.
!>
!> Orientation at the start, one of: Euler parameters e0 to e3; a turn `angle` about `axis`; three turns of a `sequence`, each about
!> an axis of the frame that the ones before it have made; the directions `xi_axis` and `eta_axis` of the body's first two axes,
!> where the second needs only lie on the right side of the first.
!>
!> Source: Flores et al. (2008), section 6.2. Limits: a tensor that no body can have, and an orientation given twice or by half,
!> are errors.
module spatial_bodies
   use bodies, only: bodies_t, of_acceleration, of_angular_acceleration, of_angular_velocity, of_position, of_velocity, points_t
   use item, only: item_t
   use kind_info, only: add_channel, add_direction, add_number, add_reference, add_word, dim_angle, dim_angular_speed, &
      dim_inertia, dim_length, dim_mass, dim_none, dim_speed, in_space, kind_info_t
   use kinds, only: wp
   use rotations, only: euler_parameters_of, principal_axes, product_of, rotation_about, rotation_of_axes, &
      rotation_of_parameters, rotation_of_sequence
   implicit none (type, external)
   private
   public :: of_orientation, of_spin
   public :: mistake_of_body, new_spatial_bodies, new_spatial_points, spatial_bodies_info, spatial_points_info

   ! channels beside those of the plane
   integer, parameter :: of_orientation = 7  !! Euler parameters
   integer, parameter :: of_spin = 8         !! angular velocity along the own axes

   character(*), parameter :: sequences = "none xyz xzy yxz yzx zxy zyx xyx xzx yxy yzy zxz zyz"
   character(*), parameter :: rates(6) = [character(2) :: "vx", "vy", "vz", "wx", "wy", "wz"]

contains

   !> The deck table of bodies in space.
   function spatial_bodies_info() result(info)
      type(kind_info_t) :: info  !! columns and channels

      character(*), parameter :: at_start = " of the initial velocity of the centre of mass; made consistent; default: undetermined"
      character(*), parameter :: turning = " of the initial angular velocity, world frame; made consistent; default: undetermined"
      integer :: k

      info%name = "bodies"
      info%space = in_space
      info%help = "rigid bodies; the ground needs no row"
      info%source = "Flores et al. (2008), section 6.2"
      call add_number(info, "mass", dim_mass, "mass", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "ixx", dim_inertia, "moment of inertia about the body's xi axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "iyy", dim_inertia, "moment of inertia about the body's eta axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "izz", dim_inertia, "moment of inertia about the body's zeta axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "ixy", dim_inertia, "product of inertia, integral of xi eta dm", default="0 kg.m^2")
      call add_number(info, "ixz", dim_inertia, "product of inertia, integral of xi zeta dm", default="0 kg.m^2")
      call add_number(info, "iyz", dim_inertia, "product of inertia, integral of eta zeta dm", default="0 kg.m^2")
      call add_number(info, "x", dim_length, "initial position of the centre of mass, world frame", default="0 m")
      call add_number(info, "y", dim_length, "initial position of the centre of mass, world frame", default="0 m")
      call add_number(info, "z", dim_length, "initial position of the centre of mass, world frame", default="0 m")
      do k = 0, 3
         call add_number(info, "e"//achar(iachar("0") + k), dim_none, "initial Euler parameter, world to body", &
                         default=merge("1", "0", k == 0), is_free=.true.)
      end do
      call add_direction(info, "axis", "rotation axis of the initial orientation", default="")
      call add_number(info, "angle", dim_angle, "rotation angle about `axis`", default="0 rad", is_free=.true.)
      call add_word(info, "sequence", "axes of three rotations to the initial orientation", default="none", choices=sequences)
      call add_number(info, "angle1", dim_angle, "first angle of the sequence", default="0 rad", is_free=.true.)
      call add_number(info, "angle2", dim_angle, "second angle of the sequence", default="0 rad", is_free=.true.)
      call add_number(info, "angle3", dim_angle, "third angle of the sequence", default="0 rad", is_free=.true.)
      call add_direction(info, "xi_axis", "initial direction of the xi axis, world frame", default="")
      call add_direction(info, "eta_axis", "approximate initial direction of the eta axis, world frame", default="")
      do k = 1, 3
         call add_number(info, rates(k), dim_speed, "velocity"//at_start, default="0 m/s", is_free=.true.)
      end do
      do k = 4, 6
         call add_number(info, rates(k), dim_angular_speed, "component"//turning, default="0 rad/s", is_free=.true.)
      end do
      call add_channel(info, "position", "m", "world", 2, "position of the centre of mass", of_position)
      call add_channel(info, "velocity", "m/s", "world", 2, "velocity of the centre of mass", of_velocity)
      call add_channel(info, "acceleration", "m/s^2", "world", 2, "acceleration of the centre of mass", &
                       of_acceleration)
      call add_channel(info, "orientation", "1", "world", 4, "Euler parameters of the body axes", of_orientation)
      call add_channel(info, "angular_velocity", "rad/s", "world", 2, "angular velocity", of_angular_velocity)
      call add_channel(info, "angular_acceleration", "rad/s^2", "world", 2, "angular acceleration", of_angular_acceleration)
      call add_channel(info, "spin", "rad/s", "body", 2, "angular velocity along the body axes", of_spin)
   end function spatial_bodies_info

   !> The deck table of points in space.
   function spatial_points_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "points"
      info%space = in_space
      info%help = "points fixed in a body, relative to its centre of mass along its axes (ground: world axes)"
      info%source = "Flores et al. (2008), eq. (6.1)"
      call add_reference(info, "body", "bodies", "the body, or ground")
      call add_number(info, "xi", dim_length, "first coordinate in the body's frame", default="0 m")
      call add_number(info, "eta", dim_length, "second coordinate in the body's frame", default="0 m")
      call add_number(info, "zeta", dim_length, "third coordinate in the body's frame", default="0 m")
   end function spatial_points_info

   !> What is wrong with a row of bodies; blank: nothing.
   function mistake_of_body(item) result(message)
      type(item_t), intent(in) :: item         !! the row
      character(:), allocatable :: message     !! what is wrong with it

      real(wp), parameter :: rounding = 1.0e-9_wp  ! of moments, that a flat body may miss the triangle inequality by [1]
      real(wp) :: axes(3, 3), moments(3), rotation(3, 3)

      message = ""
      call principal_axes(tensor_of(item), moments, axes)
      if (.not. minval(moments) > 0.0_wp) then
         message = "the inertia tensor of '"//item%name//"' is not positive definite: a principal moment is zero or negative"
      else if (2.0_wp*maxval(moments) > (1.0_wp + rounding)*sum(moments)) then
         message = "the inertia tensor of '"//item%name// &
                   "' is impossible: one principal moment exceeds the sum of the other two"
      else if (count(ways_given(item)) > 1) then
         message = "the orientation of '"//item%name//"' is given twice, by different columns"
      else if (item%is_given("angle") .and. .not. item%is_given("axis")) then
         message = "the rotation of '"//item%name//"' has an angle but no axis"
      else if (any([item%is_given("angle1"), item%is_given("angle2"), item%is_given("angle3")]) &
               .and. .not. item%is_given("sequence")) then
         message = "the rotations of '"//item%name//"' have no sequence"
      else if (item%is_given("xi_axis") .neqv. item%is_given("eta_axis")) then
         message = "the orientation of '"//item%name//"' needs both xi_axis and eta_axis"
      else
         rotation = start_rotation(item)
         if (.not. any(abs(rotation) > 0.0_wp)) then
            message = "the orientation of '"//item%name//"' is undefined: Euler parameters of zero length, or two parallel axes"
         end if
      end if
   end function mistake_of_body

   !> The ways in which the orientation of a row is given.
   function ways_given(item) result(given)
      type(item_t), intent(in) :: item   !! the row
      logical :: given(4)                !! Euler parameters, axis and angle, sequence, two axes

      given = [item%is_given("e0") .or. item%is_given("e1") .or. item%is_given("e2") .or. item%is_given("e3"), &
               item%is_given("axis"), item%is_given("sequence") .and. item%word("sequence") /= "none", &
               item%is_given("xi_axis") .or. item%is_given("eta_axis")]
   end function ways_given

   !> Tensor of inertia of a row.
   pure function tensor_of(item) result(tensor)
      type(item_t), intent(in) :: item   !! the row
      real(wp) :: tensor(3, 3)           !! (3, 3) body's own axes [kg.m^2]

      real(wp) :: xy, xz, yz

      xy = -item%number("ixy")
      xz = -item%number("ixz")
      yz = -item%number("iyz")
      tensor = reshape([item%number("ixx"), xy, xz, xy, item%number("iyy"), yz, xz, yz, item%number("izz")], [3, 3])
   end function tensor_of

   !> Orientation of a body at the start: its own axes to the world's. Zero where the row gives none.
   function start_rotation(item) result(a)
      type(item_t), intent(in) :: item   !! the row
      real(wp) :: a(3, 3)                !! (3, 3) rotation [1]

      real(wp) :: p(4)

      select case (findloc(ways_given(item), .true., dim=1))
      case (2)
         a = rotation_about(item%direction("axis"), item%number("angle"))
      case (3)
         a = rotation_of_sequence(item%word("sequence"), [item%number("angle1"), item%number("angle2"), item%number("angle3")])
      case (4)
         a = rotation_of_axes(item%direction("xi_axis"), item%direction("eta_axis"))
      case default
         p = [item%number("e0"), item%number("e1"), item%number("e2"), item%number("e3")]
         a = 0.0_wp
         if (norm2(p) > 0.0_wp) a = rotation_of_parameters(p)
      end select
   end function start_rotation

   !> Bodies from their rows, of which `mistake_of_body` finds nothing wrong.
   subroutine new_spatial_bodies(items, bodies)
      type(item_t), intent(in) :: items(:)       !! rows of the table
      type(bodies_t), intent(out) :: bodies      !! the bodies

      integer :: i, k, n

      n = size(items)
      bodies%n = n
      allocate (bodies%names(n), bodies%mass(n), bodies%inertia(n))
      allocate (bodies%angle(n), bodies%omega(n), bodies%r(3, n), bodies%v(3, n), source=0.0_wp)
      allocate (bodies%is_rate_given(6, n), source=.false.)
      associate (part => bodies%spatial)
         allocate (part%moments(3, n), part%own(3, 3, 0:n), part%p(4, n), part%w(3, n), source=0.0_wp)
         part%own(:, :, 0) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
         do k = 1, n
            associate (item => items(k))
               bodies%names(k)%s = item%name
               bodies%mass(k) = item%number("mass")
               call principal_axes(tensor_of(item), part%moments(:, k), part%own(:, :, k))
               bodies%inertia(k) = maxval(part%moments(:, k))
               bodies%r(:, k) = [item%number("x"), item%number("y"), item%number("z")]
               bodies%v(:, k) = [(item%number(rates(i)), i=1, 3)]
               part%w(:, k) = [(item%number(rates(i)), i=4, 6)]
               part%p(:, k) = euler_parameters_of(matmul(start_rotation(item), part%own(:, :, k)))
               if (is_turned_round(item, part%p(:, k), part%own(:, :, k))) part%p(:, k) = -part%p(:, k)
               bodies%is_rate_given(:3, k) = [(item%is_given(rates(i)), i=1, 3)]
               bodies%is_rate_given(4:, k) = any([(item%is_given(rates(i)), i=4, 6)])
            end associate
         end do
      end associate
   end subroutine new_spatial_bodies

   !> Whether Euler parameters of the principal axes, of either sign, give the own axes others than the row has: those that it
   !> gives, or else e0, or the first that is not zero, positive.
   logical function is_turned_round(item, p, own)
      type(item_t), intent(in) :: item      !! the row
      real(wp), intent(in) :: p(4)          !! (4) of the principal axes [1]
      real(wp), intent(in) :: own(3, 3)     !! (3, 3) principal axes to the body's own [1]

      real(wp), parameter :: none = 1.0e-9_wp   ! a parameter that is round-off [1]
      real(wp) :: given(4), inner(4), outer(4)
      logical :: ways(4)

      inner = euler_parameters_of(own)
      outer = product_of(p, [inner(1), -inner(2:4)])
      given = [item%number("e0"), item%number("e1"), item%number("e2"), item%number("e3")]
      ways = ways_given(item)
      if (.not. ways(1)) then
         given = 0.0_wp
         given(findloc(abs(outer) > none, .true., dim=1)) = 1.0_wp
      end if
      is_turned_round = dot_product(outer, given) < 0.0_wp
   end function is_turned_round

   !> Points from their rows, whose bodies have been resolved; in the frames of principal axes.
   subroutine new_spatial_points(items, own, points)
      type(item_t), intent(in) :: items(:)        !! rows of the table
      real(wp), intent(in) :: own(:, :, 0:)       !! (3, 3, 0:bodies) frames of principal axes to the bodies' own [1]
      type(points_t), intent(out) :: points       !! the points

      integer :: k, n

      n = size(items)
      points%n = n
      allocate (points%names(n), points%body(n), points%s(3, n))
      do k = 1, n
         associate (item => items(k))
            points%names(k)%s = item%name
            points%body(k) = item%reference("body")
            points%s(:, k) = matmul([item%number("xi"), item%number("eta"), item%number("zeta")], own(:, :, points%body(k)))
         end associate
      end do
   end subroutine new_spatial_points

end module spatial_bodies
