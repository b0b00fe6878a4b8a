!> What the statistics of a run remember in a checkpoint.
submodule(statistics) statistics_memory
   implicit none (type, external)

contains

   !> Write what was gathered.
   module procedure save_statistics
      integer :: k

      if (.not. self%plan%is_wanted) return
      call tape%put([self%n_strobe, self%n_sample])
      call tape%put([self%t_first, self%t_last, self%x_last, self%integral, self%integral_2, self%gap, self%lowest, self%highest])
      do k = 1, self%n_strobe
         call tape%put([self%strobe_times(k), self%strobes(:, k)])
      end do
      do k = 1, merge(self%n_sample, 0, size(self%spectra) > 0)
         call tape%put(self%series(:, k))
      end do
   end procedure save_statistics

   !> Take it back.
   module procedure load_statistics
      integer :: k, n

      if (.not. self%plan%is_wanted) return
      call tape%get(n)
      call tape%get(self%n_sample)
      call tape%get(self%t_first)
      call tape%get(self%t_last)
      call tape%get(self%x_last)
      call tape%get(self%integral)
      call tape%get(self%integral_2)
      call tape%get(self%gap)
      call tape%get(self%lowest)
      call tape%get(self%highest)
      self%n_strobe = 0
      do k = 1, n
         call make_room_for_strobe(self)
         call tape%get(self%strobe_times(k))
         call tape%get(self%strobes(:, k))
      end do
      do k = 1, merge(self%n_sample, 0, size(self%spectra) > 0)
         call make_room(self%series, k)
         call tape%get(self%series(:, k))
      end do
   end procedure load_statistics

end submodule statistics_memory
