!> The loads under which a contact has worn its surfaces: samples of a run, of which nodes of equal worn volume are kept.
!>
!> A node is  (e_x, e_y, alpha, p, V_i, V_j):  place of the pin's centre from the hole's in the frame of the hole's body, angle of
!> the pin's body less that of the hole's, exponent p of the normal law F ~ delta^p there, volumes that bearing and journal lost.
!> Of n nodes node k is the sample at which (k - 1/2)/n of the volume is lost; each stands for one nth of the volumes.
!> Source: this program (stratified sampling). Limits: a node says nothing of how fast the load changes.
module wear_loads
   use kinds, only: wp
   use wear_contact, only: wear_contact_t
   use wear_law, only: n_side
   implicit none (type, external)
   private
   public :: n_load, most_nodes, wear_loads_t

   integer, parameter :: n_load = 6         !! numbers of a node
   integer, parameter :: most_nodes = 160   !! nodes of a contact
   integer, parameter :: volumes(n_side) = [5, 6]   !! numbers of a node that are volumes

   !> Samples so far.
   type :: wear_loads_t
      integer :: n = 0                              !! samples
      real(wp), allocatable :: samples(:, :)        !! (6, n or more) see above [m, rad, 1, m^3]
   contains
      procedure :: add => add_sample
      procedure :: nodes => nodes_of_samples
   end type wear_loads_t

contains

   !> Add a sample.
   pure subroutine add_sample(self, wear, lost)
      class(wear_loads_t), intent(inout) :: self    !! the samples
      type(wear_contact_t), intent(in) :: wear      !! what the contact does
      real(wp), intent(in) :: lost(n_side)          !! (2) what bearing and journal lose [m^3]

      real(wp), allocatable :: longer(:, :)

      if (.not. sum(lost) > 0.0_wp) return
      if (.not. allocated(self%samples)) allocate (self%samples(n_load, 256))
      if (self%n == size(self%samples, 2)) then
         allocate (longer(n_load, 2*self%n))
         longer(:, :self%n) = self%samples
         call move_alloc(longer, self%samples)
      end if
      self%n = self%n + 1
      self%samples(:, self%n) = [wear%place, wear%turned, wear%exponent, lost]
   end subroutine add_sample

   !> Nodes of equal worn volume; none if nothing has worn.
   pure function nodes_of_samples(self) result(nodes)
      class(wear_loads_t), intent(in) :: self       !! the samples
      real(wp), allocatable :: nodes(:, :)          !! (6, nodes) see above [m, rad, 1, m^3]

      real(wp) :: passed, total
      integer :: i, k

      allocate (nodes(n_load, merge(most_nodes, 0, self%n > 0)))
      if (self%n == 0) return
      total = sum(self%samples(volumes, :self%n))
      passed = sum(self%samples(volumes, 1))
      i = 1
      do k = 1, most_nodes
         do while (passed < total*(k - 0.5_wp)/most_nodes .and. i < self%n)
            i = i + 1
            passed = passed + sum(self%samples(volumes, i))
         end do
         nodes(:, k) = self%samples(:, i)
         nodes(volumes, k) = sum(self%samples(volumes, :self%n), dim=2)/most_nodes
      end do
   end function nodes_of_samples

end module wear_loads
