!> Parameters of a deck that a row or a section names, to change them: numbers, no functions and no words.
module deck_parameter
   use deck_types, only: deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use expression_compile, only: dimension_agrees, symbol_number
   use item, only: location_t, value_t
   use kind_info, only: dim_t
   use spelling, only: nearest_word
   use text, only: join, text_t
   implicit none (type, external)
   private
   public :: check_dimension, number_parameter

contains

   !> Number of a parameter that is a number, in the symbols of the deck; 0 with an error.
   integer function number_parameter(deck, name, location, mistakes) result(n)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: name                !! as written
      type(location_t), intent(in) :: location        !! where
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: help

      n = deck%symbols%find(name)
      if (n > deck%symbols%n_parameter) n = 0  ! a function
      if (n == 0) then
         names = deck%symbols%names_of(functions=.false.)
         help = nearest_word(name, names)
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(location, "'"//name//"' is not a parameter of the deck", "not a parameter", &
                           help//"parameters: "//join(names, " "))
      else if (deck%symbols%list(n)%kind /= symbol_number) then
         call mistakes%add(location, "parameter '"//name//"' is a word", "a number is expected")
         n = 0
      end if
   end function number_parameter

   !> A number must have the dimension of the parameter.
   subroutine check_dimension(value, dimension, is_soft, mistakes)
      type(value_t), intent(in) :: value              !! the number
      type(dim_t), intent(in) :: dimension            !! of the parameter
      logical, intent(in) :: is_soft                  !! radians may be taken or left
      type(diagnostics_t), intent(inout) :: mistakes  !! errors found

      if (.not. value%given .or. dimension_agrees(dimension, is_soft, value%dimensions(1))) return
      call mistakes%add(value%location, "wrong dimension of "//trim(value%column), "this is "// &
                        dimension_name(value%dimensions(1))//", "//dimension_name(dimension)//" is expected")
   end subroutine check_dimension

end module deck_parameter
