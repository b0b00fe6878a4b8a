!> The contract between an analysis and whatever keeps its results.
!>
!> The order of calls is `start`, then any number of `sample`, `further_row`, `poincare`, `field`, `event` and `progress`, then
!> `finish`, which is also called when the analysis failed: nothing already recorded may be lost.
module recorder
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use film_fields, only: field_request_t, film_field_t
   use kinds, only: i8, wp
   use linearised, only: linearised_t
   use saved_run, only: saved_run_t, action_none
   use text, only: text_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: event_t, located_t, recorder_t, run_quality_t, summary_t
   public :: n_row_kind, row_end, row_instant, row_jump, row_kinds, row_onset, row_peak, row_stop
   public :: status_complete, status_failed, status_running, status_stopped

   character(*), parameter :: status_running = "running"    !! the run continues
   character(*), parameter :: status_complete = "complete"  !! the run reached its end
   character(*), parameter :: status_stopped = "stopped"    !! the run was stopped and can be resumed
   character(*), parameter :: status_failed = "failed"      !! the run ended early

   integer, parameter :: row_instant = 0  !! row of an output instant
   integer, parameter :: row_onset = 1    !! a contact has just started
   integer, parameter :: row_peak = 2     !! the normal force of a contact is the maximum since its onset
   integer, parameter :: row_end = 3      !! a contact is about to end
   integer, parameter :: row_jump = 4     !! just before or after a jump of a normal force
   integer, parameter :: row_stop = 5     !! a condition ends the run
   integer, parameter :: n_row_kind = 5   !! the maximum of these numbers
   !> What the numbers mean.
   character(*), parameter :: row_kinds = "0 output time, 1 onset, 2 peak, 3 separation, 4 before or after a jump, 5 stop"

   !> One located event. A contact is one row: its time is the onset.
   type :: event_t
      real(wp) :: time = 0.0_wp                         !! of the event; of a contact: onset [s]
      character(:), allocatable :: kind                 !! contact, stick, slip, face, film, driver
      character(:), allocatable :: item                 !! name of the joint or driver
      character(:), allocatable :: contact              !! label of the contact within the joint
      real(wp) :: impact_speed = 0.0_wp                 !! normal approach speed at onset, positive [m/s]
      real(wp) :: peak_force = 0.0_wp                   !! normal force at its located maximum [N]
      real(wp) :: peak_penetration = 0.0_wp             !! penetration at its located maximum [m]
      real(wp) :: duration = 0.0_wp                     !! from onset to end; NaN: not ended with the run [s]
      real(wp) :: release_speed = 0.0_wp                !! normal separation speed at the end, positive [m/s]
      real(wp) :: energy_lost = 0.0_wp                  !! by contact damping and friction; NaN without ledger [J]
      real(wp) :: impulse = 0.0_wp                      !! of the normal force over the contact [N.s]
      real(wp) :: peak_force_time = 0.0_wp              !! when the normal force was maximum [s]
      real(wp) :: peak_penetration_time = 0.0_wp        !! when the penetration was maximum [s]
      character(:), allocatable :: state_before         !! contact state before the event
      character(:), allocatable :: state_after          !! contact state after the event
   end type event_t

   !> How a run was made.
   type :: run_method_t
      character(:), allocatable :: integrator      !! integrator
      character(:), allocatable :: solver          !! way of solving the augmented system
      character(:), allocatable :: stabilisation   !! stabilisation method
      real(wp) :: tolerance = 0.0_wp               !! local error tolerance, 0 with fixed steps [1]
   end type run_method_t

   !> How often what was done.
   type :: run_count_t
      integer(i8) :: steps = 0                     !! accepted steps
      integer(i8) :: rejected_steps = 0            !! rejected steps
      integer(i8) :: rhs_evaluations = 0           !! evaluations of the right-hand side, all of them
      integer(i8) :: output_evaluations = 0        !! those of them made for output only
      integer(i8) :: factorisations = 0            !! of the augmented matrix
      integer :: events = 0                        !! located events
      integer :: contacts = 0                      !! contacts that started
      integer :: samples = 0                       !! output instants
      integer :: rows(n_row_kind) = 0              !! (n_row_kind) rows beside those of output instants, by kind
   end type run_count_t

   !> How right a run is.
   type :: run_quality_t
      logical :: has_ledger = .true.               !! whether the ledger was kept
      real(wp) :: energy_max = 0.0_wp              !! maximum kinetic + elastic energy + |change of potential| [J]
      real(wp) :: energy_residual_max = 0.0_wp     !! maximum |residual| of the ledger; NaN without ledger [J]
      real(wp) :: violation_max = 0.0_wp           !! maximum |Phi| over the run; rotations times 1 m [m]
      real(wp) :: violation_rate_max = 0.0_wp      !! maximum |dPhi/dt| over the run [m/s]
   end type run_quality_t

   !> What a run cost and how right it is.
   type :: summary_t
      character(:), allocatable :: status          !! complete, stopped or failed
      character(:), allocatable :: message         !! why, if not complete; else blank
      type(text_t), allocatable :: warnings(:)     !! (any) what a careful reader should know
      character(:), allocatable :: equilibrium     !! of a static analysis: stable, unstable or indifferent, and why; else blank
      type(linearised_t) :: linear                 !! of a static analysis with films: small motions about the equilibrium
      type(worn_surface_t), allocatable :: worn(:) !! (any) worn surfaces; unallocated: no dynamic analysis
      real(wp) :: time_start = 0.0_wp              !! first instant [s]
      real(wp) :: time_end = 0.0_wp                !! last instant reached [s]
      integer :: groups = 1                        !! groups of bodies integrated apart; 1: all together
      type(run_method_t) :: method                 !! how it was made
      type(run_count_t) :: count                   !! how often what was done
      type(run_quality_t) :: quality               !! how right it is
      real(wp) :: cpu_seconds = 0.0_wp             !! of the solution, without output [s]
      real(wp) :: wall_seconds = 0.0_wp            !! of the whole analysis [s]
   end type summary_t

   !> Numbers whose extremes are located between rows.
   type :: located_t
      integer, allocatable :: place(:)             !! (n) places in the values of the catalogue; unallocated: none
      real(wp) :: from = -huge(1.0_wp)             !! extremes since then count, besides those since the start [s]
   end type located_t

   !> Whatever keeps the results of an analysis.
   type, abstract :: recorder_t
      logical :: wants_contact_rows = .false.      !! whether `further_row` is to be called at contacts
      type(field_request_t), allocatable :: wants_fields(:)  !! (any) films that `field` is to be called with; unallocated: none
      character(32) :: stopped_by = "a signal"     !! what an action that ends the run was requested by
      type(located_t) :: located                   !! numbers whose extremes between rows `between` is to be called with
   contains
      procedure(start_interface), deferred :: start
      procedure(sample_interface), deferred :: sample
      procedure :: wants => wants_all
      procedure :: further_row => skip_further_row
      procedure :: between => skip_between
      procedure :: poincare => skip_poincare
      procedure :: field => skip_field
      procedure(event_interface), deferred :: event
      procedure(progress_interface), deferred :: progress
      procedure :: requested_action => action_for_none
      procedure :: save => skip_checkpoint
      procedure :: go_on => skip_going_on
      procedure(finish_interface), deferred :: finish
   end type recorder_t

   abstract interface
      !> Before the first sample.
      subroutine start_interface(self, catalogue, error)
         import :: catalogue_t, error_t, recorder_t
         implicit none (type, external)
         class(recorder_t), intent(inout) :: self           !! the recorder
         type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be made
      end subroutine start_interface

      !> Keep the catalogue's current values as those of time t.
      subroutine sample_interface(self, t, catalogue, error)
         import :: catalogue_t, error_t, recorder_t, wp
         implicit none (type, external)
         class(recorder_t), intent(inout) :: self           !! the recorder
         real(wp), intent(in) :: t                          !! time [s]
         type(catalogue_t), intent(in) :: catalogue         !! values at t
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine sample_interface

      !> Keep an event. Contacts come when they end, so not quite in the order of their onsets.
      subroutine event_interface(self, event, error)
         import :: error_t, event_t, recorder_t
         implicit none (type, external)
         class(recorder_t), intent(inout) :: self           !! the recorder
         type(event_t), intent(in) :: event                 !! what happened
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine event_interface

      !> Reported now and then how far the analysis is; must be cheap.
      subroutine progress_interface(self, fraction)
         import :: recorder_t, wp
         implicit none (type, external)
         class(recorder_t), intent(inout) :: self  !! the recorder
         real(wp), intent(in) :: fraction          !! of the work done, 0 to 1 [1]
      end subroutine progress_interface

      !> After the last sample, or after a failure (`summary%status` says which).
      subroutine finish_interface(self, summary, error)
         import :: error_t, recorder_t, summary_t
         implicit none (type, external)
         class(recorder_t), intent(inout) :: self           !! the recorder
         type(summary_t), intent(in) :: summary             !! cost and errors of the run
         type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      end subroutine finish_interface
   end interface

contains

   !> Whether the value of a quantity of an item is read, once the recorder has started: all are, unless a recorder knows better.
   pure logical function wants_all(self, group, item) result(wants)
      class(recorder_t), intent(in) :: self      !! the recorder
      integer, intent(in) :: group               !! its group in the catalogue
      integer, intent(in) :: item                !! number of the item in the group's room

      wants = .true.
   end function wants_all

   !> Keep the catalogue's current values as those of an instant of a contact, or of one at which a condition ends the run:
   !> nothing, unless a recorder needs them. Times do not fall from call to call of `sample` and `further_row`; where a force
   !> jumps, two calls have the same.
   subroutine skip_further_row(self, t, kind, catalogue, error)
      class(recorder_t), intent(inout) :: self           !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what it is, one of the above
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
   end subroutine skip_further_row

   !> The catalogue's current values are those of an instant between the last rows, at which a number has an extreme: unless a
   !> recorder has `located` set, it is not called.
   subroutine skip_between(self, t, catalogue)
      class(recorder_t), intent(inout) :: self           !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
   end subroutine skip_between

   !> Keep the catalogue's current values as those of an instant once per period of the drive: unless a recorder asks for
   !> them, nothing.
   subroutine skip_poincare(self, t, catalogue)
      class(recorder_t), intent(inout) :: self           !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
   end subroutine skip_poincare

   !> Whether the run is to be saved, or to end: asked after every step, so it must be cheap. Nothing, unless a recorder knows
   !> better; `can_save` reports it whether the run could be saved just now.
   integer function action_for_none(self, can_save) result(requested_action)
      class(recorder_t), intent(inout) :: self           !! the recorder
      logical, intent(in) :: can_save                    !! the run can be saved after this step

      requested_action = action_none
   end function action_for_none

   !> Keep what a run remembers, with what the recorder remembers itself: unless it keeps such, nothing.
   subroutine skip_checkpoint(self, saved, error)
      class(recorder_t), intent(inout) :: self           !! the recorder
      type(saved_run_t), intent(inout) :: saved          !! what the run remembers; the recorder's is added
      type(error_t), allocatable, intent(out) :: error   !! it cannot be kept
   end subroutine skip_checkpoint

   !> The run continues from what was saved: the recorder, started, takes back what it remembered. Unless it keeps such, nothing.
   subroutine skip_going_on(self, saved, error)
      class(recorder_t), intent(inout) :: self           !! the recorder
      type(saved_run_t), intent(inout) :: saved          !! what was remembered
      type(error_t), allocatable, intent(out) :: error   !! it does not belong to what the recorder finds
   end subroutine skip_going_on

   !> Keep a film that was asked for: unless a recorder asks for some, nothing.
   subroutine skip_field(self, field)
      class(recorder_t), intent(inout) :: self           !! the recorder
      type(film_field_t), intent(in) :: field            !! pressures and gaps
   end subroutine skip_field

end module recorder
