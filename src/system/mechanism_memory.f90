!> What a planar scene remembers, for checkpoints.
submodule(mechanism) mechanism_memory
   use memory, only: get, put
   implicit none (type, external)

contains

   !> Numbers that a checkpoint needs: the memory of all sets, the counters, the pace and the stretch of smooth time.
   module procedure mechanism_memory_size
      integer :: k

      n = 9 + self%way%memory_size()
      do k = 1, size(self%linkage%joints)
         n = n + self%linkage%joints(k)%set%memory_size()
      end do
      do k = 1, size(self%loading%forces)
         n = n + self%loading%forces(k)%set%memory_size()
      end do
      do k = 1, size(self%clearances)
         n = n + self%clearances(k)%set%memory_size()
      end do
   end procedure mechanism_memory_size

   !> Write what the system remembers.
   module procedure mechanism_save
      integer :: k

      call put(row, place, self%n_evaluations)
      call put(row, place, self%linkage%solution%n_damped)
      call put(row, place, [self%linkage%scales%pace, self%linkage%scales%late_rate, self%grips%h])
      call self%way%save(row, place)
      call put(row, place, self%linkage%solution%solver%n_factorisations)
      call put(row, place, self%linkage%piece%low)
      call put(row, place, self%linkage%piece%high)
      call put(row, place, self%linkage%piece%end)
      do k = 1, size(self%linkage%joints)
         call self%linkage%joints(k)%set%save(row, place)
      end do
      do k = 1, size(self%loading%forces)
         call self%loading%forces(k)%set%save(row, place)
      end do
      do k = 1, size(self%clearances)
         call self%clearances(k)%set%save(row, place)
      end do
   end procedure mechanism_save

   !> Read what the system remembers.
   module procedure mechanism_load
      integer :: k

      call get(row, place, self%n_evaluations)
      call get(row, place, self%linkage%solution%n_damped)
      call get(row, place, self%linkage%scales%pace)
      call get(row, place, self%linkage%scales%late_rate)
      call get(row, place, self%grips%h)
      call self%way%load(row, place)
      call get(row, place, self%linkage%solution%solver%n_factorisations)
      call get(row, place, self%linkage%piece%low)
      call get(row, place, self%linkage%piece%high)
      call get(row, place, self%linkage%piece%end)
      do k = 1, size(self%linkage%joints)
         call self%linkage%joints(k)%set%load(row, place)
      end do
      do k = 1, size(self%loading%forces)
         call self%loading%forces(k)%set%load(row, place)
      end do
      do k = 1, size(self%clearances)
         call self%clearances(k)%set%load(row, place)
      end do
   end procedure mechanism_load

end submodule mechanism_memory
