!> The rigid bodies of a scene, their body-fixed points and their materials.
!>
!> Body 0 is the ground: no mass, no motion, its frame is the world frame. A planar body has its
!> centre of mass in the plane z = 0 and turns about z. Tables of bodies and points in space: `spatial_bodies`.
module bodies
   use item, only: item_t
   use kind_info, only: add_channel, add_number, add_reference, dim_angle, dim_angular_speed, dim_density, dim_inertia, &
      dim_length, dim_mass, dim_none, dim_pressure, dim_speed, in_plane, kind_info_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: bodies_info, bodies_t, material_info, material_t, points_info, points_t
   public :: of_acceleration, of_angle, of_angular_acceleration, of_angular_velocity, of_position, of_velocity
   public :: new_bodies, new_materials, new_points, spatial_part_t, take_bodies

   ! channels
   integer, parameter :: of_position = 1              !! of the centre of mass
   integer, parameter :: of_velocity = 2              !! of the centre of mass
   integer, parameter :: of_acceleration = 3          !! of the centre of mass
   integer, parameter :: of_angle = 4                 !! of rotation
   integer, parameter :: of_angular_velocity = 5      !! its rate
   integer, parameter :: of_angular_acceleration = 6  !! and the rate of that

   !> What only bodies of a spatial scene have. There the frame of a body is that of its principal axes inside the program; decks
   !> and files show its own.
   type :: spatial_part_t
      real(wp), allocatable :: moments(:, :)     !! (3, n) principal moments of inertia [kg.m^2]
      real(wp), allocatable :: own(:, :, :)      !! (3, 3, 0:n) frame of principal axes to the body's own frame [1]
      real(wp), allocatable :: p(:, :)           !! (4, n) Euler parameters of the principal axes at the start [1]
      real(wp), allocatable :: w(:, :)           !! (3, n) angular velocity at the start, world frame [rad/s]
   end type spatial_part_t

   !> Rigid bodies in deck order.
   type :: bodies_t
      integer :: n = 0                            !! number of bodies, without the ground
      type(text_t), allocatable :: names(:)       !! (n) names
      real(wp), allocatable :: mass(:)            !! (n) mass [kg]
      real(wp), allocatable :: inertia(:)         !! (n) moment of inertia about z, centre of mass; in space the maximum [kg.m^2]
      real(wp), allocatable :: r(:, :)            !! (3, n) centre of mass at the start, world frame [m]
      real(wp), allocatable :: angle(:)           !! (n) angle about z at the start; in space zero [rad]
      real(wp), allocatable :: v(:, :)            !! (3, n) velocity of the centre of mass at the start, world frame [m/s]
      real(wp), allocatable :: omega(:)           !! (n) angular velocity about z at the start; in space zero [rad/s]
      logical, allocatable :: is_rate_given(:, :) !! (n_v, n) whether the deck gives each rate, or it is a default
      type(spatial_part_t) :: spatial             !! of a spatial scene, else empty
   end type bodies_t

   !> Body-fixed points.
   type :: points_t
      integer :: n = 0                        !! number of points
      type(text_t), allocatable :: names(:)   !! (n) names
      integer, allocatable :: body(:)         !! (n) body of each point, 0: ground
      real(wp), allocatable :: s(:, :)        !! (3, n) position in the body's frame, from its centre of mass [m]
   end type points_t

   !> Elastic materials.
   type :: material_t
      type(text_t) :: name                !! name
      real(wp) :: young = 0.0_wp          !! modulus of elasticity [Pa]
      real(wp) :: poisson = 0.0_wp        !! ratio of Poisson [1]
      real(wp) :: density = 0.0_wp        !! density, 0 if unknown [kg/m^3]
      real(wp) :: strength = 0.0_wp       !! maximum pressure that a surface bears, 0 if unknown [Pa]
   end type material_t

contains

   !> The deck table of bodies.
   function bodies_info() result(info)
      type(kind_info_t) :: info  !! columns and channels

      info%name = "bodies"
      info%space = in_plane
      info%help = "rigid bodies; the ground needs no row"
      info%source = "Flores et al. (2008), section 2.1"
      call add_number(info, "mass", dim_mass, "mass", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "inertia", dim_inertia, "moment of inertia about the centre of mass", &
                      lower=0.0_wp, open_lower=.true.)
      call add_number(info, "x", dim_length, "initial position of the centre of mass, world frame", default="0 m")
      call add_number(info, "y", dim_length, "initial position of the centre of mass, world frame", default="0 m")
      call add_number(info, "angle", dim_angle, "initial angle, counter-clockwise", default="0 rad")
      call add_number(info, "vx", dim_speed, "initial velocity of the centre of mass; made consistent; default: undetermined", &
                      default="0 m/s", is_free=.true.)
      call add_number(info, "vy", dim_speed, "initial velocity of the centre of mass; made consistent; default: undetermined", &
                      default="0 m/s", is_free=.true.)
      call add_number(info, "omega", dim_angular_speed, "initial angular velocity; made consistent; default: undetermined", &
                      default="0 rad/s", is_free=.true.)
      call add_channel(info, "position", "m", "world", 2, "position of the centre of mass", of_position)
      call add_channel(info, "velocity", "m/s", "world", 2, "velocity of the centre of mass", of_velocity)
      call add_channel(info, "acceleration", "m/s^2", "world", 2, "acceleration of the centre of mass", of_acceleration)
      call add_channel(info, "angle", "rad", "world", 1, "rotation angle, counter-clockwise, accumulated over revolutions", &
         of_angle)
      call add_channel(info, "angular_velocity", "rad/s", "world", 1, "angular velocity", of_angular_velocity)
      call add_channel(info, "angular_acceleration", "rad/s^2", "world", 1, "angular acceleration", of_angular_acceleration)
   end function bodies_info

   !> The deck table of points.
   function points_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "points"
      info%space = in_plane
      info%help = "points fixed in a body, relative to its centre of mass along its axes (ground: world axes)"
      info%source = "Flores et al. (2008), eq. (2.1)"
      call add_reference(info, "body", "bodies", "the body, or ground")
      call add_number(info, "xi", dim_length, "first coordinate in the body's frame", default="0 m")
      call add_number(info, "eta", dim_length, "second coordinate in the body's frame", default="0 m")
   end function points_info

   !> The deck table of materials.
   function material_info() result(info)
      type(kind_info_t) :: info  !! columns

      info%name = "material"
      info%help = "elastic materials of contact surfaces"
      info%source = "Flores et al. (2008), eq. (3.4)"
      call add_number(info, "young", dim_pressure, "Young's modulus", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "poisson", dim_none, "Poisson's ratio", lower=-1.0_wp, upper=0.5_wp, open_lower=.true.)
      call add_number(info, "density", dim_density, "density, for the validity check of quasi-static contact; 0: no check", &
                      default="0 kg/m^3", lower=0.0_wp)
      call add_number(info, "strength", dim_pressure, "maximum contact pressure of the surface (1.6 times the yield " &
                      //"strength for balls, 1.8 for cylinders); 0: no check", default="0 Pa", lower=0.0_wp)
   end function material_info

   !> Bodies from their rows.
   subroutine new_bodies(items, bodies)
      type(item_t), intent(in) :: items(:)       !! rows of the table
      type(bodies_t), intent(out) :: bodies      !! the bodies

      integer :: k, n

      n = size(items)
      bodies%n = n
      allocate (bodies%names(n), bodies%mass(n), bodies%inertia(n), bodies%angle(n), bodies%omega(n))
      allocate (bodies%r(3, n), bodies%v(3, n), source=0.0_wp)
      allocate (bodies%is_rate_given(3, n), source=.false.)
      do k = 1, n
         bodies%names(k)%s = items(k)%name
         bodies%mass(k) = items(k)%number("mass")
         bodies%inertia(k) = items(k)%number("inertia")
         bodies%r(1, k) = items(k)%number("x")
         bodies%r(2, k) = items(k)%number("y")
         bodies%angle(k) = items(k)%number("angle")
         bodies%v(1, k) = items(k)%number("vx")
         bodies%v(2, k) = items(k)%number("vy")
         bodies%omega(k) = items(k)%number("omega")
         bodies%is_rate_given(:, k) = [items(k)%is_given("vx"), items(k)%is_given("vy"), items(k)%is_given("omega")]
      end do
   end subroutine new_bodies

   !> Some of the bodies.
   pure subroutine take_bodies(all, chosen, some)
      type(bodies_t), intent(in) :: all      !! bodies
      integer, intent(in) :: chosen(:)       !! (any) numbers of those to be taken
      type(bodies_t), intent(out) :: some    !! these, in the order of the numbers

      some%n = size(chosen)
      some%names = all%names(chosen)
      some%mass = all%mass(chosen)
      some%inertia = all%inertia(chosen)
      some%r = all%r(:, chosen)
      some%angle = all%angle(chosen)
      some%v = all%v(:, chosen)
      some%omega = all%omega(chosen)
      some%is_rate_given = all%is_rate_given(:, chosen)
      if (.not. allocated(all%spatial%p)) return
      some%spatial%moments = all%spatial%moments(:, chosen)
      allocate (some%spatial%own(3, 3, 0:some%n))
      some%spatial%own(:, :, 0) = all%spatial%own(:, :, 0)
      some%spatial%own(:, :, 1:) = all%spatial%own(:, :, chosen)
      some%spatial%p = all%spatial%p(:, chosen)
      some%spatial%w = all%spatial%w(:, chosen)
   end subroutine take_bodies

   !> Points from their rows, whose bodies have been resolved.
   subroutine new_points(items, points)
      type(item_t), intent(in) :: items(:)       !! rows of the table
      type(points_t), intent(out) :: points      !! the points

      integer :: k, n

      n = size(items)
      points%n = n
      allocate (points%names(n), points%body(n))
      allocate (points%s(3, n), source=0.0_wp)
      do k = 1, n
         points%names(k)%s = items(k)%name
         points%body(k) = items(k)%reference("body")
         points%s(1, k) = items(k)%number("xi")
         points%s(2, k) = items(k)%number("eta")
      end do
   end subroutine new_points

   !> Materials from their rows.
   subroutine new_materials(items, materials)
      type(item_t), intent(in) :: items(:)                       !! rows of the table
      type(material_t), allocatable, intent(out) :: materials(:) !! (rows) the materials

      integer :: k

      allocate (materials(size(items)))
      do k = 1, size(items)
         materials(k)%name%s = items(k)%name
         materials(k)%young = items(k)%number("young")
         materials(k)%poisson = items(k)%number("poisson")
         materials(k)%density = items(k)%number("density")
         materials(k)%strength = items(k)%number("strength")
      end do
   end subroutine new_materials

end module bodies
