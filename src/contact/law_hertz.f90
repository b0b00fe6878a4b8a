!> Hertz: elastic contact of curved surfaces.
!>
!> F_N = K delta^n,   n = 3/2,   energy = K delta^(n+1) / (n+1)
!>
!> Source: Flores et al. (2008), eqs. (3.2)-(3.4). Limits: no energy is lost; quasi-static, so impact
!> speeds below 1e-5 sqrt(E/rho).
module law_hertz
   use item, only: item_t
   use kind_info, only: add_number, dim_contact_stiffness, kind_info_t
   use kinds, only: wp
   use normal_law, only: normal_law_t
   implicit none (type, external)
   private
   public :: add_elastic_columns, elastic_force, elastic_potential, law_hertz_t

   !> Elastic contact.
   type, extends(normal_law_t) :: law_hertz_t
   contains
      procedure, nopass :: info => hertz_info
      procedure :: prepare => hertz_prepare
      procedure :: force => hertz_force
      procedure :: potential => hertz_potential
   end type law_hertz_t

contains

   !> What the kind says of itself.
   function hertz_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.hertz"
      info%help = "elastic contact, F = K delta^n; no energy is lost"
      info%source = "Flores et al. (2008), eq. (3.2)"
      call add_elastic_columns(info)
   end function hertz_info

   !> The columns of laws with an elastic part K delta^n.
   subroutine add_elastic_columns(info)
      type(kind_info_t), intent(inout) :: info  !! the kind

      call add_number(info, "stiffness", dim_contact_stiffness, "contact stiffness; 0: from radii and materials", &
                      default="0 N/m^1.5", lower=0.0_wp)
   end subroutine add_elastic_columns

   !> Take the parameters.
   subroutine hertz_prepare(self, item)
      class(law_hertz_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item           !! the row

      self%name = item%name
      self%stiffness = item%values(1)%number
   end subroutine hertz_prepare

   !> Force of n contacts.
   pure subroutine hertz_force(self, n, delta, rate, impact_speed, stiffness, f, df_ddelta, df_drate, f_elastic)
      class(law_hertz_t), intent(in) :: self      !! the law
      integer, intent(in) :: n                    !! number of contacts
      real(wp), intent(in) :: delta(n)            !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)             !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)     !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: stiffness(n)        !! (n) contact stiffness [N/m^1.5]
      real(wp), intent(out) :: f(n)               !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)       !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)        !! (n) its derivative by rate, zero [N.s/m]
      real(wp), intent(out) :: f_elastic(n)       !! (n) elastic part of the force [N]

      integer :: k

      do k = 1, n
         call elastic_force(stiffness(k), delta(k), f(k), df_ddelta(k))
         f_elastic(k) = f(k)
         df_drate(k) = 0.0_wp
      end do
   end subroutine hertz_force

   !> Elastic energy of one contact.
   pure function hertz_potential(self, delta, stiffness) result(energy)
      class(law_hertz_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: delta           !! penetration [m]
      real(wp), intent(in) :: stiffness       !! contact stiffness [N/m^1.5]
      real(wp) :: energy                      !! energy stored [J]

      energy = elastic_potential(stiffness, delta)
   end function hertz_potential

   !> K delta^1.5 and its derivative; zero where delta is not positive.
   elemental subroutine elastic_force(stiffness, delta, f, df_ddelta)
      real(wp), intent(in) :: stiffness   !! contact stiffness [N/m^1.5]
      real(wp), intent(in) :: delta       !! penetration [m]
      real(wp), intent(out) :: f          !! elastic force [N]
      real(wp), intent(out) :: df_ddelta  !! its derivative [N/m]

      real(wp) :: root

      root = sqrt(max(delta, 0.0_wp))
      f = stiffness*root*max(delta, 0.0_wp)
      df_ddelta = 1.5_wp*stiffness*root
   end subroutine elastic_force

   !> The potential K delta^2.5 / 2.5 of that force.
   elemental real(wp) function elastic_potential(stiffness, delta) result(energy)
      real(wp), intent(in) :: stiffness   !! contact stiffness [N/m^1.5]
      real(wp), intent(in) :: delta       !! penetration [m]

      energy = 0.4_wp*stiffness*sqrt(max(delta, 0.0_wp))*max(delta, 0.0_wp)**2
   end function elastic_potential

end module law_hertz
