!> Two sweeps against each other: their tables of cases, cases.csv, row by row.
!>
!> Two numbers differ if |a - b| > max(absolute, relative max|a|), the maximum over the rows of the column; anything else if its
!> characters do. Source: none. Limits: tables of the same columns and cases, in the same order.
module sweep_comparison
   use errors, only: error_t, exit_file, exit_usage, set_error
   use kinds, only: i8, wp
   use numbers, only: number_length, read_number
   use system_file, only: read_file
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: compare_cases

   integer(i8), parameter :: largest = 200000000_i8   !! bytes of a table
   integer, parameter :: most_shown = 20       !! differences that are listed

   !> A table of cells.
   type :: cells_t
      type(text_t), allocatable :: names(:)     !! (columns) names
      type(text_t), allocatable :: cell(:, :)   !! (columns, rows) cells
   end type cells_t

contains

   !> Compare the cases of two sweeps.
   subroutine compare_cases(first, second, absolute, relative, lines, n_different, error)
      character(*), intent(in) :: first                         !! directory of A
      character(*), intent(in) :: second                        !! directory of B
      real(wp), intent(in) :: absolute                          !! difference allowed [any]
      real(wp), intent(in) :: relative                          !! the same, of the maximum of the column in A [1]
      type(text_t), allocatable, intent(out) :: lines(:)        !! (any) what differs, for people
      integer, intent(out) :: n_different                       !! cells that differ
      type(error_t), allocatable, intent(out) :: error          !! no tables, or tables of different sweeps

      type(cells_t) :: a, b
      real(wp), allocatable :: x(:), y(:)
      logical, allocatable :: is_number(:)
      integer :: column, row

      allocate (lines(0))
      n_different = 0
      call read_cells(first//"/cases.csv", a, error)
      if (.not. allocated(error)) call read_cells(second//"/cases.csv", b, error)
      if (allocated(error)) return
      if (size(a%names) /= size(b%names) .or. size(a%cell, 2) /= size(b%cell, 2)) then
         call set_error(error, exit_usage, "the sweeps have different tables: "//first//"/cases.csv has "// &
                        to_text(size(a%names))//" columns and "//to_text(size(a%cell, 2))//" cases, "//second//"/cases.csv "// &
                        to_text(size(b%names))//" and "//to_text(size(b%cell, 2))//new_line("a")// &
                        "  = only sweeps of the same parameters and statistics can be compared")
         return
      end if
      do column = 1, size(a%names)
         if (a%names(column)%s /= b%names(column)%s) then
            call set_error(error, exit_usage, "the sweeps have different tables: column "//to_text(column)//" is '"// &
                           a%names(column)%s//"' in A and '"//b%names(column)%s//"' in B")
            return
         end if
         call numbers_of(a%cell(column, :), b%cell(column, :), x, y, is_number)
         do row = 1, size(x)
            if (is_number(row)) then
               if (abs(x(row) - y(row)) <= max(absolute, relative*maxval(abs(x), mask=is_number))) cycle
            else if (a%cell(column, row)%s == b%cell(column, row)%s) then
               cycle
            end if
            n_different = n_different + 1
            if (n_different <= most_shown) call append_text(lines, "case "//to_text(row)//", "//a%names(column)%s//": "// &
                                                            a%cell(column, row)%s//" in A, "//b%cell(column, row)%s//" in B")
         end do
      end do
      if (n_different > most_shown) call append_text(lines, to_text(n_different - most_shown)//" more")
      call append_text(lines, to_text(n_different)//" of "//to_text(size(a%cell))//" values in "//to_text(size(a%cell, 2))// &
                       " cases differ")
   end subroutine compare_cases

   !> Cells of both tables as numbers, where both are.
   subroutine numbers_of(a, b, x, y, is_number)
      type(text_t), intent(in) :: a(:)                   !! (rows) cells of A
      type(text_t), intent(in) :: b(:)                   !! (rows) cells of B
      real(wp), allocatable, intent(out) :: x(:)         !! (rows) their numbers, 0 if none [any]
      real(wp), allocatable, intent(out) :: y(:)         !! (rows) the same of B [any]
      logical, allocatable, intent(out) :: is_number(:)  !! (rows) both have one

      logical :: is_fine(2)
      integer :: row

      allocate (x(size(a)), y(size(a)), source=0.0_wp)
      allocate (is_number(size(a)), source=.false.)
      do row = 1, size(a)
         if (len(a(row)%s) == 0 .or. len(b(row)%s) == 0) cycle
         if (number_length(a(row)%s) /= len(a(row)%s) .or. number_length(b(row)%s) /= len(b(row)%s)) cycle
         call read_number(a(row)%s, 0, x(row), is_fine(1))
         call read_number(b(row)%s, 0, y(row), is_fine(2))
         is_number(row) = all(is_fine)
      end do
   end subroutine numbers_of

   !> Read a table of comma-separated values.
   subroutine read_cells(path, cells, error)
      character(*), intent(in) :: path                     !! of the file
      type(cells_t), intent(out) :: cells                  !! what it holds
      type(error_t), allocatable, intent(out) :: error     !! it cannot be read

      character(:), allocatable :: bytes, message
      integer :: column, end, n_column, n_row, row, start
      logical :: is_last

      call read_file(path, .false., largest, bytes, message)
      if (len(message) > 0) then
         call set_error(error, exit_file, "cannot read '"//path//"': "//message)
         return
      end if
      n_row = lines_of(bytes)
      n_column = 1
      do start = 1, index(bytes, new_line("a"))
         if (bytes(start:start) == ",") n_column = n_column + 1
      end do
      allocate (cells%names(n_column), cells%cell(n_column, max(n_row - 1, 0)))
      start = 1
      do row = 0, n_row - 1
         do column = 1, n_column
            end = scan(bytes(start:), ","//new_line("a"))
            if (end > 0) is_last = bytes(start + end - 1:start + end - 1) /= ","
            if (end == 0 .or. (is_last .neqv. column == n_column)) then
               call set_error(error, exit_file, "cannot read '"//path//"': row "//to_text(row)//" has not "// &
                              to_text(n_column)//" columns")
               return
            end if
            if (row == 0) cells%names(column)%s = bytes(start:start + end - 2)
            if (row > 0) cells%cell(column, row)%s = bytes(start:start + end - 2)
            start = start + end
         end do
      end do
   end subroutine read_cells

   !> Number of lines of a text.
   pure integer function lines_of(bytes) result(n)
      character(*), intent(in) :: bytes   !! the text

      integer :: k

      n = 0
      do k = 1, len(bytes)
         if (bytes(k:k) == new_line("a")) n = n + 1
      end do
   end function lines_of

end module sweep_comparison
