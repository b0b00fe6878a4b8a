!> The room `deck` from outside: everything that other rooms use of it.
!>
!>     call read_deck(path, overrides, deck, diagnostics)
!>     call check_sections(deck, kinds, diagnostics)
!>     call read_settings(deck, info, item, is_present, diagnostics)
!>     call read_items(deck, info, items, diagnostics)
!>     call diagnostics%add(location, summary, note, help)
!>     call diagnostics%to_error(deck%sources, error)
!>
!> Every call goes on after mistakes, so that several are reported in one go.
module deck_reader
   use cell_checks, only: is_name
   use deck_file, only: deck_version, read_deck
   use deck_texts, only: deck_text, get_includes
   use deck_types, only: deck_t, location_of_end
   use diagnostics, only: diagnostics_t
   use echo, only: all_defaults, echo_items, echo_settings, echo_start, get_parameters
   use settings, only: check_sections, has_section, read_settings
   use sweep_values, only: read_sweep, sweep_t, swept_t
   use tables, only: read_items
   implicit none (type, external)
   private
   public :: all_defaults, check_sections, deck_t, deck_text, deck_version, diagnostics_t, echo_items, echo_settings
   public :: echo_start, get_includes, get_parameters, has_section, is_name, location_of_end, read_deck, read_items
   public :: read_settings, read_sweep, sweep_t, swept_t

end module deck_reader
