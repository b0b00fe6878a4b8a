!> How something rises from 0 to 1 while u goes from 0 to 1: laws of steps and of cams.
!>
!> | law | s(u) | continuous |
!> |---|---|---|
!> | cubic | 3 u^2 - 2 u^3 | velocity |
!> | haversine | (1 - cos(pi u))/2 | velocity |
!> | 3-4-5 polynomial, quintic | 10 u^3 - 15 u^4 + 6 u^5 | acceleration |
!> | 4-5-6-7 polynomial | 35 u^4 - 84 u^5 + 70 u^6 - 20 u^7 | jerk |
!> | cycloidal | u - sin(2 pi u)/(2 pi) | acceleration |
!> | modified sine | below | acceleration |
!>
!> Before u = 0 it is 0, from u = 1 on it is 1. Modified sine, in units of 1/(4 + pi): pi u - sin(4 pi u)/4 up to u = 1/8,
!> 2 + pi u - 9/4 sin((pi + 4 pi u)/3) up to 7/8, then 4 + pi u - sin(4 pi u)/4.
!>
!> Every law rises all the way and is symmetric, s(1 - u) = 1 - s(u); its speed is largest in the middle, and its acceleration
!> has one extremum in each half. The bounds use that and nothing else.
!>
!> Source: R. L. Norton, Cam design and manufacturing handbook (2002), chapters 3 and 4. Limits: none.
module rise_laws
   use intervals, only: hull, widened
   use kinds, only: eps, pi, two_pi, wp
   implicit none (type, external)
   private
   public :: bound_rise, breaks_of, is_smooth_rise, jet_of_rise, number_of_rise, rise_names, rise_values

   integer, parameter :: cubic = 1          !! velocity without jumps
   integer, parameter :: quintic = 2        !! acceleration without jumps
   integer, parameter :: haversine = 3      !! velocity without jumps
   integer, parameter :: cycloidal = 4      !! acceleration without jumps
   integer, parameter :: poly_345 = 5       !! the quintic by its name among cams
   integer, parameter :: poly_4567 = 6      !! jerk without jumps
   integer, parameter :: modified_sine = 7  !! acceleration without jumps
   integer, parameter :: n_rise = 7         !! laws

   !> Names, as in expressions.
   character(*), parameter :: rise_names(n_rise) = [character(13) :: "step3", "step5", "haversine", "cycloidal", "poly345", &
      "poly4567", "modified_sine"]

contains

   !> Number of a law by its name, 0 if there is none.
   pure integer function number_of_rise(name) result(law)
      character(*), intent(in) :: name   !! as in expressions

      do law = n_rise, 1, -1
         if (rise_names(law) == name) return
      end do
   end function number_of_rise

   !> Whether the acceleration of a law has no jumps.
   elemental logical function is_smooth_rise(law) result(is_smooth)
      integer, intent(in) :: law   !! number of the law

      is_smooth = law /= cubic .and. law /= haversine
   end function is_smooth_rise

   !> Places at which the formula of a law changes, in order.
   pure function breaks_of(law) result(breaks)
      integer, intent(in) :: law             !! number of the law
      real(wp), allocatable :: breaks(:)     !! (2 or 4) places u [1]

      breaks = [0.0_wp, 1.0_wp]
      if (law == modified_sine) breaks = [0.0_wp, 0.125_wp, 0.875_wp, 1.0_wp]
   end function breaks_of

   !> s, s' and s'' of a law at a place.
   pure function rise_values(law, u) result(s)
      integer, intent(in) :: law     !! number of the law
      real(wp), intent(in) :: u      !! the place [1]
      real(wp) :: s(3)               !! (3) value and derivatives by u [1]

      real(wp) :: angle

      if (u < 0.0_wp .or. .not. u < 1.0_wp) then
         s = [merge(0.0_wp, 1.0_wp, u < 0.0_wp), 0.0_wp, 0.0_wp]
         return
      end if
      select case (law)
      case (cubic)
         s = [u*u*(3.0_wp - 2.0_wp*u), 6.0_wp*u*(1.0_wp - u), 6.0_wp - 12.0_wp*u]
      case (quintic, poly_345)
         s = [u**3*(10.0_wp + u*(-15.0_wp + 6.0_wp*u)), 30.0_wp*(u*(1.0_wp - u))**2, &
              60.0_wp*u*(1.0_wp - u)*(1.0_wp - 2.0_wp*u)]
      case (haversine)
         s = [0.5_wp*(1.0_wp - cos(pi*u)), 0.5_wp*pi*sin(pi*u), 0.5_wp*pi**2*cos(pi*u)]
      case (cycloidal)
         angle = two_pi*u
         s = [u - sin(angle)/two_pi, 1.0_wp - cos(angle), two_pi*sin(angle)]
      case (poly_4567)
         s = [u**4*(35.0_wp + u*(-84.0_wp + u*(70.0_wp - 20.0_wp*u))), 140.0_wp*(u*(1.0_wp - u))**3, &
              420.0_wp*(u*(1.0_wp - u))**2*(1.0_wp - 2.0_wp*u)]
      case default
         if (u < 0.125_wp .or. .not. u < 0.875_wp) then
            angle = 2.0_wp*two_pi*u
            s = [merge(0.0_wp, 4.0_wp, u < 0.125_wp) + pi*u - 0.25_wp*sin(angle), pi - pi*cos(angle), 4.0_wp*pi**2*sin(angle)]
         else
            angle = (pi + 4.0_wp*pi*u)/3.0_wp
            s = [2.0_wp + pi*u - 2.25_wp*sin(angle), pi - 3.0_wp*pi*cos(angle), 4.0_wp*pi**2*sin(angle)]
         end if
         s = s/(4.0_wp + pi)
      end select
   end function rise_values

   !> The same of a place that moves.
   pure function jet_of_rise(law, u) result(v)
      integer, intent(in) :: law     !! number of the law
      real(wp), intent(in) :: u(3)   !! (3) place and derivatives [any]
      real(wp) :: v(3)               !! (3) s(u(t)) and its derivatives [any]

      real(wp) :: s(3)

      s = rise_values(law, u(1))
      if (u(1) < 0.0_wp .or. .not. u(1) < 1.0_wp) then
         v = [s(1), 0.0_wp, 0.0_wp]
      else
         v = [s(1), s(2)*u(2), s(3)*u(2)**2 + s(2)*u(3)]
      end if
   end function jet_of_rise

   !> Bounds of s, s' and s'' over an interval.
   pure function bound_rise(law, u) result(f)
      integer, intent(in) :: law     !! number of the law
      real(wp), intent(in) :: u(2)   !! (2) the interval [1]
      real(wp) :: f(2, 3)            !! (2, 3) bounds [1]

      real(wp), parameter :: last = nearest(1.0_wp, -1.0_wp)   ! the last place before the end [1]
      real(wp) :: places(7), s(3)
      integer :: i, k

      places = [u(1), u(2), 0.0_wp, max_of(law), 0.5_wp, 1.0_wp - max_of(law), last]
      f(:, 1) = [1.0_wp, 0.0_wp]
      f(:, 2) = f(:, 1)
      f(:, 3) = f(:, 1)
      do k = 1, size(places)
         if (places(k) < u(1) .or. places(k) > u(2)) cycle
         s = rise_values(law, places(k))
         do i = 1, 3
            if (f(1, i) > f(2, i)) then
               f(:, i) = s(i)
            else
               f(:, i) = hull(f(:, i), [s(i), s(i)])
            end if
         end do
      end do
      if (u(2) < 0.0_wp .or. .not. u(1) < 1.0_wp) return
      do i = 1, 3  ! round-off of a law is that of numbers of the order of one
         f(:, i) = widened(f(:, i) + [-32.0_wp, 32.0_wp]*eps)
      end do
   end function bound_rise

   !> Place in the first half where the acceleration of a law has its extremum; 0: at its start.
   pure real(wp) function max_of(law) result(u)
      integer, intent(in) :: law   !! number of the law

      select case (law)
      case (quintic, poly_345)
         u = 0.5_wp - sqrt(3.0_wp)/6.0_wp
      case (cycloidal)
         u = 0.25_wp
      case (poly_4567)
         u = 0.5_wp - 0.5_wp/sqrt(5.0_wp)
      case (modified_sine)
         u = 0.125_wp
      case default
         u = 0.0_wp
      end select
   end function max_of

end module rise_laws
