!> HDF5 files that are written whole, under another name first, so that there is never half of one. They carry their checksum.
module whole_file
   use checksum, only: seal_file
   use errors, only: error_t, exit_file, set_error
   use hdf5, only: h5fclose_f, h5fcreate_f, h5pclose_f
   use hdf5, only: h5f_acc_trunc_f, h5p_default_f, h5p_file_create_f, hid_t
   use hdf5_attributes, only: text_attribute
   use hdf5_calls, only: creation_list, open_library
   use hdf5_layout, only: make_root
   use output_marker, only: enter_file
   use output_plan, only: output_plan_t
   use posix, only: remove_file
   use text_file, only: fail_file, put_in_place
   implicit none (type, external)
   private
   public :: begin_whole_file, end_whole_file

contains

   !> Make a file beside its place, with the attributes of its root.
   subroutine begin_whole_file(path, filetype, plan, file, status, error)
      character(*), intent(in) :: path                      !! of the file when it is whole
      character(*), intent(in) :: filetype                  !! what it is
      type(output_plan_t), intent(in) :: plan               !! what it says of the run
      integer(hid_t), intent(out) :: file                   !! the file; 0: it is not open
      integer, intent(out) :: status                        !! negative: something was not written
      type(error_t), allocatable, intent(out) :: error      !! it cannot be made

      integer(hid_t) :: creation
      integer :: closed

      file = 0
      status = enter_file(path//".part")
      if (status /= 0) then
         call fail_file(error, "cannot make", path//".part", status, "")
         status = -1
         return
      end if
      call open_library(status)
      call creation_list(h5p_file_create_f, creation, status)
      if (status >= 0) call h5fcreate_f(path//".part", h5f_acc_trunc_f, file, status, creation, h5p_default_f)
      if (status < 0) then
         file = 0
         return
      end if
      call h5pclose_f(creation, closed)
      call make_root(file, plan, status)
      call text_attribute(file, "filetype", filetype, status)
   end subroutine begin_whole_file

   !> Put it in its place, or report that it could not be written.
   subroutine end_whole_file(path, file, status, error)
      character(*), intent(in) :: path                      !! of the file
      integer(hid_t), intent(in) :: file                    !! the file; closed here if it is open
      integer, intent(inout) :: status                      !! negative: something was not written
      type(error_t), allocatable, intent(out) :: error      !! it is not whole

      integer :: closed

      if (file > 0) then
         call h5fclose_f(file, closed)
         status = min(status, closed)
      end if
      if (status >= 0) status = -seal_file(path//".part")
      if (status >= 0) then
         call put_in_place(path, error)
      else
         call set_error(error, exit_file, "cannot write "//path//": the disk may be full")
      end if
      if (allocated(error)) closed = remove_file(path//".part")
   end subroutine end_whole_file

end module whole_file
