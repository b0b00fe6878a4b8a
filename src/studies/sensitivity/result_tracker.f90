!> Results of a motion and their derivatives, as steps and events bring them about.
!>
!> Of an extreme at a smooth place the derivative is that at this place (envelope theorem); of one at an event, that along with the
!> event. Between, a channel is looked at in some places of each step; its slopes at both ends say whether an extreme lies between
!> an end and the place next to it.
module result_tracker
   use catalogue, only: catalogue_t
   use contact_peaks, only: trend_t
   use extreme_place, only: find_flat_place, find_turn
   use integrator, only: integrator_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use mechanism, only: mechanism_t
   use mechanism_report, only: report_state
   use observed, only: observed_t
   use sensitivity_column, only: column_t
   use sensitivity_results, only: asked_t, found_t, is_extreme, result_duration, result_impact_speed, result_minimum, &
      result_onset, result_peak_force, result_peak_penetration, result_release_speed, result_value
   use step_map, only: step_map_t
   implicit none (type, external)
   private
   public :: tracker_t

   integer, parameter :: n_place = 8   !! parts of a step in which extremes are sought
   real(wp), parameter :: places(0:n_place) = [0.0_wp, 0.05_wp, 0.1_wp, 0.3_wp, 0.5_wp, 0.7_wp, 0.9_wp, 0.95_wp, 1.0_wp]  !! [1]

   !> A result that is looked for.
   type :: tracker_t
      type(asked_t) :: asked                  !! what is asked for
      integer :: number = 0                   !! of the result
      type(observed_t) :: what                !! which number it is of
      integer :: seen = 0                     !! onsets of its joint so far
      integer :: open = 0                     !! contact whose onset was the one asked for, until it ends; 0: none
      real(wp) :: onset = 0.0_wp              !! time of this onset [s]
      real(wp), allocatable :: theta(:)       !! (parameters) its derivative [any]
      real(wp) :: before(0:n_place) = 0.0_wp  !! (0:n_place) of a channel: its values in the last step [any]
   contains
      procedure :: at_start
      procedure :: in_step
      procedure :: at_end
      procedure :: at_touch
   end type tracker_t

contains

   !> Channels at the start of the motion and behind events.
   subroutine at_start(self, system, method, catalogue, columns, found)
      class(tracker_t), intent(inout) :: self            !! the result
      type(mechanism_t), intent(inout) :: system         !! the system
      class(integrator_t), intent(in) :: method          !! the method, (re)started
      type(catalogue_t), intent(inout) :: catalogue      !! of its channels
      type(column_t), intent(inout) :: columns(:)        !! (parameters) derivatives there
      type(found_t), intent(inout) :: found              !! results; those that are found are set

      real(wp) :: ydot(system%n)
      type(trend_t) :: x
      integer :: status

      if (self%what%place == 0) return
      call self%what%at(system, catalogue, method%t, method%step%y1, ydot, x, status)
      if (status /= 0) return
      self%before(n_place) = x%value
      if (self%asked%kind == result_value) then
         if (method%t > 0.0_wp .or. self%asked%t > 0.0_wp) return
         call take_difference(self, x%value, method, columns, found)
      else if (is_beyond(self, x%value, found)) then
         call take_difference(self, x%value, method, columns, found)
      end if
   end subroutine at_start

   !> Whether a value is a new extreme.
   logical function is_beyond(self, x, found)
      class(tracker_t), intent(in) :: self    !! the result
      real(wp), intent(in) :: x               !! the value [any]
      type(found_t), intent(in) :: found      !! the extreme so far

      is_beyond = is_extreme(self%asked%kind) .and. ieee_is_finite(x)
      if (.not. is_beyond .or. .not. found%is_found(self%number)) return
      is_beyond = x > found%value(self%number)
      if (self%asked%kind == result_minimum) is_beyond = x < found%value(self%number)
   end function is_beyond

   !> A value at the present state, and its derivatives there.
   subroutine take_difference(self, x, method, columns, found)
      class(tracker_t), intent(in) :: self               !! the result
      real(wp), intent(in) :: x                          !! its value [any]
      class(integrator_t), intent(in) :: method          !! the method
      type(column_t), intent(inout) :: columns(:)        !! (parameters) derivatives there
      type(found_t), intent(inout) :: found              !! results

      integer :: k, status
      real(wp) :: d

      call take(self, method%t, x, found)
      do k = 1, size(columns)
         if (.not. columns(k)%is_active) cycle
         call columns(k)%differ(method%t, method%step%y1, self%what, d, status)
         if (status == 0) found%derivative(k, self%number) = d
      end do
   end subroutine take_difference

   !> A result is found; its derivatives are not yet.
   subroutine take(self, t, x, found)
      class(tracker_t), intent(in) :: self       !! the result
      real(wp), intent(in) :: t                  !! when [s]
      real(wp), intent(in) :: x                  !! its value [any]
      type(found_t), intent(inout) :: found      !! results

      found%is_found(self%number) = .true.
      found%t(self%number) = t
      found%value(self%number) = x
      found%derivative(:, self%number) = not_a_number()
   end subroutine take

   !> What lies within the last step, whose events are not handled: the derivatives are those of its start.
   subroutine in_step(self, map, system, method, catalogue, columns, behind, found)
      class(tracker_t), intent(inout) :: self            !! the result
      type(step_map_t), intent(inout) :: map             !! the map of the step
      type(mechanism_t), intent(inout) :: system         !! the system
      class(integrator_t), intent(inout) :: method       !! the method after the step
      type(catalogue_t), intent(inout) :: catalogue      !! of its channels
      type(column_t), intent(inout) :: columns(:)        !! (parameters) derivatives at the start of the step
      real(wp), intent(in) :: behind                     !! time after an onset at which a force that jumps is seen; 0: none [s]
      type(found_t), intent(inout) :: found              !! results

      real(wp) :: place, x, y(system%n), ydot(system%n)
      integer :: k, status

      if (self%what%place > 0 .and. self%asked%kind /= result_value) then
         self%before(0) = self%before(n_place)
         do k = 1, n_place
            call method%state_at(system, merge(method%t, method%step%t0 + method%step%h*places(k), k == n_place), y)
            call report_state(system, method%step%t0 + method%step%h*places(k), y, ydot, 0.0_wp, catalogue, status)
            self%before(k) = catalogue%values(self%what%place)
         end do
         do k = 0, n_place
            if (.not. is_top(self, k)) cycle
            place = places(k)
            call find_flat_place(system, method, catalogue, self%what, place, x, y, ydot, status)
            if (status /= 0 .or. .not. is_beyond(self, x, found)) cycle
            call take(self, method%step%t0 + place*method%step%h, x, found)
            call probe_all(self, map, method, columns, behind, found, length=place*method%step%h)
         end do
      else if (self%asked%kind == result_value) then
         if (abs(method%t - self%asked%t) > 0.0_wp) return
         call report_state(system, method%t, method%step%y1, ydot, 0.0_wp, catalogue, status)
         call take(self, method%t, catalogue%values(self%what%place), found)
         call probe_all(self, map, method, columns, behind, found, time=method%t)
      else if (self%open > 0 .and. any(self%asked%kind == [result_peak_force, result_peak_penetration])) then
         call look_for_peak()
      end if

   contains

      !> A maximum of force or penetration that the step has raised.
      subroutine look_for_peak()
         real(wp) :: peak, when

         associate (contact => system%clearance_joints%sets(self%what%slot)%set%contact(self%what%item))
            peak = merge(contact%peak_force, contact%peak_penetration, self%what%is_force)
            when = merge(contact%went%force_at, contact%went%penetration_at, self%what%is_force)
         end associate
         if (found%is_found(self%number)) then
            if (.not. peak > found%value(self%number)) return
         end if
         place = (when - method%step%t0)/method%step%h
         if (place > 0.0_wp .and. place < 1.0_wp) then
            call find_turn(system, method, catalogue, self%what, place, x, y, ydot, status)
            if (status == 0) peak = max(peak, x)
         end if
         call take(self, method%step%t0 + place*method%step%h, peak, found)
         call probe_all(self, map, method, columns, behind, found, length=max(place*method%step%h, behind))
      end subroutine look_for_peak

   end subroutine in_step

   !> Whether the values of a channel have an extreme of the kind that is asked for at a place of the step; at the first and the
   !> last place, between it and its neighbour.
   pure logical function is_top(self, k)
      class(tracker_t), intent(in) :: self    !! the result, values in the step known
      integer, intent(in) :: k                !! number of the place

      real(wp) :: sign

      sign = merge(-1.0_wp, 1.0_wp, self%asked%kind == result_minimum)
      associate (x => self%before)
         is_top = all(ieee_is_finite(x(max(k - 2, 0):min(k + 2, n_place))))
         if (.not. is_top) return
         if (k == 0) then
            is_top = sign*(x(1) - x(0)) <= 0.0_wp .and. sign*(4.0_wp*x(1) - 3.0_wp*x(0) - x(2)) > 0.0_wp
         else if (k == n_place) then
            is_top = sign*(x(k - 1) - x(k)) <= 0.0_wp .and. sign*(4.0_wp*x(k - 1) - 3.0_wp*x(k) - x(k - 2)) > 0.0_wp
         else
            is_top = sign*(x(k) - x(k - 1)) >= 0.0_wp .and. sign*(x(k) - x(k + 1)) >= 0.0_wp
            if (is_top) is_top = abs(x(k + 1) - x(k - 1)) > 0.0_wp .or. abs(x(k) - x(k - 1)) > 0.0_wp
         end if
      end associate
   end function is_top

   !> Derivatives of a result within the step.
   subroutine probe_all(self, map, method, columns, behind, found, length, time)
      class(tracker_t), intent(in) :: self               !! the result
      type(step_map_t), intent(inout) :: map             !! the map of the step
      class(integrator_t), intent(in) :: method          !! the method after the step
      type(column_t), intent(inout) :: columns(:)        !! (parameters) derivatives at its start
      real(wp), intent(in) :: behind                     !! as in `in_step` [s]
      type(found_t), intent(inout) :: found              !! results
      real(wp), intent(in), optional :: length           !! after the start of the step [s]
      real(wp), intent(in), optional :: time             !! or when [s]

      real(wp) :: d
      integer :: k, status

      do k = 1, size(columns)
         if (.not. columns(k)%is_active) cycle
         call columns(k)%probe(map, method, self%what, behind, d, status, length, time)
         if (status == 0) found%derivative(k, self%number) = d
      end do
   end subroutine probe_all

   !> A channel at the end of a step, the derivatives being there.
   subroutine at_end(self, method, columns, found)
      class(tracker_t), intent(inout) :: self            !! the result
      class(integrator_t), intent(in) :: method          !! the method after the step
      type(column_t), intent(inout) :: columns(:)        !! (parameters) derivatives at its end
      type(found_t), intent(inout) :: found              !! results

      if (self%what%place == 0 .or. self%asked%kind == result_value) return
      if (is_beyond(self, self%before(n_place), found)) then
         call take_difference(self, self%before(n_place), method, columns, found)
      end if
   end subroutine at_end

   !> A contact starts or ends, the derivatives being there.
   subroutine at_touch(self, contact, slot, item, is_onset, t, rate, columns, found)
      class(tracker_t), intent(inout) :: self            !! the result
      integer, intent(in) :: contact                     !! its number
      integer, intent(in) :: slot                        !! its set
      integer, intent(in) :: item                        !! contact of the set
      logical, intent(in) :: is_onset                    !! it starts
      real(wp), intent(in) :: t                          !! when [s]
      real(wp), intent(in) :: rate                       !! penetration rate [m/s]
      type(column_t), intent(in) :: columns(:)           !! (parameters) derivatives
      type(found_t), intent(inout) :: found              !! results

      if (self%asked%first == 0 .or. contact < self%asked%first .or. contact > self%asked%last) return
      if (is_onset) then
         self%seen = self%seen + 1
         if (self%seen /= self%asked%ordinal) return
         self%open = contact
         self%onset = t
         self%theta = columns%theta
         self%what%slot = slot
         self%what%item = item
         if (self%asked%kind == result_onset) call set(t, columns%theta)
         if (self%asked%kind == result_impact_speed) call set(rate, rates())
      else if (self%open == contact) then
         self%open = 0
         if (self%asked%kind == result_duration) call set(t - self%onset, columns%theta - self%theta)
         if (self%asked%kind == result_release_speed) call set(-rate, -rates())
      end if

   contains

      !> The derivatives of the penetration rate.
      function rates() result(d)
         real(wp) :: d(size(columns))
         integer :: k

         d = [(columns(k)%rate(contact), k=1, size(columns))]
      end function rates

      !> The result is found.
      subroutine set(x, d)
         real(wp), intent(in) :: x       !! its value [any]
         real(wp), intent(in) :: d(:)    !! (parameters) its derivatives [any]

         integer :: k

         call take(self, t, x, found)
         do k = 1, size(columns)
            if (columns(k)%is_active) found%derivative(k, self%number) = d(k)
         end do
      end subroutine set

   end subroutine at_touch

end module result_tracker
