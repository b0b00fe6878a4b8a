!> A parameter of a deck with another value, as `--set` gives it.
module changed_parameter
   use kinds, only: wp
   use options, only: options_t
   use text, only: append_text, exact_text, starts_with, text_t
   implicit none (type, external)
   private
   public :: change_parameter

contains

   !> Give a parameter a value, instead of what the command line gives it.
   subroutine change_parameter(options, name, value, unit)
      type(options_t), intent(inout) :: options   !! the command line
      character(*), intent(in) :: name            !! of the parameter
      real(wp), intent(in) :: value               !! its value, SI [any]
      character(*), intent(in) :: unit            !! SI

      type(text_t), allocatable :: others(:)
      integer :: k

      allocate (others(0))
      do k = 1, size(options%change%overrides)
         if (.not. starts_with(options%change%overrides(k)%s, name//"=")) others = [others, options%change%overrides(k)]
      end do
      call move_alloc(others, options%change%overrides)
      call append_text(options%change%overrides, name//"="//exact_text(value)//" "//unit)
   end subroutine change_parameter

end module changed_parameter
