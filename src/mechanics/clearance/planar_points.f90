!> Planar: contacts at points in the plane, of any geometry: how they lie, by how the normal turns (`turning`).
!>
!> Signs and frames: see `planar_contacts`. Source: Flores et al. (2008), section 3.5. Limits: numbers along z are neither read nor
!> written.
module planar_points
   use contact_stick_slip, only: tangent_t
   use kinds, only: wp
   use motion, only: motion_t
   use planar_contacts, only: lie_in_plane, planar_force
   use point_contact, only: point_contact_t
   use point_contacts, only: point_contacts_t
   implicit none (type, external)
   private
   public :: planar_points_t

   !> Contacts at points in the plane.
   type, abstract, extends(point_contacts_t) :: planar_points_t
   contains
      procedure(turning_interface), deferred :: turning
      procedure :: lie => planar_lie
      procedure, nopass :: force_on_j => planar_force
   end type planar_points_t

   abstract interface
      !> How the normal of a contact turns, and how fast its point goes along the normal, as each body sees it.
      pure subroutine turning_interface(self, k, motion, contact, turn, speed_i, speed_j)
         import :: motion_t, point_contact_t, planar_points_t, wp
         implicit none (type, external)
         class(planar_points_t), intent(in) :: self    !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions and velocities
         type(point_contact_t), intent(in) :: contact   !! its kinematics
         real(wp), intent(out) :: turn                  !! rate at which the normal turns towards t [rad/s]
         real(wp), intent(out) :: speed_i               !! n . s_i', from the centre of mass of i [m/s]
         real(wp), intent(out) :: speed_j               !! n . s_j', from the centre of mass of j [m/s]
      end subroutine turning_interface
   end interface

contains

   !> How a contact lies, whether it touches or not.
   subroutine planar_lie(self, k, motion, tangent)
      class(planar_points_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                     !! contact
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(tangent_t), intent(inout) :: tangent    !! how it lies; its forces are left alone

      type(point_contact_t) :: contact
      real(wp) :: speed_i, speed_j, turn
      integer :: item

      item = self%item_of(k)
      associate (body => self%items%body(:, item))
         call self%measure(k, .true., motion, contact)
         call self%turning(k, motion, contact, turn, speed_i, speed_j)
         call lie_in_plane(contact, motion%omega(3, body(1)), motion%omega(3, body(2)), turn, speed_i, speed_j, tangent)
      end associate
   end subroutine planar_lie

end module planar_points
