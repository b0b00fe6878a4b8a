!> Words in an expression of a deck: names, channels and calls.
!>
!>     channel = name "." name {"." name}
!>
!> Functions are those of expression_functions, and the deck's own by their names. Names are parameters, `pi`, and the time `t`
!> where it is allowed.
module expression_words
   use dimension_text, only: dimension_name
   use expression, only: evaluate_code, most_seen, n_variable, op_add, op_divide, op_multiply, op_rise, op_subtract, op_time
   use expression_dimension, only: dimension_agrees, term_t
   use expression_functions, only: apply_function, function_names, function_operation, most_arguments, n_argument
   use expression_leaves, only: parse_name
   use expression_parser, only: close_parenthesis, parse_sum
   use expression_reader, only: advance, descend, digits, fail, letters, name_length, peek
   use expression_state, only: call_function, emit, find_function, function_list, parser_t, suggestion
   use expression_symbols, only: symbol_broken, symbol_state
   use kind_info, only: dim_t
   use kinds, only: wp
   use rise_laws, only: number_of_rise
   use text, only: split_blank, starts_with, to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: parse_word

contains

   !> A name, or a function with its arguments.
   recursive subroutine parse_word(parser, term)
      class(parser_t), intent(inout) :: parser !! the reader, at the name
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      type(term_t) :: arguments(most_arguments)
      character(:), allocatable :: message, name
      integer :: k, n, operation

      n = channel_length(parser%source(parser%at:))
      if (n > 0) then
         name = parser%source(parser%at:parser%at + n - 1)
         call parse_channel(parser, name, term)
         return
      end if
      n = name_length(parser%source(parser%at:))
      name = parser%source(parser%at:parser%at + n - 1)
      call advance(parser, n)
      if (peek(parser) /= "(") then
         call parse_name(parser, name, term)
         return
      end if
      operation = function_operation(name)
      if (operation == 0) then
         call parse_call(parser, name, term)
         return
      end if
      n = n_argument(operation)
      call descend(parser)
      do k = 1, n
         if (allocated(parser%fault)) return
         call advance(parser, 1)
         call parse_sum(parser, arguments(k))
         if (allocated(parser%fault)) return
         if (k < n .and. peek(parser) /= ",") then
            if (n == 2) then
               call fail(parser, term%first, parser%last, "'"//name//"' takes two arguments, separated by a comma")
            else
               call fail(parser, term%first, parser%last, "'"//name//"' takes five arguments, separated by commas", &
                       & "from h0 at x0 to h1 at x1: "//name//"(x, x0, h0, x1, h1)")
            end if
         else if (k == n .and. peek(parser) == ",") then
            message = ""
            if (name == "step") message = "step(x) is 0 for negative x, else 1; smooth steps: step3 and step5(x, x0, h0, x1, h1)"
            call fail(parser, parser%at, parser%at, "too many arguments for '"//name//"'", message)
         end if
      end do
      call close_parenthesis(parser, term%first)
      if (allocated(parser%fault)) return
      call apply_function(name, operation, arguments, term, message, k)
      if (len(message) > 0) call fail(parser, arguments(k)%first, arguments(k)%last, message)
      if (operation == op_rise) then
         call check_places(parser, name, arguments)
         call emit_rise(parser, number_of_rise(name), arguments%start)
      else
         call emit(parser, operation)
      end if
   end subroutine parse_word

   !> A law that rises takes its way between two places: constant ones must differ.
   subroutine check_places(parser, name, arguments)
      class(parser_t), intent(inout) :: parser  !! the reader, its program ends with the arguments
      character(*), intent(in) :: name          !! of the law
      type(term_t), intent(in) :: arguments(:)  !! (5) x, x0, h0, x1, h1

      real(wp) :: jet(3), place(2)
      integer :: first, k, last

      if (allocated(parser%fault) .or. .not. (arguments(2)%is_constant .and. arguments(4)%is_constant)) return
      do k = 1, 2
         first = arguments(2*k)%start
         last = arguments(2*k + 1)%start - 1
         call evaluate_code(last - first + 1, parser%code(first:last), parser%operand(first:last), parser%curves, &
                          & spread(0.0_wp, 1, n_variable), 1, jet)
         place(k) = jet(1)
      end do
      if (abs(place(2) - place(1)) > 0.0_wp) return
      call fail(parser, arguments(4)%first, arguments(4)%last, "'"//name//"' has zero width: x0 equals x1", &
              & name//"(x, x0, h0, x1, h1) goes from h0 at x0 to h1 at x1")
   end subroutine check_places

   !> A law that rises: h0 + (h1 - h0) s((x - x0)/(x1 - x0)), in the place of its arguments x, x0, h0, x1, h1.
   subroutine emit_rise(parser, law, start)
      class(parser_t), intent(inout) :: parser !! the reader, its program ends with the arguments
      integer, intent(in) :: law               !! number of the law
      integer, intent(in) :: start(:)          !! (5) first operation of each argument

      integer, allocatable :: code(:)
      real(wp), allocatable :: operand(:)
      integer :: first

      if (allocated(parser%fault)) return
      first = start(1)
      code = parser%code(first:parser%n_code)
      operand = parser%operand(first:parser%n_code)
      parser%n_code = first - 1
      call emit_argument(3)
      call emit_argument(5)
      call emit_argument(3)
      call emit(parser, op_subtract)
      call emit_argument(1)
      call emit_argument(2)
      call emit(parser, op_subtract)
      call emit_argument(4)
      call emit_argument(2)
      call emit(parser, op_subtract)
      call emit(parser, op_divide)
      call emit(parser, op_rise, real(law, wp))
      call emit(parser, op_multiply)
      call emit(parser, op_add)

   contains

      !> Append the program of an argument.
      subroutine emit_argument(number)
         integer, intent(in) :: number   !! of the argument

         integer :: k, last

         last = size(code)
         if (number < 5) last = start(number + 1) - first
         do k = start(number) - first + 1, last
            call emit(parser, code(k), operand(k))
         end do
      end subroutine emit_argument

   end subroutine emit_rise

   !> Length of the channel with which a string starts, names with dots between them; 0 if it starts otherwise.
   pure integer function channel_length(string) result(length)
      character(*), intent(in) :: string  !! any string

      integer :: n

      length = name_length(string)
      n = 0
      do while (length > 0 .and. length + 2 <= len(string))
         if (string(length + 1:length + 1) /= "." .or. scan(string(length + 2:length + 2), letters) == 0) exit
         n = verify(string(length + 2:), letters//digits//"_") - 1
         if (n < 0) n = len(string) - length - 1
         length = length + 1 + n
      end do
      if (n == 0) length = 0
   end function channel_length

   !> A channel, which is a variable behind those that have names.
   subroutine parse_channel(parser, word, term)
      class(parser_t), intent(inout) :: parser !! the reader, at the channel
      character(*), intent(in) :: word         !! the channel
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      character(:), allocatable :: help, message
      integer :: k

      call advance(parser, len(word))
      if (.not. associated(parser%finder)) then
         call fail(parser, term%first, parser%last, "the channel '"//word//"' is not allowed here", &
                 & "only loads and requests may use channels")
         return
      end if
      do k = 1, parser%n_seen
         if (parser%observables(k)%word == word) exit
      end do
      if (k > parser%n_seen) then
         if (k > most_seen) then
            call fail(parser, term%first, parser%last, "more than "//to_text(most_seen)//" channels in one expression", &
                    & "split it into requests")
            return
         end if
         call find_channel(parser, word, parser%observed_dimensions(k), message, help)
         if (.not. allocated(message)) then
            call fail(parser, term%first, parser%last, "")
         else if (len(message) > 0) then
            call fail(parser, term%first, parser%last, message, help)
         end if
         parser%observables(k)%word = word
         parser%observables(k)%first = term%first
         parser%n_seen = k
      end if
      term%dimension = parser%observed_dimensions(k)
      term%is_constant = .false.
      call emit(parser, op_time, real(1 + k, wp))
   end subroutine parse_channel

   !> The dimension of a channel: of a state that of its row, else what the finder knows.
   subroutine find_channel(parser, word, dimension, message, help)
      class(parser_t), intent(in) :: parser                  !! the reader
      character(*), intent(in) :: word                       !! the channel
      type(dim_t), intent(out) :: dimension                  !! its dimension
      character(:), allocatable, intent(out) :: message      !! what is wrong with it; empty: nothing; unallocated: reported already
      character(:), allocatable, intent(out) :: help         !! what to do, may be empty

      integer :: k

      message = ""
      help = ""
      k = parser%symbols%find(word)
      if (k == 0) then
         call parser%finder%find(word, dimension, message, help)
         if (.not. allocated(message)) return
         if (len(message) > 0) call suggest_state(parser, word, message, help)
      else if (parser%symbols%list(k)%kind == symbol_state) then
         dimension = parser%symbols%list(k)%dimension
      else
         deallocate (message)
      end if
   end subroutine find_channel

   !> What is wrong with a channel that would be a state.
   subroutine suggest_state(parser, word, message, help)
      class(parser_t), intent(in) :: parser                       !! the reader
      character(*), intent(in) :: word                            !! the channel
      character(:), allocatable, intent(inout) :: message, help   !! what is wrong, and what to do: both are replaced if it is one

      character(*), parameter :: prefix = "state."
      type(text_list_t) :: states
      integer :: k

      if (.not. starts_with(word, prefix)) return
      do k = 1, parser%symbols%n
         if (parser%symbols%list(k)%kind == symbol_state) call states%add(parser%symbols%list(k)%name)
      end do
      message = "there is no state '"//word(len(prefix) + 1:)//"'"
      help = suggestion(word, states%get(), "states are rows of [state]")
   end subroutine suggest_state

   !> A named function of the deck with its argument.
   recursive subroutine parse_call(parser, name, term)
      class(parser_t), intent(inout) :: parser !! the reader, at the parenthesis
      character(*), intent(in) :: name         !! of the function
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      type(term_t) :: argument
      character(:), allocatable :: known
      integer :: i

      i = find_function(parser, name)
      if (i == 0) then
         if (is_broken(parser, name)) then
            call fail(parser, term%first, parser%last, "")
         else
            known = function_names//function_list(parser)
            call fail(parser, term%first, parser%last, "unknown function '"//name//"'", &
                    & suggestion(name, split_blank(known), "functions: "//known))
         end if
         return
      end if
      call descend(parser)
      if (allocated(parser%fault)) return
      call advance(parser, 1)
      call parse_sum(parser, argument)
      if (allocated(parser%fault)) return
      if (peek(parser) == ",") call fail(parser, parser%at, parser%at, "too many arguments for '"//name//"'")
      call close_parenthesis(parser, term%first)
      if (allocated(parser%fault)) return
      associate (symbol => parser%symbols%list(i))
         if (.not. dimension_agrees(argument%dimension, argument%is_soft, symbol%argument)) then
            call fail(parser, argument%first, argument%last, "'"//name//"' takes "//dimension_name(symbol%argument) &
                    & //", got "//dimension_name(argument%dimension))
         end if
         term%dimension = symbol%dimension
      end associate
      term%is_soft = .false.
      term%is_constant = argument%is_constant
      call call_function(parser, i)
   end subroutine parse_call

   !> Whether a name is that of a function or parameter whose error was reported already.
   pure logical function is_broken(parser, name)
      class(parser_t), intent(in) :: parser !! the reader
      character(*), intent(in) :: name      !! the name

      is_broken = .false.
      if (parser%symbols%find(name) > 0) is_broken = parser%symbols%list(parser%symbols%find(name))%kind == symbol_broken
   end function is_broken

end module expression_words
