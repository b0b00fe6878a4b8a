!> The matrices of a mechanism linearised at a state: z' = A z + B u, y = C z + D u, of the whole right-hand side.
!>
!> z has the free displacements x, their rates, states of friction with bristles and of state equations: no more, so that
!> constraints and Euler parameters add no eigenvalues. With the derivatives J of the accelerations along the directions of
!> `motion_frame`
!>
!> $$ \ddot x = D^T M (J_q D + J_v E + \dot\omega\ \mathrm{terms})\, x + D^T M E' x + D^T M J_v D\, \dot x $$
!>
!> and in axes that turn $\ddot x' = (A_{21} + A_{22} C - C^2) x' + (A_{22} - 2 C) \dot x'$. Inputs are loads, and displacements of
!> drivers with their first two derivatives. Source: Shabana (2020), section 3.4. Limits: see `state_slopes`; where the state is no
!> equilibrium the matrices are those of the instant.
module linear_model
   use catalogue, only: catalogue_t
   use input_load, only: add_input_load, set_input_load
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use modes_results, only: input_driver, input_force, linear_model_t, modes_input_t
   use motion_frame, only: motion_frame_t
   use state_slopes, only: slopes_t
   use state_equations, only: state_prefix
   use static_problem, only: load_scale, position_scale
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: linearise

contains

   !> Find the matrices. Status 0: done.
   subroutine linearise(system, t, y, axes, inputs, place, catalogue, model, status)
      type(mechanism_t), intent(inout) :: system      !! the system, all of whose bodies are unknown; contacts in their states
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      integer, intent(in) :: axes                     !! body in whose axes motions are resolved, 0: the world's
      type(modes_input_t), intent(in) :: inputs(:)    !! (n) inputs
      integer, intent(in) :: place(:)                 !! (outputs) places in the catalogue
      type(catalogue_t), intent(inout) :: catalogue   !! outputs are bound
      type(linear_model_t), intent(out) :: model      !! the matrices
      integer, intent(out) :: status                  !! 0: done; else the equations cannot be solved there

      type(motion_frame_t) :: frame
      type(slopes_t) :: slopes
      real(wp), allocatable :: by_rate(:, :), by_shift(:, :), by_state(:, :), c(:, :), d(:, :)
      integer :: n_other

      call frame%find(system, t, y, pack(inputs%row, inputs%kind == input_driver), axes, status)
      if (status /= 0) return
      call slopes%begin(system, t, y, place)
      n_other = system%n - system%n_quadrature - system%linkage%n_position - system%linkage%n_rate
      model%n_free = frame%n_free
      model%n_state = 2*frame%n_free + n_other
      call name_others(system, n_other, model%others)
      model%direction = frame%direction(:, :frame%n_free)
      model%mass = reshape(system%linkage%mass(:, system%linkage%rows%unknown), [frame%n_rate])
      model%unsteady = frame%unsteady
      call find_rest(system, slopes, frame, axes, catalogue, model, status)
      if (status == 0) call find_columns(system, slopes, frame, catalogue, n_other, by_shift, by_rate, by_state, c, d, status)
      if (status /= 0) return
      call assemble_states(frame, n_other, by_shift, by_rate, by_state, c, model)
      call assemble_inputs(system, slopes, frame, catalogue, inputs, by_shift, by_rate, d, model, status)
      if (axes > 0) call turn_axes(frame, model)
   end subroutine linearise

   !> Names of the other states: deflections of bristles, then the deck's state equations.
   subroutine name_others(system, n_other, names)
      type(mechanism_t), intent(in) :: system               !! the system
      integer, intent(in) :: n_other                        !! other states
      type(text_t), allocatable, intent(out) :: names(:)    !! (other states) their names

      integer :: k

      allocate (names(n_other))
      associate (states => system%loading%states)
         do k = 1, n_other
            if (k > n_other - states%n_state) then
               names(k)%s = state_prefix//states%rows(states%integrated(k - n_other + states%n_state))%name
            else
               names(k)%s = "bristle"//to_text(k)
            end if
         end do
      end associate
   end subroutine name_others

   !> Accelerations that are left at the state beside those of the axes; their loads over the forces that act, as in statics.
   subroutine find_rest(system, slopes, frame, axes, catalogue, model, status)
      type(mechanism_t), intent(inout) :: system      !! the system
      type(slopes_t), intent(in) :: slopes            !! the state
      type(motion_frame_t), intent(in) :: frame       !! the directions
      integer, intent(in) :: axes                     !! body in whose axes motions are resolved, 0: the world's
      type(catalogue_t), intent(inout) :: catalogue   !! outputs are bound
      type(linear_model_t), intent(inout) :: model    !! residual and rest are set
      integer, intent(out) :: status                  !! 0: done

      real(wp), parameter :: at_rest = 1.0e-6_wp   ! negligible rate of a state, over its scale times the characteristic rate [1]
      real(wp), dimension(size(slopes%y)) :: local, weights, ydot
      real(wp) :: accelerations(frame%n_rate), outputs(size(slopes%place))
      integer :: last

      ydot = 0.0_wp
      call slopes%evaluate(system, catalogue, slopes%y, ydot, outputs, status)
      if (status /= 0) return
      last = system%n - system%n_quadrature
      associate (n => size(model%others))
         call system%weights(slopes%y, weights)
         weights(last - n + 1:last) = abs(ydot(last - n + 1:last))/(slopes%rate*weights(last - n + 1:last))
         if (any(weights(last - n + 1:last) > at_rest)) model%moving = maxloc(weights(last - n + 1:last), dim=1)
      end associate
      call system%to_local(slopes%y, ydot(:last), local(:last - system%traits%n_turning))
      associate (n => frame%n_rate)
         accelerations = local(n + 1:2*n)
         call system%to_local(slopes%y, slopes%y(:last), local(:last - system%traits%n_turning))
         accelerations = accelerations - frame%turned(system, local(n + 1:2*n), system%linkage%motion%omega(:, axes))
         model%rest = matmul(accelerations, frame%reading)
         accelerations = matmul(frame%reading(:, :frame%n_free), model%rest)*position_scale(system)
      end associate
      model%residual = norm2(accelerations)/max(load_scale(system), norm2(accelerations), tiny(1.0_wp))
   end subroutine find_rest

   !> Derivatives along all directions: of accelerations in them, and of other states; of outputs.
   subroutine find_columns(system, slopes, frame, catalogue, n_other, by_shift, by_rate, by_state, c, d, status)
      type(mechanism_t), intent(inout) :: system               !! the system
      type(slopes_t), intent(in) :: slopes                     !! the state
      type(motion_frame_t), intent(in) :: frame                !! the directions
      type(catalogue_t), intent(inout) :: catalogue            !! outputs are bound
      integer, intent(in) :: n_other                           !! other states
      real(wp), allocatable, intent(out) :: by_shift(:, :)     !! (free + other, free + drivers) by displacements [any]
      real(wp), allocatable, intent(out) :: by_rate(:, :)      !! (free + other, free + drivers) by rates [any]
      real(wp), allocatable, intent(out) :: by_state(:, :)     !! (free + other, other) by other states [any]
      real(wp), allocatable, intent(out) :: c(:, :)            !! (outputs, states) C [any]
      real(wp), allocatable, intent(out) :: d(:, :)            !! (outputs, 2 drivers) D by displacements, then by rates [any]
      integer, intent(out) :: status                           !! 0: done

      real(wp), dimension(frame%n_rate) :: none
      real(wp) :: no_state(n_other), slope(system%n - system%n_quadrature - system%traits%n_turning), unit(n_other)
      real(wp) :: outputs(size(slopes%place))
      integer :: k, n, n_all

      n = frame%n_free
      n_all = n + frame%n_driver
      allocate (by_shift(n + n_other, n_all), by_rate(n + n_other, n_all), by_state(n + n_other, n_other), source=0.0_wp)
      allocate (c(size(outputs), 2*n + n_other), d(size(outputs), 2*frame%n_driver), source=0.0_wp)
      none = 0.0_wp
      no_state = 0.0_wp
      status = 0
      do k = 1, n_all
         associate (x => frame%direction(:, k), e => frame%drift(:, k))
            call slopes%along(system, catalogue, frame, x, e, no_state, slope, outputs, status)
            if (status /= 0) return
            call read_slope(e, by_shift(:, k))
            by_shift(:n, k) = by_shift(:n, k) + frame%bend(:, k)
            if (k <= n) c(:, k) = outputs
            if (k > n) d(:, k - n) = outputs
            call slopes%along(system, catalogue, frame, none, x, no_state, slope, outputs, status)
            if (status /= 0) return
            call read_slope(x, by_rate(:, k))
            if (k <= n) c(:, n + k) = outputs
            if (k > n) d(:, frame%n_driver + k - n) = outputs
         end associate
      end do
      do k = 1, n_other
         unit = 0.0_wp
         unit(k) = 1.0_wp
         call slopes%along(system, catalogue, frame, none, none, unit, slope, outputs, status)
         if (status /= 0) return
         call read_slope(none, by_state(:, k))
         c(:, 2*n + k) = outputs
      end do

   contains

      !> Accelerations in the free directions, with what the turning of the bodies' axes adds.
      subroutine read_slope(rates, column)
         real(wp), intent(in) :: rates(:)       !! (rates) change of the rates [any]
         real(wp), intent(out) :: column(:)     !! (free + other) the column [any]

         associate (m => frame%n_rate)
            call system%linkage%set_motion(slopes%t, slopes%y)
            column(:n) = matmul(slope(m + 1:2*m) + frame%turned(system, rates), frame%reading)
            column(n + 1:) = slope(2*m + 1:)
         end associate
      end subroutine read_slope

   end subroutine find_columns

   !> A and C.
   subroutine assemble_states(frame, n_other, by_shift, by_rate, by_state, c, model)
      type(motion_frame_t), intent(in) :: frame                !! the directions
      integer, intent(in) :: n_other                           !! other states
      real(wp), intent(in) :: by_shift(:, :), by_rate(:, :)    !! (free + other, free + drivers) columns [any]
      real(wp), intent(in) :: by_state(:, :)                   !! (free + other, other) columns [any]
      real(wp), intent(in) :: c(:, :)                          !! (outputs, states) C [any]
      type(linear_model_t), intent(inout) :: model             !! A and C are set

      integer :: k, n

      n = frame%n_free
      allocate (model%a(2*n + n_other, 2*n + n_other), source=0.0_wp)
      do k = 1, n
         model%a(k, n + k) = 1.0_wp
      end do
      model%a(n + 1:, :n) = by_shift(:, :n)
      model%a(n + 1:, n + 1:2*n) = by_rate(:, :n)
      model%a(n + 1:, 2*n + 1:) = by_state
      model%c = c
   end subroutine assemble_states

   !> B and D.
   subroutine assemble_inputs(system, slopes, frame, catalogue, inputs, by_shift, by_rate, d, model, status)
      type(mechanism_t), intent(inout) :: system               !! the system; a load of amplitude zero is added
      type(slopes_t), intent(in) :: slopes                     !! the state
      type(motion_frame_t), intent(in) :: frame                !! the directions
      type(catalogue_t), intent(inout) :: catalogue            !! outputs are bound
      type(modes_input_t), intent(in) :: inputs(:)             !! (n) inputs
      real(wp), intent(in) :: by_shift(:, :), by_rate(:, :)    !! (free + other, free + drivers) columns [any]
      real(wp), intent(in) :: d(:, :)                          !! (outputs, 2 drivers) D by displacements, then by rates [any]
      type(linear_model_t), intent(inout) :: model             !! B, D and the names are set
      integer, intent(out) :: status                           !! 0: done

      integer :: driver, i, k, n_all

      n_all = size(inputs) + 2*frame%n_driver
      status = 0
      allocate (model%b(model%n_state, n_all), model%d(size(slopes%place), n_all), source=0.0_wp)
      allocate (model%inputs(0), model%input_units(0))
      if (any(inputs%kind /= input_driver)) call add_input_load(system%loading)
      driver = 0
      k = 0
      do i = 1, size(inputs)
         if (inputs(i)%kind == input_driver) then
            driver = driver + 1
            associate (n => frame%n_free)
               model%b(n + 1:, k + 1) = by_shift(:, n + driver)
               model%b(n + 1:, k + 2) = by_rate(:, n + driver)
               model%d(:, k + 1) = d(:, driver)
               model%d(:, k + 2) = d(:, frame%n_driver + driver)
            end associate
            call accelerate_driver(system, slopes, catalogue, inputs(i)%row, model%d(:, k + 3), status)
            call append_text(model%inputs, inputs(i)%name//".displacement")
            call append_text(model%inputs, inputs(i)%name//".speed")
            call append_text(model%inputs, inputs(i)%name//".acceleration")
            call append_text(model%input_units, trim(merge("rad", "m  ", inputs(i)%is_angle)))
            call append_text(model%input_units, trim(merge("rad/s", "m/s  ", inputs(i)%is_angle)))
            call append_text(model%input_units, trim(merge("rad/s^2", "m/s^2  ", inputs(i)%is_angle)))
            k = k + 3
         else
            k = k + 1
            call load_column(system, slopes, frame, catalogue, inputs(i), model%b(:, k), model%d(:, k), status)
            call append_text(model%inputs, inputs(i)%name)
            call append_text(model%input_units, trim(merge("N  ", "N.m", inputs(i)%kind == input_force)))
         end if
         if (status /= 0) return
      end do
   end subroutine assemble_inputs

   !> Columns of B and D of a load: of one as large as the loads, divided by it, for they are linear.
   subroutine load_column(system, slopes, frame, catalogue, input, b, d, status)
      type(mechanism_t), intent(inout) :: system          !! the system, with the load
      type(slopes_t), intent(in) :: slopes                !! the state
      type(motion_frame_t), intent(in) :: frame           !! the directions
      type(catalogue_t), intent(inout) :: catalogue       !! outputs are bound
      type(modes_input_t), intent(in) :: input            !! the input
      real(wp), intent(out) :: b(:)                       !! (states) its column of B [any]
      real(wp), intent(out) :: d(:)                       !! (outputs) its column of D [any]
      integer, intent(out) :: status                      !! 0: done

      real(wp), dimension(size(slopes%y)) :: local, ydot
      real(wp) :: amplitude, axis(3), other(size(d)), rates(system%n, 2)
      integer :: last, side

      amplitude = max(1.0_wp, maxval(abs(system%loading%g)))
      axis = 0.0_wp
      axis(input%axis) = amplitude
      rates = 0.0_wp
      do side = 1, 2
         associate (load => merge(axis, -axis, side == 1))
            if (input%kind == input_force) then
               call set_input_load(system%loading, input%body, input%arm, load, 0.0_wp*load)
            else
               call set_input_load(system%loading, input%body, input%arm, 0.0_wp*load, load)
            end if
         end associate
         call slopes%evaluate(system, catalogue, slopes%y, rates(:, side), other, status)
         if (status /= 0) return
         if (side == 1) d = other
      end do
      call set_input_load(system%loading, input%body, input%arm, 0.0_wp*axis, 0.0_wp*axis)
      last = system%n - system%n_quadrature
      ydot = (rates(:, 1) - rates(:, 2))/(2.0_wp*amplitude)
      d = (d - other)/(2.0_wp*amplitude)
      call system%to_local(slopes%y, ydot(:last), local(:last - system%traits%n_turning))
      b = 0.0_wp
      associate (n => frame%n_free, m => frame%n_rate)
         b(n + 1:2*n) = matmul(local(m + 1:2*m), frame%reading)
         b(2*n + 1:) = local(2*m + 1:last - system%traits%n_turning)
      end associate
   end subroutine load_column

   !> The column of D of a driver's acceleration. In B it has none: what it moves at once is across the free directions.
   subroutine accelerate_driver(system, slopes, catalogue, row, d, status)
      type(mechanism_t), intent(inout) :: system          !! the system
      type(slopes_t), intent(in) :: slopes                !! the state
      type(catalogue_t), intent(inout) :: catalogue       !! outputs are bound
      integer, intent(in) :: row                          !! row of the driver
      real(wp), intent(out) :: d(:)                       !! (outputs) the column [any]
      integer, intent(out) :: status                      !! 0: done

      real(wp) :: values(size(d)), ydot(size(slopes%y))
      integer :: k, side

      d = 0.0_wp
      do side = 1, 2
         ydot = 0.0_wp
         call system%evaluate(slopes%t, slopes%y, ydot, status)
         if (status /= 0) return
         associate (linkage => system%linkage, nq => system%linkage%n_position, n_v => system%linkage%coordinates%n_v)
            linkage%solution%b(row) = linkage%solution%b(row) + merge(1.0_wp, -1.0_wp, side == 1)
            call linkage%find_accelerations(system%loading%g, .true., .false., status)
            if (status /= 0) return
            do k = 1, linkage%rows%n_unknown
               ydot(nq + n_v*(k - 1) + 1:nq + n_v*k) = linkage%solution%a(:, linkage%rows%unknown(k))
            end do
         end associate
         call slopes%report(system, catalogue, slopes%y, ydot, values)
         d = d + merge(0.5_wp, -0.5_wp, side == 1)*values
      end do
   end subroutine accelerate_driver

   !> Resolve the matrices in axes that turn.
   subroutine turn_axes(frame, model)
      type(motion_frame_t), intent(in) :: frame           !! for C
      type(linear_model_t), intent(inout) :: model        !! turned

      integer :: n

      n = frame%n_free
      model%a(n + 1:, :n) = model%a(n + 1:, :n) + matmul(model%a(n + 1:, n + 1:2*n), frame%carry)
      model%a(n + 1:2*n, :n) = model%a(n + 1:2*n, :n) - matmul(frame%carry, frame%carry)
      model%a(n + 1:2*n, n + 1:2*n) = model%a(n + 1:2*n, n + 1:2*n) - 2.0_wp*frame%carry
      model%c(:, :n) = model%c(:, :n) + matmul(model%c(:, n + 1:2*n), frame%carry)
   end subroutine turn_axes

end module linear_model
