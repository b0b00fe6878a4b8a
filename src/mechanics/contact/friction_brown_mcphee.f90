!> Friction with a smooth peak of the static one, after Brown and McPhee.
!>
!> F_T = F_N { mu_d tanh(4 x) + (mu_s - mu_d) x / (x^2/4 + 3/4)^2 + c_v v },   x = v/v_t
!>
!> The force rises to mu_s F_N at about the transition speed v_t, falls to mu_d F_N beyond it (the Stribeck effect), and is smooth
!> everywhere. Signs: against the sliding velocity. Source: Brown and McPhee, A continuous velocity-based friction model
!> for dynamics and control with physically meaningful parameters, Journal of Computational and Nonlinear Dynamics 11 (2016),
!> 054502; there the viscous part depends on F_N through tanh(4 F_N/F_t), here it is in proportion to it.
!> Limits: no sticking: a body on a slope creeps at a speed below v_t.
module friction_brown_mcphee
   use friction_law, only: friction_law_t
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_speed, dim_t, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_brown_mcphee_t

   type(dim_t), parameter :: per_speed = dim_t(m=-1, s=1)  !! dimension of the viscous coefficient

   !> Stribeck friction.
   type, extends(friction_law_t) :: friction_brown_mcphee_t
      real(wp) :: coefficient = 0.0_wp  !! mu_d [1]
      real(wp) :: static = 0.0_wp       !! mu_s [1]
      real(wp) :: v_t = 1.0_wp          !! transition speed [m/s]
      real(wp) :: viscous = 0.0_wp      !! c_v [s/m]
   contains
      procedure, nopass :: info => brown_mcphee_info
      procedure :: prepare => brown_mcphee_prepare
      procedure :: is_active => brown_mcphee_is_active
      procedure :: force => brown_mcphee_force
      procedure :: mistake => brown_mcphee_mistake
   end type friction_brown_mcphee_t

contains

   !> Description of the kind.
   function brown_mcphee_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.brown_mcphee"
      info%help = "smooth friction with a static peak at a transition speed"
      info%source = "Brown and McPhee (2016)"
      call add_number(info, "coefficient", dim_none, "sliding friction coefficient", lower=0.0_wp)
      call add_number(info, "static_coefficient", dim_none, "maximum coefficient, reached at v_t; at least `coefficient`", &
                      lower=0.0_wp)
      call add_number(info, "v_t", dim_speed, "transition speed", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "viscosity", per_speed, "viscous coefficient, multiplied by the sliding speed", default="0 s/m", &
         lower=0.0_wp)
   end function brown_mcphee_info

   !> Take the parameters.
   subroutine brown_mcphee_prepare(self, item)
      class(friction_brown_mcphee_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%coefficient = item%number("coefficient")
      self%static = item%number("static_coefficient")
      self%v_t = item%number("v_t")
      self%viscous = item%number("viscosity")
   end subroutine brown_mcphee_prepare

   !> Without a coefficient there is no friction.
   pure logical function brown_mcphee_is_active(self)
      class(friction_brown_mcphee_t), intent(in) :: self  !! the law

      brown_mcphee_is_active = self%static > 0.0_wp .or. self%viscous > 0.0_wp
   end function brown_mcphee_is_active

   !> The peak must not be below what follows it.
   function brown_mcphee_mistake(self) result(message)
      class(friction_brown_mcphee_t), intent(in) :: self  !! the law
      character(:), allocatable :: message       !! one line, empty: all is well

      message = ""
      if (self%static < self%coefficient) then
         message = "static_coefficient must not be smaller than coefficient: friction falls beyond v_t"
      end if
   end function brown_mcphee_mistake

   !> Magnitude of the friction force of n contacts.
   pure subroutine brown_mcphee_force(self, n, normal_force, speed, f)
      class(friction_brown_mcphee_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                   !! number of contacts
      real(wp), intent(in) :: normal_force(n)    !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)           !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)              !! (n) magnitude of the friction force [N]

      real(wp) :: x
      integer :: k

      do k = 1, n
         x = speed(k)/self%v_t
         f(k) = normal_force(k)*(self%coefficient*tanh(4.0_wp*x) + self%viscous*speed(k) &
                + (self%static - self%coefficient)*x/(0.25_wp*x*x + 0.75_wp)**2)
      end do
   end subroutine brown_mcphee_force

end module friction_brown_mcphee
