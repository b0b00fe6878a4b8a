!> What the runs of a search for a tolerance allow to be claimed of the one that was taken: errors, extremes, up to which time.
!>
!> With d the greater one of the differences to the run before it and to the one that confirms it, c d is claimed: c is greater
!> where round-off, not the tolerance, makes d. Of a channel it is its own difference, but at least a part of the maximum of its
!> kind.
module accuracy_claim
   use accuracy_results, only: accuracy_t, claim_none, claim_reached, claim_whole, claim_window
   use accuracy_trial, only: search_t
   use channel_difference, only: set_differences
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use peak_bracket, only: min_gain => gain
   use precision_reference, only: described, last_within
   use run_difference, only: first_other_contact
   implicit none (type, external)
   private
   public :: safety, set_claim

   real(wp), parameter :: safety = 3.0_wp            !! of differences, for the error claimed [1]
   real(wp), parameter :: for_chance = 6.0_wp        !! the same where round-off, not the tolerance, makes them [1]
   real(wp), parameter :: of_kind = 0.3_wp           !! of the maximum error of its kind that a channel has at least [1]
   real(wp), parameter :: lost = 1.0e-2_wp           !! error above which a motion has been lost on the way [1]

contains

   !> What the runs report.
   subroutine set_claim(search, found)
      type(search_t), intent(in) :: search         !! the runs
      type(accuracy_t), intent(inout) :: found     !! the claim is set

      real(wp) :: by_instant(max(1, search%taken%run%n)), none(size(search%asked, 2))
      integer :: n, worst(max(1, search%taken%run%n))

      found%tolerance = search%taken%what%asked
      found%reason = search%reason
      found%evidence%other_from = not_a_number()
      found%evidence%residual = not_a_number()
      found%claim = claim_none
      allocate (found%extremes(0))
      if (.not. search%taken%is_there) return
      associate (run => search%taken%run, quality => search%taken%run%summary%quality)
         n = run%n
         if (quality%has_ledger .and. quality%energy_max > 0.0_wp) then
            found%evidence%residual = quality%energy_residual_max/quality%energy_max
         end if
         found%end = run%summary%time_end
         if (.not. (search%coarser%is_there .and. search%other%is_there .and. n > 0)) return
         by_instant = 0.0_wp
         none = 0.0_wp
         found%evidence%coarser = described(search%coarser%what)
         found%evidence%confirmation = described(search%other%what)
         worst = 0
         call set_differences(run, search%coarser%run, search%scale, 0.0_wp, by_instant, none, worst)
         call set_differences(run, search%other%run, search%scale, 0.0_wp, by_instant, none, worst)
         found%evidence%factor = merge(safety, for_chance, search%reason == "")
         found%error_at_end = found%evidence%factor*maxval(by_instant)
         found%worst = worst(maxloc(by_instant, dim=1))
         if (found%error_at_end > found%asked) then
            found%worst = worst(findloc(found%evidence%factor*by_instant > found%asked, .true., dim=1))
         end if
         found%asked_until = last_within(by_instant, run%t, found%asked/found%evidence%factor)
         found%until = found%end
         found%claim = claim_whole
         if (found%error_at_end > found%asked) then
            found%claim = merge(claim_window, claim_reached, found%error_at_end > lost)
            if (found%claim == claim_window) found%until = found%asked_until
            if (found%until <= run%t(1)) found%claim = claim_none
         end if
         if (found%claim == claim_none) then
            found%worst = 0   ! nothing is reported of channels
            return
         end if
         found%error = found%evidence%factor*maxval(by_instant, mask=run%t(:n) <= found%until)
         found%evidence%other_from = first_other_contact(run, search%coarser%run, found%end)
         found%evidence%other_from = earlier(found%evidence%other_from, first_other_contact(run, search%other%run, found%end))
      end associate
      call set_extremes(search, found)
   end subroutine set_claim

   !> The earlier one of two times that need not be.
   pure real(wp) function earlier(a, b)
      real(wp), intent(in) :: a  !! a time, or not a number [s]
      real(wp), intent(in) :: b  !! another one [s]

      earlier = a
      if (b < a .or. .not. ieee_is_finite(a)) earlier = b
   end function earlier

   !> Extremes of the channels up to the last time that is claimed, and the differences to the other runs.
   subroutine set_extremes(search, found)
      type(search_t), intent(in) :: search         !! the runs
      type(accuracy_t), intent(inout) :: found     !! extremes are set

      real(wp) :: by_instant(search%taken%run%n), error(size(search%taken%run%kind)), of_kinds(size(search%scale)), size_of
      integer :: k, last, worst(search%taken%run%n)

      associate (run => search%taken%run)
         last = count(run%t(:run%n) <= found%until)
         error = 0.0_wp
         by_instant = 0.0_wp
         call set_differences(run, search%coarser%run, search%scale, found%until, by_instant, error, worst)
         found%evidence%apart(1) = maxval(by_instant(:last))
         by_instant = 0.0_wp
         call set_differences(run, search%other%run, search%scale, found%until, by_instant, error, worst)
         found%evidence%apart(2) = maxval(by_instant(:last))
         deallocate (found%extremes)
         allocate (found%extremes(size(error)))
         of_kinds = 0.0_wp
         do k = 1, size(error)
            associate (maximum => of_kinds(run%kind(k)))
               maximum = max(maximum, error(k)*run%factor_of(k)/search%scale(run%kind(k)))
            end associate
         end do
         do k = 1, size(error)
            associate (extreme => found%extremes(k))
               extreme%scale = search%scale(run%kind(k))/run%factor_of(k)
               extreme%minimum = run%series%low(k, last)
               extreme%most = run%series%high(k, last)
               if (last == run%n) then
                  extreme%minimum = run%series%minimum(k)
                  extreme%most = run%series%most(k)
               end if
               if (extreme%minimum > extreme%most) then  ! it never was a number
                  extreme%minimum = not_a_number()
                  extreme%most = not_a_number()
                  extreme%error = not_a_number()
                  cycle
               end if
               ! differences of runs contain neither round-off of the numbers nor the rise at which the search for extremes ends
               size_of = max(abs(extreme%minimum), abs(extreme%most))
               extreme%error = found%evidence%factor*max(error(k), of_kind*of_kinds(run%kind(k))*extreme%scale, &
                                                epsilon(1.0_wp)*max(size_of, extreme%scale)) + min_gain*size_of
            end associate
         end do
      end associate
   end subroutine set_extremes

end module accuracy_claim
