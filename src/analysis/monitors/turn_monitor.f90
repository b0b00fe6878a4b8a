!> Contacts whose normal law jumps where the penetration turns: whether they part, approach again, or rest.
!>
!> Such a law has the force F_a while approaching and F_p < F_a while parting. Where a load lies between the two, neither way lasts:
!> the contact rests. Its force then goes from F_p to F_a as the rate goes from -v_s to v_s,
!>
!> v_s = (F_a - F_p)/(2 sqrt(K m)),   K = dF_a/ddelta,   m the reduced mass,
!>
!> a dashpot as fast as the contact itself, until the rate leaves this range.
!>
!> Signs: rates are positive while approaching. Source: A. F. Filippov, Differential Equations with Discontinuous Righthand Sides
!> (1988), chapter 2, with the sliding mode smoothed. Limits: contacts change one after another, each for the others as they are.
module turn_monitor
   use contact_memory, only: approaches, parts, rests
   use kinds, only: wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: handle_turn

contains

   !> A located turn of the penetration, or the end of rest.
   subroutine handle_turn(system, t, y, slot, k)
      type(mechanism_t), intent(inout) :: system   !! the system; the course of the contact is changed
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in) :: y(:)                     !! (n) state [any]
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: k                         !! contact of the set

      real(wp) :: acceleration(system%clearance_joints%n_contact), delta(system%clearance_joints%n_contact), &
           rate(system%clearance_joints%n_contact)
      integer :: number

      associate (set => system%clearance_joints%sets(slot)%set)
         number = set%before%contacts + k
         if (set%contact(k)%course == rests) then
            call system%turns(t, y, rate, acceleration)
            call set%set_course(k, merge(approaches, parts, rate(number) > 0.0_wp))
            return
         end if
         call set%set_course(k, merge(parts, approaches, set%contact(k)%course == approaches))
         call system%turns(t, y, rate, acceleration)
         if (set%contact(k)%course*acceleration(number) >= 0.0_wp) return
         call set%gaps(system%linkage%motion, delta, rate)
         call set%set_course(k, rests, speed_of_rest(system, slot, k, delta(number)))
      end associate
   end subroutine handle_turn

   !> Maximum rate of a contact that rests.
   pure real(wp) function speed_of_rest(system, slot, k, delta) result(speed)
      type(mechanism_t), intent(in) :: system   !! the system
      integer, intent(in) :: slot                   !! set of the contact
      integer, intent(in) :: k                      !! contact of the set
      real(wp), intent(in) :: delta                 !! penetration [m]

      real(wp), dimension(2) :: by_delta, by_rate, elastic, f
      integer :: item

      associate (set => system%clearance_joints%sets(slot)%set)
         item = set%item_of(k)
         call set%laws%normal%force(2, [delta, delta], [1.0_wp, -1.0_wp], spread(set%contact(k)%impact_speed, 1, 2), &
                            spread(set%laws%parameters(:, k), 2, 2), f, by_delta, by_rate, elastic)
         speed = 0.5_wp*(f(1) - f(2))*sqrt(set%items%pairs(item)%inverse_mass/max(by_delta(1), tiny(1.0_wp)))
      end associate
      speed = max(speed, tiny(1.0_wp))
   end function speed_of_rest

end module turn_monitor
