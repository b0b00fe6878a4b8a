!> Conditions on channels: `gudgeon.penetration > 0.1mm or slider.position.x < -5 mm`.
!>
!> A channel, a sign and a number with its unit, which may be a parameter in braces; `or` joins several, any of which
!> is enough. Whether the channel is there, and whether the unit is its own, is not known here.
module conditions
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use item, only: condition_t, value_t
   use number_cell, only: read_number
   use quantities, only: quantity_t
   use tokens, only: span, token_t
   implicit none (type, external)
   private
   public :: read_conditions

   character(*), parameter :: example = "as in: gudgeon.penetration > 0.1 mm or motor.moment < -2 kN.m"

contains

   !> Read all conditions of a key.
   subroutine read_conditions(deck, place, list, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in key stop of guards`
      type(token_t), intent(in) :: list(:)            !! (n) cells
      type(value_t), intent(inout) :: value           !! receives the conditions
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(condition_t) :: conditions(size(list))
      integer :: first, k, n

      n = 0
      first = 1
      do k = 1, size(list)
         if (k < size(list) .and. text_of(deck, list(k)) /= "or") cycle
         n = n + 1
         if (k == first .and. k < size(list)) then
            call mistakes%add(list(k)%location, "missing condition "//place, "no condition before this", example)
            return
         end if
         call read_condition(deck, place, list(first:merge(k, k - 1, k == size(list))), conditions(n), mistakes)
         first = k + 1
      end do
      value%conditions = conditions(:n)
   end subroutine read_conditions

   !> Read one condition.
   subroutine read_condition(deck, place, list, condition, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in key stop of guards`
      type(token_t), intent(in) :: list(:)            !! (n) its cells
      type(condition_t), intent(out) :: condition     !! the condition
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(quantity_t) :: quantity

      condition%channel = ""
      if (size(list) < 3) then
         call mistakes%add(span(list(1), list(size(list))), "invalid condition "//place, &
                           "expected a channel, > or <, and a number with its unit", example)
         return
      end if
      condition%channel = text_of(deck, list(1))
      condition%location = list(1)%location
      select case (text_of(deck, list(2)))
      case (">")
         condition%is_above = .true.
      case ("<")
         condition%is_above = .false.
      case default
         call mistakes%add(list(2)%location, "'"//text_of(deck, list(2))//"' is not a comparison "//place, &
                           "use > or < between blanks", example)
         return
      end select
      call read_number(deck, list(3:), place, quantity, mistakes)
      if (.not. quantity%is_good) return
      condition%limit = quantity%x
      condition%dimension = quantity%dimension
      condition%limit_location = span(list(3), list(size(list)))
   end subroutine read_condition

end module conditions
