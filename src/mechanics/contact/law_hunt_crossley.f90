!> Hunt and Crossley: Hertz contact with hysteresis damping, linear in the restitution.
!>
!> F_N = K delta^n [ 1 + 3 (1 - ce) / 2 * rate / v0 ],   n = 3/2, v0 the impact speed
!>
!> The restitution that two free bodies show is not ce but, for ce = 0.9, 0.8, 0.5, e = 0.909, 0.833, 0.663.
!>
!> Source: Hunt and Crossley, Coefficient of restitution interpreted as damping in vibroimpact, Journal of Applied
!> Mechanics 42 (1975), 440-445.
!> Reviewed by Machado et al., Compliant contact force models in multibody dynamics, Mechanism and Machine Theory 53 (2012), 99-121.
!> Limits: restitution near one, ce > 0.9; those of hertz_family.
module law_hunt_crossley
   use hertz_family, only: add_elastic_columns, add_restitution, hertz_family_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: law_hunt_crossley_t

   !> Contact with hysteresis damping.
   type, extends(hertz_family_t) :: law_hunt_crossley_t
   contains
      procedure, nopass :: info => hunt_crossley_info
      procedure, nopass :: hysteresis_of => hunt_crossley_hysteresis
   end type law_hunt_crossley_t

contains

   !> Description of the kind.
   function hunt_crossley_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "contact.hunt_crossley"
      info%help = "Hertz contact with hysteresis damping; first-order approximation of the exact law near ce = 1"
      info%source = "Hunt and Crossley (1975)"
      call add_elastic_columns(info)
      call add_restitution(info)
   end function hunt_crossley_info

   !> h = 3 (1 - ce) / 2.
   pure real(wp) function hunt_crossley_hysteresis(restitution) result(h)
      real(wp), intent(in) :: restitution  !! coefficient of restitution ce [1]

      h = 1.5_wp*(1.0_wp - restitution)
   end function hunt_crossley_hysteresis

end module law_hunt_crossley
