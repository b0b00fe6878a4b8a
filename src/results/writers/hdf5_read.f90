!> Reading back what a run wrote: lists of numbers and of strings.
!>
!> Every procedure does nothing once `status` is negative, and leaves an empty list.
module hdf5_read
   use hdf5, only: h5dclose_f, h5dget_space_f, h5dget_type_f, h5dopen_f, h5dread_f, h5dvlen_reclaim_f, h5lexists_f
   use hdf5, only: h5sclose_f, h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5tclose_f, h5tget_size_f
   use hdf5, only: h5tis_variable_str_f
   use hdf5, only: h5p_default_f, h5t_native_double, hid_t, hsize_t, size_t
   use hdf5_attributes, only: string_type
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_loc, c_null_char, c_ptr, c_size_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: has_dataset, read_reals, read_texts

   interface
      !> Length of a string of C.
      integer(c_size_t) function c_strlen(string) bind(c, name="strlen")
         import :: c_ptr, c_size_t
         implicit none (type, external)
         type(c_ptr), value :: string  !! the string
      end function c_strlen
   end interface

contains

   !> Whether a group has a dataset of some name.
   logical function has_dataset(file, group, name)
      integer(hid_t), intent(in) :: file     !! the file
      character(*), intent(in) :: group      !! path of the group, which may be missing itself
      character(*), intent(in) :: name       !! of the dataset

      integer :: status

      call h5lexists_f(file, group, has_dataset, status)
      if (status >= 0 .and. has_dataset) call h5lexists_f(file, group//"/"//name, has_dataset, status)
      has_dataset = status >= 0 .and. has_dataset
   end function has_dataset

   !> Open a dataset and find how many values it holds.
   subroutine open_dataset(file, path, dataset, n, status)
      integer(hid_t), intent(in) :: file       !! the file
      character(*), intent(in) :: path         !! path within it
      integer(hid_t), intent(out) :: dataset   !! the open dataset
      integer, intent(out) :: n                !! values in it
      integer, intent(inout) :: status         !! negative: failed

      integer(hid_t) :: space
      integer(hsize_t), allocatable :: most(:), shape(:)
      integer :: closed, rank

      dataset = -1
      n = 0
      if (status < 0) return
      call h5dopen_f(file, path, dataset, status)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      if (status >= 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status < 0) return
      allocate (shape(rank), most(rank))
      call h5sget_simple_extent_dims_f(space, shape, most, status)
      n = int(product(shape))
      call h5sclose_f(space, closed)
   end subroutine open_dataset

   !> All numbers of a dataset, in the order of the file.
   subroutine read_reals(file, path, values, status)
      integer(hid_t), intent(in) :: file                            !! the file
      character(*), intent(in) :: path                              !! path within it
      real(wp), allocatable, target, intent(out) :: values(:)       !! (n) the numbers [any]
      integer, intent(inout) :: status                              !! negative: failed

      type(c_ptr) :: memory
      integer(hid_t) :: dataset
      integer :: closed, n

      call open_dataset(file, path, dataset, n, status)
      allocate (values(n), source=0.0_wp)
      memory = c_loc(values)
      if (status >= 0 .and. n > 0) call h5dread_f(dataset, h5t_native_double, memory, status)
      if (dataset >= 0) call h5dclose_f(dataset, closed)
   end subroutine read_reals

   !> All strings of a dataset, of fixed length, or of variable length as run.h5 had them before format 2.2.
   subroutine read_texts(file, path, list, status)
      integer(hid_t), intent(in) :: file                   !! the file
      character(*), intent(in) :: path                     !! path within it
      type(text_t), allocatable, intent(out) :: list(:)    !! (n) the strings
      integer, intent(inout) :: status                     !! negative: failed

      type(c_ptr), allocatable, target :: pointers(:)
      type(c_ptr) :: memory
      character(kind=c_char), pointer :: characters(:)
      integer(hid_t) :: dataset, space, type_id
      integer :: closed, i, k, n
      logical :: has_lengths

      call open_dataset(file, path, dataset, n, status)
      allocate (list(n), pointers(max(n, 1)))
      if (status >= 0) call h5dget_type_f(dataset, type_id, status)
      if (status >= 0) call h5tis_variable_str_f(type_id, has_lengths, status)
      if (status < 0) return
      if (.not. has_lengths) then
         call read_fixed(dataset, type_id, list, status)
         call h5tclose_f(type_id, closed)
         call h5dclose_f(dataset, closed)
         return
      end if
      call h5tclose_f(type_id, closed)
      call string_type(type_id, status)
      memory = c_loc(pointers)
      if (status >= 0 .and. n > 0) call h5dread_f(dataset, type_id, memory, status)
      if (status < 0) return
      do k = 1, n
         if (.not. c_associated(pointers(k))) then
            list(k)%s = ""
            cycle
         end if
         call c_f_pointer(pointers(k), characters, [c_strlen(pointers(k))])
         allocate (character(size(characters)) :: list(k)%s)
         do i = 1, size(characters)
            list(k)%s(i:i) = characters(i)
         end do
      end do
      call h5dget_space_f(dataset, space, closed)
      if (n > 0) call h5dvlen_reclaim_f(type_id, space, h5p_default_f, memory, closed)
      call h5sclose_f(space, closed)
      call h5tclose_f(type_id, closed)
      call h5dclose_f(dataset, closed)
   end subroutine read_texts

   !> Strings of fixed length, which end at a null character.
   subroutine read_fixed(dataset, type_id, list, status)
      integer(hid_t), intent(in) :: dataset        !! the open dataset
      integer(hid_t), intent(in) :: type_id        !! its type
      type(text_t), intent(inout) :: list(:)       !! (n) the strings
      integer, intent(inout) :: status             !! negative: failed

      character(kind=c_char, len=:), allocatable, target :: store
      type(c_ptr) :: memory
      integer(size_t) :: width
      integer :: k

      call h5tget_size_f(type_id, width, status)
      if (status < 0) return
      allocate (character(width*size(list)) :: store)
      memory = c_loc(store)
      if (size(list) > 0) call h5dread_f(dataset, type_id, memory, status)
      if (status < 0) return
      do k = 1, size(list)
         associate (padded => store((k - 1)*width + 1:k*width))
            list(k)%s = padded(:index(padded//c_null_char, c_null_char) - 1)
         end associate
      end do
   end subroutine read_fixed

end module hdf5_read
