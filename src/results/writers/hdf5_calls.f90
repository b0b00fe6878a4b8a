!> The few things the writers ask of HDF5 to make files, groups and datasets, each in one call.
!>
!> Every procedure does nothing once `status` is negative, so that a caller looks at it once at the
!> end. No object carries a time of its making, so that equal runs give equal files. Shapes are given in
!> Fortran's order: reversed in the file.
module hdf5_calls
   use hdf5, only: h5dcreate_f, h5dont_atexit_f, h5eset_auto_f, h5fcreate_f, h5gcreate_f, h5open_f, h5pclose_f, h5pcopy_f
   use hdf5, only: h5f_acc_rdonly_f, h5fopen_f, h5pcreate_f
   use hdf5, only: h5pset_alloc_time_f, h5pset_chunk_cache_f, h5pset_chunk_f, h5pset_create_inter_group_f
   use hdf5, only: h5pset_local_heap_size_hint_f, h5pset_obj_track_times_f, h5sclose_f, h5screate_f, h5screate_simple_f
   use hdf5, only: h5d_alloc_time_early_f, hid_t, hsize_t, size_t, h5f_acc_trunc_f, h5p_dataset_access_f, h5p_dataset_create_f
   use hdf5, only: h5p_file_access_f, h5p_file_create_f, h5p_group_create_f, h5p_link_create_f, h5s_scalar_f, h5s_unlimited_f
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   use posix, only: set_default_variable
   implicit none (type, external)
   private
   public :: creation_list, is_memory_short, new_dataset, new_file, new_group, open_file, open_library

   logical :: is_open = .false.             !! whether the library has been opened
   integer(hid_t) :: bounded = -1           !! properties of the use of a file: what is kept of it does not grow with it
   integer(hid_t) :: link = -1              !! properties of a new name that makes the groups above it
   integer(hid_t) :: of_fixed_size = -1     !! those of a dataset that does not grow

   integer(size_t), parameter :: bytes_of_names = 1024  !! for the names in the root group, with storage for what comes at the end

   interface
      !> Whether so many bytes could be had at once: 1 or 0.
      integer(c_int) function c_has_capacity(bytes) bind(c, name="gudgeon_has_room")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: bytes  !! that are requested
      end function c_has_capacity

      !> Keep only so much of a file's metadata (ordered_file.c). Negative: failed.
      integer(c_int) function c_limit_cache(access) bind(c, name="gudgeon_limit_metadata_cache")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: access  !! access properties of a file
      end function c_limit_cache

      !> Set the driver that writes metadata in order (ordered_file.c). Negative: failed.
      integer(c_int) function c_set_driver(access) bind(c, name="gudgeon_set_ordered_driver")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: access  !! access properties of a file
      end function c_set_driver
   end interface

contains

   !> Whether there is so little memory left that a failure of the library may be due to that, not to the disk.
   logical function is_memory_short()
      integer(c_int64_t), parameter :: little = 16777216_c_int64_t  ! [byte]

      is_memory_short = c_has_capacity(little) == 0
   end function is_memory_short

   !> Open the library: it keeps quiet, leaves files to us at the end, and lets others read a running file.
   subroutine open_library(status)
      integer, intent(inout) :: status  !! negative: failed

      if (status < 0 .or. is_open) return
      call set_default_variable("HDF5_USE_FILE_LOCKING", "FALSE")
      call h5dont_atexit_f(status)
      call h5open_f(status)
      if (status < 0) return
      call h5eset_auto_f(0, status)
      if (status >= 0) call h5pcreate_f(h5p_link_create_f, link, status)
      if (status >= 0) call h5pset_create_inter_group_f(link, 1, status)
      call creation_list(h5p_dataset_create_f, of_fixed_size, status)
      if (status >= 0) call h5pcreate_f(h5p_file_access_f, bounded, status)
      if (status >= 0) status = c_limit_cache(int(bounded, c_int64_t))
      is_open = status >= 0
   end subroutine open_library

   !> Properties of a new file, group or dataset that carries no time of its making.
   subroutine creation_list(class, list, status)
      integer(hid_t), intent(in) :: class  !! class of the properties
      integer(hid_t), intent(out) :: list  !! to be closed by the caller
      integer, intent(inout) :: status     !! negative: failed

      list = -1
      if (status < 0) return
      call h5pcreate_f(class, list, status)
      if (status >= 0) call h5pset_obj_track_times_f(list, .false., status)
   end subroutine creation_list

   !> Make a file that can be read whenever its writer dies.
   subroutine new_file(path, file, status)
      character(*), intent(in) :: path      !! where
      integer(hid_t), intent(out) :: file   !! the open file
      integer, intent(inout) :: status      !! negative: failed

      integer(hid_t) :: access, creation
      integer :: closed

      file = -1
      if (status < 0) return
      call creation_list(h5p_file_create_f, creation, status)
      if (status >= 0) call h5pset_local_heap_size_hint_f(creation, bytes_of_names, status)
      if (status >= 0) call h5pcopy_f(bounded, access, status)
      if (status < 0) return
      status = c_set_driver(int(access, c_int64_t))
      if (status >= 0) call h5fcreate_f(path, h5f_acc_trunc_f, file, status, creation, access)
      call h5pclose_f(creation, closed)
      call h5pclose_f(access, closed)
   end subroutine new_file

   !> Open a file to read it.
   subroutine open_file(path, file, status)
      character(*), intent(in) :: path      !! where
      integer(hid_t), intent(out) :: file   !! the open file; negative: there is none that can be read
      integer, intent(inout) :: status      !! negative: failed

      file = -1
      call open_library(status)
      if (status >= 0) call h5fopen_f(path, h5f_acc_rdonly_f, file, status, bounded)
      if (status < 0) file = -1
   end subroutine open_file

   !> Make a group, and those above it.
   subroutine new_group(file, path, group, status)
      integer(hid_t), intent(in) :: file    !! file or group
      character(*), intent(in) :: path      !! path within it
      integer(hid_t), intent(out) :: group  !! the open group
      integer, intent(inout) :: status      !! negative: failed

      integer(hid_t) :: creation
      integer :: closed

      group = -1
      call creation_list(h5p_group_create_f, creation, status)
      if (status < 0) return
      call h5gcreate_f(file, path, group, status, lcpl_id=link, gcpl_id=creation)
      call h5pclose_f(creation, closed)
   end subroutine new_group

   !> Make a dataset of a given type, chunked if `chunk` is given, growing in its last dimension.
   subroutine new_dataset(file, path, type_id, shape, dataset, status, chunk)
      integer(hid_t), intent(in) :: file                  !! file or group
      character(*), intent(in) :: path                    !! path within it
      integer(hid_t), intent(in) :: type_id               !! type in the file
      integer(hsize_t), intent(in) :: shape(:)            !! (rank) extent, none for a scalar
      integer(hid_t), intent(out) :: dataset              !! the open dataset
      integer, intent(inout) :: status                    !! negative: failed
      integer(hsize_t), intent(in), optional :: chunk(:)  !! (rank) extent of a chunk; absent: of fixed size

      integer(hid_t) :: access, creation, space
      integer(hsize_t) :: most(size(shape))
      integer :: closed, rank

      dataset = -1
      if (status < 0) return
      rank = size(shape)
      most = shape
      if (present(chunk)) most(rank) = h5s_unlimited_f
      if (rank == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(rank, shape, space, status, most)
      end if
      if (status < 0) return
      if (present(chunk)) then
         call growing_lists(rank, chunk, creation, access, status)
         if (status < 0) return
         call h5dcreate_f(file, path, type_id, space, dataset, status, dcpl_id=creation, lcpl_id=link, dapl_id=access)
         call h5pclose_f(access, closed)
         call h5pclose_f(creation, closed)
      else
         call h5dcreate_f(file, path, type_id, space, dataset, status, dcpl_id=of_fixed_size, lcpl_id=link)
      end if
      call h5sclose_f(space, closed)
   end subroutine new_dataset

   !> Properties of a dataset that grows.
   subroutine growing_lists(rank, chunk, creation, access, status)
      integer, intent(in) :: rank                  !! dimensions
      integer(hsize_t), intent(in) :: chunk(rank)  !! (rank) extent of a chunk
      integer(hid_t), intent(out) :: creation      !! of its making, to be closed by the caller
      integer(hid_t), intent(out) :: access        !! of its use, to be closed by the caller
      integer, intent(inout) :: status             !! negative: failed

      ! with its index from the start, so that growing changes one part of the header
      call creation_list(h5p_dataset_create_f, creation, status)
      if (status >= 0) call h5pset_chunk_f(creation, rank, chunk, status)
      if (status >= 0) call h5pset_alloc_time_f(creation, h5d_alloc_time_early_f, status)
      ! only the last chunk is ever touched; a longer list of chunks costs time
      access = -1
      if (status >= 0) call h5pcreate_f(h5p_dataset_access_f, access, status)
      if (status >= 0) call h5pset_chunk_cache_f(access, 1_size_t, 8_size_t*product(int(chunk, size_t)), 1.0, status)
   end subroutine growing_lists

end module hdf5_calls
