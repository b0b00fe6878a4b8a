!> Hu and Guo: Hertz contact with hysteresis damping, good down to a restitution of one half.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce) / (2 ce) * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.7, 0.3, e = 0.900, 0.697, 0.271.
!>
!> Source: Hu and Guo, A dissipative contact force model for impact analysis in multibody dynamics, Multibody System
!> Dynamics 35 (2015), 131-151.
!> Limits: ce > 0.5; those of hertz_family.
module law_hu_guo
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_hu_guo_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_hu_guo_t
   contains
      procedure, nopass :: info => hu_guo_info
      procedure, nopass :: hysteresis_of => hu_guo_hysteresis
   end type law_hu_guo_t

contains

   !> Description of the kind.
   function hu_guo_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.hu_guo"
      info%help = "Hertz contact with hysteresis damping, for a restitution above 0.5"
      info%source = "Hu and Guo (2015)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function hu_guo_info

   !> h = 3 (1 - ce) / (2 ce).
   pure real(wp) function hu_guo_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 1.5_wp*(1.0_wp - restitution)/restitution
   end function hu_guo_hysteresis

end module law_hu_guo
