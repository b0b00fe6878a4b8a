!> Elastic elements between a frame of body i and a frame of body j in space: what bushings and beams have in common.
!>
!> R_i, R_j: axes of the frames, columns in the world; d: from the point of i to that of j. The rotation vector psi of j against i
!> (axis times angle, along the axes of i) and the displacement u are
!>
!> exp(psi) = R_i^T R_j,   u = R_s^T d - u_0,   R_s = R_i exp(s psi),   s = 0: axes of i, s = 1/2: axes halfway between i and j
!>
!> With x = (u, psi), stiffness K and damping C (both symmetric) and preload p:
!>
!> Q = K x + C x' + p,   stored energy = x^T K x/2 + p . x,   lost power = x'^T C x'
!> psi' = J(psi)^-1 R_i^T (w_j - w_i),   u' = R_s^T (d' - w_s x d),   w_s = w_i + s R_i J(s psi) psi'
!>
!> The loads are those of the virtual work -Q . dx: with f = R_s Q_u and m = d x f
!>
!> force f on i at its point and -f on j at its,   couples m - h on i and h on j,   h = R_i J(psi)^-T (s J(s psi)^T R_i^T m - Q_psi)
!>
!> so that forces and moments are in balance, and the power is that of energy and loss, at any rotation.
!> Signs: x is that of j relative to i; f pulls the points together where u and K are positive.
!> Source: the maps J of `rotation_maps`; the loads follow from the virtual work as written here. Limits: |psi| less than half a
!> turn, where its direction has no value: `is_lost`.
module spatial_frame_spring
   use archive, only: archive_t
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: pi, wp
   use motion, only: cross, loads_t, motion_t, point_position, point_velocity
   use rotation_maps, only: inverse_map_of, map_of
   use rotations, only: euler_parameters_of, rotation_about, rotation_vector_of
   implicit none (type, external)
   private
   public :: add_frame_spring_channels, frame_spring_t, words_of_half_turn

   ! channels
   integer, parameter :: of_force = 1         !! force
   integer, parameter :: of_moment = 2        !! moment
   integer, parameter :: of_deflection = 3    !! u
   integer, parameter :: of_rotation = 4      !! psi
   integer, parameter :: of_inner_force = 5   !! Q_u
   integer, parameter :: of_inner_moment = 6  !! Q_psi
   integer, parameter :: of_power = 7         !! power given to the mechanism

   !> Elastic elements of a kind; the kind sets all components.
   type, abstract, extends(force_set_t) :: frame_spring_t
      integer, allocatable :: body(:, :)            !! (2, n) bodies i and j, 0: ground
      real(wp), allocatable :: s(:, :, :)           !! (3, 2, n) points of i and of j, frames of the bodies [m]
      real(wp), allocatable :: frame(:, :, :, :)    !! (3, 3, 2, n) axes x, y, z of i and of j as columns, frames of the bodies [1]
      real(wp) :: share = 0.0_wp                    !! s: part of the rotation that the axes make, 0 or 1/2 [1]
      real(wp), allocatable :: free(:, :)           !! (3, n) u_0 [m]
      real(wp), allocatable :: stiffness(:, :, :)   !! (6, 6, n) K [N/m, N/rad or N.m/rad]
      real(wp), allocatable :: damping(:, :, :)     !! (6, 6, n) C [N.s/m, N.s/rad or N.m.s/rad]
      real(wp), allocatable :: preload(:, :)        !! (6, n) p [N or N.m]
      real(wp), allocatable :: turned(:, :)         !! (3, n) psi at the end of the last step [rad]
      logical, allocatable :: is_lost(:)            !! (n) whether a rotation has passed half a turn
   contains
      procedure :: make_storage
      procedure :: follow => frame_spring_follow
      procedure :: evaluate => frame_spring_evaluate
      procedure :: elastic_energy => frame_spring_elastic_energy
      procedure :: lost_power => frame_spring_lost_power
      procedure :: load_on => frame_spring_load_on
      procedure :: report => frame_spring_report
      procedure :: bodies_of => frame_spring_bodies
      procedure :: save => frame_spring_save
      procedure :: load => frame_spring_load
   end type frame_spring_t

   !> Deflection of an item.
   type :: deflection_t
      real(wp) :: x(6) = 0.0_wp       !! (6) u and psi [m and rad]
      real(wp) :: rate(6) = 0.0_wp    !! (6) their rates [m/s and rad/s]
      real(wp) :: axes(3, 3) = 0.0_wp !! (3, 3) R_s [1]
      real(wp) :: of_i(3, 3) = 0.0_wp !! (3, 3) R_i [1]
      real(wp) :: d(3) = 0.0_wp       !! (3) from the point of i to that of j, world frame [m]
   end type deflection_t

contains

   include "frame_spring.inc"

   !> Channels of every element.
   subroutine add_frame_spring_channels(info, place)
      type(kind_info_t), intent(inout) :: info   !! the kind, channels are added
      character(*), intent(in) :: place          !! where along the element its inner forces are, for the help

      call add_channel(info, "force", "N", "world", 2, "force on the body of i at its point", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the body of i about its point", of_moment)
      call add_channel(info, "deflection", "m", "joint", 2, "displacement of j relative to i, along the axes of the element", &
                       of_deflection)
      call add_channel(info, "rotation", "rad", "joint", 2, "rotation vector of j relative to i, along the axes of i", of_rotation)
      call add_channel(info, "inner_force", "N", "joint", 2, "force along the axes of the element"//place// &
                       ", positive where it opposes a positive displacement", of_inner_force)
      call add_channel(info, "inner_moment", "N.m", "joint", 2, "moment about the axes of the element"//place// &
                       ", positive where it opposes a positive rotation", of_inner_moment)
      call add_channel(info, "power", "W", "none", 1, "total power of stiffness and damping on the bodies", of_power)
   end subroutine add_frame_spring_channels

   !> Storage for the rows of a table, without stiffness; names, bodies and points are set.
   subroutine make_storage(self, items, points)
      class(frame_spring_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      type(points_t), intent(in) :: points          !! all points

      integer :: n

      n = size(items)
      self%n = n
      allocate (self%names(n), self%is_lost(n))
      allocate (self%body(2, n), source=0)
      allocate (self%s(3, 2, n), self%frame(3, 3, 2, n), self%free(3, n), self%stiffness(6, 6, n), self%damping(6, 6, n), &
                self%preload(6, n), self%turned(3, n), source=0.0_wp)
      self%is_lost = .false.
      call take_rows(self, items, points)
   end subroutine make_storage

   !> Rotation vector of an item: of j against i, along the axes of i.
   pure function rotation_of(self, k, motion) result(psi)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      real(wp) :: psi(3)                         !! (3) at most half a turn [rad]

      real(wp) :: r_i(3, 3), r_j(3, 3)

      r_i = matmul(motion%rot(:, :, self%body(1, k)), self%frame(:, :, 1, k))
      r_j = matmul(motion%rot(:, :, self%body(2, k)), self%frame(:, :, 2, k))
      psi = rotation_vector_of([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], euler_parameters_of(matmul(transpose(r_i), r_j)))
   end function rotation_of

   !> Deflection of an item and its rate.
   pure subroutine find_deflection(self, k, motion, it)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(deflection_t), intent(out) :: it      !! the deflection

      real(wp) :: p_i(3), p_j(3), psi(3), w(3)

      associate (i => self%body(1, k), j => self%body(2, k))
         psi = rotation_of(self, k, motion)
         it%of_i = matmul(motion%rot(:, :, i), self%frame(:, :, 1, k))
         it%axes = it%of_i
         if (self%share > 0.0_wp .and. norm2(psi) > 0.0_wp) it%axes = matmul(it%of_i, rotation_about(psi, self%share*norm2(psi)))
         p_i = point_position(motion, i, self%s(:, 1, k))
         p_j = point_position(motion, j, self%s(:, 2, k))
         it%d = p_j - p_i
         it%x(1:3) = matmul(it%d, it%axes) - self%free(:, k)
         it%x(4:6) = psi
         it%rate(4:6) = inverse_map_of(matmul(motion%omega(:, j) - motion%omega(:, i), it%of_i), psi, .false.)
         w = motion%omega(:, i)
         if (self%share > 0.0_wp) then
            w = w + matmul(it%of_i, self%share*map_of(it%rate(4:6), self%share*psi, .false.))
         end if
         it%rate(1:3) = matmul(point_velocity(motion, j, p_j) - point_velocity(motion, i, p_i) - cross(w, it%d), it%axes)
      end associate
   end subroutine find_deflection

   !> Deflection and loads of an item.
   pure subroutine find_loads(self, k, motion, it, q, force, couple_i, couple_j)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(deflection_t), intent(out) :: it      !! the deflection
      real(wp), intent(out) :: q(6)              !! (6) Q [N and N.m]
      real(wp), intent(out) :: force(3)          !! (3) on the body of i at its point, world frame [N]
      real(wp), intent(out) :: couple_i(3)       !! (3) on the body of i, world frame [N.m]
      real(wp), intent(out) :: couple_j(3)       !! (3) on the body of j, world frame [N.m]

      real(wp) :: g(3), m(3)

      call find_deflection(self, k, motion, it)
      q = matmul(self%stiffness(:, :, k), it%x) + matmul(self%damping(:, :, k), it%rate) + self%preload(:, k)
      force = matmul(it%axes, q(1:3))
      m = cross(it%d, force)
      g = -q(4:6)
      if (self%share > 0.0_wp) g = g + self%share*map_of(matmul(m, it%of_i), self%share*it%x(4:6), .true.)
      couple_j = matmul(it%of_i, inverse_map_of(g, it%x(4:6), .true.))
      couple_i = m - couple_j
   end subroutine find_loads

   !> Add the loads of all items; none of their power is but stored or lost.
   subroutine frame_spring_evaluate(self, t, motion, loads, power)
      class(frame_spring_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(loads_t), intent(inout) :: loads      !! loads on the bodies
      real(wp), intent(inout) :: power           !! left as it is [W]

      type(deflection_t) :: it
      real(wp) :: couple(3, 2), f(3), q(6)
      integer :: body, k, side

      do k = 1, self%n
         call find_loads(self, k, motion, it, q, f, couple(:, 1), couple(:, 2))
         do side = 1, 2
            body = self%body(side, k)
            loads%force(:, body) = loads%force(:, body) + f
            loads%moment(:, body) = loads%moment(:, body) + couple(:, side) &
                                    + cross(point_position(motion, body, self%s(:, side, k)) - motion%r(:, body), f)
            f = -f
         end do
      end do
   end subroutine frame_spring_evaluate

   !> Load of an item on the body of i or j, about its point.
   subroutine frame_spring_load_on(self, k, side, t, motion, force, moment, place)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: side                !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: force(3)          !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)         !! (3) about the point, world frame [N.m]
      real(wp), intent(out) :: place(3)          !! (3) the point, world frame [m]

      type(deflection_t) :: it
      real(wp) :: couple(3, 2), q(6)

      call find_loads(self, k, motion, it, q, force, couple(:, 1), couple(:, 2))
      if (side == 2) force = -force
      moment = couple(:, side)
      place = point_position(motion, self%body(side, k), self%s(:, side, k))
   end subroutine frame_spring_load_on

   !> Values of a channel for all items.
   subroutine frame_spring_report(self, code, t, motion, values)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                !! the channel
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(inout) :: values(:, :)    !! (components, n) values [N, N.m, m, rad or W]

      type(deflection_t) :: it
      real(wp) :: couple(3, 2), f(3), q(6)
      integer :: k

      do k = 1, self%n
         call find_loads(self, k, motion, it, q, f, couple(:, 1), couple(:, 2))
         select case (code)
         case (of_force); values(:, k) = f
         case (of_moment); values(:, k) = couple(:, 1)
         case (of_deflection); values(:, k) = it%x(1:3)
         case (of_rotation); values(:, k) = it%x(4:6)
         case (of_inner_force); values(:, k) = q(1:3)
         case (of_inner_moment); values(:, k) = q(4:6)
         case (of_power); values(1, k) = -dot_product(q, it%rate)
         end select
      end do
   end subroutine frame_spring_report

   !> A step has ended: a rotation vector that has turned about went through half a turn.
   subroutine frame_spring_follow(self, motion)
      class(frame_spring_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion          !! positions

      real(wp) :: psi(3)
      integer :: k

      do k = 1, self%n
         psi = rotation_of(self, k, motion)
         self%is_lost(k) = self%is_lost(k) .or. (dot_product(psi, self%turned(:, k)) < 0.0_wp .and. &
                                                 min(norm2(psi), norm2(self%turned(:, k))) > 0.5_wp*pi)
         self%turned(:, k) = psi
      end do
   end subroutine frame_spring_follow

   !> That a rotation has passed half a turn: what follows its name in a message.
   function words_of_half_turn() result(words)
      character(:), allocatable :: words   !! what is wrong

      words = "has turned by more than half a revolution: its rotation vector has no value there; guide the bodies by joints, "// &
              "or use force.torsion_spring, which counts turns"
   end function words_of_half_turn

   !> Write what the set remembers.
   subroutine frame_spring_save(self, archive)
      class(frame_spring_t), intent(in) :: self  !! the set
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      integer :: k

      do k = 1, self%n
         call archive%put(self%turned(:, k))
      end do
   end subroutine frame_spring_save

   !> Read what the set remembers.
   subroutine frame_spring_load(self, archive)
      class(frame_spring_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive     !! the checkpoint

      integer :: c, k

      do k = 1, self%n
         do c = 1, 3
            call archive%get(self%turned(c, k))
         end do
      end do
   end subroutine frame_spring_load

end module spatial_frame_spring
