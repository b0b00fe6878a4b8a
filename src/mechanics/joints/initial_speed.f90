!> Initial speed: turns a revolute joint while the start is made consistent, then lets go.
!>
!> Phi = angle_j - angle_i - (f0 + W t)                                      (1 row, at the start only)
!> f0 is the angle that the deck gives the bodies. The assembled positions have this angle and the assembled
!> velocities this speed exactly; the row then leaves the equations, and the joint moves as the forces will.
!>
!> Signs: the speed is that of j relative to i, counter-clockwise positive. Source: Flores et al. (2008),
!> sections 2.2 and 2.8 (the four-bar that starts with its crank turning). Limits: revolute joints; a speed that
!> contradicts drivers or other initial speeds ends the run before it starts.
module initial_speed
   use driver_speed, only: driver_speed_t
   use kind_info, only: add_number, add_reference, dim_angular_speed, in_plane, kind_info_t
   implicit none (type, external)
   private
   public :: initial_speed_t

   !> All initial speeds of a planar scene.
   type, extends(driver_speed_t) :: initial_speed_t
   contains
      procedure, nopass :: info => initial_info
   end type initial_speed_t

contains

   !> Description of the kind.
   function initial_info() result(info)
      type(kind_info_t) :: info  !! name, columns and rows; it has no channels

      info%name = "initial.speed"
      info%space = in_plane
      info%help = "initial speed of a revolute joint; afterwards the joint is free"
      info%source = "Flores et al. (2008), section 2.8"
      info%n_row = 1
      info%is_start_only = .true.
      call add_reference(info, "joint", "joint.revolute", "the revolute joint")
      call add_number(info, "speed", dim_angular_speed, "initial speed of j relative to i, counter-clockwise positive")
   end function initial_info

end module initial_speed
