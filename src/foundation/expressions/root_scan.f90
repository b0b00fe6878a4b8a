!> The places where a function of one variable changes its branch, one after the other from the left.
!>
!> An interval is dropped if bounds of the function exclude a change; it is monotone, or has one extremum, if bounds of the
!> derivatives say so, and then signs at its ends report; else it is halved. A place is halved down to two neighbouring numbers
!> on which the function has both signs. Intervals to be looked at are a stack, so that places are found as they
!> are asked for: thousands of them cost no memory.
!>
!> Source: E. Hansen, Global optimization using interval analysis (1992), chapter 7. Limits: intervals in which neither bounds nor
!> signs decide because the function is round-off there are left as they are, the longer the more of them follow one another.
module root_scan
   use expression, only: expression_t
   use expression_bounds, only: bound_expression
   use expression_switches, only: switch_t
   use intervals, only: holds_zero, times
   use kinds, only: eps, wp
   implicit none (type, external)
   private
   public :: new_root_scan, place_t, root_scan_t

   integer, parameter :: deepest = 80               !! intervals on the stack
   integer, parameter :: patience = 20              !! undecided intervals before they may be longer
   real(wp), parameter :: minimum = 1.0e-18_wp        !! shortest interval, of the range [1]
   real(wp), parameter :: touching = 1.0e-11_wp     !! of the function's size at the ends: counts as zero [1]

   !> A place between two neighbouring numbers.
   type :: place_t
      real(wp) :: low = huge(1.0_wp)   !! last number before it [any]
      real(wp) :: at = huge(1.0_wp)    !! that of the two at which the function is nearer to zero [any]
      real(wp) :: high = huge(1.0_wp)  !! first number behind it [any]
   end type place_t

   !> A search.
   type :: root_scan_t
      type(switch_t) :: switch                  !! the function
      real(wp) :: left = 0.0_wp                 !! where the intervals start that are left [any]
      real(wp) :: right(deepest) = 0.0_wp       !! (deepest) their ends, the first one on top [any]
      integer :: depth = 0                      !! how many
      integer :: n_undecided = 0                !! intervals left undecided one after the other
      real(wp) :: shortest = 0.0_wp             !! shortest interval [any]
      type(place_t) :: found(2)                 !! places found and not yet given out
      integer :: n_found = 0                    !! how many
   contains
      procedure :: next => root_scan_next
   end type root_scan_t

contains

   !> Start a search over a range.
   subroutine new_root_scan(switch, first, last, scan)
      type(switch_t), intent(in) :: switch      !! the function
      real(wp), intent(in) :: first             !! start of the range [any]
      real(wp), intent(in) :: last              !! its end [any]
      type(root_scan_t), intent(out) :: scan    !! the search

      scan%switch = switch
      scan%left = first
      scan%right(1) = last
      scan%depth = 1
      scan%shortest = minimum*(last - first)
   end subroutine new_root_scan

   !> The next place; beyond all numbers if there is none.
   subroutine root_scan_next(self, place)
      class(root_scan_t), intent(inout) :: self  !! the search
      type(place_t), intent(out) :: place        !! the place

      do while (self%n_found == 0 .and. self%depth > 0)
         call look(self)
      end do
      if (self%n_found == 0) return
      place = self%found(1)
      self%found(1) = self%found(2)
      self%n_found = self%n_found - 1
   end subroutine root_scan_next

   !> Look at the first interval that is left.
   subroutine look(self)
      class(root_scan_t), intent(inout) :: self  !! the search

      real(wp) :: a, b, middle, turn_high, turn_low
      real(wp) :: bend(size(self%switch%g%code)), jet(2, 3), range(2, size(self%switch%g%code))

      a = self%left
      b = self%right(self%depth)
      associate (g => self%switch%g, touches => self%switch%touches)
         call bound_expression(g, [a, b], jet, range, bend)
         if (jet(2, 1) < 0.0_wp .or. jet(1, 1) > 0.0_wp .or. (jet(1, 1) >= 0.0_wp .and. .not. touches) &
             .or. (jet(2, 1) <= 0.0_wp .and. touches .and. .not. jet(2, 1) > jet(1, 1))) then
            call drop
         else if (.not. holds_zero(jet(:, 2))) then
            if (.not. touches) call look_for_change(g, a, b)
            call drop
         else if (.not. holds_zero(jet(:, 3))) then
            call find_turn(g, a, b, turn_low, turn_high)
            if (touches) then
               call look_for_touch(g, a, b, turn_low, turn_high)
            else
               call look_for_change(g, a, turn_low)
               if (self%n_found == 0) call look_for_change(g, turn_low, turn_high)
               call look_for_change(g, turn_high, b)
            end if
            call drop
         else
            middle = a + 0.5_wp*(b - a)
            if (self%depth == deepest .or. b - a <= max(self%shortest, 4.0_wp*eps*abs(b)) .or. middle <= a .or. middle >= b) then
               if (.not. touches) call look_for_change(g, a, b)
               self%n_undecided = self%n_undecided + 1
               if (self%n_undecided > patience) self%shortest = 2.0_wp*max(self%shortest, b - a)
               self%left = b
               self%depth = self%depth - 1
            else
               self%depth = self%depth + 1
               self%right(self%depth) = middle
            end if
         end if
      end associate

   contains

      !> The interval is done.
      subroutine drop()
         self%left = b
         self%depth = self%depth - 1
         self%n_undecided = 0
         self%shortest = minimum*abs(self%right(1))
      end subroutine drop

      !> A place between two numbers if the signs there differ.
      subroutine look_for_change(g, first, last)
         type(expression_t), intent(in) :: g  !! the function
         real(wp), intent(in) :: first        !! one number [any]
         real(wp), intent(in) :: last         !! a greater one [any]

         real(wp) :: high, low
         logical :: is_negative

         if (self%n_found == size(self%found) .or. .not. last > first) return
         is_negative = value_of(g, first) < 0.0_wp
         if (is_negative .eqv. value_of(g, last) < 0.0_wp) return
         low = first
         high = last
         call halve(g, 1, is_negative, low, high)
         call keep(place_t(low, merge(low, high, abs(value_of(g, low)) <= abs(value_of(g, high))), high))
      end subroutine look_for_change

      !> A place where the function touches zero, at its extremum or at an end of the interval.
      subroutine look_for_touch(g, first, last, turn_low, turn_high)
         type(expression_t), intent(in) :: g   !! the function
         real(wp), intent(in) :: first         !! start of the interval [any]
         real(wp), intent(in) :: last          !! its end [any]
         real(wp), intent(in) :: turn_low      !! last number before the extremum [any]
         real(wp), intent(in) :: turn_high     !! first number behind it [any]

         real(wp) :: size_of_all

         if (.not. turn_high > turn_low .or. turn_low < first .or. turn_high > last) return
         if (turn_low <= first .and. turn_high >= last) return
         size_of_all = max(abs(value_of(g, first)), abs(value_of(g, last)), abs(0.5_wp*sum(abs(jet(:, 1)))))
         if (min(abs(value_of(g, turn_low)), abs(value_of(g, turn_high))) > touching*size_of_all) return
         call keep(place_t(turn_low, turn_low, turn_high))
      end subroutine look_for_touch

      !> Keep a place that counts.
      subroutine keep(place)
         type(place_t), intent(in) :: place  !! the place

         if (allocated(self%switch%condition)) then
            if (.not. value_of(self%switch%condition, place%at) < 0.0_wp) return
         end if
         self%n_found = self%n_found + 1
         self%found(self%n_found) = place
      end subroutine keep

   end subroutine look

   !> The extremum of a function that has one at most, between two neighbouring numbers; the ends where it has none.
   subroutine find_turn(g, a, b, low, high)
      type(expression_t), intent(in) :: g  !! the function
      real(wp), intent(in) :: a            !! start of the interval [any]
      real(wp), intent(in) :: b            !! its end [any]
      real(wp), intent(out) :: low         !! last number before the extremum [any]
      real(wp), intent(out) :: high        !! first number behind it [any]

      logical :: falls

      low = a
      high = b
      falls = slope_of(g, a) < 0.0_wp
      if (falls .neqv. slope_of(g, b) < 0.0_wp) then
         call halve(g, 2, falls, low, high)
      else
         high = a
      end if
   end subroutine find_turn

   !> Halve between two numbers on which value or slope have different signs, down to neighbours.
   subroutine halve(g, which, is_negative, low, high)
      type(expression_t), intent(in) :: g     !! the function
      integer, intent(in) :: which            !! 1: value, 2: slope
      logical, intent(in) :: is_negative      !! whether it is negative at the lower number
      real(wp), intent(inout) :: low          !! the lower number [any]
      real(wp), intent(inout) :: high         !! the higher one [any]

      real(wp) :: jet(3), middle

      do
         middle = low + 0.5_wp*(high - low)
         if (middle <= low .or. middle >= high) return
         call g%evaluate(middle, jet(1), jet(2), jet(3))
         if (jet(which) < 0.0_wp .eqv. is_negative) then
            low = middle
         else
            high = middle
         end if
      end do
   end subroutine halve

   !> Value of a function.
   real(wp) function value_of(g, t)
      type(expression_t), intent(in) :: g  !! the function
      real(wp), intent(in) :: t            !! where [any]

      real(wp) :: d1, d2

      call g%evaluate(t, value_of, d1, d2)
   end function value_of

   !> Slope of a function.
   real(wp) function slope_of(g, t)
      type(expression_t), intent(in) :: g  !! the function
      real(wp), intent(in) :: t            !! where [any]

      real(wp) :: d2, value

      call g%evaluate(t, value, slope_of, d2)
   end function slope_of

end module root_scan
