!> Bodies that are omitted of the unknowns, wholly or but for one coordinate: who they are, and what hangs on them.
module reduced
   use reduced_bodies, only: one_dof_bodies_t, prescribed_bodies_t
   implicit none (type, external)
   private
   public :: reduced_t

   !> Bodies that are not unknown.
   type :: reduced_t
      logical, allocatable :: is_known(:)             !! (bodies) whether the motion of a body is a known function of time
      class(prescribed_bodies_t), allocatable :: known     !! those of them whose motion is a known function of time
      class(one_dof_bodies_t), allocatable :: one_dof   !! bodies with one coordinate only
      integer, allocatable :: carried(:, :)           !! (3, sides) sides that are prescribed bodies, of rows whose multipliers
                                                      !! are found without them: row, place in the Jacobian, body
      integer, allocatable :: driven(:)               !! (bodies) prescribed bodies, and those guided by them
   end type reduced_t

end module reduced
