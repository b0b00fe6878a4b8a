!> A curve: a function of one number with exact first and second derivatives, evaluated without allocation.
!>
!> f(x) = p(x) + A sin(w x + phase) + sum_m h_m s_m((x - b_m)/l_m)
!>
!> with p piecewise polynomial: on [x_k, x_k+1] p = sum_i c_ik (x - x_k)^i, and laws s_m that rise from 0 to 1 (`rise_laws`).
!>
!> Beyond its first and last place p continues as it is, does not exist (NaN), holds its value, continues along its
!> tangent, or repeats itself. A curve that does not exist there forgives round-off of a place.
module curve
   use jets, only: jet_chain
   use kinds, only: not_a_number, wp
   use rise_laws, only: rise_values
   implicit none (type, external)
   private
   public :: beyond_error, beyond_stabilisation, beyond_linear, beyond_periodic, beyond_same
   public :: curve_t, curve_values, jet_of_curve, rise_t

   integer, parameter :: beyond_same = 0      !! beyond its places the first and the last piece continue
   integer, parameter :: beyond_error = 1     !! it does not exist there
   integer, parameter :: beyond_stabilisation = 2      !! the value of the end
   integer, parameter :: beyond_linear = 3    !! the tangent of the end
   integer, parameter :: beyond_periodic = 4  !! it repeats itself

   real(wp), parameter :: largest = 1.0e50_wp !! place at which it can be evaluated, as of numbers in decks [any]
   real(wp), parameter :: slack = 1.0e-9_wp   !! of the range, still taken as inside [1]

   !> A rise, or with a negative height a fall.
   type :: rise_t
      integer :: law = 1            !! number of its law
      real(wp) :: begin = 0.0_wp    !! where it starts [any]
      real(wp) :: length = 1.0_wp   !! how long it takes [any]
      real(wp) :: height = 0.0_wp   !! how high it rises [any]
   end type rise_t

   !> A curve; before it is made it is nowhere.
   type :: curve_t
      real(wp), allocatable :: x(:)           !! (n + 1) places, increasing; a single piece needs no end [any]
      real(wp), allocatable :: c(:, :)        !! (0:degree, n) coefficients about the first place of each piece [any]
      integer :: beyond = beyond_same         !! what it is beyond its places
      logical :: bends = .false.              !! whether the second derivative jumps at every place
      real(wp) :: amplitude = 0.0_wp          !! A [any]
      real(wp) :: angular_frequency = 0.0_wp  !! w [rad/any]
      real(wp) :: phase = 0.0_wp              !! at x = 0 [rad]
      type(rise_t), allocatable :: rises(:)   !! (any) rises between the places; unallocated: none
   end type curve_t

contains

   !> The curve of a jet.
   pure function jet_of_curve(curve, u) result(v)
      type(curve_t), intent(in) :: curve  !! the curve
      real(wp), intent(in) :: u(3)        !! (3) argument and derivatives [any]
      real(wp) :: v(3)                    !! (3) f(u(t)) and its derivatives [any]

      real(wp) :: f(3)

      f = not_a_number()
      if (abs(u(1)) <= largest) call curve_values(curve, u(1), f)
      v = jet_chain(u, f(1), f(2), f(3))
   end function jet_of_curve

   !> Value and derivatives at a place.
   pure subroutine curve_values(curve, x, f)
      type(curve_t), intent(in) :: curve  !! the curve
      real(wp), intent(in) :: x           !! the place [any]
      real(wp), intent(out) :: f(3)       !! (3) f, f', f'' [any]

      real(wp) :: angle, first, last, place, wave
      integer :: n

      n = size(curve%x)
      first = curve%x(1)
      last = curve%x(n)
      if (curve%beyond == beyond_same .or. (x >= first .and. x <= last)) then
         call values_at(curve, x, f)
      else if (curve%beyond == beyond_periodic) then
         call values_at(curve, first + modulo(x - first, last - first), f)
      else if (curve%beyond == beyond_error .and. abs(x - 0.5_wp*(first + last)) > (0.5_wp + slack)*(last - first)) then
         f = not_a_number()
      else
         place = merge(first, last, x < first)
         call values_at(curve, place, f)
         f(3) = 0.0_wp
         if (curve%beyond == beyond_stabilisation) f(2) = 0.0_wp
         f(1) = f(1) + f(2)*(x - place)
      end if
      if (.not. abs(curve%amplitude) > 0.0_wp) return
      angle = curve%angular_frequency*x + curve%phase
      wave = curve%amplitude*sin(angle)
      f(1) = f(1) + wave
      f(2) = f(2) + curve%amplitude*curve%angular_frequency*cos(angle)
      f(3) = f(3) - wave*curve%angular_frequency**2
   end subroutine curve_values

   !> Polynomial and rises at a place between the first and the last.
   pure subroutine values_at(curve, x, f)
      type(curve_t), intent(in) :: curve  !! the curve
      real(wp), intent(in) :: x           !! the place [any]
      real(wp), intent(out) :: f(3)       !! (3) f, f', f'' [any]

      integer :: m

      call segment_values(size(curve%x), curve%x, curve%c, x, f)
      if (.not. allocated(curve%rises)) return
      do m = 1, size(curve%rises)
         associate (rise => curve%rises(m))
            f = f + rise%height*rise_values(rise%law, (x - rise%begin)/rise%length)/rise%length**[0, 1, 2]
         end associate
      end do
   end subroutine values_at

   !> The polynomial of the piece that holds a place: the last one that starts before it, or the first.
   pure subroutine segment_values(n, place, c, x, f)
      integer, intent(in) :: n            !! number of places
      real(wp), intent(in) :: place(n)    !! (n) places [any]
      real(wp), intent(in) :: c(0:, :)    !! (0:degree, pieces) coefficients [any]
      real(wp), intent(in) :: x           !! where [any]
      real(wp), intent(out) :: f(3)       !! (3) p, p', p'' [any]

      real(wp) :: h
      integer :: high, i, low, middle

      low = 1
      high = size(c, 2) + 1
      do while (high - low > 1)
         middle = (low + high)/2
         if (x >= place(middle)) then
            low = middle
         else
            high = middle
         end if
      end do
      h = x - place(low)
      f = 0.0_wp
      do i = ubound(c, 1), 0, -1
         f(3) = f(3)*h + 2.0_wp*f(2)
         f(2) = f(2)*h + f(1)
         f(1) = f(1)*h + c(i, low)
      end do
   end subroutine segment_values

end module curve
