!> Initial speed in space: turns a revolute or cylindrical joint about its axis while the start is made consistent, then lets go.
!>
!> Phi = theta - theta_0 - W t                                               (1 row, at the start only)
!>
!> As initial.speed of the plane, with the angle of `turn_frames`. Signs: counter-clockwise of j against i, observed from the tip of
!> the axis. Source: Flores et al. (2008), sections 2.2 and 2.8. Limits: as `turn_frames`.
module spatial_initial_speed
   use kind_info, only: add_number, add_reference, dim_angular_speed, in_space, kind_info_t
   use spatial_driver_speed, only: spatial_driver_speed_t
   implicit none (type, external)
   private
   public :: spatial_initial_speed_t

   !> All initial speeds of a spatial scene.
   type, extends(spatial_driver_speed_t) :: spatial_initial_speed_t
   contains
      procedure, nopass :: info => initial_info
   end type spatial_initial_speed_t

contains

   !> Description of the kind.
   function initial_info() result(info)
      type(kind_info_t) :: info  !! name, columns and rows; it has no channels

      info%name = "initial.speed"
      info%space = in_space
      info%help = "initial speed of a joint about its axis; afterwards the joint is free"
      info%source = "Flores et al. (2008), section 2.8"
      info%n_row = 1
      info%is_start_only = .true.
      call add_reference(info, "joint", "joint.revolute joint.cylindrical", "the joint")
      call add_number(info, "speed", dim_angular_speed, "initial speed of j relative to i, counter-clockwise about the axis")
   end function initial_info

end module spatial_initial_speed
