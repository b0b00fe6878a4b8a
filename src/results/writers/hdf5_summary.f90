!> How a run went, as attributes of run.h5.
module hdf5_summary
   use hdf5, only: h5gclose_f, h5gopen_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use kinds, only: i8
   use recorder, only: row_end, row_jump, row_onset, row_peak, row_stop, summary_t
   implicit none (type, external)
   private
   public :: write_summary

contains

   !> The attributes of /summary, and of /provenance what was not known at the start.
   subroutine write_summary(file, summary, status)
      integer(hid_t), intent(in) :: file       !! the file
      type(summary_t), intent(in) :: summary   !! cost and errors of the run
      integer, intent(inout) :: status         !! negative: failed

      integer(hid_t) :: group
      integer :: closed, kept

      group = -1
      if (status >= 0) call h5gopen_f(file, "summary", group, status)
      kept = 0
      if (summary%quality%has_ledger) kept = 1
      call text_attribute(group, "method", summary%method%integrator, status)
      call text_attribute(group, "solver", summary%method%solver, status)
      call text_attribute(group, "stabilisation", summary%method%stabilisation, status)
      call text_attribute(group, "equilibrium", summary%equilibrium, status)
      call real_attribute(group, "tolerance", summary%method%tolerance, status)
      call real_attribute(group, "time_start", summary%time_start, status)
      call real_attribute(group, "time_end", summary%time_end, status)
      call long_attribute(group, "groups", int(summary%groups, i8), status)
      call long_attribute(group, "steps", summary%count%steps, status)
      call long_attribute(group, "rejected_steps", summary%count%rejected_steps, status)
      call long_attribute(group, "rhs_evaluations", summary%count%rhs_evaluations, status)
      call long_attribute(group, "output_evaluations", summary%count%output_evaluations, status)
      call long_attribute(group, "factorisations", summary%count%factorisations, status)
      call long_attribute(group, "events", int(summary%count%events, i8), status)
      call long_attribute(group, "contacts", int(summary%count%contacts, i8), status)
      call long_attribute(group, "samples", int(summary%count%samples, i8), status)
      call long_attribute(group, "onset_rows", int(summary%count%rows(row_onset), i8), status)
      call long_attribute(group, "peak_rows", int(summary%count%rows(row_peak), i8), status)
      call long_attribute(group, "end_rows", int(summary%count%rows(row_end), i8), status)
      call long_attribute(group, "jump_rows", int(summary%count%rows(row_jump), i8), status)
      call long_attribute(group, "stop_rows", int(summary%count%rows(row_stop), i8), status)
      call long_attribute(group, "ledger", int(kept, i8), status)
      call real_attribute(group, "energy_max", summary%quality%energy_max, status)
      call real_attribute(group, "energy_residual_max", summary%quality%energy_residual_max, status)
      call real_attribute(group, "violation_max", summary%quality%violation_max, status)
      call real_attribute(group, "violation_rate_max", summary%quality%violation_rate_max, status)
      if (group >= 0) call h5gclose_f(group, closed)
      group = -1
      if (status >= 0) call h5gopen_f(file, "provenance", group, status)
      call real_attribute(group, "cpu_seconds", summary%cpu_seconds, status)
      call real_attribute(group, "wall_seconds", summary%wall_seconds, status)
      if (group >= 0) call h5gclose_f(group, closed)
   end subroutine write_summary

end module hdf5_summary
