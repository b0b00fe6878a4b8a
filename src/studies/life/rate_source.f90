!> The contract of what gives wear per cycle: simulations of a deck, or a law with a known solution.
module rate_source
   use errors, only: error_t
   use kinds, only: wp
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: rate_source_t

   !> What gives wear per cycle.
   type, abstract :: rate_source_t
   contains
      procedure(find_interface), deferred :: find
      procedure :: show => show_nothing
   end type rate_source_t

   abstract interface
      !> What surfaces of some profiles lose in a cycle, from each start of the ensemble.
      subroutine find_interface(self, surfaces, number, settling, rates, values, loads, error)
         import :: error_t, rate_source_t, worn_surface_t, wp
         implicit none (type, external)
         class(rate_source_t), intent(inout) :: self        !! the source
         type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) their profiles
         integer, intent(in) :: number                      !! of the request, from 1: the same for the same profiles
         integer, intent(in) :: settling                    !! settling cycles, as a multiple of those of the plan
         real(wp), intent(out) :: rates(:, :)               !! (n, starts) volumes and distances per cycle [m^3, m]
         real(wp), intent(out) :: values(:)                 !! (conditions) mean extremes of their channels [any]
         real(wp), intent(out) :: loads(:, :)               !! (n_loads, starts) nodes of the loads [m, rad, 1, m^3]
         type(error_t), allocatable, intent(out) :: error   !! a simulation failed
      end subroutine find_interface
   end interface

contains

   !> Show how far the life is: nothing, unless a source knows where.
   subroutine show_nothing(self, fraction)
      class(rate_source_t), intent(inout) :: self   !! the source
      real(wp), intent(in) :: fraction              !! of the life [1]
   end subroutine show_nothing

end module rate_source
