!> The kinds of named functions: two lines each (`use`, `case`), and their number.
module function_registry
   use function_cam, only: function_cam_t
   use function_harmonic, only: function_harmonic_t
   use function_kind, only: function_kind_t
   use function_polynomial, only: function_polynomial_t
   use function_samples, only: function_samples_t
   implicit none (type, external)
   private
   public :: n_function_kinds, new_function_kind

contains

   !> Number of kinds.
   pure integer function n_function_kinds()
      n_function_kinds = 4
   end function n_function_kinds

   !> Kind number k, 1 to `n_function_kinds`.
   subroutine new_function_kind(k, kind)
      integer, intent(in) :: k                                    !! number of the kind
      class(function_kind_t), allocatable, intent(out) :: kind    !! the kind

      select case (k)
      case (1); allocate (function_polynomial_t :: kind)
      case (2); allocate (function_harmonic_t :: kind)
      case (3); allocate (function_samples_t :: kind)
      case (4); allocate (function_cam_t :: kind)
      end select
   end subroutine new_function_kind

end module function_registry
