!> Where the scenes of a fit come from: one for each set of data and all values of the unknowns.
module fit_source
   use kinds, only: wp
   use parameter_source, only: parameter_source_t
   implicit none (type, external)
   private
   public :: fit_source_t

   !> Makes jobs of a deck for the set and the values in hand; parameter 0: none is changed.
   type, abstract, extends(parameter_source_t) :: fit_source_t
      integer :: set = 1                       !! the set of data
      real(wp), allocatable :: values(:)       !! (parameters) of the unknowns of the deck, SI [any]
   end type fit_source_t

end module fit_source
