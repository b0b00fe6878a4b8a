!> Time histories of numbers by name, and impacts, whoever computed them.
module series
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: history_t, impact_t, series_t

   !> One number over the time.
   type :: series_t
      character(:), allocatable :: name   !! as `slider.velocity.x`
      character(:), allocatable :: unit   !! SI; blank: not known
      real(wp), allocatable :: x(:)       !! (n) values; NaN: none [any]
      logical :: is_state = .false.       !! one of a few whole numbers, which it keeps until it changes
      real(wp) :: turn = 0.0_wp           !! what it jumps by, as an angle from -pi to pi does; 0: it does not [any]
   end type series_t

   !> A contact that began.
   type :: impact_t
      character(:), allocatable :: item   !! joint, and label of the contact
      real(wp) :: time = 0.0_wp           !! of the onset [s]
      real(wp) :: speed = 0.0_wp          !! of the impact; NaN: not known [m/s]
      real(wp) :: force = 0.0_wp          !! greatest normal force; NaN: not known [N]
   end type impact_t

   !> What a run left.
   type :: history_t
      character(:), allocatable :: path             !! where it was read
      real(wp), allocatable :: time(:)              !! (n) times, never falling [s]
      logical, allocatable :: is_output(:)          !! (n) output instants; the others are those of contacts
      type(series_t), allocatable :: list(:)        !! (m) the numbers
      type(impact_t), allocatable :: impacts(:)     !! (k) by time
   end type history_t

end module series
