!> A scene under every way of solving the augmented equations that is registered: the equations themselves, and results by full
!> pivoting as the reference.
module solver_checks
   use check, only: check_close, check_equal
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, start_text
   use solver_registry, only: n_solver_kinds, new_solver
   implicit none (type, external)
   private
   public :: body_head, check_at_random, check_equations, check_text, point_head, second, use_solver, weight

   !> Sections of decks: heads of the tables of bodies and points, gravity, and an analysis that reduces nothing.
   character(*), parameter :: body_head = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl
   character(*), parameter :: point_head = "[points]"//nl//"name body xi[m] eta[m]"//nl
   character(*), parameter :: weight = "[scene]"//nl//"gravity = 0.5 -9.81 m/s^2"//nl
   character(*), parameter :: second = "[analysis.dynamic]"//nl//"end = 1 s"//nl//"coordinates = full"//nl// &
                                        "stabilise = baumgarte"//nl

contains

   !> All solvers at one state: the residuals of both equations and, without redundant rows, the results by full
   !> pivoting.
   subroutine check_solvers(system, t, y, what, error)
      type(mechanism_t), intent(inout) :: system      !! the system; its solver is exchanged
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: y(:)                        !! (n) state [any]
      character(*), intent(in) :: what                    !! which scene
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp) :: lambda(system%linkage%rows%n_solve), reference(system%n), tolerance(2), ydot(system%n)
      integer :: k, n, status

      if (allocated(error)) return
      n = system%n_position
      call use_solver(system, "lapack")
      reference = 0.0_wp
      call system%evaluate(t, y, reference, status)
      call check_equal(error, status, 0, what//", reference")
      lambda = system%linkage%solution%lambda(:system%linkage%rows%n_solve)
      do k = 1, n_solver_kinds()
         call new_solver(k, system%linkage%solution%solver)
         call system%linkage%solution%solver%prepare(system%linkage%bodies%n, system%linkage%rows)
         ydot = 0.0_wp
         call system%evaluate(t, y, ydot, status)
         call check_equal(error, status, 0, what//" by "//system%linkage%solution%solver%name())
         call check_equal(error, int(system%linkage%solution%n_damped), 0, &
                          what//": damped solutions by "//system%linkage%solution%solver%name())
         call check_equations(system, what//" by "//system%linkage%solution%solver%name(), error)
         ! penalties cost digits
         tolerance = [1.0e-10_wp, 1.0e-10_wp]
         if (system%linkage%solution%solver%name() == "augmented_lagrangian") tolerance = [1.0e-9_wp, 1.0e-8_wp]
         call check_close(error, ydot(n + 1:2*n), reference(n + 1:2*n), tolerance(1), what//": accelerations by "// &
                          system%linkage%solution%solver%name(), relative=.true.)
         if (size(lambda) == 0) cycle
         call check_close(error, system%linkage%solution%lambda(:size(lambda)), lambda, tolerance(2), what//": multipliers by "// &
                          system%linkage%solution%solver%name(), relative=.true.)
      end do
   end subroutine check_solvers

   !> Put another solver into a system.
   subroutine use_solver(system, name)
      type(mechanism_t), intent(inout) :: system  !! the system
      character(*), intent(in) :: name                !! word for the solver

      integer :: k

      do k = 1, n_solver_kinds()
         call new_solver(k, system%linkage%solution%solver)
         if (system%linkage%solution%solver%name() == name) exit
      end do
      call system%linkage%solution%solver%prepare(system%linkage%bodies%n, system%linkage%rows)
   end subroutine use_solver

   !> M a + Phi_q^T lambda = g of the unknown bodies, Phi_q a = b of the solved rows, in parts of the maximum terms and of
   !> what the loads alone would do.
   subroutine check_equations(system, what, error)
      type(mechanism_t), intent(in) :: system         !! the system, evaluated
      character(*), intent(in) :: what                    !! scene and solver
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp) :: bodies(3, 0:system%linkage%bodies%n), maximum(2), row_left
      integer :: body, row, side

      if (allocated(error)) return
      bodies(:, 0) = 0.0_wp
      do body = 1, system%linkage%bodies%n
         bodies(:, body) = system%linkage%mass(:, body)*system%linkage%solution%a(:, body) - system%loading%g(:, body)
      end do
      maximum = [maxval(abs(system%loading%g)), max(maxval(abs(system%linkage%solution%b)), &
                                                     maxval(abs(system%loading%g*system%linkage%inverse_mass)))]
      do row = 1, system%linkage%rows%n_solve
         row_left = -system%linkage%solution%b(row)
         do side = 1, 2
            body = system%linkage%rows%body(side, row)
            if (body == 0) cycle
            associate (jac => system%linkage%rows%jac(3*side - 2:3*side, row))
               bodies(:, body) = bodies(:, body) + jac*system%linkage%solution%lambda(row)
               maximum(1) = max(maximum(1), maxval(abs(jac*system%linkage%solution%lambda(row))))
               if (.not. any(system%linkage%rows%unknown == body)) cycle
               row_left = row_left + dot_product(jac, system%linkage%solution%a(:, body))
               maximum(2) = max(maximum(2), maxval(abs(jac*system%linkage%solution%a(:, body))))
            end associate
         end do
         call check_close(error, row_left, 0.0_wp, 1.0e-10_wp*maximum(2), what//": row of "//system%linkage%row_name(row))
      end do
      do body = 1, system%linkage%bodies%n
         if (.not. any(system%linkage%rows%unknown == body)) cycle
         call check_close(error, bodies(:, body), spread(0.0_wp, 1, 3), 1.0e-10_wp*maximum(1), what//": motion of "// &
                          system%linkage%bodies%names(body)%s)
      end do
   end subroutine check_equations

   !> Random states about a start: out of place by up to a thousandth of the size, rates of any kind.
   subroutine check_at_random(system, start, what, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: start(:)                    !! (n) its state at t = 0 [any]
      character(*), intent(in) :: what                    !! which scene
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(random_t) :: random
      real(wp) :: y(size(start))
      integer :: k, n

      if (allocated(error)) return
      random%state = 91_i8
      n = system%n_position
      do k = 1, 10
         y = start
         y(1:n) = y(1:n) + random%vector(n, -1.0e-3_wp, 1.0e-3_wp)*system%linkage%scales%length
         y(n + 1:2*n) = y(n + 1:2*n) + random%vector(n, -4.0_wp, 4.0_wp)
         call check_solvers(system, 0.0_wp, y, what, error)
      end do
   end subroutine check_at_random

   !> A scene given as text.
   subroutine check_text(deck, what, error)
      character(*), intent(in) :: deck                    !! the deck
      character(*), intent(in) :: what                    !! which scene
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(mechanism_t) :: system
      real(wp), allocatable :: start(:)

      if (allocated(error)) return
      call start_text(deck, system, start, error)
      if (.not. allocated(error)) call check_at_random(system, start, what, error)
   end subroutine check_text

end module solver_checks
