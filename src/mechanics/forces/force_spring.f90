!> Translational spring, damper and actuator between a point of i and a point of j.
!>
!> With d = r_j + s_j - r_i - s_i, l = |d|, u = d/l:
!> f = k x + c l' + f_0 + f_l(x) + f_d(l') + f_a,   x = l - l_0
!> stored energy = k (x + f_0/k)^2/2 + integral of f_l from 0 to x
!> lost power = c l'^2 + f_d l',   power of the actuator = -f_a l'
!> k stiffness, c damping, l_0 free length, f_0 preload (the tension at the free length), f_l law
!> of a spring that is not linear, f_a actuator. Without stiffness the preload stores nothing: it is then a constant
!> part of the actuator.
!>
!> Signs: f, channel `tension`, is positive if it pulls the points together; f u acts on the body of i at its
!> point, channel `force`, and -f u on the body of j. Source: Flores et al. (2008), section 2.3; Nikravesh,
!> Computer-aided analysis of mechanical systems (1988), chapter 9 (the pull positive). Limits: where the
!> points coincide there is no direction and no force is applied; a spring without free length, preload and
!> actuator has none there anyhow.
module force_spring
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, add_expression, add_number, add_reference, dim_damping, dim_force, dim_length, &
      dim_speed, dim_stiffness, kind_info_t
   use kinds, only: wp
   use motion, only: apply_force, loads_t, motion_t, point_position
   use span, only: span_of
   use spring_law, only: spring_law_t
   implicit none (type, external)
   private
   public :: force_spring_t

   ! channels
   integer, parameter :: of_force = 1    !! force
   integer, parameter :: of_tension = 2  !! force along the line of the points
   integer, parameter :: of_length = 3   !! distance of the points
   integer, parameter :: of_rate = 4     !! its rate
   integer, parameter :: of_power = 5    !! power given to the mechanism

   !> All translational springs.
   type, extends(force_set_t) :: force_spring_t
      integer, allocatable :: body(:, :)                !! (2, n) bodies i and j, 0: ground
      real(wp), allocatable :: s_i(:, :)                !! (3, n) point of body i, its frame [m]
      real(wp), allocatable :: s_j(:, :)                !! (3, n) point of body j, its frame [m]
      type(spring_law_t), allocatable :: law(:)         !! (n) tension over length and its rate, and actuator
   contains
      procedure, nopass :: info => spring_info
      procedure :: prepare => spring_prepare
      procedure :: evaluate => spring_evaluate
      procedure :: elastic_energy => spring_elastic_energy
      procedure :: lost_power => spring_lost_power
      procedure :: load_on => spring_load_on
      procedure :: report => spring_report
      procedure :: bodies_of => spring_bodies
   end type force_spring_t

contains

   !> Description of the kind.
   function spring_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.spring"
      info%help = "spring, damper and actuator between two points"
      info%source = "Flores et al. (2008), section 2.3"
      call add_reference(info, "i", "points", "point of the first body")
      call add_reference(info, "j", "points", "point of the second body")
      call add_number(info, "stiffness", dim_stiffness, "stiffness", default="0 N/m", lower=0.0_wp)
      call add_number(info, "damping", dim_damping, "coefficient of the damper", default="0 N.s/m", lower=0.0_wp)
      call add_number(info, "free_length", dim_length, "free length: distance of the points without spring force", &
                      default="0 m", lower=0.0_wp)
      call add_number(info, "preload", dim_force, "preload: tension at the free length, negative for compression", default="0 N")
      call add_expression(info, "actuator", dim_force, "tension of an actuator as a function of time and motion", default="0 N", &
                          sees_motion=.true.)
      call add_expression(info, "damper", dim_force, "tension as a function of the rate v of the length, added to the damping", &
                          default="0 N", variable="v", argument=[dim_speed])
      call add_expression(info, "law", dim_force, "tension as a function of the elongation x from the free length, added to the " &
                          //"stiffness", default="0 N", variable="x", argument=[dim_length])
      call add_channel(info, "force", "N", "world", 2, "force on the body of i", of_force)
      call add_channel(info, "tension", "N", "none", 1, "force along the line of the points, positive in tension", &
                       of_tension)
      call add_channel(info, "length", "m", "none", 1, "distance of the points", of_length)
      call add_channel(info, "rate", "m/s", "none", 1, "rate of the distance", of_rate)
      call add_channel(info, "power", "W", "none", 1, "total power of spring, damper and actuator on the bodies", of_power)
   end function spring_info

   !> Make the set.
   subroutine spring_prepare(self, items, points)
      class(force_spring_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      type(points_t), intent(in) :: points          !! all points

      integer :: i, j, k

      self%n = size(items)
      allocate (self%names(self%n), self%body(2, self%n), self%s_i(3, self%n), self%s_j(3, self%n), self%law(self%n))
      do k = 1, self%n
         associate (item => items(k))
            i = item%reference("i")
            j = item%reference("j")
            self%names(k)%s = items(k)%name
            self%body(:, k) = [points%body(i), points%body(j)]
            self%s_i(:, k) = points%s(:, i)
            self%s_j(:, k) = points%s(:, j)
            call self%law(k)%prepare(item, "free_length")
         end associate
      end do
   end subroutine spring_prepare

   !> Length, tension and what of it the actuator gives.
   pure subroutine tension_of(self, k, t, motion, u, length, rate, tension, actuator)
      class(force_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: u(3)              !! (3) direction from i to j, world frame; zero if there is none [1]
      real(wp), intent(out) :: length            !! distance of the points [m]
      real(wp), intent(out) :: rate              !! its rate [m/s]
      real(wp), intent(out) :: tension           !! force that pulls the points together [N]
      real(wp), intent(out) :: actuator          !! the actuator's part of it [N]

      call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
      call self%law(k)%force(t, motion, length, rate, tension, actuator)
   end subroutine tension_of

   !> Add the loads of all items; the power is that of the actuators.
   subroutine spring_evaluate(self, t, motion, loads, power)
      class(force_spring_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(loads_t), intent(inout) :: loads      !! loads on the bodies
      real(wp), intent(inout) :: power           !! power given to the mechanism [W]

      real(wp) :: actuator, length, rate, tension, u(3)
      integer :: k

      do k = 1, self%n
         call tension_of(self, k, t, motion, u, length, rate, tension, actuator)
         associate (i => self%body(1, k), j => self%body(2, k))
            call apply_force(loads, motion, i, point_position(motion, i, self%s_i(:, k)), tension*u)
            call apply_force(loads, motion, j, point_position(motion, j, self%s_j(:, k)), -tension*u)
         end associate
         power = power - actuator*rate
      end do
   end subroutine spring_evaluate

   !> Energy stored by stiffness and law.
   pure real(wp) function spring_elastic_energy(self, motion) result(energy)
      class(force_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion       !! positions

      real(wp) :: length, rate, u(3)
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n
         call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
         call self%law(k)%add_energy(length, energy)
      end do
   end function spring_elastic_energy

   !> Power lost in the dampers.
   pure real(wp) function spring_lost_power(self, motion) result(power)
      class(force_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion       !! positions and velocities

      real(wp) :: length, rate, u(3)
      integer :: k

      power = 0.0_wp
      do k = 1, self%n
         call span_of(motion, self%body(:, k), self%s_i(:, k), self%s_j(:, k), u, length, rate)
         power = power + self%law(k)%lost_power(rate)
      end do
   end function spring_lost_power

   !> Load of an item on the body of i or j, at its point.
   subroutine spring_load_on(self, k, side, t, motion, force, moment, place)
      class(force_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: side                !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: force(3)          !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)         !! (3) about the point: none [N.m]
      real(wp), intent(out) :: place(3)          !! (3) the point, world frame [m]

      real(wp) :: actuator, length, rate, tension, u(3)

      call tension_of(self, k, t, motion, u, length, rate, tension, actuator)
      moment = 0.0_wp
      if (side == 1) then
         force = tension*u
         place = point_position(motion, self%body(1, k), self%s_i(:, k))
      else
         force = -tension*u
         place = point_position(motion, self%body(2, k), self%s_j(:, k))
      end if
   end subroutine spring_load_on

   !> Values of a channel for all items.
   subroutine spring_report(self, code, t, motion, values)
      class(force_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                !! the channel
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(inout) :: values(:, :)    !! (components, n) values [N, m, m/s or W]

      real(wp) :: actuator, length, rate, tension, u(3)
      integer :: k

      do k = 1, self%n
         call tension_of(self, k, t, motion, u, length, rate, tension, actuator)
         select case (code)
         case (of_force)
            values(:, k) = tension*u(1:size(values, 1))
         case (of_tension)
            values(1, k) = tension
         case (of_length)
            values(1, k) = length
         case (of_rate)
            values(1, k) = rate
         case (of_power)
            values(1, k) = -tension*rate
         end select
      end do
   end subroutine spring_report

   !> The bodies that an item acts on.
   pure function spring_bodies(self, i) result(bodies)
      class(force_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                      !! number of the item
      integer :: bodies(2)                          !! both, 0: ground

      bodies = self%body(:, i)
   end function spring_bodies

end module force_spring
