!> Points of a Sobol' sequence with random scrambling: they fill the cube more evenly than random ones, and each is uniform in it.
!>
!> Point i has in each dimension the number of 32 bits
!> $$ x = s \oplus \bigoplus_{b: i_b = 1} L v_b , \quad v_b = m_b 2^{32-b}, \quad
!>    m_b = 2^d m_{b-d} \oplus m_{b-d} \oplus \bigoplus_{j=1}^{d-1} 2^j a_j m_{b-j} , $$
!> i_b the bits of i, a_j those of a primitive polynomial of degree d over two elements, m_1 to m_d odd. L is a random lower
!> triangular matrix of bits with ones on its diagonal and s a random word, both by counter: they follow from the seed and the
!> dimension alone, so that any order and any number of processes give the same bits.
!> Sources: I. M. Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86-112; S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008)
!> 2635-2654 (polynomials and m_1 to m_d); J. Matousek, J. Complexity 14 (1998) 527-556 (scrambling).
!> Limits: 53 dimensions; 2^32 points.
module sobol_points
   use counter_random, only: threefry
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: most_dimensions, sobol_t

   integer, parameter :: most_dimensions = 53   !! of a point
   integer, parameter :: n_bit = 32             !! of a number

   !> For the dimensions from the second on: the polynomial, its bits from the highest power to the lowest, and m_1 to m_d.
   integer, parameter :: table(*) = [ &
      3, 1, 7, 1, 3, 11, 1, 3, 1, 13, 1, 1, 1, 19, 1, 1, 3, 3, 25, 1, 3, 5, 13, 37, 1, 1, 5, 5, 17, 41, 1, 1, 5, 5, 5, 47, &
      1, 1, 7, 11, 19, 55, 1, 1, 5, 1, 1, 59, 1, 1, 1, 3, 11, 61, 1, 3, 5, 5, 31, 67, 1, 3, 3, 9, 7, 49, 91, 1, 1, 1, 15, &
      21, 21, 97, 1, 3, 1, 13, 27, 49, 103, 1, 1, 1, 15, 7, 5, 109, 1, 3, 1, 15, 13, 25, 115, 1, 1, 5, 5, 19, 61, 131, 1, 3, &
      7, 11, 23, 15, 103, 137, 1, 3, 7, 13, 13, 15, 69, 143, 1, 1, 3, 13, 7, 35, 63, 145, 1, 3, 5, 9, 1, 25, 53, 157, 1, 3, &
      1, 13, 9, 35, 107, 167, 1, 3, 1, 5, 27, 61, 31, 171, 1, 1, 5, 11, 19, 41, 61, 185, 1, 3, 5, 3, 3, 13, 69, 191, 1, 1, &
      7, 13, 1, 19, 1, 193, 1, 3, 7, 5, 13, 19, 59, 203, 1, 1, 3, 9, 25, 29, 41, 211, 1, 3, 5, 13, 23, 1, 55, 213, 1, 3, 7, &
      3, 13, 59, 17, 229, 1, 3, 1, 3, 5, 53, 69, 239, 1, 1, 5, 5, 23, 33, 13, 241, 1, 1, 7, 7, 1, 61, 123, 247, 1, 1, 7, 9, &
      13, 61, 49, 253, 1, 3, 3, 5, 3, 55, 33, 285, 1, 3, 1, 15, 31, 13, 49, 245, 299, 1, 3, 5, 15, 31, 59, 63, 97, 301, 1, &
      3, 1, 11, 11, 11, 77, 249, 333, 1, 3, 1, 11, 27, 43, 71, 9, 351, 1, 1, 7, 15, 21, 11, 81, 45, 355, 1, 3, 7, 3, 25, 31, &
      65, 79, 357, 1, 3, 1, 1, 19, 11, 3, 205, 361, 1, 1, 5, 9, 19, 21, 29, 157, 369, 1, 3, 7, 11, 1, 33, 89, 185, 391, 1, &
      3, 3, 3, 15, 9, 79, 71, 397, 1, 3, 7, 11, 15, 39, 119, 27, 425, 1, 1, 3, 1, 11, 31, 97, 225, 451, 1, 1, 1, 3, 23, 43, &
      57, 177, 463, 1, 3, 7, 7, 17, 17, 37, 71, 487, 1, 3, 1, 5, 27, 63, 123, 213, 501, 1, 1, 3, 5, 11, 43, 53, 133]

   !> The sequence.
   type :: sobol_t
      integer(i8), allocatable :: directions(:, :)   !! (n_bit, dimensions) scrambled: L v_b, words of 32 bits
      integer(i8), allocatable :: shifts(:)          !! (dimensions) s, words of 32 bits
   contains
      procedure :: begin
      procedure :: point
   end type sobol_t

contains

   !> The directions of a seed.
   pure subroutine begin(self, n, seed, stream)
      class(sobol_t), intent(inout) :: self   !! the sequence
      integer, intent(in) :: n                !! dimensions, up to `most_dimensions`
      integer, intent(in) :: seed             !! of all random numbers, not negative
      integer, intent(in) :: stream           !! what they are for, not negative

      integer(i8) :: bits(2), plain(n_bit)
      integer :: at, b, k, row

      if (allocated(self%directions)) deallocate (self%directions, self%shifts)
      allocate (self%directions(n_bit, n), self%shifts(n), source=0_i8)
      at = 1
      do k = 1, n
         call find_directions(k, at, plain)
         do row = 1, n_bit   ! of L, the first one makes the highest bit of x
            bits = threefry([int(seed, i8), int(stream, i8)], [int(row, i8), int(k, i8)])
            bits(1) = ior(ishft(ishft(bits(1), -(n_bit - row + 1)), n_bit - row + 1), ishft(1_i8, n_bit - row))
            do b = 1, n_bit
               if (poppar(iand(bits(1), plain(b))) == 1) self%directions(b, k) = ibset(self%directions(b, k), n_bit - row)
            end do
         end do
         bits = threefry([int(seed, i8), int(stream, i8)], [0_i8, int(k, i8)])
         self%shifts(k) = bits(1)
      end do
   end subroutine begin

   !> The directions of a dimension without scrambling.
   pure subroutine find_directions(dimension, at, v)
      integer, intent(in) :: dimension         !! its number
      integer, intent(inout) :: at             !! its place in the table; then that of the next one
      integer(i8), intent(out) :: v(:)         !! (n_bit) words of 32 bits

      integer(i8) :: m
      integer :: b, degree, j

      if (dimension == 1) then
         v = [(ishft(1_i8, n_bit - b), b=1, n_bit)]
         return
      end if
      degree = bit_size(table(at)) - leadz(table(at)) - 1
      do b = 1, n_bit
         if (b <= degree) then
            v(b) = ishft(int(table(at + b), i8), n_bit - b)
         else
            m = ieor(v(b - degree), ishft(v(b - degree), -degree))
            do j = 1, degree - 1
               if (btest(table(at), degree - j)) m = ieor(m, v(b - j))
            end do
            v(b) = m
         end if
      end do
      at = at + degree + 1
   end subroutine find_directions

   !> A point.
   pure subroutine point(self, i, u)
      class(sobol_t), intent(in) :: self   !! the sequence
      integer(i8), intent(in) :: i         !! its number, from 0 to 2^32 - 1
      real(wp), intent(out) :: u(:)        !! (dimensions) between 0 and 1, both excluded [1]

      integer(i8) :: rest, x(size(u))
      integer :: b

      x = self%shifts
      rest = i
      b = 1
      do while (rest > 0_i8)
         if (btest(rest, 0)) x = ieor(x, self%directions(b, :))
         rest = ishft(rest, -1)
         b = b + 1
      end do
      u = (real(x, wp) + 0.5_wp)/4294967296.0_wp   ! 2^32
   end subroutine point

end module sobol_points
