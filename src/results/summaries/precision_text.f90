!> The results of a comparison of settings as text.
module precision_text
   use bend_text, only: add_bends
   use beyond_text, only: add_statistics
   use failure_reasons, only: is_same_reason
   use growth, only: growth_t, n_digit
   use horizon_text, only: add_horizon
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use precision_table, only: table_of_settings, table_of_tol_runs
   use precision_results, only: error_names, error_onsets, error_units, error_words, tol_sweep_t, n_compared, precision_t, &
        tol_run_done, &
      tol_run_failed, tol_run_other, tol_run_states, tol_run_t, tol_run_unrun
   use text, only: counted, real_text, replace, split_blank, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: growth_words, precision_report, precision_summary, settings_text, short

contains

   !> What a reader needs to know first.
   function precision_summary(study, title) result(text)
      type(precision_t), intent(in) :: study     !! results
      character(*), intent(in) :: title          !! of the scene
      character(:), allocatable :: text          !! whole lines

      type(buffer_t) :: lines

      call lines%line(title)
      call lines%line("compared   "//counted(size(study%tol_sweeps), "setting", "settings")//" on a motion of "// &
                      real_text(study%end, 6)// &
                      " s"//trim(merge(" with a stop condition", "                      ", study%is_stopped))//", at "// &
                      counted(study%output_times, "output time", "output times")//window_text(study))
      call lines%line("machine    "//study%machine%processor//"; "//study%machine%compiler)
      call lines%line("           "//flags_of(study%machine%flags))
      call add_reference(lines, study)
      call add_growth(lines, study)
      call add_horizon(lines, study%horizon)
      call add_table(lines, table_of_settings(study))
      call lines%line("")
      call add_statistics(lines, study)
      call add_bends(lines, study)
      call add_failures(lines, study)
      call add_choice(lines, study)
      call lines%line("time       "//real_text(study%spent, 3)//" s"//trim(merge(" of a budget of ", repeat(" ", 16), &
                      study%budget > 0.0_wp))//budget_text(study)//"; "//rounds_text(study))
      text = lines%get()
   end function precision_summary

   !> The summary, and every run in a line below.
   function precision_report(study, title) result(text)
      type(precision_t), intent(in) :: study     !! results
      character(*), intent(in) :: title          !! of the scene
      character(:), allocatable :: text          !! whole lines

      type(buffer_t) :: lines

      call lines%add(precision_summary(study, title))
      call lines%line("")
      call lines%line("CPU time of the integration: median and minimum of the rounds; front: no run is both cheaper and more "// &
         "accurate;")
      call lines%line("below: the error is below that of the reference, hence unknown")
      call add_table(lines, table_of_tol_runs(study))
      text = lines%get()
   end function precision_report

   !> How often runs were timed.
   function rounds_text(study) result(words)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: words          !! as `timed in 5 rounds with nothing written`

      integer :: k, most

      most = 0
      do k = 1, size(study%tol_sweeps)
         most = max(most, maxval(study%tol_sweeps(k)%tol_runs%n_round))
      end do
      words = "timed in "//to_text(study%rounds)
      if (most > study%rounds) words = words//" to "//to_text(most)
      words = words//trim(merge(" round ", " rounds", most == 1))//" without output"
   end function rounds_text

   !> The flags of the compiler that may change its code: without those that warn.
   function flags_of(flags) result(words)
      character(*), intent(in) :: flags      !! all of them
      character(:), allocatable :: words     !! some of them

      type(text_t), allocatable :: list(:)
      integer :: k

      words = ""
      list = split_blank(flags)
      do k = 1, size(list)
         if (.not. starts_with(list(k)%s, "-W")) words = words//" "//list(k)%s
      end do
      words = trim(adjustl(words))
   end function flags_of

   !> The budget as text, blank if there is none.
   function budget_text(study) result(words)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: words          !! as ` 60 s`

      words = ""
      if (study%budget > 0.0_wp) words = " "//real_text(study%budget, 3)//" s"
   end function budget_text

   !> Up to when runs are compared, if not to the end.
   function window_text(study) result(words)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: words          !! blank: to the end

      words = ""
      if (study%reference%is_cut .and. .not. study%reference%is_unsure) words = " up to "//real_text(study%reference%window, 4)// &
         " s, where the error of the reference is below a tenth of the target"
   end function window_text

   !> The reference and its own errors.
   subroutine add_reference(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      integer :: k

      if (study%reference%what == "") then
         call lines%line("reference  none: no run was completed, so costs are known but errors are not")
         return
      end if
      if (study%reference%confirmation == "") then
         call lines%line("reference  "//study%reference%what//", not confirmed by a second run: its error is unknown")
         return
      end if
      call lines%line("reference  "//study%reference%what//", confirmed by "//study%reference%confirmation//"; differences:")
      do k = 2, n_compared
         if (.not. ieee_is_finite(study%reference%bar(k))) cycle
         call lines%line("           "//with_unit(study%reference%bar(k), k)//"  "//trim(error_words(k))// &
                         trim(merge(" and end time  ", "               ", k == error_onsets .and. study%is_stopped)))
      end do
      if (study%reference%is_poor) then
         call lines%line("           a tighter reference failed or took too long: raise the budget")
      end if
      if (study%reference%is_unsure) call lines%line("           they never agree to a tenth of the target error")
   end subroutine add_reference

   !> An error with its unit.
   function with_unit(x, kind) result(words)
      real(wp), intent(in) :: x                   !! the error [1, s or m]
      integer, intent(in) :: kind                 !! its kind
      character(:), allocatable :: words          !! as `3.1e-9 s`

      words = short(x)
      if (error_units(kind) /= "1") words = words//" "//trim(error_units(kind))
   end function with_unit

   !> A number of two figures.
   function short(x) result(word)
      real(wp), intent(in) :: x                   !! the number [any]
      character(:), allocatable :: word           !! as `3.1e-09`, or `-` if there is none

      character(10) :: digits

      word = "-"
      if (.not. ieee_is_finite(x)) return
      write (digits, "(es10.1e3)") x
      word = replace(replace(trim(adjustl(digits)), "E-0", "e-"), "E+0", "e+")
      word = replace(replace(word, "E-", "e-"), "E+", "e+")
   end function short

   !> How fast neighbouring starts part, and how long a trajectory has digits.
   subroutine add_growth(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      character(:), allocatable :: words
      integer :: k

      associate (growth => study%growth)
         if (growth%reason /= "") then
            call lines%line("horizon    unknown: "//growth%reason)
            return
         end if
         call lines%line("horizon    "//growth_words(growth))
         words = ""
         do k = n_digit, 1, -1
            if (.not. ieee_is_finite(growth%horizon(k))) exit
            words = words//", "//to_text(k)//" to "//real_text(growth%horizon(k), 3)//" s"
         end do
         if (words /= "" .and. k > 0) words = words//", "//to_text(k)//" to the end"
         if (words == "") then
            call lines%line("           a solution has "//to_text(n_digit)//" digits up to the end of the run")
         else
            call lines%line("           digits of a solution in double precision: "//words(3:))
         end if
      end associate
   end subroutine add_growth

   !> How fast neighbouring starts part.
   function growth_words(growth) result(words)
      type(growth_t), intent(in) :: growth        !! what reference runs report
      character(:), allocatable :: words          !! a sentence

      if (growth%is_exponential) then
         words = "neighbouring trajectories diverge as exp("//real_text(growth%rate, 4)//" t/s), +-"// &
                 real_text(growth%rate_interval, 2)//", fitted from "//real_text(growth%fit_begin, 3)//" to "// &
                 real_text(growth%fit_end, 3)//" s by "//trajectories(growth)
      else
         words = "neighbouring trajectories diverge as a power of time, t^"//rounded(growth%power)//" +-"// &
                 rounded(growth%power_interval)//", by "//trajectories(growth)//": "// &
                 trim(merge("regular motion               ", "faster than regular motion   ", growth%is_regular))
      end if
   end function growth_words

   !> How many neighbouring trajectories a growth was found by.
   function trajectories(growth) result(words)
      type(growth_t), intent(in) :: growth        !! what reference runs report
      character(:), allocatable :: words          !! as `3 neighbouring trajectories`

      words = counted(growth%n_twin, "neighbouring trajectory", "neighbouring trajectories")
   end function trajectories

   !> An exponent with a digit behind the point.
   function rounded(x) result(word)
      real(wp), intent(in) :: x                   !! the exponent [1]
      character(:), allocatable :: word           !! as `1.2`

      word = real_text(0.1_wp*anint(10.0_wp*x), 3)
   end function rounded

   !> Runs that failed, were not made, or had other contacts, with their reasons, each reason of a setting once, however
   !> its numbers differ.
   subroutine add_failures(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      integer :: i, k, n

      do k = 1, size(study%tol_sweeps)
         associate (tol_runs => study%tol_sweeps(k)%tol_runs)
            i = 0
            do while (i < size(tol_runs))
               i = i + 1
               if (tol_runs(i)%state == tol_run_done) cycle
               n = i
               do while (n < size(tol_runs))
                  if (tol_runs(n + 1)%state /= tol_runs(i)%state .or. .not. is_same_reason(tol_runs(n + 1)%reason, &
                                                                                           tol_runs(i)%reason)) exit
                  n = n + 1
               end do
               call lines%line(trim(tol_run_states(tol_runs(i)%state))//": "//study%tol_sweeps(k)%name//" "// &
                               short(tol_runs(i)%asked)// &
                               range_end(tol_runs, i, n)//why(tol_runs(i)))
               i = n
            end do
         end associate
      end do
   end subroutine add_failures

   !> The end of a range of runs.
   function range_end(tol_runs, i, n) result(words)
      type(tol_run_t), intent(in) :: tol_runs(:)        !! (runs) of a tolerance sweep
      integer, intent(in) :: i                    !! first run
      integer, intent(in) :: n                    !! last run
      character(:), allocatable :: words          !! blank if it is one run

      words = ""
      if (n > i) words = " to "//short(tol_runs(n)%asked)//" ("//to_text(n - i + 1)//" runs)"
   end function range_end

   !> Why a run has no error.
   function why(tol_run) result(words)
      type(tol_run_t), intent(in) :: tol_run            !! the run
      character(:), allocatable :: words          !! as `: reason`

      words = ": "//tol_run%reason
      if (tol_run%state == tol_run_other &
          .and. tol_run%reason == "") words = ": the order or number of contacts differs from the reference"
   end function why

   !> The choice.
   subroutine add_choice(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(precision_t), intent(in) :: study      !! results

      character(:), allocatable :: kind

      kind = trim(error_names(study%wanted))
      if (study%reference%what == "" .or. study%reference%confirmation == "") then
         call lines%line("choice     none: no confirmed reference")
         return
      end if
      if (study%choice%tol_sweep == 0) then
         call lines%line("choice     no setting reaches an error of "//short(study%accuracy)//" ("//kind//")")
         return
      end if
      associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep), &
                 tol_run => study%tol_sweeps(study%choice%tol_sweep)%tol_runs(study%choice%tol_run))
         call lines%line("choice     "//settings_text(tol_sweep, tol_run))
         call lines%line("           the cheapest with an error below "//short(study%accuracy)//" ("//kind//"): error "// &
                         short(tol_run%error(study%wanted))//", "//real_text(1.0e3_wp*tol_run%cpu, 3)//" ms, "// &
                         to_text(tol_run%count%evaluations)//" right-hand sides")
         if (study%reference%is_cut) call lines%line("           within the range of the reference, up to "// &
                                           real_text(study%reference%window, 4)//" s of "//real_text(study%end, 4)//" s")
         if (ieee_is_finite(study%choice%error)) then
            call lines%line("           repeated: error "//short(study%choice%error)//", "// &
                            real_text(1.0e3_wp*study%choice%cpu, 3)//" ms")
         else
            call lines%line("           not repeated: time budget exhausted")
         end if
      end associate
   end subroutine add_choice

   !> A setting as a deck has it.
   function settings_text(tol_sweep, tol_run) result(words)
      type(tol_sweep_t), intent(in) :: tol_sweep        !! the tolerance sweep
      type(tol_run_t), intent(in) :: tol_run            !! its run
      character(:), allocatable :: words          !! as `method = verner, tolerance = 1e-6`

      words = "method = "//tol_sweep%setting%method
      if (tol_sweep%setting%stabiliser /= "") words = words//", stabilise = "//tol_sweep%setting%stabiliser
      if (tol_sweep%setting%solver /= "") words = words//", solver = "//tol_sweep%setting%solver
      if (tol_sweep%is_fixed) then
         words = words//", step = "//real_text(tol_run%asked, 4)//" s"
      else
         words = words//", tolerance = "//real_text(tol_run%asked, 4)
      end if
   end function settings_text

end module precision_text
