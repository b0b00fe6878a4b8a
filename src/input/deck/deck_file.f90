!> Reads a deck with all its includes: version, sections, lines of cells, overrides, parameters.
!>
!> What is in it is asked for section by section; every call continues after errors, so that several are reported in one go:
!>
!>     call read_deck(path, overrides, deck, errors)             here
!>     call check_sections(deck, kinds, is_spatial, errors)      settings
!>     call read_settings(deck, info, item, is_present, errors)  settings
!>     call read_items(deck, info, items, errors)                tables
!>     call mistakes%add(location, summary, note, help)            diagnostics
!>     call mistakes%to_error(deck%sources, error)                 diagnostics
module deck_file
   use deck_types, only: add_inclusion, add_line, add_section, add_source, deck_t, location_of_end, text_of
   use diagnostics, only: diagnostics_t
   use file_path, only: beside, plain_path
   use item, only: location_t
   use kinds, only: i8
   use name_table, only: name_table_t
   use parameters, only: read_parameters
   use source_text, only: line_of, n_line_of, new_source, read_source, source_t
   use text, only: starts_with, text_t, to_text
   use tokens, only: has_content, lex_line, token_equals, token_quoted, token_word
   implicit none (type, external)
   private
   public :: deck_version, read_deck

   character(*), parameter :: deck_version = "1"  !! of the format that is read

   integer, parameter :: deepest = 16                  !! files included by each other
   integer(i8), parameter :: most_bytes = 256000000_i8  !! of a deck with all that it includes

   !> What the reader of lines has to remember.
   type :: reading_t
      integer :: chain(deepest) = 0       !! files being read, the innermost last
      integer :: depth = 0                !! number of them
      integer :: section = 0              !! section being read, 0: none
      logical :: is_new = .true.          !! no line with content was read in this file
      logical :: is_lost = .false.        !! a line outside any section was reported
      logical :: is_over = .false.        !! the rest is not worth reading
      logical :: continues = .false.      !! the last line ended with a backslash: the next belongs to it
      type(location_t) :: backslash       !! where that stands
      type(name_table_t) :: files         !! files read so far
      integer(i8) :: n_byte = 0_i8        !! their size
   end type reading_t

contains

   !> Read a deck. Errors are collected; `deck` may be used even then.
   subroutine read_deck(path, overrides, deck, mistakes)
      character(*), intent(in) :: path                !! of the deck
      type(text_t), intent(in) :: overrides(:)        !! (n) `NAME=VALUE` of the command line
      type(deck_t), intent(out) :: deck               !! the deck
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: message
      type(reading_t) :: reading
      type(source_t) :: source
      integer :: k, number

      call read_source(path, source, message, may_be_stream=.true.)
      call add_source(deck, source, number)
      do k = 1, size(overrides)
         call new_source(source, "--set "//overrides(k)%s, overrides(k)%s)
         call add_source(deck, source, number)
      end do
      deck%n_override = size(overrides)
      allocate (deck%parameter_text(0))
      if (len(message) > 0) then
         call mistakes%add(location_t(), "cannot read the deck '"//path//"'", message)
         deck%is_readable = .false.
         return
      end if
      reading%n_byte = len(deck%sources(1)%text, i8)
      call read_lines(deck, 1, reading, mistakes)
      if (reading%is_new) call mistakes%add(location_of_end(deck), "the deck is empty", "only comments")
      deck%is_readable = .not. (reading%is_over .or. reading%is_new)
      if (deck%is_readable) call read_parameters(deck, mistakes)
   end subroutine read_deck

   !> Read all lines of one file.
   recursive subroutine read_lines(deck, file, reading, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      integer, intent(in) :: file                     !! number of the file
      type(reading_t), intent(inout) :: reading       !! what to remember
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: line
      integer :: first, k

      reading%depth = reading%depth + 1
      reading%chain(reading%depth) = file
      reading%section = 0
      reading%is_new = .true.
      reading%is_lost = .false.
      do k = 1, n_line_of(deck%sources(file))
         line = line_of(deck%sources(file), k)
         call has_content(line, first)
         if (first == 0) then
            if (reading%continues) call end_line()
            cycle
         end if
         if (line(first:first) == "[") then
            if (reading%continues) call end_line()
            if (reading%is_new .and. file == 1) call report_version(location_t(file, k, first, len_trim(line)), mistakes)
            call read_header(deck, line, location_t(file, k, first, len_trim(line)), reading, mistakes)
         else
            call read_line(deck, location_t(file, k, first, len_trim(line)), reading, mistakes)
         end if
         reading%is_new = .false.
         if (reading%is_over) return
      end do
      if (reading%continues) call end_line()
      reading%depth = reading%depth - 1

   contains

      !> Nothing follows a backslash.
      subroutine end_line()
         call mistakes%add(reading%backslash, "nothing follows the backslash", "the next line is blank, a comment or a section", &
                           "a backslash at the end of a line continues it on the next one")
         reading%continues = .false.
      end subroutine end_line

   end subroutine read_lines

   !> Read a section header.
   subroutine read_header(deck, line, location, reading, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      character(*), intent(in) :: line                !! the line
      type(location_t), intent(in) :: location        !! of its content
      type(reading_t), intent(inout) :: reading       !! what to remember
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: name
      type(location_t) :: at
      integer :: first, last

      at = location
      reading%is_lost = .true.
      reading%section = 0
      last = scan(line(location%first:), "]") + location%first - 1
      if (last < location%first) then
         call mistakes%add(at, "missing end of section name", "']' is missing")
         return
      end if
      name = trim(adjustl(line(location%first + 1:last - 1)))
      if (len(name) == 0) then
         call mistakes%add(at, "empty section name", "put a name in the brackets")
         return
      end if
      at%first = location%first + index(line(location%first + 1:), name)
      at%last = at%first + len(name) - 1
      call has_content(line(last + 1:), first)
      if (first > 0) then
         call mistakes%add(location_t(at%file, at%line, last + first, len_trim(line)), &
                         & "text after the section name '"//name//"'", "put this on a separate line")
      end if
      call add_section(deck, name, at)
      reading%section = deck%n_section
      reading%is_lost = .false.
   end subroutine read_header

   !> Read a line that is not a section header.
   recursive subroutine read_line(deck, location, reading, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(location_t), intent(in) :: location        !! of its content
      type(reading_t), intent(inout) :: reading       !! what to remember
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: word
      integer :: first, n
      logical :: belongs, is_good

      belongs = reading%continues
      reading%continues = .false.
      if (reading%is_new .and. location%file == 1) then
         word = line_of(deck%sources(1), location%line)
         if (.not. starts_with(word(location%first:), "deck")) then
            call report_version(location, mistakes)
            reading%is_over = .true.
            return
         end if
      end if
      first = deck%tokens%n + 1
      call lex_line(deck%sources(location%file), location%file, location%line, deck%tokens, mistakes, is_good)
      n = deck%tokens%n - first + 1
      word = ""
      if (n > 0) then
         if (deck%tokens%t(first)%kind == token_word) word = text_of(deck, deck%tokens%t(first))
         if (n > 1 .and. reading%section > 0 .and. word /= "include") call take_backslash(deck, reading, n)
      end if
      if (belongs) then
         if (.not. is_good) deck%tokens%n = first - 1
         deck%lines(deck%n_line)%last = deck%tokens%n
         return
      end if
      if (reading%is_new .and. (location%file == 1 .or. word == "deck")) then
         call read_version(deck, first, n, location, reading, mistakes)
      else if (.not. is_good) then
         deck%tokens%n = first - 1
      else if (word == "include" .and. n <= 2) then
         call read_include(deck, first, n, location, reading, mistakes)
         deck%tokens%n = max(deck%tokens%n, first - 1)
      else if (reading%section > 0) then
         call add_line(deck, reading%section, first)
      else if (.not. reading%is_lost) then
         call mistakes%add(location, "this line is outside any section", "a section starts with [name]")
         reading%is_lost = .true.
      end if
   end subroutine read_line

   !> A backslash at the end of a line is no cell: the next line belongs to this one.
   subroutine take_backslash(deck, reading, n)
      type(deck_t), intent(inout) :: deck             !! the deck, the line's cells its last
      type(reading_t), intent(inout) :: reading       !! what to remember
      integer, intent(inout) :: n                     !! cells of the line

      associate (last => deck%tokens%t(deck%tokens%n))
         if (last%kind /= token_word) return
         if (text_of(deck, last) /= "\") return
         reading%continues = .true.
         reading%backslash = last%location
      end associate
      deck%tokens%n = deck%tokens%n - 1
      n = n - 1
   end subroutine take_backslash

   !> Check the format version in the first line.
   subroutine read_version(deck, first, n, location, reading, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      integer, intent(in) :: first                    !! first token of the line
      integer, intent(in) :: n                        !! tokens of the line
      type(location_t), intent(in) :: location        !! of its content
      type(reading_t), intent(inout) :: reading       !! what to remember
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: version
      logical :: is_deck

      version = ""
      is_deck = .false.
      if (n == 3) is_deck = text_of(deck, deck%tokens%t(first)) == "deck"
      if (is_deck) then
         if (deck%tokens%t(first + 1)%kind == token_equals) version = text_of(deck, deck%tokens%t(first + 2))
      end if
      if (version == deck_version) return
      if (len(version) == 0) then
         call mistakes%add(location, "invalid format version", "write: deck = "//deck_version)
      else
         call mistakes%add(deck%tokens%t(first + 2)%location, "unsupported format version '"//version//"'", &
                         & "this program supports version "//deck_version)
      end if
      reading%is_over = .true.
   end subroutine read_version

   !> Report that the format version is missing.
   subroutine report_version(location, mistakes)
      type(location_t), intent(in) :: location        !! of the first line
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      call mistakes%add(location, "missing format version", "the first line of a deck must be: deck = "//deck_version)
   end subroutine report_version

   !> Read an included file, once: where it is included again nothing is left to read.
   recursive subroutine read_include(deck, first, n, location, reading, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      integer, intent(in) :: first                    !! first token of the line
      integer, intent(in) :: n                        !! tokens of the line
      type(location_t), intent(in) :: location        !! of its content
      type(reading_t), intent(inout) :: reading       !! what to remember
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: message, path
      type(source_t) :: source
      integer :: k, number

      if (n < 2) path = ""
      if (n == 2) path = text_of(deck, deck%tokens%t(first + 1))
      if (n == 2) then
         if (deck%tokens%t(first + 1)%kind /= token_quoted) path = ""
      end if
      if (len(path) == 0) then
         call mistakes%add(location, "missing file name of an include", "write: include ""file""")
         return
      end if
      path = plain_path(beside(deck%sources(location%file)%place, path))
      do k = 1, reading%depth
         if (plain_path(deck%sources(reading%chain(k))%name) /= path) cycle
         call mistakes%add(deck%tokens%t(first + 1)%location, "'"//path//"' includes itself", &
                         & "this file is already open")
         return
      end do
      if (reading%depth == deepest) then
         call mistakes%add(deck%tokens%t(first + 1)%location, "nested includes exceed the limit of "//to_text(deepest)//" deep", &
                         & "this file was not read", "check for a file that includes itself by another path, through a link")
         reading%is_over = .true.
         return
      end if
      call reading%files%enter(path, deck%n_source + 1, k)
      call add_inclusion(deck, location%file, merge(k, deck%n_source + 1, k > 0))
      if (k > 0) return
      call read_source(path, source, message, may_be_stream=.false.)
      if (len(message) > 0) then
         call mistakes%add(deck%tokens%t(first + 1)%location, "cannot read the included file '"//path//"'", message)
         return
      end if
      reading%n_byte = reading%n_byte + len(source%text, i8)
      if (reading%n_byte > most_bytes) then
         call mistakes%add(deck%tokens%t(first + 1)%location, "the deck with its includes exceeds "// &
                         & to_text(most_bytes)//" bytes", "the limit is exceeded here")
         reading%is_over = .true.
         return
      end if
      call add_source(deck, source, number)
      call read_lines(deck, number, reading, mistakes)
      reading%section = 0
      reading%is_new = .false.
      reading%is_lost = .false.
   end subroutine read_include

end module deck_file
