!> Flores, Machado, Silva and Martins: Hertz contact with hysteresis damping, also for soft materials.
!>
!> F_N = K delta^n [ 1 + 8 (1 - ce) / (5 ce) * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.7, 0.3, e = 0.894, 0.683, 0.256.
!>
!> Source: Flores, Machado, Silva and Martins, On the continuous contact force models for soft materials in multibody
!> dynamics, Multibody System Dynamics 25 (2011), 357-375.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: ce > 0.3; those of hertz_family.
module law_flores
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_flores_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_flores_t
   contains
      procedure, nopass :: info => flores_info
      procedure, nopass :: hysteresis_of => flores_hysteresis
   end type law_flores_t

contains

   !> Description of the kind.
   function flores_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.flores"
      info%help = "Hertz contact with hysteresis damping, for any restitution; error grows at low values"
      info%source = "Flores et al. (2011)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function flores_info

   !> h = 8 (1 - ce) / (5 ce).
   pure real(wp) function flores_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 1.6_wp*(1.0_wp - restitution)/restitution
   end function flores_hysteresis

end module law_flores
