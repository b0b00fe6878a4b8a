!> Every way of solving the augmented equations that is registered: the equations themselves, full pivoting as the reference,
!> bodies that are solved in closed form, and redundant mechanisms against twins without redundant rows.
module test_augmented
   use augmented, only: augmented_t
   use augmented_schur, only: augmented_schur_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_file, loaded_t
   use columns, only: column_of
   use errors, only: error_t
   use fixed_random, only: random_t
   use hold, only: hold_t
   use hold_registry, only: n_hold_kinds, new_hold
   use item, only: option_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, slider_crank, start_text
   use section_info, only: dynamic_info, word_options
   use solver_registry, only: n_solver_kinds, new_solver
   use text, only: replace, to_text
   implicit none (type, external)
   private
   public :: run_test_augmented

   character(*), parameter :: body_head = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl
   character(*), parameter :: point_head = "[points]"//nl//"name body xi[m] eta[m]"//nl
   character(*), parameter :: weight = "[scene]"//nl//"gravity = 0.5 -9.81 m/s^2"//nl
   character(*), parameter :: second = "[analysis.dynamic]"//nl//"end = 1 s"//nl//"coordinates = full"//nl// &
                                        "stabilise = baumgarte"//nl

contains

   subroutine run_test_augmented(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("words_of_the_registries", test_words)
      call suite%test("options_of_the_ways", test_options)
      call suite%test("slider_crank", test_slider_crank)
      call suite%test("decks", test_decks)
      call suite%test("chain", test_chain)
      call suite%test("star", test_star)
      call suite%test("lone_bodies", test_lone_bodies)
      call suite%test("duplicated_joint", test_duplicated_joint)
      call suite%test("overdetermined_four_bar", test_overdetermined_four_bar)
      call suite%test("three_pins", test_three_pins)
      call suite%test("frame_on_rails", test_frame)
   end subroutine run_test_augmented

   !> What a deck may say is what is registered, and `auto`.
   subroutine test_words(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kind_info_t) :: info

      info = dynamic_info()
      call check_equal(error, info%columns(column_of(info, "solver"))%choices, &
                       "auto schur sparse lapack complete augmented_lagrangian", "words for the solver")
      call check_equal(error, info%columns(column_of(info, "stabilise"))%choices, "auto none baumgarte baumgarte_step "// &
                       "baumgarte_adaptive partitioning augmented_lagrangian projection", "words for the way of holding")
   end subroutine test_words

   !> An option that a deck may give changes what a way says of itself; any other leaves it as it is.
   subroutine test_options(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(6) = [character(7) :: "alpha", "beta", "target", "penalty", "omega", "mu"]
      class(hold_t), allocatable :: set, unset
      type(kind_info_t) :: info
      type(option_t) :: option
      character(:), allocatable :: all_names
      integer :: c, i, k

      all_names = ""
      do i = 1, size(names)
         all_names = trim(all_names//" "//names(i))
      end do
      info = dynamic_info()
      call check_equal(error, " "//info%columns(column_of(info, "stabilise"))%options, all_names, "options of the key")
      option%number = 0.1234_wp
      do k = 1, n_hold_kinds
         do i = 1, size(names)
            option%name = trim(names(i))
            call new_hold(k, set)
            call new_hold(k, unset)
            call unset%configure([option_t ::], 1.0e-8_wp)
            call set%configure([option], 1.0e-8_wp)
            info = word_options("stabilise", set%name())
            call check_true(error, (set%words() == unset%words()) .neqv. &
                            any([(info%columns(c)%name == option%name, c=1, size(info%columns))]), &
                            "option "//option%name//" of "//set%name()//" is taken if it is documented")
         end do
      end do
   end subroutine test_options

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
      do k = 1, n_solver_kinds
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

      do k = 1, n_solver_kinds
         call new_solver(k, system%linkage%solution%solver)
         if (system%linkage%solution%solver%name() == name) exit
      end do
      call system%linkage%solution%solver%prepare(system%linkage%bodies%n, system%linkage%rows)
   end subroutine use_solver

   !> M a + Phi_q^T lambda = g of the unknown bodies, Phi_q a = b of the solved rows, in parts of the greatest terms and of
   !> what the loads alone would do.
   subroutine check_equations(system, what, error)
      type(mechanism_t), intent(in) :: system         !! the system, evaluated
      character(*), intent(in) :: what                    !! scene and solver
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp) :: bodies(3, 0:system%linkage%bodies%n), greatest(2), row_left
      integer :: body, row, side

      if (allocated(error)) return
      bodies(:, 0) = 0.0_wp
      do body = 1, system%linkage%bodies%n
         bodies(:, body) = system%linkage%mass(:, body)*system%linkage%solution%a(:, body) - system%loading%g(:, body)
      end do
      greatest = [maxval(abs(system%loading%g)), max(maxval(abs(system%linkage%solution%b)), &
                                                     maxval(abs(system%loading%g*system%linkage%inverse_mass)))]
      do row = 1, system%linkage%rows%n_solve
         row_left = -system%linkage%solution%b(row)
         do side = 1, 2
            body = system%linkage%rows%body(side, row)
            if (body == 0) cycle
            associate (jac => system%linkage%rows%jac(3*side - 2:3*side, row))
               bodies(:, body) = bodies(:, body) + jac*system%linkage%solution%lambda(row)
               greatest(1) = max(greatest(1), maxval(abs(jac*system%linkage%solution%lambda(row))))
               if (.not. any(system%linkage%rows%unknown == body)) cycle
               row_left = row_left + dot_product(jac, system%linkage%solution%a(:, body))
               greatest(2) = max(greatest(2), maxval(abs(jac*system%linkage%solution%a(:, body))))
            end associate
         end do
         call check_close(error, row_left, 0.0_wp, 1.0e-10_wp*greatest(2), what//": row of "//system%linkage%row_name(row))
      end do
      do body = 1, system%linkage%bodies%n
         if (.not. any(system%linkage%rows%unknown == body)) cycle
         call check_close(error, bodies(:, body), spread(0.0_wp, 1, 3), 1.0e-10_wp*greatest(1), what//": motion of "// &
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

   !> Ideal and loose, the crank unknown and known.
   subroutine test_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_text(slider_crank("", "damped", "none", "ideal"), "ideal", error)
      call check_text(slider_crank("", "damped", "none", "clearance"), "loose", error)
      call check_text(replace(slider_crank("", "damped", "none", "ideal"), "= full", "= fewest"), "ideal, known crank", error)
      call check_text(replace(slider_crank("", "damped", "none", "clearance"), "= full", "= fewest"), "loose, known crank", error)
   end subroutine test_slider_crank

   !> Decks that the program comes with: a free loop, slots and distances, springs and drivers of positions.
   subroutine test_decks(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: decks(5) = [character(30) :: "four_bar", "quick_return", "valve_train", "hanging_chain", &
                                             "hard/a03_andrews_squeezer"]
      integer :: k

      do k = 1, size(decks)
         call check_deck("inputs/"//trim(decks(k))//".deck")
      end do

   contains

      !> One deck.
      subroutine check_deck(path)
         character(*), intent(in) :: path  !! from the project's directory

         type(loaded_t) :: loaded

         if (allocated(error)) return
         call load_file(path, loaded, error)
         if (.not. allocated(error)) call check_at_random(loaded%system, loaded%y, path, error)
      end subroutine check_deck

   end subroutine test_decks

   !> A chain of bodies between the ground and its last one, listed and jointed in mixed order, masses of all sizes.
   subroutine test_chain(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 12
      integer, parameter :: order(n) = [7, 2, 11, 4, 9, 1, 12, 6, 3, 10, 5, 8]
      character(:), allocatable :: bodies, joints, points
      integer :: k, m

      bodies = body_head
      points = point_head//"peg_0 ground 0 0"//nl
      joints = "[joint.revolute]"//nl//"name i j"//nl
      do k = 1, n
         m = order(k)
         bodies = bodies//"link_"//to_text(m)//" "//to_text(0.3_wp*m)//" "//to_text(0.02_wp/m)//" "//to_text(m - 0.5_wp)// &
                  " 0 0 0"//nl
         points = points//"tail_"//to_text(m)//" link_"//to_text(m)//" -0.5 0"//nl// &
                  "peg_"//to_text(m)//" link_"//to_text(m)//" 0.5 0"//nl
      end do
      do k = n, 1, -1
         m = modulo(5*k, n + 1)
         joints = joints//"pin_"//to_text(m)//" peg_"//to_text(m - 1)//" tail_"//to_text(m)//nl
      end do
      call check_text(weight//bodies//points//joints//second, "chain", error)
   end subroutine test_chain

   !> Six bodies on one: the sixth of them a star itself, all of it free to fly.
   subroutine test_star(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(:), allocatable :: bodies, joints, points
      integer :: k

      bodies = body_head//"hub 2 0.1 0 0 0 1"//nl//"twig 0.1 0.001 0 2 0.4 0"//nl
      points = point_head//"fork arm_6 0.2 0.3"//nl//"knot twig -0.1 0"//nl
      joints = "[joint.revolute]"//nl//"name i j"//nl//"branch knot fork"//nl
      do k = 1, 6
         bodies = bodies//"arm_"//to_text(k)//" 0.5 0.02 "//to_text(cos(1.0_wp*k))//" "//to_text(sin(1.0_wp*k))//" "// &
                  to_text(k)//" 0"//nl
         points = points//"seat_"//to_text(k)//" hub "//to_text(0.5_wp*cos(1.0_wp*k))//" "//to_text(0.5_wp*sin(1.0_wp*k))//nl// &
                  "heel_"//to_text(k)//" arm_"//to_text(k)//" -0.5 0"//nl
         joints = joints//"pin_"//to_text(k)//" seat_"//to_text(k)//" heel_"//to_text(k)//nl
      end do
      call check_text(weight//bodies//points//joints//second, "free star", error)
      call check_text(weight//bodies//points//"post ground 0.1 0"//nl//"eye hub 0.1 0"//nl//joints//"foot post eye"//nl//second, &
                      "star", error)
   end subroutine test_star

   !> Bodies that hang on the ground or a known body by one row and by two are lone; by three rows, or beside another unknown
   !> body, they are not.
   subroutine test_lone_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = weight//body_head// &
         "crank 1 0.01 0.1 0 0 0"//nl//"one 0.5 0.02 0.4 0.1 0.3 1"//nl//"two 0.7 0.03 0.3 0 0.1 0"//nl// &
         "three 0.6 0.01 1 1 0 0"//nl//"tail 0.2 0.004 2 0 0 0"//nl//"tip 0.3 0.006 2.4 0 0 0"//nl// &
         "free 0.3 0.005 -1 -1 0 2"//nl// &
         point_head//"base ground 0 0"//nl//"hook ground 0.5 0.5"//nl//"nail ground 0.8 1"//nl//"post ground 1.8 0"//nl// &
         "heel crank -0.1 0"//nl//"head crank 0.1 0"//nl//"one_a one 0.1 0.05"//nl//"two_a two -0.1 0"//nl// &
         "three_a three -0.2 0"//nl//"three_b three 0.1 0.1"//nl//"tail_a tail -0.2 0"//nl//"tail_b tail 0.2 0"//nl// &
         "tip_a tip -0.2 0"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"main base heel"//nl//"swing head two_a"//nl//"seat nail three_a"//nl// &
         "low post tail_a"//nl//"high tail_b tip_a"//nl// &
         "[joint.distance]"//nl//"name i j length[m]"//nl//"string one_a hook {sqrt((0.5 - 0.4 - 0.1*cos(0.3) + 0.05*sin(0.3))^2 " &
         //"+ (0.5 - 0.1 - 0.1*sin(0.3) - 0.05*cos(0.3))^2)*1m}"//nl//"stay base three_b {sqrt(1.1^2 + 1.1^2)*1m}"//nl// &
         "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor main 12"//nl//second
      type(mechanism_t) :: system
      real(wp), allocatable :: start(:)

      ! an integrator that wants all constraints leaves the known bodies alone, but guides none
      call start_text(replace(deck, "coordinates = full", "method = ida"), system, start, error)
      if (allocated(error)) return
      call use_solver(system, "schur")
      select type (solver => system%linkage%solution%solver)
      type is (augmented_schur_t)
         call check_equal(error, solver%lone%n(1), 1, "lone bodies with one row")
         call check_equal(error, solver%lone%n(2), 1, "lone bodies with two")
         if (allocated(error)) return
         call check_equal(error, system%linkage%bodies%names(solver%lone%body(1))%s, "one", "the first of them")
         call check_equal(error, system%linkage%bodies%names(solver%lone%body(2))%s, "two", "the second")
         call check_equal(error, size(solver%unknown), 4, "the other unknown bodies")
      class default
         call check_true(error, .false., "the Schur complement is in use")
      end select
      call check_at_random(system, start, "lone bodies", error)
   end subroutine test_lone_bodies

   !> A redundant mechanism and its twin with the same bodies at their common start: accelerations by every solver.
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
      do k = 1, n_solver_kinds
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
         do k = 1, n_solver_kinds
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

   !> A parallel four-bar with a third bar. In the twin the third bar meets the coupler by a slot along itself: what its pin
   !> fixes along the bar is fixed already.
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

   !> A bar on three pins along one line of a swinging rod; in the twin it is welded on.
   subroutine test_three_pins(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: bars = weight//body_head//"rod 1 0.083 0.5 0 0 4"//nl//"bar 2 0.027 0.7 0 0 4"//nl// &
         point_head//"wall ground 0 0"//nl//"eye rod -0.5 0"//nl//"rod_1 rod 0.05 0"//nl//"rod_2 rod 0.2 0"//nl// &
         "rod_3 rod 0.35 0"//nl//"bar_1 bar -0.15 0"//nl//"bar_2 bar 0 0"//nl//"bar_3 bar 0.15 0"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"pin wall eye"//nl

      call check_twins(bars//"first rod_1 bar_1"//nl//"second rod_2 bar_2"//nl//"third rod_3 bar_3"//nl//second, &
                       bars//"[joint.rigid]"//nl//"name i j"//nl//"weld rod_2 bar_2"//nl//second, "three pins", error)
   end subroutine test_three_pins

   !> A frame that slides on two parallel rails, driven aside; the twin slides on one.
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

end module test_augmented
