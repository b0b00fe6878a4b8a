!> Normal forces that jump where a contact starts or ends: those of laws that have a force where the surfaces just meet.
module force_jumps
   use clearance_set, only: clearance_set_t
   use integrator, only: integrator_t
   use kinds, only: eps, wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: find_derivative_behind, law_jumps, time_to_see

contains

   !> Whether the normal law has a force where the surfaces just meet, as a dashpot has.
   pure logical function law_jumps(set, k, rate, impact_speed) result(jumps)
      class(clearance_set_t), intent(in) :: set   !! the set
      integer, intent(in) :: k                    !! contact of the set
      real(wp), intent(in) :: rate                !! penetration rate there [m/s]
      real(wp), intent(in) :: impact_speed        !! impact speed of the contact [m/s]

      real(wp), parameter :: depths(2) = [1.0e-30_wp, 1.0e-9_wp]  ! (2) hardly any penetration, and a small one [m]
      real(wp), parameter :: hardly = 1.0e-9_wp                   ! force at the former, of that at the latter [1]
      real(wp), dimension(2) :: by_delta, by_rate, elastic, f

      call set%laws%normal%force(2, depths, [rate, rate], [impact_speed, impact_speed], spread(set%laws%parameters(:, k), 2, 2), &
                                 f, &
                         by_delta, by_rate, elastic)
      jumps = f(1) > hardly*f(2)
   end function law_jumps

   !> Time after an onset at which the penetration is beyond round-off.
   pure real(wp) function time_to_see(system, method, delta, rate) result(time)
      type(mechanism_t), intent(in) :: system      !! the system
      class(integrator_t), intent(in) :: method        !! the integrator, at the onset
      real(wp), intent(in) :: delta                    !! penetration there [m]
      real(wp), intent(in) :: rate                     !! its rate [m/s]

      real(wp), parameter :: spacings = 16.0_wp        ! of a coordinate: round-off of a penetration [1]
      real(wp), parameter :: slowest = 1.0e-9_wp       ! rate of a penetration that is worth it [m/s]

      time = 0.0_wp
      if (rate < slowest) return
      time = (abs(delta) + spacings*eps*max(system%linkage%scales%length, &
                                            maxval(abs(method%step%y1(:system%n_position)), dim=1)))/rate
   end function time_to_see

   !> The derivative behind an onset at which a force jumps, f = 2 f(t + s) - f(t + 2 s), with s the time after which it is seen.
   !> The motion is left at t + s.
   subroutine find_derivative_behind(system, method, shift, y, ydot, status)
      type(mechanism_t), intent(inout) :: system         !! the system
      class(integrator_t), intent(inout) :: method       !! the integrator, started again; its derivative is set
      real(wp), intent(in) :: shift                      !! s [s]
      real(wp), intent(inout), contiguous :: y(:)        !! (n) scratch state [any]
      real(wp), intent(inout), contiguous :: ydot(:)     !! (n) scratch derivative [any]
      integer, intent(out) :: status                     !! 0, or the equations cannot be solved there

      method%count%n_evaluations = method%count%n_evaluations + 2
      y = method%step%y1 + shift*method%step%f1
      call system%evaluate(method%t + shift, y, ydot, status)
      if (status /= 0) return
      y = method%step%y1 + 2.0_wp*shift*method%step%f1
      method%step%f1 = ydot
      call system%evaluate(method%t + 2.0_wp*shift, y, ydot, status)
      if (status /= 0) return
      method%step%f1 = 2.0_wp*method%step%f1 - ydot
      y = method%step%y1 + shift*method%step%f1
      call system%linkage%set_state(method%t + shift, y, method%step%f1)
   end subroutine find_derivative_behind

end module force_jumps
