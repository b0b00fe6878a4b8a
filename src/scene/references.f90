!> Names turned into numbers: every reference of a row is looked up among the items it may mean.
module references
   use diagnostics, only: diagnostics_t
   use item, only: item_t
   use kind_info, only: cell_reference, column_t, kind_info_t
   use text, only: append_text, join, nearest_word, text_t
   implicit none (type, external)
   private
   public :: add_names, directory_t, resolve

   !> Names of all items that can be referred to, by what they are.
   type :: directory_t
      type(text_t), allocatable :: bodies(:)      !! bodies, without the ground
      type(text_t), allocatable :: points(:)      !! points
      type(text_t), allocatable :: materials(:)   !! materials
      type(text_t), allocatable :: revolutes(:)   !! revolute joints
      type(text_t), allocatable :: laws(:)        !! normal laws
      type(text_t), allocatable :: frictions(:)   !! friction laws
   end type directory_t

contains

   !> Append the names of rows to a list.
   subroutine add_names(items, names)
      type(item_t), intent(in) :: items(:)                     !! rows
      type(text_t), allocatable, intent(inout) :: names(:)     !! list, grown

      integer :: k

      if (.not. allocated(names)) allocate (names(0))
      do k = 1, size(items)
         call append_text(names, items(k)%name)
      end do
   end subroutine add_names

   !> Look up all references of the rows of a kind.
   subroutine resolve(directory, info, items, diagnostics)
      type(directory_t), intent(in) :: directory           !! names known
      type(kind_info_t), intent(in) :: info                !! the kind
      type(item_t), intent(inout) :: items(:)              !! its rows; indices are set
      type(diagnostics_t), intent(inout) :: diagnostics    !! mistakes found

      integer :: c, k

      if (.not. allocated(info%columns)) return
      do c = 1, size(info%columns)
         if (info%columns(c)%cell /= cell_reference) cycle
         do k = 1, size(items)
            select case (info%columns(c)%refers_to)
            case ("bodies")
               call look_up(directory%bodies, "body", "bodies", .true.)
            case ("points")
               call look_up(directory%points, "point", "points", .false.)
            case ("material")
               call look_up(directory%materials, "material", "materials", .false.)
            case ("joint.revolute")
               call look_up(directory%revolutes, "joint", "revolute joints", .false.)
            case ("contact.")
               call look_up(directory%laws, "law", "contact laws", .false.)
            case ("friction.")
               call look_up(directory%frictions, "friction", "friction laws", .false.)
            end select
         end do
      end do

   contains

      !> Look up one cell.
      subroutine look_up(names, one, many, with_ground)
         type(text_t), intent(in) :: names(:)    !! names it may be
         character(*), intent(in) :: one         !! what one of them is called
         character(*), intent(in) :: many        !! what they are called together
         logical, intent(in) :: with_ground      !! whether `ground` is one of them

         character(:), allocatable :: hint, near, word
         integer :: i

         items(k)%values(c)%index = 0
         if (.not. allocated(items(k)%values(c)%text)) return
         word = items(k)%values(c)%text
         if (word == "") return
         if (with_ground .and. word == "ground") return
         if (word == "none" .and. has_none(info%columns(c))) return
         do i = 1, size(names)
            if (names(i)%s == word) then
               items(k)%values(c)%index = i
               return
            end if
         end do
         near = nearest_word(word, names)
         hint = ""
         if (near /= "") hint = "did you mean '"//near//"'? "
         hint = hint//many//": "//join(names, " ")
         if (size(names) == 0) hint = "the deck has no "//many
         call diagnostics%add(items(k)%values(c)%location, "unknown "//one//" '"//word//"' in column "// &
                              info%columns(c)%name//" of "//info%name, "no "//one//" of this deck", hint)
      end subroutine look_up

   end subroutine resolve

   !> Whether a column may hold `none`.
   pure logical function has_none(column)
      type(column_t), intent(in) :: column  !! the column

      has_none = .false.
      if (allocated(column%default)) has_none = column%default == "none"
   end function has_none

end module references
