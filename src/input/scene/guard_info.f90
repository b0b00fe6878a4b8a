!> The section [guards]: what ends a run before its end, or is reported of it.
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
      info%help = "plausibility limits: a run that violates one warns, or stops with exit code 5 and the joint, time and "// &
         "value; also " &
                  //"stop conditions set by the user"
      info%source = ""
      info%is_table = .false.
      call add_number(info, "penetration", dim_none, "maximum penetration of a contact, relative to the size of its surfaces "// &
         "(the " &
                      //"smaller radius, for a slider its length); the run stops beyond it; 0: no limit", default="1", lower=0.0_wp)
      call add_word(info, "clearance", "action if a penetration exceeds the clearance of its joint", default="warn", &
         choices=actions)
      call add_word(info, "law_range", "action if a penetration leaves the valid range of the normal law", default="warn", &
         choices=actions)
      call add_word(info, "impact_speed", "action if an impact is so fast that elastic waves, which a quasi-static law "// &
         "neglects, take 10 % " &
                    //"of its energy: 0.02 sqrt(E/rho) of the materials", default="warn", choices=actions)
      call add_word(info, "strength", "action if a contact pressure exceeds the strength in the row of [material]", &
         default="warn", &
                    choices=actions)
      call add_number(info, "energy", dim_none, "maximum energy error (residual of the energy balance, or energy created by a "// &
         "contact with initial " &
                      //"overlap) relative to the maximum energy; the run stops beyond it; 0: no limit", default="0.5", &
                         lower=0.0_wp)
      call add_number(info, "speed", dim_speed, "maximum speed of a body; the run stops beyond it; 0: no limit", &
                      default="10 km/s", lower=0.0_wp)
      call add_number(info, "travel", dim_none, "displacement of a body from its initial position, relative to the size of the "// &
         "model, for a " &
                      //"warning; 0: none", default="1000", lower=0.0_wp)
      call add_condition(info, "stop", "stop condition: the run ends normally when one of these holds: a channel above or " &
                         //"below a limit, several joined by or")
   end function guards_info

end module guard_info
