!> Archard's wear law: the volume grows with normal force and sliding distance.
!>
!> dV = kappa(s) F_N |v_T| dt   of bearing and journal each; kappa, threshold and running-in: see `wear_law`
!>
!> With Coulomb friction of coefficient mu the volume is (k/mu) times what friction takes. Archard's dimensionless coefficient K is
!> k times the hardness of the surface.
!> Signs: volumes are removed material. Source: J. F. Archard, J. Appl. Phys. 24 (1953) 981. Limits: see `wear_law`.
module wear_archard
   use kind_info, only: kind_info_t
   use wear_law, only: add_wear_columns, wear_law_t
   implicit none (type, external)
   private
   public :: wear_archard_t

   !> Archard's law.
   type, extends(wear_law_t) :: wear_archard_t
   contains
      procedure, nopass :: info => archard_info
   end type wear_archard_t

contains

   !> Description of the kind.
   function archard_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      info%name = "wear.archard"
      info%help = "Archard's law: worn volume is a coefficient times normal force times sliding distance"
      info%source = "Archard, J. Appl. Phys. 24 (1953) 981"
      call add_wear_columns(info, "normal force and sliding distance")
   end function archard_info

end module wear_archard
