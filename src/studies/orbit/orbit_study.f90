!> A study of periodic orbits: the orbit at the values of a deck, and its branch.
module orbit_study
   use continuation, only: follow_branch
   use find_orbit, only: correct_orbit, drop_cyclic
   use kinds, only: wp
   use orbit_results, only: orbit_study_t
   use orbit_source, only: orbit_source_t
   use period_map, only: period_map_t
   implicit none (type, external)
   private
   public :: study_orbits

contains

   !> Find orbit and branch.
   subroutine study_orbits(deck, study, reason)
      class(orbit_source_t), target, intent(inout) :: deck     !! where scenes come from
      type(orbit_study_t), intent(inout) :: study              !! the plan is set, the rest follows
      character(:), allocatable, intent(out) :: reason         !! why there is no orbit; blank: there is

      type(period_map_t) :: map
      real(wp), allocatable :: direction(:)
      real(wp) :: magnitude
      integer :: n

      map%deck => deck
      map%tolerance = study%plan%tolerance
      map%n_period = study%plan%n_period
      associate (plan => study%plan, orbit => study%orbit)
         orbit%p = plan%p
         call map%settle(plan%p, plan%n_settle, orbit%z, reason)
         if (reason == "") call drop_cyclic(map, plan%p, orbit%z, study%n_cyclic, reason)
         if (reason /= "") return
         study%n_free = size(orbit%z)
         study%scale = map%free%scale
         allocate (direction(size(orbit%z) + 1), source=0.0_wp)
         direction(size(direction)) = 1.0_wp
         call correct_orbit(map, plan, direction, plan%to - plan%from, orbit, n, reason)
         if (reason /= "") return
         magnitude = max(1.0_wp, maxval(abs(orbit%z)))  ! steps along the branch are measured by the orbit
         map%free%scale = magnitude*map%free%scale
         study%scale = map%free%scale
         orbit%z = orbit%z/magnitude
         if (allocated(orbit%by_p)) orbit%by_p = orbit%by_p/magnitude
         if (plan%parameter /= "") then
            call follow_branch(map, plan, orbit, study%branch)
         else
            allocate (study%branch%orbits(0), study%branch%bifurcations(0))
         end if
      end associate
      study%n_run = map%n_run
   end subroutine study_orbits

end module orbit_study
