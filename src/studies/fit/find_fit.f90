!> The fit of a mechanism to data: the search in stages, the noise of the sensors, intervals.
!>
!> A stage fits the data up to a time and starts where the stage before ended, so that a search whose start is far off finds the
!> sequence of impacts one after another. At last all data within the horizon are fitted. Where standard deviations of sensors are
!> not given, they are those of the residuals, and the fit is repeated with them until they stay.
module find_fit
   use errors, only: error_t, exit_integration, set_error
   use fit_intervals, only: find_intervals, intervals_t
   use fit_layout, only: value_of, width_of
   use fit_model, only: fit_model_t
   use fit_results, only: fit_t
   use kinds, only: wp
   use least_squares, only: end_failed, minimise, minimum_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: find_parameters

   integer, parameter :: most_rounds = 20             !! repetitions with other weights
   real(wp), parameter :: settled = 1.0e-3_wp         !! change of a standard deviation that is the last, of it [1]
   real(wp), parameter :: exact = 1.0e-12_wp          !! minimum standard deviation, of the spread of the data [1]

contains

   !> Find the parameters.
   subroutine find_parameters(model, is_given, fit, error)
      type(fit_model_t), intent(inout) :: model             !! the residuals
      logical, intent(in) :: is_given(:)                    !! (sensors) their standard deviations are known
      type(fit_t), intent(inout) :: fit                     !! names of sensors are set; the rest is found
      type(error_t), allocatable, intent(out) :: error      !! no motion, or too few data

      type(minimum_t) :: found
      real(wp) :: before(size(is_given))
      real(wp), allocatable :: u(:)
      integer :: k

      u = model%places%start
      do k = 1, size(model%plan%until) + 1
         model%stage = huge(1.0_wp)
         if (k <= size(model%plan%until)) model%stage = model%plan%until(k)
         call search(model, u, fit, found, error)
         if (allocated(error)) return
         if (k <= size(model%plan%until)) call find_noise(model, is_given)  ! the horizon of the next stage depends on it
      end do
      do k = 1, most_rounds
         before = model%sigma
         call find_noise(model, is_given)
         if (all(abs(model%sigma - before) <= settled*before)) exit
         call search(model, u, fit, found, error)
         if (allocated(error)) return
      end do
      model%sigma = before   ! that of the residuals
      call take_results(model, is_given, found, fit)
   end subroutine find_parameters

   !> One search.
   subroutine search(model, u, fit, found, error)
      type(fit_model_t), intent(inout) :: model             !! the residuals
      real(wp), intent(inout) :: u(:)                       !! (n) where it starts; then where it ended [1]
      type(fit_t), intent(inout) :: fit                     !! what it took is added
      type(minimum_t), intent(out) :: found                 !! the minimum
      type(error_t), allocatable, intent(out) :: error      !! no motion, or too few data

      integer :: k

      do k = 1, size(model%sets)
         model%sets(k)%until = huge(1.0_wp)
      end do
      call minimise(model, u, model%plan%most, found)
      fit%search%n_derived = fit%search%n_derived + found%n_derived
      fit%search%n_motion = model%n_motion
      fit%search%end = found%end
      if (found%end == end_failed) then
         call set_error(error, exit_integration, "the fit has no motion to start from: "//model%message)
      else if (size(found%r) <= size(u)) then
         if (model%stage < huge(1.0_wp)) return
         call set_error(error, exit_integration, to_text(size(found%r))//" data within the horizon of the motions are too few " &
                        //"for "//to_text(size(u))//" unknowns"//reasons(model))
      else
         u = found%u
      end if
   end subroutine search

   !> Why data are left out, set by set, as lines of a message.
   function reasons(model) result(lines)
      type(fit_model_t), intent(in) :: model     !! the model
      character(:), allocatable :: lines         !! each with a new line before it

      integer :: k

      lines = ""
      do k = 1, size(model%sets)
         associate (set => model%sets(k))
            if (set%until < huge(1.0_wp)) lines = lines//new_line("a")//"  = set '"//set%name//"' from t = "// &
                                                  real_text(set%until, 4)//" s on: "//set%reason
         end associate
      end do
   end function reasons

   !> Standard deviations of the sensors from their residuals.
   subroutine find_noise(model, is_given)
      type(fit_model_t), intent(inout) :: model     !! the residuals; standard deviations are set
      logical, intent(in) :: is_given(:)            !! (sensors) they are known

      real(wp) :: square
      integer :: n, s

      do s = 1, size(is_given)
         if (is_given(s)) cycle
         call sum_residuals(model, s, n, square)
         if (n > 0) model%sigma(s) = max(sqrt(square/n), exact*model%spread(s), tiny(1.0_wp))
      end do
   end subroutine find_noise

   !> Sum of the squared residuals of a sensor.
   subroutine sum_residuals(model, s, n, square)
      type(fit_model_t), intent(in) :: model   !! the model
      integer, intent(in) :: s                 !! number of the sensor
      integer, intent(out) :: n                !! residuals
      real(wp), intent(out) :: square          !! their sum, SI [any]

      integer :: i, k

      n = 0
      square = 0.0_wp
      do k = 1, size(model%sets)
         do i = 1, size(model%sets(k)%t)
            if (.not. model%counts(k, s, i)) cycle
            n = n + 1
            square = square + (model%sets(k)%model(s, i) - model%sets(k)%x(s, i))**2
         end do
      end do
   end subroutine sum_residuals

   !> Values, intervals and residuals.
   subroutine take_results(model, is_given, found, fit)
      type(fit_model_t), intent(in) :: model        !! the residuals
      logical, intent(in) :: is_given(:)            !! (sensors) their standard deviations are known
      type(minimum_t), intent(in) :: found          !! the minimum
      type(fit_t), intent(inout) :: fit             !! the rest is set

      type(intervals_t) :: known
      real(wp) :: square
      integer :: k, s

      call find_intervals(found%u, found%r, found%jac, all(is_given), known)
      fit%places = model%places
      fit%value = [(value_of(fit%places(k), found%u(k)), k=1, size(found%u))]
      fit%low = [(value_of(fit%places(k), known%low(k)), k=1, size(found%u))]
      fit%high = [(value_of(fit%places(k), known%high(k)), k=1, size(found%u))]
      fit%deviation = [(width_of(fit%places(k))*sqrt(known%covariance(k, k)), k=1, size(found%u))]
      fit%is_seen = known%is_seen
      fit%partner = known%partner
      fit%correlation = known%correlation
      fit%sensors%sigma = model%sigma
      fit%sensors%is_given = is_given
      fit%sets = model%sets
      fit%n_data = size(found%r)
      fit%deviation_of_residuals = sqrt(sum(found%r**2)/(size(found%r) - size(found%u)))
      do s = 1, size(is_given)
         call sum_residuals(model, s, fit%sensors(s)%n_used, square)
         if (fit%sensors(s)%n_used > 0) fit%sensors(s)%rms = sqrt(square/fit%sensors(s)%n_used)
      end do
   end subroutine take_results

end module find_fit
