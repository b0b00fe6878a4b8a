!> Whether all of a file of HDF5 can be read, found out by reading it; and sums of the rows of its datasets.
module hdf5_probe
   use checksum, only: add_rows
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dget_type_f, h5dopen_f, h5dread_f, h5fclose_f, h5gclose_f, h5gget_info_f
   use hdf5, only: h5gopen_f, h5lget_name_by_idx_f, h5s_select_set_f, h5sclose_f, h5screate_simple_f
   use hdf5, only: h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5sselect_hyperslab_f, h5tclose_f, h5tget_size_f
   use hdf5, only: h5_index_name_f, h5_iter_inc_f, hid_t, hsize_t, size_t
   use hdf5_calls, only: open_file
   use, intrinsic :: iso_c_binding, only: c_int8_t, c_loc, c_ptr
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: file_can_be_read, row_sums_t

   integer(i8), parameter :: bytes_at_once = 4194304_i8  !! that are read in one go
   integer, parameter :: deepest = 30                    !! groups within groups

   !> Sums of the first rows of several datasets.
   type :: row_sums_t
      integer :: n = 0                        !! rows
      integer(i8), allocatable :: sums(:)     !! (datasets) theirs
   contains
      procedure :: extend => extend_sums
   end type row_sums_t

contains

   !> Whether all datasets can be read. A damaged file may end the process, or keep it busy for ever: see `survives`.
   logical function file_can_be_read(path)
      character(*), intent(in) :: path   !! the file

      integer(hid_t) :: file
      integer :: closed, status

      status = 0
      call open_file(path, file, status)
      call read_group(file, "/", 1, status)
      if (file >= 0) call h5fclose_f(file, closed)
      file_can_be_read = status >= 0
   end function file_can_be_read

   !> Read all in a group.
   recursive subroutine read_group(file, path, depth, status)
      integer(hid_t), intent(in) :: file    !! the file
      character(*), intent(in) :: path      !! of the group
      integer, intent(in) :: depth          !! groups above it
      integer, intent(inout) :: status      !! negative: failed

      character(1024) :: name
      integer(hid_t) :: dataset, group
      integer(hsize_t) :: i
      integer(i8) :: ignored
      integer :: closed, most, n, storage, opened

      if (depth > deepest) status = -1
      if (status < 0) return
      call h5gopen_f(file, path, group, status)
      if (status < 0) return
      call h5gget_info_f(group, storage, n, most, status)
      do i = 0, int(n - 1, hsize_t)
         if (status >= 0) call h5lget_name_by_idx_f(group, ".", h5_index_name_f, h5_iter_inc_f, i, name, status)
         if (status < 0) exit
         call h5dopen_f(group, trim(name), dataset, opened)
         if (opened < 0) then
            call read_group(file, path//trim(name)//"/", depth + 1, status)
         else
            ignored = 0
            call add_dataset(dataset, 0_i8, -1_i8, ignored, status)
            call h5dclose_f(dataset, closed)
         end if
      end do
      call h5gclose_f(group, closed)
   end subroutine read_group

   !> Continue with the sums up to some number of rows.
   subroutine extend_sums(self, datasets, n, status)
      class(row_sums_t), intent(inout) :: self      !! the sums
      integer(hid_t), intent(in) :: datasets(:)     !! the open datasets, always the same
      integer, intent(in) :: n                      !! rows
      integer, intent(inout) :: status              !! negative: failed

      integer :: k

      if (.not. allocated(self%sums)) allocate (self%sums(size(datasets)), source=0_i8)
      do k = 1, size(datasets)
         if (n > self%n) call add_dataset(datasets(k), int(self%n, i8), int(n, i8), self%sums(k), status)
      end do
      self%n = n
   end subroutine extend_sums

   !> Add rows of a dataset to a sum.
   subroutine add_dataset(dataset, before, upto, sum, status)
      integer(hid_t), intent(in) :: dataset   !! the dataset
      integer(i8), intent(in) :: before       !! rows before the first
      integer(i8), intent(in) :: upto         !! the last; -1: of all
      integer(i8), intent(inout) :: sum       !! grown
      integer, intent(inout) :: status        !! negative: failed

      integer(hid_t) :: kind, space
      integer(hsize_t), allocatable :: most(:), shape(:)
      integer(size_t) :: width
      integer(i8) :: at, last, many
      integer :: closed, ignored, rank

      if (status < 0) return
      call h5dget_type_f(dataset, kind, status)
      if (status >= 0) call h5tget_size_f(kind, width, status)
      if (status >= 0) call h5dget_space_f(dataset, space, status)
      if (status >= 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status < 0) return
      allocate (shape(rank), most(rank))
      if (rank > 0) call h5sget_simple_extent_dims_f(space, shape, most, ignored)
      call h5sclose_f(space, closed)
      if (rank == 0) shape = [1_hsize_t]
      last = int(shape(size(shape)), i8)
      if (upto > last) status = -1
      if (upto >= 0) last = upto
      associate (row => shape(:size(shape) - 1))
         many = max(1_i8, bytes_at_once/max(1_i8, int(width, i8)*product(int(row, i8))))
         do at = before, last - 1, many
            if (status >= 0) call add_some(dataset, kind, int(width), rank, row, at, min(many, last - at), sum, status)
         end do
      end associate
      call h5tclose_f(kind, closed)
   end subroutine add_dataset

   !> Add some rows to a sum.
   subroutine add_some(dataset, kind, width, rank, shape, before, n, sum, status)
      integer(hid_t), intent(in) :: dataset     !! the dataset
      integer(hid_t), intent(in) :: kind        !! its type
      integer, intent(in) :: width              !! bytes of a number or record
      integer, intent(in) :: rank               !! of the dataset, 0: one value
      integer(hsize_t), intent(in) :: shape(:)  !! (rank - 1) extent of a row
      integer(i8), intent(in) :: before         !! rows before the first of them
      integer(i8), intent(in) :: n              !! how many
      integer(i8), intent(inout) :: sum         !! grown
      integer, intent(inout) :: status          !! negative: failed

      integer(c_int8_t), allocatable, target :: bytes(:)
      type(c_ptr) :: memory
      integer(hid_t) :: here, there
      integer(hsize_t) :: first(size(shape) + 1), many(size(shape) + 1)
      integer :: closed, made

      first = 0
      first(size(first)) = before
      many = [shape, int(n, hsize_t)]
      allocate (bytes(width*product(many)), stat=made)
      if (made /= 0) status = -1
      if (status < 0 .or. size(bytes) == 0) return
      memory = c_loc(bytes)
      if (rank == 0) then
         call h5dread_f(dataset, kind, memory, status)
      else
         call h5screate_simple_f(size(many), many, here, status)
         if (status >= 0) call h5dget_space_f(dataset, there, status)
         if (status >= 0) call h5sselect_hyperslab_f(there, h5s_select_set_f, first, many, status)
         if (status < 0) return
         call h5dread_f(dataset, kind, memory, status, here, there)
         call h5sclose_f(there, closed)
         call h5sclose_f(here, closed)
      end if
      if (status >= 0) call add_rows(sum, bytes, int(width*product(shape)))
   end subroutine add_some

end module hdf5_probe
