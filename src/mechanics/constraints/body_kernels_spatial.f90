!> Loops over bodies and rows in space, see `body_kernels.inc`.
module body_kernels_spatial
   use kinds, only: wp
   use rows, only: n_v => n_v_spatial, rows_t
   implicit none (type, external)
   private
   public :: body_accelerations, row_residuals, solve_lone_bodies

contains

   include "body_kernels.inc"

end module body_kernels_spatial
