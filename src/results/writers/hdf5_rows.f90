!> Rows for the growing datasets of run.h5.
module hdf5_rows
   use hdf5, only: h5dget_space_f, h5dset_extent_f, h5dwrite_f, h5kind_to_type, h5sclose_f, h5screate_simple_f
   use hdf5, only: h5sselect_hyperslab_f, h5s_select_set_f, h5t_native_double, h5_integer_kind, hid_t, hsize_t
   use hdf5_layout, only: dataset_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_c_binding, only: c_loc
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: write_rows, write_states

contains

   !> Append rows to a dataset of reals.
   subroutine write_rows(id, shape, rows, before, n, status)
      integer(hid_t), intent(in) :: id          !! the dataset
      integer(hsize_t), intent(in) :: shape(:)  !! (rank - 1) extent of a row
      integer, intent(in) :: before             !! rows in the file
      integer, intent(in) :: n                  !! rows to write
      real(wp), intent(in), target :: rows(product(shape)*n)  !! (size of a row times n) the rows [any]
      integer, intent(inout) :: status          !! negative: failed

      integer(hid_t) :: here, there
      integer :: closed

      if (n == 0) return
      call open_rows(id, shape, before, n, here, there, status)
      if (status < 0) return
      call h5dwrite_f(id, h5t_native_double, c_loc(rows), status, here, there)
      call h5sclose_f(here, closed)
      call h5sclose_f(there, closed)
   end subroutine write_rows

   !> Append rows to a dataset of contact states; a state that is not known is -1.
   subroutine write_states(dataset, before, n, status)
      type(dataset_t), intent(in) :: dataset  !! the dataset
      integer, intent(in) :: before           !! rows in the file
      integer, intent(in) :: n                !! rows to write
      integer, intent(inout) :: status        !! negative: failed

      integer(int8), target :: states(size(dataset%rows, 1), n)
      integer(hid_t) :: here, there
      integer :: closed, i, k

      if (n == 0) return
      call open_rows(dataset%id, dataset%shape, before, n, here, there, status)
      if (status < 0) return
      do k = 1, n
         do i = 1, size(states, 1)
            states(i, k) = -1_int8
            if (.not. ieee_is_nan(dataset%rows(i, k))) states(i, k) = nint(dataset%rows(i, k), int8)
         end do
      end do
      call h5dwrite_f(dataset%id, h5kind_to_type(int8, h5_integer_kind), c_loc(states), status, here, there)
      call h5sclose_f(here, closed)
      call h5sclose_f(there, closed)
   end subroutine write_states

   !> Make a dataset longer and select its new rows.
   subroutine open_rows(id, shape, before, n, here, there, status)
      integer(hid_t), intent(in) :: id          !! the dataset
      integer(hsize_t), intent(in) :: shape(:)  !! (rank - 1) extent of a row
      integer, intent(in) :: before             !! rows in the file
      integer, intent(in) :: n                  !! rows to write
      integer(hid_t), intent(out) :: here       !! space in memory
      integer(hid_t), intent(out) :: there      !! space in the file
      integer, intent(inout) :: status          !! negative: failed

      integer(hsize_t) :: zero(size(shape))

      here = -1
      there = -1
      zero = 0
      if (status < 0) return
      call h5dset_extent_f(id, [shape, int(before + n, hsize_t)], status)
      if (status >= 0) call h5screate_simple_f(size(shape) + 1, [shape, int(n, hsize_t)], here, status)
      if (status >= 0) call h5dget_space_f(id, there, status)
      if (status >= 0) call h5sselect_hyperslab_f(there, h5s_select_set_f, [zero, int(before, hsize_t)], &
                                                  [shape, int(n, hsize_t)], status)
   end subroutine open_rows

end module hdf5_rows
