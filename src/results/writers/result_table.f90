!> A result as a table: columns with name, unit and help over common rows, and facts, which are single values.
!>
!> A result is built once; each format writes any table: `hdf5_table`, `json_table`, `csv_table`. Values are SI. NaN is a missing
!> value; the help of its column gives the reason.
module result_table
   use kinds, only: i8, wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: in_all, in_hdf5, in_text_files, result_column_t, result_table_t

   integer, parameter :: in_all = 0         !! written in all formats
   integer, parameter :: in_hdf5 = 1        !! in HDF5 files only
   integer, parameter :: in_text_files = 2  !! in JSON and CSV only

   !> A column, or a fact: a column of one row. Only the list of its type is allocated.
   type :: result_column_t
      character(:), allocatable :: name           !! in all formats
      character(:), allocatable :: dataset        !! name in HDF5 files
      character(:), allocatable :: unit           !! SI, `1` if none, `list` if rows or parts differ
      character(:), allocatable :: help           !! one line: what it is, and what NaN means
      integer :: formats = in_all                 !! which formats have it
      integer, allocatable :: shape(:)            !! extent of one value, in Fortran's order; none: scalar
      type(text_t), allocatable :: parts(:)       !! (any) names of columns, one for each part of a value
      type(text_t), allocatable :: texts(:)       !! (n) values
      real(wp), allocatable :: reals(:)           !! (parts times n) values; NaN: missing [any]
      integer(i8), allocatable :: integers(:)     !! (n) values
      logical :: is_count = .false.               !! integers that may exceed 32 bits: real numbers in HDF5 files
      logical, allocatable :: logicals(:)         !! (n) values
   end type result_column_t

   !> A result.
   type :: result_table_t
      character(:), allocatable :: name                !! in JSON
      character(:), allocatable :: group               !! path in HDF5 files
      integer :: n = 0                                 !! rows
      type(result_column_t), allocatable :: facts(:)   !! (any) single values
      type(result_column_t), allocatable :: columns(:) !! (any) columns
   contains
      procedure :: start
      procedure :: fact
      procedure :: put
   end type result_table_t

contains

   !> Begin a table without facts and columns.
   subroutine start(self, name, group, n)
      class(result_table_t), intent(inout) :: self  !! the table
      character(*), intent(in) :: name              !! in JSON
      character(*), intent(in) :: group             !! path in HDF5 files
      integer, intent(in) :: n                      !! rows

      self%name = name
      self%group = group
      self%n = n
      if (allocated(self%facts)) deallocate (self%facts, self%columns)
      allocate (self%facts(0), self%columns(0))
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
   subroutine put(self, name, unit, help, reals, integers, counts, texts, logicals, dataset, formats, shape, parts)
      class(result_table_t), intent(inout) :: self      !! the table
      character(*), intent(in) :: name                  !! in all formats
      character(*), intent(in) :: unit                  !! SI, `1` if none, `list` if rows or parts differ
      character(*), intent(in) :: help                  !! what it is, and what NaN means
      real(wp), intent(in), optional :: reals(:)        !! (parts times n) values, row by row; NaN: missing [any]
      integer, intent(in), optional :: integers(:)      !! (n) values
      integer(i8), intent(in), optional :: counts(:)    !! (n) values that may exceed 32 bits
      type(text_t), intent(in), optional :: texts(:)    !! (n) values
      logical, intent(in), optional :: logicals(:)      !! (n) values
      character(*), intent(in), optional :: dataset     !! name in HDF5 files, if another
      integer, intent(in), optional :: formats          !! which formats have it
      integer, intent(in), optional :: shape(:)         !! extent of one value; absent: scalar
      type(text_t), intent(in), optional :: parts(:)    !! (any) names of columns, one for each part of a value

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
      self%columns = [self%columns, one]
   end subroutine put

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
      allocate (one%shape(0))
      if (present(dataset)) one%dataset = dataset
      if (present(formats)) one%formats = formats
   end function new_column

end module result_table
