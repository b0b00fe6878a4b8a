!> Planar: contacts of points with planes whose items may share faces: two of them give their forces to a face between them.
!>
!> A geometry says how an item shares (`share_item`) and what it stores then (`face_energy`); both are functions of the penetrations
!> and rates of all contacts of the item and of their states. The rate of a force is that of the five-point formula over a small
!> part of the contact's own time.
!> Source: see `clearance_translational`. Limits: an item has at most `most_of_item` contacts.
module faced_contacts
   use flat_contacts, only: flat_contacts_t
   use kinds, only: wp
   use motion, only: motion_t
   use point_contact, only: most_of_item, point_contact_t
   use point_contacts, only: point_elastic_energy, point_monitor
   implicit none (type, external)
   private
   public :: faced_contacts_t

   !> Points against planes, with faces where the geometry sets `has_faces`.
   type, abstract, extends(flat_contacts_t) :: faced_contacts_t
   contains
      procedure(energy_interface), deferred :: face_energy
      procedure :: monitor => faced_monitor
      procedure :: elastic_energy => faced_elastic_energy
   end type faced_contacts_t

   abstract interface
      !> Elastic energy of an item with faces.
      function energy_interface(self, item, contacts) result(energy)
         import :: faced_contacts_t, point_contact_t, wp
         implicit none (type, external)
         class(faced_contacts_t), intent(in) :: self      !! the set
         integer, intent(in) :: item                      !! the item
         type(point_contact_t), intent(in) :: contacts(:) !! (n_contact_item) penetrations and rates of its contacts
         real(wp) :: energy                               !! energy stored [J]
      end function energy_interface
   end interface

contains

   !> Normal force of a touching contact and its rate, that of the five-point formula where faces may be shared.
   subroutine faced_monitor(self, k, motion, delta, rate, force, force_rate)
      class(faced_contacts_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions, velocities and accelerations
      real(wp), intent(out) :: delta               !! penetration [m]
      real(wp), intent(out) :: rate                !! its rate [m/s]
      real(wp), intent(out) :: force               !! normal force [N]
      real(wp), intent(out) :: force_rate          !! its rate [N/s]

      type(point_contact_t) :: contacts(most_of_item)
      integer :: c, first

      if (.not. (self%traits%has_faces .and. self%contact(k)%is_touching)) then
         call point_monitor(self, k, motion, delta, rate, force, force_rate)
         return
      end if
      first = (self%item_of(k) - 1)*self%n_contact_item
      do c = 1, self%n_contact_item
         call self%measure(first + c, .false., motion, contacts(c))
      end do
      delta = contacts(k - first)%delta
      rate = contacts(k - first)%rate
      force = force_in_faces(self, self%item_of(k), contacts, k - first)
      force_rate = rate_in_faces(self, k, motion, contacts)
   end subroutine faced_monitor

   !> Rate of the normal force of a contact that may share a face.
   real(wp) function rate_in_faces(self, k, motion, contacts) result(force_rate)
      class(faced_contacts_t), intent(in) :: self                      !! the set
      integer, intent(in) :: k                                         !! contact of the set
      type(motion_t), intent(in) :: motion                             !! positions, velocities and accelerations
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) kinematics of its item's contacts

      real(wp), parameter :: places(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp
      real(wp), parameter :: part = 1.0e-3_wp    ! of the time in which the penetration would be gone [1]
      type(point_contact_t) :: later(most_of_item)
      real(wp) :: acceleration(most_of_item), h
      integer :: c, first, item, n, place

      item = self%item_of(k)
      n = self%n_contact_item
      first = (item - 1)*n
      do c = 1, n
         acceleration(c) = self%penetration_acceleration(first + c, motion, contacts(c))
      end do
      ! the others move too, and may be faster; at the onset, of the last digit of the penetration
      h = max(abs(contacts(k - first)%delta), epsilon(1.0_wp)*(abs(self%plane%height(k)) + norm2(contacts(k - first)%arm_i(1:2))))
      h = part*min(h/max(maxval(abs(contacts%rate)), tiny(1.0_wp)), sqrt(h/max(maxval(abs(acceleration(:n))), tiny(1.0_wp))))
      force_rate = 0.0_wp
      do place = 1, size(places)
         do c = 1, n
            associate (t => places(place)*h)
               later(c)%delta = contacts(c)%delta + t*(contacts(c)%rate + 0.5_wp*t*acceleration(c))
               later(c)%rate = contacts(c)%rate + t*acceleration(c)
            end associate
         end do
         force_rate = force_rate + weights(place)*force_in_faces(self, item, later, k - first)/h
      end do
   end function rate_in_faces

   !> Normal force of a contact of an item that may share a face.
   real(wp) function force_in_faces(self, item, contacts, c) result(force)
      class(faced_contacts_t), intent(in) :: self              !! the set
      integer, intent(in) :: item                              !! the item
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) penetrations and rates
      integer, intent(in) :: c                                 !! contact of the item

      real(wp), dimension(most_of_item) :: f_elastic, f_n, f_friction

      associate (n => self%n_contact_item)
         call self%press(item, contacts, f_n(:n), f_elastic(:n))
         f_friction(:n) = f_n(:n)
         call self%share_item(item, contacts, f_n(:n), f_elastic(:n), f_friction(:n))
      end associate
      force = f_n(c)
   end function force_in_faces

   !> Elastic energy that the touching contacts and faces store.
   function faced_elastic_energy(self, motion) result(energy)
      class(faced_contacts_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion         !! positions
      real(wp) :: energy                           !! energy stored [J]

      type(point_contact_t) :: contacts(most_of_item)
      integer :: c, item, n

      if (.not. self%traits%has_faces) then
         energy = point_elastic_energy(self, motion)
         return
      end if
      energy = 0.0_wp
      n = self%n_contact_item
      do item = 1, self%n
         do c = 1, n
            call self%measure((item - 1)*n + c, .false., motion, contacts(c))
         end do
         energy = energy + self%face_energy(item, contacts(:n))
      end do
   end function faced_elastic_energy

end module faced_contacts
