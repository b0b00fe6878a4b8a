!> Random numbers by counter: a number follows from a key and a counter alone, whatever was drawn before, so that any order and any
!> number of processes give the same bits.
!>
!> Threefry 2x32 with 20 rounds: three-fish with two words of 32 bits, each held in an integer of 64 bits, so that no sum
!> overflows. It passes the tests of BigCrush.
!> Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11 (2011).
module counter_random
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: random_order, threefry, uniform_at

   integer(i8), parameter :: word = 4294967295_i8         !! 2^32 - 1: the bits of a word
   integer(i8), parameter :: parity = 466688986_i8        !! 0x1BD11BDA, of the schedule of the keys
   integer, parameter :: rotations(4, 2) = reshape([13, 15, 26, 6, 17, 29, 16, 24], [4, 2])  !! bits by which a word is rotated
   integer, parameter :: groups = 5                       !! of four rounds, each with a key behind it

contains

   !> Two random words of a key and a counter.
   pure function threefry(key, counter) result(x)
      integer(i8), intent(in) :: key(2)      !! (2) words from 0 to 2^32 - 1
      integer(i8), intent(in) :: counter(2)  !! (2) words from 0 to 2^32 - 1
      integer(i8) :: x(2)                    !! (2) random words

      integer(i8) :: keys(0:2)
      integer :: group, k, r

      keys = [key(1), key(2), ieor(ieor(parity, key(1)), key(2))]
      x = iand(counter + keys(0:1), word)
      do group = 1, groups
         do k = 1, 4
            r = rotations(k, 1 + mod(group + 1, 2))
            x(1) = iand(x(1) + x(2), word)
            x(2) = ieor(ior(iand(ishft(x(2), r), word), ishft(x(2), r - 32)), x(1))
         end do
         x(1) = iand(x(1) + keys(mod(group, 3)), word)
         x(2) = iand(x(2) + keys(mod(group + 1, 3)) + int(group, i8), word)
      end do
   end function threefry

   !> A number between 0 and 1, both excluded, of 52 bits.
   pure real(wp) function uniform_at(seed, stream, number, index) result(u)
      integer, intent(in) :: seed        !! of all numbers, not negative
      integer, intent(in) :: stream      !! what the numbers are for, not negative
      integer(i8), intent(in) :: number  !! of the member, from 0 to 2^32 - 1
      integer, intent(in) :: index       !! of the number in it, not negative

      integer(i8) :: x(2)

      x = threefry([int(seed, i8), int(stream, i8)], [number, int(index, i8)])
      u = (real(ishft(x(1), -6), wp)*67108864.0_wp + real(ishft(x(2), -6), wp) + 0.5_wp)/4503599627370496.0_wp  ! 2^26, 2^52
   end function uniform_at

   !> A random order of numbers from 1 to n: those of a column of a Latin hypercube (Fisher and Yates).
   subroutine random_order(seed, stream, index, order)
      integer, intent(in) :: seed        !! of all numbers, not negative
      integer, intent(in) :: stream      !! what the numbers are for, not negative
      integer, intent(in) :: index       !! of the column, not negative
      integer, intent(out) :: order(:)   !! (n) the order

      integer :: j, k, kept

      order = [(k, k=1, size(order))]
      do k = size(order), 2, -1
         j = 1 + int(uniform_at(seed, stream, int(k, i8), index)*k)
         kept = order(j)
         order(j) = order(k)
         order(k) = kept
      end do
   end subroutine random_order

end module counter_random
