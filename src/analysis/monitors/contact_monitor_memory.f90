!> What the monitor over contacts remembers in a checkpoint.
submodule(contact_monitor) contact_monitor_memory
   use memory, only: get, put
   implicit none (type, external)

contains

   !> Numbers that a checkpoint needs.
   module procedure monitor_memory_size
      n = n_remembered*size(self%force)
   end procedure monitor_memory_size

   !> Write what the monitor remembers.
   module procedure monitor_save
      integer :: k

      do k = 1, size(self%force)
         call put(row, place, [self%force(k)%value, self%force(k)%rate, self%penetration(k)%value, self%penetration(k)%rate])
         call put(row, place, self%owes_row(k))
         call put(row, place, self%told(k))
         call put(row, place, self%low(:, k))
      end do
   end procedure monitor_save

   !> Read what the monitor remembers.
   module procedure monitor_load
      integer :: k

      do k = 1, size(self%force)
         call get(row, place, self%force(k)%value)
         call get(row, place, self%force(k)%rate)
         call get(row, place, self%penetration(k)%value)
         call get(row, place, self%penetration(k)%rate)
         call get(row, place, self%owes_row(k))
         call get(row, place, self%told(k))
         call get(row, place, self%low(1, k))
         call get(row, place, self%low(2, k))
      end do
   end procedure monitor_load

end submodule contact_monitor_memory
