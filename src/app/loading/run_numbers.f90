!> Numbers of a run that a deck names: CHANNEL.mean, .rms, .peak, .min, .max or .final, and those of the contacts and of the wear of
!> a joint, as JOINT.impacts.
module run_numbers
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use scene, only: scene_t
   use spelling, only: nearest_word
   use statistics, only: names_of_numbers, number_t
   use text, only: append_text, split_blank, text_t
   use word_checks, only: joints_that_wear
   implicit none (type, external)
   private
   public :: find_run_numbers

   character(*), parameter :: words_of_channels = "mean rms peak min max final"   !! numbers of a channel
   character(*), parameter :: forms = "write CHANNEL.rms, likewise mean, peak, min, max or final, or a number of a joint with " &
      //"clearance, as JOINT.impacts"

contains

   !> The numbers of a run that a word names.
   subroutine find_run_numbers(word, scene, catalogue, is_one, numbers, channel, message, hint)
      character(*), intent(in) :: word                           !! as in the deck
      type(scene_t), intent(in) :: scene                         !! the scene
      type(catalogue_t), intent(in) :: catalogue                 !! what can be reported
      logical, intent(in) :: is_one                              !! it must name one number
      type(number_t), allocatable, intent(out) :: numbers(:)     !! (n) name and unit of each; none after an error
      character(:), allocatable, intent(out) :: channel          !! the channels, as in the deck; blank: a number of a joint
      character(:), allocatable, intent(out) :: message          !! what is wrong; blank: nothing
      character(:), allocatable, intent(out) :: hint             !! what to do

      type(number_t) :: one
      type(number_t), allocatable :: others(:)
      type(scalar_t), allocatable :: scalars(:)
      type(selection_t) :: selection
      type(text_t), allocatable :: known(:), named(:)
      integer :: dot, k

      allocate (numbers(0))
      channel = ""
      message = ""
      hint = forms
      dot = index(word, ".", back=.true.)
      if (dot > 1 .and. index(" "//words_of_channels//" ", " "//word(dot + 1:)//" ") > 0) then
         call match_word(word(:dot - 1), catalogue, selection, message, hint)
         if (message /= "") return
         channel = word(:dot - 1)
         scalars = list_scalars(selection)
         if (is_one .and. size(scalars) /= 1) then
            message = "'"//word//"' is not a single number"
            hint = "name one component of a channel, as slider.acceleration.x.rms"
            return
         end if
         do k = 1, size(scalars)
            one%name = scalar_name(catalogue, scalars(k))//word(dot:)
            one%unit = catalogue%groups(scalars(k)%group)%channel%unit
            numbers = [numbers, one]
         end do
         return
      end if
      call names_of_numbers([scalar_t ::], catalogue, joints_that_wear(scene), others)
      allocate (known(size(others)))
      do k = 1, size(others)
         known(k)%s = others(k)%name
         if (known(k)%s == word) numbers = [others(k)]
      end do
      if (size(numbers) > 0) return
      message = "'"//word//"' is not a number of a run"
      named = [text_t ::]
      if (dot > 0) named = named_channel(word(:dot - 1), word(dot + 1:))
      known = [known, named]
      if (len(nearest_word(word, known)) > 0) hint = "did you mean '"//nearest_word(word, known)//"'? "//forms
   end subroutine find_run_numbers

   !> A channel with the number that is nearest to a word; none if there is no such.
   function named_channel(channel, word) result(names)
      character(*), intent(in) :: channel      !! the channel
      character(*), intent(in) :: word         !! what follows it
      type(text_t), allocatable :: names(:)    !! (0 or 1) the name

      character(:), allocatable :: nearest

      allocate (names(0))
      nearest = nearest_word(word, split_blank(words_of_channels))
      if (nearest /= "") call append_text(names, channel//"."//nearest)
   end function named_channel

end module run_numbers
