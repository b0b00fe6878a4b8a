!> Writes sweep.h5: the cases, what came of every run, statistics over the runs of each case (docs/reference/output.md).
!>
!> The file is written whole, under another name first, so that there is never half of it.
module sweep_file
   use errors, only: error_t
   use hdf5, only: h5fclose_f, h5fopen_f, h5gclose_f, h5gget_info_f, h5lget_name_by_idx_f, h5ocopy_f
   use hdf5, only: h5_index_name_f, h5_iter_inc_f, h5f_acc_rdonly_f
   use hdf5, only: hid_t, hsize_t
   use hdf5_attributes, only: text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use hdf5_layout, only: write_status
   use hdf5_table, only: write_tables
   use provenance, only: make_provenance
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use posix, only: path_exists
   use sweep_results, only: sweep_results_t
   use sweep_tables, only: table_of_cases, table_of_runs
   use table_list, only: list_of
   use text, only: join, text_t, to_text
   use whole_file, only: begin_whole_file, end_whole_file
   implicit none (type, external)
   private
   public :: write_sweep

contains

   !> Write the file.
   subroutine write_sweep(plan, results, state, message, run_directories, error)
      type(output_plan_t), intent(in) :: plan               !! what the file says of the sweep
      type(sweep_results_t), intent(in) :: results          !! what there is so far
      character(*), intent(in) :: state                     !! running, complete or failed
      character(*), intent(in) :: message                   !! why, if not complete
      type(text_t), intent(in) :: run_directories(:)        !! (runs) where channels are copied from, or none: no channels
      type(error_t), allocatable, intent(out) :: error      !! it cannot be written

      character(:), allocatable :: path
      integer(hid_t) :: file
      integer :: status

      path = plan%directory//"/sweep.h5"
      call begin_whole_file(path, "gudgeon sweep", plan, file, status, error)
      if (allocated(error)) return
      if (status >= 0) then
         call write_parameters(file, results, status)
         call write_runs(file, results, status)
         call write_tables(file, list_of(table_of_cases(results)), status)
         call make_provenance(file, plan, status)
         call write_cost(file, results, status)
         if (size(run_directories) > 0) call copy_channels(file, results, run_directories, status)
         call write_status(file, state, status)
         call text_attribute(file, "status_message", message, status)
      end if
      call end_whole_file(path, file, status, error)
   end subroutine write_sweep

   !> The cases.
   subroutine write_parameters(file, results, status)
      integer(hid_t), intent(in) :: file                !! the file
      type(sweep_results_t), intent(in) :: results      !! the cases
      integer, intent(inout) :: status                  !! negative: failed

      type(text_t), allocatable :: names(:), rows(:), units(:)
      real(wp), allocatable :: values(:, :)
      integer :: at, k, m, n, p

      p = size(results%sweep%parameters)
      n = results%sweep%n_cases()
      if (p == 0) return
      allocate (names(p), units(p), rows(n), values(p, n))
      do k = 1, p
         names(k)%s = results%sweep%parameters(k)%name
         units(k)%s = results%sweep%parameters(k)%unit
         if (units(k)%s == "") units(k)%s = "1"
      end do
      do m = 1, n
         rows(m)%s = ""
         do k = 1, p
            at = results%sweep%value_number(k, m)
            rows(m)%s = rows(m)%s//" "//results%sweep%parameters(k)%texts(at)%s
            values(k, m) = results%sweep%parameters(k)%numbers(at)
         end do
         rows(m)%s = rows(m)%s(2:)
      end do
      call text_dataset(file, "parameters/names", names, .false., "parameters of the sweep", status)
      call text_dataset(file, "parameters/units", units, .false., "units of the values", status)
      call text_dataset(file, "parameters/texts", rows, .false., "values of the parameters in each case, as in the deck", status)
      call real_dataset(file, "parameters/values", [p, n], reshape(values, [p*n]), join(units, " "), &
                        "values of the parameters in each case; NaN of words", status)
   end subroutine write_parameters

   !> What came of every run.
   subroutine write_runs(file, results, status)
      integer(hid_t), intent(in) :: file                !! the file
      type(sweep_results_t), intent(in) :: results      !! the runs
      integer, intent(inout) :: status                  !! negative: failed

      real(wp), allocatable :: times(:), samples(:)
      integer, allocatable :: owners(:)
      integer :: k, m

      call write_tables(file, list_of(table_of_runs(results)), status)
      call text_dataset(file, "runs/names", results%names, .false., "names of the statistics", status)
      call text_dataset(file, "runs/units", results%units, .false., "their units", status)
      m = sum([(size(results%runs(k)%poincare_times), k=1, size(results%runs))])
      if (m == 0) return
      allocate (owners(m), times(m), samples(m*size(results%poincare_names)))
      m = 0
      do k = 1, size(results%runs)
         associate (run => results%runs(k), q => size(results%poincare_names), more => size(results%runs(k)%poincare_times))
            owners(m + 1:m + more) = k
            times(m + 1:m + more) = run%poincare_times
            samples(q*m + 1:q*(m + more)) = reshape(results%poincare_of(k), [q*more])
            m = m + more
         end associate
      end do
      call text_dataset(file, "strobe/names", results%poincare_names, .false., "channels sampled once per period", status)
      call integer_dataset(file, "strobe/run", [size(owners)], owners, "number of the run, from 1", status)
      call real_dataset(file, "strobe/time", [size(times)], times, "s", "multiples of the drive period", status)
      call real_dataset(file, "strobe/values", [size(results%poincare_names), size(times)], samples, "list", &
                        "channel values at these times", status)
   end subroutine write_runs

   !> What the runs cost, which no two sweeps have alike.
   subroutine write_cost(file, results, status)
      integer(hid_t), intent(in) :: file                !! the file
      type(sweep_results_t), intent(in) :: results      !! the runs
      integer, intent(inout) :: status                  !! negative: failed

      integer :: k, n

      n = size(results%runs)
      call real_dataset(file, "provenance/cpu_start", [n], [(results%runs(k)%cpu(1), k=1, n)], "s", &
                        "CPU time of a run before its motion starts", status)
      call real_dataset(file, "provenance/cpu_run", [n], [(results%runs(k)%cpu(2), k=1, n)], "s", &
                        "CPU time of the motion and output of a run", status)
   end subroutine write_cost

   !> Copy the datasets of every run into /channels/N, N the number of the run.
   subroutine copy_channels(file, results, run_directories, status)
      integer(hid_t), intent(in) :: file                    !! the file
      type(sweep_results_t), intent(in) :: results          !! the runs
      type(text_t), intent(in) :: run_directories(:)        !! (runs) where they are
      integer, intent(inout) :: status                      !! negative: failed

      character(256) :: name
      integer(hid_t) :: from, group
      integer :: closed, k, most, n, storage
      integer(hsize_t) :: i

      do k = 1, size(results%runs)
         if (.not. path_exists(run_directories(k)%s//"/run.h5")) cycle
         call new_group(file, "channels/"//to_text(k), group, status)
         if (status >= 0) call h5fopen_f(run_directories(k)%s//"/run.h5", h5f_acc_rdonly_f, from, status)
         if (status < 0) return
         call h5gget_info_f(from, storage, n, most, status)
         do i = 0, int(n - 1, hsize_t)
            if (status < 0) exit
            call h5lget_name_by_idx_f(from, ".", h5_index_name_f, h5_iter_inc_f, i, name, status)
            if (index(" deck deck_includes provenance ", " "//trim(name)//" ") > 0) cycle
            if (status >= 0) call h5ocopy_f(from, trim(name), group, trim(name), status)
         end do
         call h5gclose_f(group, closed)
         call h5fclose_f(from, closed)
      end do
   end subroutine copy_channels

end module sweep_file
