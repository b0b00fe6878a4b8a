!> Where the curve of error over tolerance (or step) bends before round-off, and why.
!>
!> Errors that the reference does not hide (`precision_choice`) are taken by decades of what was asked; in each the median, of two
!> runs at least. A tolerance sweep is bent where its median falls by less than `min_fall` over two decades: a tenth of what it does
!> in proportion, and more than single runs scatter. Neighbouring stretches are one. The cause is what does not change either: the
!> steps, when stability, events or instants set them, or the constraint violation; or errors are as large as the motion itself; or
!> they do not change at all while the steps do, since what makes them is shorter than any step, as a contact that is grazed; or
!> those of neighbouring runs scatter widely, since in some of them errors of both signs cancel.
!>
!> Limits: tolerance sweeps that are too short for three decades of two runs are not judged.
module precision_bends
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_choice, only: hidden_below
   use precision_results, only: bend_lost, bend_luck, bend_scatter, bend_short, bend_steps, bend_t, bend_violation, &
      error_violation, tol_sweep_t, median, precision_t, tol_run_done
   implicit none (type, external)
   private
   public :: find_bends

   real(wp), parameter :: min_fall = 3.0_wp      !! of the median over two decades [1]
   real(wp), parameter :: same_steps = 1.4_wp      !! numbers of steps, over two decades, that are nearly the same [1]
   real(wp), parameter :: lost = 0.1_wp            !! error of a motion that has nothing left of what it should be [1]
   real(wp), parameter :: same_error = 0.01_wp     !! part of an error that may change over two decades where it is the same [1]
   real(wp), parameter :: by_luck = 10.0_wp        !! ratio of errors of one decade from which they scatter widely [1]
   integer, parameter :: fewest = 2                !! runs of a decade

   !> The runs of a decade.
   type :: decade_t
      integer :: n = 0                   !! runs whose error is known
      integer :: first = 0               !! run, the coarsest of them
      integer :: last = 0                !! run, the finest of them
      real(wp) :: error = 0.0_wp         !! median of their errors [1]
      real(wp) :: minimum = 0.0_wp         !! minimum error [1]
      real(wp) :: most = 0.0_wp          !! maximum error [1]
      real(wp) :: steps = 0.0_wp         !! median of their numbers of steps [1]
      real(wp) :: violation = 0.0_wp     !! median of the constraint violations [m]
   end type decade_t

contains

   !> The bends of all tolerance sweeps.
   subroutine find_bends(study)
      type(precision_t), intent(inout) :: study  !! errors are known; bends are set

      integer :: k

      do k = 1, size(study%tol_sweeps)
         allocate (study%tol_sweeps(k)%bends(0))
         if (ieee_is_finite(study%reference%bar(study%wanted))) call find_in(study%tol_sweeps(k), study%wanted, hidden_below(study))
      end do
   end subroutine find_bends

   !> The bends of a tolerance sweep.
   subroutine find_in(tol_sweep, kind, hidden)
      type(tol_sweep_t), intent(inout) :: tol_sweep    !! bends are set
      integer, intent(in) :: kind                !! of error
      real(wp), intent(in) :: hidden             !! errors up to this one are hidden by the reference's [1]

      type(decade_t), allocatable :: decades(:)
      type(bend_t) :: bend
      integer :: k, last

      decades = decades_of(tol_sweep, kind, hidden)
      last = 0
      do k = 1, size(decades) - 2
         if (any(decades(k:k + 2)%n < fewest)) cycle
         if (decades(k)%error > min_fall*decades(k + 2)%error) cycle
         bend%cause = cause_of(decades(k:k + 2))
         bend%first = decades(k)%first
         bend%last = decades(k + 2)%last
         if (last > 0 .and. k <= last + 2) then
            associate (before => tol_sweep%bends(size(tol_sweep%bends)))
               if (before%cause == bend%cause) then
                  before%last = bend%last
                  last = k
                  cycle
               end if
            end associate
         end if
         tol_sweep%bends = [tol_sweep%bends, bend]
         last = k
      end do
   end subroutine find_in

   !> Decades of what was asked, from the coarsest run on.
   function decades_of(tol_sweep, kind, hidden) result(decades)
      type(tol_sweep_t), intent(in) :: tol_sweep         !! the tolerance sweep
      integer, intent(in) :: kind                  !! of error
      real(wp), intent(in) :: hidden               !! errors up to this one are hidden by the reference's [1]
      type(decade_t), allocatable :: decades(:)    !! (n) decades

      integer :: decade(size(tol_sweep%tol_runs))
      logical :: is_in(size(tol_sweep%tol_runs)), is_known(size(tol_sweep%tol_runs))
      integer :: i, k

      associate (tol_runs => tol_sweep%tol_runs)
         is_known = .false.
         do i = 1, size(tol_runs)
            decade(i) = 1 + floor(log10(tol_runs(1)%asked/tol_runs(i)%asked) + 1.0e-6_wp)
            if (tol_runs(i)%state /= tol_run_done) cycle
            if (ieee_is_finite(tol_runs(i)%error(kind))) is_known(i) = tol_runs(i)%error(kind) > hidden
         end do
         allocate (decades(decade(size(tol_runs))))
         do k = 1, size(decades)
            is_in = is_known .and. decade == k
            decades(k)%n = count(is_in)
            if (decades(k)%n == 0) cycle
            decades(k)%first = findloc(is_in, .true., dim=1)
            decades(k)%last = findloc(is_in, .true., dim=1, back=.true.)
            decades(k)%error = median(pack([(tol_runs(i)%error(kind), i=1, size(tol_runs))], is_in))
            decades(k)%minimum = minval([(tol_runs(i)%error(kind), i=1, size(tol_runs))], mask=is_in)
            decades(k)%most = maxval([(tol_runs(i)%error(kind), i=1, size(tol_runs))], mask=is_in)
            decades(k)%steps = median(pack(real(tol_runs%count%steps, wp), is_in))
            decades(k)%violation = median(pack([(tol_runs(i)%error(error_violation), i=1, size(tol_runs))], is_in))
         end do
      end associate
   end function decades_of

   !> Why errors do not fall from the first to the last of three decades.
   pure integer function cause_of(decades)
      type(decade_t), intent(in) :: decades(3)   !! (3) the decades

      associate (coarse => decades(1), fine => decades(3))
         cause_of = bend_scatter
         if (any(decades%most > by_luck*decades%minimum)) cause_of = bend_luck
         if (fine%violation > 0.0_wp .and. coarse%violation <= min_fall*fine%violation) cause_of = bend_violation
         if (abs(coarse%error - fine%error) <= same_error*fine%error) cause_of = bend_short
         if (fine%steps <= same_steps*coarse%steps) cause_of = bend_steps
         if (fine%error > lost) cause_of = bend_lost
      end associate
   end function cause_of

end module precision_bends
