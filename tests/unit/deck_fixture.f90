!> Small kinds and decks for the tests of `input/deck`.
module deck_fixture
   use deck_file, only: read_deck
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use echo, only: echo_items, echo_settings
   use errors, only: error_t
   use item, only: item_t
   use kind_info, only: add_duration, add_expression, add_flag, add_number, add_reference, add_vector, add_word, add_words, &
                      & dim_acceleration, dim_angle, dim_contact_stiffness, dim_length, dim_mass, dim_none, dim_temperature, &
                      & kind_info_t
   use kinds, only: wp
   use scratch_deck, only: remove_scratch, write_scratch
   use settings, only: check_sections, read_settings
   use tables, only: read_items
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: read_all, read_lines, reading_t

   integer, parameter :: n_kind = 4  !! scene, bodies, driver, output

   !> All that came of reading a deck.
   type :: reading_t
      type(deck_t) :: deck                        !! the deck
      type(item_t) :: scene                       !! section scene
      type(item_t) :: output                      !! section output
      type(item_t), allocatable :: bodies(:)      !! table bodies
      type(item_t), allocatable :: drivers(:)     !! table driver.angle
      integer :: n_mistake = 0                    !! errors found
      character(:), allocatable :: message        !! errors as shown, empty if none
      character(:), allocatable :: echo           !! the deck written back
   end type reading_t

contains

   !> The kinds.
   subroutine make_kinds(kinds)
      type(kind_info_t), allocatable, intent(out) :: kinds(:)  !! (n_kind) scene, bodies, driver.angle, output

      allocate (kinds(n_kind))
      kinds(1)%name = "scene"
      kinds(1)%is_table = .false.
      call add_word(kinds(1), "title", "one line", default="""""")
      call add_vector(kinds(1), "gravity", dim_acceleration, 2, "free fall", default="0 -9.81 m/s^2")
      call add_number(kinds(1), "temperature", dim_temperature, "of everything", default="20 degC")
      kinds(2)%name = "bodies"
      call add_number(kinds(2), "mass", dim_mass, "mass", lower=0.0_wp, open_lower=.true.)
      call add_number(kinds(2), "x", dim_length, "place", default="0 m")
      call add_number(kinds(2), "stiffness", dim_contact_stiffness, "of the surface", default="1e9 N/m^1.5", lower=0.0_wp)
      call add_reference(kinds(2), "parent", "bodies", "another body", default="")
      call add_flag(kinds(2), "fixed", "does not move", default="off")
      kinds(3)%name = "driver.angle"
      call add_reference(kinds(3), "body", "bodies", "what turns")
      call add_expression(kinds(3), "angle", dim_angle, "law of motion")
      kinds(4)%name = "output"
      kinds(4)%is_table = .false.
      call add_duration(kinds(4), "end", "end of time", lower=0.0_wp, open_lower=.true.)
      call add_duration(kinds(4), "last", "last stretch", default="")
      call add_words(kinds(4), "channels", "what is written", default="*")
      call add_word(kinds(4), "method", "how", default="fast alpha=5s^-1", choices="fast slow", options="alpha beta file")
      call add_number(kinds(4), "factor", dim_none, "a number", default="1", lower=0.0_wp, upper=2.0_wp)
   end subroutine make_kinds

   !> Read the deck in some file.
   subroutine read_all(path, overrides, reading)
      character(*), intent(in) :: path           !! of the deck
      type(text_t), intent(in) :: overrides(:)   !! (n) of the command line
      type(reading_t), intent(out) :: reading    !! what came of it

      type(diagnostics_t) :: diagnostics
      type(error_t), allocatable :: error
      type(kind_info_t), allocatable :: kinds(:)
      logical :: is_present

      call make_kinds(kinds)
      call read_deck(path, overrides, reading%deck, diagnostics)
      call check_sections(reading%deck, kinds, .false., diagnostics)
      call read_settings(reading%deck, kinds(1), reading%scene, is_present, diagnostics)
      call read_items(reading%deck, kinds(2), reading%bodies, diagnostics)
      call read_items(reading%deck, kinds(3), reading%drivers, diagnostics)
      call read_settings(reading%deck, kinds(4), reading%output, is_present, diagnostics)
      reading%n_mistake = diagnostics%count()
      call diagnostics%to_error(reading%deck%sources, error)
      reading%message = ""
      if (allocated(error)) reading%message = error%message
      reading%echo = ""
      if (allocated(error)) return
      reading%echo = "deck = 1"//new_line("a")//echo_settings(kinds(1), reading%scene)//echo_items(kinds(2), reading%bodies) &
                   & //echo_items(kinds(3), reading%drivers)//echo_settings(kinds(4), reading%output)
   end subroutine read_all

   !> Write a deck to a file of its own, read it, remove the file.
   subroutine read_lines(whole, reading, override)
      character(*), intent(in) :: whole                !! the deck
      type(reading_t), intent(out) :: reading          !! what came of it
      character(*), intent(in), optional :: override   !! of the command line

      type(text_t), allocatable :: overrides(:)
      character(:), allocatable :: path

      allocate (overrides(0))
      if (present(override)) call append_text(overrides, override)
      call write_scratch(whole, path)
      call read_all(path, overrides, reading)
      call remove_scratch(path)
   end subroutine read_lines

end module deck_fixture
