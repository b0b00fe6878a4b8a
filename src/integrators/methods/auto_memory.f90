!> What the method that chooses remembers in a checkpoint: its choices, and the implicit part once it was chosen.
submodule(auto) auto_memory
   use one_step, only: one_step_load, one_step_save
   implicit none (type, external)

contains

   !> Version of the form of what is saved.
   module procedure auto_memory_version
      version = 2
   end procedure auto_memory_version

   !> Write what the integrator remembers; how much of the implicit part, the choices of the run decide.
   module procedure auto_save
      type(archive_t) :: part

      call one_step_save(self, archive)
      call self%choice%save(archive)
      call archive%put(self%is_implicit)
      if (allocated(self%saved)) then
         call part%put(self%saved)
      else if (allocated(self%stiff)) then
         call self%stiff%pace%save(part)
         call self%stiff%save_own(part)
      end if
      call archive%put(part%n)
      call archive%begin("implicit part of method = auto", 4, is_fixed=.false.)
      if (part%n > 0) call archive%put(part%row(:part%n))
   end procedure auto_save

   !> Read what the integrator remembers.
   module procedure auto_load
      call one_step_load(self, archive)
      call self%choice%load(archive)
      call archive%get(self%is_implicit)
      if (allocated(self%stiff)) deallocate (self%stiff)
      call archive%get_list(self%saved)
      if (size(self%saved) == 0) deallocate (self%saved)
   end procedure auto_load

   !> The implicit part takes back what a checkpoint holds of it.
   module procedure take_saved
      type(archive_t) :: part

      call self%stiff%open(system, status)
      if (status /= advance_step) return
      call part%put(self%saved)
      self%stiff%pace = step_control_t(order=real(self%stiff%order, wp))
      call self%stiff%pace%load(part)
      call self%stiff%load_own(part)
      deallocate (self%saved)
      if (.not. part%is_at_end()) status = advance_failed_evaluation
   end procedure take_saved

end submodule auto_memory
