!> What is large and what is small in a planar scene: error scales, and the characteristic rate of the mechanism.
!>
!> A mechanism moves its size L in a time that is its own. Its rate at an instant is the maximum |v|/L and |omega| of all bodies,
!> its characteristic rate the maximum rate so far. What must be reported from nothing (a speed left over, an error) is a part of
!> characteristic rate and size, so that small and slow mechanisms are computed as large and fast ones are. The characteristic rate
!> starts with the maximum of: the rate at the start; sqrt(|a|/L) and sqrt(|alpha|), which is where the accelerations of the start
!> lead; one millionth of 1/end, so that what never moves has one too. Where a load jumps, the accelerations lead anew.
submodule(mechanism_state) mechanism_scales
   use contact_memory, only: contact_memory_t
   use coordinates, only: most_rates
   use floors, only: idle_part, late, remembered, shortest_difference
   use reduced_bodies, only: held_t
   implicit none (type, external)

   real(wp), parameter :: part = 1.0e-4_wp   !! of the step: distance of the difference that gives rates [1]
   real(wp), parameter :: first = 1.0e-6_wp  !! of the run: step in hand before there is one [1]

   !> What makes error scales smaller.
   type :: factors_t
      real(wp) :: in_film = 1.0_wp    !! all of them, where films act [1]
      real(wp) :: position = 1.0_wp   !! those of coordinates, while surfaces touch [1]
      real(wp) :: speed = 1.0_wp      !! those of rates [1]
   end type factors_t

contains

   !> Error scales: lengths over the size of the bodies, angles over one radian, rates over the
   !> maximum present rate of the mechanism, at least a hundredth of its characteristic rate, and of 1/duration of the run: what
   !> starts to move late must not be measured by round-off. Angles are not scaled by
   !> their value, so that the error does not grow as a crank counts turns. Where films act, no error of a length is more than
   !> three thousandths of the minimum clearance, whatever the tolerance: implicit methods would jump over what a film resists with,
   !> which is all within the clearance. While surfaces touch,
   !> all scales are a tenth: what an impact gives back is the difference of two large energies, and
   !> its dozen steps add up. Then no rate is asked for that round-off does not allow: a contact that swings with w makes speeds
   !> of w times what a length is rounded by that is the size of the bodies or, if more, the distance of its bodies from the origin.
   module procedure mechanism_weights
      real(wp), parameter :: touching = 0.1_wp  ! scales during contact [1]
      real(wp), parameter :: in_film = 0.003_wp  ! of the clearance: error of a length at most [1]
      real(wp) :: noise, rate
      type(factors_t) :: factors
      integer :: i, k

      associate (scales => self%linkage%scales)
         rate = max(rate_of(self, y), remembered*scales%pace, scales%late_rate)
         if (self%clearance_joints%has_films) &
            factors%in_film = min(in_film*self%clearance_joints%film_clearance/(scales%tolerance*scales%length), 1.0_wp)
         noise = noise_of_all()
         if (noise >= 0.0_wp) then
            factors%position = touching
            factors%speed = touching*max(1.0_wp, epsilon(1.0_wp)*noise/(scales%tolerance*scales%length*rate))
         end if
      end associate
      associate (linkage => self%linkage, n_unknown => self%linkage%rows%n_unknown, one_dof => self%linkage%reduced%one_dof, &
                 nq => self%linkage%n_position, length => self%linkage%scales%length)
         associate (last => nq + linkage%n_rate)
            call weigh_one_dof(one_dof%n, one_dof%n_turning, length, rate, factors, scale(nq - one_dof%n + 1:nq), &
                              scale(last - one_dof%n + 1:last))
         end associate
         if (n_unknown > 0) then
            call linkage%coordinates%weigh_positions(length, n_unknown, scale)
            do k = 1, nq - one_dof%n
               scale(k) = factors%position*(factors%in_film*scale(k))
            end do
            associate (n_v => linkage%coordinates%n_v, is_turn => linkage%coordinates%is_turn)
               do k = 1, n_unknown
                  do i = 1, n_v
                     scale(nq + n_v*(k - 1) + i) = factors%speed*(factors%in_film*(merge(1.0_wp, length, is_turn(i))*rate))
                  end do
               end do
            end associate
         end if
      end associate
      if (self%friction%stick_slips%n_bristle > 0) call self%bristle_weights(scale)
      if (self%loading%states%n > 0) call self%state_weights(y, scale)

   contains

      !> The maximum noise of all contacts that touch; negative if none does.
      pure real(wp) function noise_of_all() result(maximum)
         integer :: slot

         maximum = -1.0_wp  ! [m/s]
         do slot = 1, self%clearance_joints%n_set
            associate (set => self%clearance_joints%sets(slot)%set, linkage => self%linkage)
               if (set%n_touching == 0) cycle
               maximum = max(maximum, noise_of(set%n_contact, set%contact, set%n_contact_item, set%n, set%items%body, &
                                                 linkage%scales%length, linkage%bodies%n, linkage%motion%r))
            end associate
         end do
      end function noise_of_all

   end procedure mechanism_weights

   !> Swing of the contacts of a set that touch, times the length by whose rounding their penetration is known: the maximum.
   pure real(wp) function noise_of(n_contact, contact, n_contact_item, n, body, length, n_body, r) result(noise)
      integer, intent(in) :: n_contact                       !! number of contacts of the set
      type(contact_memory_t), intent(in) :: contact(n_contact)  !! (n_contact) the contacts
      integer, intent(in) :: n_contact_item                  !! contacts of an item
      integer, intent(in) :: n                               !! number of items
      integer, intent(in) :: body(2, n)                      !! (2, n) their bodies
      real(wp), intent(in) :: length                         !! size of the bodies [m]
      integer, intent(in) :: n_body                          !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)                 !! (3, 0:bodies) centres of mass [m]

      real(wp) :: reach
      integer :: i, side

      noise = -1.0_wp
      do i = 1, n_contact
         if (.not. contact(i)%is_touching) cycle
         reach = length
         do side = 1, 2
            associate (place => r(:, body(side, (i - 1)/n_contact_item + 1)))
               reach = max(reach, abs(place(1)), abs(place(2)), abs(place(3)))
            end associate
         end do
         noise = max(noise, contact(i)%contact_rate*reach)
      end do
   end function noise_of

   !> Scales of the coordinates of bodies with one degree of freedom and of their rates.
   pure subroutine weigh_one_dof(n, n_turning, length, rate, factors, position, speed)
      integer, intent(in) :: n                    !! number of bodies with one degree of freedom
      integer, intent(in) :: n_turning            !! those that turn, the first ones
      real(wp), intent(in) :: length              !! scale of lengths [m]
      real(wp), intent(in) :: rate                !! that rates are measured by [1/s]
      type(factors_t), intent(in) :: factors      !! what makes the scales smaller
      real(wp), intent(inout) :: position(n)      !! (n) of the coordinates, set [1 or m]
      real(wp), intent(inout) :: speed(n)         !! (n) of their rates, set [1/s or m/s]

      integer :: k

      !GCC$ novector
      do k = 1, n_turning
         position(k) = factors%position*factors%in_film
         speed(k) = factors%speed*(factors%in_film*rate)
      end do
      !GCC$ novector
      do k = n_turning + 1, n
         position(k) = factors%position*(factors%in_film*length)
         speed(k) = factors%speed*(factors%in_film*(length*rate))
      end do
   end subroutine weigh_one_dof

   !> Maximum rate of the mechanism in a state; of bodies whose motion is known at the present motion.
   pure real(wp) function rate_of(self, y) result(rate)
      class(mechanism_state_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(self%n)             !! (n) state [any]

      associate (linkage => self%linkage, length => self%linkage%scales%length, known => self%linkage%reduced%known, &
                 one_dof => self%linkage%reduced%one_dof)
         rate = rate_of_prescribed(known%n, known%held, linkage%bodies%n, linkage%motion%v, linkage%motion%omega, length)
         associate (last => linkage%n_position + linkage%n_rate)
            rate = max(rate, rate_of_one_dof(one_dof%n, one_dof%n_turning, y(last - one_dof%n + 1:last), length))
         end associate
         if (linkage%rows%n_unknown > 0) then
            rate = max(rate, linkage%coordinates%max_rate(linkage%rows%n_unknown, y(linkage%n_position + 1:), length))
         end if
      end associate
   end function rate_of

   !> Maximum rate of bodies whose motion is known: of velocities over a length, and of angular velocities.
   pure real(wp) function rate_of_prescribed(n, held, n_body, v, omega, length) result(rate)
      integer, intent(in) :: n                       !! number of such bodies
      type(held_t), intent(in) :: held(n)            !! (n) which they are
      integer, intent(in) :: n_body                  !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)         !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)     !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: length                 !! the length [m]

      integer :: k

      rate = 0.0_wp
      do k = 1, n
         associate (u => v(:, held(k)%body), w => omega(:, held(k)%body))
            rate = max(rate, max(abs(u(1)), abs(u(2)), abs(u(3)))/length, abs(w(1)), abs(w(2)), abs(w(3)))
         end associate
      end do
   end function rate_of_prescribed

   !> Maximum rate of bodies with one degree of freedom.
   pure real(wp) function rate_of_one_dof(n, n_turning, speed, length) result(rate)
      integer, intent(in) :: n           !! number of bodies with one degree of freedom
      integer, intent(in) :: n_turning   !! those that turn, the first ones
      real(wp), intent(in) :: speed(n)   !! (n) rates of their coordinates [rad/s or m/s]
      real(wp), intent(in) :: length     !! the length [m]

      real(wp) :: sliding
      integer :: k

      rate = 0.0_wp
      !GCC$ novector
      do k = 1, n_turning
         rate = max(rate, abs(speed(k)))
      end do
      sliding = 0.0_wp
      !GCC$ novector
      do k = n_turning + 1, n
         sliding = max(sliding, abs(speed(k)))
      end do
      rate = max(rate, sliding/length)
   end function rate_of_one_dof

   !> Raise the characteristic rate to that of a state.
   module procedure mechanism_follow_pace
      self%linkage%scales%pace = max(self%linkage%scales%pace, rate_of(self, y))
      if (present(jump)) self%linkage%scales%pace = max(self%linkage%scales%pace, rate_to_come(self, jump))
   end procedure mechanism_follow_pace

   !> The rate to which accelerations lead, sqrt(|a|/L) and sqrt(|alpha|); of bodies whose motion is known they are not looked at.
   pure real(wp) function rate_to_come(self, ydot) result(rate)
      class(mechanism_state_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: ydot(self%n)          !! (n) derivative of a state, or what it jumps by [any]

      integer :: k

      associate (linkage => self%linkage, length => self%linkage%scales%length, one_dof => self%linkage%reduced%one_dof)
         associate (nq => linkage%n_position, last => linkage%n_position + linkage%n_rate - one_dof%n)
            rate = sqrt(linkage%coordinates%max_rate(linkage%rows%n_unknown, ydot(nq + 1:), length))
            do k = 1, one_dof%n
               rate = max(rate, sqrt(abs(ydot(last + k))/merge(1.0_wp, length, k <= one_dof%n_turning)))
            end do
         end associate
      end associate
   end function rate_to_come

   !> The characteristic rate at the start.
   module procedure mechanism_begin_pace
      real(wp) :: acceleration(most_rates), delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact), &
           ydot(size(y))
      integer(i8) :: n_evaluations, n_factorisations
      integer :: i, k, status

      ! what the method does is counted, not this
      n_evaluations = self%n_evaluations
      n_factorisations = self%linkage%solution%solver%n_factorisations
      self%linkage%scales%pace = idle_part/end
      self%linkage%scales%late_rate = late/end
      self%friction%stick_slips%h = first*end
      call self%linkage%set_motion(t, y)
      do k = 1, self%clearance_joints%n_set
         associate (set => self%clearance_joints%sets(k)%set)
            call set%gaps(self%linkage%motion, delta, rate)
            do i = 1, set%n_contact
               if (set%contact(i)%is_touching) call set%note_contact_rate(i, delta(set%before%contacts + i))
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
            scales%pace = max(scales%pace, sqrt(coordinates%max_rate(1, acceleration, scales%length)))
         end do
      end associate
   end procedure mechanism_begin_pace

   !> Scales of the quadratures, where drivers prescribe motions.
   module procedure mechanism_scale_quadratures
      real(wp) :: momentum, speed
      integer :: k

      if (self%n_quadrature == 0) return
      do k = 1, size(self%linkage%joints)
         if (self%linkage%joints(k)%set%is_driver) exit
      end do
      if (k > size(self%linkage%joints)) return
      associate (scales => self%linkage%scales, bodies => self%linkage%bodies, n_work => self%n_quadrature - self%n_impulse)
         speed = scales%length*max(remembered*scales%pace, scales%late_rate)
         self%ledger%largest = max(self%ledger%largest, energy, sum(bodies%mass)*speed**2)
         momentum = sum(bodies%mass)*scales%length*max(scales%pace, scales%late_rate)
         if (.not. allocated(self%traits%quadrature_scale)) allocate (self%traits%quadrature_scale(self%n_quadrature))
         self%traits%quadrature_scale(:n_work) = self%ledger%largest
         self%traits%quadrature_scale(n_work + 1:) = momentum
      end associate
   end procedure mechanism_scale_quadratures

   !> Part of the step in hand, but more than time is rounded by.
   module procedure time_of_difference
      time_of_difference = max(part*self%friction%stick_slips%h, shortest_difference*epsilon(1.0_wp)*abs(t))
   end procedure time_of_difference

end submodule mechanism_scales
