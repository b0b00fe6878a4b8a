!> A periodic orbit by Newton's method on the map of a period, alone or with a condition on the parameter.
!>
!> $$ P(z; p) - z = 0, \qquad \tau_z^T (z - z_0) + \tau_p (p - p_0) = 0 $$
!>
!> with the direction tau, in which the point is searched in the plane through (z_0, p_0); tau = (0, 1) keeps the parameter. While
!> the residual is small the matrix of the iteration before is used again (chord method).
!> Source: R. Seydel, Practical Bifurcation and Stability Analysis (2010), chapters 4 and 7.
module find_orbit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, pi, wp
   use multipliers, only: find_multipliers, solve
   use orbit_results, only: orbit_plan_t, orbit_t
   use period_map, only: only_end, period_map_t, period_t, with_matrix, with_parameter
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: correct_orbit, drop_cyclic

   integer, parameter :: most_iterations = 15           !! of Newton's method
   integer, parameter :: renewed = 7                    !! iteration after which the matrix is renewed in any case
   real(wp), parameter :: of_tolerance = 30.0_wp        !! residual of an orbit, of the tolerance of the motion [1]
   real(wp), parameter :: chord = 1.0e-3_wp             !! correction below which the matrix is used again, of the scales [1]
   real(wp), parameter :: same = 1.0e-8_wp              !! distance at which M is that of the orbit, of the scales [1]
   real(wp), parameter :: longest = 0.3_wp              !! correction, of the scales [1]
   real(wp), parameter :: cyclic = 1.0e-6_wp            !! difference of a column of M and of a unit vector [1]

contains

   !> Correct a point to one with a periodic orbit. The direction has m + 1 components, the last one over the scale of p.
   subroutine correct_orbit(map, plan, direction, p_scale, orbit, n_iteration, reason)
      type(period_map_t), intent(inout) :: map                !! the map of a period
      type(orbit_plan_t), intent(in) :: plan                  !! for tolerance and phase
      real(wp), intent(in) :: direction(:)                    !! (m + 1) tau [1]
      real(wp), intent(in) :: p_scale                         !! scale of the parameter; 0: it is kept [any]
      type(orbit_t), intent(inout) :: orbit                   !! p and z nearby, then the orbit
      integer, intent(out) :: n_iteration                     !! iterations
      character(:), allocatable, intent(out) :: reason        !! why none was found; blank: one was

      type(period_t) :: period, trial
      real(wp) :: a(size(direction), size(direction)), right(size(direction)), size_of
      real(wp) :: start(size(orbit%z)), x(size(direction))
      integer :: info, k, m, wanted
      logical :: has_matrix

      m = size(orbit%z)
      wanted = merge(with_parameter, with_matrix, p_scale > 0.0_wp)
      has_matrix = .false.
      reason = ""
      do n_iteration = 1, most_iterations
         call map%follow(orbit%p, orbit%z, merge(only_end, wanted, has_matrix), trial)
         reason = trial%reason
         if (reason /= "") return
         if (.not. has_matrix) then
            period = trial
         else
            period%end = trial%end
         end if
         right = 0.0_wp
         right(:m) = orbit%z - period%end
         orbit%residual = maxval(abs(right))
         if (orbit%residual <= of_tolerance*plan%tolerance) then
            if (.not. has_matrix) exit
            has_matrix = maxval(abs(orbit%z - start)) <= same
            if (has_matrix) exit
            cycle
         end if
         if (.not. has_matrix) then
            start = orbit%z
            a = 0.0_wp
            a(:m, :m) = period%matrix
            do k = 1, m
               a(k, k) = a(k, k) - 1.0_wp
            end do
            if (p_scale > 0.0_wp) a(:m, m + 1) = period%by_p*p_scale
            a(m + 1, :) = direction
         end if
         call solve(a, right, x, info)
         if (info /= 0 .or. .not. all(ieee_is_finite(x))) then
            reason = "the matrix of Newton's method is singular: a multiplier is 1"
            return
         end if
         size_of = maxval(abs(x))
         x = x*min(1.0_wp, longest/max(size_of, tiny(1.0_wp)))
         orbit%z = orbit%z + x(:m)
         orbit%p = orbit%p + x(m + 1)*p_scale
         has_matrix = size_of < chord .and. n_iteration /= renewed
      end do
      if (n_iteration > most_iterations) then
         reason = "Newton's method ends after "//to_text(most_iterations)//" iterations at a residual of "// &
                  real_text(orbit%residual, 2)//" of the scales"
         return
      end if
      call take_over(map, plan, trial, period, orbit)
   end subroutine correct_orbit

   !> What is known of the orbit.
   subroutine take_over(map, plan, last, period, orbit)
      type(period_map_t), intent(in) :: map          !! the map of a period
      type(orbit_plan_t), intent(in) :: plan         !! for the phase
      type(period_t), intent(in) :: last             !! the last period
      type(period_t), intent(in) :: period           !! the last one with derivatives
      type(orbit_t), intent(inout) :: orbit          !! the orbit

      real(wp) :: phase
      integer :: k

      orbit%matrix = period%matrix
      if (allocated(period%by_p)) orbit%by_p = period%by_p
      orbit%multipliers = find_multipliers(period%matrix)
      orbit%is_stable = all(abs(orbit%multipliers) <= 1.0_wp)
      orbit%period = last%length
      orbit%onset = last%found%onset
      orbit%contact = last%found%contact
      orbit%speed = last%found%speed
      orbit%phase = not_a_number()
      do k = 1, size(orbit%onset)
         if (orbit%contact(k) < plan%first .or. orbit%contact(k) > plan%last) cycle
         phase = plan%phase + 2.0_wp*pi*map%n_period*orbit%onset(k)/orbit%period
         orbit%phase = phase - 2.0_wp*pi*ceiling((phase - pi)/(2.0_wp*pi))
         exit
      end do
   end subroutine take_over

   !> Leave out free components that nothing depends on: each one shifts the state after a period by as much as that at its start,
   !> and no other component. Multipliers 1 that belong to them say nothing of stability.
   subroutine drop_cyclic(map, p, z, n_cyclic, reason)
      type(period_map_t), intent(inout) :: map                !! fewer free components
      real(wp), intent(in) :: p                               !! value of the parameter [any]
      real(wp), allocatable, intent(inout) :: z(:)            !! (m) start [1]
      integer, intent(out) :: n_cyclic                        !! how many were left out
      character(:), allocatable, intent(out) :: reason        !! why the motion cannot be followed; blank: it can

      type(period_t) :: period
      logical :: is_kept(size(z))
      real(wp) :: unit(size(z))
      integer :: k
      logical :: is_done

      n_cyclic = 0
      call map%follow(p, z, with_matrix, period)
      reason = period%reason
      if (reason /= "") return
      is_kept = .true.
      do
         is_done = .true.
         do k = 1, size(z)
            if (.not. is_kept(k)) cycle
            unit = 0.0_wp
            unit(k) = 1.0_wp
            if (any(abs(period%matrix(:, k) - unit) > cyclic .and. is_kept)) cycle
            is_kept(k) = .false.
            is_done = .false.
         end do
         if (is_done) exit
      end do
      n_cyclic = count(.not. is_kept)
      call map%free%keep(is_kept)
      z = pack(z, is_kept)
   end subroutine drop_cyclic

end module find_orbit
