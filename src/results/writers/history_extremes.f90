!> Extremes of the channels of a run.h5, which are located between rows too.
module history_extremes
   use hdf5, only: hid_t
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use name_table, only: name_table_t
   use series, only: history_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: read_extremes

contains

   !> The extremes; a run that continues has none yet.
   subroutine read_extremes(file, history, status)
      integer(hid_t), intent(in) :: file            !! the file
      type(history_t), intent(inout) :: history     !! its numbers take their extremes
      integer, intent(inout) :: status              !! negative: failed

      character(13), parameter :: quantities(4) = [character(13) :: "least", "greatest", "least_time", "greatest_time"]
      type(name_table_t) :: table
      type(text_t), allocatable :: names(:)
      real(wp), allocatable :: of(:, :), values(:)
      integer :: i, k

      if (.not. has_dataset(file, "extremes/channels", "name")) return
      call read_texts(file, "extremes/channels/name", names, status)
      if (status < 0) return
      allocate (of(size(names), 4), source=0.0_wp)
      do k = 1, 4
         call read_reals(file, "extremes/channels/"//trim(quantities(k)), values, status)
         if (status >= 0 .and. size(values) /= size(names)) status = -1
         if (status < 0) return
         of(:, k) = values
      end do
      call table%list(names)
      do i = 1, size(history%list)
         k = table%find(history%list(i)%name)
         if (k == 0) cycle
         if (any(ieee_is_nan(of(k, :)))) cycle
         history%list(i)%extreme = of(k, 1:2)
         history%list(i)%extreme_at = of(k, 3:4)
      end do
   end subroutine read_extremes

end module history_extremes
