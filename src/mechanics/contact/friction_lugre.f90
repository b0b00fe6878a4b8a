!> LuGre friction: surfaces hold each other by bristles, whose mean deflection z is a state of the contact.
!>
!> z' = v_T - sigma0 |v_T| z / g(|v_T|),   g = c_f + (c_s - c_f) exp(-(v_T / v_s)^2)
!> F_T = F_N (sigma0 z + sigma1 z' + sigma2 v_T)
!>
!> With steady sliding z = g / sigma0 and F_T = F_N (g + sigma2 |v_T|). A contact starts with z = 0. Below c_s F_N it gives by
!> z only, so that a body on a slope rests. The sigmas are those of the literature over the normal force.
!>
!> In space z and v_T are vectors of the tangent plane.
!>
!> Signs: against the sliding velocity. Source: C. Canudas de Wit, H. Olsson, K. J. Astrom and P. Lischinsky, A new model for
!> control of systems with friction, IEEE Trans. Autom. Control 40 (1995) 419-425, eqs. (3)-(7), with forces in proportion to
!> the normal one. Limits: stiff, with the rate sigma0 |v_T| / g; the energy of the bristles counts as lost by friction, and
!> what of it they give back comes back there.
module friction_lugre
   use friction_law, only: friction_law_t, memory_bristle
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_speed, dim_t, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_lugre_t

   !> Friction by bristles.
   type, extends(friction_law_t) :: friction_lugre_t
      real(wp) :: coefficient = 0.0_wp         !! of fast sliding, c_f [1]
      real(wp) :: static_coefficient = 0.0_wp  !! of the slowest sliding, c_s [1]
      real(wp) :: stribeck = 1.0_wp            !! speed at which the one goes over into the other, v_s [m/s]
      real(wp) :: stiffness = 1.0_wp           !! of the bristles over the normal force, sigma0 [1/m]
      real(wp) :: damping = 0.0_wp             !! of the bristles over the normal force, sigma1 [s/m]
      real(wp) :: viscosity = 0.0_wp           !! over the normal force, sigma2 [s/m]
   contains
      procedure, nopass :: info => lugre_info
      procedure :: prepare => lugre_prepare
      procedure :: is_active => lugre_is_active
      procedure :: force => lugre_force
      procedure :: bristles => lugre_bristles
      procedure :: bristle_scale => lugre_bristle_scale
      procedure :: mistake => lugre_mistake
   end type friction_lugre_t

contains

   !> Description of the kind.
   function lugre_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.lugre"
      info%help = "LuGre friction: elastic bristles with an internal state, Stribeck effect and viscous friction"
      info%source = "Canudas de Wit, Olsson, Astrom and Lischinsky (1995), eqs. (3)-(7)"
      call add_number(info, "coefficient", dim_none, "sliding friction coefficient at high speed; 0: frictionless", lower=0.0_wp)
      call add_number(info, "static_coefficient", dim_none, "static friction coefficient; 0: equal to the sliding coefficient", &
                      default="0", lower=0.0_wp)
      call add_number(info, "stribeck_speed", dim_speed, "Stribeck speed", default="1e-3 m/s", &
                      lower=0.0_wp, open_lower=.true.)
      call add_number(info, "bristle_stiffness", dim_t(m=-1), "bristle stiffness over the normal force (sigma0)", &
                      default="1e5 m^-1", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "bristle_damping", dim_t(m=-1, s=1), "bristle damping over the normal force (sigma1)", &
                      default="100 s/m", lower=0.0_wp)
      call add_number(info, "viscosity", dim_t(m=-1, s=1), "viscous friction over the normal force (sigma2)", default="0 s/m", &
                      lower=0.0_wp)
   end function lugre_info

   !> Take the parameters.
   subroutine lugre_prepare(self, item)
      class(friction_lugre_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                !! the row

      self%name = item%name
      self%memory = memory_bristle
      self%coefficient = item%number("coefficient")
      self%static_coefficient = item%number("static_coefficient")
      if (self%static_coefficient <= 0.0_wp) self%static_coefficient = self%coefficient
      self%stribeck = item%number("stribeck_speed")
      self%stiffness = item%number("bristle_stiffness")
      self%damping = item%number("bristle_damping")
      self%viscosity = item%number("viscosity")
   end subroutine lugre_prepare

   !> Without a coefficient of fast sliding there is no friction.
   pure logical function lugre_is_active(self)
      class(friction_lugre_t), intent(in) :: self  !! the law

      lugre_is_active = self%coefficient > 0.0_wp
   end function lugre_is_active

   !> What holds must not let go of less than what slides.
   function lugre_mistake(self) result(message)
      class(friction_lugre_t), intent(in) :: self  !! the law
      character(:), allocatable :: message         !! one line, empty: all is well

      message = ""
      if (self%static_coefficient < self%coefficient) message = "static_coefficient must not be smaller than coefficient"
   end function lugre_mistake

   !> Magnitude of the friction force of n contacts that slide steadily.
   pure subroutine lugre_force(self, n, normal_force, speed, f)
      class(friction_lugre_t), intent(in) :: self     !! the law
      integer, intent(in) :: n                        !! number of contacts
      real(wp), intent(in) :: normal_force(n)         !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)                !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)                   !! (n) magnitude of the friction force [N]

      integer :: k

      do k = 1, n
         f(k) = normal_force(k)*(steady(self, speed(k)) + self%viscosity*speed(k))
      end do
   end subroutine lugre_force

   !> Steady coefficient of friction without viscosity, g.
   pure real(wp) function steady(self, speed) result(g)
      class(friction_lugre_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: speed                !! sliding velocity [m/s]

      g = self%coefficient + (self%static_coefficient - self%coefficient)*exp(-(speed/self%stribeck)**2)
   end function steady

   !> Force and rate of the bristles of one contact.
   pure subroutine lugre_bristles(self, n, normal_force, velocity, z, f, z_rate)
      class(friction_lugre_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                     !! components: 1 in the plane, 3 in space
      real(wp), intent(in) :: normal_force         !! normal force [N]
      real(wp), intent(in) :: velocity(n)          !! (n) sliding velocity [m/s]
      real(wp), intent(in) :: z(n)                 !! (n) deflection of the bristles [m]
      real(wp), intent(out) :: f(n)                !! (n) force along the sliding velocity that is to be opposed [N]
      real(wp), intent(out) :: z_rate(n)           !! (n) rate of the deflection [m/s]

      real(wp) :: speed

      speed = norm2(velocity)
      z_rate = velocity - self%stiffness*speed*z/steady(self, speed)
      f = normal_force*(self%stiffness*z + self%damping*z_rate + self%viscosity*velocity)
   end subroutine lugre_bristles

   !> The maximum deflection that lasts.
   pure real(wp) function lugre_bristle_scale(self) result(z)
      class(friction_lugre_t), intent(in) :: self  !! the law

      z = self%static_coefficient/self%stiffness
   end function lugre_bristle_scale

end module friction_lugre
