!> The contract of what gives mechanisms with changed parameters: a deck, or a test.
module mechanism_source
   use errors, only: error_t
   use kinds, only: wp
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: mechanism_source_t

   !> What gives mechanisms with changed parameters.
   type, abstract :: mechanism_source_t
   contains
      procedure(build_interface), deferred :: build
      procedure :: show => show_nothing
   end type mechanism_source_t

   abstract interface
      !> The mechanism whose parameters deviate from their nominal values.
      subroutine build_interface(self, deviations, varied, clearances, error)
         import :: error_t, mechanism_source_t, varied_t, wp
         implicit none (type, external)
         class(mechanism_source_t), intent(inout) :: self   !! the source
         real(wp), intent(in) :: deviations(:)              !! (parameters) deviations, SI [any]
         type(varied_t), intent(inout) :: varied            !! its system is built anew and bound
         real(wp), intent(out) :: clearances(:)             !! (pins) radial clearances [m]
         type(error_t), allocatable, intent(out) :: error   !! the deck has errors with these values
      end subroutine build_interface
   end interface

contains

   !> Show how far a study is: nothing, unless a source knows where.
   subroutine show_nothing(self, fraction)
      class(mechanism_source_t), intent(inout) :: self   !! the source
      real(wp), intent(in) :: fraction                   !! of the study [1]
   end subroutine show_nothing

end module mechanism_source
