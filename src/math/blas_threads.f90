!> Keeps BLAS to one thread: the matrices of a mechanism are small, and repeats must be bitwise equal.
!>
!> OpenBLAS is asked by its own call, looked up at run time, so that any other LAPACK links as well.
module blas_threads
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_procpointer, c_funptr, c_int, c_null_char, c_null_ptr, c_ptr
   implicit none (type, external)
   private
   public :: use_one_blas_thread

   interface
      !> Address of a symbol of the running program; POSIX.
      function dlsym(handle, symbol) bind(c, name="dlsym") result(address)
         import :: c_char, c_funptr, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: handle                        !! null: everywhere
         character(kind=c_char), intent(in) :: symbol(*)     !! name, ended by NUL
         type(c_funptr) :: address                           !! null if there is none
      end function dlsym
   end interface

   abstract interface
      !> OpenBLAS's openblas_set_num_threads.
      subroutine set_threads_interface(n) bind(c)
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: n  !! number of threads
      end subroutine set_threads_interface
   end interface

contains

   !> One thread from here on, if the BLAS is OpenBLAS; others are left alone.
   subroutine use_one_blas_thread()
      procedure(set_threads_interface), pointer :: set_threads
      type(c_funptr) :: address

      address = dlsym(c_null_ptr, "openblas_set_num_threads"//c_null_char)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, set_threads)
      call set_threads(1_c_int)
   end subroutine use_one_blas_thread

end module blas_threads
