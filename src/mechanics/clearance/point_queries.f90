!> What reports ask of contacts at points: forces, loads on bodies, channels.
submodule(point_contacts) point_queries
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use film_law, only: film_motion_t
   use film_places, only: film_state_t
   use motion, only: cross
   use kinds, only: not_a_number
   use normal_law, only: n_law_parameter, normal_law_t
   use states_of_contacts, only: state_contact, state_free
   use surfaces, only: shape_internal, surfaces_t
   implicit none (type, external)

contains

   include "press.inc"

   !> Normal forces of the contacts of an item, zero of those that are free.
   module procedure point_press
      real(wp), dimension(most_of_item) :: delta, impact_speed, rate, slope_delta, slope_rate
      integer :: first, last

      first = (item - 1)*self%n_contact_item + 1
      last = item*self%n_contact_item
      call press(self%n_contact_item, self%laws%normal, self%contact(first:last), self%laws%parameters(:, first:last), contacts, &
                 delta, rate, &
                 impact_speed, f_n, slope_delta, slope_rate, f_elastic)
   end procedure point_press

   !> Values that are read: those of the contacts and the force on j here, others as the geometry has them.
   module procedure point_report
      type(point_contact_t) :: contacts(1)

      if (self%n_contact_item == 1) then  ! nothing is made ready for sixteen
         call report_items(self, readings, motion, 1, contacts, values)
      else
         call report_several(self, readings, motion, values)
      end if
   end procedure point_report

   !> Items of several contacts.
   subroutine report_several(self, readings, motion, values)
      class(point_contacts_t), intent(in) :: self       !! the set
      type(readings_t), intent(in) :: readings          !! channels that are read
      type(motion_t), intent(in) :: motion              !! positions and velocities
      real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]

      type(point_contact_t) :: contacts(most_of_item)

      call report_items(self, readings, motion, self%n_contact_item, contacts, values)
   end subroutine report_several

   !> All items. The contact of an item that has one is reported from where the evaluation found it.
   subroutine report_items(self, readings, motion, n, contacts, values)
      class(point_contacts_t), intent(in) :: self           !! the set
      type(readings_t), intent(in) :: readings              !! channels that are read
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      integer, intent(in) :: n                              !! contacts of an item
      type(point_contact_t), intent(inout) :: contacts(n)   !! (n) scratch
      real(wp), intent(inout), contiguous :: values(:)      !! (any) of the catalogue, those that are read are set [any]

      real(wp) :: f_elastic(most_of_item), f_n(most_of_item), f_t(most_of_item)
      integer :: item
      logical :: takes_over

      takes_over = is_evaluated(self, readings, motion)
      do item = 1, self%n
         if (n == 1 .and. takes_over .and. (self%contact(item)%is_touching .or. self%laws%normal%acts_apart)) then
            associate (work => self%work)
               call report_item(self, readings, motion, item, 1, work%contacts(item), work%f_n(item), work%f_t(item), &
                                work%f_elastic(item), values)
            end associate
         else
            call find_item(self, readings, takes_over, item, n, motion, contacts, f_n, f_t, f_elastic)
            call report_item(self, readings, motion, item, n, contacts, f_n, f_t, f_elastic, values)
         end if
      end do
   end subroutine report_items

   !> Whether the last evaluation found what is read of contacts at this motion. Not for friction that contacts remember: it may be
   !> found with the accelerations.
   pure logical function is_evaluated(self, readings, motion)
      class(point_contacts_t), intent(in) :: self  !! the set
      type(readings_t), intent(in) :: readings     !! channels that are read
      type(motion_t), intent(in) :: motion         !! positions and velocities

      is_evaluated = self%evaluated_at == motion%number .and. motion%number > 0 .and. self%stick_slip%memory == memory_none
      if (readings%most >= of_sliding_speed .and. .not. allocated(self%laws%friction)) is_evaluated = .false.
   end function is_evaluated

   !> Kinematics and forces of the contacts of an item, if something that is read needs them.
   subroutine find_item(self, readings, takes_over, item, n, motion, contacts, f_n, f_t, f_elastic)
      class(point_contacts_t), intent(in) :: self           !! the set
      type(readings_t), intent(in) :: readings              !! channels that are read
      logical, intent(in) :: takes_over                     !! as the last evaluation found them
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: n                              !! contacts of an item
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(point_contact_t), intent(inout) :: contacts(n)   !! (n) kinematics
      real(wp), intent(out) :: f_n(n)                       !! (n) normal forces [N]
      real(wp), intent(out) :: f_t(n)                       !! (n) friction forces on j along t [N]
      real(wp), intent(out) :: f_elastic(n)                 !! (n) elastic parts of the normal forces [N]

      associate (code => readings%of(:readings%n)%code)
         if (.not. any(code <= of_state .or. code == of_contact_point .or. code == of_moment .or. code >= of_contact_angle)) return
      end associate
      if (takes_over) then
         call take_evaluated(self, (item - 1)*n, n, motion, contacts, f_n, f_t, f_elastic)
      else
         call find_forces(self, item, n, motion, contacts, f_n, f_t, f_elastic, readings%most >= of_sliding_speed)
      end if
   end subroutine find_item

   !> Values of an item.
   subroutine report_item(self, readings, motion, item, n, contacts, f_n, f_t, f_elastic, values)
      class(point_contacts_t), intent(in) :: self           !! the set
      type(readings_t), intent(in) :: readings              !! channels that are read
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: n                              !! contacts of an item
      type(point_contact_t), intent(in) :: contacts(n)      !! (n) kinematics
      real(wp), intent(in) :: f_n(n)                        !! (n) normal forces [N]
      real(wp), intent(in) :: f_t(n)                        !! (n) friction forces on j along t [N]
      real(wp), intent(in) :: f_elastic(n)                  !! (n) elastic parts of the normal forces [N]
      real(wp), intent(inout), contiguous :: values(:)      !! (any) of the catalogue, those that are read are set [any]

      real(wp) :: depth, rate
      integer :: at, c, code, column, first, m, width

      first = (item - 1)*n
      column = self%before%contacts + first
      do m = 1, readings%n
         code = readings%of(m)%code
         if (code >= of_penetration .and. code <= of_state) then
            at = readings%of(m)%place + column
            do c = 1, n
               values(at + c) = value_of_contact(code, self%contact(first + c)%is_touching, contacts(c)%delta, &
                                                 contacts(c)%rate, f_n(c), f_t(c))
               if (code /= of_penetration .or. self%contact(first + c)%is_touching .or. contacts(c)%delta <= 0.0_wp) cycle
               depth = contacts(c)%delta
               rate = contacts(c)%rate
               call self%cut_at_ends(first + c, motion, contacts(c), depth, rate)  ! beyond its end a surface is not there
               values(at + c) = max(0.0_wp, depth)
            end do
         else if (code == of_contact_point .or. code >= of_contact_angle) then
            width = readings%of(m)%width
            at = readings%of(m)%place + width*column
            call report_course(self, code, item, n, motion, contacts, f_n, f_t, f_elastic, width, values(at + 1:at + width*n))
         else
            width = readings%of(m)%width
            at = readings%of(m)%place + width*(self%before%items + item - 1)
            if (code == of_force) then
               call report_force(self, n, contacts, f_n, f_t, width, values(at + 1:at + width))
            else
               call self%report_item(code, item, motion, contacts, f_n, f_t, values(at + 1:at + width))
            end if
         end if
      end do
   end subroutine report_item

   !> Where the contacts of an item are, or how they rub: values of a channel.
   subroutine report_course(self, code, item, n, motion, contacts, f_n, f_t, f_elastic, width, values)
      class(point_contacts_t), intent(in) :: self           !! the set
      integer, intent(in) :: code                           !! the channel
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: n                              !! contacts
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(n)      !! (n) their kinematics
      real(wp), intent(in) :: f_n(n)                        !! (n) normal forces [N]
      real(wp), intent(in) :: f_t(n)                        !! (n) friction forces on j along t [N]
      real(wp), intent(in) :: f_elastic(n)                  !! (n) elastic parts of the normal forces [N]
      integer, intent(in) :: width                          !! components of the channel
      real(wp), intent(inout) :: values(width*n)            !! (width n) values [any]

      integer :: first

      first = (item - 1)*n
      if (code == of_contact_point) then
         call report_points(motion%r(:, self%items%body(2, item)), n, contacts, width, values)
      else
         call report_rubbing(code, n, self%contact(first + 1:first + n), contacts, f_n, f_t, f_elastic, &
                             self%items%pairs(item), motion%rot(:, :, self%items%body(1, item)), values)
      end if
   end subroutine report_course

   !> Force of the contacts of an item on its body j, and their moment about its centre of mass.
   module procedure point_load_on_j
      type(point_contact_t) :: contacts(most_of_item)
      real(wp) :: f(3), f_elastic(most_of_item), f_n(most_of_item), f_t(most_of_item)
      integer :: c, n

      n = self%n_contact_item
      call find_forces(self, item, n, motion, contacts, f_n, f_t, f_elastic, .false.)
      force = 0.0_wp
      moment = 0.0_wp
      do c = 1, n
         if (.not. (f_n(c) > 0.0_wp .or. abs(f_t(c)) > 0.0_wp)) cycle
         f = self%force_on_j(contacts(c), f_n(c), f_t(c))
         force = force + f
         moment = moment + cross(contacts(c)%arm_j, f)
      end do
      if (allocated(self%laws%films)) call add_film(self, item, motion, force, moment)
   end procedure point_load_on_j

   !> Add what the film of an item does to its body j, force and moment about the centre of mass.
   subroutine add_film(self, item, motion, force, moment)
      class(point_contacts_t), intent(in) :: self   !! the set, with films
      integer, intent(in) :: item                   !! the item
      type(motion_t), intent(in) :: motion          !! positions and velocities
      real(wp), intent(inout) :: force(3)           !! (3) world frame [N]
      real(wp), intent(inout) :: moment(3)          !! (3) world frame [N.m]

      type(film_motion_t) :: film
      type(film_state_t) :: state
      real(wp) :: couple(3), f(3)

      associate (body => self%items%body(:, item), s_j => self%items%s_j(:, item))
         film = self%laws%films%motion_of(item, body, self%items%s_i(:, item), s_j, motion)
         state = self%laws%films%state_of(item, body, film, motion)
         if (allocated(motion%spatial%own)) then
            f = state%load
            couple = state%moment
         else
            f = [state%force, 0.0_wp]
            couple = [0.0_wp, 0.0_wp, state%torque]
         end if
         force = force + f
         moment = moment + couple + cross(matmul(motion%rot(:, :, body(2)), s_j), f)
      end associate
   end subroutine add_film

   !> Value of a channel of a contact.
   pure real(wp) function value_of_contact(code, is_touching, delta, rate, f_n, f_t) result(value)
      integer, intent(in) :: code           !! the channel
      logical, intent(in) :: is_touching    !! its state
      real(wp), intent(in) :: delta         !! penetration, negative: apart [m]
      real(wp), intent(in) :: rate          !! its rate [m/s]
      real(wp), intent(in) :: f_n           !! normal force [N]
      real(wp), intent(in) :: f_t           !! friction force on j along t [N]

      select case (code)
      case (of_penetration)
         value = max(delta, 0.0_wp)
      case (of_penetration_rate)
         value = merge(rate, 0.0_wp, is_touching)
      case (of_normal_force)
         value = f_n
      case (of_friction_force)
         value = f_t
      case default  ! its state
         value = real(merge(state_contact, state_free, is_touching), wp)
      end select
   end function value_of_contact

   !> How the contacts of an item rub: values of a channel.
   pure subroutine report_rubbing(code, n, memory, contacts, f_n, f_t, f_elastic, pair, rot, values)
      integer, intent(in) :: code                           !! the channel
      integer, intent(in) :: n                              !! contacts
      type(contact_memory_t), intent(in) :: memory(n)       !! (n) their states
      type(point_contact_t), intent(in) :: contacts(n)      !! (n) their kinematics
      real(wp), intent(in) :: f_n(n)                        !! (n) normal forces [N]
      real(wp), intent(in) :: f_t(n)                        !! (n) friction forces on j along t [N]
      real(wp), intent(in) :: f_elastic(n)                  !! (n) elastic parts of the normal forces [N]
      type(surfaces_t), intent(in) :: pair                  !! the surfaces
      real(wp), intent(in) :: rot(3, 3)                     !! (3, 3) frame of the body of i to the world's [1]
      real(wp), intent(inout) :: values(:)                  !! (n) values [any]

      real(wp) :: along(3), sliding
      integer :: c

      do c = 1, n
         sliding = merge(abs(contacts(c)%v_t), 0.0_wp, memory(c)%is_touching)
         select case (code)
         case (of_contact_angle)
            along = matmul(contacts(c)%normal, rot)
            values(c) = atan2(along(2), along(1))
         case (of_sliding_speed)
            values(c) = sliding
         case (of_contact_power)
            values(c) = (f_n(c) - f_elastic(c))*contacts(c)%rate - f_t(c)*contacts(c)%v_t_work
            if (.not. memory(c)%is_touching) values(c) = 0.0_wp
         case (of_p_v)
            values(c) = not_a_number()
            if (pair%shape == shape_internal .and. pair%length > 0.0_wp) then
               values(c) = f_n(c)/(2.0_wp*pair%radius_j*pair%length)*sliding
            end if
         end select
      end do
   end subroutine report_rubbing

   !> Where the forces on j act.
   pure subroutine report_points(r_j, n, contacts, n_axis, values)
      real(wp), intent(in) :: r_j(3)                        !! (3) centre of mass of j, world frame [m]
      integer, intent(in) :: n                              !! contacts
      type(point_contact_t), intent(in) :: contacts(n)      !! (n) their kinematics
      integer, intent(in) :: n_axis                         !! components of a vector
      real(wp), intent(inout) :: values(n_axis, n)          !! (2 or 3, n) the points, world frame [m]

      integer :: c

      do c = 1, n
         values(:, c) = r_j(:n_axis) + contacts(c)%arm_j(:n_axis)
      end do
   end subroutine report_points

   !> Force of all contacts of an item on j.
   pure subroutine report_force(self, n, contacts, f_n, f_t, n_axis, value)
      class(point_contacts_t), intent(in) :: self           !! the set
      integer, intent(in) :: n                              !! contacts
      type(point_contact_t), intent(in) :: contacts(n)      !! (n) their kinematics
      real(wp), intent(in) :: f_n(n)                        !! (n) normal forces [N]
      real(wp), intent(in) :: f_t(n)                        !! (n) friction forces on j along t [N]
      integer, intent(in) :: n_axis                         !! components of a vector
      real(wp), intent(inout) :: value(n_axis)              !! (2 or 3) the force, world frame [N]

      real(wp) :: force(3)
      integer :: c

      force = 0.0_wp
      do c = 1, n
         if (.not. (f_n(c) > 0.0_wp .or. abs(f_t(c)) > 0.0_wp)) cycle
         force = force + self%force_on_j(contacts(c), f_n(c), f_t(c))
      end do
      do c = 1, n_axis
         value(c) = force(c)
      end do
   end subroutine report_force

   !> Kinematics and forces of the contacts of an item as the last evaluation found them, at this motion: sliding velocities where
   !> there is friction.
   subroutine take_evaluated(self, first, n, motion, contacts, f_n, f_t, f_elastic)
      class(point_contacts_t), intent(in) :: self           !! the set, evaluated
      integer, intent(in) :: first                          !! contacts before those of the item
      integer, intent(in) :: n                              !! contacts of an item
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(point_contact_t), intent(inout) :: contacts(n)   !! (n) kinematics
      real(wp), intent(out) :: f_n(n)                       !! (n) normal forces [N]
      real(wp), intent(out) :: f_t(n)                       !! (n) friction forces on j along t [N]
      real(wp), intent(out) :: f_elastic(n)                 !! (n) elastic parts of the normal forces [N]

      integer :: c
      logical :: acts, acts_apart

      acts_apart = self%laws%normal%acts_apart
      acts = self%n_touching > 0 .or. acts_apart
      do c = 1, n
         if (self%contact(first + c)%is_touching .or. acts_apart) then
            contacts(c) = self%work%contacts(first + c)
         else
            call self%measure(first + c, allocated(self%laws%friction), motion, contacts(c))
         end if
         f_n(c) = 0.0_wp
         f_t(c) = 0.0_wp
         f_elastic(c) = 0.0_wp
         if (.not. acts) cycle
         f_n(c) = self%work%f_n(first + c)
         f_t(c) = self%work%f_t(first + c)
         f_elastic(c) = self%work%f_elastic(first + c)
      end do
   end subroutine take_evaluated

   !> Kinematics and forces of the contacts of an item at a motion: forces are zero of those that are free.
   subroutine find_forces(self, item, n, motion, contacts, f_n, f_t, f_elastic, with_sliding)
      class(point_contacts_t), intent(in) :: self           !! the set
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: n                              !! contacts of an item
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(point_contact_t), intent(inout) :: contacts(n)   !! (n) kinematics
      real(wp), intent(out) :: f_n(n)                       !! (n) normal forces [N]
      real(wp), intent(out) :: f_t(n)                       !! (n) friction forces on j along t [N]
      real(wp), intent(out) :: f_elastic(n)                 !! (n) elastic parts of the normal forces [N]
      logical, intent(in) :: with_sliding                   !! sliding velocities are requested

      real(wp), dimension(most_of_item) :: delta, f_friction, impact_speed, rate, slope_delta, slope_rate, speed
      integer :: c, first

      first = (item - 1)*n
      f_n = 0.0_wp
      f_t = 0.0_wp
      f_elastic = 0.0_wp
      do c = 1, n
         call self%measure(first + c, with_sliding .or. allocated(self%laws%friction), motion, contacts(c))
      end do
      if (self%n_touching == 0 .and. .not. self%laws%normal%acts_apart) return
      call press(n, self%laws%normal, self%contact(first + 1:first + n), self%laws%parameters(:, first + 1:first + n), contacts, &
                 delta, rate, impact_speed, f_n, slope_delta, slope_rate, f_elastic)
      if (self%traits%has_faces .or. allocated(self%laws%friction)) f_friction(:n) = f_n
      if (self%traits%has_faces) call self%share_item(item, contacts, f_n, f_elastic, f_friction(:n))
      if (.not. allocated(self%laws%friction)) return
      if (self%stick_slip%memory == memory_none) then
         call friction_by_law(n, self%laws%friction, self%contact(first + 1:first + n), contacts, f_friction, speed, f_t)
      else  ! of the last evaluation: it is no function of the motion alone
         do c = 1, n
            if (.not. self%contact(first + c)%is_touching) cycle
            call take_friction(self%stick_slip%n_tangent, self%stick_slip%tangent(first + c), contacts(c), f_t(c))
         end do
      end if
   end subroutine find_forces

end submodule point_queries
