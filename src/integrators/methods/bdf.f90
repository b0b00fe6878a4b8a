!> Backward differentiation, variable order 1 to 5 and variable step, by SUNDIALS' CVODE.
!>
!> For stiff equations: the step follows the motion, not the fastest decay. Newton's iteration with a
!> Jacobian by difference quotients, up to 50 bodies a full matrix with an evaluation for every entry that
!> is no quadrature, beyond sparse. Orders above 2 damp little near the imaginary axis: a stiff
!> spring without damper is followed, not damped.
!>
!> Accuracy of events: the event function is zero to round-off, the time as accurate as the motion
!> (docs/theory/evidence/accuracy.md has the figures).
!>
!> Source: A. C. Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396.
module bdf
   use cvode_library, only: cvode_library_t
   use integration_method, only: abilities_t, steps_variable
   use kind_info, only: kind_info_t
   use multistep, only: multistep_t
   implicit none (type, external)
   private
   public :: bdf_t

   !> The method.
   type, extends(multistep_t) :: bdf_t
   contains
      procedure, nopass :: info => bdf_info
      procedure, nopass :: abilities => bdf_abilities
      procedure :: make_library => bdf_make_library
   end type bdf_t

contains

   !> Description of the method.
   function bdf_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "bdf"
      info%help = "backward differentiation, variable order and step (CVODE): for stiff contacts, springs and dampers"
      info%source = "Hindmarsh et al. (2005)"
   end function bdf_info

   !> CVODE.
   subroutine bdf_make_library(self)
      class(bdf_t), intent(inout) :: self  !! the integrator

      type(cvode_library_t), allocatable :: library

      allocate (library)
      library%is_stiff = .true.
      call move_alloc(library, self%library)
   end subroutine bdf_make_library

   !> A method for stiff equations.
   pure type(abilities_t) function bdf_abilities() result(can)
      can = abilities_t(steps=steps_variable, begins_anew=.true., is_explicit=.false., is_stiff=.true., has_sparse_newton=.true., &
                        reference_place=3)
   end function bdf_abilities

end module bdf
