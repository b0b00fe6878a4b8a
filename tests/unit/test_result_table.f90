!> A table of every type of column, as each writer writes it.
module test_result_table
   use check, only: check_equal, check_true, suite_t
   use csv_table, only: csv_text
   use errors, only: error_t
   use hdf5, only: h5fclose_f, hid_t
   use hdf5_calls, only: new_file, open_library
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use hdf5_table, only: write_tables
   use html_table, only: add_section
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: i8, not_a_number, wp
   use output_scene, only: clean_scratch, scratch_directory
   use result_table, only: in_hdf5, in_text_files, only_shown, result_table_t
   use text, only: text_t
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
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
      call suite%test("tables_share_an_object", tables_share_an_object)
      call suite%test("text_has_the_columns_with_a_heading", text_has_the_columns_with_a_heading)
      call suite%test("html_has_units_that_read_well", html_has_units_that_read_well)
   end subroutine run_test_result_table

   !> A table of two rows.
   subroutine make_table(table)
      type(result_table_t), intent(out) :: table  !! the table

      type(text_t) :: names(2), parts(2), states(2)

      names(1)%s = "pin, upper"
      names(2)%s = "a ""slot"""
      parts(1)%s = "force_x"
      parts(2)%s = "force_y"
      states(1)%s = names(2)%s
      states(2)%s = names(1)%s
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
      call table%put("state", "1", "in words", texts=states, formats=in_text_files)
      call table%put("count", "1", "evaluations", counts=[5000000000_i8, 2_i8], formats=in_hdf5)
   end subroutine make_table

   !> Columns and facts know type, unit, help and name in HDF5 files.
   subroutine columns_have_their_types(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(result_table_t) :: table

      call make_table(table)
      call check_equal(error, size(table%facts), 6, "facts")
      call check_equal(error, size(table%columns), 8, "columns")
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

      type(json_object_t) :: all
      type(result_table_t) :: table

      call make_table(table)
      call all%start(0)
      table%most_in_json = 1
      call put_tables(all, [table])
      call check_equal(error, all%get(), "{"//nl//"  ""method"": ""radau"","//nl//"  ""tolerance"": 1e-6,"//nl// &
                       "  ""steps"": 12,"//nl//"  ""evaluations"": 5000000000,"//nl//"  ""is_cut"": true,"//nl// &
                       "  ""seconds"": null,"//nl//"  ""joints"": [{"//nl//"    ""joint"": ""pin, upper"","//nl// &
                       "    ""impacts"": 3,"//nl//"    ""speed"": 0.5,"//nl//"    ""is_open"": false,"//nl// &
                       "    ""force_x"": 1,"//nl//"    ""force_y"": 2,"//nl//"    ""state"": ""a \""slot\"""""//nl// &
                       "  }]"//nl//"}", "facts and the first row")
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
      call write_tables(file, [table], status)
      call check_equal(error, status, 0, "status of the writer")
      call read_texts(file, "extremes/joints/name", names, status)
      call check_equal(error, names(2)%s, "a ""slot""", "a text")
      call read_reals(file, "extremes/joints/force", values, status)
      call check_equal(error, size(values), 4, "values of a column with parts")
      call check_equal(error, nint(values(3)), 3, "the first part of the second row")
      call read_reals(file, "extremes/joints/is_open", values, status)
      call check_equal(error, nint(values(2)), 1, "a logical")
      call read_reals(file, "extremes/joints/count", values, status)
      call check_equal(error, nint(values(1)/1.0e6_wp), 5000, "a count beyond 32 bits")
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
      call put_tables(json, [table])
      call check_equal(error, json%get(), "{"//nl//"  ""joints"": []"//nl//"}", "JSON")
   end subroutine a_table_without_rows

   !> Tables with the same object are members of it.
   subroutine tables_share_an_object(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(json_object_t) :: json
      type(result_table_t) :: first, second

      call first%start("modes", "", 0, object="motion")
      call first%fact("judged", .true.)
      call second%start("onset", "", 0, object="motion")
      call second%fact("speed", 2.0_wp)
      call json%start(0)
      call put_tables(json, [first, second])
      call check_equal(error, json%get(), "{"//nl//"  ""motion"": {"//nl//"    ""judged"": true,"//nl//"    ""speed"": 2"//nl// &
                       "  }"//nl//"}", "JSON")
   end subroutine tables_share_an_object

   !> A table that people see: names with units, round-off as zero, a row that is of little interest.
   subroutine make_shown(table)
      type(result_table_t), intent(out) :: table  !! the table

      type(text_t) :: names(3)

      names(1)%s = "rod.angle"
      names(2)%s = "pin.x"
      names(3)%s = "pin.state"
      call table%start("channels", "", 3, title="values", elsewhere="run.h5")
      call table%put("channel", "1", "name", texts=names, heading="channel")
      call table%put("value", "list", "value", [2.5_wp, 1.0e-20_wp, 1.0_wp], heading="max")
      call table%put("hidden", "m", "not for people", [1.0_wp, 2.0_wp, 3.0_wp])
      call table%put("time", "s", "its time; NaN: none", [0.00125_wp, not_a_number(), 0.5_wp], heading="at", digits=3)
      call table%put("hits", "1", "contacts", integers=[7, 12, 0], formats=only_shown, heading="hits")
      table%units = names
      table%units(1)%s = "rad"
      table%units(2)%s = "m"
      table%units(3)%s = "1"
      table%noise = [0.0_wp, 1.0e-18_wp, 0.0_wp]
      table%is_minor = [.false., .false., .true.]
      table%left_out = 4
   end subroutine make_shown

   !> Columns are as wide as their longest cell; rows that are not shown are counted.
   subroutine text_has_the_columns_with_a_heading(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(buffer_t) :: lines
      type(result_table_t) :: table

      call make_shown(table)
      call add_table(lines, table)
      call check_equal(error, lines%get(), nl//"values                      max   at [s]  hits"//nl// &
                       "           rod.angle [rad]  2.5  0.00125     7"//nl// &
                       "           pin.x [m]          0        -    12"//nl//"           4 more in run.h5"//nl, "text")
   end subroutine text_has_the_columns_with_a_heading

   !> A unit for each row where they differ, one for a column where they do not.
   subroutine html_has_units_that_read_well(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(buffer_t) :: lines
      type(result_table_t) :: table

      call make_shown(table)
      table%columns(4)%reals(3) = 0.002_wp
      call add_section(lines, table)
      call check_equal(error, lines%get(), "<h2 id=""channels"">values</h2>"//nl//"<div class=""scroll""><table><thead><tr>"// &
                       "<th>channel</th><th>unit</th><th>max</th><th>at [ms]</th><th>hits</th></tr></thead><tbody>"//nl// &
                       "<tr><td>rod.angle</td><td>deg</td><td>143.24</td><td>1.25</td><td>7</td></tr>"//nl// &
                       "<tr><td>pin.x</td><td>m</td><td>0</td><td>-</td><td>12</td></tr>"//nl// &
                       "<tr><td>pin.state</td><td></td><td>1</td><td>2</td><td>0</td></tr>"//nl//"</tbody></table></div>"//nl// &
                       "<p>4 more in run.h5</p>"//nl, "page")
   end subroutine html_has_units_that_read_well

end module test_result_table
