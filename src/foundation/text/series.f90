!> Time histories of numbers by name, and impacts, whoever computed them.
module series
   use kinds, only: wp
   use name_table, only: name_table_t
   implicit none (type, external)
   private
   public :: append_series, enter_names, history_t, impact_t, series_t

   !> One number over the time.
   type :: series_t
      character(:), allocatable :: name   !! as `slider.velocity.x`
      character(:), allocatable :: unit   !! SI; blank: not known
      real(wp), allocatable :: x(:)       !! (n) values; NaN: none [any]
      logical :: is_state = .false.       !! one of a few whole numbers, which it keeps until it changes
      real(wp), allocatable :: extreme(:)     !! (2) minimum and maximum value of the run; unallocated: those of the rows [any]
      real(wp), allocatable :: extreme_at(:)  !! (2) when, between rows too [s]
      real(wp) :: turn = 0.0_wp           !! what it jumps by, as an angle from -pi to pi does; 0: it does not [any]
   end type series_t

   !> A contact that started.
   type :: impact_t
      character(:), allocatable :: item   !! joint, and label of the contact
      real(wp) :: time = 0.0_wp           !! of the onset [s]
      real(wp) :: speed = 0.0_wp          !! of the impact; NaN: not known [m/s]
      real(wp) :: force = 0.0_wp          !! maximum normal force; NaN: not known [N]
   end type impact_t

   !> What a run left.
   type :: history_t
      character(:), allocatable :: path             !! where it was read
      real(wp), allocatable :: time(:)              !! (n) times, never falling [s]
      logical, allocatable :: is_output(:)          !! (n) output instants; the others are those of contacts
      type(series_t), allocatable :: list(:)        !! (m) the numbers
      type(impact_t), allocatable :: impacts(:)     !! (k) by time
   end type history_t

contains

   !> The numbers of series by their names; of equal names the first.
   subroutine enter_names(list, table)
      type(series_t), intent(in) :: list(:)        !! (n) the series
      type(name_table_t), intent(out) :: table     !! finds them

      integer :: k, previous

      call table%start(size(list))
      do k = 1, size(list)
         call table%enter(list(k)%name, k, previous)
      end do
   end subroutine enter_names

   !> Append series to a list; neither is copied, but for what stands beside the values.
   subroutine append_series(list, more, is_kept)
      type(series_t), allocatable, intent(inout) :: list(:)   !! grown
      type(series_t), intent(inout) :: more(:)                !! (n) emptied
      logical, intent(in) :: is_kept(:)                       !! (n) which of them

      type(series_t), allocatable :: grown(:)
      integer :: k, n

      n = size(list)
      allocate (grown(n + count(is_kept)))
      do k = 1, n
         call move_series(list(k), grown(k))
      end do
      do k = 1, size(more)
         if (.not. is_kept(k)) cycle
         n = n + 1
         call move_series(more(k), grown(n))
      end do
      call move_alloc(grown, list)
   end subroutine append_series

   !> Move a series.
   subroutine move_series(from, to)
      type(series_t), intent(inout) :: from     !! emptied
      type(series_t), intent(inout) :: to       !! filled

      real(wp), allocatable :: x(:)

      call move_alloc(from%x, x)
      to = from
      call move_alloc(x, to%x)
   end subroutine move_series

end module series
