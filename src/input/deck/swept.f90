!> What a sweep goes through: parameters, their values, and which of them make a case.
!>
!> Cases are numbered from 1. Parameters of a file continue together, row by row; further ones make a grid with these rows, whose
!> last parameter changes fastest, unless all continue together.
module swept
   use item, only: location_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: most_cases, sweep_t, swept_t

   integer, parameter :: most_cases = 1000000  !! of a sweep

   !> A parameter and its values.
   type :: swept_t
      character(:), allocatable :: name           !! of the parameter
      character(:), allocatable :: unit           !! SI unit of numbers, `1` if none; blank of words
      type(location_t) :: location                !! of the line
      type(text_t), allocatable :: texts(:)       !! (n) values as a deck has them
      real(wp), allocatable :: numbers(:)         !! (n) the same in SI, NaN of words [any]
   end type swept_t

   !> A whole sweep.
   type :: sweep_t
      logical :: is_present = .false.              !! the deck has the section
      logical :: is_paired = .false.               !! all parameters continue together
      logical :: keeps_channels = .false.          !! channels of the runs are kept
      integer :: n_together = 1                    !! parameters, the first of all, that continue together: those of a file
      type(swept_t), allocatable :: parameters(:)  !! (n) what is swept
   contains
      procedure :: n_cases
      procedure :: value_number
      procedure :: n_curves
   end type sweep_t

contains

   !> Number of cases; 1 without a sweep.
   pure integer function n_cases(self)
      class(sweep_t), intent(in) :: self  !! the sweep

      integer :: k

      n_cases = 1
      if (.not. allocated(self%parameters)) return
      do k = 1, size(self%parameters)
         if (self%is_paired .or. (k > 1 .and. k <= self%n_together)) then
            n_cases = size(self%parameters(k)%texts)
         else if (n_cases <= most_cases) then
            n_cases = n_cases*min(size(self%parameters(k)%texts), most_cases)
         end if
      end do
   end function n_cases

   !> Which of its values a parameter has in a case.
   pure integer function value_number(self, parameter_number, case_number) result(at)
      class(sweep_t), intent(in) :: self           !! the sweep
      integer, intent(in) :: parameter_number      !! of the parameter
      integer, intent(in) :: case_number           !! of the case, from 1

      integer :: block, k

      at = case_number
      if (self%is_paired) return
      block = 1
      do k = max(parameter_number, self%n_together) + 1, size(self%parameters)
         block = block*size(self%parameters(k)%texts)
      end do
      at = mod((case_number - 1)/block, size(self%parameters(parameter_number)%texts)) + 1
   end function value_number

   !> Cases per value of the first parameter that differ in others: the curves of a figure.
   pure integer function n_curves(self)
      class(sweep_t), intent(in) :: self  !! the sweep

      n_curves = 1
      if (size(self%parameters) > 1 .and. .not. self%is_paired) n_curves = self%n_cases()/size(self%parameters(1)%texts)
   end function n_curves

end module swept
