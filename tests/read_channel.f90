!> One channel of a set of loose joints, as a report finds it.
module read_channel
   use catalogue, only: group_t
   use clearance_set, only: clearance_set_t
   use kind_info, only: channel_code
   use kinds, only: wp
   use motion, only: motion_t
   use readings, only: readings_t
   implicit none (type, external)
   private
   public :: read_loose

contains

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
