!> The largest Lyapunov exponent and the horizon as text.
module horizon_text
   use batch_means, only: estimate_t
   use exponent, only: horizon_t, verdict, verdict_apart, verdict_differ, verdict_together, verdict_unclear, &
      verdict_unknown
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: segment, real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_horizon

contains

   !> The exponents, what they mean, and how long there are digits.
   subroutine add_horizon(lines, horizon)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(horizon_t), intent(in) :: horizon      !! what is known

      if (.not. allocated(horizon%t)) return
      if (verdict(horizon) == verdict_unknown) then
         call lines%line("exponent   unknown: "//horizon%tangent%reason)
         return
      end if
      if (horizon%tangent%reason == "") then
         call lines%line("exponent   "//rate_text(horizon%tangent%rate)//" from "//real_text(horizon%after, 3)//" to "// &
                         real_text(horizon%t(size(horizon%t)), 3)//" s, from the tangent equations, with jumps at "// &
                         to_text(horizon%n_crossed)//" events")
      else
         call lines%line("exponent   from the tangent equations unknown: "//horizon%tangent%reason)
      end if
      if (horizon%is_cut) call lines%line("           time budget exhausted before the end of the motion: "// &
                                          "raise it with --budget")
      if (horizon%twin%reason == "") then
         call lines%line("           "//rate_text(horizon%twin%rate)//" from a neighbouring trajectory, rescaled "// &
            to_text(horizon%n_renewed)// &
                         " times"//agreement(horizon))
      else if (horizon%with_twin) then
         call lines%line("           from a neighbouring trajectory unknown: "//horizon%twin%reason)
      end if
      call lines%line("           "//meaning(horizon))
      if (horizon%n_grazed > 0) call lines%line("           "//to_text(horizon%n_grazed)// &
         " grazing events: the tangent is undefined there, and was continued without a jump")
      if (horizon%n_together > 0) call lines%line("           "//to_text(horizon%n_together)// &
         " times with simultaneous events: the tangent includes only the first")
      if (horizon%tangent%reason /= "") return
      call lines%line("           digits in double precision"// &
                      trim(merge(", from the tangent", "                  ", verdict(horizon) == verdict_differ))//": "// &
                      digits_text(horizon%digits, horizon%is_cut))
      if (horizon%asked > 0.0_wp) call lines%line("           digits of a run of tolerance "//to_text(horizon%asked)//": "// &
                                                  digits_text(horizon%run_digits, horizon%is_cut))
   end subroutine add_horizon

   !> An exponent with its interval.
   function rate_text(rate) result(words)
      type(estimate_t), intent(in) :: rate        !! the exponent [s^-1]
      character(:), allocatable :: words          !! as `12.3 +-0.4 1/s`

      words = real_text(rate%value, 4)//" +-"//real_text(rate%half, 2)//" 1/s"
   end function rate_text

   !> Whether both methods agree.
   function agreement(horizon) result(words)
      type(horizon_t), intent(in) :: horizon      !! what is known
      character(:), allocatable :: words          !! blank if one of them is not known

      words = ""
      if (horizon%tangent%reason /= "" .or. horizon%twin%reason /= "") return
      words = trim(merge(": consistent within their intervals    ", ": NOT consistent within their intervals", &
         horizon%is_agreed))
   end function agreement

   !> What the exponent means.
   function meaning(horizon) result(words)
      type(horizon_t), intent(in) :: horizon      !! what is known
      character(:), allocatable :: words          !! one line

      select case (verdict(horizon))
      case (verdict_apart)
         words = "neighbouring trajectories diverge exponentially: chaotic, or unstable"
      case (verdict_together)
         words = "neighbouring trajectories converge: the motion is stable"
      case (verdict_differ)
         words = "undecided: the two methods differ by more than their intervals"
      case (verdict_unclear)
         words = "not significantly different from zero: the interval includes zero; extend the motion (exponent_end)"
      case default
         words = "not significantly different from zero: neighbouring trajectories diverge no faster than a power of time"
      end select
   end function meaning

   !> Times up to which there are digits.
   function digits_text(digits, is_cut) result(words)
      real(wp), intent(in) :: digits(:)           !! (k) times of k digits; NaN: beyond the end [s]
      logical, intent(in) :: is_cut               !! that end is not the one of the motion
      character(:), allocatable :: words          !! one line

      integer :: k

      words = ""
      do k = n_digit, 1, -1
         if (.not. ieee_is_finite(digits(k))) exit
         if (digits(k) <= 0.0_wp) cycle
         words = words//", "//to_text(k)//" to "//real_text(digits(k), 3)//" s"
      end do
      if (k > 0) words = words//", "//to_text(k)//" "//trim(merge("to the end of the search", "to the end              ", is_cut))
      words = segment(words, 3)
   end function digits_text

end module horizon_text
