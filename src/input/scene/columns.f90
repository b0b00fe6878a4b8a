!> Columns of a kind, and cells of its rows, found by the names of the columns.
module columns
   use errors, only: exit_internal
   use, intrinsic :: iso_fortran_env, only: error_unit
   use item, only: item_t
   use kind_info, only: kind_info_t
   implicit none (type, external)
   private
   public :: cell_index, cell_text, column_of, find_column

contains

   !> Number of a column by its name; 0 if the kind has none of that name.
   pure integer function find_column(info, name)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! the column

      integer :: k

      find_column = 0
      if (.not. allocated(info%columns)) return
      do k = 1, size(info%columns)
         if (info%columns(k)%name /= name) cycle
         find_column = k
         return
      end do
   end function find_column

   !> Number of a column that the kind must have: if it has not, the program is wrong, and ends. What only some kinds have
   !> is asked for by `find_column`, `cell_text` or `cell_index`.
   integer function column_of(info, name)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! the column

      column_of = find_column(info, name)
      if (column_of > 0) return
      write (error_unit, "(a)") "error: internal error: "//info%name//" has no column '"//name//"'"
      error stop exit_internal, quiet = .true.
   end function column_of

   !> The word or name in a cell of a row; blank if the kind has no such column.
   pure function cell_text(info, item, name) result(word)
      type(kind_info_t), intent(in) :: info  !! the kind
      type(item_t), intent(in) :: item       !! the row
      character(*), intent(in) :: name       !! the column
      character(:), allocatable :: word      !! as in the deck

      integer :: c

      word = ""
      c = find_column(info, name)
      if (c == 0) return
      if (allocated(item%values(c)%text)) word = item%values(c)%text
   end function cell_text

   !> Number of the item that a cell of a row refers to; 0 if it refers to none, or the kind has no such column.
   pure integer function cell_index(info, item, name)
      type(kind_info_t), intent(in) :: info  !! the kind
      type(item_t), intent(in) :: item       !! the row
      character(*), intent(in) :: name       !! the column

      integer :: c

      cell_index = 0
      c = find_column(info, name)
      if (c > 0) cell_index = item%values(c)%index
   end function cell_index

end module columns
