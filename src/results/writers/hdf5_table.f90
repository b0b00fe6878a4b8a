!> Writes tables to an HDF5 file: their facts as attributes of their groups, their columns as datasets in these.
!>
!> Logicals are 0 and 1. The first column of a table is the dimension scale of its rows; a further dimension of a
!> column has /GROUP/COLUMN_names of a table before, or /GROUP/part_M with the numbers 1 to M.
module hdf5_table
   use hdf5, only: h5gclose_f, h5gopen_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use hdf5_scales, only: add_scale, close_scales, has_scale, scales_t, take_scales_of_path
   use kinds, only: i8, wp
   use result_table, only: in_hdf5, result_column_t, result_table_t
   use text, only: join, to_text
   implicit none (type, external)
   private
   public :: bytes_of_table, write_tables

   integer, parameter :: longest_path = 128         !! characters of the path of a scale
   integer(i8), parameter :: bytes_of_row = 512_i8  !! of names, a unit and a dozen numbers, at most

contains

   !> Bytes that the rows of a table take in a file at most.
   elemental integer(i8) function bytes_of_table(table) result(bytes)
      type(result_table_t), intent(in) :: table     !! the table

      bytes = 0
      if (table%group /= "") bytes = bytes_of_row*table%n
   end function bytes_of_table

   !> Write tables. Those of one group are written together.
   subroutine write_tables(file, tables, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(result_table_t), intent(in) :: tables(:) !! (n) the tables
      integer, intent(inout) :: status              !! negative: failed

      type(scales_t) :: scales
      integer :: k

      do k = 1, size(tables)
         call write_table(file, tables(k), scales, status)
      end do
      call close_scales(scales, file, status)
   end subroutine write_tables

   !> Write a table.
   subroutine write_table(file, table, scales, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(result_table_t), intent(in) :: table     !! the table
      type(scales_t), intent(inout) :: scales       !! those of the tables before, then of this one too
      integer, intent(inout) :: status              !! negative: failed

      character(:), allocatable :: rows
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
      rows = ""
      do k = 1, size(table%columns)
         call write_column(file, table, table%columns(k), rows, scales, status)
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
   subroutine write_column(file, table, column, rows, scales, status)
      integer(hid_t), intent(in) :: file                  !! the file
      type(result_table_t), intent(in) :: table           !! the table
      type(result_column_t), intent(in) :: column         !! the column
      character(:), allocatable, intent(inout) :: rows    !! path of the scale of the rows; blank: this column becomes it
      type(scales_t), intent(inout) :: scales             !! scales of the file
      integer, intent(inout) :: status                    !! negative: failed

      character(:), allocatable :: dimensions(:)
      character(:), allocatable :: path, unit
      integer :: k

      if (iand(column%formats, in_hdf5) == 0) return
      path = table%group//"/"//column%dataset
      associate (n => [table%n])
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
      if (rows == "" .and. size(column%shape) == 0) then
         rows = path
         call add_scale(scales, file, path, status)
         return
      end if
      if (rows == "") rows = scale_of_numbers(file, table%group, table%n, scales, status)
      allocate (character(longest_path) :: dimensions(1 + size(column%shape)))
      dimensions(1) = rows
      do k = 1, size(column%shape)
         associate (dimension => dimensions(2 + size(column%shape) - k))
            if (has_scale(scales, path//"_names")) then
               dimension = path//"_names"
            else
               dimension = scale_of_numbers(file, table%group, column%shape(k), scales, status)
            end if
         end associate
      end do
      call take_scales_of_path(scales, file, path, dimensions, status)
   end subroutine write_column

   !> Path of the scale of so many numbered parts, made when it is first requested.
   function scale_of_numbers(file, group, n, scales, status) result(path)
      integer(hid_t), intent(in) :: file                  !! the file
      character(*), intent(in) :: group                   !! group of the table
      integer, intent(in) :: n                            !! parts
      type(scales_t), intent(inout) :: scales             !! gets it
      integer, intent(inout) :: status                    !! negative: failed
      character(:), allocatable :: path                   !! path in the file

      integer :: k

      path = group//"/part_"//to_text(n)
      if (has_scale(scales, path)) return
      call integer_dataset(file, path, [n], [(k, k=1, n)], "number of the part, from 1", status)
      call add_scale(scales, file, path, status)
   end function scale_of_numbers

end module hdf5_table
