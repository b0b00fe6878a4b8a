!> Statistics that there are not: of a run that ended before they start, and the spectrum of a channel that is no number, or
!> infinite, at an output instant of the window.
module missing_statistics
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use statistics, only: statistics_t
   use text, only: append_text, real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: statistics_without_numbers

   integer, parameter :: most_named = 5   !! channels that a warning names

contains

   !> A line if there is no time for them, and one for each spectrum whose amplitudes are not known.
   function statistics_without_numbers(statistics, catalogue, t_end) result(warnings)
      type(statistics_t), intent(in) :: statistics   !! what was gathered
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      real(wp), intent(in) :: t_end                  !! last instant reached [s]
      type(text_t), allocatable :: warnings(:)       !! (any) the lines

      real(wp), allocatable :: amplitude(:), frequency(:)
      integer :: k

      allocate (warnings(0))
      if (.not. statistics%plan%is_wanted) return
      if (t_end <= statistics%plan%after) then
         call append_text(warnings, "no statistics: the run ended before their start, at "// &
                          real_text(statistics%plan%after, 6)//" s")
         return
      end if
      call add_missing(statistics, catalogue, warnings)
      do k = 1, size(statistics%spectra)
         call statistics%spectrum_of(k, frequency, amplitude)
         if (all(ieee_is_finite(amplitude))) cycle
         call append_text(warnings, "no spectrum of '"//scalar_name(catalogue, statistics%spectra(k))// &
                          "': it is NaN at some output times of the statistics")
      end do
   end function statistics_without_numbers

   !> Lines for means that are not known, and why: no time, or no channel with a number.
   subroutine add_missing(statistics, catalogue, warnings)
      type(statistics_t), intent(in) :: statistics              !! what was gathered
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      character(:), allocatable :: names
      integer :: k, n

      if (size(statistics%channels) == 0) return
      if (.not. statistics%has_time()) then
         call append_text(warnings, "statistics have no mean and no RMS: their window holds fewer than two output times; "// &
                          "reduce `every` in [output]")
         return
      end if
      names = ""
      n = 0
      do k = 1, size(statistics%channels)
         if (statistics%has_mean(k)) cycle
         n = n + 1
         if (n <= most_named) names = names//", '"//scalar_name(catalogue, statistics%channels(k))//"'"
      end do
      if (n == 0) return
      if (n > most_named) names = names//" and "//to_text(n - most_named)//" more"
      call append_text(warnings, "no mean and no RMS of "//names(3:)//": no two consecutive output times of the statistics "// &
                       "have a value")
   end subroutine add_missing

end module missing_statistics
