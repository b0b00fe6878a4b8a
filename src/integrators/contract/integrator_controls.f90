!> What a user may set of an integrator, and the deck columns that set it.
!>
!> They carry the names of IMSL's IVPRK (Hull, Enright and Jackson's DVERK) beside plain
!> ones: TOL tolerance, HINIT initial_step, HMIN minimum_step, HMAX maximum_step, MXSTEP
!> maximum_steps, MXFCN maximum_evaluations, INORM norm, FLOOR floor.
module integrator_controls
   use item, only: item_t, place_of
   use kind_info, only: add_number, add_word, dim_length, dim_none, dim_time, kind_info_t
   use kinds, only: i8, min_tolerance, wp
   implicit none (type, external)
   private
   public :: add_control_columns, add_onset_options, controls_t, read_controls
   public :: norm_absolute, norm_euclidean, norm_mixed, norm_relative, norm_scaled
   public :: onset_interpolate, onset_located, onset_reject, onset_uncontrolled, onset_words

   integer, parameter :: norm_mixed = 0       !! IMSL INORM = 0: |e| / max(|y|, 1), maximum entry
   integer, parameter :: norm_absolute = 1    !! IMSL INORM = 1: |e|, maximum entry
   integer, parameter :: norm_relative = 2    !! IMSL INORM = 2: |e| / max(|y|, FLOOR), maximum entry
   integer, parameter :: norm_euclidean = 3   !! IMSL INORM = 3: root of the sum of squares of |e| / max(|y|, 1)
   integer, parameter :: norm_scaled = -1     !! |e| over the natural scale of the entry, maximum entry

   integer, parameter :: onset_located = 0       !! onsets of contacts are located, as all events
   integer, parameter :: onset_interpolate = 1   !! linear interpolation back to the onset
   integer, parameter :: onset_reject = 2        !! steps that penetrate more than a limit are halved
   integer, parameter :: onset_uncontrolled = 3  !! a contact starts where the step ends that finds it

   !> The norms and the treatments of onsets as text.
   character(*), parameter :: norm_words(-1:3) = [character(9) :: "scaled", "mixed", "absolute", "relative", "euclidean"]
   character(*), parameter :: onset_words(0:3) = [character(12) :: "located", "interpolate", "reject", "uncontrolled"]

   real(wp), parameter :: default_limit = 1.0e-7_wp  !! penetration at an onset found by rejection [m]

   !> What a user may set.
   type :: controls_t
      real(wp) :: tolerance = 1.0e-8_wp        !! TOL: local error allowed in the norm [1]
      real(wp) :: fixed_step = 0.0_wp          !! length of fixed steps, 0: variable steps [s]
      real(wp) :: initial_step = 0.0_wp        !! HINIT: first step tried, 0: chosen [s]
      real(wp) :: minimum_step = 0.0_wp        !! HMIN: minimum step, 0: what arithmetic allows [s]
      real(wp) :: maximum_step = 0.0_wp        !! HMAX: maximum step, 0: no limit [s]
      integer(i8) :: maximum_steps = 0         !! MXSTEP: accepted steps allowed, 0: no limit
      integer(i8) :: maximum_evaluations = 0   !! MXFCN: evaluations allowed, 0: no limit
      integer :: norm = norm_scaled            !! INORM: error norm, one of the above
      real(wp) :: floor = 1.0_wp               !! FLOOR: of the relative norm [any]
      integer :: onset = onset_located         !! how onsets of contacts are met, one of the above
      real(wp) :: onset_limit = default_limit  !! maximum penetration at an onset with `onset_reject` [m]
   end type controls_t

   real(wp), parameter :: most_counted = 9.0e18_wp  !! steps or evaluations that can be counted [1]

contains

   !> The deck columns of the controls.
   subroutine add_control_columns(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      call add_number(info, "tolerance", dim_none, "local error tolerance (TOL), relative to the size and speed of the mechanism", &
                      default="1e-8", lower=min_tolerance, upper=0.01_wp)
      call add_number(info, "step", dim_time, "fixed step; 0: variable steps", default="0 s", lower=0.0_wp)
      call add_number(info, "initial_step", dim_time, "initial step; 0: automatic", default="0 s", lower=0.0_wp)
      call add_number(info, "minimum_step", dim_time, "minimum step; 0: limited by round-off only", default="0 s", lower=0.0_wp)
      call add_number(info, "maximum_step", dim_time, "maximum step; 0: no limit", default="0 s", lower=0.0_wp)
      call add_number(info, "maximum_steps", dim_none, "maximum number of accepted steps; 0: no limit", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "maximum_evaluations", dim_none, "maximum number of evaluations of the right-hand side; 0: no limit", &
                      default="0", lower=0.0_wp, upper=most_counted)
      call add_word(info, "norm", "error norm: relative to natural scales (scaled), or as INORM: mixed 0, absolute 1, relative "// &
         "2, " &
                    //"euclidean 3", default="scaled", choices="scaled mixed absolute relative euclidean")
      call add_number(info, "floor", dim_none, "minimum |y| in the relative norm (FLOOR)", default="1", lower=0.0_wp, &
                      open_lower=.true.)
      call add_word(info, "contact_onset", "treatment of a contact onset: located (step ends at the onset, to round-off); "// &
         "interpolate " &
                    //"(linear interpolation back to it after a step that penetrates); reject (halve steps that penetrate more "// &
                       "than limit, " &
                    //"default limit=0.1um); uncontrolled (end of the step that detects it)", default="located", &
                    choices="located interpolate reject uncontrolled", options="limit")
      call add_number(info, "tol", dim_none, "IMSL name of tolerance; 0: not given", default="0", lower=0.0_wp, &
                      upper=0.01_wp)
      call add_number(info, "hinit", dim_time, "IMSL name of initial_step", default="0 s", lower=0.0_wp)
      call add_number(info, "hmin", dim_time, "IMSL name of minimum_step", default="0 s", lower=0.0_wp)
      call add_number(info, "hmax", dim_time, "IMSL name of maximum_step", default="0 s", lower=0.0_wp)
      call add_number(info, "mxstep", dim_none, "IMSL name of maximum_steps", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "mxfcn", dim_none, "IMSL name of maximum_evaluations", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "inorm", dim_none, "IMSL number of the norm, 0 to 3; -1: value of norm", default="-1", &
                      lower=-1.0_wp, upper=3.0_wp)
   end subroutine add_control_columns

   !> The options of a word of `contact_onset`, as columns.
   subroutine add_onset_options(word, info)
      character(*), intent(in) :: word          !! as in `contact_onset = word`
      type(kind_info_t), intent(inout) :: info  !! its options

      if (word /= "reject") return
      call add_number(info, "limit", dim_length, "maximum penetration at an onset", default="", lower=0.0_wp, open_lower=.true.)
   end subroutine add_onset_options

   !> The controls from a section of settings that has the columns of `add_control_columns`; the scene
   !> has folded IMSL's names into the plain ones.
   subroutine read_controls(item, controls)
      type(item_t), intent(in) :: item           !! the section
      type(controls_t), intent(out) :: controls  !! the controls

      integer :: k

      controls%tolerance = item%number("tolerance")
      controls%fixed_step = item%number("step")
      controls%initial_step = item%number("initial_step")
      controls%minimum_step = item%number("minimum_step")
      controls%maximum_step = item%number("maximum_step")
      controls%maximum_steps = int(item%number("maximum_steps"), i8)
      controls%maximum_evaluations = int(item%number("maximum_evaluations"), i8)
      controls%floor = item%number("floor")
      controls%norm = findloc(norm_words == item%word("norm"), .true., dim=1) - 1 + lbound(norm_words, 1)
      associate (value => item%values(place_of(item, "contact_onset")))
         controls%onset = findloc(onset_words == value%text, .true., dim=1) - 1 + lbound(onset_words, 1)
         if (allocated(value%options)) then
            do k = 1, size(value%options)
               controls%onset_limit = value%options(k)%number
            end do
         end if
      end associate

   end subroutine read_controls

end module integrator_controls
