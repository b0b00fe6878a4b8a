!> Keeps BLAS to one thread: the matrices of a mechanism are small, and repeats must be bitwise equal.
!>
!> OpenBLAS is asked by its own call, looked up at run time, so that any other LAPACK links as well. It starts with a thread for
!> each processor, and each of them, like the first call of the program itself, asks the system for a buffer again and again,
!> for ever if there is no storage for it. So where room is short the program starts anew with one thread from the start, and
!> where it does not suffice for the one buffer it ends.
module blas_threads
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_f_procpointer, c_funptr, c_int, &
      c_int64_t, c_null_char, c_null_ptr, c_ptr
   use errors, only: error_t, exit_file, set_error
   use kinds, only: i8
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: blas_kernels, use_one_blas_thread

   integer(i8), parameter :: megabyte = 1048576_i8                  !! bytes
   integer(i8), parameter :: buffer_of_blas = 128_i8*megabyte       !! largest of OpenBLAS 0.3, BUFFER_SIZE of its param.h [byte]
   integer(i8), parameter :: group_of_program = 32_i8*megabyte       !! for a small mechanism [byte]
   character(*), parameter :: threads_variable = "OPENBLAS_NUM_THREADS"  !! read by OpenBLAS as it is loaded

   interface
      !> Address of a symbol of the running program; POSIX.
      function dlsym(handle, symbol) bind(c, name="dlsym") result(address)
         import :: c_char, c_funptr, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: handle                        !! null: everywhere
         character(kind=c_char), intent(in) :: symbol(*)     !! name, ended by NUL
         type(c_funptr) :: address                           !! null if there is none
      end function dlsym

      integer(c_int) function c_has_capacity(bytes) bind(c, name="gudgeon_has_room")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: bytes  !! that are requested at once
      end function c_has_capacity

      integer(c_int) function c_is_limited() bind(c, name="gudgeon_is_limited")
         import :: c_int
         implicit none (type, external)
      end function c_is_limited

      subroutine c_start_again(name, setting, n, arguments) bind(c, name="gudgeon_start_again")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: name(*)       !! environment variable
         character(kind=c_char), intent(in) :: setting(*)    !! its value
         integer(c_int), value :: n                          !! number of arguments
         character(kind=c_char), intent(in) :: arguments(*)  !! the program's arguments, each with its null character
      end subroutine c_start_again
   end interface

   abstract interface
      !> OpenBLAS's openblas_set_num_threads.
      subroutine set_threads_interface(n) bind(c)
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: n  !! number of threads
      end subroutine set_threads_interface

      !> OpenBLAS's openblas_get_corename.
      function kernels_interface() bind(c) result(name)
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr) :: name  !! a string of C
      end function kernels_interface

      !> OpenBLAS's blas_memory_alloc.
      function allocate_interface(position) bind(c) result(buffer)
         import :: c_int, c_ptr
         implicit none (type, external)
         integer(c_int), value :: position  !! not used
         type(c_ptr) :: buffer              !! one of its buffers
      end function allocate_interface

      !> OpenBLAS's blas_memory_free.
      subroutine free_interface(buffer) bind(c)
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: buffer  !! kept by OpenBLAS for the next call
      end subroutine free_interface
   end interface

contains

   !> One thread from here on, if the BLAS is OpenBLAS; others are left alone.
   subroutine use_one_blas_thread(error)
      type(error_t), allocatable, intent(out) :: error  !! there is no storage for its buffer

      procedure(set_threads_interface), pointer :: set_threads
      type(c_funptr) :: address
      character(2) :: threads
      integer :: status

      address = dlsym(c_null_ptr, "openblas_set_num_threads"//c_null_char)
      if (.not. c_associated(address)) return
      if (c_is_limited() /= 0 .or. c_has_capacity(buffer_of_blas + group_of_program) == 0) then
         call get_environment_variable(threads_variable, threads, status=status)
         if (status /= 0 .or. threads /= "1") call begin_anew()
         if (c_has_capacity(buffer_of_blas + group_of_program) == 0) then
            call set_error(error, exit_file, "the memory limit is too low: OpenBLAS and the program need "// &
                           to_text((buffer_of_blas + group_of_program)/megabyte)//" MB more than available (ulimit -v limits "// &
                              "the "// &
                           "address space)")
            return
         end if
         call take_buffer()
      end if
      call c_f_procpointer(address, set_threads)
      call set_threads(1_c_int)
   end subroutine use_one_blas_thread

   !> The kernels that OpenBLAS has chosen, as it calls them; blank of another BLAS.
   function blas_kernels() result(name)
      character(:), allocatable :: name  !! as `Haswell`

      procedure(kernels_interface), pointer :: get_name
      character(kind=c_char), pointer :: letters(:)
      type(c_funptr) :: address
      integer :: k

      name = ""
      address = dlsym(c_null_ptr, "openblas_get_corename"//c_null_char)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, get_name)
      call c_f_pointer(get_name(), letters, [32])
      do k = 1, size(letters)
         if (letters(k) == c_null_char) exit
         name = name//letters(k)
      end do
   end function blas_kernels

   !> Start the program anew with one thread; returns if that is not possible.
   subroutine begin_anew()
      type(buffer_t) :: list
      character(:), allocatable :: argument
      integer :: k, length

      do k = 0, command_argument_count()
         call get_command_argument(k, length=length)
         allocate (character(length) :: argument)
         call get_command_argument(k, argument)
         call list%add(argument//c_null_char)
         deallocate (argument)
      end do
      call c_start_again(threads_variable//c_null_char, "1"//c_null_char, int(command_argument_count() + 1, c_int), list%get())
   end subroutine begin_anew

   !> Let OpenBLAS take its buffer while there is storage for it.
   subroutine take_buffer()
      procedure(allocate_interface), pointer :: allocate_buffer
      procedure(free_interface), pointer :: free_buffer
      type(c_funptr) :: allocating, freeing

      allocating = dlsym(c_null_ptr, "blas_memory_alloc"//c_null_char)
      freeing = dlsym(c_null_ptr, "blas_memory_free"//c_null_char)
      if (.not. c_associated(allocating) .or. .not. c_associated(freeing)) return
      call c_f_procpointer(allocating, allocate_buffer)
      call c_f_procpointer(freeing, free_buffer)
      call free_buffer(allocate_buffer(0_c_int))
   end subroutine take_buffer

end module blas_threads
