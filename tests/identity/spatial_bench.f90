!> A kind of joint or driver of space with generic geometry and motion, for identities that every kind fulfils.
module spatial_bench
   use bodies, only: points_t
   use fixed_random, only: random_t, seed_of
   use generic_item, only: column_number, fill_item, set_number
   use item, only: item_t
   use joint_bench, only: friction_laws
   use joint_friction, only: new_joint_friction
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use kind_info, only: is_of_space, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t, new_motion
   use rotations, only: rate_of_parameters, rotation_of_parameters, second_rate_of_parameters, turned_by
   use rows, only: n_v_spatial, new_rows, rows_t
   use spatial_coordinates, only: new_spatial_coordinates, spatial_coordinates_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: apply_rows, before, bench_t, evaluate_after, make_bench, n_body, n_item, now, random_frame, spatial_kinds
   public :: times_jacobian

   integer, parameter :: n_item = 3       !! joints: of two bodies, of ground and body, of body and ground
   integer, parameter :: n_body = 2       !! moving bodies
   integer, parameter :: before = 2       !! rows of others before those of the kind
   real(wp), parameter :: now = 0.37_wp   !! time of all tests [s]
   real(wp), parameter :: steep = 4.0_wp  !! entries of Phi_q that differences are not taken of [1 or m]
   real(wp), parameter :: bent = 60.0_wp  !! nor where gamma is as large [m/s^2 or 1/s^2]

   !> A kind with generic geometry and motion. Orientations are those of the start turned by `q(4:6)`.
   type :: bench_t
      class(joint_set_t), allocatable :: set         !! its items
      type(kind_info_t) :: info                      !! the kind
      type(rows_t) :: rows                           !! their rows, with others before and after
      type(motion_t) :: motion                       !! of the bodies
      type(spatial_coordinates_t) :: coordinates     !! of space
      real(wp) :: q(7, n_body) = 0.0_wp              !! (7, bodies) coordinates [m and 1]
      real(wp) :: v(6, n_body) = 0.0_wp              !! (6, bodies) rates [m/s and rad/s]
      real(wp) :: a(6, n_body) = 0.0_wp              !! (6, bodies) any accelerations [m/s^2 and rad/s^2]
      character(:), allocatable :: name              !! of the kind and the geometry
   end type bench_t

contains

   !> Numbers of the kinds that spatial scenes know.
   function spatial_kinds() result(kinds)
      integer, allocatable :: kinds(:)   !! (any) numbers in the registry

      class(joint_set_t), allocatable :: set
      integer :: k

      allocate (kinds(0))
      do k = 1, n_joint_kinds()
         call new_joint_set(k, set)
         if (is_of_space(set%info(), .true.)) kinds = [kinds, k]
      end do
   end function spatial_kinds

   !> Items of a kind between ground and two bodies, whose own axes are not their principal ones.
   subroutine make_bench(kind, seed, bench)
      integer, intent(in) :: kind                          !! number of the kind
      integer, intent(in) :: seed                          !! number of the geometry
      type(bench_t), intent(out) :: bench                  !! the kind, not evaluated

      integer, parameter :: body_i(n_item) = [1, 0, 2], body_j(n_item) = [2, 1, 0]
      type(item_t) :: items(n_item)
      type(random_t) :: random
      real(wp) :: angle(0:n_body), own(3, 3, 0:n_body), s(3, 2, n_item)
      integer :: k

      call new_joint_set(kind, bench%set)
      bench%info = bench%set%info()
      random%state = seed_of(bench%info%name, seed)
      bench%name = bench%info%name//" geometry "//to_text(seed)
      bench%coordinates = new_spatial_coordinates()
      do k = 1, n_item
         s(:, 1, k) = random%vector(3, -1.0_wp, 1.0_wp)
         s(:, 2, k) = random%vector(3, -1.0_wp, 1.0_wp)
         call fill_item(bench%info, k, random, items(k))
         if (seed == 1) call leave_open(bench%info, "axis_j", items(k))
         call leave_open(bench%info, "offset", items(k))  ! of a coupler
         call set_number(bench%info, "pitch", 2.0_wp + k, items(k))  ! so long that rows are smooth where they are differenced
      end do
      angle = 0.0_wp
      do k = 0, n_body
         own(:, :, k) = random_frame(random)
      end do
      own(:, :, 0) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
      call bench%set%new(items, reshape([body_i, body_j], [2, n_item], order=[2, 1]), s(:, 1, :), s(:, 2, :))
      call bench%set%prepare(items, angle)
      if (column_number(bench%info, "friction") > 0) then
         call new_joint_friction(items, friction_laws(n_item), bench%set%friction_lengths(), n_v_spatial, bench%set%friction)
      end if
      bench%set%first_row = before
      call new_rows(before + n_item*bench%info%n_row + 1, bench%rows, n_v_spatial)
      call new_motion(n_body, bench%motion, own)
      call draw_state(random, bench)
      call evaluate_motion(bench, 0.0_wp)
      call bench%set%set_start(bench%motion)
      call take_joints(bench)
      call bench%set%declare_rows(bench%rows)
      do k = 1, 1000  ! until no axis is nearly along one that an angle is measured about
         call draw_state(random, bench)
         call evaluate_after(bench, 0.0_wp)
         if (maxval(abs(bench%rows%jac)) < steep .and. maxval(abs(bench%rows%gam)) < bent) exit
      end do
   end subroutine make_bench

   !> Leave a cell of a row open, if the kind has the column.
   subroutine leave_open(info, name, item)
      type(kind_info_t), intent(in) :: info    !! the kind
      character(*), intent(in) :: name         !! the column
      type(item_t), intent(inout) :: item      !! the row

      integer :: c

      c = column_number(info, name)
      if (c == 0) return
      if (.not. allocated(info%columns(c)%default)) return
      if (info%columns(c)%default /= "") return  ! a reader fills it in
      item%values(c)%given = .false.
      if (allocated(item%values(c)%table)) deallocate (item%values(c)%table)
   end subroutine leave_open

   !> Joints with the items' bodies: a revolute one for kinds that name a joint, three for those that couple them.
   subroutine take_joints(bench)
      type(bench_t), intent(inout) :: bench    !! the bodies stand where the deck puts them

      class(joint_set_t), allocatable :: joint
      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(random_t) :: random
      real(wp), parameter :: angle(0:n_body) = 0.0_wp
      character(*), parameter :: names(3) = [character(19) :: "joint.revolute", "joint.translational", "joint.cylindrical"]
      integer :: e, k, kind

      if (column_number(bench%info, "joint") == 0 .and. .not. bench%info%couples_joints) return
      do k = 1, n_item
         do e = 1, merge(3, 1, bench%info%couples_joints)
            do kind = 1, n_joint_kinds()
               call new_joint_set(kind, joint)
               info = joint%info()
               if (info%name == trim(names(e)) .and. is_of_space(info, .true.)) exit
            end do
            random%state = seed_of(bench%name, k + 10*(e - 1))
            call fill_item(info, k, random, items(1))
            call joint%new(items, bench%set%body(:, k:k), bench%set%s_i(:, k:k), bench%set%s_j(:, k:k))
            call joint%prepare(items, angle)
            call joint%set_start(bench%motion)
            call bench%set%take_joint(k, joint, bench%motion)
         end do
      end do
   end subroutine take_joints

   !> Any positions, velocities and accelerations.
   subroutine draw_state(random, bench)
      type(random_t), intent(inout) :: random  !! where numbers come from
      type(bench_t), intent(inout) :: bench    !! the state is set

      integer :: k

      do k = 1, n_body
         bench%q(:3, k) = random%vector(3, -2.0_wp, 2.0_wp)
         bench%q(4:, k) = random%vector(4, -1.0_wp, 1.0_wp)
         bench%q(4:, k) = bench%q(4:, k)/norm2(bench%q(4:, k))
         bench%v(:, k) = random%vector(6, -2.0_wp, 2.0_wp)
         bench%a(:, k) = random%vector(6, -2.0_wp, 2.0_wp)
      end do
   end subroutine draw_state

   !> Any rotation.
   function random_frame(random) result(a)
      type(random_t), intent(inout) :: random  !! where numbers come from
      real(wp) :: a(3, 3)                      !! (3, 3) the rotation [1]

      a = rotation_of_parameters(random%vector(4, -1.0_wp, 1.0_wp))
   end function random_frame

   !> Motion after a time with the bench's accelerations: the second-order part of the turn is exact at the time zero, to which all
   !> differences of first order lead.
   subroutine evaluate_motion(bench, dt)
      type(bench_t), intent(inout) :: bench  !! the kind
      real(wp), intent(in) :: dt             !! time since now [s]

      real(wp) :: q(7, n_body), v(6, n_body)
      integer :: k

      v = bench%v + dt*bench%a
      do k = 1, n_body
         q(:3, k) = bench%q(:3, k) + dt*(bench%v(:3, k) + 0.5_wp*dt*bench%a(:3, k))
         q(4:, k) = bench%q(4:, k) + dt*(rate_of_parameters(bench%q(4:, k), bench%v(4:, k)) &
                                         + 0.5_wp*dt*second_rate_of_parameters(bench%q(4:, k), bench%v(4:, k), bench%a(4:, k)))
      end do
      bench%motion%t = now + dt
      call bench%coordinates%move(n_body, [(k, k=1, n_body)], q, v, bench%motion)
   end subroutine evaluate_motion

   !> Rows after a time with the bench's accelerations.
   subroutine evaluate_after(bench, dt)
      type(bench_t), intent(inout) :: bench  !! the kind
      real(wp), intent(in) :: dt             !! time since now [s]

      call evaluate_motion(bench, dt)
      call bench%set%evaluate(now + dt, bench%motion, bench%rows)
   end subroutine evaluate_after

   !> Rows after a change of the bodies.
   subroutine apply_rows(bench, x)
      type(bench_t), intent(inout) :: bench    !! the kind
      real(wp), intent(in) :: x(6, n_body)     !! (6, bodies) displacements, and turns along the bodies' axes [m and rad]

      real(wp) :: q(7, n_body)
      integer :: k

      q = bench%q
      do k = 1, n_body
         q(:3, k) = q(:3, k) + x(:3, k)
         q(4:, k) = turned_by(q(4:, k), x(4:, k))
      end do
      call bench%coordinates%move(n_body, [(k, k=1, n_body)], q, bench%v, bench%motion)
      call bench%set%evaluate(now, bench%motion, bench%rows)
   end subroutine apply_rows

   !> Phi_q x for rates or accelerations x.
   pure function times_jacobian(rows, x) result(product)
      type(rows_t), intent(in) :: rows        !! rows
      real(wp), intent(in) :: x(6, n_body)    !! (6, bodies) rates [any]
      real(wp) :: product(rows%n)             !! (rows) Phi_q x [any]

      integer :: row, side

      product = 0.0_wp
      do row = 1, rows%n
         do side = 1, 2
            associate (body => rows%body(side, row))
               if (body == 0) cycle
               product(row) = product(row) + dot_product(rows%jac(6*side - 5:6*side, row), x(:, body))
            end associate
         end do
      end do
   end function times_jacobian

end module spatial_bench
