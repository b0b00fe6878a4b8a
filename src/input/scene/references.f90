!> Names turned into numbers: every reference of a row is looked up among the items it may mean.
module references
   use diagnostics, only: diagnostics_t
   use item, only: item_t
   use kind_info, only: cell_reference, column_t, kind_info_t
   use name_table, only: name_table_t
   use spelling, only: nearest_word
   use text, only: join, segment, text_t
   implicit none (type, external)
   private
   public :: add_names, directory_t, resolve

   !> Names of all items that can be referred to, by what they are.
   type :: directory_t
      type(text_t), allocatable :: bodies(:)      !! bodies, without the ground
      type(text_t), allocatable :: points(:)      !! points
      type(text_t), allocatable :: materials(:)   !! materials
      type(text_t), allocatable :: joints(:)      !! joints and drivers, kind by kind in the order of the registry, then joints
                                                  !! with clearance, which other rows do not refer to
      type(text_t), allocatable :: kinds(:)       !! their kinds
      type(text_t), allocatable :: laws(:)        !! normal laws
      type(text_t), allocatable :: frictions(:)   !! friction laws
      type(text_t), allocatable :: wears(:)       !! wear laws
      type(text_t), allocatable :: lubricants(:)  !! lubricants
      type(text_t), allocatable :: films(:)       !! films
   end type directory_t

contains

   !> Append the names of rows to a list.
   subroutine add_names(items, names)
      type(item_t), intent(in) :: items(:)                     !! rows
      type(text_t), allocatable, intent(inout) :: names(:)     !! list, grown

      type(text_t), allocatable :: grown(:)
      integer :: k, n

      if (.not. allocated(names)) allocate (names(0))
      if (size(items) == 0) return
      n = size(names)
      allocate (grown(n + size(items)))
      do k = 1, n
         call move_alloc(names(k)%s, grown(k)%s)
      end do
      do k = 1, size(items)
         grown(n + k)%s = items(k)%name
      end do
      call move_alloc(grown, names)
   end subroutine add_names

   !> Look up all references of the rows of a kind.
   subroutine resolve(directory, info, items, diagnostics)
      type(directory_t), intent(in) :: directory           !! names known
      type(kind_info_t), intent(in) :: info                !! the kind
      type(item_t), intent(inout) :: items(:)              !! its rows; indices are set
      type(diagnostics_t), intent(inout) :: diagnostics    !! errors found

      integer :: c

      if (.not. allocated(info%columns)) return
      if (size(items) == 0) return
      do c = 1, size(info%columns)
         if (info%columns(c)%cell /= cell_reference) cycle
         select case (info%columns(c)%refers_to)
         case ("bodies")
            call look_up_all(directory%bodies, "body", "bodies", .true.)
         case ("points")
            call look_up_all(directory%points, "point", "points", .false.)
         case ("material")
            call look_up_all(directory%materials, "material", "materials", .false.)
         case ("contact.")
            call look_up_all(directory%laws, "law", "contact laws", .false.)
         case ("friction.")
            call look_up_all(directory%frictions, "friction", "friction laws", .false.)
         case ("wear.")
            call look_up_all(directory%wears, "wear law", "wear laws", .false.)
         case ("lubricant")
            call look_up_all(directory%lubricants, "lubricant", "lubricants", .false.)
         case ("film.")
            call look_up_all(directory%films, "film", "films", .false.)
         case default
            call look_up_joints(info%columns(c)%refers_to)
         end select
      end do

   contains

      !> Look up the cells of a column of joints of some kinds; their indices are numbers among all joints.
      subroutine look_up_joints(kinds)
         character(*), intent(in) :: kinds   !! blank-separated kinds, or a prefix ending in a dot

         type(text_t), allocatable :: names(:)
         integer, allocatable :: place(:)
         integer :: k

         place = pack([(k, k=1, size(directory%joints))], [(is_among(directory%kinds(k)%s, kinds), k=1, size(directory%kinds))])
         allocate (names(size(place)))
         do k = 1, size(place)
            names(k)%s = directory%joints(place(k))%s
         end do
         call look_up_all(names, "joint", words_of(kinds), .false.)
         do k = 1, size(items)
            associate (value => items(k)%values(c))
               if (value%index > 0) value%index = place(value%index)
            end associate
         end do
      end subroutine look_up_joints

      !> Look up the cells of a column.
      subroutine look_up_all(names, one, many, with_ground)
         type(text_t), intent(in) :: names(:)    !! names they may be
         character(*), intent(in) :: one         !! what one of them is called
         character(*), intent(in) :: many        !! what they are called together
         logical, intent(in) :: with_ground      !! whether `ground` is one of them

         type(name_table_t) :: table
         integer :: k

         call table%list(names)
         do k = 1, size(items)
            call look_up(k, names, table, one, many, with_ground)
         end do
      end subroutine look_up_all

      !> Look up one cell.
      subroutine look_up(k, names, table, one, many, with_ground)
         integer, intent(in) :: k                !! its row
         type(text_t), intent(in) :: names(:)    !! names it may be
         type(name_table_t), intent(in) :: table !! the same, to find one
         character(*), intent(in) :: one         !! what one of them is called
         character(*), intent(in) :: many        !! what they are called together
         logical, intent(in) :: with_ground      !! whether `ground` is one of them

         character(:), allocatable :: hint, kind, near, word

         items(k)%values(c)%index = 0
         if (.not. allocated(items(k)%values(c)%text)) return
         word = items(k)%values(c)%text
         if (word == "") return
         if (with_ground .and. word == "ground") return
         if (word == "none" .and. has_none(info%columns(c))) return
         items(k)%values(c)%index = table%find(word)
         if (items(k)%values(c)%index > 0) return
         kind = kind_of(directory, word)
         if (one == "joint" .and. kind /= "") then
            call diagnostics%add(items(k)%values(c)%location, "'"//word//"' in column "//info%columns(c)%name//" of "// &
                                 info%name//" is a "//kind, "this column takes "//many, hint_of_kind(kind, many))
            return
         end if
         near = nearest_word(word, names)
         hint = ""
         if (near /= "") hint = "did you mean '"//near//"'? "
         hint = hint//many//": "//join(names, " ")
         if (size(names) == 0) hint = "the deck has no "//many
         call diagnostics%add(items(k)%values(c)%location, "unknown "//one//" '"//word//"' in column "// &
                              info%columns(c)%name//" of "//info%name, "no "//one//" of this deck", hint)
      end subroutine look_up

   end subroutine resolve

   !> Kind of the first joint, driver or joint with clearance of some name; blank: there is none.
   function kind_of(directory, name) result(kind)
      type(directory_t), intent(in) :: directory   !! names known
      character(*), intent(in) :: name             !! any name
      character(:), allocatable :: kind            !! as `joint.translational`

      integer :: k

      kind = ""
      do k = 1, size(directory%joints)
         if (directory%joints(k)%s == name) kind = directory%kinds(k)%s
         if (kind /= "") return
      end do
   end function kind_of

   !> What to do about a joint of another kind.
   pure function hint_of_kind(kind, many) result(hint)
      character(*), intent(in) :: kind     !! of the joint that the deck names
      character(*), intent(in) :: many     !! what joints that are allowed are called
      character(:), allocatable :: hint    !! line of help

      hint = "name one of the "//many//" of the deck; 'gudgeon list' shows the tables for other joints"
      if (index(kind, "clearance.") == 1) hint = "a joint with clearance leaves its bodies free, so it cannot be driven: drive "// &
         "the body at an ideal joint, load it by force.torque or force.point, or use an ideal joint here"
   end function hint_of_kind

   !> Whether a kind is one of some.
   pure logical function is_among(kind, kinds)
      character(*), intent(in) :: kind    !! the kind
      character(*), intent(in) :: kinds   !! blank-separated kinds, or a prefix ending in a dot

      is_among = index(" "//kinds//" ", " "//kind//" ") > 0
      if (kinds(len(kinds):) == ".") is_among = index(kind, kinds) == 1
   end function is_among

   !> What joints of some kinds are called together: joints, revolute joints, revolute or translational joints.
   pure function words_of(kinds) result(words)
      character(*), intent(in) :: kinds      !! blank-separated kinds, or a prefix ending in a dot
      character(:), allocatable :: words     !! in a message

      character(*), parameter :: room = "joint.", with_clearance = "clearance."
      character(:), allocatable :: rest
      integer :: blank

      words = "joints with clearance"
      if (kinds == with_clearance) return
      words = ""
      rest = kinds//" "
      do while (len(rest) > 0)
         blank = index(rest, " ")
         if (words /= "") words = words//" or "
         words = words//rest(len(room) + 1:blank - 1)
         rest = segment(rest, blank + 1)
      end do
      words = trim(adjustl(words//" joints"))
   end function words_of

   !> Whether a column may hold `none`.
   pure logical function has_none(column)
      type(column_t), intent(in) :: column  !! the column

      has_none = .false.
      if (allocated(column%default)) has_none = column%default == "none"
   end function has_none

end module references
