!> What a recorder remembers, when a run is saved, and who may end it.
submodule(run_recorder) run_recorder_memory
   use checkpoint_file, only: checkpoint_name, write_checkpoint
   use errors, only: exit_usage
   use exponent, only: horizon_t
   use film_fields, only: load_fields, save_fields
   use horizon_memory, only: load_horizon, save_horizon
   use posix, only: remove_file
   use processes, only: asked_by, clock_ms
   use saved_run, only: action_checkpoint, action_none, action_stop
   implicit none (type, external)

   integer, parameter :: steps_between = 64               !! steps between two looks at the clock
   integer(i8), parameter :: ms_between = 600000_i8       !! time between two checkpoints of a run that can be saved anywhere [ms]
   integer(i8), parameter :: second = 1000_i8             !! in milliseconds [ms]

contains

   !> Whether the run is to be saved or to end. Where it can be saved at some instants only, it ends at the last that is safely
   !> within the time of the wall.
   module procedure action_of_run
      requested_action = action_none
      associate (pace => self%pace, life => self%plan%life)
         if (.not. life%is_saved) return
         if (asked_by() /= 0 .or. self%last_time >= life%stop_at) then
            requested_action = action_stop
            self%stopped_by = "a signal"
            return
         end if
         pace%n_step = pace%n_step + 1
         if (pace%n_step < steps_between .and. .not. (can_save .and. pace%longest >= second)) return
         pace%n_step = 0
      end associate
      requested_action = action_by_clock(self, can_save)
   end procedure action_of_run

   !> The same, by the time that it is.
   integer function action_by_clock(self, can_save) result(requested_action)
      class(run_recorder_t), intent(inout) :: self  !! the recorder
      logical, intent(in) :: can_save               !! the run can be saved as it is

      integer(i8) :: gap, left, now

      requested_action = action_none
      associate (pace => self%pace, life => self%plan%life)
         now = clock_ms()
         if (pace%saved_at == 0) pace%saved_at = now
         gap = 0
         if (can_save) then
            if (pace%could_save_at > 0) pace%longest = max(pace%longest, now - pace%could_save_at)
            pace%could_save_at = now
            gap = pace%longest
         end if
         left = nint(1000.0_wp*life%walltime, i8) - (now - life%begun)
         if (life%walltime > 0.0_wp .and. left <= gap + 2*pace%cost + min(second, nint(50.0_wp*life%walltime, i8))) then
            requested_action = action_stop
            self%stopped_by = "the time limit of --walltime"
         else if (can_save .and. now - pace%saved_at >= ms_between) then
            requested_action = action_checkpoint
         end if
      end associate
   end function action_by_clock

   !> Write all that waits, and the checkpoint. A checkpoint that cannot be written is a failure: the run could not continue from
   !> where its reader believes.
   module procedure save_run
      integer(i8) :: begun

      if (.not. self%plan%life%is_saved) return
      begun = clock_ms()
      if (self%plan%with%hdf5) call self%hdf5%flush(self%events, error)
      if (self%plan%with%texts .and. .not. allocated(error)) call self%texts%flush(self%last_time, self%events, error)
      if (self%plan%with%motion .and. .not. allocated(error)) call self%motion%flush(error)
      self%is_broken = self%is_broken .or. allocated(error)
      if (allocated(error)) return
      associate (archive => saved%output)
         call save_horizon(self%plan%horizon, archive)  ! the first: it is requested before the recorder starts
         call archive%put(self%last_time)
         call self%events%save(archive)
         call self%statistics%save(archive)
         call self%extremes%save(archive)
         call self%keeper%save(archive)
         call save_fields(self%fields, archive)
         call self%rows%save(archive)
         if (self%plan%with%hdf5) call self%hdf5%save(archive)
         if (self%plan%with%texts) call self%texts%save(archive)
         if (self%plan%with%motion) call self%motion%save(archive)
      end associate
      call write_checkpoint(self%plan, saved, error)
      self%pace%saved_at = clock_ms()
      self%pace%cost = max(self%pace%cost, self%pace%saved_at - begun)
   end procedure save_run

   !> Take back what was remembered, and take over the files.
   module procedure go_on_with_run
      type(horizon_t) :: before   ! in the plan by now
      integer :: ignored

      ignored = remove_file(self%plan%directory//"/summary.json")  ! whose presence means that the run has ended
      ignored = remove_file(self%plan%directory//"/summary.txt")
      associate (archive => saved%output)
         call load_horizon(archive, before)
         call archive%get(self%last_time)
         call self%events%load(archive)
         call self%statistics%load(archive)
         call self%extremes%load(archive)
         call self%keeper%load(archive)
         call load_fields(archive, self%fields)
         call self%rows%load(archive)
         if (self%plan%with%hdf5) call self%hdf5%go_on(archive, error)
         if (self%plan%with%texts .and. .not. allocated(error)) call self%texts%go_on(archive, error)
         if (self%plan%with%motion .and. .not. allocated(error)) call self%motion%go_on(archive, error)
         if (allocated(error)) then
            self%is_broken = .true.
         else if (.not. archive%is_at_end()) then
            call set_error(error, exit_usage, "the checkpoint does not belong to this run: its output data have "// &
                           "another length")
         end if
      end associate
   end procedure go_on_with_run

   !> Remove the checkpoint.
   module procedure forget_checkpoint
      integer :: ignored

      if (self%plan%life%is_saved) ignored = remove_file(self%plan%directory//"/"//checkpoint_name)
   end procedure forget_checkpoint

end submodule run_recorder_memory
