!> A comparison of a run with another run, or with columns of another program: all channels, impacts, the verdict.
!>
!> Channels are compared at the output instants of the second (`differences_of_series`), where both have some. A channel differs
!> if the
!> maximum difference is more than what is allowed: the larger of `absolute` and `relative` times its maximum magnitude in the
!> first; or if at some instant only one of both has a number. What is round-off in the first (`channel_noise`) makes no difference.
!> By statistics, it differs if its mean or its mean square is further apart than that (for the square: of the magnitudes'
!> product) and
!> the significance, times the number of channels, is below 5 %: of a hundred equal channels not one is to be found different.
!>
!> Limits: impacts are paired in their order, joint by joint.
module comparison
   use channel_noise, only: noise_of_channels
   use channel_spec, only: spec_t
   use differences_of_series, only: compare_values, difference_t, find_peak
   use errors, only: error_t, exit_usage, set_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use name_table, only: name_table_t
   use series, only: enter_names, history_t, impact_t, series_t
   use series_at_output_times, only: smooth_at, state_at, unwind
   use text, only: starts_with, text_t, to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: compare_histories, comparison_t, pair_t

   !> Impacts of both, in pairs.
   type :: pair_t
      character(:), allocatable :: item       !! joint, and label of the contact
      integer :: number = 0                   !! in the order of the joint's impacts
      type(impact_t) :: a                     !! of the first
      type(impact_t) :: b                     !! of the second
   end type pair_t

   !> Everything that was found.
   type :: comparison_t
      type(difference_t), allocatable :: list(:)        !! (channels)
      type(pair_t), allocatable :: pairs(:)             !! (n) first impacts
      real(wp), allocatable :: t(:)                     !! (m) instants compared [s]
      real(wp), allocatable :: a(:, :)                  !! (m, channels) the first [any]
      real(wp), allocatable :: b(:, :)                  !! (m, channels) the second [any]
      real(wp), allocatable :: d(:, :)                  !! (m, channels) the second less the first; NaN: not compared [any]
      logical :: by_statistics = .false.                !! how it was judged
      integer :: n_different = 0                        !! channels that differ
      type(text_t), allocatable :: missing(:)           !! (k) channels that only one of them has
   end type comparison_t

   integer, parameter :: first_impacts = 10   !! of each joint

contains

   !> Compare two histories.
   !> Length: instants, channels and verdict are found in one pass.
   subroutine compare_histories(a, b, specs, absolute, relative, by_statistics, found, error)
      type(history_t), intent(in) :: a                      !! the first
      type(history_t), intent(in) :: b                      !! the second
      type(spec_t), intent(in) :: specs(:)                  !! (n) channels that are asked for; none: all
      real(wp), intent(in) :: absolute                      !! difference allowed [any]
      real(wp), intent(in) :: relative                      !! the same, of the maximum magnitude [1]
      logical, intent(in) :: by_statistics                  !! how to judge
      type(comparison_t), intent(out) :: found              !! what was found
      type(error_t), allocatable, intent(out) :: error      !! nothing to compare

      real(wp), allocatable :: noise(:), own(:)
      logical, allocatable :: is_inside(:)
      type(difference_t), allocatable :: list(:)
      type(name_table_t) :: in_a, in_b
      type(text_list_t) :: missing
      integer :: i, k, n, s

      found%by_statistics = by_statistics
      allocate (found%list(0), found%missing(0))
      own = pack(a%time, a%is_output)
      if (size(own) < 2 .or. count(b%is_output) < 1) then
         call set_error(error, exit_usage, "too few common times to compare: "//to_text(size(own))//" and "// &
                        to_text(count(b%is_output)))
         return
      end if
      is_inside = b%is_output .and. b%time >= own(1) - 1.0e-9_wp*(own(size(own)) - own(1)) .and. &
                  b%time <= own(size(own)) + 1.0e-9_wp*(own(size(own)) - own(1))
      found%t = pack(b%time, is_inside)
      if (size(found%t) == 0) then
         call set_error(error, exit_usage, "the times do not overlap: shift or scale them with --time")
         return
      end if
      allocate (found%a(size(found%t), size(b%list)), found%b(size(found%t), size(b%list)), found%d(size(found%t), size(b%list)))
      call enter_names(a%list, in_a)
      call enter_names(b%list, in_b)
      allocate (list(size(b%list)))
      noise = noise_of(a, own(size(own)) - own(1))
      n = 0
      do k = 1, size(b%list)
         i = in_a%find(b%list(k)%name)
         s = spec_of(specs, b%list(k)%name)
         if (size(specs) > 0 .and. s == 0) cycle
         if (i == 0) then
            call missing%add(b%list(k)%name//" is in "//b%path//" only")
            cycle
         end if
         n = n + 1
         found%b(:, n) = pack(b%list(k)%x, is_inside)
         call compare_channel(a, a%list(i), turn_of(specs, s, a%list(i)), found%t, found%a(:, n), found%b(:, n), found%d(:, n), &
                              list(n))
         call peak_of(a, a%list(i), found%t(1), found%t(size(found%t)), list(n)%peak(1), list(n)%peak_at(1))
         call peak_of(b, b%list(k), found%t(1), found%t(size(found%t)), list(n)%peak(2), list(n)%peak_at(2))
         list(n)%noise = noise(i)
         call judge(list(n), allowance(specs, s, absolute, .true.), allowance(specs, s, relative, .false.), by_statistics, &
                    size(b%list))
      end do
      found%list = list(:n)
      do i = 1, size(a%list)
         if (in_b%find(a%list(i)%name) > 0 .or. size(specs) > 0) cycle
         call missing%add(a%list(i)%name//" is in "//a%path//" only")
      end do
      found%missing = missing%get()
      found%n_different = count(found%list%is_different)
      if (size(found%list) == 0) call set_error(error, exit_usage, "the two have no common channel")
      call pair_impacts(a, b, found)
   end subroutine compare_histories

   !> Bring a channel of the first to the instants of the second, and compare them.
   subroutine compare_channel(run, channel, turn, t, a, b, d, difference)
      type(history_t), intent(in) :: run                 !! the first
      type(series_t), intent(in) :: channel              !! its channel
      real(wp), intent(in) :: turn                       !! differences are up to multiples of it; 0: not [any]
      real(wp), intent(in) :: t(:)                       !! (n) instants of the second, at least one [s]
      real(wp), intent(out) :: a(:)                      !! (n) the first there [any]
      real(wp), intent(inout) :: b(:)                    !! (n) the second; brought next to the first where it counts turns [any]
      real(wp), intent(out) :: d(:)                      !! (n) the second less the first; NaN where they are not compared [any]
      type(difference_t), intent(out) :: difference      !! set, but for the verdict

      real(wp) :: time(count(run%is_output)), x(count(run%is_output))
      logical :: is_settled(size(t))

      difference%name = channel%name
      difference%unit = channel%unit
      time = pack(run%time, run%is_output)
      x = pack(channel%x, run%is_output)
      if (channel%is_state) then
         call state_at(run%time, channel%x, t, a, is_settled)
      else
         if (turn > 0.0_wp) call unwind(x, turn)
         call smooth_at(time, x, t, a, is_settled, difference%interpolation)
      end if
      call compare_values(t, a, b, is_settled, turn, d, difference)
   end subroutine compare_channel

   !> What is round-off in the channels of a run.
   function noise_of(run, duration) result(noise)
      type(history_t), intent(in) :: run         !! the run
      real(wp), intent(in) :: duration           !! its time [s]
      real(wp) :: noise(size(run%list))          !! (channels) [any]

      type(text_t) :: units(size(run%list))
      real(wp) :: maximum(size(run%list))
      integer :: k

      do k = 1, size(run%list)
         units(k)%s = run%list(k)%unit
         maximum(k) = maxval(abs(run%list(k)%x), mask=ieee_is_finite(run%list(k)%x))
         if (allocated(run%list(k)%extreme)) maximum(k) = max(maximum(k), maxval(abs(run%list(k)%extreme)))
         maximum(k) = max(maximum(k), 0.0_wp)
      end do
      noise = noise_of_channels(units, maximum, duration)
   end function noise_of

   !> The maximum magnitude of a channel in the time of both: of all rows, those at contacts too, and of the extremes between them.
   pure subroutine peak_of(run, channel, from, until, peak, at)
      type(history_t), intent(in) :: run         !! a run, or columns
      type(series_t), intent(in) :: channel      !! its channel
      real(wp), intent(in) :: from               !! first instant of the second [s]
      real(wp), intent(in) :: until              !! last one [s]
      real(wp), intent(out) :: peak              !! the maximum magnitude; NaN: there is no number [any]
      real(wp), intent(out) :: at                !! its first instant; NaN: there is none [s]

      real(wp) :: begin, end
      logical :: is_inside(size(run%time))
      integer :: k

      begin = maxval(run%time, mask=run%is_output .and. run%time <= from)
      end = minval(run%time, mask=run%is_output .and. run%time >= until)
      is_inside = run%time >= begin .and. run%time <= end
      call find_peak(pack(run%time, is_inside), pack(channel%x, is_inside), peak, at)
      if (.not. allocated(channel%extreme)) return
      do k = 1, 2
         if (channel%extreme_at(k) < begin .or. channel%extreme_at(k) > end) cycle
         if (abs(channel%extreme(k)) <= peak) cycle
         peak = abs(channel%extreme(k))
         at = channel%extreme_at(k)
      end do
   end subroutine peak_of

   !> What differences of a channel are taken up to multiples of: as asked for, else as the run says; 0: they are not.
   pure real(wp) function turn_of(specs, s, channel) result(turn)
      type(spec_t), intent(in) :: specs(:)     !! (n) requests
      integer, intent(in) :: s                 !! number of the request; 0: none
      type(series_t), intent(in) :: channel    !! of the run

      turn = channel%turn
      if (s == 0) return
      if (specs(s)%modulo >= 0.0_wp) turn = specs(s)%modulo
   end function turn_of

   !> The request that a channel goes with; 0: none.
   pure integer function spec_of(specs, name) result(s)
      type(spec_t), intent(in) :: specs(:)   !! (n) requests
      character(*), intent(in) :: name       !! of the channel

      do s = 1, size(specs)
         if (specs(s)%channel == name .or. starts_with(name, specs(s)%channel//".")) return
      end do
      s = 0
   end function spec_of

   !> What a request allows, or all.
   pure real(wp) function allowance(specs, s, common, is_absolute) result(x)
      type(spec_t), intent(in) :: specs(:)     !! (n) requests
      integer, intent(in) :: s                 !! number of the request; 0: none
      real(wp), intent(in) :: common           !! of all [any]
      logical, intent(in) :: is_absolute       !! which of the two

      x = common
      if (s == 0) return
      if (is_absolute .and. specs(s)%absolute >= 0.0_wp) x = specs(s)%absolute
      if (.not. is_absolute .and. specs(s)%relative >= 0.0_wp) x = specs(s)%relative
   end function allowance

   !> The verdict on a channel.
   subroutine judge(difference, absolute, relative, by_statistics, n_channel)
      type(difference_t), intent(inout) :: difference   !! compared
      real(wp), intent(in) :: absolute                  !! allowed [any]
      real(wp), intent(in) :: relative                  !! allowed [1]
      logical, intent(in) :: by_statistics              !! how
      integer, intent(in) :: n_channel                  !! channels that are judged

      real(wp), parameter :: level = 0.05_wp   ! significance of all together [1]

      associate (d => difference)
         d%allowed = absolute
         if (max(absolute, relative) > 0.0_wp) d%allowed = max(absolute, d%noise)  ! none: bit for bit
         if (ieee_is_finite(d%peak(1))) d%allowed = max(d%allowed, relative*d%peak(1))
         d%is_different = d%n == 0 .and. sum(d%only) + d%unsettled > 0
         if (d%n == 0) return
         d%is_different = any(d%only > 0) .or. d%maximum > d%allowed
         if (.not. by_statistics) return
         d%is_different = (abs(d%mean%a%value - d%mean%b%value) > d%allowed .and. .not. is_chance(d%mean%significance)) .or. &
                          (abs(d%square%a%value - d%square%b%value) > d%allowed*maxval(d%peak) .and. &
                           .not. is_chance(d%square%significance))
      end associate

   contains

      !> Whether a difference may be chance; one of which that is not known is none.
      pure logical function is_chance(significance)
         real(wp), intent(in) :: significance   !! probability of such a difference by chance; NaN: not known [1]

         is_chance = .false.
         if (ieee_is_finite(significance)) is_chance = significance*real(n_channel, wp) >= level
      end function is_chance

   end subroutine judge

   !> The first impacts of each joint, in pairs.
   subroutine pair_impacts(a, b, found)
      type(history_t), intent(in) :: a             !! the first
      type(history_t), intent(in) :: b             !! the second
      type(comparison_t), intent(inout) :: found   !! with the pairs

      type(name_table_t) :: joints
      type(pair_t), allocatable :: pairs(:)
      integer, allocatable :: n_of_a(:), of_b(:, :)
      integer :: i, j, k, n

      allocate (n_of_a(size(b%impacts)), of_b(0:first_impacts, size(b%impacts)), source=0)
      call joints%start(size(b%impacts))
      n = 0
      do j = 1, size(b%impacts)
         call joints%enter(b%impacts(j)%item, n + 1, k)
         if (k == 0) n = n + 1
         if (k == 0) k = n
         if (of_b(0, k) == first_impacts) cycle
         of_b(0, k) = of_b(0, k) + 1
         of_b(of_b(0, k), k) = j
      end do
      allocate (pairs(min(size(a%impacts), first_impacts*n)))
      n = 0
      do i = 1, size(a%impacts)
         k = joints%find(a%impacts(i)%item)
         if (k == 0) cycle
         n_of_a(k) = n_of_a(k) + 1
         if (n_of_a(k) > of_b(0, k)) cycle
         n = n + 1
         pairs(n)%item = a%impacts(i)%item
         pairs(n)%number = n_of_a(k)
         pairs(n)%a = a%impacts(i)
         pairs(n)%b = b%impacts(of_b(n_of_a(k), k))
      end do
      found%pairs = pairs(:n)
   end subroutine pair_impacts

end module comparison
