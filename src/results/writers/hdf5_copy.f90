!> Rows of one file of HDF5 in another.
module hdf5_copy
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dget_type_f, h5dopen_f, h5dread_f, h5dset_extent_f, h5dwrite_f, h5iget_name_f
   use hdf5, only: h5s_select_set_f, h5sclose_f, h5screate_simple_f, h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f
   use hdf5, only: h5sselect_hyperslab_f, h5tclose_f, h5tget_size_f, hid_t, hsize_t, size_t
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: copy_rows

   integer(i8), parameter :: bytes_at_once = 4194304_i8  !! that are copied in one go

contains

   !> Copy the first rows of a dataset to one of the same name, type and width in another file, which has none yet. A file that has
   !> fewer rows is a failure.
   subroutine copy_rows(from, to, n, status)
      integer(hid_t), intent(in) :: from  !! the file that has them
      integer(hid_t), intent(in) :: to    !! the dataset that gets them
      integer, intent(in) :: n            !! how many
      integer, intent(inout) :: status    !! negative: failed

      character(1024) :: path
      integer(hid_t) :: kind, source, space
      integer(hsize_t), allocatable :: had(:), most(:), shape(:)
      integer(size_t) :: length, width
      integer :: at, closed, many, rank

      if (status < 0) return
      call h5iget_name_f(to, path, int(len(path), size_t), length, status)
      if (status >= 0) call h5dopen_f(from, trim(path), source, status)
      if (status < 0) return
      call h5dget_type_f(to, kind, status)
      if (status >= 0) call h5tget_size_f(kind, width, status)
      if (status >= 0) call h5dget_space_f(to, space, status)
      if (status >= 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status < 0) return
      allocate (shape(rank), had(rank), most(rank))
      call h5sget_simple_extent_dims_f(space, shape, most, status)
      call h5sclose_f(space, closed)
      call h5dget_space_f(source, space, status)
      if (status >= 0) call h5sget_simple_extent_dims_f(space, had, most, status)
      call h5sclose_f(space, closed)
      if (status >= 0) then
         if (any(had(:rank - 1) /= shape(:rank - 1)) .or. had(rank) < n) status = -1
      end if
      if (status >= 0 .and. n > 0) call h5dset_extent_f(to, [shape(:rank - 1), int(n, hsize_t)], status)
      many = int(max(1_i8, bytes_at_once/max(1_i8, int(width, i8)*product(int(shape(:rank - 1), i8)))))
      do at = 0, n - 1, many
         if (status >= 0) call copy_some(source, to, kind, int(width), shape(:rank - 1), at, min(many, n - at), status)
      end do
      call h5tclose_f(kind, closed)
      call h5dclose_f(source, closed)
   end subroutine copy_rows

   !> Copy some rows.
   subroutine copy_some(source, to, kind, width, shape, before, n, status)
      integer(hid_t), intent(in) :: source      !! the dataset that has them
      integer(hid_t), intent(in) :: to          !! the dataset that gets them, long enough
      integer(hid_t), intent(in) :: kind        !! type of a number or record
      integer, intent(in) :: width              !! its bytes
      integer(hsize_t), intent(in) :: shape(:)  !! (rank - 1) extent of a row
      integer, intent(in) :: before             !! rows before the first of them
      integer, intent(in) :: n                  !! how many
      integer, intent(inout) :: status          !! negative: failed

      integer(int8), allocatable, target :: bytes(:)
      type(c_ptr) :: memory
      integer(hid_t) :: here, there
      integer(hsize_t) :: first(size(shape) + 1), many(size(shape) + 1)
      integer :: closed, k

      first = 0
      first(size(first)) = before
      many = [shape, int(n, hsize_t)]
      allocate (bytes(width*product(many)))
      memory = c_loc(bytes)
      call h5screate_simple_f(size(many), many, here, status)
      do k = 1, 2
         if (status >= 0) call h5dget_space_f(merge(source, to, k == 1), there, status)
         if (status >= 0) call h5sselect_hyperslab_f(there, h5s_select_set_f, first, many, status)
         if (status < 0) return
         if (k == 1) call h5dread_f(source, kind, memory, status, here, there)
         if (k == 2) call h5dwrite_f(to, kind, memory, status, here, there)
         call h5sclose_f(there, closed)
      end do
      call h5sclose_f(here, closed)
   end subroutine copy_some

end module hdf5_copy
