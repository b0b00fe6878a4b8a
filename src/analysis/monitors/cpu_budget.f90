!> The time that an analysis may take, of the processor or by the clock on the wall: looked at after every step, so that a run
!> which may take for ever ends cleanly, with all that it has written.
module cpu_budget
   use errors, only: error_t, exit_integration, set_error
   use kinds, only: i8, wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: cpu_budget_t

   real(wp), parameter :: between = 1.0e-3_wp  !! time between two looks [s]

   !> The time left.
   type :: cpu_budget_t
      logical :: is_limited = .false.          !! there is a limit: `is_spent` is worth asking
      real(wp), private :: until = 0.0_wp      !! processor time of the program at which it is used up, 0: no limit [s]
      integer(i8), private :: last = 0_i8      !! count of the clock at which it is used up, 0: no limit
      integer(i8), private :: looked_at = 0_i8 !! count of the clock when it was looked at
   contains
      procedure :: begin
      procedure :: is_spent
      procedure, nopass :: refuse
   end type cpu_budget_t

contains

   !> Start to count.
   subroutine begin(self, limit, used, clock)
      class(cpu_budget_t), intent(inout) :: self  !! the budget
      real(wp), intent(in) :: limit               !! time allowed, 0: no limit [s]
      real(wp), intent(in), optional :: used      !! time used up before; absent: none [s]
      real(wp), intent(in), optional :: clock     !! time allowed by the clock, 0 or absent: no limit [s]

      integer(i8) :: now, ticks

      self%until = 0.0_wp
      self%last = 0_i8
      self%is_limited = limit > 0.0_wp
      if (present(clock)) then
         if (clock > 0.0_wp) then
            self%is_limited = .true.
            call system_clock(now, ticks)
            self%last = now + ceiling(clock*real(ticks, wp), i8)
         end if
      end if
      if (limit <= 0.0_wp) return
      call cpu_time(self%until)
      self%until = self%until + limit
      if (present(used)) self%until = self%until - used
   end subroutine begin

   !> Whether it is used up.
   logical function is_spent(self)
      class(cpu_budget_t), intent(inout) :: self  !! the budget

      integer(i8) :: clock, ticks
      real(wp) :: now

      is_spent = .false.
      if (.not. self%is_limited) return
      call system_clock(clock, ticks)  ! far cheaper than the processor time, which cannot grow faster
      is_spent = self%last > 0_i8 .and. clock >= self%last
      if (is_spent .or. self%until <= 0.0_wp) return
      if (real(clock - self%looked_at, wp) < between*real(ticks, wp)) return
      self%looked_at = clock
      call cpu_time(now)
      is_spent = now > self%until
   end function is_spent

   !> Say that it is used up, where there is no more to say.
   subroutine refuse(t, error)
      real(wp), intent(in) :: t                           !! time reached [s]
      type(error_t), allocatable, intent(out) :: error    !! the message

      call set_error(error, exit_integration, "the run exceeded its CPU time limit (limit_cpu)"//new_line("a")// &
                     "  = at t = "//real_text(t, 9)//" s"//new_line("a")// &
                     "  = results up to the last output time are saved; raise the limit, or reduce the output times")
   end subroutine refuse

end module cpu_budget
