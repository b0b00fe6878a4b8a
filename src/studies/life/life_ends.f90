!> Where a life ends: the first of its limits that is reached, located within a jump.
!>
!> Within a jump volumes are quadratic in the cycles, extremes of channels linear. Depth and clearance do not fall.
module life_ends
   use kinds, only: wp
   use life_results, only: life_t
   use life_state, only: measure_depth, n_measure
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: approach, find_end, is_beyond, part_done, rate_of_end

   integer, parameter :: halvings = 60             !! of a jump
   real(wp), parameter :: beyond = 1.1_wp          !! times the cycles in which a limit would be reached at the present rate [1]
   real(wp), parameter :: most_cycles = 1.0e18_wp  !! that are looked ahead [1]
   real(wp), parameter :: close_to = 1.0e-12_wp    !! part of the cycles at the end that may lack [1]

contains

   !> How far beyond its limits a motion is, relative to them: positive beyond; and which limit it is.
   subroutine excess_of(life, x, values, excess, limit)
      type(life_t), intent(in) :: life          !! the life
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]
      real(wp), intent(in) :: values(:)         !! (conditions) extremes of channels [any]
      real(wp), intent(out) :: excess           !! maximum over the limits [1]
      integer, intent(out) :: limit             !! 1 depth, 2 clearance, 2 + k condition k

      real(wp) :: measures(n_measure, size(life%state%surfaces)), one
      integer :: k

      excess = -huge(1.0_wp)
      limit = 1
      associate (ends => life%plan%ends)
         if (ends%depth < huge(1.0_wp)) then
            measures = life%state%measures(x)
            call take(maxval(measures(measure_depth, :))/ends%depth - 1.0_wp, 1)
         end if
         if (ends%clearance < huge(1.0_wp)) then
            call take(maxval(life%plan%clearances + life%state%added_clearance(x))/ends%clearance - 1.0_wp, 2)
         end if
         do k = 1, size(ends%extremes)
            one = values(k) - ends%extremes(k)%limit
            if (.not. ends%extremes(k)%is_above) one = -one
            call take(one/max(abs(ends%extremes(k)%limit), tiny(1.0_wp)**0.25_wp), 2 + k)
         end do
      end associate

   contains

      !> Note a limit.
      subroutine take(value, number)
         real(wp), intent(in) :: value       !! how far beyond [1]
         integer, intent(in) :: number       !! of the limit

         if (.not. value > excess) return
         excess = value
         limit = number
      end subroutine take

   end subroutine excess_of

   !> Whether a limit is reached.
   logical function is_beyond(life, x, values)
      type(life_t), intent(in) :: life          !! the life
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]
      real(wp), intent(in) :: values(:)         !! (conditions) extremes of channels [any]

      real(wp) :: excess
      integer :: limit

      call excess_of(life, x, values, excess, limit)
      is_beyond = excess >= 0.0_wp
   end function is_beyond

   !> Look for an end within the jump from the last node; without `cycles`, at the start. If there is one the reason is set.
   subroutine find_end(life, x, values, cycles)
      type(life_t), intent(inout) :: life                !! the life; reason, and at the start the last node, are set
      real(wp), intent(in) :: x(:)                       !! (n) at the last node [m^3, m]
      real(wp), intent(in) :: values(:)                  !! (conditions) extremes at the end of the jump [any]
      real(wp), intent(inout), optional :: cycles        !! of the jump; to the end if there is one [1]

      real(wp) :: excess, left, middle, right
      integer :: k, limit

      if (.not. present(cycles)) then
         call excess_of(life, x, values, excess, limit)
         life%reason = words_of(life, limit)//", at the start"
         life%ends_by_cycles = .false.
         life%last = 1
         return
      end if
      associate (node => life%nodes(life%n))
         right = cycles
         call look(right)
         if (excess >= 0.0_wp) then
            left = 0.0_wp
            do k = 1, halvings
               middle = 0.5_wp*(left + right)
               call look(middle)
               if (excess >= 0.0_wp) then
                  right = middle
               else
                  left = middle
               end if
            end do
            call look(right)
            life%reason = words_of(life, limit)
            life%ends_by_cycles = .false.
            cycles = right
         else if (node%cycles + cycles >= life%plan%ends%cycles*(1.0_wp - close_to)) then
            life%reason = "number of cycles"
         end if
      end associate

   contains

      !> How far beyond the limits it is after a part of the jump.
      subroutine look(part)
         real(wp), intent(in) :: part    !! cycles [1]

         associate (node => life%nodes(life%n))
            call excess_of(life, x + part*node%rates(:, 1) + (0.5_wp*part**2/node%jump)*(node%rates(:, 2) - node%rates(:, 1)), &
                           node%values + (part/node%jump)*(values - node%values), excess, limit)
         end associate
      end subroutine look

   end subroutine find_end

   !> A limit as text.
   function words_of(life, limit) result(words)
      type(life_t), intent(in) :: life         !! the life
      integer, intent(in) :: limit             !! number of the limit
      character(:), allocatable :: words       !! as `depth 1e-4 m`

      associate (ends => life%plan%ends)
         select case (limit)
         case (1); words = "depth "//real_text(ends%depth, 6)//" m"
         case (2); words = "clearance "//real_text(ends%clearance, 6)//" m"
         case default; words = ends%extremes(limit - 2)%words
         end select
      end associate
   end function words_of

   !> Cycles in which depth or clearance would reach their limits at the present rates, and some more.
   real(wp) function approach(life, x, rates) result(cycles)
      type(life_t), intent(in) :: life         !! the life
      real(wp), intent(in) :: x(:)             !! (n) volumes and distances [m^3, m]
      real(wp), intent(in) :: rates(:)         !! (n) per cycle [m^3, m]

      real(wp) :: left, middle
      integer :: k

      cycles = 1.0_wp
      do while (.not. is_reached(cycles))
         cycles = 2.0_wp*cycles
         if (cycles > most_cycles) then
            cycles = huge(1.0_wp)
            return
         end if
      end do
      left = 0.0_wp
      do k = 1, halvings
         middle = 0.5_wp*(left + cycles)
         if (is_reached(middle)) then
            cycles = middle
         else
            left = middle
         end if
      end do
      cycles = beyond*cycles

   contains

      !> Whether depth or clearance has reached its limit.
      logical function is_reached(part)
         real(wp), intent(in) :: part   !! cycles from now [1]

         real(wp) :: measures(n_measure, size(life%state%surfaces))

         associate (ends => life%plan%ends, changed => x + part*rates)
            measures = life%state%measures(changed)
            is_reached = maxval(measures(measure_depth, :)) >= ends%depth
            if (ends%clearance >= huge(1.0_wp)) return
            is_reached = is_reached .or. maxval(life%plan%clearances + life%state%added_clearance(changed)) >= ends%clearance
         end associate
      end function is_reached

   end function approach

   !> How fast the depth or the clearance that ended a life grows there, and half of the 95 % interval of it: NaN for other ends.
   subroutine rate_of_end(life, rate, half)
      type(life_t), intent(in) :: life         !! the life, ended
      real(wp), intent(out) :: rate            !! per cycle [m]
      real(wp), intent(out) :: half            !! of the depth or the clearance [m]

      real(wp), allocatable :: halves(:, :), measures(:, :), before(:, :)
      real(wp) :: excess
      integer :: k, limit

      rate = 0.0_wp
      half = 0.0_wp
      if (life%last < 2) return
      associate (node => life%nodes(life%last), last => life%nodes(life%last - 1))
         call excess_of(life, node%x, node%values, excess, limit)
         halves = node%half()
         measures = node%measures
         before = life%state%measures(node%x - 1.0e-3_wp*(node%cycles - last%cycles)*slope())
         before = (measures - before)/(1.0e-3_wp*(node%cycles - last%cycles))
         select case (limit)
         case (1)
            k = maxloc(measures(measure_depth, :), dim=1)
            rate = before(measure_depth, k)
            half = halves(measure_depth, k)
         case (2)
            k = maxloc(life%plan%clearances + measures(measure_depth, 1::2) + measures(measure_depth, 2::2), dim=1)
            rate = sum(before(measure_depth, 2*k - 1:2*k))
            half = sum(halves(measure_depth, 2*k - 1:2*k))
         end select
      end associate

   contains

      !> Rates at the end.
      function slope() result(rates)
         real(wp), allocatable :: rates(:)   !! (n) per cycle [m^3, m]

         associate (last => life%nodes(life%last - 1))
            rates = last%rates(:, 2) - last%rates(:, 1)
            rates = last%rates(:, 1) + ((life%nodes(life%last)%cycles - last%cycles)/last%jump)*rates
         end associate
      end function slope

   end subroutine rate_of_end

   !> How far the life is, by the nearest limit.
   real(wp) function part_done(life, cycles, x)
      type(life_t), intent(in) :: life          !! the life
      real(wp), intent(in) :: cycles            !! so far [1]
      real(wp), intent(in) :: x(:)              !! (n) volumes and distances [m^3, m]

      associate (ends => life%plan%ends)
         part_done = max(cycles/(ends%cycles*life%plan%stretch), life%state%max_depth(x)/ends%depth)
         if (ends%clearance < huge(1.0_wp)) then
            part_done = max(part_done, maxval(life%state%added_clearance(x)/(ends%clearance - life%plan%clearances)))
         end if
      end associate
   end function part_done

end module life_ends
