!> Closed forms of films against the integral of their own pressure, a solution of Reynolds' equation, and of its shear.
module test_film_pressure
   use check, only: check_close, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use film_case, only: components, film_case_t, make_film, motion_of, unit_bearing
   use film_law, only: film_motion_t
   use kinds, only: pi, wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_film_pressure

   real(wp), parameter :: ratios(5) = [0.05_wp, 0.2_wp, 0.5_wp, 0.8_wp, 0.95_wp]  !! eccentricities [1]
   real(wp), parameter :: squeezes(5) = [-1.0_wp, -0.1_wp, 0.0_wp, 0.1_wp, 1.0_wp]  !! their rates [1/s]
   real(wp), parameter :: spins(4) = [-2.0_wp, 0.0_wp, 0.5_wp, 2.0_wp]  !! Om [rad/s]

   integer, parameter :: all_round = 1     !! the film is everywhere
   integer, parameter :: first_half = 2    !! from 0 to pi
   integer, parameter :: where_positive = 3  !! where its pressure is not negative

   integer, parameter :: short = 1         !! pressure of a short bearing, in the middle, over 3 mu L^2/(4 c^2)
   integer, parameter :: long = 2          !! of a long one over 6 mu (R/c)^2, p(+90) + p(-90) = 0
   integer, parameter :: long_ends = 3     !! the same with p(0) = p(pi) = 0

contains

   subroutine run_test_film_pressure(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("reynolds_equation", test_reynolds_equation)
      call suite%test("short_full", test_short_full)
      call suite%test("short_half", test_short_half)
      call suite%test("short_positive", test_short_positive)
      call suite%test("long_full", test_long_full)
      call suite%test("long_half", test_long_half)
      call suite%test("long_positive", test_long_positive)
      call suite%test("squeezed", test_squeezed)
      call suite%test("shear", test_shear)
   end subroutine run_test_film_pressure

   !> Pressure at an angle from the widest gap.
   pure real(wp) function pressure(shape, eps, eps_dot, om, theta) result(p)
      integer, intent(in) :: shape               !! one of the above
      real(wp), intent(in) :: eps, eps_dot, om   !! state [1, 1/s, rad/s]
      real(wp), intent(in) :: theta              !! angle [rad]

      real(wp) :: h

      h = 1.0_wp + eps*cos(theta)
      select case (shape)
      case (short)
         p = (om*eps*sin(theta) - 2.0_wp*eps_dot*cos(theta))/h**3
      case default
         p = om*eps*sin(theta)*(2.0_wp + eps*cos(theta))/((2.0_wp + eps*eps)*h*h) + eps_dot/eps*(1.0_wp/h**2 - 1.0_wp)
      end select
      if (shape == long_ends) p = p + ends_gone(eps, eps_dot, theta)
   end function pressure

   !> What takes the pressure of a long bearing to zero at 0 and pi: a constant and a multiple of the integral of 1/h^3.
   pure real(wp) function ends_gone(eps, eps_dot, theta) result(p)
      real(wp), intent(in) :: eps, eps_dot   !! state [1, 1/s]
      real(wp), intent(in) :: theta          !! angle from 0 to pi [rad]

      real(wp) :: first, last

      first = eps_dot/eps*(1.0_wp/(1.0_wp + eps)**2 - 1.0_wp)
      last = eps_dot/eps*(1.0_wp/(1.0_wp - eps)**2 - 1.0_wp)
      p = -first - (last - first)*flow_integral(theta)/flow_integral(pi)

   contains

      !> Integral of 1/h^3 from 0, in Sommerfeld's variable; without a constant factor.
      pure real(wp) function flow_integral(angle) result(g)
         real(wp), intent(in) :: angle  !! upper end, 0 to pi [rad]

         real(wp) :: x

         x = atan2(sqrt(1.0_wp - eps*eps)*sin(angle), cos(angle) + eps)
         g = x - 2.0_wp*eps*sin(x) + eps*eps*(0.5_wp*x + 0.25_wp*sin(2.0_wp*x))
      end function flow_integral

   end function ends_gone

   !> d/dtheta (h^3 dp/dtheta) = -w sin(theta) + 2 eps' cos(theta) of the long ones, for p over 6 mu (R/c)^2, by differences; and
   !> their conditions at the ends.
   subroutine test_reynolds_equation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 2.0e-3_wp
      real(wp) :: flow(4), near(4), theta
      integer :: i, j, k, m, shape

      do shape = long, long_ends
         do i = 1, size(ratios)
            do j = 1, size(squeezes)
               do k = 1, size(spins)
                  theta = 0.3_wp + 0.1_wp*real(i + 5*j, wp)
                  do m = 1, 4
                     associate (at => theta + places(m)*step)
                        near = [pressure_at(at + places(1)*step), pressure_at(at + places(2)*step), &
                                pressure_at(at + places(3)*step), pressure_at(at + places(4)*step)]
                        flow(m) = (1.0_wp + ratios(i)*cos(at))**3*five_point(near, step)
                     end associate
                  end do
                  call check_close(error, five_point(flow, step), 2.0_wp*squeezes(j)*cos(theta) - spins(k)*ratios(i)*sin(theta), &
                                   1.0e-6_wp, "Reynolds' equation")
               end do
            end do
         end do
      end do
      associate (eps => 0.6_wp, eps_dot => 0.4_wp, om => 0.7_wp)
         call check_close(error, pressure(long, eps, eps_dot, om, 0.5_wp*pi), -pressure(long, eps, eps_dot, om, -0.5_wp*pi), &
                          1.0e-14_wp, "reference pressure")
         call check_close(error, [pressure(long_ends, eps, eps_dot, om, 0.0_wp), pressure(long_ends, eps, eps_dot, om, pi)], &
                          [0.0_wp, 0.0_wp], 1.0e-14_wp, "ends of the half film")
      end associate

   contains

      !> The pressure at an angle.
      real(wp) function pressure_at(angle) result(p)
         real(wp), intent(in) :: angle  !! the angle [rad]

         p = pressure(shape, ratios(i), squeezes(j), spins(k), angle)
      end function pressure_at

   end subroutine test_reynolds_equation

   !> Integral of the pressure with cosine and sine, by Gauss' formula in Sommerfeld's variable between the places where the film
   !> starts and ends.
   function force_of_pressure(shape, extent, eps, eps_dot, om) result(f)
      integer, intent(in) :: shape               !! of the pressure
      integer, intent(in) :: extent              !! of the film
      real(wp), intent(in) :: eps, eps_dot, om   !! state [1, 1/s, rad/s]
      real(wp) :: f(2)                           !! (2) along n and t [1/s]

      integer, parameter :: n_segment = 256
      real(wp) :: a, b, high, low
      integer :: k

      f = 0.0_wp
      do k = 1, merge(n_segment/2, n_segment, extent == first_half)
         a = 2.0_wp*pi*real(k - 1, wp)/n_segment
         b = 2.0_wp*pi*real(k, wp)/n_segment
         if (extent == where_positive) then
            low = in_variable(a)
            high = in_variable(b)
            if (low <= 0.0_wp .and. high <= 0.0_wp) cycle
            if (low < 0.0_wp) a = root_between(a, b)
            if (high < 0.0_wp) b = root_between(a, b)
         end if
         call add_segment(a, b)
      end do
      f = f*merge(0.5_wp, 6.0_wp, shape == short)

   contains

      !> The pressure at a value of the variable.
      real(wp) function in_variable(x) result(p)
         real(wp), intent(in) :: x  !! Sommerfeld's variable [rad]

         p = pressure(shape, eps, eps_dot, om, angle_of(x))
      end function in_variable

      !> The angle that belongs to it.
      real(wp) function angle_of(x) result(theta)
         real(wp), intent(in) :: x  !! Sommerfeld's variable [rad]

         theta = atan2(sqrt(1.0_wp - eps*eps)*sin(x), cos(x) - eps)
      end function angle_of

      !> Where the pressure changes its sign, by halving.
      real(wp) function root_between(x_1, x_2) result(x)
         real(wp), intent(in) :: x_1, x_2  !! ends, of different signs [rad]

         real(wp) :: ends(2)
         integer :: n

         ends = [x_1, x_2]
         do n = 1, 60
            x = 0.5_wp*(ends(1) + ends(2))
            if ((in_variable(x) > 0.0_wp) .eqv. (in_variable(ends(1)) > 0.0_wp)) then
               ends(1) = x
            else
               ends(2) = x
            end if
         end do
      end function root_between

      !> One piece, by three points.
      subroutine add_segment(x_1, x_2)
         real(wp), intent(in) :: x_1, x_2  !! its ends [rad]

         real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
         real(wp) :: theta, x
         integer :: m

         do m = 1, 3
            x = 0.5_wp*(x_1 + x_2 + (x_2 - x_1)*sqrt(0.6_wp)*real(m - 2, wp))
            theta = angle_of(x)
            f = f + weight(m)*(x_2 - x_1)*sqrt(1.0_wp - eps*eps)/(1.0_wp - eps*cos(x))*in_variable(x)*[cos(theta), sin(theta)]
         end do
      end subroutine add_segment

   end function force_of_pressure

   !> A film against its pressure, over eccentricity, squeeze and spin of both signs.
   subroutine compare(name, word, shape, extent, error)
      character(*), intent(in) :: name                    !! the film
      character(*), intent(in) :: word                    !! its form; blank: it has none
      integer, intent(in) :: shape                        !! of the pressure
      integer, intent(in) :: extent                       !! of the film
      type(error_t), allocatable, intent(inout) :: error  !! what failed

      type(film_case_t) :: case
      real(wp) :: f(2)
      integer :: i, j, k

      call make_film(name, merge("form", "    ", word /= ""), word, unit_bearing(), case)
      do i = 1, size(ratios)
         do j = 1, size(squeezes)
            do k = 1, size(spins)
               f = force_of_pressure(shape, extent, ratios(i), squeezes(j), spins(k))
               call check_close(error, components(case, ratios(i), squeezes(j), spins(k)), f, 1.0e-9_wp*(1.0_wp + norm2(f)), &
                                name//" at eps = "//to_text(ratios(i))//", eps' = "//to_text(squeezes(j))//", Om = "// &
                                to_text(spins(k)))
            end do
         end do
      end do
   end subroutine compare

   subroutine test_short_full(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("short_sommerfeld", "", short, all_round, error)
   end subroutine test_short_full

   subroutine test_short_half(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("short_gumbel", "book", short, first_half, error)
   end subroutine test_short_half

   subroutine test_short_positive(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("short_exact", "", short, where_positive, error)
   end subroutine test_short_positive

   subroutine test_long_full(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("long_sommerfeld", "", long, all_round, error)
   end subroutine test_long_full

   subroutine test_long_half(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("long_gumbel", "book", long_ends, first_half, error)
   end subroutine test_long_half

   subroutine test_long_positive(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare("long_exact", "", long, where_positive, error)
   end subroutine test_long_positive

   !> The squeeze film has the pressure of a long one without a wedge; the pressure of `full` counts with both signs.
   subroutine test_squeezed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: full, positive
      real(wp) :: f(2)
      integer :: i, j

      call make_film("squeeze", "pressure", "full", unit_bearing(), full)
      call make_film("squeeze", "pressure", "positive", unit_bearing(), positive)
      do i = 1, size(ratios)
         do j = 1, size(squeezes)
            f = force_of_pressure(long, all_round, ratios(i), squeezes(j), 0.0_wp)
            call check_close(error, components(full, ratios(i), squeezes(j), 1.7_wp), f, 1.0e-9_wp*(1.0_wp + norm2(f)), "full")
            f = force_of_pressure(long, where_positive, ratios(i), squeezes(j), 0.0_wp)
            call check_close(error, components(positive, ratios(i), squeezes(j), 1.7_wp), f, 1.0e-9_wp*(1.0_wp + norm2(f)), &
                             "positive")
         end do
      end do
   end subroutine test_squeezed

   !> Moments of a long film all round against the integral of the shear on both walls, drag and flow under pressure:
   !> -(w_J - w_B)/h -+ h/2 dp/dtheta, h^3 dp/dtheta = 6 (w cos(theta) + 2 eps' sin(theta)) + const.
   subroutine test_shear(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 4000
      type(film_case_t) :: case
      type(film_motion_t) :: motion
      real(wp) :: f(2), h, p_rate, shear(2), t_b, t_j, theta
      integer :: i, k

      call make_film("long_sommerfeld", " ", " ", unit_bearing(), case)
      do i = 1, 4
         associate (eps => ratios(i), eps_dot => squeezes(i), om => spins(i), spin => 1.3_wp - 0.7_wp*real(i, wp))
            motion = motion_of(case, eps, eps_dot, om, 0.0_wp)
            motion%speed_difference = spin
            f = components(case, eps, eps_dot, om)
            shear = 0.0_wp
            do k = 1, n
               theta = 2.0_wp*pi*real(k, wp)/n
               h = 1.0_wp + eps*cos(theta)
               p_rate = 6.0_wp*(om*(h - 2.0_wp*(1.0_wp - eps*eps)/(2.0_wp + eps*eps)) + 2.0_wp*eps_dot*sin(theta))/h**3
               shear = shear + 2.0_wp*pi/n*[-spin/h - 0.5_wp*h*p_rate, spin/h - 0.5_wp*h*p_rate]
            end do
            call case%law%torques(motion, case%parameters, f, t_j, t_b)
            call check_close(error, [t_j, t_b], shear, 1.0e-12_wp*(1.0_wp + norm2(shear)), "shear")
            call check_close(error, t_j + t_b + motion%e(1)*f(2) - motion%e(2)*f(1), 0.0_wp, 1.0e-12_wp*(1.0_wp + norm2(f)), &
                             "moments about one point")
         end associate
      end do
   end subroutine test_shear

end module test_film_pressure
