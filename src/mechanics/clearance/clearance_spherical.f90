!> A spherical joint with clearance: a ball of body j in a socket of body i, in space: dry contact, a film, or both.
!>
!> Equations: `socket_contacts`, `socket_films`; forces: `point_contacts`. The law is fitted to an internal contact of radii R and R
!> - c.
!>
!> Signs: the reported force is that on the ball, its moment is about the ball's centre; the eccentricity is the ball's centre from
!> the socket's, world frame. Source: Flores et al. (2008), section 6.2, corrected: see `socket_contacts`.
!> Limits: the socket is a whole sphere: nothing keeps the ball from leaving through an opening.
module clearance_spherical
   use item, only: item_t, place_of
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_length, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force, of_moment
   use revolute_level, only: add_film_columns, add_spatial_film_channels, describe_hole, find_level_mistake
   use socket_joints, only: socket_joints_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: add_socket_columns, check_socket, clearance_spherical_t

   !> Balls in sockets.
   type, extends(socket_joints_t) :: clearance_spherical_t
   contains
      procedure, nopass :: info => spherical_info
      procedure, nopass :: ideal_kind => spherical_ideal_kind
      procedure :: prepare => spherical_prepare
      procedure :: set_start => spherical_set_start
      procedure, nopass :: mistake => check_socket
      procedure, nopass :: describe => describe_hole
   end type clearance_spherical_t

contains

   !> Description of the geometry.
   function spherical_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.spherical"
      info%space = in_space
      info%help = "a ball with clearance in a socket"
      info%source = "Flores et al. (2008), section 6.2"
      call add_reference(info, "bearing", "points", "centre of the socket")
      call add_reference(info, "journal", "points", "centre of the ball")
      call add_socket_columns(info, "socket", "ball")
      call add_film_columns(info, .true.)
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the ball relative to that of the socket", of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the ball", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the ball about its centre", of_moment)
      call add_spatial_film_channels(info, .true.)
      call add_contact_channels(info, "ball", "its sliding velocity")
   end function spherical_info

   !> Columns of radii, material, level and laws.
   subroutine add_socket_columns(info, hole, pin)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: hole          !! what is outside
      character(*), intent(in) :: pin           !! what is inside

      call add_number(info, "bearing_radius", dim_length, "radius of the "//hole, lower=0.0_wp, open_lower=.true.)
      call add_number(info, "clearance", dim_length, "radial clearance, radius of the "//hole//" minus that of the "//pin, &
                      lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of "//hole//" and "//pin, default="none")
      call add_reference(info, "journal_material", "material", "material of the "//pin//", if different", default="none")
      call add_word(info, "level", "model: an ideal joint, dry contact, a film, or film and dry contact", &
                    default="clearance", choices="ideal clearance lubricated hybrid")
      call add_reference(info, "law", "contact.", "normal law of dry contact, a row of a contact table", default="none")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
   end subroutine add_socket_columns

   !> Without clearance a spherical joint.
   function spherical_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.spherical"
   end function spherical_ideal_kind

   !> A ball is inside its socket.
   subroutine spherical_prepare(self, items)
      class(clearance_spherical_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                 !! (n) rows of the table

      self%traits%is_round = .true.
      call self%make_storage()
      allocate (self%socket(self%n))
   end subroutine spherical_prepare

   !> Nothing but where the films are.
   subroutine spherical_set_start(self, motion)
      class(clearance_spherical_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion                 !! bodies where the deck puts them

      call self%seat_films()
   end subroutine spherical_set_start

   !> The inner part must have a radius, and the row what its level needs.
   subroutine check_socket(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (radius => item%number("bearing_radius"), clearance => item%number("clearance"))
         if (.not. clearance < radius) then
            column = place_of(item, "clearance")
            message = "clearance must be smaller than bearing_radius"
            help = "the inner radius is bearing_radius minus clearance: here "//to_text(1.0e3_wp*(radius - clearance))//" mm"
            return
         end if
      end associate
      call find_level_mistake(item, column, message, help)
   end subroutine check_socket

end module clearance_spherical
