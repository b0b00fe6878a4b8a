!> Friction of constant magnitude, whatever the normal force.
!>
!> F_T = min(c_c, mu_max F_N) min(v/v1, 1)
!>
!> Signs: against the sliding velocity. Source: Flores et al. (2008), eq. (3.12), after Dubowsky, Journal of Engineering for
!> Industry 96 (1974), 317-323. As printed the force jumps from -c_c to c_c where the sliding turns; the ramp up to v1 is
!> there so that an integration can pass that place. With v1 = 0, as printed, surfaces stick where that takes at most that force, by
!> located events as of `friction_coulomb`. As printed the force jumps from 0 to c_c with the normal force; where a jump drives the
!> contact back to F_N = 0 from both sides the equations have no solution. mu_max, a coefficient that no surfaces have, makes it
!> continuous. Limits: no sticking with a ramp.
module friction_constant
   use friction_law, only: friction_law_t, memory_slip
   use item, only: item_t
   use kind_info, only: add_number, dim_force, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_constant_t

   !> Friction independent of the normal force.
   type, extends(friction_law_t) :: friction_constant_t
      real(wp) :: constant = 0.0_wp  !! c_c [N]
      real(wp) :: v1 = 0.0_wp        !! speed above which the force is full [m/s]
      real(wp) :: max_coefficient = 0.0_wp  !! force over the normal force at most [1]
   contains
      procedure, nopass :: info => constant_info
      procedure :: prepare => constant_prepare
      procedure :: is_active => constant_is_active
      procedure :: force => constant_force
      procedure :: stick_limit => constant_stick_limit
   end type friction_constant_t

contains

   !> Description of the kind.
   function constant_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.constant"
      info%help = "friction force of constant magnitude, independent of the normal force"
      info%source = "Flores et al. (2008), eq. (3.12)"
      call add_number(info, "force", dim_force, "friction force while the surfaces touch and slide; 0: frictionless", lower=0.0_wp)
      call add_number(info, "v1", dim_speed, "sliding speed of full friction, linear ramp below; 0: sticks, with stick-slip "// &
         "events", &
                      default="1 mm/s", lower=0.0_wp)
      call add_number(info, "max_coefficient", dim_none, &
                      "friction force over normal force, at most; friction falls with a normal force below force/max_coefficient", &
                      default="100", lower=0.0_wp, open_lower=.true.)
   end function constant_info

   !> Take the parameters.
   subroutine constant_prepare(self, item)
      class(friction_constant_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%constant = item%number("force")
      self%v1 = item%number("v1")
      self%max_coefficient = item%number("max_coefficient")
      if (.not. self%v1 > 0.0_wp) self%memory = memory_slip
   end subroutine constant_prepare

   !> Without a coefficient there is no friction.
   pure logical function constant_is_active(self)
      class(friction_constant_t), intent(in) :: self  !! the law

      constant_is_active = self%constant > 0.0_wp
   end function constant_is_active

   !> Magnitude of the friction force of n contacts.
   pure subroutine constant_force(self, n, normal_force, speed, f)
      class(friction_constant_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                   !! number of contacts
      real(wp), intent(in) :: normal_force(n)    !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)           !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)              !! (n) magnitude of the friction force [N]

      integer :: k

      do k = 1, n
         f(k) = min(self%constant, self%max_coefficient*max(normal_force(k), 0.0_wp))
         if (speed(k) < self%v1) f(k) = f(k)*(speed(k)/self%v1)
      end do
   end subroutine constant_force

   !> Maximum force of a contact that sticks.
   pure real(wp) function constant_stick_limit(self, normal_force) result(f)
      class(friction_constant_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: normal_force            !! normal force [N]

      f = min(self%constant, self%max_coefficient*max(normal_force, 0.0_wp))
   end function constant_stick_limit

end module friction_constant
