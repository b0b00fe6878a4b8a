!> Writes precision.h5: every run of a comparison of settings, its costs and errors, the reference, reference runs and choice.
!>
!> The file is written whole, under another name first, so that there is never half of it.
module precision_file
   use errors, only: error_t
   use growth, only: n_digit
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use hdf5_layout, only: write_status
   use provenance, only: make_provenance
   use horizon_group, only: write_horizon
   use kinds, only: not_a_number, wp
   use output_plan, only: output_plan_t
   use precision_results, only: error_names, error_units, error_words, n_compared, n_error, n_statistic, precision_t, tol_run_t, &
      statistic_names, statistic_units, statistic_words
   use recorder, only: status_complete
   use text, only: append_text, text_t
   use whole_file, only: begin_whole_file, end_whole_file
   implicit none (type, external)
   private
   public :: write_precision

contains

   !> Write the file.
   subroutine write_precision(plan, study, error)
      type(output_plan_t), intent(in) :: plan               !! what the file says of the comparison
      type(precision_t), intent(in) :: study                !! its results
      type(error_t), allocatable, intent(out) :: error      !! it cannot be written

      character(:), allocatable :: path
      integer(hid_t) :: file
      integer :: status

      path = plan%directory//"/precision.h5"
      call begin_whole_file(path, "gudgeon precision", plan, file, status, error)
      if (allocated(error)) return
      if (status >= 0) then
         call text_attribute(file, "machine", study%machine%processor, status)
         call text_attribute(file, "compile_flags", study%machine%flags, status)
         call write_tol_sweeps(file, study, status)
         call write_tol_runs(file, study, status)
         call write_reference(file, study, status)
         call write_statistics(file, study, status)
         call write_growth(file, study, status)
         call write_horizon(file, study%horizon, status)
         call write_choice(file, study, status)
         call make_provenance(file, plan, status)
         call write_status(file, status_complete, status)
      end if
      call end_whole_file(path, file, status, error)
   end subroutine write_precision

   !> The settings and what their runs report together.
   subroutine write_tol_sweeps(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      type(text_t), allocatable :: names(:)
      integer :: k, n

      n = size(study%tol_sweeps)
      allocate (names(0))
      do k = 1, n
         call append_text(names, study%tol_sweeps(k)%name)
      end do
      call text_dataset(file, "ladders/names", names, .false., "settings compared", status)
      call integer_dataset(file, "ladders/is_fixed", [n], [(merge(1, 0, study%tol_sweeps(k)%is_fixed), k=1, n)], &
                           "1: sequence of fixed steps, 0: of tolerances", status)
      call real_dataset(file, "ladders/order", [n], study%tol_sweeps%order, "1", "observed order: -d ln error/d ln steps", status)
      call real_dataset(file, "ladders/exponent", [n], study%tol_sweeps%exponent, "1", "d ln error/d ln tolerance", status)
      call real_dataset(file, "ladders/ratio", [n], study%tol_sweeps%ratio, "1", "median of error over tolerance", status)
   end subroutine write_tol_sweeps

   !> Every run.
   subroutine write_tol_runs(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      type(tol_run_t), allocatable :: tol_runs(:)
      type(text_t), allocatable :: names(:), reasons(:), units(:), words(:)
      real(wp), allocatable :: errors(:, :), rounds(:, :)
      integer, allocatable :: owner(:)
      integer :: k, most, n

      allocate (tol_runs(0), owner(0), names(0), reasons(0), units(0), words(0))
      do k = 1, size(study%tol_sweeps)
         tol_runs = [tol_runs, study%tol_sweeps(k)%tol_runs]
         owner = [owner, spread(k, 1, size(study%tol_sweeps(k)%tol_runs))]
      end do
      n = size(tol_runs)
      most = max(1, maxval([0, [(size(tol_runs(k)%rounds), k=1, n)]]))
      allocate (errors(n_error, n), source=not_a_number())
      allocate (rounds(most, n), source=not_a_number())
      do k = 1, n
         call append_text(reasons, tol_runs(k)%reason)
         errors(:, k) = tol_runs(k)%error
         rounds(:size(tol_runs(k)%rounds), k) = tol_runs(k)%rounds
      end do
      do k = 1, n_error
         call append_text(names, trim(error_names(k)))
         call append_text(units, trim(error_units(k)))
         call append_text(words, trim(error_words(k)))
      end do
      call text_dataset(file, "errors/names", names, .false., "types of error", status)
      call text_dataset(file, "errors/units", units, .false., "their units", status)
      call text_dataset(file, "errors/long_names", words, .false., "descriptions", status)
      call integer_dataset(file, "runs/ladder", [n], owner, "number of the setting, from 1", status)
      call put("asked", tol_runs%asked, "1 or s", "tolerance, or length of fixed steps")
      call integer_dataset(file, "runs/state", [n], tol_runs%state, &
                           "0 not run, 1 done, 2 failed, 3 different contact sequence or "// &
         "end time", &
                           status)
      call text_dataset(file, "runs/reason", reasons, .false., "reason of a failed or omitted run", status)
      call real_dataset(file, "runs/error", [n_error, n], reshape(errors, [n_error*n]), "list", "errors by type", status)
      call integer_dataset(file, "runs/is_below", [n], merge(1, 0, tol_runs%is_below), &
                           "1: the error is below that of the reference", status)
      call integer_dataset(file, "runs/is_front", [n], merge(1, 0, tol_runs%is_front), &
                           "1: on the Pareto front, no run is both cheaper and more accurate", status)
      call put("holds_until", tol_runs%holds_until, "s", "last time with an error below the target")
      call put("cpu", tol_runs%cpu, "s", "CPU time of the integration, median of the rounds")
      call put("cpu_least", tol_runs%cpu_min, "s", "CPU time of the integration, minimum of the rounds")
      call real_dataset(file, "runs/rounds", [most, n], reshape(rounds, [most*n]), "s", "CPU time of each round", status)
      call put("setup", tol_runs%setup, "s", "CPU time of set-up and initial state")
      call put("wall", tol_runs%wall, "s", "total CPU time of the compared run")
      call put("steps", real(tol_runs%count%steps, wp), "1", "accepted steps")
      call put("rejected_steps", real(tol_runs%count%rejected, wp), "1", "rejected steps")
      call put("rhs_evaluations", real(tol_runs%count%evaluations, wp), "1", "right-hand sides, except those for output")

   contains

      !> One number of every run.
      subroutine put(name, values, units, long_name)
         character(*), intent(in) :: name       !! of the dataset
         real(wp), intent(in) :: values(:)      !! (runs) the numbers [any]
         character(*), intent(in) :: units      !! SI unit
         character(*), intent(in) :: long_name  !! what they are

         call real_dataset(file, "runs/"//name, [n], values, units, long_name, status)
      end subroutine put

   end subroutine write_tol_runs

   !> The reference.
   subroutine write_reference(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group
      integer :: closed

      call new_group(file, "reference", group, status)
      if (status < 0) return
      call text_attribute(group, "setting", study%reference%what, status)
      call text_attribute(group, "confirmed_by", study%reference%confirmation, status)
      call real_attribute(group, "window", study%reference%window, status)
      call real_attribute(group, "end", study%end, status)
      call h5gclose_f(group, closed)
      call real_dataset(file, "reference/error", [n_compared], study%reference%bar, "list", &
                        "difference from the confirming run: the first types of error", status)
      call real_dataset(file, "reference/agrees_until", [n_digit], study%reference%agreed, "s", &
                        "last time with 1, 2, ... common digits", status)
   end subroutine write_reference

   !> Statistics of the time that is not compared, if there is one.
   subroutine write_statistics(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      type(text_t), allocatable :: names(:), units(:), words(:)
      integer(hid_t) :: group
      integer :: closed, i, k, n, s

      associate (reference => study%reference%statistics, tol_sweeps => study%tol_sweeps)
         if (.not. reference%is_there) return
         call new_group(file, "statistics", group, status)
         if (status < 0) return
         call real_attribute(group, "from", reference%from, status)
         call real_attribute(group, "until", study%end, status)
         call h5gclose_f(group, closed)
         allocate (names(0), units(0), words(0))
         do s = 1, n_statistic
            call append_text(names, trim(statistic_names(s)))
            call append_text(units, trim(statistic_units(s)))
            call append_text(words, trim(statistic_words(s)))
         end do
         call text_dataset(file, "statistics/names", names, .false., "statistics", status)
         call text_dataset(file, "statistics/units", units, .false., "their units", status)
         call text_dataset(file, "statistics/long_names", words, .false., "descriptions", status)
         call put("reference", 1, reference%list%value, "of the reference")
         call put("reference_interval", 1, reference%list%half, "half-width of the 95 % confidence interval")
         n = size(tol_sweeps)
      call put("settings", n, [(tol_sweeps(k)%statistics%list%value, k=1, n)], "mean over the runs of a setting that diverged "// &
         "from the reference")
         call put("settings_interval", n, [(tol_sweeps(k)%statistics%list%half, k=1, n)], &
                  "half-width of the 95 % confidence interval, from the scatter of runs")
         call integer_dataset(file, "statistics/runs", [n_statistic, n], [(tol_sweeps(k)%statistics%n_run, k=1, n)], &
                              "number of runs of a setting that diverged from the reference", status)
         call integer_dataset(file, "statistics/apart", [n_statistic, n], [(tol_sweeps(k)%statistics%n_apart, k=1, n)], &
                              "number of those runs with significantly different statistics", status)
         call integer_dataset(file, "statistics/is_own", [sum([(size(tol_sweeps(k)%tol_runs), k=1, n)])], &
                              [((merge(1, 0, tol_sweeps(k)%tol_runs(i)%statistics%is_own), i=1, size(tol_sweeps(k)%tol_runs)), &
                                k=1, n)], &
                              "1: the run diverges from the reference", status)
         call put("values", sum([(size(tol_sweeps(k)%tol_runs), k=1, n)]), &
                  [((tol_sweeps(k)%tol_runs(i)%statistics%list%value, i=1, size(tol_sweeps(k)%tol_runs)), k=1, n)], "of every run")
         call put("intervals", sum([(size(tol_sweeps(k)%tol_runs), k=1, n)]), &
                  [((tol_sweeps(k)%tol_runs(i)%statistics%list%half, i=1, size(tol_sweeps(k)%tol_runs)), k=1, n)], &
                  "half-width of the 95 % confidence interval of every run, by batch means")
      end associate

   contains

      !> One number of each statistic, of several.
      subroutine put(name, n, values, long_name)
         character(*), intent(in) :: name       !! of the dataset
         integer, intent(in) :: n               !! how many have it
         real(wp), intent(in) :: values(:)      !! (n_statistic n) the numbers [any]
         character(*), intent(in) :: long_name  !! what they are

         call real_dataset(file, "statistics/"//name, [n_statistic, n], values, "list", long_name, status)
      end subroutine put

   end subroutine write_statistics

   !> reference runs.
   subroutine write_growth(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group
      integer :: closed

      associate (growth => study%growth)
         call new_group(file, "twins", group, status)
         if (status < 0) return
         call text_attribute(group, "reason", growth%reason, status)
         if (growth%reason == "") then
            call text_attribute(group, "law", trim(merge("exponential", "power      ", growth%is_exponential)), status)
            call real_attribute(group, "rate", growth%rate, status)
            call real_attribute(group, "rate_interval", growth%rate_interval, status)
            call real_attribute(group, "power", growth%power, status)
            call real_attribute(group, "power_interval", growth%power_interval, status)
            call real_attribute(group, "fit_begin", growth%fit_begin, status)
            call real_attribute(group, "fit_end", growth%fit_end, status)
         end if
         call h5gclose_f(group, closed)
         call real_dataset(file, "twins/horizon", [n_digit], growth%horizon, "s", &
                           "time up to which a trajectory has 1, 2, ... digits; NaN: beyond the run", status)
         if (size(growth%t) == 0) return
         call real_dataset(file, "twins/time", [size(growth%t)], growth%t, "s", "instants", status)
         call real_dataset(file, "twins/ratio", [size(growth%ratio, 2), size(growth%t)], &
                           reshape(transpose(growth%ratio), [size(growth%ratio)]), "1", "distance relative to the initial "// &
                              "distance", status)
      end associate
   end subroutine write_growth

   !> The choice.
   subroutine write_choice(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      integer(hid_t) :: group
      integer :: closed

      call new_group(file, "choice", group, status)
      if (status < 0) return
      call text_attribute(group, "error", trim(error_names(study%wanted)), status)
      call real_attribute(group, "accuracy", study%accuracy, status)
      call real_attribute(group, "budget", study%budget, status)
      call real_attribute(group, "spent", study%spent, status)
      if (study%choice%tol_sweep > 0) then
         associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep))
            call text_attribute(group, "setting", tol_sweep%name, status)
            call real_attribute(group, "asked", tol_sweep%tol_runs(study%choice%tol_run)%asked, status)
            call real_attribute(group, "confirmed_error", study%choice%error, status)
            call real_attribute(group, "confirmed_cpu", study%choice%cpu, status)
         end associate
      else
         call text_attribute(group, "setting", "", status)
      end if
      call h5gclose_f(group, closed)
   end subroutine write_choice

end module precision_file
