!> Lists of result tables.
!>
!> An array constructor with the result of a function does not give back what that has allocated (gfortran 12 and 14): so lists are
!> made here, by arguments.
module table_list
   use result_table, only: result_table_t
   implicit none (type, external)
   private
   public :: append_tables, list_of

contains

   !> A list of one to five tables.
   function list_of(a, b, c, d, e) result(tables)
      type(result_table_t), intent(in) :: a              !! the first
      type(result_table_t), intent(in), optional :: b    !! the second
      type(result_table_t), intent(in), optional :: c    !! the third
      type(result_table_t), intent(in), optional :: d    !! the fourth
      type(result_table_t), intent(in), optional :: e    !! the fifth
      type(result_table_t), allocatable :: tables(:)     !! (those present) in this order

      allocate (tables(1 + count([present(b), present(c), present(d), present(e)])))
      tables(1) = a
      if (present(b)) tables(2) = b
      if (present(c)) tables(3) = c
      if (present(d)) tables(4) = d
      if (present(e)) tables(5) = e
   end function list_of

   !> Append tables to a list.
   subroutine append_tables(tables, more)
      type(result_table_t), allocatable, intent(inout) :: tables(:)   !! (n) the list, grown
      type(result_table_t), intent(in) :: more(:)                     !! (any) what is appended

      tables = [tables, more]
   end subroutine append_tables

end module table_list
