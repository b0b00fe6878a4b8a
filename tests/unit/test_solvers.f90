!> The two ways of solving the augmented equations against each other and against the equations themselves.
module test_solvers
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: channel_of, channel_pair, nl, slider_crank, start_text, system_of_text
   implicit none (type, external)
   private
   public :: run_test_solvers

   character(*), parameter :: solvers(5) = [character(20) :: "schur", "sparse", "lapack", "complete", "augmented_lagrangian"]
      !! words of the deck

contains

   subroutine run_test_solvers(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("names", test_names)
      call suite%test("equal_results", test_equal_results)
      call suite%test("equations_are_fulfilled", test_equations_are_fulfilled)
      call suite%test("contradicting_rows", test_contradicting_rows)
      call suite%test("redundant_rows", test_redundant_rows)
      call suite%test("no_rows", test_no_rows)
   end subroutine run_test_solvers

   !> The deck's word chooses the solver.
   subroutine test_names(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: words(3) = ["auto  ", "schur ", "lapack"], chosen(3) = ["schur ", "schur ", "lapack"]
      type(mechanism_t) :: system
      integer :: k

      do k = 1, 3
         call system_of_text(slider_crank("solver = "//words(k), "hertz", "none", "ideal"), system, error)
         if (allocated(error)) return
         call check_equal(error, system%linkage%solution%solver%name(), trim(chosen(k)), "solver for "//words(k))
      end do
   end subroutine test_names

   !> A state near the assembled one: violated by up to a millimetre or milliradian, any velocities.
   subroutine disturb(random, y)
      type(random_t), intent(inout) :: random  !! where numbers come from
      real(wp), intent(inout) :: y(:)          !! (18 or more) state of three bodies [any]

      y(1:9) = y(1:9) + random%vector(9, -1.0e-3_wp, 1.0e-3_wp)
      y(10:18) = y(10:18) + random%vector(9, -5.0_wp, 5.0_wp)
   end subroutine disturb

   !> Accelerations and multipliers of both solvers at random states, ideal and with a contact.
   subroutine test_equal_results(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: levels(2) = ["ideal    ", "clearance"]
      type(mechanism_t) :: full, schur
      type(random_t) :: random
      real(wp), allocatable :: start(:), y(:), ydot(:), ydot_full(:)
      integer :: k, level, status(2)

      random%state = 11_i8
      do level = 1, 2
         call start_text(slider_crank("solver = schur", "damped", "rubbing", levels(level)), schur, start, error)
         if (allocated(error)) return
         call start_text(slider_crank("solver = lapack", "damped", "rubbing", levels(level)), full, start, error)
         if (allocated(error)) return
         ydot = start
         ydot_full = start
         if (level == 2) then
            call schur%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
            call full%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
         end if
         do k = 1, 20
            y = start
            call disturb(random, y)
            call schur%evaluate(0.0_wp, y, ydot, status(1))
            call full%evaluate(0.0_wp, y, ydot_full, status(2))
            call check_true(error, all(status == 0), "both solve")
            call check_close(error, ydot(10:18), ydot_full(10:18), 1.0e-12_wp, "accelerations, "//levels(level), relative=.true.)
            call check_close(error, schur%linkage%solution%lambda, full%linkage%solution%lambda, 1.0e-12_wp, &
                             "multipliers, "//levels(level), relative=.true.)
            call check_close(error, ydot(19:), ydot_full(19:), 1.0e-11_wp, "powers, "//levels(level), relative=.true.)
         end do
         call check_equal(error, int(schur%linkage%solution%solver%n_factorisations), 20, "factorisations counted, schur")
         call check_equal(error, int(full%linkage%solution%solver%n_factorisations), 20, "factorisations counted, lapack")
      end do
   end subroutine test_equal_results

   !> M a + Phi_q^T lambda = g and Phi_q a = gamma - 2 alpha Phi' - beta^2 Phi, row by row.
   subroutine test_equations_are_fulfilled(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: words(2) = ["schur ", "lapack"]
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: y(:), ydot(:)
      real(wp) :: left(3, 3), mass(3, 3), right, row_left
      integer :: body, row, side, solver, status

      random%state = 12_i8
      do solver = 1, 2
         call start_text(slider_crank("stabilise = baumgarte"//nl//"solver = "//words(solver), "damped", "none", "ideal"), &
                         system, y, error)
         if (allocated(error)) return
         ydot = y
         call disturb(random, y)
         call system%evaluate(0.0_wp, y, ydot, status)
         call check_equal(error, status, 0, "status")
         associate (a => reshape(ydot(10:18), [3, 3]), v => reshape(y(10:18), [3, 3]))
            mass(1:2, :) = spread([0.30_wp, 0.21_wp, 0.14_wp], 1, 2)
            mass(3, :) = [1.0e-4_wp, 2.5e-4_wp, 1.0e-4_wp]
            left = mass*a
            left(2, :) = left(2, :) + 9.81_wp*mass(1, :)
            do row = 1, system%linkage%rows%n
               row_left = 0.0_wp
               right = system%linkage%rows%phi_t(row)
               do side = 1, 2
                  body = system%linkage%rows%body(side, row)
                  if (body == 0) cycle
                  associate (jac => system%linkage%rows%jac(3*side - 2:3*side, row))
                     left(:, body) = left(:, body) + jac*system%linkage%solution%lambda(row)
                     row_left = row_left + dot_product(jac, a(:, body))
                     right = right + dot_product(jac, v(:, body))
                  end associate
               end do
               ! Baumgarte's default gains are 5 per second
               right = system%linkage%rows%gam(row) - 10.0_wp*right - 25.0_wp*system%linkage%rows%phi(row)
               call check_close(error, row_left, right, 1.0e-12_wp*maxval(abs(a)), "row of "//system%linkage%row_name(row))
            end do
            call check_close(error, reshape(left, [9]), spread(0.0_wp, 1, 9), &
                             1.0e-12_wp*maxval(abs(system%linkage%solution%lambda)), &
                             "equations of motion, "//words(solver))
         end associate
      end do
   end subroutine test_equations_are_fulfilled

   !> A body held by two pins, away from where both fit: the rows contradict one another, and one of them is named.
   subroutine test_contradicting_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:), ydot(:)
      integer :: k, solver, status

      do solver = 1, size(solvers)
         call start_text(two_pins(trim(solvers(solver))), system, y, error)
         if (allocated(error)) return
         deallocate (y)
         allocate (y(system%n), ydot(system%n), source=0.0_wp)
         do k = 1, 20
            y(3) = 0.3_wp*k
            call system%evaluate(0.0_wp, y, ydot, status)
            call check_equal(error, status, 1, "status of "//trim(solvers(solver)))
            call check_true(error, system%linkage%solution%bad_row > 0 .and. system%linkage%solution%bad_row <= 4, &
                            "a row is named by "//trim(solvers(solver)))
         end do
         deallocate (y, ydot)
      end do
   end subroutine test_contradicting_rows

   !> The same where both pins fit: one row is redundant. The body stays at rest; the pins carry its weight, the part of the
   !> forces along the line between them, which nothing determines, in halves (least norm).
   subroutine test_redundant_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:), ydot(:)
      integer :: solver

      do solver = 1, size(solvers)
         call start_text(two_pins(trim(solvers(solver))), system, y, error)
         if (allocated(error)) return
         call check_true(error, system%linkage%solution%is_redundant, "known to be redundant")
         ydot = y
         call check_close(error, channel_pair(system, 0.0_wp, y, "bob", "acceleration"), [0.0_wp, 0.0_wp], 1.0e-12_wp, &
                          "acceleration by "//trim(solvers(solver)))
         call check_close(error, channel_of(system, 0.0_wp, y, "bob", "angular_acceleration"), 0.0_wp, 1.0e-12_wp, &
                          "angular acceleration by "//trim(solvers(solver)))
         ! weights of 20 N at a third of the way between the pins, along x a metre apart
         call check_close(error, channel_pair(system, 0.0_wp, y, "first", "force"), [0.0_wp, -40.0_wp/3.0_wp], 1.0e-8_wp, &
                          "first pin by "//trim(solvers(solver)))
         call check_close(error, channel_pair(system, 0.0_wp, y, "second", "force"), [0.0_wp, -20.0_wp/3.0_wp], 1.0e-8_wp, &
                          "second pin by "//trim(solvers(solver)))
      end do
   end subroutine test_redundant_rows

   !> A body of 2 kg on two pins a metre apart, its centre of mass a third of the way between them.
   function two_pins(solver) result(deck)
      character(*), intent(in) :: solver         !! word for the solver
      character(:), allocatable :: deck          !! the deck

      deck = "[scene]"//nl//"gravity = 0 -10 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bob 2 0.05 {1 m/3} 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"nail ground 1 0"//nl// &
             "eye bob {-1 m/3} 0"//nl//"toe bob {2 m/3} 0"//nl// &
             "[joint.revolute]"//nl//"name i j"//nl//"first hook eye"//nl//"second nail toe"//nl// &
             "[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte"//nl//"solver = "//solver
   end function two_pins

   !> Without joints a body just falls, by either solver.
   subroutine test_no_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: words(2) = ["schur ", "lapack"]
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:), ydot(:)
      integer :: solver, status

      do solver = 1, 2
         call start_text("[scene]"//nl//"gravity = 3 -9 m/s^2"//nl// &
                         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] omega[rad/s]"//nl// &
                         "stone 2 0.05 0.4 0.1 1.5 7"//nl// &
                         "[analysis.dynamic]"//nl//"end = 1 s"//nl//"solver = "//words(solver), system, y, error)
         if (allocated(error)) return
         ydot = y
         call system%evaluate(0.0_wp, y, ydot, status)
         call check_equal(error, status, 0, "status of "//words(solver))
         call check_close(error, ydot(1:6), [1.5_wp, 0.0_wp, 7.0_wp, 3.0_wp, -9.0_wp, 0.0_wp], 1.0e-15_wp, &
                          "derivative by "//words(solver), relative=.true.)
      end do
   end subroutine test_no_rows

end module test_solvers
