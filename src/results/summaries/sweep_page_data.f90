!> The data of the page of a sweep: one object of JavaScript, `D`, with parameters, results, runs, means over the runs of a case,
!> Poincare samples and histories that were kept.
!>
!> Numbers stand in base 64, whole, in SI; beside them stand the factor and the symbol of the unit that is shown, that of the
!> figures. Mean and standard deviation are those of cases.csv. What would make the page larger than its limit is left out, and the
!> page says what: results that no figure draws, runs behind the first ones, samples between others.
module sweep_page_data
   use batch_means, only: student
   use display_units, only: choose_unit, display_unit_t
   use html_text, only: doubles_in_base_64, escaped, floats_in_base_64, integers_in_base_64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_histories, only: kept_histories_t
   use kinds, only: not_a_number, wp
   use sweep_axes, only: axis_of_parameter, sweep_axis_t
   use sweep_results, only: case_numbers, n_spread, sweep_results_t
   use text, only: exact_text, real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: sweep_data

   integer, parameter :: of_double = 11             !! letters of a number in base 64, about
   integer, parameter :: most_of_values = 2200000   !! bytes of the page for the results of the runs
   integer, parameter :: most_of_samples = 600000   !! the same for Poincare samples

contains

   !> The object.
   function sweep_data(results, preferred, histories) result(text)
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      character(*), intent(in) :: preferred               !! numbers that figures draw, each between commas
      type(kept_histories_t), intent(in) :: histories     !! of runs whose channels were kept
      character(:), allocatable :: text                   !! `const D={...};`

      type(buffer_t) :: data
      character(:), allocatable :: note
      integer, allocatable :: chosen(:)
      integer :: k, n_run

      note = histories%note
      call choose_results(results, preferred, chosen, n_run, note)
      call data%line("const D={ensemble:"//trim(merge("true ", "false", results%is_ensemble))//",members:"// &
                     to_text(results%n_member)//",together:"//to_text(n_together(results))//",student:"""// &
                     doubles_in_base_64([(student(k), k=1, max(1, results%n_member - 1))])//""",")
      call add_parameters(data, results, (n_run - 1)/results%n_member + 1)
      call add_results(data, results, preferred, chosen, n_run)
      call add_runs(data, results, n_run)
      call add_samples(data, results, n_run, note)
      call add_histories(data, histories, n_run)
      call data%line("note:"""//escaped(note, .false.)//"""};")
      text = data%get()
   end function sweep_data

   !> Parameters, the first of all, that change together.
   pure integer function n_together(results) result(n)
      type(sweep_results_t), intent(in) :: results        !! what the runs gave

      n = results%sweep%n_together
      if (results%sweep%is_paired) n = size(results%sweep%parameters)
   end function n_together

   !> Results and runs that the page has.
   subroutine choose_results(results, preferred, chosen, n_run, note)
      type(sweep_results_t), intent(in) :: results                 !! what the runs gave
      character(*), intent(in) :: preferred                        !! numbers that figures draw
      integer, allocatable, intent(out) :: chosen(:)               !! (n) numbers of results, in their order
      integer, intent(out) :: n_run                                !! so many of the first runs
      character(:), allocatable, intent(inout) :: note             !! says what is left out

      integer :: capacity, k, of_run, pass
      logical :: is_chosen(size(results%names)), is_drawn

      n_run = size(results%runs)
      of_run = of_double
      if (results%is_ensemble) of_run = of_double + n_spread*of_double/results%n_member
      capacity = max(1, most_of_values/(of_run*max(1, n_run)))
      is_chosen = .false.
      do pass = 1, 2
         do k = 1, size(is_chosen)
            is_drawn = index(preferred, ","//results%names(k)%s//",") > 0
            if (count(is_chosen) < capacity .and. (is_drawn .eqv. pass == 1)) is_chosen(k) = .true.
         end do
      end do
      chosen = pack([(k, k=1, size(is_chosen))], is_chosen)
      if (size(chosen) < size(is_chosen)) then
         note = note//to_text(size(chosen))//" of "//to_text(size(is_chosen))//" results, so that the page stays below 5 MB. "
      end if
      n_run = min(n_run, results%n_member*max(1, most_of_values/(of_run*max(1, size(chosen)))/results%n_member))
      if (n_run < size(results%runs)) then
         note = note//"The first "//to_text(n_run)//" of "//to_text(size(results%runs))// &
                " runs, so that the page stays below 5 MB. "
      end if
   end subroutine choose_results

   !> Parameters: name, unit, values as in the deck and as numbers, and which of them a case has. Values with many digits, as
   !> those that are sampled, are shown with six.
   subroutine add_parameters(data, results, n_case)
      type(buffer_t), intent(inout) :: data               !! grown
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      integer, intent(in) :: n_case                       !! cases of the page

      integer, parameter :: longest = 14     ! letters of a value that is shown as it stands
      type(sweep_axis_t) :: axis
      type(display_unit_t) :: unit
      integer :: i, k
      logical :: is_long

      call data%add("parameters:[")
      if (allocated(results%sweep%parameters)) then
         do k = 1, size(results%sweep%parameters)
            associate (parameter => results%sweep%parameters(k))
               axis = axis_of_parameter(parameter)
               is_long = maxval([(len(parameter%texts(i)%s), i=1, size(parameter%texts))]) > longest .and. parameter%unit /= ""
               unit = axis%unit_shown()
               if (is_long) unit = choose_unit(parameter%unit, maxval(abs(parameter%numbers)))
               call data%add("{n:"""//escaped(parameter%name, .false.)//""",u:"""//escaped(unit%symbol, .false.)//""",f:"// &
                             exact_text(unit%factor)//",log:"//trim(merge("true ", "false", axis%is_log))//",words:"// &
                             trim(merge("true ", "false", size(axis%categories) > 0))//",texts:[")
               do i = 1, size(parameter%texts)
                  if (is_long) then
                     call data%add(""""//trim(real_text(unit%factor*parameter%numbers(i), 6)//" "//unit%symbol)//""",")
                  else
                     call data%add(""""//escaped(parameter%texts(i)%s, .false.)//""",")
                  end if
               end do
               call data%line("],x:"""//doubles_in_base_64(axis%x)//""",at:"""// &
                              integers_in_base_64([(results%sweep%value_number(k, i) - 1, i=1, n_case)])//"""},")
            end associate
         end do
      end if
      call data%line("],")
   end subroutine add_parameters

   !> Results: name, unit, of each run its value, of each case of an ensemble mean, deviation, minimum and maximum.
   subroutine add_results(data, results, preferred, chosen, n_run)
      type(buffer_t), intent(inout) :: data               !! grown
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      character(*), intent(in) :: preferred               !! numbers that figures draw
      integer, intent(in) :: chosen(:)                    !! (n) numbers of results
      integer, intent(in) :: n_run                        !! runs of the page

      type(display_unit_t) :: unit
      real(wp) :: spreads(n_spread, (n_run - 1)/results%n_member + 1), values(n_run)
      integer :: i, k, n

      call data%line("results:[")
      do i = 1, size(chosen)
         associate (name => results%names(chosen(i))%s)
            values = not_a_number()
            do k = 1, n_run
               if (results%runs(k)%exit_code /= 0 .or. size(results%runs(k)%numbers) < chosen(i)) cycle
               values(k) = results%runs(k)%numbers(chosen(i))
            end do
            unit = choose_unit(results%units(chosen(i))%s, maxval([0.0_wp, pack(abs(values), ieee_is_finite(values))]))
            call data%add("{n:"""//escaped(name, .false.)//""",u:"""//escaped(unit%symbol, .false.)//""",f:"// &
                          exact_text(unit%factor)//",drawn:"// &
                          trim(merge("true ", "false", index(preferred, ","//name//",") > 0))//",v:"""// &
                          doubles_in_base_64(values)//"""")
            if (results%is_ensemble) then
               do k = 1, size(spreads, 2)
                  call case_numbers(results, k, chosen(i), n, spreads(:, k))
               end do
               call data%add(",s:"""//doubles_in_base_64([spreads])//"""")
            end if
            call data%line("},")
         end associate
      end do
      call data%line("],")
   end subroutine add_results

   !> Runs: exit codes, and what is said of those that failed or have warnings.
   subroutine add_runs(data, results, n_run)
      type(buffer_t), intent(inout) :: data               !! grown
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      integer, intent(in) :: n_run                        !! runs of the page

      integer :: k

      call data%line("exit:"""//integers_in_base_64(results%runs(:n_run)%exit_code)//""",said:{")
      do k = 1, n_run
         associate (run => results%runs(k))
            if (len(run%message) + len(run%warnings) == 0) cycle
            call data%line(to_text(k - 1)//":"""//escaped(run%message//trim(merge("; ", "  ", len(run%message) > 0 .and. &
                           len(run%warnings) > 0))//" "//run%warnings, .false.)//""",")
         end associate
      end do
      call data%line("},")
   end subroutine add_runs

   !> Poincare samples: of each channel its name and unit, of each sample the run and the value.
   subroutine add_samples(data, results, n_run, note)
      type(buffer_t), intent(inout) :: data               !! grown
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      integer, intent(in) :: n_run                        !! runs of the page
      character(:), allocatable, intent(inout) :: note    !! says what is left out

      integer, parameter :: of_integer = 6   ! letters of an integer in base 64, about
      type(display_unit_t) :: unit
      real(wp), allocatable :: samples(:, :), values(:, :)
      integer, allocatable :: owners(:)
      integer :: k, m, n, stride

      n = sum([(size(results%runs(k)%poincare_times), k=1, n_run)])
      stride = 1 + n*(of_integer + of_double*size(results%poincare_names))/most_of_samples
      if (stride > 1) note = note//"Every "//to_text(stride)//". Poincare sample, so that the page stays below 5 MB. "
      allocate (owners(n), values(size(results%poincare_names), n))
      n = 0
      do k = 1, n_run
         samples = results%poincare_of(k)
         do m = 1, size(samples, 2), stride
            n = n + 1
            owners(n) = k - 1
            values(:, n) = samples(:, m)
         end do
      end do
      call data%line("poincare:{run:"""//integers_in_base_64(owners(:n))//""",list:[")
      do k = 1, size(results%poincare_names)
         unit = choose_unit(unit_of(results, k), maxval([0.0_wp, pack(abs(values(k, :n)), ieee_is_finite(values(k, :n)))]))
         call data%line("{n:"""//escaped(results%poincare_names(k)%s, .false.)//""",u:"""//escaped(unit%symbol, .false.)// &
                        """,f:"//exact_text(unit%factor)//",v:"""//doubles_in_base_64(values(k, :n))//"""},")
      end do
      call data%line("]},")
   end subroutine add_samples

   !> The SI unit of a channel of the samples: that of its maximum, or `1`.
   function unit_of(results, channel) result(unit)
      type(sweep_results_t), intent(in) :: results        !! what the runs gave
      integer, intent(in) :: channel                      !! number of the channel
      character(:), allocatable :: unit                   !! SI

      integer :: k

      unit = "1"
      do k = 1, size(results%names)
         if (results%names(k)%s == results%poincare_names(channel)%s//".max") unit = results%units(k)%s
      end do
   end function unit_of

   !> Histories: of each channel its name and unit, of each run its window and its values, minima and maxima.
   subroutine add_histories(data, histories, n_run)
      type(buffer_t), intent(inout) :: data               !! grown
      type(kept_histories_t), intent(in) :: histories     !! of runs whose channels were kept
      integer, intent(in) :: n_run                        !! runs of the page

      type(display_unit_t) :: unit
      integer :: i, k

      call data%line("histories:[")
      do i = 1, size(histories%names)
         associate (low => histories%low(:, i, :), high => histories%high(:, i, :))
            unit = choose_unit(histories%units(i)%s, &
                               maxval([0.0_wp, pack(abs(low), ieee_is_finite(low)), pack(abs(high), ieee_is_finite(high))]))
         end associate
         call data%line("{n:"""//escaped(histories%names(i)%s, .false.)//""",u:"""//escaped(unit%symbol, .false.)//""",runs:{")
         do k = 1, size(histories%runs)
            if (histories%runs(k) > n_run) cycle
            call data%line(to_text(histories%runs(k) - 1)//":{w:["//exact_text(histories%windows(1, k))//","// &
                           exact_text(histories%windows(2, k))//"],v:"""// &
                           floats_in_base_64(unit%factor*histories%values(:, i, k))//""",lo:"""// &
                           floats_in_base_64(unit%factor*histories%low(:, i, k))//""",hi:"""// &
                           floats_in_base_64(unit%factor*histories%high(:, i, k))//"""},")
         end do
         call data%line("}},")
      end do
      call data%line("],")
   end subroutine add_histories

end module sweep_page_data
