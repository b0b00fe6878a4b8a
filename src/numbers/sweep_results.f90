!> The results of a sweep: numbers of every run, and over the runs of each case their mean, standard deviation, least and
!> greatest value; as tables of comma-separated values.
!>
!> Runs are numbered case by case, so that what is written does not depend on which of them ended first. The standard
!> deviation is that of the sample, over n - 1; of one run it is not known.
module sweep_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use hdf5, only: h5fclose_f, h5fopen_f, h5f_acc_rdonly_f, hid_t
   use hdf5_calls, only: open_library
   use hdf5_read, only: has_dataset, read_reals, read_texts
   use kinds, only: not_a_number, wp
   use sweep_values, only: sweep_t
   use text, only: append_text, exact_text, replace, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: case_numbers, cases_csv, n_spread, run_result_t, runs_csv, spread_names, sweep_results_t

   integer, parameter :: n_spread = 4  !! numbers over the runs of a case
   !> Their names.
   character(*), parameter :: spread_names(n_spread) = [character(9) :: "mean", "deviation", "min", "max"]

   !> What came of one run.
   type :: run_result_t
      integer :: exit_code = -1                     !! -1: not run
      character(:), allocatable :: message          !! why, if not 0; else blank
      real(wp), allocatable :: numbers(:)           !! (n) as in `names`, perhaps fewer; NaN: not known [any]
      real(wp), allocatable :: strobe_times(:)      !! (m) instants once per period [s]
      real(wp), allocatable :: strobes(:, :)        !! (channels, m) the channels at them, SI [any]
   end type run_result_t

   !> All results.
   type :: sweep_results_t
      type(sweep_t) :: sweep                            !! the cases
      integer :: n_member = 1                           !! runs of a case
      logical :: is_ensemble = .false.                  !! whether their starts are perturbed
      type(text_t), allocatable :: names(:)             !! (n) names of the numbers
      type(text_t), allocatable :: units(:)             !! (n) their units
      type(text_t), allocatable :: strobe_names(:)      !! (channels) names of the stroboscopic channels
      type(run_result_t), allocatable :: runs(:)        !! (cases*n_member) case by case
   contains
      procedure :: start => start_results
      procedure :: take => take_run
   end type sweep_results_t

contains

   !> Nothing has been run yet.
   subroutine start_results(self)
      class(sweep_results_t), intent(inout) :: self  !! the results; sweep and n_member are known

      integer :: k

      allocate (self%names(0), self%units(0), self%strobe_names(0))
      allocate (self%runs(self%sweep%n_cases()*self%n_member))
      do k = 1, size(self%runs)
         self%runs(k)%message = "not run"
         allocate (self%runs(k)%numbers(0), self%runs(k)%strobe_times(0), self%runs(k)%strobes(0, 0))
      end do
   end subroutine start_results

   !> Take the statistics of a run from its run.h5.
   subroutine take_run(self, number, exit_code, message, path)
      class(sweep_results_t), intent(inout) :: self  !! the results
      integer, intent(in) :: number                  !! of the run
      integer, intent(in) :: exit_code               !! with which it ended
      character(*), intent(in) :: message            !! why, if not 0
      character(*), intent(in) :: path               !! its run.h5

      type(text_t), allocatable :: names(:), strobe_names(:), units(:)
      real(wp), allocatable :: strobes(:), values(:)
      integer(hid_t) :: file
      integer :: at, closed, k, status

      self%runs(number)%exit_code = exit_code
      self%runs(number)%message = message
      status = 0
      call open_library(status)
      if (status >= 0) call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      if (status < 0) return
      if (has_dataset(file, "statistics", "values")) then
         call read_texts(file, "statistics/names", names, status)
         call read_texts(file, "statistics/units", units, status)
         call read_reals(file, "statistics/values", values, status)
         do k = 1, size(values)
            if (status < 0) exit
            call find_name(self, names(k)%s, units(k)%s, at)
            self%runs(number)%numbers = [self%runs(number)%numbers, &
                                         [(not_a_number(), closed=size(self%runs(number)%numbers) + 1, at)]]
            self%runs(number)%numbers(at) = values(k)
         end do
      end if
      if (has_dataset(file, "statistics", "strobe")) then
         call read_texts(file, "statistics/strobe_names", strobe_names, status)
         call read_reals(file, "statistics/strobe_time", self%runs(number)%strobe_times, status)
         call read_reals(file, "statistics/strobe", strobes, status)
         if (status >= 0) then
            if (size(self%strobe_names) == 0) self%strobe_names = strobe_names
            self%runs(number)%strobes = reshape(strobes, [size(strobe_names), size(self%runs(number)%strobe_times)])
         end if
      end if
      call h5fclose_f(file, closed)
   end subroutine take_run

   !> The number of a name, which is appended if it is new.
   subroutine find_name(self, name, unit, at)
      type(sweep_results_t), intent(inout) :: self   !! the results
      character(*), intent(in) :: name               !! the name
      character(*), intent(in) :: unit               !! its unit
      integer, intent(out) :: at                     !! its number

      do at = 1, size(self%names)
         if (self%names(at)%s == name) return
      end do
      call append_text(self%names, name)
      call append_text(self%units, unit)
   end subroutine find_name

   !> A number over the runs of a case that have it: how many, and mean, deviation, least and greatest.
   pure subroutine case_numbers(self, case_number, number, n, spread)
      class(sweep_results_t), intent(in) :: self     !! the results
      integer, intent(in) :: case_number             !! of the case
      integer, intent(in) :: number                  !! of the number
      integer, intent(out) :: n                      !! runs that ended well and have the number
      real(wp), intent(out) :: spread(n_spread)      !! (4) as `spread_names`; NaN: not known [any]

      real(wp) :: sample(self%n_member)
      integer :: k

      n = 0
      do k = (case_number - 1)*self%n_member + 1, case_number*self%n_member
         associate (run => self%runs(k))
            if (run%exit_code /= 0 .or. size(run%numbers) < number) cycle
            if (ieee_is_nan(run%numbers(number))) cycle
            n = n + 1
            sample(n) = run%numbers(number)
         end associate
      end do
      spread = not_a_number()
      if (n == 0) return
      spread(1) = sum(sample(1:n))/real(n, wp)
      if (n > 1) spread(2) = sqrt(sum((sample(1:n) - spread(1))**2)/real(n - 1, wp))
      spread(3:4) = [minval(sample(1:n)), maxval(sample(1:n))]
   end subroutine case_numbers

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
      call lines%line(",message")
      do k = 1, size(self%runs)
         associate (case_number => (k - 1)/self%n_member + 1)
            call lines%add(to_text(case_number)//","//to_text(mod(k - 1, self%n_member) + 1)// &
                           parameter_cells(self%sweep, case_number)//","//to_text(self%runs(k)%exit_code))
         end associate
         do i = 1, size(self%names)
            call lines%add(",")
            if (i <= size(self%runs(k)%numbers)) call lines%add(cell(self%runs(k)%numbers(i)))
         end do
         call lines%line(","//quoted(self%runs(k)%message))
      end do
      text = lines%get()
   end function runs_csv

   !> One row per case.
   function cases_csv(self) result(text)
      type(sweep_results_t), intent(in) :: self   !! the results
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
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
            do m = 1, n_spread
               call lines%add(","//cell(spread(m)))
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

end module sweep_results
