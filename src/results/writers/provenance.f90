!> The group /provenance: whatever may differ between two equal runs, and what is needed to make a run again.
module provenance
   use digest, only: sha256
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: text_dataset
   use hdf5_scales, only: add_scale, close_scales, scales_t, take_scales_of_path
   use output_plan, only: output_plan_t
   use posix, only: host_name, utc_time
   use processor, only: processor_name
   use text, only: text_t
   implicit none (type, external)
   private
   public :: make_provenance

   !> Variables of the environment that Slurm sets, and attributes that keep them.
   character(*), parameter :: slurm_variables(*) = [character(20) :: "SLURM_JOB_ID", "SLURM_ARRAY_JOB_ID", "SLURM_ARRAY_TASK_ID", &
                                                    "SLURM_RESTART_COUNT", "SLURM_CLUSTER_NAME"]
   character(*), parameter :: slurm_attributes(size(slurm_variables)) = [character(20) :: "slurm_job_id", "slurm_array_job_id", &
                                                            "slurm_array_task_id", "slurm_restart_count", "slurm_cluster_name"]

contains

   !> Make the group.
   subroutine make_provenance(file, plan, status)
      integer(hid_t), intent(in) :: file       !! the file
      type(output_plan_t), intent(in) :: plan  !! what it says of the run
      integer, intent(inout) :: status         !! negative: failed

      type(scales_t) :: scales
      type(text_t), allocatable :: digests(:), names(:)
      integer(hid_t) :: group
      integer :: closed, k

      call new_group(file, "provenance", group, status)
      call text_attribute(group, "created", utc_time(), status)
      call text_attribute(group, "command", plan%origin%command, status)
      call text_attribute(group, "host", host_name(), status)
      call text_attribute(group, "processor", processor_name(), status)
      call text_attribute(group, "compile_flags", plan%origin%flags, status)
      call text_attribute(group, "blas_kernels", plan%origin%kernels, status)
      if (plan%life%goes_on) call real_attribute(group, "resumed_from", plan%life%resumed_from, status)
      do k = 1, size(slurm_variables)
         call keep_variable(group, trim(slurm_variables(k)), trim(slurm_attributes(k)), status)
      end do
      associate (origin => plan%origin)
         allocate (names(1 + size(origin%include_names)), digests(1 + size(origin%include_names)))
         names(1)%s = origin%deck_name
         digests(1)%s = sha256(origin%deck_text)
         do k = 1, size(origin%include_names)
            names(1 + k)%s = origin%include_names(k)%s
            digests(1 + k)%s = sha256(origin%include_texts(k)%s)
         end do
         call text_dataset(group, "files/names", names, .false., "files read, the deck first", status)
         call text_dataset(group, "files/sha256", digests, .false., "SHA-256 of each", status)
         call text_dataset(group, "parameters/names", origin%parameter_names, .false., "parameters of the deck", status)
         call text_dataset(group, "parameters/values", origin%parameter_texts, .false., "values used, as written", status)
      end associate
      call add_scale(scales, group, "files/names", status)
      call add_scale(scales, group, "parameters/names", status)
      call take_scales_of_path(scales, group, "files/sha256", ["files/names"], status)
      call take_scales_of_path(scales, group, "parameters/values", ["parameters/names"], status)
      call close_scales(scales, group, status)
      if (group >= 0) call h5gclose_f(group, closed)
   end subroutine make_provenance

   !> Keep a variable of the environment, if it is set.
   subroutine keep_variable(group, variable, attribute, status)
      integer(hid_t), intent(in) :: group       !! the group
      character(*), intent(in) :: variable      !! name of the variable
      character(*), intent(in) :: attribute     !! name of the attribute
      integer, intent(inout) :: status          !! negative: failed

      character(:), allocatable :: value
      integer :: length, missing

      call get_environment_variable(variable, length=length, status=missing)
      if (missing /= 0) return
      allocate (character(length) :: value)
      call get_environment_variable(variable, value)
      call text_attribute(group, attribute, value, status)
   end subroutine keep_variable

end module provenance
