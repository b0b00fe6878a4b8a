!> What Radau IIA remembers in a checkpoint.
submodule(radau) radau_memory
   use memory, only: get, put
   implicit none (type, external)

contains

   !> Numbers that a checkpoint needs.
   module procedure radau_memory_size
      n = one_step_memory_size(self) + self%own_memory_size()
   end procedure radau_memory_size

   !> Numbers of the stages, the matrix and their lengths of steps.
   module procedure radau_own_memory_size
      n = 7 + 3*self%n + self%nodes%memory_size() + self%matrix%memory_size()
   end procedure radau_own_memory_size

   !> Write what the integrator remembers.
   module procedure radau_save
      call one_step_save(self, row, place)
      call self%save_own(row, place)
   end procedure radau_save

   !> Write what is its own.
   module procedure radau_save_own
      integer :: k

      call put(row, place, [self%now%t, self%now%h, self%contraction, self%h_matrix, self%h_gmres])
      call put(row, place, self%is_stale)
      call put(row, place, self%is_stiff)
      do k = 1, 3
         call put(row, place, self%now%z(:, k))
      end do
      call self%nodes%save(row, place)
      call self%matrix%save(row, place)
   end procedure radau_save_own

   !> Read what the integrator remembers.
   module procedure radau_load
      call one_step_load(self, row, place)
      call self%load_own(row, place)
   end procedure radau_load

   !> Read what is its own.
   module procedure radau_load_own
      integer :: k

      call get(row, place, self%now%t)
      call get(row, place, self%now%h)
      call get(row, place, self%contraction)
      call get(row, place, self%h_matrix)
      call get(row, place, self%h_gmres)
      call get(row, place, self%is_stale)
      call get(row, place, self%is_stiff)
      do k = 1, 3
         call get(row, place, self%now%z(:, k))
      end do
      call self%nodes%load(row, place)
      call self%matrix%load(row, place)
      self%stage%h = 0.0_wp
   end procedure radau_load_own

end submodule radau_memory
