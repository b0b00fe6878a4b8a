!> One channel of a set, as a report finds it.
module read_channel
   use clearance_set, only: clearance_set_t
   use coordinates, only: coordinates_t
   use joint_set, only: joint_set_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use readings, only: readings_t
   use rows, only: rows_t
   implicit none (type, external)
   private
   public :: channel_code, read_joints, read_loose

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

   !> Values of a channel of all items of a set of joints, each in its column.
   subroutine read_joints(set, code, motion, coordinates, rows, lambda, phi_dot, values)
      class(joint_set_t), intent(in) :: set            !! the set
      integer, intent(in) :: code                      !! the channel
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in) :: lambda(:)                !! (rows) multipliers [N or N.m]
      real(wp), intent(in) :: phi_dot(:)               !! (rows) rates of the violations [m/s or rad/s]
      real(wp), intent(inout) :: values(:, :)          !! (components, columns) values [any]

      type(readings_t) :: readings
      real(wp) :: row(size(values))
      integer :: k

      call readings%start(set%n)
      do k = 1, set%n
         call readings%add(code, 1, k, size(values, 1)*(set%column(k) - 1), size(values, 1))
      end do
      row = reshape(values, [size(values)])
      call set%report(readings, motion, coordinates, rows, lambda, phi_dot, row)
      values = reshape(row, shape(values))
   end subroutine read_joints

   !> Values of a channel of all items, or of all contacts.
   subroutine read_loose(set, channel, motion, values)
      class(clearance_set_t), intent(in) :: set   !! the set
      character(*), intent(in) :: channel         !! name of the channel
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(inout) :: values(:, :)     !! (components, all items or contacts) values [any]

      type(readings_t) :: readings
      real(wp) :: row(size(values))

      call readings%start(1)
      call readings%add(channel_code(set%info(), channel), 1, 0, 0, size(values, 1))
      row = reshape(values, [size(values)])
      call set%report(readings, motion, row)
      values = reshape(row, shape(values))
   end subroutine read_loose

end module read_channel
