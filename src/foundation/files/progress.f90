!> How far a run is, on the standard error: a bar on a terminal, now and then a line in a log.
!>
!> Nothing is shown in the first second, so that short runs stay silent.
module progress
   use kinds, only: i8, wp
   use posix, only: draw_error, is_terminal, write_error
   use text, only: to_text
   implicit none (type, external)
   private
   public :: progress_t

   real(wp), parameter :: silent = 1.0_wp          !! nothing is shown before [s]
   real(wp), parameter :: bar_interval = 0.2_wp    !! between two looks of the bar [s]
   real(wp), parameter :: log_interval = 10.0_wp   !! between two lines of a log [s]
   real(wp), parameter :: log_step = 0.1_wp        !! of the work between two lines of a log [1]
   integer, parameter :: bar_width = 40            !! characters of the bar
   integer, parameter :: error_descriptor = 2      !! of the standard error

   !> The state of the display.
   type :: progress_t
      private
      logical :: is_on = .false.            !! whether to show anything
      logical :: has_bar = .false.          !! the standard error is a terminal
      logical :: is_drawn = .false.         !! a bar stands on the terminal
      integer(i8) :: begun = 0              !! clock at the start
      integer(i8) :: rate = 1               !! clock counts per second
      real(wp) :: shown_at = 0.0_wp         !! time since the start at the last look [s]
      real(wp) :: shown = 0.0_wp            !! part of the work at the last look [1]
   contains
      procedure, public :: start => start_progress
      procedure, public :: update => update_progress
      procedure, public :: finish => finish_progress
   end type progress_t

contains

   !> Start.
   subroutine start_progress(self, is_on)
      class(progress_t), intent(inout) :: self  !! the display
      logical, intent(in) :: is_on              !! .false.: show nothing

      self%is_on = is_on
      self%is_drawn = .false.
      self%shown_at = 0.0_wp
      self%shown = 0.0_wp
      if (is_on) self%has_bar = is_terminal(error_descriptor)
      call system_clock(self%begun, self%rate)
   end subroutine start_progress

   !> Show the state of things if it is time to.
   subroutine update_progress(self, fraction)
      class(progress_t), intent(inout) :: self  !! the display
      real(wp), intent(in) :: fraction          !! of the work done, 0 to 1 [1]

      integer(i8) :: now
      real(wp) :: elapsed

      if (.not. self%is_on) return
      call system_clock(now)
      elapsed = real(now - self%begun, wp)/real(self%rate, wp)
      if (elapsed < silent) return
      if (self%has_bar) then
         if (self%is_drawn .and. elapsed - self%shown_at < bar_interval) return
         call draw_error(achar(13)//bar(fraction, elapsed))
         self%is_drawn = .true.
      else
         if (elapsed - self%shown_at < log_interval) return
         if (fraction - self%shown < log_step .and. elapsed - self%shown_at < 6.0_wp*log_interval) return
         call write_error("progress "//percent(fraction)//", "//time_left(fraction, elapsed)//new_line("a"))
      end if
      self%shown_at = elapsed
      self%shown = fraction
   end subroutine update_progress

   !> Take the bar away.
   subroutine finish_progress(self)
      class(progress_t), intent(inout) :: self  !! the display

      if (self%is_drawn) then
         call draw_error(achar(13)//repeat(" ", bar_width + 32)//achar(13))
      end if
      self%is_on = .false.
      self%is_drawn = .false.
   end subroutine finish_progress

   !> The bar with its numbers, always of the same length.
   pure function bar(fraction, elapsed) result(line)
      real(wp), intent(in) :: fraction     !! of the work done [1]
      real(wp), intent(in) :: elapsed      !! time since the start [s]
      character(bar_width + 32) :: line    !! ready for the terminal

      integer :: n

      n = nint(bar_width*max(0.0_wp, min(1.0_wp, fraction)))
      line = "["//repeat("=", n)//repeat(" ", bar_width - n)//"] "//percent(fraction)//"  "// &
             time_left(fraction, elapsed)
   end function bar

   !> A part of the whole as text.
   pure function percent(fraction) result(s)
      real(wp), intent(in) :: fraction   !! of the work done [1]
      character(4) :: s                  !! as ` 42%`

      write (s, "(i3, a)") nint(100.0_wp*max(0.0_wp, min(1.0_wp, fraction))), "%"
   end function percent

   !> How long it will still take.
   pure function time_left(fraction, elapsed) result(s)
      real(wp), intent(in) :: fraction   !! of the work done [1]
      real(wp), intent(in) :: elapsed    !! time since the start [s]
      character(:), allocatable :: s     !! as `2 min 5 s left`

      real(wp) :: left
      integer :: seconds

      s = ""
      if (fraction <= 1.0e-6_wp) return
      left = elapsed*(1.0_wp - min(1.0_wp, fraction))/fraction
      if (left > 3.6e8_wp) return
      seconds = nint(left)
      if (seconds < 60) then
         s = to_text(seconds)//" s left"
      else if (seconds < 3600) then
         s = to_text(seconds/60)//" min "//to_text(mod(seconds, 60))//" s left"
      else
         s = to_text(seconds/3600)//" h "//to_text(mod(seconds, 3600)/60)//" min left"
      end if
   end function time_left

end module progress
