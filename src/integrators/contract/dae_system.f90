!> The contract of a constrained system in the stabilised form of index 2 (Gear, Gupta, Leimkuhler).
!>
!> $$ q' = v - W J^T mu,  v' = M^{-1} (g - J^T lambda),  0 = J v + Phi_t,  0 = Phi,  z' = powers $$
!>
!> with J = Phi_q and W = M^{-1}, so that mu, the multiplier that keeps the positions on the
!> constraints, is an impulse; it vanishes for the exact solution. The state y = (q, v, others, z) is that
!> of the ordinary form, to which the same system answers as `evaluate`. Of rows that depend on others where an integration starts
!> the system leaves some out, so that the others are independent: their equations are lambda = 0 and mu = 0.
!>
!> Source: C. W. Gear, B. Leimkuhler and G. K. Gupta, Automatic integration of Euler-Lagrange
!> equations with constraints, J. Comput. Appl. Math. 12-13 (1985) 77-90.
module dae_system
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: dae_system_t

   !> A constrained system.
   type, abstract, extends(ode_system_t) :: dae_system_t
      integer :: n_row = 0                     !! number of constraint rows, m
      logical :: is_large = .false.            !! so large that implicit methods keep its matrices sparse
   contains
      procedure(begin_interface), deferred :: begin_form
      procedure(leaves_interface), deferred :: leaves_out
      procedure(residual_interface), deferred :: dae_residual
      procedure(pattern_interface), deferred :: dae_pattern
      procedure(spread_interface), deferred :: dae_spread
      procedure(multipliers_interface), deferred :: multipliers
      procedure(effect_interface), deferred :: effect_of
   end type dae_system_t

   abstract interface
      !> An integration starts at the state of the last evaluation: choose the rows that are omitted.
      subroutine begin_interface(self)
         import :: dae_system_t
         implicit none (type, external)
         class(dae_system_t), intent(inout) :: self   !! the system
      end subroutine begin_interface

      !> Whether it omits any.
      pure logical function leaves_interface(self) result(does)
         import :: dae_system_t
         implicit none (type, external)
         class(dae_system_t), intent(in) :: self   !! the system
      end function leaves_interface

      !> What is left of the equations: left side less right side. Status: 0 done, > 0 retry with a
      !> smaller step, < 0 give up.
      subroutine residual_interface(self, t, y, ydot, lambda, mu, r_y, r_lambda, r_mu, status)
         import :: dae_system_t, wp
         implicit none (type, external)
         class(dae_system_t), intent(inout) :: self   !! the system
         real(wp), intent(in) :: t                    !! time [s]
         real(wp), intent(in), contiguous :: y(:)     !! (n) state [any]
         real(wp), intent(in), contiguous :: ydot(:)  !! (n) its derivative [any]
         real(wp), intent(in) :: lambda(:)            !! (m) multipliers of the velocities [N or N.m]
         real(wp), intent(in) :: mu(:)                !! (m) multipliers of the positions [N.s or N.m.s]
         real(wp), intent(out), contiguous :: r_y(:)  !! (n) of the differential equations [any]
         real(wp), intent(out) :: r_lambda(:)         !! (m) rates of the violation [m/s or rad/s]
         real(wp), intent(out) :: r_mu(:)             !! (m) violations [m or rad]
         integer, intent(out) :: status               !! outcome
      end subroutine residual_interface

      !> Which rows of the residual (of y, lambda, mu) depend on which of the unknowns (y, lambda, mu): all that may ever,
      !> quadratures on themselves only. The columns of mu have the rows of those of lambda, as far as they are of positions.
      subroutine pattern_interface(self, column, row)
         import :: dae_system_t
         implicit none (type, external)
         class(dae_system_t), intent(in) :: self             !! the system
         integer, allocatable, intent(out) :: column(:)      !! (n + 2 m + 1) place of the first entry of each column, from 0
         integer, allocatable, intent(out) :: row(:)         !! (entries) rows, from 0
      end subroutine pattern_interface

      !> Values of the entries of lambda's columns, which are those of mu's as well, at the state of the last residual.
      subroutine spread_interface(self, values)
         import :: dae_system_t, wp
         implicit none (type, external)
         class(dae_system_t), intent(in) :: self   !! the system
         real(wp), intent(out) :: values(:)        !! (entries of those columns) in the order of the pattern [any]
      end subroutine spread_interface

      !> Multipliers of the last evaluation.
      subroutine multipliers_interface(self, lambda)
         import :: dae_system_t, wp
         implicit none (type, external)
         class(dae_system_t), intent(in) :: self   !! the system
         real(wp), intent(out) :: lambda(:)        !! (m) multipliers [N or N.m]
      end subroutine multipliers_interface

      !> How fast a change of the multipliers changes the velocities, M^{-1} Phi_q^T of it at the motion of the last residual: the
      !> norm over the error scales.
      real(wp) function effect_interface(self, change, scale) result(effect)
         import :: dae_system_t, wp
         implicit none (type, external)
         class(dae_system_t), intent(inout) :: self   !! the system
         real(wp), intent(in) :: change(:)            !! (m) of lambda [N or N.m]
         real(wp), intent(in) :: scale(:)             !! (n) error scales of the state [any]
      end function effect_interface
   end interface

end module dae_system
