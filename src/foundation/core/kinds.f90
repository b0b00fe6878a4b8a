!> Kinds of numbers and the constants of arithmetic used everywhere.
module kinds
   use, intrinsic :: iso_fortran_env, only: int64, real64
   implicit none (type, external)
   private
   public :: eps, i8, min_tolerance, not_a_number, pi, two_pi, wp

   integer, parameter :: wp = real64  !! working precision: IEEE double
   integer, parameter :: i8 = int64   !! counters that may exceed two thousand million
   real(wp), parameter :: pi = 3.14159265358979323846_wp  !! half a turn [rad]
   real(wp), parameter :: two_pi = 2.0_wp*pi              !! one turn [rad]
   real(wp), parameter :: eps = epsilon(1.0_wp)           !! distance from 1 to the next number [1]
   real(wp), parameter :: min_tolerance = 1.0e-14_wp    !! less than this part of a number is its round-off [1]

contains

   !> A quiet NaN: the value of what was not computed. By its bits: a procedure that uses ieee_arithmetic itself saves and restores
   !> the flags of the processor, which takes longer than what it is called for in expressions.
   pure function not_a_number() result(x)
      real(wp) :: x  !! NaN [1]

      x = transfer(int(z"7FF8000000000000", i8), x)
   end function not_a_number

end module kinds
