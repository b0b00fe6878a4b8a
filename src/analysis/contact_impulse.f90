!> Impulse of the normal force of a contact over a step.
!>
!> From values and rates F, F' at the ends of a step of length h, by the cubic of Hermite,
!>
!> $$ I = \frac{h}{2} (F_0 + F_1) + \frac{h^2}{12} (F'_0 - F'_1), $$
!>
!> whose error is h^5 F''''/720, of I about (w h)^4/720 for a contact that swings at w. Where that is not little, or the force
!> changes by more than half, the value F_m in the middle of the step's interpolant is taken too, by the quintic of Hermite,
!>
!> $$ I = \frac{h}{30} (7 F_0 + 16 F_m + 7 F_1) + \frac{h^2}{60} (F'_0 - F'_1). $$
!>
!> Where the two differ by more than a small part of the impulse that is to be expected of the contact, and the force is small at
!> one end, it is not smooth: it goes as a power 3/2 where a contact begins and ends. Then I = h int F 6 u (1 - u) du with the place
!> s = u^2 (3 - 2 u) in the step, in which such powers are whole ones, by Gauss' rule of five places.
!>
!> A step of half a swing or more, as at rest, knows nothing of the swing, and neither rates nor interpolant are worth anything:
!> h (F_0 + F_1)/2. Not so where a contact begins and ends in one step.
!>
!> Source: M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions (1964), table 25.4. Limits: none.
module contact_impulse
   use contact_peaks, only: look, trend_t
   use event_location, only: state_at
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use integrator, only: integrator_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: find_impulse

   real(wp), parameter :: little = 1.0e-7_wp  !! error of the cubic that is little, of the impulse to be expected [1]
   real(wp), parameter :: as_asked = 2.0_wp   !! so many tolerances are little too: forces are known no better [1]
   real(wp), parameter :: rough = 20.0_wp     !! difference of quintic and cubic where the force is smooth, of what is little [1]
   real(wp), parameter :: steady = 0.5_wp     !! least of the forces at the ends of a step without a bend, of the greatest [1]
   real(wp), parameter :: nearly_parted = 0.1_wp  !! force at an end where a contact has begun or will end soon, of the greatest [1]
   integer, parameter :: n_gauss = 5          !! places of Gauss' rule
   real(wp), parameter :: gauss_place(n_gauss) = [-0.906179845938663993_wp, -0.538469310105683091_wp, 0.0_wp, &
                                                  0.538469310105683091_wp, 0.906179845938663993_wp]  !! of [-1, 1] [1]
   real(wp), parameter :: gauss_weight(n_gauss) = [0.236926885056189088_wp, 0.478628670499366468_wp, 0.568888888888888889_wp, &
                                                   0.478628670499366468_wp, 0.236926885056189088_wp]  !! their weights [1]

contains

   !> Impulse of a contact over the last step.
   subroutine find_impulse(system, method, slot, item, left, right, y, has_moved, impulse)
      type(mechanism_t), intent(inout) :: system       !! the system, its motion that of the end of the step
      class(integrator_t), intent(in) :: method        !! the integrator, after a step
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: item                      !! contact of the set
      type(trend_t), intent(in) :: left                !! force at the start of the step
      type(trend_t), intent(in) :: right               !! force at its end
      real(wp), intent(inout), contiguous :: y(:)      !! (n) scratch state [any]
      logical, intent(out) :: has_moved                !! the motion is another one now
      real(wp), intent(out) :: impulse                 !! the impulse [N.s]

      real(wp) :: by_ends, error, expected, greater, h, rates, swing

      h = method%step%h
      impulse = 0.0_wp
      has_moved = .false.
      if (.not. h > 0.0_wp) return
      swing = system%loose%sets(slot)%set%contact(item)%swing
      greater = max(left%value, right%value)
      has_moved = h*swing < pi .or. greater <= 0.0_wp
      if (.not. has_moved) then
         impulse = 0.5_wp*h*(left%value + right%value)
         return
      end if
      if (ieee_is_finite(left%rate) .and. ieee_is_finite(right%rate)) then
         rates = h*h*(left%rate - right%rate)
         by_ends = 0.5_wp*h*(left%value + right%value) + rates/12.0_wp
         expected = max(abs(system%loose%sets(slot)%set%contact(item)%went%impulse), abs(by_ends))
         impulse = by_ends
         error = max(little, as_asked*method%controls%tolerance)
         if (swing > 0.0_wp) then
            expected = max(expected, greater/swing)
            has_moved = min(left%value, right%value) <= steady*greater &
                        .or. abs(by_ends)*(h*swing)**4 > 720.0_wp*error*expected
            if (.not. has_moved) return
         end if
         call go_to(system, method, 0.5_wp, y)
         impulse = h/30.0_wp*(7.0_wp*(left%value + right%value) + 16.0_wp*force_of(system, slot, item)) + rates/60.0_wp
         if (abs(impulse - by_ends) <= rough*error*expected .or. min(left%value, right%value) > nearly_parted*greater) return
      end if
      call integrate(system, method, slot, item, y, impulse)
   end subroutine find_impulse

   !> Gauss' rule in u.
   subroutine integrate(system, method, slot, item, y, impulse)
      type(mechanism_t), intent(inout) :: system       !! the system
      class(integrator_t), intent(in) :: method        !! the integrator, after a step
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: item                      !! contact of the set
      real(wp), intent(inout), contiguous :: y(:)      !! (n) scratch state [any]
      real(wp), intent(out) :: impulse                 !! the impulse [N.s]

      real(wp) :: u
      integer :: k

      impulse = 0.0_wp
      do k = 1, n_gauss
         u = 0.5_wp + 0.5_wp*gauss_place(k)
         call go_to(system, method, u*u*(3.0_wp - 2.0_wp*u), y)
         impulse = impulse + 3.0_wp*method%step%h*u*(1.0_wp - u)*gauss_weight(k)*force_of(system, slot, item)
      end do
   end subroutine integrate

   !> The motion at a place of the last step, from its interpolant.
   subroutine go_to(system, method, place, y)
      type(mechanism_t), intent(inout) :: system       !! the system
      class(integrator_t), intent(in) :: method        !! the integrator, after a step
      real(wp), intent(in) :: place                    !! the place [1]
      real(wp), intent(inout), contiguous :: y(:)      !! (n) scratch state [any]

      call state_at(system, method, place, y)
      call system%linkage%set_motion(method%step%t0 + place*method%step%h, y)
   end subroutine go_to

   !> Normal force of a contact at the present motion.
   real(wp) function force_of(system, slot, item) result(f_n)
      type(mechanism_t), intent(in) :: system          !! the system, motion set
      integer, intent(in) :: slot                      !! set of the contact
      integer, intent(in) :: item                      !! contact of the set

      type(trend_t) :: force, penetration

      call look(system, slot, item, force, penetration)
      f_n = force%value
   end function force_of

end module contact_impulse
