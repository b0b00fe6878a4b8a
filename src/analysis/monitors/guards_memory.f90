!> What the guards remember in a checkpoint.
submodule(guards) guards_memory
   implicit none (type, external)

contains

   !> Write what was seen.
   module procedure guards_save
      integer :: g, k

      call self%films%save(archive)
      call archive%put(self%n_wrong)
      if (.not. self%is_set) return
      do k = 1, size(self%breach, 2)
         do g = 1, n_contact_guard
            call archive%put(transfer(self%breach(g, k), [0.0_wp]))
         end do
      end do
      do k = 1, size(self%travel)
         call archive%put(transfer(self%travel(k), [0.0_wp]))
      end do
   end procedure guards_save

   !> Take it back.
   module procedure guards_load
      real(wp) :: numbers(size(transfer(breach_t(), [0.0_wp])))
      integer :: g, k

      call self%films%load(archive)
      call archive%get(self%n_wrong)
      if (.not. self%is_set) return
      do k = 1, size(self%breach, 2)
         do g = 1, n_contact_guard
            call archive%get(numbers)
            self%breach(g, k) = transfer(numbers, self%breach(g, k))
         end do
      end do
      do k = 1, size(self%travel)
         call archive%get(numbers)
         self%travel(k) = transfer(numbers, self%travel(k))
      end do
   end procedure guards_load

end submodule guards_memory
