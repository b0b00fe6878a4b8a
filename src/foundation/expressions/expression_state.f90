!> The state of the reader of expressions, and its small tools.
module expression_state
   use dimension_text, only: base_text
   use curve, only: curve_t
   use expression, only: most_seen, n_variable, op_curve
   use expression_symbols, only: symbol_function, symbols_t
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use observable, only: observable_t
   use spelling, only: nearest_word
   use text, only: exact_text, join, split_blank, text_t
   implicit none (type, external)
   private
   public :: advance, call_function, descend, emit, fail, name_length, new_parser, peek, resolve, suggestion
   public :: channel_finder_t, digits, fault_t, find_function, find_variable, function_list, letters, parser_t

   !> An error in an expression.
   type :: fault_t
      character(:), allocatable :: message  !! what is wrong; empty: reported already, say nothing
      character(:), allocatable :: help     !! what to do, may be empty
      integer :: first = 1                  !! first character that is wrong
      integer :: last = 1                   !! last one
   end type fault_t

   integer, parameter :: longest_code = 400  !! operations of an expression
   integer, parameter :: deepest = 60        !! parentheses and signs within each other

   !> Knows the channels that an expression may use.
   type, abstract :: channel_finder_t
   contains
      procedure(find_channel_interface), deferred :: find
   end type channel_finder_t

   abstract interface
      !> The dimension of a channel.
      subroutine find_channel_interface(self, word, dimension, message, help)
         import :: channel_finder_t, dim_t
         implicit none (type, external)
         class(channel_finder_t), intent(in) :: self            !! the finder
         character(*), intent(in) :: word                       !! as `ram.velocity.y`
         type(dim_t), intent(out) :: dimension                  !! of the channel
         character(:), allocatable, intent(out) :: message  !! what is wrong; empty: nothing; unallocated: it is reported already
         character(:), allocatable, intent(out) :: help         !! what to do, may be empty
      end subroutine find_channel_interface
   end interface

   !> The state of the reader. `at` is never on a blank.
   !> Components: those of channels beside those of the program.
   type :: parser_t
      character(:), allocatable :: source           !! the text
      character(:), allocatable :: resolved         !! the text up to `n_resolved`, parameters replaced by values
      integer :: n_resolved = 0                     !! characters of the text that were copied there
      integer :: at = 1                             !! next character
      integer :: last = 0                           !! last character of what was read
      integer :: depth = 0                          !! open parentheses and signs
      type(text_t), allocatable :: variables(:)     !! (any) names of the variables
      type(dim_t) :: arguments(n_variable) = dim_none  !! (n_variable) their dimensions
      integer :: n_code = 0                         !! operations so far
      integer :: code(longest_code) = 0             !! (longest_code) operations
      real(wp) :: operand(longest_code) = 0.0_wp    !! (longest_code) their numbers [any]
      type(symbols_t), pointer :: symbols => null() !! parameters and functions
      integer :: called(longest_code) = 0           !! (longest_code) the functions that it calls, among the symbols
      type(curve_t), allocatable :: curves(:)       !! (any) their curves; unallocated: it calls none
      class(channel_finder_t), pointer :: finder => null()  !! knows channels; not associated: there are none here
      integer :: n_seen = 0                         !! channels that it uses
      type(observable_t) :: observables(most_seen)            !! (most_seen) these
      type(dim_t) :: observed_dimensions(most_seen) = dim_none  !! (most_seen) their dimensions
      type(fault_t), allocatable :: fault           !! the first error
   end type parser_t

   character(*), parameter :: digits = "0123456789"
   character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
   character(*), parameter :: blanks = " "//achar(9)

contains

   !> Set up a reader at the first character.
   subroutine new_parser(parser, source, symbols, variables, arguments)
      type(parser_t), intent(out) :: parser     !! the reader
      character(*), intent(in) :: source        !! text of the expression
      type(symbols_t), intent(in), target :: symbols  !! parameters and functions; must outlive the reader
      character(*), intent(in) :: variables     !! names of the variables, blank-separated; blank: there are none
      type(dim_t), intent(in) :: arguments(:)   !! (any) their dimensions

      parser%source = source
      parser%resolved = ""
      parser%variables = split_blank(variables)
      parser%arguments(1:size(arguments)) = arguments
      parser%symbols => symbols
      call advance(parser, 0)
   end subroutine new_parser

   !> Continue by some characters, and over the blanks that follow.
   subroutine advance(parser, n)
      type(parser_t), intent(inout) :: parser  !! the reader
      integer, intent(in) :: n                 !! characters that were read

      integer :: skip

      parser%at = parser%at + n
      parser%last = parser%at - 1
      if (parser%at > len(parser%source)) return
      skip = verify(parser%source(parser%at:), blanks) - 1
      if (skip < 0) skip = len(parser%source) - parser%at + 1
      parser%at = parser%at + skip
   end subroutine advance

   !> The next character; a blank at the end.
   pure character function peek(parser)
      type(parser_t), intent(in) :: parser  !! the reader

      peek = " "
      if (parser%at <= len(parser%source)) peek = parser%source(parser%at:parser%at)
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

   !> Number of the variable of some name, 0 if there is none.
   pure integer function find_variable(parser, name)
      type(parser_t), intent(in) :: parser  !! the reader
      character(*), intent(in) :: name      !! any name

      integer :: i

      find_variable = 0
      do i = 1, size(parser%variables)
         if (parser%variables(i)%s == name) find_variable = i
      end do
   end function find_variable

   !> Number of the symbol that is a function of some name, 0 if there is none.
   pure integer function find_function(parser, name)
      type(parser_t), intent(in) :: parser  !! the reader
      character(*), intent(in) :: name      !! of the function

      find_function = parser%symbols%find(name)
      if (find_function == 0) return
      if (parser%symbols%list(find_function)%kind /= symbol_function) find_function = 0
   end function find_function

   !> The named functions, each after a blank.
   function function_list(parser) result(list)
      type(parser_t), intent(in) :: parser  !! the reader
      character(:), allocatable :: list     !! empty if there are none

      list = join(parser%symbols%names_of(functions=.true.), " ")
      if (len(list) > 0) list = " "//list
   end function function_list

   !> Append an operation to the program.
   subroutine emit(parser, op, x)
      type(parser_t), intent(inout) :: parser  !! the reader
      integer, intent(in) :: op                !! the operation
      real(wp), intent(in), optional :: x      !! its number [any]

      if (allocated(parser%fault)) return
      if (parser%n_code == longest_code) then
         call fail(parser, 1, len(parser%source), "the expression is too long")
         return
      end if
      parser%n_code = parser%n_code + 1
      parser%code(parser%n_code) = op
      parser%operand(parser%n_code) = 0.0_wp
      if (present(x)) parser%operand(parser%n_code) = x
   end subroutine emit

   !> Append the call of a named function; each function that is called is kept once.
   subroutine call_function(parser, i)
      type(parser_t), intent(inout) :: parser  !! the reader
      integer, intent(in) :: i                 !! its number among the symbols

      type(curve_t), allocatable :: curves(:)
      integer :: k, n

      if (allocated(parser%fault)) return
      n = 0
      if (allocated(parser%curves)) n = size(parser%curves)
      k = findloc(parser%called(:n), i, 1)
      if (k == 0) then
         k = n + 1
         allocate (curves(k))
         if (n > 0) curves(:n) = parser%curves
         curves(k) = parser%symbols%list(i)%curve
         call move_alloc(curves, parser%curves)
         parser%called(k) = i
      end if
      call emit(parser, op_curve, real(k, wp))
   end subroutine call_function

   !> Replace a parameter by its value in the text that will be written back.
   !> A soft number is written as a root, which is soft and gives the very same number.
   subroutine resolve(parser, i, first, last)
      type(parser_t), intent(inout) :: parser  !! the reader
      integer, intent(in) :: i                 !! number of the parameter
      integer, intent(in) :: first             !! first character of its name
      integer, intent(in) :: last              !! last character of its name

      character(:), allocatable :: literal

      associate (symbol => parser%symbols%list(i))
         literal = exact_text(abs(symbol%number))
         if (len(base_text(symbol%dimension)) > 0) literal = literal//" "//base_text(symbol%dimension)
         if (symbol%is_soft) literal = "sqrt(("//literal//")^2)"
         if (symbol%number < 0.0_wp) literal = "-"//literal
      end associate
      parser%resolved = parser%resolved//parser%source(parser%n_resolved + 1:first - 1)//"("//literal//")"
      parser%n_resolved = last
   end subroutine resolve

   !> Go one level deeper.
   subroutine descend(parser)
      type(parser_t), intent(inout) :: parser  !! the reader

      parser%depth = parser%depth + 1
      if (parser%depth > deepest) call fail(parser, parser%at, parser%at, "the expression is nested too deeply")
   end subroutine descend

   !> Remember an error; only the first one counts.
   subroutine fail(parser, first, last, message, help)
      type(parser_t), intent(inout) :: parser      !! the reader
      integer, intent(in) :: first                 !! first character that is wrong
      integer, intent(in) :: last                  !! last one
      character(*), intent(in) :: message          !! what is wrong; empty: reported already
      character(*), intent(in), optional :: help   !! what to do

      if (allocated(parser%fault)) return
      allocate (parser%fault)
      parser%fault%message = message
      parser%fault%help = ""
      if (present(help)) parser%fault%help = help
      parser%fault%first = max(1, min(first, len(parser%source)))
      parser%fault%last = max(parser%fault%first, min(last, len(parser%source)))
   end subroutine fail

   !> A help line with the nearest word.
   function suggestion(word, candidates, otherwise) result(help)
      character(*), intent(in) :: word           !! as written
      type(text_t), intent(in) :: candidates(:)  !! (n) words that would be right
      character(*), intent(in) :: otherwise      !! the help if none is close
      character(:), allocatable :: help          !! the line

      help = nearest_word(word, candidates)
      if (len(help) > 0) then
         help = "did you mean '"//help//"'?"
      else
         help = otherwise
      end if
   end function suggestion

end module expression_state
