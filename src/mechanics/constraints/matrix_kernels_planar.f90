!> Loops that put the matrices of the solvers together in the plane, see `matrix_kernels.inc`.
module matrix_kernels_planar
   use kinds, only: wp
   use rows, only: n_v => n_v_planar
   use schur_part, only: part_t
   implicit none (type, external)
   private
   public :: assemble_schur, lower_sides, penalty_loads, penalty_matrix, row_penalties, scaled_loads, unscaled, upper_sides

contains

   include "matrix_kernels.inc"

end module matrix_kernels_planar
