!> Coulomb friction with a value within its range near zero speed, after Rooney and Deravi.
!>
!> F_T = c_f F_N for v >= v1,   F_T = c_f F_N v/v1 below
!>
!> Signs: against the sliding velocity. Source: Flores et al. (2008), eqs. (3.13), (3.14); Rooney and Deravi, Coulomb friction in
!> mechanism sliding joints, Mechanism and Machine Theory 17 (1982), 207-211. Eq. (3.14) says only that near zero speed the
!> force is within plus and minus c_f F_N; here it is in proportion to the speed, which is such a value and makes the law
!> continuous. Limits: no sticking: a body on a slope creeps at a speed below v1; a kink at v1.
module friction_rooney_deravi
   use friction_law, only: friction_law_t
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_rooney_deravi_t

   !> Coulomb friction with a ramp.
   type, extends(friction_law_t) :: friction_rooney_deravi_t
      real(wp) :: coefficient = 0.0_wp  !! c_f [1]
      real(wp) :: v1 = 1.0_wp           !! speed that counts as near zero below [m/s]
   contains
      procedure, nopass :: info => rooney_deravi_info
      procedure :: prepare => rooney_deravi_prepare
      procedure :: is_active => rooney_deravi_is_active
      procedure :: force => rooney_deravi_force
   end type friction_rooney_deravi_t

contains

   !> Description of the kind.
   function rooney_deravi_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.rooney_deravi"
      info%help = "Coulomb friction, linear in the speed near zero speed"
      info%source = "Flores et al. (2008), eqs. (3.13), (3.14)"
      call add_number(info, "coefficient", dim_none, "friction coefficient; 0: frictionless", lower=0.0_wp)
      call add_number(info, "v1", dim_speed, "sliding speed of full friction, linear below", &
                      lower=0.0_wp, open_lower=.true.)
   end function rooney_deravi_info

   !> Take the parameters.
   subroutine rooney_deravi_prepare(self, item)
      class(friction_rooney_deravi_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%coefficient = item%number("coefficient")
      self%v1 = item%number("v1")
   end subroutine rooney_deravi_prepare

   !> Without a coefficient there is no friction.
   pure logical function rooney_deravi_is_active(self)
      class(friction_rooney_deravi_t), intent(in) :: self  !! the law

      rooney_deravi_is_active = self%coefficient > 0.0_wp
   end function rooney_deravi_is_active

   !> Magnitude of the friction force of n contacts.
   pure subroutine rooney_deravi_force(self, n, normal_force, speed, f)
      class(friction_rooney_deravi_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                   !! number of contacts
      real(wp), intent(in) :: normal_force(n)    !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)           !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)              !! (n) magnitude of the friction force [N]

      integer :: k

      do k = 1, n
         f(k) = self%coefficient*normal_force(k)*min(speed(k)/self%v1, 1.0_wp)
      end do
   end subroutine rooney_deravi_force

end module friction_rooney_deravi
