!> Direct integration: nothing holds the constraints (DIM). Violations grow.
!>
!> Source: Flores et al. (2008), section 2.4.
module hold_none
   use hold, only: hold_t
   implicit none (type, external)
   private
   public :: hold_none_t

   !> Nothing.
   type, extends(hold_t) :: hold_none_t
   contains
      procedure, nopass :: name => none_name
      procedure :: words => none_words
   end type hold_none_t

contains

   !> The word for it in a deck.
   function none_name() result(name)
      character(:), allocatable :: name  !! as in `stabilise = name`

      name = "none"
   end function none_name

   !> What is done, in words.
   function none_words(self) result(words)
      class(hold_none_t), intent(in) :: self   !! the way
      character(:), allocatable :: words       !! as in a deck

      words = self%name()
   end function none_words

end module hold_none
