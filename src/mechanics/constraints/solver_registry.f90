!> The ways of solving the augmented equations: two lines each (`use`, `case`), and their number.
module solver_registry
   use augmented, only: augmented_t
   use augmented_complete, only: augmented_complete_t
   use augmented_lagrangian, only: augmented_lagrangian_t
   use augmented_lapack, only: augmented_lapack_t
   use augmented_schur, only: augmented_schur_t
   use augmented_sparse, only: augmented_sparse_t
   implicit none (type, external)
   private
   public :: choose_solver, find_solver, n_solver_kinds, new_solver, reason_of_solver

contains

   !> Number of solvers.
   pure integer function n_solver_kinds()
      n_solver_kinds = 5
   end function n_solver_kinds

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

   !> Solver by its name in a deck, which must be one of them.
   subroutine find_solver(name, solver)
      character(*), intent(in) :: name                           !! the solver's name
      class(augmented_t), allocatable, intent(out) :: solver     !! the solver, not prepared

      integer :: k

      do k = 1, n_solver_kinds()
         call new_solver(k, solver)
         if (solver%name() == name) exit
      end do
   end subroutine find_solver

   !> The cheaper one of the Schur complement and the sparse matrix.
   subroutine choose_solver(schur_is_cheap, solver)
      logical, intent(in) :: schur_is_cheap                      !! the complement is sparse enough, or small
      class(augmented_t), allocatable, intent(out) :: solver     !! the solver, not prepared

      if (schur_is_cheap) then
         allocate (augmented_schur_t :: solver)
      else
         allocate (augmented_sparse_t :: solver)
      end if
   end subroutine choose_solver

   !> Why a solver was chosen.
   function reason_of_solver(solver) result(words)
      class(augmented_t), intent(in) :: solver    !! the solver that was chosen
      character(:), allocatable :: words          !! the reason

      select type (solver)
      type is (augmented_schur_t)
         words = "the same result as pivoting within round-off, and the fastest for these equations"
      type is (augmented_sparse_t)
         words = "high joint count per body: the Schur complement would be dense"
      class default
         words = "set by the stabilisation"
      end select
   end function reason_of_solver

end module solver_registry
