!> Reasons why runs of a setting failed or were not made: each reported once, however its numbers differ from run to run.
module failure_reasons
   use precision_results, only: tol_run_t
   implicit none (type, external)
   private
   public :: is_same_reason, reason_t, reasons_of

   character(*), parameter :: digits = "0123456789"
   character(*), parameter :: of_numbers = digits//".eE+-"   !! what stands in a number behind its first digit

   !> A reason.
   type :: reason_t
      integer :: first = 0   !! first run that has it, from the coarsest on
      integer :: n = 0       !! runs that have it
   end type reason_t

contains

   !> The reasons of the runs in some state, in the order in which they first appear.
   pure function reasons_of(tol_runs, state) result(reasons)
      type(tol_run_t), intent(in) :: tol_runs(:)          !! (runs) of a setting
      integer, intent(in) :: state                  !! of those that are looked at
      type(reason_t), allocatable :: reasons(:)     !! (n) their reasons

      integer :: i, k

      allocate (reasons(0))
      do i = 1, size(tol_runs)
         if (tol_runs(i)%state /= state) cycle
         do k = 1, size(reasons)
            if (is_same_reason(tol_runs(reasons(k)%first)%reason, tol_runs(i)%reason)) exit
         end do
         if (k > size(reasons)) reasons = [reasons, reason_t(i, 0)]
         reasons(k)%n = reasons(k)%n + 1
      end do
   end function reasons_of

   !> Whether two reasons differ in their numbers at most.
   pure logical function is_same_reason(a, b)
      character(*), intent(in) :: a   !! a reason
      character(*), intent(in) :: b   !! another one

      is_same_reason = without_numbers(a) == without_numbers(b)
   end function is_same_reason

   !> A sentence with `#` in the place of each number.
   pure function without_numbers(words) result(rest)
      character(*), intent(in) :: words             !! the sentence
      character(:), allocatable :: rest             !! what is left of it

      integer :: i

      rest = ""
      i = 1
      do while (i <= len(words))
         if (scan(words(i:i), digits) == 0) then
            if (words(i:i) /= "-") rest = rest//words(i:i)
            i = i + 1
         else
            rest = rest//"#"
            do while (i <= len(words))
               if (scan(words(i:i), of_numbers) == 0) exit
               i = i + 1
            end do
         end if
      end do
   end function without_numbers

end module failure_reasons
