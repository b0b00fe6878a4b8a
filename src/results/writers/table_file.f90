!> A file of tables: written whole, with the attributes of its root and where it comes from.
module table_file
   use errors, only: error_t
   use hdf5, only: hid_t
   use hdf5_layout, only: write_status
   use hdf5_table, only: write_tables
   use output_plan, only: output_plan_t
   use provenance, only: make_provenance
   use result_table, only: result_table_t
   use whole_file, only: begin_whole_file, end_whole_file
   implicit none (type, external)
   private
   public :: write_table_file

contains

   !> Write the file.
   subroutine write_table_file(name, filetype, plan, state, tables, error)
      character(*), intent(in) :: name                   !! of the file in the directory of the plan
      character(*), intent(in) :: filetype               !! what it is
      type(output_plan_t), intent(in) :: plan            !! what it says of its origin
      character(*), intent(in) :: state                  !! complete, stopped or failed
      type(result_table_t), intent(in) :: tables(:)      !! (n) the tables
      type(error_t), allocatable, intent(out) :: error   !! it cannot be written

      character(:), allocatable :: path
      integer(hid_t) :: file
      integer :: status

      path = plan%directory//"/"//name
      call begin_whole_file(path, filetype, plan, file, status, error)
      if (allocated(error)) return
      if (status >= 0) then
         call write_tables(file, tables, status)
         call make_provenance(file, plan, status)
         call write_status(file, state, status)
      end if
      call end_whole_file(path, file, status, error)
   end subroutine write_table_file

end module table_file
