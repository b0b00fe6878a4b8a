!> Linear equations of which only the product of the matrix with a vector is known, by SUNDIALS' GMRES.
!>
!> Norms are over the scales of the unknowns: the residual of b - A x, each entry over its scale, is made smaller than asked for.
!> Source: A. C. Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396. Limits: up to `most_directions`
!> products for a solution; where these do not suffice it is as good as they made it.
module krylov_solver
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int, c_loc, c_null_ptr, c_ptr
   use fnvector_serial_mod, only: fn_vnew_serial
   use fsunlinsol_spgmr_mod, only: fsunlinsol_spgmr
   use kinds, only: wp
   use sundials, only: fn_vdestroy, fn_vgetarraypointer, fsuncontext_free, fsunlinsolfree, fsunlinsolinitialize, &
      fsunlinsolsetatimes, fsunlinsolsetscalingvectors, fsunlinsolsetzeroguess, n_vector, new_context, sunindextype, sunlinearsolver
   implicit none (type, external)
   private
   public :: krylov_solver_t, product_t

   integer(c_int), parameter :: no_preconditioner = 0_c_int   !! SUNDIALS' number of that
   integer(c_int), parameter :: most_directions = 40_c_int    !! products for a solution
   integer(c_int), parameter :: residual_reduced(2) = [1_c_int, 801_c_int]  !! SUNDIALS' word for that, of versions 6 and 7

   !> A product of a matrix with a vector.
   type, abstract :: product_t
      integer :: status = 0   !! of the evaluations it took: 0 done, > 0 retry with a smaller step, < 0 give up
   contains
      procedure(apply_interface), deferred :: apply
   end type product_t

   !> Who makes the product, for the library's call.
   type :: caller_t
      class(product_t), pointer :: product => null()   !! the product, while a solution is searched
   end type caller_t

   !> The solver of systems of one size.
   type :: krylov_solver_t
      private
      type(caller_t), pointer :: caller => null()          !! what the library hands back
      type(c_ptr) :: context = c_null_ptr                  !! of all its objects
      type(n_vector), pointer :: solution => null()        !! (n) x
      type(n_vector), pointer :: side => null()            !! (n) b
      type(n_vector), pointer :: weight => null()          !! (n) one over the scales
      type(sunlinearsolver), pointer :: linear => null()   !! GMRES
   contains
      procedure :: open => krylov_open
      procedure :: solve => krylov_solve
      final :: krylov_free
   end type krylov_solver_t

   abstract interface
      !> z = A v.
      subroutine apply_interface(self, v, z)
         import :: product_t, wp
         implicit none (type, external)
         class(product_t), intent(inout) :: self      !! the product; `status` is set
         real(wp), intent(in) :: v(:)     !! (n) vector [any]
         real(wp), intent(out) :: z(:)    !! (n) product [any]
      end subroutine apply_interface
   end interface

   interface
      !> Solve; the library's own module has no way to say that there is no matrix.
      integer(c_int) function sunlinsolsolve(linear, matrix, x, b, tolerance) bind(c, name="SUNLinSolSolve")
         import :: c_double, c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: linear          !! the solver
         type(c_ptr), value :: matrix          !! its matrix, or none
         type(c_ptr), value :: x               !! solution
         type(c_ptr), value :: b               !! right side
         real(c_double), value :: tolerance    !! of the residual over the scales [1]
      end function sunlinsolsolve
   end interface

contains

   !> Make the solver for systems of n equations.
   subroutine krylov_open(self, n, status)
      class(krylov_solver_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n                       !! number of equations
      integer, intent(out) :: status                 !! 0, or there is no memory

      status = 0
      if (associated(self%caller)) return
      allocate (self%caller)
      status = new_context(self%context)
      self%solution => fn_vnew_serial(int(n, sunindextype), self%context)
      self%side => fn_vnew_serial(int(n, sunindextype), self%context)
      self%weight => fn_vnew_serial(int(n, sunindextype), self%context)
      if (.not. (associated(self%solution) .and. associated(self%side) .and. associated(self%weight))) status = -1
      if (status /= 0) return
      self%linear => fsunlinsol_spgmr(self%solution, no_preconditioner, most_directions, self%context)
      status = merge(0, -1, associated(self%linear))
      if (status == 0) status = int(fsunlinsolsetatimes(self%linear, c_loc(self%caller), c_funloc(call_product)))
      if (status == 0) status = int(fsunlinsolsetscalingvectors(self%linear, self%weight, self%weight))
      if (status == 0) status = int(fsunlinsolinitialize(self%linear))
   end subroutine krylov_open

   !> Solve A x = b, from x = 0.
   subroutine krylov_solve(self, product, b, scale, part, x, status)
      class(krylov_solver_t), intent(inout) :: self      !! the solver
      class(product_t), intent(inout), target :: product !! the matrix
      real(wp), intent(in) :: b(:)                       !! (n) right side [any]
      real(wp), intent(in) :: scale(:)                   !! (n) scales of the unknowns, positive [any]
      real(wp), intent(in) :: part                       !! of the residual that may be left [1]
      real(wp), intent(out) :: x(:)                      !! (n) solution [any]
      integer, intent(out) :: status                     !! 0 done, > 0 retry with a smaller step, < 0 give up

      real(c_double), pointer :: side(:), solution(:), weight(:)
      integer(c_int) :: outcome

      side => fn_vgetarraypointer(self%side)
      solution => fn_vgetarraypointer(self%solution)
      weight => fn_vgetarraypointer(self%weight)
      side(:) = b
      solution(:) = 0.0_wp
      weight(:) = 1.0_wp/scale
      product%status = 0
      self%caller%product => product
      outcome = fsunlinsolsetzeroguess(self%linear, 1_c_int)
      outcome = sunlinsolsolve(c_loc(self%linear), c_null_ptr, c_loc(self%solution), c_loc(self%side), part*norm2(side*weight))
      nullify (self%caller%product)
      x = solution
      status = product%status
      if (status == 0 .and. outcome /= 0 .and. all(outcome /= residual_reduced)) status = 1
   end subroutine krylov_solve

   !> The product, as the library asks for it.
   integer(c_int) function call_product(user_data, v, z) bind(c, name="") result(status)
      type(c_ptr), value :: user_data       !! the caller
      type(n_vector), intent(inout) :: v    !! vector
      type(n_vector), intent(inout) :: z    !! product

      type(caller_t), pointer :: caller
      real(c_double), pointer :: from(:), to(:)

      call c_f_pointer(user_data, caller)
      from => fn_vgetarraypointer(v)
      to => fn_vgetarraypointer(z)
      call caller%product%apply(from, to)
      status = int(caller%product%status, c_int)
   end function call_product

   !> Free all.
   subroutine krylov_free(self)
      type(krylov_solver_t), intent(inout) :: self   !! the solver

      integer :: status

      if (associated(self%linear)) status = fsunlinsolfree(self%linear)
      if (associated(self%weight)) call fn_vdestroy(self%weight)
      if (associated(self%side)) call fn_vdestroy(self%side)
      if (associated(self%solution)) call fn_vdestroy(self%solution)
      nullify (self%linear, self%weight, self%side, self%solution)  ! a part of a part is finalised twice by some compilers
      if (.not. associated(self%caller)) return
      deallocate (self%caller)
      status = fsuncontext_free(self%context)
   end subroutine krylov_free

end module krylov_solver
