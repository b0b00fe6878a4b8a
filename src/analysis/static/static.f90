!> Static equilibrium: search, classification, and its record of one instant.
!>
!> The search goes downhill (see static_relaxation) until a thousandth of the loads is out of balance, then KINSOL
!> polishes; where KINSOL fails or wanders off, as at an indifferent equilibrium, the descent continues
!> alone. The equilibrium is stable, unstable or indifferent by the minimum eigenvalue of the tangent stiffness
!> against the motions that the joints leave free.
!> Source and limits: static_problem.
module static
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use assembly_report, only: assembly_t
   use build_system, only: levels_ideal, new_system
   use catalogue, only: catalogue_t
   use consistent_start, only: assemble
   use dependent_rows, only: find_dependent
   use driver_conflict, only: name_conflict
   use errors, only: error_t, exit_assembly, set_error
   use film_heat, only: balance_heat
   use film_moments, only: film_moments_t
   use inverse_dynamics, only: find_reactions
   use kinds, only: i8, not_a_number, two_pi, wp
   use mobility, only: moving_bodies
   use linearised, only: linearised_t
   use mechanism_energy, only: energy_of, energy_t
   use mechanism_catalogue, only: build_catalogue
   use mechanism_report, only: fill_catalogue
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, solve_positions
   use recorder, only: recorder_t, status_complete, status_failed, summary_t
   use scene, only: analysis_static, scene_t
   use shaky, only: find_shaky
   use static_kinsol, only: polish
   use static_film, only: settle_in_films
   use static_problem, only: balance_t, evaluate_balance, free_stiffness, is_balanced, load_scale, look_at, net_load, &
      position_scale, square_frequencies
   use static_relaxation, only: relax
   use steady_stability, only: find_eigenvalues, gather_films, is_steady, mode_words, no_growth
   use text, only: append_text, real_text, to_text
   use whirl_onset, only: find_onset
   implicit none (type, external)
   private
   public :: equilibrium_t, find_equilibrium, record_equilibrium

   real(wp), parameter :: rough = 1.0e-3_wp         !! unbalanced load at which KINSOL takes over, of the largest [1]
   real(wp), parameter :: nearby = 0.1_wp           !! how far KINSOL may move a coordinate, in sizes or radians [1]
   real(wp), parameter :: no_stiffness = 1.0e-6_wp  !! stiffness that counts as none, of the largest net load [1]
   real(wp), parameter :: of_acting = 1.0e-7_wp     !! the same, of the forces that act: what differences lose [1]
   real(wp), parameter :: lost_digits = 1.0e-8_wp   !! stiffness lost in the differences, of the largest [1]
   real(wp), parameter :: to_round_off = 1.0e-14_wp !! unbalanced load that is tried for in the end, of the largest [1]
   integer, parameter :: n_last = 3                 !! steps from the tolerance towards it
   integer, parameter :: n_polish = 50              !! iterations of KINSOL allowed

   !> An equilibrium.
   type :: equilibrium_t
      real(wp), allocatable :: q(:)             !! (n_q bodies) positions [any]
      character(:), allocatable :: words        !! stable, unstable or indifferent, and why
      character(:), allocatable :: warning      !! what a careful reader should know; blank if it is stable
      real(wp) :: residual = 0.0_wp             !! of the sum of all forces [N.m]
      real(wp) :: acting = 0.0_wp               !! forces that act, its measure [N.m]
      real(wp) :: rounding = 0.0_wp             !! what the rounding of the positions makes of it [N.m]
      real(wp) :: tolerance = 0.0_wp            !! that was allowed [1]
      integer :: steps = 0                      !! steps of the descent
      integer(i8) :: n_evaluations = 0_i8       !! evaluations of the loads
      logical :: is_polished = .false.          !! KINSOL found it in the end
      type(linearised_t) :: linear              !! with films: small motions about it
      real(wp) :: cpu_seconds = 0.0_wp          !! of the search [s]
   end type equilibrium_t

contains

   !> Search an equilibrium of a system of the scene.
   subroutine find_equilibrium(scene, system, q, report, equilibrium, error, in_full)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(mechanism_t), intent(inout) :: system        !! the system; left at the equilibrium
      real(wp), intent(inout) :: q(:)                       !! (n_q bodies) positions of the deck [any]
      type(assembly_t), intent(out) :: report               !! how the assembly went
      type(equilibrium_t), intent(out) :: equilibrium       !! what was found
      type(error_t), allocatable, intent(out) :: error      !! cannot be assembled, or no equilibrium found
      logical, intent(in), optional :: in_full              !! films get their temperature and the onset of whirl is searched;
                                                            !! absent: if the analysis is static

      type(balance_t) :: balance
      real(wp) :: cpu_0, cpu_1
      integer :: most
      logical :: is_exact, is_full, is_settled

      call cpu_time(cpu_0)
      is_full = scene%analysis == analysis_static
      if (present(in_full)) is_full = in_full
      equilibrium%tolerance = scene%settings%static%number("tolerance")
      most = nint(scene%settings%static%number("maximum_iterations"))
      call assemble_at_rest(scene, system, q, report, error)
      if (allocated(error)) return
      call look_at(system, q)
      call check_loads(system, error)
      if (allocated(error)) return
      if (system%clearance_joints%has_films) then
         call settle_in_films(system, to_round_off, most, q, balance, equilibrium%steps, is_exact)
         is_settled = is_balanced(system, balance, equilibrium%tolerance)
         if (is_settled .and. is_full) call balance_heat(system, to_round_off, equilibrium%tolerance, most, q, balance, &
                                                         equilibrium%steps, error)
         if (allocated(error)) return
      else
         call relax_and_polish()
      end if
      equilibrium%residual = norm2(balance%load)
      equilibrium%acting = load_scale(system)
      equilibrium%rounding = balance%rounding
      if (.not. is_settled) then
         call refuse(system, balance, equilibrium, error)
         return
      end if
      equilibrium%q = q
      if (system%clearance_joints%has_films) then
         call judge_steady(scene, is_full, system, balance, equilibrium)
      else
         call classify(system, balance, equilibrium)
      end if
      equilibrium%n_evaluations = balance%n_evaluations
      call cpu_time(cpu_1)
      equilibrium%cpu_seconds = cpu_1 - cpu_0

   contains

      !> Downhill, then by KINSOL, then downhill again if that did not help.
      subroutine relax_and_polish()
         call relax(system, max(rough, equilibrium%tolerance), most, q, balance, equilibrium%steps, is_settled, .true.)
         if (is_settled) then
            call try_to_polish(system, q, balance, equilibrium)
            if (.not. equilibrium%is_polished) then
               call relax(system, equilibrium%tolerance, most, q, balance, equilibrium%steps, is_settled)
               if (is_settled) call relax(system, to_round_off, equilibrium%steps + n_last, q, balance, equilibrium%steps, is_exact)
            end if
         end if
      end subroutine relax_and_polish

   end subroutine find_equilibrium

   !> Loads that are no finite numbers have no equilibrium.
   subroutine check_loads(system, error)
      class(mechanism_t), intent(in) :: system              !! the system, loads evaluated
      type(error_t), allocatable, intent(out) :: error      !! names the body

      integer :: k

      do k = 1, system%linkage%bodies%n
         if (all(ieee_is_finite(system%loading%g(:, k)))) cycle
         call set_error(error, exit_assembly, "no static equilibrium exists: the load on '"// &
                        system%linkage%bodies%names(k)%s//"' is not finite at t = 0")
         return
      end do
   end subroutine check_loads

   !> Positions to start with.
   subroutine assemble_at_rest(scene, system, q, report, error)
      type(scene_t), intent(in) :: scene                    !! the scene
      type(mechanism_t), intent(inout) :: system        !! the system that is searched
      real(wp), intent(inout) :: q(:)                       !! (n_q bodies) positions, assembled [any]
      type(assembly_t), intent(out) :: report               !! how the assembly went
      type(error_t), allocatable, intent(out) :: error      !! cannot be assembled

      type(mechanism_t) :: twin
      real(wp) :: v(size(system%linkage%mass))

      v = 0.0_wp
      if (scene%settings%static%word("start") == "ideal") then
         call new_system(scene, levels_ideal, twin)
         call assemble(twin%linkage, q, v, report, error)
      else
         call assemble(system%linkage, q, v, report, error)
      end if
      if (allocated(error)) then
         call name_conflict(scene, levels_ideal, q, 0.0_wp*v, error)
         return
      end if
      if (size(report%set_aside) > 0) then
         call assemble(system%linkage, q, v, report, error)  ! rows are set aside in this system, too
         if (allocated(error)) return
      end if
      call find_dependent(system%linkage, q, v, report)
      if (report%n_weak > size(report%set_aside)) call find_shaky(system%linkage, q, error)
      if (allocated(error)) return
      system%linkage%solution%is_redundant = size(report%dependent) > 0
   end subroutine assemble_at_rest

   !> Let KINSOL polish; keep what it found if that is an equilibrium nearby.
   subroutine try_to_polish(system, q, balance, equilibrium)
      type(mechanism_t), intent(inout) :: system         !! the system, balance evaluated
      real(wp), intent(inout) :: q(:)                        !! (n_q bodies) positions, polished [any]
      type(balance_t), intent(inout) :: balance              !! at the positions
      type(equilibrium_t), intent(inout) :: equilibrium      !! whether it was polished

      type(assembly_t) :: rows
      type(newton_t) :: newton
      real(wp) :: load, moved(size(system%linkage%mass)), q_new(size(q)), rest(size(system%linkage%mass))
      integer :: outcome

      load = max(load_scale(system), balance%rounding/to_round_off)
      if (load <= 0.0_wp) return
      q_new = q
      rest = 0.0_wp
      call find_dependent(system%linkage, q, rest, rows)
      call polish(system, rows%dependent, load, to_round_off, n_polish, q_new, equilibrium%is_polished)
      call system%linkage%coordinates%difference(system%linkage%bodies%n, q, q_new, moved)
      if (equilibrium%is_polished) equilibrium%is_polished = maxval(abs(moved)/position_scale(system)) < nearby
      if (.not. equilibrium%is_polished) q_new = q
      call solve_positions(system%linkage, 0.0_wp, newton, q_new, outcome)
      call evaluate_balance(system, q_new, balance)
      call free_stiffness(system, q_new, balance)
      equilibrium%is_polished = equilibrium%is_polished .and. is_balanced(system, balance, equilibrium%tolerance)
      q = q_new
   end subroutine try_to_polish

   !> With films: coefficients, stability by the eigenvalues, and the speed at which it changes.
   subroutine judge_steady(scene, with_search, system, balance, equilibrium)
      type(scene_t), intent(in) :: scene                     !! the scene
      logical, intent(in) :: with_search                     !! the onset of whirl is searched
      type(mechanism_t), intent(inout) :: system             !! the system at the equilibrium
      type(balance_t), intent(inout) :: balance              !! there
      type(equilibrium_t), intent(inout) :: equilibrium      !! words, warning and small motions are set

      real(wp) :: floor_growth, range

      equilibrium%warning = ""
      associate (linear => equilibrium%linear)
         call look_at(system, equilibrium%q)
         call gather_films(system, linear%films)
         if (.not. is_steady(system)) then
            equilibrium%words = "instantaneous only, since the drivers accelerate bodies; stability is not determined"
            return
         end if
         call find_eigenvalues(system, equilibrium%q, balance, linear%eigenvalues)
         if (size(linear%eigenvalues) == 0) then
            equilibrium%words = "stable: drivers prescribe the motion of all bodies"
            return
         end if
         linear%is_judged = .true.
         floor_growth = no_growth(linear%eigenvalues)
         if (linear%eigenvalues(1, 1) < -floor_growth) then
            equilibrium%words = "asymptotically stable; slowest mode decays "//mode_words(linear)
         else if (linear%eigenvalues(1, 1) > floor_growth) then
            equilibrium%words = "unstable; fastest mode grows "//mode_words(linear)
            equilibrium%warning = "the steady state is unstable: its fastest mode grows "//mode_words(linear)
         else
            equilibrium%words = "marginally stable: a mode neither grows nor decays"
            equilibrium%warning = "the steady state is marginally stable: a perturbation neither grows nor decays"
            return
         end if
         range = scene%settings%static%number("whirl_search")
         if (with_search .and. range > 1.0_wp .and. any(abs(linear%films%journal_speed) > 0.0_wp)) then
            call find_onset(system, equilibrium%q, equilibrium%tolerance, range, balance, linear)
         end if
      end associate
   end subroutine judge_steady

   !> Stable, unstable or indifferent.
   subroutine classify(system, balance, equilibrium)
      type(mechanism_t), intent(in) :: system            !! the system at the equilibrium
      type(balance_t), intent(in) :: balance                 !! with stiffness and modes
      type(equilibrium_t), intent(inout) :: equilibrium      !! words and warning are set

      real(wp) :: limit, square(size(balance%stiffness))
      integer :: n_flat, n_steep

      equilibrium%warning = ""
      associate (stiffness => balance%stiffness)
         if (size(stiffness) == 0) then
            equilibrium%words = "stable: no body can move"
            return
         end if
         square = square_frequencies(system, balance)
         limit = max(no_stiffness*net_load(system), of_acting*load_scale(system), lost_digits*maxval(abs(stiffness)), tiny(1.0_wp))
         n_steep = count(stiffness < -limit)
         n_flat = count(abs(stiffness) <= limit)
         if (n_steep > 0) then
            equilibrium%words = "unstable in "//to_text(n_steep)//" of "//to_text(size(stiffness))// &
                                " degrees of freedom; fastest mode grows e-fold in "//real_text(1.0_wp/sqrt(-square(1)), 4)//" s"
            equilibrium%warning = "the equilibrium is unstable: a small perturbation moves "// &
                                  moving_bodies(system%linkage, bodies_in(system, balance%modes(:, 1:1)))// &
                                  "; start the search at another position to find a stable one"
         else if (n_flat > 0) then
            equilibrium%words = "neutrally stable in "//to_text(n_flat)//" of "//to_text(size(stiffness))//" freedoms"
            equilibrium%warning = "the equilibrium is neutral: no force holds "// &
                                  moving_bodies(system%linkage, bodies_in(system, balance%modes(:, &
                                                pack_range(abs(stiffness) <= limit))))// &
                                  " at the computed position"
         else
            equilibrium%words = "stable; lowest natural frequency "//real_text(sqrt(square(1))/two_pi, 6)//" Hz"
         end if
      end associate
   end subroutine classify

   !> Numbers of the places that are true.
   pure function pack_range(mask) result(places)
      logical, intent(in) :: mask(:)      !! (n) places
      integer, allocatable :: places(:)   !! (any) their numbers
      integer :: k

      places = pack([(k, k=1, size(mask))], mask)
   end function pack_range

   !> How much each body takes part in some motions.
   pure function bodies_in(system, modes) result(part)
      class(mechanism_t), intent(in) :: system           !! the system
      real(wp), intent(in) :: modes(:, :)                !! (n_v bodies, motions) unit motions [1]
      real(wp) :: part(system%linkage%bodies%n)          !! (bodies) maximum part of each, 0 to 1 [1]

      integer :: k

      associate (n_v => system%linkage%coordinates%n_v)
         do k = 1, size(part)
            part(k) = maxval(norm2(modes(n_v*(k - 1) + 1:n_v*k, :), dim=1))
         end do
      end associate
   end function bodies_in

   !> The residual, of the forces that act; of stiffness times length where they vanish at the equilibrium.
   function residual_words(equilibrium) result(words)
      type(equilibrium_t), intent(in) :: equilibrium  !! with residual and measures
      character(:), allocatable :: words              !! as "residual 2e-16 of the forces that act"

      words = "residual "//real_text(equilibrium%residual/max(equilibrium%acting, tiny(1.0_wp)), 2)//" relative to acting forces"
      if (max(equilibrium%acting, equilibrium%residual) <= equilibrium%rounding) words = "residual below round-off of positions"
   end function residual_words

   !> The search did not settle: say what still moves, and what to try.
   subroutine refuse(system, balance, equilibrium, error)
      type(mechanism_t), intent(in) :: system          !! the system where the search ended
      type(balance_t), intent(in) :: balance               !! there
      type(equilibrium_t), intent(in) :: equilibrium       !! how far it came
      type(error_t), allocatable, intent(out) :: error     !! the message

      real(wp) :: part(system%linkage%bodies%n), free_load(size(balance%load))

      free_load = matmul(balance%free, matmul(balance%load, balance%free))
      part = bodies_in(system, reshape(free_load, [size(free_load), 1]))
      part = part/max(maxval(part), tiny(1.0_wp))
      where (part < 0.1_wp) part = 0.0_wp
      call set_error(error, exit_assembly, "no static equilibrium was found after "//to_text(equilibrium%steps)// &
                     " steps: "//residual_words(equilibrium)//", allowed "//real_text(equilibrium%tolerance, 2)//new_line("a")// &
                     "  = unbalanced loads act on "//moving_bodies(system%linkage, part)//new_line("a")// &
                     "  = constrain free bodies by a joint, spring or driver; start closer to the equilibrium; or "// &
                     "raise maximum_iterations or the tolerance in [analysis.static]")
   end subroutine refuse

   !> One sample of all channels, at rest at t = 0.
   subroutine record_equilibrium(system, equilibrium, recorder, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system that was searched
      type(equilibrium_t), intent(in) :: equilibrium      !! what was found
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(summary_t), intent(out) :: summary             !! cost and errors
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      type(balance_t) :: balance
      type(catalogue_t) :: catalogue
      type(energy_t) :: energy
      type(error_t), allocatable :: late_error
      type(film_moments_t) :: films
      real(wp) :: rest(size(system%linkage%mass)), unbalanced, y(size(equilibrium%q) + size(system%linkage%mass))

      call build_catalogue(system, catalogue)
      rest = 0.0_wp
      y = [equilibrium%q, rest]
      call evaluate_balance(system, equilibrium%q, balance)
      call find_reactions(system%linkage, system%loading%g, rest, unbalanced)
      system%linkage%solution%phi_dot = 0.0_wp
      allocate (summary%warnings(0))
      if (equilibrium%warning /= "") call append_text(summary%warnings, equilibrium%warning)
      summary%method%integrator = "relaxation"
      if (equilibrium%is_polished) summary%method%integrator = "kinsol"
      summary%equilibrium = equilibrium%words//"; "//residual_words(equilibrium)
      summary%linear = equilibrium%linear
      summary%method%tolerance = equilibrium%tolerance
      summary%count%steps = int(equilibrium%steps, i8)
      summary%count%rhs_evaluations = equilibrium%n_evaluations
      summary%quality%has_ledger = .false.
      summary%quality%energy_residual_max = not_a_number()
      energy = energy_of(system, y)
      summary%quality%energy_max = energy%elastic
      if (system%linkage%rows%n > 0) summary%quality%violation_max = maxval(abs(system%linkage%rows%phi))
      summary%cpu_seconds = equilibrium%cpu_seconds
      summary%wall_seconds = equilibrium%cpu_seconds
      call recorder%start(catalogue, error)
      if (.not. allocated(error)) then
         call fill_catalogue(system, 0.0_wp, y, 0.0_wp, catalogue)
         call recorder%sample(0.0_wp, catalogue, error)
         if (.not. allocated(error)) summary%count%samples = 1
         call films%begin(system, recorder)
         call films%tell_rest(system, 0.0_wp, recorder)
      end if
      summary%status = status_complete
      summary%message = ""
      if (allocated(error)) then
         summary%status = status_failed
         summary%message = error%message
      end if
      call recorder%finish(summary, late_error)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
   end subroutine record_equilibrium

end module static
