!> A periodic orbit by Newton's method on the map of a period, alone or with a condition on the parameter.
!>
!> $$ P(z; p) - z = 0, \qquad \tau_z^T (z - z_0) + \tau_p (p - p_0) = 0 $$
!>
!> with the direction tau, in which the point is searched in the plane through (z_0, p_0); tau = (0, 1) keeps the parameter. While
!> corrections are small and the residual falls, the matrix of an earlier orbit or iteration is used (chord method); that of the
!> orbit found is its own.
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
   real(wp), parameter :: slow = 0.2_wp                 !! residual, of that before, after which the matrix is renewed [1]
   real(wp), parameter :: of_tolerance = 30.0_wp        !! residual of an orbit, of the tolerance of the motion [1]
   real(wp), parameter :: chord = 1.0e-3_wp             !! correction below which the matrix is used again, of the scales [1]
   real(wp), parameter :: longest = 0.3_wp              !! correction that is always allowed, of the scales [1]
   real(wp), parameter :: far = 10.0_wp                 !! longest correction, of the residual [1]
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

      type(period_t) :: own, trial
      real(wp) :: a(size(direction), size(direction)), previous, right(size(direction)), x(size(direction))
      integer :: info, m, wanted
      logical :: has_matrix

      m = size(orbit%z)
      wanted = merge(with_parameter, with_matrix, p_scale > 0.0_wp)
      has_matrix = allocated(orbit%matrix) .and. (allocated(orbit%by_p) .or. wanted == with_matrix)
      previous = huge(1.0_wp)
      reason = ""
      do n_iteration = 1, most_iterations
         call map%follow(orbit%p, orbit%z, merge(only_end, wanted, has_matrix), trial)
         reason = trial%reason
         if (reason /= "") return
         if (.not. has_matrix) then
            own = trial
            orbit%matrix = own%matrix
            if (wanted == with_parameter) orbit%by_p = own%by_p
         end if
         right(:m) = orbit%z - trial%end
         right(m + 1) = 0.0_wp
         orbit%residual = maxval(abs(right))
         if (orbit%residual <= of_tolerance*plan%tolerance*(1.0_wp + maxval(abs(orbit%z)))) then
            if (.not. has_matrix) exit
            has_matrix = .false.  ! the matrix of the orbit itself is wanted
            cycle
         end if
         call fill_matrix(orbit, direction, p_scale, a)
         call solve(a, right, x, info)
         if (info /= 0 .or. .not. all(ieee_is_finite(x))) then
            reason = "the matrix of Newton's method is singular: a multiplier is 1"
            return
         end if
         if (n_iteration == 1 .and. has_matrix .and. maxval(abs(x)) > chord) then
            has_matrix = .false.  ! that of the neighbour is not near enough
            cycle
         end if
         has_matrix = maxval(abs(x)) < chord .and. orbit%residual < slow*previous
         previous = orbit%residual
         x = x*min(1.0_wp, max(longest, far*orbit%residual)/max(maxval(abs(x)), tiny(1.0_wp)))
         orbit%z = orbit%z + x(:m)
         orbit%p = orbit%p + x(m + 1)*p_scale
      end do
      if (n_iteration > most_iterations) then
         reason = "Newton's method ends after "//to_text(most_iterations)//" iterations at a residual of "// &
                  real_text(orbit%residual, 2)//" of the scales"
      else
         call take_over(map, plan, own, orbit)
      end if
   end subroutine correct_orbit

   !> The matrix of an iteration: derivatives of the residual, and the direction.
   pure subroutine fill_matrix(orbit, direction, p_scale, a)
      type(orbit_t), intent(in) :: orbit             !! derivatives of the map
      real(wp), intent(in) :: direction(:)           !! (m + 1) tau [1]
      real(wp), intent(in) :: p_scale                !! scale of the parameter; 0: it is kept [any]
      real(wp), intent(out) :: a(:, :)               !! (m + 1, m + 1) the matrix [1]

      integer :: k, m

      m = size(direction) - 1
      a = 0.0_wp
      a(:m, :m) = orbit%matrix
      do k = 1, m
         a(k, k) = a(k, k) - 1.0_wp
      end do
      if (p_scale > 0.0_wp) a(:m, m + 1) = orbit%by_p*p_scale
      a(m + 1, :) = direction
   end subroutine fill_matrix

   !> What is known of the orbit.
   subroutine take_over(map, plan, period, orbit)
      type(period_map_t), intent(in) :: map          !! the map of a period
      type(orbit_plan_t), intent(in) :: plan         !! for the phase
      type(period_t), intent(in) :: period           !! the period
      type(orbit_t), intent(inout) :: orbit          !! the orbit

      real(wp) :: phase
      integer :: k

      orbit%multipliers = find_multipliers(period%matrix)
      orbit%is_stable = all(abs(orbit%multipliers) <= 1.0_wp)
      orbit%period = period%length
      orbit%onset = period%found%onset
      orbit%contact = period%found%contact
      orbit%speed = period%found%speed
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
      integer, intent(out) :: n_cyclic                        !! how many were omitted
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
