!> The group /extremes of run.h5: what the channels and the clearance joints of a run went through.
module hdf5_extremes
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use extremes, only: extreme_t, extremes_t, joint_extremes_t
   use hdf5, only: hid_t
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use kinds, only: i8, wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: bytes_of_extremes, write_extremes

   integer(i8), parameter :: bytes_of_number = 512_i8  !! of a name, a unit and six numbers, at most

contains

   !> Space that the group takes.
   pure integer(i8) function bytes_of_extremes(extremes, joints) result(bytes)
      type(extremes_t), intent(in) :: extremes         !! of the channels
      type(joint_extremes_t), intent(in) :: joints(:)  !! (n) of the joints

      bytes = bytes_of_number*(size(extremes%channels, kind=i8) + size(joints, kind=i8))
   end function bytes_of_extremes

   !> Write the group.
   subroutine write_extremes(file, extremes, joints, catalogue, status)
      integer(hid_t), intent(in) :: file               !! the file
      type(extremes_t), intent(in) :: extremes         !! of the channels
      type(joint_extremes_t), intent(in) :: joints(:)  !! (m) of the joints
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      integer, intent(inout) :: status                 !! negative: failed

      type(text_t) :: names(size(extremes%channels)), units(size(extremes%channels))
      type(text_t) :: of_joints(size(joints))
      type(extreme_t) :: one(size(extremes%channels))
      integer :: k, n

      n = size(extremes%channels)
      if (n > 0) then
         one = [(extremes%told(k), k=1, n)]
         do k = 1, n
            names(k)%s = scalar_name(catalogue, extremes%channels(k))
            units(k)%s = catalogue%groups(extremes%channels(k)%group)%channel%unit
         end do
         call text_dataset(file, "extremes/channels/name", names, .false., "names of the statistics", status)
         call text_dataset(file, "extremes/channels/unit", units, .false., "their units", status)
         call put("channels/least", one%minimum, "list", "minimum, located between rows too")
         call put("channels/least_time", one%min_time, "s", "time of the first minimum")
         call put("channels/greatest", one%maximum, "list", "maximum, located between rows too")
         call put("channels/greatest_time", one%max_time, "s", "time of the first maximum")
         call put("channels/mean", [(extremes%mean(k), k=1, n)], "list", "time average")
         call put("channels/rms", [(extremes%rms(k), k=1, n)], "list", "root mean square over time")
      end if
      if (size(joints) == 0) return
      do k = 1, size(joints)
         of_joints(k)%s = joints(k)%name
      end do
      call text_dataset(file, "extremes/joints/name", of_joints, .false., "joints with clearance", status)
      call integer_dataset(file, "extremes/joints/impacts", [size(joints)], joints%impacts, "number of impacts", status)
      call put("joints/contact_fraction", joints%contact_fraction, "1", "fraction of time in contact")
      call put("joints/impact_speed", joints%speed, "m/s", "maximum impact speed")
      call put("joints/impact_speed_onset", joints%speed_onset, "s", "onset of that contact")
      call put("joints/peak_force", joints%force, "N", "maximum normal force")
      call put("joints/peak_force_onset", joints%force_onset, "s", "onset of the contact with maximum force")
      call put("joints/peak_force_time", joints%force_time, "s", "time of the maximum force")
      call put("joints/peak_penetration", joints%penetration, "m", "maximum penetration")
      call put("joints/peak_penetration_onset", joints%penetration_onset, "s", "onset of the contact with maximum penetration")
      call put("joints/peak_penetration_time", joints%penetration_time, "s", "time of the maximum penetration")
      call put("joints/impulse", joints%impulse, "N.s", "impulse of the normal forces of all contacts")
      call put("joints/energy_lost", joints%energy_lost, "J", "energy lost in all contacts; NaN if the energy balance is off")

   contains

      !> A list of numbers.
      subroutine put(path, values, units, long_name)
         character(*), intent(in) :: path       !! within the group
         real(wp), intent(in) :: values(:)      !! (any) the numbers [any]
         character(*), intent(in) :: units      !! their unit
         character(*), intent(in) :: long_name  !! what they are

         call real_dataset(file, "extremes/"//path, [size(values)], values, units, long_name, status)
      end subroutine put

   end subroutine write_extremes

end module hdf5_extremes
