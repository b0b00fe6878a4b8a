!> Direct integration: nothing holds the constraints (DIM). Violations grow.
!>
!> Source: Flores et al. (2008), section 2.4.
module stabilisation_none
   use stabilisation, only: stabilisation_t
   use kind_info, only: kind_info_t
   implicit none (type, external)
   private
   public :: stabilisation_none_t

   !> Nothing.
   type, extends(stabilisation_t) :: stabilisation_none_t
   contains
      procedure, nopass :: info => none_info
      procedure :: words => none_words
   end type stabilisation_none_t

contains

   !> Description of the method.
   function none_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "none"
      info%help = "none; the constraint violation grows"
      info%source = "Flores et al. (2008), section 2.4"
   end function none_info

   !> What is done, as text.
   function none_words(self) result(words)
      class(stabilisation_none_t), intent(in) :: self   !! the stabilisation method
      character(:), allocatable :: words       !! as in a deck

      words = self%name()
   end function none_words

end module stabilisation_none
