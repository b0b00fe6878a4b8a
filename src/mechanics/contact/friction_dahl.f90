!> Dahl friction: surfaces hold each other as an elastic solid that yields, by a deflection z that is a state of the contact.
!>
!> z' = v_T |1 - x|^i sign(1 - x),   x = sigma z sign(v_T) / mu,   F_T = F_N sigma z
!>
!> With steady sliding z = mu/sigma and F_T = mu F_N. A contact starts with z = 0; from there, sliding one way by s with i = 1,
!> F_T = mu F_N (1 - exp(-sigma s/mu)), at any speed. Below mu F_N it gives by z only, so that a body on a slope rests.
!>
!> In space z and v_T are vectors: the part of z along v_T follows the law, the part across it, z_c, fades with z_c' = -|v_T| sigma
!> z_c/mu, so that with i = 1 it is z' = v_T - |v_T| sigma z/mu.
!>
!> Signs: against the sliding velocity. Source: P. R. Dahl, A solid friction model, Aerospace Corporation report
!> TOR-0158(3107-18)-1 (1968), with forces in proportion to the normal one. Limits: no dip after Stribeck and no viscous part;
!> the energy of the deflection counts as lost by friction, and what of it comes back comes back there.
module friction_dahl
   use friction_law, only: friction_law_t, memory_bristle
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_t, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_dahl_t

   !> Friction of an elastic solid that yields.
   type, extends(friction_law_t) :: friction_dahl_t
      real(wp) :: coefficient = 0.0_wp  !! mu [1]
      real(wp) :: stiffness = 1.0_wp    !! over the normal force, sigma [1/m]
      real(wp) :: exponent = 1.0_wp     !! i [1]
   contains
      procedure, nopass :: info => dahl_info
      procedure :: prepare => dahl_prepare
      procedure :: is_active => dahl_is_active
      procedure :: force => dahl_force
      procedure :: bristles => dahl_bristles
      procedure :: bristle_scale => dahl_bristle_scale
   end type friction_dahl_t

contains

   !> Description of the kind.
   function dahl_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.dahl"
      info%help = "Dahl friction: elastic deflection with an internal state, limited by the friction coefficient"
      info%source = "Dahl (1968)"
      call add_number(info, "coefficient", dim_none, "friction coefficient; 0: frictionless", lower=0.0_wp)
      call add_number(info, "stiffness", dim_t(m=-1), "stiffness over the normal force (sigma)", &
                      default="1e5 m^-1", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "exponent", dim_none, "exponent (i): 1 for ductile, smaller for brittle materials", &
                      default="1", lower=0.5_wp, upper=4.0_wp)
   end function dahl_info

   !> Take the parameters.
   subroutine dahl_prepare(self, item)
      class(friction_dahl_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item               !! the row

      self%name = item%name
      self%memory = memory_bristle
      self%coefficient = item%number("coefficient")
      self%stiffness = item%number("stiffness")
      self%exponent = item%number("exponent")
   end subroutine dahl_prepare

   !> Without a coefficient there is no friction.
   pure logical function dahl_is_active(self)
      class(friction_dahl_t), intent(in) :: self  !! the law

      dahl_is_active = self%coefficient > 0.0_wp
   end function dahl_is_active

   !> Magnitude of the friction force of n contacts that slide steadily.
   pure subroutine dahl_force(self, n, normal_force, speed, f)
      class(friction_dahl_t), intent(in) :: self      !! the law
      integer, intent(in) :: n                        !! number of contacts
      real(wp), intent(in) :: normal_force(n)         !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)                !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)                   !! (n) magnitude of the friction force [N]

      f = self%coefficient*normal_force
   end subroutine dahl_force

   !> Force and rate of the deflection of one contact.
   pure subroutine dahl_bristles(self, n, normal_force, velocity, z, f, z_rate)
      class(friction_dahl_t), intent(in) :: self   !! the law
      integer, intent(in) :: n                     !! components: 1 in the plane, 3 in space
      real(wp), intent(in) :: normal_force         !! normal force [N]
      real(wp), intent(in) :: velocity(n)          !! (n) sliding velocity [m/s]
      real(wp), intent(in) :: z(n)                 !! (n) deflection [m]
      real(wp), intent(out) :: f(n)                !! (n) force along the sliding velocity that is to be opposed [N]
      real(wp), intent(out) :: z_rate(n)           !! (n) rate of the deflection [m/s]

      real(wp) :: along, bent(n), direction(n), left, speed

      f = normal_force*self%stiffness*z
      z_rate = 0.0_wp
      speed = norm2(velocity)
      if (.not. speed > 0.0_wp) return
      direction = velocity/speed
      bent = self%stiffness/self%coefficient*z
      along = dot_product(direction, bent)
      left = 1.0_wp - along
      z_rate = speed*(sign(abs(left)**self%exponent, left)*direction - (bent - along*direction))
   end subroutine dahl_bristles

   !> The maximum deflection that lasts.
   pure real(wp) function dahl_bristle_scale(self) result(z)
      class(friction_dahl_t), intent(in) :: self  !! the law

      z = self%coefficient/self%stiffness
   end function dahl_bristle_scale

end module friction_dahl
