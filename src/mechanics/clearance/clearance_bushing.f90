!> A revolute joint with clearance in space: a pin of body j in a bushing of body i, with a contact at each of its two bases,
!> a film, or both.
!>
!> Equations: `socket_contacts`; forces: `point_contacts`; films: `socket_films`. The bases are half of `journal_length` either side
!> of the pin's point, along its axis; the bushing's ends half of `length` either side of its point. With `ends = clipped` a base
!> beyond an end of the bushing counts where the pin passes the end; with `endless` the bushing has none, as in the book. Omitted,
!> axes are those of `spatial_joint`. Each base has half of the stiffness, so that both together carry what the planar pin does
!> (`half`); `full` is the book's: shorter and harder impacts.
!>
!> Signs: the reported force is that on the pin, its moment is about the pin's point; the eccentricity is the pin's point from the
!> bushing's axis, across it, world frame. Source: Flores et al. (2008), section 6.3, corrected: see `socket_contacts`.
!> Limits: those of `socket_contacts`; the pin is held along its axis by nothing.
module clearance_bushing
   use clearance_spherical, only: add_socket_columns, check_socket
   use bodies, only: material_t
   use item, only: item_t
   use joint_frames, only: find_frames
   use kind_info, only: add_channel, add_direction, add_number, add_reference, add_word, dim_length, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use point_contacts, only: add_contact_channels, of_axial_displacement, of_eccentricity, of_force, of_moment, of_tilt
   use revolute_level, only: add_film_columns, add_spatial_film_channels, describe_hole
   use socket_contacts, only: of_engagement
   use socket_joints, only: socket_joints_t
   use surfaces, only: surfaces_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_bushing_t

   !> Pins in bushings.
   type, extends(socket_joints_t) :: clearance_bushing_t
   contains
      procedure, nopass :: info => bushing_info
      procedure, nopass :: contact_labels => bushing_labels
      procedure, nopass :: ideal_kind => bushing_ideal_kind
      procedure :: prepare => bushing_prepare
      procedure :: set_start => bushing_set_start
      procedure, nopass :: mistake => check_socket
      procedure, nopass :: describe => bushing_describe
      procedure :: span_of => bushing_span_of
   end type clearance_bushing_t

contains

   !> Description of the geometry.
   function bushing_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.revolute"
      info%space = in_space
      info%help = "a pin with clearance in a bushing: dry contact at each of its two ends, or lubricant film"
      info%source = "Flores et al. (2008), section 6.3"
      call add_reference(info, "bearing", "points", "middle of the bushing, on its axis")
      call add_reference(info, "journal", "points", "middle of the pin, on its axis")
      call add_direction(info, "axis_i", "axis of the bushing, in the frame of its body", default='"0 0 1"')
      call add_direction(info, "axis_j", "axis of the pin, in the frame of its body; default: consistent with the given "// &
         "positions", &
                         default="")
      call add_direction(info, "x_i", "direction of the zero angle of a film supply, in the frame of the bushing body; default: &
                         &the body axis after the one nearest to the axis", default="")
      call add_socket_columns(info, "bushing", "pin")
      call add_number(info, "length", dim_length, "length of the bushing along its axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "journal_length", dim_length, "distance between the ends of the pin; default: length of the bushing", &
                      default="", lower=0.0_wp, open_lower=.true.)
      call add_word(info, "ends", "clipped: contact only within the length of the bushing; endless: also beyond its ends", &
         default="clipped", &
                    choices="clipped endless")
      call add_word(info, "stiffness", "contact stiffness at each end: half that of the pin, or full as in Flores et al. "// &
         "(2008)", default="half", &
                    choices="half full")
      call add_film_columns(info, .false.)
      call add_channel(info, "eccentricity", "m", "world", 2, "middle of the pin relative to the axis of the bushing", &
         of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the pin, from contacts at both ends and film", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the pin about its middle", of_moment)
      call add_channel(info, "tilt", "rad", "joint", 1, "angle between the axes of pin and bushing", of_tilt)
      call add_channel(info, "axial_displacement", "m", "joint", 1, "middle of the pin relative to that of the bushing, along "// &
         "its axis", &
                       of_axial_displacement)
      call add_channel(info, "engagement", "m", "joint", 1, "length of the pin inside the bushing, along its axis", &
                       of_engagement)
      call add_spatial_film_channels(info, .false.)
      call add_contact_channels(info, "pin", "its sliding velocity")
   end function bushing_info

   !> A contact at each base.
   pure function bushing_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (2) names

      allocate (labels(2))
      labels(1)%s = "a"
      labels(2)%s = "b"
   end function bushing_labels

   !> Without clearance a revolute joint.
   function bushing_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.revolute"
   end function bushing_ideal_kind

   !> Axes of each item as in the deck.
   subroutine bushing_prepare(self, items)
      class(clearance_bushing_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)               !! (n) rows of the table

      integer :: k

      self%traits%is_round = .true.
      call self%make_storage()
      allocate (self%socket(self%n))
      do k = 1, self%n
         associate (item => items(k), socket => self%socket(k))
            socket%has_axis = .true.
            socket%has_ends = item%word("ends") == "clipped"
            socket%axis_i = item%direction("axis_i")
            socket%axis_j = item%direction("axis_j")
            socket%across = item%direction("x_i")
         end associate
      end do
   end subroutine bushing_prepare

   !> Axes in the frames of the bodies.
   subroutine bushing_set_start(self, motion)
      class(clearance_bushing_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion               !! bodies where the deck puts them

      real(wp) :: frame_i(3, 3), frame_j(3, 3)
      integer :: k

      do k = 1, self%n
         associate (socket => self%socket(k), i => self%items%body(1, k), j => self%items%body(2, k), own => motion%spatial%own)
            call find_frames(motion, [i, j], socket%axis_i, socket%axis_j, .true., frame_i, frame_j, &
                             reshape([socket%across, 0.0_wp, 0.0_wp, 0.0_wp], [3, 2]))
            socket%across = frame_i(:, 1)
            socket%axis_i = matmul(socket%axis_i/norm2(socket%axis_i), own(:, :, i))
            if (any(abs(socket%axis_j) > 0.0_wp)) then
               socket%axis_j = matmul(socket%axis_j/norm2(socket%axis_j), own(:, :, j))
            else
               socket%axis_j = matmul(matmul(motion%rot(:, :, i), socket%axis_i), motion%rot(:, :, j))
            end if
         end associate
      end do
      call self%seat_films()
   end subroutine bushing_set_start

   !> A pin in a hole, half as long at each base.
   pure subroutine bushing_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call describe_hole(item, materials, pair)
      pair%length = item%number("length")
      pair%length_j = pair%length
      if (item%is_given("journal_length")) pair%length_j = item%number("journal_length")
   end subroutine bushing_describe

   !> How far what takes part in a contact is from the centres of mass of both bodies.
   pure function bushing_span_of(self, contact) result(span)
      class(clearance_bushing_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact                  !! contact of the set
      real(wp) :: span(2)                             !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))) + 0.5_wp*self%items%pairs(item)%length, &
                 sum(abs(self%items%s_j(:, item))) + 0.5_wp*self%items%pairs(item)%length_j + self%items%pairs(item)%clearance]
      end associate
   end function bushing_span_of

end module clearance_bushing
