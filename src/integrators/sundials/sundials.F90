!> What the program uses of SUNDIALS and what differs between its versions 6 and 7 and between its two kinds of index.
!>
!> The Makefile finds out what is installed: SUNDIALS_VERSION is 6 or 7, SUNDIALS_INDEX the bits of `sunindextype`.
!>
!> Objects made here write no messages of their own: what goes wrong is a status, and the program's to report. In
!> version 7 messages go through the context (no error handlers, no logger), before through each solver's memory.
!>
!> Source: user guides of CVODE, IDA and KINSOL 6 and 7. Limits: one process, no MPI.
module sundials
   use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_int32_t, c_int64_t, c_null_ptr, c_ptr
#if SUNDIALS_VERSION >= 7
   use fcvode_mod, only: new_cvode => fcvodecreate
   use fida_mod, only: new_ida => fidacreate
   use fkinsol_mod, only: new_kinsol => fkincreate
   use fsundials_core_mod, only: fn_vdestroy, fn_vgetarraypointer, fsuncontext_clearerrhandlers, fsuncontext_create, &
      fsuncontext_free, fsuncontext_setlogger, fsunlinsolfree, fsunlinsolinitialize, fsunlinsolsetatimes, &
      fsunlinsolsetscalingvectors, fsunlinsolsetzeroguess, fsunmatdestroy, fsunnonlinsolfree, fsunnonlinsolgetcuriter, &
      fsunnonlinsolsetconvtestfn, n_vector, n_vector_ops, sun_comm_null, sunlinearsolver, sunmatrix, sunnonlinearsolver
#else
   use fcvode_mod, only: fcvodecreate, fcvodeseterrfile
   use fida_mod, only: fidacreate, fidaseterrfile
   use fkinsol_mod, only: fkincreate, fkinseterrfile
   use fsundials_context_mod, only: fsuncontext_create, fsuncontext_free
   use fsundials_linearsolver_mod, only: fsunlinsolfree, fsunlinsolinitialize, fsunlinsolsetatimes, fsunlinsolsetscalingvectors, &
      fsunlinsolsetzeroguess, sunlinearsolver
   use fsundials_matrix_mod, only: fsunmatdestroy, sunmatrix
   use fsundials_nonlinearsolver_mod, only: fsunnonlinsolfree, fsunnonlinsolgetcuriter, fsunnonlinsolsetconvtestfn, &
      sunnonlinearsolver
   use fsundials_nvector_mod, only: fn_vdestroy, fn_vgetarraypointer, n_vector, n_vector_ops
#endif
   implicit none (type, external)
   private
   public :: fn_vdestroy, fn_vgetarraypointer, fsuncontext_free, fsunlinsolfree, fsunlinsolinitialize, fsunlinsolsetatimes, &
      fsunlinsolsetscalingvectors, fsunlinsolsetzeroguess, fsunmatdestroy, fsunnonlinsolfree, fsunnonlinsolgetcuriter, &
      fsunnonlinsolsetconvtestfn, n_vector, n_vector_ops, sunlinearsolver, sunmatrix, sunnonlinearsolver
   public :: new_context, new_cvode, new_ida, new_kinsol, sunindextype

#if SUNDIALS_INDEX == 64
   integer, parameter :: sunindextype = c_int64_t  !! kind of lengths of vectors and matrices
#else
   integer, parameter :: sunindextype = c_int32_t  !! kind of lengths of vectors and matrices
#endif

contains

   !> A context, which all objects of the library belong to.
   integer function new_context(context) result(status)
      type(c_ptr), intent(out) :: context  !! the context

#if SUNDIALS_VERSION >= 7
      status = int(fsuncontext_create(sun_comm_null, context))
      if (status == 0) status = int(fsuncontext_clearerrhandlers(context))
      if (status == 0) status = int(fsuncontext_setlogger(context, c_null_ptr))
#else
      status = int(fsuncontext_create(c_null_ptr, context))
#endif
   end function new_context

#if SUNDIALS_VERSION < 7
   !> CVODE's memory.
   type(c_ptr) function new_cvode(method, context) result(memory)
      integer(c_int), intent(in) :: method  !! cv_adams or cv_bdf
      type(c_ptr), intent(in) :: context    !! the context

      memory = fcvodecreate(method, context)
      if (.not. c_associated(memory)) return
      if (fcvodeseterrfile(memory, c_null_ptr) /= 0) memory = c_null_ptr
   end function new_cvode

   !> IDA's memory.
   type(c_ptr) function new_ida(context) result(memory)
      type(c_ptr), intent(in) :: context    !! the context

      memory = fidacreate(context)
      if (.not. c_associated(memory)) return
      if (fidaseterrfile(memory, c_null_ptr) /= 0) memory = c_null_ptr
   end function new_ida

   !> KINSOL's memory.
   type(c_ptr) function new_kinsol(context) result(memory)
      type(c_ptr), intent(in) :: context    !! the context

      memory = fkincreate(context)
      if (.not. c_associated(memory)) return
      if (fkinseterrfile(memory, c_null_ptr) /= 0) memory = c_null_ptr
   end function new_kinsol
#endif

end module sundials
