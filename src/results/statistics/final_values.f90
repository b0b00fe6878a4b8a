!> Values of channels at the last output time, as further numbers of a run: CHANNEL.final.
module final_values
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use statistics, only: number_t, statistics_t
   implicit none (type, external)
   private
   public :: add_finals

contains

   !> Add them, if they are asked for and there are output times.
   subroutine add_finals(statistics, catalogue, numbers)
      type(statistics_t), intent(in) :: statistics              !! what was gathered
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(number_t), allocatable, intent(inout) :: numbers(:)  !! (any) grown

      type(number_t) :: final
      integer :: k

      if (.not. statistics%plan%has_finals .or. .not. statistics%has_time()) return
      do k = 1, size(statistics%channels)
         final%name = scalar_name(catalogue, statistics%channels(k))//".final"
         final%unit = catalogue%groups(statistics%channels(k)%group)%channel%unit
         final%value = statistics%x_last(k)
         numbers = [numbers, final]
      end do
   end subroutine add_finals

end module final_values
