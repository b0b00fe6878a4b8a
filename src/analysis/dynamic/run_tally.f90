!> What a run adds up and holds the maximum of, over all parts of the mechanism.
module run_tally
   use kinds, only: wp
   use archive, only: archive_t
   use time_in_output, only: output_time_t
   implicit none (type, external)
   private
   public :: run_tally_t

   !> Sums and maxima.
   type :: run_tally_t
      integer :: events = 0                       !! located events
      integer :: contacts = 0                     !! contacts that started
      type(output_time_t) :: aside                 !! CPU time spent on writing events
      real(wp) :: residual = 0.0_wp               !! of the ledger at the last steps [J]
      real(wp) :: level = 0.0_wp                  !! kinetic + elastic energy + |change of potential| there [J]
      real(wp) :: magnitude = 0.0_wp              !! of what the ledger adds up there [J]
      real(wp) :: lost = 0.0_wp                   !! what contacts have lost by then [J]
      real(wp) :: min_lost = 0.0_wp             !! minimum of it so far: negative, they made energy [J]
      real(wp) :: residual_max = 0.0_wp           !! maximum |residual| [J]
      real(wp) :: energy_max = 0.0_wp             !! maximum level [J]
      real(wp) :: violation_max = 0.0_wp          !! maximum |Phi|; rotations times 1 m [m]
      real(wp) :: violation_rate_max = 0.0_wp     !! maximum |dPhi/dt| [m/s]
   contains
      procedure :: save => save_tally
      procedure :: load => load_tally
   end type run_tally_t

contains

   !> Write it.
   subroutine save_tally(self, archive)
      class(run_tally_t), intent(in) :: self  !! the tally
      type(archive_t), intent(inout) :: archive     !! receives it

      call archive%put([self%events, self%contacts])
      call archive%put([self%aside%seconds(), self%residual, self%level, self%magnitude, self%lost, self%min_lost, &
                     self%residual_max, self%energy_max, self%violation_max, self%violation_rate_max])
   end subroutine save_tally

   !> Take it back.
   subroutine load_tally(self, archive)
      class(run_tally_t), intent(inout) :: self  !! the tally
      type(archive_t), intent(inout) :: archive        !! holds it

      real(wp) :: aside  ! [s]

      call archive%get(self%events)
      call archive%get(self%contacts)
      call archive%get(aside)
      call self%aside%begin(aside)
      call archive%get(self%residual)
      call archive%get(self%level)
      call archive%get(self%magnitude)
      call archive%get(self%lost)
      call archive%get(self%min_lost)
      call archive%get(self%residual_max)
      call archive%get(self%energy_max)
      call archive%get(self%violation_max)
      call archive%get(self%violation_rate_max)
   end subroutine load_tally

end module run_tally
