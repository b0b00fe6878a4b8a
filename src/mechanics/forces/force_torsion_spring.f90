!> Torsional spring, damper and actuator between the bodies i and j.
!>
!> With the angle phi = angle_j - angle_i, turns counted:
!> m = k x + c phi' + m_0 + m_l(x) + m_a(t),   x = phi - phi_0
!> stored energy = k (x + m_0/k)^2/2 + integral of m_l from 0 to x
!> lost power = c phi'^2,   power of the actuator = -m_a phi'
!> k stiffness, c damping, phi_0 free angle, m_0 preload (the moment at the free angle), m_l law
!> of a spring that is not linear, m_a actuator. Without stiffness the preload stores nothing: it is then a constant
!> part of the actuator.
!>
!> Signs: m acts on the body of i, channel `moment`, and -m on the body of j; counter-clockwise positive: a positive
!> moment turns the bodies back towards each other as a tension pulls points together. Source: Flores et al. (2008),
!> section 2.3; Nikravesh, Computer-aided analysis of mechanical systems (1988), chapter 9. Limits: none.
module force_torsion_spring
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, add_reference, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use spring_law, only: add_turning_law, spring_law_t
   implicit none (type, external)
   private
   public :: force_torsion_spring_t

   ! channels
   integer, parameter :: of_moment = 1        !! moment
   integer, parameter :: of_angle = 2         !! angle of j relative to i
   integer, parameter :: of_angular_rate = 3  !! its rate
   integer, parameter :: of_power = 4         !! power given to the mechanism

   !> All torsional springs.
   type, extends(force_set_t) :: force_torsion_spring_t
      integer, allocatable :: body(:, :)                !! (2, n) bodies i and j, 0: ground
      type(spring_law_t), allocatable :: law(:)         !! (n) moment over angle and its rate, and actuator
   contains
      procedure, nopass :: info => torsion_info
      procedure :: prepare => torsion_prepare
      procedure :: evaluate => torsion_evaluate
      procedure :: elastic_energy => torsion_elastic_energy
      procedure :: lost_power => torsion_lost_power
      procedure :: load_on => torsion_load_on
      procedure :: report => torsion_report
      procedure :: bodies_of => torsion_bodies
   end type force_torsion_spring_t

contains

   !> Description of the kind.
   function torsion_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "force.torsion_spring"
      info%space = in_plane
      info%help = "torsional spring, damper and actuator between two bodies"
      info%source = "Flores et al. (2008), section 2.3"
      call add_reference(info, "i", "bodies", "first body")
      call add_reference(info, "j", "bodies", "second body")
      call add_turning_law(info)
      call add_channel(info, "moment", "N.m", "world", 1, "moment on the body of i, positive counter-clockwise", of_moment)
      call add_channel(info, "angle", "rad", "none", 1, "angle of j relative to i, counter-clockwise, accumulated over "// &
         "revolutions", of_angle)
      call add_channel(info, "angular_rate", "rad/s", "none", 1, "rate of the angle", of_angular_rate)
      call add_channel(info, "power", "W", "none", 1, "total power of spring, damper and actuator on the bodies", of_power)
   end function torsion_info

   !> Make the set.
   subroutine torsion_prepare(self, items, points)
      class(force_torsion_spring_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                  !! (n) rows of the table
      type(points_t), intent(in) :: points                  !! all points

      integer :: k

      self%n = size(items)
      allocate (self%names(self%n), self%body(2, self%n), self%law(self%n))
      do k = 1, self%n
         associate (item => items(k))
            self%names(k)%s = items(k)%name
            self%body(:, k) = [item%reference("i"), item%reference("j")]
            call self%law(k)%prepare(item, "free_angle")
         end associate
      end do
   end subroutine torsion_prepare

   !> Angle, its rate, moment and what of it the actuator gives.
   pure subroutine moment_of(self, k, t, motion, angle, rate, moment, actuator)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                           !! item
      real(wp), intent(in) :: t                          !! time [s]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      real(wp), intent(out) :: angle                     !! of j relative to i [rad]
      real(wp), intent(out) :: rate                      !! its rate [rad/s]
      real(wp), intent(out) :: moment                    !! on the body of i [N.m]
      real(wp), intent(out) :: actuator                  !! the actuator's part of it [N.m]

      angle = motion%angle(self%body(2, k)) - motion%angle(self%body(1, k))
      rate = motion%omega(3, self%body(2, k)) - motion%omega(3, self%body(1, k))
      call self%law(k)%force(t, motion, angle, rate, moment, actuator)
   end subroutine moment_of

   !> Add the loads of all items; the power is that of the actuators.
   subroutine torsion_evaluate(self, t, motion, loads, power)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                          !! time [s]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      type(loads_t), intent(inout) :: loads              !! loads on the bodies
      real(wp), intent(inout) :: power                   !! power given to the mechanism [W]

      real(wp) :: actuator, angle, moment, rate
      integer :: k

      do k = 1, self%n
         call moment_of(self, k, t, motion, angle, rate, moment, actuator)
         associate (i => self%body(1, k), j => self%body(2, k))
            loads%moment(3, i) = loads%moment(3, i) + moment
            loads%moment(3, j) = loads%moment(3, j) - moment
         end associate
         power = power - actuator*rate
      end do
   end subroutine torsion_evaluate

   !> Energy stored by stiffness and law.
   pure real(wp) function torsion_elastic_energy(self, motion) result(energy)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion               !! positions

      real(wp) :: angle
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n
         angle = motion%angle(self%body(2, k)) - motion%angle(self%body(1, k))
         call self%law(k)%add_energy(angle, energy)
      end do
   end function torsion_elastic_energy

   !> Power lost in the dampers.
   pure real(wp) function torsion_lost_power(self, motion) result(power)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion               !! positions and velocities

      integer :: k

      power = 0.0_wp
      do k = 1, self%n
         power = power + self%law(k)%lost_power(motion%omega(3, self%body(2, k)) - motion%omega(3, self%body(1, k)))
      end do
   end function torsion_lost_power

   !> Moment of an item on the body of i or j.
   subroutine torsion_load_on(self, k, side, t, motion, force, moment, place)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                           !! item
      integer, intent(in) :: side                        !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t                          !! time [s]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      real(wp), intent(out) :: force(3)                  !! (3) none [N]
      real(wp), intent(out) :: moment(3)                 !! (3) world frame [N.m]
      real(wp), intent(out) :: place(3)                  !! (3) centre of mass: any place will do [m]

      real(wp) :: actuator, angle, rate

      force = 0.0_wp
      moment = 0.0_wp
      call moment_of(self, k, t, motion, angle, rate, moment(3), actuator)
      if (side == 2) moment = -moment
      place = motion%r(:, self%body(side, k))
   end subroutine torsion_load_on

   !> Values of a channel for all items.
   subroutine torsion_report(self, code, t, motion, values)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                        !! the channel
      real(wp), intent(in) :: t                          !! time [s]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      real(wp), intent(inout) :: values(:, :)            !! (components, n) values [N.m, rad, rad/s or W]

      real(wp) :: actuator, angle, moment, rate
      integer :: k

      do k = 1, self%n
         call moment_of(self, k, t, motion, angle, rate, moment, actuator)
         select case (code)
         case (of_moment)
            values(1, k) = moment
         case (of_angle)
            values(1, k) = angle
         case (of_angular_rate)
            values(1, k) = rate
         case (of_power)
            values(1, k) = -moment*rate
         end select
      end do
   end subroutine torsion_report

   !> The bodies that an item acts on.
   pure function torsion_bodies(self, i) result(bodies)
      class(force_torsion_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: i                              !! number of the item
      integer :: bodies(2)                                  !! both, 0: ground

      bodies = self%body(:, i)
   end function torsion_bodies

end module force_torsion_spring
