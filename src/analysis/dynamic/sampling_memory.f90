!> How far the reports of a motion are, in a checkpoint.
submodule(sampling) sampling_memory
   implicit none (type, external)

contains

   !> Write how far the reports are.
   module procedure save_samples
      call archive%put(self%n_sample)
      call archive%put(self%n_poincare)
      call archive%put(self%n_row)
      call archive%put(self%n_reports)
      call archive%put([self%t_row, self%aside%seconds()])
      call self%films%save(archive)
      call self%peaks%save(archive)
      call self%stride%save(archive)
   end procedure save_samples

   !> Take it back.
   module procedure load_samples
      real(wp) :: aside

      call archive%get(self%n_sample)
      call archive%get(self%n_poincare)
      call archive%get(self%n_row)
      call archive%get(self%n_reports)
      call archive%get(self%t_row)
      call archive%get(aside)
      call self%aside%begin(aside)
      call self%films%load(archive)
      call self%peaks%load(archive)
      call self%stride%load(archive)
      self%due = -huge(1.0_wp)
   end procedure load_samples

end submodule sampling_memory
