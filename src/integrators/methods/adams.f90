!> Adams' method in Nordsieck's form, variable order 1 to 12 and variable step, by SUNDIALS' CVODE.
!>
!> For smooth motion and small tolerances: one or two evaluations a step. Every event costs a new
!> start at order 1. Not for stiff equations: the fixed-point iteration keeps the step short.
!>
!> Accuracy of events: the event function is zero to round-off, the time as accurate as the motion
!> (docs/theory/evidence/accuracy.md has the figures).
!>
!> Source: A. C. Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396.
module adams
   use cvode_library, only: cvode_library_t
   use integration_method, only: abilities_t, steps_variable
   use kind_info, only: kind_info_t
   use multistep, only: multistep_t
   implicit none (type, external)
   private
   public :: adams_t

   !> The method.
   type, extends(multistep_t) :: adams_t
   contains
      procedure, nopass :: info => adams_info
      procedure, nopass :: abilities => adams_abilities
      procedure :: make_library => adams_make_library
   end type adams_t

contains

   !> Description of the method.
   function adams_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "adams"
      info%help = "Adams-Moulton, variable order and step (CVODE): implicit, for smooth motion at tight tolerances"
      info%source = "Hindmarsh et al. (2005)"
   end function adams_info

   !> A method for smooth motion.
   pure type(abilities_t) function adams_abilities() result(can)
      can = abilities_t(steps=steps_variable, begins_anew=.true., reference_place=2)
   end function adams_abilities

   !> CVODE.
   subroutine adams_make_library(self)
      class(adams_t), intent(inout) :: self  !! the integrator

      type(cvode_library_t), allocatable :: library

      allocate (library)
      library%is_stiff = .false.
      call move_alloc(library, self%library)
   end subroutine adams_make_library

end module adams
