!> The runs of a comparison of settings as a table.
module precision_table
   use kinds, only: not_a_number, wp
   use precision_results, only: error_names, error_units, n_error, n_statistic, precision_t, statistic_names, &
      statistic_units, tol_run_states, tol_run_t
   use result_table, only: in_hdf5, in_text_files, result_table_t
   use text, only: join, text_t
   implicit none (type, external)
   private
   public :: table_of_tol_runs

contains

   !> All runs, setting by setting.
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
      call table%start("runs", "runs", n)
      call table%put("ladder", "1", "number of the setting, from 1", integers=owners, formats=in_hdf5)
      call table%put("setting", "1", "name of the setting", texts=names, formats=in_text_files)
      call table%put("fixed_steps", "1", "fixed steps, not tolerances", logicals=study%tol_sweeps(owners)%is_fixed, &
                     formats=in_text_files)
      call table%put("asked", "1 or s", "tolerance, or length of fixed steps", tol_runs%asked)
      call table%put("state", "1", "0 not run, 1 done, 2 failed, 3 different contact sequence or end time", &
                     integers=tol_runs%state, formats=in_hdf5)
      call table%put("state", "1", "in words", texts=states, formats=in_text_files)
      call table%put("error", join(units, " "), "errors by type", [(tol_runs(k)%error, k=1, n)], shape=[n_error], parts=errors)
      call table%put("cpu", "s", "CPU time of the integration, median of the rounds", tol_runs%cpu)
      call table%put("cpu_least", "s", "CPU time of the integration, minimum of the rounds", tol_runs%cpu_min)
      call table%put("rounds", "s", "CPU time of each round", reshape(rounds, [size(rounds)]), shape=[size(rounds, 1)], &
                     formats=in_hdf5)
      call table%put("rounds", "1", "number of rounds", integers=tol_runs%n_round, formats=in_text_files)
      call table%put("setup", "s", "CPU time of set-up and initial state", tol_runs%setup)
      call table%put("wall", "s", "total CPU time of the compared run", tol_runs%wall, formats=in_hdf5)
      call table%put("rhs", "1", "right-hand sides, except those for output", counts=tol_runs%count%evaluations, &
                     dataset="rhs_evaluations")
      call table%put("steps", "1", "accepted steps", counts=tol_runs%count%steps)
      call table%put("rejected", "1", "rejected steps", counts=tol_runs%count%rejected, dataset="rejected_steps")
      call table%put("holds_until", "s", "last time with an error below the target", tol_runs%holds_until)
      call table%put("below", "1", "1: the error is below that of the reference", logicals=tol_runs%is_below, dataset="is_below")
      call table%put("front", "1", "1: on the Pareto front, no run is both cheaper and more accurate", logicals=tol_runs%is_front, &
                     dataset="is_front")
      if (study%reference%statistics%is_there) call put_statistics(table, tol_runs)
      call table%put("reason", "1", "reason of a failed or omitted run", texts=reasons)
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
