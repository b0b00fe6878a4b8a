!> The named functions of a deck: tables of rows become curves that its expressions can call.
module read_functions
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use expression_compile, only: is_reserved, name_length, symbol_broken, symbol_function, symbol_t
   use function_kind, only: function_kind_t, made_t
   use function_registry, only: n_function_kinds, new_function_kind
   use item, only: item_t, location_t
   use kind_list, only: function_info
   use scene, only: scene_t
   use tables, only: read_items
   implicit none (type, external)
   private
   public :: functions_from_deck

contains

   !> Read all functions. They are known to the deck's expressions only after that.
   subroutine functions_from_deck(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                !! the deck; its functions are set
      type(scene_t), intent(inout) :: scene              !! tables are set
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      class(function_kind_t), allocatable :: kind
      type(symbol_t) :: symbol
      integer :: before, i, k, n

      n = 0
      do k = 1, n_function_kinds()
         scene%tables%functions(k)%info => function_info(k)
         call read_items(deck, scene%tables%functions(k)%info, scene%tables%functions(k)%items, diagnostics)
         n = n + size(scene%tables%functions(k)%items)
      end do
      call deck%symbols%start(n)
      do k = 1, n_function_kinds()
         call new_function_kind(k, kind)
         do i = 1, size(scene%tables%functions(k)%items)
            before = diagnostics%count()
            call make_function(kind, scene%tables%functions(k)%items(i), symbol, before == 0, diagnostics)
            call check_name(deck, scene%tables%functions(k)%items(i), diagnostics)
            if (diagnostics%count() > before) symbol%kind = symbol_broken
            call deck%symbols%add(symbol)
         end do
      end do
   end subroutine functions_from_deck

   !> The curve of a row.
   subroutine make_function(kind, item, symbol, is_readable, diagnostics)
      class(function_kind_t), intent(in) :: kind         !! its kind
      type(item_t), intent(inout) :: item                !! the row
      type(symbol_t), intent(out) :: symbol              !! the function
      logical, intent(in) :: is_readable                 !! .false.: some row has an error, none is made
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      type(location_t) :: at
      type(made_t) :: made

      symbol%name = item%name
      symbol%kind = symbol_broken
      if (.not. is_readable) return
      call kind%make(item, made)
      if (made%column > 0) then
         at = item%values(made%column)%location
         if (made%place > 0) at = item%values(made%column)%places(made%place)
         call diagnostics%add(at, "function '"//item%name//"' is invalid", made%message, made%help)
         return
      end if
      symbol%kind = symbol_function
      symbol%curve = made%curve
      symbol%dimension = made%dimension
      symbol%argument = made%argument
   end subroutine make_function

   !> A function is called in expressions: its name must be one there, and no other's.
   subroutine check_name(deck, item, diagnostics)
      type(deck_t), intent(in) :: deck                   !! the deck, with its parameters and the functions before
      type(item_t), intent(in) :: item                   !! its row
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      character(:), allocatable :: message
      integer :: k

      if (len(item%name) == 0) return
      message = ""
      if (is_reserved(item%name)) message = "reserved in expressions"
      if (name_length(item%name) /= len(item%name)) message = "use a letter, then letters, digits and _"
      k = deck%symbols%find(item%name)
      if (k > 0) message = merge("a parameter has this name already", "another function has this name   ", &
         k <= deck%symbols%n_parameter)
      if (len(message) > 0) call diagnostics%add(item%location, "'"//item%name//"' is not allowed as a function name", &
                                                   trim(message))
   end subroutine check_name

end module read_functions
