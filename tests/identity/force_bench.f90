!> A kind of force element of planar scenes with generic items and motion, for identities that every kind fulfils.
module force_bench
   use bodies, only: points_t
   use fixed_random, only: random_t, seed_of
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item, make_expression
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t, new_loads, new_motion
   use planar_kinds, only: is_planar_force
   use planar_coordinates, only: set_planar_motion
   implicit none (type, external)
   private
   public :: bench_t, kind_number, make_bench, n_body, n_item, now

   integer, parameter :: n_item = 3        !! items of each kind
   integer, parameter :: n_body = 3        !! moving bodies
   real(wp), parameter :: now = 0.37_wp    !! time [s]

   !> A kind with generic items and motion.
   type :: bench_t
      class(force_set_t), allocatable :: set     !! its items
      type(points_t) :: points                   !! points of the bodies, number k of body k
      type(motion_t) :: motion                   !! of the bodies
      type(loads_t) :: loads                     !! on the bodies
      real(wp) :: power = 0.0_wp                 !! power reported [W]
      character(:), allocatable :: name          !! for messages
   end type bench_t

contains

   !> Items of a kind on three bodies that move anyhow.
   subroutine make_bench(kind, bench, x, y)
      integer, intent(in) :: kind                  !! number of the kind
      type(bench_t), intent(out) :: bench          !! the kind, not evaluated
      character(*), intent(in), optional :: x      !! expression of the first expression column of all items
      character(*), intent(in), optional :: y      !! of the second

      type(item_t) :: items(n_item)
      type(kind_info_t) :: info
      type(random_t) :: random
      real(wp) :: q(3, n_body), v(3, n_body)
      integer :: c, k

      call new_force_set(kind, bench%set)
      info = bench%set%info()
      random%state = seed_of(info%name, 0)
      bench%name = info%name
      bench%points%n = n_body
      allocate (bench%points%body(n_body), bench%points%s(3, n_body))
      bench%points%s = 0.0_wp
      do k = 1, n_body
         bench%points%body(k) = k
         bench%points%s(1:2, k) = random%vector(2, -1.0_wp, 1.0_wp)
         q(:, k) = random%vector(3, -2.0_wp, 2.0_wp)
         v(:, k) = random%vector(3, -2.0_wp, 2.0_wp)
      end do
      do k = 1, n_item
         call fill_item(info, k, random, items(k))
         c = column_number(info, "j")
         if (c > 0) items(k)%values(c)%index = modulo(k, n_item) + 1
         if (present(x)) items(k)%values(2)%expression = make_expression(x, info%columns(2))
         if (present(y)) items(k)%values(3)%expression = make_expression(y, info%columns(3))
      end do
      call bench%set%prepare(items, bench%points)
      call new_motion(n_body, bench%motion)
      call set_planar_motion(n_body, q, v, bench%motion)
      call new_loads(n_body, bench%loads)
   end subroutine make_bench

   !> Number of a kind by its name.
   integer function kind_number(name) result(kind)
      character(*), intent(in) :: name  !! as in a deck

      class(force_set_t), allocatable :: set
      type(kind_info_t) :: info

      do kind = 1, n_force_kinds()
         call new_force_set(kind, set)
         info = set%info()
         if (info%name == name .and. is_planar_force(kind)) return
      end do
      error stop "force_bench: no such kind"
   end function kind_number

end module force_bench
