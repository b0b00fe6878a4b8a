!> Scenes from decks, ready to run, and a recorder that keeps what it is reported.
module deck_scene
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use catalogue, only: catalogue_t
   use check, only: check_true
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dynamic, only: run_dynamic
   use errors, only: error_t, exit_file, set_error
   use guards, only: new_guards
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use read_scene, only: scene_from_deck
   use recorder, only: event_t, recorder_t, summary_t
   use run_audit, only: limits_t
   use scene, only: scene_t
   use scratch_deck, only: remove_scratch, write_scratch
   use start_state, only: find_start
   use step_check, only: check_steps
   use subsystems, only: new_subsystems, subsystem_t
   use text, only: append_text, text_t
   use time_plan, only: new_time_plan, time_plan_t
   implicit none (type, external)
   private
   public :: dry_deck, keeper_t, load_file, load_text, loaded_t, run_to_end

   character(*), parameter :: dry_deck = "inputs/slider_crank_dry.deck"  !! from the project's directory, where tests run

   !> A deck ready to run.
   type :: loaded_t
      type(scene_t) :: scene                            !! what it means
      type(mechanism_t) :: system                   !! its equations
      type(time_plan_t) :: plan                         !! its times
      class(integrator_t), allocatable :: method        !! its integrator, not started
      real(wp), allocatable :: y(:)                     !! (n) state at the start [any]
   end type loaded_t

   !> Keeps times, one channel and all events in memory.
   type, extends(recorder_t) :: keeper_t
      integer :: item_group = 0                         !! group of items of the channel that is kept, 0: none
      character(:), allocatable :: channel              !! its name; first component of the last item
      integer :: n_sample = 0                           !! samples
      integer :: n_event = 0                            !! events
      integer :: n_start = 0                            !! calls of start
      integer :: n_finish = 0                           !! calls of finish
      integer :: n_progress = 0                         !! calls of progress
      real(wp) :: fraction = 0.0_wp                     !! last progress reported [1]
      integer :: n_broken = huge(0)                     !! sample that cannot be written
      real(wp), allocatable :: time(:)                  !! (capacity) of the samples [s]
      real(wp), allocatable :: value(:)                 !! (capacity) of the channel [any]
      type(event_t), allocatable :: events(:)           !! (capacity) events
      type(summary_t) :: summary                        !! as given to finish
   contains
      procedure :: start => keeper_start
      procedure :: sample => keeper_sample
      procedure :: event => keeper_event
      procedure :: progress => keeper_progress
      procedure :: finish => keeper_finish
   end type keeper_t

contains

   !> Load a deck from a file. Settings are appended as `--set` gives them, between semicolons.
   subroutine load_file(path, loaded, error, overrides)
      character(*), intent(in) :: path                   !! of the deck
      type(loaded_t), intent(out) :: loaded              !! the deck, ready to run
      type(error_t), allocatable, intent(out) :: error   !! an error
      character(*), intent(in), optional :: overrides    !! as "c=1mm;speed=2rpm"

      type(assembly_t) :: assembly
      type(deck_t) :: deck
      type(diagnostics_t) :: mistakes
      type(text_t), allocatable :: list(:)
      integer :: first, last
      logical :: is_there

      inquire (file=path, exist=is_there)
      call check_true(error, is_there, path//" exists (tests run in the project's directory)")
      if (allocated(error)) return
      allocate (list(0))
      if (present(overrides)) then
         first = 1
         do while (first <= len(overrides))
            last = index(overrides(first:)//";", ";") + first - 2
            call append_text(list, overrides(first:last))
            first = last + 2
         end do
      end if
      call read_deck(path, list, deck, mistakes)
      if (mistakes%count() == 0) call scene_from_deck(deck, loaded%scene, mistakes)
      call mistakes%to_error(deck%sources, error)
      if (allocated(error)) return
      call new_system(loaded%scene, levels_as_written, loaded%system)
      call check_steps(loaded%scene%settings%integration, mistakes)
      call new_time_plan(loaded%scene, loaded%system, loaded%plan, mistakes)
      call mistakes%to_error(deck%sources, error)
      if (allocated(error)) return
      call loaded%scene%settings%integration%new_method(loaded%method)
      call find_start(loaded%scene, levels_as_written, loaded%system, loaded%y, assembly, error)
   end subroutine load_file

   !> Load a deck given as text.
   subroutine load_text(text, loaded, error)
      character(*), intent(in) :: text                   !! the deck
      type(loaded_t), intent(out) :: loaded              !! the deck, ready to run
      type(error_t), allocatable, intent(out) :: error   !! an error

      character(:), allocatable :: path

      call write_scratch(text, path)
      call load_file(path, loaded, error)
      call remove_scratch(path)
   end subroutine load_text

   !> Run a loaded deck to its end.
   subroutine run_to_end(loaded, keeper, summary, error, limits)
      type(loaded_t), intent(inout) :: loaded                !! the deck
      type(keeper_t), intent(inout) :: keeper                !! keeps the results
      type(summary_t), intent(out) :: summary                !! cost and errors
      type(error_t), allocatable, intent(out) :: error       !! the run failed
      type(limits_t), intent(in), optional :: limits         !! what the results must fulfil

      type(limits_t) :: bounds
      type(subsystem_t), allocatable :: subsystems(:)

      if (present(limits)) bounds = limits
      call new_guards(loaded%scene, loaded%system, bounds%guards)
      call new_subsystems(loaded%scene, levels_as_written, loaded%system, loaded%method, loaded%plan%end, subsystems)
      call run_dynamic(loaded%system, loaded%method, subsystems, loaded%y, loaded%plan, bounds, keeper, summary, error)
   end subroutine run_to_end

   subroutine keeper_start(self, catalogue, error)
      class(keeper_t), intent(inout) :: self             !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! never set

      self%n_start = self%n_start + 1
      allocate (self%time(64), self%value(64), source=0.0_wp)
      allocate (self%events(64))
   end subroutine keeper_start

   subroutine keeper_sample(self, t, catalogue, error)
      class(keeper_t), intent(inout) :: self             !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! the sample that cannot be written

      integer :: group

      if (self%n_sample + 1 == self%n_broken) then
         call set_error(error, exit_file, "the disk is full")
         return
      end if
      self%n_sample = self%n_sample + 1
      if (self%n_sample > size(self%time)) then
         self%time = [self%time, self%time]
         self%value = [self%value, self%value]
      end if
      self%time(self%n_sample) = t
      if (self%item_group == 0) return
      group = catalogue%find_group(self%item_group, self%channel)
      self%value(self%n_sample) = catalogue%values(catalogue%place(group, 1, size(catalogue%groups(group)%has)))
   end subroutine keeper_sample

   subroutine keeper_event(self, event, error)
      class(keeper_t), intent(inout) :: self             !! the recorder
      type(event_t), intent(in) :: event                 !! what happened
      type(error_t), allocatable, intent(out) :: error   !! never set

      type(event_t), allocatable :: grown(:)

      if (self%n_event == size(self%events)) then
         allocate (grown(2*self%n_event))
         grown(:self%n_event) = self%events
         call move_alloc(grown, self%events)
      end if
      self%n_event = self%n_event + 1
      self%events(self%n_event) = event
   end subroutine keeper_event

   subroutine keeper_progress(self, fraction)
      class(keeper_t), intent(inout) :: self  !! the recorder
      real(wp), intent(in) :: fraction        !! of the work done, 0 to 1 [1]

      self%n_progress = self%n_progress + 1
      if (fraction < self%fraction) self%n_progress = -huge(0)
      self%fraction = fraction
   end subroutine keeper_progress

   subroutine keeper_finish(self, summary, error)
      class(keeper_t), intent(inout) :: self             !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! never set

      self%n_finish = self%n_finish + 1
      self%summary = summary
   end subroutine keeper_finish

end module deck_scene
