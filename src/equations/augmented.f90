!> The contract of solvers of the augmented equations of motion, and their common structure.
!>
!> [ M  Phi_q^T ] [ a      ]   [ g ]
!> [ Phi_q   0  ] [ lambda ] = [ b ]                                         eq. (2.15)
!>
!> Signs: the reaction on the bodies is -Phi_q^T lambda. A planar mass matrix is diagonal, three
!> entries per body. Source: Flores et al. (2008), eqs. (2.14)-(2.18).
module augmented
   use joint_set, only: rows_t
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: augmented_t

   !> A way of solving the augmented equations.
   type, abstract :: augmented_t
      integer(i8) :: n_factorisations = 0  !! factorisations made
   contains
      procedure(name_interface), nopass, deferred :: name
      procedure(prepare_interface), deferred :: prepare
      procedure(solve_interface), deferred :: solve
   end type augmented_t

   abstract interface
      !> The word for it in a deck.
      function name_interface() result(name)
         implicit none (type, external)
         character(:), allocatable :: name  !! as in `solver = name`
      end function name_interface

      !> Structure and workspace for a number of bodies and declared rows.
      subroutine prepare_interface(self, n_body, rows)
         import :: augmented_t, rows_t
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self  !! the solver
         integer, intent(in) :: n_body              !! number of bodies
         type(rows_t), intent(in) :: rows           !! rows, of which the bodies are read
      end subroutine prepare_interface

      !> Accelerations and multipliers. No allocation.
      subroutine solve_interface(self, inverse_mass, rows, g, b, a, lambda, bad_row)
         import :: augmented_t, rows_t, wp
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self   !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (3, 0:bodies) inverse masses, ground 0 [1/kg, 1/kg, 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows            !! rows, of which the Jacobian is read
         real(wp), intent(in), contiguous :: g(:, 0:)             !! (3, 0:bodies) applied forces and moments [N, N, N.m]
         real(wp), intent(in), contiguous :: b(:)                !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
         real(wp), intent(out), contiguous :: a(:, 0:)            !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
         real(wp), intent(out), contiguous :: lambda(:)          !! (rows) multipliers [N or N.m]
         integer, intent(out) :: bad_row             !! row at which the system is singular, 0: none
      end subroutine solve_interface
   end interface

end module augmented
