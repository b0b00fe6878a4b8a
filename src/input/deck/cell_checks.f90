!> Checks of single values: number of cells, words to choose from, ranges.
module cell_checks
   use diagnostics, only: diagnostics_t
   use item, only: location_t
   use kind_info, only: column_t, dim_angle, no_bound, same_dimension
   use kinds, only: eps, wp
   use spelling, only: nearest_word
   use text, only: join, split_blank, text_t, to_text
   use tokens, only: span, token_t
   implicit none (type, external)
   private
   public :: check_choice, check_count, check_range, is_name

   real(wp), parameter :: min_magnitude = 1.0e-50_wp   !! of a number that is not zero, SI [any]
   real(wp), parameter :: most_magnitude = 1.0e50_wp     !! of a number, so that products of some of them are finite, SI [any]
   real(wp), parameter :: most_angle = 1.0e-6_wp/eps     !! of an angle: the next number is 1e-6 rad away [rad]

contains

   !> Report superfluous cells.
   subroutine check_count(list, n, place, mistakes, help)
      type(token_t), intent(in) :: list(:)            !! cells
      integer, intent(in) :: n                        !! as many as there may be
      character(*), intent(in) :: place               !! as `in key end of analysis.dynamic`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      character(*), intent(in), optional :: help      !! what to do

      if (size(list) <= n) return
      if (present(help)) then
         call mistakes%add(span(list(n + 1), list(size(list))), "too many values "//place, "unexpected extra value", help)
      else
         call mistakes%add(span(list(n + 1), list(size(list))), "too many values "//place, "unexpected extra value", &
                         & "put text of several words in quotes")
      end if
   end subroutine check_count

   !> Report a word that is not among the choices.
   subroutine check_choice(choices, place, word, location, mistakes)
      character(:), allocatable, intent(in) :: choices  !! blank-separated words; unallocated or blank: any
      character(*), intent(in) :: place                 !! as `in column level of clearance.revolute`
      character(*), intent(in) :: word                  !! as written
      type(location_t), intent(in) :: location          !! of the word
      type(diagnostics_t), intent(inout) :: mistakes    !! collects what is wrong

      type(text_t), allocatable :: list(:)
      character(:), allocatable :: help
      integer :: i

      if (.not. allocated(choices)) return
      list = split_blank(choices)
      if (size(list) == 0 .or. len(word) == 0) return
      do i = 1, size(list)
         if (list(i)%s == word) return
      end do
      help = nearest_word(word, list)
      if (len(help) > 0) help = "did you mean '"//help//"'? "
      call mistakes%add(location, "unknown word '"//word//"' "//place, "not one of the choices", &
                      & help//"choices: "//join(list, " "))
   end subroutine check_choice

   !> Report a number that is out of the column's range, or of the one that the program computes in.
   subroutine check_range(column, x, unit, location, place, mistakes)
      type(column_t), intent(in) :: column            !! with bounds
      real(wp), intent(in) :: x                       !! the number, SI [any]
      character(*), intent(in) :: unit                !! SI unit of the number
      type(location_t), intent(in) :: location        !! of the number
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: lower, suffix, upper
      logical :: is_high, is_low

      if (column%bounds%not_zero .and. .not. abs(x) > 0.0_wp) then
         call mistakes%add(location, to_text(x)//" is out of range "//place, "must not be 0")
         return
      end if
      is_low = x < column%bounds%lower .or. (column%bounds%open_lower .and. .not. x > column%bounds%lower)
      is_high = x > column%bounds%upper .or. (column%bounds%open_upper .and. .not. x < column%bounds%upper)
      if (column%bounds%lower <= -no_bound) is_low = .false.
      if (column%bounds%upper >= no_bound) is_high = .false.
      if (.not. is_low .and. .not. is_high) then
         if (abs(x) > most_angle .and. same_dimension(column%dimension, dim_angle)) then
            call mistakes%add(location, to_text(x)//" rad is out of range "//place, "at most "//to_text(most_angle)// &
                              " rad in magnitude", "the spacing of numbers exceeds 1e-6 rad here: subtract whole revolutions")
            return
         end if
         if (.not. (abs(x) > 0.0_wp) .or. (abs(x) >= min_magnitude .and. abs(x) <= most_magnitude)) return
         call mistakes%add(location, to_text(x)//" is out of range "//place, "allowed: 0, and "// &
                           to_text(min_magnitude)//" to "//to_text(most_magnitude)//" in magnitude, in SI units")
         return
      end if
      suffix = ""
      if (unit /= "1") suffix = " "//unit
      lower = ""
      upper = ""
      if (column%bounds%lower > -no_bound) then
         lower = "at least "//to_text(column%bounds%lower)//suffix
         if (column%bounds%open_lower) lower = "greater than "//to_text(column%bounds%lower)//suffix
      end if
      if (column%bounds%upper < no_bound) then
         upper = "at most "//to_text(column%bounds%upper)//suffix
         if (column%bounds%open_upper) upper = "less than "//to_text(column%bounds%upper)//suffix
      end if
      if (len(lower) > 0 .and. len(upper) > 0) lower = lower//" and "
      call mistakes%add(location, to_text(x)//suffix//" is out of range "//place, "must be "//lower//upper)
   end subroutine check_range

   !> Whether a word is a name: letters, digits, `_` and `-`, with a letter or digit in it.
   pure logical function is_name(word)
      character(*), intent(in) :: word  !! any word

      character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"

      is_name = verify(word, letters//"_-") == 0 .and. scan(word, letters) > 0
   end function is_name

end module cell_checks
