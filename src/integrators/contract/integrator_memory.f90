!> What an integrator remembers in a checkpoint: what every one keeps, and what a method adds.
submodule(integrator) integrator_memory
   use checkpoint, only: add_segment
   use memory, only: get, put
   implicit none (type, external)

contains

   !> List what the integrator saves: what every one keeps, then what the method adds.
   module procedure integrator_list_memory

      call add_segment(segments, "the state", base_version, self%base_memory_size())
      call add_segment(segments, "method = "//self%name(), self%memory_version(), self%memory_size() - self%base_memory_size())
   end procedure integrator_list_memory

   !> Numbers that a checkpoint needs; a method that remembers more adds to it.
   module procedure integrator_memory_size
      n = self%base_memory_size()
   end procedure integrator_memory_size

   !> Write what the integrator remembers.
   module procedure integrator_save
      call self%save_base(row, place)
   end procedure integrator_save

   !> Read what the integrator remembers.
   module procedure integrator_load
      call self%load_base(row, place)
   end procedure integrator_load

   !> Numbers that every integrator keeps: time, state, derivative, event functions, contacts passed over and counters.
   module procedure base_memory_size
      n = 5 + 2*size(self%step%y1) + 10*size(self%events%g1)
   end procedure base_memory_size

   !> Write what every integrator keeps.
   module procedure save_base
      integer :: k

      call put(row, place, self%t)
      call put(row, place, self%count%n_steps)
      call put(row, place, self%count%n_rejected)
      call put(row, place, self%count%n_evaluations)
      call put(row, place, self%count%n_output_evaluations)
      call put(row, place, self%step%y1)
      call put(row, place, self%step%f1)
      call put(row, place, self%events%g1)
      call put(row, place, self%events%rate1)
      call put(row, place, self%onset%gap)
      call put(row, place, self%onset%rate)
      call put(row, place, self%onset%passed%first)
      call put(row, place, self%onset%passed%deepest)
      call put(row, place, self%onset%passed%at)
      do k = 1, size(self%events%g1)
         call put(row, place, self%onset%passed%n(k))
         call put(row, place, self%events%is_hidden(k))
         call put(row, place, self%onset%is_waiting(k))
      end do
   end procedure save_base

   !> Read what every integrator keeps. The last step itself is over: its length is set to zero.
   module procedure load_base
      integer :: k

      call get(row, place, self%t)
      call get(row, place, self%count%n_steps)
      call get(row, place, self%count%n_rejected)
      call get(row, place, self%count%n_evaluations)
      call get(row, place, self%count%n_output_evaluations)
      call get(row, place, self%step%y1)
      call get(row, place, self%step%f1)
      call get(row, place, self%events%g1)
      call get(row, place, self%events%rate1)
      call get(row, place, self%onset%gap)
      call get(row, place, self%onset%rate)
      call get(row, place, self%onset%passed%first)
      call get(row, place, self%onset%passed%deepest)
      call get(row, place, self%onset%passed%at)
      do k = 1, size(self%events%g1)
         call get(row, place, self%onset%passed%n(k))
         call get(row, place, self%events%is_hidden(k))
         call get(row, place, self%onset%is_waiting(k))
      end do
      self%step%t0 = self%t
      self%step%h = 0.0_wp
      self%step%has_inner = .false.
      self%events%n_happened = 0
   end procedure load_base

end submodule integrator_memory
