!> Writes a table to an object of JSON: its facts as members, its rows as a list of objects.
module json_table
   use json_text, only: json_object_t
   use result_table, only: in_hdf5, result_column_t, result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: put_facts, put_rows

contains

   !> Add the facts of a table.
   subroutine put_facts(json, table)
      type(json_object_t), intent(inout) :: json       !! grown
      type(result_table_t), intent(in) :: table        !! the table

      integer :: k

      do k = 1, size(table%facts)
         call put_value(json, table%facts(k), 1)
      end do
   end subroutine put_facts

   !> Add the rows of a table, or the first of them, in a list of its name.
   subroutine put_rows(json, table, depth, most)
      type(json_object_t), intent(inout) :: json       !! grown
      type(result_table_t), intent(in) :: table        !! the table
      integer, intent(in) :: depth                     !! objects around a row
      integer, intent(in), optional :: most            !! at most so many rows

      type(text_t), allocatable :: objects(:)
      integer :: k, row

      allocate (objects(table%n))
      if (present(most)) objects = objects(:min(most, table%n))
      do row = 1, size(objects)
         block
            type(json_object_t) :: one

            call one%start(depth)
            do k = 1, size(table%columns)
               call put_value(one, table%columns(k), row)
            end do
            objects(row)%s = one%get()
         end block
      end do
      call json%put_objects(table%name, objects)
   end subroutine put_rows

   !> Add a value of a column; one with parts has a member for each.
   subroutine put_value(json, column, row)
      type(json_object_t), intent(inout) :: json       !! grown
      type(result_column_t), intent(in) :: column      !! the column
      integer, intent(in) :: row                       !! row of the value

      integer :: k

      if (column%formats == in_hdf5) return
      if (allocated(column%texts)) call json%put_text(column%name, column%texts(row)%s)
      if (allocated(column%integers)) call json%put_integer(column%name, column%integers(row))
      if (allocated(column%logicals)) call json%put_logical(column%name, column%logicals(row))
      if (allocated(column%parts)) then
         do k = 1, size(column%parts)
            call json%put_real(column%parts(k)%s, column%reals((row - 1)*size(column%parts) + k))
         end do
      else if (allocated(column%reals)) then
         call json%put_real(column%name, column%reals(row))
      end if
   end subroutine put_value

end module json_table
