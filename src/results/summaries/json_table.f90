!> Writes tables to an object of JSON: facts as members, rows as members or as a list of objects.
module json_table
   use json_text, only: json_object_t
   use result_table, only: as_members, in_json, result_column_t, result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: put_tables

contains

   !> Add tables; those that follow each other with the same `object` share it.
   subroutine put_tables(json, tables)
      type(json_object_t), intent(inout) :: json       !! grown
      type(result_table_t), intent(in) :: tables(:)    !! (any) the tables

      integer :: first, k, last

      first = 1
      do while (first <= size(tables))
         last = first
         if (tables(first)%object == "") then
            call put_table(json, tables(first), 0)
         else
            block
               type(json_object_t) :: inner

               do while (last < size(tables))
                  if (tables(last + 1)%object /= tables(first)%object) exit
                  last = last + 1
               end do
               call inner%start(1)
               do k = first, last
                  call put_table(inner, tables(k), 1)
               end do
               call json%put_object(tables(first)%object, inner%get())
            end block
         end if
         first = last + 1
      end do
   end subroutine put_tables

   !> Add the facts of a table, and its rows: as members, or in a list of its name.
   subroutine put_table(json, table, depth)
      type(json_object_t), intent(inout) :: json       !! grown
      type(result_table_t), intent(in) :: table        !! the table
      integer, intent(in) :: depth                     !! objects around this one

      type(text_t), allocatable :: objects(:)
      integer :: k, row

      do k = 1, size(table%facts)
         if (iand(table%facts(k)%formats, in_json) /= 0) call put_value(json, table%facts(k)%name, table%facts(k), 1)
      end do
      do k = 1, size(table%columns)
         if (iand(table%columns(k)%formats, as_members) == 0) cycle
         do row = 1, table%n
            call put_value(json, table%columns(1)%texts(row)%s, table%columns(k), row)
         end do
      end do
      if (all(iand(table%columns%formats, in_json) == 0)) return
      allocate (objects(min(table%n, table%most_in_json)))
      do row = 1, size(objects)
         block
            type(json_object_t) :: one

            call one%start(depth + 1)
            do k = 1, size(table%columns)
               associate (column => table%columns(k))
                  if (iand(column%formats, in_json) /= 0) call put_value(one, column%name, column, row)
               end associate
            end do
            objects(row)%s = one%get()
         end block
      end do
      call json%put_objects(table%name, objects)
   end subroutine put_table

   !> Add a value of a column; one with parts has a member for each.
   subroutine put_value(json, name, column, row)
      type(json_object_t), intent(inout) :: json       !! grown
      character(*), intent(in) :: name                 !! of a value without parts
      type(result_column_t), intent(in) :: column      !! the column
      integer, intent(in) :: row                       !! row of the value

      integer :: k

      if (allocated(column%texts)) call json%put_text(name, column%texts(row)%s)
      if (allocated(column%integers)) call json%put_integer(name, column%integers(row))
      if (allocated(column%logicals)) call json%put_logical(name, column%logicals(row))
      if (allocated(column%parts)) then
         do k = 1, size(column%parts)
            call json%put_real(column%parts(k)%s, column%reals((row - 1)*size(column%parts) + k))
         end do
      else if (allocated(column%reals)) then
         call json%put_real(name, column%reals(row))
      end if
   end subroutine put_value

end module json_table
