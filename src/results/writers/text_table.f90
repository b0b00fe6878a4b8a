!> One file of columns: `#` and the names of the columns, `channel[unit]`, more `#` lines, numbers.
module text_table
   use catalogue, only: catalogue_t
   use channel_names, only: base_name, scalar_name, scalar_t
   use decimal_text, only: decimal_width, put_decimal
   use errors, only: error_t
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use recorder, only: row_kinds
   use text, only: to_text
   use text_buffer, only: buffer_t
   use text_file, only: text_file_t
   implicit none (type, external)
   private
   public :: column_label, file_heading, number_row, one_line, put_row_of_numbers, text_table_t

   !> A file and its rows that are not yet there. Where rows may be those of contacts, the last column says what each is.
   type :: text_table_t
      type(text_file_t) :: file                    !! the file
      type(scalar_t), allocatable :: columns(:)    !! (n) numbers of a row, without the time
      logical :: with_kinds = .false.              !! whether there is a column of kinds, after the others
      real(wp), allocatable :: rows(:, :)          !! (1 + n or 2 + n, block) rows to be written, time first [any]
   contains
      procedure :: start => start_table
      procedure :: put => put_row
      procedure :: flush => flush_rows
   end type text_table_t

contains

   !> Make the file with its heading.
   subroutine start_table(self, path, columns, with_kinds, block, plan, catalogue, error)
      class(text_table_t), intent(inout) :: self         !! the table
      character(*), intent(in) :: path                   !! the file
      type(scalar_t), intent(in) :: columns(:)           !! (n) numbers of a row
      logical, intent(in) :: with_kinds                  !! whether there is a column of kinds
      integer, intent(in) :: block                       !! rows kept in memory
      type(output_plan_t), intent(in) :: plan            !! what the file says of the run
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! the file cannot be made

      type(buffer_t) :: heading
      character(:), allocatable :: name, previous
      integer :: k

      self%file%path = path
      self%columns = columns
      self%with_kinds = with_kinds
      allocate (self%rows(size(columns) + merge(2, 1, with_kinds), block))
      call heading%add("# time[s]")
      do k = 1, size(columns)
         call heading%add(" "//column_label(catalogue, columns(k)))
      end do
      if (with_kinds) call heading%add(" row_kind[1]")
      call heading%line("")
      call heading%add(file_heading(plan))
      previous = ""
      do k = 1, size(columns)
         associate (channel => catalogue%groups(columns(k)%group)%channel)
            name = base_name(catalogue, columns(k)%group, columns(k)%item)
            if (name /= previous) then
               if (channel%frame == "none") then
                  call heading%line("# column "//to_text(k + 1)//", "//name//": "//channel%help)
               else
                  call heading%line("# column "//to_text(k + 1)//", "//name//": "//channel%help//", "//channel%frame//" frame")
               end if
            end if
            previous = name
         end associate
      end do
      if (with_kinds) call heading%line("# column "//to_text(size(columns) + 2)//", row_kind: "//row_kinds)
      if (.not. plan%life%goes_on) call self%file%append(heading%get(), error)
   end subroutine start_table

   !> The `#` lines that every file of a run starts with.
   function file_heading(plan) result(lines)
      type(output_plan_t), intent(in) :: plan  !! what the file says of the run
      character(:), allocatable :: lines       !! whole lines

      character(:), allocatable :: title

      title = one_line(plan%title)
      if (plan%is_twin()) title = title//" (ideal joints)"
      lines = "# "//title//new_line("a")//"# deck: "//one_line(plan%origin%deck_name)//new_line("a")// &
              "# gudgeon "//one_line(plan%origin%program_version)//new_line("a")
   end function file_heading

   !> A string of the deck without control characters, so that it stays on its line.
   pure function one_line(string) result(s)
      character(*), intent(in) :: string   !! any string
      character(len(string)) :: s          !! the same with blanks for control characters

      integer :: i

      s = string
      do i = 1, len(s)
         if (iachar(s(i:i)) < 32 .or. iachar(s(i:i)) == 127) s(i:i) = " "
      end do
   end function one_line

   !> What stands over a column.
   function column_label(catalogue, column) result(label)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(scalar_t), intent(in) :: column        !! one number
      character(:), allocatable :: label          !! as `slider.velocity.x[m/s]`

      label = scalar_name(catalogue, column)//"["//catalogue%groups(column%group)%channel%unit//"]"
   end function column_label

   !> Keep a row.
   subroutine put_row(self, at, t, kind, catalogue)
      class(text_table_t), intent(inout) :: self  !! the table
      integer, intent(in) :: at                   !! place of the row in memory
      real(wp), intent(in) :: t                   !! time [s]
      integer, intent(in) :: kind                 !! what the row is
      type(catalogue_t), intent(in) :: catalogue  !! values at t

      integer :: k

      self%rows(1, at) = t
      do k = 1, size(self%columns)
         associate (column => self%columns(k))
            self%rows(k + 1, at) = catalogue%values(catalogue%place(column%group, column%component, column%item))
         end associate
      end do
      if (self%with_kinds) self%rows(size(self%columns) + 2, at) = real(kind, wp)
   end subroutine put_row

   !> Write the rows in memory.
   subroutine flush_rows(self, n, error)
      class(text_table_t), intent(inout) :: self         !! the table
      integer, intent(in) :: n                           !! rows in memory
      type(error_t), allocatable, intent(out) :: error   !! they cannot be written

      character(:), allocatable :: text
      integer :: k, width

      width = decimal_width*size(self%rows, 1)
      allocate (character(width*n + 8) :: text)
      do k = 1, n
         call put_row_of_numbers(self%rows(:, k), text((k - 1)*width + 1:k*width))
         text(k*width:k*width) = new_line("a")
      end do
      call self%file%append(text(1:width*n), error)
   end subroutine flush_rows

   !> Numbers side by side, with 17 digits, which read back to the same numbers.
   subroutine put_row_of_numbers(numbers, line)
      real(wp), intent(in) :: numbers(:)    !! (n) any [any]
      character(decimal_width*size(numbers)), intent(out) :: line  !! each with a blank after it

      integer :: k

      do k = 1, size(numbers)
         call put_decimal(numbers(k), line((k - 1)*decimal_width + 1:k*decimal_width))
      end do
   end subroutine put_row_of_numbers

   !> The same as text, without the last blank.
   function number_row(numbers) result(line)
      real(wp), intent(in) :: numbers(:)                   !! (n) any [any]
      character(decimal_width*size(numbers) - 1) :: line   !! blanks between

      character(decimal_width*size(numbers)) :: whole

      call put_row_of_numbers(numbers, whole)
      line = whole
   end function number_row

end module text_table
