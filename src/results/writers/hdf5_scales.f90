!> Names for the dimensions of datasets: HDF5's dimension scales, which xarray and netCDF readers look up.
!>
!> A scale is a dataset of one dimension. Every dimension in run.h5 gets one: readers refuse groups with dimensions that have
!> none. The lists are written here, each in one piece: the library's own way rewrites that of a scale for every
!> dataset that takes it. As in `hdf5_calls`, every procedure does nothing once `status` is negative.
!>
!> Source: HDF5 dimension scale specification (The HDF Group), for names and types of the lists. Limits: a dimension has one scale.
module hdf5_scales
   use hdf5, only: h5aclose_f, h5acreate_f, h5awrite_f, h5dclose_f, h5dopen_f, h5rcreate_f, h5sclose_f, h5screate_simple_f
   use hdf5, only: h5tclose_f, h5tcreate_f, h5tinsert_f, h5tvlen_create_f
   use hdf5, only: h5t_compound_f, h5t_native_integer, h5t_std_ref_obj, hid_t, hobj_ref_t_f, hsize_t, size_t
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_loc, c_null_char, c_ptr, c_size_t
   implicit none (type, external)
   private
   public :: add_scale, close_scales, has_scale, scales_t, take_scales, take_scales_of_path

   integer(size_t), parameter :: reference_bytes = 8   !! of a reference to an object
   integer(size_t), parameter :: use_bytes = 16        !! of an entry in a scale's list, as C aligns it

   !> A dataset that takes a scale, as C lays it out.
   type, bind(c) :: use_t
      integer(c_int64_t) :: dataset = 0   !! reference to it
      integer(c_int) :: dimension = 0     !! its dimension, from 0 in C's order
   end type use_t

   !> A list of references of variable length, as the library takes it.
   type, bind(c) :: vector_t
      integer(c_size_t) :: n = 0   !! references
      type(c_ptr) :: first         !! the first
   end type vector_t

   !> A scale, and who takes it.
   type :: scale_t
      character(:), allocatable :: path        !! of its dataset
      integer(c_int64_t) :: reference = 0      !! to its dataset
      type(use_t), allocatable :: uses(:)      !! (n) datasets that take it
   end type scale_t

   !> All scales of a file.
   type :: scales_t
      type(scale_t), allocatable :: list(:)    !! (n) scales
   end type scales_t

   ! allow(assumed-size)
   interface
      integer(c_int) function c_set_scale(dataset, name) bind(c, name="H5DSset_scale")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: dataset           !! the scale
         character(kind=c_char), intent(in) :: name(*)  !! (n) its name
      end function c_set_scale
   end interface

contains

   !> Make a dataset of one dimension a scale.
   subroutine add_scale(scales, file, path, status)
      type(scales_t), intent(inout) :: scales   !! gets one more
      integer(hid_t), intent(in) :: file        !! the file
      character(*), intent(in) :: path          !! path of the dataset
      integer, intent(inout) :: status          !! negative: failed

      type(scale_t) :: scale
      integer(hid_t) :: dataset
      integer :: closed

      if (.not. allocated(scales%list)) allocate (scales%list(0))
      if (status < 0) return
      scale%path = trim(path)
      allocate (scale%uses(0))
      call find_reference(file, path, scale%reference, status)
      call h5dopen_f(file, path, dataset, status)
      if (status < 0) return
      status = c_set_scale(int(dataset, c_int64_t), trim(path(index(path, "/", back=.true.) + 1:))//c_null_char)
      call h5dclose_f(dataset, closed)
      scales%list = [scales%list, scale]
   end subroutine add_scale

   !> Whether a dataset is one of the scales.
   pure logical function has_scale(scales, path)
      type(scales_t), intent(in) :: scales      !! all scales
      character(*), intent(in) :: path          !! of the dataset

      integer :: k

      has_scale = .false.
      if (.not. allocated(scales%list)) return
      do k = 1, size(scales%list)
         if (scales%list(k)%path == path) has_scale = .true.
      end do
   end function has_scale

   !> Give the dimensions of a dataset that is not open their scales.
   subroutine take_scales_of_path(scales, file, path, names, status)
      type(scales_t), intent(inout) :: scales   !! all scales
      integer(hid_t), intent(in) :: file        !! the file
      character(*), intent(in) :: path          !! of the dataset
      character(*), intent(in) :: names(:)      !! (rank) paths of the scales, in C's order
      integer, intent(inout) :: status          !! negative: failed

      integer(hid_t) :: dataset
      integer :: closed

      if (status < 0) return
      call h5dopen_f(file, path, dataset, status)
      call take_scales(scales, file, dataset, path, names, status)
      call h5dclose_f(dataset, closed)
   end subroutine take_scales_of_path

   !> Give the dimensions of a dataset their scales.
   subroutine take_scales(scales, file, dataset, path, names, status)
      type(scales_t), intent(inout), target :: scales   !! all scales
      integer(hid_t), intent(in) :: file                !! the file
      integer(hid_t), intent(in) :: dataset             !! the open dataset
      character(*), intent(in) :: path                  !! its path
      character(*), intent(in) :: names(:)              !! (rank) paths of the scales, in C's order
      integer, intent(inout) :: status                  !! negative: failed

      type(vector_t), target :: vectors(size(names))
      integer(c_int64_t) :: reference
      integer(hid_t) :: attribute, space, type_id
      integer :: closed, d, k

      call find_reference(file, path, reference, status)
      if (status < 0) return
      do d = 1, size(names)
         do k = 1, size(scales%list)
            if (scales%list(k)%path /= names(d)) cycle
            scales%list(k)%uses = [scales%list(k)%uses, use_t(reference, int(d - 1, c_int))]
            vectors(d) = vector_t(1_c_size_t, c_loc(scales%list(k)%reference))
         end do
      end do
      call h5tvlen_create_f(h5t_std_ref_obj, type_id, status)
      call h5screate_simple_f(1, [size(names, kind=hsize_t)], space, status)
      if (status >= 0) call h5acreate_f(dataset, "DIMENSION_LIST", type_id, space, attribute, status)
      if (status < 0) return
      call h5awrite_f(attribute, type_id, c_loc(vectors), status)
      call h5aclose_f(attribute, closed)
      call h5sclose_f(space, closed)
      call h5tclose_f(type_id, closed)
   end subroutine take_scales

   !> Write who takes each scale.
   subroutine close_scales(scales, file, status)
      type(scales_t), intent(in) :: scales   !! all scales
      integer(hid_t), intent(in) :: file     !! the file
      integer, intent(inout) :: status       !! negative: failed

      type(use_t), allocatable, target :: uses(:)
      integer(hid_t) :: attribute, dataset, space, type_id
      integer :: closed, k

      if (status < 0 .or. .not. allocated(scales%list)) return
      call h5tcreate_f(h5t_compound_f, use_bytes, type_id, status)
      call h5tinsert_f(type_id, "dataset", 0_size_t, h5t_std_ref_obj, status)
      call h5tinsert_f(type_id, "dimension", reference_bytes, h5t_native_integer, status)
      do k = 1, size(scales%list)
         uses = scales%list(k)%uses
         if (status < 0 .or. size(uses) == 0) cycle
         call h5dopen_f(file, scales%list(k)%path, dataset, status)
         call h5screate_simple_f(1, [size(uses, kind=hsize_t)], space, status)
         call h5acreate_f(dataset, "REFERENCE_LIST", type_id, space, attribute, status)
         if (status >= 0) call h5awrite_f(attribute, type_id, c_loc(uses), status)
         call h5aclose_f(attribute, closed)
         call h5sclose_f(space, closed)
         call h5dclose_f(dataset, closed)
      end do
      call h5tclose_f(type_id, closed)
   end subroutine close_scales

   !> Where a dataset is, as the file says it.
   subroutine find_reference(file, path, reference, status)
      integer(hid_t), intent(in) :: file                !! the file
      character(*), intent(in) :: path                  !! path of the dataset
      integer(c_int64_t), intent(out) :: reference      !! reference to it
      integer, intent(inout) :: status                  !! negative: failed

      type(hobj_ref_t_f) :: object

      reference = 0
      if (status < 0) return
      call h5rcreate_f(file, path, object, status)
      reference = int(object%ref, c_int64_t)
   end subroutine find_reference

end module hdf5_scales
