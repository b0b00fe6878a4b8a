!> A kind of joint or driver with generic geometry and motion, for identities that every kind fulfils.
module joint_bench
   use bodies, only: points_t
   use fixed_random, only: random_t, seed_of
   use friction_ambrosio, only: friction_ambrosio_t
   use friction_law, only: friction_slot_t
   use generic_item, only: fill_item
   use item, only: find_place, item_t
   use joint_friction, only: new_joint_friction
   use joint_registry, only: new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, new_motion
   use planar_coordinates, only: set_planar_motion
   use rows, only: n_v_planar, new_rows, rows_t
   use span, only: span_of
   use text, only: to_text
   implicit none (type, external)
   private
   public :: before, bench_t, evaluate_after, friction_laws, make_bench, n_body, n_item, n_seed, span_between, times_jacobian

   integer, parameter :: n_item = 3       !! joints: of two bodies, of ground and body, of body and ground
   integer, parameter :: n_body = 2       !! moving bodies
   integer, parameter :: n_seed = 4       !! geometries for each kind
   integer, parameter :: before = 2       !! rows of others before those of the kind
   real(wp), parameter :: now = 0.37_wp   !! time of all tests [s]
   real(wp), parameter :: far = 1.2_wp    !! minimum distance of the points of an item, so that directions are smooth [m]

   !> A kind with generic geometry and motion.
   type :: bench_t
      class(joint_set_t), allocatable :: set  !! its items
      type(rows_t) :: rows                    !! their rows, with others before and after
      type(motion_t) :: motion                !! of the bodies
      real(wp) :: q(3, n_body) = 0.0_wp       !! (3, bodies) coordinates [m, m, rad]
      real(wp) :: v(3, n_body) = 0.0_wp       !! (3, bodies) rates [m/s, m/s, rad/s]
      real(wp) :: a(3, n_body) = 0.0_wp       !! (3, bodies) any accelerations [m/s^2, m/s^2, rad/s^2]
      character(:), allocatable :: name       !! of the kind and the geometry
   end type bench_t

contains

   !> Items of a kind between ground and two bodies.
   subroutine make_bench(kind, seed, bench, unit_of_length)
      integer, intent(in) :: kind                          !! number of the kind
      integer, intent(in) :: seed                          !! number of the geometry
      type(bench_t), intent(out) :: bench                  !! the kind, not evaluated
      real(wp), intent(in), optional :: unit_of_length     !! scales the geometry [m]

      integer, parameter :: body_i(n_item) = [1, 0, 2], body_j(n_item) = [2, 1, 0]
      type(item_t) :: items(n_item)
      type(kind_info_t) :: info
      type(points_t) :: points
      type(random_t) :: random
      real(wp) :: angle(0:n_body), length
      integer :: k

      length = 1.0_wp
      if (present(unit_of_length)) length = unit_of_length
      call new_joint_set(kind, bench%set)
      info = bench%set%info()
      random%state = seed_of(info%name, seed)
      bench%name = info%name//" geometry "//to_text(seed)
      points%n = 2*n_item
      allocate (points%body(2*n_item), points%s(3, 2*n_item))
      points%s = 0.0_wp
      do k = 1, n_item
         points%body(2*k - 1:2*k) = [body_i(k), body_j(k)]
         points%s(1:2, 2*k - 1) = length*random%vector(2, -1.0_wp, 1.0_wp)
         points%s(1:2, 2*k) = length*random%vector(2, -1.0_wp, 1.0_wp)
         call fill_item(info, k, random, items(k), length)
         if (info%couples_joints) call take_angles(items(k))
      end do
      angle(0) = 0.0_wp
      angle(1:) = random%vector(n_body, -2.0_wp, 2.0_wp)
      call bench%set%new(items, reshape(points%body, [2, n_item]), points%s(:, 1::2), points%s(:, 2::2))
      call bench%set%prepare(items, angle)
      if (find_place(items(1), "friction") > 0) then
         call new_joint_friction(items, friction_laws(n_item), bench%set%friction_lengths(), n_v_planar, bench%set%friction)
      end if
      bench%set%first_row = before
      call new_rows(before + n_item*info%n_row + 1, bench%rows)
      call new_motion(n_body, bench%motion)
      if (info%couples_joints) call take_turns(bench, angle)
      call bench%set%declare_rows(bench%rows)
      do
         do k = 1, n_body
            bench%q(:, k) = random%vector(3, -2.0_wp, 2.0_wp)*[length, length, 1.0_wp]
         end do
         call set_planar_motion(n_body, bench%q, 0.0_wp*bench%q, bench%motion)
         if (all([(span_between(bench, k), k=1, n_item)] > far*length)) exit
      end do
      do k = 1, n_body
         bench%v(:, k) = random%vector(3, -2.0_wp, 2.0_wp)*[length, length, 1.0_wp]
         bench%a(:, k) = random%vector(3, -2.0_wp, 2.0_wp)*[length, length, 1.0_wp]
      end do
   end subroutine make_bench

   !> Couple the angles of the joints, and keep the sum of the given positions: so that the row does not depend on lengths.
   subroutine take_angles(item)
      type(item_t), intent(inout) :: item   !! a row

      character(1), parameter :: digit(3) = ["1", "2", "3"]
      integer :: e, place

      do e = 1, 3
         place = find_place(item, "of_"//digit(e))
         item%values(place)%text = "own"
      end do
      place = find_place(item, "offset")
      item%values(place)%given = .false.
   end subroutine take_angles

   !> Two revolute joints with the bodies of each item, for a kind that couples joints.
   subroutine take_turns(bench, angle)
      type(bench_t), intent(inout) :: bench     !! the kind, prepared
      real(wp), intent(in) :: angle(0:n_body)   !! (0:bodies) angles at the start [rad]

      class(joint_set_t), allocatable :: joint
      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: e, k

      call new_joint_set(1, joint)
      info = joint%info()
      do k = 1, n_item
         do e = 1, 2
            random%state = seed_of(bench%name, k)
            call fill_item(info, k, random, items(1))
            call new_joint_set(1, joint)
            call joint%new(items, bench%set%body(:, k:k), bench%set%s_i(:, k:k), bench%set%s_j(:, k:k))
            call joint%prepare(items, angle)
            call bench%set%take_joint(k, joint, bench%motion)
         end do
      end do
   end subroutine take_turns

   !> A law of friction for each item.
   function friction_laws(n) result(laws)
      integer, intent(in) :: n          !! number of items
      type(friction_slot_t) :: laws(n)  !! (n) the same law

      integer :: k

      do k = 1, n
         allocate (laws(k)%law, source=friction_ambrosio_t(coefficient=0.3_wp, v0=0.0_wp, v1=1.0e-3_wp))
      end do
   end function friction_laws

   !> Distance of the two points of an item.
   real(wp) function span_between(bench, item) result(length)
      type(bench_t), intent(in) :: bench  !! the kind
      integer, intent(in) :: item         !! the item

      real(wp) :: rate, u(3)

      call span_of(bench%motion, bench%set%body(:, item), bench%set%s_i(:, item), bench%set%s_j(:, item), u, length, rate)
   end function span_between

   !> Rows after a time with the bench's accelerations.
   subroutine evaluate_after(bench, dt)
      type(bench_t), intent(inout) :: bench  !! the kind
      real(wp), intent(in) :: dt             !! time since now [s]

      call set_planar_motion(n_body, bench%q + dt*(bench%v + 0.5_wp*dt*bench%a), bench%v + dt*bench%a, bench%motion)
      call bench%set%evaluate(now + dt, bench%motion, bench%rows)
   end subroutine evaluate_after

   !> Phi_q x for rates or accelerations x.
   pure function times_jacobian(rows, x) result(product)
      type(rows_t), intent(in) :: rows        !! rows
      real(wp), intent(in) :: x(3, n_body)    !! (3, bodies) rates [any]
      real(wp) :: product(rows%n)             !! (rows) Phi_q x [any]

      integer :: row, side

      product = 0.0_wp
      do row = 1, rows%n
         do side = 1, 2
            if (rows%body(side, row) == 0) cycle
            product(row) = product(row) + dot_product(rows%jac(3*side - 2:3*side, row), x(:, rows%body(side, row)))
         end do
      end do
   end function times_jacobian

end module joint_bench
