!> A deck that has been read but not yet understood: texts, tokens, sections, parameters.
module deck_types
   use expression_compile, only: symbols_t
   use item, only: location_t
   use source_text, only: n_line_of, source_t
   use text, only: text_t
   use text_list, only: text_list_t
   use tokens, only: token_list_t, token_t, token_text
   implicit none (type, external)
   private
   public :: add_default, add_inclusion, add_line, add_section, add_source, deck_t, find_section, line_t, location_of_end
   public :: place_of_part, section_t, text_of

   !> A section header.
   type :: section_t
      character(:), allocatable :: name  !! between the brackets
      type(location_t) :: location       !! of the name in the brackets
   end type section_t

   !> A line of a section.
   type :: line_t
      integer :: section = 0  !! number of its section
      integer :: first = 0    !! its first token
      integer :: last = 0     !! its last token
   end type line_t

   !> Files that include others.
   type :: inclusions_t
      integer :: n = 0                       !! inclusions in use
      integer, allocatable :: files(:, :)    !! (2, n or more) a file, and one that it includes
   end type inclusions_t

   !> A whole deck. Source 1 is the deck itself, then come the overrides, then included files.
   type :: deck_t
      type(source_t), allocatable :: sources(:)    !! (n_source or more) texts
      integer :: n_source = 0                      !! texts in use
      integer :: n_override = 0                    !! overrides of the command line among them
      type(inclusions_t) :: inclusions             !! which file includes which
      type(token_list_t) :: tokens                 !! all cells
      type(section_t), allocatable :: sections(:)  !! (n_section or more) in the order of reading
      integer :: n_section = 0                     !! sections in use
      type(line_t), allocatable :: lines(:)        !! (n_line or more) lines with cells
      integer :: n_line = 0                        !! lines in use
      type(symbols_t) :: symbols                   !! parameters, and named functions once they are known
      type(text_t), allocatable :: parameter_text(:) !! (n_parameter) values of the parameters as written
      type(location_t), allocatable :: parameter_change(:) !! (n_parameter) where `--set` changed the deck; else nowhere
      type(text_list_t) :: defaults                !! `kind item key = default`
      integer :: n_written = 0                     !! of these, those for cells and keys; the others follow from values
      logical :: is_readable = .true.              !! .false.: it is not a deck at all; that was reported
   end type deck_t

contains

   !> Append a source; returns its number.
   subroutine add_source(deck, source, number)
      type(deck_t), intent(inout) :: deck       !! the deck
      type(source_t), intent(inout) :: source   !! the text, moved away
      integer, intent(out) :: number            !! of the source

      type(source_t), allocatable :: larger(:)
      integer :: i

      if (.not. allocated(deck%sources)) allocate (deck%sources(4))
      if (deck%n_source == size(deck%sources)) then
         allocate (larger(2*deck%n_source))
         do i = 1, deck%n_source
            call move_source(deck%sources(i), larger(i))
         end do
         call move_alloc(larger, deck%sources)
      end if
      deck%n_source = deck%n_source + 1
      number = deck%n_source
      call move_source(source, deck%sources(number))
   end subroutine add_source

   !> Move a source without copying its text.
   subroutine move_source(from, to)
      type(source_t), intent(inout) :: from  !! becomes empty
      type(source_t), intent(inout) :: to    !! receives it

      call move_alloc(from%name, to%name)
      call move_alloc(from%text, to%text)
      call move_alloc(from%place, to%place)
      call move_alloc(from%first, to%first)
      call move_alloc(from%last, to%last)
      to%is_file = from%is_file
      to%is_stream = from%is_stream
   end subroutine move_source

   !> Append an inclusion.
   subroutine add_inclusion(deck, including, included)
      type(deck_t), intent(inout) :: deck  !! the deck
      integer, intent(in) :: including     !! number of the file that includes
      integer, intent(in) :: included      !! number of the file that is included

      integer, allocatable :: larger(:, :)

      associate (list => deck%inclusions)
         if (.not. allocated(list%files)) allocate (list%files(2, 4))
         if (list%n == size(list%files, 2)) then
            allocate (larger(2, 2*list%n))
            larger(:, :list%n) = list%files
            call move_alloc(larger, list%files)
         end if
         list%n = list%n + 1
         list%files(:, list%n) = [including, included]
      end associate
   end subroutine add_inclusion

   !> Append a section.
   subroutine add_section(deck, name, location)
      type(deck_t), intent(inout) :: deck       !! the deck
      character(*), intent(in) :: name          !! of the section
      type(location_t), intent(in) :: location  !! of its name

      type(section_t), allocatable :: larger(:)
      integer :: i

      if (.not. allocated(deck%sections)) allocate (deck%sections(32))
      if (deck%n_section == size(deck%sections)) then
         allocate (larger(2*deck%n_section))
         do i = 1, deck%n_section
            call move_alloc(deck%sections(i)%name, larger(i)%name)
            larger(i)%location = deck%sections(i)%location
         end do
         call move_alloc(larger, deck%sections)
      end if
      deck%n_section = deck%n_section + 1
      deck%sections(deck%n_section)%name = name
      deck%sections(deck%n_section)%location = location
   end subroutine add_section

   !> Append a line to the last section.
   subroutine add_line(deck, section, first)
      type(deck_t), intent(inout) :: deck  !! the deck
      integer, intent(in) :: section       !! number of its section
      integer, intent(in) :: first         !! its first token; the last one is the last of all

      type(line_t), allocatable :: larger(:)

      if (.not. allocated(deck%lines)) allocate (deck%lines(64))
      if (deck%n_line == size(deck%lines)) then
         allocate (larger(2*deck%n_line))
         larger(1:deck%n_line) = deck%lines
         call move_alloc(larger, deck%lines)
      end if
      deck%n_line = deck%n_line + 1
      deck%lines(deck%n_line) = line_t(section, first, deck%tokens%n)
   end subroutine add_line

   !> Remember a default that was taken.
   subroutine add_default(deck, line)
      type(deck_t), intent(inout) :: deck  !! the deck
      character(*), intent(in) :: line     !! `kind item key = default`

      call deck%defaults%add(line)
   end subroutine add_default

   !> Number of the first section of some name from `start` on, 0 if there is none.
   pure integer function find_section(deck, name, start)
      type(deck_t), intent(in) :: deck           !! the deck
      character(*), intent(in) :: name           !! of the section
      integer, intent(in), optional :: start     !! number of the section to start with

      integer :: i, k

      find_section = 0
      k = 1
      if (present(start)) k = start
      do i = k, deck%n_section
         if (deck%sections(i)%name == name) then
            find_section = i
            return
         end if
      end do
   end function find_section

   !> The text of a token.
   function text_of(deck, token) result(s)
      type(deck_t), intent(in) :: deck    !! the deck
      type(token_t), intent(in) :: token  !! the token
      character(:), allocatable :: s      !! its text, without braces or quotes

      s = token_text(deck%sources, token)
   end function text_of

   !> Where a part of a stretch of a line stands, not within a longer word; the whole stretch if the part is not found there.
   pure type(location_t) function place_of_part(deck, place, part)
      type(deck_t), intent(in) :: deck          !! the deck
      type(location_t), intent(in) :: place     !! the stretch
      character(*), intent(in) :: part          !! what is searched; blank: nothing

      character(*), parameter :: of_words = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.*"
      integer :: at, next

      place_of_part = place
      if (len(part) == 0 .or. place%file < 1 .or. place%line < 1 .or. place%last < place%first) return
      associate (source => deck%sources(place%file))
         associate (text => " "//source%text(source%first(place%line) + place%first - 1: &
                                             source%first(place%line) + place%last - 1)//" ")
            at = 1
            do
               next = index(text(at + 1:), part)
               if (next == 0) return
               at = at + next
               if (verify(part(1:1), of_words) > 0 .or. verify(text(at - 1:at - 1), of_words) > 0) then
                  if (verify(part(len(part):), of_words) > 0 .or. verify(text(at + len(part):at + len(part)), of_words) > 0) exit
               end if
            end do
         end associate
      end associate
      at = at - 1
      place_of_part%first = place%first + at - 1
      place_of_part%last = place_of_part%first + len(part) - 1
   end function place_of_part

   !> The end of the deck, for what is missing altogether.
   pure type(location_t) function location_of_end(deck)
      type(deck_t), intent(in) :: deck  !! the deck

      integer :: n

      location_of_end = location_t()
      if (deck%n_source == 0) return
      n = n_line_of(deck%sources(1))
      location_of_end = location_t(file=1, line=n)
      if (n == 0) return
      location_of_end%first = deck%sources(1)%last(n) - deck%sources(1)%first(n) + 2
      location_of_end%last = location_of_end%first
   end function location_of_end

end module deck_types
