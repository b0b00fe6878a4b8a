!> The results of a sweep as tables: a row for each run, and a row for each case.
module sweep_tables
   use kinds, only: not_a_number, wp
   use result_table, only: in_hdf5, in_text_files, result_table_t
   use swept, only: sweep_t
   use sweep_results, only: case_numbers, n_spread, spread_names, sweep_results_t
   use text, only: append_text, counted, join, text_t
   implicit none (type, external)
   private
   public :: shown_cases, table_of_cases, table_of_runs

   character(*), parameter :: spread_help(n_spread) = [character(40) :: "mean over the runs of a case", &
      "standard deviation over these runs", "minimum of these runs", "maximum of these runs"]

contains

   !> The runs.
   function table_of_runs(results) result(table)
      type(sweep_results_t), intent(in) :: results      !! the runs
      type(result_table_t) :: table                     !! a row for each run

      type(text_t) :: messages(size(results%runs)), warnings(size(results%runs))
      real(wp) :: values(size(results%names), size(results%runs))
      integer :: members(size(results%runs)), owners(size(results%runs)), k

      values = not_a_number()
      do k = 1, size(results%runs)
         owners(k) = (k - 1)/results%n_member + 1
         members(k) = mod(k - 1, results%n_member) + 1
         values(1:size(results%runs(k)%numbers), k) = results%runs(k)%numbers
         messages(k)%s = results%runs(k)%message
         warnings(k)%s = results%runs(k)%warnings
      end do
      call table%start("runs", "runs", size(owners))
      call table%put("case", "1", "case of the run", integers=owners)
      call table%put("run", "1", "number of the run in its case", integers=members, formats=in_text_files)
      call table%put("member", "1", "number of the run in the ensemble; 0: no ensemble", &
                     integers=merge(members, 0, results%is_ensemble), formats=in_hdf5)
      call put_parameters(table, results%sweep, owners)
      call table%put("exit_code", "1", "0: done; -1: not run; otherwise the exit code", integers=results%runs%exit_code)
      call table%put("values", join(results%units, " "), "statistics of every run", reshape(values, [size(values)]), &
                     shape=[size(results%names)], parts=results%names)
      call table%put("message", "1", "reason of a failure; blank if none", texts=messages)
      call table%put("warnings", "1", "warnings of a run; blank if none", texts=warnings)
   end function table_of_runs

   !> The cases, with numbers over the runs of each.
   function table_of_cases(results) result(table)
      type(sweep_results_t), intent(in) :: results      !! the runs
      type(result_table_t) :: table                     !! a row for each case

      type(text_t) :: names(n_spread, size(results%names)), units(n_spread, size(results%names))
      real(wp) :: spreads(n_spread, size(results%names), results%sweep%n_cases())
      integer :: cases(results%sweep%n_cases()), done(results%sweep%n_cases()), i, k, n_with_number

      do k = 1, size(cases)
         cases(k) = k
         done(k) = count(results%runs((k - 1)*results%n_member + 1:k*results%n_member)%exit_code == 0)
         do i = 1, size(results%names)
            call case_numbers(results, k, i, n_with_number, spreads(:, i, k))
         end do
      end do
      do i = 1, size(results%names)
         do k = 1, n_spread
            names(k, i)%s = results%names(i)%s//" "//trim(spread_names(k))
            units(k, i)%s = results%units(i)%s
         end do
      end do
      call table%start("cases", "cases", size(cases))
      call table%put("case", "1", "number of the case", integers=cases, formats=in_text_files)
      call put_parameters(table, results%sweep, cases)
      call table%put("runs", "1", "completed runs of the case", integers=done)
      do i = 1, n_spread
         call table%put(trim(spread_names(i)), join(results%units, " "), trim(spread_help(i)), &
                        [spreads(i, :, :)], shape=[size(results%names)], formats=in_hdf5)
      end do
      call table%put("numbers", join([units], " "), "numbers over the runs of the case", [spreads], &
                     shape=shape(names), parts=[names], formats=in_text_files)
   end function table_of_cases

   !> The cases for people: parameters as the deck writes them, and a few numbers, the means over the runs of a case.
   function shown_cases(results, preferred) result(table)
      type(sweep_results_t), intent(in) :: results      !! the runs
      character(*), intent(in) :: preferred             !! names of numbers to show, each between commas; none: the first ones
      type(result_table_t) :: table                     !! a row for each case

      integer, parameter :: most_rows = 20     ! cases shown
      integer, parameter :: most_columns = 5   ! numbers shown
      integer, allocatable :: chosen(:)
      type(text_t) :: texts(results%sweep%n_cases())
      real(wp) :: mean(results%sweep%n_cases()), spread(n_spread)
      integer :: done(results%sweep%n_cases()), i, k, n_with_number

      call table%start("cases", "", size(done), title="case", elsewhere="cases.csv")
      table%most = most_rows
      call table%put("case", "1", "", integers=[(k, k=1, size(done))], heading="case")
      if (allocated(results%sweep%parameters)) then
         do i = 1, size(results%sweep%parameters)
            associate (parameter => results%sweep%parameters(i))
               texts = parameter%texts([(results%sweep%value_number(i, k), k=1, size(done))])
               call table%put(parameter%name, "1", "", texts=texts, heading=parameter%name)
            end associate
         end do
      end if
      done = [(count(results%runs((k - 1)*results%n_member + 1:k*results%n_member)%exit_code == 0), k=1, size(done))]
      if (results%n_member > 1 .or. any(done == 0)) call table%put("runs", "1", "", integers=done, heading="runs done")
      chosen = pack([(i, i=1, size(results%names))], &
                    [(index(preferred, ","//results%names(i)%s//",") > 0, i=1, size(results%names))])
      if (size(chosen) == 0) chosen = [(i, i=1, size(results%names))]
      do i = 1, min(size(chosen), most_columns)
         do k = 1, size(done)
            call case_numbers(results, k, chosen(i), n_with_number, spread)
            mean(k) = spread(1)
         end do
         call table%put(results%names(chosen(i))%s, results%units(chosen(i))%s, "", mean, heading=results%names(chosen(i))%s)
      end do
      if (results%n_member > 1) then
         call append_text(table%notes, "means over the runs of a case; deviations, minima and maxima in cases.csv")
      end if
      if (size(chosen) > most_columns .or. size(results%names) > size(chosen)) then
         call append_text(table%notes, counted(size(results%names), "number", "numbers")//" of each case in cases.csv")
      end if
   end function shown_cases

   !> Add the parameters, numbers in SI.
   subroutine put_parameters(table, sweep, cases)
      type(result_table_t), intent(inout) :: table      !! grown
      type(sweep_t), intent(in) :: sweep                !! the parameters
      integer, intent(in) :: cases(:)                   !! (n) the case of each row

      type(text_t) :: texts(size(cases))
      integer :: at(size(cases)), i, k

      do k = 1, size(sweep%parameters)
         at = [(sweep%value_number(k, cases(i)), i=1, size(cases))]
         associate (parameter => sweep%parameters(k))
            if (parameter%unit == "") then
               texts = parameter%texts(at)
               call table%put(parameter%name, "1", "", texts=texts, formats=in_text_files)
            else
               call table%put(parameter%name, parameter%unit, "", parameter%numbers(at), formats=in_text_files)
            end if
         end associate
      end do
   end subroutine put_parameters

end module sweep_tables
