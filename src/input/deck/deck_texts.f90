!> The texts of a deck as they are kept with its results: with the values in force.
!>
!> A parameter that `--set` has changed stands there with its new value, and what the file says behind it in a comment, so
!> that the text run again without `--set` is the same run. Everything else is verbatim.
module deck_texts
   use deck_types, only: deck_t
   use text, only: text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: deck_text, get_includes

contains

   !> The deck's own text.
   pure function deck_text(deck) result(s)
      type(deck_t), intent(in) :: deck  !! the deck
      character(:), allocatable :: s    !! its text

      s = ""
      if (deck%n_source > 0) s = text_in_force(deck, 1)
   end function deck_text

   !> The included files.
   subroutine get_includes(deck, names, contents)
      type(deck_t), intent(in) :: deck                        !! the deck
      type(text_t), allocatable, intent(out) :: names(:)      !! (n) paths
      type(text_t), allocatable, intent(out) :: contents(:)   !! (n) texts

      type(text_list_t) :: paths, texts
      integer :: k

      do k = 2, deck%n_source
         if (.not. deck%sources(k)%is_file) cycle
         call paths%add(deck%sources(k)%name)
         call texts%add(text_in_force(deck, k))
      end do
      names = paths%get()
      contents = texts%get()
   end subroutine get_includes

   !> A text with the values that the command line gives; parameters stand in it in the order of their list.
   pure function text_in_force(deck, file) result(s)
      type(deck_t), intent(in) :: deck  !! the deck
      integer, intent(in) :: file       !! number of the source
      character(:), allocatable :: s    !! its text

      character(:), allocatable :: old
      integer :: first, k, last

      s = deck%sources(file)%text
      if (deck%n_override == 0) return
      do k = deck%symbols%n_parameter, 1, -1
         associate (at => deck%parameter_change(k))
            if (at%file /= file) cycle
            first = deck%sources(file)%first(at%line) + at%first - 1
            last = deck%sources(file)%first(at%line) + at%last - 1
         end associate
         old = s(first:last)
         s = s(1:first - 1)//deck%parameter_text(k)%s//"   # --set; in the file: "//old//s(last + 1:)
      end do
   end function text_in_force

end module deck_texts
