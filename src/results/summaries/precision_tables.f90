!> Every run of a comparison of settings in a line: for people, for spreadsheets.
module precision_tables
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_results, only: error_names, error_units, n_error, n_statistic, precision_t, tol_run_failed, tol_run_states, &
        tol_run_t, &
      tol_run_unrun, statistic_names, statistic_units
   use precision_text, only: column, figures, precision_summary, short
   use text, only: exact_text, replace, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: precision_csv, precision_report

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

   !> Every run as comma-separated values, SI.
   function precision_csv(study) result(text)
      type(precision_t), intent(in) :: study     !! results
      character(:), allocatable :: text          !! whole lines

      type(buffer_t) :: lines
      character(:), allocatable :: line, unit
      integer :: i, k, kind

      line = "setting,fixed_steps,asked,state"
      do kind = 1, n_error
         line = line//","//trim(error_names(kind))
         if (error_units(kind) /= "1") line = line//" ["//trim(error_units(kind))//"]"
      end do
      line = line//",cpu [s],cpu_least [s],rounds,setup [s],rhs,steps,rejected,holds_until [s],below,front"
      if (study%reference%statistics%is_there) then
         line = line//",own_way"
         do kind = 1, n_statistic
            unit = " ["//trim(statistic_units(kind))//"]"
            line = line//","//trim(statistic_names(kind))//unit//","//trim(statistic_names(kind))//"_interval"//unit
         end do
      end if
      call lines%line(line//",reason")
      do k = 1, size(study%tol_sweeps)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
               line = study%tol_sweeps(k)%name//","//digit(study%tol_sweeps(k)%is_fixed)//","//exact_text(tol_run%asked)//","// &
                      trim(tol_run_states(tol_run%state))
               do kind = 1, n_error
                  line = line//","//exact(tol_run%error(kind))
               end do
               line = line//","//exact(tol_run%cpu)//","//exact(tol_run%cpu_min)//","//to_text(tol_run%n_round)//","// &
                      exact(tol_run%setup)//","//to_text(tol_run%count%evaluations)//","//to_text(tol_run%count%steps)//","// &
                      to_text(tol_run%count%rejected)//","//exact(tol_run%holds_until)//","//digit(tol_run%is_below)//","// &
                      digit(tol_run%is_front)
               if (study%reference%statistics%is_there) then
                  line = line//","//digit(tol_run%statistics%is_own)
                  do kind = 1, n_statistic
                     line = line//","//exact(tol_run%statistics%list(kind)%value)//","//exact(tol_run%statistics%list(kind)%half)
                  end do
               end if
               call lines%line(line//","""//replace(tol_run%reason, """", "'")//"""")
            end associate
         end do
      end do
      text = lines%get()

   contains

      !> A number with all its digits, blank if it is none.
      function exact(x) result(word)
         real(wp), intent(in) :: x              !! the number [any]
         character(:), allocatable :: word      !! its digits

         word = ""
         if (ieee_is_finite(x)) word = exact_text(x)
      end function exact

      !> Whether something is so.
      pure character(1) function digit(is_so)
         logical, intent(in) :: is_so  !! whether

         digit = merge("1", "0", is_so)
      end function digit

   end function precision_csv

end module precision_tables
