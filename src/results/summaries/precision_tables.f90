!> Every run of a comparison of settings in a line, for people.
module precision_tables
   use kinds, only: wp
   use precision_results, only: error_names, n_error, precision_t, tol_run_failed, tol_run_states, tol_run_t, tol_run_unrun
   use precision_text, only: column, figures, precision_summary, short
   use text, only: to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: precision_report

contains

   !> Every run in a line, below the summary.
   function precision_report(study, title) result(text)
      type(precision_t), intent(in) :: study     !! results
      character(*), intent(in) :: title          !! of the scene
      character(:), allocatable :: text          !! whole lines

      type(buffer_t) :: lines
      integer :: i, k, kind

      call lines%add(precision_summary(study, title))
      call lines%line("")
      call lines%line("errors: onsets in s, violation in m, others relative; CPU time of the integration in ms, median and "// &
         "minimum of")
      call lines%line("the rounds; * on the Pareto front; < below the error of the reference, hence unknown")
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            call lines%line("")
            call lines%line(tol_sweep%name)
            call lines%add("  "//column(merge("step/s   ", "tolerance", tol_sweep%is_fixed)))
            do kind = 1, n_error
               call lines%add(column(trim(error_names(kind))))
            end do
            call lines%line(column("CPU")//column("min")//column("RHS")//column("steps")//"  state")
            do i = 1, size(tol_sweep%tol_runs)
               call lines%line(tol_run_line(tol_sweep%tol_runs(i)))
            end do
         end associate
      end do
      text = lines%get()
   end function precision_report

   !> A run in a line.
   function tol_run_line(tol_run) result(line)
      type(tol_run_t), intent(in) :: tol_run            !! the run
      character(:), allocatable :: line           !! its numbers

      integer :: kind

      line = merge("*", " ", tol_run%is_front)//merge("<", " ", tol_run%is_below)//column(short(tol_run%asked))
      if (tol_run%state == tol_run_failed .or. tol_run%state == tol_run_unrun) then
         line = line//"  "//trim(tol_run_states(tol_run%state))//": "//tol_run%reason
         return
      end if
      do kind = 1, n_error
         line = line//column(short(tol_run%error(kind)))
      end do
      line = line//column(figures(1.0e3_wp*tol_run%cpu))//column(figures(1.0e3_wp*tol_run%cpu_min))// &
             column(to_text(tol_run%count%evaluations))//column(to_text(tol_run%count%steps))//"  " &
                       //trim(tol_run_states(tol_run%state))
   end function tol_run_line

end module precision_tables
