!> Planar: what is reported of bodies and joints where no body is unknown (`mechanism_direct`): reactions follow from the balance of
!> each body, without rows, and nothing is solved.
!>
!> With what is held by body b, F and M the loads on it, all moments about centres of mass:
!>
!> f_b = m_b a_b - F_b + sum f_c,   m_b = I_b alpha_b - M_b + sum ( m_c + (r_c - r_b) x f_c )
!>
!> A joint that leaves a turn carries no moment about its pin P; its driver carries m_b - (P - r_b) x f_b. A driver's power is its
!> moment times the rate of its coordinate.
!>
!> Signs: force and moment of a joint are those on the body of i; that of a driver acts on the body of j.
!> Source: Flores et al. (2008), eqs. (2.15), (2.24). Limits: see `planar_prescribed`, `planar_one_dof`; what is read of the rows
!> themselves, and reactions that requests report, are found as in any other scene.
module balanced_report
   use balance_plan, only: balance_plan_t, held_reading_t
   use bodies, only: of_acceleration, of_angle, of_angular_acceleration, of_angular_velocity, of_position, of_velocity
   use joint_set, only: joint_set_t, joint_slot_t, of_coordinate, of_force, of_moment, of_power
   use kinds, only: wp
   use linkage, only: linkage_t
   use mechanism, only: mechanism_t
   use motion, only: loads_t, motion_t
   use planar_one_dof, only: planar_guide_t, planar_one_dof_t
   use planar_prescribed, only: planar_prescribed_t
   use readings, only: reading_plan_t, reading_t
   use reduced_bodies, only: held_t
   implicit none (type, external)
   private
   public :: bind_balance, report_balanced

   ! quantities
   integer, parameter :: force_of_joint = 1       !! force of a joint on the body of i
   integer, parameter :: no_moment = 2            !! moment of a joint that leaves a turn, about its pin
   integer, parameter :: moment_of_joint = 3      !! moment of another one about the point that it reports
   integer, parameter :: moment_of_driver = 4     !! driving moment on the body of j
   integer, parameter :: power_of_driver = 5      !! power of a driver
   integer, parameter :: turn_of_driver = 6       !! coordinate of a driver

contains

   !> Divide what is read of joints and drivers into what follows from balances and other readings.
   subroutine bind_balance(system, plan)
      class(mechanism_t), intent(in) :: system      !! the system
      type(reading_plan_t), intent(inout) :: plan   !! what is read of joints and drivers is bound; then this too

      type(balance_plan_t) :: balance
      type(held_reading_t) :: reading
      integer :: k, m

      plan%others = plan%joints
      balance%is_set = system%is_direct
      if (balance%is_set) then
         associate (linkage => system%linkage)
            allocate (balance%of(sum(plan%joints%n)), balance%wrench(3, 0:linkage%bodies%n))
            balance%wrench = 0.0_wp
            do k = 1, size(plan%joints)
               plan%others(k)%n = 0
               do m = 1, plan%joints(k)%n
                  associate (joint => plan%joints(k)%of(m))
                     call find_held(linkage, k, joint%item, joint%code, reading)
                     if (reading%code > 0) then
                        reading%place = joint%place
                        balance%n_reading = balance%n_reading + 1
                        balance%of(balance%n_reading) = reading
                     else
                        plan%others(k)%n = plan%others(k)%n + 1
                        plan%others(k)%of(plan%others(k)%n) = joint
                     end if
                  end associate
               end do
            end do
            call list_bodies(linkage, balance)
         end associate
      end if
      plan%of_others = pack([(k, k=1, size(plan%others))], plan%others%n > 0)
      plan%balance = balance
   end subroutine bind_balance

   !> A quantity of a joint or driver that holds a body; code 0 if it does not, or the quantity is another one.
   subroutine find_held(linkage, slot, item, code, reading)
      type(linkage_t), intent(in) :: linkage          !! the linkage
      integer, intent(in) :: slot                     !! set of the joint or driver
      integer, intent(in) :: item                     !! its item
      integer, intent(in) :: code                     !! channel of the set
      type(held_reading_t), intent(out) :: reading    !! the quantity, but for its place

      integer :: k

      select type (known => linkage%reduced%known)
      type is (planar_prescribed_t)
         do k = 1, known%n
            call look(known%held(k), known%held(k)%slot > 0)
            if (known%held(k)%slot == slot .and. known%held(k)%item == item) then
               call take(known%held(k), driver_quantity(code), -1.0_wp)
               reading%pin = known%item(k)%s_body
            end if
         end do
      end select
      associate (one_dof => linkage%reduced%one_dof)
         do k = 1, one_dof%n
            call look(one_dof%held(k), k <= one_dof%n_turning)
         end do
      end associate

   contains

      !> Take the joint if it is the one that holds a body.
      subroutine look(held, free_rotation)
         type(held_t), intent(in) :: held        !! how the body is held
         logical, intent(in) :: free_rotation      !! its joint leaves a turn

         associate (set => linkage%joints(slot)%set)
            if (held%row(1) /= set%first_row + (item - 1)*set%n_row_item + 1) return
         end associate
         call take(held, joint_quantity(code, free_rotation), 1.0_wp)
      end subroutine look

      !> Take a quantity of the joint of a body, or of the driver.
      subroutine take(held, quantity, on_i)
         type(held_t), intent(in) :: held        !! how the body is held
         integer, intent(in) :: quantity         !! what is read, 0: nothing that follows from the balance
         real(wp), intent(in) :: on_i            !! 1: what acts on the body of i is reported, -1: on that of j [1]

         reading%code = quantity
         reading%body = held%body
         reading%sense = merge(on_i, -on_i, held%side == 1)
         reading%slot = slot
         reading%item = item
      end subroutine take

   end subroutine find_held

   !> What a channel of a joint that holds a body is here, 0: nothing.
   pure integer function joint_quantity(code, free_rotation) result(quantity)
      integer, intent(in) :: code               !! the channel
      logical, intent(in) :: free_rotation        !! the joint leaves a turn

      quantity = 0
      if (code == of_force) quantity = force_of_joint
      if (code == of_moment) quantity = merge(no_moment, moment_of_joint, free_rotation)
   end function joint_quantity

   !> The same of its driver.
   pure integer function driver_quantity(code) result(quantity)
      integer, intent(in) :: code   !! the channel

      quantity = 0
      if (code == of_moment) quantity = moment_of_driver
      if (code == of_power) quantity = power_of_driver
      if (code == of_coordinate) quantity = turn_of_driver
   end function driver_quantity

   !> The bodies whose balance is needed: those that something is read of, and what these hold.
   subroutine list_bodies(linkage, balance)
      type(linkage_t), intent(in) :: linkage            !! the linkage
      type(balance_plan_t), intent(inout) :: balance    !! its quantities are there; the bodies are listed

      logical :: is_needed(0:linkage%bodies%n)
      integer :: k

      is_needed = .false.
      do k = 1, balance%n_reading
         if (balance%of(k)%code /= turn_of_driver) is_needed(balance%of(k)%body) = .true.
      end do
      associate (known => linkage%reduced%known%held, one_dof => linkage%reduced%one_dof%held)
         do k = 1, size(known)  ! each after its base
            is_needed(known(k)%body) = is_needed(known(k)%body) .or. is_needed(known(k)%base)
         end do
         do k = 1, size(one_dof)
            is_needed(one_dof(k)%body) = is_needed(one_dof(k)%body) .or. is_needed(one_dof(k)%base)
         end do
         balance%body = [one_dof%body, (known(k)%body, k=size(known), 1, -1)]
         balance%base = [one_dof%base, (known(k)%base, k=size(known), 1, -1)]
         balance%base = pack(balance%base, is_needed(balance%body))
         balance%body = pack(balance%body, is_needed(balance%body))
         balance%n = size(balance%body)
      end associate
   end subroutine list_bodies

   !> Values that are read of bodies, and of joints and drivers what follows from balances. The system is evaluated; accelerations
   !> of the bodies with one degree of freedom are set. No allocation.
   subroutine report_balanced(system, ydot, plan, n_value, values)
      class(mechanism_t), intent(inout) :: system      !! the system, evaluated
      real(wp), intent(in) :: ydot(system%n)           !! (n) derivative of its state [any]
      type(reading_plan_t), intent(inout) :: plan      !! what is read
      integer, intent(in) :: n_value                   !! values of the catalogue
      real(wp), intent(inout) :: values(n_value)       !! (n_value) they, those that are read are set [any]

      associate (linkage => system%linkage, motion => system%linkage%motion, loads => system%loading%loads, &
                 balance => plan%balance, n_body => system%linkage%bodies%n)
         select type (one_dof => linkage%reduced%one_dof)
         type is (planar_one_dof_t)
            call accelerate(one_dof%n, one_dof%n_turning, one_dof%held, one_dof%item, &
                            ydot(linkage%n_position + linkage%n_rate - one_dof%n + 1:), n_body, motion%a, motion%alpha)
         end select
         if (plan%bodies%n > 0) then
            call report_bodies(plan%bodies%n, plan%bodies%of, n_body, motion%r, motion%v, motion%a, motion%angle, motion%omega, &
                               motion%alpha, n_value, values)
         end if
         call find_wrenches(balance%n, balance%body, balance%base, n_body, linkage%mass, motion%r, motion%a, motion%alpha, &
                            loads%force, loads%moment, balance%wrench)
         call report_held(balance%n_reading, balance%of, n_body, balance%wrench, size(linkage%joints), linkage%joints, motion, &
                          n_value, values)
      end associate
   end subroutine report_balanced

   include "../reduction/planar_accelerate.inc"
   include "../bodies/report_bodies.inc"

   !> Force that holds each body, and its moment about the centre of mass, from the tips to the ground.
   pure subroutine find_wrenches(n, body, base, n_body, mass, r, a, alpha, force, moment, wrench)
      integer, intent(in) :: n                          !! number of bodies that are requested
      integer, intent(in) :: body(n)                    !! (n) these, each before what it is held by
      integer, intent(in) :: base(n)                    !! (n) what they are held by, 0: the ground
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: mass(3, n_body)           !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), intent(in) :: r(3, 0:n_body)            !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: a(3, 0:n_body)            !! (3, 0:bodies) accelerations [m/s^2]
      real(wp), intent(in) :: alpha(3, 0:n_body)        !! (3, 0:bodies) angular accelerations [rad/s^2]
      real(wp), intent(in) :: force(3, 0:n_body)        !! (3, 0:bodies) applied forces [N]
      real(wp), intent(in) :: moment(3, 0:n_body)       !! (3, 0:bodies) applied moments about the centres of mass [N.m]
      real(wp), intent(inout) :: wrench(3, 0:n_body)    !! (3, 0:bodies) of the requested bodies: what holds them [N, N, N.m]

      integer :: b, c, k

      do k = 1, n
         b = body(k)
         wrench(1, b) = mass(1, b)*a(1, b) - force(1, b)
         wrench(2, b) = mass(2, b)*a(2, b) - force(2, b)
         wrench(3, b) = mass(3, b)*alpha(3, b) - moment(3, b)
      end do
      do k = 1, n
         b = body(k)
         c = base(k)
         if (c == 0) cycle
         wrench(1, c) = wrench(1, c) + wrench(1, b)
         wrench(2, c) = wrench(2, c) + wrench(2, b)
         wrench(3, c) = wrench(3, c) + wrench(3, b) + (r(1, b) - r(1, c))*wrench(2, b) - (r(2, b) - r(2, c))*wrench(1, b)
      end do
   end subroutine find_wrenches

   !> Quantities of joints and drivers.
   subroutine report_held(n, reading, n_body, wrench, n_set, joints, motion, n_value, values)
      integer, intent(in) :: n                          !! number of quantities
      type(held_reading_t), intent(in) :: reading(n)    !! (n) the quantities
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: wrench(3, 0:n_body)       !! (3, 0:bodies) what holds the bodies [N, N, N.m]
      integer, intent(in) :: n_set                      !! number of sets of joints
      type(joint_slot_t), intent(in) :: joints(n_set)   !! (sets) joints and drivers
      type(motion_t), intent(in) :: motion              !! positions and velocities
      integer, intent(in) :: n_value                    !! values of the catalogue
      real(wp), intent(inout) :: values(n_value)        !! (n_value) they, those that are read are set [any]

      real(wp) :: p(3), rate, turn
      integer :: at, b, m

      do m = 1, n
         at = reading(m)%place
         b = reading(m)%body
         select case (reading(m)%code)
         case (force_of_joint)
            values(at + 1) = reading(m)%sense*wrench(1, b)
            values(at + 2) = reading(m)%sense*wrench(2, b)
         case (moment_of_driver)
            values(at + 1) = driving_moment(reading(m), wrench(:, b), motion%rot(:, :, b))
         case (turn_of_driver)
            call joints(reading(m)%slot)%set%coordinate(reading(m)%item, motion, values(at + 1), rate)
         case (power_of_driver)
            call joints(reading(m)%slot)%set%coordinate(reading(m)%item, motion, turn, rate)
            values(at + 1) = rate*driving_moment(reading(m), wrench(:, b), motion%rot(:, :, b))
         case (moment_of_joint)
            p = joints(reading(m)%slot)%set%reaction_point(reading(m)%item, motion)
            values(at + 1) = reading(m)%sense*(wrench(3, b) - (p(1) - motion%r(1, b))*wrench(2, b) &
                                               + (p(2) - motion%r(2, b))*wrench(1, b))
         case (no_moment)
            values(at + 1) = 0.0_wp
         end select
      end do
   end subroutine report_held

   !> What of a moment that holds a body its driver has.
   pure real(wp) function driving_moment(reading, wrench, rot) result(moment)
      type(held_reading_t), intent(in) :: reading   !! a quantity of the driver
      real(wp), intent(in) :: wrench(3)             !! (3) what holds the body, the moment about its centre of mass [N, N, N.m]
      real(wp), intent(in) :: rot(3, 3)             !! (3, 3) body frame to world frame [1]

      real(wp) :: x, y

      x = rot(1, 1)*reading%pin(1) + rot(1, 2)*reading%pin(2)
      y = rot(2, 1)*reading%pin(1) + rot(2, 2)*reading%pin(2)
      moment = reading%sense*(wrench(3) - x*wrench(2) + y*wrench(1))
   end function driving_moment

end module balanced_report
