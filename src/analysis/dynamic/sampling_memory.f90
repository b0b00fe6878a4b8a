!> How far the reports of a motion are, in a checkpoint.
submodule(sampling) sampling_memory
   implicit none (type, external)

contains

   !> Write how far the reports are.
   module procedure save_samples
      call tape%put(self%n_sample)
      call tape%put(self%n_strobe)
      call tape%put(self%n_row)
      call tape%put(self%n_reports)
      call tape%put([self%t_row, self%aside%seconds()])
      call self%films%save(tape)
      call self%peaks%save(tape)
      call self%stride%save(tape)
   end procedure save_samples

   !> Take it back.
   module procedure load_samples
      real(wp) :: aside

      call tape%get(self%n_sample)
      call tape%get(self%n_strobe)
      call tape%get(self%n_row)
      call tape%get(self%n_reports)
      call tape%get(self%t_row)
      call tape%get(aside)
      call self%aside%begin(aside)
      call self%films%load(tape)
      call self%peaks%load(tape)
      call self%stride%load(tape)
      self%due = -huge(1.0_wp)
   end procedure load_samples

end submodule sampling_memory
