!> Attributes of objects of HDF5, and the types of words and strings, each in one call.
!>
!> As in `hdf5_calls`, every procedure does nothing once `status` is negative. Strings are of variable length and UTF-8, and lie in
!> heaps of the file; words that are replaced in a file that may be read meanwhile are of fixed length and lie where they are named.
!> What most attributes share, the type of strings and the space of one value, is made once and stays for the life of the program.
module hdf5_attributes
   use hdf5, only: h5aclose_f, h5acreate_f, h5aopen_f, h5aexists_f, h5awrite_f, h5sclose_f, h5screate_f, h5screate_simple_f
   use hdf5, only: h5tclose_f, h5tcopy_f, h5tset_cset_f, h5tset_size_f, h5tset_strpad_f
   use hdf5, only: hid_t, hsize_t, size_t, h5s_scalar_f, h5t_c_s1, h5t_cset_utf8_f, h5t_native_double, h5t_native_integer
   use hdf5, only: h5t_std_i32le, h5t_std_i64le, h5t_ieee_f64le, h5t_str_nullpad_f, h5t_str_nullterm_f, h5t_string, h5kind_to_type
   use hdf5, only: h5_integer_kind
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: fixed_string_type, integer_attribute, long_attribute, real_attribute, string_type, text_attribute, word_attribute
   public :: word_type

   integer(hid_t) :: text_id = -1   !! the type of strings, once an attribute was one
   integer(hid_t) :: scalar_id = -1 !! the space of one value, once there was one

contains

   !> The type of strings in the file and in memory.
   subroutine string_type(type_id, status)
      integer(hid_t), intent(out) :: type_id  !! to be closed by the caller
      integer, intent(inout) :: status        !! negative: failed

      type_id = -1
      if (status < 0) return
      call h5tcopy_f(h5t_string, type_id, status)
      if (status >= 0) call h5tset_cset_f(type_id, h5t_cset_utf8_f, status)
   end subroutine string_type

   !> The type of strings of fixed length that end with a null character. Octave reads no others, and those of ASCII alone.
   subroutine fixed_string_type(width, is_ascii, type_id, status)
      integer, intent(in) :: width            !! bytes of the longest one, with the null character
      logical, intent(in) :: is_ascii         !! no string has other characters; else they are UTF-8
      integer(hid_t), intent(out) :: type_id  !! to be closed by the caller
      integer, intent(inout) :: status        !! negative: failed

      type_id = -1
      if (status < 0) return
      call h5tcopy_f(h5t_c_s1, type_id, status)
      if (status >= 0) call h5tset_size_f(type_id, int(width, size_t), status)
      if (status >= 0) call h5tset_strpad_f(type_id, h5t_str_nullterm_f, status)
      if (status >= 0 .and. .not. is_ascii) call h5tset_cset_f(type_id, h5t_cset_utf8_f, status)
   end subroutine fixed_string_type

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

   !> Open an attribute to write it, making it if need be.
   subroutine open_attribute(object, name, type_id, n, attribute, status, is_new)
      integer(hid_t), intent(in) :: object     !! what it belongs to
      character(*), intent(in) :: name         !! its name
      integer(hid_t), intent(in) :: type_id    !! type in the file
      integer, intent(in) :: n                 !! numbers in it, 0: a scalar
      integer(hid_t), intent(out) :: attribute !! the open attribute
      integer, intent(inout) :: status         !! negative: failed
      logical, intent(in), optional :: is_new  !! it cannot be there yet: that is not asked

      integer(hid_t) :: space
      integer :: closed
      logical :: exists

      attribute = -1
      if (status < 0) return
      exists = .true.
      if (present(is_new)) exists = .not. is_new
      if (exists) call h5aexists_f(object, name, exists, status)
      if (status < 0) return
      if (exists) then
         call h5aopen_f(object, name, attribute, status)
         return
      end if
      if (n == 0) then
         if (scalar_id < 0) call h5screate_f(h5s_scalar_f, scalar_id, status)
         if (status >= 0) call h5acreate_f(object, name, type_id, scalar_id, attribute, status)
         return
      end if
      call h5screate_simple_f(1, [int(n, hsize_t)], space, status)
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
   subroutine text_attribute(object, name, value, status, is_new)
      integer(hid_t), intent(in) :: object     !! what it belongs to
      character(*), intent(in) :: name         !! its name
      character(*), intent(in) :: value        !! the string
      integer, intent(inout) :: status         !! negative: failed
      logical, intent(in), optional :: is_new  !! the object has just been made and has none of this name

      character(kind=c_char, len=:), allocatable, target :: store
      type(c_ptr), target :: pointer
      integer(hid_t) :: attribute
      integer :: closed

      if (text_id < 0) call string_type(text_id, status)
      call open_attribute(object, name, text_id, 0, attribute, status, is_new)
      if (status < 0) return
      store = value//c_null_char
      pointer = c_loc(store)
      call h5awrite_f(attribute, text_id, c_loc(pointer), status)
      call h5aclose_f(attribute, closed)
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

end module hdf5_attributes
