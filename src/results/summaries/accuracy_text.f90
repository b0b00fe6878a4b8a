!> What a run whose accuracy was asked for knows of its errors, as text.
module accuracy_text
   use accuracy_results, only: accuracy_t, claim_none, claim_reached, claim_whole, claim_window
   use accuracy_table, only: worst_of
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_text, only: growth_words, short
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: asked_lines

contains

   !> How right the channels asked for are.
   subroutine asked_lines(lines, accuracy)
      type(buffer_t), intent(inout) :: lines       !! the summary
      type(accuracy_t), intent(in) :: accuracy     !! what is known

      character(:), allocatable :: asked, until

      until = "t = "//real_text(accuracy%until, 6)//" s"
      asked = "requested  accuracy "//real_text(accuracy%asked, 3)
      select case (accuracy%claim)
      case (claim_whole)
         call lines%line(asked//": reached, "//short(accuracy%error)//" up to the end")
      case (claim_window)
         call lines%line(asked//": reached up to "//until//", "//short(accuracy%error))
         call lines%line("           beyond "//until//" the solution is not predictable: runs diverge there, first in "// &
            worst_of(accuracy))
         if (accuracy%reason /= "") call lines%line("           the search stopped: "//accuracy%reason)
      case (claim_reached)
         call lines%line(asked//": not reached; error "//short(accuracy%error)//" up to the end: "// &
                         accuracy%reason)
         call lines%line("           limited by "//worst_of(accuracy))
         if (accuracy%asked_until > 0.0_wp) then
            call lines%line("           satisfied up to t = "//real_text(accuracy%asked_until, 6)//" s")
         end if
      case default
         call lines%line(asked//": not reached, the error of this run is unknown: "//accuracy%reason)
      end select
      if (accuracy%claim == claim_window .and. accuracy%growth%reason == "") then
         call lines%line("           "//growth_words(accuracy%growth))
      end if
      if (accuracy%claim /= claim_none) then
         call lines%line("           "//to_text(nint(accuracy%evidence%factor))//" times the maximum difference to "// &
                         accuracy%evidence%coarser//" ("//short(accuracy%evidence%apart(1))// &
                         ") and to "//accuracy%evidence%confirmation//" ("//short(accuracy%evidence%apart(2))//")")
      end if
      if (ieee_is_finite(accuracy%evidence%residual) .and. accuracy%evidence%residual > accuracy%asked) then
         call lines%line("           the energy error does not support this accuracy: it is "//short(accuracy%evidence%residual)// &
                         " of the maximum energy")
      end if
      if (ieee_is_finite(accuracy%evidence%other_from)) then
         call lines%line("           from about t = "//real_text(accuracy%evidence%other_from, 3)// &
                         " s on the runs have different contacts: "// &
                         "these have no error estimate")
      end if
      call lines%line("           "//to_text(accuracy%evidence%runs)//" runs in "//real_text(accuracy%evidence%spent, 3)//" s")
   end subroutine asked_lines

end module accuracy_text
