!> Options of `stabilise` and `contact_onset` against what the word before them takes: names, units, signs.
module option_check
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use item, only: option_t, value_t
   use kind_info, only: dim_none, kind_info_t, same_dimension
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
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      integer :: k

      if (.not. allocated(value%options) .or. index(" "//words//" ", " "//value%text//" ") == 0) return
      do k = 1, size(value%options)
         if (index(" "//known//" ", " "//value%options(k)%name//" ") == 0) cycle
         call check_one(value%options(k), key, value%text, word_options(key, value%text), diagnostics)
      end do
   end subroutine check_options

   !> Report what is wrong with an option.
   subroutine check_one(option, key, word, taken, diagnostics)
      type(option_t), intent(in) :: option                !! the option
      character(*), intent(in) :: key                     !! the key
      character(*), intent(in) :: word                    !! the word before it
      type(kind_info_t), intent(in) :: taken              !! options that the word takes, as columns
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      character(:), allocatable :: help, place
      type(quantity_t) :: quantity
      integer :: k

      place = " of "//key//" = "//word
      do k = 1, size(taken%columns)
         if (taken%columns(k)%name == option%name) exit
      end do
      if (k > size(taken%columns)) then
         help = word//" takes no options"
         if (size(taken%columns) > 0) help = "options of "//word//":"//names_of(taken)
         call diagnostics%add(option%location, "option '"//option%name//"' is not valid for "//key//" = "//word, &
                              "not an option of "//word, help)
         return
      end if
      if (.not. option%is_number) then
         call diagnostics%add(option%location, "option '"//option%name//"'"//place//" is not a number", "expected a number")
         return
      end if
      quantity = quantity_t(x=option%number, dimension=option%dimension, is_good=.true., &
                            has_unit=.not. same_dimension(option%dimension, dim_none))
      call report_dimension(quantity, taken%columns(k)%dimension, option%location, "in option '"//option%name//"'"//place, &
                            diagnostics)
      if (.not. quantity%is_good) return
      if (option%number > taken%columns(k)%bounds%lower) return
      if (option%number >= taken%columns(k)%bounds%lower .and. .not. taken%columns(k)%bounds%open_lower) return
      call diagnostics%add(option%location, "option '"//option%name//"'"//place//" is "// &
                           trim(merge("negative", "zero    ", option%number < 0.0_wp)), "out of range")
   end subroutine check_one

   !> The options of a word, with the units of those that have one, each after a blank.
   function names_of(taken) result(names)
      type(kind_info_t), intent(in) :: taken   !! options as columns
      character(:), allocatable :: names       !! as ` alpha[s^-1] mu`

      integer :: k

      names = ""
      do k = 1, size(taken%columns)
         associate (column => taken%columns(k))
            names = names//" "//column%name
            if (.not. same_dimension(column%dimension, dim_none)) names = names//"["//unit_text(column%dimension)//"]"
         end associate
      end do
   end function names_of

end module option_check
