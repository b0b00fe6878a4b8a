!> A run is saved, and continues from what was saved.
submodule(dynamic) dynamic_memory
   use run_memory, only: load_run, save_run
   implicit none (type, external)

contains

   !> Continue from what was saved, instead of from the start.
   module procedure go_on
      call load_run(saved, run%whole, run%sampler, run%tally, run%stop, run%cpu_before, error)
      if (.not. allocated(error)) call recorder%go_on(saved, error)
      run%saved_at = run%whole%t
   end procedure go_on

   !> The instant of the plan that comes next.
   module procedure next_checkpoint
      if (plan%checkpoint <= 0.0_wp) return
      do
         run%next_checkpoint = (run%n_checkpoint + 1)*plan%checkpoint
         if (run%next_checkpoint > run%whole%t) return
         run%n_checkpoint = run%n_checkpoint + 1
      end do
   end procedure next_checkpoint

   !> Save the run.
   module procedure save_now
      type(saved_run_t) :: saved
      real(wp) :: aside, cpu_0, cpu_1

      aside = run%tally%aside%seconds()
      call cpu_time(cpu_0)
      call save_run(run%whole, run%sampler, run%tally, run%stop, run%cpu_before + cpu_0 - run%cpu_begin, saved)
      call recorder%save(saved, error)
      if (allocated(error)) return
      run%saved_at = run%whole%t
      if (run%is_scheduled .and. .not. run%is_stopped) then
         call load_run(saved, run%whole, run%sampler, run%tally, run%stop, cpu_1, error)
      end if
      call next_checkpoint(run, plan)
      call cpu_time(cpu_1)
      call run%tally%aside%begin(aside + cpu_1 - cpu_0)
   end procedure save_now

end submodule dynamic_memory
