!> Statistics that there are not: of a run that ended before they begin, and the spectrum of a channel that is no number, or
!> infinite, at an output instant of the window.
module missing_statistics
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use statistics, only: statistics_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: statistics_without_numbers

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
         call append_text(warnings, "no statistics: the run ended before they begin, at "// &
                          real_text(statistics%plan%after, 6)//" s")
         return
      end if
      do k = 1, size(statistics%spectra)
         call statistics%spectrum_of(k, frequency, amplitude)
         if (all(ieee_is_finite(amplitude))) cycle
         call append_text(warnings, "no spectrum of '"//scalar_name(catalogue, statistics%spectra(k))// &
                          "': it is not a number at every output instant of the statistics")
      end do
   end function statistics_without_numbers

end module missing_statistics
