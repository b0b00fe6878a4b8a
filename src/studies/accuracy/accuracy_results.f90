!> What a run whose accuracy was asked for knows of its errors.
module accuracy_results
   use growth, only: growth_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: accuracy_t, evidence_t, extreme_t
   public :: claim_none, claim_reached, claim_whole, claim_window, claim_words

   integer, parameter :: claim_none = 0     !! nothing confirms the run: no error of it is known
   integer, parameter :: claim_whole = 1    !! the error asked for, up to the end
   integer, parameter :: claim_window = 2   !! the error asked for, up to the horizon
   integer, parameter :: claim_reached = 3  !! up to the end a greater error than the one asked for
   character(*), parameter :: claim_words(0:3) = [character(8) :: "none", "end", "horizon", "reached"]  !! in files

   !> The extremes of a channel up to the last time that is claimed, and their errors.
   type :: extreme_t
      character(:), allocatable :: name    !! as `slider.position.x`
      character(:), allocatable :: unit    !! SI, `1` if none
      real(wp) :: scale = 0.0_wp           !! what relative errors of the channel are parts of [any]
      real(wp) :: error = 0.0_wp           !! maximum error of the channel, and half the interval of its extremes [any]
      real(wp) :: minimum = 0.0_wp           !! minimum value [any]
      real(wp) :: most = 0.0_wp            !! maximum value [any]
   end type extreme_t

   !> What the claim rests on.
   type :: evidence_t
      character(:), allocatable :: coarser           !! run at the tolerance before: `verner 1e-8`
      character(:), allocatable :: confirmation      !! what confirms it: `adams 1e-9`; blank: nothing
      real(wp) :: apart(2) = 0.0_wp                  !! (2) maximum relative difference to each of them up to `until` [1]
      real(wp) :: factor = 0.0_wp                    !! of differences, in the errors claimed [1]
      real(wp) :: other_from = 0.0_wp                !! time from which these runs meet other contacts; NaN: never [s]
      real(wp) :: residual = 0.0_wp                  !! of the ledger, over the largest energy; NaN: not known [1]
      integer :: runs = 0                            !! that were made
      real(wp) :: spent = 0.0_wp                     !! time that they took [s]
   end type evidence_t

   !> All of it.
   type :: accuracy_t
      real(wp) :: asked = 0.0_wp                     !! maximum relative error asked for; 0: not asked for [1]
      integer :: claim = claim_none                  !! one of the above
      real(wp) :: tolerance = 0.0_wp                 !! that was chosen [1]
      real(wp) :: until = 0.0_wp                     !! last time that is claimed [s]
      real(wp) :: end = 0.0_wp                       !! last instant of the run [s]
      real(wp) :: error = 0.0_wp                     !! maximum relative error up to then, with the safety factor [1]
      real(wp) :: error_at_end = 0.0_wp              !! the same up to the end; 1 or more: no digit is right [1]
      real(wp) :: asked_until = 0.0_wp               !! up to when the error asked for holds; negative: never [s]
      integer :: worst = 0                           !! number of the channel whose error is greater first, else the maximum
      character(:), allocatable :: reason            !! why no more was reached; blank: it was
      type(evidence_t) :: evidence                   !! what all that rests on
      type(growth_t) :: growth                       !! of neighbouring starts; reason set: not known
      type(extreme_t), allocatable :: extremes(:)    !! (n) of the channels asked for
   end type accuracy_t

end module accuracy_results
