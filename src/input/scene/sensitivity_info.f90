!> The section [sensitivity]: derivatives of results by parameters.
module sensitivity_info
   use kind_info, only: add_number, add_words, dim_none, kind_info_t
   use kinds, only: min_tolerance, wp
   implicit none (type, external)
   private
   public :: sensitivity_section

contains

   !> The section.
   function sensitivity_section() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "sensitivity"
      info%help = "derivatives of results by parameters of the deck, through impacts, by `gudgeon sensitivity`"
      info%source = "H. G. Bock (1981), Springer Series in Chemical Physics 18, 102-125 (derivatives of the steps)"
      info%is_table = .false.
      call add_words(info, "parameters", "names of [parameters] that are numbers, none at a bound of its range: results are " &
                     //"derived by each of them, in SI units")
      call add_words(info, "results", "JOINT.onset(N), time of its N-th onset, N a number or A..B; likewise impact_speed, " &
                     //"peak_force, peak_penetration, duration, release_speed; at(CHANNEL,TIME), as " &
                     //"at(slider.velocity.x,5ms); max(CHANNEL) and min(CHANNEL) over the motion")
      call add_number(info, "tolerance", dim_none, "tolerance of the motion; a second motion at ten times of it gives the errors", &
                      default="1e-11", lower=min_tolerance, upper=1.0e-5_wp)
   end function sensitivity_section

end module sensitivity_info
