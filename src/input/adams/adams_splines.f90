!> Splines of an Adams dataset as rows of `[function.samples]`, and their calls in expressions.
!>
!> | Adams | deck |
!> |---|---|
!> | `CUBSPL(x, 0, id)` | the cubic spline through the samples of SPLINE/id, `ends = fmm`, which is the one that Adams names |
!> | `AKISPL(x, 0, id)` | Akima's curve through them, `curve = akima` |
!>
!> Beyond the samples the deck's curve continues straight with LINEAR_EXTRAPOLATE, and does not exist without, where Adams continues
!> along the last pieces: the list says so. Source: the public descriptions of the functions of Adams/Solver; `spline` and `akima`.
!> Limits: curves of one argument, whose samples stand in the dataset; no derivatives.
module adams_splines
   use adams_expression, only: node_call, node_curve, node_number, tree_t
   use adams_model, only: adams_model_t, find_statement, leave_out
   use adams_numbers, only: argument_numbers
   use akima, only: new_akima
   use curve, only: beyond_error, beyond_linear
   use dataset, only: has_word, line_words, statement_t
   use deck_draft, only: deck_draft_t, tab
   use diagnostics, only: diagnostics_t
   use expression_symbols, only: symbol_function, symbol_t
   use kinds, only: wp
   use spline, only: ends_fmm, min_samples, new_spline
   use text, only: exact_text, to_text
   implicit none (type, external)
   private
   public :: name_idle_splines, name_splines

   character(*), parameter :: cubic = "cubic_"        !! name of the row of CUBSPL, before the number of the spline
   character(*), parameter :: akimas = "akima_"       !! name of the row of AKISPL

contains

   !> Put the curves of a deck into the place of all splines of an expression; rows of functions go to the deck.
   subroutine name_splines(model, draft, tree, message)
      type(adams_model_t), intent(inout) :: model            !! the dataset
      type(deck_draft_t), intent(inout) :: draft             !! the deck
      type(tree_t), intent(inout) :: tree                    !! the expression
      character(:), allocatable, intent(inout) :: message    !! set: what has no words

      integer :: k

      if (message /= "") return
      do k = 1, tree%n
         if (tree%nodes(k)%kind /= node_call) cycle
         if (tree%nodes(k)%name /= "CUBSPL" .and. tree%nodes(k)%name /= "AKISPL") cycle
         call name_one(model, draft, tree, k, message)
         if (message /= "") return
      end do
   end subroutine name_splines

   !> The curve of one call.
   subroutine name_one(model, draft, tree, node, message)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      type(tree_t), intent(inout) :: tree                       !! the expression
      integer, intent(in) :: node                               !! the call
      character(:), allocatable, intent(inout) :: message       !! set: why it has no words

      character(:), allocatable :: key, name
      real(wp), allocatable :: x(:), y(:)
      integer :: id, k
      logical :: is_new

      associate (it => tree%nodes(node))
         if (size(it%arguments) < 3) then
            message = it%name//" has too few arguments"
            return
         end if
         if (size(it%arguments) > 3) then
            associate (order => tree%nodes(it%arguments(4)))
               if (order%kind /= node_number .or. abs(order%value) > 0.0_wp) message = "a derivative by "//it%name// &
                                                                                       " is not supported"
            end associate
            if (message /= "") return
         end if
         id = 0
         if (tree%nodes(it%arguments(3))%kind == node_number) id = nint(min(tree%nodes(it%arguments(3))%value, 1.0e9_wp))
         k = find_statement(model, "SPLINE", id)
         if (k == 0) then
            message = "the spline of "//it%name//" does not exist"
            return
         end if
         key = merge(cubic, akimas, it%name == "CUBSPL")//to_text(id)
         if (draft%place_of(key) == 0) call take_samples(model%statements(k), x, y, message)
         if (message /= "") return
         call draft%row_of(key, name, is_new)
         if (is_new) call add_row(model, draft, k, name, it%name == "AKISPL", x, y)
         it%kind = node_curve
         it%name = name
         it%arguments = it%arguments(1:1)
      end associate
   end subroutine name_one

   !> Put a spline that nothing of the deck takes on the list of what is omitted.
   subroutine name_idle_splines(model, draft, statement)
      type(adams_model_t), intent(inout) :: model      !! the dataset
      type(deck_draft_t), intent(in) :: draft          !! the deck
      type(statement_t), intent(in) :: statement       !! one of its statements, with its name in full

      if (statement%keyword /= "SPLINE") return
      if (draft%place_of(cubic//to_text(statement%id)) > 0 .or. draft%place_of(akimas//to_text(statement%id)) > 0) return
      call leave_out(model, statement, "it is not used by the deck")
   end subroutine name_idle_splines

   !> The samples of a spline.
   subroutine take_samples(statement, x, y, message)
      type(statement_t), intent(in) :: statement                !! the spline
      real(wp), allocatable, intent(out) :: x(:), y(:)          !! (n) places and values [any]
      character(:), allocatable, intent(inout) :: message       !! set: why a deck has none like it

      type(diagnostics_t) :: mistakes

      call argument_numbers(statement, "X", x, mistakes)
      call argument_numbers(statement, "Y", y, mistakes)
      if (has_word(statement, "Z", 1)) then
         message = "it is a surface, with two arguments"
      else if (has_word(statement, "FILE", 1)) then
         message = "its samples are in a separate file"
      else if (mistakes%count() > 0) then
         message = "one of its samples is not a number"
      else if (size(x) /= size(y)) then
         message = "it has "//to_text(size(y))//" values at "//to_text(size(x))//" places"
      else if (size(x) < min_samples) then
         message = "it has fewer than "//to_text(min_samples)//" samples"
      else if (any(x(2:) <= x(:size(x) - 1))) then
         message = "its abscissas do not increase"
      end if
      if (message /= "") message = "SPLINE/"//to_text(statement%id)//": "//message
   end subroutine take_samples

   !> The row of a spline.
   subroutine add_row(model, draft, statement, name, is_akima, x, y)
      type(adams_model_t), intent(inout) :: model               !! the dataset
      type(deck_draft_t), intent(inout) :: draft                !! the deck
      integer, intent(in) :: statement                          !! number of its statement
      character(*), intent(in) :: name                          !! of the row
      logical, intent(in) :: is_akima                           !! it is Akima's
      real(wp), intent(in) :: x(:), y(:)                        !! (n) its samples [any]

      type(symbol_t) :: symbol
      integer :: beyond, k
      logical :: goes_on

      associate (it => model%statements(statement))
         goes_on = has_word(it, "LINEAR_EXTRAPOLATE", 1)
         if (.not. goes_on) call model%changed%add(line_words(it%at)//"SPLINE/"//to_text(it%id)//": "//name// &
                                                   " ends at its last sample, where Adams extrapolates")
      end associate
      if (draft%functions%n == 0) then   ! at most one of each kind for a spline
         call draft%functions%start(2*count([(model%statements(k)%keyword == "SPLINE", k=1, size(model%statements))]))
      end if
      beyond = merge(beyond_linear, beyond_error, goes_on)
      symbol%name = name
      symbol%kind = symbol_function
      if (is_akima) then
         call new_akima(x, y, beyond, symbol%curve)
      else
         call new_spline(x, y, ends_fmm, beyond, symbol%curve)
      end if
      call draft%functions%add(symbol)
      call draft%put("function.samples", "name at value curve ends beyond", name//tab//list_cell(x)//tab//list_cell(y)//tab// &
                     trim(merge("akima ", "spline", is_akima))//tab//trim(merge("   ", "fmm", is_akima))//tab// &
                     trim(merge("linear", "error ", goes_on)))
   end subroutine add_row

   !> Numbers as a list of a deck.
   pure function list_cell(x) result(cell)
      real(wp), intent(in) :: x(:)             !! (n) the numbers [any]
      character(:), allocatable :: cell        !! in quotes

      integer :: k

      cell = """"
      do k = 1, size(x)
         if (k > 1) cell = cell//" "
         cell = cell//exact_text(x(k))
      end do
      cell = cell//""""
   end function list_cell

end module adams_splines
