!> The section [modes]: modes of a linearised mechanism, its matrices, its Campbell diagram.
module modes_info
   use kind_info, only: add_any_number, add_duration, add_number, add_word, add_words, dim_none, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: modes_section

contains

   !> The section.
   function modes_section() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "modes"
      info%help = "eigenvalues, natural frequencies and modes of the mechanism linearised at a state, its matrices, and its " &
                  //"Campbell diagram, by `gudgeon modes`; without the section at the equilibrium"
      info%source = "L. Meirovitch (1980), Computational Methods in Structural Dynamics, section 3.10"
      info%is_table = .false.
      call add_word(info, "at", "the state: equilibrium (static; with films the steady state), steady (a steady motion near the " &
                    //"start), time (an instant of the motion)", default="equilibrium", choices="equilibrium steady time")
      call add_duration(info, "time", "the instant, a time or `N turns of DRIVER`", default="0 s")
      call add_word(info, "axes", "body in whose axes motions are resolved, for mechanisms that turn as a whole; world: axes at " &
                    //"rest", default="world")
      call add_words(info, "inputs", "inputs of the matrices: POINT.fx, BODY.fx, BODY.mz, LOAD.fx of an element of [force.point] " &
                     //"(likewise fy, fz, mx, my), and names of drivers", default="")
      call add_words(info, "outputs", "outputs of the matrices: channels, as in [output]", default="")
      call add_word(info, "parameter", "name of a parameter that is a number, over which the Campbell diagram is drawn; none: " &
                    //"no diagram", default="")
      call add_any_number(info, "from", "first value of the parameter", default="0")
      call add_any_number(info, "to", "last value of the parameter", default="0")
      call add_number(info, "points", dim_none, "values of the parameter, a whole number", default="25", lower=2.0_wp, &
                      upper=1.0e4_wp)
   end function modes_section

end module modes_info
