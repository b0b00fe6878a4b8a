!> The section [guards]: what ends a run before its end, or is told of it.
module guard_info
   use kind_info, only: add_condition, add_number, add_word, dim_none, dim_speed, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: guards_info

   character(*), parameter :: actions = "off warn stop"  !! what a guard may do

contains

   !> The section [guards]. Its defaults guard a deck that has no such section.
   function guards_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "guards"
      info%help = "what no mechanism does: a run that gets there warns, or ends with code 5 and the joint, time and value; and " &
                  //"conditions that end a run by intent"
      info%source = ""
      info%is_table = .false.
      call add_number(info, "penetration", dim_none, "greatest penetration of a contact, of the size of its surfaces (the " &
                      //"smaller radius, of a slider its length): beyond it the run ends; 0: no limit", default="1", lower=0.0_wp)
      call add_word(info, "clearance", "a penetration greater than the clearance of its joint", default="warn", choices=actions)
      call add_word(info, "law_range", "a penetration beyond the range of the normal law", default="warn", choices=actions)
      call add_word(info, "impact_speed", "an impact so fast that elastic waves, which a quasi-static law leaves out, take 10 % " &
                    //"of its energy, 0.02 sqrt(E/rho) of the materials", default="warn", choices=actions)
      call add_word(info, "strength", "a contact pressure beyond the strength that a row of [material] gives", default="warn", &
                    choices=actions)
      call add_number(info, "energy", dim_none, "energy made of nothing, the residual of the ledger or of a contact that begins " &
                      //"overlapping, over the largest energy: beyond it the run ends; 0: no limit", default="0.5", lower=0.0_wp)
      call add_number(info, "speed", dim_speed, "greatest speed of a body: beyond it the run ends; 0: no limit", &
                      default="10 km/s", lower=0.0_wp)
      call add_number(info, "travel", dim_none, "way of a body from its start, in sizes of the whole scene, that is worth a " &
                      //"warning; 0: none", default="1000", lower=0.0_wp)
      call add_condition(info, "stop", "the run ends, as if that was its end, when one of these comes true: a channel above or " &
                         //"below a limit, several joined by or")
   end function guards_info

end module guard_info
