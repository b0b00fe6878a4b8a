!> Figures that are asked for like a call: a histogram, two scalars against each other, a picture of the mechanism.
submodule(figure_words) figure_calls
   use groups_of_catalogue, only: group_contacts
   use channels, only: list_scalars, match_word, selection_t
   use film_words, only: film_hint, take_film
   use motion_words, only: motion_hint, take_motion
   use text, only: append_text
   use text_list, only: text_list_t
   implicit none (type, external)

contains

   !> A figure with arguments.
   module procedure new_call
      type(text_t), allocatable :: arguments(:)
      integer :: k, minimum, most

      bad = ""
      allocate (figure%scalars(0), figure%numbers(0))
      minimum = merge(2, 1, figure%kind == figure_portrait .or. figure%kind == figure_section)
      most = merge(most_panels, minimum, figure%kind == figure_statistics)
      if (figure%kind == figure_film) most = 2
      arguments = arguments_of(word(len_trim(call_words(figure%kind)) + 1:))
      if (draws_mechanism(figure) .and. word(len(word):) == ")" .and. &
          (figure%kind /= figure_coupler .or. size(arguments) > 0)) then
         call take_motion(arguments, figure%kind == figure_coupler, figure%motion, message, bad)
         if (len(message) > 0) hint = motion_hint
         return
      end if
      if (size(arguments) < minimum .or. size(arguments) > most .or. word(len(word):) /= ")") then
         message = "cannot read '"//word//"'"
         hint = "write "//trim(call_words(figure%kind))//trim(merge("x_channel,y_channel", "channel            ", minimum == 2))// &
                ")"
         if (figure%kind == figure_statistics) hint = "write statistics(NUMBER,NUMBER) with one to four numbers"
         if (figure%kind == figure_film) hint = film_hint
         if (draws_mechanism(figure)) hint = motion_hint
         return
      end if
      select case (figure%kind)
      case (figure_histogram)
         call take_histogram(arguments(1)%s, catalogue, figure, message, hint)
         if (len(message) > 0) bad = arguments(1)%s
      case (figure_statistics)
         figure%numbers = arguments
      case (figure_film)
         figure%film%name = figure%name
         call take_film(arguments, catalogue, figure%film, message, hint, bad)
      case default
         do k = 1, size(arguments)
            call take_scalar(arguments(k)%s, catalogue, figure, message, hint)
            if (len(message) > 0) bad = arguments(k)%s
            if (len(message) > 0) return
         end do
      end select
   end procedure new_call

   !> What stands between commas before a closing parenthesis.
   pure function arguments_of(text) result(list)
      character(*), intent(in) :: text           !! as `a,b)`
      type(text_t), allocatable :: list(:)       !! (n) arguments

      type(text_list_t) :: found
      integer :: first, length

      first = 1
      do while (first <= len(text))
         length = scan(text(first:), ",)") - 1
         if (length < 1) exit
         call found%add(text(first:first + length - 1))
         first = first + length + 1
      end do
      list = found%get()
   end function arguments_of

   !> Add a channel that is one number to a figure.
   subroutine take_scalar(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! name of the channel
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      type(selection_t) :: named
      type(scalar_t), allocatable :: scalars(:)

      call match_word(word, catalogue, named, message, hint)
      if (len(message) > 0) return
      scalars = list_scalars(named)
      if (size(scalars) == 1) then
         figure%scalars = [figure%scalars, scalars]
      else
         message = "'"//word//"' is not a single number"
         hint = "this figure needs single components, as in "//word//".x"
      end if
   end subroutine take_scalar

   !> A histogram of what the contacts of a joint do.
   subroutine take_histogram(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! as `gudgeon.impact_speed`
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      integer :: dot, k

      dot = index(word, ".")
      do k = 1, size(catalogue%rooms(group_contacts)%names)
         if (dot == 0) exit
         if (catalogue%rooms(group_contacts)%names(k)%s /= word(1:dot - 1)) cycle
         if (index(" "//histogram_words//" ", " "//word(dot + 1:)//" ") == 0) cycle
         call append_text(figure%numbers, word(1:dot - 1))
         call append_text(figure%numbers, word(dot + 1:))
         return
      end do
      message = "no histogram of '"//word//"'"
      hint = "write histogram(JOINT.impact_speed) or histogram(JOINT.peak_force) for a joint with clearance"
   end subroutine take_histogram

end submodule figure_calls
