!> Spectra that there are not: a channel that is no number, or infinite, at an output instant of the window has none.
module missing_spectra
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use statistics, only: statistics_t
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: spectra_without_numbers

contains

   !> A line for each spectrum whose amplitudes are not known.
   function spectra_without_numbers(statistics, catalogue) result(warnings)
      type(statistics_t), intent(in) :: statistics   !! what was gathered
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      type(text_t), allocatable :: warnings(:)       !! (any) the lines

      real(wp), allocatable :: amplitude(:), frequency(:)
      integer :: k

      allocate (warnings(0))
      do k = 1, size(statistics%spectra)
         call statistics%spectrum_of(k, frequency, amplitude)
         if (all(ieee_is_finite(amplitude))) cycle
         call append_text(warnings, "no spectrum of '"//scalar_name(catalogue, statistics%spectra(k))// &
                          "': it is not a number at every output instant of the statistics")
      end do
   end function spectra_without_numbers

end module missing_spectra
