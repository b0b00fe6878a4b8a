!> Extremes of a run as tables: of the channels, and of the joints with clearance.
module extremes_tables
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use extremes, only: extreme_t, extremes_t, joint_extremes_t
   use result_table, only: result_table_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: channel_extremes, joint_extremes

contains

   !> Extremes of the channels.
   function channel_extremes(extremes, catalogue) result(table)
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      type(result_table_t) :: table                 !! a row for each channel

      type(text_t), allocatable :: names(:), units(:)
      type(extreme_t), allocatable :: one(:)
      integer :: k, n

      n = size(extremes%channels)
      allocate (names(n), units(n), one(n))
      do k = 1, n
         names(k)%s = scalar_name(catalogue, extremes%channels(k))
         units(k)%s = catalogue%groups(extremes%channels(k)%group)%channel%unit
         one(k) = extremes%told(k)
      end do
      call table%start("extremes", "extremes/channels", n)
      call table%put("channel", "1", "names of the statistics", texts=names, dataset="name")
      call table%put("unit", "1", "their units", texts=units)
      call table%put("least", "list", "minimum, located between rows too", one%minimum)
      call table%put("least_time", "s", "time of the first minimum", one%min_time)
      call table%put("greatest", "list", "maximum, located between rows too", one%maximum)
      call table%put("greatest_time", "s", "time of the first maximum", one%max_time)
      call table%put("mean", "list", "time average", [(extremes%mean(k), k=1, n)])
      call table%put("rms", "list", "root mean square over time", [(extremes%rms(k), k=1, n)])
   end function channel_extremes

   !> Extremes of the joints with clearance.
   function joint_extremes(joints) result(table)
      type(joint_extremes_t), intent(in) :: joints(:) !! (n) the joints with contacts
      type(result_table_t) :: table                   !! a row for each joint

      type(text_t) :: names(size(joints))
      integer :: k

      do k = 1, size(joints)
         names(k)%s = joints(k)%name
      end do
      call table%start("loose_joints", "extremes/joints", size(joints))
      call table%put("joint", "1", "joints with clearance", texts=names, dataset="name")
      call table%put("impacts", "1", "number of impacts", integers=joints%impacts)
      call table%put("contact_fraction", "1", "fraction of time in contact", joints%contact_fraction)
      call table%put("impact_speed", "m/s", "maximum impact speed", joints%speed)
      call table%put("impact_speed_onset", "s", "onset of that contact", joints%speed_onset)
      call table%put("peak_force", "N", "maximum normal force", joints%force)
      call table%put("peak_force_onset", "s", "onset of the contact with maximum force", joints%force_onset)
      call table%put("peak_force_time", "s", "time of the maximum force", joints%force_time)
      call table%put("peak_penetration", "m", "maximum penetration", joints%penetration)
      call table%put("peak_penetration_onset", "s", "onset of the contact with maximum penetration", joints%penetration_onset)
      call table%put("peak_penetration_time", "s", "time of the maximum penetration", joints%penetration_time)
      call table%put("impulse", "N.s", "impulse of the normal forces of all contacts", joints%impulse)
      call table%put("energy_lost", "J", "energy lost in all contacts; NaN if the energy balance is off", joints%energy_lost)
   end function joint_extremes

end module extremes_tables
