!> Numbers that look random and are the same on every machine.
!>
!> Source: S. K. Park and K. W. Miller, Random number generators: good ones are hard to find,
!> Comm. ACM 31 (1988) 1192-1201, with the multiplier 48271.
module fixed_random
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: random_t, seed_of

   integer(i8), parameter :: modulus = 2147483647_i8  !! a prime
   integer(i8), parameter :: multiplier = 48271_i8    !! a primitive root of it

   !> A sequence; the seed may be anything from 1 to 2147483646.
   type :: random_t
      integer(i8) :: state = 1_i8  !! last number drawn
   contains
      procedure :: between
      procedure :: vector
   end type random_t

contains

   !> A seed that follows from a name and a number: what a test draws for a kind does not change when another kind is registered.
   pure integer(i8) function seed_of(name, number) result(seed)
      character(*), intent(in) :: name  !! of the kind, or of several
      integer, intent(in) :: number     !! of the draw, from 0 on

      integer(i8), parameter :: base = 257_i8  !! more than there are characters
      integer :: k

      seed = int(number, i8) + 1_i8
      do k = 1, len(name)
         seed = modulo(seed*base + int(iachar(name(k:k)), i8), modulus)
      end do
      seed = max(seed, 1_i8)
   end function seed_of

   !> The next number, evenly distributed.
   function between(self, low, high) result(x)
      class(random_t), intent(inout) :: self  !! the sequence
      real(wp), intent(in) :: low             !! minimum value [any]
      real(wp), intent(in) :: high            !! maximum value [any]
      real(wp) :: x                           !! the number [any]

      self%state = modulo(self%state*multiplier, modulus)
      x = low + (high - low)*real(self%state, wp)/real(modulus, wp)
   end function between

   !> The next n numbers.
   function vector(self, n, low, high) result(x)
      class(random_t), intent(inout) :: self  !! the sequence
      integer, intent(in) :: n                !! how many
      real(wp), intent(in) :: low             !! minimum value [any]
      real(wp), intent(in) :: high            !! maximum value [any]
      real(wp) :: x(n)                        !! (n) the numbers [any]

      integer :: k

      do k = 1, n
         x(k) = self%between(low, high)
      end do
   end function vector

end module fixed_random
