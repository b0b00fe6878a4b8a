!> What a fit finds.
module fit_results
   use fit_layout, only: place_t
   use fit_model, only: measured_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: fit_t

   !> The fit.
   type :: fit_t
      type(place_t), allocatable :: places(:)         !! (n) the unknowns
      real(wp), allocatable :: value(:)               !! (n) their values, SI [any]
      real(wp), allocatable :: deviation(:)           !! (n) standard deviations, SI [any]
      real(wp), allocatable :: low(:), high(:)        !! (n) ends of the 95 % intervals, SI [any]
      logical, allocatable :: is_seen(:)              !! (n) whether the data see it
      integer, allocatable :: partner(:)              !! (n) unknown that it cannot be told from; 0: none
      real(wp), allocatable :: correlation(:, :)      !! (n, n) of the unknowns [1]
      real(wp) :: quantile = 0.0_wp                   !! half width of an interval in standard deviations [1]
      type(text_t), allocatable :: sensors(:)         !! (sensors) names
      type(text_t), allocatable :: channels(:)        !! (sensors) channels
      type(text_t), allocatable :: units(:)           !! (sensors) SI units
      real(wp), allocatable :: sigma(:)               !! (sensors) standard deviations of the noise, SI [any]
      logical, allocatable :: is_given(:)             !! (sensors) it was given
      real(wp), allocatable :: rms(:)                 !! (sensors) root mean square of the residuals, SI [any]
      integer, allocatable :: n_used(:)               !! (sensors) data that were fitted
      type(measured_t), allocatable :: sets(:)        !! (sets) data and model
      real(wp) :: deviation_of_residuals = 0.0_wp     !! root of their weighted squares over the degrees of freedom [1]
      integer :: n_data = 0                           !! numbers that were fitted
      integer :: end = 0                              !! how the search ended, as `least_squares` has it
      integer :: n_derived = 0                        !! how often derivatives were found
      integer :: n_motion = 0                         !! motions
   end type fit_t

end module fit_results
