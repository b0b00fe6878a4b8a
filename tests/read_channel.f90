!> One channel of a set, as a report finds it.
module read_channel
   use catalogue, only: group_t
   use clearance_set, only: clearance_set_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use readings, only: readings_t
   implicit none (type, external)
   private
   public :: channel_code, read_loose

contains

   !> Number by which a kind knows a channel, 0 if it has none of that name.
   pure integer function channel_code(info, name) result(code)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! part after the item's name and a dot

      integer :: k

      code = 0
      if (.not. allocated(info%channels)) return
      do k = 1, size(info%channels)
         if (info%channels(k)%name == name) code = info%channels(k)%code
      end do
   end function channel_code

   !> Values of a channel of all items, or of all contacts.
   subroutine read_loose(set, channel, motion, values)
      class(clearance_set_t), intent(in) :: set   !! the set
      character(*), intent(in) :: channel         !! name of the channel
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(inout) :: values(:, :)     !! (components, all items or contacts) values [any]

      type(group_t) :: groups(1)
      type(readings_t) :: readings

      call readings%start(1)
      call readings%add(channel_code(set%info(), channel), 1, 0)
      groups(1)%data = values
      call set%report(readings, motion, groups)
      values = groups(1)%data
   end subroutine read_loose

end module read_channel
