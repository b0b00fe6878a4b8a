!> One number of a deck: bare, with its unit glued to it or beside it, or an expression in braces.
module number_cell
   use cell_checks, only: check_count
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use expression, only: expression_t
   use kind_info, only: dim_t
   use quantities, only: is_numeric, quantity_t, read_bare, read_brace, read_unit, report_not_a_number
   use tokens, only: token_brace, token_t, token_word
   use units, only: unit_t
   implicit none (type, external)
   private
   public :: read_number

contains

   !> One number, bare, with its unit glued or beside it, or in braces.
   subroutine read_number(deck, list, place, quantity, mistakes, header, wanted)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: list(:)            !! (n) number, and its unit if that stands apart
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(quantity_t), intent(out) :: quantity       !! the number
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: header    !! unit of bare numbers
      type(dim_t), intent(in), optional :: wanted     !! dimension of the place, for a unit that is suggested

      character(:), allocatable :: word
      type(expression_t) :: compiled
      type(unit_t) :: unit
      logical :: is_good

      if (list(1)%kind == token_brace) then
         call check_count(list, 1, place, mistakes, "the result of an expression in braces has its own unit")
         call read_brace(deck, list(1), place, .false., compiled, quantity, mistakes)
         return
      end if
      word = text_of(deck, list(1))
      if (list(1)%kind /= token_word .or. .not. is_numeric(word)) then
         call report_not_a_number(word, list(1)%location, place, mistakes, deck)
      else if (size(list) > 1) then
         call check_count(list, 2, place, mistakes)
         call read_unit(text_of(deck, list(2)), list(2)%location, place, unit, is_good, mistakes, wanted)
         if (is_good) call read_bare(word, list(1)%location, place, quantity, mistakes, unit)
      else
         call read_bare(word, list(1)%location, place, quantity, mistakes, header, wanted)
      end if
   end subroutine read_number

end module number_cell
