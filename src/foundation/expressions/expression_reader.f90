!> The reader of an expression: its place in the text, the first error, and what a dialect adds to the grammar.
!>
!> `expression_parser` holds the grammar, the same for decks and Adams datasets. A dialect extends `reader_t`: it reads
!> numbers and words, and says what becomes of two operands.
module expression_reader
   use expression_dimension, only: term_t
   implicit none (type, external)
   private
   public :: advance, descend, digits, fail, fault_t, letters, name_length, peek, reader_t

   !> An error in an expression.
   type :: fault_t
      character(:), allocatable :: message  !! what is wrong; empty: reported already, say nothing
      character(:), allocatable :: help     !! what to do, may be empty
      integer :: first = 1                  !! first character that is wrong
      integer :: last = 1                   !! last one
   end type fault_t

   integer, parameter :: deepest = 60       !! parentheses and signs within each other

   !> The state of the reader. `at` is never on a blank.
   type, abstract :: reader_t
      character(:), allocatable :: source           !! the text
      integer :: at = 1                             !! next character
      integer :: last = 0                           !! last character of what was read
      integer :: depth = 0                          !! open parentheses and signs
      logical :: has_double_star = .false.          !! `**` is a power, beside `^`
      type(fault_t), allocatable :: fault           !! the first error
   contains
      procedure(combine_interface), deferred :: combine
      procedure(read_interface), deferred :: read_number
      procedure(read_interface), deferred :: read_word
   end type reader_t

   abstract interface
      !> A number or a word at the place of the reader.
      recursive subroutine read_interface(self, term)
         import :: reader_t, term_t
         implicit none (type, external)
         class(reader_t), intent(inout) :: self   !! the reader
         type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read
      end subroutine read_interface

      !> The operation of a sign on two operands; a `~` makes the first negative.
      subroutine combine_interface(self, sign, left, right)
         import :: reader_t, term_t
         implicit none (type, external)
         class(reader_t), intent(inout) :: self   !! the reader
         character, intent(in) :: sign            !! one of `+ - * / ^ ~`
         type(term_t), intent(inout) :: left      !! first operand; the result on return
         type(term_t), intent(in) :: right        !! second operand
      end subroutine combine_interface
   end interface

   character(*), parameter :: digits = "0123456789"
   character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
   character(*), parameter :: blanks = " "//achar(9)

contains

   !> Continue by some characters, and over the blanks that follow.
   subroutine advance(reader, n)
      class(reader_t), intent(inout) :: reader !! the reader
      integer, intent(in) :: n                 !! characters that were read

      integer :: skip

      reader%at = reader%at + n
      reader%last = reader%at - 1
      if (reader%at > len(reader%source)) return
      skip = verify(reader%source(reader%at:), blanks) - 1
      if (skip < 0) skip = len(reader%source) - reader%at + 1
      reader%at = reader%at + skip
   end subroutine advance

   !> The next character; a blank at the end.
   pure character function peek(reader)
      class(reader_t), intent(in) :: reader    !! the reader

      peek = " "
      if (reader%at <= len(reader%source)) peek = reader%source(reader%at:reader%at)
   end function peek

   !> Length of the name with which a string starts; 0 if it starts otherwise.
   pure integer function name_length(string)
      character(*), intent(in) :: string  !! any string

      name_length = 0
      if (len(string) == 0) return
      if (scan(string(1:1), letters) == 0) return
      name_length = verify(string, letters//digits//"_") - 1
      if (name_length < 0) name_length = len(string)
   end function name_length

   !> Go one level deeper.
   subroutine descend(reader)
      class(reader_t), intent(inout) :: reader !! the reader

      reader%depth = reader%depth + 1
      if (reader%depth > deepest) call fail(reader, reader%at, reader%at, "the expression is nested too deeply")
   end subroutine descend

   !> Remember an error; only the first one counts.
   subroutine fail(reader, first, last, message, help)
      class(reader_t), intent(inout) :: reader     !! the reader
      integer, intent(in) :: first                 !! first character that is wrong
      integer, intent(in) :: last                  !! last one
      character(*), intent(in) :: message          !! what is wrong; empty: reported already
      character(*), intent(in), optional :: help   !! what to do

      if (allocated(reader%fault)) return
      allocate (reader%fault)
      reader%fault%message = message
      reader%fault%help = ""
      if (present(help)) reader%fault%help = help
      reader%fault%first = max(1, min(first, len(reader%source)))
      reader%fault%last = max(reader%fault%first, min(last, len(reader%source)))
   end subroutine fail

end module expression_reader
