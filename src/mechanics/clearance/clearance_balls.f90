!> Two balls that touch from outside, in space.
!>
!> delta = R_i + R_j - |e|,  e = r_j^P - r_i^P,  n = -e / |e|: that of a ball in a socket of radius -R_i, see `socket_contacts`,
!> which has rates and sliding velocities; forces: `point_contacts`.
!>
!> Signs: the reported force is that on the second ball, world frame. Source: Flores et al. (2008), sections 3.1 and 6.2; (3.3) for
!> the stiffness. Limits: centres that coincide have no normal; friction has no moment about the normal.
module clearance_balls
   use clearance_discs, only: add_disc_columns, describe_discs
   use item, only: item_t
   use kind_info, only: in_space, kind_info_t
   use kinds, only: wp
   use point_contacts, only: add_contact_channels
   use socket_contacts, only: socket_contacts_t
   implicit none (type, external)
   private
   public :: clearance_balls_t

   !> Pairs of balls.
   type, extends(socket_contacts_t) :: clearance_balls_t
   contains
      procedure, nopass :: info => balls_info
      procedure :: prepare => balls_prepare
      procedure, nopass :: describe => describe_discs
   end type clearance_balls_t

contains

   !> Description of the geometry.
   function balls_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.discs"
      info%space = in_space
      info%help = "external contact of two balls; --ideal keeps it, as no ideal joint corresponds to it"
      info%source = "Flores et al. (2008), sections 3.1 and 6.2"
      call add_disc_columns(info, "ball")
      call add_contact_channels(info, "second ball", "its sliding velocity")
   end function balls_info

   !> The second ball is beside the first.
   subroutine balls_prepare(self, items)
      class(clearance_balls_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      call self%make_storage()
      allocate (self%socket(self%n))
      self%socket%side = -1.0_wp
   end subroutine balls_prepare

end module clearance_balls
