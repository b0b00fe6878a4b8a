!> Laws asked for contacts: a normal law whose force jumps where the penetration turns, and friction without a memory.
!>
!> A law whose force jumps from F_a to F_p where the penetration turns follows the course of the contact, which changes at located
!> events only; one that rests has (F_a + F_p)/2 + (F_a - F_p)/2 rate/rest_speed (`turn_monitor`).
!> Signs: penetration > 0 in contact, rate > 0 approaching, force > 0 pushes the bodies apart; friction is that on j along t.
!> Source and limits: those of the laws.
module contact_laws
   use contact_memory, only: contact_memory_t, rests
   use friction_law, only: friction_law_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: point_contact_t
   implicit none (type, external)
   private
   public :: press_in_course, friction_by_law

contains

   !> Normal forces of some contacts, by a law whose force jumps where the penetration turns.
   pure subroutine press_in_course(n, law, memory, parameters, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      integer, intent(in) :: n                                !! number of contacts
      class(normal_law_t), intent(in) :: law                  !! the law
      type(contact_memory_t), intent(in) :: memory(n)         !! (n) states
      real(wp), intent(in) :: parameters(n_law_parameter, n)  !! (n_law_parameter, n) of the law, fitted to them [any]
      real(wp), intent(in) :: delta(n)                        !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                         !! (n) its rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                 !! (n) impact speed [m/s]
      real(wp), intent(out) :: f(n)                           !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                   !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                    !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                   !! (n) its elastic part [N]

      real(wp), dimension(1) :: parting, parting_ddelta, parting_drate
      real(wp) :: speed, weight
      integer :: k

      do k = 1, n
         speed = max(abs(rate(k)), tiny(1.0_wp))
         call law%force(1, delta(k:k), [-speed], impact_speed(k:k), parameters(:, k:k), parting, parting_ddelta, parting_drate, &
                        f_elastic(k:k))
         call law%force(1, delta(k:k), [speed], impact_speed(k:k), parameters(:, k:k), f(k:k), df_ddelta(k:k), df_drate(k:k), &
                        f_elastic(k:k))
         weight = 0.5_wp*real(1 + memory(k)%course, wp)
         if (memory(k)%course == rests) weight = 0.5_wp + 0.5_wp*rate(k)/memory(k)%rest_speed
         df_drate(k) = weight*df_drate(k) + (1.0_wp - weight)*parting_drate(1)
         if (memory(k)%course == rests) df_drate(k) = df_drate(k) + 0.5_wp*(f(k) - parting(1))/memory(k)%rest_speed
         f(k) = weight*f(k) + (1.0_wp - weight)*parting(1)
         df_ddelta(k) = weight*df_ddelta(k) + (1.0_wp - weight)*parting_ddelta(1)
      end do
   end subroutine press_in_course

   !> Friction of some contacts, by a law that remembers nothing.
   subroutine friction_by_law(n, law, memory, contacts, f_n, speed, f_t)
      integer, intent(in) :: n                           !! number of contacts
      class(friction_law_t), intent(in) :: law           !! the law
      type(contact_memory_t), intent(in) :: memory(n)    !! (n) states
      type(point_contact_t), intent(in) :: contacts(n)   !! (n) sliding velocities of those that touch
      real(wp), intent(in) :: f_n(n)                     !! (n) normal forces that friction feels [N]
      real(wp), intent(inout) :: speed(n)                !! (n) magnitudes of the sliding velocities [m/s]
      real(wp), intent(inout) :: f_t(n)                  !! (n) friction force on j along t [N]

      integer :: k

      do k = 1, n
         speed(k) = 0.0_wp
         if (memory(k)%is_touching) speed(k) = abs(contacts(k)%v_t)
      end do
      call law%force(n, f_n, speed, f_t)
      do k = 1, n
         if (memory(k)%is_touching) f_t(k) = -sign(f_t(k), contacts(k)%v_t)
      end do
   end subroutine friction_by_law

end module contact_laws
