!> The largest Lyapunov exponent by two methods that share nothing but the mechanism.
!>
!> The tangent goes along with the motion, with its jumps at events (`tangent`). A neighbouring trajectory is another motion of the
!> same mechanism, integrated and its events located by itself, which starts `distance` beside; at equally spaced instants at which
!> the same contacts touch it is brought back to that distance on the line to its neighbour, with the impact speeds that its
!> contacts remember.
!>
!> Source: G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9-30 and 21-30.
!> Limits: the first reference method only; groups of bodies are one mechanism, whose exponent is the largest of theirs.
module exponent_runs
   use batch_means, only: mean_of_series
   use contact_stick_slip, only: sticks
   use errors, only: error_t
   use exponent, only: digits_of, find_exponent, horizon_t
   use friction_law, only: memory_none
   use item, only: item_t
   use kinds, only: eps, not_a_number, wp
   use mechanism, only: mechanism_t
   use mover, only: mover_t
   use precision_info, only: reference_setting, setting_t
   use stabilisation_registry, only: exact_stabilisation
   use jobs, only: first_line, job_t
   use tangent, only: tangent_t
   implicit none (type, external)
   private
   public :: find_horizon, horizon_with_twin, plan_horizon

   real(wp), parameter :: horizon_tolerance = 1.0e-11_wp   !! of the motions [1]
   real(wp), parameter :: distance = 1.0e-7_wp             !! of the neighbouring trajectory, of the scales [1]
   real(wp), parameter :: far = 1.0e-3_wp                  !! distance at which it is no longer beside the motion [1]
   integer, parameter :: fewest_output_times = 64              !! reached before the time was up, for an exponent up to there
   real(wp), parameter :: out_of_reach = 3.0_wp            !! distance, over the one requested, from which it is brought back [1]

contains

   !> Times of a search for the horizon, from the section [precision].
   subroutine plan_horizon(asked, end_of_motion, horizon)
      type(item_t), intent(in) :: asked                  !! the section, or its defaults
      real(wp), intent(in) :: end_of_motion              !! as the deck has it [s]
      type(horizon_t), intent(out) :: horizon            !! times are set

      real(wp) :: end
      integer :: output_times, k

      end = asked%number("exponent_end")
      if (end <= 0.0_wp) end = end_of_motion
      output_times = nint(asked%number("exponent_instants"))
      horizon%t = [(end*real(k, wp)/real(output_times, wp), k=0, output_times)]
      horizon%after = end*asked%number("settle")
      horizon%tolerance = horizon_tolerance
      horizon%digits = not_a_number()
      horizon%run_digits = not_a_number()
      allocate (horizon%tangent%growth(output_times + 1), horizon%twin%growth(output_times + 1), source=not_a_number())
      horizon%tangent%rate = mean_of_series([real(wp) ::])
      horizon%twin%rate = horizon%tangent%rate
      horizon%tangent%reason = "not requested"
      horizon%twin%reason = "not requested"
   end subroutine plan_horizon

   !> Exponent and digits by the tangent.
   subroutine find_horizon(job, horizon)
      type(job_t), intent(inout) :: job                  !! scene, settings, times
      type(horizon_t), intent(inout) :: horizon          !! planned; exponent of the tangent and digits follow

      type(error_t), allocatable :: error
      type(mover_t), target :: mover
      type(tangent_t) :: tangent
      real(wp), allocatable :: logs(:, :)
      integer :: k, status

      allocate (logs(2, size(horizon%t)), source=0.0_wp)
      horizon%tangent%reason = ""
      call mover%start(job, on_constraints(), horizon%tolerance, horizon%t(size(horizon%t)), error)
      if (.not. allocated(error)) then
         call tangent%begin(mover%system, mover%method, 1.0_wp/horizon%t(size(horizon%t)), status)
         if (status /= 0) horizon%tangent%reason = "no coordinate is free to be perturbed"
         if (status == 0) logs(:, 1) = tangent%lengths(mover%system)
      end if
      if (horizon%tangent%reason /= "") return
      do k = 2, size(horizon%t)
         if (.not. allocated(error)) call mover%advance(horizon%t(k), error, tangent)
         if (allocated(error)) exit
         call tangent%project(mover%system, mover%method, status)
         logs(:, k) = tangent%lengths(mover%system)
      end do
      if (allocated(error)) then
         if (.not. mover%is_late .or. k - 1 < fewest_output_times) then
            horizon%tangent%reason = first_line(error%message)
            return
         end if
         call cut(horizon, k - 1)
         logs = logs(:, :k - 1)
      end if
      horizon%n_crossed = tangent%n_crossed
      horizon%n_grazed = tangent%n_grazed
      horizon%n_together = tangent%n_together
      associate (growth => horizon%tangent%growth)
         growth = growth_of(logs, tangent%pace(mover%system))
         call find_exponent(horizon%t, horizon%after, horizon%tangent)
         horizon%digits = digits_of(horizon%t, growth, eps)
         if (horizon%asked > 0.0_wp) horizon%run_digits = digits_of(horizon%t, growth, horizon%asked)
      end associate
      call compare(horizon)
   end subroutine find_horizon

   !> Omit the instants that were not reached; the transient is the same part of the others.
   subroutine cut(horizon, n)
      type(horizon_t), intent(inout) :: horizon          !! planned
      integer, intent(in) :: n                           !! instants that were reached

      horizon%after = horizon%after*horizon%t(n)/horizon%t(size(horizon%t))
      horizon%t = horizon%t(:n)
      horizon%tangent%growth = horizon%tangent%growth(:n)
      horizon%twin%growth = horizon%twin%growth(:n)
      horizon%is_cut = .true.
   end subroutine cut

   !> Exponent by a neighbouring trajectory. Where its time is up before the last instant, behind half of them, both exponents end
   !> there.
   subroutine horizon_with_twin(job, horizon)
      type(job_t), intent(inout) :: job                  !! scene, settings, times
      type(horizon_t), intent(inout) :: horizon          !! planned; exponent of the neighbouring trajectory follows

      type(error_t), allocatable :: error
      type(mover_t), target :: base, twin
      type(tangent_t) :: first
      real(wp), allocatable :: logs(:, :)
      real(wp) :: apart(2), d, level
      integer :: k, status
      logical :: is_near

      horizon%with_twin = .true.
      horizon%twin%reason = ""
      call base%start(job, on_constraints(), horizon%tolerance, horizon%t(size(horizon%t)), error)
      if (.not. allocated(error)) then
         call twin%start(job, on_constraints(), horizon%tolerance, horizon%t(size(horizon%t)), error)
      end if
      if (.not. allocated(error)) then
         call first%begin(base%system, base%method, 1.0_wp/horizon%t(size(horizon%t)), status)
         is_near = status == 0
         if (is_near) call twin%put(base%method%step%y1 + distance*first%w, is_near)
         if (.not. is_near) horizon%twin%reason = "no perturbed initial state has the same contacts"
      end if
      if (horizon%twin%reason /= "") return
      allocate (logs(2, size(horizon%t)), source=0.0_wp)
      level = 0.0_wp
      do k = 1, size(horizon%t)
         if (.not. allocated(error)) call base%advance(horizon%t(k), error)
         if (.not. allocated(error)) call twin%advance(horizon%t(k), error)
         if (allocated(error)) exit
         apart = distances_of(base, twin, first%scale)
         logs(:, k) = level + log(max(tiny(1.0_wp), apart))
         d = max(apart(1), apart(2)/first%pace(base%system))
         if (d > far) horizon%twin%reason = "the neighbouring trajectory diverged before rescaling"
         if (.not. d > 0.0_wp) horizon%twin%reason = "the neighbouring trajectory merged with the reference"
         if (horizon%twin%reason /= "") return
         if (max(d/distance, distance/d) < out_of_reach) cycle
         call bring_back(base, twin, distance/d, is_near)
         if (.not. is_near) cycle
         horizon%n_renewed = horizon%n_renewed + 1
         apart = distances_of(base, twin, first%scale)
         level = level + log(d/max(apart(1), apart(2)/first%pace(base%system)))
      end do
      if (allocated(error)) then
         if ((base%is_late .or. twin%is_late) .and. k - 1 >= max(fewest_output_times, size(horizon%t)/2)) then
            call cut(horizon, k - 1)
            logs = logs(:, :k - 1)
            if (horizon%tangent%reason == "") call find_exponent(horizon%t, horizon%after, horizon%tangent)
         else
            horizon%twin%reason = first_line(error%message)
         end if
      end if
      if (horizon%twin%reason == "") horizon%twin%growth = growth_of(logs, first%pace(base%system))
      call find_exponent(horizon%t, horizon%after, horizon%twin)
      call compare(horizon)
   end subroutine horizon_with_twin

   !> The setting of the motions: they stay on the constraints, as a neighbouring trajectory that is brought back does.
   type(setting_t) function on_constraints() result(setting)
      setting = reference_setting(exact_stabilisation())
   end function on_constraints

   !> How far two motions of one mechanism are apart in positions, and in rates [1 and s^-1].
   function distances_of(a, b, scale) result(d)
      type(mover_t), intent(in) :: a           !! a motion
      type(mover_t), intent(in) :: b           !! another one
      real(wp), intent(in) :: scale(:)         !! (positions + rates) what differences are measured by [any]
      real(wp) :: d(2)                         !! (2) maximum of positions and of rates [1]

      real(wp), allocatable :: x(:), y(:)

      x = a%method%step%y1
      y = b%method%step%y1
      call a%system%linkage%tidy(x)
      call b%system%linkage%tidy(y)
      associate (nq => a%system%linkage%n_position, n => size(scale))
         d = [maxval(abs(y(:nq) - x(:nq))/scale(:nq)), maxval(abs(y(nq + 1:n) - x(nq + 1:n))/scale(nq + 1:))]
      end associate
   end function distances_of

   !> Growth from the logarithms of both lengths, rates over the maximum characteristic rate of all the motion.
   pure function growth_of(logs, pace) result(growth)
      real(wp), intent(in) :: logs(:, :)            !! (2, instants) of positions and of rates [1]
      real(wp), intent(in) :: pace                  !! of all the motion [1/s]
      real(wp) :: growth(size(logs, 2))             !! (instants) ln of the change over that of the start [1]

      growth = max(logs(1, :), logs(2, :) - log(pace))
      growth = growth - growth(1)
   end function growth_of

   !> Bring a neighbouring trajectory nearer to its neighbour, or away from it, if the same contacts touch.
   subroutine bring_back(base, twin, factor, is_done)
      type(mover_t), intent(in) :: base        !! the motion
      type(mover_t), intent(inout) :: twin     !! its neighbouring trajectory
      real(wp), intent(in) :: factor           !! of the difference [1]
      logical, intent(out) :: is_done          !! .false.: not here

      real(wp), allocatable :: impact(:), own(:), y(:)

      is_done = same_contacts(base%system, twin%system)
      if (.not. is_done) return
      y = base%method%step%y1 + factor*(twin%method%step%y1 - base%method%step%y1)
      own = speeds_of(twin%system)
      impact = speeds_of(base%system)
      call give(twin%system, impact + factor*(own - impact))
      call twin%put(y, is_done)
      if (.not. is_done) call give(twin%system, own)

   contains

      !> Give the contacts that touch their impact speeds.
      subroutine give(system, speeds)
         type(mechanism_t), intent(inout) :: system   !! the system
         real(wp), intent(in) :: speeds(:)            !! (contacts) the speeds [m/s]

         integer :: i, k

         do k = 1, size(system%clearance_joints%sets)
            associate (set => system%clearance_joints%sets(k)%set)
               do i = 1, set%n_contact
                  if (set%contact(i)%is_touching) call set%set_impact_speed(i, speeds(set%before%contacts + i))
               end do
            end associate
         end do
      end subroutine give

   end subroutine bring_back

   !> Impact speeds that contacts remember.
   pure function speeds_of(system) result(speeds)
      type(mechanism_t), intent(in) :: system    !! the system
      real(wp) :: speeds(system%clearance_joints%n_contact)       !! (contacts) the speeds [m/s]

      integer :: k

      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            speeds(set%before%contacts + 1:set%before%contacts + set%n_contact) = set%contact%impact_speed
         end associate
      end do
   end function speeds_of

   !> Whether the same contacts touch in two states of one mechanism, on the same course, and stick or slip alike.
   pure logical function same_contacts(a, b) result(are_same)
      type(mechanism_t), intent(in) :: a   !! a state
      type(mechanism_t), intent(in) :: b   !! another one

      integer :: k

      are_same = .true.
      do k = 1, size(a%clearance_joints%sets)
         associate (one => a%clearance_joints%sets(k)%set, other => b%clearance_joints%sets(k)%set)
            are_same = are_same .and. all(one%contact%is_touching .eqv. other%contact%is_touching)
            are_same = are_same .and. all(one%contact%course == other%contact%course .or. .not. one%contact%is_touching)
            if (one%stick_slip%memory == memory_none) cycle
            are_same = are_same .and. all(one%stick_slip%slip == other%stick_slip%slip .and. one%stick_slip%slip /= sticks .or. &
                                          .not. one%contact%is_touching)
         end associate
      end do
   end function same_contacts

   !> Whether both methods agree.
   subroutine compare(horizon)
      type(horizon_t), intent(inout) :: horizon   !! with both exponents, or one

      associate (a => horizon%tangent, b => horizon%twin)
         horizon%is_agreed = .false.
         if (a%reason == "" .and. b%reason == "") horizon%is_agreed = abs(a%rate%value - b%rate%value) <= &
                                                                      a%rate%half + b%rate%half
      end associate
   end subroutine compare

end module exponent_runs
