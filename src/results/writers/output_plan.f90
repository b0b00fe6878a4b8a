!> What a recorder is reported before a run: where its files go and what they say of the run.
module output_plan
   use accuracy_results, only: accuracy_t
   use drawing, only: drawing_t
   use exponent, only: horizon_t
   use frames, only: frame_plan_t
   use kinds, only: i8, wp
   use statistics, only: statistics_plan_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: lifetime_t, output_plan_t
   public :: show_json, show_nothing, show_summary

   integer, parameter :: show_nothing = 0  !! nothing on the standard output
   integer, parameter :: show_summary = 1  !! summary.txt on the standard output
   integer, parameter :: show_json = 2     !! summary.json on the standard output, and nothing else

   !> Where a run comes from.
   type :: origin_t
      character(:), allocatable :: deck_name           !! path of the deck as the user gave it
      character(:), allocatable :: deck_text           !! the deck, verbatim
      character(:), allocatable :: deck_echo           !! the deck as understood; unallocated: no deck.echo
      type(text_t), allocatable :: include_names(:)    !! (n) included files, as in the deck
      type(text_t), allocatable :: include_texts(:)    !! (n) their contents, verbatim
      character(:), allocatable :: program_version     !! as `0.1.0`
      character(:), allocatable :: git_sha1            !! of the sources
      character(:), allocatable :: compiler            !! name and version
      character(:), allocatable :: libraries           !! names and versions
      character(:), allocatable :: command             !! the command line
      character(:), allocatable :: flags               !! what it was compiled with
      character(:), allocatable :: kernels             !! of the BLAS, as it calls them; blank: it does not report
      character(:), allocatable :: choices             !! options that decide what is written, as text
      type(text_t), allocatable :: parameter_names(:)  !! (m) parameters of the deck
      type(text_t), allocatable :: parameter_texts(:)  !! (m) their values in force, as written
   end type origin_t

   !> What is written.
   type :: written_t
      logical :: hdf5 = .true.              !! write run.h5
      logical :: histories = .true.         !! write time histories to run.h5
      logical :: contact_rows = .false.     !! write rows at the instants of contacts, besides the output instants
      logical :: texts = .true.             !! write time histories and events as text
      logical :: csv = .false.              !! write them as comma-separated values too
      real(wp) :: worn_stl = 0.0_wp         !! write worn surfaces as solids, depths times this; 0: do not [1]
      logical :: summary = .true.           !! write summary.txt and summary.json
      logical :: motion = .false.           !! write the motion for other programs
      logical :: figures = .true.           !! make the figures at the end
      logical :: report = .false.           !! write the page of the run
      logical :: progress = .true.          !! show how far the run is on the standard error
      logical :: warnings = .true.          !! print warnings on the standard error
   end type written_t

   !> How long a run may last, and whether it can continue another time.
   type :: lifetime_t
      logical :: is_saved = .false.         !! it is saved now and then, and when it is asked to end
      logical :: goes_on = .false.          !! it continues from what an earlier run has saved
      logical :: is_concluded_later = .false.  !! figures and summary are made when they are asked for, not when the motion ends
      integer(i8) :: begun = 0              !! when the program started, on the clock of `clock_ms` [ms]
      real(wp) :: walltime = 0.0_wp         !! time from then on after which it ends; 0: none is set [s]
      real(wp) :: resumed_from = 0.0_wp     !! with `goes_on`: time of the motion at which that was saved [s]
      real(wp) :: stop_at = huge(1.0_wp)    !! time of the motion after which it is saved and ends [s]
   end type lifetime_t

   !> What the mechanism looks like, and when, if someone needs to see it.
   type :: looks_t
      type(drawing_t) :: drawing    !! outlines and joints
      type(frame_plan_t) :: frames  !! instants that figures need
   end type looks_t

   !> The plan. Strings and lists that are not allocated count as empty.
   !> Components: all that the cli reports a recorder, which is one argument for this reason.
   type :: output_plan_t
      character(:), allocatable :: directory           !! of the run, which exists and is ours
      type(origin_t) :: origin                         !! where the run comes from
      character(:), allocatable :: title               !! of the scene
      character(:), allocatable :: suffix  !! of text files' names: blank, or `.ideal` for the reference run with ideal joints
      integer :: n_freedom = 0                         !! degrees of freedom at the start, of drivers none
      real(wp) :: mass = 0.0_wp                        !! of the lightest body [kg]
      integer(i8) :: n_instant = 0                     !! output instants up to the end of the motion
      real(wp) :: moved = 0.0_wp                       !! how far assembly moved a body from where the deck puts it [m]
      type(text_t), allocatable :: channels(:)         !! (n) words of the deck's `channels`; none: everything
      type(text_t), allocatable :: warnings(:)         !! (n) what was noticed before the run
      type(text_t), allocatable :: notes(:)            !! (m) values of the deck that are possible but unusual
      type(statistics_plan_t) :: statistics            !! numbers of the motion after its transient
      type(accuracy_t) :: accuracy                     !! what is known of the errors, if an accuracy was asked for
      type(looks_t) :: looks                           !! what drawings of the mechanism need
      type(horizon_t) :: horizon                       !! how long digits mean anything; without times: it was not asked for
      type(written_t) :: with                          !! what is written
      type(lifetime_t) :: life                         !! how long it may last
      character(:), allocatable :: contact_rows        !! rows at the instants of contacts as text; blank: there are no contacts
      integer :: show = show_summary                   !! what to print at the end, one of the above
   contains
      procedure :: complete => complete_plan
      procedure :: is_twin
   end type output_plan_t

contains

   !> Give everything that was not said its empty value.
   subroutine complete_plan(self)
      class(output_plan_t), intent(inout) :: self  !! the plan

      call fill(self%directory, ".")
      call fill(self%origin%deck_name, "")
      call fill(self%origin%deck_text, "")
      call fill(self%title, "")
      call fill(self%origin%program_version, "unknown")
      call fill(self%origin%git_sha1, "unknown")
      call fill(self%origin%compiler, "unknown")
      call fill(self%origin%libraries, "unknown")
      call fill(self%origin%command, "")
      call fill(self%origin%flags, "")
      call fill(self%origin%choices, "")
      call fill(self%origin%kernels, "")
      call fill(self%suffix, "")
      call fill(self%contact_rows, "")
      call fill_list(self%origin%include_names)
      call fill_list(self%origin%include_texts)
      call fill_list(self%origin%parameter_names)
      call fill_list(self%origin%parameter_texts)
      call fill_list(self%channels)
      call fill_list(self%warnings)
      call fill_list(self%notes)
   end subroutine complete_plan

   !> A string if there is none.
   pure subroutine fill(string, default)
      character(:), allocatable, intent(inout) :: string  !! the string
      character(*), intent(in) :: default                 !! what it is if it was not given

      if (.not. allocated(string)) string = default
   end subroutine fill

   !> An empty list if there is none.
   pure subroutine fill_list(list)
      type(text_t), allocatable, intent(inout) :: list(:)  !! (n) the list

      if (.not. allocated(list)) allocate (list(0))
   end subroutine fill_list

   !> Whether the files are those of the reference run with ideal joints, which lie beside the run's own.
   pure logical function is_twin(self)
      class(output_plan_t), intent(in) :: self  !! the plan

      is_twin = .false.
      if (allocated(self%suffix)) is_twin = len_trim(self%suffix) > 0
   end function is_twin

end module output_plan
