!> The spread of a life by the uncertainty of the wear coefficients.
!>
!> With all coefficients times f the profiles after N cycles are those after f N cycles: nothing else depends on them. A coefficient
!> within k/s and k s makes measures within those after N/s and N s cycles, and a life within N/s and N s. Where joints have laws of
!> different spread each joint takes its own; what the wear of one does to that of another is not followed.
!> Limits: with running-in the coefficient depends on the distance too, and the rule is an estimate.
module life_spread
   use kinds, only: not_a_number, wp
   use life_results, only: life_t
   use life_state, only: n_measure
   implicit none (type, external)
   private
   public :: measures_at, spread_of_measures

contains

   !> Measures after some cycles; NaN beyond the last node.
   function measures_at(life, cycles) result(values)
      type(life_t), intent(in) :: life                          !! the life
      real(wp), intent(in) :: cycles                            !! number of cycles [1]
      real(wp) :: values(n_measure, size(life%state%surfaces))  !! (measures, surfaces) [m, m^3, rad]

      real(wp), allocatable :: x(:)
      real(wp) :: part
      integer :: k

      values = not_a_number()
      if (cycles > life%nodes(life%n)%cycles*(1.0_wp + 1.0e-9_wp)) return
      k = count(life%nodes(:life%n)%cycles <= cycles)
      associate (node => life%nodes(k))
         part = cycles - node%cycles
         x = node%x
         if (node%jump > 0.0_wp) x = x + part*node%rates(:, 1) + &
                                     (0.5_wp*part**2/node%jump)*(node%rates(:, 2) - node%rates(:, 1))
         values = life%state%measures(x)
      end associate
   end function measures_at

   !> Lower and upper end of the measures of a node by the uncertainty of the coefficients.
   subroutine spread_of_measures(life, k, low, high)
      type(life_t), intent(in) :: life                             !! the life
      integer, intent(in) :: k                                     !! number of the node
      real(wp), allocatable, intent(out) :: low(:, :)              !! (measures, surfaces) [m, m^3, rad]
      real(wp), allocatable, intent(out) :: high(:, :)             !! (measures, surfaces) NaN: not followed so far [m, m^3, rad]

      real(wp) :: values(n_measure, size(life%state%surfaces))
      integer :: s

      low = life%nodes(k)%measures
      high = low
      do s = 1, size(low, 2)
         associate (factor => life%plan%spreads(s))
            if (.not. factor > 1.0_wp) cycle
            values = measures_at(life, life%nodes(k)%cycles/factor)
            low(:, s) = values(:, s)
            values = measures_at(life, life%nodes(k)%cycles*factor)
            high(:, s) = values(:, s)
         end associate
      end do
   end subroutine spread_of_measures

end module life_spread
