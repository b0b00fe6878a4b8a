!> Bushing in the plane: stiffness and damping along two axes of body i and about their normal, between a point of i and one of j.
!>
!> Displacement, loads, energy and signs: `planar_frame_spring`, with the axes of body i (s = 0), turned by angle_i, no free
!> displacement, and psi = angle_j - angle_i - free_angle. K and C:
!>
!>     K = | stiffness_x    coupling_xy    coupling_x        |     C = diag(damping_x, damping_y, angular_damping) + damping_time K
!>         | coupling_xy    stiffness_y    coupling_y        |
!>         | coupling_x     coupling_y     angular_stiffness |
!>
!> Source: the public description of BUSHING in the manual of Adams/Solver, I and J being j and i here. Limits: none.
module force_bushing
   use bodies, only: points_t
   use coupled_stiffness, only: find_negative_energy
   use item, only: item_t
   use kind_info, only: add_number, add_reference, dim_angle, dim_angular_damping, dim_angular_stiffness, dim_damping, &
      dim_force, dim_moment, dim_stiffness, dim_t, dim_time, in_plane, kind_info_t
   use kinds, only: wp
   use planar_frame_spring, only: add_frame_spring_channels, frame_spring_t
   implicit none (type, external)
   private
   public :: force_bushing_t

   type(dim_t), parameter :: dim_coupling = dim_t(kg=1, m=1, s=-2, rad=-1)  !! force over angle

   !> All bushings of a planar scene.
   type, extends(frame_spring_t) :: force_bushing_t
   contains
      procedure, nopass :: info => bushing_info
      procedure, nopass :: mistake => bushing_mistake
      procedure :: prepare => bushing_prepare
   end type force_bushing_t

contains

   !> Description of the kind.
   function bushing_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.bushing"
      info%space = in_plane
      info%help = "elastic bushing: stiffness and damping along the axes of body i and in rotation"
      info%source = "Adams/Solver, BUSHING"
      call add_reference(info, "i", "points", "point of the first body, whose axes count")
      call add_reference(info, "j", "points", "point of the second body")
      call add_number(info, "angle_i", dim_angle, "angle of the bushing's x axis in body i", default="0 rad")
      call add_number(info, "free_angle", dim_angle, "free angle: angle of j relative to i without moment", default="0 rad")
      call add_number(info, "stiffness_x", dim_stiffness, "stiffness along x", default="0 N/m", lower=0.0_wp)
      call add_number(info, "stiffness_y", dim_stiffness, "stiffness along y", default="0 N/m", lower=0.0_wp)
      call add_number(info, "angular_stiffness", dim_angular_stiffness, "stiffness in rotation", default="0 N.m/rad", &
                      lower=0.0_wp)
      call add_number(info, "damping_x", dim_damping, "damping along x", default="0 N.s/m", lower=0.0_wp)
      call add_number(info, "damping_y", dim_damping, "damping along y", default="0 N.s/m", lower=0.0_wp)
      call add_number(info, "angular_damping", dim_angular_damping, "damping in rotation", default="0 N.m.s/rad", lower=0.0_wp)
      call add_number(info, "damping_time", dim_time, "time that times the stiffness matrix is added to the damping", &
                      default="0 s", lower=0.0_wp)
      call add_number(info, "preload_x", dim_force, "force on the body of i along x at zero displacement", default="0 N")
      call add_number(info, "preload_y", dim_force, "force on the body of i along y at zero displacement", default="0 N")
      call add_number(info, "preload_moment", dim_moment, "moment on the body of i at the free angle", default="0 N.m")
      call add_number(info, "coupling_xy", dim_stiffness, "force along x over a displacement along y, and y over x", &
                      default="0 N/m")
      call add_number(info, "coupling_x", dim_coupling, "force along x over a rotation, and moment over a displacement", &
                      default="0 N/rad")
      call add_number(info, "coupling_y", dim_coupling, "force along y over a rotation, and moment over a displacement", &
                      default="0 N/rad")
      call add_frame_spring_channels(info, "")
   end function bushing_info

   !> Stiffness of a row.
   pure function stiffness_of(item) result(stiffness)
      type(item_t), intent(in) :: item   !! the row
      real(wp) :: stiffness(3, 3)        !! (3, 3) K [N/m, N/rad or N.m/rad]

      stiffness(:, 1) = [item%number("stiffness_x"), item%number("coupling_xy"), item%number("coupling_x")]
      stiffness(:, 2) = [item%number("coupling_xy"), item%number("stiffness_y"), item%number("coupling_y")]
      stiffness(:, 3) = [item%number("coupling_x"), item%number("coupling_y"), item%number("angular_stiffness")]
   end function stiffness_of

   !> A stiffness matrix that gives energy away is a mistake of its couplings.
   subroutine bushing_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      call find_negative_energy(item, stiffness_of(item), "coupling_xy coupling_x coupling_y", column, message, help)
   end subroutine bushing_mistake

   !> Make the set.
   subroutine bushing_prepare(self, items, points)
      class(force_bushing_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      type(points_t), intent(in) :: points           !! all points

      integer :: k

      call self%make_storage(items, points)
      do k = 1, self%n
         associate (item => items(k))
            self%offset(:, k) = [item%number("angle_i"), item%number("angle_i") - item%number("free_angle")]
            self%stiffness(:, :, k) = stiffness_of(item)
            self%damping(:, :, k) = item%number("damping_time")*self%stiffness(:, :, k)
            self%damping(1, 1, k) = self%damping(1, 1, k) + item%number("damping_x")
            self%damping(2, 2, k) = self%damping(2, 2, k) + item%number("damping_y")
            self%damping(3, 3, k) = self%damping(3, 3, k) + item%number("angular_damping")
            self%preload(:, k) = [item%number("preload_x"), item%number("preload_y"), item%number("preload_moment")]
         end associate
      end do
   end subroutine bushing_prepare

end module force_bushing
