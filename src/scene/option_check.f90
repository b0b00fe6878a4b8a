!> Options of `stabilise` and `contact_onset` against what the word before them takes: names, units, signs.
module option_check
   use diagnostics, only: diagnostics_t
   use item, only: option_t, value_t
   use kind_info, only: dim_length, dim_none, dim_t, same_dimension
   use kinds, only: wp
   use quantities, only: quantity_t, report_dimension
   use section_info, only: word_options
   implicit none (type, external)
   private
   public :: check_options

contains

   !> Report options that the word does not take, and values that are of no use.
   subroutine check_options(key, value, words, known, diagnostics)
      character(*), intent(in) :: key                     !! the key, for messages
      type(value_t), intent(in) :: value                  !! the word and its options
      character(*), intent(in) :: words                   !! words of the key; options of another one are left alone
      character(*), intent(in) :: known                   !! options of any word; others have been reported
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      integer :: k

      if (.not. allocated(value%options) .or. index(" "//words//" ", " "//value%text//" ") == 0) return
      do k = 1, size(value%options)
         if (index(" "//known//" ", " "//value%options(k)%name//" ") == 0) cycle
         call check_one(value%options(k), key, value%text, word_options(value%text), diagnostics)
      end do
   end subroutine check_options

   !> Report what is wrong with an option.
   subroutine check_one(option, key, word, taken, diagnostics)
      type(option_t), intent(in) :: option                !! the option
      character(*), intent(in) :: key                     !! the key
      character(*), intent(in) :: word                    !! the word before it
      character(*), intent(in) :: taken                   !! blank-separated options that the word takes, with their units
      type(diagnostics_t), intent(inout) :: diagnostics   !! mistakes found

      character(:), allocatable :: help, place
      type(dim_t) :: wanted
      type(quantity_t) :: quantity

      place = " of "//key//" = "//word
      if (index(taken, " "//option%name//" ") > 0) then
         wanted = dim_none
      else if (index(taken, " "//option%name//"[s^-1] ") > 0) then
         wanted = dim_t(s=-1)
      else if (index(taken, " "//option%name//"[m] ") > 0) then
         wanted = dim_length
      else
         help = word//" takes no options"
         if (len_trim(taken) > 0) help = "options of "//word//":"//taken(:len_trim(taken))
         call diagnostics%add(option%location, "option '"//option%name//"' does not belong to "//key//" = "//word, &
                              "not an option of "//word, help)
         return
      end if
      if (.not. option%is_number) then
         call diagnostics%add(option%location, "option '"//option%name//"'"//place//" is not a number", "a number is wanted")
         return
      end if
      quantity = quantity_t(x=option%number, dimension=option%dimension, is_good=.true., &
                            has_unit=.not. same_dimension(option%dimension, dim_none))
      call report_dimension(quantity, wanted, option%location, "in option '"//option%name//"'"//place, diagnostics)
      if (.not. quantity%is_good) return
      if (option%number > 0.0_wp .or. (option%number >= 0.0_wp .and. index(" penalty limit ", " "//option%name//" ") == 0)) return
      call diagnostics%add(option%location, "option '"//option%name//"'"//place//" is "// &
                           trim(merge("negative", "zero    ", option%number < 0.0_wp)), "out of bounds")
   end subroutine check_one

end module option_check
