!> Writes a table to an HDF5 file: its facts as attributes of its group, its columns as datasets in it.
!>
!> Logicals are 0 and 1.
module hdf5_table
   use hdf5, only: h5gclose_f, h5gopen_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use kinds, only: i8, wp
   use result_table, only: in_hdf5, result_column_t, result_table_t
   use text, only: join
   implicit none (type, external)
   private
   public :: bytes_of_table, write_table

   integer(i8), parameter :: bytes_of_row = 512_i8  !! of names, a unit and a dozen numbers, at most

contains

   !> Bytes that the rows of a table take in a file at most.
   elemental integer(i8) function bytes_of_table(table) result(bytes)
      type(result_table_t), intent(in) :: table     !! the table

      bytes = 0
      if (table%group /= "") bytes = bytes_of_row*table%n
   end function bytes_of_table

   !> Write a table.
   subroutine write_table(file, table, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(result_table_t), intent(in) :: table     !! the table
      integer, intent(inout) :: status              !! negative: failed

      integer(hid_t) :: group
      integer :: closed, k

      if (status < 0 .or. table%group == "") return
      if (size(table%facts) > 0) then
         call h5gopen_f(file, table%group, group, status)
         if (status < 0) then
            status = 0
            call new_group(file, table%group, group, status)
         end if
         if (status < 0) return
         do k = 1, size(table%facts)
            call write_fact(group, table%facts(k), status)
         end do
         call h5gclose_f(group, closed)
      end if
      do k = 1, size(table%columns)
         call write_column(file, table, table%columns(k), status)
      end do
   end subroutine write_table

   !> Write a fact as an attribute.
   subroutine write_fact(group, fact, status)
      integer(hid_t), intent(in) :: group           !! the group of the table
      type(result_column_t), intent(in) :: fact     !! the fact
      integer, intent(inout) :: status              !! negative: failed

      if (iand(fact%formats, in_hdf5) == 0) return
      if (allocated(fact%texts)) call text_attribute(group, fact%dataset, fact%texts(1)%s, status)
      if (allocated(fact%reals)) call real_attribute(group, fact%dataset, fact%reals(1), status)
      if (allocated(fact%integers)) call long_attribute(group, fact%dataset, fact%integers(1), status)
      if (allocated(fact%logicals)) call long_attribute(group, fact%dataset, merge(1_i8, 0_i8, fact%logicals(1)), status)
   end subroutine write_fact

   !> Write a column as a dataset.
   subroutine write_column(file, table, column, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(result_table_t), intent(in) :: table     !! the table
      type(result_column_t), intent(in) :: column   !! the column
      integer, intent(inout) :: status              !! negative: failed

      character(:), allocatable :: unit

      if (iand(column%formats, in_hdf5) == 0) return
      associate (path => table%group//"/"//column%dataset, n => [table%n])
         if (allocated(column%texts)) call text_dataset(file, path, column%texts, .false., column%help, status)
         if (allocated(column%reals)) then
            unit = column%unit
            if (unit == "rows") unit = join(table%units, " ")
            call real_dataset(file, path, [column%shape, n], column%reals, unit, column%help, status)
         else if (column%is_count) then
            call real_dataset(file, path, n, real(column%integers, wp), column%unit, column%help, status)
         else if (allocated(column%integers)) then
            call integer_dataset(file, path, [column%shape, n], int(column%integers), column%help, status)
         else if (allocated(column%logicals)) then
            call integer_dataset(file, path, n, merge(1, 0, column%logicals), column%help, status)
         end if
      end associate
   end subroutine write_column

end module hdf5_table
