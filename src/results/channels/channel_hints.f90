!> What a channel that does not exist may have meant.
module channel_hints
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: n_groups, group_contacts, group_energy
   use channel_names, only: item_name
   use spelling, only: nearest_word
   use text, only: append_text, join, text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: is_same, suggest

   integer, parameter :: most_listed = 12  !! names listed in a hint

contains

   !> Whether a part of a word is `*` or the name itself.
   pure logical function is_same(part, name)
      character(*), intent(in) :: part  !! part of a word
      character(*), intent(in) :: name  !! a name

      is_same = part == "*" .or. (part == name .and. len(part) == len(name))
   end function is_same

   !> What a word that names nothing may have meant. The caller asks whether the words of `meant` name something.
   subroutine suggest(parts, catalogue, meant, hint)
      type(text_t), intent(in) :: parts(:)                   !! (n) parts of the word
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(text_t), allocatable, intent(out) :: meant(:)     !! (any) words that may have been meant, the likeliest first
      character(:), allocatable, intent(out) :: hint         !! what there is

      type(text_t), allocatable :: items(:), quantities(:)
      character(:), allocatable :: item, quantity

      allocate (meant(0))
      items = names_of_items(catalogue)
      item = parts(1)%s
      if (item == "energy" .and. size(catalogue%item_groups(group_energy)%names) == 0) then
         hint = "energies need 'ledger = on' in [analysis.dynamic]"
         return
      end if
      if (item /= "*" .and. .not. is_listed(item, items)) then
         item = nearest_word(item, items)
         if (len(item) == 0) then
            hint = "items with channels: "//listed(items)
            return
         end if
      end if
      quantities = quantities_of(item, catalogue)
      if (size(parts) == 1) then
         hint = "write '"//item//".*' for all of its channels, or one of them: "//listed(quantities)
         return
      end if
      quantity = parts(size(parts))%s
      if (size(parts) > 2) quantity = parts(2)%s
      if (quantity == "film_pressure" .and. is_listed("film_force", quantities) .and. .not. is_listed(quantity, quantities)) then
         hint = "the film of '"//item//"' has no pressure field; film.grid, squeeze, the short and the long films have one"
         return
      end if
      if (.not. (quantity == "*" .or. is_listed(quantity, quantities))) quantity = nearest_word(quantity, quantities)
      hint = "channels of "//item//": "//listed(quantities)
      if (len(quantity) == 0) return
      if (size(parts) > 2 .and. quantity == parts(min(2, size(parts)))%s .and. item == parts(1)%s) then
         hint = "'"//item//"."//quantity//"' has no component '"//parts(3)%s//"'; "//hint
      else
         if (size(parts) > 2) call append_text(meant, item//"."//quantity//"."//parts(3)%s)
         call append_text(meant, item//"."//quantity)
      end if
   end subroutine suggest

   !> Names of all items, each once.
   function names_of_items(catalogue) result(items)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(text_t), allocatable :: items(:)       !! (n) names

      type(text_list_t) :: found
      integer :: item, item_group

      do item_group = 1, n_groups
         if (item_group == group_contacts) cycle
         do item = 1, size(catalogue%item_groups(item_group)%names)
            call found%add(item_name(catalogue, item_group, item))
         end do
      end do
      items = found%get()
   end function names_of_items

   !> Quantities of an item, or of all items (`*`), each once.
   function quantities_of(name, catalogue) result(quantities)
      character(*), intent(in) :: name             !! an item, or `*`
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      type(text_t), allocatable :: quantities(:)   !! (n) channel names

      integer :: group, item

      allocate (quantities(0))
      do group = 1, size(catalogue%groups)
         if (catalogue%groups(group)%vector > 0) cycle
         associate (item_group => catalogue%groups(group)%item_group, quantity => catalogue%groups(group)%channel%name)
            do item = 1, size(catalogue%item_groups(item_group)%names)
               if (.not. is_same(name, item_name(catalogue, item_group, item)) .and. name /= "*") cycle
               if (.not. catalogue%item_has(group, item)) cycle
               if (.not. is_listed(quantity, quantities)) call append_text(quantities, quantity)
               exit
            end do
         end associate
      end do
   end function quantities_of

   !> Whether a word is in a list.
   pure logical function is_listed(word, list)
      character(*), intent(in) :: word     !! any word
      type(text_t), intent(in) :: list(:)  !! (n) words

      integer :: k

      is_listed = .false.
      do k = 1, size(list)
         if (list(k)%s == word) is_listed = .true.
      end do
   end function is_listed

   !> A list in one string, not too long.
   function listed(list) result(s)
      type(text_t), intent(in) :: list(:)  !! (n) words
      character(:), allocatable :: s       !! words with blanks between them

      s = join(list(1:min(size(list), most_listed)), " ")
      if (size(list) > most_listed) s = s//" ..."
   end function listed

end module channel_hints
