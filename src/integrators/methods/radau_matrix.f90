!> Newton's matrix of Radau IIA where there are few freedoms: in the directions that invariants leave, which move with the system.
!>
!> With T the free directions of displacements and rates (`free_directions` of the system) and the other states, T^+ how much of
!> each a change has,
!>
!> $$ K = T^+ (J T - T'), \quad C = T^+ J (I - T T^+) $$
!>
!> are what small changes make of themselves, and what changes across T make of them, as the motion continues: since T follows the
!> bodies (`to_local`), both stay good for many steps. K takes a difference of the right-hand side for each direction, and T' one
!> of T along the motion. What holds the invariants does not act in free directions, so that C takes differences of the loads
!> only (`evaluate_unheld`). Across T nothing is stiff, and J is omitted there. With R_i what is left of the equations at stage i
!> and r = (h A)^{-1} R, resolved at each stage, Newton's equations are
!>
!> $$ ((h A)^{-1} \otimes I - I \otimes K) z = T^+ r + C (I - T T^+) h A r, \quad \Delta = (I - T T^+) h A r + T z $$
!>
!> A^{-1} has a real eigenvalue and a complex pair; with its eigenvectors they fall into a real and a complex system of the order of
!> K (`radau_matrix_equations`). Of the filter of the error, (I - h J/u) x = b, the real one is the matrix.
!> Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.8.
!> Limits: `most_columns` directions, `most_rates` rates; else `is_known` stays false.
module radau_matrix
   use kinds, only: wp
   use archive, only: archive_t
   use ode_system, only: ode_system_t
   use radau_products, only: filter_product_t
   implicit none (type, external)
   private
   public :: radau_matrix_t

   integer, parameter :: most_columns = 24     !! directions of displacements, rates and other states
   integer, parameter :: most_rates = 60       !! rates, of which each takes two differences of the loads
   real(wp), parameter :: ahead = 1.0e-6_wp    !! of the time in which the state changes by its scales: difference of T [1]

   !> The matrix.
   !> Components: the matrices, their factors, and room.
   type :: radau_matrix_t
      logical :: is_known = .false.                      !! whether it is there
      integer, private :: n_rate = 0                     !! rates of the system, which has as many displacements
      integer, private :: n_free = 0                     !! free directions of displacements
      integer, private :: n = 0                          !! directions of displacements, rates and other states
      real(wp), private :: h = 0.0_wp                    !! step that the factors are for, 0: none [s]
      real(wp), allocatable, private :: direction(:, :)  !! (rates, room) free directions of displacements, local [any]
      real(wp), allocatable, private :: reading(:, :)    !! (rates, room) how to read them [any]
      real(wp), allocatable, private :: k(:, :)          !! (room, room) K [any]
      real(wp), allocatable, private :: across(:, :)     !! (room of free directions, 2 rates) C of accelerations [any]
      real(wp), allocatable, private :: real_lu(:, :)         !! (room, room) factors of u/h I - K [any]
      complex(wp), allocatable, private :: complex_lu(:, :)   !! (room, room) factors of the complex one [any]
      integer, allocatable, private :: pivot(:, :)       !! (room, 2) exchanges of their rows
      complex(wp), private :: right(3, 2)                !! (stage, eigenvalue) eigenvectors of A^-1, the real one first [1]
      complex(wp), private :: left(2, 3)                 !! (eigenvalue, stage) rows of the inverse of all three [1]
      real(wp), private :: inverse_a(3, 3) = 0.0_wp      !! (stage, stage) A^-1 [1]
      real(wp), allocatable, private :: x(:, :)          !! (local changes, 3) of each stage [any]
      real(wp), allocatable, private :: local(:)         !! (local changes) workspace [any]
      real(wp), allocatable, private :: change(:)        !! (state without quadratures) workspace [any]
      real(wp), allocatable, private :: moved(:, :)      !! (all, 2) workspace [any]
      real(wp), allocatable, private :: z(:, :)          !! (room, 3) in the directions, of each stage [any]
      real(wp), allocatable, private :: single(:)        !! (room) solution of the real equations [any]
      complex(wp), allocatable, private :: pair(:)       !! (room) solution of the complex equations [any]
   contains
      procedure :: open => matrix_open
      procedure :: renew
      procedure :: factorise
      procedure :: solve_stages
      procedure :: solve_filter
      procedure :: save => save_matrix
      procedure :: load => load_matrix
   end type radau_matrix_t

   interface
      !> A change of the state, local and in the directions: z = T^+ x.
      module subroutine to_directions(self, system, y, change, x, z)
         implicit none (type, external)
         class(radau_matrix_t), intent(in) :: self      !! the matrix
         class(ode_system_t), intent(in) :: system      !! the system
         real(wp), intent(in) :: y(:)                   !! (all) state [any]
         real(wp), intent(in) :: change(:)              !! (n) its change [any]
         real(wp), intent(inout) :: x(:)                !! (local changes) the same, local [any]
         real(wp), intent(inout) :: z(:)                !! (room) in the directions [any]
      end subroutine to_directions

      !> Add to a local change some change in the directions: x + factor T z.
      pure module subroutine add_directions(self, factor, z, x)
         implicit none (type, external)
         class(radau_matrix_t), intent(in) :: self      !! the matrix
         real(wp), intent(in) :: factor                 !! the factor [1]
         real(wp), intent(in) :: z(:)                   !! (room) in the directions [any]
         real(wp), intent(inout) :: x(:)                !! (local changes) local change, added to [any]
      end subroutine add_directions

      !> Eigenvectors of A^-1 and the inverse of their matrix.
      module subroutine find_eigenvectors(self)
         implicit none (type, external)
         class(radau_matrix_t), intent(inout) :: self   !! the matrix
      end subroutine find_eigenvectors

      !> Factors for steps of a length. Where there are none the matrix is no longer known.
      module subroutine factorise(self, h)
         implicit none (type, external)
         class(radau_matrix_t), intent(inout) :: self   !! the matrix, known
         real(wp), intent(in) :: h                      !! length of the step [s]
      end subroutine factorise

      !> Changes of the stages from what is left of their equations.
      module subroutine solve_stages(self, system, y, side, change)
         implicit none (type, external)
         class(radau_matrix_t), intent(inout) :: self   !! the matrix, factorised
         class(ode_system_t), intent(in) :: system      !! the system
         real(wp), intent(in) :: y(:, :)                !! (all, 3) states at the stages [any]
         real(wp), intent(in) :: side(:, :)             !! (n, 3) R, what is left [any]
         real(wp), intent(out) :: change(:, :)          !! (n, 3) the changes [any]
      end subroutine solve_stages

      !> Solve (I - h K/u) x = b in the directions; across them x is b.
      module subroutine solve_filter(self, system, y, b, x)
         implicit none (type, external)
         class(radau_matrix_t), intent(inout) :: self   !! the matrix, factorised
         class(ode_system_t), intent(in) :: system      !! the system
         real(wp), intent(in) :: y(:)                   !! (all) state [any]
         real(wp), intent(in) :: b(:)                   !! (n) right-hand side [any]
         real(wp), intent(out) :: x(:)                  !! (n) solution [any]
      end subroutine solve_filter
   end interface

contains

   !> Room, and the eigenvectors. None for a system that is too large.
   subroutine matrix_open(self, system)
      class(radau_matrix_t), intent(inout) :: self   !! the matrix
      class(ode_system_t), intent(in) :: system      !! the system

      integer :: room, group_free

      self%n_rate = system%n_position - system%traits%n_turning
      room = merge(most_columns, 0, self%n_rate <= most_rates)
      group_free = min(self%n_rate, room/2)
      associate (n => system%n - system%n_quadrature)
         allocate (self%direction(self%n_rate, group_free), self%reading(self%n_rate, group_free), self%k(room, room), &
                   self%across(group_free, 2*self%n_rate), self%real_lu(room, room), self%x(n - system%traits%n_turning, 3), &
                   self%local(n - system%traits%n_turning), self%change(n), self%moved(system%n, 2), self%z(room, 3), &
                   self%single(room), source=0.0_wp)
         allocate (self%complex_lu(room, room), self%pair(room), source=(0.0_wp, 0.0_wp))
         allocate (self%pivot(room, 2), source=0)
      end associate
      call find_eigenvectors(self)
   end subroutine matrix_open

   !> Directions, K and C at a state. Unknown afterwards where there are too many directions, or where an evaluation fails.
   subroutine renew(self, system, difference)
      class(radau_matrix_t), intent(inout) :: self           !! the matrix
      class(ode_system_t), intent(inout) :: system           !! the system
      type(filter_product_t), intent(inout) :: difference    !! at the state; its status is set

      integer :: i

      self%h = 0.0_wp
      self%is_known = .false.
      if (size(self%k) == 0) return
      call system%free_directions(difference%t, difference%y, self%n_free, self%direction, self%reading)
      self%n = size(self%x, 1) - 2*self%n_rate + 2*self%n_free
      if (self%n_free > size(self%direction, 2) .or. self%n > size(self%k, 1)) return
      difference%status = 0
      do i = 1, self%n
         call unit_change(i, difference%y)
         call difference%derivative(difference%t, difference%y, difference%f, self%change, self%moved(:size(self%change), 1))
         call to_directions(self, system, difference%y, self%moved(:size(self%change), 1), self%local, self%k(:, i))
      end do
      if (difference%status == 0) call add_turning(self, system, difference)
      if (difference%status == 0) call find_across(self, system, difference)
      self%is_known = difference%status == 0

   contains

      !> The change of the state along a direction.
      subroutine unit_change(direction, y)
         integer, intent(in) :: direction   !! its number
         real(wp), intent(in) :: y(:)       !! (all) state [any]

         self%z(:, 1) = 0.0_wp
         self%z(direction, 1) = 1.0_wp
         self%local(:) = 0.0_wp
         call add_directions(self, 1.0_wp, self%z(:, 1), self%local)
         call system%from_local(y, self%local, self%change)
      end subroutine unit_change

   end subroutine renew

   !> Less T^+ T' in K, by the difference of T along the motion.
   subroutine add_turning(self, system, difference)
      class(radau_matrix_t), intent(inout) :: self           !! the matrix
      class(ode_system_t), intent(in) :: system              !! the system
      type(filter_product_t), intent(in) :: difference       !! at the state

      real(wp) :: rate, time
      integer :: i

      rate = maxval(abs(difference%f(:difference%n))/difference%scale)
      if (rate <= 0.0_wp) return
      time = ahead/rate
      self%moved(:, 1) = difference%y + time*difference%f
      do i = 1, self%n
         self%z(:, 1) = 0.0_wp
         self%z(i, 1) = 1.0_wp
         self%local(:) = 0.0_wp
         call add_directions(self, 1.0_wp, self%z(:, 1), self%local)
         call system%from_local(self%moved(:, 1), self%local, self%change)
         call to_directions(self, system, difference%y, self%change, self%local, self%z(:, 2))
         self%k(:self%n, i) = self%k(:self%n, i) - (self%z(:self%n, 2) - self%z(:self%n, 1))/time
      end do
   end subroutine add_turning

   !> C, by differences of the accelerations that loads alone make.
   subroutine find_across(self, system, difference)
      class(radau_matrix_t), intent(inout) :: self           !! the matrix
      class(ode_system_t), intent(inout) :: system           !! the system
      type(filter_product_t), intent(inout) :: difference    !! at the state; its status is set

      real(wp) :: step
      integer :: first, i, last

      first = system%n_position + 1
      last = system%n_position + self%n_rate
      if (self%n_free == self%n_rate) return  ! nothing is across
      call system%evaluate_unheld(difference%t, difference%y, self%moved(:, 2), difference%status)
      do i = 1, 2*self%n_rate
         if (difference%status /= 0) return
         self%local(:) = 0.0_wp
         self%local(i) = 1.0_wp
         call system%from_local(difference%y, self%local, self%change)
         step = difference%distance(difference%y, self%change)
         self%moved(:, 1) = difference%y
         self%moved(:difference%n, 1) = difference%y(:difference%n) + step*self%change
         call system%evaluate_unheld(difference%t, self%moved(:, 1), difference%rate, difference%status)
         self%change = 0.0_wp
         self%change(first:last) = (difference%rate(first:last) - self%moved(first:last, 2))/step
         call to_directions(self, system, difference%y, self%change, self%local, self%z(:, 1))
         self%across(:self%n_free, i) = self%z(self%n_free + 1:2*self%n_free, 1)
      end do
   end subroutine find_across

   !> Write it; factors are made again.
   subroutine save_matrix(self, archive)
      class(radau_matrix_t), intent(in) :: self   !! the matrix
      type(archive_t), intent(inout) :: archive   !! the checkpoint

      call archive%put(self%is_known)
      call archive%put(self%n_free)
      call archive%put(self%n)
      call archive%put(reshape(self%direction, [size(self%direction)]))
      call archive%put(reshape(self%reading, [size(self%reading)]))
      call archive%put(reshape(self%k, [size(self%k)]))
      call archive%put(reshape(self%across, [size(self%across)]))
   end subroutine save_matrix

   !> Read it.
   subroutine load_matrix(self, archive)
      class(radau_matrix_t), intent(inout) :: self   !! the matrix
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      call archive%get(self%is_known)
      call archive%get(self%n_free)
      call archive%get(self%n)
      call get_columns(self%direction)
      call get_columns(self%reading)
      call get_columns(self%k)
      call get_columns(self%across)
      self%h = 0.0_wp

   contains

      !> Columns of a matrix.
      subroutine get_columns(matrix)
         real(wp), intent(inout) :: matrix(:, :)   !! (any, any) the matrix [any]

         integer :: k

         do k = 1, size(matrix, 2)
            call archive%get(matrix(:, k))
         end do
      end subroutine get_columns

   end subroutine load_matrix

end module radau_matrix
