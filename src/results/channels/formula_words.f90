!> Requests that are expressions over channels: understood when it is known which channels there are.
module formula_words
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_contacts, group_requests
   use channel_names, only: scalar_t
   use channels, only: find_scalars, item_finder_t
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name, unit_text
   use dimensions, only: same_dimension
   use expression, only: expression_t
   use expression_compile, only: channel_finder_t, dimension_agrees
   use formula_cell, only: compile_formula
   use item, only: item_t, location_t, place_of
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use name_table, only: name_table_t
   use requests, only: formula_t, source_t
   use scene, only: scene_t, table_formulas
   use text, only: starts_with, text_t
   use units, only: parse_unit, unit_factor, unit_t
   implicit none (type, external)
   private
   public :: read_formulas

   character(*), parameter :: prefix = "request."   !! of the channels that requests are

   !> Knows the channels of a catalogue, and the requests before the one at hand.
   type, extends(channel_finder_t) :: catalogue_words_t
      type(catalogue_t) :: catalogue                !! what can be recorded
      type(item_finder_t) :: items                  !! finds its items
      type(name_table_t) :: names                   !! of the requests so far
      type(name_table_t) :: broken                  !! of those with an error
      type(dim_t), allocatable :: dimensions(:)     !! (requests) their dimensions
   contains
      procedure :: find => find_word
   end type catalogue_words_t

contains

   !> Understand all requests of a scene. Each may use those before it.
   subroutine read_formulas(deck, catalogue, scene, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, for its parameters and functions
      type(catalogue_t), intent(in) :: catalogue      !! all that it can report but these requests
      type(scene_t), intent(inout) :: scene           !! the scene; its expressions over channels are set
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(catalogue_words_t) :: words
      type(formula_t), allocatable :: formulas(:)
      integer :: k, n, previous

      associate (items => scene%tables%requests(table_formulas)%items)
         words%catalogue = catalogue
         call words%items%start(catalogue)
         call words%names%start(size(items))
         call words%broken%start(size(items))
         allocate (words%dimensions(size(items)), formulas(size(items)))
         n = 0
         do k = 1, size(items)
            call read_formula(deck, words, items(k), formulas(n + 1), words%dimensions(n + 1), mistakes)
            if (allocated(formulas(n + 1)%sources)) then
               n = n + 1
               call words%names%enter(items(k)%name, n, previous)
            else
               call words%broken%enter(items(k)%name, k, previous)
            end if
         end do
      end associate
      if (allocated(scene%requests%formulas)) deallocate (scene%requests%formulas)
      allocate (scene%requests%formulas(n))
      do k = 1, n
         scene%requests%formulas(k) = formulas(k)
      end do
   end subroutine read_formulas

   !> Understand one request; without sources if it has an error.
   subroutine read_formula(deck, words, item, formula, dimension, mistakes)
      type(deck_t), intent(in) :: deck                 !! the deck, for its parameters and functions
      type(catalogue_words_t), intent(in) :: words     !! channels known
      type(item_t), intent(in) :: item                 !! the row
      type(formula_t), intent(out) :: formula          !! the expression
      type(dim_t), intent(inout) :: dimension          !! of its value
      type(diagnostics_t), intent(inout) :: mistakes   !! errors found

      type(location_t) :: at
      integer :: k
      logical :: is_good

      formula%name = item%name
      associate (value => item%values(place_of(item, "value")))
         formula%text = value%text
         call compile_formula(value, "in column value of request", deck%symbols, words, formula%expression, is_good, mistakes)
         if (.not. is_good) return
      end associate
      if (.not. allocated(formula%expression%observables)) allocate (formula%expression%observables(0))
      dimension = formula%expression%dimension
      call take_unit(item, formula%expression, dimension, formula%unit, mistakes, at)
      if (at%line < 0) return
      allocate (formula%sources(size(formula%expression%observables)))
      do k = 1, size(formula%sources)
         formula%sources(k) = source_of(words, formula%expression%observables(k)%word)
      end do
   end subroutine read_formula

   !> The unit that a request says its value has must be one of its dimension. A coherent unit of the SI is that of its numbers: an
   !> energy is in J, a moment in N.m.
   subroutine take_unit(item, expression, dimension, si, mistakes, at)
      type(item_t), intent(in) :: item                 !! the row
      type(expression_t), intent(in) :: expression     !! its value
      type(dim_t), intent(inout) :: dimension          !! of the value, that of the unit on return
      character(:), allocatable, intent(out) :: si     !! SI unit of its numbers
      type(diagnostics_t), intent(inout) :: mistakes   !! errors found
      type(location_t), intent(out) :: at              !! line -1: there is an error

      character(*), parameter :: place = "in column unit of request"
      character(:), allocatable :: message
      type(unit_t) :: unit
      integer :: first, last

      si = unit_text(dimension)
      associate (value => item%values(place_of(item, "unit")))
         if (.not. value%given) return
         call parse_unit(value%text, unit, message, first, last)
         if (len(message) > 0) then
            call mistakes%add(value%location, "invalid unit "//place, message)
         else if (.not. dimension_agrees(dimension, expression%is_soft, unit%dimension)) then
            call mistakes%add(value%location, "invalid unit "//place, "the value of '"//item%name//"' is "// &
                              dimension_name(dimension)//", this is "//dimension_name(unit%dimension), &
                              "its SI unit is "//unit_text(dimension))
         else
            dimension = unit%dimension
            si = unit_text(dimension)
            if (.not. same_dimension(dimension, dim_none) .and. is_coherent(unit)) si = value%text
            return
         end if
         at%line = -1
      end associate
   end subroutine take_unit

   !> Whether a unit has no factor and no offset beside the SI.
   pure logical function is_coherent(unit)
      type(unit_t), intent(in) :: unit  !! the unit

      is_coherent = .not. (abs(unit_factor(unit) - 1.0_wp) > 0.0_wp .or. abs(unit%offset) > 0.0_wp)
   end function is_coherent

   !> The dimension of a channel, which must be a single number.
   subroutine find_word(self, word, dimension, message, help)
      class(catalogue_words_t), intent(in) :: self           !! the finder
      character(*), intent(in) :: word                       !! as `ram.velocity.y`
      type(dim_t), intent(out) :: dimension                  !! of the channel
      character(:), allocatable, intent(out) :: message      !! what is wrong with it; empty: nothing
      character(:), allocatable, intent(out) :: help         !! what to do, may be empty

      type(scalar_t), allocatable :: scalars(:)
      type(unit_t) :: unit
      character(:), allocatable :: wrong
      integer :: first, last

      dimension = dim_none
      message = ""
      help = ""
      if (starts_with(word, prefix)) then
         first = self%names%find(word(len(prefix) + 1:))
         if (first > 0) then
            dimension = self%dimensions(first)
         else if (self%broken%find(word(len(prefix) + 1:)) > 0) then
            deallocate (message)
         else
            message = "there is no request '"//word(len(prefix) + 1:)//"' before this one"
            help = "a request may use only requests above it"
         end if
         return
      end if
      call find_scalars(word, self%catalogue, self%items, scalars, message, help)
      if (len(message) > 0) return
      if (size(scalars) > 1) then
         message = "'"//word//"' has several components"
         help = "write "//word//".x, .y or .magnitude"
         return
      end if
      call parse_unit(self%catalogue%groups(scalars(1)%group)%channel%unit, unit, wrong, first, last)
      dimension = unit%dimension
   end subroutine find_word

   !> Where a channel is found in any catalogue.
   function source_of(words, word) result(source)
      type(catalogue_words_t), intent(in) :: words   !! channels known
      character(*), intent(in) :: word               !! one of them
      type(source_t) :: source                       !! the channel by its names

      type(scalar_t), allocatable :: scalars(:)
      character(:), allocatable :: help, message

      source%label = ""
      if (starts_with(word, prefix)) then
         source%item_group = group_requests
         source%item = "request"
         source%channel = word(len(prefix) + 1:)
         return
      end if
      call find_scalars(word, words%catalogue, words%items, scalars, message, help)
      associate (scalar => scalars(1), catalogue => words%catalogue)
         source%item_group = catalogue%groups(scalar%group)%item_group
         source%item = catalogue%item_groups(source%item_group)%names(scalar%item)%s
         if (source%item_group == group_contacts) source%label = catalogue%item_groups(source%item_group)%labels(scalar%item)%s
         source%channel = catalogue%groups(scalar%group)%channel%name
         source%component = scalar%component
      end associate
   end function source_of

end module formula_words
