!> A branch of periodic orbits over a parameter by pseudo-arclength continuation, in both directions from an orbit.
!>
!> With x = (z, p/s) and t the tangent of the branch, which M - I and the derivative by p give,
!>
!> $$ (M - I) t_z + s P_p t_p = 0, \qquad |t| = 1, \qquad x_1 = x_0 + h t + \text{a correction across } t , $$
!>
!> so that the branch can turn at folds. h follows from the iterations of the correction. Between neighbours the functions of
!> `multipliers` and t_p tell bifurcations by their signs; `bifurcations` finds the points.
!> Source: H. B. Keller, Applications of Bifurcation Theory (1977), 359-384; R. Seydel (2010), chapter 4.
module continuation
   use bifurcations, only: find_bifurcations, point_t, tangent_at
   use find_orbit, only: correct_orbit
   use kinds, only: wp
   use orbit_results, only: bifurcation_t, branch_t, orbit_plan_t, orbit_t
   use period_map, only: period_map_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: follow_branch

   integer, parameter :: easy = 6                    !! iterations after which steps grow
   real(wp), parameter :: growth = 1.5_wp            !! of steps [1]
   real(wp), parameter :: first_part = 0.25_wp       !! first step, of the longest one [1]
   real(wp), parameter :: shortest = 1.0e-3_wp       !! step at which the branch is given up, of the longest one [1]
   real(wp), parameter :: min_cosine = 0.8_wp        !! between tangents of neighbours [1]

contains

   !> Follow the branch through an orbit.
   subroutine follow_branch(map, plan, orbit, branch)
      type(period_map_t), intent(inout) :: map       !! the map of a period
      type(orbit_plan_t), intent(in) :: plan         !! range, steps
      type(orbit_t), intent(in) :: orbit             !! with its derivative by the parameter
      type(branch_t), intent(out) :: branch          !! from the minimum to the maximum, if it does not turn

      type(branch_t) :: low, high
      integer :: k

      call go(map, plan, orbit, -1.0_wp, low)
      call go(map, plan, orbit, 1.0_wp, high)
      allocate (branch%orbits(0), branch%bifurcations(0))
      do k = size(low%orbits), 1, -1
         branch%orbits = [branch%orbits, low%orbits(k)]
      end do
      branch%orbits = [branch%orbits, orbit, high%orbits]
      do k = size(low%bifurcations), 1, -1
         branch%bifurcations = [branch%bifurcations, low%bifurcations(k)]
      end do
      branch%bifurcations = [branch%bifurcations, high%bifurcations]
      branch%low = low%high
      branch%high = high%high
   end subroutine follow_branch

   !> Go along the branch in one direction.
   subroutine go(map, plan, orbit, sign, branch)
      type(period_map_t), intent(inout) :: map       !! the map of a period
      type(orbit_plan_t), intent(in) :: plan         !! range, steps
      type(orbit_t), intent(in) :: orbit             !! the first orbit, which is not taken over
      real(wp), intent(in) :: sign                   !! of the first change of the parameter [1]
      type(branch_t), intent(out) :: branch          !! orbits behind it

      type(point_t) :: here, next
      type(bifurcation_t), allocatable :: some(:)
      character(:), allocatable :: reason
      real(wp) :: h, s, direction(size(orbit%z) + 1)
      integer :: n_iteration
      logical :: is_last

      allocate (branch%orbits(0), branch%bifurcations(0))
      s = plan%to - plan%from
      here%orbit = orbit
      direction = 0.0_wp
      direction(size(direction)) = sign
      call tangent_at(orbit, s, direction, here%tangent, reason)
      branch%high = reason
      if (reason /= "") return
      h = first_part*plan%step
      do while (size(branch%orbits) < plan%most)
         call step_along(map, plan, here, h, next, n_iteration, is_last, reason)
         if (reason == "") then
            if (dot_product(next%tangent, here%tangent) < min_cosine .and. .not. is_last) reason = "the branch bends sharply"
         end if
         if (reason /= "") then
            h = 0.5_wp*h
            if (h >= shortest*plan%step) cycle
            branch%high = "near "//real_text(here%orbit%p, 6)//": "//reason
            return
         end if
         call find_bifurcations(map, plan, here, next, some)
         branch%bifurcations = [branch%bifurcations, some]
         branch%orbits = [branch%orbits, next%orbit]
         if (is_last) then
            branch%high = "end of the range"
            return
         end if
         here = next
         if (n_iteration <= easy) h = min(plan%step, growth*h)
      end do
      branch%high = "number of points reached"
   end subroutine go

   !> The next orbit; one beyond the range is put on its end.
   subroutine step_along(map, plan, here, h, next, n_iteration, is_last, reason)
      type(period_map_t), intent(inout) :: map                 !! the map of a period
      type(orbit_plan_t), intent(in) :: plan                   !! range
      type(point_t), intent(in) :: here                        !! the point so far
      real(wp), intent(in) :: h                                !! length of the step [1]
      type(point_t), intent(out) :: next                       !! the next one
      integer, intent(out) :: n_iteration                      !! of its correction
      logical, intent(out) :: is_last                          !! it is at an end of the range
      character(:), allocatable, intent(out) :: reason         !! why there is none; blank: there is

      real(wp) :: bound, direction(size(here%tangent)), length, p, s
      integer :: m

      m = size(here%orbit%z)
      s = plan%to - plan%from
      p = here%orbit%p + h*here%tangent(m + 1)*s
      bound = min(max(p, plan%from), plan%to)
      is_last = abs(p - bound) > 0.0_wp
      length = h
      direction = here%tangent
      if (is_last) then
         length = (bound - here%orbit%p)/(here%tangent(m + 1)*s)
         direction = 0.0_wp
         direction(m + 1) = 1.0_wp
      end if
      next%orbit = here%orbit
      next%orbit%z = here%orbit%z + length*here%tangent(:m)
      next%orbit%p = here%orbit%p + length*here%tangent(m + 1)*s
      call correct_orbit(map, plan, direction, s, next%orbit, n_iteration, reason)
      if (reason /= "") return
      bound = min(max(next%orbit%p, plan%from), plan%to)
      if (.not. is_last .and. abs(next%orbit%p - bound) > 0.0_wp) then
         is_last = .true.
         direction = 0.0_wp
         direction(m + 1) = 1.0_wp
         associate (back => (bound - next%orbit%p)/(here%orbit%p - next%orbit%p))
            next%orbit%z = next%orbit%z + back*(here%orbit%z - next%orbit%z)
         end associate
         next%orbit%p = bound
         call correct_orbit(map, plan, direction, s, next%orbit, n_iteration, reason)
         if (reason /= "") return
      end if
      call tangent_at(next%orbit, s, here%tangent, next%tangent, reason)
   end subroutine step_along

end module continuation
