!> Wear per cycle from simulations of a deck: those of the journal, else made now, one for each start of the ensemble, as many at
!> once as requested, each in a process of its own (`members`).
module deck_rates
   use errors, only: error_t, exit_file, exit_integration, exit_ok, set_error
   use jobs, only: job_t
   use kinds, only: wp
   use life_journal, only: life_journal_t, simulation_t
   use life_rates, only: simulate, span_t
   use life_results, only: life_plan_t
   use life_state, only: life_state_t
   use members, only: hand_back, next_member, start_member
   use output_directory, only: output_directory_t
   use packed, only: packer_t, unpacker_t
   use processes, only: end_process
   use progress, only: progress_t
   use rate_source, only: rate_source_t
   use text, only: to_text
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: deck_rates_t

   character(*), parameter :: no_log = "/dev/null"   !! where messages of simulations go: what failed comes back

   !> The simulations. All components are set before the first is made.
   type, extends(rate_source_t) :: deck_rates_t
      type(job_t) :: job                         !! the scene and its limits
      type(life_plan_t) :: plan                  !! what is asked of the life
      type(life_state_t) :: state                !! its surfaces
      type(span_t) :: spans(2)                   !! (2) measured cycles, and those after twice the settling cycles
      logical :: has_ensemble = .false.          !! starts are those of [ensemble], else that of the deck
      integer :: jobs = 1                        !! simulations at once
      integer :: n_made = 0                      !! simulations made now
      type(life_journal_t) :: journal            !! what is done
      type(output_directory_t) :: directory      !! of the life
      type(progress_t) :: display                !! how far it is
   contains
      procedure :: find => find_in_simulations
      procedure :: show => show_part
   end type deck_rates_t

contains

   !> What surfaces of some profiles lose in a cycle, from each start.
   subroutine find_in_simulations(self, surfaces, number, settling, rates, values, loads, error)
      class(deck_rates_t), intent(inout) :: self         !! the simulations
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) their profiles
      integer, intent(in) :: number                      !! of the request, from 1: the same for the same profiles
      integer, intent(in) :: settling                    !! 1: settling cycles of the deck, 2: twice as many
      real(wp), intent(out) :: rates(:, :)               !! (n, starts) volumes and distances per cycle [m^3, m]
      real(wp), intent(out) :: values(:)                 !! (conditions) mean extremes of their channels [any]
      real(wp), intent(out) :: loads(:, :)               !! (n_loads, starts) nodes of the loads, see `held_loads` [m, rad, 1, m^3]
      type(error_t), allocatable, intent(out) :: error   !! a simulation failed

      integer :: at, k

      call make_missing(self, surfaces, number, settling, size(rates, 2), size(values), error)
      if (allocated(error)) return
      values = 0.0_wp
      do k = 1, size(rates, 2)
         at = self%journal%find(number, k)
         rates(:, k) = self%journal%runs(at)%rates
         loads(:, k) = self%journal%runs(at)%loads
         values = values + self%journal%runs(at)%values/size(rates, 2)
      end do
   end subroutine find_in_simulations

   !> Make the simulations of a profile that the journal does not have.
   subroutine make_missing(self, surfaces, number, settling, starts, n_values, error)
      class(deck_rates_t), intent(inout) :: self         !! the simulations
      type(worn_surface_t), intent(in) :: surfaces(:)    !! (surfaces) their profiles
      integer, intent(in) :: number                      !! of the profile
      integer, intent(in) :: settling                    !! which settling cycles
      integer, intent(in) :: starts                      !! starts of the ensemble
      integer, intent(in) :: n_values                    !! conditions
      type(error_t), allocatable, intent(out) :: error   !! a simulation failed

      type(simulation_t) :: run
      character(:), allocatable :: bytes, reason
      integer, allocatable :: processes(:), start_of(:)
      integer :: at_once, code, k, next, process, running

      at_once = min(self%jobs, starts)
      allocate (processes(at_once), start_of(at_once), source=0)
      next = 1
      running = 0
      do
         do while (next <= starts .and. running < at_once .and. .not. allocated(error))
            if (self%journal%find(number, next) == 0) then
               run = simulation_t(number, next)
               if (at_once == 1) then
                  call make_run(self, surfaces, settling, n_values, run, reason)
                  call take_run(self, run, reason, starts, error)
               else
                  k = findloc(start_of, 0, dim=1)
                  call start_process(self, surfaces, settling, n_values, run, processes(k), error)
                  if (.not. allocated(error)) start_of(k) = next
                  if (.not. allocated(error)) running = running + 1
               end if
            end if
            next = next + 1
         end do
         if (running == 0) exit
         call next_member(process, code, bytes)
         k = findloc(processes, process, dim=1)
         if (k == 0) cycle
         run = simulation_t(number, start_of(k))
         start_of(k) = 0
         processes(k) = 0
         running = running - 1
         call unpack_run(bytes, code, run, reason)
         if (.not. allocated(error)) call take_run(self, run, reason, starts, error)
      end do
   end subroutine make_missing

   !> Make a simulation here.
   subroutine make_run(self, surfaces, settling, n_values, run, reason)
      class(deck_rates_t), intent(in) :: self              !! the simulations
      type(worn_surface_t), intent(in) :: surfaces(:)      !! (surfaces) their profiles
      integer, intent(in) :: settling                      !! which settling cycles
      integer, intent(in) :: n_values                      !! conditions
      type(simulation_t), intent(inout) :: run             !! its start is known; what it gives is set
      character(:), allocatable, intent(out) :: reason     !! why it failed; blank: it did not

      allocate (run%rates(self%state%n), run%values(n_values), run%loads(self%plan%n_loads), source=0.0_wp)
      call simulate(self%job, self%plan, self%spans(settling), surfaces, merge(run%start, 0, self%has_ensemble), self%state, &
                    run%rates, run%values, run%loads, reason)
   end subroutine make_run

   !> Make a simulation in a process of its own.
   subroutine start_process(self, surfaces, settling, n_values, run, process, error)
      class(deck_rates_t), intent(inout) :: self           !! the simulations
      type(worn_surface_t), intent(in) :: surfaces(:)      !! (surfaces) their profiles
      integer, intent(in) :: settling                      !! which settling cycles
      integer, intent(in) :: n_values                      !! conditions
      type(simulation_t), intent(inout) :: run             !! its start is known
      integer, intent(out) :: process                      !! number of the process
      type(error_t), allocatable, intent(out) :: error     !! it cannot be started

      type(packer_t) :: packer
      character(:), allocatable :: reason

      if (start_member(no_log, process) /= 0) then
         call set_error(error, exit_file, "cannot start a process for a simulation; --jobs 1 needs none")
         return
      end if
      if (process /= 0) return
      call self%directory%leave()
      call make_run(self, surfaces, settling, n_values, run, reason)
      call packer%text(reason)
      call packer%reals(run%rates)
      call packer%reals(run%values)
      call packer%reals(run%loads)
      call end_process(merge(exit_ok, exit_file, hand_back(packer%bytes%get()) == 0))
   end subroutine start_process

   !> What the process of a simulation handed back.
   subroutine unpack_run(bytes, code, run, reason)
      character(*), intent(in) :: bytes                    !! what it handed back
      integer, intent(in) :: code                          !! its exit code
      type(simulation_t), intent(inout) :: run             !! what it gave is set
      character(:), allocatable, intent(out) :: reason     !! why it failed; blank: it did not

      type(unpacker_t) :: unpacker

      unpacker%bytes = bytes
      call unpacker%text(reason)
      call unpacker%reals(run%rates)
      call unpacker%reals(run%values)
      call unpacker%reals(run%loads)
      if (code == exit_ok .and. unpacker%is_good) return
      reason = "its process ended with exit code "//to_text(code)
      if (code > 128) reason = "its process was ended by signal "//to_text(code - 128)
   end subroutine unpack_run

   !> Write a simulation to the journal, or the error why it failed.
   subroutine take_run(self, run, reason, starts, error)
      class(deck_rates_t), intent(inout) :: self           !! the simulations
      type(simulation_t), intent(in) :: run                !! what it gave
      character(*), intent(in) :: reason                   !! why it failed; blank: it did not
      integer, intent(in) :: starts                        !! starts of the ensemble
      type(error_t), allocatable, intent(out) :: error     !! it failed, or cannot be written

      character(:), allocatable :: which

      if (reason == "") then
         self%n_made = self%n_made + 1
         call self%journal%add(run, error)
         return
      end if
      which = ""
      if (starts > 1) which = " from start "//to_text(run%start)
      call set_error(error, exit_integration, "simulation of profile "//to_text(run%profile)//which//" failed: "//reason)
   end subroutine take_run

   !> Show how far the life is.
   subroutine show_part(self, fraction)
      class(deck_rates_t), intent(inout) :: self   !! the simulations
      real(wp), intent(in) :: fraction             !! of the life [1]

      call self%display%update(fraction)
   end subroutine show_part

end module deck_rates
