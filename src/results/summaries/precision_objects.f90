!> The results of a comparison of settings for scripts.
module precision_objects
   use bend_text, only: bends_of
   use horizon_table, only: table_of_horizon
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: i8
   use precision_results, only: error_names, n_statistic, precision_t, tol_run_done, tol_run_failed, tol_run_other, tol_run_unrun, &
      statistic_names
   use precision_text, only: settings_text
   use table_list, only: list_of
   implicit none (type, external)
   private
   public :: precision_json

contains

   !> The results for scripts, added to an object.
   subroutine precision_json(study, json)
      type(precision_t), intent(in) :: study       !! results
      type(json_object_t), intent(inout) :: json   !! grown

      call json%put_text("error", trim(error_names(study%wanted)))
      call json%put_real("accuracy", study%accuracy)
      call json%put_text("reference", study%reference%what)
      call json%put_text("confirmed_by", study%reference%confirmation)
      call json%put_real("reference_error", study%reference%bar(study%wanted))
      call json%put_real("end", study%end)
      call json%put_real("window", study%reference%window)
      if (study%reference%statistics%is_there) call put_statistics()
      call json%put_integer("settings", int(size(study%tol_sweeps), i8))
      call json%put_integer("runs", int(runs_in(tol_run_done), i8))
      call json%put_integer("failed", int(runs_in(tol_run_failed), i8))
      call json%put_integer("not_run", int(runs_in(tol_run_unrun), i8))
      call json%put_integer("other_sequence", int(runs_in(tol_run_other), i8))
      call json%put_integer("rounds", int(study%rounds, i8))
      call json%put_real("budget", study%budget)
      call json%put_real("spent", study%spent)
      call json%put_text("growth", growth_word())
      if (study%growth%reason == "") then
         call json%put_real("growth_rate", study%growth%rate)
         call json%put_real("growth_rate_interval", study%growth%rate_interval)
         call json%put_real("growth_power", study%growth%power)
      end if
      if (allocated(study%horizon%t)) call put_tables(json, list_of(table_of_horizon(study%horizon)))
      call json%put_list("bends", bends_of(study))
      if (study%choice%tol_sweep == 0) return
      associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep), &
                 tol_run => study%tol_sweeps(study%choice%tol_sweep)%tol_runs(study%choice%tol_run))
         call json%put_text("choice", settings_text(tol_sweep, tol_run))
         call json%put_real("choice_error", tol_run%error(study%wanted))
         call json%put_real("choice_cpu", tol_run%cpu)
         call json%put_real("confirmed_error", study%choice%error)
         call json%put_real("confirmed_cpu", study%choice%cpu)
      end associate

   contains

      !> Statistics of the reference, and how many runs are apart from it.
      subroutine put_statistics()
         integer :: k, s

         associate (statistics => study%reference%statistics)
            call json%put_real("statistics_from", statistics%from)
            do s = 1, n_statistic
               call json%put_real(trim(statistic_names(s)), statistics%list(s)%value)
               call json%put_real(trim(statistic_names(s))//"_interval", statistics%list(s)%half)
               call json%put_integer(trim(statistic_names(s))//"_apart", &
                                     int(sum([(study%tol_sweeps(k)%statistics%n_apart(s), k=1, size(study%tol_sweeps))]), i8))
            end do
         end associate
      end subroutine put_statistics

      !> Runs in some state.
      pure integer function runs_in(state) result(n)
         integer, intent(in) :: state  !! the state

         integer :: k

         n = 0
         do k = 1, size(study%tol_sweeps)
            n = n + count(study%tol_sweeps(k)%tol_runs%state == state)
         end do
      end function runs_in

      !> The law of growth.
      function growth_word() result(word)
         character(:), allocatable :: word  !! exponential, power, or blank

         word = ""
         if (study%growth%reason == "") word = trim(merge("exponential", "power      ", study%growth%is_exponential))
      end function growth_word

   end subroutine precision_json

end module precision_objects
