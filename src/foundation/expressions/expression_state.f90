!> The state of the reader of a deck's expressions, and its small tools.
module expression_state
   use dimension_text, only: base_text
   use curve, only: curve_t
   use expression, only: most_seen, n_variable, op_curve
   use expression_reader, only: fail, reader_t
   use expression_symbols, only: symbol_function, symbols_t
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use observable, only: observable_t
   use spelling, only: nearest_word
   use text, only: exact_text, join, split_blank, text_t
   implicit none (type, external)
   private
   public :: call_function, channel_finder_t, emit, find_function, find_variable, function_list, new_parser, parser_t, resolve
   public :: suggestion

   integer, parameter :: longest_code = 400  !! operations of an expression

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

   !> The reader of a deck's expression, and the program so far.
   !> Components: those of channels beside those of the program.
   type, abstract, extends(reader_t) :: parser_t
      character(:), allocatable :: resolved         !! the text up to `n_resolved`, parameters replaced by values
      integer :: n_resolved = 0                     !! characters of the text that were copied there
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
   end type parser_t

contains

   !> Set up a reader at the first character.
   subroutine new_parser(parser, source, symbols, variables, arguments)
      class(parser_t), intent(out) :: parser    !! the reader
      character(*), intent(in) :: source        !! text of the expression
      type(symbols_t), intent(in), target :: symbols  !! parameters and functions; must outlive the reader
      character(*), intent(in) :: variables     !! names of the variables, blank-separated; blank: there are none
      type(dim_t), intent(in) :: arguments(:)   !! (any) their dimensions

      parser%source = source
      parser%resolved = ""
      parser%variables = split_blank(variables)
      parser%arguments(1:size(arguments)) = arguments
      parser%symbols => symbols
   end subroutine new_parser

   !> Number of the variable of some name, 0 if there is none.
   pure integer function find_variable(parser, name)
      class(parser_t), intent(in) :: parser !! the reader
      character(*), intent(in) :: name      !! any name

      integer :: i

      find_variable = 0
      do i = 1, size(parser%variables)
         if (parser%variables(i)%s == name) find_variable = i
      end do
   end function find_variable

   !> Number of the symbol that is a function of some name, 0 if there is none.
   pure integer function find_function(parser, name)
      class(parser_t), intent(in) :: parser !! the reader
      character(*), intent(in) :: name      !! of the function

      find_function = parser%symbols%find(name)
      if (find_function == 0) return
      if (parser%symbols%list(find_function)%kind /= symbol_function) find_function = 0
   end function find_function

   !> The named functions, each after a blank.
   function function_list(parser) result(list)
      class(parser_t), intent(in) :: parser !! the reader
      character(:), allocatable :: list     !! empty if there are none

      list = join(parser%symbols%names_of(functions=.true.), " ")
      if (len(list) > 0) list = " "//list
   end function function_list

   !> Append an operation to the program.
   subroutine emit(parser, op, x)
      class(parser_t), intent(inout) :: parser !! the reader
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
      class(parser_t), intent(inout) :: parser !! the reader
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
      class(parser_t), intent(inout) :: parser !! the reader
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
