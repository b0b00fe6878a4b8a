!> A steady motion of a mechanism, near the start of a deck.
!>
!> $$ D^T M (\dot V - \omega \times V) = 0 $$
!>
!> with V the speeds of the start, in axes that turn with a body those of the bodies turning with it, both as near as the rows
!> allow in the metric of the masses. Newton's iteration with the matrix of `linear_model` finds the positions. In axes at rest the
!> free speeds follow from $A_{21} \dot x = -d(\ddot x)/dt$: what springs hold stands still, what turns freely turns on.
!> Source: Meirovitch, Methods of Analytical Dynamics (1970), section 6.8 (steady motions). Limits: the one near the start.
module steady_motion
   use catalogue, only: catalogue_t
   use errors, only: error_t, exit_assembly, set_error
   use kinds, only: wp
   use lapack, only: dgelsd
   use linear_model, only: linearise
   use mechanism, only: mechanism_t
   use modes_results, only: linear_model_t, modes_input_t
   use motion, only: cross
   use motion_frame, only: motion_frame_t
   use state_slopes, only: slopes_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: find_steady

   real(wp), parameter :: found = 1.0e-12_wp      !! residual at which the search of a steady motion ends [1]
   real(wp), parameter :: good = 1.0e-8_wp        !! residual that is allowed where no step makes it less [1]
   real(wp), parameter :: longest = 0.3_wp        !! step of Newton's iteration, in sizes of the bodies or radians [1]
   integer, parameter :: most = 50                !! its steps
   integer, parameter :: most_halvings = 8        !! of a step
   integer, parameter :: n_round = 3              !! rounds of positions and free speeds

contains

   !> Newton's iteration for a steady motion: positions, then, in axes at rest, the free speeds, and again.
   subroutine find_steady(system, axes, y, words, error)
      type(mechanism_t), intent(inout) :: system             !! the system
      integer, intent(in) :: axes                            !! body that turns, 0: none
      real(wp), intent(inout) :: y(:)                        !! (n) start, then the steady motion [any]
      character(:), allocatable, intent(out) :: words        !! what it is
      type(error_t), allocatable, intent(out) :: error       !! none was found

      type(linear_model_t) :: model
      real(wp), allocatable :: start(:)
      real(wp) :: omega(3)
      integer :: round, status

      start = y
      call system%linkage%set_motion(0.0_wp, start)
      omega = system%linkage%motion%omega(:, axes)
      do round = 1, n_round
         call balance_positions(system, axes, omega, start, y, model, status)
         if (status /= 0 .or. axes > 0 .or. round == n_round) exit
         call still_rates(system, model, y, start, status)
         if (status /= 0) exit
      end do
      words = "a steady motion"
      if (status /= 0) then
         call set_error(error, exit_assembly, "no steady motion was found: the equations cannot be solved near the start")
      else if (model%residual > good) then
         call set_error(error, exit_assembly, "no steady motion was found: loads of "//real_text(model%residual, 2) &
                        //" of the forces that act are not balanced, allowed "//real_text(good, 2)//new_line("a") &
                        //"  = start nearer to it, let the motion settle (at = time), or name the body that turns (axes)")
      end if
   end subroutine find_steady

   !> Positions at which no free acceleration is left.
   subroutine balance_positions(system, axes, omega, start, y, model, status)
      type(mechanism_t), intent(inout) :: system             !! the system
      integer, intent(in) :: axes                            !! body that turns, 0: none
      real(wp), intent(in) :: omega(3)                       !! (3) its speed [rad/s]
      real(wp), intent(in) :: start(:)                       !! (n) state with the speeds of the start [any]
      real(wp), intent(inout) :: y(:)                        !! (n) where it starts, then the balance [any]
      type(linear_model_t), intent(out) :: model             !! matrices there
      integer, intent(out) :: status                         !! 0: done

      type(linear_model_t) :: next
      real(wp) :: part, trial(size(y))
      integer :: halving, k

      call correct_rates(system, start, axes, omega, y, status)
      if (status == 0) call linearise_here(y, model, status)
      steps: do k = 1, most
         if (status /= 0 .or. model%residual <= found) exit
         part = 1.0_wp
         do halving = 1, most_halvings
            call step_along(system, model, part, trial, y, status)
            if (status == 0) call correct_rates(system, start, axes, omega, trial, status)
            if (status == 0) call linearise_here(trial, next, status)
            if (status == 0) then
               if (norm2(next%rest) < norm2(model%rest)) exit
            end if
            part = 0.5_wp*part
            status = 0
         end do
         if (halving > most_halvings) exit steps
         y = trial
         model = next
      end do steps

   contains

      !> Matrices at a state, without inputs and outputs.
      subroutine linearise_here(at, here, outcome)
         real(wp), intent(in) :: at(:)                     !! (n) the state [any]
         type(linear_model_t), intent(out) :: here         !! its matrices
         integer, intent(out) :: outcome                   !! 0: done

         type(catalogue_t) :: nothing
         type(modes_input_t) :: none(0)

         call linearise(system, 0.0_wp, at, axes, none, [integer ::], nothing, here, outcome)
      end subroutine linearise_here

   end subroutine balance_positions

   !> Change the free speeds of the start so that the motion takes the mechanism to no other free accelerations: what springs hold
   !> stands still, what turns freely turns on.
   subroutine still_rates(system, model, y, start, status)
      type(mechanism_t), intent(inout) :: system             !! the system
      type(linear_model_t), intent(in) :: model              !! matrices at the state
      real(wp), intent(in) :: y(:)                           !! (n) the state [any]
      real(wp), intent(inout) :: start(:)                    !! (n) speeds of the start, changed [any]
      integer, intent(out) :: status                         !! 0: done

      type(catalogue_t) :: nothing
      type(motion_frame_t) :: frame
      type(slopes_t) :: slopes
      real(wp), dimension(size(y)) :: acceleration, change, speed
      real(wp) :: none(0), outputs(0), slope(system%n - system%n_quadrature - system%traits%n_turning), u(model%n_free)
      real(wp) :: others(size(slope) - 2*system%linkage%n_rate)

      status = 0
      if (model%n_free == 0) return
      call frame%find(system, 0.0_wp, y, [integer ::], 0, status)
      if (status /= 0) return
      call slopes%begin(system, 0.0_wp, y, [integer ::])
      change = 0.0_wp
      call slopes%evaluate(system, nothing, y, change, none, status)
      if (status /= 0) return
      associate (n => frame%n_rate, m => system%n - system%n_quadrature)
         call system%to_local(y, change(:m), acceleration(:size(slope)))
         call system%to_local(y, y(:m), speed(:size(slope)))
         others = 0.0_wp
         call slopes%along(system, nothing, frame, speed(n + 1:2*n), acceleration(n + 1:2*n), others, slope, outputs, status)
         if (status /= 0) return
         call system%linkage%set_motion(0.0_wp, y)
         u = matmul(slope(n + 1:2*n) + frame%turned(system, acceleration(n + 1:2*n)), frame%reading)
         call solve_stiffness(model, u, status)
         if (status /= 0) return
         call frame%to_state(system, y, 0.0_wp*speed(:n), matmul(frame%direction(:, :frame%n_free), u), change)
      end associate
      start = start + change
   end subroutine still_rates

   !> Solve A21 x = -b with the minimum x.
   subroutine solve_stiffness(model, b, status)
      type(linear_model_t), intent(in) :: model         !! the matrices
      real(wp), intent(inout) :: b(:)                   !! (freedoms) b, then x [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp), parameter :: same = 1.0e-10_wp          ! singular values that count as zero, over the maximum [1]
      real(wp) :: a(model%n_free, model%n_free), s(model%n_free), x(model%n_free, 1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n, rank

      n = model%n_free
      a = model%a(n + 1:2*n, :n)
      x(:, 1) = -b
      allocate (work(1000 + 100*n + 2*n*n), source=0.0_wp)
      allocate (iwork(100 + 60*n), source=0)
      call dgelsd(n, n, 1, a, n, x, n, s, same, rank, work, size(work), iwork, status)
      b = x(:, 1)
   end subroutine solve_stiffness

   !> A step of Newton's iteration: A21 x = -rest with the minimum x, no longer than allowed, brought onto the constraints.
   subroutine step_along(system, model, part, y, from, status)
      type(mechanism_t), intent(inout) :: system        !! the system
      type(linear_model_t), intent(in) :: model         !! the matrices where the step starts
      real(wp), intent(in) :: part                      !! of the step [1]
      real(wp), intent(out) :: y(:)                     !! (n) its end [any]
      real(wp), intent(in) :: from(:)                   !! (n) its start [any]
      integer, intent(out) :: status                    !! 0: done

      real(wp) :: change(size(from)), size_of, x(model%n_free)
      real(wp), allocatable :: local(:)

      status = merge(1, 0, model%n_free == 0)
      if (status /= 0) return
      x = model%rest
      call solve_stiffness(model, x, status)
      if (status /= 0) return
      associate (linkage => system%linkage, m => system%n - system%n_quadrature)
         allocate (local(m), source=0.0_wp)
         local(:linkage%n_rate) = matmul(model%direction, x)
         size_of = maxval(abs(local(:linkage%n_rate))/linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n))
         local = local*part*min(1.0_wp, longest/max(size_of, tiny(1.0_wp)))
         change = 0.0_wp
         call system%from_local(from, local(:m - system%traits%n_turning), change(:m))
         y = from + change
         call system%project_state(0.0_wp, y, status)
      end associate
   end subroutine step_along

   !> Give a state the speeds of a steady motion.
   subroutine correct_rates(system, start, axes, omega, y, status)
      type(mechanism_t), intent(inout) :: system        !! the system
      real(wp), intent(in) :: start(:)                  !! (n) state with the speeds of the start [any]
      integer, intent(in) :: axes                       !! body that turns, 0: none
      real(wp), intent(in) :: omega(3)                  !! (3) its speed [rad/s]
      real(wp), intent(inout) :: y(:)                   !! (n) positions; the rates are set [any]
      integer, intent(out) :: status                    !! 0: done

      integer :: body, k

      associate (linkage => system%linkage, coordinates => system%linkage%coordinates, nq => system%linkage%n_position)
         y(nq + 1:nq + linkage%n_rate) = start(nq + 1:nq + linkage%n_rate)
         if (axes > 0) then
            call linkage%set_motion(0.0_wp, y)
            associate (motion => linkage%motion, n_v => linkage%coordinates%n_v)
               do k = 1, linkage%rows%n_unknown
                  body = linkage%rows%unknown(k)
                  if (body /= axes) motion%v(:, body) = motion%v(:, axes) &
                                                        + cross(omega, motion%r(:, body) - motion%r(:, axes))
                  motion%omega(:, body) = omega
                  call read_rates(body, y(nq + n_v*(k - 1) + 1:nq + n_v*k))
               end do
            end associate
         end if
      end associate
      call system%project_state(0.0_wp, y, status)

   contains

      !> Rates of a body from the motion.
      subroutine read_rates(of_body, v)
         integer, intent(in) :: of_body          !! the body
         real(wp), intent(out) :: v(:)           !! (n_v) its rates [any]

         real(wp) :: q(system%linkage%coordinates%n_q)

         if (allocated(system%linkage%motion%spatial%spin)) then
            system%linkage%motion%spatial%spin(:, of_body) = matmul(omega, system%linkage%motion%rot(:, :, of_body))
         end if
         call system%linkage%coordinates%read_motion(system%linkage%motion, of_body, q, v)
      end subroutine read_rates

   end subroutine correct_rates

end module steady_motion
