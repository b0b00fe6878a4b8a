!> Contacts at points in space, of any geometry: their evaluation, and the force of one on body j.
!>
!> A geometry measures the contacts that act in one call of its own (`measure_acting`, text in `measure_acting.inc`); the rest of an
!> evaluation is here.
!>
!> Signs and forces: see `point_contacts`, `space_tangents`. Source: Flores et al. (2008), section 6.2. Limits: none.
module spatial_contacts
   use clearance_set, only: loss_contact, loss_friction, n_integrand, normal_impulse
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t
   use point_contact, only: point_contact_t
   use point_contacts, only: point_contacts_t
   use space_tangents, only: spatial_force
   implicit none (type, external)
   private
   public :: spatial_contacts_t

   !> Contacts at points in space.
   type, abstract, extends(point_contacts_t) :: spatial_contacts_t
   contains
      procedure(measure_interface), deferred :: measure_acting
      procedure :: evaluate => spatial_evaluate
      procedure, nopass :: force_on_j => spatial_force
   end type spatial_contacts_t

   abstract interface
      !> Measure the contacts that touch, all of them where they act apart, with their sliding velocities where there is friction.
      !> No allocation.
      subroutine measure_interface(self, motion)
         import :: motion_t, spatial_contacts_t
         implicit none (type, external)
         class(spatial_contacts_t), intent(inout) :: self  !! the set; kinematics are set
         type(motion_t), intent(in) :: motion              !! positions and velocities
      end subroutine measure_interface
   end interface

contains

   !> Add the contact forces of the touching contacts.
   subroutine spatial_evaluate(self, motion, loads, integrands)
      class(spatial_contacts_t), intent(inout) :: self      !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]

      include "point_way.inc"
   end subroutine spatial_evaluate

   include "push.inc"
   include "../../foundation/numerics/across.inc"

   !> Add the forces of the contacts that act to the loads, and set what is integrated: what damping and friction take, and the
   !> normal force.
   pure subroutine add_loads(n, n_each, memory, body, contacts, f_n, f_elastic, f_t, n_body, force, moment, integrands)
      integer, intent(in) :: n                           !! number of contacts
      integer, intent(in) :: n_each                      !! contacts of an item
      type(contact_memory_t), intent(in) :: memory(n)    !! (n) states
      integer, intent(in) :: body(2, n)                  !! (2, items) bodies i and j
      type(point_contact_t), intent(in) :: contacts(n)   !! (n) kinematics of those that act
      real(wp), intent(in) :: f_n(n)                     !! (n) normal forces [N]
      real(wp), intent(in) :: f_elastic(n)               !! (n) their elastic parts [N]
      real(wp), intent(in) :: f_t(n)                     !! (n) friction forces on j along t [N]
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(inout) :: force(3, 0:n_body)      !! (3, 0:bodies) forces [N]
      real(wp), intent(inout) :: moment(3, 0:n_body)     !! (3, 0:bodies) moments about the centres of mass [N.m]
      real(wp), intent(inout) :: integrands(n_integrand, n)  !! (3, n) power lost and normal force, set [W and N]

      real(wp) :: f(3)
      integer :: i, item, j, k

      do k = 1, n
         if (.not. memory(k)%is_touching) then
            integrands(:, k) = 0.0_wp
            if (.not. f_n(k) > 0.0_wp) cycle  ! but for laws that act apart
         end if
         item = k
         if (n_each > 1) item = (k - 1)/n_each + 1
         i = body(1, item)
         j = body(2, item)
         f = -f_n(k)*contacts(k)%normal + f_t(k)*contacts(k)%tangent
         force(:, i) = force(:, i) - f
         force(:, j) = force(:, j) + f
         moment(:, i) = moment(:, i) - across(contacts(k)%arm_i, f)
         moment(:, j) = moment(:, j) + across(contacts(k)%arm_j, f)
         integrands(loss_contact, k) = (f_n(k) - f_elastic(k))*contacts(k)%rate
         integrands(loss_friction, k) = -f_t(k)*contacts(k)%v_t_work
         integrands(normal_impulse, k) = f_n(k)
      end do
   end subroutine add_loads

   !> Measure the contacts that act, and take what the law gets of them.
   subroutine measure_touching(self, motion)
      class(spatial_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion              !! positions and velocities

      call self%measure_acting(motion)
      call take_contact(self%contact, self%work%contacts, self%laws%normal%acts_apart, self%work%delta, self%work%rate, &
                        self%work%impact_speed)
   end subroutine measure_touching

end module spatial_contacts
