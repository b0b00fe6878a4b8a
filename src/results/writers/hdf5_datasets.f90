!> Datasets of HDF5 that are written at once, each in one call, with what they hold, its unit and its frame.
!>
!> As in `hdf5_calls`, every procedure does nothing once `status` is negative, and shapes are given in Fortran's order.
module hdf5_datasets
   use hdf5, only: h5dclose_f, h5dwrite_f, h5tclose_f
   use hdf5, only: hid_t, hsize_t, h5t_native_double, h5t_native_integer, h5t_std_i32le, h5t_ieee_f64le
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char
   use hdf5_attributes, only: fixed_string_type, text_attribute
   use hdf5_calls, only: new_dataset
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: describe, integer_dataset, real_dataset, text_dataset

   integer, parameter :: shortest_string = 2  !! bytes; readers of netCDF take lists of single bytes for one string

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

      character(kind=c_char, len=:), allocatable, target :: store
      integer(hid_t) :: dataset, type_id
      integer :: closed, k, width

      width = shortest_string
      do k = 1, size(list)
         width = max(width, len(list(k)%s) + 1)
      end do
      allocate (character(width*size(list)) :: store)
      do k = 1, size(list)
         store((k - 1)*width + 1:k*width) = list(k)%s//repeat(c_null_char, width - len(list(k)%s))
      end do
      call fixed_string_type(width, all([(iachar(store(k:k)) < 128, k=1, len(store))]), type_id, status)
      if (status < 0) return
      if (is_scalar) then
         call new_dataset(file, path, type_id, [integer(hsize_t) ::], dataset, status)
      else
         call new_dataset(file, path, type_id, [size(list, kind=hsize_t)], dataset, status)
      end if
      if (status >= 0 .and. size(list) > 0) call h5dwrite_f(dataset, type_id, c_loc(store), status)
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
