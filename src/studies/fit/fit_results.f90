!> What a fit finds.
module fit_results
   use fit_layout, only: place_t
   use fit_model, only: measured_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: fit_t, fitted_sensor_t

   !> A sensor.
   type :: fitted_sensor_t
      character(:), allocatable :: name       !! of its row
      character(:), allocatable :: channel    !! one number, by its full name
      character(:), allocatable :: unit       !! SI
      real(wp) :: sigma = 0.0_wp              !! standard deviation of its noise, SI [any]
      logical :: is_given = .false.           !! the deck gives it
      real(wp) :: rms = 0.0_wp                !! root mean square of its residuals, SI [any]
      integer :: n_used = 0                   !! data that were fitted
   end type fitted_sensor_t

   !> The search.
   type :: search_t
      integer :: end = 0                      !! how it ended, as `least_squares` has it
      integer :: n_derived = 0                !! how often derivatives were found
      integer :: n_motion = 0                 !! motions
   end type search_t

   !> The fit.
   type :: fit_t
      type(place_t), allocatable :: places(:)             !! (n) the unknowns
      real(wp), allocatable :: value(:)                   !! (n) their values, SI [any]
      real(wp), allocatable :: deviation(:)               !! (n) standard deviations, SI [any]
      real(wp), allocatable :: low(:), high(:)            !! (n) ends of the 95 % intervals, SI [any]
      logical, allocatable :: is_seen(:)                  !! (n) whether the data see it
      integer, allocatable :: partner(:)                  !! (n) unknown that it cannot be separated from; 0: none
      real(wp), allocatable :: correlation(:, :)          !! (n, n) of the unknowns [1]
      type(fitted_sensor_t), allocatable :: sensors(:)    !! (sensors) noise and residuals
      type(measured_t), allocatable :: sets(:)            !! (sets) data and model
      real(wp) :: deviation_of_residuals = 0.0_wp         !! root of their weighted squares over the degrees of freedom [1]
      integer :: n_data = 0                               !! numbers that were fitted
      type(search_t) :: search                            !! what it took
   end type fit_t

end module fit_results
