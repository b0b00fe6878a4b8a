!> Time and error of the hand-coded dry slider-crank over a tolerance sweep of tolerances.
!>
!> Prints one line per tolerance; the first line names the columns. Errors are the maximum of the
!> first 4 and the first 10 onsets [s] and of the first 5 impact speeds [1]; CPU times are medians.
!> One argument, optional: seconds to spend on each of the five (default 0.05).
program minimal_slider_crank
   use, intrinsic :: iso_fortran_env, only: output_unit
   use minimal_solution, only: counts_t, dp, simulate
   implicit none (type, external)

   integer, parameter :: n_reference = 10   !! onsets known
   integer, parameter :: n_repeat = 5       !! timings of which the median is taken
   real(dp), parameter :: t_end = 0.024_dp  !! two turns of the crank [s]

   !> Onsets of contact and impact speeds from an independent solution in minimal coordinates by an
   !> extrapolation method in extended precision, good to twelve digits [s], [m/s].
   real(dp), parameter :: reference(n_reference) = [ &
      0.00022728603203978336_dp, 0.000637056430166948_dp, 0.0007497002798424155_dp, &
      0.0010859470339142309_dp, 0.0012058161279889777_dp, 0.0015514860013049656_dp, &
      0.0017150817862198534_dp, 0.002872495289603114_dp, 0.003169842912505948_dp, &
      0.003354093968756208_dp]
   real(dp), parameter :: reference_speed(5) = [4.385783145280216_dp, 2.756949152964998_dp, &
      1.8266990749108598_dp, 1.1018511775233388_dp, 0.8238005433086999_dp]

   type(counts_t) :: counts
   real(dp) :: seconds, tolerance, cpu(n_repeat), errors(n_reference), speeds(5)
   character(32) :: argument
   integer :: exponent, k, n_runs

   seconds = 0.05_dp
   if (command_argument_count() > 0) then
      call get_command_argument(1, argument)
      read (argument, *) seconds
   end if
   write (output_unit, "(a)") "tolerance  steps  rejected     rhs    cpu_us  ns_per_rhs"// &
      "    error_4   error_10     speeds"
   do exponent = 4, 12
      tolerance = 10.0_dp**(-exponent)
      n_runs = max(1, int(seconds/time_of(1)))
      do k = 1, n_repeat
         cpu(k) = time_of(n_runs)/n_runs
      end do
      errors = abs(counts%onset(:n_reference) - reference)
      speeds = abs(counts%speed(:5)/reference_speed - 1.0_dp)
      write (output_unit, "(es9.1, i7, i10, i8, f10.2, f12.2, 3es11.2)") tolerance, &
         counts%steps, counts%rejected, counts%rhs, 1.0e6_dp*median(cpu), &
         1.0e9_dp*median(cpu)/counts%rhs, maxval(errors(:4)), maxval(errors), maxval(speeds)
   end do

contains

   !> CPU time of n runs [s].
   real(dp) function time_of(n) result(time)
      integer, intent(in) :: n  !! number of runs

      real(dp) :: start, finish
      integer :: run

      call cpu_time(start)
      do run = 1, n
         call simulate(t_end, tolerance, counts)
      end do
      call cpu_time(finish)
      time = max(finish - start, 1.0e-6_dp)
   end function time_of

   !> The middle one of an odd number of values.
   pure real(dp) function median(values) result(middle)
      real(dp), intent(in) :: values(:)  !! (any odd number) values [any]

      integer :: i

      middle = values(1)
      do i = 1, size(values)
         if (count(values < values(i)) > size(values)/2) cycle
         if (count(values <= values(i)) <= size(values)/2) cycle
         middle = values(i)
      end do
   end function median

end program minimal_slider_crank
