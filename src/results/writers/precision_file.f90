!> Writes precision.h5: every run of a comparison of settings, its costs and errors, the reference, reference runs and choice.
!>
!> The file is written whole, under another name first, so that there is never half of it.
module precision_file
   use errors, only: error_t
   use growth, only: n_digit
   use hdf5, only: hid_t
   use hdf5_attributes, only: text_attribute
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use hdf5_layout, only: write_status
   use provenance, only: make_provenance
   use hdf5_table, only: write_tables
   use horizon_table, only: table_of_digits, table_of_horizon
   use kinds, only: wp
   use output_plan, only: output_plan_t
   use precision_results, only: error_names, error_units, error_words, n_compared, n_error, n_statistic, precision_t, &
      statistic_names, statistic_units, statistic_words
   use precision_table, only: table_of_settings, table_of_tol_runs
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use table_list, only: list_of
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
         call write_tables(file, list_of(table_of_settings(study)), status)
         call write_tol_runs(file, study, status)
         call write_reference(file, study, status)
         call write_statistics(file, study, status)
         call write_growth(file, study, status)
         if (allocated(study%horizon%t)) then
            call write_tables(file, list_of(table_of_horizon(study%horizon), table_of_digits(study%horizon)), status)
         end if
         call write_choice(file, study, status)
         call make_provenance(file, plan, status)
         call write_status(file, status_complete, status)
      end if
      call end_whole_file(path, file, status, error)
   end subroutine write_precision

   !> The types of error, and every run.
   subroutine write_tol_runs(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      type(text_t), allocatable :: names(:), units(:), words(:)
      integer :: k

      allocate (names(0), units(0), words(0))
      do k = 1, n_error
         call append_text(names, trim(error_names(k)))
         call append_text(units, trim(error_units(k)))
         call append_text(words, trim(error_words(k)))
      end do
      call text_dataset(file, "errors/names", names, .false., "types of error", status)
      call text_dataset(file, "errors/units", units, .false., "their units", status)
      call text_dataset(file, "errors/long_names", words, .false., "descriptions", status)
      call write_tables(file, list_of(table_of_tol_runs(study)), status)
   end subroutine write_tol_runs

   !> The reference.
   subroutine write_reference(file, study, status)
      integer(hid_t), intent(in) :: file          !! the file
      type(precision_t), intent(in) :: study      !! results
      integer, intent(inout) :: status            !! negative: failed

      type(result_table_t) :: table

      call table%start("reference", "reference", 0)
      call table%fact("setting", study%reference%what)
      call table%fact("confirmed_by", study%reference%confirmation)
      call table%fact("window", study%reference%window)
      call table%fact("end", study%end)
      call write_tables(file, [table], status)
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

      type(result_table_t) :: table
      type(text_t), allocatable :: names(:), units(:), words(:)
      integer :: i, k, n, s

      associate (reference => study%reference%statistics, tol_sweeps => study%tol_sweeps)
         if (.not. reference%is_there) return
         call table%start("statistics", "statistics", 0)
         call table%fact("from", reference%from)
         call table%fact("until", study%end)
         call write_tables(file, [table], status)
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

      type(result_table_t) :: table

      associate (growth => study%growth)
         call table%start("twins", "twins", 0)
         call table%fact("reason", growth%reason)
         if (growth%reason == "") then
            call table%fact("law", trim(merge("exponential", "power      ", growth%is_exponential)))
            call table%fact("rate", growth%rate)
            call table%fact("rate_interval", growth%rate_interval)
            call table%fact("power", growth%power)
            call table%fact("power_interval", growth%power_interval)
            call table%fact("fit_begin", growth%fit_begin)
            call table%fact("fit_end", growth%fit_end)
         end if
         call write_tables(file, [table], status)
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

      type(result_table_t) :: table

      call table%start("choice", "choice", 0)
      call table%fact("error", trim(error_names(study%wanted)))
      call table%fact("accuracy", study%accuracy)
      call table%fact("budget", study%budget)
      call table%fact("spent", study%spent)
      if (study%choice%tol_sweep > 0) then
         associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep))
            call table%fact("setting", tol_sweep%name)
            call table%fact("asked", tol_sweep%tol_runs(study%choice%tol_run)%asked)
            call table%fact("confirmed_error", study%choice%error)
            call table%fact("confirmed_cpu", study%choice%cpu)
         end associate
      else
         call table%fact("setting", "")
      end if
      call write_tables(file, [table], status)
   end subroutine write_choice

end module precision_file
