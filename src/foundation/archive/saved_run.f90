!> All that a run must remember to continue: of each part of the mechanism, of the whole, of the output.
module saved_run
   use archive, only: archive_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: saved_run_t
   public :: action_checkpoint, action_none, action_stop

   integer, parameter :: action_none = 0     !! continue
   integer, parameter :: action_checkpoint = 1  !! save what is remembered as soon as it can be, and continue
   integer, parameter :: action_stop = 2        !! save it as soon as it can be, and end

   !> What is remembered.
   type :: saved_run_t
      real(wp) :: t = 0.0_wp                        !! time of the motion [s]
      type(archive_t), allocatable :: parts(:)      !! (parts) of each part; of several, one more: of the whole
      type(archive_t) :: motion                        !! of the whole motion, its samples and sums
      type(archive_t) :: output                        !! of what keeps the results
   end type saved_run_t

end module saved_run
