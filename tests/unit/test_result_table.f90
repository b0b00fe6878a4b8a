!> A table of every type of column, as each writer writes it.
module test_result_table
   use check, only: check_equal, check_true, suite_t
   use csv_table, only: csv_text
   use errors, only: error_t
   use hdf5, only: h5fclose_f, hid_t
   use hdf5_calls, only: new_file, open_library
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use hdf5_table, only: write_table
   use json_table, only: put_facts, put_rows
   use json_text, only: json_object_t
   use kinds, only: i8, not_a_number, wp
   use output_scene, only: clean_scratch, scratch_directory
   use result_table, only: in_hdf5, in_text_files, result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: run_test_result_table

   character(*), parameter :: nl = new_line("a")

contains

   subroutine run_test_result_table(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("columns_have_their_types", columns_have_their_types)
      call suite%test("csv_has_a_line_for_each_row", csv_has_a_line_for_each_row)
      call suite%test("json_has_an_object_for_each_row", json_has_an_object_for_each_row)
      call suite%test("hdf5_has_a_dataset_for_each_column", hdf5_has_a_dataset_for_each_column)
      call suite%test("a_table_without_rows", a_table_without_rows)
   end subroutine run_test_result_table

   !> A table of two rows.
   subroutine make_table(table)
      type(result_table_t), intent(out) :: table  !! the table

      type(text_t) :: names(2), parts(2)

      names(1)%s = "pin, upper"
      names(2)%s = "a ""slot"""
      parts(1)%s = "force_x"
      parts(2)%s = "force_y"
      call table%start("joints", "extremes/joints", 2)
      call table%fact("method", "radau")
      call table%fact("tolerance", 1.0e-6_wp)
      call table%fact("steps", 12)
      call table%fact("evaluations", 5000000000_i8)
      call table%fact("is_cut", .true., "cut")
      call table%fact("seconds", not_a_number(), formats=in_text_files)
      call table%put("joint", "1", "name of the joint", texts=names, dataset="name")
      call table%put("impacts", "1", "number of impacts", integers=[3, 0])
      call table%put("speed", "m/s", "impact speed; NaN: no impact", [0.5_wp, not_a_number()])
      call table%put("is_open", "1", "not in contact", logicals=[.false., .true.])
      call table%put("force", "N N.m", "maximum force and moment", [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], shape=[2], parts=parts)
      call table%put("ladder", "1", "number", integers=[1, 2], formats=in_hdf5)
      call table%put("state", "1", "in words", texts=names([2, 1]), formats=in_text_files)
   end subroutine make_table

   !> Columns and facts know type, unit, help and name in HDF5 files.
   subroutine columns_have_their_types(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(result_table_t) :: table

      call make_table(table)
      call check_equal(error, size(table%facts), 6, "facts")
      call check_equal(error, size(table%columns), 7, "columns")
      call check_equal(error, table%columns(1)%dataset, "name", "name in HDF5 files")
      call check_true(error, allocated(table%columns(3)%reals), "a column of reals")
      call check_true(error, allocated(table%facts(5)%logicals), "a logical fact")
      call check_equal(error, table%columns(3)%unit//": "//table%columns(3)%help, "m/s: impact speed; NaN: no impact", "help")
   end subroutine columns_have_their_types

   !> Quotes where they are needed, an empty cell for a missing value, a cell for each part.
   subroutine csv_has_a_line_for_each_row(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(result_table_t) :: table

      call make_table(table)
      call check_equal(error, csv_text(table), &
                       "joint,impacts,speed [m/s],is_open,force_x [N],force_y [N.m],state"//nl// &
                       """pin, upper"",3,0.5,0,1,2,""a """"slot"""""""//nl// &
                       """a """"slot"""""",0,,1,3,4,""pin, upper"""//nl, "text")
   end subroutine csv_has_a_line_for_each_row

   !> Facts are members, a missing value is null.
   subroutine json_has_an_object_for_each_row(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(json_object_t) :: all, first
      type(result_table_t) :: table

      call make_table(table)
      call all%start(0)
      call put_facts(all, table)
      call check_equal(error, all%get(), "{"//nl//"  ""method"": ""radau"","//nl//"  ""tolerance"": 1e-6,"//nl// &
                       "  ""steps"": 12,"//nl//"  ""evaluations"": 5000000000,"//nl//"  ""is_cut"": true,"//nl// &
                       "  ""seconds"": null"//nl//"}", "facts")
      call first%start(0)
      call put_rows(first, table, 1, most=1)
      call check_equal(error, first%get(), "{"//nl//"  ""joints"": [{"//nl//"    ""joint"": ""pin, upper"","//nl// &
                       "    ""impacts"": 3,"//nl//"    ""speed"": 0.5,"//nl//"    ""is_open"": false,"//nl// &
                       "    ""force_x"": 1,"//nl//"    ""force_y"": 2,"//nl//"    ""state"": ""a \""slot\"""""//nl// &
                       "  }]"//nl//"}", "the first row")
   end subroutine json_has_an_object_for_each_row

   !> What was written is read back; columns of other formats are not there.
   subroutine hdf5_has_a_dataset_for_each_column(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(result_table_t) :: table
      type(text_t), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      character(:), allocatable :: path
      integer(hid_t) :: file
      integer :: closed, status

      call make_table(table)
      path = scratch_directory("result_table")
      status = 0
      call open_library(status)
      call new_file(path//"/table.h5", file, status)
      call write_table(file, table, status)
      call check_equal(error, status, 0, "status of the writer")
      call read_texts(file, "extremes/joints/name", names, status)
      call check_equal(error, names(2)%s, "a ""slot""", "a text")
      call read_reals(file, "extremes/joints/force", values, status)
      call check_equal(error, size(values), 4, "values of a column with parts")
      call check_equal(error, nint(values(3)), 3, "the first part of the second row")
      call read_reals(file, "extremes/joints/is_open", values, status)
      call check_equal(error, nint(values(2)), 1, "a logical")
      call check_equal(error, status, 0, "status of the reader")
      call check_true(error, has_dataset(file, "extremes/joints", "ladder"), "a column of HDF5 files only")
      call check_true(error, .not. has_dataset(file, "extremes/joints", "state"), "a column of text files only")
      call h5fclose_f(file, closed)
      call clean_scratch(path)
   end subroutine hdf5_has_a_dataset_for_each_column

   !> No rows: a heading, an empty list.
   subroutine a_table_without_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(json_object_t) :: json
      type(result_table_t) :: table

      call table%start("joints", "joints", 0)
      call table%put("speed", "m/s", "impact speed", [real(wp) ::])
      call check_equal(error, csv_text(table), "speed [m/s]"//nl, "CSV")
      call json%start(0)
      call put_rows(json, table, 1)
      call check_equal(error, json%get(), "{"//nl//"  ""joints"": []"//nl//"}", "JSON")
   end subroutine a_table_without_rows

end module test_result_table
