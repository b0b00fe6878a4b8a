!> Scenes from decks written in a test: systems, starts, channels. Like checks, these do nothing once an error is there.
module scene_fixture
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use catalogue, only: catalogue_t
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use errors, only: error_t
   use kinds, only: not_a_number, wp
   use mechanism, only: mechanism_t
   use mechanism_catalogue, only: build_catalogue
   use mechanism_report, only: report_state
   use read_scene, only: scene_from_deck
   use scene, only: scene_t
   use scratch_deck, only: remove_scratch, write_scratch
   use start_state, only: find_start
   use text, only: text_t
   implicit none (type, external)
   private
   public :: channel_of, channel_pair, nl, read_scene_text, slider_crank, start_text, system_of_text

   character(*), parameter :: nl = new_line("a")  !! between lines of a deck

contains

   !> Read a scene from the text of a deck. Errors of the deck are an error.
   subroutine read_scene_text(text, scene, error)
      character(*), intent(in) :: text                    !! the deck, without `deck = 1`
      type(scene_t), intent(out) :: scene                 !! what it means
      type(error_t), allocatable, intent(inout) :: error  !! first failure; errors in it

      type(deck_t) :: deck
      type(diagnostics_t) :: mistakes
      type(text_t) :: none(0)
      character(:), allocatable :: path

      if (allocated(error)) return
      call write_scratch("deck = 1"//nl//text//nl, path)
      call read_deck(path, none, deck, mistakes)
      call remove_scratch(path)
      if (mistakes%count() == 0) call scene_from_deck(deck, scene, mistakes)
      call mistakes%to_error(deck%sources, error)
   end subroutine read_scene_text

   !> The system of a deck, its joints with clearance as the deck has them.
   subroutine system_of_text(text, system, error)
      character(*), intent(in) :: text                    !! the deck, without `deck = 1`
      type(mechanism_t), intent(out) :: system        !! its equations
      type(error_t), allocatable, intent(inout) :: error  !! first failure; errors in it

      type(scene_t) :: scene

      call read_scene_text(text, scene, error)
      if (allocated(error)) return
      call new_system(scene, levels_as_written, system)
   end subroutine system_of_text

   !> The system of a deck and its state at t = 0.
   subroutine start_text(text, system, y, error, report)
      character(*), intent(in) :: text                         !! the deck, without `deck = 1`
      type(mechanism_t), intent(out) :: system             !! its equations
      real(wp), allocatable, intent(out) :: y(:)               !! (n) state [any]
      type(error_t), allocatable, intent(inout) :: error       !! first failure; errors, or it has no start
      type(assembly_t), intent(out), optional :: report        !! how the assembly went

      type(assembly_t) :: assembly
      type(scene_t) :: scene

      call read_scene_text(text, scene, error)
      if (allocated(error)) return
      call new_system(scene, levels_as_written, system)
      call find_start(scene, levels_as_written, system, y, assembly, error)
      if (present(report)) report = assembly
   end subroutine start_text

   !> First component of a channel at a state.
   real(wp) function channel_of(system, t, y, item, channel) result(x)
      type(mechanism_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      character(*), intent(in) :: item                !! name of the item
      character(*), intent(in) :: channel             !! name of the channel

      real(wp) :: pair(2)

      pair = channel_pair(system, t, y, item, channel)
      x = pair(1)
   end function channel_of

   !> Both components of a channel at a state (the second is NaN if it has only one); NaN if it is not there.
   function channel_pair(system, t, y, item, channel) result(x)
      type(mechanism_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      character(*), intent(in) :: item                !! name of the item
      character(*), intent(in) :: channel             !! name of the channel
      real(wp) :: x(2)                                !! (2) components [any]

      type(catalogue_t) :: catalogue
      real(wp) :: ydot(system%n)
      integer :: i, k, status

      x = not_a_number()
      call build_catalogue(system, catalogue)
      call report_state(system, t, y, ydot, 0.0_wp, catalogue, status)
      if (status /= 0) return
      do k = 1, size(catalogue%groups)
         associate (group => catalogue%groups(k))
            if (group%channel%name /= channel) cycle
            do i = 1, size(catalogue%item_groups(group%item_group)%names)
               if (catalogue%item_groups(group%item_group)%names(i)%s /= item) cycle
               x(1:group%channel%components) = catalogue%value(k, i)
            end do
         end associate
      end do
   end function channel_pair

   !> A slider-crank with a dry gudgeon pin: crank 50 mm, rod 120 mm, 5000 rpm.
   function slider_crank(settings, law, friction, level) result(deck)
      character(*), intent(in) :: settings          !! lines of [analysis.dynamic]
      character(*), intent(in) :: law               !! normal law of the gudgeon: hertz or damped
      character(*), intent(in) :: friction          !! friction or none
      character(*), intent(in) :: level             !! of the gudgeon: ideal or clearance
      character(:), allocatable :: deck             !! the deck

      deck = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
             "[bodies]"//nl// &
             "name    mass[kg]  inertia[kg.m^2]  x[mm]               y[mm]  angle[deg]"//nl// &
             "crank   0.30      1.0e-4           20                  15     36.86989764584402"//nl// &
             "rod     0.21      2.5e-4           98.09475019311126   15     -14.477512185929924"//nl// &
             "slider  0.14      1.0e-4           156.18950038622252  0      0"//nl// &
             "[points]"//nl// &
             "name    body    xi[mm]  eta[mm]"//nl// &
             "main    ground  0       0"//nl// &
             "heel    crank   -25     0"//nl// &
             "throw   crank   25      0"//nl// &
             "big     rod     -60     0"//nl// &
             "small   rod     60      0"//nl// &
             "pin     slider  0       0"//nl// &
             "[joint.revolute]"//nl//"name i j"//nl//"main main heel"//nl//"big_end throw big"//nl// &
             "[joint.translational]"//nl//"name i j axis"//nl//"guide main pin x"//nl// &
             "[driver.speed]"//nl//"name joint speed[rpm]"//nl//"motor main 5000"//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[clearance.revolute]"//nl// &
             "name bearing journal bearing_radius[mm] clearance[mm] material level law friction"//nl// &
             "gudgeon pin small 10 0.5 steel "//level//" "//law//" "//friction//nl// &
             "[contact.lankarani_nikravesh]"//nl//"name restitution"//nl//"damped 0.9"//nl// &
             "[contact.hertz]"//nl//"name"//nl//"hertz"//nl// &
             "[friction.ambrosio]"//nl//"name coefficient v0[m/s] v1[m/s]"//nl//"rubbing 0.1 1e-4 1e-3"//nl// &
             "[analysis.dynamic]"//nl//"end = 24 ms"//nl//"coordinates = full"//nl//settings
   end function slider_crank

end module scene_fixture
