!> What Radau IIA remembers in a checkpoint: nothing of states within the last step, which is over.
submodule(radau) radau_memory
   implicit none (type, external)

contains

   !> Version of the form of what is saved.
   module procedure radau_memory_version
      version = 2
   end procedure radau_memory_version

   !> Write what the integrator remembers.
   module procedure radau_save
      call one_step_save(self, archive)
      call self%save_own(archive)
   end procedure radau_save

   !> Write what is its own.
   module procedure radau_save_own
      integer :: k

      call archive%put([self%now%t, self%now%h, self%contraction, self%h_matrix, self%h_gmres])
      call archive%put(self%is_stale)
      call archive%put(self%is_stiff)
      do k = 1, 3
         call archive%put(self%now%z(:, k))
      end do
      call self%matrix%save(archive)
   end procedure radau_save_own

   !> Read what the integrator remembers.
   module procedure radau_load
      call one_step_load(self, archive)
      call self%load_own(archive)
   end procedure radau_load

   !> Read what is its own.
   module procedure radau_load_own
      integer :: k

      call archive%get(self%now%t)
      call archive%get(self%now%h)
      call archive%get(self%contraction)
      call archive%get(self%h_matrix)
      call archive%get(self%h_gmres)
      call archive%get(self%is_stale)
      call archive%get(self%is_stiff)
      do k = 1, 3
         call archive%get(self%now%z(:, k))
      end do
      call self%matrix%load(archive)
      self%stage%h = 0.0_wp
   end procedure radau_load_own

end submodule radau_memory
