!> The grammar of expressions, of decks and of Adams datasets.
!>
!>     sum       = term { ("+" | "-") term }
!>     term      = signed { ("*" | "/") signed }
!>     signed    = { "+" | "-" } power                     so that -2^2 is -4
!>     power     = primary [ "^" signed ]                  right-associative: 2^3^2 is 2^9
!>     primary   = number | name | name arguments | "(" sum ")"
!>     arguments = "(" sum {"," sum} ")"
!>
!> A dialect (`reader_t`) reads numbers, names and arguments: `expression_compile` for decks, `adams_expression` for datasets.
module expression_parser
   use expression_dimension, only: term_t
   use expression_reader, only: advance, descend, fail, letters, peek, reader_t
   use numbers, only: number_length
   implicit none (type, external)
   private
   public :: close_parenthesis, parse_sum, parse_whole

   character(2), parameter :: signs(2) = ["+-", "*/"]  !! of sums, of products

contains

   !> Read the whole text.
   subroutine parse_whole(reader, whole)
      class(reader_t), intent(inout) :: reader !! the reader, new
      type(term_t), intent(out) :: whole       !! the expression

      call advance(reader, 0)
      if (peek(reader) == "") then
         call fail(reader, 1, len(reader%source), "the expression is empty")
         return
      end if
      call parse_sum(reader, whole)
      if (allocated(reader%fault)) return
      select case (peek(reader))
      case ("")
         return
      case (")")
         call fail(reader, reader%at, reader%at, "no matching opening parenthesis")
      case ("<", ">", "=")
         call fail(reader, reader%at, reader%at, "expressions have no comparisons", &
                 & "use step(x): 0 for negative x, else 1")
      case default
         call fail(reader, reader%at, reader%at, "missing operator")
      end select
   end subroutine parse_whole

   !> Sums and differences.
   recursive subroutine parse_sum(reader, term)
      class(reader_t), intent(inout) :: reader !! the reader
      type(term_t), intent(out) :: term        !! what was read

      call parse_chain(reader, 1, term)
   end subroutine parse_sum

   !> Operands with signs of one level between them: a sum of products, or a product of powers with signs.
   recursive subroutine parse_chain(reader, level, term)
      class(reader_t), intent(inout) :: reader !! the reader
      integer, intent(in) :: level             !! of `signs`
      type(term_t), intent(out) :: term        !! what was read

      type(term_t) :: right
      character :: sign

      call parse_operand(term)
      do while (.not. allocated(reader%fault))
         sign = peek(reader)
         if (scan(signs(level), sign) == 0) return
         call advance(reader, 1)
         if (sign == "*" .and. peek(reader) == "*") call fail(reader, reader%at - 1, reader%at, "write a power with ^")
         if (allocated(reader%fault)) return
         call parse_operand(right)
         if (allocated(reader%fault)) return
         term%last = right%last
         call reader%combine(sign, term, right)
      end do

   contains

      !> What stands between the signs.
      recursive subroutine parse_operand(operand)
         type(term_t), intent(out) :: operand  !! what was read

         if (level < size(signs)) then
            call parse_chain(reader, level + 1, operand)
         else
            call parse_signed(reader, operand)
         end if
      end subroutine parse_operand

   end subroutine parse_chain

   !> Signs, which bind less than a power.
   recursive subroutine parse_signed(reader, term)
      class(reader_t), intent(inout) :: reader !! the reader
      type(term_t), intent(out) :: term        !! what was read

      character :: sign
      integer :: first

      sign = peek(reader)
      if (sign /= "+" .and. sign /= "-") then
         call parse_power(reader, term)
         return
      end if
      first = reader%at
      call advance(reader, 1)
      call descend(reader)
      if (allocated(reader%fault)) return
      call parse_signed(reader, term)
      reader%depth = reader%depth - 1
      term%first = first
      if (sign == "-" .and. .not. allocated(reader%fault)) call reader%combine("~", term, term_t())
   end subroutine parse_signed

   !> Powers.
   recursive subroutine parse_power(reader, term)
      class(reader_t), intent(inout) :: reader !! the reader
      type(term_t), intent(out) :: term        !! what was read

      type(term_t) :: right

      call parse_primary(reader, term)
      if (allocated(reader%fault)) return
      if (reader%has_double_star .and. peek(reader) == "*") then
         if (index(adjustl(reader%source(reader%at + 1:)), "*") /= 1) return
         call advance(reader, 1)
      else if (peek(reader) /= "^") then
         return
      end if
      call advance(reader, 1)
      call descend(reader)
      if (allocated(reader%fault)) return
      call parse_signed(reader, right)
      reader%depth = reader%depth - 1
      if (allocated(reader%fault)) return
      term%last = right%last
      call reader%combine("^", term, right)
   end subroutine parse_power

   !> Numbers, names, functions and parentheses.
   recursive subroutine parse_primary(reader, term)
      class(reader_t), intent(inout) :: reader !! the reader
      type(term_t), intent(out) :: term        !! what was read

      integer :: first

      first = reader%at
      term%first = first
      if (peek(reader) == "") then
         call fail(reader, len(reader%source), len(reader%source), "the expression is incomplete")
      else if (peek(reader) == "(") then
         call advance(reader, 1)
         call descend(reader)
         if (allocated(reader%fault)) return
         call parse_sum(reader, term)
         call close_parenthesis(reader, first)
      else if (scan(peek(reader), letters) == 1) then
         call reader%read_word(term)
      else if (number_length(reader%source(reader%at:)) > 0) then
         call reader%read_number(term)
      else
         call fail(reader, reader%at, reader%at, "expected a number, a name or a parenthesis")
      end if
      term%first = first
      term%last = reader%last
   end subroutine parse_primary

   !> The end of a parenthesis.
   subroutine close_parenthesis(reader, first)
      class(reader_t), intent(inout) :: reader !! the reader
      integer, intent(in) :: first             !! where it was opened

      if (allocated(reader%fault)) return
      reader%depth = reader%depth - 1
      if (peek(reader) == ")") then
         call advance(reader, 1)
      else if (peek(reader) == "") then
         call fail(reader, first, reader%last, "missing closing parenthesis")
      else
         call fail(reader, reader%at, reader%at, "expected an operator or a closing parenthesis")
      end if
   end subroutine close_parenthesis

end module expression_parser
