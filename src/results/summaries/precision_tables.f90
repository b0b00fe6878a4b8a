!> Every run of a comparison of settings in a line: for people, for spreadsheets.
module precision_tables
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_results, only: error_names, error_units, n_error, n_statistic, precision_t, rung_failed, rung_states, rung_t, &
      rung_unrun, statistic_names, statistic_units
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
      do k = 1, size(study%ladders)
         associate (ladder => study%ladders(k))
            call lines%line("")
            call lines%line(ladder%name)
            call lines%add("  "//column(merge("step/s   ", "tolerance", ladder%is_fixed)))
            do kind = 1, n_error
               call lines%add(column(trim(error_names(kind))))
            end do
            call lines%line(column("CPU")//column("min")//column("RHS")//column("steps")//"  state")
            do i = 1, size(ladder%rungs)
               call lines%line(rung_line(ladder%rungs(i)))
            end do
         end associate
      end do
      text = lines%get()
   end function precision_report

   !> A run in a line.
   function rung_line(rung) result(line)
      type(rung_t), intent(in) :: rung            !! the run
      character(:), allocatable :: line           !! its numbers

      integer :: kind

      line = merge("*", " ", rung%is_front)//merge("<", " ", rung%is_below)//column(short(rung%asked))
      if (rung%state == rung_failed .or. rung%state == rung_unrun) then
         line = line//"  "//trim(rung_states(rung%state))//": "//rung%reason
         return
      end if
      do kind = 1, n_error
         line = line//column(short(rung%error(kind)))
      end do
      line = line//column(figures(1.0e3_wp*rung%cpu))//column(figures(1.0e3_wp*rung%cpu_least))// &
             column(to_text(rung%count%evaluations))//column(to_text(rung%count%steps))//"  "//trim(rung_states(rung%state))
   end function rung_line

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
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            associate (rung => study%ladders(k)%rungs(i))
               line = study%ladders(k)%name//","//digit(study%ladders(k)%is_fixed)//","//exact_text(rung%asked)//","// &
                      trim(rung_states(rung%state))
               do kind = 1, n_error
                  line = line//","//exact(rung%error(kind))
               end do
               line = line//","//exact(rung%cpu)//","//exact(rung%cpu_least)//","//to_text(rung%n_round)//","// &
                      exact(rung%setup)//","//to_text(rung%count%evaluations)//","//to_text(rung%count%steps)//","// &
                      to_text(rung%count%rejected)//","//exact(rung%holds_until)//","//digit(rung%is_below)//","// &
                      digit(rung%is_front)
               if (study%reference%statistics%is_there) then
                  line = line//","//digit(rung%statistics%is_own)
                  do kind = 1, n_statistic
                     line = line//","//exact(rung%statistics%list(kind)%value)//","//exact(rung%statistics%list(kind)%half)
                  end do
               end if
               call lines%line(line//","""//replace(rung%reason, """", "'")//"""")
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
