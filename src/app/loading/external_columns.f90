!> Columns of another program from a file of the command line, as a history.
module external_columns
   use channel_spec, only: spec_t
   use column_file, only: column_table_t, read_columns
   use column_history, only: history_of_columns
   use errors, only: error_t, exit_file, exit_usage, set_error
   use series, only: history_t
   use source_text, only: read_source, source_t
   use text, only: append_text, counted, text_t, to_text
   implicit none (type, external)
   private
   public :: read_external

contains

   !> Read the columns of another program.
   subroutine read_external(path, specs, time, like, history, notes, error)
      character(*), intent(in) :: path                     !! of the file, perhaps with `:K` for its table number K
      type(spec_t), intent(in) :: specs(:)                 !! (n) channels
      type(spec_t), intent(in) :: time                     !! the time
      type(history_t), intent(in) :: like                  !! the run
      type(history_t), intent(out) :: history              !! the columns
      type(text_t), allocatable, intent(inout) :: notes(:) !! (n) what is said of them
      type(error_t), allocatable, intent(out) :: error     !! it cannot be read, or has no such table

      type(column_table_t), allocatable :: tables(:)
      type(source_t) :: source
      character(:), allocatable :: file, message
      integer :: at, k, status

      file = path
      k = 1
      at = index(path, ":", back=.true.)
      if (at > 1 .and. at < len(path)) then
         if (verify(path(at + 1:), "0123456789") == 0 .and. len(path) - at < 6) then
            read (path(at + 1:), *, iostat=status) k
            if (status == 0) file = path(:at - 1)
         end if
      end if
      call read_source(file, source, message, may_be_stream=.true.)
      if (message /= "") then
         call set_error(error, exit_file, "cannot read '"//file//"': "//message)
         return
      end if
      call read_columns(source, tables)
      if (size(tables) == 0) then
         call set_error(error, exit_file, "'"//file//"' has no rows of numbers"//new_line("a")// &
                        "  = a row needs at least two numbers, separated by commas, semicolons, tabs or blanks")
      else if (k < 1 .or. k > size(tables)) then
         call set_error(error, exit_usage, "'"//file//"' has "//to_text(size(tables))//" tables, no table "//to_text(k))
      else
         if (size(tables) > 1 .and. file == path) call append_text(notes, "'"//file//"' has "//to_text(size(tables))// &
            " tables; this comparison uses the first, "//counted(size(tables(1)%x, 2), "row", "rows")//" from line "// &
            to_text(tables(1)%line)//" on; the second is "//file//":2, from line "//to_text(tables(2)%line))
         call history_of_columns(file, tables(k), specs, time, like, history, error)
      end if
   end subroutine read_external

end module external_columns
