!> Herbert and McWhannell: Hertz contact with hysteresis damping.
!>
!> F_N = K delta^n [ 1 + 6 (1 - ce) / ((2 ce - 1)^2 + 3) * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.8, 0.5, e = 0.901, 0.807, 0.594.
!>
!> Source: Herbert and McWhannell, Shape and frequency composition of pulses from an impact pair, Journal of Engineering
!> for Industry 99 (1977), 513-518.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: ce > 0.75; those of hertz_family.
module law_herbert_mcwhannell
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_herbert_mcwhannell_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_herbert_mcwhannell_t
   contains
      procedure, nopass :: info => herbert_mcwhannell_info
      procedure, nopass :: hysteresis_of => herbert_mcwhannell_hysteresis
   end type law_herbert_mcwhannell_t

contains

   !> Description of the kind.
   function herbert_mcwhannell_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.herbert_mcwhannell"
      info%help = "Hertz contact with hysteresis damping, for a restitution above 0.75"
      info%source = "Herbert and McWhannell (1977)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function herbert_mcwhannell_info

   !> h = 6 (1 - ce) / ((2 ce - 1)^2 + 3).
   pure real(wp) function herbert_mcwhannell_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 6.0_wp*(1.0_wp - restitution)/((2.0_wp*restitution - 1.0_wp)**2 + 3.0_wp)
   end function herbert_mcwhannell_hysteresis

end module law_herbert_mcwhannell
