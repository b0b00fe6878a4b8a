!> Whether two files of HDF5 hold the same in their datasets, bit for bit. Limits: attributes are not compared; no strings of
!> variable length.
module hdf5_equal
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dget_type_f, h5dopen_f, h5dread_f, h5gget_obj_info_idx_f, h5gn_members_f
   use hdf5, only: h5fclose_f, h5g_dataset_f, h5g_group_f, h5sclose_f, h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f
   use hdf5, only: h5tclose_f, h5tget_size_f, hid_t, hsize_t, size_t
   use hdf5_calls, only: open_file
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: compare_files

   integer, parameter :: longest_name = 1024  !! characters

contains

   !> Compare two files, some groups omitted.
   subroutine compare_files(one, other, left_out, n, difference)
      character(*), intent(in) :: one                       !! path of a file
      character(*), intent(in) :: other                     !! path of the other
      character(*), intent(in) :: left_out                  !! group that is not compared
      integer(i8), intent(out) :: n                         !! numbers and texts compared
      character(:), allocatable, intent(out) :: difference  !! path of what differs; or blank

      integer(hid_t) :: a, b
      integer :: closed, status

      n = 0
      difference = ""
      status = 0
      call open_file(one, a, status)
      call open_file(other, b, status)
      if (status < 0) then
         difference = "one of the files cannot be read"
      else
         call compare_group(a, b, "/", left_out, n, difference)
      end if
      if (a >= 0) call h5fclose_f(a, closed)
      if (b >= 0) call h5fclose_f(b, closed)
   end subroutine compare_files

   !> Compare all that is in a group.
   recursive subroutine compare_group(a, b, path, left_out, n, difference)
      integer(hid_t), intent(in) :: a, b                       !! the files
      character(*), intent(in) :: path                         !! of the group
      character(*), intent(in) :: left_out                     !! group that is not compared
      integer(i8), intent(inout) :: n                          !! numbers and texts compared
      character(:), allocatable, intent(inout) :: difference   !! path of what differs; blank: nothing does

      character(longest_name) :: name
      integer :: k, kind, members, members_there, status

      call h5gn_members_f(a, path, members, status)
      if (status >= 0) call h5gn_members_f(b, path, members_there, status)
      if (status < 0 .or. members /= members_there) then
         difference = path
         return
      end if
      do k = 0, members - 1
         call h5gget_obj_info_idx_f(a, path, k, name, kind, status)
         if (status < 0) difference = path
         if (difference /= "") return
         associate (below => path//trim(name))
            if (below == left_out) cycle
            if (kind == h5g_group_f) call compare_group(a, b, below//"/", left_out, n, difference)
            if (kind == h5g_dataset_f) call compare_dataset(a, b, below, n, difference)
         end associate
      end do
   end subroutine compare_group

   !> Compare a dataset.
   subroutine compare_dataset(a, b, path, n, difference)
      integer(hid_t), intent(in) :: a, b                       !! the files
      character(*), intent(in) :: path                         !! of the dataset
      integer(i8), intent(inout) :: n                          !! numbers and texts compared
      character(:), allocatable, intent(inout) :: difference   !! path of what differs; blank: nothing does

      integer(int8), allocatable :: bytes(:), bytes_there(:)
      integer :: status

      status = 0
      call read_bytes(a, path, bytes, n, status)
      call read_bytes(b, path, bytes_there, n, status)
      if (status < 0 .or. size(bytes) /= size(bytes_there)) then
         difference = path
      else if (any(bytes /= bytes_there)) then
         difference = path
      end if
   end subroutine compare_dataset

   !> All bytes of a dataset.
   subroutine read_bytes(file, path, bytes, n, status)
      integer(hid_t), intent(in) :: file                            !! the file
      character(*), intent(in) :: path                              !! of the dataset
      integer(int8), allocatable, target, intent(out) :: bytes(:)   !! (any) its bytes
      integer(i8), intent(inout) :: n                               !! numbers and texts so far
      integer, intent(inout) :: status                              !! negative: failed

      type(c_ptr) :: memory
      integer(hid_t) :: dataset, kind, space
      integer(hsize_t), allocatable :: most(:), shape(:)
      integer(hsize_t) :: points
      integer(size_t) :: width
      integer :: closed, rank

      allocate (bytes(0))
      if (status < 0) return
      call h5dopen_f(file, path, dataset, status)
      if (status < 0) return
      call h5dget_type_f(dataset, kind, status)
      if (status >= 0) call h5dget_space_f(dataset, space, status)
      if (status >= 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status < 0) return
      allocate (most(rank), shape(rank))
      if (rank > 0) call h5sget_simple_extent_dims_f(space, shape, most, status)  ! the number of points of none is an error
      points = product(shape)
      if (status >= 0) call h5tget_size_f(kind, width, status)
      if (status < 0) return
      n = n + points
      if (points > 0) then
         deallocate (bytes)
         allocate (bytes(points*width))
         memory = c_loc(bytes)
         call h5dread_f(dataset, kind, memory, status)
      end if
      call h5sclose_f(space, closed)
      call h5tclose_f(kind, closed)
      call h5dclose_f(dataset, closed)
   end subroutine read_bytes

end module hdf5_equal
