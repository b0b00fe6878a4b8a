!> Friction that falls from the static to the sliding one after Stribeck, and rises with a viscous part.
!>
!> F_T = F_N { [ mu_d + (mu_s - mu_d) exp(-(v/v_s)^p) ] tanh(v/v_0) + c_v v }
!>
!> v_0 is the speed over which the force rises from zero: well below v_s the maximum coefficient is near mu_s. Smooth for v > 0.
!> Signs: against the sliding velocity. Source: the exponential of J. Tustin (1947) with Bo and Pavelescu's exponent p,
!> as in B. Armstrong-Helouvry, P. Dupont and C. Canudas de Wit, A survey of models, analysis tools and compensation methods for
!> the control of machines with friction, Automatica 30 (1994), 1083-1138; tanh in place of the jump at rest.
!> Limits: no sticking: a body on a slope creeps at a speed below v_0.
module friction_stribeck
   use friction_law, only: friction_law_t
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_speed, dim_t, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_stribeck_t

   !> Stribeck's curve.
   type, extends(friction_law_t) :: friction_stribeck_t
      real(wp) :: coefficient = 0.0_wp  !! mu_d [1]
      real(wp) :: static = 0.0_wp       !! mu_s [1]
      real(wp) :: stribeck = 1.0_wp     !! v_s [m/s]
      real(wp) :: rise = 1.0_wp         !! v_0 [m/s]
      real(wp) :: exponent = 2.0_wp     !! p [1]
      real(wp) :: viscous = 0.0_wp      !! c_v [s/m]
   contains
      procedure, nopass :: info => stribeck_info
      procedure :: prepare => stribeck_prepare
      procedure :: is_active => stribeck_is_active
      procedure :: force => stribeck_force
      procedure :: mistake => stribeck_mistake
   end type friction_stribeck_t

contains

   !> Description of the kind.
   function stribeck_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.stribeck"
      info%help = "Stribeck friction: exponential transition from static to sliding friction, plus a viscous term"
      info%source = "Armstrong-Helouvry, Dupont and Canudas de Wit (1994)"
      call add_number(info, "coefficient", dim_none, "sliding friction coefficient at high speed", lower=0.0_wp)
      call add_number(info, "static_coefficient", dim_none, "static friction coefficient; at least `coefficient`", &
                      lower=0.0_wp)
      call add_number(info, "stribeck_speed", dim_speed, "Stribeck speed", default="1e-2 m/s", &
                      lower=0.0_wp, open_lower=.true.)
      call add_number(info, "v0", dim_speed, "sliding speed over which friction rises from zero", default="1e-4 m/s", &
         lower=0.0_wp, &
                      open_lower=.true.)
      call add_number(info, "exponent", dim_none, "exponent of the speed in the exponential", default="2", lower=0.5_wp, &
                      upper=4.0_wp)
      call add_number(info, "viscosity", dim_t(m=-1, s=1), "viscous friction over the normal force", default="0 s/m", lower=0.0_wp)
   end function stribeck_info

   !> Take the parameters.
   subroutine stribeck_prepare(self, item)
      class(friction_stribeck_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                   !! the row

      self%name = item%name
      self%coefficient = item%number("coefficient")
      self%static = item%number("static_coefficient")
      self%stribeck = item%number("stribeck_speed")
      self%rise = item%number("v0")
      self%exponent = item%number("exponent")
      self%viscous = item%number("viscosity")
   end subroutine stribeck_prepare

   !> Without a coefficient there is no friction.
   pure logical function stribeck_is_active(self)
      class(friction_stribeck_t), intent(in) :: self  !! the law

      stribeck_is_active = self%static > 0.0_wp .or. self%viscous > 0.0_wp
   end function stribeck_is_active

   !> The static coefficient is the greater one.
   function stribeck_mistake(self) result(message)
      class(friction_stribeck_t), intent(in) :: self  !! the law
      character(:), allocatable :: message            !! one line, empty: all is well

      message = ""
      if (self%static < self%coefficient) message = "static_coefficient must not be smaller than coefficient"
   end function stribeck_mistake

   !> Magnitude of the friction force of n contacts.
   pure subroutine stribeck_force(self, n, normal_force, speed, f)
      class(friction_stribeck_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                        !! number of contacts
      real(wp), intent(in) :: normal_force(n)         !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)                !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)                   !! (n) magnitude of the friction force [N]

      real(wp) :: mu
      integer :: k

      do k = 1, n
         mu = self%coefficient + (self%static - self%coefficient)*exp(-(speed(k)/self%stribeck)**self%exponent)
         f(k) = normal_force(k)*(mu*tanh(speed(k)/self%rise) + self%viscous*speed(k))
      end do
   end subroutine stribeck_force

end module friction_stribeck
