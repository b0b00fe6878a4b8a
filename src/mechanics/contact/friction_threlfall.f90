!> Coulomb friction with an exponential approach, after Threlfall.
!>
!> F_T = c_f F_N [ 1 - exp(-3 v/v_r) ] for v < v_r;   for v >= v_r
!> continuous: its value at v_r, c_f F_N (1 - exp(-3)) = 0.950 c_f F_N
!> exponential: the same formula, which tends to c_f F_N
!> book: c_f F_N, 5 % more than at v_r
!>
!> As printed the force of `book` jumps at v_r. A load between both forces would hold the sliding velocity there, and steps would
!> have no end; so the force rises to the full one over the last 1.7 % of v_r, as steeply as at rest: c_f F_N [ 1 - 3 (1 - v/v_r) ]
!> where that is greater.
!>
!> Signs: against the sliding velocity; the book's formula lacks the minus and would drive the sliding. Source: Flores et al.
!> (2008), eq. (3.15); Threlfall, The inclusion of Coulomb friction in mechanisms programs with particular reference to DRAM,
!> Mechanism and Machine Theory 13 (1978), 475-483. Limits: no sticking: a body on a slope creeps; slope 3 c_f F_N/v_r at rest.
module friction_threlfall
   use friction_law, only: friction_law_t
   use item, only: item_t
   use kind_info, only: add_number, add_word, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_threlfall_t

   real(wp), parameter :: rise = 3.0_wp  !! exponent at the characteristic speed [1]

   !> Coulomb friction with an exponential approach.
   type, extends(friction_law_t) :: friction_threlfall_t
      real(wp) :: coefficient = 0.0_wp   !! c_f [1]
      real(wp) :: v_r = 1.0_wp           !! characteristic speed [m/s]
      real(wp) :: last_speed = 0.0_wp    !! speed up to which the exponential is followed [m/s]
      real(wp) :: above = 1.0_wp         !! part of c_f F_N beyond it [1]
      logical :: is_printed = .false.    !! c_f F_N beyond it, and a rise to that
   contains
      procedure, nopass :: info => threlfall_info
      procedure :: prepare => threlfall_prepare
      procedure :: is_active => threlfall_is_active
      procedure :: force => threlfall_force
   end type friction_threlfall_t

contains

   !> Description of the kind.
   function threlfall_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "friction.threlfall"
      info%help = "Coulomb friction with an exponential approach to its full value"
      info%source = "Flores et al. (2008), eq. (3.15)"
      call add_number(info, "coefficient", dim_none, "friction coefficient; 0: frictionless", lower=0.0_wp)
      call add_number(info, "v_r", dim_speed, "characteristic sliding speed", lower=0.0_wp, open_lower=.true.)
      call add_word(info, "above", "above v_r: constant at 95 % of the full force, exponential, or the full force as in "// &
         "Flores et al. (2008), with a rise over 1.7 % of v_r in place of its jump", &
                    default="continuous", choices="continuous exponential book")
   end function threlfall_info

   !> Take the parameters.
   subroutine threlfall_prepare(self, item)
      class(friction_threlfall_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item              !! the row

      self%name = item%name
      self%coefficient = item%number("coefficient")
      self%v_r = item%number("v_r")
      self%last_speed = merge(huge(1.0_wp), self%v_r, item%word("above") == "exponential")
      self%is_printed = item%word("above") == "book"
      self%above = merge(1.0_wp, 1.0_wp - exp(-rise), self%is_printed)
   end subroutine threlfall_prepare

   !> Without a coefficient there is no friction.
   pure logical function threlfall_is_active(self)
      class(friction_threlfall_t), intent(in) :: self  !! the law

      threlfall_is_active = self%coefficient > 0.0_wp
   end function threlfall_is_active

   !> Magnitude of the friction force of n contacts.
   pure subroutine threlfall_force(self, n, normal_force, speed, f)
      class(friction_threlfall_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                   !! number of contacts
      real(wp), intent(in) :: normal_force(n)    !! (n) normal force [N]
      real(wp), intent(in) :: speed(n)           !! (n) magnitude of the sliding velocity [m/s]
      real(wp), intent(out) :: f(n)              !! (n) magnitude of the friction force [N]

      real(wp) :: part
      integer :: k

      do k = 1, n
         part = self%above
         if (speed(k) < self%last_speed) then
            part = 1.0_wp - exp(-rise*speed(k)/self%v_r)
            if (self%is_printed) part = max(part, 1.0_wp - rise*(1.0_wp - speed(k)/self%v_r))
         end if
         f(k) = self%coefficient*normal_force(k)*part
      end do
   end subroutine threlfall_force

end module friction_threlfall
