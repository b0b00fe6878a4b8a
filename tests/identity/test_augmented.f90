!> Every way of solving the augmented equations that is registered: the equations themselves, full pivoting as the reference,
!> and bodies that are solved in closed form.
module test_augmented
   use augmented_schur, only: augmented_schur_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_file, loaded_t
   use columns, only: column_of
   use errors, only: error_t
   use fixed_random, only: random_t
   use stabilisation, only: stabilisation_t
   use stabilisation_registry, only: n_stabilisation_kinds, new_stabilisation
   use item, only: option_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use linkage, only: linkage_t
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, slider_crank, start_text
   use section_info, only: dynamic_info, word_options
   use solver_checks, only: body_head, check_at_random, check_equations, check_text, point_head, second, use_solver, weight
   use text, only: replace, to_text
   implicit none (type, external)
   private
   public :: run_test_augmented

contains

   subroutine run_test_augmented(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("words_of_the_registries", test_words)
      call suite%test("options_of_the_ways", test_options)
      call suite%test("slider_crank", test_slider_crank)
      call suite%test("decks", test_decks)
      call suite%test("chain", test_chain)
      call suite%test("long_chain", test_long_chain)
      call suite%test("star", test_star)
      call suite%test("lone_bodies", test_lone_bodies)
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

   !> An option that a deck may give changes description of a way; any other leaves it as it is.
   subroutine test_options(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(6) = [character(7) :: "alpha", "beta", "target", "penalty", "omega", "mu"]
      class(stabilisation_t), allocatable :: set, unset
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
      do k = 1, n_stabilisation_kinds()
         do i = 1, size(names)
            option%name = trim(names(i))
            call new_stabilisation(k, set)
            call new_stabilisation(k, unset)
            call unset%configure([option_t ::], 1.0e-8_wp)
            call set%configure([option], 1.0e-8_wp)
            info = word_options("stabilise", set%name())
            call check_true(error, (set%words() == unset%words()) .neqv. &
                            any([(info%columns(c)%name == option%name, c=1, size(info%columns))]), &
                            "option "//option%name//" of "//set%name()//" is taken if it is documented")
         end do
      end do
   end subroutine test_options

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

      call check_text(chain_text([7, 2, 11, 4, 9, 1, 12, 6, 3, 10, 5, 8], 5), "chain", error)
   end subroutine test_chain

   !> Chains so long that their joints are several sets and the complement is taken in blocks, listed from end to end and mixed: the
   !> equations themselves, rates of the violations and right-hand sides.
   subroutine test_long_chain(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 300
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: start(:), ydot(:)
      integer :: k, status, variant

      random%state = 23_i8
      do variant = 1, 2
         if (variant == 1) call start_text(chain_text([(n + 1 - k, k=1, n)], 1), system, start, error)
         if (variant == 2) call start_text(chain_text([(1 + modulo(11*k, n), k=1, n)], 5), system, start, error)
         if (allocated(error)) return
         call use_solver(system, "schur")
         select type (solver => system%linkage%solution%solver)
         type is (augmented_schur_t)
            call check_true(error, size(system%linkage%joints) > 1, "several sets")
            call check_true(error, solver%rest%n_block > 1 .or. variant == 2, "blocks of the chain from end to end")
         end select
         if (allocated(error)) return
         start = start + random%vector(size(start), -0.01_wp, 0.01_wp)
         start(3*n + 1:6*n) = random%vector(3*n, -4.0_wp, 4.0_wp)
         ydot = start
         call system%evaluate(0.0_wp, start, ydot, status)
         call check_equal(error, status, 0, "evaluation")
         call check_equations(system, "long chain "//to_text(variant), error)
         call check_sides(system%linkage, error)
      end do
   end subroutine test_long_chain

   !> Phi' = Phi_q v and b = gamma - 2 alpha Phi' - beta^2 Phi of rows that do not depend on time.
   subroutine check_sides(linkage, error)
      type(linkage_t), intent(in) :: linkage              !! the linkage, evaluated
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp) :: rate
      integer :: body, row, side

      do row = 1, linkage%rows%n_solve
         if (allocated(error)) return
         rate = 0.0_wp
         do side = 1, 2
            body = linkage%rows%body(side, row)
            rate = rate + dot_product(linkage%rows%jac(3*side - 2:3*side, row), [linkage%motion%v(:2, body), &
                                                                                  linkage%motion%omega(3, body)])
         end do
         associate (solution => linkage%solution)
            call check_close(error, solution%phi_dot(row), rate, 1.0e-12_wp, "rate of row "//to_text(row))
            call check_close(error, solution%b(row), linkage%rows%gam(row) - 2.0_wp*solution%alpha*rate &
                             - solution%beta**2*linkage%rows%phi(row), 1.0e-9_wp, "right-hand side of row "//to_text(row))
         end associate
      end do
   end subroutine check_sides

   !> The deck of a chain from the ground.
   function chain_text(order, stride) result(deck)
      integer, intent(in) :: order(:)       !! (n) the links in the order in which they are listed
      integer, intent(in) :: stride         !! of the joints, from one to that which is listed before it; prime to n + 1
      character(:), allocatable :: deck     !! its text

      character(:), allocatable :: bodies, joints, points
      integer :: k, m, n

      n = size(order)
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
         m = modulo(stride*k, n + 1)
         joints = joints//"pin_"//to_text(m)//" peg_"//to_text(m - 1)//" tail_"//to_text(m)//nl
      end do
      deck = weight//bodies//points//joints//second
   end function chain_text

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

   !> Bodies that hang on the ground or a prescribed body by one row and by two are lone; by three rows, or beside another unknown
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

      ! an integrator that needs all constraints leaves the prescribed bodies alone, but guides none
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

end module test_augmented
