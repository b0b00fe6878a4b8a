!> Lankarani and Nikravesh: Hertz contact with hysteresis damping.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce^2) / 4 * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The force is cut off at zero, and v0 is not less than 1 mm/s in the damping term: a contact that
!> opened gently must not pull. The restitution that two free bodies show is not ce but, for
!> ce = 0.9, 0.8, 0.5, e = 0.913, 0.847, 0.725, from h(1+e) = ln[(1+h)/(1-h e)], h = 3(1-ce^2)/4.
!>
!> Source: Flores et al. (2008), eq. (3.9). Limits: restitution near one; quasi-static contact, so
!> impact speeds below 1e-5 sqrt(E/rho).
module law_lankarani_nikravesh
   use item, only: item_t
   use kind_info, only: add_number, dim_none, kind_info_t
   use kinds, only: wp
   use law_hertz, only: add_elastic_columns, elastic_force, elastic_potential
   use normal_law, only: least_impact_speed, normal_law_t
   implicit none (type, external)
   private
   public :: law_lankarani_nikravesh_t

   !> Contact with hysteresis damping.
   type, extends(normal_law_t) :: law_lankarani_nikravesh_t
      real(wp) :: hysteresis = 0.0_wp  !! h = 3 (1 - ce^2) / 4 [1]
   contains
      procedure, nopass :: info => lankarani_nikravesh_info
      procedure :: prepare => lankarani_nikravesh_prepare
      procedure :: force => lankarani_nikravesh_force
      procedure :: potential => lankarani_nikravesh_potential
   end type law_lankarani_nikravesh_t

contains

   !> What the kind says of itself.
   function lankarani_nikravesh_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.lankarani_nikravesh"
      info%help = "Hertz contact with hysteresis damping from a coefficient of restitution"
      info%source = "Flores et al. (2008), eq. (3.9)"
      call add_elastic_columns(info)
      call add_number(info, "restitution", dim_none, "coefficient of restitution ce", &
                      lower=0.0_wp, upper=1.0_wp, open_lower=.true.)
   end function lankarani_nikravesh_info

   !> Take the parameters.
   subroutine lankarani_nikravesh_prepare(self, item)
      class(law_lankarani_nikravesh_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item                         !! the row

      self%name = item%name
      self%stiffness = item%values(1)%number
      self%hysteresis = 0.75_wp*(1.0_wp - item%values(2)%number**2)
   end subroutine lankarani_nikravesh_prepare

   !> Force of n contacts.
   pure subroutine lankarani_nikravesh_force(self, n, delta, rate, impact_speed, stiffness, f, df_ddelta, df_drate, f_elastic)
      class(law_lankarani_nikravesh_t), intent(in) :: self  !! the law
      integer, intent(in) :: n                              !! number of contacts
      real(wp), intent(in) :: delta(n)                      !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                       !! (n) penetration rate [m/s]
      real(wp), intent(in) :: impact_speed(n)               !! (n) rate at the onset [m/s]
      real(wp), intent(in) :: stiffness(n)                  !! (n) contact stiffness [N/m^1.5]
      real(wp), intent(out) :: f(n)                         !! (n) normal force [N]
      real(wp), intent(out) :: df_ddelta(n)                 !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                  !! (n) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                 !! (n) elastic part of the force [N]

      real(wp) :: slope
      integer :: k

      do k = 1, n
         call elastic_force(stiffness(k), delta(k), f_elastic(k), df_ddelta(k))
         slope = self%hysteresis/max(impact_speed(k), least_impact_speed)
         f(k) = f_elastic(k)*(1.0_wp + slope*rate(k))
         df_ddelta(k) = df_ddelta(k)*(1.0_wp + slope*rate(k))
         df_drate(k) = f_elastic(k)*slope
         if (f(k) < 0.0_wp) then
            f(k) = 0.0_wp
            df_ddelta(k) = 0.0_wp
            df_drate(k) = 0.0_wp
         end if
      end do
   end subroutine lankarani_nikravesh_force

   !> Elastic energy of one contact.
   pure function lankarani_nikravesh_potential(self, delta, stiffness) result(energy)
      class(law_lankarani_nikravesh_t), intent(in) :: self  !! the law
      real(wp), intent(in) :: delta                         !! penetration [m]
      real(wp), intent(in) :: stiffness                     !! contact stiffness [N/m^1.5]
      real(wp) :: energy                                    !! energy stored [J]

      energy = elastic_potential(stiffness, delta)
   end function lankarani_nikravesh_potential

end module law_lankarani_nikravesh
