!> Gonthier, McPhee, Lange and Piedboeuf: Hertz contact with hysteresis damping, for a low restitution.
!>
!> F_N = K delta^n [ 1 + (1 - ce^2) / ce * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.5, 0.3, e = 0.876, 0.488, 0.304.
!>
!> Source: Gonthier, McPhee, Lange and Piedboeuf, A regularized contact model with asymmetric damping and dwell-time
!> dependent friction, Multibody System Dynamics 11 (2004), 209-233.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: ce < 0.5; near one it takes a third too much; those of hertz_family.
module law_gonthier
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_gonthier_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_gonthier_t
   contains
      procedure, nopass :: info => gonthier_info
      procedure, nopass :: hysteresis_of => gonthier_hysteresis
   end type law_gonthier_t

contains

   !> Description of the kind.
   function gonthier_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.gonthier"
      info%help = "Hertz contact with hysteresis damping, for a restitution below 0.5"
      info%source = "Gonthier et al. (2004)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function gonthier_info

   !> h = (1 - ce^2) / ce.
   pure real(wp) function gonthier_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = (1.0_wp - restitution**2)/restitution
   end function gonthier_hysteresis

end module law_gonthier
