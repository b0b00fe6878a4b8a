!> Reye's wear law: the volume grows with the work of friction.
!>
!> dV = kappa(s) |F_T v_T| dt   of bearing and journal each; kappa, threshold and running-in: see `wear_law`
!>
!> What does not slide does not wear: the force of a contact that sticks does no work. The work is that of the energy ledger.
!> Signs: volumes are removed material. Source: Th. Reye, Der Civilingenieur 4 (1860) 235. Limits: needs friction; see `wear_law`.
module wear_reye
   use item, only: item_t
   use kind_info, only: kind_info_t
   use wear_law, only: add_wear_columns, wear_law_t, wear_prepare
   implicit none (type, external)
   private
   public :: wear_reye_t

   !> Reye's law.
   type, extends(wear_law_t) :: wear_reye_t
   contains
      procedure, nopass :: info => reye_info
      procedure :: prepare => reye_prepare
   end type wear_reye_t

contains

   !> Description of the kind.
   function reye_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "wear.reye"
      info%help = "Reye's law: worn volume is a coefficient times the work of friction; the joint needs friction"
      info%source = "Reye, Der Civilingenieur 4 (1860) 235"
      call add_wear_columns(info, "work of friction")
   end function reye_info

   !> Take the parameters from a row of the kind's table.
   subroutine reye_prepare(self, item)
      class(wear_reye_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item           !! the row

      call wear_prepare(self, item)
      self%by_friction = .true.
   end subroutine reye_prepare

end module wear_reye
