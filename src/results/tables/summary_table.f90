!> How a run went, as facts of tables.
module summary_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: i8, not_a_number, wp
   use recorder, only: row_end, row_jump, row_onset, row_peak, row_stop, summary_t
   use result_table, only: in_text_files, result_table_t
   implicit none (type, external)
   private
   public :: relative_residual, seconds_per_rhs, table_of_cost, table_of_summary

contains

   !> What repeated runs have in common.
   function table_of_summary(summary) result(table)
      type(summary_t), intent(in) :: summary   !! cost and errors of the run
      type(result_table_t) :: table            !! the facts

      call table%start("summary", "summary", 0)
      call table%fact("status", summary%status, formats=in_text_files)
      call table%fact("message", summary%message, formats=in_text_files)
      call table%fact("method", summary%method%integrator)
      call table%fact("solver", summary%method%solver)
      call table%fact("stabilisation", summary%method%stabilisation)
      call table%fact("equilibrium", summary%equilibrium)
      call table%fact("tolerance", summary%method%tolerance)
      call table%fact("time_start", summary%time_start)
      call table%fact("time_end", summary%time_end)
      call table%fact("groups", summary%groups)
      call table%fact("steps", summary%count%steps)
      call table%fact("rejected_steps", summary%count%rejected_steps)
      call table%fact("rhs_evaluations", summary%count%rhs_evaluations)
      call table%fact("output_evaluations", summary%count%output_evaluations)
      call table%fact("factorisations", summary%count%factorisations)
      call table%fact("events", summary%count%events)
      call table%fact("contacts", summary%count%contacts)
      call table%fact("samples", summary%count%samples)
      call table%fact("onset_rows", summary%count%rows(row_onset))
      call table%fact("peak_rows", summary%count%rows(row_peak))
      call table%fact("end_rows", summary%count%rows(row_end))
      call table%fact("jump_rows", summary%count%rows(row_jump))
      call table%fact("stop_rows", summary%count%rows(row_stop))
      call table%fact("ledger", summary%quality%has_ledger)
      call table%fact("energy_max", summary%quality%energy_max)
      call table%fact("energy_residual_max", summary%quality%energy_residual_max)
      call table%fact("energy_residual_relative", relative_residual(summary), formats=in_text_files)
      call table%fact("violation_max", summary%quality%violation_max)
      call table%fact("violation_rate_max", summary%quality%violation_rate_max)
   end function table_of_summary

   !> What the run cost, which differs between repeated runs.
   function table_of_cost(summary) result(table)
      type(summary_t), intent(in) :: summary   !! cost and errors of the run
      type(result_table_t) :: table            !! the facts

      call table%start("provenance", "provenance", 0)
      call table%fact("cpu_seconds", summary%cpu_seconds)
      call table%fact("wall_seconds", summary%wall_seconds)
      call table%fact("seconds_per_rhs", seconds_per_rhs(summary), formats=in_text_files)
   end function table_of_cost

   !> Time per evaluation of the right-hand side, without output; NaN: unknown.
   pure real(wp) function seconds_per_rhs(summary)
      type(summary_t), intent(in) :: summary  !! of the run

      integer(i8) :: n

      seconds_per_rhs = not_a_number()
      n = summary%count%rhs_evaluations - summary%count%output_evaluations
      if (n > 0) seconds_per_rhs = summary%cpu_seconds/real(n, wp)
   end function seconds_per_rhs

   !> Residual of the energy balance relative to the maximum energy; NaN: unknown.
   pure real(wp) function relative_residual(summary)
      type(summary_t), intent(in) :: summary  !! of the run

      relative_residual = not_a_number()
      if (.not. (ieee_is_finite(summary%quality%energy_residual_max) .and. ieee_is_finite(summary%quality%energy_max))) return
      if (summary%quality%has_ledger .and. summary%quality%energy_max > 0.0_wp) then
         relative_residual = summary%quality%energy_residual_max/summary%quality%energy_max
      end if
   end function relative_residual

end module summary_table
