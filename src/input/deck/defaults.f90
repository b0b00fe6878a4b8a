!> Values that the deck does not give: defaults, read as if they stood in the deck.
module defaults
   use cells, only: blank_value, read_value
   use deck_types, only: add_default, add_source, deck_t
   use diagnostics, only: diagnostics_t
   use item, only: value_t
   use kind_info, only: column_t
   use source_text, only: new_source, source_t
   use tokens, only: lex_line
   implicit none (type, external)
   private
   public :: read_default, remember_default

contains

   !> Read the default of a column; a blank one leaves the value empty.
   subroutine read_default(deck, kind, column, place, value, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck, whose sources receive the default
      character(*), intent(in) :: kind                !! name of the kind
      type(column_t), intent(in) :: column            !! with its default
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(value_t), intent(out) :: value             !! the value, marked as not given
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(source_t) :: source
      integer :: first, number
      logical :: is_good

      call blank_value(column, value)
      if (len_trim(column%default) == 0) return
      call new_source(source, "default of "//kind//" "//column%name, column%default)
      call add_source(deck, source, number)
      first = deck%tokens%n + 1
      call lex_line(deck%sources(number), number, 1, deck%tokens, mistakes, is_good)
      if (.not. is_good .or. deck%tokens%n < first) return
      call read_value(deck, column, place, deck%tokens%t(first:deck%tokens%n), value, mistakes)
      value%given = .false.
   end subroutine read_default

   !> Note for the record that a default was taken.
   subroutine remember_default(deck, kind, name, column)
      type(deck_t), intent(inout) :: deck   !! the deck
      character(*), intent(in) :: kind      !! name of the kind
      character(*), intent(in) :: name      !! of the item, empty for settings
      type(column_t), intent(in) :: column  !! with its default

      if (len_trim(column%default) == 0) return
      if (len(name) > 0) then
         call add_default(deck, kind//" "//name//" "//column%name//" = "//column%default)
      else
         call add_default(deck, kind//" "//column%name//" = "//column%default)
      end if
   end subroutine remember_default

end module defaults
