!> Writes sweep.h5: the cases, what came of every run, statistics over the runs of each case (docs/output.md).
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
   use provenance, only: make_provenance
   use kinds, only: not_a_number, wp
   use output_plan, only: output_plan_t
   use posix, only: path_exists
   use sweep_results, only: case_numbers, n_spread, spread_names, sweep_results_t
   use text, only: append_text, text_t, to_text
   use whole_file, only: begin_whole_file, end_whole_file
   implicit none (type, external)
   private
   public :: write_sweep

   character(*), parameter :: spread_help(n_spread) = [character(40) :: "mean over the runs of a case", &
      "standard deviation over these runs", "minimum of these runs", "maximum of these runs"]

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
         call write_cases(file, results, status)
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

      type(text_t), allocatable :: names(:), texts(:), units(:)
      real(wp), allocatable :: values(:)
      character(:), allocatable :: all_units
      integer :: k, m, n, p

      p = size(results%sweep%parameters)
      n = results%sweep%n_cases()
      allocate (names(0), units(0), texts(p*n), values(p*n))
      all_units = ""
      do k = 1, p
         associate (parameter => results%sweep%parameters(k))
            call append_text(names, parameter%name)
            call append_text(units, parameter%unit)
            if (parameter%unit == "") units(k)%s = "1"
            all_units = trim(all_units//" "//units(k)%s)
         end associate
      end do
      do m = 1, n
         do k = 1, p
            associate (parameter => results%sweep%parameters(k), at => results%sweep%value_number(k, m))
               texts((m - 1)*p + k)%s = parameter%texts(at)%s
               values((m - 1)*p + k) = parameter%numbers(at)
            end associate
         end do
      end do
      if (p == 0) return
      call text_dataset(file, "parameters/names", names, .false., "parameters of the sweep", status)
      call text_dataset(file, "parameters/units", units, .false., "units of the values", status)
      call text_table(file, "parameters/texts", texts, p, status)
      call real_dataset(file, "parameters/values", [p, n], values, trim(adjustl(all_units)), &
                        "values of the parameters in each case; NaN of words", status)
   end subroutine write_parameters

   !> Values as a deck has them, one text per case and parameter.
   subroutine text_table(file, path, texts, p, status)
      integer(hid_t), intent(in) :: file       !! the file
      character(*), intent(in) :: path         !! of the dataset
      type(text_t), intent(in) :: texts(:)     !! (p*cases) texts, the parameter fastest
      integer, intent(in) :: p                 !! parameters
      integer, intent(inout) :: status         !! negative: failed

      type(text_t), allocatable :: rows(:)
      integer :: k, m

      allocate (rows(size(texts)/p))
      do k = 1, size(rows)
         rows(k)%s = texts((k - 1)*p + 1)%s
         do m = 2, p
            rows(k)%s = rows(k)%s//" "//texts((k - 1)*p + m)%s
         end do
      end do
      call text_dataset(file, path, rows, .false., "values of the parameters in each case, as in the deck", status)
   end subroutine text_table

   !> What came of every run.
   subroutine write_runs(file, results, status)
      integer(hid_t), intent(in) :: file                !! the file
      type(sweep_results_t), intent(in) :: results      !! the runs
      integer, intent(inout) :: status                  !! negative: failed

      type(text_t), allocatable :: messages(:), warnings(:)
      real(wp), allocatable :: times(:), values(:, :), samples(:)
      integer, allocatable :: owners(:)
      integer :: k, m, n

      n = size(results%runs)
      allocate (messages(n), warnings(n))
      allocate (values(size(results%names), n), source=not_a_number())
      m = sum([(size(results%runs(k)%poincare_times), k=1, n)])
      allocate (owners(m), times(m), samples(m*size(results%poincare_names)))
      m = 0
      do k = 1, n
         associate (run => results%runs(k), q => size(results%poincare_names), more => size(results%runs(k)%poincare_times))
            messages(k)%s = run%message
            warnings(k)%s = run%warnings
            values(1:size(run%numbers), k) = run%numbers
            owners(m + 1:m + more) = k
            times(m + 1:m + more) = run%poincare_times
            samples(q*m + 1:q*(m + more)) = reshape(results%poincare_of(k), [q*more])
            m = m + more
         end associate
      end do
      call integer_dataset(file, "runs/case", [n], [((k - 1)/results%n_member + 1, k=1, n)], "case of the run", status)
      call integer_dataset(file, "runs/member", [n], [(merge(mod(k - 1, results%n_member) + 1, 0, results%is_ensemble), &
                                                       k=1, n)], "number of the run in the ensemble; 0: no ensemble", status)
      call integer_dataset(file, "runs/exit_code", [n], [(results%runs(k)%exit_code, k=1, n)], &
                           "0: done; -1: not run; otherwise the exit code", status)
      call text_dataset(file, "runs/message", messages, .false., "reason of a failure; blank if none", status)
      call text_dataset(file, "runs/warnings", warnings, .false., "warnings of a run; blank if none", status)
      call text_dataset(file, "runs/names", results%names, .false., "names of the statistics", status)
      call text_dataset(file, "runs/units", results%units, .false., "their units", status)
      call real_dataset(file, "runs/values", [size(results%names), n], reshape(values, [size(values)]), &
                        all_units(results), "statistics of every run", status)
      if (size(times) == 0) return
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

   !> Statistics over the runs of each case.
   subroutine write_cases(file, results, status)
      integer(hid_t), intent(in) :: file                !! the file
      type(sweep_results_t), intent(in) :: results      !! the runs
      integer, intent(inout) :: status                  !! negative: failed

      real(wp) :: spreads(n_spread, size(results%names), results%sweep%n_cases())
      integer :: done(results%sweep%n_cases()), i, k, n, n_number

      n = size(done)
      n_number = size(results%names)
      do k = 1, n
         do i = 1, n_number
            call case_numbers(results, k, i, done(k), spreads(:, i, k))
         end do
         done(k) = count(results%runs((k - 1)*results%n_member + 1:k*results%n_member)%exit_code == 0)
      end do
      call integer_dataset(file, "cases/runs", [n], done, "completed runs of the case", status)
      do i = 1, n_spread
         call real_dataset(file, "cases/"//trim(spread_names(i)), [n_number, n], &
                           reshape(spreads(i, :, :), [n_number*n]), all_units(results), trim(spread_help(i)), status)
      end do
   end subroutine write_cases

   !> Units of the numbers with blanks between them.
   function all_units(results) result(units)
      type(sweep_results_t), intent(in) :: results      !! the runs
      character(:), allocatable :: units                !! one for each number

      integer :: k

      units = ""
      do k = 1, size(results%units)
         units = trim(units//" "//results%units(k)%s)
      end do
      units = trim(adjustl(units))
   end function all_units

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
