!> Words for channels and figures: what they name, and what is said of those that name nothing.
module test_output_channels
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_bodies, group_contacts
   use channel_names, only: component_letter, scalar_name, scalar_t
   use channels, only: list_scalars, select_channels, selection_t
   use check, only: check_equal, check_true, suite_t
   use errors, only: error_t
   use figure_binding, only: bind_figure
   use figure_phrase, only: mistake_t
   use figure_words, only: figure_orbit, figure_portrait, figure_t, read_figure
   use output_scene, only: make_scene
   use text, only: join, split_blank, text_t
   implicit none (type, external)
   private
   public :: run_test_output_channels

contains

   subroutine run_test_output_channels(suite)
      type(suite_t), intent(inout) :: suite  !! tests of the program

      call suite%test("words_name_channels", words_name_channels)
      call suite%test("no_words_name_all", no_words_name_all)
      call suite%test("unknown_words_are_explained", unknown_words_are_explained)
      call suite%test("an_item_has_only_its_channels", an_item_has_only_its_channels)
      call suite%test("components_have_letters", components_have_letters)
      call suite%test("figures_are_understood", figures_are_understood)
      call suite%test("wrong_figures_are_explained", wrong_figures_are_explained)
   end subroutine run_test_output_channels

   !> The names of everything that words name.
   function named(words) result(names)
      character(*), intent(in) :: words      !! blank-separated words
      character(:), allocatable :: names     !! blank-separated names of numbers

      type(catalogue_t) :: scene
      type(selection_t) :: selection
      type(scalar_t), allocatable :: scalars(:)
      type(text_t), allocatable :: list(:)
      character(:), allocatable :: hint, message
      integer :: bad, k

      call make_scene(scene)
      call select_channels(split_blank(words), scene, selection, bad, message, hint)
      scalars = list_scalars(selection)
      allocate (list(size(scalars)))
      do k = 1, size(scalars)
         list(k)%s = scalar_name(scene, scalars(k))
      end do
      names = join(list, " ")
   end function named

   subroutine words_name_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_equal(error, named("slider.velocity"), "slider.velocity.x slider.velocity.y", "a quantity")
      call check_equal(error, named("slider.velocity.y"), "slider.velocity.y", "a component")
      call check_equal(error, named("*.angle"), "crank.angle slider.angle", "of all items")
      call check_equal(error, named("gudgeon.penetration"), "gudgeon.penetration", "of a single contact")
      call check_equal(error, named("guide.penetration"), "guide.A.penetration guide.B.penetration", "of all contacts")
      call check_equal(error, named("guide.B.penetration"), "guide.B.penetration", "of one contact")
      call check_equal(error, named("guide.*"), "guide.eccentricity.x guide.eccentricity.y guide.A.penetration "// &
                       "guide.B.penetration guide.A.state guide.B.state", "all of a joint")
      call check_equal(error, named("energy.*"), "energy.kinetic energy.residual", "the ledger")
      call check_equal(error, named("motor.moment slider.angle motor.*"), "slider.angle motor.moment", "twice the same")
   end subroutine words_name_channels

   subroutine no_words_name_all(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(text_t), allocatable :: words(:)

      call check_equal(error, named(""), named("*"), "no words")
      words = split_blank(named(""))
      call check_equal(error, size(words), 23, "numbers of the scene")
   end subroutine no_words_name_all

   !> Check what is said of a wrong word.
   subroutine check_word(error, words, number, message, hint)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: words                   !! blank-separated words
      integer, intent(in) :: number                       !! of the wrong one
      character(*), intent(in) :: message                 !! what must be said
      character(*), intent(in) :: hint                    !! how the hint must start

      type(catalogue_t) :: scene
      type(selection_t) :: selection
      character(:), allocatable :: got_hint, got_message
      integer :: bad

      call make_scene(scene)
      call select_channels(split_blank(words), scene, selection, bad, got_message, got_hint)
      call check_equal(error, bad, number, "number of the wrong word in '"//words//"'")
      call check_equal(error, got_message, message, "message")
      call check_equal(error, got_hint(1:min(len(hint), len(got_hint))), hint, "hint")
   end subroutine check_word

   subroutine unknown_words_are_explained(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_word(error, "motor.moment slidr.velocity", 2, "unknown channel 'slidr.velocity'", &
                      "did you mean 'slider.velocity'? channels of slider: position velocity angle")
      call check_word(error, "slider.velocty", 1, "unknown channel 'slider.velocty'", "did you mean 'slider.velocity'?")
      call check_word(error, "slider.velocity.z", 1, "unknown channel 'slider.velocity.z'", &
                      "'slider.velocity' has no component 'z'")
      call check_word(error, "piston.velocity", 1, "unknown channel 'piston.velocity'", &
                      "items with channels: crank slider motor gudgeon guide energy")
      call check_word(error, "slider", 1, "unknown channel 'slider'", "write 'slider.*'")
      call check_word(error, "guide.C.penetration", 1, "unknown channel 'guide.C.penetration'", "channels of guide:")
      call check_word(error, ".", 1, "unknown channel '.'", "items")
      call check_word(error, "a.b.c.d.e", 1, "unknown channel 'a.b.c.d.e'", "items")
   end subroutine unknown_words_are_explained

   subroutine an_item_has_only_its_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(catalogue_t) :: scene

      call make_scene(scene)
      call check_true(error, scene%item_has(scene%find_group(group_bodies, "angle"), 2), "the slider has an angle")
      call check_true(error, scene%item_has(scene%find_group(group_contacts, "state"), 3), "a contact has a state")
      call scene%add_item(group_bodies, "point_mass")
      call scene%allocate_data()
      call check_true(error, scene%item_has(scene%find_group(group_bodies, "angle"), 3), "an item without kind has all")
   end subroutine an_item_has_only_its_channels

   subroutine components_have_letters(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_equal(error, component_letter(1, 1), "", "scalar")
      call check_equal(error, component_letter(2, 2)//component_letter(3, 3), "yz", "vectors")
      call check_equal(error, component_letter(4, 1)//component_letter(4, 4), "e0e3", "Euler parameters")
   end subroutine components_have_letters

   !> Read a figure and look up what it names.
   subroutine understand(word, figure, mistake)
      character(*), intent(in) :: word                       !! the figure
      type(figure_t), intent(out) :: figure                  !! its record
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      type(catalogue_t) :: scene

      call make_scene(scene)
      call read_figure(word, figure, mistake)
      if (.not. allocated(mistake)) call bind_figure(figure, scene, mistake)
   end subroutine understand

   subroutine figures_are_understood(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(catalogue_t) :: scene
      type(figure_t) :: figure
      type(mistake_t), allocatable :: mistake

      call understand("slider.velocity", figure, mistake)
      call check_true(error, .not. allocated(mistake), "a channel")
      call check_equal(error, size(figure%scalars), 2, "its components")
      call check_equal(error, figure%name, "slider.velocity", "its name")
      call understand("gudgeon.orbit", figure, mistake)
      call check_true(error, .not. allocated(mistake), "an orbit")
      call check_equal(error, figure%kind, figure_orbit, "kind of an orbit")
      call make_scene(scene)
      call bind_figure(figure, scene, mistake)
      call check_equal(error, size(figure%scalars), 2, "its coordinates, bound once more")
      call understand("portrait(slider.velocity.x,crank.angle)", figure, mistake)
      call check_true(error, .not. allocated(mistake), "a portrait")
      call check_equal(error, figure%kind, figure_portrait, "kind of a portrait")
      call check_equal(error, figure%name, "portrait.slider.velocity.x.crank.angle", "name of a portrait")
      call understand("energy.*", figure, mistake)
      call check_equal(error, figure%name, "energy.all", "name of many")
   end subroutine figures_are_understood

   !> Check what is said of a wrong figure.
   subroutine check_figure(error, word, message)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: word                    !! the figure
      character(*), intent(in) :: message                 !! how the message must start

      type(figure_t) :: figure
      type(mistake_t), allocatable :: mistake

      call understand(word, figure, mistake)
      call check_true(error, allocated(mistake), "'"//word//"' is wrong")
      if (.not. allocated(mistake)) return
      call check_equal(error, mistake%message(:min(len(message), len(mistake%message))), message, "message")
      call check_true(error, len(mistake%hint) > 0, "there is a hint for '"//word//"'")
   end subroutine check_figure

   subroutine wrong_figures_are_explained(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_figure(error, "slidr.velocity", "unknown figure 'slidr.velocity'")
      call check_figure(error, "gudgen.orbit", "no orbit of 'gudgen'")
      call check_figure(error, "motor.orbit", "no orbit of 'motor'")
      call check_figure(error, "slider.*", "'slider.*' names channels of different units")
      call check_figure(error, "*", "'*' names too many")
      call check_figure(error, "portrait(slider.velocity.x", "cannot read")
      call check_figure(error, "portrait(slider.velocity,crank.angle)", "'slider.velocity' is not a single number")
      call check_figure(error, "portrait(slider.velocity.x,crank.angel)", "unknown channel 'crank.angel'")
      call check_figure(error, "slider.velocity.x + crank.angel", "unknown channel 'crank.angel'")
      call check_figure(error, "slider.velocity.x + crank.angle + motor.moment", "'motor.moment' has another unit")
      call check_figure(error, "slider.velocity.x in mm", "unit 'mm' does not match the dimension")
      call check_figure(error, "slider.velocity.x in furlong", "unknown unit 'furlong'")
      call check_figure(error, "slider.velocity.x from 0 to 1", "missing unit of the axis limits")
      call check_figure(error, "slider.velocity.x from 2 to 1 m/s", "the axis limits do not increase")
      call check_figure(error, "slider.velocity.x from 1 m/s", "missing 'to'")
      call check_figure(error, "slider.velocity.x against slider.velocity", "'slider.velocity' is not a single number")
      call check_figure(error, "slider.velocity.x against crank.angle + motor.moment", "a figure has one abscissa")
      call check_figure(error, "gudgeon.orbit in mm", "'in' is valid for figures of curves")
      call check_figure(error, "panels(slider.velocity.x,)", "missing channel before ')'")
   end subroutine wrong_figures_are_explained

end module test_output_channels
