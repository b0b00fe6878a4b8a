!> Sections of settings `key = value`, and the check of section names.
module settings
   use cells, only: blank_value, read_value
   use deck_types, only: deck_t, find_section, location_of_end, text_of
   use defaults, only: read_default, remember_default
   use diagnostics, only: diagnostics_t
   use item, only: item_t
   use kind_info, only: is_of_space, kind_info_t
   use name_table, only: name_table_t
   use table_header, only: column_index, column_list
   use spelling, only: nearest_word
   use text, only: append_text, join, starts_with, text_t, to_text
   use tokens, only: span, token_equals, token_t, token_word
   implicit none (type, external)
   private
   public :: check_sections, has_section, read_settings

   integer, parameter :: most_helped = 1000  !! errors with a hint of what was meant; far more than are shown

contains

   !> Read one section of settings; a missing one takes all defaults. A key of a file wins over the same key of the same section in
   !> the files that it includes, directly or through others.
   subroutine read_settings(deck, info, item, is_present, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(item_t), intent(out) :: item               !! the settings; some are empty after errors
      logical, intent(out) :: is_present              !! whether the deck has the section
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      logical, allocatable :: is_set(:), is_won(:, :)
      logical :: is_meant(deck%n_section)
      integer :: i, k, n_column, section

      section = find_section(deck, info%name)
      is_present = section > 0
      n_column = 0
      if (allocated(info%columns)) n_column = size(info%columns)
      item%kind = info%name
      item%name = ""
      item%location = location_of_end(deck)
      if (is_present) item%location = deck%sections(section)%location
      allocate (item%values(n_column), is_set(n_column))
      is_set = .false.
      do k = 1, n_column
         call blank_value(info%columns(k), item%values(k))
         item%values(k)%location = item%location
      end do
      is_meant = [(deck%sections(i)%name == info%name, i=1, deck%n_section)]
      call find_won(deck, info, n_column, is_meant, is_won)
      do i = 1, deck%n_line
         associate (line => deck%lines(i))
            if (.not. is_meant(line%section)) cycle
            k = column_index(info, text_of(deck, deck%tokens%t(line%first)))
            if (k > 0) then
               if (is_won(k, deck%tokens%t(line%first)%location%file)) cycle
            end if
            call read_line(deck, info, deck%tokens%t(line%first:line%last), item, is_set, mistakes)
         end associate
      end do
      call take_defaults(deck, info, is_present, item, is_set, mistakes)
   end subroutine read_settings

   !> The keys that a file gives in vain, for one that includes it gives them.
   subroutine find_won(deck, info, n_column, is_meant, is_won)
      type(deck_t), intent(in) :: deck                   !! the deck
      type(kind_info_t), intent(in) :: info              !! the kind
      integer, intent(in) :: n_column                    !! number of its keys
      logical, intent(in) :: is_meant(:)                 !! (sections) whether they are of this kind
      logical, allocatable, intent(out) :: is_won(:, :)  !! (keys, files) whether a file above gives the key

      logical, allocatable :: has(:, :)
      integer :: i, k

      allocate (is_won(n_column, deck%n_source), source=.false.)
      if (deck%inclusions%n == 0) return
      allocate (has, source=is_won)
      do i = 1, deck%n_line
         associate (line => deck%lines(i))
            if (.not. is_meant(line%section)) cycle
            k = column_index(info, text_of(deck, deck%tokens%t(line%first)))
            if (k > 0) has(k, deck%tokens%t(line%first)%location%file) = .true.
         end associate
      end do
      do
         k = count(is_won)
         do i = 1, deck%inclusions%n
            associate (above => deck%inclusions%files(1, i), below => deck%inclusions%files(2, i))
               is_won(:, below) = is_won(:, below) .or. has(:, above) .or. is_won(:, above)
            end associate
         end do
         if (count(is_won) == k) exit
      end do
   end subroutine find_won

   !> Read one setting.
   subroutine read_line(deck, info, list, item, is_set, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the line
      type(item_t), intent(inout) :: item             !! receives the value
      logical, intent(inout) :: is_set(:)             !! (keys) whether they stood in the deck
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: help, name
      integer :: k

      name = text_of(deck, list(1))
      if (list(1)%kind /= token_word) then
         call mistakes%add(list(1)%location, "expected a key in section "//info%name, "write: key = value", column_list(info))
         return
      end if
      k = column_index(info, name)
      if (k < 1) then
         help = nearest_word(name, column_list(info))
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(list(1)%location, "unknown key '"//name//"' in section "//info%name, &
                         & "not a key of this section", help//column_list(info))
         return
      end if
      if (is_set(k)) call mistakes%add(list(1)%location, "key '"//name//"' is given twice in section "//info%name, &
                                     & "already set", "only an including file may override a key of its included file")
      is_set(k) = .true.
      if (size(list) == 1) then
         call mistakes%add(list(1)%location, "missing '=' after key '"//name//"' of "//info%name, "write: key = value")
      else if (list(2)%kind /= token_equals) then
         call mistakes%add(span(list(1), list(size(list))), "missing '=' after key '"//name//"' of "//info%name, &
                         & "write: key = value")
      else if (size(list) == 2) then
         call mistakes%add(list(2)%location, "missing value of key "//name//" of "//info%name, &
                         & "no value after the equals sign")
      else
         call read_value(deck, info%columns(k), "in key "//name//" of "//info%name, list(3:), item%values(k), mistakes)
      end if
   end subroutine read_line

   !> Fill what was not given.
   subroutine take_defaults(deck, info, is_present, item, is_set, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      logical, intent(in) :: is_present               !! whether the deck has the section
      type(item_t), intent(inout) :: item             !! receives the defaults
      logical, intent(in) :: is_set(:)                !! (keys) whether they stood in the deck
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: missing
      integer :: k

      missing = ""
      do k = 1, size(is_set)
         if (is_set(k)) cycle
         if (.not. allocated(info%columns(k)%default)) then
            missing = missing//" "//info%columns(k)%name
            if (is_present) call mistakes%add(item%location, "missing key '"//info%columns(k)%name//"' in section " &
                     & //info%name, "this key has no default", info%columns(k)%name//": "//info%columns(k)%help)
         else
            call read_default(deck, info%name, info%columns(k), "in key "//info%columns(k)%name//" of "//info%name, &
                            & item%values(k), mistakes)
            item%values(k)%location = item%location
            call remember_default(deck, info%name, "", info%columns(k))
         end if
      end do
      if (is_present .or. len(missing) == 0 .or. .not. deck%is_readable) return
      call mistakes%add(item%location, "section "//info%name//" is missing", "end of the deck", &
                      & "this section is needed for its keys without a default:"//missing)
   end subroutine take_defaults

   !> Whether a deck has a section.
   pure logical function has_section(deck, name)
      type(deck_t), intent(in) :: deck  !! the deck
      character(*), intent(in) :: name  !! of the section

      has_section = find_section(deck, name) > 0
   end function has_section

   !> Report unknown sections, and settings that stand twice.
   subroutine check_sections(deck, kinds, is_spatial, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: kinds(:)       !! (n) all kinds of sections, without `parameters`
      logical, intent(in) :: is_spatial               !! whether the scene is in space
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(name_table_t) :: seen
      character(:), allocatable :: name
      integer :: first, i, k
      logical :: is_known, is_other

      do i = 1, deck%n_section
         name = deck%sections(i)%name
         if (name == "parameters") cycle
         is_known = .false.
         is_other = .false.
         do k = 1, size(kinds)
            if (kinds(k)%name /= name) cycle
            is_known = is_of_space(kinds(k), is_spatial)
            if (is_known) exit
            is_other = .true.
         end do
         if (is_other .and. .not. is_known) then
            call mistakes%add(deck%sections(i)%location, "section "//name//" does not exist in "//words_of(is_spatial), &
                              "a type of "//words_of(.not. is_spatial), "the deck sets space = " &
                              //trim(merge("spatial", "planar ", is_spatial)))
         else if (.not. is_known .and. mistakes%count() >= most_helped) then
            call mistakes%add(deck%sections(i)%location, "unknown section '"//name//"'", "not a section")
         else if (.not. is_known) then
            call report_unknown(deck, i, pack(kinds, is_of_space(kinds, is_spatial)), mistakes)
         else if (.not. kinds(k)%is_table) then
            call seen%enter(to_text(deck%sections(i)%location%file)//" "//name, i, first)
            if (first > 0) call mistakes%add(deck%sections(i)%location, "section "//name//" is given twice in this file", &
                                & "use one section for all settings of a file", "first in line " &
                                & //to_text(deck%sections(first)%location%line))
         end if
      end do
   end subroutine check_sections

   !> A space as text.
   pure function words_of(is_spatial) result(words)
      logical, intent(in) :: is_spatial      !! space, not the plane
      character(:), allocatable :: words     !! what it is called

      words = "the plane"
      if (is_spatial) words = "space"
   end function words_of

   !> Report an unknown section, with the nearest names.
   subroutine report_unknown(deck, i, kinds, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      integer, intent(in) :: i                        !! number of the section
      type(kind_info_t), intent(in) :: kinds(:)       !! (n) all kinds of sections
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(*), parameter :: other_words(7) = [character(9) :: "hinge", "pin", "prismatic", "slider", "ball", "weld", "fixed"]
      character(*), parameter :: joint_words(7) = [character(13) :: "revolute", "revolute", "translational", "translational", &
                                                   "spherical", "rigid", "rigid"]   ! what other programs call otherwise
      type(text_t), allocatable :: groups(:), names(:), relatives(:)
      character(:), allocatable :: group, help, name
      integer :: dot, k

      name = deck%sections(i)%name
      dot = index(name, ".")
      allocate (groups(0), names(0), relatives(0))
      call append_text(names, "parameters")
      call append_text(groups, "parameters")
      do k = 1, size(kinds)
         call append_text(names, kinds(k)%name)
         group = kinds(k)%name
         if (index(group, ".") > 0) group = group(1:index(group, "."))//"*"
         if (index(" "//join(groups, " ")//" ", " "//group//" ") == 0) call append_text(groups, group)
         if (dot == 0) cycle
         if (starts_with(kinds(k)%name, name(1:dot))) call append_text(relatives, kinds(k)%name)
      end do
      help = nearest_word(name, names)
      do k = 1, size(other_words)
         if (name == "joint."//trim(other_words(k))) help = "joint."//trim(joint_words(k))
      end do
      if (len(help) > 0) help = "did you mean ["//help//"]? "
      if (size(relatives) == 0) relatives = groups
      call mistakes%add(deck%sections(i)%location, "unknown section '"//name//"'", "not a section", &
                      & help//"sections: "//join(relatives, " "))
   end subroutine report_unknown

end module settings
