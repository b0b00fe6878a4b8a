!> The times of a motion and of its output, from settings such as `end = 2 turns of motor`.
module time_plan
   use diagnostics, only: diagnostics_t
   use output_times, only: output_times_t, new_output_times
   use item, only: place_of, value_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_static, scene_t
   use spelling, only: nearest_word
   use state_equations, only: sampled
   use text, only: join, to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: instant, last_instant, new_time_plan, seconds, time_plan_t

   real(wp), parameter :: intervals = 1000.0_wp  !! output intervals of a motion if the deck gives none [1]

   real(wp), parameter :: most_checkpoints = 1.0e5_wp  !! of a motion [1]

   real(wp), parameter :: most_samples = 1.0e7_wp      !! of a state equation in a motion [1]

   !> What a user can do about too many instants.
   character(*), parameter :: most_help = "each takes 8 bytes in run.h5 and up to 25 in a .dat file for every channel; " &
                              //"raise 'instants_limit' in [output] to allow them"

   !> Times of a motion and of its output.
   type :: time_plan_t
      real(wp) :: end = 0.0_wp              !! end of the motion [s]
      real(wp) :: first_output = 0.0_wp     !! first output instant [s]
      real(wp) :: every = 0.0_wp            !! output interval [s]
      real(wp) :: after = 0.0_wp            !! end of the transient, for the statistics [s]
      real(wp) :: checkpoint = 0.0_wp       !! interval of the instants at which the run is saved; 0: none is set [s]
      real(wp) :: period = 0.0_wp           !! of the drive, on average in the window of the statistics; 0: none [s]
      real(wp), allocatable :: poincare_samples(:)   !! (n) multiples of the period from `after` to `end` [s]
      type(output_times_t) :: output_times          !! when functions of time are not smooth
   end type time_plan_t

contains

   !> Times from the settings of a scene; all zero for an equilibrium.
   subroutine new_time_plan(scene, system, plan, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(time_plan_t), intent(out) :: plan              !! times
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(value_t) :: end
      real(wp) :: last

      allocate (plan%poincare_samples(0))
      if (scene%analysis == analysis_static) return
      end = scene%settings%dynamic%values(place_of(scene%settings%dynamic, "end"))
      if (scene%analysis == analysis_kinematic) end = scene%settings%kinematic%values(place_of(scene%settings%kinematic, "end"))
      associate (from => scene%settings%output%values(place_of(scene%settings%output, "from")), &
                 stretch => scene%settings%output%values(place_of(scene%settings%output, "last")), &
                 every => scene%settings%output%values(place_of(scene%settings%output, "every")), &
                 most => scene%settings%output%values(place_of(scene%settings%output, "instants_limit")))
         plan%end = seconds(end, "end", -1.0_wp, system, diagnostics)
         plan%first_output = seconds(from, "from", -1.0_wp, system, diagnostics)
         last = seconds(stretch, "last", plan%end, system, diagnostics)
         plan%every = every%number
         if (scene%analysis == analysis_dynamic) call plan_checkpoints(scene, system, plan, diagnostics)
         if (diagnostics%count() > 0) return
         if (plan%end <= 0.0_wp) then
            call diagnostics%add(end%location, "the end time must be positive", "not positive", "a motion starts at t = 0")
         else if (plan%first_output < 0.0_wp) then
            call diagnostics%add(from%location, "'from' must not be negative", "before the start", "a motion starts at t = 0")
         else if (last < 0.0_wp) then
            call diagnostics%add(stretch%location, "'last' must not be negative", "a negative time")
         else if (plan%first_output > 0.0_wp .and. last > 0.0_wp) then
            call diagnostics%add(stretch%location, "'from' and 'last' exclude each other", "the second of the two")
         else if (last > plan%end) then
            call diagnostics%add(stretch%location, "'last' is longer than the motion", "longer than the motion")
         else if (plan%first_output >= plan%end) then
            call diagnostics%add(from%location, "'from' must be before the end", "after the end of the motion")
         end if
         if (last > 0.0_wp) plan%first_output = plan%end - last
         if (plan%every <= 0.0_wp) plan%every = (plan%end - plan%first_output)/intervals
         if (plan%every > (plan%end - plan%first_output)*(1.0_wp + 1.0e-9_wp) .and. diagnostics%count() == 0) then
            call diagnostics%add(every%location, "'every' is longer than what is written", "longer than the output window", &
                                 "output would have one time point and no curve")
         end if
         if (diagnostics%count() == 0) then
            associate (span => plan%end - plan%first_output, at => merge(every%location, most%location, every%given))
               if (span >= most%number*plan%every) then
                  call diagnostics%add(at, "the run would have "//count_text(span/plan%every + 1.0_wp)// &
                                       " output times, the limit is "//count_text(most%number), "too many", most_help)
               end if
            end associate
         end if
      end associate
      if (scene%settings%statistics%is_present .and. scene%analysis /= analysis_kinematic .and. diagnostics%count() == 0) then
         call plan_statistics(scene, system, plan, diagnostics)
      end if
      if (diagnostics%count() == 0) call check_samples(scene, plan%end, diagnostics)
      if (diagnostics%count() == 0) call new_output_times(scene, plan%end, system%clearance_joints%n > 0, plan%output_times)
   end subroutine new_time_plan

   !> State equations must not be sampled too often: each sample ends a step.
   subroutine check_samples(scene, end, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      real(wp), intent(in) :: end                         !! end of the motion [s]
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      do k = 1, scene%states%n
         associate (row => scene%states%rows(k))
            if (row%sort /= sampled .or. end <= most_samples*row%every) cycle
            call diagnostics%add(row%location, "state '"//row%name//"' would have "//count_text(end/row%every)// &
                                 " samples, the limit is "//count_text(most_samples), "sampled too often", "raise 'every'")
         end associate
      end do
   end subroutine check_samples

   !> A number of instants, all its digits where a real has them.
   pure function count_text(n) result(s)
      real(wp), intent(in) :: n           !! the number, its fraction is dropped; what lacks by round-off is whole [1]
      character(:), allocatable :: s      !! its digits

      s = to_text(n)
      if (n < 1.0e15_wp) s = to_text(int(n + max(1.0e-9_wp, 2.0_wp*spacing(n)), i8))
   end function count_text

   !> How often the run is saved.
   subroutine plan_checkpoints(scene, system, plan, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(mechanism_t), intent(in) :: system             !! its system, for the drivers
      type(time_plan_t), intent(inout) :: plan            !! times
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      associate (value => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "checkpoint")))
         plan%checkpoint = seconds(value, "checkpoint", -1.0_wp, system, diagnostics)
         if (diagnostics%count() > 0) return
         if (plan%checkpoint < 0.0_wp) then
            call diagnostics%add(value%location, "'checkpoint' must not be negative", "a negative time")
         else if (plan%checkpoint > 0.0_wp .and. plan%end > most_checkpoints*plan%checkpoint) then
            call diagnostics%add(value%location, "the run would have "//count_text(plan%end/plan%checkpoint)// &
                                 " checkpoints, the limit is "//count_text(most_checkpoints), "too many")
         end if
      end associate
   end subroutine plan_checkpoints

   !> The transient and the stroboscopic instants: exact multiples of the period, or of a number of turns of a driver.
   subroutine plan_statistics(scene, system, plan, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(time_plan_t), intent(inout) :: plan            !! times
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      real(wp), allocatable :: longer(:)
      integer :: item, k, most, n, slot
      real(wp) :: t

      most = nint(scene%settings%output%number("instants_limit"))
      associate (after => scene%settings%statistics%values(place_of(scene%settings%statistics, "after")), &
                 period => scene%settings%statistics%values(place_of(scene%settings%statistics, "period")))
         plan%after = seconds(after, "after", -1.0_wp, system, diagnostics)
         slot = 0
         if (period%given) call find_driver(period, "period", system, slot, item, diagnostics)
         if (diagnostics%count() > 0) return
         if (plan%after < 0.0_wp) then
            call diagnostics%add(after%location, "'after' must not be negative", "before the start", "a motion starts at t = 0")
         else if (plan%after >= plan%end) then
            call diagnostics%add(after%location, "'after' must be before the end", "after the end of the motion")
         else if (plan%after < plan%first_output*(1.0_wp - 1.0e-9_wp)) then
            call diagnostics%add(after%location, "'after' is before the first output time", "no samples there", &
                                 "statistics use the output times: see 'from' and 'last' of [output]")
         else if (period%given .and. period%number <= 0.0_wp) then
            call diagnostics%add(period%location, "the period must be positive", "not positive")
         end if
         if (diagnostics%count() > 0 .or. .not. period%given) return
         t = period_start(period, most, system, slot, item)
         if (t >= 0.0_wp .and. t <= plan%end) then
            call diagnostics%add(period%location, "the run would have more than "//to_text(most)//" periods up to the end at "// &
                                 to_text(plan%end)//" s", "too many", most_help)
            return
         end if
         n = 0
         deallocate (plan%poincare_samples)
         allocate (plan%poincare_samples(64), source=0.0_wp)
         do k = 0, most
            t = period_start(period, k, system, slot, item)
            if (t < 0.0_wp .and. k < 2) call report_turns(period, diagnostics)
            if (t < 0.0_wp .and. k < 2) return
            if (t < 0.0_wp .or. t > plan%end*(1.0_wp + 1.0e-12_wp)) exit  ! a driver that turns back never makes more
            if (t >= plan%after*(1.0_wp - 1.0e-12_wp)) then
               if (n == size(plan%poincare_samples)) then
                  allocate (longer(2*n), source=0.0_wp)
                  longer(:n) = plan%poincare_samples
                  call move_alloc(longer, plan%poincare_samples)
               end if
               n = n + 1
               plan%poincare_samples(n) = min(t, plan%end)
            end if
         end do
         plan%poincare_samples = plan%poincare_samples(:n)
         if (n > 1) then
            plan%period = (plan%poincare_samples(n) - plan%poincare_samples(1))/real(n - 1, wp)
            return
         end if
         call diagnostics%add(period%location, "less than one period remains between 'after' and the end", "too long")
      end associate
   end subroutine plan_statistics

   !> Time at which a period starts, negative: the driver never makes so many turns.
   function period_start(period, k, system, slot, item) result(t)
      type(value_t), intent(in) :: period           !! the setting
      integer, intent(in) :: k                      !! number of the period, from 0
      type(mechanism_t), intent(in) :: system   !! drivers
      integer, intent(in) :: slot                   !! the driver's set, 0: a period is a time
      integer, intent(in) :: item                   !! its number there
      real(wp) :: t                                 !! the time [s]

      t = period%number*real(k, wp)
      if (slot > 0 .and. k > 0) t = system%linkage%joints(slot)%set%time_of_turns(item, t)
   end function period_start

   !> Output instant number k, from 0; the last of a grid that fits the motion is its end.
   pure real(wp) function instant(plan, k) result(t)
      type(time_plan_t), intent(in) :: plan  !! times
      integer(i8), intent(in) :: k           !! its number

      t = plan%first_output + real(k, wp)*plan%every
      if (abs(t - plan%end) < 1.0e-9_wp*plan%every) t = plan%end
   end function instant

   !> Number of the last output instant.
   pure integer(i8) function last_instant(plan) result(k)
      type(time_plan_t), intent(in) :: plan  !! times

      k = floor((plan%end - plan%first_output)/plan%every*(1.0_wp + 1.0e-12_wp) + 1.0e-9_wp, i8)
   end function last_instant

   !> Seconds of a duration: turns since the start, or those that end at t_end.
   function seconds(value, key, t_end, system, diagnostics) result(t)
      type(value_t), intent(in) :: value                  !! the setting
      character(*), intent(in) :: key                     !! its key
      real(wp), intent(in) :: t_end                       !! end of the turns, negative: turns since the start [s]
      type(mechanism_t), intent(in) :: system         !! drivers
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found
      real(wp) :: t                                       !! the time [s]

      integer :: before, item, slot

      before = diagnostics%count()
      call find_driver(value, key, system, slot, item, diagnostics)
      t = merge(value%number, 0.0_wp, diagnostics%count() == before)
      if (slot == 0) return
      associate (set => system%linkage%joints(slot)%set)
         if (t_end >= 0.0_wp) then
            t = t_end - set%time_before(item, value%number, t_end)
            if (t > t_end) t = -1.0_wp
         else
            t = set%time_of_turns(item, value%number)
         end if
      end associate
      if (t < 0.0_wp) call report_turns(value, diagnostics)
   end function seconds

   !> A driver turns less than is asked for.
   subroutine report_turns(value, diagnostics)
      type(value_t), intent(in) :: value                  !! the setting
      type(diagnostics_t), intent(inout) :: diagnostics   !! receives the error

      call diagnostics%add(value%location, "driver '"//value%text//"' never completes so many turns", "never reached")
   end subroutine report_turns

   !> The driver whose turns a duration counts.
   subroutine find_driver(value, key, system, slot, item, diagnostics)
      type(value_t), intent(in) :: value                  !! the setting
      character(*), intent(in) :: key                     !! its key
      type(mechanism_t), intent(in) :: system         !! drivers
      integer, intent(out) :: slot                        !! the driver's set, 0: a time, or an error
      integer, intent(out) :: item                        !! its number there
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      type(text_list_t) :: drivers
      character(:), allocatable :: hint
      integer :: i, k

      slot = 0
      item = 0
      if (.not. allocated(value%text)) return
      if (value%text == "") return
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            if (.not. set%is_driver) cycle
            do i = 1, set%n
               call drivers%add(set%names(i)%s)
               if (set%names(i)%s /= value%text) cycle
               slot = k
               item = i
               return
            end do
         end associate
      end do
      hint = "the deck has no drivers"
      if (drivers%n > 0) hint = "drivers: "//join(drivers%get(), " ")
      if (nearest_word(value%text, drivers%get()) /= "") hint = "did you mean '"//nearest_word(value%text, drivers%get())//"'? " &
                                                              //hint
      call diagnostics%add(value%location, "unknown driver '"//value%text//"' in '"//key//"'", "no driver of this deck", hint)
   end subroutine find_driver

end module time_plan
