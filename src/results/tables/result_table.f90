!> A result as a table: columns with name, unit and help over common rows, and facts, which are single values.
!>
!> A result is built once; each format writes any table: `hdf5_table`, `json_table`, `csv_table`, `text_of_table`, `html_table`.
!> Values are SI. NaN is a missing value; the help of its column gives the reason. Files for programs have the columns with a
!> `formats` of theirs; summary.txt and report.html have the columns with a heading, in tables with a title.
!>
!> Units of parts of a value stand with blanks between them. A column whose rows have the units of the table has the unit `list`,
!> or `rows`, for which HDF5 files have all of them.
module result_table
   use kinds, only: i8, wp
   use text, only: split_blank, text_t
   implicit none (type, external)
   private
   public :: as_members, in_all, in_csv, in_hdf5, in_json, in_text_files, only_shown
   public :: name_with_unit, result_column_t, result_table_t

   integer, parameter :: in_hdf5 = 1                    !! written in HDF5 files
   integer, parameter :: in_json = 2                    !! in JSON
   integer, parameter :: in_csv = 4                     !! as comma-separated values
   integer, parameter :: in_text_files = in_json + in_csv   !! in both
   integer, parameter :: in_all = in_hdf5 + in_text_files   !! in all files for programs
   integer, parameter :: only_shown = 0                 !! for people only
   integer, parameter :: as_members = 8                 !! in JSON each value is a member, named by the first column

   !> A column, or a fact: a column of one row. Only the list of its type is allocated.
   type :: result_column_t
      character(:), allocatable :: name           !! in files for programs
      character(:), allocatable :: dataset        !! name in HDF5 files
      character(:), allocatable :: heading        !! for people; not allocated: not shown
      character(:), allocatable :: unit           !! SI, `1` if none; see above if rows or parts differ
      character(:), allocatable :: help           !! one line: what it is, and what NaN means
      character(:), allocatable :: missing        !! NaN for people
      integer :: formats = in_all                 !! which files for programs have it
      integer :: digits = 5                       !! for people
      integer, allocatable :: shape(:)            !! extent of one value, in Fortran's order; none: scalar
      type(text_t), allocatable :: parts(:)       !! (any) names of columns, one for each part of a value
      type(text_t), allocatable :: texts(:)       !! (n) values
      real(wp), allocatable :: reals(:)           !! (parts times n) values; NaN: missing [any]
      integer(i8), allocatable :: integers(:)     !! (parts times n) values
      logical :: is_count = .false.               !! integers that may exceed 32 bits: real numbers in HDF5 files
      logical, allocatable :: logicals(:)         !! (n) values
   contains
      procedure :: has_unit_of_row
      procedure :: n_part
      procedure :: head => head_of_part
   end type result_column_t

   !> A result.
   type :: result_table_t
      character(:), allocatable :: name                !! of the list of rows in JSON
      character(:), allocatable :: object              !! object of JSON that has facts and rows; blank: the outermost
      character(:), allocatable :: group               !! path in HDF5 files; blank: not there
      character(:), allocatable :: title               !! for people; blank: not shown
      character(:), allocatable :: elsewhere           !! files with the rows that are not shown
      integer :: n = 0                                 !! rows
      integer :: left_out = 0                          !! further rows, elsewhere only
      integer :: most = 40                             !! rows in summary.txt
      integer :: most_in_json = 1000                   !! rows in JSON
      type(text_t), allocatable :: units(:)            !! (n) of columns whose rows have units of their own
      real(wp), allocatable :: noise(:)                !! (n) less is shown as zero in these columns [any]
      logical, allocatable :: is_minor(:)              !! (n) not shown in summary.txt
      type(text_t), allocatable :: notes(:)            !! (any) lines below the table
      type(result_column_t), allocatable :: facts(:)   !! (any) single values
      type(result_column_t), allocatable :: columns(:) !! (any) columns
   contains
      procedure :: start
      procedure :: fact
      procedure :: put
      procedure :: section
   end type result_table_t

contains

   !> Begin a table without facts and columns.
   subroutine start(self, name, group, n, object, title, elsewhere)
      class(result_table_t), intent(inout) :: self      !! the table
      character(*), intent(in) :: name                  !! in JSON
      character(*), intent(in) :: group                 !! path in HDF5 files
      integer, intent(in) :: n                          !! rows
      character(*), intent(in), optional :: object      !! of JSON
      character(*), intent(in), optional :: title       !! for people
      character(*), intent(in), optional :: elsewhere   !! files with the rows that are not shown

      self%name = name
      self%group = group
      self%object = ""
      self%title = ""
      self%elsewhere = ""
      if (present(object)) self%object = object
      if (present(title)) self%title = title
      if (present(elsewhere)) self%elsewhere = elsewhere
      self%n = n
      if (allocated(self%facts)) deallocate (self%facts, self%columns, self%notes)
      allocate (self%facts(0), self%columns(0), self%notes(0))
   end subroutine start

   !> Append a fact: text, real, integer or logical.
   subroutine fact(self, name, value, dataset, formats)
      class(result_table_t), intent(inout) :: self      !! the table
      character(*), intent(in) :: name                  !! in all formats
      class(*), intent(in) :: value                     !! its value, SI; NaN: missing
      character(*), intent(in), optional :: dataset     !! name in HDF5 files, if another
      integer, intent(in), optional :: formats          !! which formats have it

      type(result_column_t) :: one

      one = new_column(name, "1", "", dataset, formats)
      select type (value)
      type is (character(*))
         allocate (one%texts(1))
         one%texts(1)%s = value
      type is (real(wp))
         one%reals = [value]
      type is (integer)
         one%integers = [int(value, i8)]
      type is (integer(i8))
         one%integers = [value]
      type is (logical)
         one%logicals = [value]
      end select
      self%facts = [self%facts, one]
   end subroutine fact

   !> Append a column, with values of one type.
   subroutine put(self, name, unit, help, reals, integers, counts, texts, logicals, dataset, formats, shape, parts, heading, &
                  digits, missing)
      class(result_table_t), intent(inout) :: self      !! the table
      character(*), intent(in) :: name                  !! in files for programs
      character(*), intent(in) :: unit                  !! SI, `1` if none; see above if rows or parts differ
      character(*), intent(in) :: help                  !! what it is, and what NaN means
      real(wp), intent(in), optional :: reals(:)        !! (parts times n) values, row by row; NaN: missing [any]
      integer, intent(in), optional :: integers(:)      !! (parts times n) values
      integer(i8), intent(in), optional :: counts(:)    !! (n) values that may exceed 32 bits
      type(text_t), intent(in), optional :: texts(:)    !! (n) values
      logical, intent(in), optional :: logicals(:)      !! (n) values
      character(*), intent(in), optional :: dataset     !! name in HDF5 files, if another
      integer, intent(in), optional :: formats          !! which files for programs have it
      integer, intent(in), optional :: shape(:)         !! extent of one value; absent: scalar
      type(text_t), intent(in), optional :: parts(:)    !! (any) names of columns, one for each part of a value
      character(*), intent(in), optional :: heading     !! for people; absent: not shown
      integer, intent(in), optional :: digits           !! for people, if not 5
      character(*), intent(in), optional :: missing     !! NaN for people, if not `-`

      type(result_column_t) :: one

      one = new_column(name, unit, help, dataset, formats)
      if (present(reals)) one%reals = reals
      if (present(integers)) one%integers = int(integers, i8)
      if (present(counts)) one%integers = counts
      one%is_count = present(counts)
      if (present(texts)) one%texts = texts
      if (present(logicals)) one%logicals = logicals
      if (present(shape)) one%shape = shape
      if (present(parts)) one%parts = parts
      if (present(heading)) one%heading = heading
      if (present(digits)) one%digits = digits
      if (present(missing)) one%missing = missing
      self%columns = [self%columns, one]
   end subroutine put

   !> Whether its rows have the units of the table.
   pure logical function has_unit_of_row(self)
      class(result_column_t), intent(in) :: self        !! the column

      has_unit_of_row = self%unit == "list" .or. self%unit == "rows"
   end function has_unit_of_row

   !> Number of parts of a value.
   pure integer function n_part(self)
      class(result_column_t), intent(in) :: self        !! the column

      n_part = product(self%shape)
   end function n_part

   !> Name of a column, or of a part of its values, with its unit.
   function head_of_part(self, name, part) result(text)
      class(result_column_t), intent(in) :: self        !! the column
      character(*), intent(in) :: name                  !! of a column without parts
      integer, intent(in) :: part                       !! number of the part
      character(:), allocatable :: text                 !! as `moment [N.m]`

      type(text_t), allocatable :: units(:)

      text = name_with_unit(name, self%unit)
      if (.not. allocated(self%parts)) return
      units = split_blank(self%unit)
      text = name_with_unit(self%parts(part)%s, units(merge(part, 1, size(units) == size(self%parts)))%s)
   end function head_of_part

   !> A name with its unit in brackets, if it has one unit.
   pure function name_with_unit(name, unit) result(text)
      character(*), intent(in) :: name                  !! any name
      character(*), intent(in) :: unit                  !! as of a column
      character(:), allocatable :: text                 !! as `moment [N.m]`

      text = name
      if (all(unit /= ["1   ", "list", "rows"]) .and. index(unit, " ") == 0) text = name//" ["//unit//"]"
   end function name_with_unit

   !> Name of its section in report.html.
   pure function section(self) result(name)
      class(result_table_t), intent(in) :: self         !! the table
      character(:), allocatable :: name                 !! of its object in JSON, or of its rows

      name = self%object
      if (name == "") name = self%name
   end function section

   !> A column without values.
   pure function new_column(name, unit, help, dataset, formats) result(one)
      character(*), intent(in) :: name                  !! in all formats
      character(*), intent(in) :: unit                  !! SI
      character(*), intent(in) :: help                  !! what it is
      character(*), intent(in), optional :: dataset     !! name in HDF5 files, if another
      integer, intent(in), optional :: formats          !! which formats have it
      type(result_column_t) :: one                      !! the column

      one%name = name
      one%dataset = name
      one%unit = unit
      one%help = help
      one%missing = "-"
      allocate (one%shape(0))
      if (present(dataset)) one%dataset = dataset
      if (present(formats)) one%formats = formats
   end function new_column

end module result_table
