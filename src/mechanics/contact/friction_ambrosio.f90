!> Coulomb friction as modified by Ambrosio.
!>
!> F_T = c_f c_d F_N,   c_d = 0 for v <= v0, (v - v0)/(v1 - v0) between, 1 for v >= v1
!>
!> Signs: against the sliding velocity. Source: Flores et al. (2008), eqs. (3.16), (3.17).
!> Limits: no sticking: below v0 there is no force, so a body on a slope creeps; kinks at v0 and v1.
module friction_ambrosio
   use friction_law, only: friction_law_t
   use item, only: item_t
   use kind_info, only: add_number, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_ambrosio_t

   !> Coulomb friction with a dead zone and a ramp.
   type, extends(friction_law_t) :: friction_ambrosio_t
      real(wp) :: coefficient = 0.0_wp  !! c_f [1]
      real(wp) :: v0 = 0.0_wp           !! speed below which there is no force [m/s]
      real(wp) :: v1 = 1.0_wp           !! speed above which the force is full [m/s]
   contains
      procedure, nopass :: info => ambrosio_info
      procedure :: prepare => ambrosio_prepare
      procedure :: is_active => ambrosio_is_active
      procedure :: force => ambrosio_force
      procedure :: mistake => ambrosio_mistake
   end type friction_ambrosio_t

contains

   !> Description of the kind.
   function ambrosio_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.ambrosio"
      info%help = "Coulomb friction, zero below v0, with a linear ramp up to v1"
      info%source = "Flores et al. (2008), eqs. (3.16), (3.17)"
      call add_number(info, "coefficient", dim_none, "coefficient of friction; 0: frictionless", lower=0.0_wp)
      call add_number(info, "v0", dim_speed, "sliding speed below which friction is zero", lower=0.0_wp)
      call add_number(info, "v1", dim_speed, "sliding speed of full friction, greater than v0", &
                      lower=0.0_wp, open_lower=.true.)
   end function ambrosio_info

   !> Take the parameters.
   subroutine ambrosio_prepare(self, item)
      class(friction_ambrosio_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                   !! the row

      self%name = item%name
      self%coefficient = item%number("coefficient")
      self%v0 = item%number("v0")
      self%v1 = item%number("v1")
   end subroutine ambrosio_prepare

   !> Without a coefficient there is no friction.
   pure logical function ambrosio_is_active(self)
      class(friction_ambrosio_t), intent(in) :: self  !! the law

      ambrosio_is_active = self%coefficient > 0.0_wp
   end function ambrosio_is_active

   !> The ramp must rise.
   function ambrosio_mistake(self) result(message)
      class(friction_ambrosio_t), intent(in) :: self  !! the law
      character(:), allocatable :: message            !! one line, empty: all is well

      message = ""
      if (.not. self%v1 > self%v0) message = "v1 must be greater than v0: friction rises from zero at v0 to its full value at v1"
   end function ambrosio_mistake

   !> Magnitude of the friction force of n contacts.
   pure subroutine ambrosio_force(self, n, normal_force, speed, f)
      class(friction_ambrosio_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                        !! number of contacts
      real(wp), intent(in) :: normal_force(n)         !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)                !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)                   !! (n) magnitude of the friction force [N]

      integer :: k

      do k = 1, n
         f(k) = self%coefficient*normal_force(k)*min(max((speed(k) - self%v0)/(self%v1 - self%v0), 0.0_wp), 1.0_wp)
      end do
   end subroutine ambrosio_force

end module friction_ambrosio
