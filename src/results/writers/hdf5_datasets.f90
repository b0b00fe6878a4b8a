!> Datasets of HDF5 that are written at once, each in one call, with what they hold, its unit and its frame.
!>
!> As in `hdf5_calls`, every procedure does nothing once `status` is negative, and shapes are given in Fortran's order.
module hdf5_datasets
   use hdf5, only: h5dclose_f, h5dwrite_f, h5p_dataset_xfer_f, h5pcreate_f, h5pset_buffer_f, h5tclose_f
   use hdf5, only: hid_t, hsize_t, h5t_native_double, h5t_native_integer, h5t_std_i32le, h5t_ieee_f64le
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5_attributes, only: string_type, text_attribute
   use hdf5_calls, only: new_dataset
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: describe, integer_dataset, real_dataset, text_dataset

   integer(hsize_t), parameter :: conversion = 65536_hsize_t  !! bytes in which strings get the form of the file; 1 MB is usual
   integer(hsize_t), parameter :: bytes_of_string = 64_hsize_t  !! more than one takes there: its length and where its heap has it

   integer(hid_t) :: transfer = -1  !! properties of writing strings, once some were written

contains

   !> Say what a dataset that was just made holds.
   subroutine describe(dataset, units, long_name, frame, status)
      integer(hid_t), intent(in) :: dataset  !! the dataset
      character(*), intent(in) :: units      !! SI unit, `1` if none
      character(*), intent(in) :: long_name  !! one line
      character(*), intent(in) :: frame      !! world, body, joint or none
      integer, intent(inout) :: status       !! negative: failed

      call text_attribute(dataset, "units", units, status, is_new=.true.)
      call text_attribute(dataset, "long_name", long_name, status, is_new=.true.)
      call text_attribute(dataset, "frame", frame, status, is_new=.true.)
   end subroutine describe

   !> Make a dataset of strings and write it.
   subroutine text_dataset(file, path, list, is_scalar, long_name, status)
      integer(hid_t), intent(in) :: file        !! file or group
      character(*), intent(in) :: path          !! path within it
      type(text_t), intent(in) :: list(:)       !! (n) strings
      logical, intent(in) :: is_scalar          !! one string, not a list of one
      character(*), intent(in) :: long_name     !! what they are
      integer, intent(inout) :: status          !! negative: failed

      type(c_ptr), target :: pointers(max(size(list), 1))
      character(kind=c_char, len=:), allocatable, target :: store
      integer(hid_t) :: dataset, type_id
      integer :: at, closed, k, total

      call string_type(type_id, status)
      if (status < 0) return
      total = 1
      do k = 1, size(list)
         total = total + len(list(k)%s) + 1
      end do
      allocate (character(total) :: store)
      at = 1
      do k = 1, size(list)
         store(at:at + len(list(k)%s)) = list(k)%s//c_null_char
         pointers(k) = c_loc(store(at:at))
         at = at + len(list(k)%s) + 1
      end do
      if (is_scalar) then
         call new_dataset(file, path, type_id, [integer(hsize_t) ::], dataset, status)
      else
         call new_dataset(file, path, type_id, [size(list, kind=hsize_t)], dataset, status)
      end if
      if (status >= 0 .and. size(list) > 0) then
         if (transfer < 0) call h5pcreate_f(h5p_dataset_xfer_f, transfer, status)
         if (status >= 0) call h5pset_buffer_f(transfer, min(conversion, bytes_of_string*size(list, kind=hsize_t)), status)
         if (status >= 0) call h5dwrite_f(dataset, type_id, c_loc(pointers), status, xfer_prp=transfer)
      end if
      call describe(dataset, "1", long_name, "none", status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
      call h5tclose_f(type_id, closed)
   end subroutine text_dataset

   !> Make a dataset of reals and write it.
   subroutine real_dataset(file, path, shape, values, units, long_name, status)
      integer(hid_t), intent(in) :: file        !! file or group
      character(*), intent(in) :: path          !! path within it
      integer, intent(in) :: shape(:)           !! (rank) extent, in Fortran's order
      real(wp), intent(in), contiguous, target :: values(:)  !! (product of shape) the numbers [any]
      character(*), intent(in) :: units         !! SI unit, `1` if none, or a list of them
      character(*), intent(in) :: long_name     !! what they are
      integer, intent(inout) :: status          !! negative: failed

      integer(hid_t) :: dataset
      integer :: closed

      call new_dataset(file, path, h5t_ieee_f64le, int(shape, hsize_t), dataset, status)
      if (status >= 0 .and. size(values) > 0) call h5dwrite_f(dataset, h5t_native_double, c_loc(values), status)
      call describe(dataset, units, long_name, "none", status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
   end subroutine real_dataset

   !> Make a dataset of integers and write it.
   subroutine integer_dataset(file, path, shape, values, long_name, status)
      integer(hid_t), intent(in) :: file        !! file or group
      character(*), intent(in) :: path          !! path within it
      integer, intent(in) :: shape(:)           !! (rank) extent, in Fortran's order
      integer, intent(in) :: values(:)          !! (product of shape) the numbers
      character(*), intent(in) :: long_name     !! what they are
      integer, intent(inout) :: status          !! negative: failed

      integer, allocatable, target :: store(:)
      integer(hid_t) :: dataset
      integer :: closed

      call new_dataset(file, path, h5t_std_i32le, int(shape, hsize_t), dataset, status)
      store = [values, 0]
      if (status >= 0 .and. size(values) > 0) call h5dwrite_f(dataset, h5t_native_integer, c_loc(store), status)
      call describe(dataset, "1", long_name, "none", status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
   end subroutine integer_dataset

end module hdf5_datasets
