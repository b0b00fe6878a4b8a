!> Identities of every force element that spatial scenes know: a kind is tested by being registered.
module test_spatial_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: points_t
   use check, only: check_close, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: is_of_space, kind_info_t
   use kinds, only: not_a_number, wp
   use motion, only: cross, loads_t, motion_t, new_loads, new_motion
   use read_channel, only: channel_code
   use rotations, only: rate_of_parameters, rotation_of_parameters
   use spatial_coordinates, only: new_spatial_coordinates, spatial_coordinates_t
   implicit none (type, external)
   private
   public :: run_test_spatial_forces

   integer, parameter :: n_item = 3         !! items of each kind
   integer, parameter :: n_body = 3         !! moving bodies
   real(wp), parameter :: now = 0.37_wp     !! time [s]
   real(wp), parameter :: tick = 3.0e-4_wp  !! of differences [s]

   !> A kind with generic items and motion.
   type :: bench_t
      class(force_set_t), allocatable :: set       !! its items
      type(kind_info_t) :: info                    !! the kind
      type(motion_t) :: motion                     !! of the bodies
      type(spatial_coordinates_t) :: coordinates   !! of space
      real(wp) :: q(7, n_body) = 0.0_wp            !! (7, bodies) coordinates [m and 1]
      real(wp) :: v(6, n_body) = 0.0_wp            !! (6, bodies) rates [m/s and rad/s]
      type(loads_t) :: loads                       !! on the bodies
      real(wp) :: power = 0.0_wp                   !! power reported [W]
   end type bench_t

contains

   subroutine run_test_spatial_forces(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("power", test_power)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("channels", test_channels)
   end subroutine run_test_spatial_forces

   !> Items of a kind on bodies that lie and move anyhow, evaluated; .false. of kinds of the plane.
   logical function make_bench(kind, bench) result(is_known)
      integer, intent(in) :: kind            !! number of the kind
      type(bench_t), intent(out) :: bench    !! the kind

      type(item_t) :: items(n_item)
      type(points_t) :: points
      type(random_t) :: random
      real(wp) :: own(3, 3, 0:n_body)
      integer :: c, k

      call new_force_set(kind, bench%set)
      bench%info = bench%set%info()
      is_known = is_of_space(bench%info, .true.)
      if (.not. is_known) return
      random%state = seed_of(bench%info%name, 7)
      bench%coordinates = new_spatial_coordinates()
      points%n = n_body
      points%body = [(k, k=1, n_body)]
      allocate (points%s(3, n_body))
      own(:, :, 0) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      do k = 1, n_body
         points%s(:, k) = random%vector(3, -1.0_wp, 1.0_wp)
         own(:, :, k) = rotation_of_parameters(random%vector(4, -1.0_wp, 1.0_wp))
         bench%q(:3, k) = random%vector(3, -2.0_wp, 2.0_wp)
         bench%q(4:, k) = random%vector(4, -1.0_wp, 1.0_wp)
         bench%q(4:, k) = bench%q(4:, k)/norm2(bench%q(4:, k))
         bench%v(:, k) = random%vector(6, -2.0_wp, 2.0_wp)
      end do
      do k = 1, n_item
         call fill_item(bench%info, k, random, items(k))
         c = column_number(bench%info, "j")
         if (c > 0) items(k)%values(c)%index = modulo(k, n_item) + 1
      end do
      call bench%set%prepare(items, points)
      call new_motion(n_body, bench%motion, own)
      call move(bench, 0.0_wp)
      call bench%set%set_start(bench%motion)
      call new_loads(n_body, bench%loads)
      call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
   end function make_bench

   !> Bodies after a time at their present velocities.
   subroutine move(bench, dt)
      type(bench_t), intent(inout) :: bench  !! the kind
      real(wp), intent(in) :: dt             !! the time [s]

      real(wp) :: q(7, n_body)
      integer :: k

      do k = 1, n_body
         q(:3, k) = bench%q(:3, k) + dt*bench%v(:3, k)
         q(4:, k) = bench%q(4:, k) + dt*rate_of_parameters(bench%q(4:, k), bench%v(4:, k))
      end do
      call bench%coordinates%move(n_body, [(k, k=1, n_body)], q, bench%v, bench%motion)
   end subroutine move

   !> What a kind reports the ledger, and the power of its channel, are the power of its loads.
   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: given, lost, power(1, n_item), stored(4)
      integer :: k, kind, n

      n = 0
      do kind = 1, n_force_kinds()
         if (.not. make_bench(kind, bench)) cycle
         n = n + 1
         given = 0.0_wp
         do k = 1, n_body
            given = given + dot_product(bench%loads%force(:, k), bench%motion%v(:, k)) &
                    + dot_product(bench%loads%moment(:, k), bench%motion%omega(:, k))
         end do
         call check_true(error, abs(given) > 0.01_wp, bench%info%name//": there is a power")
         lost = bench%set%lost_power(bench%motion)
         power = 0.0_wp
         call bench%set%report(channel_code(bench%info, "power"), now, bench%motion, power)
         call check_close(error, sum(power), given, 1.0e-12_wp, bench%info%name//": power reported")
         do k = 1, 4
            call move(bench, places(k)*tick)
            stored(k) = bench%set%elastic_energy(bench%motion)
         end do
         call check_close(error, bench%power - lost - five_point(stored, tick), given, 1.0e-7_wp, &
                          bench%info%name//": power of the loads")
      end do
      call check_true(error, n >= 4, "kinds of space")
   end subroutine test_power

   !> What acts between bodies adds up to nothing: forces, and moments about one point.
   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: moment(3)
      integer :: k, kind

      do kind = 1, n_force_kinds()
         if (.not. make_bench(kind, bench)) cycle
         if (column_number(bench%info, "j") == 0) cycle
         call check_close(error, sum(bench%loads%force, 2), [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-13_wp, bench%info%name//": forces")
         moment = 0.0_wp
         do k = 1, n_body
            moment = moment + bench%loads%moment(:, k) + cross(bench%motion%r(:, k), bench%loads%force(:, k))
         end do
         call check_close(error, moment, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp, bench%info%name//": moments")
         call check_true(error, sum(abs(bench%loads%moment)) > 0.01_wp, bench%info%name//": there are loads")
      end do
   end subroutine test_action_and_reaction

   !> Every channel that a kind announces is filled.
   subroutine test_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: values(:, :)
      integer :: c, kind

      do kind = 1, n_force_kinds()
         if (.not. make_bench(kind, bench)) cycle
         do c = 1, size(bench%info%channels)
            associate (channel => bench%info%channels(c))
               allocate (values(merge(3, 1, channel%components == 2), n_item), source=not_a_number())
               call bench%set%report(channel%code, now, bench%motion, values)
               call check_true(error, all(ieee_is_finite(values)), bench%info%name//": channel "//channel%name)
               deallocate (values)
            end associate
         end do
      end do
   end subroutine test_channels

end module test_spatial_forces
