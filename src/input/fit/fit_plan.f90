!> What a fit is asked: unknown parameters with their bounds, sensors, sets of data, settings.
module fit_plan
   use item, only: location_t
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: data_set_t, fit_plan_t, sensor_t, unknown_t

   !> An unknown parameter of the deck.
   type :: unknown_t
      character(:), allocatable :: name       !! of the parameter
      type(dim_t) :: dimension = dim_none     !! of its value
      real(wp) :: lower = 0.0_wp              !! lower bound, SI [any]
      real(wp) :: upper = 0.0_wp              !! upper bound, SI [any]
      real(wp) :: start = 0.0_wp              !! where the search starts, SI [any]
      logical :: is_each = .false.            !! every set of data has its own value
   end type unknown_t

   !> A sensor.
   type :: sensor_t
      character(:), allocatable :: name       !! of its row
      character(:), allocatable :: channel    !! as written
      character(:), allocatable :: column     !! of the data, as `gudgeon compare` reads it; blank: as the channel
      real(wp) :: sigma = 0.0_wp              !! standard deviation of its noise, SI; 0: that of the residuals [any]
      real(wp) :: offset = 0.0_wp             !! maximum magnitude of its unknown offset, SI; 0: it has none [any]
      real(wp) :: delay = 0.0_wp              !! maximum magnitude of its unknown delay; 0: it has none [s]
      type(location_t) :: location            !! of the channel
      type(location_t) :: at(2)               !! (2) of standard deviation and offset
      type(dim_t) :: dimensions(2)            !! (2) of these
      logical :: has(2) = .false.             !! (2) whether they are given
   end type sensor_t

   !> A set of data.
   type :: data_set_t
      character(:), allocatable :: name       !! of its row
      integer :: file = 1                     !! which file of the command line it is in
      real(wp) :: from = 0.0_wp               !! time of the data at which the motion starts [s]
      real(wp) :: to = huge(1.0_wp)           !! time of the data that is the last [s]
      type(text_t), allocatable :: changes(:) !! (n) parameters of the deck that are other in it, as NAME=VALUE
   end type data_set_t

   !> All of it.
   type :: fit_plan_t
      type(unknown_t), allocatable :: unknowns(:)   !! (n) rows of [fit]
      type(sensor_t), allocatable :: sensors(:)     !! (sensors) rows of [fit.sensor]
      type(data_set_t), allocatable :: sets(:)      !! (sets) rows of [fit.set]; none: each file is a set
      real(wp) :: tolerance = 0.0_wp                !! of the motions [1]
      real(wp), allocatable :: until(:)             !! (stages) times up to which the data are fitted in turn [s]
      integer :: most = 0                           !! iterations, at most
   end type fit_plan_t

end module fit_plan
