!> Where scenes with another value of a parameter come from: who asks for derivatives need not know what a deck is.
module parameter_source
   use jobs, only: job_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: parameter_source_t

   !> Makes jobs of one deck with other values of its parameters.
   type, abstract :: parameter_source_t
   contains
      procedure(make_interface), deferred :: make
   end type parameter_source_t

   abstract interface
      !> The job with one parameter changed, all others as in the deck.
      subroutine make_interface(self, parameter, value, job, reason)
         import :: job_t, parameter_source_t, wp
         implicit none (type, external)
         class(parameter_source_t), intent(inout) :: self    !! the deck
         integer, intent(in) :: parameter                    !! number of the parameter among those asked for
         real(wp), intent(in) :: value                       !! its value, SI [any]
         type(job_t), intent(inout) :: job                   !! the scene with it
         character(:), allocatable, intent(out) :: reason    !! why no mechanism could be made; blank: one was made
      end subroutine make_interface
   end interface

end module parameter_source
