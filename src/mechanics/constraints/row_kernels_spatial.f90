!> Loops over the constraint rows in space, see `row_kernels.inc`.
module row_kernels_spatial
   use kinds, only: wp
   use rows, only: n_v => n_v_spatial, rows_t
   implicit none (type, external)
   private
   public :: right_hand_side, take_prescribed

   integer, parameter :: n_length = 3       !! rates of a body that are no rotation
   integer, parameter :: n_shift = n_v - 3  !! what the number of a rate of rotation is beyond that of its axis

contains

   include "row_kernels.inc"

end module row_kernels_spatial
