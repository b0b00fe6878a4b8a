!> Coulomb friction with sticking, set-valued: the reference that the smooth laws approximate.
!>
!> sliding:   F_T = c_f F_N against the sliding velocity v_T
!> sticking:  F_T is what keeps the surfaces from sliding, as long as |F_T| <= c_s F_N
!>
!> A contact slides one way, slides the other way or sticks, and changes only at located events: sliding ends where v_T = 0,
!> sticking where |F_T| = c_s F_N. The force that sticks is found with the accelerations (`mechanism_friction`); it does no work.
!>
!> Signs: against the sliding velocity. Source: Flores et al. (2008), eqs. (3.13), (3.14). Limits: needs an integrator that
!> solves for accelerations, so not `ida`.
module friction_coulomb
   use friction_law, only: friction_law_t, memory_slip
   use item, only: item_t
   use kind_info, only: add_number, dim_none, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_coulomb_t

   !> Coulomb friction.
   type, extends(friction_law_t) :: friction_coulomb_t
      real(wp) :: coefficient = 0.0_wp         !! of sliding, c_f [1]
      real(wp) :: static_coefficient = 0.0_wp  !! of sticking, c_s [1]
   contains
      procedure, nopass :: info => coulomb_info
      procedure :: prepare => coulomb_prepare
      procedure :: is_active => coulomb_is_active
      procedure :: force => coulomb_force
      procedure :: stick_limit => coulomb_stick_limit
      procedure :: mistake => coulomb_mistake
   end type friction_coulomb_t

contains

   !> Description of the kind.
   function coulomb_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.coulomb"
      info%help = "Coulomb friction with sticking; stick-slip transitions are located events"
      info%source = "Flores et al. (2008), eqs. (3.13), (3.14)"
      call add_number(info, "coefficient", dim_none, "sliding friction coefficient; 0: frictionless", lower=0.0_wp)
      call add_number(info, "static_coefficient", dim_none, "static friction coefficient; 0: equal to the sliding "// &
         "coefficient", default="0", &
                      lower=0.0_wp)
   end function coulomb_info

   !> Take the parameters.
   subroutine coulomb_prepare(self, item)
      class(friction_coulomb_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                  !! the row

      self%name = item%name
      self%memory = memory_slip
      self%coefficient = item%number("coefficient")
      self%static_coefficient = item%number("static_coefficient")
      if (self%static_coefficient <= 0.0_wp) self%static_coefficient = self%coefficient
   end subroutine coulomb_prepare

   !> Without a coefficient of sliding there is no friction.
   pure logical function coulomb_is_active(self)
      class(friction_coulomb_t), intent(in) :: self  !! the law

      coulomb_is_active = self%coefficient > 0.0_wp
   end function coulomb_is_active

   !> What sticks must not let go of less than what slides.
   function coulomb_mistake(self) result(message)
      class(friction_coulomb_t), intent(in) :: self  !! the law
      character(:), allocatable :: message           !! one line, empty: all is well

      message = ""
      if (self%static_coefficient < self%coefficient) message = "static_coefficient must not be smaller than coefficient"
   end function coulomb_mistake

   !> Magnitude of the friction force of n contacts that slide.
   pure subroutine coulomb_force(self, n, normal_force, speed, f)
      class(friction_coulomb_t), intent(in) :: self   !! the law
      integer, intent(in) :: n                        !! number of contacts
      real(wp), intent(in) :: normal_force(n)         !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)                !! (n) magnitude of the sliding velocity, of no influence [m/s]
      real(wp), intent(out) :: f(n)                   !! (n) magnitude of the friction force [N]

      integer :: k

      do k = 1, n
         f(k) = self%coefficient*normal_force(k)
      end do
   end subroutine coulomb_force

   !> Maximum force of a contact that sticks.
   pure real(wp) function coulomb_stick_limit(self, normal_force) result(f)
      class(friction_coulomb_t), intent(in) :: self   !! the law
      real(wp), intent(in) :: normal_force            !! normal force [N]

      f = self%static_coefficient*normal_force
   end function coulomb_stick_limit

end module friction_coulomb
