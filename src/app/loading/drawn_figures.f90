!> Figures that draw the mechanism: the instants that they need, against the times of the run.
!>
!> `mechanism` is at its instants, else at the end. `strip` and `animation` are over the window `last`, else over the last turn of
!> the first driver that makes one, else over all that is written. Of turns of a driver that turns evenly the first and the last
!> position are one: a strip omits the last, of an animation the page has it and the GIF, which repeats, has not. `coupler` follows
!> a point over its window, else over all that is written, with the mechanism at the end of it.
module drawn_figures
   use diagnostics, only: diagnostics_t
   use figure_words, only: draws_mechanism, figure_animation, figure_coupler, figure_mechanism, figure_strip, figure_t
   use frames, only: frame_plan_t, wanted_frames_t
   use item, only: location_of, location_t, place_of, value_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene, only: analysis_static, scene_t
   use scene_drawing, only: own_point
   use spelling, only: nearest_word
   use text, only: join, to_text
   use time_plan, only: instant, last_instant, seconds, time_plan_t
   implicit none (type, external)
   private
   public :: check_drawn_figures, plan_drawn_figures

   integer, parameter :: n_strip = 8           !! positions of a strip, usually
   integer, parameter :: n_animation = 60      !! pictures of an animation, usually
   integer, parameter :: most_places = 2000000 !! bodies times pictures of a figure

contains

   !> Look for figures of the mechanism that there cannot be.
   subroutine check_drawn_figures(figures, scene, system, times, mistakes)
      type(figure_t), intent(in) :: figures(:)        !! (n) figures of the deck
      type(scene_t), intent(in) :: scene              !! the scene
      type(mechanism_t), intent(in) :: system         !! its system, for the drivers
      type(time_plan_t), intent(in) :: times          !! of the run
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(wanted_frames_t) :: wanted
      integer :: k

      if (scene%analysis == analysis_static) return
      associate (value => scene%settings%output%values(place_of(scene%settings%output, "figures")))
         do k = 1, size(figures)
            if (draws_mechanism(figures(k))) call want(figures(k), scene, system, times, location_of(value, k), wanted, mistakes)
         end do
      end associate
   end subroutine check_drawn_figures

   !> What the figures of a run need; there are no errors in them.
   subroutine plan_drawn_figures(figures, scene, system, times, plan)
      type(figure_t), intent(in) :: figures(:)    !! (n) figures of the run
      type(scene_t), intent(in) :: scene          !! the scene
      type(mechanism_t), intent(in) :: system     !! its system, for the drivers
      type(time_plan_t), intent(in) :: times      !! of the run
      type(frame_plan_t), intent(out) :: plan     !! what they need

      type(diagnostics_t) :: mistakes
      integer :: k, n

      plan%every = times%every
      plan%first = times%first_output
      plan%end = times%end
      allocate (plan%wanted(count([(draws_mechanism(figures(k)), k=1, size(figures))])))
      n = 0
      do k = 1, size(figures)
         if (.not. draws_mechanism(figures(k))) cycle
         n = n + 1
         call want(figures(k), scene, system, times, location_t(), plan%wanted(n), mistakes)
      end do
   end subroutine plan_drawn_figures

   !> What one figure needs.
   subroutine want(figure, scene, system, times, location, wanted, mistakes)
      type(figure_t), intent(in) :: figure              !! the figure
      type(scene_t), intent(in) :: scene                !! the scene
      type(mechanism_t), intent(in) :: system           !! its system, for the drivers
      type(time_plan_t), intent(in) :: times            !! of the run
      type(location_t), intent(in) :: location          !! where its word stands
      type(wanted_frames_t), intent(out) :: wanted      !! instants, window and point
      type(diagnostics_t), intent(inout) :: mistakes    !! errors found

      integer :: k, n
      logical :: closes, is_even
      real(wp) :: from

      wanted%name = figure%name
      wanted%has_end = figure%kind /= figure_mechanism .or. size(figure%motion%times) == 0
      call find_window(figure, system, times, location, from, closes, is_even, mistakes)
      if (from < times%first_output*(1.0_wp - 1.0e-9_wp) .and. mistakes%count() == 0) then
         call mistakes%add(location, "the window of '"//figure%word//"' starts before the first output time", &
                           "no output is written there", "see 'from' and 'last' of [output]")
      end if
      n = figure%motion%n
      select case (figure%kind)
      case (figure_mechanism)
         wanted%times = figure%motion%times
         if (size(wanted%times) == 0) wanted%times = [times%end]
         if (maxval(wanted%times) > times%end*(1.0_wp + 1.0e-9_wp) .or. &
             minval(wanted%times) < times%first_output*(1.0_wp - 1.0e-9_wp)) then
            call mistakes%add(location, "a time of '"//figure%word//"' is not an output time", "from "// &
                              to_text(times%first_output)//" s to "//to_text(times%end)//" s")
         end if
      case (figure_strip, figure_animation)
         if (n == 0) n = merge(n_strip, n_animation, figure%kind == figure_strip)
         if (n > 1 .or. is_even) wanted%gap = (times%end - from)/real(merge(n, n - 1, is_even), wp)
         wanted%repeats = is_even .and. figure%kind == figure_animation
         wanted%times = [(from + k*wanted%gap, k=0, merge(n, n - 1, wanted%repeats))]
         if (figure%kind == figure_animation) wanted%to = times%end*(1.0_wp + 1.0e-9_wp)
      case (figure_coupler)
         wanted%times = [times%end]
         wanted%to = times%end*(1.0_wp + 1.0e-9_wp)
         call find_point(figure%motion%point, scene, location, wanted, mistakes)
      end select
      wanted%from = from
      if (closes .or. figure%motion%last > 0.0_wp) wanted%length = times%end - from
      wanted%times = min(wanted%times, instant(times, last_instant(times)))
      if (size(wanted%times)*(scene%bodies%n + 1) > most_places) then
         call mistakes%add(location, to_text(size(wanted%times))//" pictures of "//to_text(scene%bodies%n)// &
                           " bodies exceed the limit for '"//figure%word//"'", "too many", "use fewer pictures: n=2, or one time")
      end if
   end subroutine want

   !> Where the window of a figure starts; all windows end with the run.
   subroutine find_window(figure, system, times, location, from, closes, is_even, mistakes)
      type(figure_t), intent(in) :: figure              !! the figure
      type(mechanism_t), intent(in) :: system           !! drivers
      type(time_plan_t), intent(in) :: times            !! of the run
      type(location_t), intent(in) :: location          !! where its word stands
      real(wp), intent(out) :: from                     !! its start [s]
      logical, intent(out) :: closes                    !! it is one of turns
      logical, intent(out) :: is_even                   !! of a driver that turns evenly
      type(diagnostics_t), intent(inout) :: mistakes    !! errors found

      type(diagnostics_t) :: ignored
      type(value_t) :: value
      integer :: k
      real(wp) :: last

      from = times%first_output
      closes = .false.
      is_even = .false.
      value%location = location
      if (figure%motion%last > 0.0_wp) then
         value%number = figure%motion%last
         value%text = figure%motion%driver
         last = seconds(value, figure%word, times%end, system, mistakes)
         from = times%end - last
         closes = figure%motion%driver /= ""
         is_even = closes .and. turns_evenly(value, last)
         return
      end if
      if (figure%kind /= figure_strip .and. figure%kind /= figure_animation) return
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            if (.not. set%is_driver .or. set%n == 0) cycle
            value%number = 1.0_wp
            value%text = set%names(1)%s
            last = seconds(value, figure%word, times%end, system, ignored)
            closes = ignored%count() == 0 .and. last > 0.0_wp .and. times%end - last >= times%first_output*(1.0_wp - 1.0e-9_wp)
            if (.not. closes) return
            from = times%end - last
            is_even = turns_evenly(value, last)
            return
         end associate
      end do

   contains

      !> Whether half of the turns before the end take half of their time.
      logical function turns_evenly(turns, duration)
         type(value_t), intent(in) :: turns        !! turns of a driver
         real(wp), intent(in) :: duration          !! time that they take [s]

         real(wp), parameter :: even = 1.0e-3_wp   ! difference of the times, of their sum [1]
         type(value_t) :: half

         half = turns
         half%number = 0.5_wp*turns%number
         turns_evenly = abs(2.0_wp*seconds(half, figure%word, times%end, system, ignored) - duration) <= even*duration
      end function turns_evenly
   end subroutine find_window

   !> The point whose path is followed.
   subroutine find_point(name, scene, location, wanted, mistakes)
      character(*), intent(in) :: name                  !! of the point
      type(scene_t), intent(in) :: scene                !! the scene
      type(location_t), intent(in) :: location          !! where the word stands
      type(wanted_frames_t), intent(inout) :: wanted    !! body and place are set
      type(diagnostics_t), intent(inout) :: mistakes    !! errors found

      character(:), allocatable :: hint
      integer :: k

      do k = 1, scene%points%n
         if (scene%points%names(k)%s /= name) cycle
         wanted%body = scene%points%body(k)
         wanted%s = own_point(scene, k)
         return
      end do
      hint = nearest_word(name, scene%points%names)
      if (len(hint) > 0) hint = "did you mean '"//hint//"'? "
      call mistakes%add(location, "unknown point '"//name//"' in coupler("//name//")", "not a point of this deck", &
                        hint//"points: "//join(scene%points%names, " "))
   end subroutine find_point

end module drawn_figures
