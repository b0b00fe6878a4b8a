!> State equations of a deck: rows of its table become expressions that see the motion and one another.
!>
!> The rows are known to all expressions of loads as channels `state.NAME`, with the dimension of their unit.
module read_states
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name, unit_text
   use expression_compile, only: dimension_agrees, name_length, symbol_broken, symbol_state, symbol_t
   use formula_cell, only: compile_formula
   use item, only: item_t, location_t, place_of
   use kind_info, only: dim_t, same_dimension
   use kind_list, only: kind_named
   use kinds, only: wp
   use observable, only: sees_state
   use observable_words, only: observable_words_t
   use read_requests, only: place_observable
   use scene, only: analysis_dynamic, scene_t
   use state_equations, only: algebraic, continuous, sampled, state_equations_t, state_prefix, state_row_t
   use tables, only: read_items
   use units, only: parse_unit, unit_factor, unit_t
   implicit none (type, external)
   private
   public :: make_states, place_states, states_from_deck

   !> Columns with an expression, in the order of the sorts.
   character(*), parameter :: columns(3) = [character(5) :: "rate", "next", "value"]

contains

   !> Read the table. Its rows are known to the deck's expressions only after that.
   subroutine states_from_deck(deck, scene, diagnostics)
      type(deck_t), intent(inout) :: deck                !! the deck; its symbols are set
      type(scene_t), intent(inout) :: scene              !! the table and the equations are set
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      type(symbol_t) :: symbol
      type(unit_t) :: unit
      integer :: before, k

      associate (table => scene%tables%states)
         table%info => kind_named("state", .false.)
         call read_items(deck, table%info, table%items, diagnostics)
         if (size(table%items) == 0) return
         call deck%symbols%start(size(table%items))
         do k = 1, size(table%items)
            before = diagnostics%count()
            if (name_length(table%items(k)%name) /= len(table%items(k)%name)) then
               call diagnostics%add(table%items(k)%location, "'"//table%items(k)%name//"' is not allowed as the name of a state", &
                                    "use a letter, then letters, digits and _")
            end if
            call read_state_unit(table%items(k), unit, diagnostics)
            symbol%name = state_prefix//table%items(k)%name
            symbol%dimension = unit%dimension
            symbol%kind = merge(symbol_broken, symbol_state, diagnostics%count() > before)
            call deck%symbols%add(symbol)
         end do
      end associate
      call make_states(deck, scene, diagnostics)
   end subroutine states_from_deck

   !> The unit of a row.
   subroutine read_state_unit(item, unit, diagnostics)
      type(item_t), intent(in) :: item                   !! the row
      type(unit_t), intent(out) :: unit                  !! its unit
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      character(:), allocatable :: message
      integer :: first, last

      associate (value => item%values(place_of(item, "unit")))
         if (len(value%text) == 0) return   ! the row has an error
         call parse_unit(value%text, unit, message, first, last)
         if (len(message) > 0) call diagnostics%add(value%location, "invalid unit in column unit of state", message)
      end associate
   end subroutine read_state_unit

   !> The equations of the rows; what their expressions see is placed later.
   subroutine make_states(deck, scene, diagnostics)
      type(deck_t), intent(in) :: deck                   !! the deck, for its parameters, functions and states
      type(scene_t), intent(inout) :: scene              !! the equations are set
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      type(state_equations_t) :: states
      integer :: before, k

      before = diagnostics%count()
      associate (items => scene%tables%states%items)
         allocate (states%rows(size(items)))
         do k = 1, size(items)
            call make_row(deck, items(k), states%rows(k), diagnostics)
         end do
         if (size(items) > 0 .and. .not. scene%settings%has_analysis(analysis_dynamic)) then
            call diagnostics%add(items(1)%location, "state equations need [analysis.dynamic]", "a state changes with time", &
                                 "leave [state] out, or run a dynamic analysis")
         end if
      end associate
      if (diagnostics%count() > before) return
      states%n = size(states%rows)
      states%integrated = pack([(k, k=1, states%n)], states%rows%sort /= algebraic)
      states%n_state = size(states%integrated)
      states%n_sampled = count(states%rows%sort == sampled)
      scene%states = states
   end subroutine make_states

   !> The equation of a row.
   subroutine make_row(deck, item, row, diagnostics)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(item_t), intent(in) :: item                   !! the row
      type(state_row_t), intent(out) :: row              !! its equation
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      type(unit_t) :: unit
      type(dim_t) :: wanted
      logical :: is_given(size(columns))
      integer :: k

      row%name = item%name
      k = deck%symbols%find(state_prefix//item%name)
      if (k == 0) return
      if (deck%symbols%list(k)%kind == symbol_broken) return  ! reported already
      do k = 1, size(columns)
         is_given(k) = item%is_given(trim(columns(k)))
      end do
      if (count(is_given) /= 1) then
         call diagnostics%add(item%location, "state '"//item%name//"' needs one of rate, next and value", &
                              trim(merge("none is given    ", "several are given", .not. any(is_given))), &
                              "rate: differential equation; next, with every: difference equation; value: algebraic variable")
         return
      end if
      row%sort = findloc(is_given, .true., dim=1)
      call read_state_unit(item, unit, diagnostics)
      row%dimension = unit%dimension
      row%unit = unit_text(row%dimension)
      wanted = row%dimension
      if (row%sort == continuous) wanted%s = wanted%s - 1.0_wp
      call compile_cell(deck, item, trim(columns(row%sort)), wanted, row, diagnostics)
      call take_number(item, "start", row%dimension, row%start, diagnostics)
      call take_number(item, "scale", row%dimension, row%scale, diagnostics)
      if (row%scale < 0.0_wp) call diagnostics%add(item%values(place_of(item, "scale"))%location, &
                                                   "the scale of a state must not be negative", "negative")
      if (.not. row%scale > 0.0_wp) row%scale = abs(row%start)
      if (.not. row%scale > 0.0_wp) row%scale = unit_factor(unit)
      row%every = item%number("every")
      associate (every => item%values(place_of(item, "every")))
         if (row%sort == sampled .and. .not. row%every > 0.0_wp) then
            call diagnostics%add(every%location, "sampled state '"//item%name//"' needs a period", "column every", "as every = 1ms")
         else if (row%sort /= sampled .and. row%every > 0.0_wp) then
            call diagnostics%add(every%location, "state '"//item%name//"' is not sampled", "only rows with 'next' have a period")
         end if
      end associate
   end subroutine make_row

   !> A number of the dimension of a row; zero needs no unit.
   subroutine take_number(item, column, dimension, x, diagnostics)
      type(item_t), intent(in) :: item                   !! the row
      character(*), intent(in) :: column                 !! its column
      type(dim_t), intent(in) :: dimension               !! of the row
      real(wp), intent(out) :: x                         !! the number [any]
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      associate (value => item%values(place_of(item, column)))
         x = value%number
         if (.not. abs(x) > 0.0_wp .or. same_dimension(value%dimensions(1), dimension)) return
         call report_dimension_of(value%location, column, value%dimensions(1), dimension, diagnostics)
      end associate
   end subroutine take_number

   !> A cell of another dimension than that of its row.
   subroutine report_dimension_of(location, column, dimension, wanted, diagnostics)
      type(location_t), intent(in) :: location           !! of the cell
      character(*), intent(in) :: column                 !! its column
      type(dim_t), intent(in) :: dimension, wanted       !! what it has, and what it should have
      type(diagnostics_t), intent(inout) :: diagnostics  !! receives the error

      call diagnostics%add(location, "wrong dimension in column "//column//" of state", "this is "// &
                           dimension_name(dimension)//", "//dimension_name(wanted)//" expected")
   end subroutine report_dimension_of

   !> The expression of a row.
   subroutine compile_cell(deck, item, column, wanted, row, diagnostics)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(item_t), intent(in) :: item                   !! the row
      character(*), intent(in) :: column                 !! its column
      type(dim_t), intent(in) :: wanted                  !! dimension that it must have
      type(state_row_t), intent(inout) :: row            !! its equation
      type(diagnostics_t), intent(inout) :: diagnostics  !! errors found

      logical :: is_good

      associate (value => item%values(place_of(item, column)))
         row%location = value%location
         call compile_formula(value, "in column "//column//" of state", deck%symbols, observable_words_t(), row%expression, &
                              is_good, diagnostics)
         if (.not. is_good) return
         if (dimension_agrees(row%expression%dimension, row%expression%is_soft, wanted)) return
         call report_dimension_of(value%location, column, row%expression%dimension, wanted, diagnostics)
      end associate
   end subroutine compile_cell

   !> Find what the equations see, and the order of the algebraic variables.
   subroutine place_states(scene, diagnostics)
      type(scene_t), intent(inout) :: scene               !! the equations are completed
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k, m

      do k = 1, scene%states%n
         associate (row => scene%states%rows(k))
            if (.not. allocated(row%expression%observables)) cycle
            do m = 1, size(row%expression%observables)
               call place_observable(scene, row%location, row%expression%observables(m), diagnostics)
            end do
         end associate
      end do
      call order_variables(scene%states, diagnostics)
   end subroutine place_states

   !> The order of the algebraic variables, each after those that it reads; a loop is an error that names it.
   subroutine order_variables(states, diagnostics)
      type(state_equations_t), intent(inout) :: states    !! the equations; the order is set
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: path(states%n)
      logical :: is_done(states%n)
      integer :: k

      states%order = [integer ::]
      is_done = [(states%rows(k)%sort /= algebraic, k=1, states%n)]
      do k = 1, states%n
         call visit(k, 0)
      end do

   contains

      !> Put a variable behind those that it reads.
      recursive subroutine visit(row, depth)
         integer, intent(in) :: row     !! number of the row
         integer, intent(in) :: depth   !! rows on the path to it

         integer :: m

         if (is_done(row)) return
         if (any(path(:depth) == row)) then
            call report_loop(states, [path(findloc(path(:depth), row, dim=1):depth), row], diagnostics)
            is_done(path(:depth)) = .true.   ! once is enough
            return
         end if
         path(depth + 1) = row
         if (allocated(states%rows(row)%expression%observables)) then
            do m = 1, size(states%rows(row)%expression%observables)
               associate (observable => states%rows(row)%expression%observables(m))
                  if (observable%quantity == sees_state) call visit(observable%component, depth + 1)
               end associate
            end do
         end if
         if (is_done(row)) return
         states%order = [states%order, row]
         is_done(row) = .true.
      end subroutine visit

   end subroutine order_variables

   !> A loop of algebraic variables.
   subroutine report_loop(states, loop, diagnostics)
      type(state_equations_t), intent(in) :: states       !! the equations
      integer, intent(in) :: loop(:)                      !! (rows) the loop, the first row last again
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: words
      integer :: k

      words = states%rows(loop(1))%name
      do k = 2, size(loop)
         words = words//" -> "//states%rows(loop(k))%name
      end do
      call diagnostics%add(states%rows(loop(1))%location, "algebraic loop of states: "//words, "each needs the value of the next", &
                           "give one of them a rate, as a filter, or sample it")
   end subroutine report_loop

end module read_states
