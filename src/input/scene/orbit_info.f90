!> The section [orbit]: periodic orbits, their multipliers, branches over a parameter.
module orbit_info
   use kind_info, only: add_any_number, add_duration, add_number, add_word, dim_angle, dim_none, kind_info_t
   use kinds, only: min_tolerance, wp
   implicit none (type, external)
   private
   public :: orbit_section

contains

   !> The section.
   function orbit_section() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "orbit"
      info%help = "a periodic orbit near the motion of the deck, stable or not, its Floquet multipliers, and its branch over a " &
                  //"parameter, by `gudgeon orbit`"
      info%source = "R. Seydel (2010), Practical Bifurcation and Stability Analysis, chapters 4 and 7"
      info%is_table = .false.
      call add_duration(info, "period", "period of the drivers, a time or `N turns of DRIVER`; it may depend on parameters")
      call add_number(info, "periods", dim_none, "periods of the drivers in one of the orbit, a whole number", default="1", &
                      lower=1.0_wp, upper=1000.0_wp)
      call add_number(info, "settle", dim_none, "periods of the drivers from the start of the motion to the first guess, a whole " &
                      //"number; 0: the start itself, near an unstable orbit", default="0", lower=0.0_wp, upper=1.0e6_wp)
      call add_word(info, "contact", "joint with clearance whose first onset in a period has the phase, as JOINT or " &
                    //"JOINT.CONTACT; none: no phase", default="")
      call add_number(info, "phase", dim_angle, "phase of the drivers at t = 0", default="0 rad")
      call add_word(info, "parameter", "name of a parameter that is a number, over which the branch is followed; none: the orbit " &
                    //"only", default="")
      call add_any_number(info, "from", "minimum of the parameter on the branch", default="0")
      call add_any_number(info, "to", "maximum of the parameter on the branch", default="0")
      call add_number(info, "step", dim_none, "longest step along the branch, of the range of the parameter", default="0.05", &
                      lower=1.0e-6_wp, upper=1.0_wp)
      call add_number(info, "points", dim_none, "orbits on the branch to each side of the first one, at most", default="200", &
                      lower=1.0_wp, upper=1.0e5_wp)
      call add_number(info, "tolerance", dim_none, "tolerance of the motion", default="1e-10", lower=min_tolerance, &
                      upper=1.0e-5_wp)
   end function orbit_section

end module orbit_info
