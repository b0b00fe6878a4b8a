!> Processor time that a motion spends aside: on output, not on its steps.
!>
!> A reading of the processor time is a call of the operating system, which takes as long as a sample. So a stretch aside is timed
!> by the clock, which is read in the program itself, and of every millisecond or so the part aside is the same part of its
!> processor time: what other programs take of a processor is not counted, wherever it falls.
module time_in_output
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: output_time_t

   real(wp), parameter :: between = 1.0e-3_wp  !! time by the clock between two readings of the processor time [s]

   !> The time so far.
   type :: output_time_t
      real(wp), private :: before = 0.0_wp     !! processor time aside before the last reading [s]
      real(wp), private :: cpu = 0.0_wp        !! processor time of the program at the last reading [s]
      integer(i8), private :: read_at = 0      !! count of the clock then
      integer(i8), private :: since = 0        !! counts aside since then
      integer(i8), private :: left_at = 0      !! count of the clock when the motion was left
   contains
      procedure :: begin
      procedure :: leave
      procedure :: come_back
      procedure :: seconds
   end type output_time_t

contains

   !> Start to count, with what was counted before.
   subroutine begin(self, before)
      class(output_time_t), intent(inout) :: self  !! the time
      real(wp), intent(in) :: before              !! processor time aside so far [s]

      self%before = before
      self%since = 0
      call system_clock(self%read_at)
      call cpu_time(self%cpu)
   end subroutine begin

   !> The motion is left for output.
   subroutine leave(self)
      class(output_time_t), intent(inout) :: self  !! the time, started

      call system_clock(self%left_at)
   end subroutine leave

   !> Output is done, the motion continues.
   subroutine come_back(self)
      class(output_time_t), intent(inout) :: self  !! the time, left before

      integer(i8) :: now, ticks
      real(wp) :: cpu

      call system_clock(now, ticks)
      self%since = self%since + (now - self%left_at)
      if (real(now - self%read_at, wp) < between*real(ticks, wp)) return
      call cpu_time(cpu)
      self%before = self%before + part_of(self, cpu, now)
      self%cpu = cpu
      self%read_at = now
      self%since = 0
   end subroutine come_back

   !> Processor time aside so far; the motion is not left.
   real(wp) function seconds(self)
      class(output_time_t), intent(in) :: self  !! the time, started

      integer(i8) :: now
      real(wp) :: cpu

      call system_clock(now)
      call cpu_time(cpu)
      seconds = self%before + part_of(self, cpu, now)  ! [s]
   end function seconds

   !> Part of the processor time since the last reading that was spent aside.
   pure real(wp) function part_of(self, cpu, now) result(part)
      class(output_time_t), intent(in) :: self   !! the time
      real(wp), intent(in) :: cpu               !! processor time of the program [s]
      integer(i8), intent(in) :: now            !! count of the clock

      part = (cpu - self%cpu)*real(self%since, wp)/real(max(now - self%read_at, 1_i8), wp)  ! [s]
   end function part_of

end module time_in_output
