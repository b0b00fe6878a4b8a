!> How far a run is from another one of the same motion: errors by kind, up to a time.
!>
!> Positions, velocities and reactions are compared at common instants: the maximum difference of any number of the sort, over
!> the scale of the sort in the reference: for positions the maximum range of one of them over the run (which does not hang on
!> where the origin is), for velocities and reactions the maximum magnitude. Contacts are compared one by one in the order
!> in which each starts anew; where a run has another sequence of them there is nothing to compare, and it is reported.
module run_difference
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: contact_t, kept_run_t, n_sort, sort_positions, sort_reactions, sort_velocities
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: by_onset, compare_contacts, compare_sorts, distances, ends_elsewhere, first_other_contact, scales_of

   real(wp), parameter :: at_rest = 1.0e-8_wp   !! range of motion below which a mechanism rests, of its size [1]
   real(wp), parameter :: together = 1.0e-9_wp  !! onsets so near that their order does not count, of the time compared [1]
   integer, parameter :: halvings = 10          !! of the motion, in the search for the first contact that differs

contains

   !> Scales of the sorts in a run. What moves less than a small part of the mechanism's size is at rest: then the size itself, and
   !> for velocities that over the time of the motion, are the scales. Without any reaction theirs is 1.
   pure function scales_of(run, size_of_scene, end) result(scale)
      class(kept_run_t), intent(in) :: run           !! the run
      real(wp), intent(in) :: size_of_scene          !! size of the mechanism [m]
      real(wp), intent(in) :: end                    !! time of the motion [s]
      real(wp) :: scale(n_sort)                      !! (n_sort) in the units of the sorts [any]

      integer :: k

      scale = 0.0_wp
      do k = 1, size(run%sort)
         associate (x => run%values(k, :run%n), s => scale(run%sort(k)))
            if (run%sort(k) == sort_positions) then
               s = max(s, maxval(x) - minval(x))
            else
               s = max(s, maxval(abs(x)))
            end if
         end associate
      end do
      if (scale(sort_positions) < at_rest*size_of_scene) then
         scale(sort_positions) = size_of_scene
         scale(sort_velocities) = size_of_scene/end
      end if
      if (scale(sort_reactions) <= 0.0_wp) scale(sort_reactions) = 1.0_wp
   end function scales_of

   !> Whether a run and its reference end at other instants within the window, by more than the one that rounding may cost: a
   !> condition ends one of them where it does not end the other.
   pure logical function ends_elsewhere(run, reference, window)
      class(kept_run_t), intent(in) :: run        !! the run
      class(kept_run_t), intent(in) :: reference  !! what it is compared with
      real(wp), intent(in) :: window              !! time up to which they are compared [s]

      real(wp), parameter :: same = 1.0e-9_wp   ! of the window [1]
      integer :: n

      n = min(run%n, reference%n)
      ends_elsewhere = abs(run%n - reference%n) > 1
      if (ends_elsewhere .and. n > 0) ends_elsewhere = reference%t(n) < window*(1.0_wp - same)
   end function ends_elsewhere

   !> Differences of two runs at each common instant, over the scales.
   pure subroutine distances(run, reference, scale, d)
      class(kept_run_t), intent(in) :: run        !! the run
      class(kept_run_t), intent(in) :: reference  !! what it is compared with
      real(wp), intent(in) :: scale(:)            !! (n_sort) scales [any]
      real(wp), allocatable, intent(out) :: d(:, :)  !! (n_sort, instants) maximum difference of each sort [1]

      integer :: i, k

      allocate (d(n_sort, min(run%n, reference%n)), source=0.0_wp)
      do i = 1, size(d, 2)
         do k = 1, size(run%sort)
            associate (sort => run%sort(k), difference => abs(run%values(k, i) - reference%values(k, i)))
               d(sort, i) = max(d(sort, i), difference/scale(sort))
            end associate
         end do
      end do
   end subroutine distances

   !> Maximum differences up to a time; of the motion the greater one of positions and velocities.
   pure subroutine compare_sorts(d, t, until, error, motion)
      real(wp), intent(in) :: d(:, :)       !! (n_sort, instants) differences [1]
      real(wp), intent(in) :: t(:)          !! (instants or more) their times [s]
      real(wp), intent(in) :: until         !! last time that counts [s]
      real(wp), intent(out) :: error(:)     !! (n_sort) maximum difference of each sort [1]
      real(wp), intent(out) :: motion       !! that of positions and velocities [1]

      integer :: i

      error = 0.0_wp
      do i = 1, size(d, 2)
         if (t(i) > until) exit
         error = max(error, d(:, i))
      end do
      motion = max(error(sort_positions), error(sort_velocities))
   end subroutine compare_sorts

   !> Differences of the contacts up to a time: none of them are numbers without contacts, or if their sequence is another.
   !> The restitution is a ratio of speeds, of which an error of the motion makes little where they are high and much where they are
   !> near it; so the difference of each ratio is weighed by the impact speed, over the highest of them.
   subroutine compare_contacts(run, reference, until, onset, peak, restitution, is_other)
      class(kept_run_t), intent(in) :: run        !! the run
      class(kept_run_t), intent(in) :: reference  !! what it is compared with
      real(wp), intent(in) :: until               !! last time that counts [s]
      real(wp), intent(out) :: onset              !! maximum difference of onset times [s]
      real(wp), intent(out) :: peak               !! of peak forces, over the maximum peak [1]
      real(wp), intent(out) :: restitution        !! of release over impact speeds, weighed [1]
      logical, intent(out) :: is_other            !! whether the sequence of contacts is another one

      type(contact_t), allocatable :: a(:), b(:)
      integer, allocatable :: partner(:)
      real(wp) :: last, maximum, fastest
      integer :: k, n

      onset = not_a_number()
      peak = not_a_number()
      restitution = not_a_number()
      a = by_onset(reference%contacts)
      b = by_onset(run%contacts)
      n = count(a%onset <= until)
      last = until
      if (n > 0 .and. n < size(a)) last = min(last, 0.5_wp*(a(n)%onset + a(n + 1)%onset))
      call find_partners(a(:n), b, last, together*until, partner, is_other)
      if (is_other .or. n == 0) return
      onset = maxval(abs(b(partner)%onset - a(:n)%onset))
      maximum = 0.0_wp
      fastest = maxval(a(:n)%impact_speed)
      do k = 1, n
         associate (one => a(k), other => b(partner(k)))
            if (.not. (ieee_is_finite(one%release_speed) .and. ieee_is_finite(other%release_speed))) cycle
            maximum = max(maximum, one%peak_force)
            call raise(peak, abs(other%peak_force - one%peak_force))
            if (one%impact_speed > 0.0_wp .and. other%impact_speed > 0.0_wp) then
               call raise(restitution, one%impact_speed/fastest* &
                          abs(other%release_speed/other%impact_speed - one%release_speed/one%impact_speed))
            end if
         end associate
      end do
      if (maximum > 0.0_wp) peak = peak/maximum
   end subroutine compare_contacts

   !> Time from which two runs meet other contacts, to a thousandth of the motion; not a number if they do not.
   real(wp) function first_other_contact(run, reference, end) result(from)
      class(kept_run_t), intent(in) :: run        !! the run
      class(kept_run_t), intent(in) :: reference  !! what it is compared with
      real(wp), intent(in) :: end                 !! of the motion [s]

      real(wp) :: same
      integer :: k

      from = not_a_number()
      if (.not. is_other_at(end)) return
      same = 0.0_wp
      from = end
      do k = 1, halvings
         associate (middle => 0.5_wp*(same + from))
            if (is_other_at(middle)) then
               from = middle
            else
               same = middle
            end if
         end associate
      end do

   contains

      !> Whether the contacts up to a time are others.
      logical function is_other_at(until) result(is_other)
         real(wp), intent(in) :: until  !! the time [s]

         real(wp) :: onset, peak, restitution

         call compare_contacts(run, reference, until, onset, peak, restitution, is_other)
      end function is_other_at

   end function first_other_contact

   !> Raise a maximum that may not be a number yet.
   pure subroutine raise(maximum, x)
      real(wp), intent(inout) :: maximum  !! the maximum so far, not a number before the first [any]
      real(wp), intent(in) :: x            !! what may be more [any]

      if (.not. ieee_is_finite(maximum)) maximum = 0.0_wp
      maximum = max(maximum, x)
   end subroutine raise

   !> For every contact of a reference the same one of a run: that of the same place which started as many times before.
   subroutine find_partners(a, b, last, tie, partner, is_other)
      type(contact_t), intent(in) :: a(:)                  !! (n) contacts of the reference, by their onsets
      type(contact_t), intent(in) :: b(:)                  !! (m) contacts of the run, by their onsets
      real(wp), intent(in) :: last                         !! up to which both must have as many [s]
      real(wp), intent(in) :: tie                          !! onsets so near have no order [s]
      integer, allocatable, intent(out) :: partner(:)      !! (n) numbers of the run's contacts
      logical, intent(out) :: is_other                     !! there are none: the sequence is another one

      logical :: is_taken(size(b))
      integer :: j, k

      allocate (partner(size(a)), source=0)
      is_taken = .false.
      is_other = count(b%onset <= last) /= size(a)
      do k = 1, size(a)
         do j = 1, size(b)
            if (.not. is_taken(j) .and. b(j)%number == a(k)%number) exit
         end do
         is_other = is_other .or. j > size(b)
         if (is_other) return
         partner(k) = j
         is_taken(j) = .true.
      end do
      do k = 1, size(a) - 1
         if (a(k + 1)%onset - a(k)%onset <= tie) cycle
         is_other = is_other .or. b(partner(k + 1))%onset < b(partner(k))%onset
      end do
   end subroutine find_partners

   !> Contacts in the order of their onsets.
   pure function by_onset(contacts) result(sorted)
      type(contact_t), intent(in) :: contacts(:)    !! (n) in any order
      type(contact_t), allocatable :: sorted(:)     !! (n) in order; those together in their own

      type(contact_t) :: one
      integer :: i, k

      sorted = contacts
      do k = 2, size(sorted)
         one = sorted(k)
         do i = k - 1, 1, -1
            if (sorted(i)%onset <= one%onset) exit
            sorted(i + 1) = sorted(i)
         end do
         sorted(i + 1) = one
      end do
   end function by_onset

end module run_difference
