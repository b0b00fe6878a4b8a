!> Hertz: elastic contact of curved surfaces.
!>
!> F_N = K delta^n,   n = 3/2,   energy = K delta^(n+1) / (n+1)
!>
!> Source: Flores et al. (2008), eqs. (3.2)-(3.5). Limits: no energy is lost; quasi-static, so impact
!> speeds below 0.02 sqrt(E/rho).
module law_hertz
   use hertz_family, only: add_elastic_columns, elastic_force, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter
   implicit none (type, external)
   private
   public :: law_hertz_t

   !> Elastic contact.
   type, extends(hertz_family_t) :: law_hertz_t
   contains
      procedure, nopass :: info => hertz_info
      procedure, nopass :: hysteresis_of => hertz_hysteresis
      procedure :: force => hertz_force
   end type law_hertz_t

contains

   !> Description of the kind.
   function hertz_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.hertz"
      info%help = "elastic contact, F = K delta^n; conserves energy"
      info%source = "Flores et al. (2008), eq. (3.2)"
      call add_elastic_columns(info)
   end function hertz_info

   !> No damping whatever the restitution, which the law's rows do not have.
   pure real(wp) function hertz_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 0.0_wp
   end function hertz_hysteresis

   !> Force of n contacts.
   pure subroutine hertz_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(law_hertz_t), intent(in) :: self                 !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) stiffness first [N/m^1.5]
      real(wp), intent(out) :: f(n)                          !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) its derivative by rate, zero [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) elastic part of the force [N]

      integer :: k

      do k = 1, n
         call elastic_force(parameters(1, k), delta(k), f(k), df_ddelta(k))
         f_elastic(k) = f(k)
         df_drate(k) = 0.0_wp
      end do
   end subroutine hertz_force

end module law_hertz
