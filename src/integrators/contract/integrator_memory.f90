!> What an integrator remembers in a checkpoint: what every one keeps, and what a method adds.
submodule(integrator) integrator_memory
   implicit none (type, external)

contains

   !> Write what the integrator remembers.
   module procedure integrator_save
      call self%save_base(archive)
   end procedure integrator_save

   !> Read what the integrator remembers.
   module procedure integrator_load
      call self%load_base(archive)
   end procedure integrator_load

   !> Write what every integrator keeps: time, state, derivative, event functions, contacts passed over and counters.
   module procedure save_base
      integer :: k

      call archive%begin("the state", base_version)
      call archive%put(self%t)
      call archive%put(self%count%n_steps)
      call archive%put(self%count%n_rejected)
      call archive%put(self%count%n_evaluations)
      call archive%put(self%count%n_output_evaluations)
      call archive%put(self%step%y1)
      call archive%put(self%step%f1)
      call archive%put(self%events%g1)
      call archive%put(self%events%rate1)
      call archive%put(self%onset%gap)
      call archive%put(self%onset%rate)
      call archive%put(self%onset%passed%first)
      call archive%put(self%onset%passed%deepest)
      call archive%put(self%onset%passed%at)
      do k = 1, size(self%events%g1)
         call archive%put(self%onset%passed%n(k))
         call archive%put(self%events%is_hidden(k))
         call archive%put(self%onset%is_waiting(k))
      end do
      call archive%begin("method = "//self%name(), self%memory_version())
   end procedure save_base

   !> Read what every integrator keeps. The last step itself is over: its length is set to zero.
   module procedure load_base
      integer :: k

      call archive%get(self%t)
      call archive%get(self%count%n_steps)
      call archive%get(self%count%n_rejected)
      call archive%get(self%count%n_evaluations)
      call archive%get(self%count%n_output_evaluations)
      call archive%get(self%step%y1)
      call archive%get(self%step%f1)
      call archive%get(self%events%g1)
      call archive%get(self%events%rate1)
      call archive%get(self%onset%gap)
      call archive%get(self%onset%rate)
      call archive%get(self%onset%passed%first)
      call archive%get(self%onset%passed%deepest)
      call archive%get(self%onset%passed%at)
      do k = 1, size(self%events%g1)
         call archive%get(self%onset%passed%n(k))
         call archive%get(self%events%is_hidden(k))
         call archive%get(self%onset%is_waiting(k))
      end do
      self%step%t0 = self%t
      self%step%h = 0.0_wp
      self%step%has_inner = .false.
      self%events%n_happened = 0
   end procedure load_base

end submodule integrator_memory
