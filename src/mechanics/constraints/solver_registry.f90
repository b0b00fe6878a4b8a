!> The ways of solving the augmented equations: two lines each (`use`, `case`).
module solver_registry
   use augmented, only: augmented_t
   use augmented_complete, only: augmented_complete_t
   use augmented_lagrangian, only: augmented_lagrangian_t
   use augmented_lapack, only: augmented_lapack_t
   use augmented_schur, only: augmented_schur_t
   use augmented_sparse, only: augmented_sparse_t
   implicit none (type, external)
   private
   public :: n_solver_kinds, new_solver

   integer, parameter :: n_solver_kinds = 5  !! number of ways

contains

   !> Solver number k, 1 to `n_solver_kinds`, not prepared.
   subroutine new_solver(k, solver)
      integer, intent(in) :: k                                   !! number of the way
      class(augmented_t), allocatable, intent(out) :: solver     !! the solver

      select case (k)
      case (1); allocate (augmented_schur_t :: solver)
      case (2); allocate (augmented_sparse_t :: solver)
      case (3); allocate (augmented_lapack_t :: solver)
      case (4); allocate (augmented_complete_t :: solver)
      case (5); allocate (augmented_lagrangian_t :: solver)
      end select
   end subroutine new_solver

end module solver_registry
