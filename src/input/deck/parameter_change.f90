!> Other numbers for the parameters of a deck that was read before: what the deck says is not read again.
module parameter_change
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use expression_compile, only: symbol_number, symbol_t, symbols_t
   use kind_info, only: same_dimension
   use kinds, only: wp
   use parameters, only: read_parameters, section_name
   use source_text, only: new_source
   use text, only: text_t
   implicit none (type, external)
   private
   public :: change_parameters

contains

   !> Give the parameters the values of another command line, and say which sections may mean something else now: those with a
   !> line that has a brace and the name of a parameter whose value is another. Without success the deck must be read anew: the
   !> command line has an error, sets more or fewer parameters than the one before, or a word. Functions stay as they are.
   subroutine change_parameters(deck, overrides, is_touched, is_done)
      type(deck_t), intent(inout) :: deck                    !! the deck, of use only after success
      type(text_t), intent(in) :: overrides(:)               !! (n) `NAME=VALUE` of the command line
      logical, allocatable, intent(out) :: is_touched(:)     !! (sections) whether they may mean something else
      logical, intent(out) :: is_done                        !! success

      type(diagnostics_t) :: mistakes
      type(symbols_t) :: before, none
      integer :: k

      allocate (is_touched(deck%n_section), source=.false.)
      is_done = size(overrides) == deck%n_override
      if (.not. is_done) return
      do k = 1, size(overrides)
         call new_source(deck%sources(k + 1), "--set "//overrides(k)%s, overrides(k)%s)
      end do
      before = deck%symbols
      deck%symbols = none
      call read_parameters(deck, mistakes)
      is_done = mistakes%count() == 0 .and. deck%symbols%n_parameter == before%n_parameter
      if (.not. is_done) return
      do k = 1, before%n_parameter
         if (is_same(before%list(k), deck%symbols%list(k))) cycle
         is_done = is_done .and. deck%symbols%list(k)%kind == symbol_number .and. before%list(k)%kind == symbol_number
         call touch(deck, before%list(k)%name, is_touched)
      end do
      call deck%symbols%start(before%n - before%n_parameter)
      do k = before%n_parameter + 1, before%n
         call deck%symbols%add(before%list(k))
      end do
   end subroutine change_parameters

   !> Whether a parameter has the value that it had.
   pure logical function is_same(a, b)
      type(symbol_t), intent(in) :: a  !! before
      type(symbol_t), intent(in) :: b  !! now

      is_same = a%kind == b%kind .and. (a%is_soft .eqv. b%is_soft) .and. same_dimension(a%dimension, b%dimension)
      if (.not. is_same) return
      if (a%kind == symbol_number) then
         is_same = .not. abs(a%number - b%number) > 0.0_wp
      else
         is_same = a%word == b%word
      end if
   end function is_same

   !> Mark the sections in which a parameter may stand.
   subroutine touch(deck, name, is_touched)
      type(deck_t), intent(in) :: deck           !! the deck
      character(*), intent(in) :: name           !! of the parameter
      logical, intent(inout) :: is_touched(:)    !! (sections) those with it are marked

      integer :: k

      do k = 1, deck%n_line
         if (is_touched(deck%lines(k)%section)) cycle
         if (deck%sections(deck%lines(k)%section)%name == section_name) cycle
         associate (at => deck%tokens%t(deck%lines(k)%first)%location)
            associate (source => deck%sources(at%file))
               associate (line => source%text(source%first(at%line):source%last(at%line)))
                  is_touched(deck%lines(k)%section) = index(line, "{") > 0 .and. has_word(line, name)
               end associate
            end associate
         end associate
      end do
   end subroutine touch

   !> Whether a name stands in a line, not as a part of a longer one. What follows a number may be a name.
   pure logical function has_word(line, name)
      character(*), intent(in) :: line   !! the line
      character(*), intent(in) :: name   !! the name

      character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_", digits = "0123456789"
      integer :: after, at, from

      has_word = .false.
      from = 1
      do while (.not. has_word)
         at = index(line(from:), name) + from - 1
         if (at < from) return
         after = at + len(name)
         has_word = scan(line(max(at - 1, 1):at - 1), letters) == 0 &
                    .and. scan(line(after:min(after, len(line))), letters//digits) == 0
         from = at + 1
      end do
   end function has_word

end module parameter_change
