!> Lankarani and Nikravesh: Hertz contact with hysteresis damping.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce^2) / 4 * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.8, 0.5, e = 0.913, 0.847, 0.725.
!>
!> Source: Flores et al. (2008), eq. (3.9). Limits: restitution near one, ce > 0.9; those of hertz_family.
module law_lankarani_nikravesh
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: lankarani_nikravesh_hysteresis, law_lankarani_nikravesh_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_lankarani_nikravesh_t
   contains
      procedure, nopass :: info => lankarani_nikravesh_info
      procedure, nopass :: hysteresis_of => lankarani_nikravesh_hysteresis
   end type law_lankarani_nikravesh_t

contains

   !> Description of the kind.
   function lankarani_nikravesh_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.lankarani_nikravesh"
      info%help = "Hertz contact with hysteresis damping from a coefficient of restitution"
      info%source = "Flores et al. (2008), eq. (3.9)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function lankarani_nikravesh_info

   !> h = 3 (1 - ce^2) / 4.
   pure real(wp) function lankarani_nikravesh_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 0.75_wp*(1.0_wp - restitution**2)
   end function lankarani_nikravesh_hysteresis

end module law_lankarani_nikravesh
