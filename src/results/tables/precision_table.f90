!> A comparison of settings as tables: a row for each setting, and for each run.
module precision_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: i8, not_a_number, wp
   use precision_results, only: error_names, error_units, n_error, n_statistic, precision_t, statistic_names, &
      statistic_units, tol_run_done, tol_run_states, tol_run_t, tol_sweep_t
   use result_table, only: in_hdf5, in_text_files, only_shown, result_table_t
   use text, only: join, text_t
   implicit none (type, external)
   private
   public :: table_of_settings, table_of_tol_runs

contains

   !> The settings, with what their runs report together.
   function table_of_settings(study) result(table)
      type(precision_t), intent(in) :: study      !! results
      type(result_table_t) :: table               !! a row for each setting

      type(text_t) :: marks(size(study%tol_sweeps)), names(size(study%tol_sweeps))
      real(wp), allocatable :: cpu(:), error(:)
      integer(i8), allocatable :: evaluations(:)
      integer :: best, k, n

      n = size(names)
      allocate (cpu(n), error(n), source=not_a_number())
      allocate (evaluations(n), source=0_i8)
      do k = 1, n
         names(k)%s = study%tol_sweeps(k)%name
         marks(k)%s = ""
         best = min_error(study%tol_sweeps(k), study%wanted)
         if (best == 0) cycle
         associate (run => study%tol_sweeps(k)%tol_runs(best))
            cpu(k) = run%cpu
            evaluations(k) = run%count%evaluations
            error(k) = run%error(study%wanted)
            if (run%is_below) error(k) = study%reference%bar(study%wanted)
            if (run%is_below) marks(k)%s = "<"
         end associate
      end do
      call table%start("ladders", "ladders", n, title="settings")
      table%most = n
      associate (settings => study%tol_sweeps)
         call table%put("names", "1", "settings compared", texts=names, heading="setting")
         call table%put("runs", "1", "completed runs", integers=[(count(settings(k)%tol_runs%state == tol_run_done), k=1, n)], &
                        formats=only_shown, heading="runs")
         call table%put("is_fixed", "1", "1: sequence of fixed steps, 0: of tolerances", logicals=settings%is_fixed)
         call table%put("order", "1", "observed order: -d ln error/d ln steps", settings%order, heading="order", digits=3)
         call table%put("exponent", "1", "d ln error/d ln tolerance", settings%exponent, heading="exponent", digits=3)
         call table%put("ratio", "1", "median of error over tolerance", settings%ratio, heading="error/tol", digits=3)
      end associate
      call table%put("mark", "1", "`<`: the error is below that of the reference", texts=marks, formats=only_shown, heading="")
      call table%put("error", "1", "minimum error; below that of the reference: the latter", error, formats=only_shown, &
                     heading="minimum error", digits=2)
      call table%put("cpu", "s", "CPU time of the run with the minimum error", cpu, formats=only_shown, heading="CPU", digits=3)
      call table%put("rhs", "1", "its right-hand sides", counts=evaluations, formats=only_shown, heading="RHS")
   end function table_of_settings

   !> The run of the minimum error, 0 if there is none.
   pure integer function min_error(tol_sweep, kind) result(best)
      type(tol_sweep_t), intent(in) :: tol_sweep        !! the tolerance sweep
      integer, intent(in) :: kind                 !! of error

      integer :: k

      best = 0
      do k = 1, size(tol_sweep%tol_runs)
         if (tol_sweep%tol_runs(k)%state /= tol_run_done) cycle
         if (.not. ieee_is_finite(tol_sweep%tol_runs(k)%error(kind))) cycle
         if (best == 0) best = k
         if (tol_sweep%tol_runs(k)%error(kind) < tol_sweep%tol_runs(best)%error(kind)) best = k
      end do
   end function min_error

   !> All runs, setting by setting.
   !> Length: a line or two for each column.
   function table_of_tol_runs(study) result(table)
      type(precision_t), intent(in) :: study      !! results
      type(result_table_t) :: table               !! a row for each run

      type(tol_run_t), allocatable :: tol_runs(:)
      type(text_t), allocatable :: names(:), reasons(:), states(:)
      type(text_t) :: errors(n_error), units(n_error)
      real(wp), allocatable :: rounds(:, :)
      integer, allocatable :: owners(:)
      integer :: k, n

      allocate (tol_runs(0), owners(0))
      do k = 1, size(study%tol_sweeps)
         tol_runs = [tol_runs, study%tol_sweeps(k)%tol_runs]
         owners = [owners, spread(k, 1, size(study%tol_sweeps(k)%tol_runs))]
      end do
      n = size(tol_runs)
      allocate (names(n), reasons(n), states(n))
      allocate (rounds(max(1, maxval([0, [(size(tol_runs(k)%rounds), k=1, n)]])), n), source=not_a_number())
      do k = 1, n
         names(k)%s = study%tol_sweeps(owners(k))%name
         states(k)%s = trim(tol_run_states(tol_runs(k)%state))
         reasons(k)%s = tol_runs(k)%reason
         rounds(:size(tol_runs(k)%rounds), k) = tol_runs(k)%rounds
      end do
      do k = 1, n_error
         errors(k)%s = trim(error_names(k))
         units(k)%s = trim(error_units(k))
      end do
      call table%start("runs", "runs", n, title="runs")
      table%most = n
      call table%put("ladder", "1", "number of the setting, from 1", integers=owners, formats=in_hdf5)
      call table%put("setting", "1", "name of the setting", texts=names, formats=in_text_files, heading="setting")
      call table%put("fixed_steps", "1", "fixed steps, not tolerances", logicals=study%tol_sweeps(owners)%is_fixed, &
                     formats=in_text_files)
      call table%put("asked", "1 or s", "tolerance, or length of fixed steps", tol_runs%asked, heading="tol. or step", digits=2)
      call table%put("state", "1", "0 not run, 1 done, 2 failed, 3 different contact sequence or end time", &
                     integers=tol_runs%state, formats=in_hdf5)
      call table%put("state", "1", "as text", texts=states, formats=in_text_files, heading="state")
      call table%put("error", join(units, " "), "errors by type", [(tol_runs(k)%error, k=1, n)], shape=[n_error], &
                     parts=errors, heading="error", digits=2)
      call table%put("cpu", "s", "CPU time of the integration, median of the rounds", tol_runs%cpu, heading="CPU", digits=3)
      call table%put("cpu_least", "s", "CPU time of the integration, minimum of the rounds", tol_runs%cpu_min, &
                     heading="min", digits=3)
      call table%put("rounds", "s", "CPU time of each round", reshape(rounds, [size(rounds)]), shape=[size(rounds, 1)], &
                     formats=in_hdf5)
      call table%put("rounds", "1", "number of rounds", integers=tol_runs%n_round, formats=in_text_files)
      call table%put("setup", "s", "CPU time of set-up and initial state", tol_runs%setup)
      call table%put("wall", "s", "total CPU time of the compared run", tol_runs%wall, formats=in_hdf5)
      call table%put("rhs", "1", "right-hand sides, except those for output", counts=tol_runs%count%evaluations, &
                     dataset="rhs_evaluations", heading="RHS")
      call table%put("steps", "1", "accepted steps", counts=tol_runs%count%steps, heading="steps")
      call table%put("rejected", "1", "rejected steps", counts=tol_runs%count%rejected, dataset="rejected_steps")
      call table%put("holds_until", "s", "last time with an error below the target", tol_runs%holds_until)
      call table%put("below", "1", "1: the error is below that of the reference", logicals=tol_runs%is_below, dataset="is_below", &
                     heading="below")
      call table%put("front", "1", "1: on the Pareto front, no run is both cheaper and more accurate", logicals=tol_runs%is_front, &
                     dataset="is_front", heading="front")
      if (study%reference%statistics%is_there) call put_statistics(table, tol_runs)
      call table%put("reason", "1", "reason of a failed or omitted run", texts=reasons, heading="reason")
   end function table_of_tol_runs

   !> Add the statistics of each run beyond the comparison window.
   subroutine put_statistics(table, tol_runs)
      type(result_table_t), intent(inout) :: table      !! grown
      type(tol_run_t), intent(in) :: tol_runs(:)              !! (n) the runs

      character(:), allocatable :: name, unit
      integer :: k, s

      call table%put("own_way", "1", "the run diverges from the reference", &
                     logicals=[(tol_runs(k)%statistics%is_own, k=1, size(tol_runs))], formats=in_text_files)
      do s = 1, n_statistic
         name = trim(statistic_names(s))
         unit = trim(statistic_units(s))
         call table%put(name, unit, "its mean", &
                        [(tol_runs(k)%statistics%list(s)%value, k=1, size(tol_runs))], formats=in_text_files)
         call table%put(name//"_interval", unit, "half-width of its 95 % confidence interval", &
                        [(tol_runs(k)%statistics%list(s)%half, k=1, size(tol_runs))], formats=in_text_files)
      end do
   end subroutine put_statistics

end module precision_table
