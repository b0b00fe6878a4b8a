!> Identities of every joint with clearance in space, for all normal and friction laws that space knows: a geometry is tested by
!> being registered. Bodies lie, turn and accelerate anyhow, their principal axes are not their own, pins are tilted in their
!> bushings, and some reach beyond an end.
module test_spatial_clearances
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: material_t, points_t
   use check, only: check_close, check_true, suite_t
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t, loss_contact, loss_friction
   use contact_grip, only: tangent_t
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use friction_law, only: friction_law_t, memory_bristle, memory_none, memory_slip
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: dim_angle, dim_length, is_of_space, kind_info_t
   use kinds, only: not_a_number, wp
   use law_fixture, only: steel, tame
   use motion, only: cross, loads_t, motion_t, new_loads, new_motion
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: most_of_item, point_contact_t
   use point_contacts, only: named_channels, point_contacts_t
   use read_channel, only: read_loose
   use revolute_level, only: film_channels
   use rotations, only: rate_of_parameters, rotation_of_parameters, second_rate_of_parameters, turned_by
   use spatial_coordinates, only: new_spatial_coordinates, spatial_coordinates_t
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: run_test_spatial_clearances

   integer, parameter :: n_body = 2           !! bodies: of the bearing and of the journal
   integer, parameter :: n_end = 3            !! pins: in the bushing, beyond an end, in an endless one; stops: of three joints
   real(wp), parameter :: tick = 1.0e-7_wp    !! step of differences in time [s]

   !> A geometry with its laws, in contact.
   type :: bench_t
      class(clearance_set_t), allocatable :: set     !! one item
      type(kind_info_t) :: info                      !! the geometry
      type(motion_t) :: motion                       !! of the bodies
      type(spatial_coordinates_t) :: coordinates     !! of space
      real(wp) :: q(7, n_body) = 0.0_wp              !! (7, bodies) coordinates [m and 1]
      real(wp) :: v(6, n_body) = 0.0_wp              !! (6, bodies) rates [m/s and rad/s]
      real(wp) :: a(6, n_body) = 0.0_wp              !! (6, bodies) accelerations [m/s^2 and rad/s^2]
      logical :: fits = .false.                      !! whether the law fits the surfaces
      character(:), allocatable :: name              !! of the combination
   end type bench_t

   abstract interface
      !> What is claimed of one combination.
      subroutine claim(error, bench)
         import :: bench_t, error_t
         implicit none (type, external)
         type(error_t), allocatable, intent(inout) :: error  !! what failed
         type(bench_t), intent(inout) :: bench               !! the combination
      end subroutine claim
   end interface

contains

   subroutine run_test_spatial_clearances(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("penetration", test_penetration)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("power", test_power)
      call suite%test("force_rate", test_force_rate)
      call suite%test("channels", test_channels)
      call suite%test("sliding", test_sliding)
   end subroutine run_test_spatial_clearances

   !> Claim something of all combinations.
   subroutine claim_all(error, what)
      type(error_t), allocatable, intent(out) :: error  !! what failed
      procedure(claim) :: what                          !! the claim

      class(clearance_set_t), allocatable :: set
      type(bench_t) :: bench
      integer :: ends, friction, kind, law, n

      n = 0
      do kind = 1, n_clearance_kinds
         call new_clearance_set(kind, set)
         if (.not. is_of_space(set%info(), .true.)) cycle
         do law = 1, n_law_kinds
            do friction = 0, n_friction_kinds
               do ends = 1, n_end
                  call make_bench(kind, law, friction, ends, bench)
                  if (.not. bench%fits) cycle
                  call what(error, bench)
                  if (allocated(error)) return
                  n = n + 1
               end do
            end do
         end do
      end do
      call check_true(error, n >= 100, "combinations of space")
   end subroutine claim_all

   !> A geometry with a normal law and a friction law (0: none), in contact.
   subroutine make_bench(kind, law_kind, friction_kind, ends, bench)
      integer, intent(in) :: kind            !! number of the geometry
      integer, intent(in) :: law_kind        !! number of the normal law
      integer, intent(in) :: friction_kind   !! number of the friction law, 0: none
      integer, intent(in) :: ends            !! how the pin lies
      type(bench_t), intent(out) :: bench    !! the set, in contact

      class(friction_law_t), allocatable :: friction
      class(normal_law_t), allocatable :: law
      type(item_t) :: item(1), law_item
      type(kind_info_t) :: law_info
      type(material_t) :: materials(1)
      type(points_t) :: points
      type(random_t) :: random
      character(:), allocatable :: help, message
      real(wp) :: own(3, 3, 0:n_body), parameters(n_law_parameter)
      integer :: c, k

      call new_clearance_set(kind, bench%set)
      bench%info = bench%set%info()
      bench%coordinates = new_spatial_coordinates()
      call new_normal_law(law_kind, law)
      law_info = law%info()
      bench%name = bench%info%name//", "//law_info%name
      random%state = seed_of(bench%name, ends)
      call fill_item(law_info, 1, random, law_item)
      call tame(law_info, law_item, .true.)
      call set_number(law_info, "restitution", 0.7_wp, law_item)
      call law%prepare(law_item)
      if (friction_kind > 0) then
         call new_friction_law(friction_kind, friction)
         law_info = friction%info()
         if (.not. is_of_space(law_info, .true.)) return
         bench%name = bench%name//", "//law_info%name
         call fill_item(law_info, 1, random, law_item)
         call set_number(law_info, "coefficient", 0.12_wp, law_item)
         call set_number(law_info, "v0", 1.0e-4_wp, law_item)
         call set_number(law_info, "v1", 1.0_wp, law_item)
         call friction%prepare(law_item)
      end if
      call fill_item(bench%info, 1, random, item(1))
      call set_number(bench%info, "bearing_radius", 10.0e-3_wp, item(1))
      call set_number(bench%info, "clearance", 0.5e-3_wp, item(1))
      call set_number(bench%info, "gap", 0.5e-3_wp, item(1))
      call set_number(bench%info, "width", 15.0e-3_wp, item(1))
      call set_number(bench%info, "height", 10.0e-3_wp, item(1))
      call set_number(bench%info, "face_radius", 15.0e-3_wp, item(1))
      call set_number(bench%info, "edge_radius", 1.0e-3_wp, item(1))
      call set_number(bench%info, "corner_radius", 1.0e-3_wp, item(1))
      call set_number(bench%info, "length", 20.0e-3_wp, item(1))
      call set_number(bench%info, "radius", 12.0e-3_wp, item(1))
      call set_number(bench%info, "radius_i", 10.0e-3_wp, item(1))
      call set_number(bench%info, "radius_j", 8.0e-3_wp, item(1))
      call set_number(bench%info, "guide_start", 0.0_wp, item(1))
      call set_number(bench%info, "guide_end", 0.0_wp, item(1))
      call set_limits(ends, item(1), bench)
      call set_number(bench%info, "journal_length", merge(30.0e-3_wp, 18.0e-3_wp, ends == 2), item(1))
      c = column_number(bench%info, "ends")
      if (c > 0) item(1)%values(c)%text = trim(merge("endless", "clipped", ends == 3))
      c = column_number(bench%info, "axis_j")
      if (c > 0) item(1)%values(c)%given = .false.
      if (c > 0) deallocate (item(1)%values(c)%table)
      points%n = 2
      points%body = [1, 2]
      allocate (points%s(3, 2))
      points%s(:, 1) = random%vector(3, -0.05_wp, 0.05_wp)
      points%s(:, 2) = random%vector(3, -0.05_wp, 0.05_wp)
      call bench%set%new(item, [1], [2], points, law, friction)
      materials(1) = steel()
      call bench%set%prepare(item)
      call bench%set%fit_law(item, materials, [1.0_wp, 1.0_wp], [.false., .false.])
      call bench%set%laws%normal%fit(bench%set%items%pairs(1), parameters, message, help)
      if (message /= "") return
      own(:, :, 0) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      do k = 1, n_body
         own(:, :, k) = rotation_of_parameters(random%vector(4, -1.0_wp, 1.0_wp))
         bench%q(:3, k) = random%vector(3, -0.1_wp, 0.1_wp)
         bench%q(4:, k) = random%vector(4, -1.0_wp, 1.0_wp)
         bench%q(4:, k) = bench%q(4:, k)/norm2(bench%q(4:, k))
         bench%v(:, k) = random%vector(6, -1.0_wp, 1.0_wp)*[1, 1, 1, 20, 20, 20]
         bench%a(:, k) = random%vector(6, -1.0_wp, 1.0_wp)*[100, 100, 100, 2000, 2000, 2000]
      end do
      call new_motion(n_body, bench%motion, own)
      call move(bench, 0.0_wp)
      if (column_number(bench%info, "joint") > 0) call take_joint(ends, bench)
      call bench%set%set_start(bench%motion)
      call bring_into_contact(random, bench)
   end subroutine make_bench

   !> Limits that the bodies are beyond as they stand: of an angle, where the joint turns, or of a way.
   subroutine set_limits(ends, item, bench)
      integer, intent(in) :: ends            !! 3: of a way
      type(item_t), intent(inout) :: item    !! the row
      type(bench_t), intent(in) :: bench     !! the geometry

      character(5), parameter :: limits(2) = [character(5) :: "lower", "upper"]
      integer :: c, k

      if (column_number(bench%info, "upper") == 0) return
      call set_number(bench%info, "lower", -0.3_wp, item)
      call set_number(bench%info, "upper", -1.0e-4_wp, item)
      call set_number(bench%info, "lever", 0.2_wp, item)
      do k = 1, 2
         c = column_number(bench%info, limits(k))
         item%values(c)%dimensions = merge(dim_length, dim_angle, ends == 3)
      end do
   end subroutine set_limits

   !> The joint that an item names, between the bench's bodies: one that turns, slides, or does both.
   subroutine take_joint(ends, bench)
      integer, intent(in) :: ends            !! which of the kinds that the geometry knows
      type(bench_t), intent(inout) :: bench  !! the bodies stand where the deck puts them

      class(joint_set_t), allocatable :: joint
      type(item_t) :: item(1)
      type(kind_info_t) :: info
      type(random_t) :: random
      type(text_t), allocatable :: kinds(:)
      integer :: c, kind

      kinds = split_blank(bench%info%columns(column_number(bench%info, "joint"))%refers_to)
      do kind = 1, n_joint_kinds
         call new_joint_set(kind, joint)
         info = joint%info()
         if (info%name == kinds(ends)%s .and. is_of_space(info, .true.)) exit
      end do
      random%state = seed_of(bench%name, ends)
      call fill_item(info, 1, random, item(1))
      c = column_number(info, "zero")
      if (c > 0) item(1)%values(c)%text = "start"
      c = column_number(info, "axis_j")
      item(1)%values(c)%given = .false.
      deallocate (item(1)%values(c)%table)
      call joint%new(item, bench%set%items%body, bench%set%items%s_i, bench%set%items%s_j)
      call joint%prepare(item, [0.0_wp, 0.0_wp, 0.0_wp])
      call joint%set_start(bench%motion)
      call bench%set%take_joint(1, joint)
   end subroutine take_joint

   !> Tilt the journal and shift it so that two of its contacts overlap, or its only one.
   subroutine bring_into_contact(random, bench)
      type(random_t), intent(inout) :: random   !! where numbers come from
      type(bench_t), intent(inout) :: bench     !! the set; contacts begin

      real(wp) :: delta(most_of_item), rate(most_of_item), shift(3), start(3)
      logical :: is_deep(most_of_item)
      integer :: k

      bench%q(4:, 2) = turned_by(bench%q(4:, 2), 2.0e-3_wp*random%vector(3, -1.0_wp, 1.0_wp))
      call move(bench, 0.0_wp)
      start = bench%q(:3, 2) - (arm(2) - arm(1))
      if (bench%info%name == "clearance.plane" .or. bench%info%name == "clearance.discs") start = start + reach()
      do k = 1, 1000
         shift = 0.8e-3_wp*random%vector(3, -1.0_wp, 1.0_wp)
         bench%q(:3, 2) = start + shift
         call move(bench, 0.0_wp)
         call bench%set%gaps(bench%motion, delta, rate)
         associate (n => bench%set%n_contact)
            is_deep(:n) = delta(:n) > 2.0e-5_wp
            if (count(is_deep(:n)) >= merge(1, min(n, 2), column_number(bench%info, "joint") > 0)) exit
         end associate
      end do
      bench%fits = k <= 1000
      if (.not. bench%fits) return
      if (maxval(pack(rate(:bench%set%n_contact), is_deep(:bench%set%n_contact))) < 0.0_wp) then
         bench%v = -bench%v  ! one at least approaches: damping could leave no force of any
         call move(bench, 0.0_wp)
      end if
      do k = 1, bench%set%n_contact
         if (.not. is_deep(k)) cycle
         call bench%set%begin_contact(k, 0.0_wp, 5.0_wp, 0.0_wp)
         call let_slip(bench, k)
      end do

   contains

      !> From where the points coincide to where a ball touches: along the normal of its only contact.
      function reach()
         real(wp) :: reach(3)   !! (3) world frame [m]

         type(point_contact_t) :: contact

         bench%q(:3, 2) = start + [1.0e-6_wp, 0.0_wp, 0.0_wp]
         call move(bench, 0.0_wp)
         select type (set => bench%set)
         class is (point_contacts_t)
            call set%measure(1, .false., bench%motion, contact)
         end select
         reach = -contact%delta*contact%normal
      end function reach

      !> Where the point of a body is.
      function arm(side)
         integer, intent(in) :: side   !! 1 bearing, 2 journal
         real(wp) :: arm(3)            !! (3) world frame [m]

         real(wp) :: s(3)

         s = bench%set%items%s_i(:, 1)
         if (side == 2) s = bench%set%items%s_j(:, 1)
         arm = bench%q(:3, side) + matmul(bench%motion%rot(:, :, side), s)
      end function arm

   end subroutine bring_into_contact

   !> A contact that could stick slips the way that it moves; bristles are half bent that way.
   subroutine let_slip(bench, k)
      type(bench_t), intent(inout) :: bench   !! the set
      integer, intent(in) :: k                !! its contact

      if (bench%set%grip%memory == memory_none) return
      call bench%set%lay(k, bench%motion)
      associate (grip => bench%set%grip, tangent => bench%set%grip%tangent(k))
         if (grip%memory == memory_slip) call bench%set%slip_toward(k, tangent%v)
         if (grip%memory == memory_bristle) then
            grip%z(:, k) = 0.5_wp*bench%set%laws%friction%bristle_scale()*matmul(tangent%t, tangent%v/norm2(tangent%v))
         end if
      end associate
   end subroutine let_slip

   !> Motion after a time.
   subroutine move(bench, dt)
      type(bench_t), intent(inout) :: bench  !! the set
      real(wp), intent(in) :: dt             !! time since now [s]

      real(wp) :: a(6, n_body), q(7, n_body), v(6, n_body)
      integer :: k

      v = bench%v + dt*bench%a
      a = bench%a
      do k = 1, n_body
         q(:3, k) = bench%q(:3, k) + dt*(bench%v(:3, k) + 0.5_wp*dt*bench%a(:3, k))
         q(4:, k) = bench%q(4:, k) + dt*(rate_of_parameters(bench%q(4:, k), bench%v(4:, k)) &
                                         + 0.5_wp*dt*second_rate_of_parameters(bench%q(4:, k), bench%v(4:, k), bench%a(4:, k)))
      end do
      call bench%coordinates%move(n_body, [(k, k=1, n_body)], q, v, bench%motion)
      call bench%coordinates%accelerate(n_body, [(k, k=1, n_body)], a, bench%motion)
   end subroutine move

   subroutine test_penetration(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, penetration)
   end subroutine test_penetration

   !> The rate of penetration against differences of penetration.
   subroutine penetration(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp) :: delta(most_of_item, 4), now(most_of_item), rate(most_of_item)
      integer :: k

      do k = 1, 4
         call move(bench, places(k)*tick)
         call bench%set%gaps(bench%motion, delta(:, k), rate)
      end do
      call move(bench, 0.0_wp)
      call bench%set%gaps(bench%motion, now, rate)
      do k = 1, bench%set%n_contact
         call check_close(error, rate(k), five_point(delta(k, :), tick), 1.0e-7_wp, bench%name//": rate of penetration")
      end do
   end subroutine penetration

   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, action_and_reaction)
   end subroutine test_action_and_reaction

   !> Forces add up to zero, and moments about one point.
   subroutine action_and_reaction(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: losses(2, most_of_item), moment(3), scale
      integer :: k

      call new_loads(n_body, loads)
      call bench%set%evaluate(bench%motion, loads, losses(:, :bench%set%n_contact))
      scale = sum(abs(loads%force))
      call check_true(error, scale > 100.0_wp, bench%name//": there are forces")
      if (allocated(error)) return
      call check_close(error, sum(loads%force, dim=2)/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": forces")
      moment = 0.0_wp
      do k = 1, n_body
         moment = moment + loads%moment(:, k) + cross(bench%motion%r(:, k), loads%force(:, k))
      end do
      call check_close(error, moment/scale, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": moments")
   end subroutine action_and_reaction

   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, power)
   end subroutine test_power

   !> Power of the loads: less the rate of the stored energy, by differences, less what damping and friction take. So the force does
   !> the work that it stores, beyond an end of the bushing too.
   subroutine power(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp) :: given, losses(2, most_of_item), scale, stored(4)
      integer :: k

      call new_loads(n_body, loads)
      call bench%set%evaluate(bench%motion, loads, losses(:, :bench%set%n_contact))
      given = 0.0_wp
      do k = 1, n_body
         given = given + dot_product(loads%force(:, k), bench%motion%v(:, k)) &
                 + dot_product(loads%moment(:, k), bench%motion%omega(:, k))
      end do
      do k = 1, 4
         call move(bench, places(k)*tick)
         stored(k) = bench%set%elastic_energy(bench%motion)
      end do
      call move(bench, 0.0_wp)
      scale = sum(abs(loads%force))  ! powers, at speeds of about 1 m/s
      call check_close(error, given/scale, (-five_point(stored, tick) - sum(losses(loss_contact, :bench%set%n_contact)) &
                                            - sum(losses(loss_friction, :bench%set%n_contact)))/scale, 1.0e-7_wp, &
                       bench%name//": power")
      if (bench%set%grip%memory == memory_bristle) return  ! which may give back what they have stored
      call check_true(error, all(losses(loss_friction, :bench%set%n_contact) >= 0.0_wp), bench%name//": friction takes")
   end subroutine power

   subroutine test_force_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, force_rate)
   end subroutine test_force_rate

   !> The rate of the normal force, second derivative of the penetration included, against differences of the force.
   subroutine force_rate(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      real(wp) :: delta, f(4), force, rate, slope
      integer :: c, k

      if (bench%set%laws%normal%jumps_at_turn) return
      do c = 1, bench%set%n_contact
         if (.not. bench%set%contact(c)%is_touching) cycle
         do k = 1, 4
            call move(bench, places(k)*tick)
            call bench%set%watch(c, bench%motion, delta, rate, f(k), slope)
         end do
         call move(bench, 0.0_wp)
         call bench%set%watch(c, bench%motion, delta, rate, force, slope)
         call check_close(error, slope/force, five_point(f, tick)/force, 1.0e-3_wp + 3.0e-7_wp*abs(slope/force), &
                          bench%name//": rate of the force")
      end do
   end subroutine force_rate

   subroutine test_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, channels)
   end subroutine test_channels

   !> Every channel that a geometry announces is filled, but those of films; the force on the journal is that of the loads.
   subroutine channels(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(loads_t) :: loads
      real(wp), allocatable :: values(:, :)
      real(wp) :: losses(2, most_of_item), scale
      logical :: is_of_contact
      integer :: c

      call new_loads(n_body, loads)
      call bench%set%evaluate(bench%motion, loads, losses(:, :bench%set%n_contact))
      scale = sum(abs(loads%force))
      do c = 1, size(bench%info%channels)
         associate (channel => bench%info%channels(c))
            if (index(film_channels//" p_v ", " "//channel%name//" ") > 0) cycle  ! p v is one of pins with a length
            is_of_contact = index(" penetration penetration_rate normal_force friction_force state contact_point"//named_channels, &
                                  " "//channel%name//" ") > 0
            allocate (values(merge(3, 1, channel%components == 2), merge(bench%set%n_contact, 1, is_of_contact)), &
                      source=not_a_number())
            call read_loose(bench%set, channel%name, bench%motion, values)
            call check_true(error, all(ieee_is_finite(values)), bench%name//": channel "//channel%name)
            if (channel%name == "force") then
               call check_close(error, values(:, 1)/scale, loads%force(:, 2)/scale, 1.0e-14_wp, bench%name//": force")
            end if
            deallocate (values)
         end associate
      end do
   end subroutine channels

   subroutine test_sliding(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, sliding)
   end subroutine test_sliding

   !> Rates of the sliding velocities along the tangents, by accelerations and drift, against differences; the tangents are at right
   !> angles to each other and to the normal, which turns as the tangent plane does.
   subroutine sliding(error, bench)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the combination

      type(tangent_t) :: later, tangent
      real(wp) :: a(3), n(3, 4), normal(3), v(2, 4)
      integer :: c, k

      if (bench%set%grip%memory == memory_none) return
      do c = 1, bench%set%n_contact
         call bench%set%lie(c, bench%motion, tangent)
         tangent%way = tangent%t(:, 1) + 0.3_wp*tangent%t(:, 2)
         call bench%set%lie(c, bench%motion, tangent)
         later = tangent
         do k = 1, 4
            call move(bench, places(k)*tick)
            call bench%set%lie(c, bench%motion, later)
            v(:, k) = later%v
            n(:, k) = cross(later%t(:, 1), later%t(:, 2))
         end do
         call move(bench, 0.0_wp)
         a = bench%motion%a(:, 2) + cross(bench%motion%alpha(:, 2), tangent%arm_j) - bench%motion%a(:, 1) &
             - cross(bench%motion%alpha(:, 1), tangent%arm_i)
         do k = 1, 2
            call check_close(error, dot_product(tangent%t(:, k), a) + tangent%drift(k), five_point(v(k, :), tick), &
                             1.0e-6_wp*(100.0_wp + abs(tangent%drift(k))), bench%name//": rate of sliding")
         end do
         normal = cross(tangent%t(:, 1), tangent%t(:, 2))
         call check_close(error, pack(matmul(transpose(tangent%t), tangent%t), .true.), [1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
                          1.0e-13_wp, bench%name//": tangents at right angles")
         call check_close(error, cross(tangent%spin, normal), [(five_point(n(k, :), tick), k=1, 3)], 1.0e-4_wp, &
                          bench%name//": turn of the tangent plane")
      end do
   end subroutine sliding

end module test_spatial_clearances
