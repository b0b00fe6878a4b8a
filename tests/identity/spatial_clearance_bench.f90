!> A joint with clearance in space with its laws, in contact: what their identities start from. Bodies lie, turn and accelerate
!> anyhow, their principal axes are not their own, pins are tilted in their bushings, and some reach beyond an end.
module spatial_clearance_bench
   use bodies, only: material_t, points_t
   use check, only: check_true
   use clearance_registry, only: n_clearance_kinds, new_clearance_set
   use clearance_set, only: clearance_set_t
   use contact_registry, only: n_friction_kinds, n_law_kinds, new_friction_law, new_normal_law
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use friction_law, only: friction_law_t, memory_bristle, memory_none, memory_slip
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: dim_angle, dim_length, is_of_space, kind_info_t
   use kinds, only: wp
   use law_fixture, only: steel, tame
   use motion, only: motion_t, new_motion
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: most_of_item, point_contact_t
   use point_contacts, only: point_contacts_t
   use rotations, only: rate_of_parameters, rotation_of_parameters, second_rate_of_parameters, turned_by
   use spatial_coordinates, only: new_spatial_coordinates, spatial_coordinates_t
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: bench_t, claim_all, move, n_body, tick

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

   !> Claim something of all combinations.
   subroutine claim_all(error, what)
      type(error_t), allocatable, intent(out) :: error  !! what failed
      procedure(claim) :: what                          !! the claim

      class(clearance_set_t), allocatable :: set
      type(bench_t) :: bench
      integer :: ends, friction, kind, law, n

      n = 0
      do kind = 1, n_clearance_kinds()
         call new_clearance_set(kind, set)
         if (.not. is_of_space(set%info(), .true.)) cycle
         do law = 1, n_law_kinds()
            do friction = 0, n_friction_kinds()
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
      call bench%set%take_surfaces(item, materials, [1.0_wp, 1.0_wp], [.false., .false.])
      call bench%set%prepare(item)
      call bench%set%fit(1)
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
      do kind = 1, n_joint_kinds()
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
      type(bench_t), intent(inout) :: bench     !! the set; contacts start

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

      if (bench%set%stick_slip%memory == memory_none) return
      call bench%set%lay(k, bench%motion)
      associate (stick_slip => bench%set%stick_slip, tangent => bench%set%stick_slip%tangent(k))
         if (stick_slip%memory == memory_slip) call bench%set%slip_toward(k, tangent%v)
         if (stick_slip%memory == memory_bristle) then
            stick_slip%z(:, k) = 0.5_wp*bench%set%laws%friction%bristle_scale()*matmul(tangent%t, tangent%v/norm2(tangent%v))
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

end module spatial_clearance_bench
