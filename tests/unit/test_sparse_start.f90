!> The sparse start against the dense one: the same positions, velocities and dependent rows.
module test_sparse_start
   use assembly_report, only: assembly_t
   use build_system, only: levels_ideal, new_system
   use check, only: check_close, check_equal, check_true, suite_t
   use consistent_start, only: assemble
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use dependent_rows, only: choose_dependent
   use diagnostics, only: diagnostics_t
   use envelope, only: envelope_t, factorise_semidefinite, new_envelope, solve_factored, vanishing_vector
   use errors, only: error_t, exit_assembly
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use read_scene, only: scene_from_deck
   use row_corrections, only: evaluate_rows
   use scene, only: scene_t
   use scene_fixture, only: nl, read_scene_text
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: run_test_sparse_start

contains

   subroutine run_test_sparse_start(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("semidefinite_factors", test_semidefinite_factors)
      call suite%test("dense_and_sparse", test_dense_and_sparse)
      call suite%test("redundant_rows", test_redundant_rows)
      call suite%test("given_velocities", test_given_velocities)
      call suite%test("open_loop", test_open_loop)
      call suite%test("contradictory_speeds", test_contradictory_speeds)
   end subroutine run_test_sparse_start

   !> A = B B^T of low rank: as many rows set aside as the rank lacks, combinations that vanish, consistent equations solved.
   subroutine test_semidefinite_factors(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 12
      type(envelope_t) :: matrix
      type(random_t) :: random
      logical :: is_dependent(n)
      real(wp) :: b(n, n), full(n, n), x(n), z(n)
      integer :: i, j, lowest, rank, trial

      random%state = 71_i8
      do trial = 1, 20
         rank = 4 + modulo(trial, 8)
         b = 0.0_wp
         do j = 1, rank
            do i = 1, n
               b(i, j) = random%between(-1.0_wp, 1.0_wp)
            end do
         end do
         b(7, :) = 2.0_wp*b(3, :)  ! a row that depends on one earlier row only
         full = matmul(b, transpose(b))
         call new_envelope(spread(1, 1, n), matrix)
         do i = 1, n
            matrix%a(matrix%start(i) + 1:matrix%start(i) + i) = full(i, 1:i)
         end do
         call factorise_semidefinite(1.0e-11_wp, matrix, is_dependent)
         call check_equal(error, count(.not. is_dependent), rank, "rank in trial "//to_text(trial))
         call check_true(error, is_dependent(7), "the doubled row is set aside")
         x = matmul(full, [(real(i, wp), i=1, n)])
         call solve_factored(n, size(matrix%a), matrix%first, matrix%start, matrix%a, x)
         call check_close(error, matmul(full, x), matmul(full, [(real(i, wp), i=1, n)]), 1.0e-9_wp, "consistent equations")
         do j = 1, n
            if (.not. is_dependent(j)) cycle
            z = 0.0_wp
            call vanishing_vector(matrix, j, 1.0e-12_wp, z, lowest)
            call check_close(error, matmul(full, z), 0.0_wp*z, 1.0e-9_wp, "combination of row "//to_text(j))
            if (j == 7) call check_close(error, z(3), -2.0_wp, 1.0e-9_wp, "multiple of the row that it doubles")
         end do
      end do
   end subroutine test_semidefinite_factors

   !> Read a deck of the project.
   subroutine read_file(path, scene, error)
      character(*), intent(in) :: path                    !! of the deck
      type(scene_t), intent(out) :: scene                 !! what it means
      type(error_t), allocatable, intent(inout) :: error  !! an error

      type(deck_t) :: deck
      type(diagnostics_t) :: mistakes
      type(text_t) :: none(0)

      call read_deck(path, none, deck, mistakes)
      if (mistakes%count() == 0) call scene_from_deck(deck, scene, mistakes)
      call mistakes%to_error(deck%sources, error)
   end subroutine read_file

   !> Assemble a scene by both, its bodies moved by a random part of the size of the bodies, and compare all.
   subroutine compare(name, scene, disturbance, n_dependent, error)
      character(*), intent(in) :: name                    !! of the scene
      type(scene_t), intent(in) :: scene                  !! the scene
      real(wp), intent(in) :: disturbance                 !! of the start, in sizes of the bodies and radians [1]
      integer, intent(in) :: n_dependent                  !! dependent rows expected
      type(error_t), allocatable, intent(inout) :: error  !! what differs

      type(assembly_t) :: dense, sparse
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: q(:), q_sparse(:), v(:), v_sparse(:)
      integer :: k

      if (allocated(error)) return
      call new_system(scene, levels_ideal, system, is_for_start=.true.)
      call system%linkage%deck_state(q, v)
      random%state = 17_i8
      do k = 1, size(q)
         q(k) = q(k) + disturbance*random%between(-1.0_wp, 1.0_wp)*merge(1.0_wp, system%linkage%scales%length, modulo(k, 3) == 0)
      end do
      q_sparse = q
      v_sparse = v
      call assemble(system%linkage, q, v, dense, error, is_sparse=.false.)
      if (allocated(error)) return
      call assemble(system%linkage, q_sparse, v_sparse, sparse, error, is_sparse=.true.)
      if (allocated(error)) return
      call check_close(error, q_sparse/maxval(abs(q)), q/maxval(abs(q)), 1.0e-9_wp, name//": positions")
      call check_close(error, v_sparse/max(1.0_wp, maxval(abs(v))), v/max(1.0_wp, maxval(abs(v))), 1.0e-9_wp, name//": velocities")
      call check_close(error, sparse%residual, 0.0_wp, 1.0e-12_wp, name//": violation")
      call evaluate_rows(system%linkage, 0.0_wp, q, v)
      call choose_dependent(system%linkage, dense, is_sparse=.false.)
      call choose_dependent(system%linkage, sparse, is_sparse=.true.)
      call check_equal(error, size(dense%dependent), n_dependent, name//": dependent rows, dense")
      call check_equal(error, size(sparse%dependent), n_dependent, name//": dependent rows, sparse")
      call check_equal(error, sparse%rank, dense%rank, name//": rank")
      call check_equal(error, size(sparse%shared), size(dense%shared), name//": shared rows")
      if (allocated(error)) return
      call check_true(error, all(sparse%shared == dense%shared), name//": the same rows are shared")
      do k = 1, size(sparse%dependent)
         call check_true(error, any(sparse%shared == sparse%dependent(k)), name//": a dependent row is shared")
      end do
   end subroutine compare

   !> Scenes without redundant rows, disturbed by a hundredth of their size.
   subroutine test_dense_and_sparse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(scene_t) :: scene
      character(*), parameter :: decks(10) = [character(32) :: "four_bar", "slider_crank_dry", "quick_return", "valve_train", &
                                              "hanging_chain", "hard/a01_simple_pendulum", "hard/a02_four_bars_10", &
                                              "hard/a03_andrews_squeezer", "hard/light_coupler", "hard/wrong_velocities"]
      integer :: k

      do k = 1, size(decks)
         call read_file("inputs/"//trim(decks(k))//".deck", scene, error)
         call compare(trim(decks(k)), scene, 1.0e-2_wp, 0, error)
      end do
   end subroutine test_dense_and_sparse

   !> Scenes with redundant rows: both find as many, and the same rows share the load. Disturbed, they contradict each other to
   !> second order. The bars of the overdetermined four-bar must stay parallel to the thresholds of both, which differ.
   subroutine test_redundant_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(scene_t) :: scene

      call read_file("inputs/hard/h_frame.deck", scene, error)
      call compare("H-frame", scene, 1.0e-7_wp, 2, error)
      call read_file("inputs/hard/three_pins.deck", scene, error)
      call compare("three pins", scene, 1.0e-7_wp, 4, error)
      call read_file("inputs/hard/duplicated_joints.deck", scene, error)
      call compare("duplicated joints", scene, 1.0e-7_wp, 2, error)
      call read_file("inputs/hard/overdetermined_four_bar.deck", scene, error)
      call compare("overdetermined four-bar", scene, 1.0e-10_wp, 1, error)
   end subroutine test_redundant_rows

   !> Two rods in a row, of which the deck gives some velocities.
   function two_rods(first, second, more) result(deck)
      character(*), intent(in) :: first      !! cells vx, vy, omega of the first
      character(*), intent(in) :: second     !! the same of the second
      character(*), intent(in) :: more       !! more tables
      character(:), allocatable :: deck      !! the deck

      deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg] vx[m/s] vy[m/s] omega[rad/s]"//nl// &
             "a 1 0.1 0.5 0 0 "//first//nl//"b 1 0.1 1.5 0 0 "//second//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"o ground 0 0"//nl//"a0 a -0.5 0"//nl//"a1 a 0.5 0"//nl// &
             "b0 b -0.5 0"//nl//"b1 b 0.5 0"//nl//"e ground 1.2 1.6"//nl// &
             "[joint.revolute]"//nl//"name i j"//nl//"pin o a0"//nl//"elbow a1 b0"//nl//more//nl// &
             "[analysis.dynamic]"//nl//"end = 1 s"//nl//"[output]"//nl//"every = 1 s"
   end function two_rods

   !> Velocities omitted give way to a given one: the rod of 1 m that turns at 3 rad/s moves its middle at 1.5 m/s.
   subroutine test_given_velocities(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      type(scene_t) :: scene
      real(wp), allocatable :: q(:), v(:)

      call read_scene_text(two_rods("- - 3", "- - -", ""), scene, error)
      call compare("two rods", scene, 0.0_wp, 0, error)
      if (allocated(error)) return
      call new_system(scene, levels_ideal, system, is_for_start=.true.)
      call system%linkage%deck_state(q, v)
      call assemble(system%linkage, q, v, report, error, is_sparse=.true.)
      if (allocated(error)) return
      call check_close(error, v(1:3), [0.0_wp, 1.5_wp, 3.0_wp], 1.0e-7_wp, "velocities of the first rod")
      ! of the second only its point at 3 m/s is reported: the minimum rates are those of a free rod that is hit there,
      ! in sizes of half a metre: v = 3/(1 + 1) = 1.5 and omega = -(3 - 1.5)/0.5 = -3
      call check_close(error, v(4:6), [0.0_wp, 1.5_wp, -3.0_wp], 1.0e-6_wp, "velocities of the second rod")
   end subroutine test_given_velocities

   !> A loop that cannot close is refused by both, by the same joint.
   subroutine test_open_loop(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call refused_by_both(two_rods("- - -", "- - -", "far b1 e2"//nl//"[points]"//nl//"name body xi[m] eta[m]"//nl// &
                                    "e2 ground 3 4"), "cannot be assembled", error)
   end subroutine test_open_loop

   !> Two speeds that contradict each other are refused by both.
   subroutine test_contradictory_speeds(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call refused_by_both(two_rods("- - -", "- - -", "[initial.speed]"//nl//"name joint speed[rad/s]"//nl//"one pin 1"//nl// &
                                    "other pin 2"), "no velocities satisfy", error)
   end subroutine test_contradictory_speeds

   !> Neither way finds a start, and both say why.
   subroutine refused_by_both(deck, words, error)
      character(*), intent(in) :: deck                  !! the deck
      character(*), intent(in) :: words                 !! of the message
      type(error_t), allocatable, intent(inout) :: error  !! what failed

      type(assembly_t) :: report
      type(error_t), allocatable :: refusal
      type(mechanism_t) :: system
      type(scene_t) :: scene
      real(wp), allocatable :: q(:), v(:)
      integer :: k

      call read_scene_text(deck, scene, error)
      if (allocated(error)) return
      do k = 1, 2
         call new_system(scene, levels_ideal, system, is_for_start=.true.)
         call system%linkage%deck_state(q, v)
         call assemble(system%linkage, q, v, report, refusal, is_sparse=k == 2)
         call check_true(error, allocated(refusal), "refused")
         if (allocated(error)) return
         call check_equal(error, refusal%code, exit_assembly, "exit code")
         call check_true(error, index(refusal%message, words) > 0, "message: "//refusal%message)
      end do
   end subroutine refused_by_both

end module test_sparse_start
