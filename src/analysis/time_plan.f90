!> The times of a motion and of its output, from settings such as `end = 2 turns of motor`.
module time_plan
   use columns, only: column_of
   use diagnostics, only: diagnostics_t
   use instants, only: instants_t, new_instants
   use item, only: value_t
   use kinds, only: i8, wp
   use planar_system, only: planar_system_t
   use scene, only: analysis_kinematic, analysis_static, scene_t
   use text, only: append_text, join, nearest_word, text_t
   implicit none (type, external)
   private
   public :: instant, last_instant, new_time_plan, time_plan_t

   real(wp), parameter :: intervals = 1000.0_wp  !! output intervals of a motion if the deck gives none [1]

   !> Times of a motion and of its output.
   type :: time_plan_t
      real(wp) :: end = 0.0_wp              !! end of the motion [s]
      real(wp) :: first_output = 0.0_wp     !! first output instant [s]
      real(wp) :: every = 0.0_wp            !! output interval [s]
      real(wp) :: after = 0.0_wp            !! end of the transient, for the statistics [s]
      real(wp) :: period = 0.0_wp           !! of the drive, on average in the window of the statistics; 0: none [s]
      real(wp), allocatable :: strobes(:)   !! (n) multiples of the period from `after` to `end` [s]
      type(instants_t) :: instants          !! when functions of time are not smooth
   end type time_plan_t

contains

   !> Times from the settings of a scene; all zero for an equilibrium.
   subroutine new_time_plan(scene, system, plan, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(planar_system_t), intent(in) :: system         !! its system, for the drivers
      type(time_plan_t), intent(out) :: plan              !! times
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      type(value_t) :: end
      real(wp) :: last

      allocate (plan%strobes(0), plan%instants%cells(0))
      if (scene%analysis == analysis_static) return
      end = scene%dynamic%values(column_of(scene%dynamic_kind, "end"))
      if (scene%analysis == analysis_kinematic) end = scene%kinematic%values(column_of(scene%kinematic_kind, "end"))
      associate (from => scene%output%values(column_of(scene%output_kind, "from")), &
                 stretch => scene%output%values(column_of(scene%output_kind, "last")), &
                 every => scene%output%values(column_of(scene%output_kind, "every")))
         plan%end = seconds(end, "end", -1.0_wp, system, diagnostics)
         plan%first_output = seconds(from, "from", -1.0_wp, system, diagnostics)
         last = seconds(stretch, "last", plan%end, system, diagnostics)
         plan%every = every%number
         if (diagnostics%count() > 0) return
         if (plan%end <= 0.0_wp) then
            call diagnostics%add(end%location, "the end must be after the start", "not positive", "a motion begins at t = 0")
         else if (plan%first_output < 0.0_wp) then
            call diagnostics%add(from%location, "'from' must not be negative", "before the start", "a motion begins at t = 0")
         else if (last < 0.0_wp) then
            call diagnostics%add(stretch%location, "'last' must not be negative", "a negative time")
         else if (plan%first_output > 0.0_wp .and. last > 0.0_wp) then
            call diagnostics%add(stretch%location, "'from' and 'last' exclude each other", "the second of the two")
         else if (last > plan%end) then
            call diagnostics%add(stretch%location, "'last' is longer than the motion", "longer than the motion")
         else if (plan%first_output >= plan%end) then
            call diagnostics%add(from%location, "'from' is not before the end", "after the end of the motion")
         end if
         if (last > 0.0_wp) plan%first_output = plan%end - last
         if (plan%every <= 0.0_wp) plan%every = (plan%end - plan%first_output)/intervals
         if (plan%every > (plan%end - plan%first_output)*(1.0_wp + 1.0e-9_wp) .and. diagnostics%count() == 0) then
            call diagnostics%add(every%location, "'every' is longer than what is written", "longer than the output window", &
                                 "there would be one instant and no curve")
         end if
      end associate
      if (scene%has_statistics .and. scene%analysis /= analysis_kinematic .and. diagnostics%count() == 0) then
         call plan_statistics(scene, system, plan, diagnostics)
      end if
      if (diagnostics%count() == 0) call new_instants(scene, plan%end, system%n_loose > 0, plan%instants)
   end subroutine new_time_plan

   !> The transient and the stroboscopic instants: exact multiples of the period, or of a number of turns of a driver.
   subroutine plan_statistics(scene, system, plan, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(planar_system_t), intent(in) :: system         !! its system, for the drivers
      type(time_plan_t), intent(inout) :: plan            !! times
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      type(value_t) :: turns
      integer :: k
      real(wp) :: t

      associate (after => scene%statistics%values(column_of(scene%statistics_kind, "after")), &
                 period => scene%statistics%values(column_of(scene%statistics_kind, "period")))
         plan%after = seconds(after, "after", -1.0_wp, system, diagnostics)
         turns = period
         t = 0.0_wp
         if (period%given) t = seconds(period, "period", -1.0_wp, system, diagnostics)
         if (diagnostics%count() > 0) return
         if (plan%after < 0.0_wp) then
            call diagnostics%add(after%location, "'after' must not be negative", "before the start", "a motion begins at t = 0")
         else if (plan%after >= plan%end) then
            call diagnostics%add(after%location, "'after' is not before the end", "after the end of the motion")
         else if (plan%after < plan%first_output*(1.0_wp - 1.0e-9_wp)) then
            call diagnostics%add(after%location, "'after' is before the first output instant", "nothing is sampled there", &
                                 "statistics are taken on the output instants: see 'from' and 'last' of [output]")
         else if (period%given .and. t <= 0.0_wp) then
            call diagnostics%add(period%location, "the period must be positive", "no period")
         end if
         if (diagnostics%count() > 0 .or. .not. period%given) return
         k = 0
         do
            turns%number = period%number*real(k, wp)
            t = turns%number
            if (k > 0) t = seconds(turns, "period", -1.0_wp, system, diagnostics)
            if (diagnostics%count() > 0) return
            if (t > plan%end*(1.0_wp + 1.0e-12_wp)) exit
            if (t >= plan%after*(1.0_wp - 1.0e-12_wp)) plan%strobes = [plan%strobes, min(t, plan%end)]
            k = k + 1
         end do
         associate (n => size(plan%strobes))
            if (n > 1) plan%period = (plan%strobes(n) - plan%strobes(1))/real(n - 1, wp)
            if (n > 1) return
         end associate
         call diagnostics%add(period%location, "there is less than one period between 'after' and the end", "too long")
      end associate
   end subroutine plan_statistics

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
      type(planar_system_t), intent(in) :: system         !! drivers
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found
      real(wp) :: t                                       !! the time [s]

      type(text_t), allocatable :: drivers(:)
      character(:), allocatable :: hint
      integer :: i, k

      t = value%number
      if (.not. allocated(value%text)) return
      if (value%text == "") return
      allocate (drivers(0))
      do k = 1, size(system%joints)
         associate (set => system%joints(k)%set)
            if (.not. set%is_driver) cycle
            do i = 1, set%n
               call append_text(drivers, set%names(i)%s)
               if (set%names(i)%s /= value%text) cycle
               if (t_end >= 0.0_wp) then
                  t = t_end - set%time_before(i, value%number, t_end)
                  if (t > t_end) t = -1.0_wp
               else
                  t = set%time_of_turns(i, value%number)
               end if
               if (t < 0.0_wp) then
                  call diagnostics%add(value%location, "driver '"//value%text//"' never makes so many turns", "never reached")
               end if
               return
            end do
         end associate
      end do
      t = 0.0_wp
      hint = "the deck has no drivers"
      if (size(drivers) > 0) hint = "drivers: "//join(drivers, " ")
      if (nearest_word(value%text, drivers) /= "") hint = "did you mean '"//nearest_word(value%text, drivers)//"'? "//hint
      call diagnostics%add(value%location, "unknown driver '"//value%text//"' in '"//key//"'", "no driver of this deck", hint)
   end function seconds

end module time_plan
