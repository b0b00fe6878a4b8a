!> What one run of a sweep hands back to it: its numbers, the channels once per period, warnings, and what it cost.
module member_result
   use kinds, only: wp
   use packed, only: packer_t, unpacker_t
   use statistics, only: number_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: member_result_t

   !> The result of a run. Lists that are not allocated count as empty.
   type :: member_result_t
      type(number_t), allocatable :: numbers(:)       !! (n) of the motion after its transient
      type(text_t), allocatable :: poincare_names(:)    !! (q) names of the channels once per period
      real(wp), allocatable :: poincare_times(:)        !! (m) instants once per period [s]
      real(wp), allocatable :: poincare_samples(:, :)          !! (q, m) the channels at them, SI [any]
      type(text_t), allocatable :: warnings(:)        !! (w) what a careful reader should know
      real(wp) :: cpu_start = 0.0_wp                  !! processor time until the motion starts [s]
      real(wp) :: cpu_run = 0.0_wp                    !! processor time of the motion and of what is written of it [s]
   contains
      procedure :: complete => complete_result
      procedure :: pack => pack_result
      procedure :: unpack => unpack_result
   end type member_result_t

contains

   !> Give every list that is not there its empty value.
   pure subroutine complete_result(self)
      class(member_result_t), intent(inout) :: self  !! the result

      if (.not. allocated(self%numbers)) allocate (self%numbers(0))
      if (.not. allocated(self%poincare_names)) allocate (self%poincare_names(0))
      if (.not. allocated(self%poincare_times)) allocate (self%poincare_times(0))
      if (.not. allocated(self%poincare_samples)) allocate (self%poincare_samples(0, 0))
      if (.not. allocated(self%warnings)) allocate (self%warnings(0))
   end subroutine complete_result

   !> Put it behind other bytes.
   pure subroutine pack_result(self, packer)
      class(member_result_t), intent(in) :: self        !! the result, complete
      class(packer_t), intent(inout) :: packer          !! where it is put

      integer :: k

      call packer%integer(size(self%numbers))
      do k = 1, size(self%numbers)
         call packer%text(self%numbers(k)%name)
         call packer%text(self%numbers(k)%unit)
      end do
      call packer%reals(self%numbers%value)
      call packer%texts(self%poincare_names)
      call packer%reals(self%poincare_times)
      call packer%reals(reshape(self%poincare_samples, [size(self%poincare_samples)]))
      call packer%texts(self%warnings)
      call packer%reals([self%cpu_start, self%cpu_run])
   end subroutine pack_result

   !> Take it from bytes; `is_good` of these says whether it was there.
   subroutine unpack_result(self, unpacker)
      class(member_result_t), intent(out) :: self       !! the result
      class(unpacker_t), intent(inout) :: unpacker      !! the bytes

      real(wp), allocatable :: cpu(:), poincare_samples(:), values(:)
      integer :: k, n

      call unpacker%integer(n, len(unpacker%bytes))
      allocate (self%numbers(n))
      do k = 1, n
         call unpacker%text(self%numbers(k)%name)
         call unpacker%text(self%numbers(k)%unit)
      end do
      call unpacker%reals(values)
      call unpacker%texts(self%poincare_names)
      call unpacker%reals(self%poincare_times)
      call unpacker%reals(poincare_samples)
      call unpacker%texts(self%warnings)
      call unpacker%reals(cpu)
      associate (q => size(self%poincare_names), m => size(self%poincare_times), is_good => unpacker%is_good)
         is_good = is_good .and. size(values) == n .and. size(poincare_samples) == q*m .and. size(cpu) == 2
         if (.not. is_good) return
         self%poincare_samples = reshape(poincare_samples, [q, m])
      end associate
      self%numbers%value = values
      self%cpu_start = cpu(1)
      self%cpu_run = cpu(2)
   end subroutine unpack_result

end module member_result
