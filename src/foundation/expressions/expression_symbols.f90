!> What the expressions of a deck may name: parameters, functions and states, each found by its name in constant time.
module expression_symbols
   use curve, only: curve_t
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use name_table, only: name_table_t
   use text, only: text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: symbol_broken, symbol_function, symbol_number, symbol_state, symbol_t, symbol_word, symbols_t

   integer, parameter :: symbol_number = 1    !! a parameter with a value and a dimension
   integer, parameter :: symbol_word = 2      !! a parameter that is a word
   integer, parameter :: symbol_broken = 3    !! one whose error was reported already
   integer, parameter :: symbol_function = 4  !! a named function
   integer, parameter :: symbol_state = 5     !! a row of the state equations: a channel, by its whole name

   !> A parameter, or a named function.
   type :: symbol_t
      character(:), allocatable :: name    !! as written; blank: it has none that could be found
      integer :: kind = symbol_number      !! one of the above
      real(wp) :: number = 0.0_wp          !! its value, SI [any]
      type(dim_t) :: dimension = dim_none  !! of the value
      logical :: is_soft = .false.         !! its radians may be taken or left
      character(:), allocatable :: word    !! of a word
      type(curve_t) :: curve               !! of a function, whose value has the dimension
      type(dim_t) :: argument = dim_none   !! what a function takes
   end type symbol_t

   !> All symbols of a deck, parameters first.
   type :: symbols_t
      integer :: n_parameter = 0                 !! parameters among them
      integer :: n = 0                           !! symbols
      type(symbol_t), allocatable :: list(:)     !! (n or more) the symbols
      type(name_table_t), private :: names       !! where each stands; of equal names the first
   contains
      procedure :: add => add_symbol
      procedure :: find => find_symbol
      procedure :: names_of
      procedure :: start => start_symbols
   end type symbols_t

contains

   !> Make storage for so many symbols more; those that are there stay.
   subroutine start_symbols(self, n)
      class(symbols_t), intent(inout) :: self  !! the symbols
      integer, intent(in) :: n                 !! most that will be added

      type(symbol_t), allocatable :: list(:)
      integer :: k, previous

      allocate (list(self%n + n))
      call self%names%start(self%n + n)
      do k = 1, self%n
         list(k) = self%list(k)
         if (len(list(k)%name) > 0) call self%names%enter(list(k)%name, k, previous)
      end do
      call move_alloc(list, self%list)
   end subroutine start_symbols

   !> Add a symbol, for which there must be room.
   subroutine add_symbol(self, symbol)
      class(symbols_t), intent(inout) :: self  !! the symbols
      type(symbol_t), intent(in) :: symbol     !! the new one

      integer :: previous

      self%n = self%n + 1
      self%list(self%n) = symbol
      if (len(symbol%name) > 0) call self%names%enter(symbol%name, self%n, previous)
   end subroutine add_symbol

   !> Number of the first symbol of some name, 0 if there is none.
   pure integer function find_symbol(self, name)
      class(symbols_t), intent(in) :: self  !! the symbols
      character(*), intent(in) :: name      !! any name

      find_symbol = self%names%find(name)
   end function find_symbol

   !> Names of the functions, or of all others.
   function names_of(self, functions) result(names)
      class(symbols_t), intent(in) :: self      !! the symbols
      logical, intent(in) :: functions          !! those of functions
      type(text_t), allocatable :: names(:)     !! (any) in their order

      type(text_list_t) :: found
      integer :: k

      do k = 1, self%n
         if (self%list(k)%kind == symbol_state) cycle
         if ((self%list(k)%kind == symbol_function) .eqv. functions) call found%add(self%list(k)%name)
      end do
      names = found%get()
   end function names_of

end module expression_symbols
