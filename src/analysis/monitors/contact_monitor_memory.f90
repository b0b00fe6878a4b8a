!> What the monitor over contacts remembers in a checkpoint.
submodule(contact_monitor) contact_monitor_memory
   implicit none (type, external)

contains

   !> Write what the monitor remembers.
   module procedure monitor_save
      integer :: k

      do k = 1, size(self%force)
         call archive%put([self%force(k)%value, self%force(k)%rate, self%penetration(k)%value, self%penetration(k)%rate])
         call archive%put(self%owes_row(k))
         call archive%put(self%told(k))
         call archive%put(self%low(:, k))
      end do
      call self%wear%save(archive)
   end procedure monitor_save

   !> Read what the monitor remembers.
   module procedure monitor_load
      integer :: k

      do k = 1, size(self%force)
         call archive%get(self%force(k)%value)
         call archive%get(self%force(k)%rate)
         call archive%get(self%penetration(k)%value)
         call archive%get(self%penetration(k)%rate)
         call archive%get(self%owes_row(k))
         call archive%get(self%told(k))
         call archive%get(self%low(1, k))
         call archive%get(self%low(2, k))
      end do
      call self%wear%load(archive)
   end procedure monitor_load

end submodule contact_monitor_memory
