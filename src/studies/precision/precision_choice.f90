!> What the tolerance sweeps report: observed order, proportionality of error to tolerance, the front of best settings, the cheapest
!> one.
module precision_choice
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use precision_results, only: tol_sweep_t, median, precision_t, tol_run_done, tol_run_other, tol_run_t
   implicit none (type, external)
   private
   public :: choose_best, find_orders, hidden_below

   real(wp), parameter :: coarse = 1.0e-3_wp     !! error above which no method shows its order [1]
   real(wp), parameter :: above_bar = 10.0_wp    !! errors this many times the reference's own or more report of a method [1]
   integer, parameter :: fewest = 3              !! points of a fit

contains

   !> Observed order and proportionality of every tolerance sweep, from those of its errors that the reference and round-off do not
   !> hide.
   subroutine find_orders(study)
      type(precision_t), intent(inout) :: study  !! errors are known; orders are set

      logical, allocatable :: is_good(:)
      real(wp), allocatable :: error(:)
      integer :: k

      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            error = errors_of(tol_sweep, study%wanted)
            is_good = tol_sweep%tol_runs%state == tol_run_done
            is_good = is_good .and. error > hidden_below(study) .and. error > 0.0_wp .and. error < coarse
            call drop_floor(error, is_good)
            tol_sweep%order = order_of(pack(real(tol_sweep%tol_runs%count%steps, wp), is_good), pack(error, is_good))
            tol_sweep%exponent = slope(log(pack(tol_sweep%tol_runs%asked, is_good)), log(pack(error, is_good)))
            tol_sweep%ratio = not_a_number()
            if (.not. tol_sweep%is_fixed) tol_sweep%ratio = median(pack(error/tol_sweep%tol_runs%asked, is_good))
            if (tol_sweep%is_fixed) tol_sweep%exponent = not_a_number()
         end associate
      end do
   end subroutine find_orders

   !> Order that errors show over numbers of steps; none where it is not their number that makes the errors, since it hardly
   !> changes.
   pure real(wp) function order_of(steps, error) result(order)
      real(wp), intent(in) :: steps(:)    !! (n) numbers of steps [1]
      real(wp), intent(in) :: error(:)    !! (n) errors [1]

      real(wp), parameter :: min_change = 1.5_wp  ! of the number of steps, from the fewest to the most [1]

      order = not_a_number()
      if (size(steps) == 0) return
      if (maxval(steps) < min_change*minval(steps)) return
      order = -slope(log(steps), log(error))
   end function order_of

   !> Omit what lies behind the minimum error of a tolerance sweep: there round-off grows with the number of steps.
   pure subroutine drop_floor(error, is_good)
      real(wp), intent(in) :: error(:)           !! (n) errors, from the coarsest run on [1]
      logical, intent(inout) :: is_good(:)       !! (n) which of them count

      integer :: k

      k = minloc(error, dim=1, mask=is_good)
      if (k > 0) is_good(k + 1:) = .false.
   end subroutine drop_floor

   !> Errors of a tolerance sweep, 0 where there are none.
   pure function errors_of(tol_sweep, kind) result(error)
      type(tol_sweep_t), intent(in) :: tol_sweep       !! the tolerance sweep
      integer, intent(in) :: kind                !! of error
      real(wp) :: error(size(tol_sweep%tol_runs))      !! (runs) errors [1]

      integer :: k

      error = 0.0_wp
      do k = 1, size(error)
         if (tol_sweep%tol_runs(k)%state /= tol_run_done) cycle
         if (ieee_is_finite(tol_sweep%tol_runs(k)%error(kind))) error(k) = tol_sweep%tol_runs(k)%error(kind)
      end do
   end function errors_of

   !> Errors up to this one report of the reference, not of a method.
   pure real(wp) function hidden_below(study) result(minimum)
      type(precision_t), intent(in) :: study  !! the study

      minimum = above_bar*bar_of(study)
   end function hidden_below

   !> Error of the reference, 0 if nothing confirms it.
   pure real(wp) function bar_of(study) result(bar)
      type(precision_t), intent(in) :: study  !! the study

      bar = 0.0_wp
      if (ieee_is_finite(study%reference%bar(study%wanted))) bar = study%reference%bar(study%wanted)
   end function bar_of

   !> Slope of a line: the median of the slopes between all pairs of points, which a few points near round-off do not change; NaN of
   !> fewer than three points. Source: P. K. Sen (1968), J. Amer. Statist. Assoc. 63, 1379-1389.
   pure real(wp) function slope(x, y)
      real(wp), intent(in) :: x(:)  !! (n) abscissae [any]
      real(wp), intent(in) :: y(:)  !! (n) ordinates [any]

      real(wp), allocatable :: slopes(:)
      integer :: i, k, n

      slope = not_a_number()
      if (size(x) < fewest) return
      allocate (slopes(size(x)*(size(x) - 1)/2), source=0.0_wp)
      n = 0
      do k = 2, size(x)
         do i = 1, k - 1
            if (.not. abs(x(k) - x(i)) > 0.0_wp) cycle
            n = n + 1
            slopes(n) = (y(k) - y(i))/(x(k) - x(i))
         end do
      end do
      slope = median(slopes(:n))
   end function slope

   !> The front of settings of which no other is both cheaper and more exact, and the cheapest that reaches the error requested.
   !> Of errors that are within the reference's own all count as that, so that chance among them decides nothing; and a run
   !> is chosen only if no tighter one of its tolerance sweep misses the error requested or meets other contacts: it is no stroke of
   !> luck. Against a reference that nothing confirms nothing is chosen.
   subroutine choose_best(study)
      type(precision_t), intent(inout) :: study  !! costs and errors are known; front and choice are set

      integer :: i, k
      real(wp) :: minimum

      study%choice%tol_sweep = 0
      study%choice%tol_run = 0
      minimum = huge(1.0_wp)
      do k = 1, size(study%tol_sweeps)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
               if (can_be_chosen(tol_run, study%wanted)) tol_run%is_front = .not. is_beaten(study, tol_run)
            end associate
         end do
         if (.not. ieee_is_finite(study%reference%bar(study%wanted))) cycle
         do i = size(study%tol_sweeps(k)%tol_runs), 1, -1
            associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
               if (tol_run%state == tol_run_other) exit
               if (.not. can_be_chosen(tol_run, study%wanted)) cycle
               if (level(study, tol_run) > study%accuracy) exit
               if (tol_run%cpu >= minimum) cycle
               minimum = tol_run%cpu
               study%choice%tol_sweep = k
               study%choice%tol_run = i
            end associate
         end do
      end do
   end subroutine choose_best

   !> Whether a run has an error and a cost.
   pure logical function can_be_chosen(tol_run, kind)
      type(tol_run_t), intent(in) :: tol_run  !! the run
      integer, intent(in) :: kind       !! of error

      can_be_chosen = tol_run%state == tol_run_done
      if (can_be_chosen) can_be_chosen = ieee_is_finite(tol_run%error(kind))
   end function can_be_chosen

   !> Error of a run that can be reported from the reference's.
   pure real(wp) function level(study, tol_run)
      type(precision_t), intent(in) :: study  !! the study
      type(tol_run_t), intent(in) :: tol_run        !! the run

      level = max(tol_run%error(study%wanted), bar_of(study))
   end function level

   !> Whether another run is cheaper and no less exact, or more exact and no dearer.
   pure logical function is_beaten(study, tol_run)
      type(precision_t), intent(in) :: study  !! the study
      type(tol_run_t), intent(in) :: tol_run        !! the run

      integer :: i, k

      is_beaten = .true.
      do k = 1, size(study%tol_sweeps)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            associate (other => study%tol_sweeps(k)%tol_runs(i))
               if (.not. can_be_chosen(other, study%wanted)) cycle
               if (other%cpu < tol_run%cpu .and. level(study, other) <= level(study, tol_run)) return
               if (other%cpu <= tol_run%cpu .and. level(study, other) < level(study, tol_run)) return
            end associate
         end do
      end do
      is_beaten = .false.
   end function is_beaten

end module precision_choice
