!> What a run whose accuracy was asked for knows of its errors, as text and for scripts.
module accuracy_text
   use accuracy_results, only: accuracy_t, claim_none, claim_reached, claim_whole, claim_window
   use accuracy_table, only: table_of_accuracy, worst_of
   use channel_noise, only: known_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use json_table, only: put_facts, put_rows
   use json_text, only: json_object_t
   use kinds, only: wp
   use precision_text, only: growth_words, short
   use result_table, only: result_table_t
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: accuracy_json, asked_lines, extreme_lines

   integer, parameter :: most_extremes = 40   !! rows of the table of extremes

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

   !> The extremes with their intervals.
   subroutine extreme_lines(lines, accuracy)
      type(buffer_t), intent(inout) :: lines       !! the summary
      type(accuracy_t), intent(in) :: accuracy     !! what is known

      character(:), allocatable :: name
      integer :: k, n

      n = size(accuracy%extremes)
      if (n == 0) return
      call lines%line("")
      name = "extremes"  ! located: those of the run
      if (accuracy%claim == claim_window) name = name//" up to t = "//real_text(accuracy%until, 6)//" s"
      call lines%line(padded(name, 42)//right("min", 20)//right("max", 20)//right("+-", 11))
      do k = 1, min(n, most_extremes)
         associate (extreme => accuracy%extremes(k))
            name = "  "//extreme%name
            if (extreme%unit /= "1") name = name//" ["//extreme%unit//"]"
            call lines%line(padded(name, 42)//right(known_text(extreme%minimum, 12), 20)//right(known_text(extreme%most, 12), &
                                                                                                20)// &
                            right(short(extreme%error), 11))
         end associate
      end do
      if (.not. all(ieee_is_finite(accuracy%extremes%minimum))) then
         call lines%line("  -: undefined; a contact point is defined only during contact")
      end if
      if (n > most_extremes) call lines%line("  and "//to_text(n - most_extremes)//" more in summary.json and run.h5")
   end subroutine extreme_lines

   !> A string with blanks behind it.
   pure function padded(string, width) result(s)
      character(*), intent(in) :: string   !! any string
      integer, intent(in) :: width         !! of the field
      character(:), allocatable :: s       !! never shorter than the string

      s = string//repeat(" ", max(width - len(string), 0))
   end function padded

   !> A string with blanks before it.
   pure function right(string, width) result(s)
      character(*), intent(in) :: string   !! any string
      integer, intent(in) :: width         !! of the field
      character(:), allocatable :: s       !! never shorter than the string and a blank

      s = repeat(" ", max(width - len(string), 1))//string
   end function right

   !> The same for scripts.
   function accuracy_json(accuracy) result(object)
      type(accuracy_t), intent(in) :: accuracy     !! what is known
      character(:), allocatable :: object          !! as text

      type(json_object_t) :: json
      type(result_table_t) :: table

      table = table_of_accuracy(accuracy, growth_words(accuracy%growth))
      call json%start(1)
      call put_facts(json, table)
      call put_rows(json, table, 2)
      object = json%get()
   end function accuracy_json

end module accuracy_text
