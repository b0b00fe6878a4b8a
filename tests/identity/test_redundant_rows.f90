!> Redundant mechanisms against reference runs without redundant rows, by every way of solving the augmented equations that is
!> registered.
module test_redundant_rows
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, start_text
   use solver_checks, only: body_head, check_equations, point_head, second, use_solver, weight
   use solver_registry, only: n_solver_kinds, new_solver
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_redundant_rows

contains

   subroutine run_test_redundant_rows(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("duplicated_joint", test_duplicated_joint)
      call suite%test("overdetermined_four_bar", test_overdetermined_four_bar)
      call suite%test("three_pins", test_three_pins)
      call suite%test("frame_on_rails", test_frame)
   end subroutine run_test_redundant_rows

   !> A redundant mechanism and its reference run with the same bodies at their common start: accelerations by every solver.
   subroutine check_twins(redundant, twin, what, error)
      character(*), intent(in) :: redundant               !! the deck
      character(*), intent(in) :: twin                    !! the deck without redundant rows
      character(*), intent(in) :: what                    !! which scene
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      type(mechanism_t) :: system, unique
      real(wp), allocatable :: start(:), y(:), ydot(:), ydot_twin(:)
      integer :: k, n, status

      if (allocated(error)) return
      call start_text(redundant, system, y, error)
      if (.not. allocated(error)) call start_text(twin, unique, start, error)
      if (allocated(error)) return
      call check_true(error, system%linkage%solution%is_redundant, what//" is known to be redundant")
      call check_true(error, .not. unique%linkage%solution%is_redundant, "the twin of "//what//" is not")
      call check_close(error, start, y, 1.0e-10_wp, "start of the twin of "//what)
      n = system%n_position
      allocate (ydot(system%n), ydot_twin(unique%n), source=0.0_wp)
      call use_solver(unique, "complete")
      call unique%evaluate(0.0_wp, y, ydot_twin, status)
      call check_equal(error, status, 0, "twin of "//what)
      do k = 1, n_solver_kinds()
         call new_solver(k, system%linkage%solution%solver)
         call system%linkage%solution%solver%prepare(system%linkage%bodies%n, system%linkage%rows)
         call system%evaluate(0.0_wp, y, ydot, status)
         call check_equal(error, status, 0, what//" by "//system%linkage%solution%solver%name())
         call check_close(error, ydot(n + 1:2*n), ydot_twin(n + 1:2*n), 1.0e-10_wp, what//": accelerations by "// &
                          system%linkage%solution%solver%name(), relative=.true.)
         call check_equations(system, what//" by "//system%linkage%solution%solver%name(), error)
      end do
   end subroutine check_twins

   !> A swinging rod on one pin, and on the same pin given twice or three times: equal shares.
   subroutine test_duplicated_joint(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: rod = weight//body_head//"rod 1.5 0.1 {0.5m*cos(0.4)} {0.5m*sin(0.4)} 0.4 3"//nl// &
                                 point_head//"wall ground 0 0"//nl//"eye rod -0.5 0"//nl// &
                                 "[joint.revolute]"//nl//"name i j"//nl//"pin wall eye"//nl
      type(mechanism_t) :: one, many
      real(wp), allocatable :: start(:), y(:), ydot(:)
      character(:), allocatable :: deck
      integer :: copies, i, k, status

      call start_text(rod//second, one, start, error)
      if (allocated(error)) return
      ydot = start
      call one%evaluate(0.0_wp, start, ydot, status)
      deck = rod
      do copies = 2, 3
         deck = deck//"again_"//to_text(copies)//" wall eye"//nl
         call check_twins(deck//second, rod//second, "pin given "//to_text(copies)//" times", error)
         if (allocated(error)) return
         call start_text(deck//second, many, y, error)
         if (allocated(error)) return
         do k = 1, n_solver_kinds()
            call new_solver(k, many%linkage%solution%solver)
            call many%linkage%solution%solver%prepare(many%linkage%bodies%n, many%linkage%rows)
            call many%evaluate(0.0_wp, start, ydot, status)
            do i = 1, copies
               call check_close(error, many%linkage%solution%lambda(2*i - 1:2*i), one%linkage%solution%lambda/copies, &
                                1.0e-7_wp, "share of pin "//to_text(i)// &
                                " of "//to_text(copies)//" by "//many%linkage%solution%solver%name(), relative=.true.)
            end do
         end do
      end do
   end subroutine test_duplicated_joint

   !> A parallel four-bar with a third bar. In the reference run the third bar meets the coupler by a slot along itself: what its
   !> pin fixes along the bar is fixed already.
   subroutine test_overdetermined_four_bar(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: four_bar = weight//body_head// &
         "bar_1 1 0.0033 {0.1m*sin(1.0)} {-0.1m*cos(1.0)} {1 rad - 90 deg} 2"//nl// &
         "bar_2 1.2 0.0035 {0.15m + 0.1m*sin(1.0)} {-0.1m*cos(1.0)} {1 rad - 90 deg} 2"//nl// &
         "bar_3 0.9 0.0031 {0.3m + 0.1m*sin(1.0)} {-0.1m*cos(1.0)} {1 rad - 90 deg} 2"//nl// &
         "coupler 2 0.015 {0.15m + 0.2m*sin(1.0)} {-0.2m*cos(1.0)} 0 0"//nl// &
         point_head//"wall_1 ground 0 0"//nl//"wall_2 ground 0.15 0"//nl//"wall_3 ground 0.3 0"//nl// &
         "bar_1_a bar_1 -0.1 0"//nl//"bar_1_b bar_1 0.1 0"//nl//"bar_2_a bar_2 -0.1 0"//nl//"bar_2_b bar_2 0.1 0"//nl// &
         "bar_3_a bar_3 -0.1 0"//nl//"bar_3_b bar_3 0.1 0"//nl// &
         "left coupler -0.15 0"//nl//"middle coupler 0 0"//nl//"right coupler 0.15 0"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"top_1 wall_1 bar_1_a"//nl//"top_2 wall_2 bar_2_a"//nl// &
         "top_3 wall_3 bar_3_a"//nl//"low_1 bar_1_b left"//nl//"low_3 bar_3_b right"//nl

      call check_twins(four_bar//"low_2 bar_2_b middle"//nl//second, &
                       four_bar//"[joint.pin_in_slot]"//nl//"name i j axis"//nl//"low_2 bar_2_b middle x"//nl//second, &
                       "overdetermined four-bar", error)
   end subroutine test_overdetermined_four_bar

   !> A bar on three pins along one line of a swinging rod; in the reference run it is welded on.
   subroutine test_three_pins(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: bars = weight//body_head//"rod 1 0.083 0.5 0 0 4"//nl//"bar 2 0.027 0.7 0 0 4"//nl// &
         point_head//"wall ground 0 0"//nl//"eye rod -0.5 0"//nl//"rod_1 rod 0.05 0"//nl//"rod_2 rod 0.2 0"//nl// &
         "rod_3 rod 0.35 0"//nl//"bar_1 bar -0.15 0"//nl//"bar_2 bar 0 0"//nl//"bar_3 bar 0.15 0"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"pin wall eye"//nl

      call check_twins(bars//"first rod_1 bar_1"//nl//"second rod_2 bar_2"//nl//"third rod_3 bar_3"//nl//second, &
                       bars//"[joint.rigid]"//nl//"name i j"//nl//"weld rod_2 bar_2"//nl//second, "three pins", error)
   end subroutine test_three_pins

   !> A frame that slides on two parallel rails, driven aside; the reference run slides on one.
   subroutine test_frame(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: frame = weight//body_head//"left 0.5 1e-3 0 0 0 0"//nl//"beam 2 0.05 0 0.5 {90 deg} 0"//nl// &
         "right 0.7 1e-3 0 1 0 0"//nl// &
         point_head//"rail_0 ground 0 0"//nl//"rail_1 ground 0 1"//nl//"left_mid left 0 0"//nl//"right_mid right 0 0"//nl// &
         "beam_0 beam -0.5 0"//nl//"beam_1 beam 0.5 0"//nl//"grip beam 0.2 0"//nl// &
         "[joint.rigid]"//nl//"name i j"//nl//"weld_0 left_mid beam_0"//nl//"weld_1 beam_1 right_mid"//nl// &
         "[force.point]"//nl//"name point fx[N]"//nl//"push grip 8"//nl// &
         "[joint.translational]"//nl//"name i j axis"//nl//"lower rail_0 left_mid x"//nl

      call check_twins(frame//"upper rail_1 right_mid x"//nl//second, frame//second, "frame on two rails", error)
   end subroutine test_frame

end module test_redundant_rows
