!> Damping of contacts that are deeper than their impact speed could take them.
!>
!> There v0 gives way to the speed s of the depth (`normal_law`), and the factor 1 + x, x = h rate/s, to one that never cuts the
!> force off while the surfaces still overlap: what they store would all be lost at once, in a motion that feels no force any more.
!>
!> F_N = F_elastic [ (1 - w)(1 + x) + w ( x + sqrt(1 + x^2) ) ],   w = (1 - v0^2/u)^3,   u = gentle^2 v_d^2 > v0^2
!>
!> w joins the usual factor twice smoothly at u = v0^2, and is 1 for v0 = 0; where w < 1 the force is cut off at zero.
!>
!> Source: the usual factor is that of Flores et al. (2008), section 3.2; the other one is gudgeon's own. Limits: it shows no
!> restitution of its own, a contact that is pressed in and let go has none.
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

      real(wp), parameter :: nothing = sqrt(tiny(1.0_wp))  ! u of no depth, where x^2 would overflow [m^2/s^2]
      real(wp) :: dspeed, factor, r, root, slope, speed, u, usual, w, w_slope, x

      f = f_elastic
      df_drate = 0.0_wp
      u = gently*f_elastic*delta
      call impact_speed_of_depth(delta, f_elastic, df_ddelta, impact_speed, gently, speed, dspeed)
      if (.not. u > nothing) return
      slope = hysteresis/speed
      x = slope*rate
      r = min(impact_speed**2/u, 1.0_wp)
      w = (1.0_wp - r)**3
      w_slope = 3.0_wp*(1.0_wp - r)**2*r*gently*(df_ddelta*delta + f_elastic)/u  ! of w, by the penetration
      usual = r*(3.0_wp - r*(3.0_wp - r))                                        ! 1 - w
      root = sqrt(1.0_wp + x*x)
      factor = x + root
      if (x < 0.0_wp) factor = 1.0_wp/(root - x)
      f = f_elastic*(usual*(1.0_wp + x) + w*factor)
      df_drate = f_elastic*slope*(usual + w*factor/root)
      df_ddelta = df_ddelta*(usual*(1.0_wp + x) + w*factor) - df_drate*rate*dspeed/speed &
                  + f_elastic*w_slope*(factor - 1.0_wp - x)
      if (f < 0.0_wp) then
         f = 0.0_wp
         df_ddelta = 0.0_wp
         df_drate = 0.0_wp
      end if
   end subroutine damp_deep

end module deep_damping
