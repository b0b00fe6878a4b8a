!> What the extremes of a run remember in a checkpoint.
submodule(extremes) extremes_memory
   implicit none (type, external)

contains

   !> Write what was gathered.
   module procedure save_extremes
      integer :: k

      call archive%put(self%n_sample)
      call archive%put([self%t_first, self%t_last, self%first_row, self%last_row])
      do k = 1, size(self%of)
         call archive%put(transfer(self%of(k), [0.0_wp]))
      end do
   end procedure save_extremes

   !> Take it back.
   module procedure load_extremes
      real(wp) :: numbers(size(transfer(extreme_t(), [0.0_wp])))
      integer :: k

      call archive%get(self%n_sample)
      call archive%get(self%t_first)
      call archive%get(self%t_last)
      call archive%get(self%first_row)
      call archive%get(self%last_row)
      do k = 1, size(self%of)
         call archive%get(numbers)
         self%of(k) = transfer(numbers, self%of(k))
      end do
   end procedure load_extremes

end submodule extremes_memory
