!> The sections of settings of a deck: [scene], [analysis.*], [output].
module section_info
   use augmented, only: augmented_t
   use stabilisation, only: stabilisation_t
   use stabilisation_registry, only: n_stabilisation_kinds, new_stabilisation
   use integrator, only: integrator_t
   use integrator_controls, only: add_control_columns, add_onset_options
   use integrator_registry, only: n_integrator_kinds, new_integrator
   use kind_info, only: add_duration, add_flag, add_number, add_vector, add_word, add_words, dim_acceleration, dim_length, &
      dim_none, dim_time, kind_info_t
   use kinds, only: min_tolerance, wp
   use solver_registry, only: n_solver_kinds, new_solver
   use text, only: join, text_t, to_text
   implicit none (type, external)
   private
   public :: dynamic_info, kinematic_info, most_row_contacts, output_info, scene_info, static_info, word_options

   integer, parameter :: most_row_contacts = 64  !! contacts of a scene that gets rows at their instants by itself

contains

   !> The section [scene].
   function scene_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "scene"
      info%help = "title, space and gravity"
      info%source = ""
      info%is_table = .false.
      call add_word(info, "title", "one line for figures and output files", default="")
      call add_word(info, "space", "planar: motion in the plane x, y; spatial: motion in x, y and z", default="planar", &
                    choices="planar spatial")
      call add_vector(info, "gravity", dim_acceleration, 3, "gravitational acceleration, world frame: two numbers in the "// &
         "plane, "// &
                      "three in space", default="0 0 m/s^2")
      call add_number(info, "closing_tolerance", dim_none, "maximum misfit of redundant rows of closed loops that is treated "// &
         "as rounding of " &
                      //"the deck, relative to the size of the bodies or a radian: a least-squares fit closes the loops, " &
                      //"with a warning; 0: never", default="1e-3", lower=0.0_wp, upper=0.1_wp)
   end function scene_info

   !> The section [analysis.dynamic].
   function dynamic_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "analysis.dynamic"
      info%help = "forward dynamics: motion under forces"
      info%source = "Flores et al. (2008), section 2.4"
      info%is_table = .false.
      call add_word(info, "start", "initial state. ideal: positions and velocities of the mechanism with ideal joints; given: "// &
         "those of the deck, " &
                    //"with ideal joints assembled; static: static equilibrium at t = 0, at rest", &
                    default="ideal", choices="ideal given static")
      call add_word(info, "overlap", "initial overlap in joints with clearance: error, or preload: these contacts start in the " &
                    //"contact state, with the penetration rate as impact speed, or its minimum", default="error", &
                    choices="error preload")
      call add_duration(info, "end", "end time, or `N turns of DRIVER`")
      call add_methods(info)
      call add_solvers(info)
      call add_ways(info)
      call add_word(info, "coordinates", "fewest: driven bodies have prescribed motion, a body guided by one joint has one " &
                    //"coordinate; full: three coordinates per body", default="fewest", choices="fewest full")
      call add_word(info, "groups", "independent groups of bodies: apart, each group with its own steps; together, with the " &
                    //"steps of the fastest group", default="apart", choices="apart together")
      call add_flag(info, "ledger", "monitor the energy balance", default="on")
      call add_number(info, "energy_limit", dim_none, "maximum residual of the energy balance, relative to the maximum energy; "// &
         "0: no limit", &
                      default="0", lower=0.0_wp)
      call add_number(info, "violation_limit", dim_length, "maximum constraint violation; 0: no limit", &
                      default="0 m", lower=0.0_wp)
      call add_limit_cpu(info)
      call add_duration(info, "checkpoint", "interval between checkpoints, a time or `N turns of DRIVER`; adams, bdf and ida "// &
         "restart " &
                        //"there, and groups of bodies synchronise; 0: every ten minutes of wall-clock time, but never for these " &
                        //"methods and groups", default="0 s")
      call add_control_columns(info)
   end function dynamic_info

   !> The options that a word of a key takes: of a stabilisation method, or of meeting an onset.
   function word_options(key, word) result(info)
      character(*), intent(in) :: key    !! `stabilise` or `contact_onset`
      character(*), intent(in) :: word   !! as in `stabilise = word`
      type(kind_info_t) :: info          !! its options as columns; there may be none

      class(stabilisation_t), allocatable :: stabiliser
      integer :: k

      if (key == "contact_onset") call add_onset_options(word, info)
      if (key == "stabilise") then
         do k = 1, n_stabilisation_kinds()
            call new_stabilisation(k, stabiliser)
            if (stabiliser%name() /= word) cycle
            info = stabiliser%info()
            exit
         end do
      end if
      if (.not. allocated(info%columns)) allocate (info%columns(0))
   end function word_options

   !> The integrators: their words.
   subroutine add_methods(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      class(integrator_t), allocatable :: method
      type(kind_info_t) :: one
      type(text_t) :: words(n_integrator_kinds())
      integer :: k

      do k = 1, n_integrator_kinds()
         call new_integrator(k, method)
         one = method%info()
         words(k)%s = one%name
      end do
      call add_word(info, "method", "integrator", default="auto", choices=join(words, " "))
   end subroutine add_methods

   !> The solvers of the augmented equations: their words, and what they do.
   subroutine add_solvers(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      class(augmented_t), allocatable :: solver
      type(kind_info_t) :: one
      type(text_t) :: says(n_solver_kinds()), words(n_solver_kinds())
      integer :: k

      do k = 1, n_solver_kinds()
         call new_solver(k, solver)
         one = solver%info()
         words(k)%s = one%name
         says(k)%s = one%name//" ("//one%help//")"
      end do
      call add_word(info, "solver", "solver of the augmented equations: "//join(says, ", ")//", or auto", default="auto", &
                    choices="auto "//join(words, " "))
   end subroutine add_solvers

   !> The stabilisation methods: their words, what they do, the options of them all.
   subroutine add_ways(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      class(stabilisation_t), allocatable :: stabiliser
      type(kind_info_t) :: one
      type(text_t) :: says(n_stabilisation_kinds()), words(n_stabilisation_kinds())
      character(:), allocatable :: options
      integer :: i, k

      options = ""
      do k = 1, n_stabilisation_kinds()
         call new_stabilisation(k, stabiliser)
         one = stabiliser%info()
         words(k)%s = one%name
         says(k)%s = one%name//" ("//one%help//")"
         if (.not. allocated(one%columns)) cycle
         do i = 1, size(one%columns)
            if (index(options//" ", " "//one%columns(i)%name//" ") == 0) options = options//" "//one%columns(i)%name
         end do
      end do
      call add_word(info, "stabilise", "stabilisation method of the constraints: "//join(says, "; ")//"; or auto", default="auto", &
                    choices="auto "//join(words, " "), options=options(2:))
   end subroutine add_ways

   !> The section [analysis.kinematic].
   function kinematic_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "analysis.kinematic"
      info%help = "kinematics: drivers prescribe all degrees of freedom; forces by inverse dynamics"
      info%source = "Flores et al. (2008), section 2.4, figure 2.5"
      info%is_table = .false.
      call add_duration(info, "end", "end time, or `N turns of DRIVER`")
      call add_number(info, "tolerance", dim_none, "constraint violation at which Newton's iteration is " &
                      //"accepted, relative to the size of the bodies or a radian; it continues to round-off", default="1e-10", &
                      lower=min_tolerance, upper=1.0e-4_wp)
      call add_number(info, "maximum_iterations", dim_none, "maximum number of Newton iterations per time", default="25", &
                      lower=1.0_wp, upper=1.0e9_wp)
      call add_limit_cpu(info)
   end function kinematic_info

   !> The processor time of a motion.
   subroutine add_limit_cpu(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      call add_number(info, "limit_cpu", dim_time, "CPU time limit of the run; 0: no limit", default="0 s", &
                      lower=0.0_wp)
   end subroutine add_limit_cpu

   !> The section [analysis.static].
   function static_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "analysis.static"
      info%help = "static equilibrium under the forces at t = 0, drivers fixed at their initial values"
      info%source = "Flores et al. (2008), eq. (2.14) with velocities and accelerations zero; SUNDIALS KINSOL"
      info%is_table = .false.
      call add_word(info, "start", "start of the search. ideal: the mechanism with ideal joints; given: the given positions of "// &
         "the " &
                    //"bodies, with ideal joints assembled", default="ideal", choices="ideal given")
      call add_number(info, "tolerance", dim_none, "maximum force residual, relative to the maximum load", default="1e-10", &
                      lower=min_tolerance, upper=1.0e-4_wp)
      call add_number(info, "maximum_iterations", dim_none, "maximum number of steps of the search", default="500", lower=1.0_wp, &
                      upper=1.0e9_wp)
      call add_number(info, "whirl_search", dim_none, "with films: maximum factor on the driver speeds, up and down, in the " &
                      //"search for the whirl onset speed; 1: no search", default="30", lower=1.0_wp, &
                      upper=1.0e4_wp)
   end function static_info

   !> The section [output].
   function output_info() result(info)
      type(kind_info_t) :: info  !! keys

      info%name = "output"
      info%help = "what to write, and when"
      info%source = ""
      info%is_table = .false.
      call add_number(info, "every", dim_time, "output interval; 0: a thousandth of the output window", default="0 s", lower=0.0_wp)
      call add_duration(info, "from", "first output time, or `N turns of DRIVER`", default="0 s")
      call add_duration(info, "last", "length of the output window before the end, a time or `N turns of DRIVER`; 0: all", &
         default="0 s")
      call add_word(info, "contact_rows", "additional output rows at onset, peak and separation of every contact: " &
                    //"on, off (equally spaced rows only), or auto (on up to "//to_text(most_row_contacts)// &
                    " contacts)", default="auto", choices="auto on off")
      call add_number(info, "instants_limit", dim_none, "maximum number of output times, and of periods of the statistics", &
                      default="1e7", lower=2.0_wp, upper=2.0e9_wp)
      call add_number(info, "size_limit", dim_none, "maximum estimated size of the output, in GB", &
                      default="100", lower=1.0e-6_wp)
      call add_words(info, "channels", "channels to write: item.channel, item.*, *.channel or *", default="*")
      call add_word(info, "motion", "motion file for other programs: vtkhdf (motion.vtkhdf, for ParaView), " &
                    //"one step per output time", default="off", choices="off vtkhdf")
      call add_words(info, "figures", "figures: a channel, several of them (A + B), phase plots (A against C), with units and " &
                     //"limits of axes (in mm, from 0 mm to 2 mm), stacked panels (panels(A, B)); JOINT.orbit, " &
                     //"portrait(x_channel,y_channel), film(JOINT), wear(JOINT), mechanism, strip(n=8), coupler(POINT), " &
                     //"animation(last=...)", &
                     default="")
      call add_flag(info, "csv", "write time histories, events and profiles of worn surfaces as comma-separated values too", &
                    default="off")
      call add_number(info, "worn_stl", dim_none, "write worn bearings and journals as solids (JOINT.bearing.stl, in mm), with " &
                      //"depths magnified by this factor; 0: none", default="0", lower=0.0_wp)
      call add_flag(info, "report", "write report.html, a single page: the deck with all defaults, figures, extremes, impacts, " &
                    //"cost and error, warnings; of a sweep its runs as plots and a table; it works offline", default="off")
   end function output_info

end module section_info
