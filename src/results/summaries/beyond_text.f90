!> The statistics of a comparison of settings beyond the time that is compared, as text.
module beyond_text
   use batch_means, only: estimate_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_results, only: tol_sweep_t, n_statistic, precision_t, tol_run_done, tol_run_other, statistic_units, statistic_words
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_statistics

   integer, parameter :: width = 24          !! characters of a column
   real(wp), parameter :: chance = 0.05_wp   !! runs of equal statistics that are apart by chance [1]

contains

   !> For every statistic that is known: of the reference, of the runs of each setting together, and how many of them are apart.
   subroutine add_statistics(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      character(:), allocatable :: line
      integer :: k, longest, n_ended, n_own, s

      associate (reference => study%reference%statistics)
         if (.not. reference%is_there) return
         n_own = 0
         n_ended = 0
         do k = 1, size(study%tol_sweeps)
            n_own = n_own + count(study%tol_sweeps(k)%tol_runs%statistics%is_own)
            n_ended = n_ended + count(study%tol_sweeps(k)%tol_runs%state == tol_run_done &
                                      .or. study%tol_sweeps(k)%tol_runs%state == tol_run_other)
         end do
         call lines%line("statistics from "//real_text(reference%from, 4)//" to "//real_text(study%end, 4)// &
                         " s, beyond the comparison window, with 95 % confidence intervals,")
         call lines%line("of the reference and of the runs that diverged from it, "//to_text(n_own)//" of "// &
                         to_text(n_ended)//" do:")
         longest = len("reference")
         do k = 1, size(study%tol_sweeps)
            longest = max(longest, len(study%tol_sweeps(k)%name))
         end do
         do s = 1, n_statistic
            if (.not. ieee_is_finite(reference%list(s)%value)) cycle
            call lines%line("  "//trim(statistic_words(s))//" ["//trim(statistic_units(s))//"]")
            line = "    "//padded("reference", longest)//padded(estimate_text(reference%list(s)), width)
            call lines%line(trim(line)//told(.not. ieee_is_finite(reference%list(s)%half), "too few values for an interval"))
            do k = 1, size(study%tol_sweeps)
               associate (tol_sweep => study%tol_sweeps(k))
                  if (tol_sweep%statistics%n_run(s) == 0) cycle
                  call lines%line("    "//padded(tol_sweep%name, longest)//padded(estimate_text(tol_sweep%statistics%list(s)), &
                                                                                  width)// &
                                  apart_text(tol_sweep, s))
               end associate
            end do
         end do
         call lines%line("")
      end associate
   end subroutine add_statistics

   !> How many runs of a setting are apart from the reference.
   function apart_text(tol_sweep, s) result(words)
      type(tol_sweep_t), intent(in) :: tol_sweep       !! the setting
      integer, intent(in) :: s                   !! the statistic
      character(:), allocatable :: words         !! as `1 of 27 apart from the reference`

      associate (n => tol_sweep%statistics%n_run(s), apart => tol_sweep%statistics%n_apart(s))
         words = to_text(apart)//" of "//to_text(n)//" significantly different from the reference"// &
                 told(apart > 0 .and. by_chance(apart, n) > 1.001_wp*chance, "within chance")
      end associate
   end function apart_text

   !> The probability that at least k of n runs of equal statistics are apart: one less the first terms of the binomial
   !> distribution.
   pure real(wp) function by_chance(k, n) result(probability)
      integer, intent(in) :: k     !! runs that are apart, 1 or more
      integer, intent(in) :: n     !! runs

      real(wp) :: term
      integer :: i

      probability = 1.0_wp
      term = (1.0_wp - chance)**n
      do i = 0, k - 1
         probability = probability - term
         term = term*chance/(1.0_wp - chance)*real(n - i, wp)/real(i + 1, wp)
      end do
   end function by_chance

   !> A remark, if it holds.
   pure function told(is_so, remark) result(words)
      logical, intent(in) :: is_so              !! whether it holds
      character(*), intent(in) :: remark        !! the remark
      character(:), allocatable :: words        !! as `, remark`, or blank

      words = ""
      if (is_so) words = ", "//remark
   end function told

   !> An estimate with its interval.
   function estimate_text(estimate) result(words)
      type(estimate_t), intent(in) :: estimate   !! the estimate [any]
      character(:), allocatable :: words         !! as `12.3 +-0.4`

      words = real_text(estimate%value, 4)
      if (ieee_is_finite(estimate%half)) words = words//" +-"//real_text(estimate%half, 2)
   end function estimate_text

   !> A word at the left of its column.
   pure function padded(word, length) result(cell)
      character(*), intent(in) :: word            !! the word
      integer, intent(in) :: length               !! of the column
      character(:), allocatable :: cell           !! with blanks behind it

      cell = word//repeat(" ", max(0, length - len(word)) + 2)
   end function padded

end module beyond_text
