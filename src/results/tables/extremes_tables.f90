!> Extremes of a run as tables: of the channels, and of the joints with clearance.
module extremes_tables
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use extremes, only: extreme_t, extremes_t, joint_extremes_t
   use groups_of_catalogue, only: group_clearances, group_contacts
   use kinds, only: wp
   use result_table, only: only_shown, result_table_t
   use text, only: append_text, counted, text_t
   implicit none (type, external)
   private
   public :: channel_extremes, joint_extremes

contains

   !> Extremes of the channels; of a run without duration people see one value.
   function channel_extremes(extremes, catalogue) result(table)
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      type(result_table_t) :: table                 !! a row for each channel

      type(text_t), allocatable :: names(:), units(:)
      type(extreme_t), allocatable :: one(:)
      integer, allocatable :: list(:)
      integer :: k, n

      list = forces_first(extremes, catalogue)
      n = size(list)
      allocate (names(n), units(n), one(n))
      do k = 1, n
         names(k)%s = scalar_name(catalogue, extremes%channels(list(k)))
         units(k)%s = catalogue%groups(extremes%channels(list(k))%group)%channel%unit
         one(k) = extremes%told(list(k))
      end do
      call table%start("extremes", "extremes/channels", n, title="extremes", &
                       elsewhere="summary.json and in run.h5, /extremes/channels")
      call table%put("channel", "1", "names of the statistics", texts=names, dataset="name", heading="channel")
      call table%put("unit", "1", "their units", texts=units)
      call table%put("least", "list", "minimum, located between rows too", one%minimum, heading="min")
      call table%put("least_time", "s", "time of the first minimum", one%min_time, heading="at", digits=6)
      call table%put("greatest", "list", "maximum, located between rows too", one%maximum, heading="max")
      call table%put("greatest_time", "s", "time of the first maximum", one%max_time, heading="at", digits=6)
      call table%put("mean", "list", "time average", [(extremes%mean(list(k)), k=1, n)])
      call table%put("mean", "list", "zero if it is round-off beside the root mean square", &
                     [(extremes%shown_mean(list(k)), k=1, n)], formats=only_shown, heading="mean")
      call table%put("rms", "list", "root mean square over time", [(extremes%rms(list(k)), k=1, n)], heading="rms")
      table%units = units
      table%noise = extremes%noise(list)
      table%is_minor = [(extremes%is_nothing(list(k)) .or. .not. extremes%has_values(list(k)), k=1, n)]
      if (.not. extremes%has_course()) then
         table%title = "values"
         table%columns(3)%heading = "value"
         do k = 4, size(table%columns)
            if (allocated(table%columns(k)%heading)) deallocate (table%columns(k)%heading)
         end do
      else if (.not. extremes%has_time()) then
         call append_text(table%notes, "-: no mean of a single output time")
      end if
      if (n == 0) table%group = ""
      call rest(count([(extremes%is_nothing(list(k)), k=1, n)]), "with zeros or round-off only")
      call rest(count([(.not. extremes%has_values(list(k)), k=1, n)]), "without values")

   contains

      !> Note how many further channels there are.
      subroutine rest(how_many, what)
         integer, intent(in) :: how_many    !! their number
         character(*), intent(in) :: what   !! what they are

         if (how_many > 0) call append_text(table%notes, counted(how_many, "channel", "channels")//" "//what)
      end subroutine rest

   end function channel_extremes

   !> The numbers that are recorded: forces and moments, then what else joints with clearance and contacts have, then the others.
   pure function forces_first(extremes, catalogue) result(list)
      type(extremes_t), intent(in) :: extremes      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      integer, allocatable :: list(:)               !! (n) their numbers

      integer :: k, rank(extremes%n_recorded)

      do k = 1, size(rank)
         associate (group => catalogue%groups(extremes%channels(k)%group))
            rank(k) = 3
            if (any(group%item_group == [group_clearances, group_contacts])) rank(k) = 2
            if (any(group%channel%unit == ["N  ", "N.m"])) rank(k) = 1
         end associate
      end do
      list = [pack([(k, k=1, size(rank))], rank == 1), pack([(k, k=1, size(rank))], rank == 2), &
              pack([(k, k=1, size(rank))], rank == 3)]
   end function forces_first

   !> Extremes of the joints with clearance.
   function joint_extremes(joints, has_course) result(table)
      type(joint_extremes_t), intent(in) :: joints(:) !! (n) the joints with contacts
      logical, intent(in) :: has_course               !! the run has a duration; people see nothing of one without
      type(result_table_t) :: table                   !! a row for each joint

      type(text_t) :: names(size(joints))
      integer :: k

      do k = 1, size(joints)
         names(k)%s = joints(k)%name
      end do
      call table%start("loose_joints", "extremes/joints", size(joints), title="joints with clearance", &
                       elsewhere="summary.json and in run.h5, /extremes/joints")
      if (.not. has_course) table%title = ""
      if (size(joints) == 0) table%group = ""
      table%is_minor = joints%impacts == 0 .and. .not. joints%contact_fraction > 0.0_wp
      if (any(table%is_minor)) call append_text(table%notes, counted(count(table%is_minor), "joint", "joints")//" without contact")
      call table%put("joint", "1", "joints with clearance", texts=names, dataset="name", heading="joint")
      call table%put("impacts", "1", "number of impacts", integers=joints%impacts, heading="impacts")
      call table%put("contact_fraction", "1", "fraction of time in contact", joints%contact_fraction, &
                     heading="in contact", digits=4)
      call table%put("impact_speed", "m/s", "maximum impact speed", joints%speed, heading="max speed")
      call table%put("impact_speed_onset", "s", "onset of that contact", joints%speed_onset, heading="at", digits=6)
      call table%put("peak_force", "N", "maximum normal force", joints%force, heading="max force", digits=6)
      call table%put("peak_force_onset", "s", "onset of the contact with maximum force", joints%force_onset)
      call table%put("peak_force_time", "s", "time of the maximum force", joints%force_time, heading="at", digits=6)
      call table%put("peak_penetration", "m", "maximum penetration", joints%penetration, heading="penetration")
      call table%put("peak_penetration_onset", "s", "onset of the contact with maximum penetration", joints%penetration_onset)
      call table%put("peak_penetration_time", "s", "time of the maximum penetration", joints%penetration_time, &
                     heading="at", digits=6)
      call table%put("impulse", "N.s", "impulse of the normal forces of all contacts", joints%impulse, heading="impulse")
      call table%put("energy_lost", "J", "energy lost in all contacts; NaN if the energy balance is off", joints%energy_lost, &
                     heading="energy lost")
   end function joint_extremes

end module extremes_tables
