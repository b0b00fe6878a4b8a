!> Zhiying and Qishao: Hertz contact with hysteresis damping.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce^2) exp(2 (1 - ce)) / 4 * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.7, 0.3, e = 0.896, 0.680, 0.327.
!>
!> Source: Zhiying and Qishao, Analysis of impact process based on restitution coefficient, Journal of Dynamics and
!> Control 4 (2006), 294-298.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: ce > 0.3; those of hertz_family.
module law_zhiying_qishao
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_zhiying_qishao_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_zhiying_qishao_t
   contains
      procedure, nopass :: info => zhiying_qishao_info
      procedure, nopass :: hysteresis_of => zhiying_qishao_hysteresis
   end type law_zhiying_qishao_t

contains

   !> Description of the kind.
   function zhiying_qishao_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.zhiying_qishao"
      info%help = "Hertz contact with hysteresis damping, for a restitution above 0.3"
      info%source = "Zhiying and Qishao (2006)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function zhiying_qishao_info

   !> h = 3 (1 - ce^2) exp(2 (1 - ce)) / 4.
   pure real(wp) function zhiying_qishao_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 0.75_wp*(1.0_wp - restitution**2)*exp(2.0_wp*(1.0_wp - restitution))
   end function zhiying_qishao_hysteresis

end module law_zhiying_qishao
