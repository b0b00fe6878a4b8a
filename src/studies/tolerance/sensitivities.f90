!> Derivatives of channels by parameters of the deck, at the output times of a kinematic analysis.
!>
!> Positions: $$ \Phi_q \frac{\partial q}{\partial p} = -\Phi_p, $$ all parameters with one factorisation at each instant.
!> Phi_p comes from differences, extrapolated, of mechanisms that are built anew from the deck with the parameter changed, at
!> the nominal positions. A channel R follows along the tangent,
!> $$ \frac{\mathrm{d}R}{\mathrm{d}p} = \frac{\mathrm{d}}{\mathrm{d}h} R\left(p + h, q + h \frac{\partial q}{\partial p}\right)
!>    \quad\text{at } h = 0, $$
!> by such differences too, with the rates and forces that the changed mechanism has there: velocities, accelerations and reactions
!> have derivatives as positions do. A pin that is displaced by e has Phi_q dq = -de.
!> Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989), section 3.5 (the derivative of rows).
module sensitivities
   use errors, only: error_t, exit_integration, set_error
   use extrapolation, only: extrapolated, n_step, step_of
   use kind_info, only: dim_angle, dim_length, same_dimension
   use kinds, only: wp
   use mechanism_source, only: mechanism_source_t
   use prescribed_motion, only: solved
   use row_corrections, only: evaluate_rows
   use tangents, only: solve_tangents
   use text, only: real_text
   use tolerance_results, only: found_pin_t, sensitivities_t, tolerance_study_t
   use tolerated, only: tolerated_t
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: find_sensitivities, pin_rows

   real(wp), parameter :: step_part = 0.01_wp    !! longest step, of the value of the parameter [1]
   real(wp), parameter :: shorter = 1.0_wp/16.0_wp   !! step after one with which the deck has errors, of that [1]
   integer, parameter :: most_tries = 5              !! steps that are tried
   real(wp), parameter :: round_off = 1.0e-14_wp     !! change of a channel over the longest step that is zero, of its value [1]
   real(wp), parameter :: step_of_size = 0.01_wp !! of the size of the mechanism, or one radian, if the value is zero [1]

contains

   !> Find all first derivatives. The instants of the nominal motion are known.
   subroutine find_sensitivities(source, nominal, study, error)
      class(mechanism_source_t), intent(inout) :: source   !! gives changed mechanisms
      type(varied_t), intent(inout) :: nominal             !! the nominal one, bound
      type(tolerance_study_t), intent(inout) :: study      !! derivatives are set
      type(error_t), allocatable, intent(out) :: error     !! a parameter cannot be changed, or an instant is singular

      type(varied_t), allocatable :: varied(:, :, :)
      integer :: k, n, n_v

      associate (found => study%derivatives, linkage => nominal%system%linkage)
         n = size(study%plan%parameters)
         n_v = linkage%coordinates%n_v*linkage%bodies%n
         associate (n_request => size(study%requests), n_pin => size(study%pins), n_time => size(found%instants))
            allocate (found%values(n_request, n_time), found%slopes(n, n_request, n_time), &
                      found%pins(2, n_pin, n_request, n_time), found%tangents(n_v, n, n_time), &
                      found%pin_tangents(n_v, 2*n_pin, n_time), &
                      found%directions(2, n_pin, n_time), found%clearance_slopes(n, n_pin), source=0.0_wp)
         end associate
         found%steps = [(longest_step(study%plan%parameters(k), linkage%scales%length), k=1, n)]
         call build_all(source, study%pins, found, varied, error)
         if (allocated(error)) return
         do k = 1, size(found%instants)
            call find_at_instant(nominal, study%pins, k, varied, found, error)
            if (allocated(error)) return
            call source%show(0.5_wp*k/size(found%instants))
         end do
      end associate
   end subroutine find_sensitivities

   !> The longest step of a parameter.
   pure real(wp) function longest_step(parameter, length) result(h)
      type(tolerated_t), intent(in) :: parameter   !! the parameter
      real(wp), intent(in) :: length               !! size of the mechanism [m]

      h = step_part*abs(parameter%nominal)
      if (h > 0.0_wp) return
      h = step_of_size
      if (same_dimension(parameter%dimension, dim_length)) h = step_of_size*length
      if (same_dimension(parameter%dimension, dim_length) .or. same_dimension(parameter%dimension, dim_angle)) return
      if (parameter%upper > parameter%lower) h = 0.5_wp*(parameter%upper - parameter%lower)
   end function longest_step

   !> Build the mechanisms of all steps of all parameters, and find the derivatives of the clearances.
   subroutine build_all(source, pins, found, varied, error)
      class(mechanism_source_t), intent(inout) :: source         !! gives changed mechanisms
      type(found_pin_t), intent(in) :: pins(:)                   !! (pins) joints with clearance
      type(sensitivities_t), intent(inout) :: found              !! steps may be shortened; derivatives of clearances are set
      type(varied_t), allocatable, intent(out) :: varied(:, :, :)  !! (2, steps, parameters) ahead and behind
      type(error_t), allocatable, intent(out) :: error           !! a parameter cannot be changed

      real(wp) :: clearances(size(pins), n_step, 2)
      integer :: k, try

      allocate (varied(2, n_step, size(found%steps)))
      do k = 1, size(found%steps)
         do try = 1, most_tries
            call build_steps(k)
            if (.not. allocated(error)) exit
            if (try < most_tries) found%steps(k) = shorter*found%steps(k)
         end do
         if (allocated(error)) return
         found%clearance_slopes(k, :) = extrapolated(clearances(:, :, 1), clearances(:, :, 2), found%steps(k))
      end do

   contains

      !> The mechanisms of a parameter.
      subroutine build_steps(p)
         integer, intent(in) :: p   !! number of the parameter

         real(wp) :: deviations(size(found%steps))
         integer :: l, side

         do l = 1, n_step
            do side = 1, 2
               deviations = 0.0_wp
               deviations(p) = merge(1.0_wp, -1.0_wp, side == 1)*step_of(found%steps(p), l)
               call source%build(deviations, varied(side, l, p), clearances(:, l, side), error)
               if (allocated(error)) return
            end do
         end do
      end subroutine build_steps

   end subroutine build_all

   !> Derivatives at an instant.
   subroutine find_at_instant(nominal, pins, at, varied, found, error)
      type(varied_t), intent(inout) :: nominal              !! the nominal mechanism
      type(found_pin_t), intent(in) :: pins(:)              !! (pins) joints with clearance
      integer, intent(in) :: at                             !! number of the instant
      type(varied_t), intent(inout) :: varied(:, :, :)      !! (2, steps, parameters) changed mechanisms
      type(sensitivities_t), intent(inout) :: found         !! derivatives at the instant are set
      type(error_t), allocatable, intent(out) :: error      !! the instant is singular

      real(wp), allocatable :: rest(:), right(:, :), x(:, :)
      integer :: i, k, n, outcome, rows(2)
      logical :: is_regular

      associate (instant => found%instants(at), linkage => nominal%system%linkage)
         n = size(found%steps)
         allocate (right(linkage%rows%n, n + 2*size(pins)), x(size(found%tangents, 1), n + 2*size(pins)), source=0.0_wp)
         nominal%needs_forces = size(pins) > 0
         call nominal%values_at(instant, instant%q, found%values(:, at), outcome)
         nominal%needs_forces = .false.
         if (outcome == solved) call find_directions(nominal, pins, found%directions(:, :, at))
         do k = 1, n
            call find_row_slopes(varied(:, :, k), instant%q, found%steps(k), right(:, k))
         end do
         right(:, :n) = -right(:, :n)
         do k = 1, size(pins)
            rows = pin_rows(nominal, pins(k))
            right(rows(1), n + 2*k - 1) = -1.0_wp
            right(rows(2), n + 2*k) = -1.0_wp
         end do
         allocate (rest(size(x, 1)), source=0.0_wp)
         call evaluate_rows(linkage, instant%t, instant%q, rest)
         call solve_tangents(linkage, right, x, is_regular)
         if (outcome /= solved .or. .not. is_regular) then
            call refuse_instant(instant%t, error)
            return
         end if
         found%tangents(:, :, at) = x(:, :n)
         found%pin_tangents(:, :, at) = x(:, n + 1:)
         do k = 1, n
            call find_value_slopes(varied(:, :, k), x(:, k), found%steps(k), found%slopes(k, :, at))
         end do
         do k = 1, size(pins)
            do i = 1, 2
               call find_pin_slopes(nominal, x(:, n + 2*(k - 1) + i), found%pins(i, k, :, at))
            end do
         end do
         call nominal%follow()
      end associate

   contains

      !> Derivatives of the rows by a parameter, at fixed positions.
      subroutine find_row_slopes(list, q, h, slopes)
         type(varied_t), intent(inout) :: list(:, :)   !! (2, steps) changed mechanisms
         real(wp), intent(in) :: q(:)                  !! (n_q bodies) positions [any]
         real(wp), intent(in) :: h                     !! longest step [any]
         real(wp), intent(out) :: slopes(:)            !! (rows) derivatives [any]

         real(wp) :: phi(size(slopes), n_step, 2)
         integer :: l, side

         do l = 1, n_step
            do side = 1, 2
               call list(side, l)%rows_at(found%instants(at), q, phi(:, l, side))
            end do
         end do
         slopes = extrapolated(phi(:, :, 1), phi(:, :, 2), h)
      end subroutine find_row_slopes

      !> Derivatives of the channels by a parameter, along the tangent.
      subroutine find_value_slopes(list, tangent, h, slopes)
         type(varied_t), intent(inout) :: list(:, :)   !! (2, steps) changed mechanisms
         real(wp), intent(in) :: tangent(:)            !! (n_v bodies) of the positions [any]
         real(wp), intent(in) :: h                     !! longest step [any]
         real(wp), intent(out) :: slopes(:)            !! (requests) derivatives [any]

         real(wp) :: values(size(slopes), n_step, 2)
         integer :: l, side

         do l = 1, n_step
            do side = 1, 2
               call values_along(list(side, l), merge(1.0_wp, -1.0_wp, side == 1)*step_of(h, l)*tangent, values(:, l, side))
               call list(side, l)%follow()
            end do
         end do
         slopes = extrapolated(values(:, :, 1), values(:, :, 2), h)
         where (abs(slopes)*h <= round_off*abs(found%values(:, at))) slopes = 0.0_wp
      end subroutine find_value_slopes

      !> Derivatives of the channels by a displacement of a pin.
      subroutine find_pin_slopes(one, tangent, slopes)
         type(varied_t), intent(inout) :: one          !! the nominal mechanism
         real(wp), intent(in) :: tangent(:)            !! (n_v bodies) of the positions [any]
         real(wp), intent(out) :: slopes(:)            !! (requests) derivatives [any]

         real(wp) :: h, values(size(slopes), n_step, 2)
         integer :: l, side

         h = step_of_size*one%system%linkage%scales%length
         do l = 1, n_step
            do side = 1, 2
               call values_along(one, merge(1.0_wp, -1.0_wp, side == 1)*step_of(h, l)*tangent, values(:, l, side))
            end do
         end do
         slopes = extrapolated(values(:, :, 1), values(:, :, 2), h)
         where (abs(slopes)*h <= round_off*abs(found%values(:, at))) slopes = 0.0_wp
      end subroutine find_pin_slopes

      !> Channels at the nominal positions and a change of them. A singular instant was found before: there is no outcome.
      subroutine values_along(one, change, values)
         type(varied_t), intent(inout) :: one          !! a mechanism
         real(wp), intent(in) :: change(:)             !! (n_v bodies) of the positions [m or rad]
         real(wp), intent(out) :: values(:)            !! (requests) values [any]

         real(wp) :: q(size(found%instants(at)%q))
         integer :: ignored

         q = found%instants(at)%q
         call one%system%linkage%coordinates%add_change(one%system%linkage%bodies%n, change, q)
         call one%values_at(found%instants(at), q, values, ignored)
      end subroutine values_along

   end subroutine find_at_instant

   !> Positions have no derivatives at an instant.
   subroutine refuse_instant(t, error)
      real(wp), intent(in) :: t                             !! time [s]
      type(error_t), allocatable, intent(out) :: error      !! the message

      call set_error(error, exit_integration, "the positions have no derivatives at t = "//real_text(t, 9)// &
                     " s: constraint rows are linearly dependent there, as at a dead centre"//new_line("a")// &
                     "  = shift the output times away from it")
   end subroutine refuse_instant

   !> Rows of a pin: x, then y.
   pure function pin_rows(nominal, pin) result(rows)
      type(varied_t), intent(in) :: nominal     !! the mechanism
      type(found_pin_t), intent(in) :: pin      !! the joint
      integer :: rows(2)                        !! (2) their numbers

      integer :: i

      associate (set => nominal%system%linkage%ideal(pin%set)%set)
         rows = [(set%first_row + (pin%item - 1)*set%n_row_item + i, i=1, 2)]
      end associate
   end function pin_rows

   !> Where the forces press the pins: along the force on the bearing. Forces were found.
   subroutine find_directions(nominal, pins, directions)
      type(varied_t), intent(in) :: nominal            !! the mechanism, its forces found
      type(found_pin_t), intent(in) :: pins(:)         !! (pins) joints with clearance
      real(wp), intent(out) :: directions(:, :)        !! (2, pins) unit vectors; 0: no force [1]

      real(wp) :: force(3), moment(3)
      integer :: k

      directions = 0.0_wp
      associate (linkage => nominal%system%linkage)
         do k = 1, size(pins)
            call linkage%ideal(pins(k)%set)%set%reaction(pins(k)%item, linkage%motion, linkage%coordinates, linkage%rows, &
                                                         linkage%solution%lambda, force, moment)
            if (norm2(force(:2)) > 0.0_wp) directions(:, k) = force(:2)/norm2(force(:2))
         end do
      end associate
   end subroutine find_directions

end module sensitivities
