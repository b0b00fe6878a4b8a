!> The residuals of a fit: sensors of all sets of data, in standard deviations of their noise.
!>
!> A sensor with offset b and delay d shows x(t - d) + b of its channel x, so that
!>
!> $$ r = \frac{x(t - d; p) + b - m}{\sigma}, \quad
!>    \frac{\partial r}{\partial p} = \frac{1}{\sigma}\frac{\partial x}{\partial p}, \quad
!>    \frac{\partial r}{\partial b} = \frac{1}{\sigma}, \quad \frac{\partial r}{\partial d} = -\frac{\dot x}{\sigma} . $$
!>
!> One motion of each set gives all of it. Data of a set are left out from the first time on at which a derivative ends, or at which
!> the motion at ten times the tolerance gives another value: that is the horizon of the motion.
module fit_model
   use channel_samples, only: channel_samples_t
   use errors, only: error_t
   use fit_layout, only: is_delay, is_offset, is_parameter, place_t, value_of, width_of
   use fit_plan, only: fit_plan_t
   use fit_source, only: fit_source_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use jobs, only: first_line, job_t
   use kinds, only: not_a_number, wp
   use least_squares, only: residuals_t
   use sensitivity_motion, only: find_motion
   use sensitivity_results, only: found_t, sensitivity_plan_t
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: fit_model_t, measured_t

   real(wp), parameter :: coarser = 10.0_wp         !! tolerance of the second motion, of the first [1]
   real(wp), parameter :: finer = 0.5_wp            !! tolerance of a motion whose derivatives end, of the one before [1]
   integer, parameter :: most_attempts = 3          !! such motions, each with other steps: a kink may be next to their ends
   character(*), parameter :: beyond = "the motion is beyond its horizon"
   real(wp), parameter :: of_sigma = 0.1_wp         !! difference of both at the horizon, of the noise [1]
   real(wp), parameter :: of_spread = 1.0e-5_wp     !! the same, of the spread of the data [1]
   real(wp), parameter :: part = 1.0e-3_wp          !! first changes of parameters, of what they are measured by [1]
   real(wp), parameter :: of_width = 0.01_wp        !! that is at least this part of the distance of the bounds [1]

   !> A set of data.
   type :: measured_t
      character(:), allocatable :: name            !! of the set
      character(:), allocatable :: path            !! of its file
      real(wp), allocatable :: t(:)                !! (rows) times of the motion [s]
      real(wp), allocatable :: x(:, :)             !! (sensors, rows) what the sensors show, SI; NaN: nothing [any]
      real(wp), allocatable :: model(:, :)         !! (sensors, rows) what they should show [any]
      real(wp) :: until = huge(1.0_wp)             !! data from here on are left out; huge: none [s]
      character(:), allocatable :: reason          !! why
   end type measured_t

   !> The model.
   type, extends(residuals_t) :: fit_model_t
      type(fit_plan_t) :: plan                             !! what is asked
      type(place_t), allocatable :: places(:)              !! (n) the unknowns
      class(fit_source_t), pointer :: source => null()     !! where scenes come from
      type(measured_t), allocatable :: sets(:)             !! (sets) the data
      integer, allocatable :: channels(:, :)               !! (3, sensors) group, component and item
      real(wp), allocatable :: sigma(:)                    !! (sensors) standard deviations, SI [any]
      real(wp), allocatable :: spread(:)                   !! (sensors) of the data [any]
      real(wp) :: stage = huge(1.0_wp)                     !! data from here on do not count [s]
      character(:), allocatable :: message                 !! why the last motion failed
      integer :: n_motion = 0                              !! motions so far
   contains
      procedure :: evaluate => model_evaluate
      procedure :: derive => model_derive
      procedure :: counts
      procedure, private :: move
      procedure, private :: add_residuals
   end type fit_model_t

contains

   !> Whether a number of a set counts.
   pure logical function counts(self, set, sensor, row)
      class(fit_model_t), intent(in) :: self     !! the model
      integer, intent(in) :: set                 !! number of the set
      integer, intent(in) :: sensor              !! number of the sensor
      integer, intent(in) :: row                 !! of the set

      associate (data => self%sets(set))
         counts = data%t(row) < min(data%until, self%stage) .and. ieee_is_finite(data%x(sensor, row))
      end associate
   end function counts

   !> The residuals.
   subroutine model_evaluate(self, u, r, is_good)
      class(fit_model_t), intent(inout) :: self     !! the model
      real(wp), intent(in) :: u(:)                  !! (n) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)    !! (m) residuals [1]
      logical, intent(out) :: is_good               !! .false.: a motion fails

      type(channel_samples_t) :: samples
      real(wp), allocatable :: jac(:, :)
      integer :: k

      allocate (r(0), jac(0, size(u)))
      do k = 1, size(self%sets)
         call self%move(u, k, .false., self%plan%tolerance, samples, is_good)
         if (is_good) call self%add_residuals(u, k, samples, .false., r, jac)
         is_good = is_good .and. all(ieee_is_finite(r))
         if (.not. is_good) return
      end do
   end subroutine model_evaluate

   !> The residuals and their derivatives.
   subroutine model_derive(self, u, r, jac, is_good)
      class(fit_model_t), intent(inout) :: self           !! the model
      real(wp), intent(in) :: u(:)                        !! (n) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)          !! (m) residuals [1]
      real(wp), allocatable, intent(out) :: jac(:, :)     !! (m, n) their derivatives [1]
      logical, intent(out) :: is_good                     !! .false.: a motion fails

      type(channel_samples_t) :: other, samples
      type(found_t) :: found
      character(:), allocatable :: reason
      real(wp) :: until
      integer :: attempt, k

      allocate (r(0), jac(0, size(u)))
      do k = 1, size(self%sets)
         call self%move(u, k, .false., coarser*self%plan%tolerance, other, is_good)
         do attempt = 0, most_attempts
            call self%move(u, k, .true., self%plan%tolerance*finer**attempt, samples, is_good, found)
            if (.not. is_good) return
            call find_end(self, samples, other, found, until, reason)
            if (until >= huge(1.0_wp) .or. reason == beyond) exit
         end do
         if (until < self%sets(k)%until) then
            self%sets(k)%until = until
            self%sets(k)%reason = reason
         end if
         call self%add_residuals(u, k, samples, .true., r, jac)
      end do
      is_good = size(r) > 0 .and. all(ieee_is_finite(r)) .and. all(ieee_is_finite(jac))
      if (.not. is_good) self%message = "no data are within the horizon of the motion"
   end subroutine model_derive

   !> The motion of a set: its channels at the times of the data.
   subroutine move(self, u, set, is_derived, tolerance, samples, is_good, details)
      class(fit_model_t), intent(inout) :: self           !! the model
      real(wp), intent(in) :: u(:)                        !! (n) unknowns [1]
      integer, intent(in) :: set                          !! number of the set
      logical, intent(in) :: is_derived                   !! derivatives are wanted
      real(wp), intent(in) :: tolerance                   !! of the motion [1]
      type(channel_samples_t), intent(out) :: samples     !! what it gives
      logical, intent(out) :: is_good                     !! .false.: it fails before any data
      type(found_t), intent(out), optional :: details     !! why derivatives end

      type(error_t), allocatable :: error
      type(found_t) :: found
      type(job_t) :: job
      type(sensitivity_plan_t) :: plan
      real(wp), allocatable :: times(:)
      integer :: k, n

      associate (source => self%source, unknowns => self%plan%unknowns)
         n = size(unknowns)
         source%set = set
         if (.not. allocated(source%values)) allocate (source%values(n), source=0.0_wp)
         do k = 1, size(self%places)
            associate (place => self%places(k))
               if (place%kind /= is_parameter .or. all(place%set /= [0, set])) cycle
               source%values(place%number) = value_of(place, u(k))
            end associate
         end do
         allocate (plan%results(0))
         plan%values = source%values
         if (.not. is_derived) plan%values = plan%values(:0)
         allocate (plan%parameters(size(plan%values)), plan%units(size(plan%values)))
         plan%spans = [(max(abs(plan%values(k)), of_width*(unknowns(k)%upper - unknowns(k)%lower)), k=1, size(plan%values))]
         call source%make(0, 0.0_wp, job, self%message)
         is_good = self%message == ""
         if (.not. is_good) return
      end associate
      call list_times(self, u, set, times)
      samples%channels = self%channels
      samples%has_rates = is_derived .and. any(self%places%kind == is_delay)
      call samples%begin(times, size(plan%values))
      plan%tolerance = tolerance
      plan%end = max(times(size(times)), tiny(1.0_wp))
      self%n_motion = self%n_motion + 1
      call find_motion(job, self%source, plan, tolerance, part, found, error, samples)
      if (allocated(error)) self%message = first_line(error%message)
      is_good = ieee_is_finite(samples%values(1, 1))
      if (present(details)) details = found
   end subroutine move

   !> Times at which the channels of a set are wanted, ascending: those of its data less the delays of the sensors.
   subroutine list_times(self, u, set, times)
      class(fit_model_t), intent(in) :: self              !! the model
      real(wp), intent(in) :: u(:)                        !! (n) unknowns [1]
      integer, intent(in) :: set                          !! number of the set
      real(wp), allocatable, intent(out) :: times(:)      !! (times) they [s]

      real(wp), allocatable :: more(:)
      real(wp) :: delay, last
      integer :: i, j, s

      allocate (times(0))
      last = -1.0_wp
      do s = 1, size(self%sigma)
         delay = of_sensor(self, u, is_delay, s)
         if (s > 1 .and. .not. abs(delay - last) > 0.0_wp) cycle
         last = delay
         more = pack(self%sets(set)%t, self%sets(set)%t < min(self%stage, self%sets(set)%until)) - delay
         more = pack(more, more >= 0.0_wp)
         i = 1
         if (size(times) == 0) then
            times = more
            cycle
         end if
         do j = 1, size(more)      ! merge two ascending lists
            do while (i <= size(times))
               if (times(i) >= more(j)) exit
               i = i + 1
            end do
            if (i <= size(times)) then
               if (.not. abs(times(i) - more(j)) > 0.0_wp) cycle
            end if
            times = [times(:i - 1), more(j), times(i:)]
         end do
      end do
      if (size(times) == 0) times = [0.0_wp]
   end subroutine list_times

   !> Offset or delay of a sensor.
   pure real(wp) function of_sensor(self, u, kind, sensor) result(x)
      class(fit_model_t), intent(in) :: self     !! the model
      real(wp), intent(in) :: u(:)               !! (n) unknowns [1]
      integer, intent(in) :: kind                !! which of both
      integer, intent(in) :: sensor              !! number of the sensor

      integer :: k

      x = 0.0_wp
      do k = 1, size(self%places)
         if (self%places(k)%kind == kind .and. self%places(k)%number == sensor) x = value_of(self%places(k), u(k))
      end do
   end function of_sensor

   !> The first time at which a derivative is missing, or at which both motions differ.
   subroutine find_end(self, samples, other, found, until, reason)
      class(fit_model_t), intent(in) :: self             !! the model
      type(channel_samples_t), intent(in) :: samples     !! of the motion
      type(channel_samples_t), intent(in) :: other       !! of the motion at the greater tolerance
      type(found_t), intent(in) :: found                 !! why derivatives end
      real(wp), intent(out) :: until                     !! that time; huge: there is none [s]
      character(:), allocatable, intent(out) :: reason   !! why

      logical :: is_good(size(self%sigma))
      integer :: c, k, s

      until = huge(1.0_wp)
      reason = ""
      do k = 1, size(samples%times)
         do s = 1, size(is_good)
            is_good(s) = all(ieee_is_finite(samples%derivatives(s, :, k))) .and. ieee_is_finite(samples%values(s, k)) .and. &
                         ieee_is_finite(other%values(s, k))
            if (is_good(s)) is_good(s) = abs(samples%values(s, k) - other%values(s, k)) <= &
                                         max(of_sigma*self%sigma(s), of_spread*self%spread(s))
         end do
         if (all(is_good)) cycle
         until = samples%times(k)
         reason = beyond
         do c = 1, size(found%reason)
            if (all(ieee_is_finite(samples%derivatives(:, c, k))) .or. found%reason(c)%s == "") cycle
            reason = found%reason(c)%s
         end do
         return
      end do
   end subroutine find_end

   !> Residuals of a set, and their derivatives.
   subroutine add_residuals(self, u, set, samples, is_derived, r, jac)
      class(fit_model_t), intent(inout) :: self              !! the model; what sensors should show is set
      real(wp), intent(in) :: u(:)                           !! (n) unknowns [1]
      integer, intent(in) :: set                             !! number of the set
      type(channel_samples_t), intent(in) :: samples         !! of its motion
      logical, intent(in) :: is_derived                      !! derivatives too
      real(wp), allocatable, intent(inout) :: r(:)           !! (m) grown [1]
      real(wp), allocatable, intent(inout) :: jac(:, :)      !! (m, n) grown [1]

      real(wp), allocatable :: all_jac(:, :), new(:, :), new_r(:)
      real(wp) :: delay, offset
      integer :: at, i, k, n, s

      associate (data => self%sets(set))
         if (.not. allocated(data%model)) allocate (data%model(size(self%sigma), size(data%t)))
         if (is_derived) data%model = not_a_number()
         allocate (new_r(size(data%x)), new(size(data%x), size(u)), source=0.0_wp)
         n = 0
         do s = 1, size(self%sigma)
            delay = of_sensor(self, u, is_delay, s)
            offset = of_sensor(self, u, is_offset, s)
            at = 1
            do i = 1, size(data%t)
               if (.not. self%counts(set, s, i)) cycle
               do while (at < size(samples%times))
                  if (samples%times(at) >= data%t(i) - delay) exit
                  at = at + 1
               end do
               n = n + 1
               if (is_derived) data%model(s, i) = samples%values(s, at) + offset
               new_r(n) = (samples%values(s, at) + offset - data%x(s, i))/self%sigma(s)
               if (.not. is_derived) cycle
               do k = 1, size(u)
                  new(n, k) = slope(self%places(k), s, at)
               end do
            end do
         end do
      end associate
      r = [r, new_r(:n)]
      if (.not. is_derived) return
      allocate (all_jac(size(r), size(u)))
      all_jac(:size(jac, 1), :) = jac
      all_jac(size(jac, 1) + 1:, :) = new(:n, :)
      call move_alloc(all_jac, jac)

   contains

      !> Derivative of a residual by an unknown.
      pure real(wp) function slope(place, sensor, at)
         type(place_t), intent(in) :: place    !! the unknown
         integer, intent(in) :: sensor         !! number of the sensor
         integer, intent(in) :: at             !! number of the time

         slope = 0.0_wp
         if (place%kind == is_parameter) then
            if (any(place%set == [0, set])) slope = samples%derivatives(sensor, place%number, at)
         else if (place%number == sensor) then
            slope = 1.0_wp
            if (place%kind == is_delay) slope = -samples%rates(sensor, at)
         end if
         slope = slope*width_of(place)/self%sigma(sensor)
      end function slope

   end subroutine add_residuals

end module fit_model
