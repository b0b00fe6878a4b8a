!> Backward differentiation of variable order and step on the stabilised form of index 2, by SUNDIALS' IDA.
!>
!> Positions and velocities satisfy their constraints at every step, to the error of Newton's iteration:
!> no stabilisation is needed and none acts. A system without constraints is integrated as it is. The
!> Jacobian by difference quotients over state and multipliers is a full matrix up to 50 bodies, beyond sparse. Newton's iteration
!> continues until the multipliers are found, as what they do to the velocities in a step says; the local error is that of the
!> state.
!>
!> Accuracy of events: the event function is zero to round-off, the time as accurate as the motion
!> (docs/theory/evidence/accuracy.md has the figures).
!>
!> Source: C. W. Gear, B. Leimkuhler and G. K. Gupta, Automatic integration of Euler-Lagrange equations
!> with constraints, J. Comput. Appl. Math. 12-13 (1985) 77-90; A. C. Hindmarsh et al. (2005).
!> Limits: of redundant constraints some are omitted, chosen where an integration starts, and anew where the step has become too
!> small, since those that are kept have come to depend on one another. Friction in joints, which needs the multipliers
!> of all rows, is refused there.
module ida
   use ida_library, only: ida_library_t
   use integration_method, only: abilities_t, steps_variable
   use kind_info, only: kind_info_t
   use multistep, only: multistep_t
   implicit none (type, external)
   private
   public :: ida_t

   !> The method.
   type, extends(multistep_t) :: ida_t
   contains
      procedure, nopass :: info => ida_info
      procedure, nopass :: abilities => ida_abilities
      procedure :: make_library => ida_make_library
   end type ida_t

contains

   !> Description of the method.
   function ida_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "ida"
      info%help = "differential-algebraic, stabilised index 2 (Gear, Gupta, Leimkuhler), backward differentiation (IDA): " &
                  //"enforces positions and velocities without stabilisation"
      info%source = "Gear, Leimkuhler and Gupta (1985); Hindmarsh et al. (2005)"
   end function ida_info

   !> IDA.
   subroutine ida_make_library(self)
      class(ida_t), intent(inout) :: self  !! the integrator

      type(ida_library_t), allocatable :: library

      allocate (library)
      call move_alloc(library, self%library)
      ! off the constraints by more than the local error allowed, the first step after an event fails however short it is
      self%projects = .true.
   end subroutine ida_make_library

   !> A method for stiff equations.
   pure type(abilities_t) function ida_abilities() result(can)
      can = abilities_t(steps=steps_variable, begins_anew=.true., is_explicit=.false., is_stiff=.true., has_sparse_newton=.true., &
                        solves_dae=.true.)
   end function ida_abilities

end module ida
