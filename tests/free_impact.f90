!> The impact of two free bodies, integrated with many small steps: nothing of the program but the law is used.
module free_impact
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   implicit none (type, external)
   private
   public :: impact_t, run_impact

   integer, parameter :: n_step = 20000  !! steps in the duration of an elastic impact

   !> How an impact went.
   type :: impact_t
      real(wp) :: duration = 0.0_wp      !! from onset to end [s]
      real(wp) :: end_rate = 0.0_wp      !! penetration rate at the end, negative [m/s]
      real(wp) :: peak_delta = 0.0_wp    !! maximum penetration at a step [m]
      real(wp) :: peak_force = 0.0_wp    !! maximum force at a step [N]
      real(wp) :: lost = 0.0_wp          !! energy that damping took [J]
   end type impact_t

contains

   !> m delta'' = -F(delta, delta') from delta = 0, delta' = speed, to delta = 0 again.
   subroutine run_impact(law, parameters, mass, speed, impact)
      class(normal_law_t), intent(in) :: law   !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) of the law, fitted to the surfaces [any]
      real(wp), intent(in) :: mass             !! reduced mass [kg]
      real(wp), intent(in) :: speed            !! approach speed [m/s]
      type(impact_t), intent(out) :: impact    !! how it went

      real(wp) :: after(3), h, high, low, y(3)
      integer :: k

      h = law%contact_time(parameters, speed, 1.0_wp/mass)/real(n_step, wp)
      y = [0.0_wp, speed, 0.0_wp]
      do k = 1, 40*n_step
         after = runge_kutta(y, h)
         if (after(1) <= 0.0_wp) exit
         y = after
         impact%duration = impact%duration + h
         impact%peak_delta = max(impact%peak_delta, y(1))
         impact%peak_force = max(impact%peak_force, mass*abs(slope_2(y)))
      end do
      ! the last step ends where the penetration does
      low = 0.0_wp
      high = h
      do k = 1, 100
         after = runge_kutta(y, 0.5_wp*(low + high))
         if (after(1) > 0.0_wp) then
            low = 0.5_wp*(low + high)
         else
            high = 0.5_wp*(low + high)
         end if
      end do
      impact%duration = impact%duration + low
      impact%end_rate = after(2)
      impact%lost = after(3)

   contains

      !> One step of the classical method.
      function runge_kutta(y, h) result(after)
         real(wp), intent(in) :: y(3)  !! (3) penetration, rate, energy lost [m, m/s, J]
         real(wp), intent(in) :: h     !! step [s]
         real(wp) :: after(3)          !! (3) the same at its end [m, m/s, J]

         real(wp) :: k_1(3), k_2(3), k_3(3), k_4(3)

         k_1 = slope(y)
         k_2 = slope(y + 0.5_wp*h*k_1)
         k_3 = slope(y + 0.5_wp*h*k_2)
         k_4 = slope(y + h*k_3)
         after = y + h/6.0_wp*(k_1 + 2.0_wp*(k_2 + k_3) + k_4)
      end function runge_kutta

      !> Derivatives.
      function slope(y) result(rate)
         real(wp), intent(in) :: y(3)  !! (3) penetration, rate, energy lost [m, m/s, J]
         real(wp) :: rate(3)           !! (3) their rates [m/s, m/s^2, W]

         real(wp) :: elastic(1), f(1), unused(1), unused_too(1)

         call law%force(1, y(1:1), y(2:2), [speed], parameters, f, unused, unused_too, elastic)
         rate = [y(2), -f(1)/mass, (f(1) - elastic(1))*y(2)]
      end function slope

      !> Acceleration.
      function slope_2(y) result(acceleration)
         real(wp), intent(in) :: y(3)  !! (3) penetration, rate, energy lost [m, m/s, J]
         real(wp) :: acceleration      !! second derivative of the penetration [m/s^2]

         real(wp) :: rate(3)

         rate = slope(y)
         acceleration = rate(2)
      end function slope_2

   end subroutine run_impact

end module free_impact
