!> Members of a study: mechanisms as they are made, sampled; means, deviations, yields, histograms.
!>
!> A member is good if all its channels are within their limits at all output times. One that cannot be assembled at some time is
!> not good, and has no part in means. Where a pin is at its worst place a channel must be within its limits on both sides.
module sampled_members
   use kinds, only: i8, not_a_number, wp
   use mechanism_source, only: mechanism_source_t
   use member_draws, only: draw_t, stream_members
   use member_values, only: block_length, block_t
   use normal_distribution, only: wilson_interval
   use sample_moments, only: capability_of, sample_t
   use tolerance_plan, only: pin_worst
   use tolerance_results, only: members_t, tolerance_study_t, yield_t
   use worst_members, only: find_worst, keep_worst
   implicit none (type, external)
   private
   public :: begin_members, end_members, find_capabilities, inside_limits, sample_members, take_block

   real(wp), parameter :: histogram_half = 4.0_wp   !! half the width of a histogram, of a standard deviation [1]

contains

   !> Sample the members.
   subroutine sample_members(source, study, is_exact)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(inout) :: study      !! its members are set
      logical, intent(in) :: is_exact                      !! members are assembled

      type(block_t) :: some
      type(draw_t) :: draw
      type(sample_t), allocatable :: samples(:, :)
      real(wp), allocatable :: u(:, :)
      real(wp) :: start, now
      integer(i8) :: done
      integer :: m, n

      call cpu_time(start)
      call draw%begin(study)
      allocate (u(draw%n, block_length))
      call begin_members(study, is_exact, samples)
      done = 0
      do while (done < study%plan%sampling%members)
         n = int(min(int(block_length, i8), study%plan%sampling%members - done))
         do m = 1, n
            call draw%numbers(stream_members, done + m, u(:, m))
         end do
         call some%fill(source, study, draw, u(:, :n), is_exact)
         call take_block(some, study, samples)
         done = done + n
         call source%show(0.7_wp + 0.2_wp*done/study%plan%sampling%members)
      end do
      call end_members(samples, study%members)
      call find_capabilities(study)
      call find_worst(study, draw)
      call cpu_time(now)
      study%cpu_members = now - start
   end subroutine sample_members

   !> Make storage; the references of the samples are the means to second order.
   subroutine begin_members(study, is_exact, samples)
      type(tolerance_study_t), intent(inout) :: study           !! the study
      logical, intent(in) :: is_exact                           !! members are assembled
      type(sample_t), allocatable, intent(out) :: samples(:, :) !! (requests, times) the samples

      integer :: bin, r

      associate (members => study%members, n_request => size(study%sigma, 1), bins => study%plan%sampling%bins)
         members%is_exact = is_exact
         members%n = study%plan%sampling%members
         allocate (members%yields(n_request), members%at(n_request), members%edges(0:bins, n_request))
         allocate (members%counts(bins, n_request), source=0_i8)
         allocate (members%worst(2, n_request))
         allocate (samples(n_request, size(study%sigma, 2)))
         samples%reference = study%derivatives%values
         do r = 1, n_request
            members%at(r) = shown_time(study, r)
            associate (middle => 0.5_wp*(study%low(r, members%at(r)) + study%high(r, members%at(r))), &
                       half => histogram_half*study%sigma(r, members%at(r)))
               members%edges(:, r) = [(middle + half*(2.0_wp*bin/bins - 1.0_wp), bin=0, bins)]
            end associate
         end do
      end associate
   end subroutine begin_members

   !> Number of the time that tables and figures show of a channel: where its mean is next to a limit, in standard deviations;
   !> without limits where its standard deviation is maximum.
   pure integer function shown_time(study, r) result(at)
      type(tolerance_study_t), intent(in) :: study         !! the study
      integer, intent(in) :: r                             !! number of the channel

      real(wp) :: margin(size(study%sigma, 2))

      at = maxloc(study%sigma(r, :), dim=1)
      if (.not. (study%requests(r)%is_limited .and. study%sigma(r, at) > 0.0_wp)) return
      margin = min(study%requests(r)%upper - study%mean(r, :), study%mean(r, :) - study%requests(r)%lower)
      at = minloc(margin/max(study%sigma(r, :), 1.0e-6_wp*study%sigma(r, at)), dim=1)
   end function shown_time

   !> Take a block of members.
   subroutine take_block(some, study, samples)
      type(block_t), intent(in) :: some                    !! the block
      type(tolerance_study_t), intent(inout) :: study      !! yields and histograms grow
      type(sample_t), intent(inout) :: samples(:, :)       !! (requests, times) the samples

      real(wp) :: values(some%n)
      logical :: is_good(some%n), is_within(some%n)
      integer :: at, r

      is_good = .not. some%is_open(:some%n)
      study%members%open = study%members%open + count(some%is_open(:some%n))
      do r = 1, size(samples, 1)
         is_within = .not. some%is_open(:some%n)
         do at = 1, size(samples, 2)
            call some%values(study, r, at, values)
            if (any(some%is_open(:some%n))) then
               call samples(r, at)%add(pack(values, .not. some%is_open(:some%n)))
            else
               call samples(r, at)%add(values)
            end if
            if (at == study%members%at(r)) then
               call count_bins(values, some%is_open(:some%n), study%members%edges(:, r), study%members%counts(:, r))
               call keep_worst(values, some%is_open(:some%n), study%members%taken, study%members%worst(:, r))
            end if
            if (study%requests(r)%is_limited) is_within = is_within .and. is_between(some, study, r, at, values)
         end do
         study%members%yields(r)%good = study%members%yields(r)%good + count(is_within)
         is_good = is_good .and. is_within
      end do
      study%members%yield%good = study%members%yield%good + count(is_good)
      study%members%taken = study%members%taken + some%n
   end subroutine take_block

   !> Which members of a block have a channel between its limits at all times; one that cannot be assembled has not.
   function inside_limits(some, study, r) result(is_inside)
      type(block_t), intent(in) :: some                    !! the block
      type(tolerance_study_t), intent(in) :: study         !! the study
      integer, intent(in) :: r                             !! number of the channel
      logical :: is_inside(some%n)                         !! (members) which

      real(wp) :: values(some%n)
      integer :: at

      is_inside = .not. some%is_open(:some%n)
      do at = 1, size(study%derivatives%instants)
         call some%values(study, r, at, values)
         is_inside = is_inside .and. is_between(some, study, r, at, values)
      end do
   end function inside_limits

   !> Which members of a block have a channel between its limits at a time, wherever a pin at its worst place is.
   pure function is_between(some, study, r, at, values)
      type(block_t), intent(in) :: some                    !! the block
      type(tolerance_study_t), intent(in) :: study         !! the study
      integer, intent(in) :: r                             !! number of the channel
      integer, intent(in) :: at                            !! number of the time
      real(wp), intent(in) :: values(:)                    !! (members) the channel then [any]
      logical :: is_between(size(values))                  !! (members) which

      real(wp) :: widths(size(values))
      integer :: k

      widths = 0.0_wp
      do k = 1, size(study%pins)
         if (study%pins(k)%position /= pin_worst) cycle
         widths = widths + some%clearances(:some%n, k)*norm2(study%derivatives%pins(:, k, r, at))
      end do
      is_between = values - widths >= study%requests(r)%lower .and. values + widths <= study%requests(r)%upper
   end function is_between

   !> Count members in the bins of a histogram; those beyond its ends are counted in its outer bins.
   pure subroutine count_bins(values, is_open, edges, counts)
      real(wp), intent(in) :: values(:)            !! (members) values [any]
      logical, intent(in) :: is_open(:)            !! (members) which have none
      real(wp), intent(in) :: edges(0:)            !! (0:bins) edges [any]
      integer(i8), intent(inout) :: counts(:)      !! (bins) members

      integer :: bin, m, n

      n = size(counts)
      if (.not. edges(n) > edges(0)) return
      do m = 1, size(values)
         if (is_open(m)) cycle
         bin = min(max(1 + floor(min(max((values(m) - edges(0))/(edges(n) - edges(0)), -1.0_wp), 2.0_wp)*n), 1), n)
         counts(bin) = counts(bin) + 1_i8
      end do
   end subroutine count_bins

   !> Means, deviations and yields with their intervals.
   subroutine end_members(samples, members)
      type(sample_t), intent(in) :: samples(:, :)    !! (requests, times) the samples
      type(members_t), intent(inout) :: members      !! the rest is set

      real(wp) :: interval(2)
      integer :: at, r

      associate (n_request => size(samples, 1), n_time => size(samples, 2))
         allocate (members%mean(n_request, n_time), members%sigma(n_request, n_time), members%mean_half(n_request, n_time), &
                   members%sigma_low(n_request, n_time), members%sigma_high(n_request, n_time))
         members%lowest = samples%lowest
         members%highest = samples%highest
         do at = 1, n_time
            do r = 1, n_request
               call samples(r, at)%moments(members%mean(r, at), members%mean_half(r, at), members%sigma(r, at), interval)
               members%sigma_low(r, at) = interval(1)
               members%sigma_high(r, at) = interval(2)
            end do
         end do
         do r = 1, n_request
            call end_yield(members%yields(r))
         end do
         call end_yield(members%yield)
      end associate

   contains

      !> The interval of a yield.
      subroutine end_yield(yield)
         type(yield_t), intent(inout) :: yield   !! its good members are counted

         yield%n = members%n
         yield%open = members%open
         interval = wilson_interval(yield%good, yield%n)
         yield%low = interval(1)
         yield%high = interval(2)
      end subroutine end_yield

   end subroutine end_members

   !> Process capability of each request at the time that is shown of it.
   subroutine find_capabilities(study)
      type(tolerance_study_t), intent(inout) :: study   !! means and deviations of its members are known

      integer :: r

      associate (members => study%members, requests => study%requests)
         allocate (members%capability(3, size(requests)), source=not_a_number())
         do r = 1, size(requests)
            if (.not. requests(r)%is_limited .or. members%n - members%open < 2) cycle
            members%capability(:, r) = capability_of(members%mean(r, members%at(r)), members%sigma(r, members%at(r)), &
                                                     members%n - members%open, requests(r)%lower, requests(r)%upper)
         end do
      end associate
   end subroutine find_capabilities

end module sampled_members
