!> Bifurcations between neighbours of a branch: which, and where.
!>
!> A bifurcation is where a test function changes its sign; that is found by the Illinois method along the branch, on corrected
!> orbits. A multiplier 1 is a fold where the parameter turns (t_p), else symmetry breaks: without a symmetry a branch meets no
!> other one. Where the number of onsets changes an onset grazes; the place is found by bisection, and derivatives have a
!> singularity there (A. B. Nordmark, J. Sound Vib. 145 (1991) 279-297).
module bifurcations
   use find_orbit, only: correct_orbit
   use kinds, only: wp
   use multipliers, only: solve, test_flip, test_one, test_torus
   use orbit_results, only: bifurcation_t, branch_flip, branch_fold, branch_grazing, branch_pitchfork, branch_torus, &
      orbit_plan_t, orbit_t
   use period_map, only: period_map_t
   implicit none (type, external)
   private
   public :: find_bifurcations, point_t, tangent_at

   integer, parameter :: most_trials = 40            !! of a location
   real(wp), parameter :: located = 1.0e-9_wp        !! width of the bracket, of the longest step [1]
   real(wp), parameter :: grazing_located = 1.0e-4_wp  !! the same where an onset grazes [1]

   !> A point of a branch.
   type :: point_t
      type(orbit_t) :: orbit                     !! the orbit
      real(wp), allocatable :: tangent(:)        !! (m + 1) of the branch, the last component over the range of p [1]
   end type point_t

contains

   !> Tangent of the branch, on the side of a direction.
   subroutine tangent_at(orbit, s, direction, tangent, reason)
      type(orbit_t), intent(in) :: orbit                       !! with its derivatives
      real(wp), intent(in) :: s                                !! scale of the parameter [any]
      real(wp), intent(in) :: direction(:)                     !! (m + 1) a direction nearby [1]
      real(wp), allocatable, intent(out) :: tangent(:)         !! (m + 1) of length one [1]
      character(:), allocatable, intent(out) :: reason         !! why there is none; blank: there is

      real(wp) :: a(size(direction), size(direction)), right(size(direction))
      integer :: info, k, m

      m = size(orbit%z)
      a = 0.0_wp
      a(:m, :m) = orbit%matrix
      do k = 1, m
         a(k, k) = a(k, k) - 1.0_wp
      end do
      a(:m, m + 1) = orbit%by_p*s
      a(m + 1, :) = direction
      right = 0.0_wp
      right(m + 1) = 1.0_wp
      allocate (tangent(m + 1))
      call solve(a, right, tangent, info)
      reason = ""
      if (info /= 0) reason = "branches meet: the tangent is not unique"
      if (info == 0) tangent = tangent/norm2(tangent)
   end subroutine tangent_at

   !> The bifurcations between two neighbours, in the order of the branch.
   subroutine find_bifurcations(map, plan, a, b, some)
      type(period_map_t), intent(inout) :: map                        !! the map of a period
      type(orbit_plan_t), intent(in) :: plan                          !! range
      type(point_t), intent(in) :: a                                  !! the first one
      type(point_t), intent(in) :: b                                  !! the second one
      type(bifurcation_t), allocatable, intent(out) :: some(:)        !! (any) what is between

      type(bifurcation_t) :: one
      logical :: is_fold
      integer :: kind

      allocate (some(0))
      is_fold = changes(branch_fold, a, b)
      do kind = branch_fold, branch_grazing
         if (kind == branch_pitchfork .and. is_fold) cycle
         if (.not. changes(kind, a, b)) cycle
         call locate(map, plan, kind, a, b, one)
         if (kind == branch_torus .and. .not. any(abs(one%orbit%multipliers%im) > 0.0_wp .and. &
                                                  abs(abs(one%orbit%multipliers) - 1.0_wp) < 1.0e-3_wp)) cycle
         some = [some, one]
      end do
      if (size(some) == 2) then
         if (distance(some(1)) > distance(some(2))) some = some([2, 1])
      end if

   contains

      !> How far along the branch.
      real(wp) function distance(bifurcation)
         type(bifurcation_t), intent(in) :: bifurcation   !! of these

         distance = dot_product(a%tangent(:size(a%tangent) - 1), bifurcation%orbit%z - a%orbit%z) + &
                    a%tangent(size(a%tangent))*(bifurcation%orbit%p - a%orbit%p)/(plan%to - plan%from)
      end function distance

   end subroutine find_bifurcations

   !> Whether the test function of a kind changes its sign.
   logical function changes(kind, a, b)
      integer, intent(in) :: kind               !! of the bifurcation
      type(point_t), intent(in) :: a, b         !! neighbours

      changes = test(kind, a, a)*test(kind, b, a) < 0.0_wp
   end function changes

   !> The test function of a kind.
   real(wp) function test(kind, point, first) result(f)
      integer, intent(in) :: kind               !! of the bifurcation
      type(point_t), intent(in) :: point        !! where
      type(point_t), intent(in) :: first        !! the first neighbour

      f = 0.0_wp
      select case (kind)
      case (branch_fold); f = point%tangent(size(point%tangent))
      case (branch_flip); f = test_flip(point%orbit%multipliers)
      case (branch_torus); f = test_torus(point%orbit%multipliers)
      case (branch_pitchfork); f = test_one(point%orbit%multipliers)
      case (branch_grazing); f = merge(1.0_wp, -1.0_wp, size(point%orbit%onset) == size(first%orbit%onset))
      end select
   end function test

   !> Find the place.
   subroutine locate(map, plan, kind, a, b, one)
      type(period_map_t), intent(inout) :: map          !! the map of a period
      type(orbit_plan_t), intent(in) :: plan            !! range
      integer, intent(in) :: kind                       !! of the bifurcation
      type(point_t), intent(in) :: a, b                 !! neighbours
      type(bifurcation_t), intent(out) :: one           !! the point, or the nearest that is known

      type(point_t) :: trial
      character(:), allocatable :: reason
      real(wp) :: f(2), g, s, width, x(2), y
      integer :: k, last, m, n, side

      last = 0
      m = size(a%orbit%z)
      s = plan%to - plan%from
      width = merge(grazing_located, located, kind == branch_grazing)*plan%step
      one%kind = kind
      x = [0.0_wp, dot_product(a%tangent(:m), b%orbit%z - a%orbit%z) + a%tangent(m + 1)*(b%orbit%p - a%orbit%p)/s]
      f = [test(kind, a, a), test(kind, b, a)]
      one%orbit = b%orbit
      do k = 1, most_trials
         y = (x(1)*f(2) - x(2)*f(1))/(f(2) - f(1))
         trial%orbit = a%orbit
         trial%orbit%z = a%orbit%z + y*a%tangent(:m)
         trial%orbit%p = a%orbit%p + y*a%tangent(m + 1)*s
         if (k > 1) trial%orbit = guess(y)
         call correct_orbit(map, plan, a%tangent, s, trial%orbit, n, reason)
         if (reason == "") call tangent_at(trial%orbit, s, a%tangent, trial%tangent, reason)
         if (reason /= "") return
         g = test(kind, trial, a)
         one%orbit = trial%orbit
         side = merge(2, 1, g*f(2) > 0.0_wp)
         if (side == last .and. kind /= branch_grazing) f(3 - side) = 0.5_wp*f(3 - side)
         x(side) = y
         f(side) = g
         last = side
         if (abs(x(2) - x(1)) <= width .or. .not. abs(g) > 1.0e-10_wp) return
      end do

   contains

      !> A point between: from the last one, along the tangent of the first neighbour.
      function guess(y) result(orbit)
         real(wp), intent(in) :: y          !! place [1]
         type(orbit_t) :: orbit             !! near it

         real(wp) :: ahead

         orbit = one%orbit
         ahead = y - dot_product(a%tangent(:m), orbit%z - a%orbit%z) - a%tangent(m + 1)*(orbit%p - a%orbit%p)/s
         orbit%z = orbit%z + ahead*a%tangent(:m)
         orbit%p = orbit%p + ahead*a%tangent(m + 1)*s
      end function guess

   end subroutine locate

end module bifurcations
