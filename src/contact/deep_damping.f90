!> Damping of contacts that are deeper than their impact speed could take them (`normal_law`).
module deep_damping
   use kinds, only: wp
   use normal_law, only: impact_speed_of_depth, n_law_parameter, parameter_gentle
   implicit none (type, external)
   private
   public :: damp_all_deep, damp_deep

contains

   !> Those of n contacts that are; the others stay as they are. A call of its own module, so that the usual ones do not save
   !> registers for it.
   pure subroutine damp_all_deep(hysteresis, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      real(wp), intent(in) :: hysteresis                     !! h [1]
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) stiffness first [N/m^1.5]
      real(wp), intent(inout) :: f(n)                        !! (n) normal force [N]
      real(wp), intent(inout) :: df_ddelta(n)                !! (n) its derivative by penetration [N/m]
      real(wp), intent(inout) :: df_drate(n)                 !! (n) its derivative by rate [N.s/m]
      real(wp), intent(in) :: f_elastic(n)                   !! (n) elastic part of the force [N]

      integer :: k

      do k = 1, n
         if (parameters(parameter_gentle, k)*f_elastic(k)*delta(k) < impact_speed(k)*impact_speed(k)) cycle
         call damp_deep(hysteresis, delta(k), rate(k), impact_speed(k), parameters(parameter_gentle, k), f_elastic(k), f(k), &
                        df_ddelta(k), df_drate(k))
      end do
   end subroutine damp_all_deep

   !> One contact that is deeper than its impact speed could take it; the elastic force alone where it is not deep at all.
   pure subroutine damp_deep(hysteresis, delta, rate, impact_speed, gently, f_elastic, f, df_ddelta, df_drate)
      real(wp), intent(in) :: hysteresis     !! h [1]
      real(wp), intent(in) :: delta          !! penetration [m]
      real(wp), intent(in) :: rate           !! penetration rate [m/s]
      real(wp), intent(in) :: impact_speed   !! rate at the onset [m/s]
      real(wp), intent(in) :: gently         !! parameter_gentle of the contact [1/kg]
      real(wp), intent(in) :: f_elastic      !! elastic force [N]
      real(wp), intent(out) :: f             !! normal force [N]
      real(wp), intent(inout) :: df_ddelta   !! derivative by penetration: of the elastic force, then of the normal force [N/m]
      real(wp), intent(out) :: df_drate      !! derivative of the normal force by rate [N.s/m]

      real(wp) :: dspeed, slope, speed

      f = f_elastic
      df_drate = 0.0_wp
      call impact_speed_of_depth(delta, f_elastic, df_ddelta, impact_speed, gently, speed, dspeed)
      if (.not. speed > 0.0_wp) return
      slope = hysteresis/speed
      f = f_elastic*(1.0_wp + slope*rate)
      df_ddelta = df_ddelta*(1.0_wp + slope*rate) - f_elastic*slope*rate*dspeed/speed
      df_drate = f_elastic*slope
      if (f < 0.0_wp) then
         f = 0.0_wp
         df_ddelta = 0.0_wp
         df_drate = 0.0_wp
      end if
   end subroutine damp_deep

end module deep_damping
