!> Friction that remembers: contacts that stick. Bristles are states (`mechanism_bristles`).
!>
!> Normal forces are known before the accelerations, so the forces x along the m tangents of contacts that stick (of each one in
!> the plane, two in space) follow from
!>
!> v_T' = -kappa v_T:   A x = -(G a_0 + drift + kappa v_T),   A = G K^-1 G^T,
!>
!> with G their tangential rows (`contact_stick_slip`), a_0 the accelerations without these forces and K the augmented matrix: one
!> solution of the augmented equations for each of them and one with all loads. kappa, a multiple of the mechanism's characteristic
!> rate (`mechanism_scales`), keeps the sliding velocity at round-off.
!> Where contacts share a load, as two corners of one block do, each takes the same part of what it can hold.
!>
!> Sliding that drivers prescribe no force can keep back: such a contact sticks only while it is at rest, where friction is any
!> force between its limits and the drivers take the rest; it is given none. It slips as soon as it moves, at a reversal at once.
!>
!> Source: Flores et al. (2008), eqs. (3.13), (3.14); F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts
!> (1996), section 5.3. Limits: none.
submodule(mechanism) mechanism_friction
   use clearance_set, only: clearance_set_t, loss_friction
   use contact_stick_slip, only: sticks
   use coordinates, only: most_rates
   use friction_law, only: memory_slip
   use floors, only: at_rest, captured, contact_lever, min_mobility, no_acceleration, settling, standstill, widest_band
   use stick_slip_forces, only: gripped_t, share_of_stick_slips, solve_stick_slips
   implicit none (type, external)

   real(wp), parameter :: shared = 1.0e-6_wp   !! share of a force in combinations that change no acceleration: it is not unique [1]

contains

   !> Forces of the contacts that stick, and the accelerations with them.
   module procedure mechanism_stick
      real(wp) :: minimum    ! mobility taken as zero, of that of free bodies [1]
      real(wp) :: nothing  ! sliding acceleration taken as zero [m/s^2]
      integer :: c, m

      status = 0
      call list_stick_slips(self, .true., m)
      if (m == 0) return
      associate (stick_slips => self%friction%stick_slips)
         minimum = mobility_of_depth(self, m)
         call find_mobilities(self, m, minimum, nothing, status)
         if (status /= 0) return
         call solve_stick_slips(m, size(stick_slips%matrix, 1), stick_slips%matrix(:, :m), stick_slips%mobility(:m), minimum, &
                                stick_slips%root(:m), &
                          stick_slips%force(:m), stick_slips%left(:m), stick_slips%eigenvalue(:m), stick_slips%work)
         do c = 1, m
            call add_pair(self, c, stick_slips%force(c), self%loading%g)
            call keep_force(self, c, nothing)
         end do
      end associate
      call self%linkage%find_accelerations(self%loading%g, .true., .true., status)
   end procedure mechanism_stick

   !> Note the contacts that stick whose friction forces are not unique: some combination of them changes no acceleration.
   subroutine note_shared_forces(self, t)
      class(mechanism_t), intent(inout) :: self   !! the system, accelerations found; they are those of unit forces afterwards
      real(wp), intent(in) :: t                   !! time [s]

      real(wp) :: minimum, nothing
      integer :: c, m, status

      call list_stick_slips(self, .false., m)
      if (m == 0) return
      associate (stick_slips => self%friction%stick_slips, sets => self%clearance_joints%sets)
         if (m == sets(stick_slips%at(1)%slot)%set%stick_slip%n_tangent) return
         if (all([(sets(stick_slips%at(c)%slot)%set%stick_slip%shared_from(stick_slips%at(c)%contact) <= t, c=1, m)])) return
         minimum = mobility_of_depth(self, m)
         call find_mobilities(self, m, minimum, nothing, status)
         if (status /= 0) return
         call share_of_stick_slips(m, size(stick_slips%matrix, 1), stick_slips%matrix(:, :m), stick_slips%mobility(:m), &
                                   minimum, stick_slips%force(:m), &
                             stick_slips%eigenvalue(:m), stick_slips%work)
         do c = 1, m
            if (stick_slips%is_fixed(c) .or. .not. stick_slips%force(c) > shared) cycle
            call sets(stick_slips%at(c)%slot)%set%note_shared(stick_slips%at(c)%contact, t)
         end do
      end associate
   end subroutine note_shared_forces

   !> List the tangents of the contacts that stick.
   subroutine list_stick_slips(self, with_driven, m)
      class(mechanism_t), intent(inout) :: self   !! the system, its list is made
      logical, intent(in) :: with_driven          !! with contacts that drivers alone move
      integer, intent(out) :: m                   !! tangents

      integer :: axis, d, k

      m = 0
      do d = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(d)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. set%stick_slip%slip(k) /= sticks) cycle
               if (.not. with_driven .and. set%stick_slip%tangent(k)%is_driven) cycle
               do axis = 1, set%stick_slip%n_tangent
                  m = m + 1
                  self%friction%stick_slips%at(m) = gripped_t(d, k, axis)
               end do
            end do
         end associate
      end do
   end subroutine list_stick_slips

   !> What unit forces along the tangents on the list do to their sliding accelerations, and, into `force`, the sliding
   !> accelerations that the forces are to give them. Accelerations are those of unit forces afterwards.
   subroutine find_mobilities(self, m, minimum, nothing, status)
      class(mechanism_t), intent(inout) :: self    !! the system, accelerations found
      integer, intent(in) :: m                     !! tangents on the list
      real(wp), intent(in) :: minimum                !! mobility taken as zero, of that of free bodies [1]
      real(wp), intent(out) :: nothing             !! sliding acceleration taken as zero [m/s^2]
      integer, intent(out) :: status               !! 0: found

      real(wp) :: decay   ! of a sliding velocity left over [1/s]
      integer :: c, d

      status = 0
      nothing = 0.0_wp
      associate (stick_slips => self%friction%stick_slips, n => self%linkage%rows%n_solve)
         do c = 1, m
            associate (at => stick_slips%at(c), law => self%clearance_joints%sets(stick_slips%at(c)%slot)%set%laws%friction, &
                       tangent => &
                       self%clearance_joints%sets(stick_slips%at(c)%slot)%set%stick_slip%tangent(stick_slips%at(c)%contact))
               stick_slips%root(c) = sqrt(max(law%stick_limit(tangent%f_n), tiny(1.0_wp)))
               if (at%axis == 1) decay = decay_rate(self, at%slot, at%contact)
               stick_slips%force(c) = -(sliding_acceleration(self, c, .true.) + tangent%drift(at%axis) + decay*tangent%v(at%axis))
               stick_slips%mobility(c) = mobility_of(self, c)
               nothing = nothing + abs(tangent%drift(at%axis)) + decay*abs(tangent%v(at%axis))
            end associate
         end do
         nothing = nothing + sqrt(minimum)*maxval(abs(stick_slips%force(:m)))
         stick_slips%load%b(:n) = self%linkage%solution%b(:n)
         self%linkage%solution%b(:n) = 0.0_wp
         do d = 1, m
            stick_slips%load%unit = 0.0_wp
            call add_pair(self, d, 1.0_wp, stick_slips%load%unit)
            call self%linkage%find_accelerations(stick_slips%load%unit, .false., .true., status)
            if (status /= 0) exit
            do c = 1, m
               stick_slips%matrix(c, d) = sliding_acceleration(self, c, .false.)
            end do
            stick_slips%is_fixed(d) = stick_slips%matrix(d, d) <= min_mobility*stick_slips%mobility(d)
         end do
         self%linkage%solution%b(:n) = stick_slips%load%b(:n)
      end associate
   end subroutine find_mobilities

   !> Rate at which the sliding velocity of a contact that sticks decays: within the time of the contact, for what is left of it, in
   !> space where slip ends at a speed of rest, in the plane of sliding that corners of one face do not hold, works on its force.
   real(wp) function decay_rate(self, slot, k) result(decay)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot              !! set of the contact
      integer, intent(in) :: k                 !! contact of the set

      real(wp) :: delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact), time

      decay = settling*self%linkage%scales%pace
      associate (set => self%clearance_joints%sets(slot)%set)
         call set%gaps(self%linkage%motion, delta, rate)
         time = own_time(self, slot, k, delta(set%before%contacts + k))
         if (time*decay < 1.0_wp .and. time > 0.0_wp) decay = 1.0_wp/time
      end associate
   end function decay_rate

   !> Reciprocal of the angular frequency of a contact, sqrt(delta/(F_N sum of 1/m)); 0 without a penetration or force.
   pure real(wp) function own_time(self, slot, k, delta) result(time)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: k                     !! contact of the set
      real(wp), intent(in) :: delta                !! its penetration [m]

      real(wp) :: compliance
      integer :: item

      associate (set => self%clearance_joints%sets(slot)%set)
         item = set%item_of(k)
         compliance = sum(self%linkage%inverse_mass(1, set%items%body(:, item)))*set%stick_slip%tangent(k)%f_n
      end associate
      time = 0.0_wp
      if (compliance > 0.0_wp .and. delta > 0.0_wp) time = sqrt(delta/compliance)
   end function own_time

   !> Mobility taken as zero, of that of free bodies. A contact acts anywhere within its penetration: no friction force holds a
   !> combination of tangents that moves only as the bodies turn about that lever, as corners of one face have.
   real(wp) function mobility_of_depth(self, m) result(minimum)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: m                 !! tangents on the list

      real(wp) :: delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact), turned
      integer :: body, c, side

      minimum = min_mobility
      do c = 1, m
         associate (at => self%friction%stick_slips%at(c))
            associate (set => self%clearance_joints%sets(at%slot)%set)
               if (m == 1 .or. at%axis < set%stick_slip%n_tangent) cycle
               call set%gaps(self%linkage%motion, delta, rate)
               turned = 0.0_wp
               do side = 1, 2
                  body = set%items%body(side, set%item_of(at%contact))
                  turned = turned + maxval(self%linkage%inverse_mass(:, body), self%linkage%coordinates%is_turn)
               end do
               minimum = max(minimum, (contact_lever*delta(set%before%contacts + at%contact))**2*turned &
                                  /max(mobility_of(self, c), tiny(1.0_wp)))
            end associate
         end associate
      end do
   end function mobility_of_depth

   !> Speed of the mechanism, which says what sliding is slow.
   pure real(wp) function own_speed(self) result(speed)
      class(mechanism_t), intent(in) :: self   !! the system

      speed = self%linkage%scales%pace*self%linkage%scales%length
   end function own_speed

   !> In space: what the tolerance leaves of a speed.
   pure real(wp) function resolved_speed(self) result(speed)
      class(mechanism_t), intent(in) :: self   !! the system

      speed = max(standstill, captured*self%linkage%scales%tolerance)*own_speed(self)
   end function resolved_speed

   !> Speed of rest: a contact may stick below it. In space also what the tolerance leaves of a speed, for nearer to
   !> rest the direction of sliding turns faster than steps can follow; and the speed of the turning bodies within the penetration,
   !> for the contact acts anywhere there.
   real(wp) function rest_speed(self, slot, k) result(speed)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot              !! set of the contact
      integer, intent(in) :: k                 !! contact of the set

      real(wp) :: delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact), turning(3)
      integer :: item

      speed = at_rest*own_speed(self)
      associate (set => self%clearance_joints%sets(slot)%set, motion => self%linkage%motion)
         if (set%stick_slip%n_tangent == 1) return
         call set%gaps(motion, delta, rate)
         item = set%item_of(k)
         turning = motion%omega(:, set%items%body(2, item)) - motion%omega(:, set%items%body(1, item))
         speed = 2.0_wp*min(max(resolved_speed(self), 0.5_wp*contact_lever*delta(set%before%contacts + k)*norm2(turning)), &
                            widest_band*own_speed(self))
      end associate
   end function rest_speed

   !> Sliding velocity at which slip ends, without a chatter.
   real(wp) function end_speed(self, slot, k) result(speed)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot              !! set of the contact
      integer, intent(in) :: k                 !! contact of the set

      if (self%clearance_joints%sets(slot)%set%stick_slip%n_tangent == 1) then
         speed = standstill*own_speed(self)
      else
         speed = 0.5_wp*rest_speed(self, slot, k)
      end if
   end function end_speed

   !> Length of a vector of the tangents.
   pure real(wp) function size_of(x)
      real(wp), intent(in) :: x(2)   !! (2) the vector [any]

      size_of = hypot(x(1), x(2))
   end function size_of

   !> Keep the force that was found along a tangent on the list with its contact. Drivers prescribe how it slides where no force
   !> moves it along any tangent, or where they accelerate it along one. Where contacts hold the same two bodies, as both ends of a
   !> pin do, a combination of their tangents is hardly moved by any force either: what is left of it is the sliding that has
   !> gathered, what turning tangents make of it, and the root of the mobility taken as zero, of the acceleration asked for;
   !> that is no driver's doing.
   subroutine keep_force(self, c, nothing)
      class(mechanism_t), intent(inout) :: self    !! the system, forces found
      integer, intent(in) :: c                     !! place on the list of contacts that stick
      real(wp), intent(in) :: nothing              !! what may be left without a driver [m/s^2]

      real(wp) :: force(2)
      logical :: is_driven
      integer :: first

      associate (stick_slips => self%friction%stick_slips, &
                 set => self%clearance_joints%sets(self%friction%stick_slips%at(c)%slot)%set, &
                 k => self%friction%stick_slips%at(c)%contact)
         associate (tangent => set%stick_slip%tangent(k))
            first = c - stick_slips%at(c)%axis + 1
            is_driven = all(stick_slips%is_fixed(first:first + set%stick_slip%n_tangent - 1)) &
                        .or. any(abs(stick_slips%left(first:c)) > nothing &
                                 + no_acceleration*stick_slips%mobility(first:c)*tangent%f_n)
            force = tangent%f_t
            force(stick_slips%at(c)%axis) = force(stick_slips%at(c)%axis) + stick_slips%force(c)
            call set%stick_with(k, force, is_driven)
            self%clearance_joints%integrands(loss_friction, set%before%contacts + k) = -dot_product(tangent%f_t, tangent%v)
         end associate
      end associate
   end subroutine keep_force

   !> Part of the rate of the sliding velocity of a contact on the list that comes from the accelerations.
   pure real(wp) function sliding_acceleration(self, c, with_prescribed) result(a)
      class(mechanism_t), intent(in) :: self   !! the system, accelerations found
      integer, intent(in) :: c                     !! place on the list of contacts that stick
      logical, intent(in) :: with_prescribed            !! with those of bodies whose motion is known

      associate (at => self%friction%stick_slips%at(c))
         a = tangential(self, at%slot, at%contact, at%axis, with_prescribed)
      end associate
   end function sliding_acceleration

   !> The same for any contact.
   pure real(wp) function tangential(self, slot, k, axis, with_prescribed) result(a)
      class(mechanism_t), intent(in) :: self   !! the system, accelerations found
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: k                     !! contact of the set
      integer, intent(in) :: axis                  !! tangent of the contact
      logical, intent(in) :: with_prescribed            !! with those of bodies whose motion is known

      real(wp) :: acceleration(most_rates), row(most_rates)
      integer :: body, side

      a = 0.0_wp
      associate (set => self%clearance_joints%sets(slot)%set, linkage => self%linkage)
         do side = 1, 2
            body = set%items%body(side, set%item_of(k))
            if (body == 0) cycle
            call sliding_row(self, slot, k, axis, side, row)
            if (.not. linkage%reduced%is_known(body)) then
               a = a + dot_product(row(:linkage%coordinates%n_v), linkage%solution%a(:, body))
            else if (with_prescribed) then
               call linkage%coordinates%find_acceleration(linkage%motion, body, acceleration)
               a = a + dot_product(row(:linkage%coordinates%n_v), acceleration(:linkage%coordinates%n_v))
            end if
         end do
      end associate
   end function tangential

   !> What a unit force would do to the sliding acceleration of a contact on the list if the bodies were free.
   pure real(wp) function mobility_of(self, c) result(mobility)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: c                     !! place on the list of contacts that stick

      real(wp) :: row(most_rates)
      integer :: body, side

      mobility = 0.0_wp
      associate (slot => self%friction%stick_slips%at(c)%slot, k => self%friction%stick_slips%at(c)%contact)
         associate (set => self%clearance_joints%sets(slot)%set)
            do side = 1, 2
               body = set%items%body(side, set%item_of(k))
               call sliding_row(self, slot, k, self%friction%stick_slips%at(c)%axis, side, row)
               mobility = mobility + sum(self%linkage%inverse_mass(:, body)*row(:self%linkage%coordinates%n_v)**2)
            end do
         end associate
      end associate
   end function mobility_of

   !> Add the pair of tangential forces of a contact on the list to loads on the rates.
   pure subroutine add_pair(self, c, force, g)
      class(mechanism_t), intent(in) :: self       !! the system
      integer, intent(in) :: c                     !! place on the list of contacts that stick
      real(wp), intent(in) :: force                !! on body j along t [N]
      real(wp), intent(inout) :: g(:, 0:)          !! (n_v, 0:bodies) loads [N or N.m]

      real(wp) :: row(most_rates)
      integer :: body, side

      associate (slot => self%friction%stick_slips%at(c)%slot, k => self%friction%stick_slips%at(c)%contact)
         associate (set => self%clearance_joints%sets(slot)%set)
            do side = 1, 2
               body = set%items%body(side, set%item_of(k))
               call sliding_row(self, slot, k, self%friction%stick_slips%at(c)%axis, side, row)
               g(:, body) = g(:, body) + force*row(:size(g, 1))
            end do
         end associate
      end associate
   end subroutine add_pair

   !> What the rates of one of its bodies add to the sliding velocity of a contact, of j relative to i.
   pure subroutine sliding_row(self, slot, k, axis, side, row)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: k                     !! contact of the set
      integer, intent(in) :: axis                  !! tangent of the contact
      integer, intent(in) :: side                  !! 1: body i, 2: body j
      real(wp), intent(out) :: row(most_rates)     !! (most_rates) the row, its first n_v entries [1 or m]

      integer :: body

      body = self%clearance_joints%sets(slot)%set%items%body(side, self%clearance_joints%sets(slot)%set%item_of(k))
      associate (tangent => self%clearance_joints%sets(slot)%set%stick_slip%tangent(k), coordinates => self%linkage%coordinates, &
                 motion => self%linkage%motion)
         if (side == 1) then
            call coordinates%along(tangent%t(:, axis), tangent%arm_i, motion, body, row(:coordinates%n_v))
            row(:coordinates%n_v) = -row(:coordinates%n_v)
         else
            call coordinates%along(tangent%t(:, axis), tangent%arm_j, motion, body, row(:coordinates%n_v))
         end if
      end associate
   end subroutine sliding_row

end submodule mechanism_friction
