!> What springs have in common, whatever their stretch is: a distance of points, or an angle between bodies.
!>
!> With x = l - l_0:
!> f = k x + c l' + f_0 + f_l(x) + f_d(l') + f_a
!> stored energy = k (x + f_0/k)^2/2 + integral of f_l from 0 to x
!> k stiffness, c damping, l_0 free length or angle, f_0 preload (f at x = 0), f_l law of a spring that is not linear, f_d
!> that of a damper that is not, f_a actuator, of time and motion. Without stiffness the preload stores nothing: it is then a
!> constant part of the actuator.
!>
!> Signs: f is positive if it takes l back towards smaller values. Source and limits: those of the kinds.
module spring_law
   use expression, only: expression_t
   use item, only: item_t, place_of
   use kind_info, only: add_expression, add_number, dim_angle, dim_angular_damping, dim_angular_speed, &
      dim_angular_stiffness, dim_moment, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use quadrature, only: integral_of
   use observed_motion, only: value_of
   implicit none (type, external)
   private
   public :: add_turning_law, spring_law_t

   !> The law of one spring. Unit of f: N, or N.m; unit of l: m, or rad.
   type :: spring_law_t
      real(wp) :: stiffness = 0.0_wp    !! k [N/m or N.m/rad]
      real(wp) :: damping = 0.0_wp      !! c [N.s/m or N.m.s/rad]
      real(wp) :: free = 0.0_wp         !! l_0 [m or rad]
      real(wp) :: relaxed = 0.0_wp      !! l without force of the stiffness, l_0 - f_0/k [m or rad]
      real(wp) :: constant = 0.0_wp     !! constant part of the actuator, f_0 without stiffness [N or N.m]
      type(expression_t) :: law         !! f_l over x [N or N.m]
      logical :: has_law = .false.      !! whether it is not zero
      type(expression_t) :: damper      !! f_d over the rate [N or N.m]
      logical :: has_damper = .false.   !! whether it is not zero
      type(expression_t) :: actuator    !! f_a [N or N.m]
   contains
      procedure :: prepare => spring_law_prepare
      procedure :: force => spring_law_force
      procedure :: lost_power => spring_law_lost_power
      procedure :: add_energy => spring_law_add_energy
   end type spring_law_t

contains

   !> Columns of the law of a torsional spring, of the plane and of space.
   subroutine add_turning_law(info)
      type(kind_info_t), intent(inout) :: info  !! the kind, columns are added

      call add_number(info, "stiffness", dim_angular_stiffness, "stiffness", default="0 N.m/rad", lower=0.0_wp)
      call add_number(info, "damping", dim_angular_damping, "coefficient of the damper", default="0 N.m.s/rad", lower=0.0_wp)
      call add_number(info, "free_angle", dim_angle, "free angle: angle of j relative to i without spring moment", &
                      default="0 rad")
      call add_number(info, "preload", dim_moment, "moment on the body of i at the free angle", default="0 N.m")
      call add_expression(info, "actuator", dim_moment, "moment on the body of i as a function of time and motion", &
                          default="0 N.m", sees_motion=.true.)
      call add_expression(info, "damper", dim_moment, "moment as a function of the rate v of the angle, added to the damping", &
                          default="0 N.m", variable="v", argument=[dim_angular_speed])
      call add_expression(info, "law", dim_moment, "moment as a function of the angle x from the free angle, added to the "// &
         "stiffness", &
                          default="0 N.m", variable="x", argument=[dim_angle])
   end subroutine add_turning_law

   !> Take a row of a table.
   subroutine spring_law_prepare(self, item, free)
      class(spring_law_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item            !! the row
      character(*), intent(in) :: free            !! its column for the length or angle without force

      self%stiffness = item%number("stiffness")
      self%damping = item%number("damping")
      self%free = item%number(free)
      self%relaxed = self%free
      self%constant = item%number("preload")
      if (self%stiffness > 0.0_wp) then
         self%relaxed = self%relaxed - self%constant/self%stiffness
         self%constant = 0.0_wp
      end if
      self%actuator = item%values(place_of(item, "actuator"))%expression
      self%law = item%values(place_of(item, "law"))%expression
      self%has_law = .not. self%law%is_constant .or. abs(item%number("law")) > 0.0_wp
      self%damper = item%values(place_of(item, "damper"))%expression
      self%has_damper = .not. self%damper%is_constant .or. abs(item%number("damper")) > 0.0_wp
   end subroutine spring_law_prepare

   !> Force or moment, and what of it the actuator gives.
   pure subroutine spring_law_force(self, t, motion, length, rate, force, actuator)
      class(spring_law_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: t                !! time [s]
      type(motion_t), intent(in) :: motion     !! positions and velocities
      real(wp), intent(in) :: length           !! l [m or rad]
      real(wp), intent(in) :: rate             !! l' [m/s or rad/s]
      real(wp), intent(out) :: force           !! f [N or N.m]
      real(wp), intent(out) :: actuator        !! the actuator's part of it [N or N.m]

      real(wp) :: by_law, first_derivative, second_derivative

      actuator = value_of(self%actuator, t, motion) + self%constant
      force = self%stiffness*(length - self%relaxed) + self%damping*rate + actuator
      if (self%has_damper) then
         call self%damper%evaluate(rate, by_law, first_derivative, second_derivative)
         force = force + by_law
      end if
      if (.not. self%has_law) return
      call self%law%evaluate(length - self%free, by_law, first_derivative, second_derivative)
      force = force + by_law
   end subroutine spring_law_force

   !> Power that the damper takes.
   pure real(wp) function spring_law_lost_power(self, rate) result(power)
      class(spring_law_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: rate             !! l' [m/s or rad/s]

      real(wp) :: by_law, first_derivative, second_derivative

      power = self%damping*rate**2
      if (.not. self%has_damper) return
      call self%damper%evaluate(rate, by_law, first_derivative, second_derivative)
      power = power + by_law*rate
   end function spring_law_lost_power

   !> Add the energy stored by stiffness and law.
   pure subroutine spring_law_add_energy(self, length, energy)
      class(spring_law_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: length           !! l [m or rad]
      real(wp), intent(inout) :: energy        !! of all springs so far [J]

      energy = energy + 0.5_wp*self%stiffness*(length - self%relaxed)**2
      if (self%has_law) energy = energy + integral_of(self%law, length - self%free)
   end subroutine spring_law_add_energy

end module spring_law
