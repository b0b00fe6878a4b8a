!> The few things the writers ask of HDF5, each in one call.
!>
!> Every procedure does nothing once `status` is negative, so that a caller looks at it once at the
!> end. Strings are of variable length and UTF-8, and lie in heaps of the file; words that are replaced in a
!> file that may be read meanwhile are of fixed length and lie where they are named. No object carries a time
!> of its making, so that equal runs give equal files. Shapes are given in Fortran's order: reversed in the file.
module hdf5_calls
   use hdf5, only: h5aclose_f, h5acreate_f, h5aopen_f, h5aexists_f, h5awrite_f, h5dclose_f, h5dcreate_f, h5dwrite_f
   use hdf5, only: h5dont_atexit_f, h5eset_auto_f, h5fcreate_f, h5gclose_f, h5gcreate_f, h5open_f, h5pclose_f, h5pcreate_f
   use hdf5, only: h5d_alloc_time_early_f, h5pset_alloc_time_f, h5pset_chunk_cache_f, h5pset_chunk_f
   use hdf5, only: h5pset_create_inter_group_f, h5pset_local_heap_size_hint_f, h5pset_obj_track_times_f
   use hdf5, only: h5sclose_f, h5screate_f, h5screate_simple_f, h5tclose_f, h5tcopy_f, h5tset_cset_f, h5tset_size_f
   use hdf5, only: h5tset_strpad_f
   use hdf5, only: hid_t, hsize_t, size_t
   use hdf5, only: h5f_acc_trunc_f, h5p_dataset_access_f, h5p_dataset_create_f, h5p_file_access_f, h5p_file_create_f
   use hdf5, only: h5p_group_create_f, h5p_link_create_f
   use hdf5, only: h5s_scalar_f, h5s_unlimited_f, h5t_c_s1, h5t_cset_utf8_f, h5t_native_double, h5t_native_integer
   use hdf5, only: h5t_std_i32le, h5t_std_i64le, h5t_ieee_f64le, h5t_str_nullpad_f, h5t_string, h5kind_to_type, h5_integer_kind
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_loc, c_null_char, c_ptr
   use kinds, only: i8, wp
   use posix, only: set_default_variable
   use text, only: text_t
   implicit none (type, external)
   private
   public :: creation_list, describe, integer_attribute, is_memory_short, long_attribute, new_dataset, new_file, new_group
   public :: open_library, real_attribute
   public :: integer_dataset, real_dataset, string_type, text_attribute, text_dataset, word_attribute, word_type

   logical :: is_open = .false.  !! whether the library has been opened

   integer(size_t), parameter :: bytes_of_names = 1024  !! for the names in the root group, with room for what comes at the end

   interface
      !> Whether so many bytes could be had at once: 1 or 0.
      integer(c_int) function c_has_room(bytes) bind(c, name="gudgeon_has_room")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: bytes  !! that are wanted
      end function c_has_room

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

      is_memory_short = c_has_room(little) == 0
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

   !> Properties of a new name that makes the groups above it.
   subroutine link_list(list, status)
      integer(hid_t), intent(out) :: list  !! to be closed by the caller
      integer, intent(inout) :: status     !! negative: failed

      list = -1
      if (status < 0) return
      call h5pcreate_f(h5p_link_create_f, list, status)
      if (status >= 0) call h5pset_create_inter_group_f(list, 1, status)
   end subroutine link_list

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
      if (status >= 0) call h5pcreate_f(h5p_file_access_f, access, status)
      if (status < 0) return
      status = c_set_driver(int(access, c_int64_t))
      if (status >= 0) call h5fcreate_f(path, h5f_acc_trunc_f, file, status, creation, access)
      call h5pclose_f(creation, closed)
      call h5pclose_f(access, closed)
   end subroutine new_file

   !> Make a group, and those above it.
   subroutine new_group(file, path, group, status)
      integer(hid_t), intent(in) :: file    !! file or group
      character(*), intent(in) :: path      !! path within it
      integer(hid_t), intent(out) :: group  !! the open group
      integer, intent(inout) :: status      !! negative: failed

      integer(hid_t) :: creation, link
      integer :: closed

      group = -1
      if (status < 0) return
      call creation_list(h5p_group_create_f, creation, status)
      call link_list(link, status)
      if (status < 0) return
      call h5gcreate_f(file, path, group, status, lcpl_id=link, gcpl_id=creation)
      call h5pclose_f(creation, closed)
      call h5pclose_f(link, closed)
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

      integer(hid_t) :: access, creation, link, space
      integer(hsize_t) :: most(size(shape))
      integer :: closed, rank

      dataset = -1
      if (status < 0) return
      rank = size(shape)
      most = shape
      if (present(chunk)) most(rank) = h5s_unlimited_f
      call creation_list(h5p_dataset_create_f, creation, status)
      if (status >= 0 .and. present(chunk)) then  ! with its index from the start, so that growing changes one part of the header
         call h5pset_chunk_f(creation, rank, chunk, status)
         if (status >= 0) call h5pset_alloc_time_f(creation, h5d_alloc_time_early_f, status)
      end if
      call link_list(link, status)
      if (status < 0) return
      if (rank == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(rank, shape, space, status, most)
      end if
      if (status >= 0) call h5pcreate_f(h5p_dataset_access_f, access, status)
      if (status < 0) return
      if (present(chunk)) then  ! only the last chunk is ever touched; a longer list of chunks costs time
         call h5pset_chunk_cache_f(access, 1_size_t, 8_size_t*product(int(chunk, size_t)), 1.0, status)
      end if
      call h5dcreate_f(file, path, type_id, space, dataset, status, dcpl_id=creation, lcpl_id=link, dapl_id=access)
      call h5sclose_f(space, closed)
      call h5pclose_f(access, closed)
      call h5pclose_f(creation, closed)
      call h5pclose_f(link, closed)
   end subroutine new_dataset

   !> Say what a dataset holds.
   subroutine describe(dataset, units, long_name, frame, status)
      integer(hid_t), intent(in) :: dataset  !! the dataset
      character(*), intent(in) :: units      !! SI unit, `1` if none
      character(*), intent(in) :: long_name  !! one line
      character(*), intent(in) :: frame      !! world, body, joint or none
      integer, intent(inout) :: status       !! negative: failed

      call text_attribute(dataset, "units", units, status)
      call text_attribute(dataset, "long_name", long_name, status)
      call text_attribute(dataset, "frame", frame, status)
   end subroutine describe

   !> The type of strings in the file and in memory.
   subroutine string_type(type_id, status)
      integer(hid_t), intent(out) :: type_id  !! to be closed by the caller
      integer, intent(inout) :: status        !! negative: failed

      type_id = -1
      if (status < 0) return
      call h5tcopy_f(h5t_string, type_id, status)
      if (status >= 0) call h5tset_cset_f(type_id, h5t_cset_utf8_f, status)
   end subroutine string_type

   !> The type of words of fixed length, shorter ones padded with null characters.
   subroutine word_type(width, type_id, status)
      integer, intent(in) :: width            !! bytes of a word
      integer(hid_t), intent(out) :: type_id  !! to be closed by the caller
      integer, intent(inout) :: status        !! negative: failed

      type_id = -1
      if (status < 0) return
      call h5tcopy_f(h5t_c_s1, type_id, status)
      if (status >= 0) call h5tset_size_f(type_id, int(width, size_t), status)
      if (status >= 0) call h5tset_strpad_f(type_id, h5t_str_nullpad_f, status)
   end subroutine word_type

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
      if (status >= 0 .and. size(list) > 0) call h5dwrite_f(dataset, type_id, c_loc(pointers), status)
      call describe(dataset, "1", long_name, "none", status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
      call h5tclose_f(type_id, closed)
   end subroutine text_dataset

   !> Make a dataset of reals and write it.
   subroutine real_dataset(file, path, shape, values, units, long_name, status)
      integer(hid_t), intent(in) :: file        !! file or group
      character(*), intent(in) :: path          !! path within it
      integer, intent(in) :: shape(:)           !! (rank) extent, in Fortran's order
      real(wp), intent(in) :: values(:)         !! (product of shape) the numbers [any]
      character(*), intent(in) :: units         !! SI unit, `1` if none, or a list of them
      character(*), intent(in) :: long_name     !! what they are
      integer, intent(inout) :: status          !! negative: failed

      real(wp), allocatable, target :: store(:)
      integer(hid_t) :: dataset
      integer :: closed

      call new_dataset(file, path, h5t_ieee_f64le, int(shape, hsize_t), dataset, status)
      store = [values, 0.0_wp]
      if (status >= 0 .and. size(values) > 0) call h5dwrite_f(dataset, h5t_native_double, c_loc(store), status)
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

   !> Open an attribute to write it, making it if need be.
   subroutine open_attribute(object, name, type_id, n, attribute, status)
      integer(hid_t), intent(in) :: object     !! what it belongs to
      character(*), intent(in) :: name         !! its name
      integer(hid_t), intent(in) :: type_id    !! type in the file
      integer, intent(in) :: n                 !! numbers in it, 0: a scalar
      integer(hid_t), intent(out) :: attribute !! the open attribute
      integer, intent(inout) :: status         !! negative: failed

      integer(hid_t) :: space
      integer :: closed
      logical :: exists

      attribute = -1
      if (status < 0) return
      call h5aexists_f(object, name, exists, status)
      if (status < 0) return
      if (exists) then
         call h5aopen_f(object, name, attribute, status)
         return
      end if
      if (n == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(1, [int(n, hsize_t)], space, status)
      end if
      if (status < 0) return
      call h5acreate_f(object, name, type_id, space, attribute, status)
      call h5sclose_f(space, closed)
   end subroutine open_attribute

   !> Write a word as an attribute, within the header of the object; one that is there is replaced in its place.
   subroutine word_attribute(object, name, value, width, status)
      integer(hid_t), intent(in) :: object  !! what it belongs to
      character(*), intent(in) :: name      !! its name
      character(*), intent(in) :: value     !! the word
      integer, intent(in) :: width          !! bytes of the longest word that it may hold
      integer, intent(inout) :: status      !! negative: failed

      character(kind=c_char, len=width), target :: store
      integer(hid_t) :: attribute, type_id
      integer :: closed

      call word_type(width, type_id, status)
      call open_attribute(object, name, type_id, 0, attribute, status)
      if (status < 0) return
      store = value//repeat(c_null_char, max(width - len(value), 0))
      call h5awrite_f(attribute, type_id, c_loc(store), status)
      call h5aclose_f(attribute, closed)
      call h5tclose_f(type_id, closed)
   end subroutine word_attribute

   !> Write a string as an attribute; a string that is there is replaced, where nobody reads the file meanwhile: some versions of
   !> the library take the old one from its heap before the header knows of the new one.
   subroutine text_attribute(object, name, value, status)
      integer(hid_t), intent(in) :: object  !! what it belongs to
      character(*), intent(in) :: name      !! its name
      character(*), intent(in) :: value     !! the string
      integer, intent(inout) :: status      !! negative: failed

      character(kind=c_char, len=:), allocatable, target :: store
      type(c_ptr), target :: pointer
      integer(hid_t) :: attribute, type_id
      integer :: closed

      call string_type(type_id, status)
      call open_attribute(object, name, type_id, 0, attribute, status)
      if (status < 0) return
      store = value//c_null_char
      pointer = c_loc(store)
      call h5awrite_f(attribute, type_id, c_loc(pointer), status)
      call h5aclose_f(attribute, closed)
      call h5tclose_f(type_id, closed)
   end subroutine text_attribute

   !> Write 32-bit integers as an attribute.
   subroutine integer_attribute(object, name, values, status)
      integer(hid_t), intent(in) :: object        !! what it belongs to
      character(*), intent(in) :: name            !! its name
      integer, intent(in) :: values(:)            !! (n) the numbers
      integer, intent(inout) :: status            !! negative: failed

      integer, target :: store(size(values))
      integer(hid_t) :: attribute
      integer :: closed

      call open_attribute(object, name, h5t_std_i32le, size(values), attribute, status)
      if (status < 0) return
      store = values
      call h5awrite_f(attribute, h5t_native_integer, c_loc(store), status)
      call h5aclose_f(attribute, closed)
   end subroutine integer_attribute

   !> Write a 64-bit integer as an attribute.
   subroutine long_attribute(object, name, value, status)
      integer(hid_t), intent(in) :: object  !! what it belongs to
      character(*), intent(in) :: name      !! its name
      integer(i8), intent(in) :: value      !! the number
      integer, intent(inout) :: status      !! negative: failed

      integer(i8), target :: store
      integer(hid_t) :: attribute
      integer :: closed

      call open_attribute(object, name, h5t_std_i64le, 0, attribute, status)
      if (status < 0) return
      store = value
      call h5awrite_f(attribute, h5kind_to_type(i8, h5_integer_kind), c_loc(store), status)
      call h5aclose_f(attribute, closed)
   end subroutine long_attribute

   !> Write a real as an attribute.
   subroutine real_attribute(object, name, value, status)
      integer(hid_t), intent(in) :: object  !! what it belongs to
      character(*), intent(in) :: name      !! its name
      real(wp), intent(in) :: value         !! the number [any]
      integer, intent(inout) :: status      !! negative: failed

      real(wp), target :: store
      integer(hid_t) :: attribute
      integer :: closed

      call open_attribute(object, name, h5t_ieee_f64le, 0, attribute, status)
      if (status < 0) return
      store = value
      call h5awrite_f(attribute, h5t_native_double, c_loc(store), status)
      call h5aclose_f(attribute, closed)
   end subroutine real_attribute

end module hdf5_calls
