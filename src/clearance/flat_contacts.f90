!> Contacts of points of body j with planes fixed in body i: what the geometries with flat surfaces share.
!>
!> Contact m: A is a point of j, or the centre of a circle of radius R; P is a point of i, n the unit normal of a plane of i,
!> into its material, h its distance from P along n:
!> d = r_A - r_P,   delta = n . d - h   (h less R of a circle),   rate = n . (v_A - v_i(A)) = d(delta)/dt
!> delta'' = n . (a_A - a_P) + 2 w_i t . (v_A - v_P) + d . (alpha_i t - w_i^2 n),   t = R90 n
!> force on j: f_j = -F_N n + F_T t,  F_T against v_T = t . (v_j(C) - v_i(C));   on i: -f_j; both act at C.
!>
!> C is the point A itself, or, of a circle, the middle between the two surfaces, A + (R - delta/2) n.
!>
!> Source: Flores et al. (2008), section 4.3, corrected: signed penetration instead of (4.20), velocities of material points
!> instead of (4.21), one common point of application instead of two. Limits: planes without ends, unless the geometry says.
module flat_contacts
   use catalogue, only: state_contact, state_free
   use clearance_set, only: clearance_set_t, loss_contact, loss_friction
   use contact_grip, only: tangent_t
   use friction_law, only: memory_none
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   implicit none (type, external)
   private
   public :: add_contact_channels, flat_contacts_t, flat_gaps, flat_report, flat_t, flat_work_t

   integer, parameter :: most_sharing = 8  !! contacts of an item that may share faces

   !> Kinematics of one contact.
   type :: flat_t
      real(wp) :: normal(2) = 0.0_wp        !! (2) unit vector into the body of the plane, world frame [1]
      real(wp) :: delta = 0.0_wp            !! penetration [m]
      real(wp) :: rate = 0.0_wp             !! penetration rate [m/s]
      real(wp) :: v_t = 0.0_wp              !! sliding velocity of j along t at C [m/s]
      real(wp) :: arm_i(2) = 0.0_wp         !! (2) C from the centre of mass of i [m]
      real(wp) :: arm_j(2) = 0.0_wp         !! (2) C from the centre of mass of j [m]
   end type flat_t

   !> What an evaluation finds of all contacts of a set.
   type :: flat_work_t
      type(flat_t), allocatable :: kinematics(:)       !! (n_contact) kinematics
      real(wp), allocatable :: delta(:)                !! (n_contact) penetration [m]
      real(wp), allocatable :: rate(:)                 !! (n_contact) its rate [m/s]
      real(wp), allocatable :: impact_speed(:)         !! (n_contact) impact speed [m/s]
      real(wp), allocatable :: speed(:)                !! (n_contact) magnitude of the sliding velocity [m/s]
      real(wp), allocatable :: f_n(:)                  !! (n_contact) normal force [N]
      real(wp), allocatable :: f_elastic(:)            !! (n_contact) derivative of the stored energy by the penetration [N]
      real(wp), allocatable :: df_ddelta(:)            !! (n_contact) derivative of the normal force by penetration [N/m]
      real(wp), allocatable :: df_drate(:)             !! (n_contact) derivative of the normal force by rate [N.s/m]
      real(wp), allocatable :: f_rub(:)                !! (n_contact) normal force that friction feels [N]
      real(wp), allocatable :: f_t(:)                  !! (n_contact) friction force on j along t [N]
   end type flat_work_t

   !> Points or circles against planes. `prepare` of a geometry calls `make_room` and fills the parameters.
   type, abstract, extends(clearance_set_t) :: flat_contacts_t
      real(wp), allocatable :: normal_i(:, :)          !! (2, n_contact) normal of the plane, frame of i [1]
      real(wp), allocatable :: point_j(:, :)           !! (2, n_contact) the point A, frame of j [m]
      real(wp), allocatable :: height(:)               !! (n_contact) h: plane from P along the normal, less the radius [m]
      real(wp), allocatable :: radius(:)               !! (n_contact) radius of the circle, 0: a point [m]
      type(flat_work_t), allocatable :: work           !! scratch of one evaluation
   contains
      procedure :: make_room
      procedure :: find_forces
      procedure :: find_normal_forces
      procedure :: measure
      procedure :: span_of => flat_span_of
      procedure :: share_faces => flat_share_faces
      procedure :: face_energy => flat_face_energy
      procedure :: evaluate => flat_evaluate
      procedure :: gaps => flat_gaps
      procedure :: watch => flat_watch
      procedure :: lie => flat_lie
      procedure :: report => flat_report
      procedure :: elastic_energy => flat_elastic_energy
   end type flat_contacts_t

contains

   !> The channels of the contacts.
   subroutine add_contact_channels(info, who)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: who           !! what has the friction force, as "slider"

      call add_channel(info, "penetration", "m", "none", 1, "penetration of the surfaces, 0 when apart")
      call add_channel(info, "penetration_rate", "m/s", "none", 1, "rate of the penetration, positive when approaching")
      call add_channel(info, "normal_force", "N", "none", 1, "normal contact force")
      call add_channel(info, "friction_force", "N", "none", 1, "friction force on the "//who//" along t = R90 n")
      call add_channel(info, "state", "1", "none", 1, "0 free, 1 contact, 2 film, 3 mixed")
   end subroutine add_contact_channels

   !> Room for the parameters and the scratch.
   subroutine make_room(self)
      class(flat_contacts_t), intent(inout) :: self  !! the set

      integer :: m

      m = self%n_contact
      allocate (self%normal_i(2, m), self%point_j(2, m), self%height(m), self%radius(m), source=0.0_wp)
      allocate (self%work)
      call new_work(m, self%work)
   end subroutine make_room

   !> Room for what an evaluation finds.
   subroutine new_work(m, work)
      integer, intent(in) :: m                !! contacts
      type(flat_work_t), intent(out) :: work  !! all zero

      allocate (work%kinematics(m))
      allocate (work%delta(m), work%rate(m), work%impact_speed(m), work%speed(m), work%f_n(m), work%f_elastic(m), &
                work%df_ddelta(m), work%df_drate(m), work%f_rub(m), work%f_t(m), source=0.0_wp)
   end subroutine new_work

   !> Normal, penetration, rate, arms and sliding velocity of a contact.
   pure subroutine measure(self, m, motion, contact)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                    !! contact
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(flat_t), intent(out) :: contact        !! kinematics

      real(wp) :: reach, s_i(2), s_j(2), v(2)
      integer :: i, item, j

      item = self%item_of(m)
      i = self%body(1, item)
      j = self%body(2, item)
      s_i = motion%rot(1:2, 1, i)*self%s_i(1, item) + motion%rot(1:2, 2, i)*self%s_i(2, item)
      s_j = motion%rot(1:2, 1, j)*self%point_j(1, m) + motion%rot(1:2, 2, j)*self%point_j(2, m)
      associate (n => contact%normal)
         n = motion%rot(1:2, 1, i)*self%normal_i(1, m) + motion%rot(1:2, 2, i)*self%normal_i(2, m)
         contact%delta = dot_product(n, motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i) - self%height(m)
         reach = 0.0_wp
         if (self%radius(m) > 0.0_wp) reach = self%radius(m) - 0.5_wp*contact%delta
         contact%arm_j = s_j + reach*n
         contact%arm_i = motion%r(1:2, j) - motion%r(1:2, i) + contact%arm_j
         v = motion%v(1:2, j) + motion%omega(3, j)*[-contact%arm_j(2), contact%arm_j(1)] &
             - motion%v(1:2, i) - motion%omega(3, i)*[-contact%arm_i(2), contact%arm_i(1)]
         contact%rate = dot_product(n, v)
         contact%v_t = n(1)*v(2) - n(2)*v(1)
      end associate
   end subroutine measure

   !> How far plane and point of a contact are from the centres of mass.
   pure function flat_span_of(self, contact) result(span)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact              !! contact of the set
      real(wp) :: span(2)                         !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%s_i(:, item))) + abs(self%height(contact)), sum(abs(self%point_j(:, contact)))]
      end associate
   end function flat_span_of

   !> Second derivative of a penetration by time.
   pure real(wp) function penetration_acceleration(self, m, motion, contact) result(acceleration)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                    !! contact
      type(motion_t), intent(in) :: motion        !! positions, velocities and accelerations
      type(flat_t), intent(in) :: contact         !! its kinematics

      real(wp) :: a(2), d(2), s_i(2), s_j(2), tangent(2), v(2)
      integer :: i, item, j

      item = self%item_of(m)
      i = self%body(1, item)
      j = self%body(2, item)
      s_i = motion%rot(1:2, 1, i)*self%s_i(1, item) + motion%rot(1:2, 2, i)*self%s_i(2, item)
      s_j = motion%rot(1:2, 1, j)*self%point_j(1, m) + motion%rot(1:2, 2, j)*self%point_j(2, m)
      tangent = [-contact%normal(2), contact%normal(1)]
      d = motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i
      v = motion%v(1:2, j) + motion%omega(3, j)*[-s_j(2), s_j(1)] - motion%v(1:2, i) - motion%omega(3, i)*[-s_i(2), s_i(1)]
      a = motion%a(1:2, j) + motion%alpha(3, j)*[-s_j(2), s_j(1)] - motion%omega(3, j)**2*s_j &
          - motion%a(1:2, i) - motion%alpha(3, i)*[-s_i(2), s_i(1)] + motion%omega(3, i)**2*s_i
      acceleration = dot_product(contact%normal, a) + 2.0_wp*motion%omega(3, i)*dot_product(tangent, v) &
                     + dot_product(d, motion%alpha(3, i)*tangent - motion%omega(3, i)**2*contact%normal)
   end function penetration_acceleration

   !> Forces of all contacts of a set at a motion: zero of those that are free.
   subroutine find_forces(self, motion, work)
      class(flat_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(flat_work_t), intent(inout) :: work    !! kinematics and forces are set

      integer :: m

      do m = 1, self%n_contact
         work%delta(m) = 0.0_wp
         work%rate(m) = 0.0_wp
         work%impact_speed(m) = 1.0_wp
         work%speed(m) = 0.0_wp
         if (.not. (self%contact(m)%is_touching .or. self%has_faces)) cycle
         call self%measure(m, motion, work%kinematics(m))
         if (.not. self%contact(m)%is_touching) cycle
         work%delta(m) = work%kinematics(m)%delta
         work%rate(m) = work%kinematics(m)%rate
         work%impact_speed(m) = self%contact(m)%impact_speed
         work%speed(m) = abs(work%kinematics(m)%v_t)
      end do
      call self%find_normal_forces(work)
      if (.not. allocated(self%friction)) return
      if (self%grip%memory /= memory_none) then
         work%f_t = self%grip%tangent%f_t  ! of the last evaluation: it is no function of the motion alone
         return
      end if
      call self%friction%force(self%n_contact, work%f_rub, work%speed, work%f_t)
      do m = 1, self%n_contact
         if (self%contact(m)%is_touching) work%f_t(m) = -sign(work%f_t(m), work%kinematics(m)%v_t)
      end do
   end subroutine find_forces

   !> Normal forces from penetrations and rates.
   subroutine find_normal_forces(self, work)
      class(flat_contacts_t), intent(in) :: self  !! the set
      type(flat_work_t), intent(inout) :: work    !! kinematics, penetrations and rates; normal forces are set

      integer :: first, item, last

      call self%press(1, self%n_contact, work%delta, work%rate, work%impact_speed, work%f_n, work%df_ddelta, work%df_drate, &
                      work%f_elastic)
      work%f_rub = work%f_n
      if (.not. self%has_faces) return
      do item = 1, self%n
         first = (item - 1)*self%n_contact_item + 1
         last = item*self%n_contact_item
         call self%share_faces(item, work%kinematics(first:last), work%f_n(first:last), work%f_elastic(first:last), &
                               work%f_rub(first:last))
      end do
   end subroutine find_normal_forces

   !> Add the contact forces of the touching contacts.
   subroutine flat_evaluate(self, motion, loads, losses)
      class(flat_contacts_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion           !! positions and velocities
      type(loads_t), intent(inout) :: loads          !! loads on the bodies
      real(wp), intent(inout), contiguous :: losses(:, :)  !! (2, all contacts) power lost [W]

      type(flat_work_t), allocatable :: work
      real(wp) :: f(2)
      integer :: i, item, j, m

      losses(:, self%first_contact + 1:self%first_contact + self%n_contact) = 0.0_wp
      if (self%n_touching == 0) return
      call move_alloc(self%work, work)
      call self%find_forces(motion, work)
      if (self%grip%memory /= memory_none) call self%rub(motion, work%f_rub, work%f_t, losses)
      do m = 1, self%n_contact
         if (.not. self%contact(m)%is_touching .and. work%f_n(m) <= 0.0_wp) cycle
         item = self%item_of(m)
         i = self%body(1, item)
         j = self%body(2, item)
         associate (contact => work%kinematics(m))
            f = force_of(work, m)
            losses(loss_contact, self%first_contact + m) = (work%f_n(m) - work%f_elastic(m))*contact%rate
            losses(loss_friction, self%first_contact + m) = -work%f_t(m)*contact%v_t
            loads%force(1:2, i) = loads%force(1:2, i) - f
            loads%force(1:2, j) = loads%force(1:2, j) + f
            loads%moment(3, i) = loads%moment(3, i) - (contact%arm_i(1)*f(2) - contact%arm_i(2)*f(1))
            loads%moment(3, j) = loads%moment(3, j) + (contact%arm_j(1)*f(2) - contact%arm_j(2)*f(1))
         end associate
      end do
      call move_alloc(work, self%work)
   end subroutine flat_evaluate

   !> Penetration and its rate for all contacts.
   subroutine flat_gaps(self, motion, delta, rate)
      class(flat_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(inout) :: delta(:)         !! (all contacts) penetration [m]
      real(wp), intent(inout) :: rate(:)          !! (all contacts) its rate [m/s]

      type(flat_t) :: contact
      integer :: m

      do m = 1, self%n_contact
         call self%measure(m, motion, contact)
         delta(self%first_contact + m) = contact%delta
         rate(self%first_contact + m) = contact%rate
      end do
   end subroutine flat_gaps

   !> How a contact lies. The normal turns with body i; the point of contact moves with the point A, and in a circle towards it
   !> by half the penetration.
   subroutine flat_lie(self, k, motion, tangent)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! contact
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(tangent_t), intent(inout) :: tangent   !! how it lies

      type(flat_t) :: contact
      real(wp) :: nearer, s_j(2), v(2)
      integer :: i, item, j

      item = self%item_of(k)
      i = self%body(1, item)
      j = self%body(2, item)
      call self%measure(k, motion, contact)
      s_j = motion%rot(1:2, 1, j)*self%point_j(1, k) + motion%rot(1:2, 2, j)*self%point_j(2, k)
      v = motion%omega(3, j)*[-s_j(2), s_j(1)]  ! of the point A, from the centre of mass
      nearer = merge(0.5_wp*contact%rate, 0.0_wp, self%radius(k) > 0.0_wp)
      tangent%t = [-contact%normal(2), contact%normal(1)]
      tangent%arm_i = contact%arm_i
      tangent%arm_j = contact%arm_j
      tangent%v = contact%v_t
      tangent%drift = -motion%omega(3, i)*contact%rate + motion%omega(3, j)*(dot_product(contact%normal, v) - nearer) &
                      - motion%omega(3, i)*(dot_product(contact%normal, motion%v(1:2, j) + v - motion%v(1:2, i)) - nearer)
   end subroutine flat_lie

   !> Normal force of a touching contact and its rate, F' = dF/ddelta delta' + dF/drate delta''. The rate of a contact that
   !> shares a face is that of the five-point formula over a small part of its own time.
   subroutine flat_watch(self, k, motion, delta, rate, force, force_rate)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! contact
      type(motion_t), intent(in) :: motion        !! positions, velocities and accelerations
      real(wp), intent(out) :: delta              !! penetration [m]
      real(wp), intent(out) :: rate               !! its rate [m/s]
      real(wp), intent(out) :: force              !! normal force [N]
      real(wp), intent(out) :: force_rate         !! its rate [N/s]

      type(flat_t) :: contact
      real(wp) :: elastic(1), f(1), slope_delta(1), slope_rate(1)

      call self%measure(k, motion, contact)
      delta = contact%delta
      rate = contact%rate
      force = 0.0_wp
      force_rate = 0.0_wp
      if (.not. self%contact(k)%is_touching) return
      if (self%has_faces) then
         call watch_face(self, k, motion, force, force_rate)
         return
      end if
      call self%press(k, k, [delta], [rate], [self%contact(k)%impact_speed], f, slope_delta, slope_rate, elastic)
      force = f(1)
      force_rate = slope_delta(1)*rate + slope_rate(1)*penetration_acceleration(self, k, motion, contact)
   end subroutine flat_watch

   !> Normal force of a contact that may share a face, and its rate.
   subroutine watch_face(self, k, motion, force, force_rate)
      class(flat_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! contact of the set
      type(motion_t), intent(in) :: motion        !! positions, velocities and accelerations
      real(wp), intent(out) :: force              !! normal force [N]
      real(wp), intent(out) :: force_rate         !! its rate [N/s]

      real(wp), parameter :: places(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp
      real(wp), parameter :: part = 1.0e-3_wp    ! of the time in which the penetration would be gone [1]
      type(flat_t) :: contacts(most_sharing), later(most_sharing)
      real(wp) :: acceleration(most_sharing), h
      integer :: c, first, item, place

      item = self%item_of(k)
      first = (item - 1)*self%n_contact_item
      do c = 1, self%n_contact_item
         call self%measure(first + c, motion, contacts(c))
         acceleration(c) = penetration_acceleration(self, first + c, motion, contacts(c))
      end do
      force = force_in_faces(self, item, contacts, k - first)
      associate (n => self%n_contact_item)  ! the others move too, and may be faster
         ! at the onset, of the last digit of the penetration
         h = max(abs(contacts(k - first)%delta), epsilon(1.0_wp)*(abs(self%height(k)) + norm2(contacts(k - first)%arm_i)))
         h = part*min(h/max(maxval(abs(contacts(:n)%rate)), tiny(1.0_wp)), sqrt(h/max(maxval(abs(acceleration(:n))), tiny(1.0_wp))))
      end associate
      force_rate = 0.0_wp
      do place = 1, size(places)
         do c = 1, self%n_contact_item
            associate (t => places(place)*h)
               later(c)%delta = contacts(c)%delta + t*(contacts(c)%rate + 0.5_wp*t*acceleration(c))
               later(c)%rate = contacts(c)%rate + t*acceleration(c)
            end associate
         end do
         force_rate = force_rate + weights(place)*force_in_faces(self, item, later, k - first)/h
      end do
   end subroutine watch_face

   !> Normal force of a contact of an item that may share a face.
   real(wp) function force_in_faces(self, item, contacts, c) result(force)
      class(flat_contacts_t), intent(in) :: self            !! the set
      integer, intent(in) :: item                           !! the item
      type(flat_t), intent(in) :: contacts(most_sharing)    !! (most_sharing) penetrations and rates of its contacts
      integer, intent(in) :: c                              !! contact of the item

      real(wp), dimension(most_sharing) :: delta, f_elastic, f_n, f_rub, impact_speed, rate, slope_delta, slope_rate
      integer :: first, n

      n = self%n_contact_item
      first = (item - 1)*n
      delta(:n) = merge(contacts(:n)%delta, 0.0_wp, self%contact(first + 1:first + n)%is_touching)
      rate(:n) = contacts(:n)%rate
      impact_speed(:n) = merge(self%contact(first + 1:first + n)%impact_speed, 1.0_wp, &
                               self%contact(first + 1:first + n)%is_touching)
      call self%press(first + 1, first + n, delta, rate, impact_speed, f_n, slope_delta, slope_rate, f_elastic)
      call self%share_faces(item, contacts(:n), f_n(:n), f_elastic(:n), f_rub(:n))
      force = f_n(c)
   end function force_in_faces

   !> Values of a channel of the contacts, and force on j and moment about its point for all items.
   subroutine flat_report(self, channel, motion, values)
      class(flat_contacts_t), intent(in) :: self  !! the set
      character(*), intent(in) :: channel         !! name of the channel
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(inout) :: values(:, :)     !! (components, all items or contacts) values [any]

      type(flat_work_t) :: work
      real(wp) :: arm(2), f(2)
      integer :: column, item, m

      call new_work(self%n_contact, work)
      if (self%n_touching > 0) call self%find_forces(motion, work)
      do m = 1, self%n_contact
         column = self%first_contact + m
         item = self%item_of(m)
         call self%measure(m, motion, work%kinematics(m))
         associate (contact => work%kinematics(m))
            select case (channel)
            case ("force")
               column = self%first + item
               if (modulo(m - 1, self%n_contact_item) == 0) values(:, column) = 0.0_wp
               values(:, column) = values(:, column) + force_of(work, m)
            case ("moment")
               column = self%first + item
               if (modulo(m - 1, self%n_contact_item) == 0) values(1, column) = 0.0_wp
               f = force_of(work, m)
               arm = contact%arm_j - matmul(motion%rot(1:2, 1:2, self%body(2, item)), self%s_j(1:2, item))
               values(1, column) = values(1, column) + arm(1)*f(2) - arm(2)*f(1)
            case ("penetration")
               values(1, column) = max(contact%delta, 0.0_wp)
            case ("penetration_rate")
               values(1, column) = merge(contact%rate, 0.0_wp, self%contact(m)%is_touching)
            case ("normal_force")
               values(1, column) = work%f_n(m)
            case ("friction_force")
               values(1, column) = work%f_t(m)
            case ("state")
               values(1, column) = real(merge(state_contact, state_free, self%contact(m)%is_touching), wp)
            end select
         end associate
      end do
   end subroutine flat_report

   !> Force on j of one contact.
   pure function force_of(work, m) result(f)
      type(flat_work_t), intent(in) :: work  !! kinematics and forces
      integer, intent(in) :: m               !! contact
      real(wp) :: f(2)                       !! (2) world frame [N]

      associate (n => work%kinematics(m)%normal)
         f(1) = -work%f_n(m)*n(1) - work%f_t(m)*n(2)
         f(2) = -work%f_n(m)*n(2) + work%f_t(m)*n(1)
      end associate
   end function force_of

   !> Elastic energy that the touching contacts store.
   function flat_elastic_energy(self, motion) result(energy)
      class(flat_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion        !! positions
      real(wp) :: energy                          !! energy stored [J]

      type(flat_t) :: contact, contacts(most_sharing)
      integer :: c, item, m

      energy = 0.0_wp
      if (self%has_faces) then
         do item = 1, self%n
            do c = 1, self%n_contact_item
               call self%measure((item - 1)*self%n_contact_item + c, motion, contacts(c))
            end do
            energy = energy + self%face_energy(item, contacts(:self%n_contact_item))
         end do
         return
      end if
      do m = 1, self%n_contact
         if (.not. self%contact(m)%is_touching) cycle
         call self%measure(m, motion, contact)
         energy = energy + self%law%potential(contact%delta, self%parameters(:, m))
      end do
   end function flat_elastic_energy

   !> Let faces of an item take over from its contacts: a geometry without faces leaves the forces as they are.
   subroutine flat_share_faces(self, item, contacts, f_n, f_elastic, f_rub)
      class(flat_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: item                  !! the item
      type(flat_t), intent(in) :: contacts(:)      !! (n_contact_item) penetrations and rates of its contacts
      real(wp), intent(inout) :: f_n(:)            !! (n_contact_item) normal forces, as the normal law gives them [N]
      real(wp), intent(inout) :: f_elastic(:)      !! (n_contact_item) derivatives of the stored energy by the penetrations [N]
      real(wp), intent(inout) :: f_rub(:)          !! (n_contact_item) normal forces that friction feels [N]

      f_rub = f_n
   end subroutine flat_share_faces

   !> Elastic energy of an item with faces: a geometry without faces has none.
   function flat_face_energy(self, item, contacts) result(energy)
      class(flat_contacts_t), intent(in) :: self   !! the set
      integer, intent(in) :: item                  !! the item
      type(flat_t), intent(in) :: contacts(:)      !! (n_contact_item) penetrations and rates of its contacts
      real(wp) :: energy                           !! energy stored [J]

      energy = 0.0_wp
   end function flat_face_energy

end module flat_contacts
