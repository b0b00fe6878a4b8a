!> Constant-velocity joint: two points coincide, and two shafts turn by the same angle about their axes, however they are bent.
!>
!> Phi = [ P_i - P_j,  2 e_3 ]                                              (4 rows)
!>
!> z_i and z_j are along the shafts, in the same sense. Where the deck puts the bodies the frame of j is that of i, turned from
!> z_i to z_j about their common perpendicular. The last row keeps it so: e_3 is the fourth Euler parameter of j against i, so
!> that j is turned against i about an axis across z alone, which is the homokinetic condition: the plane that halves the angle of
!> the shafts is a plane of symmetry. If one shaft turns by an angle about its axis, the other turns by the same.
!>
!> The row has full rank wherever it holds, and no other branch: shafts may bend through half a turn and on. The product
!> x_i . y_j - y_i . x_j = -4 e_0 e_3 would have a second branch, e_0 = 0, which meets the first there.
!>
!> Signs, frames: `spatial_joint`. Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), sections 6.1 and
!> 7.2, for Euler parameters and the parts of the rows. Limits: less than half a turn between the axes where the deck puts the
!> bodies, since the axis of the bend is ambiguous beyond; the joint's own bodies are omitted.
module spatial_constant_velocity
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_set, only: of_own
   use kind_info, only: add_channel, kind_info_t, free_spherical
   use kinds, only: wp
   use motion, only: motion_t
   use rotations, only: euler_parameters_of, turned_onto
   use rows, only: rows_t
   use spatial_joint, only: add_axis_columns, add_joint_columns, add_spatial_channels, at_point, set_joint_frames, &
      spatial_joint_t, spatial_report_own, untwisted
   use spatial_rows, only: axis_of
   implicit none (type, external)
   private
   public :: spatial_constant_velocity_t

   integer, parameter :: of_bend = of_own + 6   !! channel: the angle of the shafts, behind those of joints with axes

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_constant_velocity_t
   contains
      procedure, nopass :: info => constant_velocity_info
      procedure :: prepare => constant_velocity_prepare
      procedure :: set_start => constant_velocity_set_start
      procedure :: closing_fault => constant_velocity_closing_fault
      procedure :: report_own => constant_velocity_report_own
   end type spatial_constant_velocity_t

contains

   !> Description of the kind.
   function constant_velocity_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.constant_velocity"
      info%help = "constant-velocity joint: two points coincide and two shafts rotate by the same angle"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 4
      info%free = free_spherical
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the shaft")
      call add_spatial_channels(info)
      call add_channel(info, "bend", "rad", "joint", 1, "angle between the two shafts, zero if aligned", of_bend)
   end function constant_velocity_info

   !> Elements of the joint.
   subroutine constant_velocity_prepare(self, items, angle)
      class(spatial_constant_velocity_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point, untwisted])
      allocate (self%axes%turn(4, 2, self%n), source=0.0_wp)
   end subroutine constant_velocity_prepare

   !> Frames: that of j is that of i, turned from z_i to z_j, where the deck puts the bodies.
   subroutine constant_velocity_set_start(self, motion)
      class(spatial_constant_velocity_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion                       !! bodies where the deck puts them

      real(wp) :: world(3, 3)
      integer :: k

      call set_joint_frames(self, motion)
      do k = 1, self%n
         associate (rot => motion%rot, i => self%body(1, k), j => self%body(2, k), frame_i => self%axes%frame_i(:, :, k), &
                    frame_j => self%axes%frame_j(:, :, k))
            world = turned_onto(matmul(rot(:, :, i), frame_i), axis_of(motion, j, frame_j(:, 3)))
            frame_j = matmul(transpose(rot(:, :, j)), world)
            self%axes%turn(:, 1, k) = euler_parameters_of(frame_i)
            self%axes%turn(:, 2, k) = euler_parameters_of(frame_j)
         end associate
      end do
   end subroutine constant_velocity_set_start

   !> Shafts that point at one another at the start: about which axis they are bent is not known.
   function constant_velocity_closing_fault(self, k, motion) result(fault)
      class(spatial_constant_velocity_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                                !! item
      type(motion_t), intent(in) :: motion                    !! positions
      character(:), allocatable :: fault                      !! what is wrong; blank: nothing

      real(wp), parameter :: minimum = 1.0e-6_wp  ! 1 + cosine of the angle of the shafts [1]

      fault = ""
      if (1.0_wp + dot_product(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                               axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))) > minimum) return
      fault = "is assembled in the reversed configuration: the angle between its shafts is 180 deg, so the plane of the angle "// &
         "is undefined"// &
              new_line("a")//"  = rotate one of its bodies, or reverse axis_i or axis_j, in the deck"
   end function constant_velocity_closing_fault

   !> A channel of its own: the angle of the shafts here, the others as of any joint with axes.
   subroutine constant_velocity_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(spatial_constant_velocity_t), intent(in) :: self   !! the set
      integer, intent(in) :: code                              !! the channel
      integer, intent(in) :: k                                 !! item of the set
      type(motion_t), intent(in) :: motion                     !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates          !! what loads on the rates are
      type(rows_t), intent(in) :: rows                         !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)            !! (rows) multipliers [N or N.m]
      real(wp), intent(inout), contiguous :: value(:)          !! (components) the value [any]

      real(wp) :: z_i(3), z_j(3)

      if (code /= of_bend) then
         call spatial_report_own(self, code, k, motion, coordinates, rows, lambda, value)
         return
      end if
      z_i = axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k))
      z_j = axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))
      value = 2.0_wp*atan2(norm2(z_i - z_j), norm2(z_i + z_j))
   end subroutine constant_velocity_report_own

end module spatial_constant_velocity
