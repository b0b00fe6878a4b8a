!> Which channels a run keeps: from the deck's words to a mask over the catalogue.
!>
!> Words: `slider.position`, `slider.position.x`, `slider.position.magnitude`, `gudgeon.*`, `*.velocity`, `*`, `gudgeon.penetration`
!> of a contact, `guide.A.penetration` where a joint has several, `energy.residual`, `energy.*`, `request.NAME`. A `*` for the item
!> stands for everything but points, which have channels only where they are named.
module channels
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: n_groups, group_contacts, group_points
   use channel_hints, only: is_same, suggest
   use channel_names, only: component_letter, item_name, scalar_t
   use name_table, only: name_table_t
   use point_contacts, only: named_channels
   use text, only: segment, text_t
   implicit none (type, external)
   private
   public :: chosen_t, find_scalars, item_finder_t, list_scalars, match_word, select_channels, selection_t

   !> The chosen numbers of a group.
   type :: chosen_t
      logical :: is_used = .false.        !! some of them are chosen
      logical, allocatable :: mask(:, :)  !! (components, items)
   end type chosen_t

   !> The chosen numbers of a catalogue.
   type :: selection_t
      type(chosen_t), allocatable :: groups(:)  !! (groups) as in the catalogue
   contains
      procedure :: clear => clear_selection
      procedure :: choose => choose_scalars
      procedure :: count => count_selection
      procedure :: has_group => selection_has_group
      procedure :: has_item => selection_has_item
   end type selection_t

   !> Finds the items that a part of a word names.
   type :: item_finder_t
      private
      type(name_table_t) :: names(n_groups)  !! (groups) names of the items; of equal names the first
   contains
      procedure :: start => start_finder
      procedure :: find => find_items
   end type item_finder_t

contains

   !> The channels that a list of words names; an empty list names all.
   subroutine select_channels(words, catalogue, selection, bad_word, bad_message, hint)
      type(text_t), intent(in) :: words(:)                    !! (n) words of the deck
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      type(selection_t), intent(out) :: selection             !! what they name
      integer, intent(out) :: bad_word                        !! number of the first wrong word, 0: none
      character(:), allocatable, intent(out) :: bad_message   !! what is wrong with it
      character(:), allocatable, intent(out) :: hint          !! what may have been meant, may be blank

      type(item_finder_t) :: finder
      type(scalar_t), allocatable :: scalars(:)
      integer :: k

      bad_word = 0
      call finder%start(catalogue)
      call selection%clear(catalogue)
      if (size(words) == 0) call match_word("*", catalogue, selection, bad_message, hint)
      do k = 1, size(words)
         call find_scalars(words(k)%s, catalogue, finder, scalars, bad_message, hint)
         call selection%choose(scalars)
         if (len(bad_message) == 0 .or. bad_word > 0) cycle
         bad_word = k
         exit
      end do
      if (bad_word > 0) return
      bad_message = ""
      hint = ""
   end subroutine select_channels

   !> The channels that one word names.
   subroutine match_word(word, catalogue, named, message, hint)
      character(*), intent(in) :: word                   !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(selection_t), intent(out) :: named            !! what it names
      character(:), allocatable, intent(out) :: message  !! blank if it names something
      character(:), allocatable, intent(out) :: hint     !! what may have been meant, may be blank

      type(item_finder_t) :: finder
      type(scalar_t), allocatable :: scalars(:)

      call named%clear(catalogue)
      call finder%start(catalogue)
      call find_scalars(word, catalogue, finder, scalars, message, hint)
      call named%choose(scalars)
   end subroutine match_word

   !> The numbers that one word names, in the order of the catalogue. Only the items of its first part are looked at.
   subroutine find_scalars(word, catalogue, finder, scalars, message, hint)
      character(*), intent(in) :: word                      !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue            !! what can be recorded
      type(item_finder_t), intent(in) :: finder             !! finds its items
      type(scalar_t), allocatable, intent(out) :: scalars(:)  !! (any) what it names
      character(:), allocatable, intent(out) :: message     !! blank if it names something
      character(:), allocatable, intent(out) :: hint        !! what may have been meant, may be blank

      type(text_t), allocatable :: meant(:), parts(:)
      type(scalar_t), allocatable :: named(:)
      integer :: k

      message = ""
      hint = ""
      parts = split_dots(word)
      call collect_scalars(parts, catalogue, finder, scalars)
      if (size(scalars) > 0 .or. word == "*") return
      message = "unknown channel '"//word//"'"
      call suggest(parts, catalogue, meant, hint)
      do k = 1, size(meant)
         call collect_scalars(split_dots(meant(k)%s), catalogue, finder, named)
         if (size(named) == 0) cycle
         hint = "did you mean '"//meant(k)%s//"'? "//hint
         return
      end do
   end subroutine find_scalars

   !> The numbers that the parts of a word name.
   subroutine collect_scalars(parts, catalogue, finder, scalars)
      type(text_t), intent(in) :: parts(:)                    !! (n) parts of the word
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      type(item_finder_t), intent(in) :: finder               !! finds its items
      type(scalar_t), allocatable, intent(out) :: scalars(:)  !! (any) what they name

      integer :: component, first, group, item, last, n, pass

      do pass = 1, 2
         n = 0
         do group = 1, size(catalogue%groups)
            call finder%find(catalogue, catalogue%groups(group)%item_group, parts(1)%s, first, last)
            do item = first, last
               if (.not. catalogue%item_has(group, item)) cycle
               do component = 1, catalogue%groups(group)%channel%components
                  if (.not. fits(parts, catalogue, scalar_t(group, component, item))) cycle
                  n = n + 1
                  if (pass == 2) scalars(n) = scalar_t(group, component, item)
               end do
            end do
         end do
         if (pass == 1) allocate (scalars(n))
      end do
   end subroutine collect_scalars

   !> Enter the names of a catalogue's items.
   subroutine start_finder(self, catalogue)
      class(item_finder_t), intent(inout) :: self  !! the finder
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded

      integer :: item, previous, item_group

      do item_group = 1, n_groups
         call self%names(item_group)%start(size(catalogue%item_groups(item_group)%names))
         do item = 1, size(catalogue%item_groups(item_group)%names)
            call self%names(item_group)%enter(item_name(catalogue, item_group, item), item, previous)
         end do
      end do
   end subroutine start_finder

   !> The items of a group that a part of a word names: all, one, several contacts of a joint (they stand together), or none.
   subroutine find_items(self, catalogue, item_group, part, first, last)
      class(item_finder_t), intent(in) :: self    !! the finder
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      integer, intent(in) :: item_group                 !! the group
      character(*), intent(in) :: part            !! first part of a word
      integer, intent(out) :: first               !! the first of them
      integer, intent(out) :: last                !! the last, less than the first if there are none

      associate (n => size(catalogue%item_groups(item_group)%names))
         first = 1
         last = n
         if (item_group == group_points .and. part == "*") last = 0
         if (part == "*") return
         last = 0
         if (n > 0) first = self%names(item_group)%find(part)
         if (first == 0 .or. n == 0) then
            first = 1
            return
         end if
         last = first
         do while (last < n)
            if (catalogue%item_groups(item_group)%names(last + 1)%s /= catalogue%item_groups(item_group)%names(first)%s) exit
            last = last + 1
         end do
      end associate
   end subroutine find_items

   !> Whether a word, whose first part fits, names a number.
   pure logical function fits(parts, catalogue, scalar)
      type(text_t), intent(in) :: parts(:)        !! (n) parts of the word
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(scalar_t), intent(in) :: scalar        !! the number

      character(:), allocatable :: label, letter, quantity
      integer :: item_group, vector

      item_group = catalogue%groups(scalar%group)%item_group
      quantity = catalogue%groups(scalar%group)%channel%name
      letter = component_letter(catalogue%groups(scalar%group)%channel%components, scalar%component)
      label = ""
      if (item_group == group_contacts) label = catalogue%item_groups(item_group)%labels(scalar%item)%s
      fits = .false.
      vector = catalogue%groups(scalar%group)%vector
      if (vector > 0) then  ! only where it is named
         letter = segment(quantity, len(catalogue%groups(vector)%channel%name) + 2)
         quantity = catalogue%groups(vector)%channel%name
         if (parts(size(parts))%s /= letter .or. size(parts) < 3) return
      end if
      select case (size(parts))
      case (1)
         fits = parts(1)%s == "*" .and. .not. is_named_only(quantity)
      case (2)
         fits = is_same(parts(2)%s, quantity) .and. .not. (parts(2)%s == "*" .and. is_named_only(quantity))
      case (3)
         fits = is_same(parts(2)%s, quantity) .and. len(letter) > 0 .and. is_same(parts(3)%s, letter)
         if (.not. fits) fits = len(label) > 0 .and. is_same(parts(2)%s, label) .and. is_same(parts(3)%s, quantity)
      case (4)
         fits = len(label) > 0 .and. is_same(parts(2)%s, label) .and. is_same(parts(3)%s, quantity) .and. &
                len(letter) > 0 .and. is_same(parts(4)%s, letter)
      case default
         fits = .false.
      end select
   end function fits

   !> Whether a quantity is reported only where it is named.
   pure logical function is_named_only(quantity)
      character(*), intent(in) :: quantity   !! name of the channel

      is_named_only = index(named_channels, " "//quantity//" ") > 0
   end function is_named_only

   !> The parts of a word between its dots.
   pure function split_dots(word) result(parts)
      character(*), intent(in) :: word        !! a word of the deck
      type(text_t), allocatable :: parts(:)   !! (n) its parts, n at least 1

      integer :: at, i, k, next

      allocate (parts(1 + count([(word(i:i) == ".", i=1, len(word))])))
      next = 1
      do k = 1, size(parts) - 1
         at = index(word(next:), ".")
         parts(k)%s = word(next:next + at - 2)
         next = next + at
      end do
      parts(size(parts))%s = word(next:)
   end function split_dots

   !> Every number of a selection, in the order of the catalogue.
   function list_scalars(selection) result(scalars)
      type(selection_t), intent(in) :: selection     !! a selection
      type(scalar_t), allocatable :: scalars(:)      !! (n) its numbers

      integer :: component, group, item, n

      allocate (scalars(selection%count()))
      n = 0
      do group = 1, size(selection%groups)
         do item = 1, size(selection%groups(group)%mask, 2)
            do component = 1, size(selection%groups(group)%mask, 1)
               if (.not. selection%groups(group)%mask(component, item)) cycle
               n = n + 1
               scalars(n) = scalar_t(group, component, item)
            end do
         end do
      end do
   end function list_scalars

   !> Make a selection of nothing.
   subroutine clear_selection(self, catalogue)
      class(selection_t), intent(inout) :: self   !! the selection
      type(catalogue_t), intent(in) :: catalogue  !! what could be chosen

      integer :: group, n_items

      if (allocated(self%groups)) deallocate (self%groups)
      allocate (self%groups(size(catalogue%groups)))
      do group = 1, size(self%groups)
         n_items = size(catalogue%item_groups(catalogue%groups(group)%item_group)%names)
         allocate (self%groups(group)%mask(catalogue%groups(group)%channel%components, n_items), source=.false.)
      end do
   end subroutine clear_selection

   !> Take some numbers as well.
   pure subroutine choose_scalars(self, scalars)
      class(selection_t), intent(inout) :: self  !! the selection
      type(scalar_t), intent(in) :: scalars(:)   !! (any) the numbers

      integer :: k

      do k = 1, size(scalars)
         associate (group => self%groups(scalars(k)%group))
            group%mask(scalars(k)%component, scalars(k)%item) = .true.
            group%is_used = .true.
         end associate
      end do
   end subroutine choose_scalars

   !> How many numbers a selection holds.
   pure integer function count_selection(self)
      class(selection_t), intent(in) :: self  !! the selection

      integer :: group

      count_selection = 0
      do group = 1, size(self%groups)
         count_selection = count_selection + count(self%groups(group)%mask)
      end do
   end function count_selection

   !> Whether a selection holds something of a group.
   pure logical function selection_has_group(self, group)
      class(selection_t), intent(in) :: self  !! the selection
      integer, intent(in) :: group            !! number of the group

      selection_has_group = self%groups(group)%is_used
   end function selection_has_group

   !> Whether a selection holds some channel of an item.
   pure logical function selection_has_item(self, catalogue, item_group, item)
      class(selection_t), intent(in) :: self      !! the selection
      type(catalogue_t), intent(in) :: catalogue  !! what could be chosen
      integer, intent(in) :: item_group                 !! group of the item
      integer, intent(in) :: item                 !! its number there

      integer :: group

      selection_has_item = .false.
      do group = 1, size(self%groups)
         if (catalogue%groups(group)%item_group /= item_group) cycle
         if (any(self%groups(group)%mask(:, item))) selection_has_item = .true.
      end do
   end function selection_has_item

end module channels
