!> What the statistics of a run remember in a checkpoint.
submodule(statistics) statistics_memory
   implicit none (type, external)

contains

   !> Write what was gathered.
   module procedure save_statistics
      integer :: k

      if (.not. self%plan%is_wanted) return
      call archive%put([self%n_poincare, self%n_sample])
      call archive%put([self%t_first, self%t_last, self%x_last, self%integral, self%integral_2, self%gap, self%lowest, &
                        self%highest])
      do k = 1, self%n_poincare
         call archive%put([self%poincare_times(k), self%poincare_samples(:, k)])
      end do
      do k = 1, merge(self%n_sample, 0, size(self%spectra) > 0)
         call archive%put(self%series(:, k))
      end do
   end procedure save_statistics

   !> Take it back.
   module procedure load_statistics
      integer :: k, n

      if (.not. self%plan%is_wanted) return
      call archive%get(n)
      call archive%get(self%n_sample)
      call archive%get(self%t_first)
      call archive%get(self%t_last)
      call archive%get(self%x_last)
      call archive%get(self%integral)
      call archive%get(self%integral_2)
      call archive%get(self%gap)
      call archive%get(self%lowest)
      call archive%get(self%highest)
      self%n_poincare = 0
      do k = 1, n
         call make_storage_for_poincare(self)
         call archive%get(self%poincare_times(k))
         call archive%get(self%poincare_samples(:, k))
      end do
      do k = 1, merge(self%n_sample, 0, size(self%spectra) > 0)
         call make_storage(self%series, k)
         call archive%get(self%series(:, k))
      end do
   end procedure load_statistics

end submodule statistics_memory
