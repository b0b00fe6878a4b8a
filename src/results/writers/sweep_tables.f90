!> The results of a sweep as tables of comma-separated values: sweep.csv, a row for each run, and cases.csv, one for each case.
module sweep_tables
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use swept, only: sweep_t
   use sweep_results, only: case_numbers, n_spread, spread_names, sweep_results_t
   use text, only: exact_text, replace, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: cases_csv, runs_csv

contains

   !> One row per run.
   function runs_csv(self) result(text)
      type(sweep_results_t), intent(in) :: self   !! the results
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      integer :: i, k

      call lines%add("case,run"//parameter_heads(self%sweep)//",exit_code")
      do i = 1, size(self%names)
         call lines%add(","//head(self%names(i)%s, self%units(i)%s))
      end do
      call lines%line(",message,warnings")
      do k = 1, size(self%runs)
         associate (case_number => (k - 1)/self%n_member + 1)
            call lines%add(to_text(case_number)//","//to_text(mod(k - 1, self%n_member) + 1)// &
                           parameter_cells(self%sweep, case_number)//","//to_text(self%runs(k)%exit_code))
         end associate
         do i = 1, size(self%names)
            call lines%add(",")
            if (i <= size(self%runs(k)%numbers)) call lines%add(cell(self%runs(k)%numbers(i)))
         end do
         call lines%line(","//quoted(self%runs(k)%message)//","//quoted(self%runs(k)%warnings))
      end do
      text = lines%get()
   end function runs_csv

   !> One row per case.
   function cases_csv(self) result(text)
      type(sweep_results_t), intent(in) :: self   !! the results
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      character(:), allocatable :: first   ! the mean
      real(wp) :: spread(n_spread)
      integer :: i, k, m, n

      call lines%add("case"//parameter_heads(self%sweep)//",runs")
      do i = 1, size(self%names)
         do m = 1, n_spread
            call lines%add(","//head(self%names(i)%s//" "//trim(spread_names(m)), self%units(i)%s))
         end do
      end do
      call lines%line("")
      do k = 1, self%sweep%n_cases()
         n = count(self%runs((k - 1)*self%n_member + 1:k*self%n_member)%exit_code == 0)
         call lines%add(to_text(k)//parameter_cells(self%sweep, k)//","//to_text(n))
         do i = 1, size(self%names)
            call case_numbers(self, k, i, n, spread)
            first = cell(spread(1))
            call lines%add(","//first)
            do m = 2, n_spread
               if (ieee_is_nan(spread(m)) .or. ieee_is_nan(spread(1))) then
                  call lines%add(","//cell(spread(m)))
               else if (abs(spread(m) - spread(1)) > 0.0_wp) then
                  call lines%add(","//cell(spread(m)))
               else
                  call lines%add(","//first)   ! as of a single run
               end if
            end do
         end do
         call lines%line("")
      end do
      text = lines%get()
   end function cases_csv

   !> Heads of the columns of the parameters.
   function parameter_heads(sweep) result(text)
      type(sweep_t), intent(in) :: sweep     !! the cases
      character(:), allocatable :: text      !! each with a comma before it

      integer :: k

      text = ""
      do k = 1, size(sweep%parameters)
         text = text//","//head(sweep%parameters(k)%name, sweep%parameters(k)%unit)
      end do
   end function parameter_heads

   !> The parameters of a case, numbers in SI.
   function parameter_cells(sweep, case_number) result(text)
      type(sweep_t), intent(in) :: sweep     !! the cases
      integer, intent(in) :: case_number     !! of the case
      character(:), allocatable :: text      !! each with a comma before it

      integer :: at, k

      text = ""
      do k = 1, size(sweep%parameters)
         at = sweep%value_number(k, case_number)
         if (sweep%parameters(k)%unit == "") then
            text = text//","//quoted(sweep%parameters(k)%texts(at)%s)
         else
            text = text//","//cell(sweep%parameters(k)%numbers(at))
         end if
      end do
   end function parameter_cells

   !> The head of a column.
   pure function head(name, unit) result(text)
      character(*), intent(in) :: name       !! what it is
      character(*), intent(in) :: unit       !! `1` or blank: none
      character(:), allocatable :: text      !! as `motor.moment.rms [N.m]`

      text = name
      if (unit /= "1" .and. unit /= "") text = name//" ["//unit//"]"
   end function head

   !> A number; what is not known is an empty cell.
   pure function cell(x) result(text)
      real(wp), intent(in) :: x              !! the number [any]
      character(:), allocatable :: text      !! its digits

      text = ""
      if (.not. ieee_is_nan(x)) text = exact_text(x)
   end function cell

   !> Text in quotes if it needs them.
   pure function quoted(text) result(s)
      character(*), intent(in) :: text       !! any text
      character(:), allocatable :: s         !! on one line

      s = replace(text, new_line("a"), " ")
      if (scan(s, ",""") > 0) s = """"//replace(s, """", """""")//""""
   end function quoted

end module sweep_tables
