!> Lee and Wang: Hertz contact with half of Hunt and Crossley's damping.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce) / 4 * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.8, 0.5, e = 0.952, 0.909, 0.799.
!>
!> Source: Lee and Wang, On the dynamics of intermittent-motion mechanisms, Journal of Mechanisms, Transmissions and
!> Automation in Design 105 (1983), 534-540.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: restitution very near one, ce > 0.98; those of hertz_family.
module law_lee_wang
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_lee_wang_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_lee_wang_t
   contains
      procedure, nopass :: info => lee_wang_info
      procedure, nopass :: hysteresis_of => lee_wang_hysteresis
   end type law_lee_wang_t

contains

   !> Description of the kind.
   function lee_wang_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.lee_wang"
      info%help = "Hertz contact with hysteresis damping; dissipates about half of the energy that ce implies"
      info%source = "Lee and Wang (1983)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function lee_wang_info

   !> h = 3 (1 - ce) / 4.
   pure real(wp) function lee_wang_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 0.75_wp*(1.0_wp - restitution)
   end function lee_wang_hysteresis

end module law_lee_wang
