!> What a comparison of settings gives: tolerance sweeps of runs with their costs and errors, the reference, the choice.
module precision_results
   use batch_means, only: estimate_t
   use exponent, only: horizon_t
   use growth, only: growth_t, n_digit
   use kinds, only: i8, not_a_number, wp
   use precision_info, only: setting_t
   implicit none (type, external)
   private
   public :: bend_t, tol_sweep_t, precision_t, tol_run_t, statistics_t
   public :: bend_lost, bend_luck, bend_scatter, bend_short, bend_steps, bend_violation
   public :: error_ledger, error_motion, error_names, error_onsets, error_peaks, error_positions, error_reactions, &
      error_restitution, error_units, error_velocities, error_violation, error_words, n_compared, n_error
   public :: tol_run_done, tol_run_failed, tol_run_other, tol_run_states, tol_run_unrun
   public :: median
   public :: n_statistic, statistic_names, statistic_peaks, statistic_rate, statistic_reactions, statistic_speeds, &
      statistic_units, statistic_velocities, statistic_words

   ! kinds of error, those against the reference first
   integer, parameter :: error_motion = 1       !! the greater of positions and velocities
   integer, parameter :: error_positions = 2    !! of bodies, angles at their radii of gyration
   integer, parameter :: error_velocities = 3   !! of bodies
   integer, parameter :: error_reactions = 4    !! of joints
   integer, parameter :: error_onsets = 5       !! of contacts
   integer, parameter :: error_peaks = 6        !! maximum normal forces of contacts
   integer, parameter :: error_restitution = 7  !! release over impact speed
   integer, parameter :: n_compared = 7         !! kinds that need a reference
   integer, parameter :: error_ledger = 8       !! maximum residual over the largest energy
   integer, parameter :: error_violation = 9    !! of constraints
   integer, parameter :: n_error = 9            !! kinds of error

   character(*), parameter :: error_names(n_error) = [character(11) :: "motion", "positions", "velocities", "reactions", &
      "onsets", "peaks", "restitution", "ledger", "violation"]              !! in files
   character(*), parameter :: error_units(n_error) = [character(1) :: "1", "1", "1", "1", "s", "1", "1", "1", "m"]  !! SI
   character(*), parameter :: error_words(n_error) = [character(64) :: &
      "maximum of position and velocity errors", "position error, relative to the largest range of a position", &
      "velocity error, relative to the largest velocity", "reaction error, relative to the largest reaction", &
      "maximum error of onset times", "peak force error, relative to the largest peak force", &
      "maximum error of separation over impact speed", &
      "maximum energy error, relative to the maximum energy", "maximum constraint violation"]  !! what they are

   integer, parameter :: tol_run_unrun = 0    !! no time was left for it
   integer, parameter :: tol_run_done = 1     !! ran to the end
   integer, parameter :: tol_run_failed = 2   !! failed
   integer, parameter :: tol_run_other = 3    !! ran to its end, with other contacts than the reference, or another end
   character(*), parameter :: tol_run_states(0:3) = [character(26) :: "not run", "done", "failed", &
      "different contact sequence"]  !! as text

   ! statistics of the time that is not compared
   integer, parameter :: statistic_rate = 1         !! contacts that start
   integer, parameter :: statistic_speeds = 2       !! impact speeds
   integer, parameter :: statistic_peaks = 3        !! peak forces
   integer, parameter :: statistic_velocities = 4   !! velocities of bodies
   integer, parameter :: statistic_reactions = 5    !! reactions
   integer, parameter :: n_statistic = 5            !! number of them

   character(*), parameter :: statistic_names(n_statistic) = [character(12) :: "contact_rate", "impact_speed", "peak_force", &
      "velocity_rms", "reaction_rms"]                                           !! in files
   character(*), parameter :: statistic_units(n_statistic) = [character(3) :: "1/s", "m/s", "N", "m/s", "N"]  !! SI
   character(*), parameter :: statistic_words(n_statistic) = [character(64) :: &
      "impacts per time", "mean impact speed", "mean peak force of completed contacts", &
      "root mean square of velocities of bodies", "root mean square of reactions"]  !! what they are

   !> Statistics of the time that is not compared, of one run or of the runs of a setting.
   type :: statistics_t
      real(wp) :: from = 0.0_wp                   !! start of that time [s]
      logical :: is_there = .false.               !! there is such a time
      logical :: is_own = .false.                 !! of a run: it parts from the reference, so that it reports something of its own
      type(estimate_t) :: list(n_statistic)       !! (n_statistic) values and half intervals of 95 %; NaN: not known [any]
      integer :: n_run(n_statistic) = 0           !! (n_statistic) runs of a setting that go their own way and have a value
      integer :: n_apart(n_statistic) = 0         !! (n_statistic) those of them that are apart from the reference
   end type statistics_t

   !> What a run did.
   type :: tol_run_counts_t
      integer(i8) :: steps = 0         !! accepted steps
      integer(i8) :: rejected = 0      !! rejected steps
      integer(i8) :: evaluations = 0   !! of right-hand sides, without those for output
   end type tol_run_counts_t

   !> A run of a tolerance sweep.
   type :: tol_run_t
      real(wp) :: asked = 0.0_wp                     !! tolerance, or length of fixed steps [1 or s]
      integer :: state = tol_run_unrun                  !! one of the above
      character(:), allocatable :: reason            !! why it failed or was not run; blank: neither
      real(wp) :: error(n_error) = 0.0_wp            !! (n_error) errors by kind; NaN: not defined [1, s or m]
      logical :: is_below = .false.                  !! the error is within the reference's own
      real(wp) :: holds_until = 0.0_wp               !! last instant up to which the error is not above the one requested [s]
      integer :: n_round = 0                         !! times that it was timed
      real(wp), allocatable :: rounds(:)             !! (n_round or more) processor times of the solution [s]
      real(wp) :: cpu = 0.0_wp                       !! their median; of the run that was compared if there are none [s]
      real(wp) :: cpu_min = 0.0_wp                 !! the minimum of them [s]
      real(wp) :: setup = 0.0_wp                     !! processor time of the system and its start [s]
      real(wp) :: wall = 0.0_wp                      !! that the compared run took, all in all [s]
      type(tol_run_counts_t) :: count                   !! steps and evaluations
      logical :: is_front = .false.                  !! no other one is both cheaper and more exact
      type(statistics_t) :: statistics               !! of the time that is not compared
   end type tol_run_t

   integer, parameter :: bend_scatter = 0     !! no cause is known
   integer, parameter :: bend_steps = 1       !! the steps do not change either
   integer, parameter :: bend_violation = 2   !! the constraint violation does not fall either
   integer, parameter :: bend_lost = 3        !! errors are of the size of the motion itself
   integer, parameter :: bend_short = 4       !! errors do not change at all: what makes them is shorter than all steps
   integer, parameter :: bend_luck = 5        !! errors of neighbouring runs scatter: those of some cancel

   !> A stretch of a tolerance sweep over which errors do not fall.
   type :: bend_t
      integer :: first = 0                !! its coarsest run
      integer :: last = 0                 !! its finest run
      integer :: cause = bend_scatter     !! why
   end type bend_t

   !> The runs of a setting, from the coarsest on.
   type :: tol_sweep_t
      type(setting_t) :: setting                 !! the setting
      character(:), allocatable :: name          !! its word
      logical :: is_fixed = .false.              !! a tolerance sweep of steps, not of tolerances
      type(tol_run_t), allocatable :: tol_runs(:)      !! (n) runs
      real(wp) :: order = 0.0_wp                 !! observed: -d ln error/d ln steps; NaN: not known [1]
      real(wp) :: exponent = 0.0_wp              !! of proportionality: d ln error/d ln tolerance; NaN: not known [1]
      real(wp) :: ratio = 0.0_wp                 !! median of error over tolerance; NaN: not known [1]
      type(bend_t), allocatable :: bends(:)      !! (n) where errors do not fall
      type(statistics_t) :: statistics           !! of its runs in the time that is not compared
   end type tol_sweep_t

   !> What the runs are compared with.
   type :: reference_t
      character(:), allocatable :: what           !! the setting; blank: there is none
      character(:), allocatable :: confirmation   !! what confirms it; blank: nothing does
      logical :: is_poor = .false.                !! it is not as tight as it should be
      real(wp) :: bar(n_compared) = 0.0_wp        !! (n_compared) its errors; NaN: unknown [1 or s]
      real(wp) :: agreed(n_digit) = 0.0_wp        !! (k) last time at which it and its confirmation have k digits in common [s]
      real(wp) :: window = 0.0_wp                 !! last time compared: it is known well enough [s]
      logical :: is_cut = .false.                 !! whether that is before the end
      logical :: is_unsure = .false.              !! it is not known so well at any time: all of it is compared
      type(statistics_t) :: statistics            !! of the time beyond the last one compared, or of all of it if it is unsure
   end type reference_t

   !> The cheapest setting that reaches the error requested, run once more.
   type :: choice_t
      integer :: tol_sweep = 0            !! its tolerance sweep, 0: none does
      integer :: tol_run = 0              !! its run
      real(wp) :: error = 0.0_wp       !! when it was run once more; NaN: it was not [1]
      real(wp) :: cpu = 0.0_wp         !! its processor time then [s]
   end type choice_t

   !> What times were measured on.
   type :: machine_t
      character(:), allocatable :: processor   !! its name
      character(:), allocatable :: compiler    !! that built the program
      character(:), allocatable :: flags       !! with which flags
   end type machine_t

   !> All of it.
   type :: precision_t
      type(tol_sweep_t), allocatable :: tol_sweeps(:)       !! (n) the tolerance sweeps
      integer :: wanted = error_motion                !! kind of error that is requested and drawn
      real(wp) :: accuracy = 0.0_wp                   !! error requested [1]
      real(wp) :: end = 0.0_wp                        !! of the motion [s]
      logical :: is_stopped = .false.                 !! a condition of the deck ends it
      integer :: output_times = 0                         !! compared, with the start
      type(reference_t) :: reference                  !! what all are compared with
      type(growth_t) :: growth                        !! of the distance of neighbouring starts
      type(horizon_t) :: horizon                      !! largest Lyapunov exponent, and digits by it
      type(choice_t) :: choice                        !! the cheapest setting that reaches the error requested
      real(wp) :: budget = 0.0_wp                     !! time allowed, 0: no limit [s]
      real(wp) :: spent = 0.0_wp                      !! time taken up to the figures [s]
      integer :: rounds = 0                           !! rounds of timing that were done by all
      real(wp) :: longest_step = 0.0_wp               !! `maximum_step` of the deck, 0: none [s]
      type(machine_t) :: machine                      !! what it was measured on
   end type precision_t

contains

   !> The median of some numbers.
   pure real(wp) function median(x)
      real(wp), intent(in) :: x(:)  !! (n) the numbers [any]

      real(wp) :: sorted(size(x)), one
      integer :: i, k, n

      n = size(x)
      median = not_a_number()
      if (n == 0) return
      sorted = x
      do k = 2, n
         one = sorted(k)
         do i = k - 1, 1, -1
            if (sorted(i) <= one) exit
            sorted(i + 1) = sorted(i)
         end do
         sorted(i + 1) = one
      end do
      median = 0.5_wp*(sorted((n + 1)/2) + sorted(n/2 + 1))
   end function median

end module precision_results
