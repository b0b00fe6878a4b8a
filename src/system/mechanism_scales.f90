!> What is large and what is small in a planar scene: error scales, and the pace of the mechanism.
!>
!> A mechanism moves its size L in a time that is its own. Its rate at an instant is the greatest |v|/L and |omega| of all bodies,
!> its pace the greatest rate so far. What must be told from nothing (a speed left over, an error) is a part of pace and size, so
!> that small and slow mechanisms are computed as large and fast ones are. The pace begins with the greatest of: the rate at the
!> start; sqrt(|a|/L) and sqrt(|alpha|), which is where the accelerations of the start lead; one millionth of 1/end, so that what
!> never moves has one too. Where a load jumps, the accelerations lead anew.
submodule(mechanism_state) mechanism_scales
   use clearance_set, only: clearance_set_t
   use coordinates, only: most_rates
   use floors, only: idle_part, late, remembered, shortest_difference
   implicit none (type, external)

   real(wp), parameter :: part = 1.0e-4_wp   !! of the step: distance of the difference that gives rates [1]
   real(wp), parameter :: first = 1.0e-6_wp  !! of the run: step in hand before there is one [1]

contains

   !> Error scales: lengths over the size of the bodies, angles over one radian, rates over the
   !> greatest present rate of the mechanism, at least a hundredth of its pace, and of 1/duration of the run: what begins to move
   !> late must not be measured by round-off. Angles are not scaled by
   !> their value, so that the error does not grow as a crank counts turns. Where films act, no error of a length is more than
   !> three thousandths of the least clearance, whatever the tolerance: implicit methods would jump over what a film resists with,
   !> which is all within the clearance. While surfaces touch,
   !> all scales are a tenth: what an impact gives back is the difference of two large energies, and
   !> its dozen steps add up. Then no rate is asked for that round-off does not allow: a contact that swings with w makes speeds
   !> of w times what a length is rounded by that is the size of the bodies or, if more, the distance of its bodies from the origin.
   module procedure mechanism_weights
      real(wp), parameter :: touching = 0.1_wp  ! scales during contact [1]
      real(wp), parameter :: in_film = 0.003_wp  ! of the clearance: error of a length at most [1]
      real(wp) :: noise, rate, ratio
      integer :: i, k, n

      associate (linkage => self%linkage, n_unknown => self%linkage%rows%n_unknown, guided => self%linkage%reduced%guided, &
                 nq => self%linkage%n_position, length => self%linkage%scales%length)
         n = linkage%n_rate
         rate = max(rate_of(self, y), remembered*linkage%scales%pace, linkage%scales%late_rate)
         if (n_unknown > 0) call linkage%coordinates%weigh_positions(length, n_unknown, scale)
         associate (n_v => linkage%coordinates%n_v, is_turn => linkage%coordinates%is_turn)
            do k = 1, n_unknown
               do i = 1, n_v
                  scale(nq + n_v*(k - 1) + i) = merge(1.0_wp, length, is_turn(i))*rate
               end do
            end do
         end associate
         call weigh_guided(guided%n, guided%n_turning, length, rate, scale(nq - guided%n + 1:nq), &
                           scale(nq + n - guided%n + 1:nq + n))
      end associate
      if (self%loose%has_films) then
         ratio = in_film*self%loose%film_clearance/(self%linkage%scales%tolerance*self%linkage%scales%length)
         if (ratio < 1.0_wp) scale(:self%linkage%n_position + n) = ratio*scale(:self%linkage%n_position + n)
      end if
      if (self%friction%grips%n_bristle > 0) call self%bristle_weights(scale)
      noise = -1.0_wp
      do k = 1, size(self%loose%sets)
         associate (set => self%loose%sets(k)%set, scales => self%linkage%scales, motion => self%linkage%motion)
            if (set%n_touching == 0) cycle
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               noise = max(noise, set%contact(i)%swing*reach_of(set, i, scales%length, ubound(motion%angle, 1), motion%r))
            end do
         end associate
      end do
      if (noise < 0.0_wp) return
      associate (nq => self%linkage%n_position, scales => self%linkage%scales)
         rate = max(1.0_wp, epsilon(1.0_wp)*noise/(scales%tolerance*scales%length*rate))
         do k = 1, nq
            scale(k) = touching*scale(k)
         end do
         do k = nq + 1, nq + n
            scale(k) = touching*rate*scale(k)
         end do
      end associate
   end procedure mechanism_weights

   !> Length by whose rounding the penetration of a contact is known.
   pure real(wp) function reach_of(set, contact, length, n_body, r) result(reach)
      class(clearance_set_t), intent(in) :: set   !! loose joints
      integer, intent(in) :: contact              !! one of their contacts
      real(wp), intent(in) :: length              !! size of the bodies [m]
      integer, intent(in) :: n_body               !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)      !! (3, 0:bodies) centres of mass [m]

      integer :: c, side

      reach = length
      associate (item => (contact - 1)/set%n_contact_item + 1)
         do side = 1, 2
            do c = 1, 3
               reach = max(reach, abs(r(c, set%items%body(side, item))))
            end do
         end do
      end associate
   end function reach_of

   !> Scales of the coordinates of guided bodies and of their rates.
   pure subroutine weigh_guided(n, n_turning, length, rate, position, speed)
      integer, intent(in) :: n                    !! number of guided bodies
      integer, intent(in) :: n_turning            !! those that turn, the first ones
      real(wp), intent(in) :: length              !! scale of lengths [m]
      real(wp), intent(in) :: rate                !! that rates are measured by [1/s]
      real(wp), intent(inout) :: position(n)      !! (n) of the coordinates, set [1 or m]
      real(wp), intent(inout) :: speed(n)         !! (n) of their rates, set [1/s or m/s]

      integer :: k

      !GCC$ novector
      do k = 1, n_turning
         position(k) = 1.0_wp
         speed(k) = rate
      end do
      !GCC$ novector
      do k = n_turning + 1, n
         position(k) = length
         speed(k) = length*rate
      end do
   end subroutine weigh_guided

   !> Greatest rate of the mechanism in a state; of bodies whose motion is known at the present motion.
   pure real(wp) function rate_of(self, y) result(rate)
      class(mechanism_state_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(self%n)             !! (n) state [any]

      integer :: k

      associate (linkage => self%linkage, coordinates => self%linkage%coordinates, length => self%linkage%scales%length, &
                 known => self%linkage%reduced%known, guided => self%linkage%reduced%guided)
         associate (nq => linkage%n_position, last => linkage%n_position + linkage%n_rate - guided%n)
            rate = 0.0_wp
            if (linkage%rows%n_unknown > 0) rate = coordinates%greatest_rate(linkage%rows%n_unknown, y(nq + 1:), length)
            do k = 1, known%n
               rate = max(rate, coordinates%rate_of(linkage%motion, known%held(k)%body, length))
            end do
            !GCC$ novector
            do k = last + 1, last + guided%n_turning
               rate = max(rate, abs(y(k)))
            end do
            !GCC$ novector
            do k = last + guided%n_turning + 1, last + guided%n
               rate = max(rate, abs(y(k))/length)
            end do
         end associate
      end associate
   end function rate_of

   !> Raise the pace to that of a state.
   module procedure mechanism_follow_pace
      self%linkage%scales%pace = max(self%linkage%scales%pace, rate_of(self, y))
      if (present(jump)) self%linkage%scales%pace = max(self%linkage%scales%pace, rate_to_come(self, jump))
   end procedure mechanism_follow_pace

   !> The rate to which accelerations lead, sqrt(|a|/L) and sqrt(|alpha|); of bodies whose motion is known they are not looked at.
   pure real(wp) function rate_to_come(self, ydot) result(rate)
      class(mechanism_state_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: ydot(self%n)          !! (n) derivative of a state, or what it jumps by [any]

      integer :: k

      associate (linkage => self%linkage, length => self%linkage%scales%length, guided => self%linkage%reduced%guided)
         associate (nq => linkage%n_position, last => linkage%n_position + linkage%n_rate - guided%n)
            rate = sqrt(linkage%coordinates%greatest_rate(linkage%rows%n_unknown, ydot(nq + 1:), length))
            do k = 1, guided%n
               rate = max(rate, sqrt(abs(ydot(last + k))/merge(1.0_wp, length, k <= guided%n_turning)))
            end do
         end associate
      end associate
   end function rate_to_come

   !> The pace at the start.
   module procedure mechanism_begin_pace
      real(wp) :: acceleration(most_rates), delta(self%loose%n_contact), rate(self%loose%n_contact), ydot(size(y))
      integer(i8) :: n_evaluations, n_factorisations
      integer :: i, k, status

      ! what the method does is counted, not this
      n_evaluations = self%n_evaluations
      n_factorisations = self%linkage%solution%solver%n_factorisations
      self%linkage%scales%pace = idle_part/end
      self%linkage%scales%late_rate = late/end
      self%friction%grips%h = first*end
      call self%linkage%set_motion(t, y)
      do k = 1, size(self%loose%sets)
         associate (set => self%loose%sets(k)%set)
            call set%gaps(self%linkage%motion, delta, rate)
            do i = 1, set%n_contact
               if (set%contact(i)%is_touching) call set%note_swing(i, delta(set%before%contacts + i))
            end do
         end associate
      end do
      call self%evaluate(t, y, ydot, status)
      self%n_evaluations = n_evaluations
      self%linkage%solution%solver%n_factorisations = n_factorisations
      if (status /= 0) ydot = 0.0_wp
      call self%follow_pace(y, ydot)
      if (status /= 0) return
      associate (linkage => self%linkage, coordinates => self%linkage%coordinates, scales => self%linkage%scales)
         do k = 1, linkage%reduced%known%n
            call coordinates%find_acceleration(linkage%motion, linkage%reduced%known%held(k)%body, acceleration)
            scales%pace = max(scales%pace, sqrt(coordinates%greatest_rate(1, acceleration, scales%length)))
         end do
      end associate
   end procedure mechanism_begin_pace

   !> Part of the step in hand, but more than time is rounded by.
   module procedure time_of_difference
      time_of_difference = max(part*self%friction%grips%h, shortest_difference*epsilon(1.0_wp)*abs(t))
   end procedure time_of_difference

end submodule mechanism_scales
