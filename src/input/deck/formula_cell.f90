!> Cells that hold an expression over channels: compiled when it is known which channels there are.
module formula_cell
   use diagnostics, only: diagnostics_t
   use expression, only: expression_t
   use expression_compile, only: channel_finder_t, compile_expression, fault_t, symbols_t
   use item, only: location_t, value_t
   implicit none (type, external)
   private
   public :: compile_formula

contains

   !> Compile a cell, in braces or without.
   subroutine compile_formula(value, place, symbols, finder, compiled, is_good, mistakes)
      type(value_t), intent(in) :: value                 !! the cell
      character(*), intent(in) :: place                  !! as `in column value of request`
      type(symbols_t), intent(in) :: symbols             !! parameters, functions and states
      class(channel_finder_t), intent(in) :: finder      !! knows the channels
      type(expression_t), intent(out) :: compiled        !! the expression
      logical, intent(out) :: is_good                    !! .false.: an error was reported
      type(diagnostics_t), intent(inout) :: mistakes     !! errors found

      type(fault_t), allocatable :: fault
      type(location_t) :: at

      call compile_expression(value%text, symbols, .true., compiled, fault, finder=finder)
      is_good = .not. allocated(fault)
      if (is_good) return
      if (len(fault%message) == 0) return
      at = value%location
      if (at%last - at%first + 1 > len(value%text)) then  ! in braces
         at%first = value%location%first + fault%first
         at%last = value%location%first + fault%last
      end if
      call mistakes%add(at, "invalid expression "//place, fault%message, fault%help)
   end subroutine compile_formula

end module formula_cell
