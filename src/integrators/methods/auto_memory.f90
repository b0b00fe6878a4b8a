!> What the method that chooses remembers in a checkpoint: its choices, and the implicit part once it was chosen.
submodule(auto) auto_memory
   use checkpoint, only: add_segment
   use integrator, only: integrator_list_memory
   use memory, only: get, put
   use method_choice, only: n_choice_number
   use one_step, only: one_step_load, one_step_memory_size, one_step_save
   use step_control, only: n_control_number
   implicit none (type, external)

   integer, parameter :: n_number = 2   !! numbers beside the choice and the implicit part

contains

   !> List what the integrator saves, and the implicit part behind it.
   module procedure auto_list_memory
      call integrator_list_memory(self, segments)
      segments(size(segments))%size = segments(size(segments))%size - size_of_part(self)
      call add_segment(segments, "implicit part of method = auto", 3, size_of_part(self), is_fixed=.false.)
   end procedure auto_list_memory

   !> Version of the form of what is saved.
   module procedure auto_memory_version
      version = 1
   end procedure auto_memory_version

   !> Numbers that a checkpoint needs.
   module procedure auto_memory_size
      n = one_step_memory_size(self) + n_choice_number + n_number + size_of_part(self)
   end procedure auto_memory_size

   !> Numbers of the implicit part.
   pure integer function size_of_part(self) result(n)
      class(auto_t), intent(in) :: self  !! the integrator

      n = 0
      if (allocated(self%saved)) then
         n = size(self%saved)
      else if (allocated(self%stiff)) then
         n = n_control_number + self%stiff%own_memory_size()
      end if
   end function size_of_part

   !> Write what the integrator remembers.
   module procedure auto_save
      call one_step_save(self, row, place)
      call self%choice%save(row, place)
      call put(row, place, self%is_implicit)
      call put(row, place, size_of_part(self))
      if (allocated(self%saved)) then
         call put(row, place, self%saved)
      else if (allocated(self%stiff)) then
         call self%stiff%pace%save(row, place)
         call self%stiff%save_own(row, place)
      end if
   end procedure auto_save

   !> Read what the integrator remembers.
   module procedure auto_load
      integer :: n

      call one_step_load(self, row, place)
      call self%choice%load(row, place)
      call get(row, place, self%is_implicit)
      call get(row, place, n)
      if (allocated(self%stiff)) deallocate (self%stiff)
      if (allocated(self%saved)) deallocate (self%saved)
      n = min(max(n, 0), size(row) - place)
      if (n == 0) return
      self%saved = row(place + 1:place + n)
      place = place + n
   end procedure auto_load

   !> The implicit part takes back what a checkpoint holds of it.
   module procedure take_saved
      integer :: place

      call self%stiff%open(system, status)
      if (status /= advance_step) return
      if (size(self%saved) /= n_control_number + self%stiff%own_memory_size()) then
         status = advance_failed_evaluation
         return
      end if
      place = 0
      self%stiff%pace = step_control_t(order=real(self%stiff%order, wp))
      call self%stiff%pace%load(self%saved, place)
      call self%stiff%load_own(self%saved, place)
      deallocate (self%saved)
   end procedure take_saved

end submodule auto_memory
