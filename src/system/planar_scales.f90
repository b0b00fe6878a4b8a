!> What is large and what is small in a planar scene: error scales, and the pace of the mechanism.
!>
!> A mechanism moves its size L in a time that is its own. Its rate at an instant is the greatest |v|/L and |omega| of all bodies,
!> its pace the greatest rate so far. What must be told from nothing (a speed left over, an error) is a part of pace and size, so
!> that small and slow mechanisms are computed as large and fast ones are. The pace begins with the greatest of: the rate at the
!> start; sqrt(|a|/L) and sqrt(|alpha|), which is where the accelerations of the start lead; one millionth of 1/end, so that what
!> never moves has one too. Where a load jumps, the accelerations lead anew.
submodule(planar_system) planar_scales
   use floors, only: idle_part, late, remembered, shortest_difference
   implicit none (type, external)

   real(wp), parameter :: part = 1.0e-4_wp   !! of the step: distance of the difference that gives rates [1]
   real(wp), parameter :: first = 1.0e-6_wp  !! of the run: step in hand before there is one [1]

contains

   !> Error scales: lengths over the size of the bodies, angles over one radian, rates over the
   !> greatest present rate of the mechanism, at least a hundredth of its pace, and of 1/duration of the run: what begins to move
   !> late must not be measured by round-off. Angles are not scaled by
   !> their value, so that the error does not grow as a crank counts turns. While surfaces touch,
   !> all scales are a tenth: what an impact gives back is the difference of two large energies, and
   !> its dozen steps add up. Then no rate is asked for that round-off does not allow: a contact that swings with w makes speeds
   !> of w times what a length as the mechanism's size is rounded by.
   module procedure planar_weights
      real(wp), parameter :: touching = 0.1_wp  ! scales during contact [1]
      real(wp) :: rate, swing
      integer :: k, n, nq

      nq = self%n_position
      n = 3*self%linkage%rows%n_unknown
      rate = max(rate_of(self, y), remembered*self%linkage%scales%pace, self%linkage%scales%late_rate)
      do k = 1, self%linkage%reduced%guided%n
         scale(n + k) = merge(1.0_wp, self%linkage%scales%length, k <= self%linkage%reduced%guided%n_turning)
      end do
      scale(nq + n + 1:2*nq) = scale(n + 1:nq)*rate
      do k = 1, n, 3
         scale(k) = self%linkage%scales%length
         scale(k + 1) = self%linkage%scales%length
         scale(k + 2) = 1.0_wp
         scale(nq + k) = self%linkage%scales%length*rate
         scale(nq + k + 1) = self%linkage%scales%length*rate
         scale(nq + k + 2) = rate
      end do
      if (self%grips%n_bristle > 0) call self%bristle_weights(scale)
      swing = -1.0_wp
      do k = 1, size(self%clearances)
         if (self%clearances(k)%set%n_touching == 0) cycle
         swing = max(swing, maxval(self%clearances(k)%set%contact%swing, mask=self%clearances(k)%set%contact%is_touching))
      end do
      if (swing < 0.0_wp) return
      rate = max(1.0_wp, epsilon(1.0_wp)*swing/(self%linkage%scales%tolerance*rate))
      scale(:nq) = touching*scale(:nq)
      scale(nq + 1:2*nq) = touching*rate*scale(nq + 1:2*nq)
   end procedure planar_weights

   !> Greatest rate of the mechanism in a state; of bodies whose motion is known at the present motion.
   pure real(wp) function rate_of(self, y) result(rate)
      class(planar_system_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(:)                !! (n) state [any]

      integer :: body, k, n, nq

      nq = self%n_position
      n = 3*self%linkage%rows%n_unknown
      rate = 0.0_wp
      do k = nq + 1, nq + n, 3
         rate = max(rate, abs(y(k))/self%linkage%scales%length, abs(y(k + 1))/self%linkage%scales%length, abs(y(k + 2)))
      end do
      do k = 1, self%linkage%reduced%known%n
         body = self%linkage%reduced%known%item(k)%body
         rate = max(rate, maxval(abs(self%linkage%motion%v(1:2, body)))/self%linkage%scales%length, &
                    abs(self%linkage%motion%omega(3, body)))
      end do
      do k = 1, self%linkage%reduced%guided%n
         rate = max(rate, abs(y(nq + n + k))/merge(1.0_wp, self%linkage%scales%length, k <= self%linkage%reduced%guided%n_turning))
      end do
   end function rate_of

   !> Raise the pace to that of a state.
   module procedure planar_follow_pace
      self%linkage%scales%pace = max(self%linkage%scales%pace, rate_of(self, y))
      if (present(jump)) self%linkage%scales%pace = max(self%linkage%scales%pace, rate_to_come(self, jump))
   end procedure planar_follow_pace

   !> The rate to which accelerations lead, sqrt(|a|/L) and sqrt(|alpha|); of bodies whose motion is known they are not looked at.
   pure real(wp) function rate_to_come(self, ydot) result(rate)
      class(planar_system_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: ydot(:)             !! (n) derivative of a state, or what it jumps by [any]

      integer :: k, n, nq

      nq = self%n_position
      n = 3*self%linkage%rows%n_unknown
      rate = 0.0_wp
      do k = nq + 1, nq + n, 3
         rate = max(rate, sqrt(maxval(abs(ydot(k:k + 1)))/self%linkage%scales%length), sqrt(abs(ydot(k + 2))))
      end do
      do k = 1, self%linkage%reduced%guided%n
         rate = max(rate, sqrt(abs(ydot(nq + n + k))/merge(1.0_wp, self%linkage%scales%length, &
                    k <= self%linkage%reduced%guided%n_turning)))
      end do
   end function rate_to_come

   !> The pace at the start.
   module procedure planar_begin_pace
      real(wp) :: delta(self%n_contact), rate(self%n_contact), ydot(size(y))
      integer(i8) :: n_evaluations, n_factorisations
      integer :: i, k, status

      ! what the method does is counted, not this
      n_evaluations = self%n_evaluations
      n_factorisations = self%linkage%solution%solver%n_factorisations
      self%linkage%scales%pace = idle_part/end
      self%linkage%scales%late_rate = late/end
      self%grips%h = first*end
      call self%linkage%set_motion(t, y)
      do k = 1, size(self%clearances)
         associate (set => self%clearances(k)%set)
            call set%gaps(self%linkage%motion, delta, rate)
            do i = 1, set%n_contact
               if (set%contact(i)%is_touching) call set%note_swing(i, delta(set%first_contact + i))
            end do
         end associate
      end do
      call self%evaluate(t, y, ydot, status)
      self%n_evaluations = n_evaluations
      self%linkage%solution%solver%n_factorisations = n_factorisations
      if (status /= 0) ydot = 0.0_wp
      call self%follow_pace(y, ydot)
      if (status /= 0) return
      do k = 1, self%linkage%reduced%known%n
         associate (body => self%linkage%reduced%known%item(k)%body, motion => self%linkage%motion)
            self%linkage%scales%pace = max(self%linkage%scales%pace, sqrt(maxval(abs(motion%a(1:2, &
                                           body)))/self%linkage%scales%length), sqrt(abs(motion%alpha(3, body))))
         end associate
      end do
   end procedure planar_begin_pace

   !> Part of the step in hand, but more than time is rounded by.
   module procedure time_of_difference
      time_of_difference = max(part*self%grips%h, shortest_difference*epsilon(1.0_wp)*abs(t))
   end procedure time_of_difference

end submodule planar_scales
