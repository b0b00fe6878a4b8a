!> Channels of blocks of members, by the expansion or assembled.
module member_values
   use exact_member, only: assemble_member
   use expansion, only: expanded_value
   use kinds, only: wp
   use mechanism_source, only: mechanism_source_t
   use member_draws, only: draw_t
   use tolerance_plan, only: pin_force
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: block_length, block_t

   integer, parameter :: block_length = 512   !! members of a block

   !> A block of members.
   type :: block_t
      integer :: n = 0                                !! members
      real(wp), allocatable :: deviations(:, :)       !! (members, parameters) deviations [any]
      real(wp), allocatable :: units(:, :, :)         !! (members, 2, pins) displacements of pins, of the clearances [1]
      real(wp), allocatable :: clearances(:, :)       !! (members, pins) clearances to first order [m]
      logical, allocatable :: is_open(:)              !! (members) cannot be assembled
      real(wp), allocatable :: exact(:, :, :)         !! (requests, times, members) values of assembled members [any]
      logical :: is_exact = .false.                   !! members are assembled
   contains
      procedure :: fill => block_fill
      procedure :: take => block_take
      procedure :: values => block_values
   end type block_t

contains

   !> Make the members of some random numbers, no more than the first time.
   subroutine block_fill(self, source, study, draw, u, is_exact)
      class(block_t), intent(inout) :: self                !! the block
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(tolerance_study_t), intent(in) :: study         !! the study
      type(draw_t), intent(in) :: draw                     !! makes members
      real(wp), intent(in) :: u(:, :)                      !! (numbers, members) random numbers [1]
      logical, intent(in) :: is_exact                      !! members are assembled

      integer :: m, n, n_pin

      n = size(study%plan%parameters)
      n_pin = size(study%pins)
      if (.not. allocated(self%deviations)) then
         allocate (self%deviations(size(u, 2), n), self%units(size(u, 2), 2, n_pin), self%clearances(size(u, 2), n_pin), &
                   self%is_open(size(u, 2)))
         if (is_exact) allocate (self%exact(size(study%requests), size(study%derivatives%instants), size(u, 2)))
      end if
      self%n = size(u, 2)
      self%is_exact = is_exact
      self%is_open = .false.
      do m = 1, self%n
         call draw%make(study, 1, u(:, m), self%deviations(m, :), self%units(m, :, :), self%clearances(m, :))
         if (is_exact) then
            call assemble_member(source, study, self%deviations(m, :), self%units(m, :, :), self%exact(:, :, m), self%is_open(m))
            if (self%is_open(m)) self%exact(:, :, m) = 0.0_wp
         end if
      end do
   end subroutine block_fill

   !> Take members that were run; they have one time and no pins.
   subroutine block_take(self, values, is_open)
      class(block_t), intent(inout) :: self    !! the block
      real(wp), intent(in) :: values(:, :)     !! (requests, members) values; of failed ones any number [any]
      logical, intent(in) :: is_open(:)        !! (members) failed

      self%n = size(is_open)
      self%is_exact = .true.
      self%is_open = is_open
      self%exact = reshape(values, [size(values, 1), 1, self%n])
   end subroutine block_take

   !> A channel of all members of the block at a time; of open ones zero.
   subroutine block_values(self, study, r, at, values)
      class(block_t), intent(in) :: self                   !! the block
      type(tolerance_study_t), intent(in) :: study         !! the study
      integer, intent(in) :: r                             !! number of the channel
      integer, intent(in) :: at                            !! number of the time
      real(wp), intent(out) :: values(:)                   !! (members) values [any]

      real(wp), allocatable :: displaced(:, :, :)
      integer :: i, k

      if (self%is_exact) then
         values = self%exact(r, at, :self%n)
         return
      end if
      allocate (displaced(self%n, 2, size(study%pins)))
      do k = 1, size(study%pins)
         do i = 1, 2
            displaced(:, i, k) = self%clearances(:self%n, k)*self%units(:self%n, i, k)
            if (study%pins(k)%position == pin_force) then
               displaced(:, i, k) = self%clearances(:self%n, k)*study%derivatives%directions(i, k, at)
            end if
         end do
      end do
      call expanded_value(study%derivatives, r, at, self%deviations(:self%n, :), displaced, values)
   end subroutine block_values

end module member_values
