!> A row of a deck table (or a section of settings), typed, in SI: what the kinds are made from.
!>
!> The deck reader fills items from the columns of a `kind_info_t`: value k belongs to column k. Whoever needs a value asks for
!> its column by name, once, where it makes a typed record of the row; to ask for a column that is not there is an error of the
!> program, and stops it.
!> The scene turns the names of references into indices. After that no part of the program looks
!> at deck text again, except to say where an error stands.
module item
   use expression, only: expression_t
   use kind_info, only: dim_none, dim_t, longest_column
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: condition_t, find_place, item_t, location_of, location_t, option_t, place_of, take_items, value_t

   !> A stretch of deck text.
   type :: location_t
      integer :: file = 0   !! number of the source file, 1 for the deck itself; 0: nowhere (`--set`, a default)
      integer :: line = 0   !! line number from 1
      integer :: first = 0  !! first column from 1
      integer :: last = 0   !! last column
   end type location_t

   !> An option `name=value` after a word of a setting, as `alpha=5s^-1`.
   type :: option_t
      character(:), allocatable :: name     !! before the equals sign
      character(:), allocatable :: text     !! after it, as written
      real(wp) :: number = 0.0_wp           !! its value if it is a number, SI [any]
      logical :: is_number = .false.        !! whether it is a number
      type(dim_t) :: dimension = dim_none   !! of the number
      type(location_t) :: location          !! of the whole option
   end type option_t

   !> A condition `channel > limit`.
   type :: condition_t
      character(:), allocatable :: channel  !! the word before the sign
      logical :: is_above = .true.          !! `>`: the channel must be greater, `<`: less
      real(wp) :: limit = 0.0_wp            !! what it is compared with, SI [any]
      type(dim_t) :: dimension = dim_none   !! of the limit
      type(location_t) :: location          !! of the channel
      type(location_t) :: limit_location    !! of the limit
   end type condition_t

   !> A vector.
   type :: vector_t
      real(wp) :: x(3) = 0.0_wp   !! (3) its components, SI [any]
      integer :: n = 0            !! numbers given
   end type vector_t

   !> One cell, or the right-hand side of one setting.
   type :: value_t
      character(longest_column) :: column = ""       !! name of the column or key
      logical :: given = .false.                     !! .false.: the column's default was taken
      real(wp) :: number = 0.0_wp                    !! of a number; of an expression its value at t = 0, SI [any]
      type(dim_t) :: dimensions(2) = dim_none        !! (2) of a number of any dimension, a list, the columns of a file
      real(wp), allocatable :: table(:, :)           !! (rows, 1 or 2) numbers of a list, or of a file, SI [any]
      type(vector_t) :: vector                       !! of a vector
      logical :: flag = .false.                      !! of an on/off cell
      character(:), allocatable :: text              !! the word, the name referred to, or the cell as written
      type(text_t), allocatable :: words(:)          !! of a list of words
      type(location_t), allocatable :: places(:)     !! (words or rows) where each entry of a list stands
      type(option_t), allocatable :: options(:)      !! after a word
      type(condition_t), allocatable :: conditions(:)  !! (n) conditions, any of which is enough
      type(expression_t), allocatable :: expression  !! of an expression cell, constant ones too
      integer :: index = 0                           !! of a reference: number of the item, set by the scene
      type(location_t) :: location                   !! where it stands
   end type value_t

   !> One row of a table, or one section of settings.
   type :: item_t
      character(:), allocatable :: kind      !! name of its kind
      character(:), allocatable :: name      !! its name (table rows)
      type(location_t) :: location           !! of the name, or of the section's header
      type(value_t), allocatable :: values(:)  !! (columns of the kind)
   contains
      procedure :: number => item_number
      procedure :: word => item_word
      procedure :: reference => item_reference
      procedure :: flag => item_flag
      procedure :: is_given => item_is_given
      procedure :: direction => item_direction
   end type item_t

contains

   !> Copies of some items. A section with numbers in an array in its place, as an argument, is copied with all that it holds, and
   !> the copy is never given back (gfortran).
   pure subroutine take_items(items, chosen, some)
      type(item_t), intent(in) :: items(:)                 !! (n) items
      integer, intent(in) :: chosen(:)                     !! (m) numbers of those requested
      type(item_t), allocatable, intent(out) :: some(:)    !! (m) these

      integer :: k

      allocate (some(size(chosen)))
      do k = 1, size(chosen)
         some(k) = items(chosen(k))
      end do
   end subroutine take_items

   !> Place of a column among the values of a row by its name; 0 if the kind has none of that name.
   pure integer function find_place(item, name) result(place)
      class(item_t), intent(in) :: item  !! the row, or the section
      character(*), intent(in) :: name   !! the column, or the key

      do place = 1, size(item%values)
         if (item%values(place)%column == name) return
      end do
      place = 0
   end function find_place

   !> Place of a column that the kind must have: if it has not, the program is wrong, and ends.
   pure integer function place_of(item, name) result(place)
      class(item_t), intent(in) :: item  !! the row, or the section
      character(*), intent(in) :: name   !! the column, or the key

      place = find_place(item, name)
      if (place == 0) error stop "internal error: "//item%kind//" has no column '"//name//"'"
   end function place_of

   !> The number in a column; of an expression its value at t = 0.
   pure real(wp) function item_number(self, name) result(number)
      class(item_t), intent(in) :: self   !! the row, or the section
      character(*), intent(in) :: name    !! the column, or the key

      number = self%values(place_of(self, name))%number
   end function item_number

   !> The direction in a column, its maximum component one, so that its length can be found; zero where the column is left open.
   pure function item_direction(self, name) result(x)
      class(item_t), intent(in) :: self   !! the row
      character(*), intent(in) :: name    !! the column
      real(wp) :: x(3)                    !! (3) its components [1]

      x = 0.0_wp
      associate (value => self%values(place_of(self, name)))
         if (.not. allocated(value%table)) return
         if (size(value%table) == 3) x = value%table(:, 1)
      end associate
      if (any(abs(x) > 0.0_wp)) x = x/maxval(abs(x))
   end function item_direction

   !> The word in a column.
   pure function item_word(self, name) result(word)
      class(item_t), intent(in) :: self    !! the row, or the section
      character(*), intent(in) :: name     !! the column, or the key
      character(:), allocatable :: word    !! as in the deck, or the default

      word = self%values(place_of(self, name))%text
   end function item_word

   !> Number of the item that a column refers to, 0: none, or the ground.
   pure integer function item_reference(self, name) result(number)
      class(item_t), intent(in) :: self   !! the row
      character(*), intent(in) :: name    !! the column

      number = self%values(place_of(self, name))%index
   end function item_reference

   !> Whether a column says `on`.
   pure logical function item_flag(self, name) result(flag)
      class(item_t), intent(in) :: self   !! the row, or the section
      character(*), intent(in) :: name    !! the column, or the key

      flag = self%values(place_of(self, name))%flag
   end function item_flag

   !> Whether a column was given, not left to its default.
   pure logical function item_is_given(self, name) result(is_given)
      class(item_t), intent(in) :: self   !! the row, or the section
      character(*), intent(in) :: name    !! the column, or the key

      is_given = self%values(place_of(self, name))%given
   end function item_is_given

   !> Where a word of a list stands.
   pure type(location_t) function location_of(value, word)
      type(value_t), intent(in) :: value  !! the list
      integer, intent(in) :: word         !! number of the word

      location_of = value%location
      if (word <= size(value%places)) location_of = value%places(word)
   end function location_of

end module item
