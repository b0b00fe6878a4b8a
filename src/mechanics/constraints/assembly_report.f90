!> How an assembly went: what it moved, what is left open, which rows depend on others.
module assembly_report
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: assembly_t, largest_t

   !> A maximum over the bodies.
   type :: largest_t
      real(wp) :: value = 0.0_wp   !! the maximum [any]
      integer :: body = 0          !! the body it belongs to; 0: none
   end type largest_t

   !> How an assembly went.
   type :: assembly_t
      integer :: rank = 0                        !! independent constraint rows
      integer :: corrections = 0                 !! Newton corrections made
      real(wp) :: moved = 0.0_wp                 !! maximum change of a coordinate, angles times the size of the bodies [m]
      type(largest_t) :: shift                   !! maximum displacement of a centre of mass [m]
      type(largest_t) :: turn                    !! maximum rotation of a body [rad]
      real(wp) :: residual = 0.0_wp              !! maximum violation left [m or rad]
      real(wp) :: rate_changed = 0.0_wp          !! maximum change of a given velocity, angles times the size of the bodies [m/s]
      integer :: changed_body = 0                !! the body it belongs to
      integer :: n_weak = 0                      !! rows that depend on others, or nearly so, by 1e-6
      integer, allocatable :: set_aside(:)       !! redundant rows that do not quite agree with the others, omitted
      character(:), allocatable :: misfit        !! by how much, and what was done; blank if none are
      integer, allocatable :: dependent(:)       !! rows that depend on others
      integer, allocatable :: shared(:)          !! rows, those among them, whose multipliers are not unique
      integer, allocatable :: rubbing(:)         !! joints among those with friction whose friction depends on such multipliers
   end type assembly_t

end module assembly_report
