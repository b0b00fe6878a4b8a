!> What the ladders tell: observed order, proportionality of error to tolerance, the front of best settings, the cheapest one.
module precision_choice
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use precision_results, only: ladder_t, median, precision_t, rung_done, rung_other, rung_t
   implicit none (type, external)
   private
   public :: choose_best, find_orders, hidden_below

   real(wp), parameter :: coarse = 1.0e-3_wp     !! error above which no method shows its order [1]
   real(wp), parameter :: above_bar = 10.0_wp    !! errors this many times the reference's own or more tell of a method [1]
   integer, parameter :: fewest = 3              !! points of a fit

contains

   !> Observed order and proportionality of every ladder, from those of its errors that the reference and round-off do not hide.
   subroutine find_orders(study)
      type(precision_t), intent(inout) :: study  !! errors are known; orders are set

      logical, allocatable :: is_good(:)
      real(wp), allocatable :: error(:)
      integer :: k

      do k = 1, size(study%ladders)
         associate (ladder => study%ladders(k))
            error = errors_of(ladder, study%wanted)
            is_good = ladder%rungs%state == rung_done
            is_good = is_good .and. error > hidden_below(study) .and. error > 0.0_wp .and. error < coarse
            call drop_floor(error, is_good)
            ladder%order = order_of(pack(real(ladder%rungs%count%steps, wp), is_good), pack(error, is_good))
            ladder%exponent = slope(log(pack(ladder%rungs%asked, is_good)), log(pack(error, is_good)))
            ladder%ratio = not_a_number()
            if (.not. ladder%is_fixed) ladder%ratio = median(pack(error/ladder%rungs%asked, is_good))
            if (ladder%is_fixed) ladder%exponent = not_a_number()
         end associate
      end do
   end subroutine find_orders

   !> Order that errors show over numbers of steps; none where it is not their number that makes the errors, since it hardly
   !> changes.
   pure real(wp) function order_of(steps, error) result(order)
      real(wp), intent(in) :: steps(:)    !! (n) numbers of steps [1]
      real(wp), intent(in) :: error(:)    !! (n) errors [1]

      real(wp), parameter :: least_change = 1.5_wp  ! of the number of steps, from the fewest to the most [1]

      order = not_a_number()
      if (size(steps) == 0) return
      if (maxval(steps) < least_change*minval(steps)) return
      order = -slope(log(steps), log(error))
   end function order_of

   !> Leave out what lies behind the least error of a ladder: there round-off grows with the number of steps.
   pure subroutine drop_floor(error, is_good)
      real(wp), intent(in) :: error(:)           !! (n) errors, from the coarsest rung on [1]
      logical, intent(inout) :: is_good(:)       !! (n) which of them count

      integer :: k

      k = minloc(error, dim=1, mask=is_good)
      if (k > 0) is_good(k + 1:) = .false.
   end subroutine drop_floor

   !> Errors of a ladder, 0 where there are none.
   pure function errors_of(ladder, kind) result(error)
      type(ladder_t), intent(in) :: ladder       !! the ladder
      integer, intent(in) :: kind                !! of error
      real(wp) :: error(size(ladder%rungs))      !! (rungs) errors [1]

      integer :: k

      error = 0.0_wp
      do k = 1, size(error)
         if (ladder%rungs(k)%state /= rung_done) cycle
         if (ieee_is_finite(ladder%rungs(k)%error(kind))) error(k) = ladder%rungs(k)%error(kind)
      end do
   end function errors_of

   !> Errors up to this one tell of the reference, not of a method.
   pure real(wp) function hidden_below(study) result(least)
      type(precision_t), intent(in) :: study  !! the study

      least = above_bar*bar_of(study)
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

   !> The front of settings of which no other is both cheaper and more exact, and the cheapest that reaches the error wanted.
   !> Of errors that are within the reference's own all count as that, so that chance among them decides nothing; and a run
   !> is chosen only if no tighter one of its ladder misses the error wanted or meets other contacts: it is no stroke of luck.
   !> Against a reference that nothing confirms nothing is chosen.
   subroutine choose_best(study)
      type(precision_t), intent(inout) :: study  !! costs and errors are known; front and choice are set

      integer :: i, k
      real(wp) :: least

      study%choice%ladder = 0
      study%choice%rung = 0
      least = huge(1.0_wp)
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            associate (rung => study%ladders(k)%rungs(i))
               if (can_be_chosen(rung, study%wanted)) rung%is_front = .not. is_beaten(study, rung)
            end associate
         end do
         if (.not. ieee_is_finite(study%reference%bar(study%wanted))) cycle
         do i = size(study%ladders(k)%rungs), 1, -1
            associate (rung => study%ladders(k)%rungs(i))
               if (rung%state == rung_other) exit
               if (.not. can_be_chosen(rung, study%wanted)) cycle
               if (level(study, rung) > study%accuracy) exit
               if (rung%cpu >= least) cycle
               least = rung%cpu
               study%choice%ladder = k
               study%choice%rung = i
            end associate
         end do
      end do
   end subroutine choose_best

   !> Whether a run has an error and a cost.
   pure logical function can_be_chosen(rung, kind)
      type(rung_t), intent(in) :: rung  !! the run
      integer, intent(in) :: kind       !! of error

      can_be_chosen = rung%state == rung_done
      if (can_be_chosen) can_be_chosen = ieee_is_finite(rung%error(kind))
   end function can_be_chosen

   !> Error of a run that can be told from the reference's.
   pure real(wp) function level(study, rung)
      type(precision_t), intent(in) :: study  !! the study
      type(rung_t), intent(in) :: rung        !! the run

      level = max(rung%error(study%wanted), bar_of(study))
   end function level

   !> Whether another run is cheaper and no less exact, or more exact and no dearer.
   pure logical function is_beaten(study, rung)
      type(precision_t), intent(in) :: study  !! the study
      type(rung_t), intent(in) :: rung        !! the run

      integer :: i, k

      is_beaten = .true.
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            associate (other => study%ladders(k)%rungs(i))
               if (.not. can_be_chosen(other, study%wanted)) cycle
               if (other%cpu < rung%cpu .and. level(study, other) <= level(study, rung)) return
               if (other%cpu <= rung%cpu .and. level(study, other) < level(study, rung)) return
            end associate
         end do
      end do
      is_beaten = .false.
   end function is_beaten

end module precision_choice
